//! Lists of growth exponents: how many may be asked for, and remarks on those found.

use crate::{Failure, Refused, Typed};
use stickslip_stability::{Certificate, Spectrum, StabilityError};
use stickslip_tip::{Model, TipFunction};

/// Errors above this part of the smallest |λ| are worth a remark.
const EXACT: f64 = 1e-10;
/// More than there are right of [`leftmost`].
const MOST_ROOTS: usize = 1000;

/// Re λ below which the roots of a table are those of its round-off, and those of a closed form are of
/// no use: they decay by e^{-60} over a width of the tip.
pub(crate) fn leftmost(model: &Model) -> f64 {
    /// Tips of more Gaussians come from tables.
    const FEW: usize = 16;
    let TipFunction::Gaussians(sum) = model.tip() else { return -1e6 * model.r() };
    let reach = model.tip().reach().unwrap_or(1.0);
    let exponent = if sum.terms().len() > FEW { -24.0 } else { -540.0 };
    model.r() * exponent / reach
}

/// Refuses a number of roots that is not from 1 to 1000.
///
/// # Errors
/// The refusal.
pub fn judge_count(parameter: &'static str, count: usize) -> Result<(), Refused> {
    if (1..=MOST_ROOTS).contains(&count) {
        return Ok(());
    }
    Err(Refused::number(parameter, count as f64, format!("1 to {MOST_ROOTS} will do")))
}

/// The roots could not be listed, through no fault of the question unless α and r are out of all proportion.
pub fn failed(error: &StabilityError, advice: &str) -> Failure {
    match error {
        StabilityError::Stopped => Failure::Cancelled,
        StabilityError::TooFarApart { alpha, r } => {
            let value = Some(format!("{} and {}", Typed(*alpha), Typed(*r)));
            Refused { parameter: "alpha and r".into(), value, why: error.to_string() }.into()
        }
        error => Failure::Failed(format!("{error}; {advice}")),
    }
}

/// What a reader of the list should know: fewer than asked for, or inexact.
pub fn remarks(spectrum: &Spectrum, asked: Option<usize>, name: &str) -> Vec<String> {
    let Spectrum { roots, certificate: Certificate { largest_error, .. } } = spectrum;
    let found = roots.len();
    let few = asked.filter(|asked| found < *asked).map(|asked| {
        format!("{name}: {found} of {asked}, there are no more, or they lie too far left to be told from round-off")
    });
    let sizes = roots.iter().map(|z| z.norm()).filter(|size| *size > 0.0);
    let smallest = sizes.fold(f64::INFINITY, f64::min);
    let inexact = (*largest_error > EXACT * smallest)
        .then(|| format!("{name}: their errors may reach {largest_error:.0e}"));
    few.into_iter().chain(inexact).collect()
}
