//! Images u(x,y,t) under the wider law, against quadrature of what the law says: each visit weighed by the height under
//! the tip, all of it fading, from a steady past without beginning on. The judge shares the trajectory with what it
//! judges, and nothing else.

use gauss_quad::legendre::GaussLegendre;
use std::num::NonZeroUsize;
use stickslip_surface::Surface;
use stickslip_tip::{Footprint, Gaussian2d, Model, Scenario, TipFunction, Trajectory, Wider, run};

/// A pit with walls, no product of functions of x and y.
fn terms() -> Vec<Gaussian2d> {
    let bump = |amplitude, (center, center_y), (width, width_y)| Gaussian2d {
        amplitude,
        center,
        width,
        center_y,
        width_y,
    };
    let mut terms = vec![bump(1.0, (0.0, 0.0), (1.0, 0.8))];
    for side in [-1.0, 1.0] {
        terms.push(bump(-0.2, (2.0 * side, 0.0), (1.0, 1.2)));
        terms.push(bump(-0.1, (0.0, 1.5 * side), (0.9, 0.5)));
    }
    terms
}

fn value(x: f64, y: f64) -> f64 {
    let term = |g: &Gaussian2d| {
        let (z, q) = ((x - g.center) / g.width, (y - g.center_y) / g.width_y);
        g.amplitude * (-0.5 * (z * z + q * q)).exp()
    };
    terms().iter().map(term).sum()
}

/// ∫ of a function by five-point rules on so many panels.
fn integral((from, to): (f64, f64), panels: u32, of: impl Fn(f64) -> f64) -> f64 {
    let rule = GaussLegendre::new(NonZeroUsize::new(5).unwrap());
    let width = (to - from) / f64::from(panels);
    let panel = |n: u32| -> f64 {
        let at = |node: f64| of(from + width * (f64::from(n) + 0.5 * (1.0 + node)));
        rule.as_node_weight_pairs()
            .iter()
            .map(|(node, weight)| 0.5 * width * weight * at(*node))
            .sum()
    };
    (0..panels).map(panel).sum()
}

/// What the run has carved, and what is left of what it began with.
fn by_quadrature(model: &Model, trajectory: &Trajectory, (x, y): (f64, f64), start: f64) -> f64 {
    let (wider, from, to) = (model.wider(), trajectory.start(), trajectory.end());
    let left = |since: f64| wider.healing_time.map_or(1.0, |time| (-since / time).exp());
    let weight = |t: f64| match (wider.depth_limit, trajectory.height(t)) {
        (Some(limit), Some(height)) => (-height.abs() / limit).exp(),
        _ => 1.0,
    };
    let visit = |t: f64| weight(t) * left(to - t) * value(x - trajectory.x0(t), y);
    let carved: f64 =
        trajectory.steps().iter().map(|step| integral((step.t, step.end()), 40, visit)).sum();
    // In steady motion at r the tip was at start - rτ a time τ before, with the weight of its steady height.
    let steady =
        wider.depth_limit.map_or(1.0, |limit| (-model.steady_height().abs() / limit).exp());
    let before = integral((0.0, 40.0 / model.r()), 4000, |since| {
        left(since) * value(x - start + model.r() * since, y)
    });
    -model.alpha() * (carved + steady * left(to - from) * before)
}

#[test]
fn images_are_those_of_visits_weighed_and_faded() {
    let footprint = Footprint::gaussian_sum(&terms()).unwrap();
    let tip = TipFunction::of_footprint(footprint.clone());
    for (depth_limit, healing_time, inertia) in [
        (None, None, None),
        (Some(3.0), None, None),
        (None, Some(8.0), None),
        (None, None, Some(0.4)),
        (Some(2.0), Some(12.0), Some(0.3)),
    ] {
        let wider = Wider { depth_limit, healing_time, inertia, spring: true };
        let model = Model::under(wider, tip.clone(), 1.6, 0.9).unwrap();
        let mut scenario = Scenario::new(model.clone(), 45.0);
        (scenario.kick, scenario.tolerance) = (0.2, 1e-11);
        let (run, initial) = (run(&scenario).unwrap(), scenario.initial_surface().unwrap());
        let (trajectory, start) = (&run.trajectory, initial.steady_position().unwrap());
        let surface = Surface::new(&model, &initial, trajectory);
        let front = trajectory.x0(trajectory.end());
        let x: Vec<f64> = [-25.0, -9.0, -2.0, -0.3, 0.0, 0.7, 3.0].map(|d| front + d).to_vec();
        // Beside where the run began too.
        let x = [x, vec![start - 6.0, start - 1.0, start + 2.0]].concat();
        let y = [-2.1, 0.0, 0.6];
        let image = surface.image(&footprint, trajectory.end(), &x, &y).unwrap();
        let mut largest = 0.0_f64;
        for (j, y) in y.iter().enumerate() {
            for (i, x) in x.iter().enumerate() {
                let judged = by_quadrature(&model, trajectory, (*x, *y), start);
                largest = largest.max((image[(j, i)] - judged).abs());
            }
        }
        println!("{wider:?}: {largest:.1e}");
        assert!(largest < 1e-9, "{wider:?}: {largest:e}");
        // Along the path it is the curve that the tip has left.
        let curve = surface.heights(trajectory.end(), &x).unwrap();
        let off = curve.iter().zip(image.row(1)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-11, "{wider:?}: {off:e}");
    }
}
