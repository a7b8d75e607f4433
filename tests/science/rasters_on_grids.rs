//! Rasters against the full equations on rows of cells (`stickslip_grid::scan`), which shares no code with them but the
//! formula of the footprint; and that grid against its own refinement.

use std::f64::consts::PI;
use std::ops::ControlFlow;
use stickslip_grid::{Layer, RowMethod, Scan, ScanLine, Stepping, scan};
use stickslip_raster::{Area, AreaLine, Path, Plan, Scanned, Scanning};
use stickslip_tip::{Footprint, Gaussian, Model, TipFunction, Wider};

/// π over the band of a Gaussian of width 1.
const EXACT: f64 = PI / 8.7;
/// Of heights, so much may be missed; of x0 a tenth.
const HEIGHTS: f64 = 2e-7;

fn triple(x: f64) -> f64 {
    let bell = |x: f64| (-0.5 * x * x).exp();
    bell(x) - 0.5 * (bell(x + 2.0) + bell(x - 2.0))
}

fn gaussian(x: f64) -> f64 {
    (-0.5 * x * x).exp()
}

/// Centres and amplitudes of Gaussians of width 1: a lobe ahead, another behind, and f'(0) = 0.
fn sides() -> [(f64, f64); 3] {
    let slope = |center: f64| center * gaussian(center);
    [(0.0, 1.0), (2.0, -0.4), (-1.5, 0.4 * slope(2.0) / slope(-1.5))]
}

fn two_sided(x: f64) -> f64 {
    sides().map(|(center, amplitude)| amplitude * gaussian(x - center)).iter().sum()
}

/// The other way round.
fn mirrored(x: f64) -> f64 {
    two_sided(-x)
}

fn two_sided_tip() -> TipFunction {
    let term = |(center, amplitude)| Gaussian { amplitude, center, width: 1.0 };
    TipFunction::asymmetric_sum(sides().map(term).to_vec()).unwrap()
}

type Section = fn(f64) -> f64;

struct Case {
    name: &'static str,
    f: Section,
    width_y: f64,
    alpha: f64,
    wider: Wider,
    path: Path,
    area: Area,
}

fn rectangle() -> Area {
    Area::Rectangle { pitch: 0.5, lines: 6, length: 20.0 }
}

fn plan(case: &Case) -> Plan {
    let tip = match case.name.split([' ', ',']).next() {
        Some("triple") => TipFunction::triple_gaussian(1.0, 1.0).unwrap(),
        Some("two-sided") => two_sided_tip(),
        Some("mirrored") => two_sided_tip().mirrored(),
        _ => TipFunction::gaussian(1.0).unwrap(),
    };
    let footprint = Footprint::separable(tip.clone(), case.width_y).unwrap();
    let model = Model::under(case.wider, tip, case.alpha, 0.9).unwrap();
    let mut plan = Plan::over(footprint, model, case.path, case.area.clone());
    plan.law.tolerance = 1e-11;
    plan
}

/// Motions and heights on the grid, at these times and points.
fn on_grid(
    case: &Case,
    (method, spacing, tolerance): (RowMethod, f64, f64),
    (times, points): (&[f64], &[f64]),
) -> stickslip_grid::Scanned {
    let lines: Vec<AreaLine> = match &case.area {
        Area::Lines(lines) => lines.clone(),
        Area::Rectangle { pitch, lines, length } => (0..*lines)
            .map(|n| AreaLine { y: pitch * n as f64, start: 0.0, length: *length })
            .collect(),
    };
    let is_zigzag = case.path == Path::Zigzag;
    let way = |(n, line): (usize, &AreaLine)| {
        let (low, high) = (line.start, line.start + line.length);
        let (from, to) = if is_zigzag && n % 2 == 1 { (high, low) } else { (low, high) };
        ScanLine { y: line.y, from, to }
    };
    let lines: Vec<ScanLine> = lines.iter().enumerate().map(way).collect();
    let across = |y: f64| gaussian(y / case.width_y);
    let law = case.wider;
    let asked = Scan {
        model: (case.alpha, 0.9),
        law: (law.depth_limit, law.healing_time, law.inertia),
        layers: &[Layer { along: &case.f, across: &across }],
        reach: (11.0, 9.0 * case.width_y),
        lines: &lines,
        zigzag: is_zigzag,
        force: &|_| 0.0,
    };
    let stepping = Stepping::absolute(tolerance);
    let mut go_on = |_: f64| ControlFlow::Continue(());
    scan(&asked, (method, spacing), &stepping, (times, points), &mut go_on).unwrap()
}

