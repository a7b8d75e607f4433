//! The finished lines of an unfinished raster, bit by bit.

use super::lines::LineHistory;
use crate::Unusable;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use stickslip_raster::{Line, Plan};
use stickslip_tip::{Heights, STAGES, Stages, Step, Work, nodes_and_weights, planar};

/// A finished line of an unfinished raster.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptLine {
    /// Index of the line, from 0.
    pub index: usize,
    /// Numbers of accepted steps, rejected steps, Newton iterations, Taylor expansions, and changes from them to
    /// collocation.
    pub work: [u64; 5],
    /// The numbers of all steps. Those of a step are its start, duration, extension and displacements; the heights at
    /// its start and nodes, if there is a depth limit; and for a tip that is free to move across, its distance from the
    /// line at the start, and the changes at the nodes.
    pub steps: Vec<f64>,
}

/// Size of a number in bytes.
const SIZE: usize = 8;
/// A value at the start of a step, and values at its nodes.
const OF_NODES: usize = 1 + STAGES;

impl KeptLine {
    /// The line with this index, from 0.
    pub fn of(index: usize, line: &Line) -> Self {
        let Work { steps, rejected, newton_iterations, series, switches } = line.work();
        let work = [steps, rejected, newton_iterations, series, switches];
        let (mut across, mut steps) = (line.planar_steps(), vec![]);
        for step in line.trajectory().steps() {
            steps.extend_from_slice(&[step.t, step.h, step.extension]);
            steps.extend_from_slice(&step.displacement);
            if let Some(Heights { start, nodes }) = step.height {
                steps.push(start);
                steps.extend_from_slice(&nodes);
            }
            if let Some(planar::Step { y, across, .. }) = across.next() {
                steps.push(y);
                steps.extend_from_slice(&across);
            }
        }
        Self { index, work, steps }
    }

    /// The index, the work and the bits of all numbers, the lowest byte first, in base64: a tenth of the work of
    /// decimals.
    pub fn to_text(&self) -> String {
        let mut bytes = Vec::with_capacity(SIZE * (1 + self.work.len() + self.steps.len()));
        bytes.extend_from_slice(&(self.index as u64).to_le_bytes());
        self.work.iter().for_each(|work| bytes.extend_from_slice(&work.to_le_bytes()));
        self.steps.iter().for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
        STANDARD.encode(bytes)
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
        let steps = self.steps([model.wider().depth_limit.is_some(), plan.free.is_some()]);
        let none = || Unusable::new(format!("line {} has no steps", self.index + 1));
        let steps = steps.filter(|steps| !steps.is_empty()).ok_or_else(none)?;
        let line = if plan.free.is_some() {
            Line::free(track, model, &steps, work)
        } else {
            Line::new(track, model, steps.into_iter().map(|step| step.along).collect(), work)
        };
        LineHistory::of(&line).line((&nodes, &weights), plan, self.index, work)?;
        Ok(line)
    }

    /// The steps, which have heights and positions across as `has` says; `None` if the numbers are not theirs.
    fn steps(&self, has: [bool; 2]) -> Option<Vec<planar::Step>> {
        let length = 3 + STAGES + has.iter().filter(|has| **has).count() * OF_NODES;
        let steps = self.steps.chunks_exact(length).map(|numbers| step(numbers, has));
        self.steps.len().is_multiple_of(length).then(|| steps.collect())?
    }
}

/// The step with these numbers.
fn step(numbers: &[f64], has: [bool; 2]) -> Option<planar::Step> {
    let ([t, h, extension], rest) = numbers.split_first_chunk()?;
    let (displacement, mut rest) = rest.split_first_chunk()?;
    let mut of_nodes = |is_there: bool| -> Option<Option<(f64, Stages)>> {
        if !is_there {
            return Some(None);
        }
        let (start, nodes) = rest.split_first()?;
        let (nodes, after) = nodes.split_first_chunk()?;
        rest = after;
        Some(Some((*start, *nodes)))
    };
    let height = of_nodes(has[0])?.map(|(start, nodes)| Heights { start, nodes });
    let (y, across) = of_nodes(has[1])?.unwrap_or_default();
    let along = Step { t: *t, h: *h, extension: *extension, displacement: *displacement, height };
    Some(planar::Step { along, y, across })
}
