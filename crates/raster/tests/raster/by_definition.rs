//! Rasters against the definition: the full equations (10) and (11), or those of the wider law, on rows of points, one row
//! for each line, with Runge-Kutta steps of fixed length. It shares nothing with the library but the formula of the footprint, written out
//! here, and the path of the support.
//!
//! u is limited in band, so that points 0.4 apart hold it and the sum of sines over all of them gives its slope
//! anywhere, to 4e-14 for a Gaussian of width 1.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use stickslip_raster::{Area, AreaLine, Line, Path, Plan, Scanned, Scanning, volume};
use stickslip_tip::{
    Footprint, Gaussian2d, InitialSurface, Model, Relief, Running, TipFunction, Wider,
};

use crate::definition::{Definition, Formula, given};

fn scanned(plan: &Plan) -> Vec<Line> {
    let mut scanning = Scanning::new(plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    scanning.into_lines()
}

fn plan(footprint: Footprint, (alpha, r): (f64, f64), path: Path, size: (f64, usize, f64)) -> Plan {
    let model = Model::new(footprint.path().clone(), alpha, r).unwrap();
    let mut plan = Plan::new(footprint, model, path, size.0, size.1, size.2);
    plan.law.tolerance = 1e-11;
    plan
}

/// Largest differences of x0 on any line and of u on any row.
fn differences(plan: &Plan, f: Formula) -> (f64, f64) {
    let given = given(plan);
    let mut y: Vec<f64> = given.iter().map(|line| line.0).collect();
    y.sort_by(f64::total_cmp);
    y.dedup();
    let ends = given.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), line| {
        (low.min(line.1), high.max(line.2))
    });
    let mut slow = Definition::new(f, &plan.law.model, y.clone(), ends);
    let lines = scanned(plan);
    let mut worst_x0 = 0.0_f64;
    for (n, line) in lines.iter().enumerate() {
        let (at, from, to) = given[n];
        let row = y.iter().position(|y| (y - at).abs() < 1e-12).unwrap();
        let is_zigzag = plan.path == Path::Zigzag;
        let ends = if is_zigzag && n % 2 == 1 { (to, from) } else { (from, to) };
        for (t, x0) in slow.line(row, ends, is_zigzag) {
            worst_x0 = worst_x0.max((line.x0(t) - x0).abs());
        }
    }
    let u = Scanned::new(plan, &lines).heights(&slow.x, &y);
    let miss = |((n, i), u): ((usize, usize), &f64)| (u - slow.state.u[n][i]).abs();
    (worst_x0, u.indexed_iter().map(miss).fold(0.0, f64::max))
}

fn judge(name: &str, plan: &Plan, f: Formula) {
    let (x0, u) = differences(plan, f);
    println!("{name}: x0 {x0:.1e}, u {u:.1e}");
    assert!(x0 < 1e-8 && u < 1e-8, "{name}: x0 {x0:e}, u {u:e}");
}

fn gaussian(x: f64, y: f64) -> f64 {
    (-0.5 * (x * x + y * y)).exp()
}

fn triple(x: f64, y: f64) -> f64 {
    let along = (-0.5 * x * x).exp()
        - 0.5 * ((-0.5 * (x + 2.0) * (x + 2.0)).exp() + (-0.5 * (x - 2.0) * (x - 2.0)).exp());
    along * (-0.5 * (y / 1.6) * (y / 1.6)).exp()
}

/// No product: a broad part and a ring of side lobes in y.
fn lobed(x: f64, y: f64) -> f64 {
    let z = x / 1.2;
    let lobe = |c: f64| (-0.5 * (y - c) * (y - c) / 0.49).exp();
    gaussian(x, y) + 0.3 * (-0.5 * z * z).exp() * (lobe(1.1) + lobe(-1.1))
}

fn lobed_footprint() -> Footprint {
    let term = |amplitude, width, center_y, width_y| Gaussian2d {
        amplitude,
        center: 0.0,
        width,
        center_y,
        width_y,
    };
    let terms = [term(1.0, 1.0, 0.0, 1.0), term(0.3, 1.2, 1.1, 0.7), term(0.3, 1.2, -1.1, 0.7)];
    Footprint::gaussian_sum(&terms).unwrap()
}

