//! Is the image that of (14), (56) for the f(x,y) given, and is f(x,0) what the tip moved by?
//!
//! Judges, all written here: quadrature of (56) on 40,000 panels of the run, which shares the trajectory
//! and the formula of f(x,y) with what it judges, and nothing else; (58), u2D(x,t)h(y), for separable
//! tips; sums of the two-dimensional Gaussians as given; and the linear equation of y0 stepped in time.

use crate::acceptance::Acceptance;
use chacha20::ChaCha8Rng;
use gauss_quad::legendre::GaussLegendre;
use rand::{RngExt, SeedableRng};
use std::num::NonZeroUsize;
use stickslip_surface::{Surface, SurfaceError, carved};
use stickslip_tip::{
    Footprint, Gaussian2d, InitialSurface, Model, Noise, Scenario, Start, TipFunction,
    TipFunctionError, Trajectory, run,
};

/// What is asked for, of heights of order one.
const HEIGHT: Acceptance = Acceptance { floor: 1e-10, slack: 0.0 };
/// Round-off of sums that are the same but for their order.
const ROUND_OFF: Acceptance = Acceptance { floor: 1e-12, slack: 0.0 };

fn bump(
    amplitude: f64,
    (center, center_y): (f64, f64),
    (width, width_y): (f64, f64),
) -> Gaussian2d {
    Gaussian2d { amplitude, center, width, center_y, width_y }
}

/// Even in both, and no product: a round pit, walls before and behind it, and beside it.
fn crater() -> Vec<Gaussian2d> {
    let mut terms = vec![bump(1.0, (0.0, 0.0), (1.0, 0.8))];
    for side in [-1.0, 1.0] {
        terms.push(bump(-0.3, (2.0 * side, 0.0), (1.0, 1.2)));
        terms.push(bump(-0.2, (0.0, 1.5 * side), (0.9, 0.5)));
        for end in [-1.0, 1.0] {
            terms.push(bump(0.05, (1.1 * end, 0.7 * side), (0.7, 0.5)));
        }
    }
    terms
}

fn value(terms: &[Gaussian2d], x: f64, y: f64) -> f64 {
    let term = |g: &Gaussian2d| {
        let (z, q) = ((x - g.center) / g.width, (y - g.center_y) / g.width_y);
        g.amplitude * (-0.5 * (z * z + q * q)).exp()
    };
    terms.iter().map(term).sum()
}

/// (56) integrated from the start to t by five-point rules on panels of a hundredth of a step.
fn brute_force(f: impl Fn(f64) -> f64, trajectory: &Trajectory, t: f64) -> f64 {
    let rule = GaussLegendre::new(NonZeroUsize::new(5).unwrap());
    let (start, panels) = (trajectory.start(), 40_000);
    let width = (t - start) / f64::from(panels);
    let mut sum = 0.0;
    for panel in 0..panels {
        for (node, weight) in rule.as_node_weight_pairs() {
            let then = start + width * (f64::from(panel) + 0.5 * (1.0 + node));
            sum += 0.5 * width * weight * f(trajectory.x0(then));
        }
    }
    sum
}

fn finished(scenario: &Scenario) -> (Trajectory, InitialSurface) {
    (run(scenario).unwrap().trajectory, scenario.initial_surface().unwrap())
}

