//! Measured data.

use stickslip_tip::sorting::{ascending, ends};
use thiserror::Error;

/// Values along a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// Positions, in any unit: on the surface, or of the support.
    pub x: Vec<f64>,
    /// Heights or forces, in any unit.
    pub y: Vec<f64>,
    /// Scale of the model in units of the data, without σ, if known: k/a for heights (in units of height over
    /// length²), k for forces. An unknown gain is fitted.
    pub gain: Option<f64>,
    /// Number of measured rows, evenly spaced, of which each row here is the mean.
    pub averaged: usize,
}

impl Track {
    /// Rows without averaging.
    pub fn new(x: Vec<f64>, y: Vec<f64>, gain: Option<f64>) -> Self {
        Self { x, y, gain, averaged: 1 }
    }

    /// Distance of the rows before averaging.
    pub(super) fn spacing(&self) -> f64 {
        let (first, last) = ends(self.x.iter().copied());
        (last - first) / (self.x.len().max(2) - 1) as f64 / self.averaged as f64
    }
}

/// Direction of the scan along the positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "ScanName"))]
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

/// Largest number of rows of one file.
const MOST_ROWS: usize = 5_000_000;
/// Largest number of rows kept; more are averaged in groups, which keeps dozens of rows per wavelength and reduces
/// their noise.
const KEPT_ROWS: usize = 2048;

/// Measured data of one motion or of a series of motions; ℓ is the width σ of the tip in the unit of the positions.
#[derive(Debug, Clone, PartialEq)]
pub enum Data {
    /// Heights of the surface far behind the tip, along its path: `gain` ℓ² u(x/ℓ).
    Ripple(Track),
    /// Lateral force against the position of the support: `gain` ℓ times the lag.
    Friction(Track),
    /// A loop: `y` is the force on the trace, the second column that on the retrace over the same positions.
    Loop(Track, Vec<f64>),
    /// Loads at the onset of stick-slip, at these velocities.
    Onsets {
        /// Velocity of the support, in any unit.
        velocity: Vec<f64>,
        /// Load, in any unit; α is proportional to it.
        load: Vec<f64>,
    },
    /// Wavelengths of ripples at these velocities and loads.
    Wavelengths {
        /// Velocity of the support, in any unit.
        velocity: Vec<f64>,
        /// Load, in any unit; α is proportional to it.
        load: Vec<f64>,
        /// Wavelength, in the unit of lengths.
        wavelength: Vec<f64>,
    },
}

/// The reason why data were rejected.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DataError {
    /// Columns that are not finite, or of different lengths.
    #[error("row {row} is not finite, or not complete")]
    NotFinite {
        /// Row, from 1.
        row: usize,
    },
    /// A velocity, load or wavelength that is not above 0.
    #[error("row {row}: velocities, loads and wavelengths must be above 0")]
    NotPositive {
        /// Row, from 1.
        row: usize,
    },
    /// Too many rows.
    #[error("{rows} rows: at most {MOST_ROWS} are read; average neighbouring rows first")]
    Many {
        /// Number of rows in one data set.
        rows: usize,
    },
    /// Positions that are all the same.
    #[error("all positions are the same")]
    NoExtent,
    /// A series at fewer places than parameters to fit.
    #[error(
        "{rows} rows at {places} different velocities and loads: {parameters} parameters need at least {parameters} different ones"
    )]
    Places {
        /// Rows of the series.
        rows: usize,
        /// Number of different velocities and loads.
        places: usize,
        /// Number of fitted parameters.
        parameters: usize,
    },
    /// Fewer rows than parameters to fit.
    #[error("{rows} rows are too few for {parameters} parameters")]
    Rows {
        /// Number of rows in all data.
        rows: usize,
        /// Number of fitted parameters.
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

    /// Number of phases to search.
    pub(super) fn phases(&self) -> usize {
        match self {
            Self::Ripple(_) | Self::Friction(_) => 1,
            Self::Loop(..) => 2,
            Self::Onsets { .. } | Self::Wavelengths { .. } => 0,
        }
    }

    /// The track; `None` for a series.
    pub(super) fn track(&self) -> Option<&Track> {
        match self {
            Self::Ripple(track) | Self::Friction(track) | Self::Loop(track, _) => Some(track),
            Self::Onsets { .. } | Self::Wavelengths { .. } => None,
        }
    }

    /// Whether the data determine the size of the motion, and not only its shape.
    pub(super) fn has_gain(&self) -> bool {
        self.track().is_none_or(|track| track.gain.is_some())
    }

    /// Number of linear parameters, which are projected out: offset, slope, gain.
    pub(super) fn linear(&self) -> usize {
        self.track().map_or(0, |track| 2 + usize::from(track.gain.is_none()))
    }

    pub(super) fn is_series(&self) -> bool {
        self.track().is_none()
    }

    /// The rows by ascending position; if there are more than a few thousand, the means of groups of neighbours.
    ///
    /// # Errors
    /// Rows that are not finite, incomplete, or too many.
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

    /// Number of different velocities, or of velocities and loads, of a series; `None` for a track.
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

/// Columns of offset and slope at these positions.
pub(super) fn ground(x: &[f64]) -> Vec<Vec<f64>> {
    let (first, last) = ends(x.iter().copied());
    let slope = x.iter().map(|x| (2.0 * x - first - last) / (last - first)).collect();
    vec![vec![1.0; x.len()], slope]
}

/// A track, and the retrace of a loop, by ascending position and averaged in groups.
fn reduced(track: Track, back: Vec<f64>) -> (Track, Vec<f64>) {
    let Track { x, y, gain, averaged } = track;
    let order = ascending(&x);
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
