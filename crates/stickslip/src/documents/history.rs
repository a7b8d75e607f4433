//! The dense history of a motion, as stored in a document.

use crate::Unusable;
use crate::documents::table::Array;
use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_tip::{Heights, STAGES, Step, Support, Trajectory, Wider, nodes_and_weights, planar};

/// Farthest position, in σ: beyond it round-off exceeds a thousandth of σ, a tenth of the largest tolerance.
pub const FARTHEST: f64 = 1e13;

/// Largest excursion within a step, relative to the distance between its ends or to σ: a larger one is damage.
const LEAP: f64 = 1000.0;

/// The accepted steps, each a polynomial: x0(t) at every t of the run.
///
/// In step i, from t[i] to t[i+1], x0(t) = R(t[i]) - extension[i] + p(τ) with τ = (t - t[i])/(t[i+1] - t[i]). R is rt,
/// or the path of the support. The polynomial p is 0 at τ = 0 and displacement[i][j] at τ = nodes[j]. `surface` uses
/// the residence of the tip: the time weights[j] (t[i+1] - t[i]) at each of the nodes.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct History {
    /// Collocation nodes (Radau IIA), as fractions of a step.
    pub nodes: Vec<f64>,
    /// Quadrature weights of the nodes, as fractions of a step.
    pub weights: Vec<f64>,
    /// Start of each step, and the end of the last, in Γ/k.
    pub t: Vec<f64>,
    /// R - x0 at the start of each step, in σ.
    pub extension: Vec<f64>,
    /// x0 at the nodes minus x0 at the start of the step, in σ.
    pub displacement: Vec<[f64; STAGES]>,
    /// Height of the surface under the tip at the start of each step and at its nodes, in kσ²/a, if there is a depth
    /// limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<Vec<[f64; STAGES + 1]>>,
    /// y0 at the start of each step and at its nodes, in σ, if the tip is free to move across the scan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y0: Option<Vec<[f64; STAGES + 1]>>,
}

impl From<&Trajectory> for History {
    fn from(trajectory: &Trajectory) -> Self {
        Self::of(trajectory.steps())
    }
}

impl From<&planar::Trajectory> for History {
    /// The history of the motion along the scan, together with y0.
    fn from(trajectory: &planar::Trajectory) -> Self {
        let along: Vec<Step> = trajectory.steps().iter().map(|step| step.along).collect();
        let y0 = trajectory.steps().iter();
        let y0 = y0.map(|step| row(step.y, step.across.map(|across| step.y + across)));
        Self { y0: Some(y0.collect()), ..Self::of(&along) }
    }
}

impl History {
    fn of(steps: &[Step]) -> Self {
        let (nodes, weights) = nodes_and_weights();
        Self {
            nodes: nodes.to_vec(),
            weights: weights.to_vec(),
            t: steps.iter().map(|s| s.t).chain(steps.last().map(Step::end)).collect(),
            extension: steps.iter().map(|s| s.extension).collect(),
            displacement: steps.iter().map(|s| s.displacement).collect(),
            height: steps.iter().map(|s| s.height.map(|h| row(h.start, h.nodes))).collect(),
            y0: None,
        }
    }
}

/// The values at the start of a step and at its nodes, in a row.
pub(super) fn row(start: f64, nodes: [f64; STAGES]) -> [f64; STAGES + 1] {
    let mut row = [start; STAGES + 1];
    row[1..].copy_from_slice(&nodes);
    row
}

/// The values at the start of a step and at its nodes, from their row.
pub(super) fn start_and_nodes(row: &[f64; STAGES + 1]) -> (f64, [f64; STAGES]) {
    (row[0], std::array::from_fn(|i| row[i + 1]))
}

