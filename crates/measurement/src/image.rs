//! A measured image of a footprint: the width of each Gaussian of its profile across the scan.
//!
//! ```text
//! z(x,y) = ground + apex Σ_k a_k exp(-(x - c_k)²/(2 w_k²)) exp(-(y - y0)²/(2 v_k²))
//! ```
//!
//! a, c and w are those of the profile along x through the middle, from [`tip`](crate::tip); v and y0 are fitted to
//! all pixels, with background and height projected out.

use crate::interval::median;
use crate::least_squares::{Minimum, Residuals, forward, minimum};
use crate::profile::{Profile, ProfileError};
use crate::projection::project;
use crate::tip::{MeasuredTip, bell};
use std::ops::Range;
use stickslip_tip::Gaussian;
use thiserror::Error;

/// Heights over an even grid, a row for each y, in any units.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    x: Vec<f64>,
    y: Vec<f64>,
    rows: Vec<Vec<f64>>,
}

/// The reason why an image gives no footprint.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ImageError {
    /// Too few rows or columns, or not one for each position.
    #[error(
        "{columns} × {rows} pixels: at least {FEWEST} in each direction are needed, in rows of equal length"
    )]
    Size {
        /// Number of pixels in a row.
        columns: usize,
        /// Number of rows.
        rows: usize,
    },
    /// Heights that are not finite.
    #[error("row {row} has a height that is not finite: interpolate it, or crop the image")]
    NotFinite {
        /// Row, from 1.
        row: usize,
    },
    /// Heights that are all the same, or a profile that contains no footprint.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// No footprint was found.
    #[error("no footprint is distinguishable from the background")]
    Nothing,
}

/// f(x,y), fitted to all pixels of an image: each Gaussian of f(x) times exp(-y²/(2v²)).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "AcrossDocument"))]
pub struct Across {
    /// v of each of `gaussians`, in σ.
    pub widths: Vec<f64>,
    /// Centre of symmetry of f across the scan, in the unit of the positions.
    pub centre: f64,
    /// Standard deviation of the residuals of all pixels, in the unit of the heights.
    pub residual: f64,
    /// Standard deviation of the noise from pixel to pixel along the rows, in the unit of the heights.
    pub noise: f64,
}

/// Smallest number of pixels in either direction.
const FEWEST: usize = 12;
/// Number of pixels that is sufficient for a fit.
const ENOUGH: usize = 20_000;
/// Width of the frame that counts as background, as a fraction of the image.
const FRAME: f64 = 0.1;
/// Half width of the band of rows averaged for a profile, as a fraction of the half width across: f falls by 0.1 %
/// there.
const BAND: f64 = 0.05;
/// Step of y0/σ and ln v in finite differences.
const STEP: f64 = 1e-5;

impl Image {
    /// An image with these positions of columns and rows, and these rows of heights.
    ///
    /// # Errors
    /// The image is too small, its rows are uneven, or a value is not finite.
    pub fn new(x: Vec<f64>, y: Vec<f64>, rows: Vec<Vec<f64>>) -> Result<Self, ImageError> {
        let size = ImageError::Size { columns: x.len(), rows: rows.len() };
        let is_even = rows.len() == y.len() && rows.iter().all(|row| row.len() == x.len());
        if !is_even || x.len() < FEWEST || y.len() < FEWEST {
            return Err(size);
        }
        let finite = |row: &Vec<f64>| row.iter().all(|v| v.is_finite());
        if let Some(row) = rows.iter().position(|row| !finite(row)) {
            return Err(ImageError::NotFinite { row: row + 1 });
        }
        Ok(Self { x, y, rows })
    }

    /// Positions of the columns.
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// Positions of the rows.
    pub fn y(&self) -> &[f64] {
        &self.y
    }

