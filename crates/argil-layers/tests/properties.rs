//! What must hold of layers that are read, whatever a program wrote them like.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use argil_layers::{Layers, LayersError, SvgSettings, json, svg};
use argil_mesh::Unit;
use glam::DVec2;
use proptest::prelude::*;

fn read(drawing: &str) -> Result<Layers, LayersError> {
    svg(drawing.as_bytes(), &SvgSettings::default())
}

/// A drawing of 100 by 80 units of a tenth of a millimetre.
fn drawing(body: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"10mm\" height=\"8mm\" viewBox=\"0 0 100 80\">{body}</svg>"
    )
}

fn area(contour: &[DVec2]) -> f64 {
    let next = contour.iter().cycle().skip(1);
    0.5 * contour.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>()
}

fn contour() -> impl Strategy<Value = Vec<(i32, i32)>> {
    prop::collection::vec((-4000..4000_i32, -4000..4000_i32), 3..12).prop_filter("ends apart", |points| {
        let (a, b): ((i32, i32), (i32, i32)) = (points[0], points[points.len() - 1]);
        (a.0 - b.0).abs() + (a.1 - b.1).abs() > 100
    })
}

proptest! {
    #[test]
    fn a_contour_is_the_same_in_every_notation(points in contour(), shift in (-90..90_i32, -90..90_i32)) {
        let at = |k: usize| (f64::from(points[k].0) / 16.0, f64::from(points[k].1) / 16.0);
        let list: String = (0..points.len()).map(|k| format!("{},{} ", at(k).0, at(k).1)).collect();
        let absolute: String =
            (0..points.len()).map(|k| format!("{}{} {}", if k == 0 { 'M' } else { 'L' }, at(k).0, at(k).1)).collect();
        let relative: String = (1..points.len())
            .map(|k| format!(" {} {}", at(k).0 - at(k - 1).0, at(k).1 - at(k - 1).1))
            .collect();
        let (dx, dy) = shift;
        let first = at(0);
        let shapes = [
            format!("<polygon points=\"{list}\"/>"),
            format!("<polyline points=\"{list} {},{}\"/>", first.0, first.1),
            format!("<path d=\"{absolute}Z\"/>"),
            format!("<path d=\"m{} {} l{relative}z\"/>", first.0, first.1),
            format!("<g transform=\"translate({dx},{dy})\"><path transform=\"translate({} {})\" d=\"{absolute}z\"/></g>", -dx, -dy),
            format!("<g transform=\"scale(4)\"><g><path transform=\"scale(.25)\" d=\"{absolute} {} {}\"/></g></g>", first.0, first.1),
        ];
        let wanted: Vec<DVec2> = (0..points.len()).map(|k| DVec2::new(at(k).0 / 10.0, 8.0 - at(k).1 / 10.0)).collect();
        for shape in shapes {
            let layers = read(&drawing(&format!("<g><rect width=\"1\" height=\"1\"/></g><g>{shape}</g>"))).unwrap();
            let found = &layers.layers[1][0];
            prop_assert_eq!(found.len(), wanted.len(), "{}", shape);
            prop_assert!(found.iter().zip(&wanted).all(|(a, b)| a.distance(*b) < 1e-9), "{} {:?}", shape, found);
        }
    }

    #[test]
    fn curves_are_followed_by_their_chords(r in 1.0..400.0_f64, error in 1e-4..0.05_f64) {
        let settings = SvgSettings { chord_error: error, ..SvgSettings::default() };
        // Four cubics, two arcs, a circle and an ellipse, all the same circle about the origin.
        let k = 0.552_284_75 * r;
        let shapes = [
            format!("<path d=\"M{r} 0C{r} {k} {k} {r} 0 {r}S{} {k} {} 0S{} {} 0 {}S{r} {} {r} 0Z\"/>", -r, -r, -k, -r, -r, -k),
            format!("<path d=\"M{r} 0A{r} {r} 0 0 1 {} 0A{r} {r} 0 0 1 {r} 0\"/>", -r),
            format!("<circle r=\"{r}\"/>"),
            format!("<ellipse rx=\"{r}\" ry=\"{}\" transform=\"scale(1 2)\"/>", 0.5 * r),
        ];
        for shape in shapes {
            let drawing = format!("<svg xmlns=\"http://www.w3.org/2000/svg\"><g>{shape}</g></svg>");
            let layers = svg(drawing.as_bytes(), &settings).unwrap();
            let found = &layers.layers[0][0];
            // Four cubics lie beside a circle by 2.8e-4 of its radius.
            let allowed = error + 3e-4 * r;
            for (a, b) in found.iter().zip(found.iter().cycle().skip(1)) {
                prop_assert!((a.length() - r).abs() < allowed && (a.midpoint(*b).length() - r).abs() < allowed, "{} {} {}", shape, a, b);
            }
            prop_assert!(found.len() >= 3);
        }
    }

    #[test]
    fn no_bytes_panic(bytes in prop::collection::vec(any::<u8>(), 0..200), text in "[<>/a-z\"= 0-9.MLAz-]{0,80}") {
        drop(svg(&bytes, &SvgSettings::default()));
        drop(json(&bytes, None));
        drop(read(&drawing(&format!("<g><path d=\"{}\"/></g>", text.replace(['<', '"'], " ")))));
        drop(read(&text));
    }
}

