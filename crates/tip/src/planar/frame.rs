//! Layers in use: their center and number.

use super::extent::Extent;
use super::layers::{self, LANES, Radii};
use super::past::Past;
use super::scenario::PlanarError;
use crate::state::{Damaged, Reader, State};
use std::collections::VecDeque;

/// Number of layers in a run, and their error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layers {
    /// Largest number of layers in use at any time of the run.
    pub most: usize,
    /// Number of changes of the center or the number of layers.
    pub changes: u64,
    /// Bound on the error of f and of v `f_y` due to the finite number of layers, for every position within reach.
    pub error: f64,
}

/// Center and number of the layers. The center follows the middle of the tip and of all positions within reach, and the
/// number of layers is sufficient for them. A step that would leave the range of the layers is shortened.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    width: f64,
    /// Whether a position acts on a tip that is far from it across: then the layers suffice for a tip anywhere.
    is_wide: bool,
    /// Largest error of the layers.
    allowed: f64,
    center: f64,
    radii: Radii,
    /// Radii for one group of layers, for two groups and so on, as far as they have been needed.
    known: Vec<Radii>,
    extent: Extent,
    /// Changes whose effect is still within reach.
    cuts: VecDeque<Cut>,
    layers: Layers,
}

/// A change of the center or number, which truncates the layers of the past.
#[derive(Debug, Clone, Copy)]
struct Cut {
    /// Position of the tip.
    x: f64,
    /// Error due to the truncation, for any later position of the tip.
    error: f64,
}

/// Least room for a step beyond past positions and tip: in widths, and as a fraction of their distance.
const LEAST_ROOM: (f64, f64) = (0.15, 0.35);
/// Additional room for newly chosen layers, in the same units; twice this room before layers are removed.
const SPARE_ROOM: (f64, f64) = (0.1, 0.1);

impl Frame {
    /// A frame for a function h(y) of Gaussians of this width, and a footprint of this reach along the scan. `is_wide`
    /// is false for a single Gaussian about 0.
    pub(super) fn new((width, is_wide): (f64, bool), reach: f64, allowed: f64) -> Self {
        Self {
            width,
            is_wide,
            allowed,
            center: 0.0,
            radii: Radii { tip: 0.0, visits: 0.0 },
            known: vec![],
            extent: Extent::new(reach),
            cuts: VecDeque::new(),
            layers: Layers { most: 0, changes: 0, error: allowed },
        }
    }

    /// A frame for a memory that has no layers: any position is within it.
    pub(super) fn without_layers(width: f64, reach: f64) -> Self {
        let radii = Radii { tip: f64::INFINITY, visits: f64::INFINITY };
        let frame = Self::new((width, false), reach, 0.0);
        Self { radii, known: vec![radii], ..frame }
    }

    /// η of a position y.
    pub(super) fn eta(&self, y: f64) -> f64 {
        (y - self.center) / self.width
    }

    /// Largest distance of the tip from the center, in widths.
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

    /// Reads a frame of this number of groups of layers.
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
            self.know_next().ok_or(Damaged::OutOfRange)?;
        }
        if groups > 0 {
            self.radii = self.known[groups - 1];
        }
        Ok(())
    }

    /// Number of real numbers in the range and the changes.
    pub(super) fn size(&self) -> usize {
        4 * self.extent.bins() + 2 * self.cuts.len()
    }

    /// Chooses the layers for past positions up to `x.0`, between `low` and `high`, and for a tip that continues from
    /// `x.1` within them. It keeps the present layers if they are sufficient and not too many. Must be called before
    /// the positions are added to the past.
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

    /// The smallest sufficient number of groups of layers for past positions and a tip at this distance.
    fn groups(&mut self, distance: f64) -> Option<usize> {
        while self.known.last().is_none_or(|last| !suits(last, distance)) {
            self.know_next()?;
        }
        Some(1 + self.known.partition_point(|radii| !suits(radii, distance)))
    }

    /// Adds the radii for one more group of layers; `None` beyond the largest number.
    fn know_next(&mut self) -> Option<()> {
        let radii = Radii::of(LANES * (self.known.len() + 1), self.allowed)?;
        self.known.push(if self.is_wide { radii.for_any_tip() } else { radii });
        Some(())
    }

    /// Records a truncation of layers, and removes truncations that are out of reach.
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

/// Whether layers of these radii are sufficient for past positions at this distance, and for a tip that moves on from
/// there.
fn suits(radii: &Radii, distance: f64) -> bool {
    distance <= radii.visits && distance + LEAST_ROOM.0 + LEAST_ROOM.1 * distance <= radii.tip
}
