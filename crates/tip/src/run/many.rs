//! Many runs, vectorised where possible.

use super::{MOST_STEPS, Run, RunError, Scenario, Start, collected};
use crate::integrator::{BeginBeside, SideBySide, Work};
use crate::memory::{Fit, MemoryChoice, MemoryReport, Retreat, Sum, accuracy_needed};
use crate::{Step, TipFunction};
use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Runs of all these scenarios, each as by [`run`](super::run) and in the order of the scenarios: see [`run_each`].
pub fn run_many(scenarios: &[Scenario]) -> Vec<Result<Run, RunError>> {
    let mut runs: Vec<_> = scenarios.iter().map(|_| None).collect();
    run_each(scenarios, |number, run| runs[number] = Some(run));
    runs.into_iter().flatten().collect()
}

/// Runs all these scenarios and passes each result, with the number of its scenario, to `ended` as soon as it is
/// complete. The order is not specified.
///
/// Some motions are integrated together in SIMD lanes, in less than half of the time ([`Run::side_by_side`]). They must
/// have one footprint, one tolerance, the basic model, the memory `auto` or `modes`, and no force, noise or profile.
/// The results are as accurate as those of [`run`](super::run) but differ in the last bits; they do not depend on the
/// other scenarios. [`run`](super::run) integrates all other scenarios, and those in which the groove becomes too stiff or
/// the tip nearly stops.
///
/// ```
/// use stickslip_tip::{Model, Scenario, TipFunction, run_each};
///
/// let tip = TipFunction::triple_gaussian(1.0, 1.0)?;
/// let scenario = |i| Ok(Scenario::new(Model::new(tip.clone(), 0.1 * f64::from(i), 1.0)?, 60.0));
/// let scenarios: Vec<_> = (0..12).map(scenario).collect::<Result<_, stickslip_tip::ModelError>>()?;
/// run_each(&scenarios, |i, run| {
///     let (l, steady) = (run.unwrap().trajectory.l(60.0), scenarios[i].model.steady_l());
///     assert!((l - steady).abs() < 1e-8);
/// });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run_each(scenarios: &[Scenario], mut ended: impl FnMut(usize, Result<Run, RunError>)) {
    // Of those that have ended: room for the next.
    let most = Cell::new(0);
    let steps = |_| Vec::with_capacity(most.get() + most.get() / 4);
    collect_at_most(MOST_STEPS as u64, scenarios, steps, |number, run| {
        let run = run.map(|collected| collected.into_run(&scenarios[number]));
        most.set(run.as_ref().map_or(0, |run| run.trajectory.steps().len()).max(most.get()));
        ended(number, run);
    });
}

/// Runs all these scenarios as [`run_each`] does, but keeps no steps: it passes those of each run to a collector, which
/// `begin` creates from the number of the scenario. A run that leaves the lanes begins again with a new collector.
pub fn collect_each<C: Extend<Step>>(
    scenarios: &[Scenario],
    begin: impl Fn(usize) -> C,
    ended: impl FnMut(usize, Result<Run<C>, RunError>),
) {
    collect_at_most(u64::MAX, scenarios, begin, ended);
}

fn collect_at_most<C: Extend<Step>>(
    most_steps: u64,
    scenarios: &[Scenario],
    begin: impl Fn(usize) -> C,
    mut ended: impl FnMut(usize, Result<Run<C>, RunError>),
) {
    let mut waiting = vec![true; scenarios.len()];
    for group in groups(scenarios) {
        let mut beside = SideBySide::new(&group.tip, &group.fit, group.tolerance, most_steps);
        let begins = group.begins.iter().map(|motion| (*motion, begin(motion.number)));
        beside.run(begins, |number, steps, work| {
            if let Ok(run) = group.collected(&scenarios[number], steps, work) {
                waiting[number] = false;
                ended(number, Ok(run));
            }
        });
    }
    for (number, scenario) in scenarios.iter().enumerate().filter(|(number, _)| waiting[*number]) {
        let mut count = 0;
        let take = |steps: &mut C, step: Step| {
            if count == most_steps {
                return Err(RunError::HistoryTooLong { t: step.t });
            }
            count += 1;
            steps.extend([step]);
            Ok(ControlFlow::Continue(()))
        };
        ended(number, collected(scenario, begin(number), take));
    }
}

/// Motions that share SIMD lanes: they have one footprint, one sum of exponentials and one tolerance.
struct Group {
    tip: TipFunction,
    fit: Arc<Fit>,
    tolerance: f64,
    begins: Vec<BeginBeside>,
}

fn groups(scenarios: &[Scenario]) -> Vec<Group> {
    let mut groups: Vec<Group> = vec![];
    for (number, scenario) in scenarios.iter().enumerate().filter(|(_, s)| is_plain(s)) {
        let Scenario { model, tolerance, .. } = scenario;
        let wanted = accuracy_needed(model, *tolerance);
        let Ok(fit) = Fit::cached(model.tip(), wanted, Retreat::Small) else { continue };
        if scenario.kick > fit.retreat_between_steps() {
            continue;
        }
        let is_theirs = |group: &&mut Group| {
            let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
            same(group.tolerance, *tolerance)
                && same(group.fit.wanted(), wanted)
                && group.tip == *model.tip()
        };
        let begin = begin(number, scenario);
        match groups.iter_mut().find(is_theirs) {
            Some(group) => group.begins.push(begin),
            None => {
                let (tip, tolerance) = (model.tip().clone(), *tolerance);
                groups.push(Group { tip, fit, tolerance, begins: vec![begin] });
            }
        }
    }
    groups
}

/// Whether a run can share SIMD lanes: the conditions are those of [`run_each`].
fn is_plain(scenario: &Scenario) -> bool {
    let Scenario { model, path, start_velocity, noise, profile, force, memory, .. } = scenario;
    let is_free = path.is_none() && start_velocity.is_none() && force.begins().is_infinite();
    let is_even = noise.is_none() && profile.is_none();
    let by_modes = matches!(memory, MemoryChoice::Auto | MemoryChoice::Modes);
    let fades = model.tip().reach().is_some();
    let is_plain = is_free && force.begins() > 0.0 && is_even && by_modes && fades;
    is_plain && model.wider().is_basic() && scenario.validate().is_ok()
}

fn begin(number: usize, scenario: &Scenario) -> BeginBeside {
    BeginBeside {
        number,
        alpha: scenario.model.alpha(),
        r: scenario.model.r(),
        t: scenario.start_time(),
        extension: scenario.start_extension() + scenario.kick,
        until: scenario.until,
        steady: (scenario.start == Start::Steady).then_some(scenario.kick),
    }
}

impl Group {
    fn collected<C>(&self, scenario: &Scenario, steps: C, work: Work) -> Result<Run<C>, RunError> {
        let (terms, certificate) = (self.fit.terms().len(), self.fit.certificate());
        let sum = Sum::Modes { terms, certificate, retreats: 0 };
        let report = MemoryReport { choice: scenario.memory, accuracy: self.fit.wanted(), sum };
        let errors_in_words = report.errors_in_words().unwrap_or_default();
        Ok(Run {
            initial_surface: scenario.initial_surface()?,
            trajectory: steps,
            work,
            memory: report.name(),
            memory_reason: format!("side by side with other motions; {errors_in_words}"),
            interrupted: false,
            side_by_side: true,
        })
    }
}
