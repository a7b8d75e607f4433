//! The paper's discretisation: N + 1 ordinary differential equations, all advanced at every stage.

use crate::patch::Patch;
use crate::scheme::Scheme;
use crate::stepping::{reached, too_small, towards};
use crate::three_point::ThreePoint;
use crate::unknowns::Unknowns;
use crate::{GridError, Observer, Problem, Request, Run, Stepping, Work};
use differential_equations::error::Error;
use differential_equations::methods::{DormandPrince, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;
use std::cell::{Cell, RefCell};

type Dopri5 = ExplicitRungeKutta<Ordinary, DormandPrince, f64, Unknowns, 5, 7, 7>;

/// x0 and u at the cells `first` … `first` + `len` - 1.
struct FullGrid<'a> {
    problem: &'a Problem<'a>,
    scheme: ThreePoint<'a>,
    first: i64,
    len: usize,
    stencil: RefCell<Patch>,
    /// Time and position at which a stage left the grid, if one did.
    left: Cell<Option<(f64, f64)>>,
}

impl FullGrid<'_> {
    fn x(&self, k: usize) -> f64 {
        (self.first + k as i64) as f64 * self.scheme.spacing
    }

    /// Σ stencil · u; `None` outside of the grid.
    fn read(&self, u: &[f64], stencil: &Patch) -> Option<f64> {
        let from = usize::try_from(stencil.first - self.first).ok()?;
        u.get(from..from + stencil.values.len()).map(|u| stencil.dot(u))
    }

    /// x0, the cells, and with inertia x0'.
    fn start(&self) -> Unknowns {
        let start = &self.problem.start;
        let heights = (0..self.len).map(|k| start.height(self.x(k)));
        let velocity = self.problem.wider.inertia.map(|(_, velocity)| velocity);
        Unknowns(std::iter::once(start.x0).chain(heights).chain(velocity).collect())
    }

    /// w of (61); `None` outside of the grid.
    fn weight(&self, u: &[f64], x0: f64, stencil: &mut Patch) -> Option<f64> {
        if self.problem.wider.depth_limit.is_none() {
            return Some(1.0);
        }
        self.scheme.height_stencil(x0, stencil);
        self.read(u, stencil).map(|height| self.problem.wider.weight(height))
    }

    /// u(x) at time t.
    fn height(&self, t: f64, u: &[f64], x: f64) -> f64 {
        let mut stencil = Patch::default();
        self.scheme.height_stencil(x, &mut stencil);
        let left = || self.problem.left_of_start(t) * self.problem.start.height(x);
        self.read(u, &stencil).unwrap_or_else(left)
    }
}

impl ODE<f64, Unknowns> for FullGrid<'_> {
    fn diff(&self, t: f64, y: &Unknowns, dydt: &mut Unknowns) {
        let (x0, u) = (y.0[0], &y.0[1..=self.len]);
        let mut stencil = self.stencil.borrow_mut();
        self.scheme.slope_stencil(x0, &mut stencil);
        let slope = self.read(u, &stencil);
        let weight = self.weight(u, x0, &mut stencil);
        if slope.is_none() && x0.is_finite() {
            self.left.set(Some((t, x0)));
        }
        let force = self.problem.velocity(t, x0, slope.unwrap_or(f64::NAN));
        dydt.0[0] = force;
        if let Some((mass, _)) = self.problem.wider.inertia {
            let velocity = y.0[1 + self.len];
            dydt.0[0] = velocity;
            dydt.0[1 + self.len] = (force - velocity) / mass;
        }
        let alpha = self.problem.alpha * weight.unwrap_or(f64::NAN);
        for (k, rate) in dydt.0[1..=self.len].iter_mut().enumerate() {
            *rate = -alpha * self.problem.footprint.value(self.x(k) - x0);
        }
        if let Some(time) = self.problem.wider.healing_time {
            let rates = dydt.0[1..=self.len].iter_mut();
            rates.zip(u).for_each(|(rate, u)| *rate -= u / time);
        }
    }
}

