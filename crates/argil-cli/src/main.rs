//! The program `argil`: plans clay prints in one unbroken strand, and audits any g-code file.
//!
//! Exit status: 0 done · 2 wrong usage · 3 bad input · 4 a plan or file with findings.
#![forbid(unsafe_code)]
// A program prints; the libraries do not.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod args;
mod audit_command;
mod failure;
mod input;
mod output;
mod plan_command;
mod preview_page;
mod progress;
mod report;
mod samples_command;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};

fn main() -> ExitCode {
    let outcome = match Args::parse().command {
        Command::Plan(args) => plan_command::run(&args),
        Command::Audit(args) => audit_command::run(&args),
        Command::Samples => Ok(samples_command::run()),
    };
    outcome.unwrap_or_else(|failure| {
        eprintln!("argil: {failure}");
        failure.exit_code()
    })
}
