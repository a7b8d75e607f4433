//! Walks without a spring, judged by what is known of walking droplets and of the Lorenz system.

use num_complex::Complex64;
use std::time::{Duration, Instant};
use stickslip_stability::{walk, walking_alpha, walking_speeds};
use stickslip_tip::{Model, Scenario, Start, TipFunction, Wider, run};

fn triple(beta: f64) -> TipFunction {
    TipFunction::triple_gaussian(beta, 1.0).expect("a valid tip")
}

fn walker(tip: &TipFunction, inertia: Option<f64>, healing: f64, alpha: f64) -> Model {
    let healing_time = Some(healing);
    walker_under(Wider { inertia, healing_time, depth_limit: None, spring: false }, tip, alpha)
}

fn walker_under(wider: Wider, tip: &TipFunction, alpha: f64) -> Model {
    Model::under(wider, tip.clone(), alpha, 0.0).expect("a valid model")
}

#[test]
fn a_walk_over_waves_has_the_speed_of_walking_droplets() {
    // Oza, Rosales and Bush (2013), in one dimension: v² = (2B - 1 - √(1+4B))/2.
    for b in [2.01, 2.5, 3.0, 8.0, 50.0_f64] {
        let walker = walker(&TipFunction::Bessel, None, 1.0, -b);
        let speeds = walking_speeds(&walker).unwrap();
        let exact = (0.5 * (2.0 * b - 1.0 - (1.0 + 4.0 * b).sqrt())).sqrt();
        assert_eq!(speeds.len(), 1, "{b}");
        assert!((speeds[0] - exact).abs() < 1e-13 * exact.max(1.0), "{b} {} {exact}", speeds[0]);
    }
    let below = walker(&TipFunction::Bessel, None, 1.0, -1.99);
    let threshold = walking_alpha(below.tip(), below.wider()).unwrap();
    assert!((threshold + 2.0).abs() < 1e-14);
    assert!(walking_speeds(&below).unwrap().is_empty());
}

#[test]
fn walking_begins_where_the_curvature_says_for_every_footprint() {
    for tip in [triple(0.0), triple(0.7), TipFunction::Bessel, TipFunction::Cosine] {
        for (time, inertia, depth_limit) in
            [(1.0, None, None), (3.0, Some(0.5), None), (2.0, None, Some(0.5))]
        {
            if depth_limit.is_some() && tip == TipFunction::Cosine {
                continue;
            }
            let wider = Wider { inertia, healing_time: Some(time), depth_limit, spring: false };
            let alpha = walking_alpha(&tip, &wider).unwrap();
            let speeds = |part: f64| walking_speeds(&walker_under(wider, &tip, part * alpha));
            assert!(speeds(0.999).unwrap().is_empty(), "{tip:?}");
            let walks = speeds(1.001).unwrap();
            assert_eq!(walks.len(), 1, "{tip:?} {walks:?}");
            assert!(walks[0] < 0.1, "{tip:?} {walks:?}");
        }
    }
}

/// λ³ + (σ+b+1)λ² + b(σ+ρ)λ + 2bσ(ρ-1) = 0 at the fixed points of the Lorenz system, b = 1.
#[test]
fn a_walk_over_a_cosine_has_the_roots_of_the_lorenz_system() {
    for (sigma, rho) in [(10.0, 28.0), (10.0, 5.0), (4.0, 60.0)] {
        let walker = walker(&TipFunction::Cosine, Some(1.0 / sigma), 1.0, -rho);
        let speeds = walking_speeds(&walker).unwrap();
        assert_eq!(speeds.len(), 1);
        assert!((speeds[0] - f64::sqrt(rho - 1.0)).abs() < 1e-12 * rho);
        let walk = walk(&walker, speeds[0], 4).unwrap();
        assert!(walk.spectrum.certificate.is_complete());
        assert_eq!(walk.spectrum.roots.len(), 4);
        let lorenz: Vec<_> = walk.spectrum.roots.iter().filter(|z| z.norm() > 0.0).collect();
        assert_eq!(lorenz.len(), 3, "and the shift of the whole walk: {:?}", walk.spectrum.roots);
        for z in lorenz {
            let terms = [
                z * z * z,
                z * z * (sigma + 2.0),
                z * (sigma + rho),
                (2.0 * sigma * (rho - 1.0)).into(),
            ];
            let size: f64 = terms.iter().map(|t| t.norm()).sum();
            assert!(terms.iter().sum::<Complex64>().norm() < 1e-12 * size, "{sigma} {rho} {z}");
        }
    }
}

#[test]
fn the_lorenz_walk_loses_its_stability_where_the_lorenz_system_does() {
    let sigma = 10.0;
    let hopf = sigma * (sigma + 4.0) / (sigma - 2.0);
    for (part, count) in [(0.999, 0), (1.001, 2)] {
        let rho = part * hopf;
        let walker = walker(&TipFunction::Cosine, Some(1.0 / sigma), 1.0, -rho);
        let speed = walking_speeds(&walker).unwrap()[0];
        let walk = walk(&walker, speed, 4).unwrap();
        assert_eq!(walk.unstable_count(), count, "{rho} {:?}", walk.spectrum.roots);
    }
}

