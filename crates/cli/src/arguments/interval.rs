//! The ends of a range and its number of values: `LO:HI:N`, the form of all ranges.

use crate::failure::Failure;
use std::fmt::{self, Display};
use std::str::FromStr;

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
