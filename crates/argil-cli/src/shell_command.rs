//! `argil completions` and `argil man`: what a shell and a manual reader need to know of the program.

use std::io;
use std::process::ExitCode;

use clap::CommandFactory;
use clap_complete::Shell;

use crate::args::Args;
use crate::failure::Failure;

/// Writes a completion script.
pub(crate) fn completions(shell: Shell) -> ExitCode {
    clap_complete::generate(shell, &mut Args::command(), "argil", &mut io::stdout());
    ExitCode::SUCCESS
}

/// Writes the manual page of the program, with that of every command after it.
pub(crate) fn manual() -> Result<ExitCode, Failure> {
    let failed = |source| Failure::Output { what: "manual page", source: Box::new(source) };
    let mut out = io::stdout().lock();
    let mut command = Args::command();
    command.build();
    clap_mangen::Man::new(command.clone()).render(&mut out).map_err(failed)?;
    for sub in command.get_subcommands().filter(|sub| sub.get_name() != "help") {
        let page = clap_mangen::Man::new(sub.clone());
        page.render_synopsis_section(&mut out).map_err(failed)?;
        page.render_description_section(&mut out).map_err(failed)?;
        page.render_options_section(&mut out).map_err(failed)?;
    }
    Ok(ExitCode::SUCCESS)
}
