//! An area scanned line by line by a tip that is free in both coordinates.

use super::marcher::Marcher;
use super::problem::PlaneProblem;
use super::product::{self, Product};
use super::sheet::Sheet;
use super::start::PlaneStart;
use super::tensor::{Factors, PlaneMethod, Tensor};
use crate::{GridError, LineObserver, Path, PlaneRequest, ScanLine, Stepping, Wider, Work};

/// Definition of a scan.
pub struct PlaneScan<'a> {
    /// α and r.
    pub model: (f64, f64),
    /// Depth limit b, healing time T and inertia M. The initial velocity with inertia is that at the end of the line
    /// before on a zigzag, and otherwise 0.
    pub law: (Option<f64>, Option<f64>, Option<f64>),
    /// Stiffness κ_y of the spring across the lines.
    pub stiffness_across: f64,
    /// The terms of f(x,y).
    pub products: &'a [Product],
    /// The lines in the order of the scan.
    pub lines: &'a [ScanLine],
    /// Whether the tip starts a line where the one before has ended, instead of at the start of the line.
    pub zigzag: bool,
    /// y0 minus the y of the first line, at the start of this line.
    pub kick: f64,
    /// (F_x, F_y) on the first line, against the time since its start.
    pub force: &'a dyn Fn(f64) -> [f64; 2],
}

/// Result of a scan.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneScanned {
    /// (x0, y0) on each line at the requested times since its start.
    pub position: Vec<Vec<[f64; 2]>>,
    /// Times since the start of each line and (x0, y0) at the ends of the grid's steps.
    pub steps: Vec<Vec<(f64, [f64; 2])>>,
    /// u after the last line at the requested points.
    pub u: Vec<f64>,
    /// Cost of the scan.
    pub work: Work,
}

/// (x0, y0) and x0' at the end of a line.
type State = ([f64; 2], f64);

/// Scans all lines on a flat surface. The `times` count from the start of each line and are ascending. A step ends at
/// each of them; times after the end of a line are ignored.
///
/// # Errors
/// Invalid input; a step lost in round-off; [`GridError::Stopped`].
pub fn scan_plane(
    scan: &PlaneScan,
    method: &PlaneMethod,
    stepping: &Stepping,
    (times, points): (&[f64], &[[f64; 2]]),
    observe: &mut LineObserver,
) -> Result<PlaneScanned, GridError> {
    stepping.check()?;
    product::check(scan.products)?;
    PlaneRequest { times, points }.check(0.0)?;
    let factors = Factors::new(scan.products);
    let discretisation = (method, &Tensor::new(method, &factors)?);
    let mut sheet = Sheet::default();
    let mut scanned =
        PlaneScanned { position: vec![], steps: vec![], u: vec![], work: Work::default() };
    let mut state = None;
    for (n, line) in scan.lines.iter().enumerate() {
        let kick = if n == 0 { scan.kick } else { 0.0 };
        let start = ([line.from, line.y + kick], 0.0);
        let (at, velocity) = state.filter(|_| scan.zigzag).unwrap_or(start);
        let position = |t: f64| line.from + (line.to - line.from).signum() * scan.model.1 * t;
        let problem = problem(scan, (n, line), &position, (at, velocity));
        problem.check()?;
        let duration = (line.to - line.from).abs() / scan.model.1;
        let mut marcher = Marcher::new(&problem, discretisation, *stepping, &mut sheet);
        let (mut steps, mut positions) = (vec![], vec![]);
        let mut within = |t: f64, position: [f64; 2]| {
            steps.push((t, position));
            observe(n as f64 + t / duration)
        };
        for time in times.iter().filter(|time| **time <= duration) {
            positions.push(marcher.advance_to(*time, &mut within)?);
        }
        state = Some((marcher.advance_to(duration, &mut within)?, marcher.velocity));
        marcher.settle();
        if n + 1 == scan.lines.len() {
            scanned.u = points.iter().map(|point| marcher.height(*point)).collect();
        }
        scanned.work = scanned.work.plus(&marcher.work);
        scanned.position.push(positions);
        scanned.steps.push(steps);
    }
    Ok(scanned)
}

/// The problem of one line, without the surface that earlier lines left.
fn problem<'a>(
    scan: &PlaneScan<'a>,
    (n, line): (usize, &ScanLine),
    position: &'a dyn Fn(f64) -> f64,
    (at, velocity): State,
) -> PlaneProblem<'a> {
    let (depth_limit, healing_time, mass) = scan.law;
    let inertia = mass.map(|mass| (mass, velocity));
    let path = Some(Path { position, knots: &[] });
    PlaneProblem {
        model: scan.model,
        stiffness_across: scan.stiffness_across,
        line: line.y,
        products: scan.products,
        wider: Wider { depth_limit, healing_time, inertia, spring: true, path },
        force: if n == 0 { scan.force } else { &|_| [0.0; 2] },
        start: PlaneStart::flat(0.0, at),
    }
}
