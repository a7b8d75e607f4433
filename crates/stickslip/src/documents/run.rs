//! `stickslip/run`.

use crate::documents::table::{Array, Column, Named, Tabular};
use crate::{
    CreepDocument, DriftDocument, FORMAT_VERSION, History, InUnits, OscillationDocument,
    RegimeName, RunEnd, RunParameters, SampleLine, Software, SteadyState, TransientDocument,
    Unusable, VerificationDocument, WorkDocument,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_tip::friction::Loop;
use stickslip_tip::{Support, Trajectory};

/// A tip run. Lengths in σ, times in Γ/k, forces in kσ, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunDocument {
    /// "stickslip/run"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// Everything that defines the run.
    pub parameters: RunParameters,
    /// The steady motion at these parameters, whether or not it is stable; null without a spring.
    pub steady_state: Option<SteadyState>,
    /// l, lag, x0 and x0' at the times asked for.
    pub samples: Samples,
    /// The dense history; null where it was not asked for.
    pub history: Option<History>,
    /// The kind of motion at the end of the run.
    pub regime: RegimeName,
    /// Period and amplitudes, where the regime is stick-slip.
    pub oscillation: Option<OscillationDocument>,
    /// The closed loops of a support on a path, and the work done in each; where the run keeps its history.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub loops: Option<Vec<LoopDocument>>,
    /// The rate of creep, where the regime is trapped.
    #[serde(default)]
    pub creep: Option<CreepDocument>,
    /// The velocity, where the regime is drifting.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drifting: Option<DriftDocument>,
    /// What it seems to go to, where the regime is transient.
    #[serde(default)]
    pub transient: Option<TransientDocument>,
    /// Where round-off, the start, the tolerance or a disturbance decides; empty if nothing does.
    #[serde(default)]
    pub remarks: Vec<String>,
    /// Whether a signal stopped the run before `until`.
    pub interrupted: bool,
    /// The run against a repetition, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verification: Option<VerificationDocument>,
    /// What it took.
    pub work: WorkDocument,
    /// Numbers of it in nm, s and nN, where it was asked for these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub physical: Option<InUnits>,
}

impl RunDocument {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/run";

    /// The document of a run that became what `end` says; `samples` in the order asked for.
    pub fn new(
        parameters: RunParameters,
        steady_state: Option<SteadyState>,
        samples: &[SampleLine],
        history: Option<History>,
        end: RunEnd,
    ) -> Self {
        Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            physical: None,
            parameters,
            steady_state,
            samples: samples.into(),
            history,
            regime: end.regime,
            oscillation: end.oscillation,
            loops: None,
            creep: end.creep,
            drifting: end.drifting,
            transient: end.transient,
            remarks: end.remarks,
            interrupted: end.interrupted,
            verification: None,
            work: end.work,
        }
    }

    /// The motion, as its dense history tells it.
    ///
    /// # Errors
    /// The history was left out, or damaged.
    pub fn trajectory(&self) -> Result<Trajectory, Unusable> {
        let missing = || Unusable::new("history: it was left out; run it again with --history all");
        let history = self.history.as_ref().ok_or_else(missing)?;
        let parameters = &self.parameters;
        if parameters.support_path.is_none() && !parameters.model.law.no_spring {
            let (wider, support) = (parameters.model.wider(), Support::Moving(parameters.model.r));
            return history.under(wider, support);
        }
        let scenario = parameters.scenario()?;
        history.under(*scenario.model.wider(), scenario.support())
    }
}

/// A closed loop of the support.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoopDocument {
    /// Time at which it begins, in Γ/k.
    pub from: f64,
    /// Time at which it ends, in Γ/k.
    pub to: f64,
    /// ∮ (R - x0)dR, the work that the support does, in kσ².
    pub work: f64,
}

impl From<Loop> for LoopDocument {
    fn from(Loop { from, to, work }: Loop) -> Self {
        Self { from, to, work }
    }
}

/// Columns of equal length.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Samples {
    /// Times, in Γ/k.
    pub t: Vec<f64>,
    /// l = rt - r - x0, in σ; null for a support on a path of its own, or none.
    pub l: Option<Vec<f64>>,
    /// R - x0, the extension of the spring, in σ: the lateral force, in kσ; null without a spring.
    #[serde(default)]
    pub lag: Option<Vec<f64>>,
    /// Position of the tip, in σ.
    pub x0: Vec<f64>,
    /// x0', in kσ/Γ, the derivative of the dense history: one order less accurate than x0.
    pub velocity: Vec<f64>,
    /// Height of the surface under the tip, in kσ²/a, where there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<Vec<f64>>,
    /// w, the rate of indentation relative to α, where there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<Vec<f64>>,
}

impl Samples {
    /// Row by row, as far as all columns that are there go.
    pub fn lines(&self) -> impl Iterator<Item = SampleLine> {
        let at =
            |column: &Option<Vec<f64>>, i: usize| column.as_ref().and_then(|c| c.get(i).copied());
        let rows = self.t.len().min(self.x0.len()).min(self.velocity.len());
        (0..rows).map(move |i| SampleLine {
            t: self.t[i],
            l: at(&self.l, i),
            lag: at(&self.lag, i),
            x0: self.x0[i],
            velocity: self.velocity[i],
            height: at(&self.height, i),
            weight: at(&self.weight, i),
        })
    }

    /// Whether all columns that are there have an entry for each time.
    pub fn are_even(&self) -> bool {
        let optional = [&self.l, &self.lag, &self.height, &self.weight].into_iter().flatten();
        let mut columns = [&self.x0, &self.velocity].into_iter().chain(optional);
        columns.all(|column| column.len() == self.t.len())
    }
}

impl From<&[SampleLine]> for Samples {
    fn from(samples: &[SampleLine]) -> Self {
        let column = |value: fn(&SampleLine) -> f64| samples.iter().map(value).collect();
        let some = |value: fn(&SampleLine) -> Option<f64>| samples.iter().map(value).collect();
        Self {
            t: column(|s| s.t),
            l: some(|s| s.l),
            lag: some(|s| s.lag),
            x0: column(|s| s.x0),
            velocity: column(|s| s.velocity),
            height: some(|s| s.height).filter(|height: &Vec<f64>| !height.is_empty()),
            weight: some(|s| s.weight).filter(|weight: &Vec<f64>| !weight.is_empty()),
        }
    }
}

impl Tabular for RunDocument {
    fn columns(&self) -> Vec<Named<'_>> {
        let Samples { t, l, lag, x0, velocity, height, weight } = &self.samples;
        let columns = [
            ("t", Some(t)),
            ("l", l.as_ref()),
            ("x0", Some(x0)),
            ("velocity", Some(velocity)),
            ("lag", lag.as_ref()),
            ("height", height.as_ref()),
            ("weight", weight.as_ref()),
        ];
        let there = columns.into_iter();
        there.filter_map(|(name, column)| Some((name, Column::of(column?)))).collect()
    }

    /// The samples, and the history where it is there.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let samples = self.columns().into_iter();
        let samples = samples.filter_map(|(name, column)| Some((name, column.array()?)));
        samples.chain(self.history.iter().flat_map(History::arrays)).collect()
    }

    fn physical(&self) -> Option<&InUnits> {
        self.physical.as_ref()
    }
}
