//! `argil completions` and `argil man`: what a shell and a manual reader need to know of the program.

use std::io::{self, Write};
use std::process::ExitCode;

use clap::CommandFactory;
use clap_complete::Shell;

use crate::args::Args;
use crate::failure::Failure;
use crate::output::print;

/// Writes a completion script.
pub(crate) fn completions(shell: Shell) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Args::command(), "argil", &mut script);
    print("completion script", &script)?;
    Ok(ExitCode::SUCCESS)
}

/// Writes the manual page of the program, with that of every command after it.
pub(crate) fn manual() -> Result<ExitCode, Failure> {
    let what = "manual page";
    let mut page = Vec::new();
    rendered(&mut page).map_err(|source| Failure::Output { what, source: Box::new(source) })?;
    print(what, &page)?;
    Ok(ExitCode::SUCCESS)
}

fn rendered(out: &mut impl Write) -> io::Result<()> {
    let mut command = Args::command();
    command.build();
    clap_mangen::Man::new(command.clone()).render(out)?;
    for sub in command.get_subcommands().filter(|sub| sub.get_name() != "help") {
        let page = clap_mangen::Man::new(sub.clone());
        page.render_synopsis_section(out)?;
        page.render_description_section(out)?;
        page.render_options_section(out)?;
    }
    Ok(())
}
