//! Retreats of the tip beyond the range of the modes: the lattice, built from the history buffer, replaces them.

use super::super::fft::Fft;
use super::super::groove::longest_look;
use super::super::record::Record;
use crate::TipFunction;

/// Number of retreats of the tip beyond the range of the modes, and the lattice in use meanwhile.
#[derive(Default)]
pub(super) struct Retreats {
    pub(super) fft: Option<Box<Fft>>,
    pub(super) count: u64,
    /// Distance behind the farthest point up to which the lattice contains all visits within reach.
    pub(super) farthest_back: f64,
}

/// The lattice first contains the visits within this number of reaches behind the tip: few retreats are longer.
const NEAR: f64 = 4.0;

impl Retreats {
    /// Begins a retreat of a tip that is at the distance `back` behind its farthest point.
    pub(super) fn begin(&mut self, tip: &TipFunction, record: &Record, back: f64) {
        let near = NEAR * tip.reach().unwrap_or(f64::INFINITY);
        self.fft = Some(Box::new(Fft::new(tip, record.near(-near, back))));
        self.farthest_back = back + near - longest_look(tip);
        self.count += 1;
    }

    /// Continues the retreat; builds a longer lattice if the tip is too far back for the first one.
    pub(super) fn continue_retreat(&mut self, tip: &TipFunction, record: &Record, back: f64) {
        if back > self.farthest_back {
            self.fft = Some(Box::new(Fft::new(tip, record.all())));
            self.farthest_back = f64::INFINITY;
        }
    }
}