    /// Heights, a row for each y.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// Whether the pixels of both images lie at the same positions, within a thousandth of their distance.
    pub(crate) fn is_alike(&self, other: &Self) -> bool {
        let near = |a: &[f64], b: &[f64]| {
            let close = 1e-3 * (a[1] - a[0]).abs();
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= close)
        };
        near(&self.x, &other.x) && near(&self.y, &other.y)
    }

    /// The part of the image in these columns and rows.
    ///
    /// # Errors
    /// [`ImageError::Size`] if these are too few.
    pub(crate) fn part(
        &self,
        columns: Range<usize>,
        rows: Range<usize>,
    ) -> Result<Self, ImageError> {
        let cut = self.rows[rows.clone()].iter().map(|row| row[columns.clone()].to_vec());
        Self::new(self.x[columns.clone()].to_vec(), self.y[rows].to_vec(), cut.collect())
    }

    /// Every `every`th pixel in both directions: x, y and height.
    fn pixels(&self, every: usize) -> impl Iterator<Item = [f64; 3]> {
        let rows = self.y.iter().zip(&self.rows).step_by(every);
        rows.flat_map(move |(y, row)| {
            self.x.iter().zip(row).step_by(every).map(|(x, z)| [*x, *y, *z])
        })
    }

    /// Heights minus the plane through the frame.
    fn above_ground(&self) -> Option<Vec<[f64; 3]>> {
        let within = |at: f64, ends: &[f64]| {
            let (first, last) = (ends[0], ends[ends.len() - 1]);
            let margin = FRAME * (last - first).abs();
            (at - first).abs().min((last - at).abs()) > margin
        };
        let is_frame = |p: &[f64; 3]| !(within(p[0], &self.x) && within(p[1], &self.y));
        let frame: Vec<[f64; 3]> = self.pixels(1).filter(is_frame).collect();
        let column = |i: usize| frame.iter().map(|p| p[i]).collect::<Vec<f64>>();
        let plane = project(&[vec![1.0; frame.len()], column(0), column(1)], &column(2))?;
        let [c, a, b] = <[f64; 3]>::try_from(plane.coefficients).ok()?;
        Some(self.pixels(1).map(|[x, y, z]| [x, y, z - c - a * x - b * y]).collect())
    }

    /// The profile along x through the middle of the footprint.
    ///
    /// # Errors
    /// No footprint rises above the background.
    pub fn profile(&self) -> Result<Profile, ImageError> {
        let above = self.above_ground().ok_or(ImageError::Nothing)?;
        let extreme = above.iter().map(|p| p[2]).max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let extreme = extreme.filter(|z| *z != 0.0).ok_or(ImageError::Nothing)?;
        // More than half as high: the middle of a footprint, whatever its ground.
        let high = above.iter().filter(|p| p[2] / extreme > 0.5);
        let (count, sum, square) =
            high.fold((0.0, 0.0, 0.0), |(n, s, q), [_, y, _]| (n + 1.0, s + y, q + y * y));
        let middle: f64 = sum / count;
        let spread = (square / count - middle * middle).max(0.0).sqrt();
        let apart = |y: &f64| (y - middle).abs();
        let nearest = self.y.iter().map(apart).fold(f64::INFINITY, f64::min);
        let band = nearest.max(2.0 * BAND * spread);
        let rows: Vec<&Vec<f64>> = self
            .y
            .iter()
            .zip(&self.rows)
            .filter(|(y, _)| apart(y) <= band)
            .map(|(_, row)| row)
            .collect();
        let mean = |i: usize| rows.iter().map(|row| row[i]).sum::<f64>() / rows.len() as f64;
        Ok(Profile::new(self.x.clone(), (0..self.x.len()).map(mean).collect())?)
    }

    /// The widths of the Gaussians across the scan; `tip` is the result for [`Image::profile`].
    ///
    /// # Errors
    /// No fit was found.
    pub fn across(&self, tip: &MeasuredTip) -> Result<Across, ImageError> {
        let every = ((self.x.len() * self.y.len()) as f64 / ENOUGH as f64).sqrt().ceil().max(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let pixels: Vec<[f64; 3]> = self.pixels(every as usize).collect();
        let problem = Problem::of(pixels, tip, self.middle());
        let alike = problem.widths.iter().map(|w| w.ln());
        let starts = [1.0, 0.5, 2.0].map(|times: f64| {
            std::iter::once(0.0).chain(alike.clone().map(|w| w + times.ln())).collect::<Vec<f64>>()
        });
        let best = starts.iter().filter_map(|start| minimum(&problem, start));
        let best: Minimum =
            best.min_by(|a, b| a.sum.total_cmp(&b.sum)).ok_or(ImageError::Nothing)?;
        let widths = problem.group.iter().map(|k| best.parameters[1 + k].exp()).collect();
        let freedom = best.residuals.len() as f64 - best.parameters.len() as f64 - 4.0;
        Ok(Across {
            widths,
            centre: problem.middle + tip.sigma.value * best.parameters[0],
            residual: (best.sum / freedom).sqrt(),
            noise: self.noise(),
        })
    }

    fn middle(&self) -> f64 {
        0.5 * (self.y[0] + self.y[self.y.len() - 1])
    }

    /// The median over the rows of [`Profile::noise`].
    fn noise(&self) -> f64 {
        let of = |row: &Vec<f64>| Profile::new(self.x.clone(), row.clone()).ok().map(|p| p.noise());
        median(self.rows.iter().filter_map(of)).unwrap_or(0.0)
    }
}

