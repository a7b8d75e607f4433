//! The result of a run.

use crate::documents::table::{Array, Named, Tabular, as_arrays};
use crate::schema::JsonSchema;
use crate::{
    Failure, History, OscillationDocument, RegimeName, SteadyState, SwingDocument,
    TransientDocument, VerificationDocument, WorkDocument, from_json,
};
use serde::{Deserialize, Serialize};
use stickslip_outcome::{Creeping, Drift, Observer, Outcome, judge};
use stickslip_surface::{Surface, ripple_behind};
use stickslip_tip::friction::{Hold, Loop, holds, loops};
use stickslip_tip::{InitialSurface, Scenario, Support, Trajectory};

/// The motion of a tip, and its regime. Lengths in σ, times in Γ/k, forces in kσ, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunFound {
    /// The steady motion at these parameters, stable or not; null without a spring.
    pub steady_state: Option<SteadyState>,
    /// l, lag, x0 and x0' at the sample times.
    pub samples: Samples,
    /// The dense history; null if it was not requested.
    pub history: Option<History>,
    /// The regime at the end of the run.
    pub regime: RegimeName,
    /// Period and amplitudes, if the regime is stick-slip.
    pub oscillation: Option<OscillationDocument>,
    /// Period and amplitudes, if the regime is snaking.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub snaking: Option<SwingDocument>,
    /// The closed loops of a support that follows a path; null without a path, or if the history is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub loops: Option<Vec<Loop>>,
    /// The holds of a support that follows a path, and the peak of the lateral force after each; null without holds, or
    /// if the history is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub holds: Option<Vec<Hold>>,
    /// The rate of creep, if the regime is trapped.
    #[serde(default)]
    pub creep: Option<Creeping>,
    /// The velocity, if the regime is drifting.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drifting: Option<Drift>,
    /// The predicted regime, if the regime is transient.
    #[serde(default)]
    pub transient: Option<TransientDocument>,
    /// Whether a signal stopped the run before `until`.
    pub interrupted: bool,
    /// Comparison with a repetition of the run, if requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verification: Option<VerificationDocument>,
    /// Cost of the run.
    pub work: WorkDocument,
}

impl RunFound {
    /// The answer of a run with the result `end`; `samples` are in the order of the request.
    pub fn new(
        steady_state: Option<SteadyState>,
        samples: Samples,
        history: Option<History>,
        end: RunEnd,
    ) -> Self {
        Self {
            steady_state,
            samples,
            history,
            regime: end.regime,
            oscillation: end.oscillation,
            snaking: end.snaking,
            loops: None,
            holds: None,
            creep: end.creep,
            drifting: end.drifting,
            transient: end.transient,
            interrupted: end.interrupted,
            verification: None,
            work: end.work,
        }
    }

    /// Adds the closed loops and the holds of a support that follows a path.
    #[must_use]
    pub fn along_path(self, trajectory: &Trajectory) -> Self {
        let (loops, holds) = Self::of_path(trajectory);
        Self { loops, holds, ..self }
    }

    /// The closed loops and the holds of a support that follows a path; `None` without them.
    pub fn of_path(trajectory: &Trajectory) -> (Option<Vec<Loop>>, Option<Vec<Hold>>) {
        if !matches!(trajectory.support(), Support::Path(_)) {
            return (None, None);
        }
        let holds = holds(trajectory);
        (Some(loops(trajectory)), (!holds.is_empty()).then_some(holds))
    }
}

/// The result of a run whose steps an observer has seen.
pub(super) fn observed(
    (scenario, initial): (&Scenario, &InitialSurface),
    observer: &Observer,
    work: WorkDocument,
) -> Result<RunEnd, Failure> {
    let seen = observer.tail().zip(observer.t());
    let (tail, t) = seen.ok_or_else(no_steps)?;
    let outcome = judge(scenario, initial, observer);
    let oscillation = outcome.oscillation.as_ref().map(|found| {
        let surface = Surface::new(&scenario.model, initial, &tail);
        OscillationDocument::of(found, ripple_behind(&surface, found.wavelength))
    });
    Ok(RunEnd::of(t, outcome, oscillation, work))
}

