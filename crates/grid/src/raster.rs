//! The full PDE for an area scanned line by line: heights on rows of cells, all rows within reach carved in every
//! step.
//!
//! ```text
//! x0' = -u_x(x0, Y, t) + R(t) - x0 + Fext(t),      u_t(x, y, t) = -α f(x - x0(t), y - Y)
//! ```
//!
//! There is a row at the y of every line. Rows between them are not needed, because no motion depends on them. f(x,y)
//! is a sum of products, so that a step computes one imprint for each product and adds it to every row.

use crate::cells::Cells;
use crate::marcher::Marcher;
use crate::method::run_within;
use crate::patch::Patch;
use crate::scheme::{Scheme, positive, sample};
use crate::sinc::Sinc;
use crate::tableau::{DOP853, DOPRI5, Tableau};
use crate::three_point::ThreePoint;
use crate::{Footprint, GridError, Path, Problem, Request, Start, Stepping, Wider, Work};
use std::ops::ControlFlow;

/// Discretisation of rows along x and in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowMethod {
    /// Samples interpolated by a regularised sinc, exact to round-off for a spacing of at most π over the largest
    /// wave number in f; order 8 in time.
    Sinc,
    /// The paper's grid: slopes by central differences, interpolated linearly, order 2; order 5 in time.
    ThreePoint,
}

/// Cells on either side in the support of the sinc.
const HALF_WIDTH: usize = 80;

impl RowMethod {
    fn scheme(self, footprint: Footprint<'_>, spacing: f64) -> Box<dyn Scheme + '_> {
        match self {
            Self::Sinc => Box::new(Sinc::new(footprint, spacing, HALF_WIDTH)),
            Self::ThreePoint => Box::new(ThreePoint { footprint, spacing }),
        }
    }

    fn tableau(self) -> &'static Tableau {
        match self {
            Self::Sinc => &DOP853,
            Self::ThreePoint => &DOPRI5,
        }
    }
}

/// One product g(x) h(y) of the sum f(x,y).
#[derive(Clone, Copy)]
pub struct Layer<'a> {
    /// The factor g.
    pub along: &'a dyn Fn(f64) -> f64,
    /// The factor h.
    pub across: &'a dyn Fn(f64) -> f64,
}

/// The path of the support along one line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScanLine {
    /// y of the line.
    pub y: f64,
    /// x of the support at the start.
    pub from: f64,
    /// x of the support at the end.
    pub to: f64,
}

/// Definition of a scan.
pub struct Scan<'a> {
    /// α and r.
    pub model: (f64, f64),
    /// Depth limit b, healing time T and inertia M. The initial velocity with inertia is that at the end of the line
    /// before on a zigzag, and otherwise 0.
    pub law: (Option<f64>, Option<f64>, Option<f64>),
    /// The terms of f(x,y).
    pub layers: &'a [Layer<'a>],
    /// Distances in x and y beyond which f is taken as 0.
    pub reach: (f64, f64),
    /// The lines in the order of the scan.
    pub lines: &'a [ScanLine],
    /// Whether the tip starts a line at the position where the one before has ended, instead of at the start of the
    /// line.
    pub zigzag: bool,
    /// External force on the first line, against the time since its start.
    pub force: &'a dyn Fn(f64) -> f64,
}

/// Result of a scan.
#[derive(Debug, Clone, PartialEq)]
pub struct Scanned {
    /// x0 on each line at the requested times since its start.
    pub x0: Vec<Vec<f64>>,
    /// Times since the start of each line and x0 at the ends of the grid's steps.
    pub steps: Vec<Vec<(f64, f64)>>,
    /// y of the rows, ascending.
    pub y: Vec<f64>,
    /// u after the last line at the requested points, a row for each y.
    pub u: Vec<Vec<f64>>,
    /// Cost of the scan.
    pub work: Work,
}

/// Distance from the range of the support, in reaches, at which a tip has left the grid.
const OUTSIDE: f64 = 2.0;

/// Callback at every step with the number of finished lines, including the fraction of the current one; may stop the
/// scan.
pub type LineObserver<'a> = dyn FnMut(f64) -> ControlFlow<()> + 'a;

