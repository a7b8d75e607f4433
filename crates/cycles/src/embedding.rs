//! Embedding: the history as a state of a few exponentials, which turns (18) into an ordinary differential equation.

use super::{CycleError, TOLERANCES, lattice};
use std::sync::Arc;
use stickslip_tip::memory::{Fit, FitError, Retreat, accuracy_needed};
use stickslip_tip::step::Law;
use stickslip_tip::{Model, TipFunction, Wider, tip_function};

/// (18) with f'(ξ) = `Σ_j Re(w_j e^{s_j ξ})` behind the tip.
///
/// The state of the tip and its history is X = (e, Re ζ, Im ζ), where e = rt - x0 is the extension of the spring and
/// `ζ_j = w_j ∫ e^{s_j (x0(t) - x0(t'))}dt'`. X is a vector of fixed length, and a cycle is a periodic solution of the
/// equation for X. With inertia its last component is the velocity. Under a depth limit the height under the tip is no
/// further component, but -α `Σ_j Re(ζ_j/s_j)`.
///
/// Three sums represent f'. The equations are solved in the `fine` sum. They are linearised in the `short` sum for
/// multipliers and branches, and in the `rough` sum during the search: Newton's method also converges with this sum, and
/// a state of half the length costs a quarter.
#[derive(Debug, Clone)]
pub(super) struct Embedding {
    pub(super) tip: TipFunction,
    pub(super) alpha: f64,
    pub(super) r: f64,
    pub(super) wider: Wider,
    pub(super) fine: Arc<Fit>,
    pub(super) short: Arc<Fit>,
    /// Replaces `short` during the search for a cycle.
    pub(super) rough: Arc<Fit>,
    /// Whether the short sum is accurate enough for derivatives.
    pub(super) short_is_precise: bool,
    /// Largest wave number of f that matters for the step length.
    pub(super) band: f64,
}

/// The continuation parameter of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "OverName"))]
pub enum Parameter {
    /// α at fixed r.
    Alpha,
    /// r at fixed α.
    R,
}

/// Largest displacement of the tip by the residual of the fine sum, in units of the allowed residual of (18).
const SHARE_OF_FINE: f64 = 0.1;
/// Largest displacement by the residual of the short sum: multipliers have the same accuracy, unless they amplify it.
const ACCURACY_OF_SHORT: f64 = 1e-8;
/// Largest displacement by the residual of the rough sum: from 1e-3 to 1e-6 phase diagrams take the same time within a
/// tenth.
const ACCURACY_OF_ROUGH: f64 = 1e-4;
/// Largest number of exponentials in a sum without a lattice.
const FEW: usize = 60;
/// Largest number of waves of a lattice of exponents, which is used if few exponentials cannot fit f'.
const MOST_WAVES_OF_FINE: usize = 1200;
const MOST_WAVES_OF_SHORT: usize = 120;
/// Displacement of the tip by the part of f that steps need not resolve.
const ACCURACY_OF_STEPS: f64 = 1e-5;
/// Largest wave number that steps resolve, over the largest one of f at this accuracy.
const WAVES_OF_ROUND_OFF: f64 = 1.5;

impl Embedding {
    /// The same equations with sums of more terms, valid up to this distance behind the farthest point reached.
    ///
    /// # Errors
    /// No sum is valid farther than the present ones, or none is accurate enough.
    pub(super) fn reaching_back(&self, retreat: f64, allowed: f64) -> Result<Self, CycleError> {
        let model = self.model().ok_or(self.lost())?;
        let far = Self::of_sums(&model, allowed, Some(retreat))?;
        if far.retreat() > self.retreat() { Ok(far) } else { Err(self.lost()) }
    }

    /// The error of a search for a cycle at these parameters.
    pub(super) fn lost(&self) -> CycleError {
        CycleError::NotConverged { alpha: self.alpha, r: self.r }
    }