#[test]
fn heights_at_random_points_are_the_integral_56() {
    let footprint = Footprint::gaussian_sum(&crater()).unwrap();
    let tip = TipFunction::of_footprint(footprint.clone());
    let model = Model::new(tip, 1.1, 0.9).unwrap();
    let scenario = Scenario { start: Start::Flat, tolerance: 1e-11, ..Scenario::new(model, 60.0) };
    let (trajectory, initial) = finished(&scenario);
    let surface = Surface::new(&scenario.model, &initial, &trajectory);
    let mut rng = ChaCha8Rng::seed_from_u64(56);
    for _ in 0..12 {
        let (x, y) = (rng.random_range(5.0..60.0), rng.random_range(-3.0..3.0));
        let t = rng.random_range(20.0..60.0);
        let exact = -1.1 * brute_force(|x0| value(&crater(), x - x0, y), &trajectory, t);
        let found = surface.image(&footprint, t, &[x], &[y]).unwrap()[[0, 0]];
        HEIGHT.judge(&format!("u({x:.3}, {y:.3}, {t:.3})"), (found - exact).abs(), 0.0);
        let section = brute_force(|x0| value(&crater(), x - x0, 0.0), &trajectory, t);
        // Away from the path f(x,0) is another function.
        assert!(y.abs() < 0.3 || (section * -1.1 - exact).abs() > 1e-4 || exact.abs() < 1e-3);
    }
}

/// -α Σ_j w_j f(x - x_j, y), row by row: one evaluation of f for each position of the tip and each pixel.
fn image_by_definition(
    model: &Model,
    trajectory: &Trajectory,
    footprint: &Footprint,
    (x, y): (&[f64], &[f64]),
) -> Vec<f64> {
    let (positions, weights) = trajectory.residence(trajectory.end());
    let along = || positions.iter().zip(&weights);
    let pixel = |x: &f64, y: &f64| -> f64 {
        along().map(|(p, w)| w * footprint.value(x - p, *y)).sum::<f64>() * -model.alpha()
    };
    y.iter().flat_map(|y| x.iter().map(|x| pixel(x, y)).collect::<Vec<_>>()).collect()
}

/// The layers with FFT, the definition without.
#[test]
fn the_image_is_that_of_the_definition() {
    let footprint = Footprint::gaussian_sum(&crater()).unwrap();
    let model = Model::new(TipFunction::of_footprint(footprint.clone()), 1.2, 1.0).unwrap();
    let scenario = Scenario { kick: 0.1, ..Scenario::new(model, 200.0) };
    let (trajectory, initial) = finished(&scenario);
    let surface = Surface::new(&scenario.model, &initial, &trajectory);
    let x: Vec<f64> = (0..900).map(|i| 10.0 + 0.2 * f64::from(i)).collect();
    let y = [-2.5, -0.4, 0.0, 1.0];
    let fast = surface.image_far_behind(&footprint, 200.0, &x, &y).unwrap();
    let slow = image_by_definition(&scenario.model, &trajectory, &footprint, (&x, &y));
    let worst = fast.iter().zip(&slow).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    ROUND_OFF.judge("image by layers", worst, 0.0);
    // Row y = 0 is the plane surface.
    let plane = surface.heights(200.0, &x).unwrap();
    let image = surface.image(&footprint, 200.0, &x, &[0.0]).unwrap();
    let worst = (&image.row(0) - &plane).iter().fold(0.0, |m: f64, d| m.max(d.abs()));
    ROUND_OFF.judge("y = 0", worst, 0.0);
}

/// (58), (60): direct integration of (56) against the plane surface times h(y).
#[test]
fn a_separable_tip_leaves_the_plane_surface_times_h() {
    let triple = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let tips = [triple, TipFunction::gaussian(1.0).unwrap(), TipFunction::Bessel];
    for (tip, alpha) in tips.into_iter().zip([1.1, 1.9, 0.9]) {
        let width = 1.3;
        let model = Model::new(tip.clone(), alpha, 1.0).unwrap();
        let scenario = Scenario { kick: 0.05, ..Scenario::new(model, 60.0) };
        let (trajectory, initial) = finished(&scenario);
        let surface = Surface::new(&scenario.model, &initial, &trajectory);
        let x: Vec<f64> = (0..120).map(|i| 0.5 * f64::from(i)).collect();
        let y = [-2.0, -0.7, 0.0, 0.3, 4.0];
        let footprint = Footprint::separable(tip.clone(), width).unwrap();
        let image = surface.image(&footprint, 60.0, &x, &y).unwrap();
        let direct = image_by_definition(&scenario.model, &trajectory, &footprint, (&x, &y));
        let carved_part = surface.image_far_behind(&footprint, 60.0, &x, &y).unwrap();
        let (plane, far) =
            (surface.heights(60.0, &x).unwrap(), surface.far_behind(60.0, &x).unwrap());
        let mut worst = [0.0_f64; 3];
        for (j, y) in y.iter().enumerate() {
            let h = (-y * y / (2.0 * width * width)).exp();
            for i in 0..x.len() {
                let differences = [
                    image[[j, i]] - plane[i] * h,
                    direct[j * x.len() + i] - far[i] * h,
                    carved_part[[j, i]] - far[i] * h,
                ];
                worst = std::array::from_fn(|k| worst[k].max(differences[k].abs()));
            }
        }
        for (name, worst) in ["image", "by definition", "far behind"].iter().zip(worst) {
            HEIGHT.judge(&format!("{name}, α = {alpha}"), worst, 0.0);
        }
    }
}

