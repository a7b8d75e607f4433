//! A measured profile: positions and heights.

use crate::interval::median;
use stickslip_tip::sorting::sort_by_number;
use thiserror::Error;

/// Smallest number of rows that determines a shape, an offset, a slope and a noise.
pub(crate) const FEWEST_ROWS: usize = 12;
/// Largest number of rows.
pub const MOST_ROWS: usize = 100_000;

/// The reason why a profile was rejected.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ProfileError {
    /// Too few or too many rows.
    #[error("there are {found} rows: {least} to {most} are accepted", least = FEWEST_ROWS, most = MOST_ROWS)]
    Rows {
        /// Number of rows.
        found: usize,
    },
    /// An entry that is not finite.
    #[error("row {row} is not a pair of finite numbers")]
    NotFinite {
        /// Row, from 1.
        row: usize,
    },
    /// Positions that are all the same.
    #[error("all positions are {0}: a profile needs different positions")]
    NoExtent(f64),
    /// Heights that are all the same.
    #[error("all heights are {0}: they contain no footprint")]
    Flat(f64),
}

/// Heights over positions, in any units, by ascending position.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    x: Vec<f64>,
    f: Vec<f64>,
}

impl Profile {
    /// A profile from rows in any order; several may have the same position. If all rows stand equally often, as in a file
    /// that was written twice, each counts once.
    ///
    /// # Errors
    /// Too few or too many rows, a value that is not finite, no extent or no height.
    pub fn new(x: Vec<f64>, f: Vec<f64>) -> Result<Self, ProfileError> {
        let mut rows: Vec<(f64, f64)> = x.into_iter().zip(f).collect();
        if let Some(i) = rows.iter().position(|(x, f)| !(x.is_finite() && f.is_finite())) {
            return Err(ProfileError::NotFinite { row: i + 1 });
        }
        each_once(&mut rows);
        let found = rows.len();
        if !(FEWEST_ROWS..=MOST_ROWS).contains(&found) {
            return Err(ProfileError::Rows { found });
        }
        sort_by_number(&mut rows, |item| item.0);
        let (x, f): (Vec<f64>, Vec<f64>) = rows.into_iter().unzip();
        if x[found - 1] - x[0] <= 0.0 {
            return Err(ProfileError::NoExtent(x[0]));
        }
        let (low, high) = f.iter().fold((f[0], f[0]), |(a, b), v| (a.min(*v), b.max(*v)));
        if high - low <= 0.0 {
            return Err(ProfileError::Flat(low));
        }
        Ok(Self { x, f })
    }

    /// Positions, ascending.
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// Heights.
    pub fn f(&self) -> &[f64] {
        &self.f
    }

    /// The same positions with other heights.
    pub(crate) fn with(&self, f: Vec<f64>) -> Self {
        Self { x: self.x.clone(), f }
    }

    /// First and last position.
    pub(crate) fn ends(&self) -> (f64, f64) {
        (self.x[0], self.x[self.x.len() - 1])
    }

    /// Mean distance of the rows.
    pub(crate) fn spacing(&self) -> f64 {
        let (first, last) = self.ends();
        (last - first) / (self.x.len() - 1) as f64
    }

    /// Whether the profile may be one half of an even one about position 0: it begins there, with its apex.
    pub fn is_half(&self) -> bool {
        let (first, last) = self.ends();
        let extent = last - first;
        if first < -0.02 * extent || first > 0.1 * extent {
            return false;
        }
        let tail = self.x.partition_point(|x| *x < last - 0.1 * extent).min(self.x.len() - 1);
        let mean = |f: &[f64]| f.iter().sum::<f64>() / f.len() as f64;
        let ground = mean(&self.f[tail..]);
        let heights = self.f.windows(5).map(|rows| (mean(rows) - ground).abs());
        let apex = heights.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        apex.is_some_and(|(i, _)| self.x[i] - first < 0.15 * extent)
    }

    /// Standard deviation of the noise from row to row, by the pseudo-residuals of Gasser, Sroka and Jennen-Steinmetz
    /// (1986): the distance of each row from the line between its neighbours. The median of their absolute values
    /// reduces the influence of a few steep places.
    pub(crate) fn noise(&self) -> f64 {
        let sizes = (1..self.x.len() - 1).filter_map(|i| {
            let (before, after) = (self.x[i] - self.x[i - 1], self.x[i + 1] - self.x[i]);
            let part = after / (before + after);
            let off = part * self.f[i - 1] + (1.0 - part) * self.f[i + 1] - self.f[i];
            let size = off.abs() / (1.0 + part * part + (1.0 - part).powi(2)).sqrt();
            size.is_finite().then_some(size)
        });
        median(sizes).map_or(0.0, |size| size / MEDIAN_OF_NORMAL)
    }
}

/// Keeps one of each row if all rows stand equally often: copies bring no information, but would seem to have no noise.
fn each_once(rows: &mut Vec<(f64, f64)>) {
    let mut sorted = rows.clone();
    sort_by_number(&mut sorted, |row| row.1);
    sort_by_number(&mut sorted, |row| row.0);
    let mut groups = sorted.chunk_by(|a, b| a == b).map(<[_]>::len);
    let times = groups.next().unwrap_or(1);
    if times > 1 && groups.all(|count| count == times) {
        sorted.dedup();
        *rows = sorted;
    }
}

/// Median of the absolute value of a standard normal variable.
pub(crate) const MEDIAN_OF_NORMAL: f64 = 0.674_489_75;
