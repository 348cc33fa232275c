//! The cleaning guide as data: every place once and in order, every picture a picture, every cut along the wall's edge.
#![allow(clippy::unwrap_used)]

use argil_preview::{CleaningStyle, CutPlace, cleaning_html};
use argil_strand::{DVec2, Move, Role, Strand, StrandLayer};
use proptest::prelude::*;
use resvg::usvg::{Group, Node, Options, Tree};

const RADIUS: f64 = 20.0;
const WIDTH: f64 = 1.5;

/// Rings of wall with a spoke of support that runs in and back at angle 0. Every other number is a layer's.
fn rings(layers: usize) -> Strand {
    let at = |k: i32| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 180.0) * RADIUS;
    let wall = (1..=180).map(|k| Move { to: at(k % 180), role: Role::Wall });
    let spoke = [5.0, RADIUS].map(|x| Move { to: DVec2::new(x, 0.0), role: Role::Support });
    let turn: Vec<Move> = spoke.into_iter().chain(wall).collect();
    let seam = Move { to: at(0), role: Role::Seam };
    let layer = |k: usize| StrandLayer {
        index: 2 * k,
        z: 0.5 * (k as f64 + 1.0),
        height: 0.5,
        width: WIDTH,
        moves: (k > 0).then_some(seam).into_iter().chain(turn.clone()).collect(),
        supports: vec![],
    };
    Strand::new(at(0), (0..layers).map(layer).collect()).unwrap()
}

fn place(first_layer: usize, last_layer: usize, at: DVec2, length: f64) -> CutPlace {
    CutPlace {
        cause: "root".into(),
        advice: "cut".into(),
        at_roots: false,
        first_layer,
        last_layer,
        at,
        length,
    }
}

fn guide(strand: &Strand, places: &[CutPlace]) -> String {
    cleaning_html(strand, places, &CleaningStyle::default())
}

/// What stands between two texts, each time.
fn all_between<'t>(text: &'t str, before: &str, after: &'t str) -> Vec<&'t str> {
    text.split(before).skip(1).map(|rest| rest.split_once(after).unwrap().0).collect()
}

/// The pictures of a page, each with the layers that it uses, as files of their own.
fn pictures(page: &str) -> Vec<String> {
    let defs = all_between(page, "<defs>", "</defs>")[0];
    all_between(page, "<svg ", "</svg>")
        .into_iter()
        .skip(1)
        .map(|picture| {
            let (head, body) = picture.split_once('>').unwrap();
            format!("<svg xmlns=\"http://www.w3.org/2000/svg\" {head}><defs>{defs}</defs>{body}</svg>")
        })
        .collect()
}

fn drawn(group: &Group) -> usize {
    let count = |node: &Node| match node {
        Node::Group(inner) => drawn(inner),
        Node::Path(_) => 1,
        _ => 0,
    };
    group.children().iter().map(count).sum()
}

/// The points of each cut, y up, without the white line below the dark one.
fn cuts(page: &str) -> Vec<Vec<DVec2>> {
    let point = |text: &str| {
        let (x, y) = text.split_once(' ').unwrap();
        DVec2::new(x.parse().unwrap(), -y.parse::<f64>().unwrap())
    };
    let paths = all_between(page, "<path class=\"cut\" d=\"M", "\"");
    paths.into_iter().step_by(2).map(|path| path.split('L').map(point).collect()).collect()
}

#[test]
fn places_are_told_from_the_top_down_and_the_longest_first() {
    let at = DVec2::new(RADIUS - 1.0, 0.0);
    let places = [place(0, 4, at, 3.0), place(6, 10, at, 2.0), place(8, 10, at, 5.0), place(2, 2, at, 9.0)];
    let page = guide(&rings(8), &places);
    let headings = all_between(&page, "<h2>Layer ", "</h2>");
    assert_eq!(headings, ["10, 3 mm up", "4, 1.5 mm up", "2, 1 mm up"]);
    let told: Vec<&str> = all_between(&page, "<p>layer", " mm at x");
    assert_eq!(told, ["s 10 down to 8, 5", "s 10 down to 6, 2", "s 4 down to 0, 3", " 2, 9"]);
    assert_eq!(all_between(&page, "<li id=\"place-", "\""), ["1", "2", "3", "4"]);
    assert!(page.contains("<p>4 places, 19 mm of strand"));
    assert!(page.contains("<tr><td>root<td>4<td>19<td>cut"));
}

