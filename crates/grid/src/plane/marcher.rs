//! The integrator of a tip and of the cells of the plane within its reach.

use super::problem::PlaneProblem;
use super::sheet::Sheet;
use super::tensor::{PlaneMethod, Stencils, Tensor};
use crate::patch::Patch;
use crate::stepping::{Control, blend, reached, too_small, towards};
use crate::tableau::Tableau;
use crate::{GridError, Stepping, Work};
use std::ops::ControlFlow;

/// Callback after each accepted step, with its time t and (x0, y0); may stop the run.
pub type PlaneObserver<'a> = dyn FnMut(f64, [f64; 2]) -> ControlFlow<()> + 'a;

/// An embedded Runge–Kutta step of the tip and of all cells. Cells out of reach are unchanged; imprints of stages are
/// products of two patches, and only their sum over the stages is written to the cells.
pub(super) struct Marcher<'a> {
    problem: &'a PlaneProblem<'a>,
    tensor: &'a Tensor<'a>,
    tableau: &'static Tableau,
    stepping: Stepping,
    control: Control,
    /// e^{(t - s)/T} (u - u0), with u0 the remaining part of the initial surface.
    sheet: &'a mut Sheet,
    t: f64,
    position: [f64; 2],
    /// x0', with inertia only.
    pub(super) velocity: f64,
    /// The reference time s.
    since: f64,
    stages: Vec<Stage>,
    stencils: Stencils,
    reach: [f64; 2],
    pub(super) work: Work,
}

/// Position, velocity, x0'' with inertia, and the imprint with its weight, at one stage.
#[derive(Default)]
struct Stage {
    position: [f64; 2],
    velocity: [f64; 2],
    acceleration: f64,
    /// e^{(t - s)/T} w
    weight: f64,
    imprint: Vec<[Patch; 2]>,
}

impl<'a> Marcher<'a> {
    pub(super) fn new(
        problem: &'a PlaneProblem<'a>,
        (method, tensor): (&PlaneMethod, &'a Tensor<'a>),
        stepping: Stepping,
        sheet: &'a mut Sheet,
    ) -> Self {
        let tableau = method.tableau();
        let mut stages = vec![];
        stages.resize_with(tableau.stages(), Stage::default);
        let start = &problem.start;
        let mut marcher = Self {
            problem,
            tensor,
            control: Control::new(tableau.order, &stepping),
            tableau,
            stepping,
            sheet,
            t: start.time,
            position: start.position,
            velocity: problem.wider.inertia.map_or(0.0, |(_, velocity)| velocity),
            since: start.time,
            stages,
            stencils: Stencils::default(),
            reach: super::product::reach(problem.products),
            work: Work::default(),
        };
        marcher.evaluate(0, start.time, start.position, 0.0);
        marcher
    }

    /// Integrates to a time; returns (x0, y0) there.
    pub(super) fn advance_to(
        &mut self,
        target: f64,
        observe: &mut PlaneObserver,
    ) -> Result<[f64; 2], GridError> {
        while !reached(self.t, target) {
            let end = self.problem.wider.next_knot(self.t).min(target);
            let h = towards(end, self.t, self.control.step);
            if too_small(h, self.t) && h < target - self.t {
                return Err(GridError::StepTooSmall { time: self.t, step: h });
            }
            let after = self.stages_of_step(h);
            let error = after.map_or(f64::INFINITY, |after| self.error(h, after));
            let accepted = self.control.judge(h, error);
            let Some(after) = after.filter(|_| accepted) else {
                self.work.rejected += 1;
                continue;
            };
            self.accept(h, after);
            if observe(self.t, self.position).is_break() {
                return Err(GridError::Stopped { time: self.t });
            }
        }
        self.t = target;
        Ok(self.position)
    }

