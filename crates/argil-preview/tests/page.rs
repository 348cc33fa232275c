//! The page as data: what it carries is the strand, whatever text is put beside it. How it looks and works in a browser
//! is tried by `.ci/page`.
#![allow(clippy::unwrap_used)]

use argil_preview::{PageMark, PageStyle, page_html};
use argil_strand::{DVec2, Move, Role, Strand, StrandLayer};
use proptest::prelude::*;
use serde_json::Value;

const ROLES: [Role; 4] = [Role::Wall, Role::Support, Role::Connection, Role::Fill];

fn strands() -> impl Strategy<Value = Strand> {
    let point = (-500.0..500.0f64, -80.0..80.0f64).prop_map(|(x, y)| DVec2::new(x, y));
    let cycle = prop::collection::vec((point, 0..4usize), 2..20);
    prop::collection::vec((cycle, 0.1..2.0f64, 0.3..4.0f64), 1..6).prop_map(|cycles| {
        let start = cycles[0].0[0].0;
        let mut z = 0.0;
        let mut layers = Vec::new();
        for (index, (cycle, height, width)) in cycles.into_iter().enumerate() {
            z += height;
            let seam = cycle[0].0;
            let rise = (index > 0).then_some(Move { to: seam, role: Role::Seam });
            let turn = cycle[1..].iter().map(|&(to, role)| Move { to, role: ROLES[role] });
            let moves = rise.into_iter().chain(turn).chain([Move { to: seam, role: Role::Wall }]).collect();
            layers.push(StrandLayer { index: 2 * index, z, height, width, moves, supports: vec![] });
        }
        Strand::new(start, layers).unwrap()
    })
}

/// What stands between two texts, which must both be there once.
fn between<'t>(text: &'t str, before: &str, after: &str) -> &'t str {
    assert_eq!(text.matches(before).count(), 1, "{before}");
    text.split_once(before).unwrap().1.split_once(after).unwrap().0
}

fn plan_of(page: &str) -> Value {
    serde_json::from_str(between(page, "<script id=\"plan\" type=\"application/json\">", "</script>"))
        .unwrap()
}

fn from_base64(text: &str) -> Vec<u8> {
    let letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut bytes = Vec::new();
    for group in text.trim_end_matches('=').as_bytes().chunks(4) {
        let value = |c: &u8| letters.find(char::from(*c)).unwrap() as u32;
        let whole = group.iter().fold(0, |whole, c| whole << 6 | value(c)) << (6 * (4 - group.len()));
        bytes.extend(&whole.to_be_bytes()[1..group.len()]);
    }
    bytes
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_page_carries_the_strand(strand in strands()) {
        let plan = plan_of(&page_html(&strand, &PageStyle::default()));
        let step = number(&plan["step"]);
        let origin = DVec2::new(number(&plan["origin"][0]), number(&plan["origin"][1]));
        let points: Vec<DVec2> = from_base64(plan["points"].as_str().unwrap())
            .chunks_exact(4)
            .map(|p| {
                let [x, y] = [u16::from_le_bytes([p[0], p[1]]), u16::from_le_bytes([p[2], p[3]])];
                origin + DVec2::new(f64::from(x), f64::from(y)) * step
            })
            .collect();
        let roles = from_base64(plan["moveRoles"].as_str().unwrap());
        prop_assert_eq!(points.len(), roles.len() + 1);
        prop_assert!((points[0] - strand.start()).abs().max_element() <= 0.5001 * step);
        let layers = plan["layers"].as_array().unwrap();
        let told: usize = layers.iter().map(|layer| layer[4].as_u64().unwrap() as usize).sum();
        prop_assert_eq!((layers.len(), told), (strand.layers().len(), roles.len()));

        // Steps of no length on the grid are left out, save where a layer begins.
        let mut drawn = points[1..].iter().zip(&roles);
        let mut at = points[0];
        for step_laid in strand.steps() {
            let to = step_laid.to.truncate();
            let meets = |point: DVec2| (point - to).abs().max_element() <= 0.5001 * step;
            if meets(at) && step_laid.role != Role::Seam {
                continue;
            }
            let (&point, &role) = drawn.next().unwrap();
            prop_assert!(meets(point));
            prop_assert_eq!(Role::ALL[usize::from(role)], step_laid.role);
            at = point;
        }
        prop_assert!(drawn.next().is_none());
        for (told, layer) in layers.iter().zip(strand.layers()) {
            prop_assert_eq!(number(&told[0]) as usize, layer.index);
            prop_assert!((number(&told[1]) - layer.z).abs() < 1e-6);
        }
    }

    #[test]
    fn no_text_breaks_out_of_its_place(title in "\\PC{0,40}", name in ".{0,20}", kind in ".{0,20}") {
        let square = [(9.0, 0.0), (9.0, 9.0), (0.0, 0.0)];
        let moves = square.map(|(x, y)| Move { to: DVec2::new(x, y), role: Role::Wall }).to_vec();
        let layer = StrandLayer { index: 3, z: 0.5, height: 0.5, width: 1.5, moves, supports: vec![] };
        let strand = Strand::new(DVec2::ZERO, vec![layer]).unwrap();
        let title = format!("{title}</title></script><script>{{{{plan}}}}");
        let mark = PageMark {
            kind: format!("{kind}</script>"),
            fault: true,
            layer: 3,
            last_layer: 99,
            at: Some(DVec2::new(f64::NAN, 0.0)),
            measure: f64::INFINITY,
            unit: "\"".into(),
        };
        let style = PageStyle {
            title: title.clone(),
            facts: vec![(name.clone(), "</script>".into())],
            marks: vec![mark],
            ..PageStyle::default()
        };
        let page = page_html(&strand, &style);
        prop_assert_eq!((page.matches("<script").count(), page.matches("</script").count()), (2, 2));
        prop_assert_eq!(page.matches("<title>").count(), 1);
        let plan = plan_of(&page);
        prop_assert_eq!(plan["title"].as_str(), Some(title.as_str()));
        prop_assert_eq!(plan["facts"][0][0].as_str(), Some(name.as_str()));
        prop_assert_eq!(&plan["marks"][0], &serde_json::json!([0, 0, null, null, 0, 0]));
    }
}

#[test]
fn the_page_needs_nothing_from_elsewhere() {
    let moves =
        vec![Move { to: DVec2::new(5.0, 5.0), role: Role::Wall }, Move { to: DVec2::ZERO, role: Role::Wall }];
    let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves, supports: vec![] };
    let page = page_html(&Strand::new(DVec2::ZERO, vec![layer]).unwrap(), &PageStyle::default());
    for outward in ["http", "src=", "href=", "@import", "url(", "fetch(", "XMLHttpRequest", "import("] {
        assert!(!page.contains(outward), "{outward}");
    }
    assert!(page.len() < 80_000, "{} bytes without a plan", page.len());
}
