//! Settled ripples of a one-way raster whose tip gives way across the lines, on a spring κ_y.
//!
//! As in `travelling`, every line repeats the one before it, shifted along the scan: s(φ) = θ' and the distance Y(φ) of the tip
//! from its line are functions of the phase φ = qx + κdn on line n. With f(x,y) = g(x) h(y) the force balances at the tip are
//!
//! ```text
//! 1/s      = α Σ_{j≥0} ∫ g'(x-x') h (jd + Y(φ) - Y_j(x')) s_j(x') dx' + rθ - x
//! qY'(φ)/s = α Σ_{j≥0} ∫ g (x-x') h'(jd + Y(φ) - Y_j(x')) s_j(x') dx' - κ_y Y
//! ```
//!
//! where s_j and Y_j belong to the j-th earlier line, at the phase φ' - κdj with φ' = qx' + κdn, and j = 0 is the line itself
//! up to the tip. At given φ each integrand is a kernel in x - x' times a periodic function. Therefore the integrals are sums
//! over points of a wavelength, with weights from the transform of the kernel: exact for the harmonics that the points resolve.
//! If f is a sum of products g h, so are the integrals.

use super::travelling::{HARMONICS_ACROSS as HARMONICS, Lines, POINTS_ACROSS as POINTS, Unknowns};
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::TAU;
use stickslip_tip::{Across, Layer};

type Complex64 = Complex<f64>;

/// Largest number of iterations for a neutral wave.
const ITERATIONS: usize = 30;
/// The residual at which Newton's method ends.
const ENOUGH: f64 = 1e-10;
/// Step of q for a derivative.
const STEP: f64 = 1e-6;
/// Number of steps of 1/κ_y, from 0 for a rigid tip, over which a neutral wave is followed.
const SOFTER: u32 = 8;
/// α and r from which a neutral wave is sought where a rigid tip has none, and the largest logarithm of either.
const STARTS: [f64; 3] = [0.3, 0.8, 2.0];
const FARTHEST: f64 = 4.0;

/// h, h' and h'' at a distance.
fn derivatives(across: &Across, y: f64) -> [f64; 3] {
    let Across { center, width } = *across;
    let twin = (center > 0.0).then_some(-center);
    std::iter::once(center).chain(twin).fold([0.0; 3], |[h, h1, h2], center| {
        let z = (y - center) / width;
        let bell = (-0.5 * z * z).exp();
        [h + bell, h1 - z / width * bell, h2 + (z * z - 1.0) / (width * width) * bell]
    })
}

/// Weights of the integrals over g' and g by the distance of two points: an entry for each layer and, within it, for the line
/// itself and each earlier one.
struct Weights {
    slope: Vec<[f64; POINTS]>,
    value: Vec<[f64; POINTS]>,
}

/// The phase at a point.
fn angle(point: usize) -> f64 {
    TAU * (point % POINTS) as f64 / POINTS as f64
}

/// The distance from one point to another, in points, within a wavelength.
fn distance(i: usize, k: usize) -> usize {
    (i + POINTS - k) % POINTS
}

/// Values, at the points, of the real periodic function with this transform at the wave numbers 0, 1, ….
fn at_points(transform: impl Fn(usize) -> Complex64) -> [f64; POINTS] {
    let terms: Vec<Complex64> = (0..=HARMONICS).map(transform).collect();
    std::array::from_fn(|m| {
        let wave = |k: usize| 2.0 * (terms[k] * Complex64::cis(angle(k * m))).re;
        (terms[0].re + (1..=HARMONICS).map(wave).sum::<f64>()) / POINTS as f64
    })
}

/// Kernels of the integral over x of a function without its mean, and of the derivative by x.
fn calculus(q: f64) -> [[f64; POINTS]; 2] {
    let number = |k: usize| Complex64::new(0.0, k as f64 * q);
    let integral = at_points(|k| if k == 0 { Complex64::new(0.0, 0.0) } else { 1.0 / number(k) });
    [integral, at_points(number)]
}

