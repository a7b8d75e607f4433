//! Do the full PDE on a grid and the closed equation describe the same motion, and does each grid come
//! to it at its own order? The reference is the closed equation with the direct memory (the definition)
//! at a tolerance of 1e-12; the judged are the grids of crates/grid, which knows nothing of it and is
//! given f as a function. That crate's own tests hold the grids against each other and closed forms.

use crate::acceptance::{Acceptance, observed_order};
use std::f64::consts::PI;
use stickslip_grid::{
    Footprint, Gaussian, Method, Problem, Request, Start, Stepping, solve_observed,
};
use stickslip_surface::Surface;
use stickslip_tip::{InitialSurface, MemoryChoice, Model, Scenario, TipFunction, Trajectory, run};

const ALPHA: f64 = 1.2;
const KICK: f64 = 0.05;
const POSITION: f64 = 14.0;
const SPAN: f64 = 20.0;

/// The closed equation's motion and surface.
struct Reference {
    model: Model,
    initial: InitialSurface,
    trajectory: Trajectory,
}

impl Reference {
    /// At this α: the tests' own α, or another where they should fail.
    fn new(alpha: f64) -> Self {
        let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), alpha, 1.0);
        let model = model.unwrap();
        let start = Scenario::new(model.clone(), 1e3).start_time();
        let scenario = Scenario {
            kick: KICK,
            tolerance: 1e-12,
            memory: MemoryChoice::Direct,
            ..Scenario::new(model, start + SPAN)
        };
        let run = run(&scenario).unwrap();
        Self { model: scenario.model, initial: run.initial_surface, trajectory: run.trajectory }
    }

    /// Largest distance of a grid's x0 at all of its steps, and of its u at the end.
    fn distance(&self, method: &Method, stepping: &Stepping) -> (f64, f64) {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let f = |x: f64| tip.value(x);
        let footprint = Footprint::new(&f, 10.8).unwrap();
        let start = Start::steady(ALPHA, 1.0, footprint, POSITION, KICK);
        let end = [start.time + SPAN];
        let problem = Problem::new(ALPHA, 1.0, footprint, start).unwrap();
        let points: Vec<f64> = (0..60).map(|k| 10.0 + 0.7 * f64::from(k)).collect();
        let request = Request { times: &end, points: &points };
        let mut motion = vec![];
        let grid = solve_observed(&problem, method, stepping, &request, &mut |t, x0| {
            motion.push((t, x0));
            std::ops::ControlFlow::Continue(())
        });
        let surface = Surface::new(&self.model, &self.initial, &self.trajectory);
        let u = surface.heights(end[0].min(self.trajectory.end()), &points).unwrap();
        let largest = |distances: &mut dyn Iterator<Item = f64>| distances.fold(0.0, f64::max);
        (
            largest(&mut motion.iter().map(|(t, x0)| (x0 - self.trajectory.x0(*t)).abs())),
            largest(&mut grid.unwrap().u.iter().zip(&u).map(|(a, b)| (a - b).abs())),
        )
    }
}

/// Both orders over a ladder of five and more lie in the range.
fn assert_orders(name: &str, ladder: &[(f64, (f64, f64))], range: std::ops::Range<f64>) {
    let column = |pick: fn(&(f64, f64)) -> f64| -> Vec<(f64, f64)> {
        ladder.iter().map(|(h, errors)| (*h, pick(errors))).collect()
    };
    for (what, points) in [("x0", column(|e| e.0)), ("u", column(|e| e.1))] {
        let order = observed_order(&points);
        println!("{name}, {what}: order {order:.2}, errors {points:?}");
        assert!(range.contains(&order), "{name}, {what}: order {order}, {points:?}");
    }
}

const SPACINGS: [f64; 5] = [0.1, 0.05, 0.025, 0.0125, 0.00625];

/// Steps of 0.04 as in the paper: their own error is far below that of the spacing.
fn second_order(reference: &Reference, method: impl Fn(f64) -> Method) -> [(f64, (f64, f64)); 5] {
    SPACINGS.map(|h| (h, reference.distance(&method(h), &Stepping::fixed(0.04))))
}

fn uniform(spacing: f64) -> Method {
    Method::Uniform { spacing, from: 3.0, to: 46.0 }
}

#[test]
fn the_uniform_and_the_windowed_grid_come_to_the_closed_equation_at_order_2() {
    let reference = Reference::new(ALPHA);
    let windowed = |spacing| Method::Windowed { spacing };
    assert_orders("uniform", &second_order(&reference, uniform), 1.9..2.1);
    assert_orders("windowed", &second_order(&reference, windowed), 1.9..2.1);
    // Negative control: of another α, no refinement comes nearer.
    let other = second_order(&Reference::new(ALPHA + 1e-3), windowed);
    let order = observed_order(&other.map(|(h, (x0, _))| (h, x0)));
    assert!(order < 1.5, "{order}, {other:?}");
}

fn spectral(spacing: f64) -> Method {
    let term = |amplitude, center| Gaussian { amplitude, center, width: 1.0 };
    Method::Spectral { gaussians: vec![term(1.0, 0.0), term(-0.5, 2.0), term(-0.5, -2.0)], spacing }
}

/// In space their error is round-off, so the order is that of Dormand and Prince's 8(5,3).
#[test]
fn the_spectral_and_the_sinc_grid_come_to_it_at_order_8_in_time() {
    let reference = Reference::new(ALPHA);
    let sinc = Method::Sinc { spacing: 0.36, half_width: 80 };
    for (name, method) in [("spectral", spectral(PI / 8.7)), ("sinc", sinc)] {
        let ladder = [43, 51, 61, 73, 87, 103].map(|n| {
            let h = SPAN / f64::from(n);
            (h, reference.distance(&method, &Stepping::fixed(h)))
        });
        assert_orders(name, &ladder, 7.6..8.6);
    }
}

/// Aliasing: 2 exp(-π²/2h²) of the lattice's own slope, and nothing else, until round-off.
#[test]
fn the_spectral_grid_comes_to_it_exponentially_in_space() {
    let reference = Reference::new(ALPHA);
    let allowed = Acceptance { floor: 1e-11, slack: 10.0 };
    for h in [0.7_f64, 0.6, 0.5, 0.43, 0.36] {
        let (x0, u) = reference.distance(&spectral(h), &Stepping::absolute(1e-13));
        let predicted = 2.0 * (-0.5 * (PI / h).powi(2)).exp();
        allowed.judge(&format!("spacing {h}"), x0.max(u), predicted);
    }
    let (x0, _) = reference.distance(&spectral(0.8), &Stepping::absolute(1e-13));
    assert!(x0 > 1e-5, "a wide lattice is seen to be wrong: {x0:e}");
}
