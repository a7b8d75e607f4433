//! `stickslip schema`.

use crate::arguments::SchemaArguments;
use crate::failure::Failure;
use crate::files::output::Output;
use std::path::Path;
use stickslip as documents;

pub(crate) fn schema(arguments: &SchemaArguments) -> Result<(), Failure> {
    let missing = || Failure::input(&arguments.name, "there is no such document");
    let schema = documents::schema(&arguments.name).ok_or_else(missing)?;
    let text =
        serde_json::to_string_pretty(&schema).map_err(|error| Failure::Run(error.to_string()))?;
    Output::open("--output", Path::new("-"))?.write_bytes(format!("{text}\n").as_bytes())
}
