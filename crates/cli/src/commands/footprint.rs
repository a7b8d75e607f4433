//! Which f(x,y) a tip has.

use crate::failure::{Failure, Typed};
use stickslip_tip::{Footprint, TipFunction};

/// The f(x,y) of the tip; for one that has none, f(x)h(y) with h a Gaussian of the width asked for, or of
/// the width that all Gaussians of f have.
pub(super) fn footprint(
    asked: Option<f64>,
    tip: &TipFunction,
) -> Result<(Footprint, Option<f64>), Failure> {
    let named = || asked.map_or("--width-y".into(), |v| format!("--width-y {}", Typed(v)));
    match (tip.footprint(), asked.or_else(|| common_width(tip))) {
        (Some(_), _) if asked.is_some() => {
            Err(Failure::input(named(), "the tip file has its own f(x,y): leave the option out"))
        }
        (Some(own), _) => Ok((own.clone(), None)),
        (None, Some(width)) => match Footprint::separable(tip.clone(), width) {
            Ok(footprint) => Ok((footprint, Some(width))),
            Err(_) => Err(Failure::input(named(), "must be a finite number above 0")),
        },
        (None, None) => Err(Failure::input(
            "--width-y",
            "the tip has no single width of its own: give the width V in f(x,y) = \
             f(x) exp(-y²/(2 V²))",
        )),
    }
}

/// The width of all Gaussians of the tip, if it is the same.
fn common_width(tip: &TipFunction) -> Option<f64> {
    let TipFunction::Gaussians(sum) = tip else { return None };
    let width = sum.terms().first()?.width;
    // A table is made of narrow Gaussians whose width says nothing of the tip.
    let alike = sum.terms().len() <= 3;
    let same = |w: f64| (w - width).abs() <= 1e-12 * width;
    (alike && sum.terms().iter().all(|g| same(g.width))).then_some(width)
}