/// Scans all lines on a flat surface; `spacing` is that of the cells. The `times` count from the start of each line and
/// are ascending. A step ends at each of them; times after the end of a line are ignored.
///
/// # Errors
/// Invalid input; a tip that leaves the grid; a step lost in round-off; [`GridError::Stopped`].
pub fn scan(
    scan: &Scan,
    (method, spacing): (RowMethod, f64),
    stepping: &Stepping,
    (times, points): (&[f64], &[f64]),
    observe: &mut LineObserver,
) -> Result<Scanned, GridError> {
    stepping.check()?;
    let mut plane = Plane::new(scan, positive(spacing)?)?;
    let (mut x0, mut steps, mut state, mut work) = (vec![], vec![], None, Work::default());
    for (n, line) in scan.lines.iter().enumerate() {
        let start = state.filter(|_| scan.zigzag).unwrap_or((line.from, 0.0));
        let mut own = vec![];
        let mut within = |part: f64| observe(n as f64 + part);
        let request =
            LineRequest { method, stepping, times, steps: &mut own, observe: &mut within };
        let (at, end, took) = plane.line(scan, n, start, request)?;
        x0.push(at);
        steps.push(own);
        state = Some(end);
        work = work.plus(&took);
    }
    let u = plane.rows.iter().map(|row| plane.read(row, method, points)).collect();
    Ok(Scanned { x0, steps, y: plane.y, u, work })
}

/// Heights on all rows.
struct Plane {
    y: Vec<f64>,
    rows: Vec<Patch>,
    spacing: f64,
    /// Range of possible positions of the tip.
    ends: (f64, f64),
}

/// x0 and x0' at the end of a line.
type State = (f64, f64);

/// Stepping and output of a line.
struct LineRequest<'a> {
    method: RowMethod,
    stepping: &'a Stepping,
    times: &'a [f64],
    steps: &'a mut Vec<(f64, f64)>,
    /// Callback for the fraction of the line done.
    observe: &'a mut LineObserver<'a>,
}

impl Plane {
    fn new(scan: &Scan, spacing: f64) -> Result<Self, GridError> {
        let mut y: Vec<f64> = scan.lines.iter().map(|line| line.y).collect();
        y.sort_by(f64::total_cmp);
        y.dedup();
        let both = || scan.lines.iter().flat_map(|line| [line.from, line.to]);
        let (low, high) =
            (both().fold(f64::INFINITY, f64::min), both().fold(f64::NEG_INFINITY, f64::max));
        let outside = OUTSIDE * scan.reach.0;
        let ends = (low - outside, high + outside);
        let beyond = scan.reach.0 + HALF_WIDTH as f64 * spacing;
        let (from, to) =
            (((ends.0 - beyond) / spacing).floor(), ((ends.1 + beyond) / spacing).ceil());
        let count = to - from + 1.0;
        let cells = count * y.len() as f64;
        if y.iter().any(|y| !y.is_finite()) || !(4.0..=1e8).contains(&cells) {
            return Err(GridError::Cells(cells));
        }
        let row = Patch { first: from as i64, values: vec![0.0; count as usize] };
        Ok(Self { rows: vec![row; y.len()], y, spacing, ends })
    }

