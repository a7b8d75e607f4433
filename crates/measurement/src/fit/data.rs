//! What was measured.

use thiserror::Error;

/// Values along a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// Positions, in any unit: on the surface, or of the support.
    pub x: Vec<f64>,
    /// Heights or forces, in any unit.
    pub y: Vec<f64>,
    /// What one unit of the model is, if it is known, but for σ: k/a for heights (in units of height over length²), k for
    /// forces. The gain is fitted where it is not.
    pub gain: Option<f64>,
    /// How many rows, at even distances, each of these is the mean of.
    pub averaged: usize,
}

impl Track {
    /// Rows as they were measured.
    #[must_use]
    pub fn new(x: Vec<f64>, y: Vec<f64>, gain: Option<f64>) -> Self {
        Self { x, y, gain, averaged: 1 }
    }

    /// Distance of the rows as they were measured.
    pub(super) fn spacing(&self) -> f64 {
        let (first, last) = self
            .x
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
        (last - first) / (self.x.len().max(2) - 1) as f64 / self.averaged as f64
    }
}

/// The direction in which the tip moved over the positions of a track.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scan {
    /// Towards larger positions.
    Right,
    /// Towards smaller positions.
    Left,
}

impl Scan {
    /// "right" or "left".
    #[must_use]
    pub fn word(self) -> &'static str {
        if self == Self::Right { "right" } else { "left" }
    }

    pub(super) fn sign(self) -> f64 {
        if self == Self::Right { 1.0 } else { -1.0 }
    }
}

/// Most rows of one file.
const MOST_ROWS: usize = 5_000_000;
/// More rows than this are averaged in groups: a wavelength keeps dozens of them, and their noise falls as they grow fewer.
const KEPT_ROWS: usize = 2048;

/// What was measured, of one motion or of a series of them.
#[derive(Debug, Clone, PartialEq)]
pub enum Data {
    /// Heights of the surface far behind the tip, along its path: `gain` ℓ² u(x/ℓ).
    Ripple(Track),
    /// Lateral force over the way of the support: `gain` ℓ (lag).
    Friction(Track),
    /// A loop: `y` is the force forwards, the second column that backwards over the same positions.
    Loop(Track, Vec<f64>),
    /// Loads at which stick-slip sets in, at these velocities.
    Onsets {
        /// Of the support, in any unit.
        velocity: Vec<f64>,
        /// In any unit: α is in proportion to it.
        load: Vec<f64>,
    },
    /// Wavelengths of ripples at these velocities and loads.
    Wavelengths {
        /// Of the support, in any unit.
        velocity: Vec<f64>,
        /// In any unit: α is in proportion to it.
        load: Vec<f64>,
        /// In the unit of lengths.
        wavelength: Vec<f64>,
    },
}

/// Why data were refused.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DataError {
    /// Columns that are not finite, or not of one length.
    #[error("row {row} is not finite, or not complete")]
    NotFinite {
        /// Counted from 1.
        row: usize,
    },
    /// A velocity, load or wavelength that is not above 0.
    #[error("row {row}: velocities, loads and wavelengths must be above 0")]
    NotPositive {
        /// Counted from 1.
        row: usize,
    },
    /// More rows than are taken.
    #[error("{rows} rows: at most {MOST_ROWS} are read; average neighbouring rows first")]
    Many {
        /// In one of the data.
        rows: usize,
    },
    /// Positions that are all the same.
    #[error("all positions are the same")]
    NoExtent,
    /// A series at fewer places than numbers to fit.
    #[error(
        "{rows} rows at {places} different velocities and loads: {parameters} numbers need as many different ones at least"
    )]
    Places {
        /// Rows of the series.
        rows: usize,
        /// Different ones among them.
        places: usize,
        /// Numbers fitted.
        parameters: usize,
    },
    /// Fewer rows than numbers to fit.
    #[error("{rows} rows are too few for {parameters} numbers")]
    Rows {
        /// In all data.
        rows: usize,
        /// Those fitted.
        parameters: usize,
    },
}

impl Data {
    pub(super) fn rows(&self) -> usize {
        match self {
            Self::Ripple(track) | Self::Friction(track) => track.x.len(),
            Self::Loop(track, _) => 2 * track.x.len(),
            Self::Onsets { load, .. } => load.len(),
            Self::Wavelengths { wavelength, .. } => wavelength.len(),
        }
    }

    /// Phases that are searched.
    pub(super) fn phases(&self) -> usize {
        match self {
            Self::Ripple(_) | Self::Friction(_) => 1,
            Self::Loop(..) => 2,
            Self::Onsets { .. } | Self::Wavelengths { .. } => 0,
        }
    }

    /// Whether it says how high or strong the motion is, and not its shape alone.
    pub(super) fn has_gain(&self) -> bool {
        match self {
            Self::Ripple(track) | Self::Friction(track) | Self::Loop(track, _) => {
                track.gain.is_some()
            }
            Self::Onsets { .. } | Self::Wavelengths { .. } => true,
        }
    }

