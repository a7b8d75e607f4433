//! The memory of a tip in two coordinates: exponentials, and a lattice for one that goes back farther than they hold.

use super::lattice::Lattice;
use super::layers::Lanes;
use super::modes::{Jet, Modes};
use crate::memory::SteadyPast;
use crate::state::{Damaged, Reader, State};

/// Both remember the same, where there is a lattice.
#[derive(Debug, Clone)]
pub(super) struct Past {
    modes: Modes,
    lattice: Option<Lattice>,
    /// Whether the lattice answers in the step under way.
    goes_back: bool,
}

/// How far behind its farthest point a tip is, and how far it may be.
pub(super) struct TooFar {
    pub(super) behind: f64,
    pub(super) allowed: f64,
}

impl Past {
    /// Nothing remembered yet.
    pub(super) fn new(modes: Modes, lattice: Option<Lattice>) -> Self {
        Self { modes, lattice, goes_back: false }
    }

    /// Decides which of the two answers in a step from where the tip is.
    pub(super) fn begin(&mut self) -> Result<(), TooFar> {
        let behind = self.modes.behind();
        self.goes_back = behind > self.modes.retreat_between_steps();
        let lattice = self.lattice.as_ref().map(Lattice::retreat);
        let allowed = lattice.unwrap_or(self.modes.retreat_between_steps());
        if self.goes_back && behind > allowed { Err(TooFar { behind, allowed }) } else { Ok(()) }
    }

    /// Whether it knows [`derivatives`](Self::derivatives) of any order.
    pub(super) fn knows_series(&self) -> bool {
        !self.goes_back
    }

    /// The exponentials, if they answer.
    pub(super) fn derivatives(&self, factor: f64, told: &mut [Lanes]) {
        self.modes.derivatives(factor, told);
    }

    /// Derivatives of g at 0, as the exponentials have them.
    pub(super) fn of_tip(&self) -> &[f64] {
        self.modes.of_tip()
    }

    /// The integrals of each layer over g, g' and g'' at a displacement from the tip.
    pub(super) fn at(&self, displacement: f64, jet: &mut Jet<'_>) {
        match &self.lattice {
            Some(lattice) if self.goes_back => lattice.at(displacement, jet),
            _ => self.modes.at(displacement, jet),
        }
    }

    /// The lowest displacement from the tip that a step may lead to.
    pub(super) fn lowest(&self, farthest: f64) -> f64 {
        let lattice = self.lattice.as_ref().filter(|_| self.goes_back);
        farthest - lattice.map_or(self.modes.retreat(), Lattice::retreat)
    }

    /// How far behind its farthest point the tip is.
    pub(super) fn behind(&self) -> f64 {
        self.modes.behind()
    }

    /// The layers as groups of lanes.
    pub(super) fn groups(&self) -> usize {
        self.modes.groups()
    }

    /// Another number of layers: new ones hold nothing.
    pub(super) fn resize(&mut self, groups: usize) {
        self.modes.resize(groups);
        self.lattice.iter_mut().for_each(|lattice| lattice.resize(groups));
    }

    /// The center of the layers moves by so many widths.
    pub(super) fn recenter(&mut self, distance: f64) {
        self.modes.recenter(distance);
        self.lattice.iter_mut().for_each(|lattice| lattice.recenter(distance));
    }

    /// All that is remembered times a factor.
    pub(super) fn fade(&mut self, factor: f64) {
        self.modes.fade(factor);
        self.lattice.iter_mut().for_each(|lattice| lattice.fade(factor));
    }

    /// Remembers a steady past on a line, of which these are the layers.
    pub(super) fn remember_steady(&mut self, past: &SteadyPast, phi: &[Lanes]) {
        self.modes.remember_steady(past, phi);
        self.lattice.iter_mut().for_each(|lattice| lattice.remember_steady(past, phi));
    }

    /// Remembers visits, displacements from the tip, which then stands at the last of them: of each the layers times what it
    /// weighs.
    pub(super) fn remember(&mut self, position: &[f64], weighted: &[Lanes]) {
        self.modes.remember(position, weighted);
        self.lattice.iter_mut().for_each(|lattice| lattice.remember(position, weighted));
    }

    pub(super) fn save(&self, state: &mut State) {
        self.modes.save(state);
        self.lattice.iter().for_each(|lattice| lattice.save(state));
    }

    pub(super) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.modes.restore(state)?;
        match &mut self.lattice {
            Some(lattice) => lattice.restore(state, self.modes.groups()),
            None => Ok(()),
        }
    }

    /// Numbers that it consists of.
    pub(super) fn size(&self) -> usize {
        self.modes.size() + self.lattice.as_ref().map_or(0, Lattice::size)
    }
}
