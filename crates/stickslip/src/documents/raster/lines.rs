//! The lines of a raster.

use crate::documents::history::{row, start_and_nodes};
use crate::documents::table::{Array, joined};
use crate::schema::JsonSchema;
use crate::{History, Unusable};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use stickslip_raster::{Line, LineRegime, Plan, line_regime};
use stickslip_tip::{STAGES, Step, Support, Work, nodes_and_weights, planar};

/// Largest distance of a tip from its line in a history, in σ.
const FARTHEST_ACROSS: f64 = 1e6;

/// One scan line.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterLine {
    /// y of the line, in σ.
    pub y: f64,
    /// The motion at the sample times.
    pub samples: RasterSamples,
    /// The regime of the motion.
    pub regime: LineRegime,
}

/// Columns of equal length, in the frame of the surface: on a line towards smaller x, x0 decreases and lags are
/// negative.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterSamples {
    /// Times since the start of the line, in Γ/k.
    pub t: Vec<f64>,
    /// Position of the tip, in σ.
    pub x0: Vec<f64>,
    /// R - x0, in σ; as a force, in kσ.
    pub lag: Vec<f64>,
    /// x0', in kσ/Γ: one order less accurate than x0.
    pub velocity: Vec<f64>,
    /// Height of the surface under the tip, in kσ²/a, if there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<Vec<f64>>,
    /// Position of the tip across the lines, in σ, if it is free to move there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y0: Option<Vec<f64>>,
    /// y0', the velocity across the lines, in kσ/Γ.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_y: Option<Vec<f64>>,
}

/// The accepted steps of all lines, each a polynomial, in the frame of its line: the support starts at 0 and moves to
/// larger x. On the retrace of a zigzag of length X, the position of the tip on the surface is X - x0.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterHistory {
    /// Collocation nodes (Radau IIA), as fractions of a step.
    pub nodes: Vec<f64>,
    /// Quadrature weights of the nodes, as fractions of a step.
    pub weights: Vec<f64>,
    /// The lines, each in the form of the history of a run.
    pub lines: Vec<LineHistory>,
}

/// The steps of one line.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LineHistory {
    /// Start of each step, and the end of the last, in Γ/k.
    pub t: Vec<f64>,
    /// rt - x0 at the start of each step, in σ.
    pub extension: Vec<f64>,
    /// x0 at the nodes minus x0 at the start of the step, in σ.
    pub displacement: Vec<[f64; STAGES]>,
    /// Height of the surface under the tip at the start of each step and at its nodes, in kσ²/a, if there is a depth
    /// limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<Vec<[f64; STAGES + 1]>>,
    /// y0 on the surface at the start of each step and at its nodes, in σ. Present if the tip is free to move across the lines.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y0: Option<Vec<[f64; STAGES + 1]>>,
}

impl RasterLine {
    /// The samples of a line at `times`, up to its end.
    pub(super) fn of(plan: &Plan, line: &Line, times: &[f64]) -> Self {
        let duration = line.trajectory().end();
        let lasts = times.iter().filter(|t| **t <= duration * (1.0 + 1e-12));
        let times: Vec<f64> = lasts.copied().collect();
        let column = |value: &dyn Fn(f64) -> f64| times.iter().map(|t| value(*t)).collect();
        let at: Vec<[f64; 3]> = times.iter().map(|t| line.at(*t)).collect();
        let samples = RasterSamples {
            t: times.clone(),
            x0: at.iter().map(|at| at[0]).collect(),
            lag: at.iter().map(|at| at[1]).collect(),
            velocity: at.iter().map(|at| at[2]).collect(),
            height: times
                .iter()
                .map(|t| line.height(*t))
                .collect::<Option<_>>()
                .filter(|_| !times.is_empty()),
            y0: line.is_free().then(|| column(&|t| line.y0(t))),
            velocity_y: line.is_free().then(|| column(&|t| line.velocity_y(t))),
        };
        Self { y: line.track().y, samples, regime: line_regime(plan, line) }
    }
}

impl LineHistory {
    pub(super) fn of(line: &Line) -> Self {
        let History { t, extension, displacement, height, .. } = line.trajectory().into();
        let y = line.track().y;
        let places =
            |step: planar::Step| row(y + step.y, step.across.map(|across| y + step.y + across));
        let y0 = line.is_free().then(|| line.planar_steps().map(places).collect());
        Self { t, extension, displacement, height, y0 }
    }