/// p and q in the least-squares sense.
fn fitted(y: &[f64]) -> (f64, f64) {
    let sum = |f: &dyn Fn(&[f64]) -> f64| y.windows(3).map(f).sum::<f64>();
    let (aa, ab, bb) = (sum(&|w| w[1] * w[1]), sum(&|w| w[1] * w[0]), sum(&|w| w[0] * w[0]));
    let (ca, cb) = (sum(&|w| w[2] * w[1]), sum(&|w| w[2] * w[0]));
    let determinant = aa * bb - ab * ab;
    ((ca * bb - cb * ab) / determinant, (cb * aa - ca * ab) / determinant)
}

/// Just above the onset of walking a walk is stable, and its exponent is small. It is called stable unless the error of
/// the exponent is larger, and never unstable.
#[test]
fn a_walk_next_to_onset_is_stable_or_undecided() {
    for (tip, onset) in
        [(triple(0.0), -1.0), (TipFunction::Cosine, -1.0), (TipFunction::Bessel, -2.0)]
    {
        for (above, wanted) in [(1e-3, Some(true)), (1e-7, None)] {
            let walker = walker(&tip, None, 1.0, onset * (1.0 + above));
            let walk = walk(&walker, walking_speeds(&walker).unwrap()[0], 2).unwrap();
            assert_eq!(walk.is_stable(), wanted, "{tip:?} {above:e} {:?}", walk.spectrum);
        }
    }
}

/// There roots begin at -s, 5,500 widths to the left: line by line this took 25 s.
#[test]
fn roots_of_a_walk_next_to_onset_are_found_in_time() {
    let began = Instant::now();
    for (tip, count) in [(triple(0.0), 10), (TipFunction::Cosine, 3)] {
        let walker = walker(&tip, None, 1.0, -1.0 - 1e-7);
        let walk = walk(&walker, walking_speeds(&walker).unwrap()[0], count).unwrap();
        assert!(walk.spectrum.roots.len() >= count, "{:?}", walk.spectrum);
    }
    // 0.1 s
    assert!(began.elapsed() < Duration::from_secs(3));
}

/// A tip set going on a flat surface settles into the walk, with and without a depth limit, where that is stable.
#[test]
fn runs_settle_into_the_walk_at_its_speed() {
    for (tip, depth_limit, mass, alpha) in [
        (TipFunction::Bessel, None, 0.3, -3.0),
        (triple(0.0), None, 0.5, -4.0),
        (triple(0.0), Some(2.0), 0.5, -4.0),
        (triple(0.5), Some(3.0), 0.6, -3.0),
    ] {
        let wider =
            Wider { depth_limit, healing_time: Some(1.5), inertia: Some(mass), spring: false };
        let model = Model::under(wider, tip.clone(), alpha, 0.0).unwrap();
        let speeds = walking_speeds(&model).unwrap();
        assert_eq!(speeds.len(), 1, "{tip:?}");
        let walk = walk(&model, speeds[0], 4).unwrap();
        assert_eq!(walk.unstable_count(), 0, "{:?}", walk.spectrum.roots);
        assert_eq!(walk.weight < 1.0, depth_limit.is_some());
        let slowest = walk.spectrum.roots.iter().map(|z| z.re).filter(|re| *re < 0.0);
        let decay = -slowest.fold(f64::NEG_INFINITY, f64::max);
        let span = 25.0 / decay;
        let base = Scenario::new(model.clone(), 0.0);
        let start_velocity = Some(0.8 * speeds[0]);
        let until = base.start_time() + span;
        let scenario =
            Scenario { start: Start::Flat, start_velocity, until, tolerance: 1e-11, ..base };
        let motion = run(&scenario).unwrap().trajectory;
        let velocity = motion.velocity(motion.end());
        assert!((velocity - speeds[0]).abs() < 1e-8, "{tip:?} {depth_limit:?}");
        // On its way the leading root is seen: y(t+2dt) = p y(t+dt) + q y(t) is solved by e^{λt}.
        let leading = walk.spectrum.roots.iter().find(|z| z.re < 0.0).unwrap();
        let dt = 0.3 / leading.norm();
        let from = motion.start() + 11.0 / decay;
        let y = |i: i32| motion.velocity(from + dt * f64::from(i)) - speeds[0];
        let multiplier = (leading * dt).exp();
        let (p, q) = fitted(&(0..20).map(y).collect::<Vec<f64>>());
        let miss = (multiplier * multiplier - multiplier * p - q).norm();
        println!("{tip:?} {depth_limit:?}: {leading}, missed by {miss:.1e}");
        assert!(miss < 2e-5, "{tip:?} {depth_limit:?} {leading} {miss:e}");
    }
}
