//! The page that tells how to read the test prints.

use argil_strand::DVec2;

use crate::sheet::Sheet;
use crate::windows::{HALF_DEPTH, edges, is_in_front};
use crate::{CalibrateError, Calibration, GAPS, LEANS, fan};

/// Left edge of the text, mm on the sheet.
const LEFT: f64 = 14.0;

/// Left edges of the tables' columns, mm on the sheet.
const COLUMNS: [f64; 3] = [103.0, 114.5, 128.0];

/// Widths in shares of the one asked for, for which the legend gives the flow.
const MEASURED: [f64; 9] = [0.7, 0.8, 0.9, 0.95, 1.0, 1.05, 1.1, 1.2, 1.4];

/// A page of A4 with the three prints from above, how each is read, and the line that each reading gives for a material's
/// or printer's file.
///
/// # Errors
/// A bead or place that cannot be printed.
///
/// # Complexity
/// Constant.
pub fn legend_svg(calibration: &Calibration) -> Result<String, CalibrateError> {
    let Calibration { width, layer_height, .. } = *calibration;
    let mut sheet = Sheet::new("What a paste bears: legend of the test prints");
    sheet.text(LEFT, 18.0, 6.0, "What this paste bears");
    let bead = format!("bead {} × {} mm", short(width), short(layer_height));
    sheet.text(
        LEFT,
        25.0,
        3.4,
        &format!("{bead}     paste ____________________     water ______ %     date ____________"),
    );
    of_fan(calibration, &mut sheet)?;
    of_windows(calibration, &mut sheet)?;
    of_ring(calibration, &mut sheet)?;
    sheet.rule(281.0);
    sheet.text(LEFT, 286.0, 2.9, "Both files need to know where their values come from:");
    sheet.code(LEFT, 291.0, &format!("[sources]  own = \"test prints, {bead}, DATE\""));
    Ok(sheet.finished())
}

fn of_fan(calibration: &Calibration, sheet: &mut Sheet) -> Result<(), CalibrateError> {
    let print = calibration.fan()?;
    sheet.rule(30.0);
    sheet.text(LEFT, 37.0, 4.4, "1  fan: how far a bead may lie beside the one below (--across)");
    let place = sheet.outline(&print, DVec2::new(LEFT, 42.0), DVec2::new(66.0, 60.0));
    for sector in 0..LEANS.len() {
        let middle = fan::middle(calibration.width, sector);
        let inside = middle.normalize_or_zero() * (fan::foot_radius() - 3.0) * calibration.width;
        sheet.label(place(calibration.centre + inside), &sector.to_string());
    }
    let lines = [
        "Begin at the long fin and count counter-clockwise, seen from above; sector 0 stands upright. The last sector",
        "whose outside is clean gives the value: no bead of it hangs down or lies apart.",
    ];
    paragraph(sheet, 109.0, &lines.map(str::to_owned));
    row(sheet, 45.0, ["sector", "--across", "line of the material's file"].map(str::to_owned));
    for (sector, &lean) in LEANS.iter().enumerate().skip(1) {
        let degrees = short(calibration.overhang(lean).round());
        let line = format!("overhang = {{ value = {degrees}, source = \"own\" }}");
        row(sheet, 45.0 + 5.5 * sector as f64, [sector.to_string(), short(lean), line]);
    }
    Ok(())
}