fn cases() -> Vec<Case> {
    let papers = Wider::default();
    let limited = Wider { depth_limit: Some(3.0), ..papers };
    let all = Wider { healing_time: Some(15.0), inertia: Some(0.4), ..limited };
    let case = |name, f, width_y, alpha, wider, path| Case {
        name,
        f,
        width_y,
        alpha,
        wider,
        path,
        area: rectangle(),
    };
    let line = |(y, start, length): (f64, f64, f64)| AreaLine { y, start, length };
    let shape = [(0.0, -4.0, 14.0), (0.6, -4.5, 15.0), (1.2, 3.0, 8.0), (0.6, 2.0, 9.0)];
    let shape = Area::Lines(shape.into_iter().map(line).collect());
    let repeated = Area::Rectangle { pitch: 0.0, lines: 3, length: 20.0 };
    vec![
        case("gaussian", gaussian, 1.0, 0.7, papers, Path::OneWay),
        case("gaussian zigzag", gaussian, 1.6, 0.6, papers, Path::Zigzag),
        case("triple", triple, 1.0, 0.8, papers, Path::OneWay),
        case("triple limited", triple, 1.0, 1.5, limited, Path::OneWay),
        case("triple limited zigzag", triple, 1.6, 1.5, limited, Path::Zigzag),
        case("gaussian, all, zigzag", gaussian, 1.0, 0.9, all, Path::Zigzag),
        Case { area: shape.clone(), ..case("shape", gaussian, 1.0, 0.7, papers, Path::Zigzag) },
        case("two-sided", two_sided, 1.0, 0.7, papers, Path::OneWay),
        case("mirrored", mirrored, 1.0, 0.7, papers, Path::OneWay),
        case("two-sided, zigzag", two_sided, 1.0, 0.8, papers, Path::Zigzag),
        case("two-sided, all, zigzag", two_sided, 1.6, 0.9, all, Path::Zigzag),
        Case { area: shape, ..case("two-sided shape", two_sided, 1.0, 0.7, papers, Path::Zigzag) },
        Case {
            area: repeated,
            ..case("two-sided, repeated", two_sided, 1.0, 0.5, papers, Path::Repeat)
        },
    ]
}

/// x0 on every line to 2e-8, heights to 2e-7, with steps of a local error of 1e-11; of 1e-13 under a depth limit, where the
/// grid steps over the corner of |u| and errs by 5e-8 at 1e-11, the raster by 2e-12.
#[test]
fn rasters_are_those_of_the_full_equations_on_rows_of_cells() {
    for case in cases() {
        let plan = plan(&case);
        let mut scanning = Scanning::new(&plan).unwrap();
        while scanning.next_line().unwrap().is_some() {}
        let lines = scanning.into_lines();
        let times: Vec<f64> = (0..56).map(|i| 0.4 * f64::from(i)).collect();
        let points: Vec<f64> = (0..90).map(|i| 0.37 * f64::from(i) - 8.0).collect();
        let tolerance = if case.wider.depth_limit.is_some() { 1e-13 } else { 1e-11 };
        let grid = on_grid(&case, (RowMethod::Sinc, EXACT, tolerance), (&times, &points));
        let mut worst = [0.0_f64; 2];
        for (line, x0) in lines.iter().zip(&grid.x0) {
            let end = line.trajectory().end();
            assert_eq!(x0.len(), times.iter().filter(|t| **t <= end).count(), "{}", case.name);
            for (t, x0) in times.iter().zip(x0) {
                worst[0] = worst[0].max((line.x0(*t) - x0).abs());
            }
        }
        let heights = Scanned::new(&plan, &lines).heights(&points, &grid.y);
        for ((n, i), u) in heights.indexed_iter() {
            worst[1] = worst[1].max((grid.u[n][i] - u).abs());
        }
        println!("{}: x0 {:.1e}, u {:.1e}, {:?}", case.name, worst[0], worst[1], grid.work);
        assert!(worst[0] < 0.1 * HEIGHTS && worst[1] < HEIGHTS, "{}: {worst:?}", case.name);
    }
}

