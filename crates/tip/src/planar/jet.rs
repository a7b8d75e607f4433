//! Height, slopes and curvatures of a surface at a position.

use super::spline::Partials;

/// Height, slopes and curvatures at a point of a surface, of f, or of an integral over f.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Jet {
    /// Height u.
    pub height: f64,
    /// Slopes `u_x` and `u_y`.
    pub slope: [f64; 2],
    /// Curvatures `u_xx`, `u_xy` and `u_yy`.
    pub curvature: [f64; 3],
}

impl Jet {
    /// The jet with the derivatives up to the second order from `partials`.
    pub(super) fn of(partials: &Partials) -> Self {
        let at = |a: usize, b: usize| partials[a][b];
        Self {
            height: at(0, 0),
            slope: [at(1, 0), at(0, 1)],
            curvature: [at(2, 0), at(1, 1), at(0, 2)],
        }
    }

    pub(super) fn add(&mut self, factor: f64, jet: &Self) {
        self.height += factor * jet.height;
        self.slope.iter_mut().zip(jet.slope).for_each(|(sum, slope)| *sum += factor * slope);
        let curvatures = self.curvature.iter_mut().zip(jet.curvature);
        curvatures.for_each(|(sum, curvature)| *sum += factor * curvature);
    }

    pub(super) fn times(self, factor: f64) -> Self {
        Self {
            height: factor * self.height,
            slope: self.slope.map(|slope| factor * slope),
            curvature: self.curvature.map(|curvature| factor * curvature),
        }
    }
}