/// A kernel applied to values, at a point.
fn folded(kernel: &[f64; POINTS], values: &[f64], i: usize) -> f64 {
    (0..POINTS).map(|k| kernel[distance(i, k)] * values[k]).sum()
}

/// Values of a pattern at the points.
struct Values {
    /// θ'
    slowness: Vec<f64>,
    /// Y
    across: Vec<f64>,
}

impl Lines {
    /// α and r of the neutral wave (q, κ) by linear theory if the tip gives way across the lines: both are followed from those
    /// of a rigid tip as κ_y decreases. `None` if there is no such wave with α, r > 0.
    pub(super) fn neutral_across(&self, q: f64, kappa: f64, stiffness: f64) -> Option<(f64, f64)> {
        let sums = self.neutral_sums(q, kappa);
        let near = |at, softness| neutral_near(at, q, softness, &sums);
        let followed = self.neutral_rigid(q, kappa).and_then(|(alpha, r)| {
            let softer = |at, part| near(at, f64::from(part) / f64::from(SOFTER) / stiffness);
            (1..=SOFTER).try_fold([alpha.ln(), r.ln()], softer)
        });
        // Where a rigid tip has no such wave: the one with the least α.
        let starts = STARTS.iter().flat_map(|alpha| STARTS.map(|r| [alpha.ln(), r.ln()]));
        let at = followed.or_else(|| {
            let found = starts.filter_map(|start| near(start, 1.0 / stiffness));
            let is_near = |at: &[f64; 2]| at.iter().all(|log| log.abs() < FARTHEST);
            found.filter(is_near).min_by(|a, b| a[0].total_cmp(&b[0]))
        })?;
        Some((at[0].exp(), at[1].exp()))
    }

    /// Sums of linear theory: A of the forces along the scan, K that couples both, and B of the forces across it.
    fn neutral_sums(&self, q: f64, kappa: f64) -> [Complex64; 3] {
        let i = Complex64::new(0.0, 1.0);
        let mut sums = [Complex64::new(0.0, 0.0); 3];
        for layer in &self.layers {
            let fourier = |k: f64| Complex64::new(layer.along.fourier(k), 0.0);
            let [all, none] = [q, 0.0].map(fourier);
            let h = |y: f64| derivatives(&layer.across, y);
            let own = [q, 0.0].map(|q| self.one_sided(layer, q));
            let here = h(0.0);
            sums[0] += here[0] * (i * q * own[0] - layer.along.value(0.0));
            sums[2] += here[2] * (own[1] - own[0]);
            for j in 1..=self.earlier {
                let away = f64::from(j) * self.pitch;
                let turn = Complex64::from_polar(1.0, -kappa * away);
                let [h0, h1, h2] = h(away);
                sums[0] += i * q * all * h0 * turn;
                sums[1] += all * h1 * turn;
                sums[2] += h2 * (none - all * turn);
            }
        }
        sums
    }

    /// ∫_0^∞ g(ξ) e^{-iqξ} dξ of a layer.
    fn one_sided(&self, layer: &Layer, q: f64) -> Complex64 {
        let term = |(x, weight): &(f64, f64)| {
            Complex64::from_polar(weight * layer.along.value(*x), -q * x)
        };
        self.nodes.iter().map(term).sum()
    }

    /// A step of Newton's method: `Some(None)` if the force balances are met, `None` if there is no step.
    pub(super) fn newton_across(
        &self,
        (r, kappa, stiffness): (f64, f64, f64),
        at: &Unknowns,
    ) -> Option<Option<DVector<f64>>> {
        let law = (r, stiffness);
        let weights = self.weights(at.q, kappa);
        let here = self.balance(at, &weights, law)?;
        if here.amax() < ENOUGH * r.max(1.0) {
            return Some(None);
        }
        let beside = Unknowns { q: at.q + STEP, ..at.clone() };
        let by_q = (self.balance(&beside, &self.weights(beside.q, kappa), law)? - &here) / STEP;
        self.jacobian(at, &weights, law, &by_q).lu().solve(&here).map(Some)
    }