impl History {
    /// The trajectory of this history.
    ///
    /// # Errors
    /// The history is invalid: its steps do not follow each other, or a number is out of range.
    pub fn under(&self, wider: Wider, support: Support) -> Result<Trajectory, Unusable> {
        let steps = self.steps()?;
        let far = |step: &Step| {
            let ends = [step.t, step.end()].map(|t| support.position(t));
            let heights = step.height.iter().flat_map(|h| h.nodes.iter().chain([&h.start]));
            let sizes = [ends[0], ends[1], step.extension];
            let mut numbers = sizes.iter().chain(&step.displacement).chain(heights);
            // NaN is beyond too.
            !numbers.all(|size| size.abs() <= FARTHEST)
        };
        if let Some(i) = steps.iter().position(far) {
            return Err(unusable(format!("step {i} has numbers beyond {FARTHEST:e}")));
        }
        // As written, each step begins where the last one ended, to the last digit.
        let breaks = |pair: &[Step]| {
            let velocity = support.velocity(pair[0].t);
            let (end, next) = (pair[0].extension_at_end(velocity), pair[1].extension);
            (end - next).abs() > 1e-9 * end.abs().max(1.0)
        };
        if let Some(i) = steps.windows(2).position(breaks) {
            let message = format!("step {} does not begin where step {i} ends", i + 1);
            return Err(unusable(message));
        }
        let leaps = |step: &Step| {
            let moved = support.advance(step.t, step.h).abs();
            let ends = moved.max(step.displacement[STAGES - 1].abs()).max(1.0);
            step.displacement.iter().any(|d| d.abs() > LEAP * ends)
        };
        if let Some(i) = steps.iter().position(leaps) {
            return Err(unusable(format!(
                "within step {i} the tip is {LEAP} times as far away as at its ends"
            )));
        }
        if wider.depth_limit.is_some() != self.height.is_some() {
            return Err(unusable("heights are present with a depth limit, and only then"));
        }
        Ok(Trajectory::under(wider, support, steps))
    }

    /// The trajectory of this history of a tip that is free to move across the scan.
    ///
    /// # Errors
    /// As [`under`](Self::under); y0 is missing, or its rows do not follow each other.
    pub fn across(&self, wider: Wider, support: Support) -> Result<planar::Trajectory, Unusable> {
        let along = self.under(wider, support.clone())?;
        let rows = self.y0.as_ref().ok_or_else(|| unusable("y0 is missing"))?;
        if rows.len() != along.steps().len() {
            return Err(unusable("y0 does not have the length of extension"));
        }
        let step = |(along, row): (&Step, &[f64; STAGES + 1])| {
            let (y, nodes) = start_and_nodes(row);
            let step = planar::Step { along: *along, y, across: nodes.map(|node| node - y) };
            row.iter().all(|y| y.abs() <= FARTHEST).then_some(step)
        };
        let steps: Option<Vec<_>> = along.steps().iter().zip(rows).map(step).collect();
        let steps = steps.ok_or_else(|| unusable(format!("y0 has numbers beyond {FARTHEST:e}")))?;
        let breaks = |pair: &[planar::Step]| {
            (pair[0].y_at_end() - pair[1].y).abs() > 1e-9 * pair[1].y.abs().max(1.0)
        };
        match steps.windows(2).position(breaks) {
            Some(i) => {
                Err(unusable(format!("y0 of step {} is not that at the end of step {i}", i + 1)))
            }
            None => Ok(planar::Trajectory::under(wider, support, steps)),
        }
    }

    fn steps(&self) -> Result<Vec<Step>, Unusable> {
        let Self { nodes, weights, t, extension, displacement, height, .. } = self;
        let same = |a: &[f64], b: &[f64]| {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        let ours = nodes_and_weights();
        if !(same(nodes, &ours.0) && same(weights, &ours.1)) {
            return Err(unusable("nodes and weights differ from those of this program"));
        }
        let steps = extension.len();
        if steps == 0 || t.len() != steps + 1 || displacement.len() != steps {
            return Err(unusable("t, extension and displacement do not have matching lengths"));
        }
        if height.as_ref().is_some_and(|height| height.len() != steps) {
            return Err(unusable("height does not have the length of extension"));
        }
        if t.windows(2).any(|t| t[1] <= t[0]) {
            return Err(unusable("t does not increase"));
        }
        let step = |i: usize| {
            let heights = |row| {
                let (start, nodes) = start_and_nodes(row);
                Heights { start, nodes }
            };
            let height = height.as_ref().map(|height| heights(&height[i]));
            let (h, extension) = (t[i + 1] - t[i], extension[i]);
            Step { t: t[i], h, extension, displacement: displacement[i], height }
        };
        Ok((0..steps).map(step).collect())
    }
}

fn unusable(message: impl std::fmt::Display) -> Unusable {
    Unusable::new(format!("history: {message}"))
}

impl History {
    /// The arrays of the history, each named after its field.
    pub(crate) fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let height = self.height.iter();
        let height = height.map(|height| ("history_height", Array::of_rows(height)));
        let mut arrays = vec![
            ("history_nodes", Array::vector(&self.nodes)),
            ("history_weights", Array::vector(&self.weights)),
            ("history_t", Array::vector(&self.t)),
            ("history_extension", Array::vector(&self.extension)),
            ("history_displacement", Array::of_rows(&self.displacement)),
        ];
        arrays.extend(height);
        let across = self.y0.iter().map(|y0| ("history_y0", Array::of_rows(y0)));
        arrays.extend(across);
        arrays
    }
}
