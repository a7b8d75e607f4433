//! The memory of the layers of one product: exponentials, with a lattice for retreats beyond their range of validity; or a
//! memory without exponentials.

use super::layers::Lanes;
use super::modes::{Integrals, Modes};
use crate::memory::SteadyPast;
use crate::state::{Damaged, Reader, State};

/// A memory of layers that is valid for motion in both directions.
pub(super) trait Layered {
    /// Number of groups of lanes that contain the layers.
    fn groups(&self) -> usize;

    /// Changes the number of layers; new layers are 0.
    fn resize(&mut self, groups: usize);

    /// Moves the center of the layers by a number of widths.
    fn recenter(&mut self, distance: f64);

    /// Multiplies the whole past by a factor.
    fn fade(&mut self, factor: f64);

    /// Adds a steady past on a line with these layers.
    fn remember_steady(&mut self, past: &SteadyPast, phi: &[Lanes]);

    /// Adds nodes, given as displacements from the tip, which then is at the last of them. `weighted` contains the
    /// layers of each node multiplied by its weight.
    fn remember(&mut self, position: &[f64], weighted: &[Lanes]);

    /// The integrals of each layer over g, g' and g'' at a displacement from the tip.
    fn at(&self, displacement: f64, jet: &mut Integrals<'_>);

    /// Largest allowed distance of the tip behind its farthest point.
    fn retreat(&self) -> f64;

    /// Distance of the tip behind its farthest point.
    fn behind(&self) -> f64;

    /// Number of real numbers in the memory.
    fn size(&self) -> usize;

    fn save(&self, state: &mut State);

    /// `groups` is the number of groups of exponentials with the same past, if there are any.
    fn restore(&mut self, state: &mut Reader, groups: Option<usize>) -> Result<(), Damaged>;
}

/// Exponentials and, if there is one, another memory with the same past; or one without exponentials.
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
    /// An empty memory.
    pub(super) fn new(modes: Modes, other: Option<Box<dyn Layered>>) -> Self {
        Self { modes: Some(modes), other, goes_back: false }
    }

    /// An empty memory without exponentials; `None`: positions are kept elsewhere.
    pub(super) fn without_modes(other: Option<Box<dyn Layered>>) -> Self {
        Self { modes: None, other, goes_back: true }
    }

    /// Chooses between the two for a step from the present position of the tip.
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

    /// The integrals of each layer over g, g' and g'' at a displacement from the tip.
    pub(super) fn at(&self, displacement: f64, jet: &mut Integrals<'_>) {
        match (&self.other, &self.modes) {
            (Some(other), _) if self.goes_back => other.at(displacement, jet),
            (_, modes) => modes.iter().for_each(|modes| modes.at(displacement, jet)),
        }
    }

    /// The lowest displacement from the tip that a step may reach.
    pub(super) fn lowest(&self, farthest: f64) -> f64 {
        let other = self.other.as_ref().filter(|_| self.goes_back);
        let of_modes = || self.modes.as_ref().map_or(f64::INFINITY, Modes::retreat);
        farthest - other.map_or_else(of_modes, |other| other.retreat())
    }

    /// Distance of the tip behind its farthest point; -∞ if no retreat is too far.
    pub(super) fn behind(&self) -> f64 {
        let of_other = || self.other.as_ref().map_or(f64::NEG_INFINITY, |other| other.behind());
        self.modes.as_ref().map_or_else(of_other, Modes::behind)
    }

    /// Number of groups of lanes that contain the layers.
    pub(super) fn groups(&self) -> usize {
        let of_other = || self.other.as_ref().map_or(0, |other| other.groups());
        self.modes.as_ref().map_or_else(of_other, Modes::groups)
    }

    /// Changes the number of layers; new layers are 0.
    pub(super) fn resize(&mut self, groups: usize) {
        self.modes.iter_mut().for_each(|modes| modes.resize(groups));
        self.other.iter_mut().for_each(|other| other.resize(groups));
    }

    /// Moves the center of the layers by a number of widths.
    pub(super) fn recenter(&mut self, distance: f64) {
        self.modes.iter_mut().for_each(|modes| modes.recenter(distance));
        self.other.iter_mut().for_each(|other| other.recenter(distance));
    }

    /// Multiplies the whole past by a factor.
    pub(super) fn fade(&mut self, factor: f64) {
        self.modes.iter_mut().for_each(|modes| modes.fade(factor));
        self.other.iter_mut().for_each(|other| other.fade(factor));
    }

    /// Adds a steady past on a line with these layers.
    pub(super) fn remember_steady(&mut self, past: &SteadyPast, phi: &[Lanes]) {
        self.modes.iter_mut().for_each(|modes| modes.remember_steady(past, phi));
        self.other.iter_mut().for_each(|other| other.remember_steady(past, phi));
    }

    /// Adds nodes as [`Layered::remember`].
    pub(super) fn remember(&mut self, position: &[f64], weighted: &[Lanes]) {
        self.modes.iter_mut().for_each(|modes| modes.remember(position, weighted));
        self.other.iter_mut().for_each(|other| other.remember(position, weighted));
    }

    pub(super) fn save(&self, state: &mut State) {
        self.modes.iter().for_each(|modes| modes.save(state));
        self.other.iter().for_each(|other| other.save(state));
    }

    pub(super) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        if let Some(modes) = &mut self.modes {
            modes.restore(state)?;
        }
        let groups = self.modes.as_ref().map(Modes::groups);
        self.other.iter_mut().try_for_each(|other| other.restore(state, groups))
    }

    /// Number of real numbers in the memory.
    pub(super) fn size(&self) -> usize {
        let of_other = self.other.as_ref().map_or(0, |other| other.size());
        self.modes.as_ref().map_or(0, Modes::size) + of_other
    }
}
