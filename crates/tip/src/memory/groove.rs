//! What a memory does: it remembers visits, lets them fade, and tells the groove.

use super::derivatives::{Derivatives, SteadyPast};
use crate::TipFunction;

/// Memory of the tip's past. Positions are displacements from where the tip stands now.
pub trait Memory {
    /// Remembers visits: the tip spent the time `weight[j]` at `position[j]`, and now stands at the last of
    /// these positions. A time may be multiplied by how strongly the tip indented then.
    fn remember(&mut self, position: &[f64], weight: &[f64]);

    /// Lets all that it remembers count by this factor, at most 1: a surface heals.
    fn fade(&mut self, factor: f64);

    /// Tells the groove at the points x = tip + `at`, each at most [`longest_look`] from the tip.
    fn groove(&mut self, at: &[f64], groove: &mut Groove<'_>);

    /// Tells `count` derivatives of the groove at the tip, with those of a steady past before it began; false if
    /// it knows no series that holds wherever the next step may lead.
    fn derivatives(&self, _: Option<&SteadyPast>, _count: usize, _: &mut Derivatives) -> bool {
        false
    }
}

/// What a memory tells: integrals over the remembered past, one number for each point asked about.
#[derive(Debug)]
pub struct Groove<'a> {
    /// ∫ f'(x - x0(t'))dt'
    pub slope: &'a mut [f64],
    /// ∫ f''(x - x0(t'))dt'
    pub curvature: &'a mut [f64],
    /// ∫ f(x - x0(t'))dt', for those who want it: it costs as much again.
    pub height: Option<&'a mut [f64]>,
}

impl<'a> Groove<'a> {
    /// Slope and curvature only.
    pub fn new(slope: &'a mut [f64], curvature: &'a mut [f64]) -> Self {
        Self { slope, curvature, height: None }
    }

    /// The height too.
    #[must_use]
    pub fn with_height(self, height: &'a mut [f64]) -> Self {
        Self { height: Some(height), ..self }
    }

    /// All of it times a factor.
    pub(super) fn scale(&mut self, factor: f64) {
        let height = self.height.iter_mut().flat_map(|height| height.iter_mut());
        let told = self.slope.iter_mut().chain(self.curvature.iter_mut()).chain(height);
        told.for_each(|told| *told *= factor);
    }

    /// Nothing carved.
    pub(super) fn clear(&mut self) {
        self.slope.fill(0.0);
        self.curvature.fill(0.0);
        self.height.iter_mut().for_each(|height| height.fill(0.0));
    }
}

/// The farthest from the tip that a memory is asked about the groove, ahead or behind: 4.6 widths of
/// a Gaussian. The integrator rejects steps that would lead further.
#[must_use]
pub fn longest_look(tip: &TipFunction) -> f64 {
    (40.0 / tip.band()).min(12.0)
}

/// Ends of the interval that these values span.
pub(super) fn range(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)))
}
