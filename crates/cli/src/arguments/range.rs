//! Ranges: values of a parameter, and the ends of an interval with its number of values, `LO:HI:N`.

use crate::failure::Failure;
use std::fmt::{self, Display};
use std::str::FromStr;

/// Largest number of values.
const MOST: usize = 10_000_000;

/// Values of a parameter: one value, N evenly spaced from LO to HI, or a list.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Range {
    Even { low: f64, high: f64, points: usize },
    Listed(Vec<f64>),
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|v| v.is_finite());
        let parts: Vec<&str> = text.split(':').collect();
        let parsed = match parts.as_slice() {
            [list] => list.split(',').map(number).collect::<Option<_>>().map(Self::Listed),
            [low, high, points] => number(low).zip(number(high)).and_then(|(low, high)| {
                let points =
                    points.trim().parse().ok().filter(|n| (2..=MOST).contains(n) && low < high)?;
                Some(Self::Even { low, high, points })
            }),
            _ => None,
        };
        parsed.ok_or_else(|| {
            format!(
                "a finite number, LO:HI:N with LO below HI and N of 2 or more (at most {MOST} are accepted), or \
                 V1,V2,…"
            )
        })
    }
}

impl Range {
    /// The values, both ends exact.
    pub(crate) fn values(&self) -> Vec<f64> {
        let (low, high, points) = match self {
            Self::Even { low, high, points } => (*low, *high, *points),
            Self::Listed(values) => return values.clone(),
        };
        let last = points - 1;
        let step = (high - low) / last.max(1) as f64;
        let value = |i: usize| if i == last { high } else { low + step * i as f64 };
        (0..points).map(value).collect()
    }

    /// Number of values.
    pub(crate) fn points(&self) -> usize {
        match self {
            Self::Even { points, .. } => *points,
            Self::Listed(values) => values.len(),
        }
    }
}

/// `LO:HI`, or `LO:HI:N` with the number of values; `LO,HI` is accepted too.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Interval {
    typed: String,
    low: f64,
    high: f64,
    points: Option<usize>,
}

impl FromStr for Interval {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts: Vec<&str> = text.split(':').map(str::trim).collect();
        let parts = match (parts.as_slice(), text.split_once(',')) {
            ([_], Some((low, high))) => vec![low.trim(), high.trim()],
            _ => parts,
        };
        let parsed = match parts.as_slice() {
            [low, high] => low.parse().ok().zip(high.parse().ok()).map(|ends| (ends, None)),
            [low, high, points] => {
                let ends = low.parse().ok().zip(high.parse().ok());
                ends.zip(points.parse().ok()).map(|(ends, points)| (ends, Some(points)))
            }
            _ => None,
        };
        let ((low, high), points) = parsed
            .ok_or("two numbers LO:HI, or LO:HI:N with the number of values, such as 0.05:3:200")?;
        Ok(Self { typed: text.into(), low, high, points })
    }
}

impl Display for Interval {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.typed)
    }
}

impl Interval {
    /// Both ends, the first below the second.
    pub(crate) fn ends(&self, option: &str) -> Result<(f64, f64), Failure> {
        if self.low.is_finite() && self.high.is_finite() && self.low < self.high {
            return Ok((self.low, self.high));
        }
        Err(self.refused(option, "needs two finite numbers LO:HI with LO below HI"))
    }

    /// Both ends, without a check.
    pub(super) fn numbers(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// The number of values, if given.
    pub(super) fn counted(&self) -> Option<usize> {
        self.points
    }

    /// The number of values, if given: at least 2, and not given by the option `other` too.
    pub(crate) fn points(
        &self,
        option: &str,
        other: Option<&str>,
    ) -> Result<Option<usize>, Failure> {
        match (self.points, other) {
            (Some(_), Some(other)) => {
                let both = "gives the number of values, and so does";
                Err(self.refused(option, format!("{both} {other}: leave one of them out")))
            }
            (Some(0 | 1), None) => {
                Err(self.refused(option, "needs 2 values or more: LO:HI:N with N of at least 2"))
            }
            (points, _) => Ok(points),
        }
    }

    /// The rejection of the range, with its value as typed.
    fn refused(&self, option: &str, message: impl Display) -> Failure {
        Failure::input(format!("{option} {}", self.typed), message)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_both_ends_and_nonsense_is_refused() {
        let values = "0.1:0.4:4".parse::<Range>().unwrap().values();
        assert_eq!(values.len(), 4);
        assert!((values[0] - 0.1).abs() < 1e-300 && (values[3] - 0.4).abs() < 1e-300);
        assert_eq!("-2".parse::<Range>().unwrap().values().len(), 1);
        assert_eq!("3,-1e2".parse(), Ok(Range::Listed(vec![3.0, -100.0])));
        for bad in [
            "", "1,", "1,x", "1:2,3:4", "1:2", "1:2:1", "2:1:5", "1:2:3:4", "nan", "1:inf:3",
            "a:b:c",
        ] {
            assert!(bad.parse::<Range>().is_err(), "{bad}");
        }
    }

    #[test]
    fn ranges_are_understood_in_all_forms() {
        let ends = |text: &str| text.parse::<Interval>().unwrap().ends("--range").unwrap();
        for text in ["0.1:3", "0.1,3", "0.1:3:5", " 0.1 : 3 "] {
            let (low, high) = ends(text);
            assert!((low - 0.1).abs() + (high - 3.0).abs() < 1e-15, "{text}");
        }
        let points = |text: &str| text.parse::<Interval>().unwrap().points("--range", None);
        assert_eq!(points("0.1:3:5").unwrap(), Some(5));
        assert_eq!(points("-5,460").unwrap(), None);
        assert!(points("1:2:1").is_err());
        for bad in ["", "1", "a:b", "1:2:3:4", "1:2:x", "1:2:-3", "1,2,3", "1:2,3"] {
            assert!(bad.parse::<Interval>().unwrap_err().contains("LO:HI:N"), "{bad}");
        }
        let refused = "3,1".parse::<Interval>().unwrap().ends("--r-range").unwrap_err();
        assert!(refused.to_string().starts_with("--r-range 3,1: needs"), "{refused}");
    }
}
