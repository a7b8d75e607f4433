//! The model: a tip function, the two numbers α and r, and the terms of the extended model.

use crate::wider::{Wider, WiderError};
use crate::{Footprint, TipFunction, lambert};
use thiserror::Error;

/// Footprint, indentation rate and support velocity, validated.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    tip: TipFunction,
    alpha: f64,
    r: f64,
    wider: Wider,
}

/// A parameter outside its range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ModelError {
    /// α must be finite, and ≥ 0 with a spring.
    #[error(
        "the dimensionless indentation rate alpha (13) must be a finite number, 0 or above, not {0:?} (below 0 only without a spring)"
    )]
    Alpha(f64),
    /// r must be finite and > 0 with a spring.
    #[error("the dimensionless support velocity r (12) must be a finite number above 0, not {0:?}")]
    R(f64),
    /// r must be 0 without a spring, because there is no support.
    #[error("without a spring there is no support, and no velocity r of it, not {0:?}")]
    SupportWithoutSpring(f64),
    /// A depth limit needs a footprint with a mean depth; cos x has none.
    #[error("the tip cosine has no mean depth, and cannot have a depth limit")]
    Cosine,
    /// A parameter of the extended model is out of range.
    #[error(transparent)]
    Wider(#[from] WiderError),
}

impl Model {
    /// The basic model, without the terms of the extended one.
    ///
    /// # Errors
    /// `alpha` < 0, `r` ≤ 0, or either not finite.
    pub fn new(tip: TipFunction, alpha: f64, r: f64) -> Result<Self, ModelError> {
        Self::under(Wider::default(), tip, alpha, r)
    }

    /// A model with the terms of the extended model. Without a spring α may be below 0, and r is 0.
    ///
    /// # Errors
    /// As [`new`](Self::new); a parameter of the extended model out of its range.
    pub fn under(wider: Wider, tip: TipFunction, alpha: f64, r: f64) -> Result<Self, ModelError> {
        wider.validate()?;
        if !(alpha.is_finite() && (alpha >= 0.0 || !wider.spring)) {
            return Err(ModelError::Alpha(alpha));
        }
        if wider.spring && !(r.is_finite() && r > 0.0) {
            return Err(ModelError::R(r));
        }
        if !wider.spring && r.abs() > 0.0 {
            return Err(ModelError::SupportWithoutSpring(r));
        }
        if tip == TipFunction::Cosine && wider.depth_limit.is_some() {
            return Err(ModelError::Cosine);
        }
        Ok(Self { tip, alpha, r, wider })
    }

    /// The same model with the footprint f(x,y), whose section f(x,0) becomes its tip function.
    #[must_use]
    pub fn with_footprint(self, footprint: Footprint) -> Self {
        Self { tip: TipFunction::of_footprint(footprint), ..self }
    }

    /// The same model for a tip that moves to smaller x, in the frame of its motion: with the footprint f(-x).
    pub fn mirrored(&self) -> Self {
        Self { tip: self.tip.mirrored(), ..self.clone() }
    }

    /// The footprint f.
    pub fn tip(&self) -> &TipFunction {
        &self.tip
    }

    /// Dimensionless indentation rate α (13).
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// Dimensionless support velocity r (12).
    pub fn r(&self) -> f64 {
        self.r
    }

    /// Terms of the extended model.
    pub fn wider(&self) -> &Wider {
        &self.wider
    }

    /// Decay rate s = 1/(rT), per unit length, of the groove of steady motion behind the tip; 0 without healing.
    pub fn fading(&self) -> f64 {
        self.wider.fading(self.r)
    }

    /// Relative indentation rate w0 of a tip in steady motion, in units of α: 1 without a depth limit.
    ///
    /// With the depth limit b of (61) the height under the tip is h0 = -(α w0/r)φ, φ = ∫_0^∞ f(y) e^{-sy}dy, and w0 =
    /// e^{-|h0|/b}. Hence w0 = W(c)/c with c = α|φ|/(rb) and Lambert's function W; s is [`fading`](Self::fading).
    pub fn steady_weight(&self) -> f64 {
        let Some(limit) = self.wider.depth_limit else { return 1.0 };
        let depth = self.tip.fading_tail(0.0, self.fading()).abs();
        let c = self.alpha * depth / (self.r * limit);
        if c > 0.0 { lambert::w0(c) / c } else { 1.0 }
    }

    /// Height h0 of the surface under a tip in steady motion, in kσ²/a.
    pub fn steady_height(&self) -> f64 {
        0.0 - self.steady_density() * self.tip.fading_tail(0.0, self.fading())
    }

    /// Indentation α w0/r per unit length of the path in steady motion.
    pub fn steady_density(&self) -> f64 {
        self.alpha * self.steady_weight() / self.r
    }

    /// Value l0 of l = rt - r - x0 in steady motion: α f(0)/r. Equation (21) has α/r, which requires f(0) = 1. In the
    /// extended model it is (α w0/r)(f(0) - sφ), with the φ of [`steady_weight`](Self::steady_weight).
    pub fn steady_l(&self) -> f64 {
        let apex = self.tip.value(0.0);
        match self.wider.healing_time {
            None => self.alpha * self.steady_weight() * apex / self.r,
            Some(_) => {
                let fading = self.fading();
                self.steady_density() * (apex - fading * self.tip.fading_tail(0.0, fading))
            }
        }
    }

    /// Lag r + l0 of the tip behind the support in steady motion, (23).
    pub fn steady_lag(&self) -> f64 {
        self.r + self.steady_l()
    }

    /// Height of the surface far behind a tip in steady motion, (25), in kσ²/a; 0 if the surface heals.
    pub fn steady_surface_behind(&self) -> f64 {
        if self.wider.healing_time.is_some() {
            return 0.0;
        }
        // 0.0 - 0.0 is 0.0, where a minus sign would make it -0.0.
        0.0 - self.alpha * self.steady_weight() / self.r * self.tip.integral()
    }
}
