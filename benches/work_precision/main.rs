//! The work-precision diagram: time against the error reached, for whole runs of the regimes.
//!
//! Error: largest difference of l from `fft` at a tolerance of 1e-12, at 20,000 times (at the ends of its own
//! steps for the explicit method). Time: the shortest of many runs in this process, fits cached.
//!
//! Beside our integrator, a candidate that it must beat: an explicit Runge-Kutta method of order 8 (DOP853 of
//! the crate differential-equations) on the embedded system of the modes, z' = 1 + s x0' z.
//!
//!     cargo run --release --example work_precision -- DATA.json

#![allow(missing_docs, reason = "a program")]

mod case;
mod explicit;

use case::{CASES, Case};
use serde::Serialize;
use std::time::Instant;
use stickslip_tip::{MemoryChoice, Run, Trajectory, run};

/// One run.
#[derive(Debug, Clone, Serialize)]
struct Point {
    tolerance: f64,
    error: f64,
    seconds: f64,
    /// Accepted steps.
    steps: u64,
    /// Looks at the groove in all stages, or right-hand sides.
    evaluations: u64,
}

/// The runs of one method on one case.
#[derive(Debug, Clone, Serialize)]
struct Curve {
    case: &'static str,
    method: &'static str,
    points: Vec<Point>,
}

#[derive(Debug, Serialize)]
struct Diagram {
    machine: String,
    cases: &'static [Case],
    curves: Vec<Curve>,
}

const TOLERANCES: [f64; 8] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11];
/// Each run is repeated for so long, in seconds.
const REPEATED: f64 = 0.2;
/// An explicit method is given up where it takes longer than this, in seconds.
const LONGEST: f64 = 1.0;

/// Shortest time of many.
fn shortest(mut once: impl FnMut()) -> f64 {
    let begun = Instant::now();
    let mut best = f64::INFINITY;
    while begun.elapsed().as_secs_f64() < REPEATED {
        let started = Instant::now();
        once();
        best = best.min(started.elapsed().as_secs_f64());
    }
    best
}

/// Largest difference of l.
fn largest_difference(a: &Trajectory, b: &Trajectory) -> f64 {
    let (start, end) = (a.start(), a.end());
    let time = |i: i32| start + (end - start) * f64::from(i) / 20_000.0;
    (0..=20_000).map(time).map(|t| (a.l(t) - b.l(t)).abs()).fold(0.0, f64::max)
}

fn ours(case: &'static Case, method: &'static str, memory: MemoryChoice, reference: &Run) -> Curve {
    let point = |tolerance: &f64| {
        let scenario = case.scenario(*tolerance, memory);
        let result = run(&scenario).expect("a run");
        Point {
            tolerance: *tolerance,
            error: largest_difference(&result.trajectory, &reference.trajectory),
            seconds: shortest(|| drop(run(&scenario))),
            steps: result.work.steps,
            evaluations: result.work.newton_iterations,
        }
    };
    Curve { case: case.name, method, points: TOLERANCES.iter().map(point).collect() }
}

fn explicit(case: &'static Case, reference: &Run) -> Curve {
    let mut points = vec![];
    for tolerance in TOLERANCES {
        let started = Instant::now();
        let Some(solved) = explicit::solve(case, tolerance) else { continue };
        if started.elapsed().as_secs_f64() > LONGEST {
            break;
        }
        let error = |(t, l): &(f64, f64)| (reference.trajectory.l(*t) - l).abs();
        points.push(Point {
            tolerance,
            error: solved.l.iter().map(error).fold(0.0, f64::max),
            seconds: shortest(|| drop(explicit::solve(case, tolerance))),
            steps: solved.l.len() as u64 - 1,
            evaluations: solved.evaluations,
        });
    }
    Curve { case: case.name, method: "explicit", points }
}

fn main() {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    let [data] = paths.as_slice() else { panic!("usage: work_precision DATA.json") };
    let mut curves = vec![];
    for case in &CASES {
        let reference = run(&case.scenario(1e-12, MemoryChoice::Fft)).expect("a reference");
        curves.push(ours(case, "modes", MemoryChoice::Modes, &reference));
        curves.push(ours(case, "fft", MemoryChoice::Fft, &reference));
        curves.push(explicit(case, &reference));
        for curve in curves.iter().rev().take(3).rev() {
            for p in &curve.points {
                println!(
                    "{:15} {:9} {:6.0e}: error {:8.1e}, {:9.4} ms, {:7} steps, {:7} evaluations",
                    curve.case,
                    curve.method,
                    p.tolerance,
                    p.error,
                    1e3 * p.seconds,
                    p.steps,
                    p.evaluations
                );
            }
        }
    }
    let machine = case::machine();
    let diagram = Diagram { machine, cases: &CASES, curves };
    let json = serde_json::to_string_pretty(&diagram).expect("numbers");
    std::fs::write(data, json + "\n").expect("a file that can be written");
}
