//! Errors of the reproduction.

use thiserror::Error;

/// Something that could not be computed.
#[derive(Debug, Error)]
#[error("{0}")]
pub struct Failed(String);

impl Failed {
    pub(crate) fn new(what: String) -> Self {
        Self(what)
    }
}
