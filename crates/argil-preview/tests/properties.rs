//! Pictures are read by an SVG parser that is not ours, and looked at pixel by pixel.
#![allow(clippy::unwrap_used)]

use argil_preview::{Palette, SvgStyle, ViewStyle, layer_svg, overview_svg};
use argil_strand::{DVec2, Move, Role, Strand, StrandLayer, SupportSource};
use proptest::prelude::*;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Group, Node, Options, Paint, Path, Tree};

/// A square of walls, half of each side support, on two layers; 20 mm wide, centred.
fn square(layers: usize) -> Strand {
    let to = |x: f64, y: f64, role| Move { to: DVec2::new(x, y), role };
    let turn = [
        to(10.0, -10.0, Role::Wall),
        to(10.0, 10.0, Role::Support),
        to(-10.0, 10.0, Role::Connection),
        to(-10.0, -10.0, Role::Fill),
    ];
    let corner = DVec2::splat(-10.0);
    let layers = (0..layers)
        .map(|k| {
            let seam = (k > 0).then_some(Move { to: corner, role: Role::Seam });
            let supports =
                vec![SupportSource { at: DVec2::new(10.0, 4.0), needs: vec![DVec2::new(10.0, 5.0)] }];
            let moves = seam.into_iter().chain(turn).collect();
            StrandLayer { index: k, z: 0.5 * (k as f64 + 1.0), height: 0.5, width: 2.0, moves, supports }
        })
        .collect();
    Strand::new(corner, layers).unwrap()
}

fn parse(svg: &str) -> Tree {
    Tree::from_str(svg, &Options::default()).unwrap()
}

fn paths(group: &Group, found: &mut Vec<Path>) {
    for node in group.children() {
        match node {
            Node::Group(inner) => paths(inner, found),
            Node::Path(path) => found.push((**path).clone()),
            _ => {}
        }
    }
}

fn all_paths(svg: &str) -> Vec<Path> {
    let mut found = Vec::new();
    paths(parse(svg).root(), &mut found);
    found
}

