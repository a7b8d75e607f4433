//! Small ripples of nonlinear rasters grow from line to line as linear theory says (`stickslip_stability::Raster`,
//! which knows nothing of runs). A weak pulse on the first line, with either sign: half the difference is linear, to the
//! square of the pulse. Ripples are measured by ρ̂ = ∫ e^{-iqx0(t)} dt, summed over the motion itself, and obey
//!
//! ```text
//!     δρ̂_n = (C/D) Σ_j h(jd) δρ̂_{n-j},      on the way back of a zigzag with (C/D)*
//! ```

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use num_complex::Complex64;
use stickslip_raster::{Line, Path, Plan, Scanning};
use stickslip_stability::{Raster, RasterPath};
use stickslip_tip::{Footprint, Force, Gaussian2d, Model, Pulse, TipFunction, Wider};

/// Of the pulse; its square is what is not linear.
const WEAK: f64 = 1e-4;

fn scanned(plan: &Plan) -> Vec<Line> {
    let mut scanning = Scanning::new(plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    scanning.into_lines()
}

fn spectrum(line: &Line, q: f64) -> Complex64 {
    let (positions, weights) = line.residence();
    let term = |(x, w): (&f64, &f64)| Complex64::from_polar(*w, -q * x);
    positions.iter().zip(&weights).map(term).sum()
}

/// δρ̂ of every line. The pulse comes in the middle: ripples drift along from line to line, and neither they may come to
/// the end nor the edge to them.
fn ripples(plan: &Plan, q: f64) -> Vec<Complex64> {
    let one = |sign: f64| {
        let pulse = Pulse { amplitude: sign * WEAK, time: 0.5 * plan.area.longest(), width: 0.7 };
        let disturbance = Force::new(vec![pulse], None).unwrap();
        scanned(&Plan { disturbance, ..plan.clone() })
    };
    let (up, down) = (one(1.0), one(-1.0));
    up.iter().zip(&down).map(|(a, b)| 0.5 * (spectrum(a, q) - spectrum(b, q))).collect()
}

fn plan(beta: f64, width_y: f64, alpha: f64, path: Path, size: (f64, usize, f64)) -> Plan {
    let tip = TipFunction::triple_gaussian(beta, 1.0).unwrap();
    let footprint = Footprint::separable(tip, width_y).unwrap();
    let model = Model::new(footprint.path().clone(), alpha, 1.0).unwrap();
    let mut plan = Plan::new(footprint, model, path, size.0, size.1, size.2);
    plan.law.tolerance = 1e-12;
    plan
}

fn pitch(plan: &Plan) -> f64 {
    plan.area.pitch(plan.path).unwrap_or_default()
}

/// The largest relative error of δρ̂_n against the recurrence.
fn worst(plan: &Plan, width_y: f64, q: f64) -> f64 {
    let gain = |footprint: &Footprint| {
        let theory = Raster::new(footprint, Wider::default(), (1.0, pitch(plan)), 1.0).unwrap();
        theory.repeat_gain(plan.law.model.alpha(), q) - 1.0
    };
    let (forth, back) = (gain(&plan.footprint), gain(&plan.footprint.mirrored()).conj());
    let found = ripples(plan, q);
    let mut worst = 0.0_f64;
    for n in 1..found.len() {
        let height = |m: usize| {
            let z = pitch(plan) * (n - m) as f64 / width_y;
            (-0.5 * z * z).exp()
        };
        let felt: Complex64 = (0..n).map(|m| found[m] * height(m)).sum();
        let gain = if plan.track(n).backward { back } else { forth };
        worst = worst.max((gain * felt - found[n]).norm() / found[n].norm());
    }
    println!("{:?} {q}: {worst:.1e}", plan.path);
    worst
}

#[test]
fn every_line_answers_to_those_before_as_theory_says() {
    for path in [Path::OneWay, Path::Zigzag] {
        for q in [0.6, 1.0, 1.4] {
            let (alpha, pitch) = (0.4, 0.5);
            let error = worst(&plan(0.0, 1.0, alpha, path, (pitch, 12, 160.0)), 1.0, q);
            assert!(error < 1e-6, "{path:?} {q}: {error:e}");
        }
    }
    let error = worst(&plan(1.0, 1.5, 0.3, Path::OneWay, (1.0, 8, 130.0)), 1.5, 0.9);
    assert!(error < 1e-6, "{error:e}");
}

/// A lobe ahead and another behind: of the halves, and of the whole f that is felt of earlier lines.
#[test]
fn lines_of_a_tip_with_two_sides_answer_as_theory_says() {
    let slope = |c: f64| c * (-0.5 * c * c).exp();
    let lobes = [(1.0, 0.0), (-0.4, 2.0), (-0.4 * slope(2.0) / slope(1.5), -1.5)];
    let term = |(amplitude, center)| Gaussian2d {
        amplitude,
        center,
        width: 1.0,
        center_y: 0.0,
        width_y: 1.0,
    };
    let footprint = Footprint::gaussian_sum(&lobes.map(term)).unwrap();
    assert!(!footprint.is_even() && footprint.mirrored().layers().len() == 1);
    for path in [Path::OneWay, Path::Zigzag] {
        for q in [0.6, 1.2] {
            let mut plan = plan(0.0, 1.0, 0.4, path, (0.5, 8, 150.0));
            plan.footprint = footprint.clone();
            plan.law.model = Model::new(footprint.path().clone(), 0.4, 1.0).unwrap();
            let error = worst(&plan, 1.0, q);
            assert!(error < 1e-6, "{path:?} {q}: {error:e}");
        }
    }
}

/// Above the threshold, to which the pulse takes no part but to begin: z of the fastest growing ripple.
#[test]
fn growth_from_line_to_line_is_that_of_theory() {
    let plan = plan(0.0, 1.0, 0.43, Path::OneWay, (0.5, 60, 280.0));
    let theory = Raster::new(&plan.footprint, Wider::default(), (1.0, 0.5), 1.0).unwrap();
    let critical = theory.critical(RasterPath::OneWay).unwrap();
    assert!(critical.alpha < 0.43);
    let found = ripples(&plan, critical.q);
    let z = found[59] / found[58];
    let wanted = theory.growth(0.43, critical.q);
    println!("{z} {wanted}");
    assert!((z - wanted).norm() < 1e-6, "{z} for {wanted}");
    assert!(wanted.norm() > 1.0 && wanted.im.abs() > 0.1);
}

/// The gain of a repeated pass, 1 + C/D: of the groove, that is of the sum of all passes.
#[test]
fn a_repeated_pass_has_the_gain_of_theory() {
    let plan = plan(0.0, 1.0, 0.25, Path::Repeat, (1.0, 5, 130.0));
    let theory = Raster::new(&plan.footprint, Wider::default(), (1.0, 1.0), 1.0).unwrap();
    for q in [0.7, 1.2] {
        let found = ripples(&plan, q);
        let groove = |n: usize| found[..n].iter().sum::<Complex64>();
        for n in 1..5 {
            let gain = groove(n + 1) / groove(n);
            let wanted = theory.repeat_gain(0.25, q);
            assert!((gain - wanted).norm() < 1e-6, "{n} {q}: {gain} for {wanted}");
        }
    }
}
