//! The wave in an image: wave vector and harmonics, with line offsets and tilts removed.
//!
//! ```text
//! z(x,y) = a_row + b_row x + 2 Re Σ_{k=1}^{3} B_k e^{ik(qx + κy)} + noise
//! ```
//!
//! Offset and slope of every row are projected out. The start is the largest value of the periodogram; the rest is least
//! squares. Errors follow from the scatter of the scores between blocks of the image. This includes noise that is correlated
//! from pixel to pixel, and slow changes of the pattern across the image.

use super::RippleError;
use crate::image::{Image, ImageError};
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::TAU;

type Complex64 = Complex<f64>;

/// Harmonics measured.
pub(crate) const HARMONICS: usize = 3;
/// q, κ, and two numbers for each harmonic.
pub(crate) const UNKNOWNS: usize = 2 + 2 * HARMONICS;
/// Blocks along each side for the errors.
const BLOCKS: usize = 4;
/// Ratio of the scatter of blocks to that of noise above which it is not chance: χ² of 32 degrees of freedom exceeds it with a
/// probability of 0.0006.
const BEYOND_NOISE: f64 = 2.0;
/// Mean ratio of the variances by blocks and by independent pixels below which their difference is chance: three standard deviations
/// of χ² of 120 degrees of freedom.
const SCATTER: f64 = 1.4;
/// Parts of a wavelength in the mean profile.
const PARTS: usize = 48;
/// Largest number of rows and columns of the periodogram, to which the image is averaged.
const COARSE: usize = 128;
/// Least number of wavelengths along x, and in the image altogether.
const FEWEST: f64 = 1.5;
const ITERATIONS: usize = 60;

/// A plane wave in an image, lengths and heights in the units of the image, relative to its middle.
#[derive(Debug, Clone)]
pub(crate) struct Wave {
    /// q, κ, then Re B_k and Im B_k.
    pub(crate) values: [f64; UNKNOWNS],
    pub(crate) covariance: DMatrix<f64>,
    /// Standard deviation of the residuals.
    pub(crate) residual: f64,
    /// Fraction of the variance that the wave explains.
    pub(crate) explained: f64,
    /// Mean square of the wave per unknown, relative to that of the residuals: F of independent pixels.
    pub(crate) strength: f64,
    /// Standard deviation of the first harmonic between the blocks of the image, beyond the noise, relative to its size.
    pub(crate) modulation: f64,
    /// Mean height and its standard deviation at evenly spaced phases qx + κy from 0 to 2π.
    pub(crate) folded: Vec<[f64; 2]>,
}

/// Images of one area: of the trace and, optionally, of the retrace. Both show the same surface, each with offsets, slopes and
/// noise of its own.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub(super) trace: Image,
    pub(super) retrace: Option<Image>,
    /// Distance by which the ripples of the retrace are further along the lines.
    pub(super) shift: f64,
    /// Weights of the pixels of trace and retrace, with a mean of 1.
    pub(super) weights: [f64; 2],
}

impl Pair {
    pub(super) fn alone(image: &Image) -> Self {
        Self { trace: image.clone(), retrace: None, shift: 0.0, weights: [1.0; 2] }
    }

    /// Both images, made smaller in the same way.
    pub(super) fn each(
        &self,
        smaller: impl Fn(&Image) -> Result<Image, ImageError>,
    ) -> Result<Self, ImageError> {
        let retrace = self.retrace.as_ref().map(&smaller).transpose()?;
        Ok(Self { trace: smaller(&self.trace)?, retrace, ..*self })
    }
}

/// Rows without their own offsets and slopes; positions relative to the middle.
struct Rows {
    x: Vec<f64>,
    rows: Vec<Row>,
}

/// Heights z of a line, whose ripples are further along it by the shift.
struct Row {
    y: f64,
    z: Vec<f64>,
    shift: f64,
    weight: f64,
}

