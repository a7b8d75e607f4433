//! The groove as a memory evaluates it.

use crate::TipFunction;

/// Results of a memory: integrals over the past, one number for each requested point.
#[derive(Debug)]
pub struct Groove<'a> {
    /// ∫ f'(x - x0(t'))dt'
    pub slope: &'a mut [f64],
    /// ∫ f''(x - x0(t'))dt'
    pub curvature: &'a mut [f64],
    /// ∫ f(x - x0(t'))dt', on request; it doubles the cost.
    pub height: Option<&'a mut [f64]>,
}

impl<'a> Groove<'a> {
    /// Room for slope and curvature only.
    pub fn new(slope: &'a mut [f64], curvature: &'a mut [f64]) -> Self {
        Self { slope, curvature, height: None }
    }

    /// Adds room for the height.
    #[must_use]
    pub fn with_height(self, height: &'a mut [f64]) -> Self {
        Self { height: Some(height), ..self }
    }

    pub(super) fn scale(&mut self, factor: f64) {
        let height = self.height.iter_mut().flat_map(|height| height.iter_mut());
        let told = self.slope.iter_mut().chain(self.curvature.iter_mut()).chain(height);
        told.for_each(|told| *told *= factor);
    }

    pub(super) fn clear(&mut self) {
        self.slope.fill(0.0);
        self.curvature.fill(0.0);
        self.height.iter_mut().for_each(|height| height.fill(0.0));
    }
}

/// Largest distance from the tip, ahead or behind, at which a memory evaluates the groove: 4.6 widths of a Gaussian.
/// The integrator rejects steps that would lead further.
pub fn longest_look(tip: &TipFunction) -> f64 {
    (40.0 / tip.band()).min(12.0)
}
