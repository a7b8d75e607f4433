//! `--units`: what the dimensionless numbers of an image are in metres.

use crate::arguments::SurfaceArguments;
use crate::failure::{Failure, Typed};
use crate::files::input::read_document;
use stickslip_documents::UnitsDocument;
use stickslip_tip::Model;

/// Relative difference at which α or r are taken for others: what is typed has this many digits.
const SAME: f64 = 1e-6;

/// SI values of one unit of length and of height, and their unit; 1 and none where `--units` is not given.
#[derive(Debug)]
pub(super) struct Scale {
    pub(super) length: f64,
    pub(super) height: f64,
    pub(super) unit: &'static str,
}

impl Scale {
    pub(super) fn asked(arguments: &SurfaceArguments, model: &Model) -> Result<Self, Failure> {
        let Some(path) = arguments.units.as_deref() else {
            return Ok(Self { length: 1.0, height: 1.0, unit: "" });
        };
        let document: UnitsDocument = read_document("--units", path, UnitsDocument::FORMAT)?;
        let named = || format!("--units {}", path.display());
        let pairs = [("α", document.alpha, model.alpha()), ("r", document.r, model.r())];
        for (name, there, here) in pairs {
            if (there - here).abs() > SAME * here.abs() {
                let (there, here) = (Typed(there), Typed(here));
                let advice = format!(
                    "{name} is {there} there and {here} in the run: give the units of this run"
                );
                return Err(Failure::input(named(), advice));
            }
        }
        let scales = [document.scales.length, document.scales.height];
        if scales.iter().any(|s| !(s.is_finite() && *s > 0.0)) {
            return Err(Failure::input(named(), "damaged: scales must be above 0"));
        }
        Ok(Self { length: scales[0], height: scales[1], unit: "m" })
    }
}
