//! `stickslip`: the tip of an atomic force microscope on a soft surface, from the command line.
//!
//! Results go to standard output or to `-o FILE`, messages and progress to standard error. The exit
//! status is 0, 1 for what failed at run time, 2 for unusable input, 3 for a run to be verified that is
//! right as far as it goes but has no end, 130 (143) when interrupted by SIGINT (SIGTERM).

mod arguments;
mod commands;
mod failure;
mod files;
#[cfg(test)]
mod fuzz;
mod interrupt;

use arguments::{Cli, Command};
use clap::Parser;
use failure::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let done = match &cli.command {
        Command::Run(arguments) => commands::run::run(arguments),
        Command::Verify(arguments) => commands::verify::verify(arguments),
        Command::Surface(arguments) => commands::surface::surface(arguments),
        Command::Stability(arguments) => commands::stability::stability(arguments),
        Command::Boundary(arguments) => commands::boundary::boundary(arguments),
        Command::Compare(arguments) => commands::compare::compare(arguments),
        Command::Response(arguments) => commands::response::response(arguments),
        Command::Cycle(arguments) => commands::cycle::cycle(arguments),
        Command::Continue(arguments) => commands::continuation::follow(arguments),
        Command::Sweep(arguments) => commands::sweep::sweep(arguments),
        Command::Units(arguments) => commands::units::units(arguments),
        Command::Plot(arguments) => commands::plot::plot(arguments),
        Command::Figures(arguments) => commands::figures::figures(arguments),
        Command::Schema(arguments) => commands::schema::schema(arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            if !failure.is_silent() {
                eprintln!("stickslip: {failure}");
            }
            failure.exit_code()
        }
    }
}

impl Failure {
    fn exit_code(&self) -> ExitCode {
        ExitCode::from(self.status())
    }
}
