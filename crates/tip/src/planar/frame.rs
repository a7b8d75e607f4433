//! Which layers are in use: their center, and how many there are.

use super::extent::Extent;
use super::layers::{self, LANES, Radii};
use super::past::Past;
use super::scenario::PlanarError;
use crate::state::{Damaged, Reader, State};
use std::collections::VecDeque;

/// How many layers a run used, and what they left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layers {
    /// The most that were in use.
    pub most: usize,
    /// How often center or number were changed.
    pub changes: u64,
    /// Bound of the error of f and of v `f_y` that their finite number brings about, for every visit within reach.
    pub error: f64,
}

/// The center follows the middle of all that can be felt, visits and tip; layers are as many as hold for them. A step that
/// leads beyond is cut short.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    width: f64,
    /// Largest error of the layers.
    allowed: f64,
    center: f64,
    radii: Radii,
    /// Of one group of layers, of two, as many as have been asked for.
    known: Vec<Radii>,
    extent: Extent,
    /// Of those before, as long as there are visits left of them.
    cuts: VecDeque<Cut>,
    layers: Layers,
}

/// A change of center or number: layers of what was there before were cut off.
#[derive(Debug, Clone, Copy)]
struct Cut {
    /// Where the tip was.
    x: f64,
    /// What was cut off, wherever the tip goes.
    error: f64,
}

/// Beyond visits and tip there is to be this room for a step, in widths, and this part of their distance.
const LEAST_ROOM: (f64, f64) = (0.15, 0.35);
/// So much more of it, where layers are chosen anew; twice that, where they are given up.
const SPARE_ROOM: (f64, f64) = (0.1, 0.1);

impl Frame {
    /// For a Gaussian of this width across, and a footprint of this reach along.
    pub(super) fn new(width: f64, reach: f64, allowed: f64) -> Self {
        Self {
            width,
            allowed,
            center: 0.0,
            radii: Radii { tip: 0.0, visits: 0.0 },
            known: vec![],
            extent: Extent::new(reach),
            cuts: VecDeque::new(),
            layers: Layers { most: 0, changes: 0, error: allowed },
        }
    }

    /// v
    pub(super) fn width(&self) -> f64 {
        self.width
    }

    /// η of a place.
    pub(super) fn eta(&self, y: f64) -> f64 {
        (y - self.center) / self.width
    }

    /// How far the tip may be from the center, in widths.
    pub(super) fn radius(&self) -> f64 {
        self.radii.tip
    }

    pub(super) fn layers(&self) -> Layers {
        self.layers
    }

    pub(super) fn save(&self, state: &mut State) {
        state.number(self.center);
        self.extent.save(state);
        let cuts: Vec<(f64, f64)> = self.cuts.iter().map(|cut| (cut.x, cut.error)).collect();
        state.pairs(cuts.iter());
        state.count(self.layers.most as u64);
        state.count(self.layers.changes);
        state.number(self.layers.error);
    }

    /// That of so many groups of layers.
    pub(super) fn restore(&mut self, state: &mut Reader, groups: usize) -> Result<(), Damaged> {
        self.center = state.finite()?;
        self.extent.restore(state)?;
        self.cuts = state.pairs()?.into_iter().map(|(x, error)| Cut { x, error }).collect();
        self.layers = Layers {
            most: usize::try_from(state.count()?).map_err(|_| Damaged::OutOfRange)?,
            changes: state.count()?.min(u64::MAX / 2),
            error: state.finite()?,
        };
        while self.known.len() < groups {
            let count = LANES * (self.known.len() + 1);
            self.known.push(Radii::of(count, self.allowed).ok_or(Damaged::OutOfRange)?);
        }
        self.radii = self.known[groups - 1];
        Ok(())
    }

    /// Numbers that range and cuts consist of.
    pub(super) fn size(&self) -> usize {
        4 * self.extent.bins() + 2 * self.cuts.len()
    }

    /// Chooses the layers for visits up to `x.0` and between `low` and `high`, and for a tip that goes on from `x.1` within them,
    /// if those in use do not suit them or are too many. To be told before the visits are remembered.
    pub(super) fn visit(
        &mut self,
        past: &mut Past,
        t: f64,
        x: (f64, f64),
        (low, high): (f64, f64),
    ) -> Result<(), PlanarError> {
        let farthest =
            |frame: &Self, (low, high): (f64, f64)| frame.eta(low).abs().max(frame.eta(high).abs());
        let before = self.extent.about(x.1);
        self.extent.add(x.0, (low, high));
        let (low, high) = before.map_or((low, high), |(a, b)| (low.min(a), high.max(b)));
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low) / self.width);
        let groups = past.groups();
        let spare = SPARE_ROOM.0 + SPARE_ROOM.1 * half;
        let is_lean = groups <= 1 || !suits(&self.known[groups - 2], half + 2.0 * spare);
        if suits(&self.radii, farthest(self, (low, high))) && is_lean {
            return Ok(());
        }
        let range = 2.0 * half;
        let needed = self.groups(half + spare).ok_or(PlanarError::Range { t, range })?;
        if let Some(before) = before {
            let error = layers::error_of_visits(farthest(self, before), LANES * groups);
            self.cut(x.1, error);
        }
        // The more layers, the less is cut off.
        past.resize(needed.max(groups));
        past.recenter((middle - self.center) / self.width);
        past.resize(needed);
        (self.center, self.radii) = (middle, self.known[needed - 1]);
        self.layers.most = self.layers.most.max(LANES * needed);
        Ok(())
    }

    /// The fewest groups of layers that suit visits and a tip at this distance.
    fn groups(&mut self, distance: f64) -> Option<usize> {
        while self.known.last().is_none_or(|last| !suits(last, distance)) {
            let count = LANES * (self.known.len() + 1);
            self.known.push(Radii::of(count, self.allowed)?);
        }
        Some(1 + self.known.partition_point(|radii| !suits(radii, distance)))
    }

    /// Layers are cut off; cuts of which there are no visits left are forgotten.
    fn cut(&mut self, x: f64, error: f64) {
        let reach = self.extent.reach();
        while self.cuts.front().is_some_and(|cut| cut.x < x - reach) {
            self.cuts.pop_front();
        }
        self.cuts.push_back(Cut { x, error });
        let before: f64 = self.cuts.iter().map(|cut| cut.error).sum();
        self.layers.error = self.layers.error.max(self.allowed + before);
        self.layers.changes += 1;
    }
}

/// Whether layers of these radii hold for visits at this distance, and for a tip that moves on from there.
fn suits(radii: &Radii, distance: f64) -> bool {
    distance <= radii.visits && distance + LEAST_ROOM.0 + LEAST_ROOM.1 * distance <= radii.tip
}
