//! The memory of a tip in two coordinates: exponentials, and a lattice for retreats beyond their range of validity; or
//! the lattice alone.

use super::lattice::Lattice;
use super::layers::Lanes;
use super::modes::{Jet, Modes};
use crate::memory::SteadyPast;
use crate::state::{Damaged, Reader, State};

/// Exponentials and, if there is one, a lattice with the same past; or a lattice without exponentials.
#[derive(Debug, Clone)]
pub(super) struct Past {
    modes: Option<Modes>,
    lattice: Option<Lattice>,
    /// Whether the lattice is in use in the present step.
    goes_back: bool,
}

/// Distance of a tip behind its farthest point, and the largest allowed distance.
pub(super) struct TooFar {
    pub(super) behind: f64,
    pub(super) allowed: f64,
}

impl Past {
    /// An empty memory.
    pub(super) fn new(modes: Modes, lattice: Option<Lattice>) -> Self {
        Self { modes: Some(modes), lattice, goes_back: false }
    }

    /// An empty memory without exponentials.
    pub(super) fn of_lattice(lattice: Lattice) -> Self {
        Self { modes: None, lattice: Some(lattice), goes_back: true }
    }

    /// Chooses between the two for a step from the present position of the tip.
    pub(super) fn begin(&mut self) -> Result<(), TooFar> {
        let behind = self.behind();
        let of_modes = self.modes.as_ref().map_or(f64::NEG_INFINITY, Modes::retreat_between_steps);
        self.goes_back = self.modes.is_none() || behind > of_modes;
        let allowed = self.lattice.as_ref().map_or(of_modes, Lattice::retreat);
        if self.goes_back && behind > allowed { Err(TooFar { behind, allowed }) } else { Ok(()) }
    }

    /// Whether [`derivatives`](Self::derivatives) of any order are available.
    pub(super) fn knows_series(&self) -> bool {
        !self.goes_back
    }

    /// Derivatives from the exponentials, if these are in use.
    pub(super) fn derivatives(&self, factor: f64, told: &mut [Lanes]) {
        self.modes.iter().for_each(|modes| modes.derivatives(factor, told));
    }

    /// Derivatives of g at 0, from the sum of exponentials.
    pub(super) fn of_tip(&self) -> &[f64] {
        self.modes.as_ref().map_or(&[], Modes::of_tip)
    }

    /// The integrals of each layer over g, g' and g'' at a displacement from the tip.
    pub(super) fn at(&self, displacement: f64, jet: &mut Jet<'_>) {
        match (&self.lattice, &self.modes) {
            (Some(lattice), _) if self.goes_back => lattice.at(displacement, jet),
            (_, modes) => modes.iter().for_each(|modes| modes.at(displacement, jet)),
        }
    }

    /// The lowest displacement from the tip that a step may reach.
    pub(super) fn lowest(&self, farthest: f64) -> f64 {
        let lattice = self.lattice.as_ref().filter(|_| self.goes_back);
        let of_modes = || self.modes.as_ref().map_or(0.0, Modes::retreat);
        farthest - lattice.map_or_else(of_modes, Lattice::retreat)
    }

    /// Distance of the tip behind its farthest point.
    pub(super) fn behind(&self) -> f64 {
        let of_lattice = || self.lattice.as_ref().map_or(f64::NEG_INFINITY, Lattice::behind);
        self.modes.as_ref().map_or_else(of_lattice, Modes::behind)
    }

    /// Number of groups of lanes that contain the layers.
    pub(super) fn groups(&self) -> usize {
        let of_lattice = || self.lattice.as_ref().map_or(0, Lattice::groups);
        self.modes.as_ref().map_or_else(of_lattice, Modes::groups)
    }

    /// Changes the number of layers; new layers are 0.
    pub(super) fn resize(&mut self, groups: usize) {
        self.modes.iter_mut().for_each(|modes| modes.resize(groups));
        self.lattice.iter_mut().for_each(|lattice| lattice.resize(groups));
    }

    /// Moves the center of the layers by a number of widths.
    pub(super) fn recenter(&mut self, distance: f64) {
        self.modes.iter_mut().for_each(|modes| modes.recenter(distance));
        self.lattice.iter_mut().for_each(|lattice| lattice.recenter(distance));
    }

    /// Multiplies the whole past by a factor.
    pub(super) fn fade(&mut self, factor: f64) {
        self.modes.iter_mut().for_each(|modes| modes.fade(factor));
        self.lattice.iter_mut().for_each(|lattice| lattice.fade(factor));
    }

    /// Adds a steady past on a line with these layers.
    pub(super) fn remember_steady(&mut self, past: &SteadyPast, phi: &[Lanes]) {
        self.modes.iter_mut().for_each(|modes| modes.remember_steady(past, phi));
        self.lattice.iter_mut().for_each(|lattice| lattice.remember_steady(past, phi));
    }

    /// Adds nodes, given as displacements from the tip, which then is at the last of them. `weighted` contains the
    /// layers of each node multiplied by its weight.
    pub(super) fn remember(&mut self, position: &[f64], weighted: &[Lanes]) {
        self.modes.iter_mut().for_each(|modes| modes.remember(position, weighted));
        self.lattice.iter_mut().for_each(|lattice| lattice.remember(position, weighted));
    }

    pub(super) fn save(&self, state: &mut State) {
        self.modes.iter().for_each(|modes| modes.save(state));
        self.lattice.iter().for_each(|lattice| lattice.save(state));
    }

    pub(super) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        // States are of runs with exponentials.
        let modes = self.modes.as_mut().ok_or(Damaged::OutOfRange)?;
        modes.restore(state)?;
        match &mut self.lattice {
            Some(lattice) => lattice.restore(state, modes.groups()),
            None => Ok(()),
        }
    }

    /// Number of real numbers in the memory.
    pub(super) fn size(&self) -> usize {
        self.modes.as_ref().map_or(0, Modes::size) + self.lattice.as_ref().map_or(0, Lattice::size)
    }
}
