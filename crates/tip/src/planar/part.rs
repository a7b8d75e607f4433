//! The memory of one product g(x) h(y) of the footprint: the past, and the layers that represent it.

use super::bells::Bells;
use super::fields::Fields;
use super::frame::Frame;
use super::jet::Jet;
use super::lattice::Lattice;
use super::layered::Layered;
use super::layers::{LANES, Lanes, dot, values};
use super::modes::Modes;
use super::past::Past;
use super::products::Product;
use super::visits::Visits;
use crate::TipFunction;
use crate::memory::{Fit, FitError, Retreat, SteadyPast};
use crate::state::{Damaged, Reader, State};

/// The factors g and h, and the past.
pub(super) struct Part {
    pub(super) along: TipFunction,
    pub(super) bells: Bells,
    pub(super) past: Past,
    pub(super) frame: Frame,
    /// All positions, if the past is not stored in layers.
    visits: Option<Visits>,
    /// Factor from the error of the layers of a single Gaussian to that of f.
    size: f64,
}

/// Largest factor by which the error of exponentials may exceed its share if no better fit exists. The error then
/// amounts to three quarters of the tolerance.
const MOST_SLACK: f64 = 30.0;

#[derive(Debug, Clone, Copy)]
pub(super) enum Storage {
    /// Exponentials that allow for this retreat, with a lattice for retreats beyond it or without one.
    Modes(Retreat, bool),
    /// Densities, convolved by FFT.
    Fft,
    /// All positions.
    Direct,
}

impl Part {
    pub(super) fn new(product: &Product, storage: Storage) -> Result<Self, FitError> {
        let Product { along, bells, size, slope_error, layer_error } = product;
        let lattice = || Lattice::new(along).map(|lattice| Box::new(lattice) as Box<dyn Layered>);
        let past = match storage {
            Storage::Modes(back, with_lattice) => {
                let fit = Fit::cached(along, *slope_error, back).or_else(|error| match error {
                    // A narrow lattice, of a table of many rows.
                    FitError::NotMet { reached, .. } if reached <= MOST_SLACK * slope_error => {
                        Fit::cached(along, MOST_SLACK * slope_error, back)
                    }
                    error => Err(error),
                });
                Past::new(Modes::new(fit?), lattice().filter(|_| with_lattice))
            }
            Storage::Fft => Past::without_modes(Some(Box::new(Fields::new(along)))),
            Storage::Direct => Past::without_modes(None),
        };
        let visits = matches!(storage, Storage::Direct).then(|| Visits::new(along));
        let reach = along.reach().ok_or(FitError::NeverFades)?;
        let frame = match visits {
            Some(_) => Frame::without_layers(bells.width(), reach),
            None => Frame::new((bells.width(), !bells.is_single()), reach, *layer_error),
        };
        Ok(Self { along: along.clone(), bells: bells.clone(), past, frame, visits, size: *size })
    }

    pub(super) fn save(&self, state: &mut State) {
        self.past.save(state);
        self.visits.iter().for_each(|visits| visits.save(state));
        self.frame.save(state);
    }

    pub(super) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.past.restore(state)?;
        self.visits.iter_mut().try_for_each(|visits| visits.restore(state))?;
        self.frame.restore(state, self.past.groups())
    }

    pub(super) fn memory_size(&self) -> usize {
        self.past.size() + self.visits.as_ref().map_or(0, Visits::size) + self.frame.size()
    }

    /// Bound on the error of f and v `f_y` due to the layers.
    pub(super) fn error(&self) -> f64 {
        self.size * self.frame.layers().error
    }

    /// Adds a steady past on the line y = 0.
    pub(super) fn remember_steady(&mut self, past: &SteadyPast) {
        if let Some(visits) = &mut self.visits {
            return visits.remember_steady(past);
        }
        let mut phi = vec![[0.0; LANES]; self.past.groups()];
        values(self.frame.eta(0.0), 1.0, &mut phi);
        self.past.remember_steady(past, &phi);
    }

    /// Adds positions with these weights, given as displacements from the tip at `y`, and moves the tip to the last
    /// one; `left` is the undecayed part of the past.
    pub(super) fn remember(
        &mut self,
        (along, across): (&[f64], &[f64]),
        weights: &[f64],
        (y, left): (f64, f64),
        room: &mut Vec<Lanes>,
    ) {
        if let Some(visits) = &mut self.visits {
            visits.fade(left);
            return visits.remember((along, across), weights, y);
        }
        let groups = self.past.groups();
        room.resize(groups * along.len(), [0.0; LANES]);
        for ((layers, e), weight) in room.chunks_exact_mut(groups).zip(across).zip(weights) {
            values(self.frame.eta(y + e), *weight, layers);
        }
        if left < 1.0 {
            self.past.fade(left);
        }
        self.past.remember(along, room);
    }

    /// ∫ g h over the past at a displacement d from the tip along the scan, at y across it.
    pub(super) fn at(&self, d: f64, y: f64, room: &mut Room) -> Jet {
        if let Some(visits) = &self.visits {
            let of_past = |past: &SteadyPast| self.of_line(past.groove(&self.along, d), y);
            return visits.at((d, y), |x, y| self.of_visit(x, y), of_past);
        }
        let groups = self.past.groups();
        let Room { layers, scratch } = room;
        layers.resize(5 * groups, [0.0; LANES]);
        let (of_place, of_past) = layers[..5 * groups].split_at_mut(2 * groups);
        let (phi, slope) = of_place.split_at_mut(groups);
        let (value, rest) = of_past.split_at_mut(groups);
        let (first, second) = rest.split_at_mut(groups);
        let (eta, v) = (self.frame.eta(y), self.bells.width());
        self.bells.read(eta, phi, slope, scratch);
        self.past.at(d, &mut [&mut *value, &mut *first, &mut *second]);
        let bend = self.bells.bend(eta, groups, scratch);
        Jet {
            height: dot(phi, value),
            slope: [dot(phi, first), dot(slope, value) / v],
            curvature: [dot(phi, second), dot(slope, first) / v, dot(bend, value) / (v * v)],
        }
    }

    /// g h and its derivatives at (x, y).
    pub(super) fn of_visit(&self, x: f64, y: f64) -> Jet {
        let (g, (g1, g2)) = (self.along.value(x), self.along.slope_and_curvature(x));
        self.of_line([g, g1, g2], y)
    }

    /// As [`of_visit`](Self::of_visit), for given values of g and its two derivatives.
    fn of_line(&self, [g, g1, g2]: [f64; 3], y: f64) -> Jet {
        let [h, h1, h2] = self.bells.jet(y);
        Jet { height: g * h, slope: [g1 * h, g * h1], curvature: [g2 * h, g1 * h1, g * h2] }
    }
}

/// The sum of jets of all products of the footprint.
pub(super) fn sum(parts: &[Part], of: impl FnMut(&Part) -> Jet) -> Jet {
    let mut sum = Jet::default();
    parts.iter().map(of).for_each(|jet| sum.add(1.0, &jet));
    sum
}

#[derive(Debug, Clone, Default)]
pub(super) struct Room {
    layers: Vec<Lanes>,
    scratch: Vec<Lanes>,
}
