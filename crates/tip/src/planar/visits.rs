//! The memory `direct` in two coordinates: the definition, a sum of f over all positions within reach.

use super::jet::Jet;
use crate::TipFunction;
use crate::memory::{Fading, Record, SteadyPast};
use crate::state::{Damaged, Reader, State};

/// All positions of the tip.
#[derive(Debug)]
pub(super) struct Visits {
    /// Positions along the scan, with weights.
    record: Record,
    /// y of each position.
    across: Vec<f64>,
    fading: Fading,
    /// The past before the first position, on the line y = 0.
    steady: Option<SteadyPast>,
}

impl Visits {
    /// An empty history for this shape along the scan.
    pub(super) fn new(along: &TipFunction) -> Self {
        let record = Record::whole(along);
        Self { record, across: vec![], fading: Fading::default(), steady: None }
    }

    /// Adds a steady past on the line y = 0.
    pub(super) fn remember_steady(&mut self, past: &SteadyPast) {
        self.steady = Some(*past);
    }

    /// Adds positions with these weights, given as displacements from the tip at `y`, and moves the tip to the last
    /// one.
    pub(super) fn remember(&mut self, (along, across): (&[f64], &[f64]), weights: &[f64], y: f64) {
        let left = self.fading.left().unwrap_or(1.0);
        let weights: Vec<f64> = weights.iter().map(|weight| weight / left).collect();
        self.record.remember(along, &weights);
        self.across.extend(across.iter().map(|e| y + e));
        if let Some((past, moved)) = self.steady.as_mut().zip(along.last()) {
            past.distance += moved;
        }
    }

    pub(super) fn fade(&mut self, factor: f64) {
        if let Some(scale) = self.fading.by(factor) {
            self.record.scale(scale);
        }
        self.steady.iter_mut().for_each(|past| past.weight *= factor);
    }

    /// The sum of `of_visit` over all positions, and of `of_past` for the steady past: at a displacement d from the tip
    /// along the scan, and at y across it.
    pub(super) fn at(
        &self,
        (d, y): (f64, f64),
        of_visit: impl Fn(f64, f64) -> Jet,
        of_past: impl Fn(&SteadyPast) -> Jet,
    ) -> Jet {
        let x = self.record.position() + d;
        let mut sum = Jet::default();
        for places in self.record.places_near(x, x) {
            let nodes = self.record.nodes()[places.clone()].iter().zip(&self.across[places]);
            for ((position, weight), across) in nodes {
                sum.add(*weight, &of_visit(x - position, y - across));
            }
        }
        let mut all = self.steady.as_ref().map_or_else(Jet::default, of_past);
        all.add(self.fading.left().unwrap_or(1.0), &sum);
        all
    }

    pub(super) fn size(&self) -> usize {
        3 * self.across.len()
    }

    pub(super) fn save(&self, state: &mut State) {
        self.record.save(state);
        state.numbers(self.across.iter().copied());
        self.fading.save(state);
        save_steady(self.steady.as_ref(), state);
    }

    pub(super) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.record.restore(state)?;
        self.across = state.numbers()?;
        self.fading.restore(state)?;
        restore_steady(self.steady.as_mut(), state)?;
        let is_whole = self.across.len() == self.record.nodes().len();
        if is_whole { Ok(()) } else { Err(Damaged::OutOfRange) }
    }
}

/// Writes those data of a steady past that change in a run.
pub(super) fn save_steady(past: Option<&SteadyPast>, state: &mut State) {
    if let Some(past) = past {
        state.number(past.distance);
        state.number(past.weight);
    }
}

pub(super) fn restore_steady(
    past: Option<&mut SteadyPast>,
    state: &mut Reader,
) -> Result<(), Damaged> {
    if let Some(past) = past {
        (past.distance, past.weight) = (state.finite()?, state.finite()?);
    }
    Ok(())
}