#[test]
fn slic3r_says_height_and_kind() {
    let file = |body: &str| {
        format!(
            "\u{feff}<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n\
             <!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.0//EN\" \"http://www.w3.org/TR/2001/REC-SVG-20010904/DTD/svg10.dtd\">\n\
             <svg width=\"20.000000\" height=\"10.000000\" xmlns=\"http://www.w3.org/2000/svg\" \
             xmlns:slic3r=\"http://slic3r.org/namespaces/slic3r\" viewport-fill=\"black\">\n<!-- written by hand -->\n{body}</svg>\n"
        )
    };
    let group =
        |z: f64, height: &str, body: &str| format!("<g id=\"l\" slic3r:z=\"{z}\"{height}>\n{body}\n</g>\n");
    let square = "<path d=\"M 1 9 9 9 9 1 1 1 z M 3 3 3 5 5 5 5 3 z\" style=\"fill: white\"/>";
    let pillar = "<circle cx=\"15\" cy=\"5\" r=\"2\" slic3r:type=\"support\"/>";
    let height = " slic3r:layer-height=\"0.5000\"";
    let layers =
        read(&file(&[group(0.5, height, square), group(1.0, height, &format!("{square}{pillar}"))].concat()))
            .unwrap();
    assert_eq!((layers.layer_height, layers.has_unit), (Some(0.5), false));
    assert_eq!(layers.layers[1].iter().map(|contour| area(contour).abs()).collect::<Vec<_>>(), [64.0, 4.0]);
    assert_eq!(layers.layers[0][0][0].to_array(), [1.0, 1.0]);
    assert_eq!(layers.remarks, ["1 elements of another program's support are left out, the first on line 9"]);
    // Heights by z alone, with the rounding that the program has.
    let thirds = [0.1667, 0.5, 0.8333].map(|z| group(z, "", square)).concat();
    assert_eq!(read(&file(&thirds)).unwrap().layer_height, Some(0.3333));
    let uneven = [0.35, 0.75, 1.15, 1.65].map(|z| group(z, "", square)).concat();
    assert!(matches!(read(&file(&uneven)), Err(LayersError::Heights { layer: 1, .. })));
    let infill = group(0.5, height, "<path slic3r:type=\"infill\" d=\"M0 0\"/>");
    assert!(matches!(read(&file(&infill)), Err(LayersError::Unsupported { layer: 0, line: 6, .. })));
}

#[test]
fn pages_state_units() {
    let with = |page: &str, unit| {
        let drawing = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" {page}><g><rect x=\"10\" width=\"96\" height=\"96\"/></g></svg>"
        );
        let layers = svg(drawing.as_bytes(), &SvgSettings { unit, ..SvgSettings::default() })?;
        Ok((layers.extent(), layers.layers[0][0][0].to_array(), layers.has_unit))
    };
    let inch_in_pixels = 25.4 / 96.0;
    for (page, extent, corner, has_unit) in [
        ("", 96.0, [10.0, 0.0], false),
        ("width=\"200\" height=\"100px\"", 96.0, [10.0, 100.0], false),
        ("width=\"25mm\" viewBox=\"10 -4 200 100\"", 12.0, [0.0, 12.0], true),
        ("width=\"2in\" height=\"1in\"", 25.4, [10.0 * inch_in_pixels, 25.4], true),
        ("width=\"100%\" viewBox=\"0 0 200 96\"", 96.0, [10.0, 96.0], false),
    ] {
        let found = with(page, None).unwrap();
        let [x, y] = [0, 1].map(|axis| (found.1[axis] - corner[axis]).abs());
        assert!((found.0 - extent).abs() + x + y < 1e-9 && found.2 == has_unit, "{page}: {found:?}");
    }
    assert_eq!(with("width=\"20mm\" viewBox=\"0 0 200 100\"", Some(Unit::Centimetre)).unwrap().0, 960.0);
    for page in [
        "width=\"20mm\" height=\"20mm\" viewBox=\"0 0 200 100\"",
        "viewBox=\"0 0 0 100\"",
        "viewBox=\"0 0\"",
        "width=\"wide\"",
    ] {
        assert!(matches!(with(page, None), Err(LayersError::Attribute { line: 1, .. })), "{page}");
    }
}

