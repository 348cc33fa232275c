//! The program `argil`: plans clay prints in one unbroken strand, and audits any g-code file.
//!
//! Exit status: 0 done · 2 wrong usage · 3 bad input · 4 a plan or file with findings.
#![forbid(unsafe_code)]

mod args;
mod audit_command;
mod calibrate_command;
mod cleaning_page;
mod closed_slices;
mod config;
mod failure;
mod input;
mod layer_file;
mod limits;
mod list_command;
mod machine;
mod machine_args;
mod missing;
mod output;
mod plan_command;
mod preview_page;
mod profiles;
mod progress;
mod report;
mod samples_command;
mod shell_command;
mod shrinkage;
mod stated;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{ArgMatches, Command as Program, CommandFactory, FromArgMatches};

use args::{Args, Command};
use failure::Failure;

fn main() -> ExitCode {
    run(std::env::args_os().collect()).unwrap_or_else(|failure| {
        output::tell(format_args!("argil: {failure}"));
        failure.exit_code()
    })
}

fn run(typed: Vec<OsString>) -> Result<ExitCode, Failure> {
    // An option may stand in a file and be typed as well: the later one counts.
    let mut program =
        Args::command().args_override_self(true).mut_subcommands(|command| command.args_override_self(true));
    let words = config::with_file(&program, typed)?;
    if let Some(file) = printed_config(&program, &words) {
        output::print("file of options", file.as_bytes())?;
        return Ok(ExitCode::SUCCESS);
    }
    let matches = program.try_get_matches_from_mut(words).unwrap_or_else(|error| error.exit());
    let args = Args::from_arg_matches(&matches).unwrap_or_else(|error| error.format(&mut program).exit());
    match args.command {
        Command::Plan(args) => plan_command::run(&args),
        Command::Audit(args) => audit_command::run(&args),
        Command::Calibrate(args) => calibrate_command::run(&args),
        Command::Samples => samples_command::run(),
        Command::Printers { name } => list_command::list_printers(name.as_deref()),
        Command::Materials { name } => list_command::list_materials(name.as_deref()),
        Command::Completions { shell } => shell_command::completions(shell),
        Command::Man => shell_command::manual(),
    }
}

/// The options as a file, where that is asked for: neither model nor output need then be given.
fn printed_config(program: &Program, words: &[OsString]) -> Option<String> {
    const ASKED: &str = "print_config";
    let lenient = |command: Program| {
        let has = command.get_arguments().any(|arg| arg.get_id() == ASKED);
        if has { command.mut_args(|arg| arg.required(false)) } else { command }
    };
    let matches = program.clone().mut_subcommands(lenient).try_get_matches_from(words);
    let (name, of_command): (&str, &ArgMatches) = match &matches {
        Ok(matches) => matches.subcommand()?,
        // Whatever is wrong is told by the reading that follows.
        Err(_) => return None,
    };
    let asked = of_command.try_get_one::<bool>(ASKED).ok().flatten().copied().unwrap_or(false);
    let command = program.find_subcommand(name).filter(|_| asked)?;
    Some(config::as_file(command, of_command))
}
