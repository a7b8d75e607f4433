//! The times at which a motion is sampled.

use crate::arguments::SamplingArguments;
use crate::documents::Times;
use crate::failure::{Failure, Typed};

const DEFAULT_INTERVALS: u64 = 2000;
/// Four columns of these are 1.3 GB, and four times as much as JSON.
const MOST_SAMPLES: f64 = 4e7;
/// A petabyte of lines.
const MOST_LINES: f64 = 1e13;

impl Times {
    /// Those asked for, all between the start and the end of `what`; where they are kept in memory, no more
    /// than fit there.
    pub(crate) fn asked(
        sampling: &SamplingArguments,
        (start, end): (f64, f64),
        what: &str,
        are_kept: bool,
    ) -> Result<Self, Failure> {
        if let Some(times) = &sampling.sample_at {
            return match times.iter().find(|t| !(start..=end).contains(*t)) {
                None => Ok(Self::At(times.clone())),
                Some(t) => Err(Failure::input(
                    format!("--sample-at {}", Typed(*t)),
                    format!("outside of {what}, which lasts from {start} to {end}"),
                )),
            };
        }
        let Some(every) = sampling.sample_every else {
            let every = (end - start) / DEFAULT_INTERVALS as f64;
            return Ok(Self::Every { start, every, end, intervals: DEFAULT_INTERVALS });
        };
        let named = format!("--sample-every {}", Typed(every));
        if !(every.is_finite() && every > 0.0) {
            return Err(Failure::input(named, "must be a finite number above 0"));
        }
        let count = (end - start) / every;
        let most = if are_kept { MOST_SAMPLES } else { MOST_LINES };
        if count > most {
            let least = (end - start) / most;
            return Err(Failure::input(
                named,
                format!(
                    "would make {count:.1e} samples, more than fit in memory; {least:.3e} or above will do"
                ),
            ));
        }
        // The end itself is a sample where the interval divides the run, round-off aside.
        Ok(Self::Every { start, every, end, intervals: (count + 1e-9).floor() as u64 })
    }

    /// Whether they go on in time, and end.
    pub(crate) fn are_usable(&self) -> bool {
        match self {
            Self::Every { every, .. } => *every > 0.0,
            Self::At(_) => true,
        }
    }

    /// How many there are.
    pub(crate) fn count(&self) -> u64 {
        match self {
            Self::Every { intervals, .. } => intervals + 1,
            Self::At(times) => times.len() as u64,
        }
    }

    /// The i-th of them.
    pub(crate) fn at(&self, i: u64) -> Option<f64> {
        match self {
            Self::Every { start, every, end, intervals } => {
                (i <= *intervals).then(|| (start + every * i as f64).min(*end))
            }
            Self::At(times) => times.get(usize::try_from(i).ok()?).copied(),
        }
    }

    /// In the order in which a run passes them, and the place of each in the order asked for.
    pub(crate) fn in_order(self) -> (Self, Vec<usize>) {
        let Self::At(times) = self else { return (self, vec![]) };
        let mut places: Vec<usize> = (0..times.len()).collect();
        places.sort_by(|a, b| times[*a].total_cmp(&times[*b]));
        (Self::At(places.iter().map(|place| times[*place]).collect()), places)
    }
}

/// The times asked for, all between the start and the end of `what`.
pub(crate) fn times(
    sampling: &SamplingArguments,
    span: (f64, f64),
    what: &str,
) -> Result<Vec<f64>, Failure> {
    let times = Times::asked(sampling, span, what, true)?;
    Ok((0..times.count()).map_while(|i| times.at(i)).collect())
}