/// A run on the cells from `from` to `to`.
pub(crate) fn run(
    problem: &Problem,
    (spacing, from, to): (f64, f64, f64),
    stepping: &Stepping,
    request: &Request,
    observe: &mut Observer,
) -> Result<Run, GridError> {
    let first = (from / spacing).ceil();
    let len = (to / spacing).floor() - first + 1.0;
    if !(4.0..=2_147_483_648.0).contains(&len) {
        return Err(GridError::Domain { from, to });
    }
    let grid = FullGrid {
        problem,
        scheme: ThreePoint { footprint: problem.footprint, spacing },
        first: first as i64,
        len: len as usize,
        stencil: RefCell::default(),
        left: Cell::new(None),
    };
    let mut runner = Runner::new(&grid, stepping, request)?;
    let mut x0 = Vec::with_capacity(request.times.len());
    for &time in request.times {
        runner.advance_to(time, observe)?;
        x0.push(runner.solver.y().0[0]);
    }
    let u = request
        .points
        .iter()
        .map(|&x| grid.height(runner.t, &runner.solver.y().0[1..=grid.len], x))
        .collect();
    Ok(Run { x0, u, work: runner.work })
}

/// The integrator of the crate, called from one requested time to the next.
struct Runner<'g> {
    grid: &'g FullGrid<'g>,
    solver: Dopri5,
    t: f64,
    work: Work,
}

impl<'g> Runner<'g> {
    fn new(
        grid: &'g FullGrid<'g>,
        stepping: &Stepping,
        request: &Request,
    ) -> Result<Self, GridError> {
        let t = grid.problem.start.time;
        let end = request.times.last().map_or(t, |&end| end).max(t + 1.0);
        let step = stepping.first_step.min(stepping.max_step).min(end - t);
        let mut solver = Dopri5::dopri5()
            .rtol(stepping.rtol)
            .atol(stepping.atol)
            .h0(step)
            .h_max(stepping.max_step)
            .max_steps(usize::MAX);
        let mut work = Work::default();
        let evaluations =
            solver.init(grid, t, end, &grid.start()).map_err(|e| grid.explain(&e, t, step))?;
        grid.count(&mut work, evaluations.function);
        Ok(Self { grid, solver, t, work })
    }

    fn advance_to(&mut self, target: f64, observe: &mut Observer) -> Result<(), GridError> {
        while !reached(self.t, target) {
            let proposed = self.solver.h();
            let end = self.grid.problem.wider.next_knot(self.t).min(target);
            let h = towards(end, self.t, proposed);
            if too_small(h, self.t) && h < target - self.t {
                return Err(self.grid.departure(GridError::StepTooSmall { time: self.t, step: h }));
            }
            self.solver.set_h(h);
            let evaluations =
                self.solver.step(self.grid).map_err(|e| self.grid.explain(&e, self.t, h))?;
            self.grid.count(&mut self.work, evaluations.function);
            if matches!(self.solver.status(), Status::RejectedStep) {
                self.work.rejected += 1;
                continue;
            }
            self.work.steps += 1;
            self.t = self.solver.t();
            if h < proposed {
                self.solver.set_h(proposed.max(self.solver.h()));
            }
            if observe(self.t, self.solver.y().0[0]).is_break() {
                return Err(GridError::Stopped { time: self.t });
            }
        }
        Ok(())
    }
}

impl FullGrid<'_> {
    fn count(&self, work: &mut Work, evaluations: usize) {
        work.right_hand_sides += evaluations as u64;
        work.cells_updated += (evaluations * self.len) as u64;
    }

    /// The error that the tip left the grid, if it did, and `otherwise` if not.
    fn departure(&self, otherwise: GridError) -> GridError {
        self.left.get().map_or(otherwise, |(time, x0)| GridError::LeftGrid { time, x0 })
    }

    fn explain(&self, error: &Error<f64, Unknowns>, time: f64, step: f64) -> GridError {
        self.departure(match error {
            Error::Stiffness { t, .. } => GridError::Stiff { time: *t },
            _ => GridError::StepTooSmall { time, step },
        })
    }
}
