//! The finished lines of an unfinished raster, bit by bit.

use super::lines::LineHistory;
use crate::Unusable;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use stickslip_raster::{Line, Plan};
use stickslip_tip::{STEP_NUMBERS, Step, Work, nodes_and_weights, planar};

/// A finished line of an unfinished raster.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptLine {
    /// Index of the line, from 0.
    pub index: usize,
    /// Numbers of accepted steps, rejected steps, Newton iterations, Taylor expansions, and changes from them to
    /// collocation.
    pub work: [u64; 5],
    /// The numbers of all steps, one step after the other: of a tip that is free to move across,
    /// [`planar::Step::numbers`], else [`Step::numbers`].
    pub steps: Vec<f64>,
}

impl KeptLine {
    /// The line with this index, from 0.
    pub fn of(index: usize, line: &Line) -> Self {
        let Work { steps, rejected, newton_iterations, series, switches } = line.work();
        let work = [steps, rejected, newton_iterations, series, switches];
        let count = line.trajectory().steps().len();
        let mut numbers = vec![];
        if line.is_free() {
            numbers.reserve_exact(count * planar::STEP_NUMBERS);
            line.planar_steps().for_each(|step| numbers.extend_from_slice(&step.numbers()));
        } else {
            numbers.reserve_exact(count * STEP_NUMBERS);
            let steps = line.trajectory().steps().iter();
            steps.for_each(|step| numbers.extend_from_slice(&step.numbers()));
        }
        Self { index, work, steps: numbers }
    }

    /// The index, the work and the bits of all numbers, the lowest byte first, in base64: a tenth of the work of
    /// decimals.
    pub fn to_text(&self) -> String {
        let head = [self.index as u64].into_iter().chain(self.work).map(u64::to_le_bytes);
        let mut numbers = Vec::with_capacity(1 + self.work.len() + self.steps.len());
        numbers.extend(head);
        numbers.extend(self.steps.iter().map(|number| number.to_le_bytes()));
        STANDARD.encode(numbers.as_flattened())
    }

    /// The line whose text this is; `None` if it is that of no line.
    pub fn from_text(text: &str) -> Option<Self> {
        let bytes = STANDARD.decode(text).ok()?;
        let (numbers, rest) = bytes.as_chunks();
        let (index, numbers) = numbers.split_first()?;
        let (work, steps) = numbers.split_first_chunk()?;
        rest.is_empty().then(|| Self {
            index: u64::from_le_bytes(*index) as usize,
            work: work.map(u64::from_le_bytes),
            steps: steps.iter().map(|number| f64::from_le_bytes(*number)).collect(),
        })
    }

    /// The line, reconstructed.
    ///
    /// # Errors
    /// The line does not belong to this plan.
    pub fn line(&self, plan: &Plan) -> Result<Line, Unusable> {
        let [steps, rejected, newton_iterations, series, switches] = self.work;
        let work = Work { steps, rejected, newton_iterations, series, switches };
        let (nodes, weights) = nodes_and_weights();
        let (track, model) = (plan.track(self.index), &plan.law.model);
        let line = if plan.free.is_some() {
            let steps: Vec<planar::Step> = self.rows(planar::Step::from_numbers)?;
            Line::free(track, model, &steps, work)
        } else {
            Line::new(track, model, self.rows(Step::from_numbers)?, work)
        };
        LineHistory::of(&line).line((&nodes, &weights), plan, self.index, work)?;
        Ok(line)
    }

    /// The steps, of which each has this many numbers.
    fn rows<const N: usize, S>(&self, step: impl Fn([f64; N]) -> S) -> Result<Vec<S>, Unusable> {
        let (rows, rest) = self.steps.as_chunks();
        if rows.is_empty() || !rest.is_empty() {
            return Err(Unusable::new(format!("line {} has no steps", self.index + 1)));
        }
        Ok(rows.iter().map(|row| step(*row)).collect())
    }
}
