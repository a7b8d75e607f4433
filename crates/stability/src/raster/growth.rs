//! Growth of a ripple from line to line, and from pass to pass.

use super::Raster;
use super::plane::Sideways;
use num_complex::{Complex64, ComplexFloat};

/// Largest number of lines in the computation of a growth factor.
const MOST_PASSES: usize = 100_000;

/// c0 + c1 a + c2 a².
type Quadratic = [Complex64; 3];

/// A matrix that multiplies (A, B, C).
type Matrix = [[Complex64; 3]; 3];

/// Quantities that depend on q but not on the phase.
struct At {
    /// det P
    own: Quadratic,
    /// v·adj(P)u/r; its last coefficient is 0.
    felt: Quadratic,
    /// ĝ_l(p)
    layers: Vec<Complex64>,
}

impl Raster {
    /// Factor by which another pass over the same line multiplies a ripple e^{iqx} of its groove, at a given α in the
    /// basic model: 1 + (α/r) q² f̂(q)/D(q) with D(q) = 1 + irq + (α/r) G(iq). The ripple grows if the modulus is above 1.
    pub fn repeat_gain(&self, alpha: f64, q: f64) -> Complex64 {
        let ratio = alpha / self.r;
        let [.., g] = self.waves.jets(Complex64::new(0.0, q));
        let d = Complex64::new(1.0, self.r * q) + ratio * g.0;
        let own = q * q * self.footprint.path().transform(q);
        1.0 + ratio * own / d
    }

    /// Growth factor z of a ripple from line to line, A_n ∝ zⁿ, at a given α and q of a one-way raster: the z of largest
    /// modulus. It is the limit of A_n/A_{n-1} in the recurrence from line to line, which includes both coordinates if the
    /// tip is flexible across the lines; 0 if no line feels an earlier one. For sums of Gaussians only.
    pub fn growth(&self, alpha: f64, q: f64) -> Complex64 {
        if self.terms.across.is_some() {
            let start = [Complex64::new(1.0, 0.3), Complex64::ZERO, Complex64::new(0.7, -0.2)];
            return settled(&self.answers_in_plane(alpha, q), start);
        }
        let answers: Vec<[[Complex64; 1]; 1]> =
            self.answers(alpha, q).into_iter().map(|answer| [[answer]]).collect();
        settled(&answers, [Complex64::ONE])
    }

    /// Coefficients c_j, j = 1, 2, …, of the recurrence from line to line: the deviation of the indentation density of
    /// line n is Σ_j c_j times that of line n - j. For sums of Gaussians only.
    pub fn answers(&self, alpha: f64, q: f64) -> Vec<Complex64> {
        let a = self.density(alpha);
        let at = self.at(q);
        let factor = value(&at.felt, a) * a / value(&at.own, a);
        let most = self.heights[0].iter().map(Vec::len).max().unwrap_or(0);
        let answer = |j: usize| {
            let heights = self.heights[0].iter().zip(&at.layers);
            let each = heights.map(|(heights, g)| heights.get(j).map_or(0.0.into(), |h| g * h));
            factor * each.sum::<Complex64>()
        };
        (0..most).map(answer).collect()
    }

    /// Matrices M_j, j = 1, 2, …, of the recurrence (A, B, C)_n = Σ_j M_j (A, B, C)_{n-j} of one-way lines if the tip is
    /// flexible across them; empty for any other tip. The deviations are e^{iqx} times A along the lines, B of the
    /// weight (0 without a depth limit) and C across the lines.
    pub fn answers_in_plane(&self, alpha: f64, q: f64) -> Vec<Matrix> {
        let Some(Sideways { stiffness, beside: [tilt, bend] }) = self.terms.across else {
            return vec![];
        };
        let (r, s, beta) = (self.r, self.waves.fading, self.terms.steepness);
        let (ratio, p) = (self.density(alpha) / r, Complex64::new(s, q));
        let [_, even_slope, even_curvature] = self.waves.steady;
        let [height, slope, curvature] = self.waves.jets(p).map(|jet| jet.0);
        let [still, across] = [s.into(), p].map(|p| self.waves.across_at(p).0);
        let beside = self.terms.beside;
        let drag = Complex64::new(0.0, r * q);
        let m = drag + 1.0 - self.terms.mass * (r * q).powi(2);
        let own = [
            [
                m - ratio * (even_curvature - curvature + s * s * beside),
                -ratio * slope,
                (-ratio * s * tilt).into(),
            ],
            [
                -ratio * beta * (even_slope - slope + s * beside),
                1.0 - ratio * beta * height,
                (-ratio * beta * tilt).into(),
            ],
            [
                (-ratio * s * tilt).into(),
                0.0.into(),
                drag + stiffness - ratio * (still - across + bend),
            ],
        ];
        let layers: Vec<Complex64> = self.waves.layers_at(p).iter().map(|jet| jet.0).collect();
        let most = self.heights.iter().flatten().map(Vec::len).max().unwrap_or(0);
        let felt = |j: usize| {
            let [h, h1, h2] = [0, 1, 2].map(|order: usize| {
                let each = layers.iter().zip(&self.heights[order]);
                let each = each.map(|(g, h)| g * h.get(j).copied().unwrap_or(0.0));
                each.sum::<Complex64>() * ratio
            });
            [
                [-p * p * h, p * h, -p * h1],
                [-p * h * beta, h * beta, -h1 * beta],
                [-p * h1, h1, -h2],
            ]
        };
        (0..most).map(|j| solution(&own, &felt(j))).collect()
    }

