//! The times at which a motion is sampled.

use crate::arguments::SamplingArguments;
use crate::failure::{Failure, Typed};

const DEFAULT_INTERVALS: usize = 2000;
/// Four columns of these are 1.3 GB, and four times as much as JSON.
const MOST_SAMPLES: f64 = 4e7;

/// The times asked for, all between the start and the end of `what`.
pub(crate) fn times(
    sampling: &SamplingArguments,
    (start, end): (f64, f64),
    what: &str,
) -> Result<Vec<f64>, Failure> {
    if let Some(times) = &sampling.sample_at {
        return match times.iter().find(|t| !(start..=end).contains(*t)) {
            None => Ok(times.clone()),
            Some(t) => Err(Failure::input(
                format!("--sample-at {}", Typed(*t)),
                format!("outside of {what}, which lasts from {start} to {end}"),
            )),
        };
    }
    let Some(every) = sampling.sample_every else {
        return Ok(evenly_to(
            start,
            end,
            (end - start) / DEFAULT_INTERVALS as f64,
            DEFAULT_INTERVALS,
        ));
    };
    let named = format!("--sample-every {}", Typed(every));
    if !(every.is_finite() && every > 0.0) {
        return Err(Failure::input(named, "must be a finite number above 0"));
    }
    let count = (end - start) / every;
    if count > MOST_SAMPLES {
        let least = (end - start) / MOST_SAMPLES;
        return Err(Failure::input(
            named,
            format!(
                "would make {count:.1e} samples, more than fit in memory; {least:.3e} or above will do"
            ),
        ));
    }
    // The end itself is a sample where the interval divides the run, round-off aside.
    Ok(evenly_to(start, end, every, (count + 1e-9).floor() as usize))
}

/// start, start + every, … up to `intervals` of them, and not beyond end.
fn evenly_to(start: f64, end: f64, every: f64, intervals: usize) -> Vec<f64> {
    (0..=intervals).map(|i| (start + every * i as f64).min(end)).collect()
}