    /// The equations for cycles with a residual of (18) of at most `allowed`, or the smallest that the fit permits, in sums
    /// that are valid up to the distance `far` behind the farthest point reached.
    ///
    /// # Errors
    /// A footprint that never fades, or one with too much detail for this residual.
    fn of_sums(model: &Model, allowed: f64, far: Option<f64>) -> Result<Self, CycleError> {
        let (tip, alpha, r) = (model.tip().clone(), model.alpha(), model.r());
        let sum = |accuracy: f64, most: usize| {
            let needed = accuracy_needed(model, accuracy);
            if let Some(retreat) = far {
                return lattice::reaching_back(&tip, (needed, retreat), most);
            }
            match Fit::cached(&tip, needed, Retreat::Small) {
                Err(FitError::NotMet { .. }) => lattice::fit(&tip, needed, most),
                fit => fit,
            }
        };
        let fine = sum(SHARE_OF_FINE * allowed, MOST_WAVES_OF_FINE)?;
        let needed = accuracy_needed(model, allowed);
        if fine.certificate().slope > needed {
            let times = fine.certificate().slope / needed;
            return Err(CycleError::Rough { allowed, reached: times * allowed });
        }
        let short = sum(ACCURACY_OF_SHORT, MOST_WAVES_OF_SHORT)?;
        let short_is_precise =
            short.certificate().slope <= accuracy_needed(model, 10.0 * ACCURACY_OF_SHORT);
        let rough = if short_is_precise {
            sum(ACCURACY_OF_ROUGH, MOST_WAVES_OF_SHORT)?
        } else {
            Arc::clone(&short)
        };
        let nominal = tip.band();
        let is_usual =
            Fit::cached(&tip, accuracy_needed(model, ACCURACY_OF_SHORT), Retreat::Small).is_ok();
        let band = if is_usual {
            nominal
        } else {
            let seen = lattice::band(&tip, accuracy_needed(model, ACCURACY_OF_STEPS))?;
            nominal.min(WAVES_OF_ROUND_OFF * seen)
        };
        let wider = *model.wider();
        Ok(Self { tip, alpha, r, wider, fine, short, rough, short_is_precise, band })
    }

    /// Whether f' is fitted by exponents on a lattice.
    pub(super) fn is_on_lattice(&self) -> bool {
        self.fine.terms().len() > FEW
    }

    /// The width of a Gaussian with this bandwidth: the scale of the peaks of f.
    pub(super) fn width(&self) -> f64 {
        tip_function::widths(1.0, self.band)
    }

    /// Distance behind the farthest point reached up to which the sums are valid.
    pub(super) fn retreat(&self) -> f64 {
        self.fine.retreat().min(self.short.retreat())
    }

    pub(super) fn parameter(&self, which: Parameter) -> f64 {
        match which {
            Parameter::Alpha => self.alpha,
            Parameter::R => self.r,
        }
    }

    pub(super) fn set(&mut self, which: Parameter, value: f64) {
        match which {
            Parameter::Alpha => self.alpha = value,
            Parameter::R => self.r = value,
        }
    }

    /// The model at the present parameters; `None` if one of them is out of range.
    pub(super) fn model(&self) -> Option<Model> {
        Model::under(self.wider, self.tip.clone(), self.alpha, self.r).ok()
    }

    /// The force on the tip.
    pub(super) fn law(&self) -> Law {
        Law { alpha: self.alpha, r: self.r, spring: 1.0 }
    }

    /// Work for the sensitivities of the state over this number of steps, in the unit of [`super::solve::MOST_WORK`].
    pub(super) fn work(&self, steps: f64) -> f64 {
        let state = self.state_len() as f64;
        steps * state * state
    }

    pub(super) fn state_len(&self) -> usize {
        1 + 2 * self.short.terms().len() + usize::from(self.wider.inertia.is_some())
    }
}

/// An error for a tip without a spring, which nothing drags.
pub(super) fn dragged(model: &Model) -> Result<(), CycleError> {
    if model.wider().spring { Ok(()) } else { Err(CycleError::NoSpring) }
}

/// The equations of a model, for this residual.
pub(super) fn embedding(model: &Model, tolerance: f64) -> Result<Embedding, CycleError> {
    dragged(model)?;
    judge(tolerance)?;
    Embedding::of_sums(model, tolerance, None)
}

/// An error for a residual out of range.
pub(super) fn judge(tolerance: f64) -> Result<(), CycleError> {
    let usable = (TOLERANCES.0..=TOLERANCES.1).contains(&tolerance);
    if usable { Ok(()) } else { Err(CycleError::Tolerance(tolerance)) }
}
