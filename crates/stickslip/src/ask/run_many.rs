//! Many runs, integrated together.

use super::moving::sampled;
use super::run_found::observed;
use crate::{Ask, Context, Failure, Run, RunDocument, Times, WorkDocument};
use stickslip_outcome::Observer;
use stickslip_tip::{RunError, Scenario, Step, Trajectory, collect_each};

/// A run that can be integrated together with others.
struct Begun {
    question: Run,
    scenario: Scenario,
    times: Times,
}

/// Steps of a run, and the observer that classifies it.
struct Followed {
    steps: Vec<Step>,
    observer: Observer,
}

impl Extend<Step> for Followed {
    fn extend<I: IntoIterator<Item = Step>>(&mut self, steps: I) {
        for step in steps {
            self.steps.push(step);
            self.observer.observe(&step);
        }
    }
}

/// Answers all these questions and passes each document, with the number of its question, to `ended` as soon as it is
/// complete. The order is not specified; invalid questions come first.
///
/// Runs share SIMD lanes where [`collect_each`] allows it; `work.memory_reason` says so. Their motion is as accurate as
/// that of [`Run::ask`] but differs in the last bits; it does not depend on the other questions. All other runs equal
/// those of [`Run::ask`]. `work.seconds` is the time since the previous run ended: the sum over all runs is the total
/// time.
///
/// ```
/// use stickslip::{Context, Indentation, RegimeName, Run, Tip, ask_runs};
///
/// let run = |i| Run::new(Tip::default(), Indentation::given(0.1 * f64::from(i)), 1.0, 60.0);
/// ask_runs((0..10).map(run).collect(), &Context::default(), |_, run| {
///     assert_eq!(run.unwrap().regime, RegimeName::Steady);
/// });
/// ```
pub fn ask_runs(
    questions: Vec<Run>,
    context: &Context,
    mut ended: impl FnMut(usize, Result<RunDocument, Failure>),
) {
    let (all, mut done) = (questions.len(), 0);
    let (mut numbers, mut together, mut others) = (vec![], vec![], vec![]);
    for (number, question) in questions.into_iter().enumerate() {
        match begun(question, context) {
            Ok(Ok(begun)) => {
                numbers.push(number);
                together.push(begun);
            }
            Ok(Err(other)) => others.push((number, other)),
            Err(failure) => {
                done += 1;
                ended(number, Err(failure));
            }
        }
    }
    let mut ended = |number, answer| {
        done += 1;
        // Cancelled runs end by themselves.
        context.counted(done, all, "runs").ok();
        ended(number, answer);
    };
    let mut last = context.seconds();
    let scenarios: Vec<Scenario> = together.iter().map(|run| run.scenario.clone()).collect();
    let begin = |i: usize| Followed { steps: vec![], observer: Observer::new(&scenarios[i]) };
    let mut of_lanes = || {
        collect_each(&scenarios, begin, |i, run| {
            let now = context.seconds();
            ended(numbers[i], together[i].document(run, now - last));
            last = now;
        });
        Ok(())
    };
    // Errors are passed to `ended`.
    context.keeping(&mut of_lanes).ok();
    for (number, question) in others {
        ended(number, question.answered(context));
    }
}

/// The resolved question with its scenario; or the resolved question alone if the tip is free to move across the scan.
fn begun(question: Run, context: &Context) -> Result<Result<Begun, Run>, Failure> {
    let question = question.resolved(context)?;
    if question.stiffness_across.is_some() {
        return Ok(Err(question));
    }
    let scenario = question.scenario()?;
    let span = (scenario.start_time(), scenario.until);
    let times = question.sampling.times(span, "the run", true)?;
    Ok(Ok(Begun { question, scenario, times }))
}

impl Begun {
    fn document(
        &self,
        run: Result<stickslip_tip::Run<Followed>, RunError>,
        seconds: f64,
    ) -> Result<RunDocument, Failure> {
        let Self { question, scenario, times } = self;
        let run = run.map_err(|error| question.refused(&error))?;
        let stickslip_tip::Run {
            initial_surface, trajectory: Followed { steps, observer }, ..
        } = run;
        let work = WorkDocument::of(&run.work, (run.memory, run.memory_reason), seconds);
        let mut end = observed((scenario, &initial_surface), &observer, work)?;
        end.interrupted = run.interrupted && end.end < scenario.until;
        let trajectory = Trajectory::under(*scenario.model.wider(), scenario.support(), steps);
        let samples = sampled(&trajectory, times);
        let mut document = question.clone().document(samples, Some((&trajectory).into()), end);
        document.answer = document.answer.along_path(&trajectory);
        Ok(document)
    }
}