    pub(super) fn height(&mut self, at: [f64; 2]) -> f64 {
        let left = self.problem.wider.left_after(self.t - self.since);
        self.tensor.stencils(at, &mut self.stencils);
        let [along, across] = &self.stencils.height;
        let background = self.problem.left_of_start(self.t) * self.problem.start.surface(at)[0];
        left * self.sheet.read(along, across) + background
    }

    /// Replaces e^{(t - s)/T} (u - u0) by u - u0.
    pub(super) fn settle(&mut self) {
        self.sheet.scale(self.problem.wider.left_after(self.t - self.since));
        self.since = self.t;
    }

    /// Evaluates all stages except the first, which is available; returns (x0, y0) at t + h.
    fn stages_of_step(&mut self, h: f64) -> Option<[f64; 2]> {
        for i in 1..self.tableau.stages() {
            let position = self.moved(h, self.tableau.a[i])?;
            self.evaluate(i, self.t + self.tableau.c[i] * h, position, h);
        }
        self.moved(h, self.tableau.b)
    }

    /// The position moved by h Σ weight · velocity; `None` if that is not finite or a reach away, because the step is
    /// far too long.
    fn moved(&self, h: f64, weights: &[f64]) -> Option<[f64; 2]> {
        let distance = [0, 1].map(|axis| h * self.sum(weights, |stage| stage.velocity[axis]));
        let is_near = (0..2).all(|axis| distance[axis].abs() <= self.reach[axis]);
        is_near.then_some([self.position[0] + distance[0], self.position[1] + distance[1]])
    }

    /// Σ weight · rate over the stages
    fn sum(&self, weights: &[f64], rate: impl Fn(&Stage) -> f64) -> f64 {
        weights.iter().zip(&self.stages).map(|(w, stage)| w * rate(stage)).sum()
    }

    /// Stage `i`, at time `t` and a position, from the stages before it in a step of length `h`.
    fn evaluate(&mut self, i: usize, t: f64, position: [f64; 2], h: f64) {
        let (problem, wider) = (self.problem, &self.problem.wider);
        let left = wider.left_after(t - self.since);
        self.tensor.stencils(position, &mut self.stencils);
        let Stencils { height, slope } = &self.stencils;
        let [u, u_x, u_y] =
            [(&height[0], &height[1], 0), (&slope[0], &height[1], 1), (&height[0], &slope[1], 2)]
                .map(|(along, across, part)| {
                    let carved = self.read(i, h, along, across);
                    let initial = problem.left_of_start(t) * problem.start.surface(position)[part];
                    left * carved + initial
                });
        let force = problem.force(t, position, [u_x, u_y]);
        let (velocity, acceleration) = match wider.inertia {
            None => (force[0], 0.0),
            Some((mass, _)) => {
                let gained = self.tableau.a[i].iter().zip(&self.stages[..i]);
                let gained: f64 = gained.map(|(a, stage)| a * stage.acceleration).sum();
                let velocity = self.velocity + h * gained;
                (velocity, (force[0] - velocity) / mass)
            }
        };
        let stage = &mut self.stages[i];
        stage.position = position;
        (stage.velocity, stage.acceleration) = ([velocity, force[1]], acceleration);
        stage.weight = wider.weight(u) / left;
        self.tensor.imprint(position, &mut stage.imprint);
        self.work.right_hand_sides += 1;
        let cells = |pair: &[Patch; 2]| pair[0].values.len() * pair[1].values.len();
        self.work.cells_updated += stage.imprint.iter().map(cells).sum::<usize>() as u64;
    }

    /// The value of the product of two stencils on the sheet at stage `i`.
    fn read(&self, i: usize, h: f64, along: &Patch, across: &Patch) -> f64 {
        let own = |(a, stage): (&f64, &Stage)| {
            let each = stage.imprint.iter();
            let seen = each.map(|[g, h]| g.overlap(along) * h.overlap(across));
            a * stage.weight * seen.sum::<f64>()
        };
        let stages: f64 = self.tableau.a[i].iter().zip(&self.stages[..i]).map(own).sum();
        self.sheet.read(along, across) - self.problem.model.0 * h * stages
    }