impl Wave {
    /// The strongest wave of the trace, fitted to trace and retrace.
    pub(crate) fn of(pair: &Pair) -> Result<Self, RippleError> {
        let trace = Rows::of(&pair.trace);
        let mut at = [0.0; UNKNOWNS];
        [at[0], at[1]] = trace.coarse(COARSE).strongest().ok_or(RippleError::Nothing)?;
        trace.beside(pair).fit(at)
    }

    pub(crate) fn q(&self) -> f64 {
        self.values[0]
    }

    pub(crate) fn kappa(&self) -> f64 {
        self.values[1]
    }

    pub(crate) fn harmonic(&self, k: usize) -> Complex64 {
        Complex64::new(self.values[2 * k], self.values[2 * k + 1])
    }
}

/// 2 Re Σ B_k e^{ikθ}.
pub(crate) fn height(harmonics: &[Complex64], phase: f64) -> f64 {
    let term = |(k, b): (usize, &Complex64)| (b * Complex64::cis((k + 1) as f64 * phase)).re;
    2.0 * harmonics.iter().enumerate().map(term).sum::<f64>()
}

/// The image without offsets and slopes of its rows, averaged to at most `most` rows and columns.
pub(crate) fn coarse_image(image: &Image, most: usize) -> Result<Image, ImageError> {
    let Rows { x, rows } = Rows::of(image).coarse(most);
    let (y, z): (Vec<f64>, _) = rows.into_iter().map(|row| (row.y, row.z)).unzip();
    let moved = |at: &[f64], of: &[f64]| -> Vec<f64> {
        let middle = 0.5 * (of[0] + of[of.len() - 1]);
        at.iter().map(|v| v + middle).collect()
    };
    Image::new(moved(&x, image.x()), moved(&y, image.y()), z)
}

impl Rows {
    fn of(image: &Image) -> Self {
        let centred = |at: &[f64]| -> Vec<f64> {
            let middle = 0.5 * (at[0] + at[at.len() - 1]);
            at.iter().map(|v| v - middle).collect()
        };
        let x = centred(image.x());
        let rows = centred(image.y()).into_iter().zip(image.rows());
        let rows = rows.map(|(y, row)| Row::new(y, levelled(&x, row))).collect();
        Self { x, rows }
    }

    /// Each row, followed by that of the retrace.
    fn beside(self, pair: &Pair) -> Self {
        let Some(retrace) = &pair.retrace else { return self };
        let [there, back] = pair.weights;
        let both = self.rows.into_iter().zip(Self::of(retrace).rows).flat_map(|(a, b)| {
            [Row { weight: there, ..a }, Row { weight: back, shift: pair.shift, ..b }]
        });
        Self { rows: both.collect(), ..self }
    }

    /// The rows averaged over blocks, to at most `most` rows and columns.
    fn coarse(&self, most: usize) -> Self {
        let (across, along) = (self.rows.len().div_ceil(most), self.x.len().div_ceil(most));
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let x: Vec<f64> = self.x.chunks_exact(along).map(mean).collect();
        let rows = self.rows.chunks_exact(across).map(|rows| {
            let y: Vec<f64> = rows.iter().map(|row| row.y).collect();
            let sums: Vec<f64> =
                (0..self.x.len()).map(|i| rows.iter().map(|row| row.z[i]).sum::<f64>()).collect();
            let row: Vec<f64> = sums.chunks_exact(along).map(mean).collect();
            Row::new(mean(&y), levelled(&x, &row))
        });
        Self { rows: rows.collect(), x }
    }

    /// The wave vector of the largest value of the periodogram, among those spaced by half of a Fourier frequency.
    fn strongest(&self) -> Option<[f64; 2]> {
        let (dx, dy) = (self.x[1] - self.x[0], self.rows[1].y - self.rows[0].y);
        let (nx, ny) = (self.x.len(), self.rows.len());
        let step = [0.5 * TAU / (dx * nx as f64), 0.5 * TAU / (dy * ny as f64)];
        let first = (2.0 * FEWEST).ceil() as usize;
        let mut best = (0.0, None);
        for m in first..nx {
            let q = step[0] * m as f64;
            let turn: Vec<Complex64> =
                self.x.iter().map(|x| Complex64::from_polar(1.0, -q * x)).collect();
            let sum = |row: &Row| row.z.iter().zip(&turn).map(|(z, e)| e * *z).sum();
            let sums: Vec<Complex64> = self.rows.iter().map(sum).collect();
            for n in 0..2 * ny {
                let kappa = step[1] * (n as f64 - ny as f64);
                let mut phase = Complex64::from_polar(1.0, -kappa * self.rows[0].y);
                let on = Complex64::from_polar(1.0, -kappa * dy);
                let mut sum = Complex64::new(0.0, 0.0);
                for row in &sums {
                    sum += row * phase;
                    phase *= on;
                }
                if sum.norm_sqr() > best.0 {
                    best = (sum.norm_sqr(), Some([q, kappa]));
                }
            }
        }
        best.1
    }

