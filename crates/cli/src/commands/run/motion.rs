//! A run in progress in one coordinate or in two, as far as its record and its checkpoints are concerned.

use crate::commands::verify;
use crate::failure::Failure;
use crate::files::rows::Rows;
use crate::session::Session;
use std::fmt::Display;
use std::io;
use std::path::Path;
use stickslip::{
    History, Mark, RunEnd, RunFound, SampleLine, VerificationDocument, became, became_across,
    sample_across,
};
use stickslip_outcome::{Watched, WatchedAcross};
use stickslip_tip::planar::{self, PlanarError, PlanarScenario};
use stickslip_tip::state::State;
use stickslip_tip::{
    InitialSurface, RunError, STAGES, STEP_NUMBERS, Scenario, Step, Support, Trajectory, Wider,
};
use stickslip_verify::verify_across;

/// A tip in motion.
pub(super) trait Motion {
    type Step: Recorded;
    type Error: Display;
    /// What defines the run.
    type Origin: Copy;

    /// The next step; `None` at the end of the scenario.
    fn step(&mut self) -> Result<Option<Self::Step>, Self::Error>;
    /// The last step.
    fn last(&self) -> Option<Self::Step>;
    /// Time reached.
    fn t(&self) -> f64;
    /// The state from which it can be resumed.
    fn save(&self) -> State;
    /// The result of the run, which took this many seconds.
    fn became(&self, origin: Self::Origin, seconds: f64) -> Result<RunEnd, Failure>;

    /// The motion as a document has it.
    fn history(whole: &Trajectory<Self::Step>) -> History;
    /// The answer with what follows from the whole motion.
    fn completed(found: RunFound, whole: &Trajectory<Self::Step>) -> RunFound;
    /// Comparison of the motion, which had this memory, with its repetition.
    fn verified(
        session: &Session,
        origin: Self::Origin,
        memory: &str,
        whole: &Trajectory<Self::Step>,
    ) -> Result<VerificationDocument, Failure>;
}

/// A step that can be recorded.
pub(super) trait Recorded: Copy + AsRef<Step> {
    /// Numbers per step and per sample in a journal.
    const NUMBERS: [usize; 2];

    /// The motion at a time within the step.
    fn sample(&self, of: (&Support, &Wider), t: f64) -> SampleLine;
    /// Writes the step as a row of a journal,
    fn write(&self, journal: &mut Rows) -> io::Result<()>;
    /// and a sample.
    fn write_sample(sample: &SampleLine, journal: &mut Rows) -> io::Result<()>;
    /// Reads a journal of steps up to a mark, to be continued,
    fn read(path: &Path, mark: Mark) -> io::Result<(Rows, Vec<Self>)>;
    /// and one of samples.
    fn read_samples(path: &Path, mark: Mark) -> io::Result<(Rows, Vec<SampleLine>)>;
}

impl<'a> Motion for Watched<'a> {
    type Step = Step;
    type Error = RunError;
    type Origin = (&'a Scenario, &'a InitialSurface);

    fn step(&mut self) -> Result<Option<Step>, RunError> {
        Watched::step(self)
    }

    fn last(&self) -> Option<Step> {
        Watched::last(self)
    }

    fn t(&self) -> f64 {
        Watched::t(self)
    }

    fn save(&self) -> State {
        Watched::save(self)
    }

    fn became(&self, (scenario, initial): Self::Origin, seconds: f64) -> Result<RunEnd, Failure> {
        Ok(became(scenario, initial, self, seconds)?)
    }

    fn history(whole: &Trajectory) -> History {
        whole.into()
    }

    fn completed(found: RunFound, whole: &Trajectory) -> RunFound {
        found.along_path(whole)
    }

    fn verified(
        session: &Session,
        (scenario, _): Self::Origin,
        memory: &str,
        whole: &Trajectory,
    ) -> Result<VerificationDocument, Failure> {
        let found = verify::repeated(session, |observe| {
            stickslip_verify::verify(scenario, memory, whole, observe)
        })?;
        Ok((&found).into())
    }
}

impl<'a> Motion for WatchedAcross<'a> {
    type Step = planar::Step;
    type Error = PlanarError;
    type Origin = &'a PlanarScenario;

    fn step(&mut self) -> Result<Option<planar::Step>, PlanarError> {
        WatchedAcross::step(self)
    }

    fn last(&self) -> Option<planar::Step> {
        WatchedAcross::last(self).copied()
    }

    fn t(&self) -> f64 {
        WatchedAcross::t(self)
    }

    fn save(&self) -> State {
        WatchedAcross::save(self)
    }

    fn became(&self, scenario: Self::Origin, seconds: f64) -> Result<RunEnd, Failure> {
        if self.last().is_none() {
            return Err(Failure::Run("the run has no steps".into()));
        }
        became_across(scenario, self, seconds).map_err(|error| Failure::Run(error.to_string()))
    }

    fn history(whole: &planar::Trajectory) -> History {
        whole.into()
    }

