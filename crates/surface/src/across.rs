//! The surface u(x,y,t) carved by a tip that moves in both coordinates.

use crate::SurfaceError;
use ndarray::Array2;
use rayon::prelude::*;
use stickslip_tip::planar::{PlanarError, PlanarScenario, Texture, Trajectory, Visit};
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::{Layer, Start};

/// The surface of one run in two coordinates.
///
/// ```text
///     u(x,y,t) = u0(x,y) e^{-(t-t1)/T} - α ∫_{t1}^t w e^{-(t-t')/T} f(x - x0(t'), y - y0(t')) dt'
/// ```
///
/// with the indentation rate α w and the healing time T.
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

    /// u(x,y,t) at every y (rows) and every x (columns). Each value is a direct sum over the visits within reach of x,
    /// as accurate as the trajectory.
    ///
    /// # Errors
    /// `t` is outside of the run; x or y is not finite.
    pub fn image(&self, t: f64, x: &[f64], y: &[f64]) -> Result<Array2<f64>, SurfaceError> {
        SurfaceError::check_time(self.trajectory, t)?;
        SurfaceError::check_positions(x.iter().chain(y))?;
        let mut visits = self.trajectory.residence(t);
        sort_by_number(&mut visits, |item| item.x);
        let left = self.scenario.along.model.wider().left_after(t - self.trajectory.start());
        let reach = self.layers.iter().map(reach).fold(0.0, f64::max);
        let near: Vec<&[f64]> = x
            .chunk_by(|a, b| (b - a).abs() < CLOSE * reach)
            .flat_map(|near| near.chunks(COLUMNS))
            .collect();
        let columns: Vec<Vec<f64>> =
            near.par_iter().flat_map_iter(|x| self.columns(&visits, left, x, y)).collect();
        Ok(Array2::from_shape_fn((y.len(), x.len()), |(j, i)| columns[i][j]))
    }

    /// u at every y, for each of the neighbouring `x`; `left` is the undecayed fraction of the initial surface.
    fn columns(&self, visits: &[Visit], left: f64, x: &[f64], y: &[f64]) -> Vec<Vec<f64>> {
        let along = &self.scenario.along;
        let (model, position) = (&along.model, along.start_position);
        let initial = |x| y.iter().map(|y| left * self.texture.height(x, *y)).collect();
        let mut columns: Vec<Vec<f64>> = x.iter().copied().map(initial).collect();
        for layer in self.layers {
            let profile: Vec<f64> = y.iter().map(|y| layer.across.value(*y)).collect();
            let carved = carved_across(layer, visits, x, y);
            for ((column, carved), x) in columns.iter_mut().zip(carved).zip(x) {
                let steady = match along.start {
                    Start::Steady => {
                        let tail = layer.along.fading_tail(x - position, model.fading());
                        left * model.steady_density() * tail
                    }
                    Start::Flat => 0.0,
                };
                for ((u, sum), across) in column.iter_mut().zip(carved).zip(&profile) {
                    *u -= model.alpha() * sum + steady * across;
                }
            }
        }
        columns
    }
}

/// Largest number of neighbouring columns that share the profile of a visit.
const COLUMNS: usize = 32;
/// Largest distance between adjacent columns that share profiles, relative to the reach of the tip.
const CLOSE: f64 = 0.25;
/// Number of visits whose profiles are kept at a time.
const VISITS: usize = 256;

fn reach(layer: &Layer) -> f64 {
    layer.along.reach().unwrap_or(f64::INFINITY)
}

/// Σ weight g(x - x0) h(y - y0) over the visits within reach, for the layer g(x) h(y). The result has one vector for
/// each x, with one value for each y. `visits` must be sorted by x0.
pub fn carved_across(layer: &Layer, visits: &[Visit], x: &[f64], y: &[f64]) -> Vec<Vec<f64>> {
    let reach = reach(layer);
    let low = x.iter().copied().fold(f64::INFINITY, f64::min) - reach;
    let high = x.iter().copied().fold(f64::NEG_INFINITY, f64::max) + reach;
    let from = visits.partition_point(|visit| visit.x < low);
    let to = visits.partition_point(|visit| visit.x <= high);
    let mut sums = vec![vec![0.0; y.len()]; x.len()];
    for visits in visits[from..to].chunks(VISITS) {
        let profile = |visit: &Visit| -> Vec<f64> {
            y.iter().map(|y| layer.across.value(y - visit.y)).collect()
        };
        let profiles: Vec<Vec<f64>> = visits.iter().map(profile).collect();
        for (sums, x) in sums.iter_mut().zip(x) {
            let from = visits.partition_point(|visit| visit.x < x - reach);
            let within = visits.iter().zip(&profiles).skip(from);
            for (visit, profile) in within.take_while(|(visit, _)| visit.x <= x + reach) {
                let weight = visit.weight * layer.along.value(x - visit.x);
                sums.iter_mut().zip(profile).for_each(|(sum, across)| *sum += weight * across);
            }
        }
    }
    sums
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

    /// Steady motion leaves the profile (24), known in closed form, however fast the surface heals.
    #[test]
    fn where_it_heals_within_a_step_it_is_that_of_steady_motion() {
        let x: Vec<f64> = (0..60).map(|i| 35.0 + 0.1 * f64::from(i)).collect();
        for time in [3.0, 0.3, 0.1, 0.03, 0.01, 0.001] {
            let wider = Wider { healing_time: Some(time), ..Wider::default() };
            let scenario = scenario(wider, 1.0, 0.0);
            let along = Scenario { kick: 0.0, ..scenario.along.clone() };
            let scenario = PlanarScenario { along, ..scenario };
            let model = &scenario.along.model;
            let one = run(&scenario.along).unwrap();
            let surface = Surface::new(model, &one.initial_surface, &one.trajectory);
            let u = surface.heights(40.0, &x).unwrap();
            let both = planar::run(&scenario).unwrap().trajectory;
            let across = SurfaceAcross::new(&scenario, &both).unwrap();
            let v = across.image(40.0, &x, &[0.0]).unwrap();
            let behind = |x: &f64| x - one.trajectory.x0(40.0);
            let groove = |x: f64| model.tip().fading_tail(x, model.fading());
            let known: Vec<f64> =
                x.iter().map(|x| -model.steady_density() * groove(behind(x))).collect();
            let worst = |u: &[f64]| {
                u.iter().zip(&known).map(|(u, known)| (u - known).abs()).fold(0.0, f64::max)
            };
            let (line, plane) = (worst(u.as_slice().unwrap()), worst(v.as_slice().unwrap()));
            println!("{time}: {line:e} {plane:e}");
            assert!(line < 1e-11 && plane < 1e-11, "{time}: {line:e} {plane:e}");
        }
    }
}
