//! What healing leaves of the grooves of scan lines.

use crate::failure::{Failure, Typed};
use stickslip_tip::Wider;

/// What is left of a groove after another line as long as `--length` says, dragged at r.
pub(super) fn left(length: Option<f64>, law: &Wider, r: f64) -> Result<f64, Failure> {
    match (length, law.healing_time) {
        (None, None) => Ok(1.0),
        (Some(length), Some(_)) if length.is_finite() && length > 0.0 => {
            Ok(law.left_after(length / r))
        }
        (Some(length), Some(_)) => Err(Failure::input(
            format!("--length {}", Typed(length)),
            "must be a finite number above 0",
        )),
        (None, Some(_)) => Err(Failure::input(
            "--length",
            "give the length of the lines, --length X: a surface heals while the support goes along them",
        )),
        (Some(_), None) => Err(Failure::input(
            "--length",
            "counts for nothing where the surface does not heal: leave it out, or give --healing-time T",
        )),
    }
}