/// The failure of a run that ended before its first step.
pub(super) fn no_steps() -> Failure {
    Failure::Failed("the run has no steps".into())
}

/// The motion at one time.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SampleLine {
    /// Time, in Γ/k.
    pub t: f64,
    /// l = rt - r - x0, in σ; null without a support, or if the support follows a path.
    pub l: Option<f64>,
    /// R - x0, the extension of the spring, in σ; null without a spring.
    #[serde(default)]
    pub lag: Option<f64>,
    /// Position of the tip, in σ.
    pub x0: f64,
    /// x0', in kσ/Γ, one order less accurate than x0.
    pub velocity: f64,
    /// Height of the surface under the tip, in kσ²/a, if there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
    /// w, the rate of indentation relative to α, if there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
    /// y0, the position of the tip across the scan, in σ, if it is free to move there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y0: Option<f64>,
    /// y0', the velocity across the scan, in kσ/Γ.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_y: Option<f64>,
}

impl SampleLine {
    /// The sample on a line of a file.
    ///
    /// # Errors
    ///
    /// The line is another, or damaged.
    pub fn on(line: &[u8]) -> serde_json::Result<Self> {
        from_json(line)
    }
}

/// The result of a run; in a file of lines it is the last line.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunEnd {
    /// Time reached, in Γ/k.
    pub end: f64,
    /// The regime at the end of the run.
    pub regime: RegimeName,
    /// Period and amplitudes, if the regime is stick-slip.
    pub oscillation: Option<OscillationDocument>,
    /// Period and amplitudes, if the regime is snaking.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub snaking: Option<SwingDocument>,
    /// The rate of creep, if the regime is trapped.
    #[serde(default)]
    pub creep: Option<Creeping>,
    /// The velocity, if the regime is drifting.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drifting: Option<Drift>,
    /// The predicted regime, if the regime is transient.
    #[serde(default)]
    pub transient: Option<TransientDocument>,
    /// Warnings: the result depends on round-off, on the initial condition, on the tolerance or on a disturbance; may
    /// be empty.
    #[serde(default)]
    pub remarks: Vec<String>,
    /// Whether a signal stopped the run before `until`.
    pub interrupted: bool,
    /// Cost of the run.
    pub work: WorkDocument,
}

impl RunEnd {
    /// The result of a run that was not interrupted and reached the time `end`.
    pub fn of(
        end: f64,
        outcome: Outcome,
        oscillation: Option<OscillationDocument>,
        work: WorkDocument,
    ) -> Self {
        Self {
            end,
            regime: outcome.regime.into(),
            oscillation,
            snaking: None,
            creep: outcome.creep,
            drifting: outcome.drifting,
            transient: outcome.prospect.map(Into::into),
            remarks: outcome.remarks.iter().map(ToString::to_string).collect(),
            interrupted: false,
            work,
        }
    }
}

/// Adds an entry to a column; without a value the column is removed.
#[inline]
fn add(column: &mut Option<Vec<f64>>, value: Option<f64>) {
    match (column.as_mut(), value) {
        (Some(column), Some(value)) => column.push(value),
        _ => *column = None,
    }
}

/// Samples of a motion; columns of equal length.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Samples {
    /// Times, in Γ/k.
    pub t: Vec<f64>,
    /// l = rt - r - x0, in σ; null without a support, or if the support follows a path.
    pub l: Option<Vec<f64>>,
    /// R - x0, the extension of the spring, in σ: the lateral force, in kσ; null without a spring.
    #[serde(default)]
    pub lag: Option<Vec<f64>>,
    /// Position of the tip, in σ.
    pub x0: Vec<f64>,
    /// x0', in kσ/Γ, the derivative of the dense history: one order less accurate than x0.
    pub velocity: Vec<f64>,
    /// Height of the surface under the tip, in kσ²/a, if there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<Vec<f64>>,
    /// w, the rate of indentation relative to α, if there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<Vec<f64>>,
    /// y0, the position of the tip across the scan, in σ, if it is free to move there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y0: Option<Vec<f64>>,
    /// y0', the velocity across the scan, in kσ/Γ.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_y: Option<Vec<f64>>,
}