    fn at(&self, q: f64) -> At {
        let (r, s) = (self.r, self.waves.fading);
        let p = Complex64::new(s, q);
        let [_, even_slope, even_curvature] = self.waves.steady;
        let [height, slope, curvature] = self.waves.jets(p).map(|jet| jet.0);
        let (beta, beside) = (self.terms.steepness, self.terms.beside);
        let m = Complex64::new(1.0 - self.terms.mass * (r * q).powi(2), r * q);
        let k = [
            (even_curvature - curvature + s * s * beside) / r,
            slope / r,
            (even_slope - slope + s * beside) * beta / r,
            height * beta / r,
        ];
        let own = [m, -(m * k[3] + k[0]), k[0] * k[3] - k[1] * k[2]];
        let felt = [m * beta - p * p, p * p * k[3] - p * beta * k[1] + p * k[2] - k[0] * beta];
        let felt = [felt[0] / r, felt[1] / r, 0.0.into()];
        let layers = self.waves.layers_at(p).iter().map(|jet| jet.0).collect();
        At { own, felt, layers }
    }
}

/// x of the linear equations Mx = y, by Cramer's rule.
pub(super) fn cramer<T: ComplexFloat>(matrix: [[T; 3]; 3], right: [T; 3]) -> [T; 3] {
    let determinant = |m: [[T; 3]; 3]| {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
            - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    let all = determinant(matrix);
    std::array::from_fn(|column| {
        let mut replaced = matrix;
        (0..3).for_each(|row| replaced[row][column] = right[row]);
        determinant(replaced) / all
    })
}

/// X of PX = Y.
fn solution(p: &Matrix, y: &Matrix) -> Matrix {
    let columns: [_; 3] = std::array::from_fn(|column| cramer(*p, y.map(|row| row[column])));
    std::array::from_fn(|row| columns.map(|column| column[row]))
}

/// The limit of the ratio of successive lines in the recurrence x_n = Σ_j M_j x_{n-j} of numbers or vectors.
fn settled<const N: usize>(answers: &[[[Complex64; N]; N]], start: [Complex64; N]) -> Complex64 {
    let mut z = Complex64::ZERO;
    // No earlier line is felt, or none carves.
    if answers.iter().flatten().flatten().all(|m| m.norm() <= 0.0) {
        return z;
    }
    let mut tracks = vec![start];
    for _ in 0..MOST_PASSES {
        let mut next = [Complex64::ZERO; N];
        for (m, track) in answers.iter().zip(tracks.iter().rev()) {
            for (next, row) in next.iter_mut().zip(m) {
                *next += row.iter().zip(track).map(|(m, x)| m * x).sum::<Complex64>();
            }
        }
        let last = tracks[tracks.len() - 1];
        let before = z;
        let size = |x: &[Complex64; N]| x.iter().map(Complex64::norm_sqr).sum::<f64>();
        let product = next.iter().zip(&last).map(|(next, last)| next * last.conj());
        z = product.sum::<Complex64>() / size(&last);
        tracks.push(next);
        if tracks.len() > 2 * answers.len() {
            tracks.drain(..tracks.len() - answers.len());
            let whole = size(&next).sqrt();
            tracks.iter_mut().flatten().for_each(|x| *x /= whole);
        }
        if (z - before).norm() < 1e-15 * z.norm() {
            break;
        }
    }
    z
}

fn value(quadratic: &Quadratic, a: f64) -> Complex64 {
    quadratic[0] + (quadratic[1] + quadratic[2] * a) * a
}