#[test]
fn a_single_group_round_all_layers_is_none() {
    let layer = "<g><rect width=\"9\" height=\"9\"/></g>";
    let wrapped = read(&drawing(&format!(
        "<defs><rect/></defs><title>t</title><g transform=\"scale(2)\">{layer}{layer}</g>"
    )))
    .unwrap();
    assert_eq!(wrapped.layers.len(), 2);
    assert_eq!(wrapped.extent(), 1.8);
    // Islands of a layer may be grouped, and what is not displayed is left out.
    let hidden =
        read(&drawing(&format!("<g>{layer}{layer}</g><g>{layer}<g style=\"display: none\">{layer}</g></g>")))
            .unwrap();
    assert_eq!(hidden.layers.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1]);
    assert!(hidden.remarks[0].contains("not displayed"));
}

#[test]
fn what_might_be_solid_and_is_not_read_is_told() {
    let layer = "<g><rect width=\"9\" height=\"9\"/></g>\n";
    for (body, says) in [
        ("<rect width=\"9\" height=\"9\"/>", "line 2: `rect` belongs to no layer"),
        ("<g><text>7</text></g>", "layer 1, line 2: `text` is not read"),
        ("<g><use href=\"#a\"/></g>", "`use` is not read"),
        ("<g><rect rx=\"2\" width=\"9\" height=\"9\"/></g>", "round corners"),
        ("<g><path clip-path=\"url(#a)\" d=\"M0 0L1 0L1 1Z\"/></g>", "clip paths"),
        ("<g><path d=\"M0 0L10 0L10 10\"/></g>", "layer 1, line 2: a contour is open by"),
        ("<g><polyline points=\"0 0 10 0 10 10\"/></g>", "a contour is open by"),
        ("<g><polygon points=\"0 0 10 0 10\"/></g>", "no y"),
        ("<g><polygon points=\"0 0 10 0 ten\"/></g>", "a list of numbers"),
        ("<g><path d=\"M0 0L10\"/></g>", "`d` of `path`"),
        ("<g><path transform=\"turn(3)\" d=\"M0 0\"/></g>", "`transform` of `path`"),
        ("<g><circle r=\"3mm\"/></g>", "a number without a unit"),
        ("<g><circle r=\"1e99\"/></g>", "beyond 1e6 mm"),
        ("<g><path d=\"M0 0A1e300 1 0 0 1 1 1Z\"/></g>", "beyond 1e6 mm"),
        ("<g><path d=\"M0 0L99999999 0L0 1Z\"/></g>", "layer 1, line 2: a coordinate"),
        ("<g><path transform=\"scale(1e300)\" d=\"M0 0L1e9 0L0 1Z\"/></g>", "a coordinate"),
    ] {
        let error = read(&drawing(&format!("{layer}{body}"))).unwrap_err().to_string();
        assert!(error.contains(says), "no `{says}` in {error}");
    }
    for (text, says) in [
        ("<html/>", "its root is `html`"),
        ("<svg xmlns=\"http://www.w3.org/2000/svg\"/>", "it has no group"),
        ("<svg", "no XML"),
        ("<!DOCTYPE a [<!ENTITY a \"&b;\"><!ENTITY b \"&a;\">]><svg>&a;</svg>", "no XML"),
    ] {
        let error = read(text).unwrap_err().to_string();
        assert!(error.contains(says), "no `{says}` in {error}");
    }
    assert_eq!(svg(b"<svg>\xff", &SvgSettings::default()), Err(LayersError::NotText { byte: 5 }));
}
