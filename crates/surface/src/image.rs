//! u(x,y,t): the surface in three dimensions, (56) integrated along the path of the tip.

use crate::{Surface, SurfaceError, carved};
use ndarray::{Array1, Array2, Axis};
use rayon::prelude::*;
use stickslip_tip::{Footprint, Layer};

impl Surface<'_> {
    /// u(x,y,t) at every y (rows) and every x (columns), for a tip with footprint f(x,y), of which the
    /// model's tip function is f(x,0).
    ///
    /// ```text
    ///     u(x,y,t) = u0(x,y) - α ∫_{t1}^t f(x - x0(t'), y)dt'
    /// ```
    ///
    /// In the extended model the integrand has the weight and the decay given in the [crate documentation](crate).
    /// Steady motion before the run carved with the same footprint. A given profile and noise, known on the path only,
    /// are assumed to be the same for all y. The cost is that of one surface u(x) for each layer of the footprint and
    /// one multiplication for each layer and pixel.
    ///
    /// # Errors
    /// `t` is outside of the run; x or y is not finite.
    pub fn image(
        &self,
        footprint: &Footprint,
        t: f64,
        x: &[f64],
        y: &[f64],
    ) -> Result<Array2<f64>, SurfaceError> {
        self.check(t, x, y)?;
        let left = self.trajectory.wider().left_after(t - self.trajectory.start());
        let before: Array1<f64> = x.iter().map(|x| left * self.initial.texture(*x)).collect();
        let steady = |layer: &Layer| self.steady_past(layer, x) * left;
        let mut image = self.layered(footprint, t, x, y, steady);
        image.axis_iter_mut(Axis(0)).for_each(|mut row| row += &before);
        Ok(image)
    }

    /// -α ∫_{t1}^t f(x - x0(t'), y)dt': the groove carved by time t, without the initial surface.
    ///
    /// # Errors
    /// As [`Self::image`].
    pub fn image_far_behind(
        &self,
        footprint: &Footprint,
        t: f64,
        x: &[f64],
        y: &[f64],
    ) -> Result<Array2<f64>, SurfaceError> {
        self.check(t, x, y)?;
        Ok(self.layered(footprint, t, x, y, |_| Array1::zeros(x.len())))
    }

    /// Σ_k h_k(y) (-α Σ_j w_j g_k(x - x_j) + `before`(k)) over the layers g_k(x) h_k(y) of the footprint.
    fn layered(
        &self,
        footprint: &Footprint,
        t: f64,
        x: &[f64],
        y: &[f64],
        before: impl Fn(&Layer) -> Array1<f64> + Sync,
    ) -> Array2<f64> {
        let layers = footprint.layers();
        let (positions, weights) = self.trajectory.residence(t);
        let profile = |layer: &Layer| {
            let sums = carved(&layer.along, &positions, &weights, x);
            before(layer) - sums * self.model.alpha()
        };
        let profiles: Vec<Array1<f64>> = layers.par_iter().map(profile).collect();
        let mut image = Array2::zeros((y.len(), x.len()));
        for (layer, profile) in layers.iter().zip(&profiles) {
            for (mut row, y) in image.outer_iter_mut().zip(y) {
                row.scaled_add(layer.across.value(*y), profile);
            }
        }
        image
    }

    /// The steady profile (24) at the start of the run, with the factor g(x) of the layer in place of f.
    fn steady_past(&self, layer: &Layer, x: &[f64]) -> Array1<f64> {
        let Some(position) = self.initial.steady_position() else {
            return Array1::zeros(x.len());
        };
        let (depth, fading) = (self.model.steady_density(), self.model.fading());
        let (all, reach) = (layer.along.integral(), layer.along.reach().unwrap_or(f64::INFINITY));
        let tail = |x: f64| match x - position {
            ahead if ahead > reach => 0.0,
            near if fading > 0.0 => layer.along.fading_tail(near, fading),
            behind if behind < -reach => all,
            near => layer.along.tail(near),
        };
        x.iter().map(|x| -depth * tail(*x)).collect()
    }

    fn check(&self, t: f64, x: &[f64], y: &[f64]) -> Result<(), SurfaceError> {
        SurfaceError::check_time(self.trajectory, t)?;
        SurfaceError::check_positions(x.iter().chain(y))
    }
}
