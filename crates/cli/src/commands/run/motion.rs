//! A run in progress, in one coordinate or in two, as its record and its checkpoints need it.

use crate::commands::verify;
use crate::failure::Failure;
use crate::session::Session;
use stickslip::{Moved, Moving, SampleLine, VerificationDocument};
use stickslip_outcome::{Watched, WatchedAcross};
use stickslip_tip::planar;
use stickslip_tip::{STEP_NUMBERS, Step, Trajectory};
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
    /// Numbers per step in a journal.
    const NUMBERS: usize;
    /// Numbers per sample in a journal: the first ones of [`numbers_of`].
    const SAMPLE_NUMBERS: usize;

    /// The step as a row of a journal.
    fn numbers(&self) -> impl AsRef<[f64]>;
    /// The step in a row of a journal.
    fn from_numbers(row: &[f64]) -> Self;
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

impl Recorded for Step {
    const NUMBERS: usize = STEP_NUMBERS;
    const SAMPLE_NUMBERS: usize = 7;

    fn numbers(&self) -> impl AsRef<[f64]> {
        Step::numbers(self)
    }

    fn from_numbers(row: &[f64]) -> Self {
        Step::from_numbers(std::array::from_fn(|i| row[i]))
    }
}

impl Recorded for planar::Step {
    const NUMBERS: usize = planar::STEP_NUMBERS;
    const SAMPLE_NUMBERS: usize = 9;

    fn numbers(&self) -> impl AsRef<[f64]> {
        planar::Step::numbers(self)
    }

    fn from_numbers(row: &[f64]) -> Self {
        planar::Step::from_numbers(std::array::from_fn(|i| row[i]))
    }
}

/// A sample as a row of a journal, with NaN for missing values.
pub(super) fn numbers_of(sample: &SampleLine) -> [f64; 9] {
    let SampleLine { t, l, lag, x0, velocity, height, weight, y0, velocity_y } = *sample;
    let or_nan = |x: Option<f64>| x.unwrap_or(f64::NAN);
    let [l, lag, height, weight] = [l, lag, height, weight].map(or_nan);
    [t, l, lag, x0, velocity, height, weight, or_nan(y0), or_nan(velocity_y)]
}

/// The sample in the first numbers of a row.
pub(super) fn sample_of(row: &[f64]) -> SampleLine {
    let number = |i: usize| row.get(i).copied().unwrap_or(f64::NAN);
    let there = |i: usize| Some(number(i)).filter(|x| !x.is_nan());
    SampleLine {
        t: number(0),
        l: there(1),
        lag: there(2),
        x0: number(3),
        velocity: number(4),
        height: there(5),
        weight: there(6),
        y0: there(7),
        velocity_y: there(8),
    }
}
