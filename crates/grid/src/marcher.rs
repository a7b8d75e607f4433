//! The integrator that updates only the cells within reach of the tip.

use crate::cells::Cells;
use crate::patch::Patch;
use crate::scheme::Scheme;
use crate::stepping::{Control, blend, reached, too_small, towards};
use crate::tableau::Tableau;
use crate::{GridError, Observer, Problem, Request, Run, Start, Stepping, Work};

/// An embedded Runge–Kutta step of the tip and of all cells. Three savings change results by round-off only: f is
/// evaluated only within its reach around the tip. Stage values of cells are computed only where the tip reads the
/// slope. All other cells are unchanged.
pub(crate) struct Marcher<'a> {
    problem: &'a Problem<'a>,
    scheme: Box<dyn Scheme + 'a>,
    tableau: &'static Tableau,
    stepping: Stepping,
    control: Control,
    cells: Cells<'a>,
    /// The initial surface u0, added if the cells contain only u - u0.
    background: Option<&'a Start<'a>>,
    t: f64,
    x0: f64,
    /// x0', with inertia only.
    velocity: f64,
    /// Reference time s: the cells contain e^{(t - s)/T} times the heights.
    since: f64,
    stages: Vec<Stage>,
    scratch: Scratch,
    work: Work,
    /// Callback for the positions of the tip in every accepted step.
    visited: Option<&'a mut Visited<'a>>,
}

/// Callback for the contribution of a step to ∫ w g(x0) dt: for each stage its time, x0, and h b w.
pub(crate) type Visited<'a> = dyn FnMut(&[(f64, f64, f64)]) + 'a;

/// Time, x0, w, x0', x0'' with inertia, and the imprint at one stage.
#[derive(Default, Clone)]
struct Stage {
    time: f64,
    position: f64,
    weight: f64,
    velocity: f64,
    acceleration: f64,
    imprint: Patch,
}

#[derive(Default)]
struct Scratch {
    stencil: Patch,
    local: Patch,
    carved: Patch,
    errors: [Patch; 2],
}

impl<'a> Marcher<'a> {
    pub(crate) fn new(
        problem: &'a Problem<'a>,
        scheme: Box<dyn Scheme + 'a>,
        tableau: &'static Tableau,
        stepping: Stepping,
        cells: Cells<'a>,
        background: Option<&'a Start<'a>>,
    ) -> Self {
        let control = Control::new(tableau.order, &stepping);
        let stages = vec![Stage::default(); tableau.stages()];
        let (t, x0) = (problem.start.time, problem.start.x0);
        let (scratch, work) = (Scratch::default(), Work::default());
        let velocity = problem.wider.inertia.map_or(0.0, |(_, velocity)| velocity);
        Self {
            problem,
            scheme,
            tableau,
            stepping,
            control,
            cells,
            background,
            t,
            x0,
            velocity,
            since: t,
            stages,
            scratch,
            work,
            visited: None,
        }
    }

    /// Adds a callback for the positions of the tip in every accepted step.
    pub(crate) fn with_visited(self, visited: &'a mut Visited<'a>) -> Self {
        Self { visited: Some(visited), ..self }
    }

    /// Runs to the last requested time; also returns x0' there, with inertia.
    pub(crate) fn run(
        mut self,
        request: &Request,
        observe: &mut Observer,
    ) -> Result<(Run, f64), GridError> {
        let mut x0 = Vec::with_capacity(request.times.len());
        self.evaluate(0, self.t, self.x0, 0.0);
        for &time in request.times {
            self.advance_to(time, observe)?;
            x0.push(self.x0);
        }
        let u = request.points.iter().map(|&x| self.height(x)).collect();
        Ok((Run { x0, u, work: self.work }, self.velocity))
    }

