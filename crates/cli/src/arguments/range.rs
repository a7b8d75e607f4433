//! Ranges of values of a parameter.

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
}
