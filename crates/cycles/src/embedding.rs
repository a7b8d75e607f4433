//! The past as the state of a few exponentials, which makes (18) an ordinary differential equation.

use std::sync::Arc;
use stickslip_tip::memory::{Fit, FitError, accuracy_needed};
use stickslip_tip::{Model, TipFunction};

/// (18) with f'(ξ) = `Σ_j Re(w_j e^{s_j ξ})` on the side of the past.
///
/// The state of the tip and its past is X = (e, Re ζ, Im ζ), e = rt - x0 the extension of the spring and
/// `ζ_j = w_j ∫ e^{s_j (x0(t) - x0(t'))}dt'`: a vector of fixed length, and a cycle is a periodic solution of an
/// equation for it.
///
/// Two sums stand for f': a `fine` one, in which the equations are solved, and a `short` one, in which they
/// are linearised. Newton's method converges all the same, and costs a fifth.
#[derive(Debug, Clone)]
pub(super) struct Embedding {
    pub(super) tip: TipFunction,
    pub(super) alpha: f64,
    pub(super) r: f64,
    pub(super) fine: Arc<Fit>,
    pub(super) short: Arc<Fit>,
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
/// What a fit reached, it reaches again.
const AT_BEST: f64 = 1.01;

impl Embedding {
    /// For cycles on which (18) leaves a residual of at most `allowed`, or as little as the fit does.
    ///
    /// # Errors
    /// A footprint that never fades.
    pub(super) fn new(model: &Model, allowed: f64) -> Result<Self, FitError> {
        let (tip, alpha, r) = (model.tip().clone(), model.alpha(), model.r());
        let fit = |accuracy: f64| match Fit::cached(&tip, accuracy_needed(model, accuracy)) {
            Err(FitError::NotMet { reached, .. }) => Fit::cached(&tip, AT_BEST * reached),
            fit => fit,
        };
        let (fine, short) = (fit(SHARE_OF_FINE * allowed)?, fit(ACCURACY_OF_SHORT)?);
        Ok(Self { tip, alpha, r, fine, short })
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
        Model::new(self.tip.clone(), self.alpha, self.r).ok()
    }
}
