//! The regimes of a surface, and the criteria between them.

use super::estimate::Estimate;
use std::fmt;

/// Regimes of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "RasterRegimeName"))]
pub enum Regime {
    /// No ripples, except those that decay from the edges at which lines begin.
    Steady,
    /// Crests that repeat from line to line; on a zigzag from each line to the next one in the same direction.
    Ripples,
    /// Lines that fell into grooves of earlier lines, if the tip is free to move across: trenches along the scan, or
    /// pairs of lines.
    Bunched,
    /// Crests broken into pits; neighbouring lines are still correlated.
    Pits,
    /// Neither ripples nor pits.
    Disordered,
    /// On most lines the tip did not leave the pit at one end.
    StuckAtTheEdge,
    /// Too few or too short lines for a regime, or one line scanned repeatedly; `remarks` state how many lines would
    /// be sufficient.
    Unknown,
}

impl fmt::Display for Regime {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Steady => "steady",
            Self::Ripples => "ripples",
            Self::Bunched => "bunched",
            Self::Pits => "pits",
            Self::Disordered => "disordered",
            Self::StuckAtTheEdge => "stuck at the edge",
            Self::Unknown => "regime unknown",
        })
    }
}

/// Largest amplitude relative to the depth that counts as no ripples.
pub(super) const FLAT: f64 = 0.01;
/// A wave is an effect of the edges if less than this fraction of it remains away from the edges of the lines.
const FADED: f64 = 0.5;
/// Smallest coherence of ripples.
const ORDERED: f64 = 0.95;
/// Smallest coherence of a lattice of pits.
const LATTICE: f64 = 0.4;
/// Smallest straightness of ripples. Crests count as broken into pits if more than a twentieth of the power of slopes
/// lies along them, a straightness of 1 - 2/20, and the surface is also rough.
const STRAIGHT: f64 = 0.9;
/// Smallest amplitude of a rough surface, relative to the carved depth.
pub(super) const PITTED: f64 = 0.12;

/// The measures that determine the regime.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measures {
    /// Half peak-to-peak, relative to the carved depth.
    pub(super) amplitude: Estimate,
    /// For waves common to all lines, and for settled ones: the fraction that remains away from the edges; 1 for others.
    pub(super) kept: Estimate,
    /// Straightness of the crests: see [`Sheet::straightness`](super::sheet::Sheet::straightness).
    pub(super) straightness: Estimate,
    /// Coherence of each line with the previous one in its direction.
    pub(super) followed: Estimate,
}

impl Measures {
    pub(super) fn regime(&self) -> Regime {
        if self.amplitude.value < FLAT || self.kept.value < FADED {
            return Regime::Steady;
        }
        let is_pitted = self.straightness.value < STRAIGHT && self.amplitude.value > PITTED;
        match is_pitted {
            true if self.followed.value >= LATTICE => Regime::Pits,
            false if self.followed.value >= ORDERED => Regime::Ripples,
            _ => Regime::Disordered,
        }
    }

    /// Another regime that results if one of the measures changes within its error.
    pub(super) fn beside(&self) -> Option<Regime> {
        let here = self.regime();
        let of: [fn(&mut Self) -> &mut Estimate; 4] =
            [|m| &mut m.amplitude, |m| &mut m.kept, |m| &mut m.straightness, |m| &mut m.followed];
        let moved = |measure: fn(&mut Self) -> &mut Estimate, side: f64| {
            let mut moved = *self;
            let estimate = measure(&mut moved);
            estimate.value += side * estimate.error;
            moved.regime()
        };
        let all = of.into_iter().flat_map(|measure| [-1.0, 1.0].map(|side| moved(measure, side)));
        all.into_iter().find(|regime| *regime != here)
    }
}
