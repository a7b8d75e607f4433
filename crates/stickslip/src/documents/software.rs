//! The program that wrote a document, and the version of its format.

use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

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
    /// Commit of the sources that the program was built from; null where it is unknown (sources without Git, builds
    /// without optimisation).
    #[serde(default)]
    pub commit: Option<String>,
    /// Whether the sources were those of the commit, unchanged; null without a commit.
    #[serde(default)]
    pub clean: Option<bool>,
}

impl Software {
    /// Version and commit of this program, on a line each.
    pub const BUILD: &str = concat!(env!("CARGO_PKG_VERSION"), "\n", env!("STICKSLIP_SOURCES"));

    /// This program, in this version and of this commit.
    pub fn this() -> Self {
        let commit = Some(env!("STICKSLIP_COMMIT")).filter(|commit| !commit.is_empty());
        Self {
            name: "stickslip".into(),
            version: env!("CARGO_PKG_VERSION").into(),
            commit: commit.map(str::to_owned),
            clean: commit.map(|_| Some("clean") == option_env!("STICKSLIP_TREE")),
        }
    }
}

/// Name, version and commit, such as `stickslip 0.2.0 (commit 1234abcd…, clean)`.
impl fmt::Display for Software {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{} {}", self.name, self.version)?;
        let Some(commit) = &self.commit else { return Ok(()) };
        let tree = if self.clean == Some(true) { "clean" } else { "with changes" };
        write!(out, " (commit {commit}, {tree})")
    }
}
