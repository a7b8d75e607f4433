//! Growth of a ripple from line to line, and from pass to pass.

use super::Raster;
use num_complex::Complex64;

/// Lines after which a growth from line to line has settled.
const MOST_PASSES: usize = 100_000;

/// c0 + c1 a + c2 a².
type Quadratic = [Complex64; 3];

/// What one q says, whatever the phase.
struct At {
    /// det P
    own: Quadratic,
    /// v·adj(P)u/r, of which the last is 0.
    felt: Quadratic,
    /// ĝ_l(p)
    layers: Vec<Complex64>,
}

impl Raster {
    /// By how much another pass over the same line changes a ripple e^{iqx} of the groove at a given α under the basic law:
    /// 1 + C/D. It grows from pass to pass where this is larger than 1 in modulus.
    #[must_use]
    pub fn repeat_gain(&self, alpha: f64, q: f64) -> Complex64 {
        let ratio = alpha / self.r;
        let [.., g] = self.waves.jets(Complex64::new(0.0, q));
        let d = Complex64::new(1.0, self.r * q) + ratio * g.0;
        let own = q * q * self.footprint.path().fourier(q);
        1.0 + ratio * own / d
    }

    /// The z with A_n ∝ zⁿ at a given α and q of a one-way raster that is largest in modulus, by the first lines of
    /// the recurrence until it settles; the growth from line to line.
    #[must_use]
    pub fn growth(&self, alpha: f64, q: f64) -> Complex64 {
        settled(&self.answers(alpha, q))
    }

    /// c_j, j = 1, 2, …: what deviates of the density that a line leaves is Σ c_j of what deviated of that j lines before.
    #[must_use]
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

fn value(quadratic: &Quadratic, a: f64) -> Complex64 {
    quadratic[0] + (quadratic[1] + quadratic[2] * a) * a
}

/// The ratio of A_n to A_{n-1} that comes to be after many lines of A_n = Σ_j c_j A_{n-1-j}.
fn settled(couplings: &[Complex64]) -> Complex64 {
    let most = couplings.len();
    let mut tracks = vec![Complex64::new(1.0, 0.0)];
    let mut z = Complex64::new(0.0, 0.0);
    for _ in 0..MOST_PASSES {
        let earlier = tracks.iter().rev().zip(couplings);
        let next: Complex64 = earlier.map(|(a, c)| a * c).sum();
        let before = z;
        z = next / tracks.last().copied().unwrap_or(next);
        tracks.push(next);
        if tracks.len() > 2 * most {
            tracks.drain(..tracks.len() - most.max(1));
            let size = next.norm();
            tracks.iter_mut().for_each(|a| *a /= size);
        }
        if (z - before).norm() < 1e-15 * z.norm() {
            break;
        }
    }
    z
}
