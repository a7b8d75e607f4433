//! u(x,y,t) of a tip that moves in both coordinates.

use crate::SurfaceError;
use ndarray::{Array1, Array2};
use rayon::prelude::*;
use stickslip_tip::planar::{PlanarError, PlanarScenario, Texture, Trajectory, Visit};
use stickslip_tip::{Layer, Start};

/// The surface of one run in two coordinates.
///
/// ```text
///     u(x,y,t) = u0(x,y) e^{-(t-t1)/T} - α ∫_{t1}^t w e^{-(t-t')/T} f(x - x0(t'), y - y0(t')) dt'
/// ```
#[derive(Debug)]
pub struct SurfaceAcross<'a> {
    scenario: &'a PlanarScenario,
    trajectory: &'a Trajectory,
    texture: Texture,
    layers: &'a [Layer],
}

impl<'a> SurfaceAcross<'a> {
    /// The surface of a tip that moved along `trajectory` in this scenario.
    ///
    /// # Errors
    /// The initial surface cannot be computed, or the footprint is f(x) alone.
    pub fn new(
        scenario: &'a PlanarScenario,
        trajectory: &'a Trajectory,
    ) -> Result<Self, PlanarError> {
        let footprint = scenario.along.model.tip().footprint().ok_or(PlanarError::NoFootprint)?;
        let (texture, layers) = (scenario.texture()?, footprint.layers());
        Ok(Self { scenario, trajectory, texture, layers })
    }

    /// u(x,y,t) at every y (rows) and every x (columns). For each x it sums over the visits within reach: the
    /// definition, to the accuracy of the trajectory.
    ///
    /// # Errors
    /// `t` is outside of the run; x or y is not finite.
    pub fn image(&self, t: f64, x: &[f64], y: &[f64]) -> Result<Array2<f64>, SurfaceError> {
        let (start, end) = (self.trajectory.start(), self.trajectory.end());
        if !(start..=end).contains(&t) {
            return Err(SurfaceError::OutsideRun { t, start, end });
        }
        if let Some(place) = x.iter().chain(y).find(|place| !place.is_finite()) {
            return Err(SurfaceError::Position(*place));
        }
        let mut visits = self.trajectory.residence(t);
        visits.sort_by(|a, b| a.x.total_cmp(&b.x));
        let left = self.scenario.along.model.wider().left_after(t - start);
        let columns: Vec<Array1<f64>> =
            x.par_iter().map(|x| self.column(&visits, left, *x, y)).collect();
        Ok(Array2::from_shape_fn((y.len(), x.len()), |(j, i)| columns[i][j]))
    }

    /// u at every y of one x; `left` is the undecayed part of the initial surface.
    fn column(&self, visits: &[Visit], left: f64, x: f64, y: &[f64]) -> Array1<f64> {
        let along = &self.scenario.along;
        let (model, position) = (&along.model, along.start_position);
        let mut column: Array1<f64> = y.iter().map(|y| left * self.texture.height(x, *y)).collect();
        for layer in self.layers {
            let reach = layer.along.reach().unwrap_or(f64::INFINITY);
            let from = visits.partition_point(|visit| visit.x < x - reach);
            let within = visits[from..].iter().take_while(|visit| visit.x <= x + reach);
            let carved: Vec<(f64, f64)> =
                within.map(|v| (v.y, v.weight * layer.along.value(x - v.x))).collect();
            let steady = match along.start {
                Start::Steady => {
                    let tail = layer.along.fading_tail(x - position, model.fading());
                    left * model.steady_density() * tail
                }
                Start::Flat => 0.0,
            };
            for (u, y) in column.iter_mut().zip(y) {
                let of = |(there, weight): &(f64, f64)| weight * layer.across.value(y - there);
                let sum: f64 = carved.iter().map(of).sum();
                *u -= model.alpha() * sum + steady * layer.across.value(*y);
            }
        }
        column
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Surface;
    use stickslip_tip::{Footprint, Model, Scenario, TipFunction, Wider, planar, run};

    fn scenario(wider: Wider, stiffness: f64, kick_across: f64) -> PlanarScenario {
        let along = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let tip = TipFunction::of_footprint(Footprint::separable(along, 1.0).unwrap());
        let model = Model::under(wider, tip, 1.2, 1.0).unwrap();
        let along = Scenario { kick: 0.05, ..Scenario::new(model, 40.0) };
        PlanarScenario { kick_across, ..PlanarScenario::new(along, stiffness) }
    }

    /// The height under the tip is what the integrator knows of it, from its own memory.
    #[test]
    fn under_the_tip_it_is_the_height_of_the_run() {
        let wider = Wider { depth_limit: Some(4.0), healing_time: Some(20.0), ..Wider::default() };
        let scenario = scenario(wider, 0.3, 0.3);
        let trajectory = planar::run(&scenario).unwrap().trajectory;
        let surface = SurfaceAcross::new(&scenario, &trajectory).unwrap();
        for t in [trajectory.start(), 17.3, 24.0, 31.7, 40.0] {
            let told = trajectory.height(t).unwrap();
            let u = surface.image(t, &[trajectory.x0(t)], &[trajectory.y0(t)]).unwrap()[(0, 0)];
            assert!((u - told).abs() < 2e-8, "{t}: {u} {told}");
        }
    }

    /// Of a tip that stays on its line it is the surface of one coordinate.
    #[test]
    fn on_the_line_it_is_that_of_one_coordinate() {
        let scenario = scenario(Wider::default(), 1.0, 0.0);
        let trajectory = planar::run(&scenario).unwrap().trajectory;
        let surface = SurfaceAcross::new(&scenario, &trajectory).unwrap();
        let x: Vec<f64> = (0..120).map(|i| 5.0 + 0.3 * f64::from(i)).collect();
        let y = [-1.3, 0.0, 0.4, 2.0];
        let image = surface.image(37.0, &x, &y).unwrap();
        let one = run(&scenario.along).unwrap();
        let footprint = scenario.along.model.tip().footprint().unwrap();
        let line = Surface::new(&scenario.along.model, &one.initial_surface, &one.trajectory);
        let known = line.image(footprint, 37.0, &x, &y).unwrap();
        let worst = image.iter().zip(&known).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 2e-8, "{worst:e}");
        assert!(
            surface.image(41.0, &x, &y).is_err() && surface.image(37.0, &[f64::NAN], &y).is_err()
        );
    }
}
