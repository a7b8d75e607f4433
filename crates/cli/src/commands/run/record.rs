//! Record of a run in progress: its samples, in memory or written immediately, and its history.

use super::motion::{Recorded, numbers_of, sample_of};
use crate::failure::Failure;
use crate::files::journal::{Rows, journal_of};
use crate::files::place::taken;
use crate::files::stream::Stream;
use std::io;
use std::path::{Path, PathBuf};
use stickslip::{Mark, RunLine, Samples, Times};
use stickslip_tip::{MOST_STEPS, Scenario, Step, Support, Trajectory, Wider};

/// The record of a run.
pub(super) struct Record<S = Step> {
    support: Support,
    wider: Wider,
    times: Times,
    /// Index of each sample in the order of the request, if that is not the order of time.
    places: Vec<usize>,
    /// Number of samples taken.
    pub(super) taken: u64,
    pub(super) samples: Samples,
    /// The history, if it is kept.
    pub(super) steps: Option<Vec<S>>,
    pub(super) sink: Sink,
}

/// Destination of the record during the run.
pub(super) enum Sink {
    /// Memory only.
    Memory,
    /// Samples as lines of output.
    Lines(Stream),
    /// A journal beside a checkpoint: steps if the history is kept, else samples.
    Journal(PathBuf, Rows),
}

/// Number of steps that a history has room for from the start: a longer one is copied as it grows.
const USUAL_STEPS: usize = 1024;

/// Samples between two checks of the signals; a step may be as long as the run and contain all its samples.
const SAMPLES_PER_LOOK: u64 = 1024;

impl<S: Recorded> Record<S> {
    pub(super) fn new(scenario: &Scenario, times: Times, keeps_history: bool, sink: Sink) -> Self {
        let (support, wider) = (scenario.support(), *scenario.model.wider());
        let (times, places) = times.in_order();
        let kept = if matches!(sink, Sink::Lines(_)) { 0 } else { times.count() };
        let samples = Samples::with_capacity(usize::try_from(kept).unwrap_or(0));
        let steps = keeps_history.then(|| Vec::with_capacity(USUAL_STEPS));
        Self { support, wider, times, places, taken: 0, samples, steps, sink }
    }

    /// The whole motion, if the history is kept.
    pub(super) fn whole(&mut self) -> Option<Trajectory<S>> {
        let steps = self.steps.take()?;
        Some(Trajectory::under(self.wider, self.support.clone(), steps))
    }

    /// Time of the next sample; infinite after the last one.
    pub(super) fn next_sample(&self) -> f64 {
        self.times.at(self.taken).unwrap_or(f64::INFINITY)
    }

    /// Records a step, and returns whether all its samples were taken before a signal.
    pub(super) fn take(
        &mut self,
        step: &S,
        is_stopped: impl Fn() -> bool,
    ) -> Result<bool, Failure> {
        if let Some(steps) = &mut self.steps {
            if steps.len() == MOST_STEPS {
                return Err(history_too_long(step.as_ref().t));
            }
            steps.push(*step);
            if let Sink::Journal(path, journal) = &mut self.sink {
                journal
                    .write(step.numbers().as_ref())
                    .map_err(|error| Failure::writing(path, error))?;
            }
        }
        // A time at which one step ends is the next one's.
        let end = step.as_ref().end();
        self.sample(step, |t| t < end, is_stopped)
    }

    /// Takes the samples at the very end of the last step, unless they were taken.
    pub(super) fn end(&mut self, last: Option<&S>) -> Result<(), Failure> {
        if let Some(last) = last {
            let end = last.as_ref().end();
            self.sample(last, |t| t <= end, || false)?;
        }
        if !self.places.is_empty() {
            self.samples = std::mem::take(&mut self.samples).ordered_by(&self.places);
        }
        Ok(())
    }