    pub(super) fn line(
        &self,
        (nodes, weights): (&[f64], &[f64]),
        plan: &Plan,
        n: usize,
        work: Work,
    ) -> Result<Line, Unusable> {
        let Self { t, extension, displacement, height, y0 } = self.clone();
        let (nodes, weights) = (nodes.to_vec(), weights.to_vec());
        let model = &plan.law.model;
        let history = History { nodes, weights, t, extension, displacement, height, y0: None };
        let found = history.under(*model.wider(), Support::Moving(model.r()));
        let found = found.map_err(|error| Unusable::new(format!("line {}: {error}", n + 1)))?;
        let (start, end, duration) = (found.start(), found.end(), plan.duration(n));
        if n >= plan.lines() || start.abs() > 0.0 || (end - duration).abs() > 1e-9 * duration {
            return Err(Unusable::new(format!("line {} is none of this raster", n + 1)));
        }
        let (track, steps) = (plan.track(n), found.steps().to_vec());
        let damaged =
            || Unusable::new(format!("line {}: history: y0 is not that of its steps", n + 1));
        match (y0, &plan.free) {
            (None, None) => Ok(Line::new(track, model, steps, work)),
            (Some(y0), Some(_)) if y0.len() == steps.len() => {
                let rows = steps.into_iter().zip(&y0);
                let steps = rows.map(|(along, y0)| free_step(along, y0, track.y));
                let steps: Vec<planar::Step> = steps.collect::<Option<_>>().ok_or_else(damaged)?;
                Ok(Line::free(track, model, &steps, work))
            }
            _ => Err(damaged()),
        }
    }
}

/// A step of a line at y, from y0 at its start and nodes; `None` for positions out of range.
fn free_step(along: Step, y0: &[f64; STAGES + 1], y: f64) -> Option<planar::Step> {
    let (start, nodes) = start_and_nodes(y0);
    let is_near = y0.iter().all(|y0| (y0 - y).abs() <= FARTHEST_ACROSS);
    let step = planar::Step { along, y: start - y, across: nodes.map(|y0| y0 - start) };
    is_near.then_some(step)
}

impl RasterHistory {
    pub(super) fn of(lines: &[Line]) -> Self {
        let (nodes, weights) = nodes_and_weights();
        let lines = lines.par_iter().map(LineHistory::of).collect();
        Self { nodes: nodes.to_vec(), weights: weights.to_vec(), lines }
    }

    /// The lines of a plan with this history; their counts of work are unknown.
    pub(crate) fn lines(&self, plan: &Plan) -> Result<Vec<Line>, Unusable> {
        let (found, wanted) = (self.lines.len(), plan.lines());
        if found != wanted {
            return Err(Unusable::new(format!("history: {found} lines, {wanted} are needed")));
        }
        let rule = (&*self.nodes, &*self.weights);
        let line = |(n, line): (usize, &LineHistory)| line.line(rule, plan, n, Work::default());
        let lines: Vec<Line> = self.lines.iter().enumerate().map(line).collect::<Result<_, _>>()?;
        let outside = lines.iter().map(outside).fold(0.0, f64::max);
        plan.judge_memory(outside).map_err(Unusable::new)?;
        Ok(lines)
    }

    pub(super) fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let lines = || self.lines.iter();
        let t = joined(lines().map(|line| &line.t));
        let extension = joined(lines().map(|line| &line.extension));
        let displacement = joined(lines().map(|line| &line.displacement));
        let steps: Vec<f64> = lines().map(|line| line.extension.len() as f64).collect();
        let height = joined(lines().filter_map(|line| line.height.as_ref()));
        let mut arrays = vec![
            ("history_nodes", Array::vector(&self.nodes)),
            ("history_weights", Array::vector(&self.weights)),
            ("history_steps", Array::vector(steps)),
            ("history_t", Array::vector(t)),
            ("history_extension", Array::vector(extension)),
            ("history_displacement", Array::of_rows(displacement)),
        ];
        if !height.is_empty() {
            arrays.push(("history_height", Array::of_rows(height)));
        }
        let y0 = joined(lines().filter_map(|line| line.y0.as_ref()));
        if !y0.is_empty() {
            arrays.push(("history_y0", Array::of_rows(y0)));
        }
        arrays
    }
}

/// Largest distance of the tip from the range of its support, in σ.
fn outside(line: &Line) -> f64 {
    let motion = line.trajectory();
    let (positions, _) = motion.residence(motion.end());
    positions.iter().map(|x| (-x).max(x - line.track().length)).fold(0.0, f64::max)
}
