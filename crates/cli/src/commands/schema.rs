//! `stickslip schema`.

use crate::arguments::SchemaArguments;
use crate::failure::Failure;
use crate::files::output::Output;
use std::path::Path;

pub(crate) fn schema(arguments: &SchemaArguments) -> Result<(), Failure> {
    let missing = || Failure::input(&arguments.name, "there is no such document");
    let text = stickslip::schema(&arguments.name).ok_or_else(missing)?;
    Output::open("--output", Path::new("-"))?.write_bytes(text.as_bytes())
}