    fn sample(
        &mut self,
        step: &S,
        is_due: impl Fn(f64) -> bool,
        is_stopped: impl Fn() -> bool,
    ) -> Result<bool, Failure> {
        while let Some(t) = self.times.at(self.taken).filter(|t| is_due(*t)) {
            if self.taken.is_multiple_of(SAMPLES_PER_LOOK) && is_stopped() {
                return Ok(false);
            }
            let sample = step.sample((&self.support, &self.wider), t);
            match &mut self.sink {
                Sink::Lines(stream) => stream.line(&RunLine::Sample(sample))?,
                Sink::Journal(path, journal) if self.steps.is_none() => {
                    let row = &numbers_of(&sample)[..S::SAMPLE_NUMBERS];
                    journal.write(row).map_err(|error| Failure::writing(path, error))?;
                    self.samples.push(&sample);
                }
                _ => self.samples.push(&sample),
            }
            self.taken += 1;
        }
        Ok(true)
    }

    /// Keeps the incomplete file of lines, and returns its name.
    pub(super) fn keep_part(&mut self) -> Option<&Path> {
        match &mut self.sink {
            Sink::Lines(stream) => stream.keep_part(),
            Sink::Memory | Sink::Journal(..) => None,
        }
    }

    /// Writes all records to the disk, and returns the mark of that state.
    pub(super) fn sync(&mut self) -> Result<Mark, Failure> {
        match &mut self.sink {
            Sink::Memory => Ok(Mark::default()),
            Sink::Lines(stream) => stream.sync(),
            Sink::Journal(path, journal) => {
                journal.sync().map_err(|error| Failure::writing(path, error))
            }
        }
    }

    /// Reads the journal up to a mark, which must reach time t, and continues it.
    pub(super) fn resume(&mut self, path: &Path, mark: Mark, t: f64) -> Result<(), Failure> {
        let unusable = |error: io::Error| {
            taken("--resume", path, &error).unwrap_or_else(|| {
                let needed = "the checkpoint cannot be resumed without it";
                Failure::Run(format!("cannot extend {}: {error}; {needed}", path.display()))
            })
        };
        let rows = if self.steps.is_some() {
            let (rows, numbers) = Rows::resume(path, mark, S::NUMBERS).map_err(unusable)?;
            let steps: Vec<S> = numbers.chunks_exact(S::NUMBERS).map(S::from_numbers).collect();
            let along: Vec<Step> = steps.iter().map(|step| *step.as_ref()).collect();
            if !follow_each_other(&along, t) {
                return Err(unusable(io::Error::other(OTHER_ROWS)));
            }
            for step in &steps {
                self.take(step, || false)?;
            }
            rows
        } else {
            let (rows, numbers) = Rows::resume(path, mark, S::SAMPLE_NUMBERS).map_err(unusable)?;
            self.samples.extend(numbers.chunks_exact(S::SAMPLE_NUMBERS).map(sample_of));
            self.taken = self.samples.t.len() as u64;
            let due = |(i, t): (u64, &f64)| self.times.at(i) == Some(*t);
            if !(0..).zip(&self.samples.t).all(due) {
                return Err(unusable(io::Error::other(OTHER_ROWS)));
            }
            rows
        };
        self.sink = Sink::Journal(path.into(), rows);
        Ok(())
    }
}

const OTHER_ROWS: &str = "its rows are not those of the run";

/// Whether the steps reach time t, each beginning where the last one ends, up to round-off.
fn follow_each_other(steps: &[Step], t: f64) -> bool {
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs().max(1.0);
    let follows = |pair: &[Step]| same(pair[1].t, pair[0].end());
    let leads = steps.last().is_none_or(|last| same(last.end(), t));
    steps.iter().all(Step::is_sound) && steps.windows(2).all(follows) && leads
}

/// A journal for the checkpoint at `path`, with rows of the given length.
pub(super) fn journal(path: &Path, numbers: usize) -> Result<Sink, Failure> {
    let journal = journal_of(path);
    match Rows::create(&journal, path, numbers) {
        Ok(rows) => Ok(Sink::Journal(journal, rows)),
        Err(error) => Err(taken("--checkpoint", path, &error)
            .unwrap_or_else(|| Failure::writing(&journal, error))),
    }
}

fn history_too_long(t: f64) -> Failure {
    Failure::Run(format!(
        "at t = {t} the history has {MOST_STEPS} steps, more than fit in memory: write the samples as lines (-o \
         FILE.jsonl), leave the history out (--history none), or end the run earlier (--until {t})"
    ))
}
