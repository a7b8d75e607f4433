//! The interface of a memory of the layers of one product.

use super::layers::Lanes;
use crate::memory::SteadyPast;
use crate::state::{Damaged, Reader, State};

/// For each layer the integrals over g, g' and g'', `∫ w φ_m(η') g(x - x') dt'` and so on.
pub(super) type Integrals<'a> = [&'a mut [Lanes]; 3];

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

    /// Adds a steady past on a line with the layers `phi`.
    fn remember_steady(&mut self, past: &SteadyPast, phi: &[Lanes]);

    /// Adds nodes, given as displacements from the tip, and moves the tip to the last one. `weighted` contains the
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
