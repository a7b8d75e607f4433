//! Functions shared by the questions about neighbouring scan lines.

use crate::Refused;
use stickslip_stability::{Raster, StabilityError};
use stickslip_tip::{Footprint, TipFunction, Wider};

/// The f(x,y) of a tip, and V of f(x,y) = f(x) exp(-y²/(2V²)) for a tip that has f(x) alone: the width given, or the
/// common width of its Gaussians.
///
/// # Errors
/// A width is given for a tip that has its own f(x,y); no width is given and the Gaussians differ in width; the width
/// is not above 0.
pub fn footprint(
    width_y: Option<f64>,
    tip: &TipFunction,
) -> Result<(Footprint, Option<f64>), Refused> {
    let refused = |why: &str| match width_y {
        Some(width) => Refused::number("width_y", width, why),
        None => Refused::whole("width_y", why),
    };
    match (tip.footprint(), width_y.or_else(|| common_width(tip))) {
        (Some(_), _) if width_y.is_some() => {
            Err(refused("the tip file has its own f(x,y): leave the option out"))
        }
        (Some(own), _) => Ok((own.clone(), None)),
        (None, Some(width)) => match Footprint::separable(tip.clone(), width) {
            Ok(footprint) => Ok((footprint, Some(width))),
            Err(_) => Err(refused("must be a finite number above 0")),
        },
        (None, None) => Err(refused(
            "the tip has no single width of its own: give the width V in f(x,y) = f(x) exp(-y²/(2 V²))",
        )),
    }
}

/// The common width of the Gaussians of the tip; `None` if they differ.
fn common_width(tip: &TipFunction) -> Option<f64> {
    let TipFunction::Gaussians(sum) = tip else { return None };
    let width = sum.terms().first()?.width;
    // A table is made of narrow Gaussians whose width says nothing of the tip.
    let alike = sum.terms().len() <= 3;
    let same = |w: f64| (w - width).abs() <= 1e-12 * width;
    (alike && sum.terms().iter().all(|g| same(g.width))).then_some(width)
}

/// The fraction of a groove that remains after another line of this length, in σ, scanned at r. A length is needed on a
/// surface that heals, and only there.
pub(super) fn left(length: Option<f64>, law: &Wider, r: f64) -> Result<f64, Refused> {
    match (length, law.healing_time) {
        (None, None) => Ok(1.0),
        (Some(length), Some(_)) => {
            let length = Refused::positive("length", length)?;
            Ok(law.left_after(length / r))
        }
        (None, Some(_)) => Err(Refused::whole(
            "length",
            "give the length of the lines, {length}: the surface heals while the support moves along them",
        )),
        (Some(_), None) => Err(Refused::whole(
            "length",
            "has no effect where the surface does not heal: leave it out, or give {healing_time}",
        )),
    }
}

/// A raster of lines `at` this r and pitch, with a spring across the scan if there is one; a fraction `left` of each
/// groove remains after another line.
pub(super) fn raster(
    footprint: &Footprint,
    law: Wider,
    at: (f64, f64),
    (left, stiffness_across): (f64, Option<f64>),
) -> Result<Raster, StabilityError> {
    let raster = Raster::new(footprint, law, at, left)?;
    match stiffness_across {
        Some(stiffness) => raster.with_stiffness_across(stiffness),
        None => Ok(raster),
    }
}

/// The rejection of the parameter that leaves a raster without a threshold: r, the law, the path, the tip or else the
/// pitches.
pub(super) fn refused(error: &StabilityError, r: f64, pitches: impl Fn() -> Refused) -> Refused {
    match error {
        StabilityError::R(_) => Refused::number("r", r, error),
        StabilityError::StiffnessAcross(stiffness) => {
            Refused::number("stiffness_across", *stiffness, error)
        }
        StabilityError::NoSupport => Refused::whole("no_spring", error),
        StabilityError::Corner => Refused::whole("depth_limit", error),
        StabilityError::Wider(error) => (*error).into(),
        StabilityError::HealingZigzag => Refused::word("path", "zigzag", error),
        StabilityError::PapersLawOnly(_)
        | StabilityError::EvenOnly(_)
        | StabilityError::NoRipples => Refused::whole("tip", error),
        error => Refused { why: error.to_string(), ..pitches() },
    }
}
