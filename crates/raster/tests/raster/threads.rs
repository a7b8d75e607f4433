//! Lines on several threads: the same to the last bit as one after the other.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use stickslip_raster::{Area, AreaLine, Line, Path, Plan, Scanning};
use stickslip_tip::{
    Footprint, Force, Gaussian2d, Model, Pulse, Scenario, TipFunction, Wider, stop,
};

fn scanned(plan: &Plan, threads: usize) -> Vec<Line> {
    let mut scanning = Scanning::new(plan).unwrap();
    let mut taken = 0;
    scanning
        .scan(threads, |_| {
            taken += 1;
            true
        })
        .unwrap();
    assert_eq!(taken, plan.lines());
    scanning.into_lines()
}

/// All numbers of all steps.
fn bits(lines: &[Line]) -> Vec<u64> {
    let steps = lines.iter().flat_map(|line| line.trajectory().steps());
    let numbers = steps.flat_map(|step| {
        let heights = step.height.into_iter();
        let heights = heights.flat_map(|height| [height.start].into_iter().chain(height.nodes));
        [step.t, step.h, step.extension].into_iter().chain(step.displacement).chain(heights)
    });
    numbers.map(f64::to_bits).collect()
}

fn judge(plan: &Plan) {
    let mut one_by_one = Scanning::new(plan).unwrap();
    while one_by_one.next_line().unwrap().is_some() {}
    let wanted = bits(one_by_one.lines());
    for threads in [1, 2, 3, 5] {
        assert!(bits(&scanned(plan, threads)) == wanted, "{threads} threads");
    }
}

fn plan(wider: Wider, alpha: f64, path: Path) -> Plan {
    let tip = TipFunction::gaussian(1.0).unwrap();
    let footprint = Footprint::separable(tip.clone(), 1.0).unwrap();
    let model = Model::under(wider, tip, alpha, 1.0).unwrap();
    let mut plan = Plan::new(footprint, model, path, 0.5, 24, 70.0);
    plan.law.tolerance = 1e-7;
    plan
}

#[test]
fn ripples_and_stick_slip_are_the_same() {
    judge(&plan(Wider::default(), 0.5, Path::OneWay));
    judge(&plan(Wider::default(), 0.8, Path::OneWay));
    judge(&plan(Wider::default(), 0.5, Path::Zigzag));
}

/// Lines at the same y share one row, from which each later line reads while the last is still under way.
#[test]
fn repeated_lines_are_the_same() {
    let healing = Wider { healing_time: Some(60.0), ..Wider::default() };
    judge(&plan(healing, 0.3, Path::Repeat));
}

#[test]
fn lines_under_the_wider_law_are_the_same() {
    let wider = Wider { depth_limit: Some(4.0), healing_time: Some(90.0), ..Wider::default() };
    judge(&plan(wider, 0.9, Path::OneWay));
    judge(&plan(Wider { inertia: Some(0.6), ..Wider::default() }, 0.5, Path::OneWay));
}

#[test]
fn lines_of_any_shape_are_the_same() {
    let line = |n: u32| {
        let n = f64::from(n);
        AreaLine { y: 0.4 * (7.0 * n) % 3.0, start: 9.0 * n.sin(), length: 30.0 + 25.0 * n.cos() }
    };
    let first = plan(Wider::default(), 0.4, Path::OneWay);
    judge(&Plan { area: Area::Lines((0..30).map(line).collect()), ..first });
}

#[test]
fn layers_of_several_widths_are_the_same() {
    let sum = [(1.0, 1.0, 1.0), (-0.3, 0.6, 0.8)].map(|(amplitude, width, width_y)| Gaussian2d {
        amplitude,
        center: 0.0,
        width,
        center_y: 0.0,
        width_y,
    });
    let footprint = Footprint::gaussian_sum(&sum).unwrap();
    let tip = footprint.path().clone();
    let one = plan(Wider::default(), 0.6, Path::OneWay);
    let law = Scenario { model: Model::new(tip, 0.6, 1.0).unwrap(), ..one.law };
    judge(&Plan { footprint, law, ..one });
}

/// A pulse drives the tip of the first line back by some twenty widths, to where other lines have already been: they
/// begin anew.
#[test]
fn a_tip_that_returns_makes_later_lines_begin_anew() {
    let mut plan = plan(Wider::default(), 0.5, Path::OneWay);
    plan.disturbance =
        Force::new(vec![Pulse { amplitude: -30.0, time: 55.0, width: 2.0 }], None).unwrap();
    let first = Scanning::new(&plan).unwrap().next_line().unwrap().cloned().unwrap();
    let farthest_back = (0..100).map(|i| first.x0(55.0 + 0.1 * f64::from(i))).fold(55.0, f64::min);
    assert!(farthest_back < 40.0, "{farthest_back}");
    judge(&plan);
}

#[test]
fn work_that_is_stopped_and_taken_up_again_is_the_same() {
    let plan = plan(Wider::default(), 0.5, Path::OneWay);
    let wanted = bits(&scanned(&plan, 1));
    let mut scanning = Scanning::new(&plan).unwrap();
    // Once by who takes the lines, once by the flag of the thread.
    let mut left = 5;
    scanning
        .scan(3, |_| {
            left -= 1;
            left > 0
        })
        .unwrap();
    assert_eq!(scanning.lines().len(), 5);
    let flag = Arc::new(AtomicBool::new(false));
    let stopped = stop::with_flag(&flag, || {
        scanning.scan(2, |_| {
            flag.store(true, Ordering::Relaxed);
            true
        })
    });
    stopped.unwrap();
    assert_eq!(scanning.lines().len(), 6);
    let mut resumed = Scanning::resumed(&plan, scanning.lines().to_vec()).unwrap();
    resumed.scan(2, |_| true).unwrap();
    scanning.scan(3, |_| true).unwrap();
    assert!(bits(scanning.lines()) == wanted && bits(resumed.lines()) == wanted);
}
