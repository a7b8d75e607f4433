//! From text to a document.

use crate::FORMAT_VERSION;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::fmt::Display;
use thiserror::Error;

/// What is wrong with a document, or with a part of it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct Unusable(String);

impl Unusable {
    /// `reason` as the message.
    pub fn new(reason: impl Display) -> Self {
        Self(reason.to_string())
    }
}

/// What every document begins with.
#[derive(Debug, Clone, Deserialize)]
pub struct Kind {
    /// Such as "stickslip/run".
    pub format: Option<String>,
    /// Version of that format.
    pub format_version: Option<u32>,
}

impl Kind {
    /// Refuses all but the format wanted, in the version that this program reads.
    ///
    /// # Errors
    /// Names what was found instead.
    pub fn judge(&self, wanted: &str) -> Result<(), Unusable> {
        match (self.format.as_deref(), self.format_version) {
            (Some(format), Some(FORMAT_VERSION)) if format == wanted => Ok(()),
            (Some(format), version) if format == wanted => {
                let found = version.map_or("none".into(), |v| v.to_string());
                Err(Unusable(format!(
                    "format_version is {found}, this program reads {FORMAT_VERSION}: run it again with this version"
                )))
            }
            (format, _) => {
                let found = format.unwrap_or("missing");
                Err(Unusable(format!("format is {found}, \"{wanted}\" is needed")))
            }
        }
    }
}

/// The document of the format wanted, such as [`RunDocument::FORMAT`](crate::RunDocument::FORMAT), that a text holds.
///
/// # Errors
/// The text is no JSON, a document of another format or version, or damaged.
pub fn read<D: DeserializeOwned>(text: &str, wanted: &str) -> Result<D, Unusable> {
    let kind: Kind = serde_json::from_str(text).map_err(|error| {
        let command = wanted.replace('/', " ");
        Unusable(format!(
            "not a whole JSON document ({error}); write it again with `{command} -o FILE.json`"
        ))
    })?;
    kind.judge(wanted)?;
    serde_json::from_str(text).map_err(|error| Unusable(format!("damaged: {error}")))
}
