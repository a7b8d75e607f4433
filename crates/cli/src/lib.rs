//! `stickslip`: the tip of an atomic force microscope on a soft surface, from the command line; and [the
//! same](hosted) in-process.
//!
//! Results go to standard output or to `-o FILE`, messages and progress to standard error. The exit status is 0 for
//! success, 1 for an error at run time, and 2 for invalid input. It is 3 for a verified run that is correct but
//! incomplete, and 130 (143) for an interrupt by SIGINT (SIGTERM).

// All that is said goes through `message`.
#![deny(clippy::print_stderr, clippy::print_stdout)]

mod arguments;
mod arithmetic;
mod commands;
mod failure;
mod files;
pub mod hosted;
mod interrupt;
mod message;
mod session;
mod sign_of_life;
#[cfg(test)]
mod tests;

use arguments::{Cli, FIRST_SCREEN};
use clap::CommandFactory;
use clap::error::ErrorKind as Misread;
use commands::quantities::translated;
use failure::Failure;
use message::{say, say_lines};
use session::Session;
use std::io::ErrorKind;
use std::process::ExitCode;

/// The definition of the command line, for generated documentation.
#[cfg(feature = "manual")]
pub fn arguments() -> clap::Command {
    <Cli as clap::CommandFactory>::command()
}

/// Runs the program, as called from a shell.
pub fn main() -> ExitCode {
    let words = std::env::args_os().collect();
    let line = match translated(&Session::default(), words, Cli::command) {
        Ok(line) => line,
        Err(failure) => return failed(&failure),
    };
    let cli = match Cli::read(&line.words) {
        Ok(cli) => cli,
        Err(mut error) => {
            drop_far_suggestion(&mut error);
            return answered(&error);
        }
    };
    let session = Session::of_terminal(cli.quiet).with_quantities(line.typed);
    if let Err(error) = interrupt::end_at_once() {
        say(format_args!("stickslip: cannot listen for signals: {error}"));
        return ExitCode::FAILURE;
    }
    if !cli.quiet {
        sign_of_life::begin();
    }
    let done = commands::carried_out(&session, &cli.command);
    sign_of_life::end();
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failed(&session.restored(failure)),
    }
}

fn failed(failure: &Failure) -> ExitCode {
    if !failure.is_silent() {
        say(format_args!("stickslip: {failure}"));
    }
    ExitCode::from(failure.status())
}

/// Removes a suggested option from the message unless it is at least as similar as a suggested field must be.
fn drop_far_suggestion(error: &mut clap::Error) {
    use clap::error::{ContextKind, ContextValue};
    let text = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => text.trim_start_matches('-'),
        _ => "",
    };
    let (typed, similar) = (text(ContextKind::InvalidArg), text(ContextKind::SuggestedArg));
    if strsim::jaro_winkler(typed, similar) < commands::fields::ALIKE {
        error.remove(ContextKind::SuggestedArg);
        // It is that of the suggestion.
        error.remove(ContextKind::Usage);
    }
}

/// Prints help or version to standard output, or the error of the command line.
fn answered(error: &clap::Error) -> ExitCode {
    if error.kind() == Misread::DisplayHelpOnMissingArgumentOrSubcommand {
        say_lines(FIRST_SCREEN);
        return ExitCode::from(2);
    }
    if error.use_stderr() {
        say_lines(&error.render().to_string());
        return ExitCode::from(2);
    }
    match error.print() {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => ExitCode::FAILURE,
        _ => ExitCode::SUCCESS,
    }
}
