//! The times at which a motion is sampled.

use crate::Refused;
use crate::parameter::option;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// When a motion is sampled; without either at 2,000 even intervals.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Sampling {
    /// Time between two samples, in Γ/k; without it a 2,000th of the motion.
    #[schemars(extend("x-option" = option("DT", "Output", 60)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sample_every: Option<f64>,
    /// Times of the samples, in Γ/k, in any order.
    #[schemars(extend("x-option" = option("T1,T2,…", "Output", 61)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sample_at: Option<Vec<f64>>,
}

const DEFAULT_INTERVALS: u64 = 2000;
/// Rows, columns and what is written of them are 240 MB; there is no limit to lines.
const MOST_SAMPLES: f64 = 2.5e6;
/// A petabyte of lines.
const MOST_LINES: f64 = 1e13;

fn most(are_kept: bool) -> f64 {
    if are_kept { MOST_SAMPLES } else { MOST_LINES }
}

impl Sampling {
    /// The times, all between the start and the end of `what`; where the samples are kept in memory, no more than fit there.
    ///
    /// # Errors
    /// A time outside, an interval that is not above 0, more samples than are kept.
    pub fn times(
        &self,
        (start, end): (f64, f64),
        what: &str,
        are_kept: bool,
    ) -> Result<Times, Refused> {
        match (&self.sample_at, self.sample_every) {
            (Some(_), Some(_)) => {
                Err(Refused::whole("sample_every and sample_at", "give one of them, not both"))
            }
            (Some(times), None) => match times.iter().find(|t| !(start..=end).contains(*t)) {
                None => Ok(Times::At(times.clone())),
                Some(t) => {
                    let why = format!("outside of {what}, which lasts from {start} to {end}");
                    Err(Refused::number("sample_at", *t, why))
                }
            },
            (None, None) => {
                let every = (end - start) / DEFAULT_INTERVALS as f64;
                Ok(Times::Every { start, every, end, intervals: DEFAULT_INTERVALS })
            }
            (None, Some(every)) => {
                let refused = |why: String| Err(Refused::number("sample_every", every, why));
                if !(every.is_finite() && every > 0.0) {
                    return refused("must be a finite number above 0".into());
                }
                let count = (end - start) / every;
                if count > most(are_kept) {
                    let least = (end - start) / most(are_kept);
                    return refused(format!(
                        "would make {count:.1e} samples, more than are kept in memory; {least:.3e} or above will do"
                    ));
                }
                Ok(Times::Every { start, every, end, intervals: intervals(count) })
            }
        }
    }
}

/// Whole ones. The end itself is a sample where the interval divides the run, round-off aside.
fn intervals(count: f64) -> u64 {
    (count + 1e-9).floor() as u64
}

/// The times at which a motion is sampled.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Times {
    /// start, start + every, … `intervals` times, and not beyond end.
    Every {
        /// The first, in Γ/k.
        start: f64,
        /// From one to the next, in Γ/k.
        every: f64,
        /// None is beyond this time, in Γ/k.
        end: f64,
        /// Samples but the first.
        intervals: u64,
    },
    /// As given.
    At(Vec<f64>),
}

impl Times {
    /// Whether they go on in time, and end.
    pub fn are_usable(&self) -> bool {
        match self {
            Self::Every { every, .. } => *every > 0.0,
            Self::At(_) => true,
        }
    }

    /// All of them, as far as they go.
    pub fn all(&self) -> Vec<f64> {
        (0..self.count()).map_while(|i| self.at(i)).collect()
    }

    /// How many there are.
    pub fn count(&self) -> u64 {
        match self {
            Self::Every { intervals, .. } => intervals.saturating_add(1),
            Self::At(times) => times.len() as u64,
        }
    }

    /// The i-th of them.
    pub fn at(&self, i: u64) -> Option<f64> {
        match self {
            Self::Every { start, every, end, intervals } => {
                (i <= *intervals).then(|| (start + every * i as f64).min(*end))
            }
            Self::At(times) => times.get(usize::try_from(i).ok()?).copied(),
        }
    }

    /// In the order in which a run passes them, and the place of each in the order asked for; no places where the
    /// two are the same.
    pub fn in_order(self) -> (Self, Vec<usize>) {
        let Self::At(times) = self else { return (self, vec![]) };
        let mut places: Vec<usize> = (0..times.len()).collect();
        places.sort_by(|a, b| times[*a].total_cmp(&times[*b]));
        (Self::At(places.iter().map(|place| times[*place]).collect()), places)
    }

    /// Whether a motion over this span can have been asked for these times.
    pub fn are_of(&self, (start, end): (f64, f64), are_kept: bool) -> bool {
        match *self {
            Self::At(ref times) => times.iter().all(|t| (start..=end).contains(t)),
            Self::Every { start: from, every, end: to, intervals: found } => {
                let count = (end - start) / every;
                let is_theirs = [from, to].map(f64::to_bits) == [start, end].map(f64::to_bits);
                let is_usable = every > 0.0 && count <= most(are_kept);
                is_theirs && is_usable && (found == intervals(count) || found == DEFAULT_INTERVALS)
            }
        }
    }
}
