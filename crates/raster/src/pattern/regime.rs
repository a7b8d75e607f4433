//! The kinds of surface, and what decides between them.

use super::estimate::Estimate;
use std::fmt;

/// The kinds of surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// No ripples: the surface is as deep everywhere, but for what fades from the edges at which lines begin.
    Steady,
    /// Crests, the same from line to line; on a zigzag from each to the next that goes the same way.
    Ripples,
    /// Crests broken into pits, lines still following each other.
    Pits,
    /// Neither.
    Disordered,
    /// On most lines the tip did not leave the pit at an end of them.
    StuckAtTheEdge,
    /// Too few or too short lines to tell.
    Unknown,
}

impl fmt::Display for Regime {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Steady => "steady",
            Self::Ripples => "ripples",
            Self::Pits => "pits",
            Self::Disordered => "disordered",
            Self::StuckAtTheEdge => "stuck at the edge",
            Self::Unknown => "unknown",
        })
    }
}

/// Ripples below this part of the depth are none.
pub(super) const FLAT: f64 = 0.01;
/// What has less than this left away from the edges of the lines, of what it has next to them, is the mark of the edges.
const FADED: f64 = 0.5;
/// Coherence of ripples, and of a lattice of pits.
const ORDERED: f64 = 0.95;
const LATTICE: f64 = 0.4;
/// Crests are broken into pits where more than a twentieth of the power of slopes lies along them, which is a straightness of
/// 1 - 2/20, and the surface is that rough, in its depth.
const STRAIGHT: f64 = 0.9;
pub(super) const PITTED: f64 = 0.12;

/// What decides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measures {
    /// Half peak-to-peak, in parts of the depth that was carved.
    pub(super) amplitude: Estimate,
    /// Of what all lines have alike: what is left of it away from the edges. Of other waves 1.
    pub(super) kept: Estimate,
    /// See [`Sheet::straightness`](super::sheet::Sheet::straightness).
    pub(super) straightness: Estimate,
    /// Coherence of each line with the one that it follows.
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

    /// Another that one of the measures would make it, elsewhere within its error.
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