    /// Scans one line from an initial state; returns x0 at the times within its duration, and the final state.
    fn line(
        &mut self,
        scan: &Scan,
        n: usize,
        (start, velocity): State,
        LineRequest { method, stepping, times, steps, observe }: LineRequest,
    ) -> Result<(Vec<f64>, State, Work), GridError> {
        let (line, (alpha, r)) = (scan.lines[n], scan.model);
        let duration = (line.to - line.from).abs() / r;
        let position = |t: f64| line.from + (line.to - line.from).signum() * r * t;
        let (depth_limit, healing_time, mass) = scan.law;
        let inertia = mass.map(|mass| (mass, velocity));
        let path = Some(Path { position: &position, knots: &[] });
        let wider = Wider { depth_limit, healing_time, inertia, spring: true, path };
        let section = |x: f64| scan.layers.iter().map(|l| (l.along)(x) * (l.across)(0.0)).sum();
        let footprint = Footprint::new(&section, scan.reach.0)?;
        let scheme = || method.scheme(footprint, self.spacing);
        let reader = Reader { scheme: scheme(), row: self.own_row(line.y).clone() };
        let surface = Start::new(0.0, start, |x| reader.height(x), |x| reader.slope(x));
        let problem = Problem::under(wider, scan.model, footprint, surface)?;
        let problem = if n == 0 { problem.with_force(scan.force) } else { problem };
        let nothing = |_: i64| 0.0;
        let within: Vec<f64> = times.iter().copied().filter(|t| *t < duration).collect();
        let asked = times.iter().filter(|t| **t <= duration * (1.0 + 1e-12)).count();
        let all: Vec<f64> = within.into_iter().chain([duration]).collect();
        let request = Request { times: &all, points: &[] };
        request.check(0.0)?;
        let (scheme, ends) = (scheme(), self.ends);
        let left = |t: f64| problem.wider.left_after(duration - t);
        self.rows.iter_mut().flat_map(|row| &mut row.values).for_each(|u| *u *= left(0.0));
        let mut cells_carved = 0;
        let mut carve = |visits: &[(f64, f64, f64)]| {
            let visits = visits.iter().map(|(t, x, weight)| (*x, -alpha * weight * left(*t)));
            cells_carved += self.carve(scan, line.y, &visits.collect::<Vec<_>>());
        };
        let mut step = |time: f64, x0: f64| {
            steps.push((time, x0));
            observe(time / duration)
        };
        let is_inside = |x0: f64| x0 > ends.0 && x0 < ends.1;
        let (run, velocity) = run_within(is_inside, &mut step, |observe| {
            let (cells, tableau) = (Cells::new(&nothing), method.tableau());
            Marcher::new(&problem, scheme, tableau, *stepping, cells, Some(&problem.start))
                .with_visited(&mut carve)
                .run(&request, observe)
        })?;
        let mut work = run.work;
        work.cells_updated += cells_carved;
        let mut x0 = run.x0;
        let end = x0[x0.len() - 1];
        x0.truncate(asked);
        Ok((x0, (end, velocity), work))
    }

    /// Changes all rows within reach by a step on the line at `line_y`: x0 and the change of height at its apex for each
    /// stage. Returns the number of cells.
    fn carve(&mut self, scan: &Scan, line_y: f64, visits: &[(f64, f64)]) -> u64 {
        let (reach, reach_across) = scan.reach;
        let ends =
            |(low, high): (f64, f64), visit: &(f64, f64)| (low.min(visit.0), high.max(visit.0));
        let (low, high) = visits.iter().fold((f64::INFINITY, f64::NEG_INFINITY), ends);
        let first = ((low - reach) / self.spacing).floor() as i64;
        let len = ((high + reach) / self.spacing).ceil() as i64 - first + 1;
        let (mut cells, mut imprint, mut sum) = (0, Patch::default(), Patch::default());
        for layer in scan.layers {
            let Ok(footprint) = Footprint::new(layer.along, reach) else { break };
            sum.reset(first, len as usize);
            for (x, change) in visits {
                sample(&footprint, self.spacing, *x, &mut imprint);
                sum.add(*change, &imprint);
            }
            for (y, row) in self.y.iter().zip(&mut self.rows) {
                if (y - line_y).abs() <= reach_across {
                    row.add((layer.across)(y - line_y), &sum);
                    cells += sum.values.len() as u64;
                }
            }
        }
        cells
    }

    fn own_row(&self, y: f64) -> &Patch {
        let own = self.y.partition_point(|other| *other < y);
        &self.rows[own]
    }

    fn read(&self, row: &Patch, method: RowMethod, points: &[f64]) -> Vec<f64> {
        let nothing = |_: f64| 0.0;
        let Ok(footprint) = Footprint::new(&nothing, 1.0) else { return vec![] };
        let scheme = method.scheme(footprint, self.spacing);
        let reader = Reader { scheme, row: row.clone() };
        points.iter().map(|x| reader.height(*x)).collect()
    }
}

/// Interpolation of the heights of a row before the line is scanned.
struct Reader<'a> {
    scheme: Box<dyn Scheme + 'a>,
    row: Patch,
}

impl Reader<'_> {
    fn height(&self, x: f64) -> f64 {
        let mut stencil = Patch::default();
        self.scheme.height_stencil(x, &mut stencil);
        stencil.overlap(&self.row)
    }

    fn slope(&self, x: f64) -> f64 {
        let mut stencil = Patch::default();
        self.scheme.slope_stencil(x, &mut stencil);
        stencil.overlap(&self.row)
    }
}
