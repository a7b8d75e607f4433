//! The part of the initial surface u0(x,y) that no tip has carved: profile, table and noise.

use super::spline::{Bicubic, Partials, Patch};
use crate::relief::{Piece, noise_heights, noise_points};
use crate::run::Scenario;
use crate::series::{SeriesError, checked};
use crate::spline::Ends;
use thiserror::Error;

/// Heights u, in kσ²/a, at the points (`x_i`, `y_j`) of a grid, in σ.
///
/// Between the points u is a bicubic spline. It is 0 before the first x and behind the last, with slope 0 along the
/// scan there; beyond the first and last y it equals that of the nearest row.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightTable {
    x: Vec<f64>,
    y: Vec<f64>,
    u: Vec<f64>,
}

impl HeightTable {
    /// A table of heights row after row: all x of the first y, then those of the second.
    ///
    /// # Errors
    /// Fewer than three x or y, positions that do not increase, heights that are not finite or not one per point.
    pub fn new(x: Vec<f64>, y: Vec<f64>, u: Vec<f64>) -> Result<Self, SeriesError> {
        for axis in [&x, &y] {
            checked(axis.clone(), axis.clone())?;
        }
        if u.len() != x.len() * y.len() {
            return Err(SeriesError::Uneven(u.len(), x.len() * y.len()));
        }
        match u.iter().position(|u| !u.is_finite()) {
            Some(i) => Err(SeriesError::NotFinite(i + 1)),
            None => Ok(Self { x, y, u }),
        }
    }

    /// All x, all y, and the heights row after row.
    pub fn parts(&self) -> [&[f64]; 3] {
        [&self.x, &self.y, &self.u]
    }
}

/// Errors in an initial surface.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TextureError {
    /// A profile that is not a function of x.
    #[error("the initial surface: {0}")]
    Profile(#[from] SeriesError),
    /// Noise that needs too many points.
    #[error(
        "noise in two coordinates would need {points:e} points (at most {MOST_POINTS:e}): end the run earlier, or take larger spacings"
    )]
    Points {
        /// Number of points.
        points: f64,
    },
}

/// The initial surface except for the groove of steady motion: the sum of a profile u0(x), a table u0(x,y) and noise.
#[derive(Debug, Clone, Default)]
pub struct Texture {
    parts: Vec<Bicubic>,
}

/// The part of the plane about the tip in which u0 is a polynomial.
#[derive(Debug, Clone)]
pub(super) struct Field {
    patches: Vec<Patch>,
    /// Ends along and across, with the slack of each.
    pub(super) ends: [Piece; 2],
}

/// Range of y on both sides of the line that noise covers, in σ; the outermost row continues beyond it.
const COVERED: f64 = 24.0;
const MOST_POINTS: f64 = 5e6;

impl Texture {
    /// Profile and noise of a scenario, rows of noise at this distance across the scan, and a table.
    ///
    /// # Errors
    /// A profile that is not a function of x, or noise of too many points.
    pub(super) fn new(
        along: &Scenario,
        spacing_across: Option<f64>,
        table: Option<&HeightTable>,
    ) -> Result<Self, TextureError> {
        let mut parts = vec![];
        if let Some((x, u)) = along.profile.clone() {
            let (x, u) = checked(x, u)?;
            parts.push(Bicubic::through(x, vec![0.0], &u, Ends::Level));
        }
        if let Some(HeightTable { x, y, u }) = table {
            parts.push(Bicubic::through(x.clone(), y.clone(), u, Ends::Level));
        }
        if let Some(noise) = along.noise {
            let (from, to) = along.noise_range();
            let points = noise_points(noise, from, to);
            let rows = rows_of_noise(spacing_across);
            let all = (points * rows.len()) as f64;
            if all > MOST_POINTS && rows.len() > 1 {
                return Err(TextureError::Points { points: all });
            }
            let x = (0..points).map(|i| from + noise.spacing * i as f64).collect();
            let heights = rows.iter().flat_map(|(stream, _)| noise_heights(noise, points, *stream));
            let (u, y) = (heights.collect::<Vec<_>>(), rows.iter().map(|(_, y)| *y).collect());
            parts.push(Bicubic::through(x, y, &u, Ends::Straight));
        }
        Ok(Self { parts })
    }

    /// A table of waves, for tests.
    #[cfg(test)]
    pub(super) fn waves() -> Self {
        let [x, y] = [12, 8].map(|n| (-n..=n).map(|i| 0.8 * f64::from(i)).collect::<Vec<_>>());
        let wave = |x: f64, y: f64| 0.3 * (0.9 * x + 0.4 * y * y.cos()).sin();
        let u: Vec<f64> = y.iter().flat_map(|y| x.iter().map(|x| wave(*x, *y))).collect();
        Self { parts: vec![Bicubic::through(x, y, &u, Ends::Level)] }
    }

    /// Whether u0 = 0 everywhere.
    pub fn is_flat(&self) -> bool {
        self.parts.is_empty()
    }

    /// u0(x,y).
    pub fn height(&self, x: f64, y: f64) -> f64 {
        let part = |part: &Bicubic| part.jet(&part.patch([x, y], [true; 2], 0.0), [x, y])[0][0];
        self.parts.iter().map(part).sum()
    }

    /// u0(x,y) and its derivatives in x and y.
    pub fn height_and_slopes(&self, x: f64, y: f64) -> [f64; 3] {
        let part = |part: &Bicubic| part.jet(&part.patch([x, y], [true; 2], 0.0), [x, y]);
        let add = |[u, along, across]: [f64; 3], jet: Partials| {
            [u + jet[0][0], along + jet[1][0], across + jet[0][1]]
        };
        self.parts.iter().map(part).fold([0.0; 3], add)
    }

    /// The field that contains a tip, or that the tip is about to enter.
    pub(super) fn field(&self, at: [f64; 2], forward: [bool; 2], accuracy: f64) -> Field {
        let patches: Vec<Patch> =
            self.parts.iter().map(|part| part.patch(at, forward, accuracy)).collect();
        let mut ends = [Piece::EVERYWHERE; 2];
        for patch in &patches {
            for (ends, piece) in ends.iter_mut().zip([patch.x, patch.y]) {
                ends.narrow(&piece);
            }
        }
        Field { patches, ends }
    }

    /// Height and derivatives at any point of the polynomial of a field.
    pub(super) fn jet(&self, field: &Field, at: [f64; 2]) -> Partials {
        let mut sum = [[0.0; 4]; 4];
        for (part, patch) in self.parts.iter().zip(&field.patches) {
            let jet = part.jet(patch, at);
            for (sum, term) in sum.as_flattened_mut().iter_mut().zip(jet.as_flattened()) {
                *sum += term;
            }
        }
        sum
    }
}

impl Field {
    /// Whether u0 is 0 in the field.
    pub(super) fn is_flat(&self) -> bool {
        self.patches.iter().all(|patch| patch.x.index.is_none())
    }
}

/// Number of the random stream and y of each row. The row y = 0 is the noise of a run in one coordinate; without a
/// spacing it is the only row.
fn rows_of_noise(spacing: Option<f64>) -> Vec<(u64, f64)> {
    let Some(spacing) = spacing else { return vec![(0, 0.0)] };
    #[expect(clippy::cast_possible_truncation, reason = "a count")]
    let most = (COVERED / spacing).ceil().max(1.0) as i64;
    let stream =
        |j: i64| if j > 0 { 2 * j.unsigned_abs() } else { (2 * j.unsigned_abs()).max(1) - 1 };
    (-most..=most).map(|j| (stream(j), spacing * j as f64)).collect()
}