    fn weights(&self, q: f64, kappa: f64) -> Weights {
        let (mut slope, mut value) = (vec![], vec![]);
        for layer in &self.layers {
            let own: Vec<Complex64> =
                (0..=HARMONICS).map(|k| self.one_sided(layer, k as f64 * q)).collect();
            let peak = layer.along.value(0.0);
            slope.push(at_points(|k| Complex64::new(0.0, k as f64 * q) * own[k] - peak));
            value.push(at_points(|k| own[k]));
            let all: Vec<f64> =
                (0..=HARMONICS).map(|k| layer.along.fourier(k as f64 * q)).collect();
            for j in 1..=self.earlier {
                let turn = |k: usize| {
                    Complex64::from_polar(all[k], -(k as f64) * kappa * f64::from(j) * self.pitch)
                };
                slope.push(at_points(|k| Complex64::new(0.0, k as f64 * q) * turn(k)));
                value.push(at_points(turn));
            }
        }
        Weights { slope, value }
    }

    /// Calls `each` for every pair of a point on the line and a point on the same or an earlier line. Further arguments are the
    /// weights of g' and g, and h, h' and h'' for the distance of the points across the lines.
    fn pairs(
        &self,
        weights: &Weights,
        across: &[f64],
        mut each: impl FnMut((usize, usize), [f64; 2], [f64; 3]),
    ) {
        let lines = (self.earlier + 1) as usize;
        for (n, (slope, value)) in weights.slope.iter().zip(&weights.value).enumerate() {
            let layer = &self.layers[n / lines];
            let away = (n % lines) as f64 * self.pitch;
            for i in 0..POINTS {
                for k in 0..POINTS {
                    let m = distance(i, k);
                    let between = derivatives(&layer.across, away + across[i] - across[k]);
                    each((i, k), [slope[m], value[m]], between);
                }
            }
        }
    }

    /// The forces along and across the lines, over α.
    fn forces(&self, weights: &Weights, Values { slowness, across }: &Values) -> DVector<f64> {
        let mut forces = DVector::zeros(2 * POINTS);
        self.pairs(weights, across, |(i, k), [along, beside], [h, h1, _]| {
            forces[i] += along * h * slowness[k];
            forces[POINTS + i] += beside * h1 * slowness[k];
        });
        forces
    }

    /// Residuals of both force balances at the points; `None` for a tip that moves backward.
    fn balance(
        &self,
        at: &Unknowns,
        weights: &Weights,
        (r, stiffness): (f64, f64),
    ) -> Option<DVector<f64>> {
        let values = at.values();
        let Values { slowness, across } = &values;
        if !slowness.iter().all(|s| *s > 0.0) {
            return None;
        }
        let [integral, derivative] = calculus(at.q);
        let mut residual = -at.alpha * self.forces(weights, &values);
        for i in 0..POINTS {
            let lag = r * (at.mean + folded(&integral, slowness, i));
            residual[i] += 1.0 / slowness[i] - lag;
            let turn = folded(&derivative, across, i);
            residual[POINTS + i] += turn / slowness[i] + stiffness * across[i];
        }
        Some(residual)
    }

