//! The past as the state of a few exponentials, which makes (18) an ordinary differential equation.

use super::{CycleError, lattice};
use std::sync::Arc;
use stickslip_tip::memory::{Fit, FitError, Retreat, accuracy_needed};
use stickslip_tip::step::Law;
use stickslip_tip::{Model, TipFunction, Wider, tip_function};

/// (18) with f'(ξ) = `Σ_j Re(w_j e^{s_j ξ})` on the side of the past.
///
/// The state of the tip and its past is X = (e, Re ζ, Im ζ), e = rt - x0 the extension of the spring and
/// `ζ_j = w_j ∫ e^{s_j (x0(t) - x0(t'))}dt'`: a vector of fixed length, and a cycle is a periodic solution of an
/// equation for it. With inertia its last component is the velocity; under a depth limit the height under the tip is no
/// further component, but -α `Σ_j Re(ζ_j/s_j)`.
///
/// Three sums stand for f': a `fine` one, in which the equations are solved, a `short` one, in which what is found is
/// linearised, for multipliers and branches, and on the way there a `rough` one: Newton's method converges all the same,
/// and a state of half the length costs a quarter.
#[derive(Debug, Clone)]
pub(super) struct Embedding {
    pub(super) tip: TipFunction,
    pub(super) alpha: f64,
    pub(super) r: f64,
    pub(super) wider: Wider,
    pub(super) fine: Arc<Fit>,
    pub(super) short: Arc<Fit>,
    /// Takes the place of `short` while a cycle is sought.
    pub(super) rough: Arc<Fit>,
    /// Whether derivatives in the short sum are those of f.
    pub(super) short_is_precise: bool,
    /// Wave number beyond which f does not vary, as far as steps are concerned.
    pub(super) band: f64,
}

/// Of the two parameters, the one that is free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// α at fixed r.
    Alpha,
    /// r at fixed α.
    R,
}

/// Displacement of the tip that the fine sum may bring about, over the residual allowed.
const SHARE_OF_FINE: f64 = 0.1;
/// Displacement that the short one may bring about: multipliers are as accurate, where they are not
/// amplified.
const ACCURACY_OF_SHORT: f64 = 1e-8;
/// And the one that Newton's method goes by: from 1e-3 to 1e-6 maps take the same time within a tenth.
const ACCURACY_OF_ROUGH: f64 = 1e-4;
/// Few exponentials are no more than these.
const FEW: usize = 60;
/// Waves of a lattice of exponents, where no few exponentials follow f'.
const MOST_WAVES_OF_FINE: usize = 1200;
const MOST_WAVES_OF_SHORT: usize = 120;
/// What a step may miss of f, as a displacement, and the waves that this leaves over those of round-off.
const ACCURACY_OF_STEPS: f64 = 1e-5;
const WAVES_OF_ROUND_OFF: f64 = 1.5;

impl Embedding {
    /// For cycles on which (18) leaves a residual of at most `allowed`, or as little as the fit does.
    ///
    /// # Errors
    /// A footprint that never fades, or one too rough for this residual.
    pub(super) fn new(model: &Model, allowed: f64) -> Result<Self, CycleError> {
        Self::of_sums(model, allowed, false)
    }

    /// The same in sums that hold far behind the farthest point reached, of more terms.
    ///
    /// # Errors
    /// These are such sums already, or there are none good enough.
    pub(super) fn reaching_back(&self, allowed: f64) -> Result<Self, CycleError> {
        let Self { alpha, r, .. } = *self;
        let model = self.model().ok_or(CycleError::NotConverged { alpha, r })?;
        let far = Self::of_sums(&model, allowed, true)?;
        if far.retreat() > self.retreat() {
            Ok(far)
        } else {
            Err(CycleError::NotConverged { alpha, r })
        }
    }

    fn of_sums(model: &Model, allowed: f64, far: bool) -> Result<Self, CycleError> {
        let (tip, alpha, r) = (model.tip().clone(), model.alpha(), model.r());
        let sum = |accuracy: f64, most: usize| {
            let needed = accuracy_needed(model, accuracy);
            if far {
                return lattice::reaching_back(&tip, needed, most);
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

    /// Whether f is told by exponents on a lattice.
    pub(super) fn is_on_lattice(&self) -> bool {
        self.fine.terms().len() > FEW
    }

    /// Half a hump of f, as far as steps are concerned: the width of a Gaussian.
    pub(super) fn width(&self) -> f64 {
        tip_function::widths(1.0, self.band)
    }

    /// How far back from the farthest point reached the sums still hold.
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

    /// The model at the present parameters; `None` where one of them has left its range.
    pub(super) fn model(&self) -> Option<Model> {
        Model::under(self.wider, self.tip.clone(), self.alpha, self.r).ok()
    }

    /// The force on the tip.
    pub(super) fn law(&self) -> Law {
        Law { alpha: self.alpha, r: self.r, spring: 1.0 }
    }

    /// What it takes to carry the sensitivities of the state over so many steps.
    pub(super) fn work(&self, steps: f64) -> f64 {
        let state = self.state_len() as f64;
        steps * state * state
    }

    /// Length of the state X.
    pub(super) fn state_len(&self) -> usize {
        1 + 2 * self.short.terms().len() + usize::from(self.wider.inertia.is_some())
    }
}
