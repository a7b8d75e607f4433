//! A run in progress, in one coordinate or in two, and its answer.

use super::run_found::{RunFound, SampleLine, Samples, observed};
use crate::{Context, Failure, History, RunEnd, SteadyState, Times, WorkDocument};
use stickslip_outcome::{Classified, Watched};
use stickslip_tip::{Place, Scenario, Step, Support, Trajectory, Wider};

/// A run in progress with a result.
pub trait Moving: Classified<Step: Moved> {
    /// The result of the run, which has taken `seconds` so far. For a cancelled run only quantities that need no
    /// further computation are included.
    ///
    /// # Errors
    /// The run has no steps.
    fn became(&self, seconds: f64) -> Result<RunEnd, Failure>;
}

/// A step of a motion in one coordinate or in two.
pub trait Moved: Copy + AsRef<Step> {
    /// The motion at a time within the step.
    fn sample(&self, of: (&Support, &Wider), t: f64) -> SampleLine;

    /// The motion as a document contains it.
    fn history(whole: &Trajectory<Self>) -> History;

    /// Adds the friction loops and the holds of a support that follows a path.
    fn along_path(found: RunFound, _whole: &Trajectory<Self>) -> RunFound {
        found
    }
}

impl Moving for Watched<'_> {
    fn became(&self, seconds: f64) -> Result<RunEnd, Failure> {
        let made = self.running();
        let memory = (made.memory(), made.memory_reason());
        let work = WorkDocument::of(&made.work(), memory, seconds);
        observed(self.origin(), self.observer(), work)
    }
}

impl Moved for Step {
    fn sample(&self, (support, wider): (&Support, &Wider), t: f64) -> SampleLine {
        let height = self.height(t);
        let (Place { lag, x0, l }, velocity) = self.place_and_velocity(support, t);
        SampleLine {
            t,
            l,
            lag: (!matches!(support, Support::None)).then_some(lag),
            x0,
            velocity,
            height,
            weight: height.map(|height| wider.weight(height)),
            ..SampleLine::default()
        }
    }

    fn history(whole: &Trajectory) -> History {
        whole.into()
    }

    fn along_path(found: RunFound, whole: &Trajectory) -> RunFound {
        found.along_path(whole)
    }
}

/// The answer of a run up to its end or its cancellation, with the dense history.
pub(super) fn answered<R: Moving>(
    scenario: &Scenario,
    mut running: R,
    times: &Times,
    context: &Context,
    refused: impl Fn(R::Error) -> Failure,
) -> Result<(RunFound, Vec<String>), Failure> {
    let span = (scenario.start_time(), scenario.until);
    let (began, mut steps) = (context.seconds(), vec![]);
    while !context.is_cancelled()
        && let Some(step) = running.step().map_err(&refused)?
    {
        steps.push(step);
        context.stepped(span, step.as_ref().end(), steps.len());
    }
    let end = running.became(context.seconds() - began)?;
    let end = RunEnd { interrupted: running.t() < scenario.until, ..end };
    let whole = Trajectory::under(*scenario.model.wider(), scenario.support(), steps);
    let (steady_state, remarks) = (SteadyState::of(&scenario.model), end.remarks.clone());
    let history = Some(R::Step::history(&whole));
    let found = RunFound::new(steady_state, sampled(&whole, times), history, end);
    Ok((R::Step::along_path(found, &whole), remarks))
}

/// The motion at these times, as far as it was computed, in the order of the request.
pub(super) fn sampled<S: Moved>(whole: &Trajectory<S>, times: &Times) -> Samples {
    let (support, wider) = (whole.support(), whole.wider());
    let (steps, end) = (whole.steps(), whole.end());
    let all = (0..times.count()).map_while(|i| times.at(i)).filter(|t| *t <= end);
    all.map(|t| {
        // A time at which one step ends is the next one's.
        let after = steps.partition_point(|step| step.as_ref().end() <= t).min(steps.len() - 1);
        steps[after].sample((support, wider), t)
    })
    .collect()
}
