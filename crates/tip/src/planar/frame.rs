//! Which layers are in use: their center, and how many there are.

use super::extent::Extent;
use super::layers::{self, LANES};
use super::modes::Modes;
use super::scenario::PlanarError;
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

/// The center follows the middle of all that can be felt, visits and tip; layers are as many as hold for tip and visits within
/// the radius. A step that leads beyond it is cut short there.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    width: f64,
    /// Largest error of the layers.
    allowed: f64,
    center: f64,
    radius: f64,
    /// Up to which radius so many groups of layers hold: as many as have been asked for.
    radii: Vec<f64>,
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
    center: f64,
    count: usize,
    /// The farthest visit before it from the center, and the farthest after it, in widths.
    visits: f64,
    tip: f64,
}

/// Beyond the half-range the radius is to leave this room, in widths, and this part of the half-range: the tip moves on, and
/// visits are felt from farther away than they were made.
const LEAST_ROOM: (f64, f64) = (0.15, 0.35);
/// So much more of it, where layers are chosen anew or given up.
const SPARE_ROOM: f64 = 0.15;

impl Frame {
    /// For a Gaussian of this width across, and a footprint of this reach along.
    pub(super) fn new(width: f64, reach: f64, allowed: f64) -> Self {
        Self {
            width,
            allowed,
            center: 0.0,
            radius: 0.0,
            radii: vec![],
            extent: Extent::new(reach),
            cuts: VecDeque::new(),
            layers: Layers { most: 0, changes: 0, error: 0.0 },
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
        self.radius
    }

    pub(super) fn layers(&self) -> Layers {
        Layers { error: self.error(), ..self.layers }
    }

    /// Numbers that range and cuts consist of.
    pub(super) fn size(&self) -> usize {
        4 * (self.extent.bins() + self.cuts.len())
    }

    /// The tip was there.
    pub(super) fn visit(&mut self, x: f64, y: f64) {
        self.extent.add(x, y);
        for cut in &mut self.cuts {
            cut.tip = cut.tip.max((y - cut.center).abs() / self.width);
        }
    }

    /// Chooses the layers for a tip that is there, if those in use no longer do or are too many.
    pub(super) fn follow(
        &mut self,
        modes: &mut Modes,
        t: f64,
        (x, y): (f64, f64),
    ) -> Result<(), PlanarError> {
        let (low, high) = self.extent.about(x, y);
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low) / self.width);
        let groups = modes.groups();
        let wanted = half + LEAST_ROOM.0 + LEAST_ROOM.1 * half;
        let farthest = self.eta(low).abs().max(self.eta(high).abs());
        let holds = farthest + wanted - half <= self.radius;
        let is_lean = groups <= 1 || wanted + 2.0 * SPARE_ROOM > self.radii[groups - 2];
        if holds && is_lean {
            return Ok(());
        }
        let range = 2.0 * half;
        let needed = self.groups(wanted + SPARE_ROOM).ok_or(PlanarError::Range { t, range })?;
        if groups > 0 {
            self.certify(x);
            let (count, tip) = (LANES * groups, self.eta(y).abs());
            self.cuts.push_back(Cut { x, center: self.center, count, visits: farthest, tip });
            self.layers.changes += 1;
        }
        // The more layers, the less is cut off.
        modes.resize(needed.max(groups));
        modes.recenter((middle - self.center) / self.width);
        modes.resize(needed);
        (self.center, self.radius) = (middle, self.radii[needed - 1]);
        self.layers.most = self.layers.most.max(LANES * needed);
        Ok(())
    }

    /// The groups of layers that hold up to this radius.
    fn groups(&mut self, radius: f64) -> Option<usize> {
        while self.radii.last().is_none_or(|last| *last < radius) {
            let count = LANES * (self.radii.len() + 1);
            self.radii.push(layers::radius(count, self.allowed)?);
        }
        Some(1 + self.radii.partition_point(|held| *held < radius))
    }

    /// What the layers left out up to here; cuts before which there are no visits left are forgotten.
    fn certify(&mut self, x: f64) {
        self.layers.error = self.error();
        let reach = self.extent.reach();
        while self.cuts.front().is_some_and(|cut| cut.x < x - reach) {
            self.cuts.pop_front();
        }
    }

    /// What the layers in use leave out, and of what was cut off before; the largest so far.
    fn error(&self) -> f64 {
        let of_cut = |cut: &Cut| layers::error(cut.visits, cut.tip, cut.count);
        let before: f64 = self.cuts.iter().map(of_cut).sum();
        self.layers.error.max(self.allowed + before)
    }
}