#[test]
fn a_blade_goes_along_the_edge_of_the_wall_where_the_strand_touches() {
    for (at, edge) in [(RADIUS - 1.0, RADIUS - WIDTH / 2.0), (RADIUS + 1.0, RADIUS + WIDTH / 2.0)] {
        let places: Vec<CutPlace> =
            [0.0, 1.0, 2.5].map(|angle| place(0, 6, DVec2::from_angle(angle) * at, 20.0)).to_vec();
        let page = guide(&rings(5), &places);
        let cuts = cuts(&page);
        assert_eq!(cuts.len(), places.len());
        for cut in cuts {
            assert!(cut.iter().all(|p| (p.length() - edge).abs() < 0.01 * WIDTH), "{cut:?}");
            let length: f64 = cut.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            // Twenty millimetres of wall over seven layers; its edge is shorter inside and longer outside.
            assert!((length - 20.0 / 7.0 * edge / RADIUS).abs() < 0.05 * WIDTH, "{length}");
            let middle = cut[cut.len() / 2];
            assert!(places.iter().any(|place| place.at.distance(middle) < WIDTH), "{middle}");
        }
    }
}

#[test]
fn a_root_is_cut_where_strand_leaves_the_wall() {
    let root = CutPlace { at_roots: true, ..place(0, 0, DVec2::new(RADIUS - 1.5, 0.0), 2.0) };
    let cuts = cuts(&guide(&rings(2), &[root]));
    // The spoke's way in and its way back lie on one another.
    assert_eq!(cuts.len(), 2);
    for cut in cuts {
        assert!(
            cut.iter().all(|p| (p.length() - RADIUS + WIDTH / 2.0).abs() < 0.01 * WIDTH && p.y.abs() < WIDTH)
        );
    }
}

#[test]
fn every_picture_is_one_and_shows_its_layer() {
    let places = [place(0, 4, DVec2::new(RADIUS, 1.0), 3.0), place(6, 6, DVec2::new(-RADIUS, 1.0), 2.0)];
    let page = guide(&rings(5), &places);
    let pictures = pictures(&page);
    assert_eq!(pictures.len(), 4, "two layers, two places");
    for picture in pictures {
        let tree = Tree::from_str(&picture, &Options::default()).unwrap();
        // Wall and support of the layer, and a ring or the two lines of a cut.
        assert!(drawn(tree.root()) >= 3, "{picture}");
    }
    let shown = all_between(&page, "<g id=\"layer-", "\"");
    assert_eq!(shown, ["2", "4", "6"], "the middle and the top of one place, the layer of the other");
}

#[test]
fn without_contact_there_is_nothing_to_do() {
    let page = guide(&rings(2), &[]);
    assert!(page.contains("nothing has to be cut") && !page.contains("<li"));
    let none = Strand::new(DVec2::ZERO, vec![]).map(|strand| guide(&strand, &[place(0, 1, DVec2::ONE, 1.0)]));
    assert!(none.is_err() || none.unwrap().ends_with("</html>\n"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_places_are_all_there_and_no_text_breaks_out(
        places in prop::collection::vec((0..30usize, 0..30usize, prop::num::f64::ANY, -99.0..99.0f64, prop::num::f64::ANY), 0..20),
        cause in ".{0,12}", advice in ".{0,12}", title in ".{0,12}",
    ) {
        let places: Vec<CutPlace> = places
            .into_iter()
            .map(|(first, last, x, y, length)| CutPlace {
                cause: format!("{cause}</li><script>"),
                advice: format!("{advice}\"></p>"),
                ..place(first, last, DVec2::new(x, y), length)
            })
            .collect();
        let style = CleaningStyle { title: format!("{title}</title><b>"), ..CleaningStyle::default() };
        let page = cleaning_html(&rings(8), &places, &style);
        prop_assert_eq!(page.matches("<li ").count(), places.len());
        prop_assert_eq!((page.matches("</li>").count(), page.matches("<title>").count()), (places.len(), 1));
        prop_assert!(!page.contains("<script") && !page.contains("NaN") && !page.contains("inf"));
        for picture in pictures(&page) {
            prop_assert!(Tree::from_str(&picture, &Options::default()).is_ok());
        }
    }
}