    /// The derivatives of the residuals by α, q, the mean, the parts of c_2, … and Y.
    fn jacobian(
        &self,
        at: &Unknowns,
        weights: &Weights,
        (r, stiffness): (f64, f64),
        by_q: &DVector<f64>,
    ) -> DMatrix<f64> {
        let values = at.values();
        let Values { slowness, across } = &values;
        let [mut by_s, mut by_y] = [0, 1].map(|_| DMatrix::zeros(2 * POINTS, POINTS));
        self.pairs(weights, across, |(i, k), [along, beside], [h, h1, h2]| {
            by_s[(i, k)] -= at.alpha * along * h;
            by_s[(POINTS + i, k)] -= at.alpha * beside * h1;
            let [along, beside] = [along * h1, beside * h2].map(|v| at.alpha * v * slowness[k]);
            by_y[(i, k)] += along;
            by_y[(i, i)] -= along;
            by_y[(POINTS + i, k)] += beside;
            by_y[(POINTS + i, i)] -= beside;
        });
        let [integral, derivative] = calculus(at.q);
        for i in 0..POINTS {
            for k in 0..POINTS {
                by_s[(i, k)] -= r * integral[distance(i, k)];
                by_y[(POINTS + i, k)] += derivative[distance(i, k)] / slowness[i];
            }
            let square = slowness[i] * slowness[i];
            by_s[(i, i)] -= 1.0 / square;
            by_s[(POINTS + i, i)] -= folded(&derivative, across, i) / square;
            by_y[(POINTS + i, i)] += stiffness;
        }
        let mut all = DMatrix::zeros(2 * POINTS, 2 * POINTS);
        all.set_column(0, &-self.forces(weights, &values));
        all.set_column(1, by_q);
        all.view_mut((0, 2), (POINTS, 1)).fill(-r);
        for k in 2..=HARMONICS {
            let wave =
                |part: fn(f64) -> f64| DVector::from_fn(POINTS, |i, _| 2.0 * part(angle(k * i)));
            all.set_column(2 * k - 1, &(&by_s * wave(f64::cos)));
            all.set_column(2 * k, &(&by_s * -wave(f64::sin)));
        }
        all.view_mut((0, POINTS), (2 * POINTS, POINTS)).copy_from(&by_y);
        all
    }

    /// Complex amplitudes of the height.
    pub(super) fn heights_across(&self, at: &Unknowns, kappa: f64) -> Vec<Complex64> {
        let Values { slowness, across } = at.values();
        let height = |k: usize| {
            let k_number = k as f64;
            let layer = |layer: &Layer| {
                layer.along.fourier(k_number * at.q) * layer.across.fourier(k_number * kappa)
            };
            let point = |i: usize| {
                Complex64::from_polar(slowness[i], -angle(k * i) - k_number * kappa * across[i])
            };
            let mean = (0..POINTS).map(point).sum::<Complex64>() / POINTS as f64;
            -mean * (at.alpha / self.pitch * self.layers.iter().map(layer).sum::<f64>())
        };
        (1..=HARMONICS).map(height).collect()
    }
}

/// ln α and ln r at which the determinant vanishes for a softness 1/κ_y, from values nearby. For s = 1/r + c e^{iqx} and
/// Y = e e^{iqx}, with the sums A, K and B,
///
/// ```text
/// (αA + r² + r/(iq)) c = (iqα/r) K e,   (1 + (iqr - (α/r) B)/κ_y) e = (α/κ_y) K c
/// ```
fn neutral_near(
    mut at: [f64; 2],
    q: f64,
    softness: f64,
    [along, coupling, across]: &[Complex64; 3],
) -> Option<[f64; 2]> {
    let i = Complex64::new(0.0, 1.0);
    let value = |at: &[f64; 2]| {
        let (alpha, r) = (at[0].exp(), at[1].exp());
        let first = along * alpha + r * r + r / (i * q);
        let second = 1.0 + softness * (i * q * r - across * (alpha / r));
        let determinant =
            first * second - i * q * (alpha * alpha / r) * softness * coupling * coupling;
        [determinant.re, determinant.im]
    };
    for _ in 0..ITERATIONS {
        let here = value(&at);
        let column = |n: usize| {
            let mut there = at;
            there[n] += STEP;
            let there = value(&there);
            [0, 1].map(|k| (there[k] - here[k]) / STEP)
        };
        let [a, b] = [column(0), column(1)];
        let jacobian = DMatrix::from_row_slice(2, 2, &[a[0], b[0], a[1], b[1]]);
        let step = jacobian.lu().solve(&DVector::from_column_slice(&here))?;
        let part = (0.3 / step.amax()).min(1.0);
        at = [0, 1].map(|n| at[n] - part * step[n]);
        if step.amax() < 1e-10 {
            return Some(at);
        }
    }
    None
}

