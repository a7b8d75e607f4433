//! A run of a tip that is free to move across the scan.

use super::moving::{Moved, Moving};
use super::run_found::{RunEnd, SampleLine, no_steps};
use crate::{Failure, History, OscillationDocument, RegimeName, SwingDocument, WorkDocument};
use stickslip_outcome::{Classified, Outcome, Prospect, Regime, WatchedAcross, judge};
use stickslip_stability::Snaking;
use stickslip_tip::planar::{PlanarScenario, Step, Trajectory};
use stickslip_tip::{Support, Wider};

/// A deviation across the scan counts as decayed if it is at most this many tolerances at the end of a run.
const DIED_OUT: f64 = 10.0;
/// Length of the last part of a run, as a fraction of the run, in which a deviation must not exceed [`DIED_OUT`] tolerances.
const LATE: f64 = 0.25;

impl Moving for WatchedAcross<'_> {
    fn became(&self, seconds: f64) -> Result<RunEnd, Failure> {
        let end = self.last().ok_or_else(no_steps)?.end();
        let scenario = self.scenario();
        let along = &scenario.along;
        let made = self.running();
        let work = WorkDocument::of(&made.work(), made.memory(), seconds);
        let across = self.across();
        let has_died_out = across.largest_late(LATE) <= DIED_OUT * along.tolerance;
        let outcome = if has_died_out {
            let initial = along.initial_surface();
            judge(
                along,
                &initial.map_err(|error| Failure::Failed(error.to_string()))?,
                self.along(),
            )
        } else {
            unsettled()
        };
        let oscillation = outcome.oscillation.as_ref();
        let oscillation = oscillation.map(|found| OscillationDocument::of(found, None));
        let mut ended = RunEnd::of(end, outcome, oscillation, work);
        ended.remarks.extend(undisturbed(scenario).filter(|_| has_died_out));
        if let Some(swing) = across.snaking(along.tolerance).filter(|_| !has_died_out) {
            ended.regime = RegimeName::Snaking;
            ended.transient = None;
            ended.snaking = Some(SwingDocument::of(&swing, along.model.r()));
        }
        Ok(ended)
    }
}

impl Moved for Step {
    fn sample(&self, of: (&Support, &Wider), t: f64) -> SampleLine {
        let [_, velocity_y] = self.velocity(t);
        let along = self.along.sample(of, t);
        SampleLine { y0: Some(self.y0(t)), velocity_y: Some(velocity_y), ..along }
    }

    fn history(whole: &Trajectory) -> History {
        whole.into()
    }
}

/// The outcome of a motion that has not settled, without a prediction.
fn unsettled() -> Outcome {
    Outcome {
        regime: Regime::Transient,
        oscillation: None,
        creep: None,
        drifting: None,
        prospect: Some(Prospect::default()),
        remarks: vec![],
    }
}

/// A warning for a tip that stays on its line only because nothing displaces it, although deviations across the scan
/// would grow.
fn undisturbed(scenario: &PlanarScenario) -> Option<String> {
    let model = &scenario.along.model;
    let is_pushed = scenario.kick_across.abs() > 0.0
        || scenario.noise_spacing_across.is_some()
        || scenario.profile_across.is_some();
    let theory = || {
        let place = (model.r(), scenario.stiffness_across);
        Snaking::new(model.tip().footprint()?, *model.wider(), place).ok()
    };
    let grows = || theory()?.unstable_count(model.alpha()).ok().filter(|count| *count > 0);
    (!is_pushed && grows().is_some()).then(|| {
        "the tip starts on its line, and stays there by symmetry, but deviations across the scan grow: start it off \
         the line with a kick across"
            .into()
    })
}