    /// Least squares from a start, by Levenberg's and Marquardt's method.
    fn fit(&self, start: [f64; UNKNOWNS]) -> Result<Wave, RippleError> {
        let mut at = start;
        // The amplitudes are linear: from the start all of them are found at once.
        let mut normal = self.normal(&at);
        at = moved(&at, &normal.linear().ok_or(RippleError::Nothing)?);
        normal = self.normal(&at);
        let mut damping = 1e-3;
        for _ in 0..ITERATIONS {
            let step = normal.step(damping).ok_or(RippleError::Nothing)?;
            let there = moved(&at, &step);
            let beyond = self.normal(&there);
            if beyond.sum <= normal.sum {
                let gain = (normal.sum - beyond.sum) / normal.sum.max(f64::MIN_POSITIVE);
                (at, normal, damping) = (there, beyond, 0.1 * damping);
                if gain < 1e-14 {
                    break;
                }
            } else {
                damping *= 10.0;
                if damping > 1e12 {
                    break;
                }
            }
        }
        self.judged(at, &normal)
    }

    /// Normal equations of the whole image, and the scores of each block.
    fn normal(&self, at: &[f64; UNKNOWNS]) -> Normal {
        let (q, kappa) = (at[0], at[1]);
        let b: [Complex64; HARMONICS] =
            std::array::from_fn(|i| Complex64::new(at[2 + 2 * i], at[3 + 2 * i]));
        // Waves along x, and times x, without what offsets and slopes of the rows take.
        let waves: Vec<[Vec<Complex64>; 2]> = (1..=HARMONICS)
            .map(|k| {
                let plain: Vec<Complex64> =
                    self.x.iter().map(|x| Complex64::from_polar(1.0, k as f64 * q * x)).collect();
                let times: Vec<Complex64> = plain
                    .iter()
                    .zip(&self.x)
                    .map(|(e, x)| e * Complex64::new(0.0, k as f64 * x))
                    .collect();
                [levelled_wave(&self.x, &plain), levelled_wave(&self.x, &times)]
            })
            .collect();
        let mut found = Normal::empty();
        let (columns, rows) = (self.x.len(), self.rows.len());
        for (j, Row { y, z, shift, weight }) in self.rows.iter().enumerate() {
            let away = kappa * y - q * shift;
            let turn: [Complex64; HARMONICS] =
                std::array::from_fn(|i| Complex64::cis((i + 1) as f64 * away));
            let block = (j * BLOCKS / rows) * BLOCKS;
            for (i, z) in z.iter().enumerate() {
                let mut slopes = [0.0; UNKNOWNS];
                let mut left = *z;
                for k in 0..HARMONICS {
                    let here = waves[k][0][i] * turn[k];
                    let turned = 2.0 * (b[k] * here).im * (k + 1) as f64;
                    left -= 2.0 * (b[k] * here).re;
                    slopes[0] += 2.0 * (b[k] * waves[k][1][i] * turn[k]).re + turned * shift;
                    slopes[1] -= turned * y;
                    slopes[2 + 2 * k] = 2.0 * here.re;
                    slopes[3 + 2 * k] = -2.0 * here.im;
                }
                let turns = ((q * self.x[i] + away) / TAU).rem_euclid(1.0);
                let part = ((turns * PARTS as f64) as usize).min(PARTS - 1);
                found.add((block + i * BLOCKS / columns, part), (left, *weight), &slopes);
            }
        }
        found
    }

