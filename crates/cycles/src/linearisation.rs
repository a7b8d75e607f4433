//! The collocation equations of a whole cycle, linearised and reduced to its first state.
//!
//! The displacements of every step are eliminated while the orbit is followed. The remaining unknowns are the changes
//! of the first state X, the period T and the free parameter. The remaining equations are that X at the end equals X
//! at the start, that l has a maximum there, and one more: a fixed parameter, or a position along the branch.

use super::carved::Carved;
use super::change::{Change, Direction};
use super::embedding::{Embedding, Parameter};
use super::mesh::OfStep;
use super::orbit::Orbit;
use super::past::{Grooves, Past};
use super::sensitivity::Sensitivity;
use super::step::{Factors, LinearStep, OfStages, Solved};
use nalgebra::{DMatrix, DVector, Dyn, LU};
use std::cell::Cell;
use stickslip_tip::collocation::{STAGES, Stages};
use stickslip_tip::memory::Fit;
use stickslip_tip::step::velocity_at_end;
use stickslip_tip::stop;

thread_local! {
    /// The memory of the rows of earlier linearisations, the largest, for the next one.
    static EARLIER: Cell<OfStages> = Cell::default();
}

pub(super) struct Linearisation {
    /// rt - x0 at the end minus rt - x0 at the start.
    gap: f64,
    end: Sensitivity,
    stages: OfStages,
    phase: Phase,
    /// Data for the choice of a mesh.
    pub(super) of_steps: Vec<OfStep>,
}

/// r minus the velocity at the start, and its derivatives.
struct Phase {
    value: f64,
    by_state: Vec<f64>,
    by_parameter: f64,
}

/// The equations of a step are singular because the orbit is far from a solution, or a stop was requested.
#[derive(Debug, Clone, Copy)]
pub(super) struct Singular;

impl Linearisation {
    /// The linearisation in the short sum, about an orbit that should solve the equations in the sum `solved`.
    pub(super) fn new(
        equation: &Embedding,
        orbit: &Orbit,
        free: Parameter,
        solved: &Fit,
    ) -> Result<Self, Singular> {
        let carved = orbit.carved(&equation.wider);
        let past = |sum| Past::of(sum, (orbit, &carved)).ok_or(Singular);
        let has_heights = !orbit.heights.is_empty();
        // Its memory is there for the history of the linearised equations.
        let grooves = if solved == &*equation.short {
            None
        } else {
            Some(past(solved)?.grooves(has_heights))
        };
        let linear = past(&equation.short)?;
        let grooves = grooves.unwrap_or_else(|| linear.grooves(has_heights));
        let mut end = Sensitivity::identity(equation.state_len());
        let earlier = EARLIER.take();
        let mut stages = OfStages {
            displacements: end.none_in(earlier.displacements, STAGES * orbit.stages.len()),
            heights: end.none_in(earlier.heights, STAGES * orbit.heights.len()),
        };
        let mut of_steps = Vec::with_capacity(orbit.stages.len());
        let mut factors = Factors::default();
        let gap = along(equation, (orbit, &carved), (&linear, &grooves), |_, step, share| {
            step.carry((free, share), &mut end, &mut stages, &mut factors)?;
            of_steps.push(step.of_step());
            Some(())
        })?;
        let phase = Phase::new(equation, (orbit.extension, orbit.velocity()), &grooves, free);
        Ok(Self { gap, end, stages, phase, of_steps })
    }

    fn len(&self) -> usize {
        self.phase.by_state.len()
    }

    /// The change that solves the linearised equations and has no component in this direction.
    pub(super) fn correction(&self, fixed: &Direction) -> Option<Change> {
        let n = self.len();
        let mut wanted = DVector::zeros(n + 2);
        // ζ needs no equation: it is that of a motion that has lasted indefinitely.
        wanted[0] = -self.gap;
        for i in 0..n {
            wanted[i] -= self.end.row(i)[n + 2];
        }
        wanted[n] = -self.phase.value;
        let found = self.factorised(fixed).solve(&wanted)?;
        Some(self.change(&found, 1.0))
    }

    /// The change along the branch with the component 1 in this direction.
    pub(super) fn tangent(&self, along: &Direction) -> Option<Change> {
        let n = self.len();
        let mut wanted = DVector::zeros(n + 2);
        wanted[n + 1] = 1.0;
        let found = self.factorised(along).solve(&wanted)?;
        Some(self.change(&found, 0.0))
    }

