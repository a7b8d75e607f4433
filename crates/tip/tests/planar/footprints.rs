//! Footprints that are no product of a function of x and a Gaussian of y, against the reference.

use super::lines::{holds, line, problem};
use super::reference::{Footprint, Problem};
use stickslip_tip::planar::{PlanarError, PlanarRunning, PlanarScenario, ProductsError, run};
use stickslip_tip::{Gaussian2d, MemoryChoice, SupportPath, TipFunction, Wider};

/// The tip, and the same footprint for the reference, from amplitudes, centers and widths along and across.
pub(crate) fn gaussians(terms: &[[f64; 5]]) -> (TipFunction, Footprint) {
    let term = |[amplitude, center, width, center_y, width_y]: &[f64; 5]| Gaussian2d {
        amplitude: *amplitude,
        center: *center,
        width: *width,
        center_y: *center_y,
        width_y: *width_y,
    };
    let all: Vec<Gaussian2d> = terms.iter().map(term).collect();
    let footprint = stickslip_tip::Footprint::gaussian_sum(&all).unwrap();
    (TipFunction::of_footprint(footprint), Footprint::gaussians(terms.to_vec()))
}

/// Side lobes along the scan that are wider across than the middle.
fn fan() -> Vec<[f64; 5]> {
    let lobe = |x: f64| [-0.5, x, 1.0, 0.0, 1.4];
    vec![[1.0, 0.0, 1.0, 0.0, 1.0], lobe(-2.0), lobe(2.0)]
}

/// Lobes in all four directions, of three widths across.
pub(crate) fn star() -> Vec<[f64; 5]> {
    let along = |x: f64| [-0.4, x, 0.9, 0.0, 0.8];
    let across = |y: f64| [-0.25, 0.0, 1.1, y, 0.9];
    vec![[1.0, 0.0, 1.0, 0.0, 1.0], along(-2.0), along(2.0), across(-1.8), across(1.8)]
}

/// (1 - x²/2 + x²y²/10) e^{-x²/2 - y²/2.4}: three products.
fn saddle([x, y]: [f64; 2]) -> [f64; 3] {
    let bell = (-0.5 * x * x - y * y / 2.4).exp();
    let factor = 1.0 - 0.5 * x * x + 0.1 * x * x * y * y;
    let (along, across) = (-x + 0.2 * x * y * y, 0.2 * x * x * y);
    [factor * bell, (along - x * factor) * bell, (across - y / 1.2 * factor) * bell]
}

/// A table of values at these distances, to 8.5.
fn table(f: impl Fn(f64, f64) -> f64, spacing: f64) -> TipFunction {
    let count = (8.5 / spacing).round() as usize;
    let (mut x, mut y, mut values) = (vec![], vec![], vec![]);
    for n in 0..=count * (count + 2) {
        x.push(spacing * (n % (count + 1)) as f64);
        y.push(spacing * (n / (count + 1)) as f64);
        values.push(f(x[n], y[n]));
    }
    let footprint = stickslip_tip::Footprint::table(&x, &y, &values).unwrap();
    TipFunction::of_footprint(footprint)
}

fn plain() -> Wider {
    Wider::default()
}

/// The problem of the reference with this footprint.
fn with(scenario: &PlanarScenario, footprint: Footprint) -> Problem {
    Problem { footprint, ..problem(scenario, (1.0, 1.0)) }
}

#[test]
fn sums_of_products_are_followed() {
    for (name, terms, alpha, stiffness, kicks) in [
        ("fan, snaking", fan(), 1.3, 0.2, [0.05, 0.3]),
        ("fan, stick-slip", fan(), 1.9, 1.0, [0.05, 0.1]),
        ("star", star(), 1.4, 0.3, [0.05, 0.2]),
    ] {
        let (tip, footprint) = gaussians(&terms);
        let scenario = line((tip, plain()), alpha, stiffness, kicks, 36.0);
        holds(name, &scenario, &with(&scenario, footprint), 360);
    }
}