    fn judged(&self, at: [f64; UNKNOWNS], normal: &Normal) -> Result<Wave, RippleError> {
        let pixels = (self.x.len() * self.rows.len()) as f64;
        let freedom = (pixels - 2.0 * self.rows.len() as f64 - UNKNOWNS as f64).max(1.0);
        let residual = (normal.sum / freedom).sqrt();
        let square = |row: &Row| row.weight * row.z.iter().map(|z| z * z).sum::<f64>();
        let all: f64 = self.rows.iter().map(square).sum();
        let inverse = normal.matrix().lu().try_inverse().ok_or(RippleError::Nothing)?;
        let white = &inverse * (residual * residual);
        let blocks = normal.scatter();
        let scattered = &inverse * blocks * &inverse;
        // Correlations between the numbers as for independent pixels; variances by the larger of both, unless the scatter is as for
        // independent pixels within chance.
        let ratios: Vec<f64> = (0..UNKNOWNS).map(|i| scattered[(i, i)] / white[(i, i)]).collect();
        let is_white = ratios.iter().sum::<f64>() < SCATTER * UNKNOWNS as f64;
        let factor: Vec<f64> =
            ratios.iter().map(|v| if is_white { 1.0 } else { v.max(1.0).sqrt() }).collect();
        let covariance =
            DMatrix::from_fn(UNKNOWNS, UNKNOWNS, |i, j| white[(i, j)] * factor[i] * factor[j]);
        let strength =
            (all - normal.sum) / UNKNOWNS as f64 / (residual * residual).max(f64::MIN_POSITIVE);
        let mut values = at;
        if values[0] < 0.0 {
            values[0] = -values[0];
            values[1] = -values[1];
            (0..HARMONICS).for_each(|k| values[3 + 2 * k] = -values[3 + 2 * k]);
        }
        let explained = 1.0 - normal.sum / all.max(f64::MIN_POSITIVE);
        let modulation = normal.modulation(&white) / values[2].hypot(values[3]);
        let folded = vec![];
        let mut wave =
            Wave { values, covariance, residual, explained, strength, modulation, folded };
        // The mean counts correlated noise as the first harmonic does.
        let deviation = residual * (0.5 * (factor[2] * factor[2] + factor[3] * factor[3])).sqrt();
        wave.folded = normal.folded(&wave, deviation);
        if at[0] < 0.0 {
            wave.folded.reverse();
        }
        Ok(wave)
    }
}

impl Row {
    fn new(y: f64, z: Vec<f64>) -> Self {
        Self { y, z, shift: 0.0, weight: 1.0 }
    }
}

/// Normal equations of least squares.
struct Normal {
    matrix: [[f64; UNKNOWNS]; UNKNOWNS],
    /// Scores of the blocks.
    scores: [[f64; UNKNOWNS]; BLOCKS * BLOCKS],
    /// Sum of the squared residuals.
    sum: f64,
    /// Weighted sum of the residuals in each part of a wavelength, and the sum of the weights.
    parts: [(f64, f64); PARTS],
}

impl Normal {
    fn empty() -> Self {
        Self {
            matrix: [[0.0; UNKNOWNS]; UNKNOWNS],
            scores: [[0.0; UNKNOWNS]; BLOCKS * BLOCKS],
            sum: 0.0,
            parts: [(0.0, 0.0); PARTS],
        }
    }

    fn add(
        &mut self,
        (block, part): (usize, usize),
        (left, weight): (f64, f64),
        slopes: &[f64; UNKNOWNS],
    ) {
        self.sum += weight * left * left;
        self.parts[part] = (self.parts[part].0 + weight * left, self.parts[part].1 + weight);
        for (i, slope) in slopes.iter().enumerate() {
            let slope = weight * slope;
            self.scores[block][i] += slope * left;
            for (sum, other) in self.matrix[i].iter_mut().zip(slopes).take(i + 1) {
                *sum += slope * other;
            }
        }
    }

