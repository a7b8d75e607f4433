//! The scanned area: a rectangle, or any shape made of lines.

use crate::error::{MOST_LINES, RasterError};
use crate::path::{AreaLine, Path, Track};
use stickslip_tip::sorting::{ends, sort_numbers};

/// Positions of the scan lines.
#[derive(Debug, Clone, PartialEq)]
pub enum Area {
    /// Lines of equal length, one pitch apart, from x = 0 and y = 0.
    Rectangle {
        /// Distance between the lines; ignored by [`Path::Repeat`].
        pitch: f64,
        /// Number of lines.
        lines: usize,
        /// Distance that the support moves along each line.
        length: f64,
    },
    /// A list of lines in the order of the scan; several may have the same y.
    Lines(Vec<AreaLine>),
}

/// Largest |y|; beyond it the usual distances between lines would be lost in round-off.
const FARTHEST: f64 = 1e9;
/// Largest relative difference of distances that count as equal.
const EVEN: f64 = 1e-9;

impl Area {
    /// Number of lines.
    pub fn len(&self) -> usize {
        match self {
            Self::Rectangle { lines, .. } => *lines,
            Self::Lines(lines) => lines.len(),
        }
    }

    /// Whether there are no lines.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The path of the support along line n, counted from 0.
    pub fn track(&self, path: Path, n: usize) -> Track {
        match self {
            Self::Rectangle { pitch, length, .. } => path.track(n, *pitch, *length),
            Self::Lines(lines) => path.along(n, lines[n]),
        }
    }

    /// Smallest and largest x that a support reaches.
    pub fn ends(&self) -> (f64, f64) {
        match self {
            Self::Rectangle { length, .. } => (0.0, *length),
            Self::Lines(lines) => {
                ends(lines.iter().flat_map(|line| [line.start, line.start + line.length]))
            }
        }
    }

    /// The length of the longest line.
    pub fn longest(&self) -> f64 {
        match self {
            Self::Rectangle { length, .. } => *length,
            Self::Lines(lines) => lines.iter().map(|line| line.length).fold(0.0, f64::max),
        }
    }

    /// The distance from each line to the next, if it is constant and positive.
    pub fn pitch(&self, path: Path) -> Option<f64> {
        match self {
            Self::Rectangle { pitch, .. } => (path != Path::Repeat).then_some(*pitch),
            Self::Lines(lines) => pitch_of(lines),
        }
    }

    /// # Errors
    /// There are no lines, a line is invalid, or too many lines are within reach of each other; `most` is the largest
    /// extent, and at most `most_within` lines may be within `reach`.
    pub(crate) fn validate(
        &self,
        most: f64,
        (reach, most_within): (f64, f64),
    ) -> Result<(), RasterError> {
        if !(1..=MOST_LINES).contains(&self.len()) {
            return Err(RasterError::Lines(self.len()));
        }
        let Self::Lines(lines) = self else { return Ok(()) };
        let is_line = |l: &AreaLine| {
            l.y.abs() <= FARTHEST && l.start.abs() <= most && l.length > 0.0 && l.length <= most
        };
        if let Some(n) = lines.iter().position(|line| !is_line(line)) {
            return Err(RasterError::AreaLine { line: n + 1, found: lines[n], most });
        }
        let (low, high) = self.ends();
        if high - low > most {
            return Err(RasterError::Extent { extent: high - low, most });
        }
        let mut y: Vec<f64> = lines.iter().map(|line| line.y).collect();
        sort_numbers(&mut y);
        y.dedup();
        let within = most_within as usize;
        match y.windows(within + 1).find(|all| all[within] - all[0] < reach) {
            Some(_) => Err(RasterError::Crowded { reach, most: within }),
            None => Ok(()),
        }
    }
}

/// The pitch of these lines, if it is constant and positive.
pub(crate) fn pitch_of(lines: &[AreaLine]) -> Option<f64> {
    let [first, .., last] = lines else { return None };
    let pitch = (last.y - first.y) / (lines.len() - 1) as f64;
    let off =
        |pair: &[AreaLine]| (pair[1].y - pair[0].y - pitch).abs() > EVEN * last.y.abs().max(pitch);
    (pitch > 0.0 && !lines.windows(2).any(off)).then_some(pitch)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(y: f64, start: f64, length: f64) -> AreaLine {
        AreaLine { y, start, length }
    }

    #[test]
    fn an_area_knows_its_ends_and_its_pitch() {
        let area =
            Area::Lines(vec![line(1.0, -3.0, 5.0), line(1.5, 2.0, 7.0), line(2.0, 0.0, 1.0)]);
        assert_eq!((area.ends(), area.longest()), ((-3.0, 9.0), 7.0));
        assert!((area.pitch(Path::OneWay).unwrap() - 0.5).abs() < 1e-15);
        let back = area.track(Path::Zigzag, 1);
        assert_eq!((back.y, back.start, back.length, back.backward), (1.5, 9.0, 7.0, true));
        assert!((back.x(2.0) - 7.0).abs() < 1e-15 && (back.along(7.0) - 2.0).abs() < 1e-15);
        for uneven in [[0.0, 1.0, 2.5], [0.0, 0.0, 0.0], [2.0, 1.0, 0.0]] {
            let area = Area::Lines(uneven.iter().map(|y| line(*y, 0.0, 1.0)).collect());
            assert_eq!(area.pitch(Path::OneWay), None);
        }
    }

    #[test]
    fn what_is_no_area_is_refused() {
        let refused = |lines: Vec<AreaLine>| {
            Area::Lines(lines).validate(1e3, (9.0, 4.0)).unwrap_err().to_string()
        };
        assert!(refused(vec![]).contains("between 1 and"));
        for bad in [
            line(f64::NAN, 0.0, 1.0),
            line(1e308, 0.0, 1.0),
            line(0.0, 1e300, 1.0),
            line(0.0, 0.0, 0.0),
            line(0.0, 0.0, 2e3),
        ] {
            assert!(refused(vec![line(0.0, 0.0, 1.0), bad]).starts_with("line 2"));
        }
        assert!(refused(vec![line(0.0, 0.0, 1.0), line(0.0, 1e3, 1.0)]).contains("extent"));
        let crowded = (0..6).map(|i| line(f64::from(i), 0.0, 1.0)).collect();
        assert!(refused(crowded).contains("within"));
        // At the same y they are one row.
        let same = vec![line(0.0, 0.0, 1.0); 50];
        assert!(Area::Lines(same).validate(1e3, (9.0, 4.0)).is_ok());
    }
}
