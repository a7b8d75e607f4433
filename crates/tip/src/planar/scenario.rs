//! Scenarios in two coordinates: all parameters of a run, and errors in them.

use crate::footprint::Across;
use crate::memory::{FitError, MemoryChoice};
use crate::run::{RunError, Scenario};
use crate::{Force, IntegrationError, TipFunction};
use thiserror::Error;

/// A line y = 0, scanned by a tip that also moves across it.
#[derive(Debug, Clone)]
pub struct PlanarScenario {
    /// Parameters of the motion along the scan; the footprint is one of [`TipFunction::of_footprint`].
    pub along: Scenario,
    /// Stiffness κ_y of the spring across the scan, in units of that along it.
    pub stiffness_across: f64,
    /// Initial displacement of the tip from its line, in σ.
    pub kick_across: f64,
    /// External force across the scan, in kσ.
    pub force_across: Force,
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
    /// The footprint is f(x) alone, which does not determine the force across.
    #[error("two coordinates need a footprint f(x,y): give its width across the scan")]
    NoFootprint,
    /// The footprint has several layers, or lobes across.
    #[error(
        "in two coordinates f(x,y) must be a function of x times one Gaussian of y about 0; this one has {layers} such terms{}",
        if *.lobes { ", with lobes across the scan" } else { "" }
    )]
    Footprint {
        /// Number of products in the footprint.
        layers: usize,
        /// Whether some of them have their centers off y = 0.
        lobes: bool,
    },
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
        "at t = {t}: the tip and the groove that it feels span {range} widths across the scan, more than a sum of layers can represent"
    )]
    Range {
        /// Time reached.
        t: f64,
        /// Range, in widths v.
        range: f64,
    },
    /// Exponentials do not fit f'.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// An error that also applies to one coordinate.
    #[error(transparent)]
    Along(#[from] RunError),
}

impl From<IntegrationError> for PlanarError {
    fn from(error: IntegrationError) -> Self {
        Self::Along(error.into())
    }
}

impl PlanarScenario {
    /// A scenario without a kick or force across.
    #[must_use]
    pub fn new(along: Scenario, stiffness_across: f64) -> Self {
        Self { along, stiffness_across, kick_across: 0.0, force_across: Force::default() }
    }

    /// The footprint as f(x,y) = g(x) h(y).
    ///
    /// # Errors
    /// A footprint of another form.
    pub(super) fn footprint(&self) -> Result<(&TipFunction, Across), PlanarError> {
        let footprint = self.along.model.tip().footprint().ok_or(PlanarError::NoFootprint)?;
        match footprint.layers() {
            [layer] if layer.across.center <= 0.0 => Ok((&layer.along, layer.across)),
            layers => {
                let lobes = layers.iter().any(|layer| layer.across.center > 0.0);
                Err(PlanarError::Footprint { layers: layers.len(), lobes })
            }
        }
    }

    /// # Errors
    /// The first parameter out of range, or an option that is not available.
    pub fn validate(&self) -> Result<(), PlanarError> {
        if !(self.stiffness_across.is_finite() && self.stiffness_across > 0.0) {
            return Err(PlanarError::Stiffness(self.stiffness_across));
        }
        if !self.kick_across.is_finite() {
            return Err(PlanarError::Kick(self.kick_across));
        }
        self.footprint()?;
        let along = &self.along;
        along.validate()?;
        let wider = along.model.wider();
        let unavailable = [
            (!wider.spring, "a tip without a spring"),
            (along.noise.is_some(), "noise on the initial surface"),
            (along.profile.is_some(), "an initial surface"),
            (along.memory == MemoryChoice::Direct, "the memory direct"),
            (along.memory == MemoryChoice::Fft, "the memory fft"),
        ];
        match unavailable.into_iter().find(|(asked, _)| *asked) {
            Some((_, what)) => Err(PlanarError::Unavailable(what)),
            None => Ok(()),
        }
    }
}