    fn completed(found: RunFound, _: &planar::Trajectory) -> RunFound {
        found
    }

    fn verified(
        session: &Session,
        scenario: Self::Origin,
        _: &str,
        whole: &planar::Trajectory,
    ) -> Result<VerificationDocument, Failure> {
        let found = verify::repeated(session, |observe| verify_across(scenario, whole, observe))?;
        Ok((&found).into())
    }
}

const SAMPLE_NUMBERS: usize = 7;
const SAMPLE_NUMBERS_ACROSS: usize = SAMPLE_NUMBERS + 2;
const STEP_NUMBERS_ACROSS: usize = STEP_NUMBERS + 1 + STAGES;

impl Recorded for Step {
    const NUMBERS: [usize; 2] = [STEP_NUMBERS, SAMPLE_NUMBERS];

    fn sample(&self, of: (&Support, &Wider), t: f64) -> SampleLine {
        SampleLine::of(self, of, t)
    }

    fn write(&self, journal: &mut Rows) -> io::Result<()> {
        journal.write(self.numbers())
    }

    fn write_sample(sample: &SampleLine, journal: &mut Rows) -> io::Result<()> {
        journal.write(numbers_of(sample))
    }

    fn read(path: &Path, mark: Mark) -> io::Result<(Rows, Vec<Self>)> {
        let (rows, steps) = Rows::resume::<STEP_NUMBERS>(path, mark)?;
        Ok((rows, steps.into_iter().map(Step::from_numbers).collect()))
    }

    fn read_samples(path: &Path, mark: Mark) -> io::Result<(Rows, Vec<SampleLine>)> {
        let (rows, samples) = Rows::resume::<SAMPLE_NUMBERS>(path, mark)?;
        Ok((rows, samples.into_iter().map(sample_of).collect()))
    }
}

impl Recorded for planar::Step {
    const NUMBERS: [usize; 2] = [STEP_NUMBERS_ACROSS, SAMPLE_NUMBERS_ACROSS];

    fn sample(&self, of: (&Support, &Wider), t: f64) -> SampleLine {
        sample_across(self, of, t)
    }

    fn write(&self, journal: &mut Rows) -> io::Result<()> {
        let mut row = [self.y; STEP_NUMBERS_ACROSS];
        row[..STEP_NUMBERS].copy_from_slice(&self.along.numbers());
        row[STEP_NUMBERS + 1..].copy_from_slice(&self.across);
        journal.write(row)
    }

    fn write_sample(sample: &SampleLine, journal: &mut Rows) -> io::Result<()> {
        let mut row = [f64::NAN; SAMPLE_NUMBERS_ACROSS];
        row[..SAMPLE_NUMBERS].copy_from_slice(&numbers_of(sample));
        let across = [sample.y0, sample.velocity_y].map(|x| x.unwrap_or(f64::NAN));
        row[SAMPLE_NUMBERS..].copy_from_slice(&across);
        journal.write(row)
    }

    fn read(path: &Path, mark: Mark) -> io::Result<(Rows, Vec<Self>)> {
        let (rows, steps) = Rows::resume::<STEP_NUMBERS_ACROSS>(path, mark)?;
        let step = |row: [f64; STEP_NUMBERS_ACROSS]| planar::Step {
            along: Step::from_numbers(std::array::from_fn(|i| row[i])),
            y: row[STEP_NUMBERS],
            across: std::array::from_fn(|i| row[STEP_NUMBERS + 1 + i]),
        };
        Ok((rows, steps.into_iter().map(step).collect()))
    }

    fn read_samples(path: &Path, mark: Mark) -> io::Result<(Rows, Vec<SampleLine>)> {
        let (rows, samples) = Rows::resume::<SAMPLE_NUMBERS_ACROSS>(path, mark)?;
        let sample = |row: [f64; SAMPLE_NUMBERS_ACROSS]| {
            let along = sample_of(std::array::from_fn(|i| row[i]));
            let (y0, velocity_y) = (Some(row[SAMPLE_NUMBERS]), Some(row[SAMPLE_NUMBERS + 1]));
            SampleLine { y0, velocity_y, ..along }
        };
        Ok((rows, samples.into_iter().map(sample).collect()))
    }
}

/// A sample as a row of a journal, with NaN for missing values.
fn numbers_of(sample: &SampleLine) -> [f64; SAMPLE_NUMBERS] {
    let SampleLine { t, l, lag, x0, velocity, height, weight, .. } = *sample;
    let [l, lag, height, weight] = [l, lag, height, weight].map(|x| x.unwrap_or(f64::NAN));
    [t, l, lag, x0, velocity, height, weight]
}

fn sample_of([t, l, lag, x0, velocity, height, weight]: [f64; SAMPLE_NUMBERS]) -> SampleLine {
    let there = |x: f64| (!x.is_nan()).then_some(x);
    let [l, lag, height, weight] = [l, lag, height, weight].map(there);
    let (y0, velocity_y) = (None, None);
    SampleLine { t, l, lag, x0, velocity, height, weight, y0, velocity_y }
}
