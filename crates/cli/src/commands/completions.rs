//! `stickslip completions`.

use crate::arguments::{Cli, CompletionsArguments};
use crate::failure::Failure;
use crate::files::output::Output;
use clap::CommandFactory;
use clap_complete::generate;
use std::path::Path;

pub(crate) fn completions(arguments: &CompletionsArguments) -> Result<(), Failure> {
    let mut script = vec![];
    generate(arguments.shell, &mut Cli::command(), "stickslip", &mut script);
    Output::open("--output", Path::new("-"))?.write_bytes(&script)
}