impl Unknowns {
    /// θ' and Y at the points.
    fn values(&self) -> Values {
        let slowness = (0..POINTS)
            .map(|i| {
                let wave = |k: usize| (self.c[k - 1] * Complex64::cis(angle(k * i))).re;
                self.slowness + 2.0 * (1..=HARMONICS).map(wave).sum::<f64>()
            })
            .collect();
        Values { slowness, across: self.across.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::travelling::crest_angle;
    use super::*;
    use stickslip_tip::{Footprint, TipFunction};

    fn lines(pitch: f64) -> Lines {
        let tip = TipFunction::gaussian(1.0).unwrap();
        Lines::new(&Footprint::separable(tip, 1.0).unwrap(), pitch).unwrap()
    }

    /// α and κ of the neutral wave with this q at r = 1 that has the least α.
    fn neutral_at_1(lines: &Lines, q: f64) -> Option<(f64, f64)> {
        let excess = |kappa: f64| lines.neutral(q, kappa).map(|(_, r)| r.ln());
        let between = |i: u32| {
            let (mut low, mut high) = (-0.01 * f64::from(i), -0.01 * f64::from(i + 1));
            let sign = excess(low)?;
            if sign * excess(high)? > 0.0 {
                return None;
            }
            for _ in 0..40 {
                let middle = 0.5 * (low + high);
                *(if excess(middle)? * sign > 0.0 { &mut low } else { &mut high }) = middle;
            }
            let (alpha, r) = lines.neutral(q, low)?;
            ((r - 1.0).abs() < 1e-8).then_some((alpha, low))
        };
        (20..200).filter_map(between).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The least α of neutral waves at r = 1 and its angle are those of PHYSICS 8, from exponentials and Hermite-Gauss layers:
    /// αc = 0.83391 at 43.8° for κ_y = 10 and pitch 1, 0.89942 at 35.7° for κ_y = 3.
    #[test]
    fn neutral_waves_are_those_of_linear_theory() {
        for (stiffness, wanted, angle) in [(10.0, 0.833_91, 43.8), (3.0, 0.899_42, 35.7)] {
            let lines = lines(1.0).with_stiffness(Some(stiffness));
            let waves = (0..150).filter_map(|i| {
                let q = 0.5 + 0.004 * f64::from(i);
                let (alpha, kappa) = neutral_at_1(&lines, q)?;
                Some((alpha, crest_angle(q, kappa)))
            });
            let least = waves.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
            println!("{stiffness} {least:?}");
            assert!((least.0 - wanted).abs() < 2e-5, "{least:?}");
            assert!((least.1 - angle).abs() < 0.3, "{least:?}");
        }
    }

    /// A stiff spring across makes a rigid tip: α, q, heights and lag differ by 1/κ_y.
    #[test]
    fn patterns_become_those_of_a_rigid_tip() {
        let rigid = lines(1.0);
        let (q, kappa) = (0.83, -0.65);
        let (_, r) = rigid.neutral(q, kappa).unwrap();
        let wanted = rigid.pattern(r, kappa, 0.6, Err(q)).unwrap();
        let off = |stiffness: f64| {
            let lines = rigid.with_stiffness(Some(stiffness));
            let found = lines.pattern(r, kappa, 0.6, Err(q)).unwrap();
            let heights = (0..3).map(|k| (found.heights[k] - wanted.heights[k]).norm());
            let lag = (found.lag() - wanted.lag()).norm();
            heights.sum::<f64>()
                + lag
                + (found.alpha - wanted.alpha).abs()
                + (found.q - wanted.q).abs()
        };
        let (near, far) = (off(1e6), off(1e5));
        println!("{near:e} {far:e}");
        assert!(near < 1e-5 && (far / near - 10.0).abs() < 0.5, "{near} {far}");
    }

    /// α and q of small waves differ from linear theory by the square of the amplitude.
    #[test]
    fn small_patterns_approach_linear_theory_in_second_order() {
        let lines = lines(1.0).with_stiffness(Some(3.0));
        let q = 0.65;
        let (alpha, kappa) = neutral_at_1(&lines, q).unwrap();
        let r = 1.0;
        let off =
            |swing: f64| (lines.pattern(r, kappa, swing, Err(q)).unwrap().alpha - alpha).abs();
        let ratio = off(0.02) / off(0.01);
        println!("{} {ratio}", off(0.01));
        assert!((ratio - 4.0).abs() < 0.03, "{ratio}");
    }
}
