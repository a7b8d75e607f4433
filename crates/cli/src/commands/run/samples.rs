//! The times at which a motion is sampled.

use crate::arguments::SamplingArguments;
use crate::failure::{Failure, Typed};
use stickslip::Times;

const DEFAULT_INTERVALS: u64 = 2000;
/// Rows, columns and what is written of them are 240 MB; there is no limit to lines.
const MOST_SAMPLES: f64 = 2.5e6;
/// A petabyte of lines.
const MOST_LINES: f64 = 1e13;

/// Those asked for, all between the start and the end of `what`; where they are kept in memory, no more
/// than fit there.
pub(super) fn sample_times(
    sampling: &SamplingArguments,
    (start, end): (f64, f64),
    what: &str,
    are_kept: bool,
) -> Result<Times, Failure> {
    if let Some(times) = &sampling.sample_at {
        return match times.iter().find(|t| !(start..=end).contains(*t)) {
            None => Ok(Times::At(times.clone())),
            Some(t) => Err(Failure::input(
                format!("--sample-at {}", Typed(*t)),
                format!("outside of {what}, which lasts from {start} to {end}"),
            )),
        };
    }
    let Some(every) = sampling.sample_every else {
        let every = (end - start) / DEFAULT_INTERVALS as f64;
        return Ok(Times::Every { start, every, end, intervals: DEFAULT_INTERVALS });
    };
    let named = format!("--sample-every {}", Typed(every));
    if !(every.is_finite() && every > 0.0) {
        return Err(Failure::input(named, "must be a finite number above 0"));
    }
    let count = (end - start) / every;
    let most = if are_kept { MOST_SAMPLES } else { MOST_LINES };
    if count > most {
        let least = (end - start) / most;
        let lines = match what {
            "the run" if are_kept => ", or -o FILE.jsonl, which keeps none",
            _ => "",
        };
        return Err(Failure::input(
            named,
            format!(
                "would make {count:.1e} samples, more than are kept in memory; {least:.3e} or above will do{lines}"
            ),
        ));
    }
    Ok(Times::Every { start, every, end, intervals: intervals(count) })
}

/// Whole ones. The end itself is a sample where the interval divides the run, round-off aside.
fn intervals(count: f64) -> u64 {
    (count + 1e-9).floor() as u64
}

/// Whether a run over this span can have been asked for these times.
pub(super) fn are_of(times: &Times, (start, end): (f64, f64), are_kept: bool) -> bool {
    match *times {
        Times::At(ref times) => times.iter().all(|t| (start..=end).contains(t)),
        Times::Every { start: from, every, end: to, intervals: found } => {
            let count = (end - start) / every;
            let most = if are_kept { MOST_SAMPLES } else { MOST_LINES };
            let is_theirs = [from, to].map(f64::to_bits) == [start, end].map(f64::to_bits);
            let is_usable = every > 0.0 && count <= most;
            is_theirs && is_usable && (found == intervals(count) || found == DEFAULT_INTERVALS)
        }
    }
}

/// The times asked for, all between the start and the end of `what`.
pub(crate) fn times(
    sampling: &SamplingArguments,
    span: (f64, f64),
    what: &str,
) -> Result<Vec<f64>, Failure> {
    let times = sample_times(sampling, span, what, true)?;
    Ok((0..times.count()).map_while(|i| times.at(i)).collect())
}
