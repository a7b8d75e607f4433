//! `stickslip schema`.

use crate::arguments::SchemaArguments;
use crate::failure::Failure;
use crate::files::output::Output;
use std::path::Path;

pub(crate) fn schema(arguments: &SchemaArguments) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(&arguments.name.schema())
        .map_err(|error| Failure::Run(error.to_string()))?;
    Output::open("--output", Path::new("-"))?.write_bytes(format!("{text}\n").as_bytes())
}
