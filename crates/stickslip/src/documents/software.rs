//! Who wrote a document, and in which version of its format.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Version of all documents; it changes when a reader of the old ones would misread the new.
pub const FORMAT_VERSION: u32 = 1;

/// The program that wrote a document.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Software {
    /// "stickslip"
    pub name: String,
    /// Of the program, as `stickslip --version` says.
    pub version: String,
}

impl Software {
    /// This program, in this version.
    pub fn this() -> Self {
        Self { name: "stickslip".into(), version: env!("CARGO_PKG_VERSION").into() }
    }
}
