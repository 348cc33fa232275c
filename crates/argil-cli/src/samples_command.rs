//! `argil samples`.

use std::process::ExitCode;

/// Lists the bundled models.
pub(crate) fn run() -> ExitCode {
    for name in argil_models::names() {
        println!("sample:{name}");
    }
    ExitCode::SUCCESS
}