/// The stroke's colour as the palette writes it.
fn stroke_colour(path: &Path) -> Option<String> {
    match path.stroke()?.paint() {
        Paint::Color(c) => Some(format!("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue)),
        _ => None,
    }
}

#[test]
fn beads_are_as_wide_as_they_are() {
    let style = SvgStyle { scale: 10.0, ..SvgStyle::default() };
    let edges: Vec<_> = all_paths(&layer_svg(&square(2), 0, &style))
        .into_iter()
        .filter_map(|path| {
            let width = path.stroke()?.width().get();
            Some(width * path.abs_transform().get_scale().0)
        })
        .collect();
    // Edge of the bead, and the ghost of the one above: 2 mm at 10 pixels to the millimetre.
    assert!(edges.iter().filter(|&&width| (width - 20.0).abs() < 1e-3).count() >= 5, "{edges:?}");
    assert!(edges.iter().all(|&width| width < 20.001));
}

#[test]
fn beads_of_a_width_of_their_own_are_drawn_with_it() {
    let strand = square(1).of_widths(vec![vec![2.0, 2.0, 2.0, 1.5]]).unwrap();
    let style = SvgStyle { scale: 10.0, ..SvgStyle::default() };
    let widths = |svg: &str| -> Vec<f64> {
        let width = |path: Path| Some(path.stroke()?.width().get() * path.abs_transform().get_scale().0);
        all_paths(svg).into_iter().filter_map(width).map(f64::from).collect()
    };
    let count =
        |svg: &str, wanted: f64| widths(svg).iter().filter(|width| (**width - wanted).abs() < 0.01).count();
    // One role of four is three quarters as wide.
    let svg = layer_svg(&strand, 0, &style);
    assert_eq!((count(&svg, 15.0), count(&svg, 20.0)), (1, 3));
    let view = ViewStyle { bed: false, ..ViewStyle::default() };
    let classes = |strand: &Strand| {
        let svg = overview_svg(strand, &view);
        svg.matches("stroke-width=").count()
    };
    assert_eq!(classes(&strand), classes(&square(1)) + 2, "rim and body of the one bead");
}

#[test]
fn every_role_has_its_colour() {
    let strand = square(2);
    let palette = Palette::default();
    let found: Vec<_> =
        all_paths(&layer_svg(&strand, 1, &SvgStyle::default())).iter().filter_map(stroke_colour).collect();
    for role in Role::ALL.into_iter().filter(|&role| role != Role::Skirt) {
        assert!(found.contains(&palette.of(role).to_string()), "{role}");
    }
    // Skirt lies on the lowest layer only, before its cycle.
    let (start, mut layers) = (strand.start(), strand.into_layers());
    layers[0].moves.insert(0, Move { to: start, role: Role::Skirt });
    let skirted = Strand::new(start - 5.0, layers).unwrap();
    let found: Vec<_> =
        all_paths(&layer_svg(&skirted, 0, &SvgStyle::default())).iter().filter_map(stroke_colour).collect();
    assert!(found.contains(&palette.of(Role::Skirt).to_string()));
}

/// The colour at a place of a layer's picture, given in mm.
#[cfg(feature = "png")]
fn seen(strand: &Strand, style: &SvgStyle, place: DVec2) -> [u8; 3] {
    let svg = layer_svg(strand, 0, style);
    let numbers: Vec<f64> = svg
        .split("viewBox=\"")
        .nth(1)
        .and_then(|rest| rest.split('"').next())
        .unwrap()
        .split(' ')
        .map(|number| number.parse().unwrap())
        .collect();
    let picture = Pixmap::decode_png(&argil_preview::png(&svg, 800).unwrap()).unwrap();
    let scale = 800.0 / numbers[2].max(numbers[3]);
    let at = (DVec2::new(place.x, -place.y) - DVec2::new(numbers[0], numbers[1])) * scale;
    let colour = picture.pixel(at.x as u32, at.y as u32).unwrap();
    [colour.red(), colour.green(), colour.blue()]
}

#[cfg(feature = "png")]
#[test]
fn pixels_lie_where_the_strand_lies() {
    let style = SvgStyle { ghost: false, seam: false, support_points: false, ..SvgStyle::default() };
    let (strand, palette) = (square(1), style.palette);
    let shade = |c: argil_preview::Colour| [c.red, c.green, c.blue];
    // Beside the light in the middle of the bead and inside of its edge.
    assert_eq!(seen(&strand, &style, DVec2::new(0.0, -10.65)), shade(palette.wall));
    assert_eq!(seen(&strand, &style, DVec2::new(10.65, 0.0)), shade(palette.support));
    assert_eq!(seen(&strand, &style, DVec2::new(0.0, 10.65)), shade(palette.connection));
    assert_eq!(seen(&strand, &style, DVec2::new(-10.65, 0.0)), shade(palette.fill));
    for empty in [DVec2::ZERO, DVec2::new(0.0, -11.2), DVec2::new(8.8, 0.0)] {
        assert_eq!(seen(&strand, &style, empty), [255, 255, 255]);
    }
}

#[cfg(feature = "png")]
#[test]
fn the_overview_shows_something_on_white() {
    let svg = overview_svg(&square(20), &ViewStyle { bed: false, ..ViewStyle::default() });
    let picture = Pixmap::decode_png(&argil_preview::png(&svg, 300).unwrap()).unwrap();
    assert_eq!(picture.width().max(picture.height()), 300);
    let painted =
        picture.pixels().iter().filter(|p| p.red() != 255 || p.green() != 255 || p.blue() != 255).count();
    let share = painted as f64 / picture.pixels().len() as f64;
    assert!((0.1..0.8).contains(&share), "{share}");
    let corner = picture.pixel(0, 0).unwrap();
    assert_eq!((corner.red(), corner.green(), corner.blue()), (255, 255, 255));
}

#[cfg(feature = "png")]
#[test]
fn what_is_no_picture_is_an_error() {
    use argil_preview::{PreviewError, png};
    assert!(matches!(png("<svg", 100), Err(PreviewError::Svg(_))));
    assert!(matches!(png("", 100), Err(PreviewError::Svg(_))));
    let svg = layer_svg(&square(1), 0, &SvgStyle::default());
    assert!(matches!(png(&svg, 0), Err(PreviewError::Side { side: 0, .. })));
    assert!(matches!(png(&svg, u32::MAX), Err(PreviewError::Side { .. })));
    assert_eq!(png(&svg, 120).unwrap(), png(&svg, 120).unwrap());
}

#[test]
fn without_non_model_paths_their_colours_are_gone() {
    let strand = square(3);
    let plain = Palette { support: argil_preview::Colour::new(0, 255, 0), ..Palette::default() };
    let greenish = |non_model| {
        let svg = overview_svg(&strand, &ViewStyle { non_model, palette: plain, ..ViewStyle::default() });
        all_paths(&svg).iter().filter_map(stroke_colour).any(|c| {
            let share = |k: usize| u8::from_str_radix(&c[k..k + 2], 16).unwrap();
            share(3) > share(1).saturating_add(60)
        })
    };
    assert!(greenish(true) && !greenish(false));
}

#[test]
fn titles_cannot_become_markup() {
    let evil = "</title><rect id=\"x\"/>&\u{1}\u{ffff}";
    let style = SvgStyle { title: Some(evil.into()), ..SvgStyle::default() };
    let view = ViewStyle { title: Some(evil.into()), ..ViewStyle::default() };
    for svg in [layer_svg(&square(1), 0, &style), overview_svg(&square(1), &view)] {
        parse(&svg);
        assert!(!svg.contains("<rect id"));
    }
}

#[test]
fn positions_above_the_uppermost_layer_give_an_empty_frame() {
    let svg = layer_svg(&square(1), 7, &SvgStyle::default());
    assert!(svg.contains("no layer 7"));
    parse(&svg);
}

#[test]
fn a_long_strand_stays_a_small_file() {
    let turn = 2000;
    let point = |k: usize| DVec2::from_angle(k as f64 / turn as f64 * std::f64::consts::TAU) * 20.0;
    let moves: Vec<Move> = (1..=turn).map(|k| Move { to: point(k % turn), role: Role::Wall }).collect();
    let layers = (0..60)
        .map(|k| {
            let seam = (k > 0).then_some(Move { to: point(0), role: Role::Seam });
            let moves = seam.into_iter().chain(moves.clone()).collect();
            StrandLayer { index: k, z: k as f64 + 1.0, height: 1.0, width: 2.0, moves, supports: vec![] }
        })
        .collect();
    let strand = Strand::new(point(0), layers).unwrap();
    let fine = overview_svg(&strand, &ViewStyle::default()).len();
    let coarse = overview_svg(&strand, &ViewStyle { most_points: 10_000, ..ViewStyle::default() }).len();
    assert!(coarse < fine && fine < 400_000, "{coarse} {fine}");
}

/// The strand with all its places multiplied.
fn stretched(strand: &Strand, by: f64) -> Strand {
    let layers = strand.layers().iter().cloned().map(|mut layer| {
        layer.moves.iter_mut().for_each(|step| step.to *= by);
        layer
    });
    Strand::new(strand.start() * by, layers.collect()).unwrap()
}

/// Found with a scale of 1e-9 and with one that is infinite: the picture had no size, which is no SVG.
#[test]
fn any_style_gives_an_svg() {
    for stretch in [0.0, 1e-6, 1.0, 1e4, 1e9] {
        let strand = stretched(&square(2), stretch);
        for odd in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e-9, 1e9] {
            for which in 0..6 {
                let (mut style, mut view) = (SvgStyle::default(), ViewStyle::default());
                match which {
                    0 => style.scale = odd,
                    1 => style.margin = odd,
                    2 => view.azimuth = odd,
                    3 => view.elevation = odd,
                    4 => view.size = odd,
                    _ => view.most_points = 0,
                }
                for svg in [layer_svg(&strand, 1, &style), overview_svg(&strand, &view)] {
                    let size = parse(&svg).size();
                    assert!(size.width() > 0.0 && size.height() > 0.0, "{odd} as {which} at {stretch}");
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_is_drawn_outside_of_the_paper(
        corners in prop::collection::vec((-80.0..80.0f64, -80.0..80.0f64), 1..30),
        width in 0.2..30.0f64, azimuth in -400.0..400.0f64, elevation in 0.0..100.0f64,
    ) {
        let place = |k: usize| DVec2::from(corners[k % corners.len()]);
        let turn = (1..=corners.len()).map(|k| Move { to: place(k), role: Role::Wall });
        let layers = (0..3).map(|k| {
            let seam = (k > 0).then_some(Move { to: place(0), role: Role::Seam });
            let moves = seam.into_iter().chain(turn.clone()).collect();
            StrandLayer { index: k, z: (k as f64 + 1.0) * 0.4, height: 0.4, width, moves, supports: vec![] }
        });
        let strand = Strand::new(place(0), layers.collect()).unwrap();
        let svg = layer_svg(&strand, 1, &SvgStyle { seam: false, ..SvgStyle::default() });
        let size = parse(&svg).size();
        for path in all_paths(&svg) {
            let inked = path.abs_stroke_bounding_box();
            prop_assert!(inked.left() > -1.0 && inked.top() > -1.0);
            prop_assert!(inked.right() < size.width() + 1.0 && inked.bottom() < size.height() + 1.0);
        }

        // Boxes of turned strokes are not tight, so the overview is painted and its border looked at.
        let view = ViewStyle { azimuth, elevation, bed: false, size: 200.0, ..ViewStyle::default() };
        let tree = parse(&overview_svg(&strand, &view));
        let (across, down) = (tree.size().width() as u32, tree.size().height() as u32);
        let mut picture = Pixmap::new(across.max(1), down.max(1)).unwrap();
        resvg::render(&tree, Transform::identity(), &mut picture.as_mut());
        let white = |x, y| picture.pixel(x, y).is_none_or(|p| p.red() == 255 && p.green() == 255 && p.blue() == 255);
        prop_assert!((0..across).all(|x| white(x, 0) && white(x, down - 1)));
        prop_assert!((0..down).all(|y| white(0, y) && white(across - 1, y)));
    }
}