    fn advance_to(&mut self, target: f64, observe: &mut Observer) -> Result<(), GridError> {
        while !reached(self.t, target) {
            let end = self.problem.wider.next_knot(self.t).min(target);
            let h = towards(end, self.t, self.control.step);
            if too_small(h, self.t) && h < target - self.t {
                return Err(GridError::StepTooSmall { time: self.t, step: h });
            }
            let x0 = self.stages_of_step(h);
            let error = x0.map_or(f64::INFINITY, |x0| self.carve_and_estimate(h, x0));
            let accepted = self.control.judge(h, error);
            let Some(x0) = x0.filter(|_| accepted) else {
                self.work.rejected += 1;
                continue;
            };
            self.accept(h, x0);
            if observe(self.t, self.x0).is_break() {
                return Err(GridError::Stopped { time: self.t });
            }
        }
        self.t = target;
        Ok(())
    }

    /// Evaluates all stages except the first, which is available; returns x0(t + h).
    fn stages_of_step(&mut self, h: f64) -> Option<f64> {
        for i in 1..self.tableau.stages() {
            let x = self.moved(h, self.tableau.a[i])?;
            self.evaluate(i, self.t + self.tableau.c[i] * h, x, h);
        }
        self.moved(h, self.tableau.b)
    }

    /// x0 + h Σ weight · velocity; `None` if that is not finite or a reach away, because the step is far too long.
    fn moved(&self, h: f64, weights: &[f64]) -> Option<f64> {
        let distance = h * self.slope(weights, |stage| stage.velocity);
        (distance.abs() <= self.problem.footprint.reach()).then_some(self.x0 + distance)
    }

    /// Σ weight · rate over the stages
    fn slope(&self, weights: &[f64], rate: impl Fn(&Stage) -> f64) -> f64 {
        weights.iter().zip(&self.stages).map(|(w, stage)| w * rate(stage)).sum()
    }

    /// Stage `i`, at time `t` and position `x`, from the stages before it in a step of length `h`.
    fn evaluate(&mut self, i: usize, t: f64, x: f64, h: f64) {
        let wider = &self.problem.wider;
        let (left, left_of_start) =
            (wider.left_after(t - self.since), self.problem.left_of_start(t));
        self.scheme.slope_stencil(x, &mut self.scratch.stencil);
        let background = self.background.map_or(0.0, |u0| left_of_start * u0.slope(x));
        let slope = left * self.read(i, h) + background;
        let weight = if wider.depth_limit.is_some() {
            self.scheme.height_stencil(x, &mut self.scratch.stencil);
            let background = self.background.map_or(0.0, |u0| left_of_start * u0.height(x));
            wider.weight(left * self.read(i, h) + background)
        } else {
            1.0
        };
        let force = self.problem.velocity(t, x, slope);
        let (velocity, acceleration) = match wider.inertia {
            None => (force, 0.0),
            Some((mass, _)) => {
                let before = &self.stages[..i];
                let gained = self.tableau.a[i].iter().zip(before);
                let gained: f64 = gained.map(|(a, stage)| a * stage.acceleration).sum();
                let velocity = self.velocity + h * gained;
                (velocity, (force - velocity) / mass)
            }
        };
        let stage = &mut self.stages[i];
        (stage.time, stage.position, stage.weight) = (t, x, weight);
        (stage.velocity, stage.acceleration) = (velocity, acceleration);
        self.scheme.imprint(x, &mut stage.imprint);
        let weight = weight / left;
        if (weight - 1.0).abs() > 0.0 {
            stage.imprint.values.iter_mut().for_each(|value| *value *= weight);
        }
        self.work.right_hand_sides += 1;
        self.work.cells_updated += stage.imprint.values.len() as u64;
    }

    /// The value of the stencil in the scratch storage on the cells of stage `i`.
    fn read(&mut self, i: usize, h: f64) -> f64 {
        let Scratch { stencil, local, .. } = &mut self.scratch;
        local.reset(stencil.first, stencil.values.len());
        local.values.copy_from_slice(self.cells.range(stencil.first, stencil.values.len()));
        for (weight, stage) in self.tableau.a[i].iter().zip(&self.stages[..i]) {
            local.add(-self.problem.alpha * h * weight, &stage.imprint);
        }
        stencil.dot(&local.values)
    }

