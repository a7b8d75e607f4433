//! Everything that defines a raster, and what no raster can be made of.

use crate::path::{Path, Track};
use stickslip_tip::{Footprint, Force, Model, RunError, Scenario, Start};
use thiserror::Error;

/// Everything that defines a raster. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone)]
pub struct Plan {
    /// f(x,y), of which the tip of the model is f(x,0).
    pub footprint: Footprint,
    /// How the support goes from one line to the next.
    pub path: Path,
    /// Distance of the lines; not looked at by [`Path::Repeat`].
    pub pitch: f64,
    /// How many.
    pub lines: usize,
    /// How far the support goes along each.
    pub length: f64,
    /// External force on the first line, by the time since its start: what disturbs all others.
    pub disturbance: Force,
    /// The law, the tolerance and the memory of every line; start, end, kick and force are those of the line.
    pub law: Scenario,
}

/// Why a raster was refused or could not be finished.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RasterError {
    /// A pitch that is no distance.
    #[error(
        "the pitch must be a finite number above 0, and at least {least:.1e} for a footprint that reaches {reach:.3} across, not {pitch:?}"
    )]
    Pitch {
        /// As given.
        pitch: f64,
        /// Reach of the footprint across the lines.
        reach: f64,
        /// The smallest.
        least: f64,
    },
    /// A length that is no distance, or that no lattice holds.
    #[error(
        "the length of a line must be a finite number above 0 and at most {most:.1e}, not {length:?}"
    )]
    Length {
        /// As given.
        length: f64,
        /// The largest.
        most: f64,
    },
    /// None, or more than are kept.
    #[error("a raster has between 1 and {MOST_LINES} lines, not {0}")]
    Lines(usize),
    /// Nothing that could be scanned with.
    #[error("a raster needs a spring: without one there is no support that goes along lines")]
    NoSpring,
    /// A footprint without reach.
    #[error("a raster needs a footprint that fades along the lines, as J0 does not")]
    NeverFades,
    /// The tip is not f(x,0).
    #[error("the tip function of the law is not the footprint's section y = 0")]
    Section,
    /// A line could not be run.
    #[error("line {line}: {error}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// Why.
        error: RunError,
    },
}

/// The most lines; their histories take some 20 kB each at 100 widths.
pub const MOST_LINES: usize = 1_000_000;
/// Lines within reach of one.
const MOST_WITHIN_REACH: f64 = 1e4;
/// Points of the lattice that a line is held on.
const MOST_POINTS: f64 = 1e7;
/// A Gaussian ends so many widths from its center: e^{-40.5} = 2.6e-18.
pub(crate) const WIDTHS: f64 = 9.0;

impl Plan {
    /// Lines over a flat surface under the law of `model`, to a tolerance of 1e-9.
    #[must_use]
    pub fn new(
        footprint: Footprint,
        model: Model,
        path: Path,
        pitch: f64,
        lines: usize,
        length: f64,
    ) -> Self {
        let law = Scenario::new(model, length);
        Self { footprint, path, pitch, lines, length, disturbance: Force::default(), law }
    }

    /// # Errors
    /// The first parameter out of range.
    pub fn validate(&self) -> Result<(), RasterError> {
        if !self.law.model.wider().spring {
            return Err(RasterError::NoSpring);
        }
        let layers = self.footprint.layers().iter();
        if layers.clone().any(|layer| layer.along.reach().is_none()) {
            return Err(RasterError::NeverFades);
        }
        let section = self.footprint.path();
        let differs = |x: f64| (section.value(x) - self.law.model.tip().value(x)).abs() > 1e-12;
        if (0..20).any(|i| differs(0.37 * f64::from(i) * 8.7 / section.band())) {
            return Err(RasterError::Section);
        }
        let (pitch, reach) = (self.pitch, self.reach_across());
        let least = reach / MOST_WITHIN_REACH;
        if self.path != Path::Repeat && !(pitch.is_finite() && pitch >= least) {
            return Err(RasterError::Pitch { pitch, reach, least });
        }
        let most = MOST_POINTS / self.band();
        if !(self.length > 0.0 && self.length <= most) {
            return Err(RasterError::Length { length: self.length, most });
        }
        if !(1..=MOST_LINES).contains(&self.lines) {
            return Err(RasterError::Lines(self.lines));
        }
        self.line((0.0, 0.0), true).validate().map_err(|error| RasterError::Line { line: 1, error })
    }

    /// Line number n, counted from 0.
    #[must_use]
    pub fn track(&self, n: usize) -> Track {
        self.path.track(n, self.pitch, self.length)
    }

    /// How long each line takes, X/r.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.length / self.law.model.r()
    }

    /// The run of a line whose tip starts `ahead` of the support, with this velocity if it has inertia.
    pub(crate) fn line(&self, (ahead, velocity): (f64, f64), is_first: bool) -> Scenario {
        let has_inertia = self.law.model.wider().inertia.is_some();
        Scenario {
            start: Start::Flat,
            start_position: 0.0,
            kick: -ahead,
            start_velocity: has_inertia.then_some(velocity),
            path: None,
            until: self.duration(),
            force: if is_first { self.disturbance.clone() } else { Force::default() },
            ..self.law.clone()
        }
    }

    /// Beyond this distance in y a line is not felt.
    #[must_use]
    pub fn reach_across(&self) -> f64 {
        let of = |across: &stickslip_tip::Across| across.center + WIDTHS * across.width;
        self.footprint.layers().iter().map(|layer| of(&layer.across)).fold(0.0, f64::max)
    }

    /// Beyond this distance in x nothing is felt.
    pub(crate) fn reach_along(&self) -> f64 {
        let layers = self.footprint.layers().iter();
        layers.filter_map(|layer| layer.along.reach()).fold(0.0, f64::max)
    }

    /// Beyond this wave number in x no layer has anything.
    pub(crate) fn band(&self) -> f64 {
        self.footprint.layers().iter().map(|layer| layer.along.band()).fold(0.0, f64::max)
    }
}