    fn matrix(&self) -> DMatrix<f64> {
        DMatrix::from_fn(UNKNOWNS, UNKNOWNS, |i, j| self.matrix[i.max(j)][i.min(j)])
    }

    fn right(&self) -> DVector<f64> {
        DVector::from_fn(UNKNOWNS, |i, _| self.scores.iter().map(|score| score[i]).sum())
    }

    fn step(&self, damping: f64) -> Option<DVector<f64>> {
        let mut matrix = self.matrix();
        (0..UNKNOWNS).for_each(|i| matrix[(i, i)] *= 1.0 + damping);
        matrix.lu().solve(&self.right())
    }

    /// The step of the amplitudes alone.
    fn linear(&self) -> Option<DVector<f64>> {
        let linear = self.matrix().view((2, 2), (UNKNOWNS - 2, UNKNOWNS - 2)).into_owned();
        let found = linear.lu().solve(&self.right().rows(2, UNKNOWNS - 2).into_owned())?;
        Some(DVector::from_fn(UNKNOWNS, |i, _| if i < 2 { 0.0 } else { found[i - 2] }))
    }

    /// The wave plus the mean residual in each part of a wavelength, and the standard deviation of that mean.
    fn folded(&self, wave: &Wave, deviation: f64) -> Vec<[f64; 2]> {
        let harmonics: Vec<Complex64> = (1..=HARMONICS).map(|k| wave.harmonic(k)).collect();
        let part = |(i, (sum, count)): (usize, &(f64, f64))| {
            let count = count.max(1.0);
            [height(&harmonics, phase(i)) + sum / count, deviation / count.sqrt()]
        };
        self.parts.iter().enumerate().map(part).collect()
    }

    /// Standard deviation of the complex first harmonic between blocks, minus that of white noise; 0 if noise explains it.
    fn modulation(&self, white: &DMatrix<f64>) -> f64 {
        let count = (BLOCKS * BLOCKS) as f64;
        let all = self.matrix();
        let first = DMatrix::from_fn(2, 2, |i, k| all[(2 + i, 2 + k)] / count);
        let Some(inverse) = first.lu().try_inverse() else {
            return f64::INFINITY;
        };
        let apart = |score: &[f64; UNKNOWNS]| {
            (&inverse * DVector::from_column_slice(&score[2..4])).norm_squared()
        };
        let square = self.scores.iter().map(apart).sum::<f64>() / count;
        let noise = count * (white[(2, 2)] + white[(3, 3)]);
        if square > BEYOND_NOISE * noise { (square - noise).sqrt() } else { 0.0 }
    }

    /// Sum over the blocks of the outer products of their scores.
    fn scatter(&self) -> DMatrix<f64> {
        let count = (BLOCKS * BLOCKS) as f64;
        let mut sum = DMatrix::zeros(UNKNOWNS, UNKNOWNS);
        for score in &self.scores {
            let score = DVector::from_column_slice(score);
            sum += &score * score.transpose();
        }
        sum * (count / (count - 1.0))
    }
}

/// The phase in the middle of a part of a wavelength.
pub(crate) fn phase(part: usize) -> f64 {
    TAU * (part as f64 + 0.5) / PARTS as f64
}

fn moved(at: &[f64; UNKNOWNS], step: &DVector<f64>) -> [f64; UNKNOWNS] {
    std::array::from_fn(|i| at[i] + step[i])
}

/// Values minus their regression line over x, which has mean 0.
fn levelled(x: &[f64], values: &[f64]) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let slope = x.iter().zip(values).map(|(x, v)| x * v).sum::<f64>()
        / x.iter().map(|x| x * x).sum::<f64>().max(f64::MIN_POSITIVE);
    x.iter().zip(values).map(|(x, v)| v - mean - slope * x).collect()
}

fn levelled_wave(x: &[f64], values: &[Complex64]) -> Vec<Complex64> {
    let part =
        |of: fn(&Complex64) -> f64| levelled(x, &values.iter().map(of).collect::<Vec<f64>>());
    part(|c| c.re).into_iter().zip(part(|c| c.im)).map(|(re, im)| Complex64::new(re, im)).collect()
}
