//! How many growth exponents may be asked for, and what is said about those that come.

use crate::failure::{Failure, Typed};
use stickslip::ComplexDocument;
use stickslip_stability::{Certificate, Spectrum, StabilityError};
use stickslip_tip::{Model, TipFunction};

/// Errors above this part of the smallest |λ| are worth a remark.
const EXACT: f64 = 1e-10;
/// More than there are right of [`leftmost`].
const MOST_ROOTS: usize = 1000;

/// Re λ below which the roots of a table are those of its round-off, and those of a closed form are of
/// no use: they decay by e^{-60} over a width of the tip.
pub(super) fn leftmost(model: &Model) -> f64 {
    /// Tips of more Gaussians come from tables.
    const FEW: usize = 16;
    let TipFunction::Gaussians(sum) = model.tip() else { return -1e6 * model.r() };
    let reach = model.tip().reach().unwrap_or(1.0);
    let exponent = if sum.terms().len() > FEW { -24.0 } else { -540.0 };
    model.r() * exponent / reach
}

/// Judges a number of roots that `option` asked for.
pub(super) fn judge_count(option: &str, count: usize) -> Result<(), Failure> {
    if (1..=MOST_ROOTS).contains(&count) {
        return Ok(());
    }
    Err(Failure::input(format!("{option} {count}"), format!("1 to {MOST_ROOTS} will do")))
}

pub(super) fn complex(re: f64, im: f64) -> ComplexDocument {
    ComplexDocument { re, im }
}

/// The roots could not be listed, through no fault of the input unless that is out of all proportion.
pub(super) fn failed(error: &StabilityError, advice: &str) -> Failure {
    if let StabilityError::TooFarApart { alpha, r } = error {
        return Failure::input(format!("--alpha {} --r {}", Typed(*alpha), Typed(*r)), error);
    }
    Failure::Run(format!("{error}; {advice}"))
}

/// What a reader of the list should know.
pub(super) fn remarks(spectrum: &Spectrum, asked: Option<usize>, name: &str) -> Vec<String> {
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
