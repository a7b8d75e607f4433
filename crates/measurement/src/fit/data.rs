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
}

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

    pub(super) fn judge(&self) -> Result<(), DataError> {
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
        Ok(())
    }
}
