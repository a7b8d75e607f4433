//! Results of a raster: its lines and their pattern.

use crate::documents::table::{Array, Column, Named, Tabular};
use crate::schema::JsonSchema;
use crate::{Pattern, RasterDocument, RasterHistory, RasterLine, RasterSamples};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use stickslip_raster::{Line, Plan, Regime, Written, pattern, volume};
use stickslip_tip::Work;

/// Neighbouring scan lines on one surface. Lengths in σ, times in Γ/k, forces in kσ, heights in kσ²/a; times count
/// from the start of each line.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterFound {
    /// The lines in the order in which they were scanned.
    pub lines: Vec<RasterLine>,
    /// The regime of the surface.
    pub regime: Regime,
    /// The ripple; null where there is none.
    pub pattern: Option<Pattern>,
    /// ∫∫ u dx dy, in kσ⁴/a; in the basic model -α (X/r) ∫∫f for each line.
    pub volume: f64,
    /// The dense history of all lines, from which `surface` is computed.
    pub history: RasterHistory,
    /// Cost of the raster.
    pub work: Work,
}

impl RasterFound {
    /// The result for these lines of `plan`, each sampled at `times` from its start, up to its end; and warnings.
    pub(crate) fn of(plan: &Plan, lines: &[Line], times: &[f64]) -> (Self, Vec<String>) {
        let Written { regime, pattern: found, doubts } = pattern(plan, lines);
        let total = |count: fn(&Line) -> u64| lines.iter().map(count).sum();
        let found = Self {
            lines: lines.par_iter().map(|line| RasterLine::of(plan, line, times)).collect(),
            regime,
            pattern: found,
            volume: volume(plan, lines),
            history: RasterHistory::of(lines),
            work: Work {
                steps: total(|line| line.work().steps),
                rejected: total(|line| line.work().rejected),
                newton_iterations: total(|line| line.work().newton_iterations),
                series: total(|line| line.work().series),
                switches: total(|line| line.work().switches),
            },
        };
        (found, doubts.iter().map(ToString::to_string).collect())
    }
}

impl RasterDocument {
    /// A copy without samples and history of the lines.
    pub(crate) fn without_lines(&self) -> Self {
        let Self { format, format_version, software, parameters, answer, remarks, physical } = self;
        let RasterHistory { nodes, weights, .. } = &answer.history;
        let history =
            RasterHistory { nodes: nodes.clone(), weights: weights.clone(), lines: vec![] };
        Self {
            format: format.clone(),
            format_version: *format_version,
            software: software.clone(),
            parameters: parameters.clone(),
            answer: RasterFound { lines: vec![], history, ..*answer },
            remarks: remarks.clone(),
            physical: physical.clone(),
        }
    }
}

/// A column of samples that not every raster has.
type SomeSamples = fn(&RasterSamples) -> Option<&Vec<f64>>;

/// The samples under a depth limit, and those of a tip that is free to move across the lines.
const SOME: [(&str, SomeSamples); 3] = [
    ("height", |samples| samples.height.as_ref()),
    ("y0", |samples| samples.y0.as_ref()),
    ("velocity_y", |samples| samples.velocity_y.as_ref()),
];

impl Tabular for RasterFound {
    /// The samples as a table, line after line.
    fn columns(&self) -> Vec<Named<'_>> {
        let joined = |of: fn(&RasterSamples) -> &Vec<f64>| {
            self.lines.iter().map(|line| of(&line.samples)).collect()
        };
        // Lines of a shape have not all as many samples.
        let repeated = |of: &dyn Fn(usize) -> f64| {
            let rows = |(n, line): (usize, &RasterLine)| vec![of(n); line.samples.t.len()];
            self.lines.iter().enumerate().flat_map(rows).collect()
        };
        let mut columns = vec![
            ("line", repeated(&|n| n as f64 + 1.0)),
            ("y", repeated(&|n| self.lines[n].y)),
            ("t", joined(|samples| &samples.t)),
            ("x0", joined(|samples| &samples.x0)),
            ("lag", joined(|samples| &samples.lag)),
            ("velocity", joined(|samples| &samples.velocity)),
        ];
        for (name, of) in SOME {
            let all = self.lines.iter().map(|line| of(&line.samples));
            let joined: Option<Column> = all.collect();
            columns.extend(joined.map(|joined| (name, joined)));
        }
        columns
    }

    /// `x0`, `lag` and `velocity` have a row for each line, filled with NaN after its end; the histories of all lines
    /// are concatenated, with `history_steps` steps for each.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let Some(longest) = self.lines.iter().max_by_key(|line| line.samples.t.len()) else {
            return vec![];
        };
        let whole = |values: &Vec<f64>| {
            let mut row = values.clone();
            row.resize(longest.samples.t.len(), f64::NAN);
            row
        };
        let rows = |of: fn(&RasterSamples) -> &Vec<f64>| {
            let rows = self.lines.iter().map(|line| whole(of(&line.samples)));
            Array::matrix(&rows.collect::<Vec<_>>())
        };
        let y: Vec<f64> = self.lines.iter().map(|line| line.y).collect();
        let t = longest.samples.t.clone();
        let mut arrays = vec![
            ("y", Array::vector(y)),
            ("t", Array::vector(t)),
            ("x0", rows(|samples| &samples.x0)),
            ("lag", rows(|samples| &samples.lag)),
            ("velocity", rows(|samples| &samples.velocity)),
        ];
        for (name, of) in SOME {
            let rows = self.lines.iter().map(|line| of(&line.samples).map(whole));
            let rows: Option<Vec<Vec<f64>>> = rows.collect();
            arrays.extend(rows.map(|rows| (name, Array::matrix(&rows))));
        }
        arrays.extend(self.history.arrays());
        arrays
    }
}