#[test]
fn a_separable_sum_of_gaussians_is_the_separable_tip() {
    let terms: Vec<Gaussian2d> = [(1.0, 0.0), (-0.5, -2.0), (-0.5, 2.0)]
        .map(|(amplitude, center)| bump(amplitude, (center, 0.0), (1.0, 0.7)))
        .into();
    let footprint = Footprint::gaussian_sum(&terms).unwrap();
    let triple = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    assert_eq!(footprint.layers().len(), 1);
    let separable = Footprint::separable(triple.clone(), 0.7).unwrap();
    for (x, y) in [(0.0, 0.0), (0.3, -0.4), (2.1, 1.5), (-1.0, 3.0)] {
        let exact = triple.value(x) * (-y * y / 0.98_f64).exp();
        ROUND_OFF.judge("sum", (footprint.value(x, y) - exact).abs(), 0.0);
        ROUND_OFF.judge("product", (separable.value(x, y) - exact).abs(), 0.0);
        ROUND_OFF.judge("path", (footprint.path().value(x) - triple.value(x)).abs(), 0.0);
    }
}

#[test]
fn the_path_and_the_curvature_are_those_of_the_terms() {
    let footprint = Footprint::gaussian_sum(&crater()).unwrap();
    for i in 0..60 {
        let x = -5.0 + 0.17 * f64::from(i);
        let on_path = value(&crater(), x, 0.0);
        ROUND_OFF.judge("f(x,0)", (footprint.path().value(x) - on_path).abs(), 0.0);
        ROUND_OFF.judge("f(x,1)", (footprint.value(x, 1.0) - value(&crater(), x, 1.0)).abs(), 0.0);
        let h = 1e-3;
        let f = |y: f64| value(&crater(), x, y);
        let difference = (f(h) - 2.0 * f(0.0) + f(-h)) / (h * h);
        let error = (footprint.curvature_across(x) - difference).abs();
        Acceptance { floor: 1e-5, slack: 0.0 }.judge("f_yy(x,0)", error, 0.0);
    }
}

/// The rows of a table in any order; on an even grid finer than the bells need be, to their saturation.
#[test]
fn a_table_of_the_crater_gives_it_back() {
    let (mut x, mut y, mut f) = (vec![], vec![], vec![]);
    for i in (0..=90).rev() {
        for j in 0..=90 {
            let at = (0.1 * f64::from(i), 0.1 * f64::from(j));
            x.push(at.0);
            y.push(at.1);
            f.push(value(&crater(), at.0, at.1));
        }
    }
    let footprint = Footprint::table(&x, &y, &f).unwrap();
    let mut worst: f64 = 0.0;
    for i in 0..40 {
        for j in 0..40 {
            let (x, y) = (-5.0 + 0.263 * f64::from(i), -5.0 + 0.257 * f64::from(j));
            worst = worst.max((footprint.value(x, y) - value(&crater(), x, y)).abs());
        }
    }
    Acceptance { floor: 1e-10, slack: 0.0 }.judge("table", worst, 0.0);
    // A row left out, a row twice.
    let refused = |x: &[f64], y: &[f64], f: &[f64]| Footprint::table(x, y, f).unwrap_err();
    let error = refused(&x[1..], &y[1..], &f[1..]);
    assert!(matches!(error, TipFunctionError::TableGrid { points: 8280, x: 91, y: 91 }), "{error}");
    (x[5], y[5]) = (x[6], y[6]);
    assert!(matches!(refused(&x, &y, &f), TipFunctionError::TableGrid { .. }));
}

