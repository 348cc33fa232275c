//! The cleaning guide of a plan: it has every contact that the audit's ledger has.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

#[test]
fn the_guide_has_every_contact_of_the_ledger() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cleaning");
    drop(fs::remove_dir_all(&folder));
    fs::create_dir_all(&folder).unwrap();
    let plan = |more: &[&str]| {
        let fixed = ["plan", "sample:columns", "--width", "3", "-o", "out.gcode", "--cleaning", "out.html"];
        let mut command = Command::new(env!("CARGO_BIN_EXE_argil"));
        command.args(fixed).args(more).current_dir(&folder).output().unwrap().status.code()
    };
    assert_eq!(plan(&["--no-audit"]), Some(2), "there is no ledger without an audit");
    assert!(!folder.join("out.html").exists());
    assert_eq!(plan(&["--report", "out.json"]), Some(0));

    let report: Value = serde_json::from_slice(&fs::read(folder.join("out.json")).unwrap()).unwrap();
    let mut wanted: Vec<String> = report["audit"]["contacts"]
        .as_array()
        .unwrap()
        .iter()
        .map(|contact| {
            let [first, last] = ["first_layer", "last_layer"].map(|name| contact[name].as_u64().unwrap());
            let layers = if first == last {
                format!("layer {first}")
            } else {
                format!("layers {last} down to {first}")
            };
            format!("{layers}, {} mm", (contact["length"].as_f64().unwrap() * 10.0).round() / 10.0)
        })
        .collect();
    assert!(wanted.len() > 3, "a model without contact shows nothing");
    let page = fs::read_to_string(folder.join("out.html")).unwrap();
    let mut told: Vec<String> = page
        .split("</label>\n<p>")
        .skip(1)
        .map(|rest| rest.split_once(" at x").unwrap().0.to_owned())
        .collect();
    wanted.sort();
    told.sort();
    assert_eq!(told, wanted);
}