/// Pixels, and the fixed parts of the model.
struct Problem {
    pixels: Vec<[f64; 3]>,
    /// For each Gaussian its factor along x at every pixel, with its amplitude.
    along: Vec<Vec<f64>>,
    /// For each Gaussian the index of its width across; symmetric pairs share one.
    group: Vec<usize>,
    /// Widths along x, of each group.
    widths: Vec<f64>,
    middle: f64,
    sigma: f64,
}

impl Problem {
    fn of(pixels: Vec<[f64; 3]>, tip: &MeasuredTip, middle: f64) -> Self {
        let sigma = tip.sigma.value;
        let along = tip.gaussians.iter().map(|g| {
            let at = |p: &[f64; 3]| bell(g, (p[0] - tip.centre) / sigma);
            pixels.iter().map(at).collect()
        });
        let along = along.collect();
        let (mut group, mut first): (Vec<usize>, Vec<&Gaussian>) = (vec![], vec![]);
        for g in &tip.gaussians {
            let twin = |other: &&Gaussian| {
                let near = |a: f64, b: f64| (a.abs() - b.abs()).abs() < 1e-9 * (1.0 + b.abs());
                near(other.center, g.center) && near(other.width, g.width)
            };
            group.push(first.iter().position(twin).unwrap_or_else(|| {
                first.push(g);
                first.len() - 1
            }));
        }
        let widths = first.iter().map(|g| g.width).collect();
        Self { pixels, along, group, widths, middle, sigma }
    }
}

/// Admissible widths across, in σ.
const WIDTHS: std::ops::RangeInclusive<f64> = 0.02..=50.0;

impl Residuals for Problem {
    /// Residuals as a function of y0, in σ from the middle, and ln v of each group.
    fn at(&self, parameters: &[f64]) -> Option<Vec<f64>> {
        let (centre, widths) = (parameters[0], &parameters[1..]);
        if !widths.iter().all(|w| WIDTHS.contains(&w.exp())) {
            return None;
        }
        let mut model = vec![0.0; self.pixels.len()];
        for (along, k) in self.along.iter().zip(&self.group) {
            let width = widths[*k].exp();
            for ((sum, part), [_, y, _]) in model.iter_mut().zip(along).zip(&self.pixels) {
                let away = ((y - self.middle) / self.sigma - centre) / width;
                *sum += part * (-0.5 * away * away).exp();
            }
        }
        let column = |i: usize| self.pixels.iter().map(|p| p[i]).collect::<Vec<f64>>();
        let columns = [vec![1.0; self.pixels.len()], column(0), column(1), model];
        Some(project(&columns, &column(2))?.residuals)
    }

    fn derivatives(&self, here: &[f64], parameters: &[f64]) -> Option<Vec<Vec<f64>>> {
        forward(self, (here, parameters), STEP)
    }
}