    /// Computes the new cells in the scratch storage; returns the error relative to its limit.
    fn carve_and_estimate(&mut self, h: f64, x0: f64) -> f64 {
        let first = self.stages.iter().map(|s| s.imprint.first).min().unwrap_or(0);
        let end = self.stages.iter().map(|s| s.imprint.end()).max().unwrap_or(0);
        let len = (end - first) as usize;
        let (carving, tableau) = (-self.problem.alpha * h, &self.tableau);
        let Scratch { carved, errors, .. } = &mut self.scratch;
        combine(carved, first, len, carving, tableau.b, &self.stages);
        combine(&mut errors[0], first, len, carving, tableau.error, &self.stages);
        combine(&mut errors[1], first, len, carving, tableau.error3, &self.stages);
        // `max` below would swallow a NaN.
        if errors[0].values.iter().sum::<f64>().is_nan() {
            return f64::INFINITY;
        }
        let before = self.cells.range(first, len);
        let mut largest = [0.0_f64; 2];
        for ((k, u), du) in before.iter().enumerate().zip(&carved.values) {
            let allowed = self.stepping.allowed(*u, u + du);
            for (largest, error) in largest.iter_mut().zip(&*errors) {
                *largest = largest.max(error.values[k].abs() / allowed);
            }
        }
        let allowed = self.stepping.allowed(self.x0, x0);
        let [fifth, third] = [&tableau.error, &tableau.error3]
            .map(|weights| h * self.slope(weights, |stage| stage.velocity).abs() / allowed);
        let turned = [&tableau.error, &tableau.error3]
            .map(|weights| h * self.slope(weights, |stage| stage.acceleration).abs() / allowed);
        blend(largest[0].max(fifth).max(turned[0]), largest[1].max(third).max(turned[1]))
    }

    fn accept(&mut self, h: f64, x0: f64) {
        let carved = &self.scratch.carved;
        let cells = self.cells.range(carved.first, carved.values.len());
        for (cell, du) in cells.iter_mut().zip(&carved.values) {
            *cell += du;
        }
        if let Some(visited) = &mut self.visited {
            let visit =
                |(b, stage): (&f64, &Stage)| (stage.time, stage.position, h * b * stage.weight);
            let visits: Vec<_> = self.tableau.b.iter().zip(&self.stages).map(visit).collect();
            visited(&visits);
        }
        self.velocity += h * self.slope(self.tableau.b, |stage| stage.acceleration);
        self.t += h;
        self.x0 = x0;
        self.work.steps += 1;
        let knot = self.problem.wider.next_knot(self.t - h) <= self.t;
        if self.problem.wider.healing_time.is_some() {
            self.cells.scale(self.problem.wider.left_after(self.t - self.since));
            self.since = self.t;
            self.evaluate(0, self.t, x0, h);
        } else if self.tableau.first_same_as_last && !knot {
            let last = self.stages.len() - 1;
            self.stages.swap(0, last);
        } else {
            self.evaluate(0, self.t, x0, h);
        }
    }

    fn height(&mut self, x: f64) -> f64 {
        let stencil = &mut self.scratch.stencil;
        self.scheme.height_stencil(x, stencil);
        let cells = (stencil.first..).map(|cell| self.cells.at(cell));
        let sum: f64 = stencil.values.iter().zip(cells).map(|(weight, w)| weight * w).sum();
        let left = self.problem.left_of_start(self.t);
        sum + self.background.map_or(0.0, |u0| left * u0.height(x))
    }
}

/// `out` = `factor` Σ weight · imprint over the stages, at `len` cells from `first`.
fn combine(
    out: &mut Patch,
    first: i64,
    len: usize,
    factor: f64,
    weights: &[f64],
    stages: &[Stage],
) {
    out.reset(first, len);
    for (weight, stage) in weights.iter().zip(stages) {
        if weight.abs() > 0.0 {
            out.add(factor * weight, &stage.imprint);
        }
    }
}