    /// The estimated error of a step relative to its limit: the largest of any cell and of the tip.
    fn error(&self, h: f64, after: [f64; 2]) -> f64 {
        if self.stepping.atol.is_infinite() {
            return 0.0;
        }
        let weights = [&self.tableau.error, &self.tableau.error3];
        let mut largest = [0.0_f64; 2];
        let mut raise = |errors: [f64; 2], allowed: f64| {
            for (largest, error) in largest.iter_mut().zip(errors) {
                // `max` would swallow a NaN.
                let error = error.abs() / allowed;
                *largest = if error.is_nan() { f64::INFINITY } else { largest.max(error) };
            }
        };
        for (axis, after) in after.iter().enumerate() {
            let allowed = self.stepping.allowed(self.position[axis], *after);
            let velocity = weights.map(|w| h * self.sum(w, |stage| stage.velocity[axis]));
            raise(velocity, allowed);
        }
        let allowed = self.stepping.allowed(self.position[0], after[0]);
        raise(weights.map(|w| h * self.sum(w, |stage| stage.acceleration)), allowed);
        let (first, end, across) = self.carved();
        let mut columns = [across.clone(), across.clone(), across];
        for i in first..end {
            self.combine(h, i, self.tableau.b, &mut columns[0]);
            self.combine(h, i, weights[0], &mut columns[1]);
            self.combine(h, i, weights[1], &mut columns[2]);
            let [carved, fifth, third] = &columns;
            let errors = fifth.values.iter().zip(&third.values);
            for ((j, du), (fifth, third)) in (carved.first..).zip(&carved.values).zip(errors) {
                let before = if self.stepping.rtol > 0.0 { self.sheet.at(i, j) } else { 0.0 };
                raise([*fifth, *third], self.stepping.allowed(before, before + du));
            }
        }
        blend(largest[0], largest[1])
    }

    /// The columns that the step carves, and the cells of each.
    fn carved(&self) -> (i64, i64, Patch) {
        let ends = |axis: usize| {
            let all = || self.stages.iter().flat_map(|stage| &stage.imprint);
            let first = all().map(|pair| pair[axis].first).min().unwrap_or(0);
            (first, all().map(|pair| pair[axis].end()).max().unwrap_or(0))
        };
        let ((first, end), (low, high)) = (ends(0), ends(1));
        let mut across = Patch::default();
        across.reset(low, (high - low) as usize);
        (first, end, across)
    }

    /// -α h Σ weight · imprint over the stages, at the cells of column `i`.
    fn combine(&self, h: f64, i: i64, weights: &[f64], column: &mut Patch) {
        column.values.fill(0.0);
        for (weight, stage) in weights.iter().zip(&self.stages).filter(|(w, _)| w.abs() > 0.0) {
            for [along, across] in &stage.imprint {
                if let Some(along) = along.at(i) {
                    let factor = -self.problem.model.0 * h * weight * stage.weight;
                    column.add(factor * along, across);
                }
            }
        }
    }

    fn accept(&mut self, h: f64, after: [f64; 2]) {
        let (first, end, mut column) = self.carved();
        for i in first..end {
            self.combine(h, i, self.tableau.b, &mut column);
            self.sheet.add(i, &column);
        }
        self.velocity += h * self.sum(self.tableau.b, |stage| stage.acceleration);
        let knot = self.problem.wider.next_knot(self.t) <= self.t + h;
        self.t += h;
        self.position = after;
        self.work.steps += 1;
        if self.problem.wider.healing_time.is_some() {
            self.settle();
        } else if self.tableau.first_same_as_last && !knot {
            let last = self.stages.len() - 1;
            self.stages.swap(0, last);
            return;
        }
        self.evaluate(0, self.t, after, h);
    }
}
