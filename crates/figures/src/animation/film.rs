//! Duration, rate and size of an animation.

use crate::error::FigureError;
use crate::size::Width;

/// Default duration, in seconds, and frames per second.
const SECONDS: f64 = 10.0;
const RATE: f64 = 20.0;
/// Ranges of duration and rate. Browsers slow down faster animations.
const LENGTHS: (f64, f64) = (0.5, 120.0);
const RATES: (f64, f64) = (1.0, 50.0);
/// Default width in pixels.
const WIDTH: f64 = 640.0;
/// Fraction of the duration for which the first frame stays, and its largest value in seconds.
const HELD: (f64, f64) = (0.15, 1.2);

/// Duration, rate and size of an animation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    seconds: f64,
    rate: f64,
    width: Width,
}

impl Film {
    /// An animation of this duration in seconds (by default 10), with this number of frames per second (20), and this
    /// width (640 pixels).
    ///
    /// # Errors
    /// The duration or the rate is out of range.
    pub fn new(
        seconds: Option<f64>,
        rate: Option<f64>,
        width: Option<Width>,
    ) -> Result<Self, FigureError> {
        let (seconds, rate) = (seconds.unwrap_or(SECONDS), rate.unwrap_or(RATE));
        if !(LENGTHS.0..=LENGTHS.1).contains(&seconds) {
            return Err(FigureError::Film("seconds of an animation", LENGTHS.0, LENGTHS.1));
        }
        if !(RATES.0..=RATES.1).contains(&rate) {
            return Err(FigureError::Film("frames per second", RATES.0, RATES.1));
        }
        Ok(Self { seconds, rate, width: width.unwrap_or(Width::Pixels(WIDTH)) })
    }

    pub(super) fn width(&self) -> Width {
        self.width
    }

    /// Time and duration in milliseconds of each frame: the end of the motion, which stays, and the motion in equal
    /// steps up to the step before the end. Durations are multiples of 10 ms, as a GIF has them.
    pub(super) fn times(&self, [from, to]: [f64; 2]) -> Vec<(f64, u32)> {
        let held = (HELD.0 * self.seconds).min(HELD.1);
        let moving = self.seconds - held;
        let count = (moving * self.rate).round().max(1.0);
        let at = |i: f64| (100.0 * moving * i / count).round();
        let mut frames = vec![(to, 10 * (100.0 * held).round() as u32)];
        frames.extend((0..count as u32).map(f64::from).map(|i| {
            let milliseconds = 10.0 * (at(i + 1.0) - at(i));
            (from + (to - from) * i / count, milliseconds as u32)
        }));
        frames
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_last_as_long_as_asked_together_and_begin_with_the_end() {
        for (seconds, rate) in [(10.0, 20.0), (3.0, 30.0), (0.5, 50.0), (7.0, 1.0)] {
            let film = Film::new(Some(seconds), Some(rate), None).unwrap();
            let frames = film.times([2.0, 5.0]);
            assert!((frames[0].0 - 5.0).abs() < 1e-12 && (frames[1].0 - 2.0).abs() < 1e-12);
            assert!(frames[1..].is_sorted_by(|a, b| a.0 < b.0) && frames[frames.len() - 1].0 < 5.0);
            let total: u32 = frames.iter().map(|frame| frame.1).sum();
            assert!(
                (f64::from(total) - 1000.0 * seconds).abs() < 10.1,
                "{seconds} {rate}: {total}"
            );
        }
        for (seconds, rate) in [(0.0, 20.0), (f64::NAN, 20.0), (10.0, 1e9)] {
            assert!(Film::new(Some(seconds), Some(rate), None).is_err());
        }
    }
}
