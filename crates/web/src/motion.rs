//! The run: its samples, the surface at any time of it, and its document.

use crate::asked::Asked;
use crate::limits::{MOST_MILLISECONDS, MOST_TIME, STEPS_PER_LOOK};
use crate::refusal::Refusal;
use stickslip::{
    OscillationDocument, RunDocument, RunEnd, RunParameters, SampleLine, SteadyState, Times,
    WorkDocument,
};
use stickslip_outcome::{Observer, judge};
use stickslip_surface::{Surface, ripple_behind};
use stickslip_tip::{InitialSurface, Running, Scenario, Trajectory};

/// As the program samples by default.
const INTERVALS: u64 = 2000;

/// A run with its history.
pub(crate) struct Motion {
    scenario: Scenario,
    initial: InitialSurface,
    trajectory: Trajectory,
    observer: Observer,
    work: WorkDocument,
    /// Whether it ended before its time, as it took too long.
    is_cut_off: bool,
}

impl Motion {
    /// Makes the run, as far as it comes in [`MOST_MILLISECONDS`]; `now` is the time in milliseconds.
    pub(crate) fn of(asked: &Asked, now: impl Fn() -> f64) -> Result<Self, Refusal> {
        if asked.until > MOST_TIME {
            return Err(Refusal::TooLong(asked.until));
        }
        let scenario = asked.scenario()?;
        let initial = scenario.initial_surface()?;
        let (began, mut steps, mut observer) = (now(), vec![], Observer::new(&scenario));
        let mut running = Running::new(&scenario, &initial)?;
        let mut is_cut_off = false;
        while !is_cut_off && let Some(step) = running.step()? {
            observer.observe(&step);
            steps.push(step);
            let is_due = steps.len().is_multiple_of(STEPS_PER_LOOK);
            is_cut_off = is_due && now() - began > MOST_MILLISECONDS;
        }
        is_cut_off &= running.t() < scenario.until;
        if steps.is_empty() {
            return Err(Refusal::NoSteps);
        }
        let memory = (running.memory(), running.memory_reason());
        let work = WorkDocument::of(&running.work(), memory, (now() - began) / 1e3);
        drop(running);
        let trajectory = Trajectory::under(*scenario.model.wider(), scenario.support(), steps);
        Ok(Self { scenario, initial, trajectory, observer, work, is_cut_off })
    }

    fn times(&self) -> impl Iterator<Item = f64> {
        let (start, end) =
            (self.scenario.start_time(), self.cut_off().unwrap_or(self.scenario.until));
        let every = (end - start) / INTERVALS as f64;
        let times = Times::Every { start, every, end, intervals: INTERVALS };
        (0..=INTERVALS).filter_map(move |i| times.at(i))
    }

    /// The time reached by a run that was cut off.
    pub(crate) fn cut_off(&self) -> Option<f64> {
        self.is_cut_off.then(|| self.trajectory.end())
    }

    fn lines(&self) -> Vec<SampleLine> {
        let (support, wider) = (self.trajectory.support(), self.trajectory.wider());
        let steps = self.trajectory.steps();
        let mut n = 0;
        let at = |t: f64| {
            while n + 1 < steps.len() && steps[n].end() <= t {
                n += 1;
            }
            SampleLine::of(&steps[n], (support, wider), t)
        };
        self.times().map(at).collect()
    }

    pub(crate) fn columns(&self) -> Vec<f64> {
        let lines = self.lines();
        let columns: [fn(&SampleLine) -> f64; 5] = [
            |s| s.t,
            |s| s.l.unwrap_or(f64::NAN),
            |s| s.velocity,
            |s| s.lag.unwrap_or(f64::NAN),
            |s| s.x0,
        ];
        columns.iter().flat_map(|column| lines.iter().map(column)).collect()
    }

    pub(crate) fn heights(
        &self,
        t: f64,
        (from, to): (f64, f64),
        count: usize,
    ) -> Result<Vec<f64>, Refusal> {
        let spacing = (to - from) / count.max(2).saturating_sub(1) as f64;
        let x: Vec<f64> = (0..count).map(|i| from + spacing * i as f64).collect();
        let t = t.clamp(self.trajectory.start(), self.trajectory.end());
        Ok(self.surface(&self.trajectory).heights(t, &x)?.to_vec())
    }

    fn surface<'a>(&'a self, trajectory: &'a Trajectory) -> Surface<'a> {
        Surface::new(&self.scenario.model, &self.initial, trajectory)
    }

    pub(crate) fn positions(&self, t: f64) -> [f64; 2] {
        [self.trajectory.x0(t), self.trajectory.support().position(t)]
    }

    pub(crate) fn end(&self) -> Result<RunEnd, Refusal> {
        let outcome = judge(&self.scenario, &self.initial, &self.observer);
        let tail = self.observer.tail().ok_or(Refusal::NoSteps)?;
        let oscillation = outcome.oscillation.as_ref().map(|o| {
            let ripple = ripple_behind(&self.surface(&tail), &tail, o.wavelength);
            OscillationDocument::of(o, ripple)
        });
        let end = RunEnd::of(self.trajectory.end(), outcome, oscillation, self.work.clone());
        Ok(RunEnd { interrupted: self.is_cut_off, ..end })
    }

    pub(crate) fn document(&self) -> Result<RunDocument, Refusal> {
        let parameters = RunParameters::of(&self.scenario, None, &[], None);
        let steady = SteadyState::of(&self.scenario.model);
        let history = Some((&self.trajectory).into());
        Ok(RunDocument::new(parameters, steady, &self.lines(), history, self.end()?))
    }
}
