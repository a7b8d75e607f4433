//! The history of a tip in two coordinates: its accepted steps, each a polynomial along and one across.

use crate::collocation::{RADAU, STAGES, Stages, apply};
use crate::state::{Damaged, Reader, State};

/// One accepted step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Duration of the step, and the motion along the scan.
    pub along: crate::Step,
    /// y0 at the start of the step.
    pub y: f64,
    /// y0 minus its value at the start, at the collocation nodes; the last node is the end of the step.
    pub across: Stages,
}

/// Number of real numbers in a step, including its heights, which are NaN without a depth limit.
pub const STEP_NUMBERS: usize = crate::STEP_NUMBERS + 1 + STAGES;

impl Step {
    /// All data of the step: those along the scan, then y and the displacements across.
    pub fn numbers(&self) -> [f64; STEP_NUMBERS] {
        let mut row = [self.y; STEP_NUMBERS];
        row[..crate::STEP_NUMBERS].copy_from_slice(&self.along.numbers());
        row[crate::STEP_NUMBERS + 1..].copy_from_slice(&self.across);
        row
    }

    /// A step from its [`numbers`](Self::numbers).
    pub fn from_numbers(row: [f64; STEP_NUMBERS]) -> Self {
        let along = crate::Step::from_numbers(std::array::from_fn(|i| row[i]));
        let across = std::array::from_fn(|i| row[crate::STEP_NUMBERS + 1 + i]);
        Self { along, y: row[crate::STEP_NUMBERS], across }
    }

    /// Time at the end of the step.
    pub fn end(&self) -> f64 {
        self.along.end()
    }

    /// y0 at the end of the step.
    pub fn y_at_end(&self) -> f64 {
        self.y + self.across[STAGES - 1]
    }

    /// y0(t) by its polynomial.
    pub fn y0(&self, t: f64) -> f64 {
        self.y + RADAU.value(&self.across, self.part(t))
    }

    /// x0'(t) and y0'(t), by the polynomials of the step: one order less accurate than positions.
    pub fn velocity(&self, t: f64) -> [f64; 2] {
        let across = RADAU.slope(&self.across, self.part(t)) / self.along.h;
        [self.along.velocity(t), across]
    }

    /// y0' by its polynomial as a function of t, for many t.
    pub fn velocity_across(&self) -> impl Fn(f64) -> f64 + use<'_> {
        self.rate(&self.across)
    }

    /// x0' by its polynomial as a function of t, for many t.
    pub fn velocity_along(&self) -> impl Fn(f64) -> f64 + use<'_> {
        self.rate(&self.along.displacement)
    }

    /// The derivative of the polynomial through these displacements.
    fn rate(&self, displacement: &Stages) -> impl Fn(f64) -> f64 + use<'_> {
        let rates = apply(&RADAU.derivative, displacement);
        move |t| RADAU.between(&rates, self.part(t)) / self.along.h
    }

    fn part(&self, t: f64) -> f64 {
        (t - self.along.t) / self.along.h
    }

    /// Writes all data of the step.
    pub fn save(&self, state: &mut State) {
        state.step(&self.along);
        state.number(self.y);
        self.across.iter().for_each(|across| state.number(*across));
    }

    /// Reads a step that [`save`](Self::save) wrote.
    ///
    /// # Errors
    /// Too few words left, or a number out of its range.
    pub fn restored(state: &mut Reader) -> Result<Self, Damaged> {
        let (along, y, mut across) = (state.step()?, state.finite()?, [0.0; STAGES]);
        for across in &mut across {
            *across = state.finite()?;
        }
        Ok(Self { along, y, across })
    }
}

impl AsRef<crate::Step> for Step {
    fn as_ref(&self) -> &crate::Step {
        &self.along
    }
}

/// The dense output of a run: x0(t) and y0(t) at every t of it.
pub type Trajectory = crate::Trajectory<Step>;

/// A node of the history: a position with its weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Visit {
    /// Position x0, in σ.
    pub x: f64,
    /// Position y0, in σ.
    pub y: f64,
    /// Time spent there, in Γ/k, multiplied by its undecayed part, and by w with a depth limit.
    pub weight: f64,
}

impl Trajectory {
    /// Positions of the tip until t with their weights: `∫_{start}^t w e^{-(t-t')/T} q(x0(t'), y0(t')) dt'` = Σ weight
    /// q(x, y). The surface is its initial state minus α times the sum for q = f(x - x0, y - y0).
    pub fn residence(&self, t: f64) -> Vec<Visit> {
        let mut visits = vec![];
        for step in self.steps().iter().take_while(|step| step.along.t < t) {
            let origin = self.support().position(step.along.t) - step.along.extension;
            step.along.each_moment(self.wider(), t, |moment| {
                visits.push(Visit {
                    x: origin + moment.value(&step.along.displacement),
                    y: step.y + moment.value(&step.across),
                    weight: moment.weight,
                });
            });
        }
        visits
    }

    /// y0(t).
    pub fn y0(&self, t: f64) -> f64 {
        self.step_at(t).y0(t)
    }

    /// x0'(t) and y0'(t), one order less accurate than positions.
    pub fn velocity(&self, t: f64) -> [f64; 2] {
        self.step_at(t).velocity(t)
    }
}
