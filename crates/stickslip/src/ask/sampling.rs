//! The times at which a motion is sampled.

use crate::Refused;
use crate::parameter::option;
use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_tip::sorting::ascending;

/// Times at which a motion is sampled; by default 2,001 times at even intervals.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Sampling {
    /// Time between two samples, in Γ/k; by default a 2,000th of the duration of the motion; on the lines of a
    /// raster the time in which the support moves a quarter of a width, if that is longer.
    #[schemars(extend("x-option" = option("DT", "Output", 60)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sample_every: Option<f64>,
    /// Times of the samples, in Γ/k, in any order.
    #[schemars(extend("x-option" = option("T1,T2,…", "Output", 61)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sample_at: Option<Vec<f64>>,
}

const DEFAULT_INTERVALS: u64 = 2000;
/// Largest number of samples kept in memory: with their columns and text they take 240 MB.
const MOST_SAMPLES: f64 = 2.5e6;
/// Largest number of samples that are written as lines: a petabyte.
const MOST_LINES: f64 = 1e13;

fn most(are_kept: bool) -> f64 {
    if are_kept { MOST_SAMPLES } else { MOST_LINES }
}

impl Sampling {
    /// The sample times, all between the start and the end of `what`. If samples are kept in memory (`are_kept`), fewer
    /// are allowed.
    ///
    /// # Errors
    /// A time is out of range, an interval is not above 0, or there are too many samples.
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
                let every = Refused::positive("sample_every", every)?;
                let count = (end - start) / every;
                if count > most(are_kept) {
                    let least = (end - start) / most(are_kept);
                    let why = format!(
                        "would make {count:.1e} samples, more than fit in memory; take {least:.3e} or more"
                    );
                    return Err(Refused::number("sample_every", every, why));
                }
                Ok(Times::Every { start, every, end, intervals: intervals(count) })
            }
        }
    }
}

/// The number of whole intervals. The end is a sample if the interval divides the run up to round-off.
fn intervals(count: f64) -> u64 {
    (count + 1e-9).floor() as u64
}

/// The times at which a motion is sampled.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub enum Times {
    /// The times start, start + every, …: `intervals` steps, none beyond `end`.
    Every {
        /// The first time, in Γ/k.
        start: f64,
        /// Interval, in Γ/k.
        every: f64,
        /// Upper limit of the times, in Γ/k.
        end: f64,
        /// Number of intervals.
        intervals: u64,
    },
    /// A list of times.
    At(Vec<f64>),
}

impl Times {
    /// Whether the interval, if there is one, is above 0.
    pub fn are_usable(&self) -> bool {
        match self {
            Self::Every { every, .. } => *every > 0.0,
            Self::At(_) => true,
        }
    }

    /// All of the times, as a list.
    pub fn all(&self) -> Vec<f64> {
        (0..self.count()).map_while(|i| self.at(i)).collect()
    }

    /// Number of times.
    pub fn count(&self) -> u64 {
        match self {
            Self::Every { intervals, .. } => intervals.saturating_add(1),
            Self::At(times) => times.len() as u64,
        }
    }

    /// The time with index i; `None` beyond the last.
    pub fn at(&self, i: u64) -> Option<f64> {
        match self {
            Self::Every { start, every, end, intervals } => {
                (i <= *intervals).then(|| (start + every * i as f64).min(*end))
            }
            Self::At(times) => times.get(usize::try_from(i).ok()?).copied(),
        }
    }

    /// The times in ascending order, and for each its index in the order of the request; no indices if the two orders
    /// agree.
    pub fn in_order(self) -> (Self, Vec<usize>) {
        let Self::At(times) = self else { return (self, vec![]) };
        let places = ascending(&times);
        (Self::At(places.iter().map(|place| times[*place]).collect()), places)
    }

    /// Whether these can be sample times of a motion over this span.
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