impl Samples {
    /// Empty columns with room for this number of samples.
    pub fn with_capacity(count: usize) -> Self {
        let room = || Vec::with_capacity(count);
        Self {
            t: room(),
            l: Some(room()),
            lag: Some(room()),
            x0: room(),
            velocity: room(),
            height: None,
            weight: None,
            y0: None,
            velocity_y: None,
        }
    }

    /// Adds a sample. A column is `None` if any of the samples lacks its value.
    pub fn push(&mut self, sample: &SampleLine) {
        if self.t.is_empty() {
            let column = |value: Option<f64>| value.map(|_| Vec::with_capacity(self.t.capacity()));
            self.height = column(sample.height);
            self.weight = column(sample.weight);
            self.y0 = column(sample.y0);
            self.velocity_y = column(sample.velocity_y);
        }
        self.t.push(sample.t);
        self.x0.push(sample.x0);
        self.velocity.push(sample.velocity);
        add(&mut self.l, sample.l);
        add(&mut self.lag, sample.lag);
        add(&mut self.height, sample.height);
        add(&mut self.weight, sample.weight);
        add(&mut self.y0, sample.y0);
        add(&mut self.velocity_y, sample.velocity_y);
    }

    /// The samples sorted by `places`, which has at least one entry for each sample.
    #[must_use]
    pub fn ordered_by(self, places: &[usize]) -> Self {
        let mut order: Vec<usize> = (0..self.t.len()).collect();
        order.sort_by_key(|i| places[*i]);
        let moved = |column: Vec<f64>| order.iter().map(|i| column[*i]).collect::<Vec<f64>>();
        let Self { t, l, lag, x0, velocity, height, weight, y0, velocity_y } = self;
        let [t, x0, velocity] = [t, x0, velocity].map(moved);
        let [l, lag, height, weight, y0, velocity_y] =
            [l, lag, height, weight, y0, velocity_y].map(|column| column.map(moved));
        Self { t, l, lag, x0, velocity, height, weight, y0, velocity_y }
    }

    /// The samples row by row, up to the length of the shortest column.
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
            y0: at(&self.y0, i),
            velocity_y: at(&self.velocity_y, i),
        })
    }

    /// The columns that are present, with their names.
    pub(super) fn columns(&self) -> Vec<Named<'_>> {
        let Self { t, l, lag, x0, velocity, height, weight, y0, velocity_y } = self;
        let columns = [
            ("t", Some(t)),
            ("l", l.as_ref()),
            ("x0", Some(x0)),
            ("velocity", Some(velocity)),
            ("lag", lag.as_ref()),
            ("height", height.as_ref()),
            ("weight", weight.as_ref()),
            ("y0", y0.as_ref()),
            ("velocity_y", velocity_y.as_ref()),
        ];
        let there = columns.into_iter();
        there.filter_map(|(name, column)| Some((name, column?.into()))).collect()
    }

    /// Whether every column that is present has an entry for each time.
    pub fn are_even(&self) -> bool {
        let optional = [&self.l, &self.lag, &self.height, &self.weight, &self.y0, &self.velocity_y];
        let optional = optional.into_iter().flatten();
        let mut columns = [&self.x0, &self.velocity].into_iter().chain(optional);
        columns.all(|column| column.len() == self.t.len())
    }
}

impl Default for Samples {
    /// No samples yet; the first one decides which columns there are.
    fn default() -> Self {
        Self::with_capacity(0)
    }
}

impl Extend<SampleLine> for Samples {
    fn extend<I: IntoIterator<Item = SampleLine>>(&mut self, samples: I) {
        samples.into_iter().for_each(|sample| self.push(&sample));
    }
}

impl FromIterator<SampleLine> for Samples {
    fn from_iter<I: IntoIterator<Item = SampleLine>>(samples: I) -> Self {
        let mut columns = Self::default();
        columns.extend(samples);
        columns
    }
}

impl Tabular for RunFound {
    fn columns(&self) -> Vec<Named<'_>> {
        self.samples.columns()
    }

    /// The samples, and the history if it is present, as arrays.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        as_arrays(self.columns()).chain(self.history.iter().flat_map(History::arrays)).collect()
    }
}
