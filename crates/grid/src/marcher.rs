//! The stepper that touches only the cells within reach of the tip.

use crate::cells::Cells;
use crate::control::{Control, reached, too_small, towards};
use crate::patch::Patch;
use crate::scheme::Scheme;
use crate::tableau::Tableau;
use crate::{GridError, Observer, Problem, Request, Run, Start, Stepping, Work};

/// An embedded Runge–Kutta step of the tip and of all cells, with three savings that change no result
/// but for round-off: f is evaluated only within its reach of the tip's stage position; the cells'
/// stage values are formed only where the tip reads the slope; a step leaves all other cells alone.
pub(crate) struct Marcher<'a, S> {
    problem: &'a Problem<'a>,
    scheme: S,
    tableau: Tableau,
    stepping: Stepping,
    control: Control,
    cells: Cells<'a>,
    /// Added to what the cells say: u0, where they hold only u - u0.
    background: Option<&'a Start<'a>>,
    t: f64,
    x0: f64,
    stages: Vec<Stage>,
    scratch: Scratch,
    work: Work,
}

/// x0' and the imprint at one stage.
#[derive(Default, Clone)]
struct Stage {
    velocity: f64,
    imprint: Patch,
}

#[derive(Default)]
struct Scratch {
    stencil: Patch,
    local: Patch,
    carved: Patch,
    errors: [Patch; 2],
}

impl<'a, S: Scheme> Marcher<'a, S> {
    pub(crate) fn new(
        problem: &'a Problem<'a>,
        scheme: S,
        tableau: Tableau,
        stepping: Stepping,
        cells: Cells<'a>,
        background: Option<&'a Start<'a>>,
    ) -> Self {
        let control = Control::new(tableau.order, &stepping);
        let stages = vec![Stage::default(); tableau.stages()];
        let (t, x0) = (problem.start.time, problem.start.x0);
        let (scratch, work) = (Scratch::default(), Work::default());
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
            stages,
            scratch,
            work,
        }
    }

    /// Runs through the requested times.
    pub(crate) fn run(
        mut self,
        request: &Request,
        observe: &mut Observer,
    ) -> Result<Run, GridError> {
        let mut x0 = Vec::with_capacity(request.times.len());
        self.evaluate(0, self.t, self.x0, 0.0);
        for &time in request.times {
            self.advance_to(time, observe)?;
            x0.push(self.x0);
        }
        let u = request.points.iter().map(|&x| self.height(x)).collect();
        Ok(Run { x0, u, work: self.work })
    }

    fn advance_to(&mut self, target: f64, observe: &mut Observer) -> Result<(), GridError> {
        while !reached(self.t, target) {
            let h = towards(target, self.t, self.control.step);
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

    /// All stages but the first, which is there already; returns x0(t + h).
    fn stages_of_step(&mut self, h: f64) -> Option<f64> {
        for i in 1..self.tableau.stages() {
            let x = self.moved(h, &self.tableau.a[i])?;
            self.evaluate(i, self.t + self.tableau.c[i] * h, x, h);
        }
        self.moved(h, &self.tableau.b)
    }

    /// x0 + h Σ weight · velocity, unless that is not finite or a whole reach away: far too long a step.
    fn moved(&self, h: f64, weights: &[f64]) -> Option<f64> {
        let distance = h * self.velocity(weights);
        (distance.abs() <= self.problem.footprint.reach()).then_some(self.x0 + distance)
    }

    /// Σ weight · velocity over the stages
    fn velocity(&self, weights: &[f64]) -> f64 {
        weights.iter().zip(&self.stages).map(|(w, stage)| w * stage.velocity).sum()
    }

    /// Stage `i`, at time `t` and position `x`, from the stages before it in a step of length `h`.
    fn evaluate(&mut self, i: usize, t: f64, x: f64, h: f64) {
        let Scratch { stencil, local, .. } = &mut self.scratch;
        self.scheme.slope_stencil(x, stencil);
        local.reset(stencil.first, stencil.values.len());
        local.values.copy_from_slice(self.cells.range(stencil.first, stencil.values.len()));
        let (before, rest) = self.stages.split_at_mut(i);
        for (weight, stage) in self.tableau.a[i].iter().zip(before) {
            local.add(-self.problem.alpha * h * weight, &stage.imprint);
        }
        let slope = stencil.dot(&local.values) + self.background.map_or(0.0, |u0| u0.slope(x));
        let stage = &mut rest[0];
        stage.velocity = self.problem.velocity(t, x, slope);
        self.scheme.imprint(x, &mut stage.imprint);
        self.work.right_hand_sides += 1;
        self.work.cells_updated += stage.imprint.values.len() as u64;
    }

    /// Forms the carved cells in the scratch; returns the error relative to what is allowed.
    fn carve_and_estimate(&mut self, h: f64, x0: f64) -> f64 {
        let first = self.stages.iter().map(|s| s.imprint.first).min().unwrap_or(0);
        let end = self.stages.iter().map(|s| s.imprint.end()).max().unwrap_or(0);
        let len = (end - first) as usize;
        let (carving, tableau) = (-self.problem.alpha * h, &self.tableau);
        let Scratch { carved, errors, .. } = &mut self.scratch;
        combine(carved, first, len, carving, &tableau.b, &self.stages);
        combine(&mut errors[0], first, len, carving, &tableau.error, &self.stages);
        combine(&mut errors[1], first, len, carving, &tableau.error3, &self.stages);
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
            .map(|weights| (h * self.velocity(weights)).abs() / allowed);
        blend(largest[0].max(fifth), largest[1].max(third))
    }

    fn accept(&mut self, h: f64, x0: f64) {
        let carved = &self.scratch.carved;
        let cells = self.cells.range(carved.first, carved.values.len());
        for (cell, du) in cells.iter_mut().zip(&carved.values) {
            *cell += du;
        }
        self.t += h;
        self.x0 = x0;
        self.work.steps += 1;
        if self.tableau.first_same_as_last {
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
        sum + self.background.map_or(0.0, |u0| u0.height(x))
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

/// Hairer, Nørsett and Wanner's e5²/√(e5² + 0.01 e3²); with no second estimate e5 itself.
fn blend(fifth: f64, third: f64) -> f64 {
    if third > 0.0 { fifth * fifth / fifth.hypot(0.1 * third) } else { fifth }
}
