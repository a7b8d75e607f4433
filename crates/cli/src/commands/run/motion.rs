//! A run in progress, in one coordinate or in two, as its record and its checkpoints need it.

use crate::commands::verify;
use crate::failure::Failure;
use crate::files::rows::Rows;
use crate::session::Session;
use std::io;
use std::path::Path;
use stickslip::{Mark, Moved, Moving, SampleLine, VerificationDocument};
use stickslip_outcome::{Watched, WatchedAcross};
use stickslip_tip::planar;
use stickslip_tip::{STAGES, STEP_NUMBERS, Step, Trajectory};
use stickslip_verify::verify_across;

/// A tip in motion.
pub(super) trait Motion: Moving<Step: Recorded> {
    /// Comparison of the motion, which had this memory, with its repetition.
    fn verified(
        &self,
        session: &Session,
        memory: &str,
        whole: &Trajectory<Self::Step>,
    ) -> Result<VerificationDocument, Failure>;
}

/// A step that can be recorded.
pub(super) trait Recorded: Moved {
    /// Numbers per step and per sample in a journal.
    const NUMBERS: [usize; 2];

    /// Writes the step as a row of a journal.
    fn write(&self, journal: &mut Rows) -> io::Result<()>;
    /// Writes a sample as a row of a journal.
    fn write_sample(sample: &SampleLine, journal: &mut Rows) -> io::Result<()>;
    /// Reads a journal of steps up to a mark, to be continued.
    fn read(path: &Path, mark: Mark) -> io::Result<(Rows, Vec<Self>)>;
    /// Reads a journal of samples up to a mark, to be continued.
    fn read_samples(path: &Path, mark: Mark) -> io::Result<(Rows, Vec<SampleLine>)>;
}

impl Motion for Watched<'_> {
    fn verified(
        &self,
        session: &Session,
        memory: &str,
        whole: &Trajectory,
    ) -> Result<VerificationDocument, Failure> {
        let (scenario, _) = self.origin();
        let found = verify::repeated(session, |observe| {
            stickslip_verify::verify(scenario, memory, whole, observe)
        })?;
        Ok((&found).into())
    }
}

impl Motion for WatchedAcross<'_> {
    fn verified(
        &self,
        session: &Session,
        _: &str,
        whole: &planar::Trajectory,
    ) -> Result<VerificationDocument, Failure> {
        let scenario = self.scenario();
        let found = verify::repeated(session, |observe| verify_across(scenario, whole, observe))?;
        Ok((&found).into())
    }
}

const SAMPLE_NUMBERS: usize = 7;
const SAMPLE_NUMBERS_ACROSS: usize = SAMPLE_NUMBERS + 2;
const STEP_NUMBERS_ACROSS: usize = STEP_NUMBERS + 1 + STAGES;

impl Recorded for Step {
    const NUMBERS: [usize; 2] = [STEP_NUMBERS, SAMPLE_NUMBERS];

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