fn of_windows(calibration: &Calibration, sheet: &mut Sheet) -> Result<(), CalibrateError> {
    let print = calibration.windows()?;
    sheet.rule(119.0);
    sheet.text(LEFT, 126.0, 4.4, "2  windows: how long a bridge may be (--along)");
    let place = sheet.outline(&print, DVec2::new(LEFT, 137.0), DVec2::new(84.0, 28.0));
    for front in [true, false] {
        let numbers = (0..GAPS.len()).filter(|&window| is_in_front(window) == front);
        for (window, [left, right]) in numbers.zip(edges(front)) {
            let beside = if front { -HALF_DEPTH - 2.6 } else { HALF_DEPTH + 2.6 };
            let at = DVec2::new((left + right) / 2.0, beside) * calibration.width;
            sheet.label(place(calibration.centre + at), &(window + 1).to_string());
        }
    }
    let lines = [
        "Look through the windows from the side. The widest one",
        "with a straight lintel gives the value: its lowest bead sags",
        "by less than a third of a layer. Where sector 6 of the fan or",
        "more is good, take 0.2 off for each sector above 5.",
    ];
    paragraph(sheet, 175.0, &lines.map(str::to_owned));
    row(sheet, 134.0, ["window", "clear mm", "line of the material's file"].map(str::to_owned));
    for (window, &gap) in GAPS.iter().enumerate() {
        let line = format!("bridge = {{ value = {}, source = \"own\" }}", short(gap));
        let cells = [(window + 1).to_string(), format!("{:.2}", gap * calibration.width), line];
        row(sheet, 139.0 + 5.0 * window as f64, cells);
    }
    Ok(())
}

fn of_ring(calibration: &Calibration, sheet: &mut Sheet) -> Result<(), CalibrateError> {
    let print = calibration.ring()?;
    let volume = print.volume_as(calibration.bead);
    sheet.rule(193.0);
    sheet.text(LEFT, 200.0, 4.4, "3  ring: bead width and flow");
    let _place = sheet.outline(&print, DVec2::new(LEFT, 206.0), DVec2::new(66.0, 24.0));
    let (weighed, of_row): (_, Box<dyn Fn(f64) -> String>) = match calibration.mm3_per_e {
        Some(known) => (
            format!("mm3_per_e = {} × 1000 × grams ÷ ({volume:.0} × g/cm³)", short(known)),
            Box::new(move |factor| {
                format!("mm3_per_e = {{ value = {:.4}, source = \"own\" }}", known * factor)
            }),
        ),
        None => (
            format!("rate = the rate set × 1000 × grams ÷ ({volume:.0} × g/cm³)"),
            Box::new(|_| "the rate set, times the factor".to_owned()),
        ),
    };
    let lines = [
        "Measure the wall at five places of the long sides, above the".to_owned(),
        "second layer. The table gives for the middle one of the five".to_owned(),
        "what the machine truly pushes out.".to_owned(),
        format!("Or weigh it while wet; {:.2} cm³ were asked for:", volume / 1e3),
        weighed,
        "Print it again with the new value: the width should now be".to_owned(),
        format!("the one asked for, {} mm.", short(calibration.width)),
    ];
    paragraph(sheet, 238.0, &lines);
    row(sheet, 208.0, ["wall mm", "factor", "line of the printer's file"].map(str::to_owned));
    for (number, share) in MEASURED.into_iter().enumerate() {
        let measured = share * calibration.width;
        let factor = calibration.flow(measured);
        let cells = [format!("{measured:.2}"), format!("{factor:.3}"), of_row(factor)];
        row(sheet, 213.0 + 5.0 * number as f64, cells);
    }
    sheet.text(
        COLUMNS[0],
        264.0,
        2.9,
        "A width that is liked as it comes out is kept in the material's file:",
    );
    sheet.code(COLUMNS[0], 269.0, "width = { value = WALL, source = \"own\" }");
    Ok(())
}

fn paragraph(sheet: &mut Sheet, top: f64, lines: &[String]) {
    lines.iter().enumerate().for_each(|(k, line)| sheet.text(LEFT, top + 4.2 * k as f64, 2.9, line));
}

fn row(sheet: &mut Sheet, y: f64, cells: [String; 3]) {
    COLUMNS.into_iter().zip(cells).for_each(|(x, cell)| sheet.code(x, y, &cell));
}

/// A number with up to four decimals and no more than it needs.
fn short(value: f64) -> String {
    ((value * 1e4).round() / 1e4).to_string()
}
