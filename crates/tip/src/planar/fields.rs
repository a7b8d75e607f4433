//! The memory `fft` in two coordinates: for each layer a density of positions along the scan, convolved with g by FFT.
//!
//! It is valid for motion in both directions and for any g. A change of the center applies the matrix T of the
//! [layers](super::layers) to the densities of all layers, cell by cell.

use super::layered::{Integrals, Layered};
use super::layers::{LANES, Lanes, recenter};
use super::visits::{restore_steady, save_steady};
use crate::TipFunction;
use crate::memory::{Fading, Fft, SteadyPast};
use crate::state::{Damaged, Reader, State};

/// The densities of all layers.
pub(super) struct Fields {
    along: TipFunction,
    layers: Vec<Fft>,
    fading: Fading,
    /// The past before the first node, and its layers.
    steady: Option<SteadyPast>,
    of_steady: Vec<Lanes>,
    /// The farthest-forward position, as a displacement from the tip.
    farthest: f64,
    /// Scratch space for the weights of one layer.
    room: Vec<f64>,
}

impl Fields {
    /// An empty memory for this shape along the scan.
    pub(super) fn new(along: &TipFunction) -> Self {
        Self {
            along: along.clone(),
            layers: vec![],
            fading: Fading::default(),
            steady: None,
            of_steady: vec![],
            farthest: f64::NEG_INFINITY,
            room: vec![],
        }
    }

    fn prepare(&mut self) {
        self.layers.iter_mut().for_each(Fft::prepare);
    }
}

impl Layered for Fields {
    fn groups(&self) -> usize {
        self.layers.len() / LANES
    }

    fn resize(&mut self, groups: usize) {
        let count = groups * LANES;
        // All of them fold their nodes, and move their origin, at the same time.
        Fft::mix(&mut self.layers, |_| {});
        self.layers.truncate(count);
        while self.layers.len() < count {
            let new = match self.layers.first() {
                Some(first) => first.empty_copy(),
                None => Fft::new(&self.along, std::iter::empty()),
            };
            self.layers.push(new);
        }
        self.of_steady.resize(groups, [0.0; LANES]);
        self.prepare();
    }

    fn recenter(&mut self, distance: f64) {
        let groups = self.groups();
        if groups > 0 {
            let change = |cells: &mut [f64]| recenter(distance, cells.as_chunks_mut().0, groups);
            Fft::mix(&mut self.layers, change);
            recenter(distance, &mut self.of_steady, groups);
            self.prepare();
        }
    }

    fn fade(&mut self, factor: f64) {
        if let Some(scale) = self.fading.by(factor) {
            self.layers.iter_mut().for_each(|layer| layer.scale(scale));
            self.prepare();
        }
        self.steady.iter_mut().for_each(|past| past.weight *= factor);
    }

    fn remember_steady(&mut self, past: &SteadyPast, phi: &[Lanes]) {
        (self.steady, self.of_steady) = (Some(*past), phi.to_vec());
        self.farthest = self.farthest.max(-past.distance);
    }

    fn remember(&mut self, position: &[f64], weighted: &[Lanes]) {
        let Some(moved) = position.last() else { return };
        let (count, left) = (self.layers.len(), self.fading.left().unwrap_or(1.0));
        let weighted = weighted.as_flattened();
        for (m, layer) in self.layers.iter_mut().enumerate() {
            self.room.clear();
            self.room.extend(weighted.iter().skip(m).step_by(count).map(|weight| weight / left));
            layer.remember(position, &self.room);
            layer.prepare();
        }
        self.steady.iter_mut().for_each(|past| past.distance += moved);
        self.farthest = position.iter().copied().fold(self.farthest, f64::max) - moved;
    }

    fn at(&self, displacement: f64, jet: &mut Integrals<'_>) {
        let left = self.fading.left().unwrap_or(1.0);
        let of_steady = self.steady.map_or([0.0; 3], |past| past.groove(&self.along, displacement));
        for (row, of_past) in jet.iter_mut().zip(of_steady) {
            let all = row.as_flattened_mut().iter_mut().zip(self.of_steady.as_flattened());
            all.for_each(|(entry, phi)| *entry = of_past * phi);
        }
        for (m, layer) in self.layers.iter().enumerate() {
            for (row, of_layer) in jet.iter_mut().zip(layer.jet(displacement)) {
                row.as_flattened_mut()[m] += left * of_layer;
            }
        }
    }

    fn retreat(&self) -> f64 {
        self.layers.first().map_or(0.0, Fft::retreat)
    }

    fn behind(&self) -> f64 {
        self.farthest
    }

    fn size(&self) -> usize {
        self.layers.iter().map(Fft::size).sum()
    }

    fn save(&self, state: &mut State) {
        state.count(self.layers.len() as u64);
        self.layers.iter().for_each(|layer| layer.save(None, state));
        self.fading.save(state);
        save_steady(self.steady.as_ref(), state);
        state.numbers(self.of_steady.as_flattened().iter().copied());
        state.number(self.farthest);
    }

    fn restore(&mut self, state: &mut Reader, _: Option<usize>) -> Result<(), Damaged> {
        let count = state.length(LANES)?;
        if count == 0 || !count.is_multiple_of(LANES) {
            return Err(Damaged::OutOfRange);
        }
        self.layers.clear();
        for _ in 0..count {
            let mut layer = Fft::new(&self.along, std::iter::empty());
            layer.restore(state)?;
            layer.prepare();
            self.layers.push(layer);
        }
        self.fading.restore(state)?;
        restore_steady(self.steady.as_mut(), state)?;
        self.of_steady = state.numbers()?.as_chunks::<LANES>().0.to_vec();
        self.farthest = state.number()?;
        let is_whole = self.of_steady.len() == self.groups();
        if is_whole { Ok(()) } else { Err(Damaged::OutOfRange) }
    }
}
