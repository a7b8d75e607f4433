//! Scenarios in two coordinates: all parameters of a run, and errors in them.

use super::products::{Products, ProductsError};
use super::texture::{HeightTable, Texture, TextureError};
use crate::memory::{FINEST_OF_SWINGING, FitError, accuracy_needed};
use crate::run::{RunError, Scenario};
use crate::{Force, IntegrationError};
use std::sync::Arc;
use thiserror::Error;

/// A line y = 0, scanned by a tip that also moves across it.
#[derive(Debug, Clone)]
pub struct PlanarScenario {
    /// Parameters of the motion along the scan; the footprint is one of [`TipFunction::of_footprint`](crate::TipFunction::of_footprint).
    pub along: Scenario,
    /// Stiffness κ_y of the spring across the scan, in units of that along it.
    pub stiffness_across: f64,
    /// Initial displacement of the tip from its line, in σ.
    pub kick_across: f64,
    /// External force across the scan, in kσ.
    pub force_across: Force,
    /// Distance of independent rows of the [noise](Scenario::noise) across the scan, its correlation length, in σ.
    /// `None`: noise does not depend on y.
    pub noise_spacing_across: Option<f64>,
    /// Table u0(x,y) added to the initial surface; [`Scenario::profile`] does not depend on y.
    pub profile_across: Option<HeightTable>,
}

/// Errors of a run in two coordinates: an invalid scenario, or an integration that cannot be completed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlanarError {
    /// κ_y is not a finite number above 0.
    #[error("the stiffness across the scan must be a finite number above 0, not {0:?}")]
    Stiffness(f64),
    /// The kick across is not finite.
    #[error("the kick across the scan must be a finite number, not {0:?}")]
    Kick(f64),
    /// The distance of rows of noise is not finite or too small.
    #[error("rows of noise must be at least {LEAST_SPACING} apart across the scan, not {0:?}")]
    NoiseSpacing(f64),
    /// The initial surface cannot be computed.
    #[error(transparent)]
    InitialSurface(#[from] TextureError),
    /// The footprint is f(x) alone, which does not determine the force across.
    #[error("two coordinates need a footprint f(x,y): give its width across the scan")]
    NoFootprint,
    /// The footprint does not decay along the scan.
    #[error(
        "a tip that moves across the scan needs a footprint that decays along it, which J0 and the cosine do not; for J0 in the plane there are walkers"
    )]
    NeverFades,
    /// The sides of the footprint differ along x.
    #[error("two coordinates need a footprint with two equal sides: give one side of it")]
    TwoSides,
    /// The footprint is not a sum of few products of a function of x and one of y.
    #[error(transparent)]
    Products(#[from] ProductsError),
    /// An option that is available in one coordinate only.
    #[error("{0} is not available in two coordinates")]
    Unavailable(&'static str),
    /// The tip retreated beyond the range of the memory.
    #[error(
        "at t = {t}: the tip is {behind} behind the farthest point that it has been to, and the memory reaches back {allowed}"
    )]
    Retreat {
        /// Time reached.
        t: f64,
        /// Distance behind the farthest point, in σ.
        behind: f64,
        /// Largest allowed distance, in σ.
        allowed: f64,
    },
    /// The tip and its past span too wide a range across the scan.
    #[error(
        "at t = {t}: the tip and the groove that it feels span {range} widths across the scan, more than a sum of layers can represent: take a smaller α, or a stiffer spring across"
    )]
    Range {
        /// Time reached.
        t: f64,
        /// Range, in widths v.
        range: f64,
    },
    /// The tip left the part of the surface of earlier scans that was given.
    #[error(
        "at t = {t}: the tip is {y} off its line, where the surface of earlier lines is unknown"
    )]
    BeyondGrooves {
        /// Time reached.
        t: f64,
        /// y0, in σ.
        y: f64,
    },
    /// Exponentials do not fit f'.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// An error that also applies to one coordinate.
    #[error(transparent)]
    Along(#[from] RunError),
}

/// Factor of the error that exponentials may have, for a spring across as stiff as that along. The phase of a line that
/// snakes is free: errors of its period add up, in 35 periods to a thousand times the error of the exponentials.
const SHARE_ACROSS: f64 = 0.1;
/// Least distance of rows of noise, in σ.
const LEAST_SPACING: f64 = 0.01;

impl From<IntegrationError> for PlanarError {
    fn from(error: IntegrationError) -> Self {
        Self::Along(error.into())
    }
}

impl PlanarScenario {
    /// A scenario without a kick or force across, with an initial surface that does not depend on y.
    pub fn new(along: Scenario, stiffness_across: f64) -> Self {
        Self {
            along,
            stiffness_across,
            kick_across: 0.0,
            force_across: Force::default(),
            noise_spacing_across: None,
            profile_across: None,
        }
    }

    /// The initial surface except for the groove of steady motion.
    ///
    /// # Errors
    /// The profile is not a function of x, or the noise has too many points.
    pub fn texture(&self) -> Result<Texture, PlanarError> {
        let table = self.profile_across.as_ref();
        Ok(Texture::new(&self.along, self.noise_spacing_across, table)?)
    }

    /// The footprint as a sum of products g(x) h(y), as accurate as the tolerance needs.
    ///
    /// # Errors
    /// The footprint is f(x) alone, or requires too many products.
    pub(super) fn products(&self) -> Result<Arc<Products>, PlanarError> {
        let model = &self.along.model;
        let footprint = model.tip().footprint().ok_or(match model.tip().reach() {
            None => PlanarError::NeverFades,
            Some(_) => PlanarError::NoFootprint,
        })?;
        let share = SHARE_ACROSS * self.stiffness_across.min(1.0);
        let accuracies = [1.0, share].map(|share| {
            accuracy_needed(model, share * self.along.tolerance).max(FINEST_OF_SWINGING)
        });
        Ok(Products::cached(footprint, accuracies)?)
    }

    /// Checks all parameters.
    ///
    /// # Errors
    /// The first parameter out of range, or an option that is not available.
    pub fn validate(&self) -> Result<(), PlanarError> {
        if !(self.stiffness_across.is_finite() && self.stiffness_across > 0.0) {
            return Err(PlanarError::Stiffness(self.stiffness_across));
        }
        if !self.kick_across.is_finite() {
            return Err(PlanarError::Kick(self.kick_across));
        }
        if let Some(spacing) = self.noise_spacing_across
            && !(spacing.is_finite() && spacing >= LEAST_SPACING)
        {
            return Err(PlanarError::NoiseSpacing(spacing));
        }
        let along = &self.along;
        along.validate()?;
        if !along.model.tip().is_even() {
            return Err(PlanarError::TwoSides);
        }
        self.products()?;
        if self.profile_across.is_some() {
            along.validate_rounding(along.start_position.abs().max(along.farthest()))?;
        }
        if !along.model.wider().spring {
            return Err(PlanarError::Unavailable("a tip without a spring"));
        }
        Ok(())
    }
}