    /// The changes of all unknowns for a change of the first state alone.
    pub(super) fn carried(&self, state: &[f64]) -> Change {
        let mut unknowns = DVector::zeros(state.len() + 2);
        unknowns.rows_mut(0, state.len()).copy_from_slice(state);
        self.change(&unknowns, 0.0)
    }

    /// The monodromy matrix ∂X(T)/∂X(0).
    pub(super) fn monodromy(&self) -> DMatrix<f64> {
        let n = self.len();
        DMatrix::from_fn(n, n, |i, k| self.end.row(i)[k])
    }

    fn factorised(&self, last: &Direction) -> LU<f64, Dyn, Dyn> {
        let n = self.len();
        let mut matrix = DMatrix::zeros(n + 2, n + 2);
        for i in 0..n {
            let row = self.end.row(i);
            for k in 0..n + 2 {
                matrix[(i, k)] = row[k];
            }
            matrix[(i, i)] -= 1.0;
            matrix[(n, i)] = self.phase.by_state[i];
        }
        matrix[(n, n + 1)] = self.phase.by_parameter;
        matrix[(n + 1, 0)] = last.l;
        matrix[(n + 1, n)] = last.period;
        matrix[(n + 1, n + 1)] = last.parameter;
        matrix.lu()
    }

    fn change(&self, found: &DVector<f64>, corrected: f64) -> Change {
        let n = self.len();
        let unknowns: Vec<f64> = found.iter().copied().chain([corrected]).collect();
        let changes = |of: &Sensitivity| -> Vec<Stages> {
            let change = |n| std::array::from_fn(|i| of.change(STAGES * n + i, &unknowns));
            (0..of.rows() / STAGES).map(change).collect()
        };
        Change {
            state: unknowns[..n].to_vec(),
            period: unknowns[n],
            parameter: unknowns[n + 1],
            stages: changes(&self.stages.displacements),
            heights: changes(&self.stages.heights),
        }
    }
}

impl Drop for Linearisation {
    fn drop(&mut self) {
        let stages = std::mem::take(&mut self.stages);
        // Of a thread that ends, the memory may be gone already.
        let keep = EARLIER.try_with(|earlier| {
            let kept = earlier.take();
            let (least, room) = (kept.displacements.room(), stages.displacements.room());
            earlier.set(if least >= room { kept } else { stages });
        });
        keep.ok();
    }
}

/// Passes the steps to a function in turn, each with its number and its fraction of the period; returns the change of rt - x0.
/// The sums are as in [`Linearisation::new`].
pub(super) fn along(
    equation: &Embedding,
    (orbit, carved): (&Orbit, &[Carved]),
    (past, grooves): (&Past, &Grooves),
    mut each: impl FnMut(usize, &LinearStep, f64) -> Option<()>,
) -> Result<f64, Singular> {
    let (mut extension, mut velocity) = (orbit.extension, orbit.velocity());
    let steps = orbit.mesh.windows(2).zip(orbit.lengths()).zip(&orbit.stages);
    for (n, ((ends, h), d)) in steps.enumerate() {
        if stop::is_requested() {
            return Err(Singular);
        }
        let (carved, heights) = (&carved[n], orbit.heights.get(n));
        let step = Solved { extension, velocity, h, d, heights, carved };
        let step = LinearStep::new(equation, (past.of_step(n), grooves.of_step(n)), step);
        let step = step.ok_or(Singular)?;
        each(n, &step, ends[1] - ends[0]).ok_or(Singular)?;
        extension += equation.r * h - d[STAGES - 1];
        velocity = velocity_at_end(d, h);
    }
    Ok(extension - orbit.extension)
}

impl Phase {
    /// l' = r - x0' = r - e - α Σ Re ζ at the start, which is to be a maximum of l; with inertia x0' is part of X.
    fn new(
        equation: &Embedding,
        (extension, velocity): (f64, f64),
        grooves: &Grooves,
        free: Parameter,
    ) -> Self {
        let groove = grooves.at_start;
        let modes = equation.short.terms().len();
        let mut by_state = vec![0.0; equation.state_len()];
        let by_r = f64::from(u8::from(free == Parameter::R));
        if equation.wider.inertia.is_some() {
            by_state[1 + 2 * modes] = -1.0;
            return Self { value: equation.r - velocity, by_state, by_parameter: by_r };
        }
        by_state[0] = -1.0;
        by_state[1..=modes].fill(-equation.alpha);
        let by_parameter = if free == Parameter::R { by_r } else { -groove };
        let value = equation.r - extension - equation.alpha * groove;
        Self { value, by_state, by_parameter }
    }
}