#[test]
fn sums_of_products_under_the_wider_law_are_followed() {
    for (name, terms, wider) in [
        ("depth limit", star(), Wider { depth_limit: Some(3.0), ..plain() }),
        ("healing", fan(), Wider { healing_time: Some(6.0), ..plain() }),
        ("inertia", star(), Wider { inertia: Some(0.4), ..plain() }),
    ] {
        let (tip, footprint) = gaussians(&terms);
        let scenario = line((tip, wider), 1.5, 0.3, [0.05, 0.2], 36.0);
        holds(name, &scenario, &with(&scenario, footprint), 360);
    }
}

/// Drawn back over its own groove, by exponentials and by convolution.
#[test]
fn sums_of_products_are_followed_backwards() {
    const PATH: [(f64, f64); 4] = [(0.0, 0.0), (6.0, 6.0), (16.0, -4.0), (24.0, 5.0)];
    let (tip, _) = gaussians(&star());
    let mut scenario = line((tip, plain()), 1.2, 0.25, [0.1, 0.2], 24.0);
    let (t, displacement) = PATH.into_iter().unzip();
    scenario.along.path = Some(SupportPath::new(t, displacement).unwrap());
    let by_modes = run(&scenario).unwrap();
    let mut by_fft = scenario.clone();
    by_fft.along.memory = MemoryChoice::Fft;
    let by_fft = run(&by_fft).unwrap();
    let (_, footprint) = gaussians(&star());
    let support = |problem: &Problem, t: f64| {
        let piece = PATH.windows(2).find(|ends| t <= ends[1].0).unwrap_or(&PATH[2..]);
        let part = (t - piece[0].0) / (piece[1].0 - piece[0].0);
        // Where steady motion has it.
        let height: f64 = star()
            .iter()
            .map(|[a, c, w, d, v]| a * (-0.5 * (c * c / w / w + d * d / v / v)).exp())
            .sum();
        14.0 + problem.r
            + problem.alpha * height / problem.r
            + piece[0].1
            + part * (piece[1].1 - piece[0].1)
    };
    let problem = Problem { support, ..with(&scenario, footprint) };
    let motion = problem.motion(24.0, 480);
    for (name, trajectory) in [("modes", &by_modes.trajectory), ("fft", &by_fft.trajectory)] {
        let mut worst = [0.0_f64; 2];
        for (t, [x, y]) in motion.t.iter().zip(&motion.position) {
            worst[0] = worst[0].max((trajectory.x0(*t) - x).abs());
            worst[1] = worst[1].max((trajectory.y0(*t) - y).abs());
        }
        println!("{name}: {worst:?}");
        assert!(worst.iter().all(|miss| *miss < 5e-9), "{name}: {worst:?}");
    }
    assert!(by_modes.work.switches > 0, "{:?}", by_modes.work);
}

/// The table knows the function at its points alone.
#[test]
fn a_table_is_followed() {
    let tip = table(|x, y| saddle([x, y])[0], 0.25);
    let scenario = line((tip, plain()), 1.3, 0.3, [0.05, 0.2], 36.0);
    let of_formula = with(&scenario, Footprint::new(saddle));
    holds("table", &scenario, &of_formula, 360);
}

/// Rows so dense are narrow Gaussians that nearly cancel: no exponentials fit them to this tolerance, and a convolution
/// takes their place.
#[test]
fn a_dense_table_is_followed_at_a_tight_tolerance() {
    let tip = table(|x, y| saddle([x, y])[0], 0.1);
    let mut scenario = line((tip, plain()), 1.3, 0.3, [0.05, 0.2], 24.0);
    scenario.along.tolerance = 1e-10;
    let (name, why) = PlanarRunning::new(&scenario).unwrap().memory();
    assert_eq!(name, "fft", "{why}");
    holds("dense table", &scenario, &with(&scenario, Footprint::new(saddle)), 300);
}

/// Rough at every point: no few products are near it.
#[test]
fn a_footprint_of_many_products_is_refused() {
    let rough = |x: f64, y: f64| {
        let noise = (1e4 * (12.9 * x + 78.2 * y).sin()).fract();
        (1.0 + 0.05 * noise) * (-0.2 * (x * x + y * y)).exp()
    };
    let scenario = line((table(rough, 0.125), plain()), 1.3, 0.3, [0.05, 0.2], 36.0);
    let error = scenario.validate().unwrap_err();
    println!("{error}");
    let PlanarError::Products(ProductsError::TooMany { needed }) = error else { panic!("{error}") };
    assert!(needed > 48, "{needed}");
}
