//! The program that wrote a document, and the version of its format.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Version of all documents; it changes when a reader of the old version would misread the new one.
pub const FORMAT_VERSION: u32 = 1;

/// The program that wrote a document.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Software {
    /// "stickslip"
    pub name: String,
    /// Version of the program, as printed by `stickslip --version`.
    pub version: String,
}

impl Software {
    /// This program, in this version.
    pub fn this() -> Self {
        Self { name: "stickslip".into(), version: env!("CARGO_PKG_VERSION").into() }
    }
}