    /// Numbers that are projected out: offset, slope, gain.
    pub(super) fn linear(&self) -> usize {
        match self {
            Self::Ripple(track) | Self::Friction(track) | Self::Loop(track, _) => {
                2 + usize::from(track.gain.is_none())
            }
            Self::Onsets { .. } | Self::Wavelengths { .. } => 0,
        }
    }

    pub(super) fn is_series(&self) -> bool {
        self.phases() == 0
    }

    /// The rows by ascending position, and where there are more than a few thousand the means of groups of
    /// neighbours.
    ///
    /// # Errors
    /// Rows that are not finite, not complete, or too many.
    pub fn reduced(self) -> Result<Self, DataError> {
        self.judge()?;
        Ok(match self {
            Self::Ripple(track) => Self::Ripple(reduced(track, vec![]).0),
            Self::Friction(track) => Self::Friction(reduced(track, vec![]).0),
            Self::Loop(track, back) => {
                let (track, back) = reduced(track, back);
                Self::Loop(track, back)
            }
            series => series,
        })
    }

    /// How many different velocities, or velocities and loads, a series has; `None` for a track.
    pub(super) fn places(&self) -> Option<usize> {
        let mut places: Vec<(u64, u64)> = match self {
            Self::Onsets { velocity, .. } => velocity.iter().map(|v| (v.to_bits(), 0)).collect(),
            Self::Wavelengths { velocity, load, .. } => {
                velocity.iter().zip(load).map(|(v, l)| (v.to_bits(), l.to_bits())).collect()
            }
            _ => return None,
        };
        places.sort_unstable();
        places.dedup();
        Some(places.len())
    }

    pub(super) fn judge(&self) -> Result<(), DataError> {
        if self.rows() > 2 * MOST_ROWS {
            return Err(DataError::Many { rows: self.rows() });
        }
        let columns: Vec<&[f64]> = match self {
            Self::Ripple(track) | Self::Friction(track) => vec![&track.x, &track.y],
            Self::Loop(track, back) => vec![&track.x, &track.y, back],
            Self::Onsets { velocity, load } => vec![velocity, load],
            Self::Wavelengths { velocity, load, wavelength } => vec![velocity, load, wavelength],
        };
        let longest = columns.iter().map(|column| column.len()).max().unwrap_or(0);
        for i in 0..longest {
            let row: Vec<Option<&f64>> = columns.iter().map(|column| column.get(i)).collect();
            if !row.iter().all(|v| v.is_some_and(|v| v.is_finite())) {
                return Err(DataError::NotFinite { row: i + 1 });
            }
            if self.is_series() && row.iter().flatten().any(|v| **v <= 0.0) {
                return Err(DataError::NotPositive { row: i + 1 });
            }
        }
        if !self.is_series() && columns[0].iter().all(|x| (x - columns[0][0]).abs() <= 0.0) {
            return Err(DataError::NoExtent);
        }
        Ok(())
    }
}

/// A track, and the way back of a loop, by ascending position and in groups.
fn reduced(track: Track, back: Vec<f64>) -> (Track, Vec<f64>) {
    let Track { x, y, gain, averaged } = track;
    let mut order: Vec<usize> = (0..x.len()).collect();
    order.sort_by(|a, b| x[*a].total_cmp(&x[*b]));
    let group = x.len().div_ceil(KEPT_ROWS).max(1);
    // A last group that is not full would be another mean.
    let full = order.len() / group * group;
    let mean = |column: &[f64]| -> Vec<f64> {
        let of = |rows: &[usize]| rows.iter().map(|i| column[*i]).sum::<f64>() / group as f64;
        order[..full].chunks(group).map(of).collect()
    };
    let back = if back.is_empty() { back } else { mean(&back) };
    (Track { x: mean(&x), y: mean(&y), gain, averaged: averaged * group }, back)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_rows_are_averaged_and_few_only_sorted() {
        let x: Vec<f64> = (0..100_000).rev().map(f64::from).collect();
        let many = Data::Ripple(Track::new(x.clone(), x, None)).reduced().unwrap();
        let Data::Ripple(track) = &many else { panic!("a ripple") };
        assert_eq!((track.x.len(), track.averaged), (2040, 49));
        assert!((track.x[0] - 24.0).abs() < 1e-9 && (track.y[1] - 73.0).abs() < 1e-9);
        assert!((track.spacing() - 1.0).abs() < 1e-9);
        assert_eq!(many.clone().reduced().unwrap(), many);
        let few = Data::Loop(Track::new(vec![2.0, 1.0], vec![5.0, 6.0], None), vec![7.0, 8.0]);
        let Data::Loop(track, back) = few.reduced().unwrap() else { panic!("a loop") };
        assert_eq!((track.x, track.y, back), (vec![1.0, 2.0], vec![6.0, 5.0], vec![8.0, 7.0]));
    }

    #[test]
    fn rows_at_one_place_are_one_place() {
        let series = Data::Onsets { velocity: vec![1.0; 3], load: vec![2.0; 3] };
        assert_eq!(series.places(), Some(1));
        let flat = Data::Ripple(Track::new(vec![1.0; 3], vec![2.0; 3], None));
        assert_eq!(flat.reduced(), Err(DataError::NoExtent));
    }
}