fn round() -> Footprint {
    Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap()
}

#[test]
fn one_way_lines_are_those_of_the_full_equations() {
    judge("gaussian", &plan(round(), (0.9, 1.0), Path::OneWay, (0.5, 6, 16.0)), gaussian);
    let wide = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let wide = Footprint::separable(wide, 1.6).unwrap();
    judge("triple", &plan(wide, (0.7, 0.8), Path::OneWay, (1.0, 4, 16.0)), triple);
    judge("lobed", &plan(lobed_footprint(), (0.6, 1.0), Path::OneWay, (0.7, 4, 16.0)), lobed);
}

#[test]
fn zigzag_lines_are_those_of_the_full_equations() {
    judge("gaussian", &plan(round(), (0.9, 1.0), Path::Zigzag, (0.5, 6, 16.0)), gaussian);
    judge("lobed", &plan(lobed_footprint(), (0.6, 1.0), Path::Zigzag, (0.7, 5, 16.0)), lobed);
}

/// Depth limit, healing and inertia, alone and together: weights of visits, grooves that fade from line to line, and
/// the velocity with which a tip comes to the turn of a zigzag.
#[test]
fn lines_under_the_wider_law_are_those_of_the_full_equations() {
    let limited = Wider { depth_limit: Some(2.0), ..Wider::default() };
    let healing = Wider { healing_time: Some(12.0), ..Wider::default() };
    // Several healing times in a step: what is left of a line is that of the last part of a step.
    let quick = Wider { healing_time: Some(0.1), ..Wider::default() };
    let heavy = Wider { inertia: Some(0.5), ..Wider::default() };
    let all = Wider { depth_limit: Some(3.0), healing_time: Some(20.0), ..heavy };
    for (name, wider, path) in [
        ("limited", limited, Path::OneWay),
        ("limited zigzag", limited, Path::Zigzag),
        ("healing", healing, Path::OneWay),
        ("quick zigzag", quick, Path::Zigzag),
        ("heavy zigzag", heavy, Path::Zigzag),
        ("all", all, Path::Zigzag),
        ("all repeated", all, Path::Repeat),
    ] {
        let mut plan = plan(round(), (0.8, 1.0), path, (0.7, 4, 16.0));
        let tip = plan.law.model.tip().clone();
        plan.law.model = Model::under(wider, tip, 0.8, 1.0).unwrap();
        judge(name, &plan, gaussian);
    }
}

/// An L of lines that begin at several x and are of several lengths, one of them twice, and one that goes back to where
/// lines have been: by the paper's law, and by all of the wider one.
#[test]
fn lines_of_any_shape_are_those_of_the_full_equations() {
    let line = |(y, start, length): (f64, f64, f64)| AreaLine { y, start, length };
    let shape = [(0.0, -4.0, 14.0), (0.6, -4.5, 15.0), (1.2, 3.0, 8.0), (1.2, 3.0, 8.0)];
    let shape: Vec<AreaLine> = shape.into_iter().chain([(0.3, -2.0, 12.0)]).map(line).collect();
    for path in [Path::OneWay, Path::Zigzag] {
        let mut plan = plan(round(), (0.8, 1.0), path, (0.0, 1, 1.0));
        plan.area = Area::Lines(shape.clone());
        judge("shape", &plan, gaussian);
        let wider = Wider {
            depth_limit: Some(3.0),
            healing_time: Some(20.0),
            inertia: Some(0.5),
            ..Wider::default()
        };
        let tip = plan.law.model.tip().clone();
        plan.law.model = Model::under(wider, tip, 0.8, 1.0).unwrap();
        judge("shape, all", &plan, gaussian);
    }
}

#[test]
fn repeated_lines_are_those_of_the_full_equations() {
    judge("gaussian", &plan(round(), (0.6, 1.0), Path::Repeat, (0.0, 5, 16.0)), gaussian);
}

