//! Errors, with messages for the page.

use stickslip::Unusable;
use stickslip_raster::RasterError;
use stickslip_surface::SurfaceError;
use stickslip_tip::planar::PlanarError;
use stickslip_tip::{ModelError, RunError, TipFunctionError};
use thiserror::Error;

/// An error, by its origin.
#[derive(Debug, Error)]
pub(crate) enum Refusal {
    #[error("not a set of parameters: {0}")]
    Json(serde_json::Error),
    #[error("the page computes up to t = {most}, not {0}: use the program for longer runs", most = crate::limits::MOST_TIME)]
    TooLong(f64),
    #[error("the page scans up to {most} lines, not {0}: use the program for more", most = crate::limits::MOST_LINES)]
    TooManyLines(usize),
    #[error(transparent)]
    Unusable(#[from] Unusable),
    #[error(transparent)]
    Tip(#[from] TipFunctionError),
    #[error(transparent)]
    Model(#[from] ModelError),
    #[error(transparent)]
    Run(#[from] RunError),
    #[error(transparent)]
    Across(#[from] PlanarError),
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    #[error("{}", .0.described(|parameter| parameter.replace('_', " ")))]
    Question(#[from] stickslip::Failure),
    #[error(transparent)]
    Raster(#[from] RasterError),
}
