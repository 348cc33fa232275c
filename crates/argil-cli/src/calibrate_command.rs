//! `argil calibrate`.

use std::process::ExitCode;

use argil::gcode::{Extrusion, GcodeError, Poses, write_gcode};
use argil_calibrate::{CalibrateError, Calibration, legend_svg};

use crate::args::CalibrateArgs;
use crate::failure::Failure;
use crate::machine::{self, Job};
use crate::output::tell;
use crate::profiles::Profiles;
use crate::{input, output};

/// Writes the test prints and their legend.
pub(crate) fn run(args: &CalibrateArgs) -> Result<ExitCode, Failure> {
    let bead = args.bead();
    let profiles = Profiles::of(&bead)?;
    let settings = input::settings(&bead, &profiles)?;
    let job = |model| Job { model, bead: &bead, machine: &args.machine };
    let written = machine::gcode_settings(&job("test print"), &settings, &profiles)?;
    let middle = profiles.printer.as_ref().and_then(|printer| printer.middle());
    let calibration = Calibration {
        width: settings.width,
        layer_height: settings.layer_height,
        centre: middle.unwrap_or_default().into(),
        bead: written.bead,
        mm3_per_e: (written.extrusion == Extrusion::Units).then_some(written.mm3_per_e),
    };
    let prints =
        [("fan", calibration.fan()), ("windows", calibration.windows()), ("ring", calibration.ring())];
    let legend = legend_svg(&calibration).map_err(unprinted)?;
    output::folder(&args.folder)?;
    for (name, print) in prints {
        let print = print.map_err(unprinted)?;
        let mut written = written.clone();
        machine::complete(&mut written, &job(name), &print)?;
        let (file, text) = if machine::is_robot(&profiles) {
            (format!("{name}.csv"), Poses::new(&print, &written).map_err(unwritten)?.to_string())
        } else {
            (format!("{name}.gcode"), write_gcode(&print, &written).map_err(unwritten)?)
        };
        output::write(&args.folder.join(&file), text.as_bytes())?;
        let minutes = (print.length() / written.speed(&print, 1) / 60.0).ceil();
        let unit = if minutes > 1.0 { "minutes" } else { "minute" };
        tell(format_args!(
            "{file}: {:.1} cm³ of paste, about {minutes:.0} {unit}",
            print.volume_as(written.bead) / 1e3
        ));
        machine::misfit(&profiles, &job(name), &print).iter().for_each(tell);
    }
    output::write(&args.folder.join("legend.svg"), legend.as_bytes())?;
    machine::unknown_flow(&profiles, &job("test print")).iter().for_each(tell);
    tell("legend.svg: how to read them, to be printed on A4");
    Ok(ExitCode::SUCCESS)
}

fn unprinted(source: CalibrateError) -> Failure {
    Failure::Output { what: "test print", source: Box::new(source) }
}

fn unwritten(source: GcodeError) -> Failure {
    Failure::Output { what: "g-code", source: Box::new(source) }
}