/// Negative control: lines that do not feel each other differ by far more than is allowed above.
#[test]
fn lines_that_did_not_feel_each_other_would_be_found_out() {
    let with = plan(round(), (0.9, 1.0), Path::OneWay, (0.5, 2, 16.0));
    let lines = scanned(&with);
    let apart =
        (0..50).map(|i| (lines[1].x0(0.3 * f64::from(i)) - lines[0].x0(0.3 * f64::from(i))).abs());
    assert!(apart.fold(0.0, f64::max) > 0.1);
}

/// A second scan of the same line is one run with that groove, as a profile, for initial surface. The spline through
/// points 0.004 apart errs by 1e-9 in slope.
#[test]
fn a_second_scan_is_a_run_over_the_groove_of_the_first() {
    let plan = plan(round(), (0.8, 1.0), Path::Repeat, (0.0, 2, 12.0));
    let lines = scanned(&plan);
    let (positions, weights) = lines[0].residence();
    let height = |x: f64| -> f64 {
        -0.8 * positions.iter().zip(&weights).map(|(p, w)| w * gaussian(x - p, 0.0)).sum::<f64>()
    };
    let x: Vec<f64> = (0..8000).map(|i| 0.004 * f64::from(i) - 10.0).collect();
    let u = x.iter().map(|x| height(*x)).collect();
    let surface = InitialSurface::flat().with(Relief::profile(x, u).unwrap());
    let start = stickslip_tip::Start::Flat;
    let scenario = stickslip_tip::Scenario {
        start,
        start_position: 0.0,
        tolerance: 1e-10,
        ..stickslip_tip::Scenario::new(plan.law.model.clone(), 12.0)
    };
    let mut running = Running::new(&scenario, &surface).unwrap();
    let mut worst = 0.0_f64;
    while let Some(step) = running.step().unwrap() {
        worst = worst.max((step.x0(1.0, step.end()) - lines[1].x0(step.end())).abs());
    }
    assert!(worst < 1e-8, "{worst:e}");
    // Negative control.
    assert!((lines[1].x0(6.0) - lines[0].x0(6.0)).abs() > 0.05);
}

/// The volume by adding up the surface, on points so dense that the sum is exact, and by the law.
#[test]
fn every_line_takes_away_the_same_volume() {
    for (footprint, alpha, path) in [
        (round(), 0.9, Path::OneWay),
        (round(), 0.9, Path::Zigzag),
        (lobed_footprint(), 0.6, Path::OneWay),
    ] {
        let plan = plan(footprint, (alpha, 0.8), path, (0.6, 3, 14.0));
        let lines = scanned(&plan);
        for n in 1..=lines.len() {
            let x: Vec<f64> = (0..140).map(|i| 0.3 * f64::from(i) - 14.0).collect();
            let y: Vec<f64> = (0..80).map(|i| 0.3 * f64::from(i) - 12.0).collect();
            let added = 0.09 * Scanned::new(&plan, &lines[..n]).heights(&x, &y).sum();
            let by_law = -alpha * 14.0 / 0.8 * plan.footprint.integral() * n as f64;
            assert!((added - by_law).abs() < 1e-10, "{n}: {added} for {by_law}");
            assert!((volume(&plan, &lines[..n]) - by_law).abs() < 1e-10);
        }
        assert!(volume(&plan, &[]).is_sign_positive(), "-0");
    }
    assert!((round().integral() - 2.0 * std::f64::consts::PI).abs() < 1e-14);
}

/// Taken up after any line, all lines are the same to the last bit; and what no tip has done, a stretch made longer, too.
#[test]
fn a_raster_taken_up_again_is_the_same() {
    for path in [Path::OneWay, Path::Zigzag, Path::Repeat] {
        let plan = plan(round(), (0.9, 1.0), path, (0.5, 7, 12.0));
        let whole = scanned(&plan);
        for n in [0, 1, 4, 7] {
            let mut again = Scanning::resumed(&plan, whole[..n].to_vec()).unwrap();
            while again.next_line().unwrap().is_some() {}
            for (a, b) in again.lines().iter().zip(&whole) {
                assert_eq!(a.trajectory(), b.trajectory(), "{path:?} {n}");
            }
        }
    }
}