/// What symmetrising hides: the even part of a tip whose sides differ moves otherwise, to and fro.
#[test]
fn the_even_part_of_a_tip_with_two_sides_moves_otherwise() {
    let case = cases().into_iter().find(|case| case.name == "two-sided, zigzag").unwrap();
    let even = sides().into_iter().flat_map(|(center, amplitude)| {
        [center, -center].map(|center| Gaussian { amplitude: 0.5 * amplitude, center, width: 1.0 })
    });
    let tip = TipFunction::gaussian_sum(even.collect()).unwrap();
    let mut plan = plan(&case);
    plan.footprint = Footprint::separable(tip.clone(), case.width_y).unwrap();
    plan.law.model = Model::new(tip, case.alpha, 0.9).unwrap();
    let times: Vec<f64> = (0..20).map(f64::from).collect();
    let grid = on_grid(&case, (RowMethod::Sinc, EXACT, 1e-9), (&times, &[]));
    let mut scanning = Scanning::new(&plan).unwrap();
    for x0 in &grid.x0[..2] {
        let line = scanning.next_line().unwrap().unwrap();
        let off = times.iter().zip(x0).map(|(t, x0)| (line.x0(*t) - x0).abs()).fold(0.0, f64::max);
        println!("{off:.2}");
        assert!(off > 0.01, "{off}");
    }
}

/// A finer lattice changes nothing, and a coarser one much: it is exact to round-off where it is said to be. A looser
/// tolerance shows, as the time integration is the only error.
#[test]
fn the_rows_of_cells_are_converged() {
    let case = &cases()[0];
    let times: Vec<f64> = (0..20).map(f64::from).collect();
    let x0 = |spacing: f64, tolerance: f64| -> Vec<f64> {
        on_grid(case, (RowMethod::Sinc, spacing, tolerance), (&times, &[0.0])).x0.concat()
    };
    let best = x0(0.8 * EXACT, 1e-12);
    let off =
        |found: Vec<f64>| best.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (same, loose, coarse) =
        (off(x0(EXACT, 1e-12)), off(x0(EXACT, 1e-6)), off(x0(2.5 * EXACT, 1e-12)));
    println!("{same:.1e} {loose:.1e} {coarse:.1e}");
    assert!(same < 1e-9 && loose > 10.0 * same && coarse > 1e-5, "{same:e} {loose:e} {coarse:e}");
}

/// The second-order rows come to the raster as the square of their spacing.
#[test]
fn rows_as_in_the_papers_grid_converge_at_second_order() {
    let case = &cases()[0];
    let times: Vec<f64> = (0..20).map(f64::from).collect();
    let x0 = |method, spacing: f64| -> Vec<f64> {
        on_grid(case, (method, spacing, 1e-9), (&times, &[0.0])).x0.concat()
    };
    let best = x0(RowMethod::Sinc, EXACT);
    let off = |spacing: f64| {
        let found = x0(RowMethod::ThreePoint, spacing);
        best.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let errors = [0.08, 0.04, 0.02].map(off);
    println!("{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.7..2.4).contains(&order), "{errors:?}");
    }
}
