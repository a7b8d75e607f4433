//! The dense history of a motion in a document.

use crate::Unusable;
use crate::table::Array;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_tip::{Step, Trajectory, nodes_and_weights};

/// Positions beyond this are rounded by a thousandth of σ and more, a tenth of the largest tolerance.
pub const FARTHEST: f64 = 1e13;

/// The accepted steps, each a polynomial: x0(t) at every t of the run.
///
/// In step i, from t[i] to t[i+1], x0(t) = r t[i] - extension[i] + p(τ), τ = (t - t[i])/(t[i+1] - t[i]),
/// where p is the polynomial through 0 at τ = 0 and displacement[i][j] at τ = nodes[j]. The tip's
/// residence, from which `surface` works, is the time weights[j] (t[i+1] - t[i]) spent at each of the
/// nodes.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct History {
    /// Collocation nodes (Radau IIA), as parts of a step.
    pub nodes: Vec<f64>,
    /// Quadrature weights of the nodes, as parts of a step.
    pub weights: Vec<f64>,
    /// Start of each step, and the end of the last, in Γ/k.
    pub t: Vec<f64>,
    /// rt - x0 at the start of each step, in σ.
    pub extension: Vec<f64>,
    /// x0 less its value at the start of the step, at the nodes, in σ.
    pub displacement: Vec<Vec<f64>>,
}

impl From<&Trajectory> for History {
    fn from(trajectory: &Trajectory) -> Self {
        let steps = trajectory.steps();
        let (nodes, weights) = nodes_and_weights();
        Self {
            nodes: nodes.to_vec(),
            weights: weights.to_vec(),
            t: steps.iter().map(|s| s.t).chain([trajectory.end()]).collect(),
            extension: steps.iter().map(|s| s.extension).collect(),
            displacement: steps.iter().map(|s| s.displacement.to_vec()).collect(),
        }
    }
}

impl History {
    /// The trajectory that it tells of, r being the velocity of the support.
    ///
    /// # Errors
    /// It was not written by this program, or was damaged since: it is no sequence of steps each of which begins
    /// where the last one ended.
    pub fn trajectory(&self, r: f64) -> Result<Trajectory, Unusable> {
        let steps = self.steps()?;
        let far = |step: &Step| {
            let sizes = [r * step.t, r * step.end(), step.extension];
            !sizes.iter().chain(&step.displacement).all(|size| size.abs() <= FARTHEST)
        };
        if let Some(i) = steps.iter().position(far) {
            return Err(unusable(format!("step {i} has numbers beyond {FARTHEST:e}")));
        }
        // As written, each step begins where the last one ended, to the last digit.
        let breaks = |pair: &[Step]| {
            let (end, next) = (pair[0].extension_at_end(r), pair[1].extension);
            (end - next).abs() > 1e-9 * end.abs().max(1.0)
        };
        if let Some(i) = steps.windows(2).position(breaks) {
            let message = format!("step {} does not begin where step {i} ends", i + 1);
            return Err(unusable(message));
        }
        Ok(Trajectory::new(r, steps))
    }

    fn steps(&self) -> Result<Vec<Step>, Unusable> {
        let Self { nodes, weights, t, extension, displacement } = self;
        let same = |a: &[f64], b: &[f64]| {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        let ours = nodes_and_weights();
        if !(same(nodes, &ours.0) && same(weights, &ours.1)) {
            return Err(unusable("nodes and weights are not those of this program"));
        }
        let steps = extension.len();
        if steps == 0 || t.len() != steps + 1 || displacement.len() != steps {
            return Err(unusable("t, extension and displacement do not have matching lengths"));
        }
        if t.windows(2).any(|t| t[1] <= t[0]) {
            return Err(unusable("t does not increase"));
        }
        let step = |i: usize| {
            let displacement = displacement[i].as_slice().try_into();
            let displacement = displacement.map_err(|_| {
                let (found, needed) = (self.displacement[i].len(), nodes.len());
                unusable(format!("displacement {i} has {found} entries, {needed} are needed"))
            })?;
            Ok(Step { t: t[i], h: t[i + 1] - t[i], extension: extension[i], displacement })
        };
        (0..steps).map(step).collect()
    }
}

fn unusable(message: impl std::fmt::Display) -> Unusable {
    Unusable::new(format!("history: {message}"))
}

impl History {
    /// Its arrays, each named after its field.
    pub(crate) fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        vec![
            ("history_nodes", Array::vector(&self.nodes)),
            ("history_weights", Array::vector(&self.weights)),
            ("history_t", Array::vector(&self.t)),
            ("history_extension", Array::vector(&self.extension)),
            ("history_displacement", Array::matrix(&self.displacement)),
        ]
    }
}
