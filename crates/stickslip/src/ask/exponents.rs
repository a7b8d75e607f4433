//! Lists of growth exponents: the largest number allowed, and warnings about the exponents found.

use crate::{Failure, Refused, Typed};
use stickslip_stability::{Certificate, Spectrum, StabilityError};
use stickslip_tip::{Model, TipFunction};

/// Largest relative error, in units of the smallest |λ|, that causes no warning.
const EXACT: f64 = 1e-10;
/// Largest number of exponents in a list; fewer lie to the right of [`leftmost`].
const MOST_ROOTS: usize = 1000;

/// Re λ, in k/Γ, below which roots are not listed. There the roots of a footprint fitted to a table are round-off.
/// Other roots there decay by e^{-60} or more over one tip width.
pub(crate) fn leftmost(model: &Model) -> f64 {
    /// Largest number of Gaussians of a tip that was not fitted to a table.
    const FEW: usize = 16;
    let TipFunction::Gaussians(sum) = model.tip() else { return -1e6 * model.r() };
    let reach = model.tip().reach().unwrap_or(1.0);
    let exponent = if sum.terms().len() > FEW { -24.0 } else { -540.0 };
    model.r() * exponent / reach
}

/// Rejects a number of roots outside 1 to 1000.
pub(crate) fn judge_count(parameter: &'static str, count: usize) -> Result<(), Refused> {
    if (1..=MOST_ROOTS).contains(&count) {
        return Ok(());
    }
    Err(Refused::number(parameter, count as f64, format!("must be 1 to {MOST_ROOTS}")))
}

/// The failure for a list that could not be computed, with advice; for extreme α and r, a rejection of both.
pub(crate) fn failed(error: &StabilityError, advice: &str) -> Failure {
    match error {
        StabilityError::Stopped => Failure::Cancelled,
        StabilityError::TooFarApart { alpha, r } => {
            let values = format!("{} and {}", Typed(*alpha), Typed(*r));
            Refused::word("alpha and r", values, error).into()
        }
        StabilityError::Corner => {
            Failure::Failed(format!("{error}; a run shows whether they grow"))
        }
        error => Failure::Failed(format!("{error}; {advice}")),
    }
}

/// Warnings about the list: fewer roots than requested, or inexact ones.
pub(crate) fn remarks(spectrum: &Spectrum, asked: Option<usize>, name: &str) -> Vec<String> {
    let Spectrum { roots, certificate: Certificate { largest_error, .. } } = spectrum;
    let found = roots.len();
    let few = asked.filter(|asked| found < *asked).map(|asked| {
        format!("{name}: {found} of {asked}: there are no more, or they lie too far left to be distinguished from round-off")
    });
    let sizes = roots.iter().map(|z| z.norm()).filter(|size| *size > 0.0);
    let smallest = sizes.fold(f64::INFINITY, f64::min);
    let inexact = (*largest_error > EXACT * smallest)
        .then(|| format!("{name}: their errors may reach {largest_error:.0e}"));
    few.into_iter().chain(inexact).collect()
}
