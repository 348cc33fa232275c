//! `argil samples`.

use std::process::ExitCode;

use crate::failure::Failure;
use crate::output::print;

/// Lists the bundled models.
pub(crate) fn run() -> Result<ExitCode, Failure> {
    let list: String = argil_models::names().map(|name| format!("sample:{name}\n")).collect();
    print("list of samples", list.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}