#[test]
fn what_is_not_even_is_refused_with_the_term_that_stands_alone() {
    let cases = [
        (vec![bump(1.0, (0.0, 0.5), (1.0, 1.0))], "center_y -0.5"),
        (vec![bump(1.0, (0.5, 0.0), (1.0, 1.0))], "at -0.5"),
        (vec![bump(1.0, (0.0, 0.0), (1.0, 0.0))], "width 0"),
        (vec![bump(0.0, (0.0, 0.0), (1.0, 1.0))], "zero everywhere"),
        (
            vec![bump(1.0, (0.5, 0.5), (1.0, 1.0)), bump(1.0, (-0.5, -0.5), (1.0, 1.0))],
            "lacks a twin",
        ),
    ];
    for (terms, words) in cases {
        let error = Footprint::gaussian_sum(&terms).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
    assert!(Footprint::separable(TipFunction::Bessel, -1.0).is_err());
}

/// (24) for every y: -(α/r) ∫ f(ξ,y)dξ from x - X on, by Gauss's rule on panels of 0.1.
#[test]
fn a_steady_past_was_carved_by_the_same_footprint() {
    let footprint = Footprint::gaussian_sum(&crater()).unwrap();
    let (alpha, r) = (1.3, 0.8);
    let model = Model::new(TipFunction::of_footprint(footprint.clone()), alpha, r).unwrap();
    let scenario = Scenario::new(model, 30.0);
    let (trajectory, initial) = finished(&scenario);
    let surface = Surface::new(&scenario.model, &initial, &trajectory);
    let start = trajectory.start();
    for (x, y) in [(14.0, 0.0), (13.1, 0.9), (15.7, -1.8), (2.0, 1.3)] {
        let rule = GaussLegendre::new(NonZeroUsize::new(10).unwrap());
        let panels = |f: &dyn Fn(f64) -> f64, from: f64| -> f64 {
            (0..300)
                .map(|i| {
                    let left = from + 0.1 * f64::from(i);
                    rule.integrate(left, left + 0.1, f)
                })
                .sum()
        };
        let exact = -alpha / r * panels(&|xi| value(&crater(), xi, y), x - 14.0);
        let found = surface.image(&footprint, start, &[x], &[y]).unwrap()[[0, 0]];
        ROUND_OFF.judge(&format!("u({x}, {y}, t1)"), (found - exact).abs(), 0.0);
    }
}

#[test]
fn noise_and_profile_are_the_same_for_all_y() {
    let tip = TipFunction::gaussian(1.0).unwrap();
    let scenario = Scenario {
        start: Start::Flat,
        noise: Some(Noise { amplitude: 0.1, spacing: 0.5, seed: 3 }),
        ..Scenario::new(Model::new(tip.clone(), 0.5, 1.0).unwrap(), 40.0)
    };
    let (trajectory, initial) = finished(&scenario);
    let surface = Surface::new(&scenario.model, &initial, &trajectory);
    let x: Vec<f64> = (0..50).map(f64::from).collect();
    let image = surface.image(&Footprint::separable(tip, 1.0).unwrap(), 40.0, &x, &[0.0, 30.0]);
    let image = image.unwrap();
    let plane = surface.heights(40.0, &x).unwrap();
    for i in 0..x.len() {
        ROUND_OFF.judge("path", (image[[0, i]] - plane[i]).abs(), 0.0);
        ROUND_OFF.judge("beside", (image[[1, i]] - initial.height(x[i])).abs(), 0.0);
    }
    let footprint = Footprint::separable(TipFunction::Bessel, 1.0).unwrap();
    let outside = surface.image(&footprint, 41.0, &x, &[0.0]);
    assert!(matches!(outside, Err(SurfaceError::OutsideRun { .. })));
    assert!(surface.image(&footprint, 40.0, &x, &[f64::NAN]).is_err());
}

/// Largest |y0| of the last fifth of 400 time units, for y0 = 1 before: the linear equation
/// y0' = (α/r) ∫ `f_yy`(ξ,0) (y0(t) - y0(t - ξ/r))dξ - (k'/k) y0 by Heun's method.
fn sideways(footprint: &Footprint, alpha: f64, r: f64, stiffness: f64) -> f64 {
    let (dt, reach) = (0.05, 12.0);
    let lags = (reach / (r * dt)) as usize;
    let kernel: Vec<f64> = (0..=lags)
        .map(|i| {
            let end = if i == 0 || i == lags { 0.5 } else { 1.0 };
            end * alpha * dt * footprint.curvature_across(r * dt * i as f64)
        })
        .collect();
    let total: f64 = kernel.iter().sum();
    let velocity = |past: &[f64]| {
        let now = past[past.len() - 1];
        let memory: f64 = kernel.iter().zip(past.iter().rev()).map(|(k, y)| k * y).sum();
        total * now - memory - stiffness * now
    };
    let mut y = vec![0.0; lags + 1];
    y.push(1.0);
    let steps = (400.0 / dt) as usize;
    for _ in 0..steps {
        let now = y[y.len() - 1];
        let v = velocity(&y);
        y.push(now + dt * v);
        let w = velocity(&y);
        *y.last_mut().unwrap() = now + 0.5 * dt * (v + w);
    }
    y[y.len() - steps / 5..].iter().fold(0.0, |m: f64, y| m.max(y.abs()))
}

#[test]
fn above_the_stiffness_needed_the_tip_stays_on_its_line() {
    let triple = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let tip = Footprint::separable(triple, 1.0).unwrap();
    let (alpha, r) = (1.0, 1.0);
    let needed = tip.transverse_stiffness_needed(alpha / r);
    assert!((0.5..2.0).contains(&needed), "{needed}");
    let above = sideways(&tip, alpha, r, 1.02 * needed);
    assert!(above < 1e-6, "k' above: {above}");
    // Without a spring the walls of the groove push the tip off.
    let without = sideways(&tip, alpha, r, 0.0);
    assert!(without > 1e3, "no k': {without}");
    // A tip that is highest on its line needs none.
    let round = Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap();
    assert!(round.transverse_stiffness_needed(1.0).abs() < 1e-15);
    assert!(sideways(&round, alpha, r, 0.05) < 1e-3);
    // Two tips side by side, the example of the paper.
    let pair = [-1.0, 1.0].map(|side| bump(1.0, (0.0, 2.0 * side), (1.0, 1.0)));
    assert!(Footprint::gaussian_sum(&pair).unwrap().transverse_stiffness_needed(1.0) > 0.0);
    let bessel = Footprint::separable(TipFunction::Bessel, 1.0).unwrap();
    assert!(bessel.transverse_stiffness_needed(1.0) > 10.0);
}

/// A guard of the guard: the sums of layers differ where the layers do.
#[test]
fn layers_carve_by_their_own_profile() {
    let footprint = Footprint::gaussian_sum(&crater()).unwrap();
    assert_eq!(footprint.layers().len(), 4);
    let along: Vec<f64> = footprint
        .layers()
        .iter()
        .map(|layer| carved(&layer.along, &[0.0], &[1.0], &[0.5])[0])
        .collect();
    assert!(along.windows(2).all(|pair| (pair[0] - pair[1]).abs() > 1e-3), "{along:?}");
}
