//! Values of a parameter.

use std::str::FromStr;

/// Values of a parameter: one, or N evenly from LO to HI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Range {
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) points: usize,
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|v| v.is_finite());
        let parts: Vec<&str> = text.split(':').collect();
        let parsed = match parts.as_slice() {
            [value] => number(value).map(|v| Self { low: v, high: v, points: 1 }),
            [low, high, points] => number(low).zip(number(high)).and_then(|(low, high)| {
                let points = points.trim().parse().ok().filter(|n| *n >= 2 && low < high)?;
                Some(Self { low, high, points })
            }),
            _ => None,
        };
        parsed.ok_or_else(|| "a number, or LO:HI:N with LO below HI and N of 2 or more".into())
    }
}

impl Range {
    /// The values, both ends exactly.
    pub(crate) fn values(self) -> Vec<f64> {
        let last = self.points - 1;
        let step = (self.high - self.low) / last.max(1) as f64;
        let value = |i: usize| if i == last { self.high } else { self.low + step * i as f64 };
        (0..self.points).map(value).collect()
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
        for bad in ["", "1:2", "1:2:1", "2:1:5", "1:2:3:4", "nan", "1:inf:3", "a:b:c"] {
            assert!(bad.parse::<Range>().is_err(), "{bad}");
        }
    }
}
