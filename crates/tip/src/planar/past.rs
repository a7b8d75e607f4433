//! The memory of the layers of one product: exponentials, with a lattice for retreats beyond their range of validity; or a
//! memory without exponentials.

use super::layered::{Integrals, Layered};
use super::layers::Lanes;
use super::modes::Modes;
use crate::memory::SteadyPast;
use crate::state::{Damaged, Reader, State};

/// Exponentials and, if there is one, another memory of the same past; or a memory without exponentials.
pub(super) struct Past {
    modes: Option<Modes>,
    other: Option<Box<dyn Layered>>,
    /// Whether the other memory is in use in the present step.
    goes_back: bool,
}

/// Distance of a tip behind its farthest point, and the largest allowed distance.
pub(super) struct TooFar {
    pub(super) behind: f64,
    pub(super) allowed: f64,
}

impl Past {
    pub(super) fn new(modes: Modes, other: Option<Box<dyn Layered>>) -> Self {
        Self { modes: Some(modes), other, goes_back: false }
    }

    /// An empty memory without exponentials; `other` is `None` if positions are kept elsewhere.
    pub(super) fn without_modes(other: Option<Box<dyn Layered>>) -> Self {
        Self { modes: None, other, goes_back: true }
    }

    /// All memories, the exponentials first.
    fn each(&self) -> impl Iterator<Item = &dyn Layered> {
        let modes = self.modes.iter().map(|modes| modes as &dyn Layered);
        modes.chain(self.other.as_deref())
    }

    fn each_mut(&mut self) -> impl Iterator<Item = &mut (dyn Layered + 'static)> {
        let modes = self.modes.iter_mut().map(|modes| modes as &mut dyn Layered);
        modes.chain(self.other.as_deref_mut())
    }

    /// The memory in use in the present step.
    fn in_use(&self) -> Option<&dyn Layered> {
        let other = self.other.as_deref().filter(|_| self.goes_back);
        other.or_else(|| self.modes.as_ref().map(|modes| modes as &dyn Layered))
    }

    /// Chooses the memory for a step from the present position of the tip.
    pub(super) fn begin(&mut self) -> Result<(), TooFar> {
        let behind = self.behind();
        let of_modes = self.modes.as_ref().map_or(f64::NEG_INFINITY, Modes::retreat_between_steps);
        self.goes_back = behind > of_modes || self.modes.is_none();
        let allowed = self.other.as_ref().map_or(of_modes, |other| other.retreat());
        if self.goes_back && behind > allowed { Err(TooFar { behind, allowed }) } else { Ok(()) }
    }

    /// Whether [`derivatives`](Self::derivatives) of any order are available.
    pub(super) fn knows_series(&self) -> bool {
        !self.goes_back
    }

    /// Derivatives from the exponentials, if these are in use.
    pub(super) fn derivatives(&self, factor: f64, of_layers: &mut [Lanes]) {
        self.modes.iter().for_each(|modes| modes.derivatives(factor, of_layers));
    }

    /// Derivatives of g at 0, from the sum of exponentials.
    pub(super) fn of_tip(&self) -> &[f64] {
        self.modes.as_ref().map_or(&[], Modes::of_tip)
    }

    pub(super) fn at(&self, displacement: f64, jet: &mut Integrals<'_>) {
        self.in_use().iter().for_each(|memory| memory.at(displacement, jet));
    }

    /// The lowest displacement from the tip that a step may reach.
    pub(super) fn lowest(&self, farthest: f64) -> f64 {
        farthest - self.in_use().map_or(f64::INFINITY, |memory| memory.retreat())
    }

    /// Distance of the tip behind its farthest point; -∞ if no retreat is too far.
    pub(super) fn behind(&self) -> f64 {
        self.each().next().map_or(f64::NEG_INFINITY, |memory| memory.behind())
    }

    pub(super) fn groups(&self) -> usize {
        self.each().next().map_or(0, |memory| memory.groups())
    }

    pub(super) fn resize(&mut self, groups: usize) {
        self.each_mut().for_each(|memory| memory.resize(groups));
    }

    pub(super) fn recenter(&mut self, distance: f64) {
        self.each_mut().for_each(|memory| memory.recenter(distance));
    }

    pub(super) fn fade(&mut self, factor: f64) {
        self.each_mut().for_each(|memory| memory.fade(factor));
    }

    pub(super) fn remember_steady(&mut self, past: &SteadyPast, phi: &[Lanes]) {
        self.each_mut().for_each(|memory| memory.remember_steady(past, phi));
    }

    pub(super) fn remember(&mut self, position: &[f64], weighted: &[Lanes]) {
        self.each_mut().for_each(|memory| memory.remember(position, weighted));
    }

    pub(super) fn save(&self, state: &mut State) {
        self.each().for_each(|memory| memory.save(state));
    }

    pub(super) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let mut groups = None;
        for memory in self.each_mut() {
            memory.restore(state, groups)?;
            groups = Some(memory.groups());
        }
        Ok(())
    }

    pub(super) fn size(&self) -> usize {
        self.each().map(|memory| memory.size()).sum()
    }
}
