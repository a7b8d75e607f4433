//! Settled ripples of a one-way raster: every line repeats the one before it, shifted along the scan.
//!
//! Let θ_n(x) be the time at which the tip passes x on line n, after the start of the line. In a pattern with the wave
//! vector (q, κ)
//!
//! ```text
//! θ_n'(x) = 1/r + Σ_{k≠0} c_k e^{ik(qx + κdn)},  c_{-k} = c̄_k
//! ```
//!
//! and the force balance at the tip, as a function of x instead of time, is an equation for the c_k:
//!
//! ```text
//! 1/θ' = α Σ_k c_k e^{ikqx} [∫_0^∞ f'(ξ) e^{-ikqξ} dξ + ikq f̂(kq) S_k] + rθ - x,  S_k = Σ_{j≥1} h(jd) e^{-ikκdj}
//! ```
//!
//! with the pitch d and c_0 = 1/r. The first term in brackets is the groove of the line itself, the second that of all earlier
//! lines, for f(x,y) = f(x) h(y); a sum of such products has a sum of second terms. To first order in the c_k the equation is
//! the linear theory of rasters. For given r, κ and c_1 it determines α, q and the other harmonics. It holds as long as the tip
//! only moves forward.

use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::{PI, TAU};
use stickslip_tip::{Footprint, Layer, TipFunction};

type Complex64 = Complex<f64>;

/// Number of harmonics of θ'.
const HARMONICS: usize = 16;
/// Number of points of a wavelength. It is large enough to keep the aliasing of the harmonics of 1/θ' and 1/θ'² small.
const POINTS: usize = 4 * HARMONICS;
/// Harmonics of θ' and Y of a tip that gives way across the lines, and points of a wavelength.
pub(super) const HARMONICS_ACROSS: usize = 10;
pub(super) const POINTS_ACROSS: usize = 2 * HARMONICS_ACROSS + 1;
/// Points of a wavelength for the lag as a function of the position of the support.
const LAG_POINTS: usize = 256;
/// Largest number of Newton iterations, and the residual at which they end.
const ITERATIONS: usize = 30;
const ENOUGH: f64 = 1e-11;
/// Distance, in widths across, at which earlier lines are negligible: e^{-32} = 1e-14.
const WIDTHS: f64 = 8.0;
/// Step in q for derivatives of the transforms of layers.
const STEP: f64 = 1e-6;
/// Number of nodes whose powers are computed side by side: each power is computed from the one before.
const ABREAST: usize = 8;
/// Panels of the Gauss-Legendre rule per unit length, and its positive nodes and weights (order 8).
const PANELS: f64 = 2.0;
const NODES: [f64; 4] = [
    0.183_434_642_495_649_8,
    0.525_532_409_916_329,
    0.796_666_477_413_626_7,
    0.960_289_856_497_536_3,
];
const WEIGHTS: [f64; 4] = [
    0.362_683_783_378_362,
    0.313_706_645_877_887_3,
    0.222_381_034_453_374_48,
    0.101_228_536_290_376_26,
];

/// Lines of a raster. Lengths in σ.
#[derive(Debug, Clone)]
pub(crate) struct Lines {
    /// f(x,0).
    pub(super) tip: TipFunction,
    /// f(x,y) = Σ_l f_l(x) h_l(y).
    pub(super) layers: Vec<Layer>,
    pub(super) pitch: f64,
    /// Number of earlier lines that are not negligible.
    pub(super) earlier: u32,
    /// κ_y of a tip that gives way across the lines.
    pub(super) stiffness: Option<f64>,
    /// Nodes and weights of integrals over the way behind the tip.
    pub(super) nodes: Vec<(f64, f64)>,
    /// Nodes, weights times f', of the integral over f'.
    rule: Vec<(f64, f64)>,
    /// e^{2πi k/POINTS}.
    turns: Vec<Complex64>,
}

/// A travelling pattern.
#[derive(Debug, Clone)]
pub(crate) struct Travelling {
    pub(crate) alpha: f64,
    pub(crate) q: f64,
    /// Complex amplitudes of the height, k = 1, 2, …: u = mean + 2 Re Σ B_k e^{ik(qx + κy)}, in kσ²/a.
    pub(crate) heights: Vec<Complex64>,
    /// The solution, from which that for a pattern nearby starts.
    pub(super) unknowns: Unknowns,
}

#[derive(Debug, Clone)]
pub(super) struct Unknowns {
    pub(super) alpha: f64,
    pub(super) q: f64,
    /// Mean of the lag rθ - x, divided by r.
    pub(super) mean: f64,
    /// 1/r
    pub(super) slowness: f64,
    pub(super) c: Vec<Complex64>,
    /// Distances of the tip from its line at evenly spaced phases; empty for a rigid tip.
    pub(super) across: Vec<f64>,
}

impl Lines {
    /// `None` for a footprint that does not fade, or for a pitch that is not above 0.
    pub(crate) fn new(footprint: &Footprint, pitch: f64) -> Option<Self> {
        let tip = footprint.path().clone();
        let reach = tip.reach()?;
        if !(pitch.is_finite() && pitch > 0.0 && reach.is_finite()) {
            return None;
        }
        let layers = footprint.layers().to_vec();
        let beside = |layer: &Layer| layer.across.center + WIDTHS * layer.across.width;
        let widest = layers.iter().map(beside).fold(0.0, f64::max);
        let panels = (PANELS * reach).ceil().max(1.0);
        let half = 0.5 * reach / panels;
        let mut nodes = vec![];
        for panel in 0..panels as u32 {
            let middle = (2.0 * f64::from(panel) + 1.0) * half;
            for (node, weight) in NODES.iter().zip(WEIGHTS) {
                for x in [middle - half * node, middle + half * node] {
                    nodes.push((x, half * weight));
                }
            }
        }
        let turns = (0..POINTS).map(|i| Complex64::from_polar(1.0, TAU * i as f64 / POINTS as f64));
        let earlier = (widest / pitch).ceil().max(1.0) as u32;
        let rule = nodes.iter().map(|(x, weight)| (*x, weight * tip.slope(*x))).collect();
        let turns = turns.collect();
        Some(Self { tip, layers, pitch, earlier, stiffness: None, nodes, rule, turns })
    }

    /// The same lines with a tip on a spring κ_y across them; `None` for a rigid one.
    pub(crate) fn with_stiffness(&self, stiffness: Option<f64>) -> Self {
        Self { stiffness, ..self.clone() }
    }

    /// Responses of the slope at the tip to the harmonics 1, 2, …, `count`, divided by α, each with its derivative by q.
    fn responses(&self, q: f64, kappa: f64, count: usize) -> Vec<(Complex64, Complex64)> {
        let mut responses = self.own_responses(q, count);
        for layer in &self.layers {
            let mut earlier = vec![Complex64::ZERO; count];
            for j in 1..=self.earlier {
                let away = f64::from(j) * self.pitch;
                let turn = Complex64::from_polar(1.0, -kappa * away);
                let mut power = Complex64::new(layer.across.value(away), 0.0);
                for sum in &mut earlier {
                    power *= turn;
                    *sum += power;
                }
            }
            for (((response, slope), earlier), k) in responses.iter_mut().zip(earlier).zip(1_u32..)
            {
                let groove = |q: f64| {
                    let k = f64::from(k) * q;
                    Complex64::new(0.0, k * layer.along.fourier(k)) * earlier
                };
                let here = groove(q);
                *response += here;
                *slope += (groove(q + STEP) - here) / STEP;
            }
        }
        responses
    }

    /// The part of the responses that is due to the groove of the line itself.
    fn own_responses(&self, q: f64, count: usize) -> Vec<(Complex64, Complex64)> {
        // Real and imaginary parts of the sums over f' e^{-ikqξ} and over ξ f' e^{-ikqξ}.
        let mut sums = vec![[[0.0; ABREAST]; 4]; count];
        for nodes in self.rule.chunks(ABREAST) {
            let [mut x, mut cosine, mut sine, mut re, mut im] = [[0.0; ABREAST]; 5];
            for (i, (node, weight)) in nodes.iter().enumerate() {
                (sine[i], cosine[i]) = (-q * node).sin_cos();
                (x[i], re[i]) = (*node, *weight);
            }
            for [sum_re, sum_im, moment_re, moment_im] in &mut sums {
                for i in 0..ABREAST {
                    (re[i], im[i]) =
                        (re[i] * cosine[i] - im[i] * sine[i], re[i] * sine[i] + im[i] * cosine[i]);
                    sum_re[i] += re[i];
                    sum_im[i] += im[i];
                    moment_re[i] += x[i] * re[i];
                    moment_im[i] += x[i] * im[i];
                }
            }
        }
        let all = |parts: &[f64; ABREAST]| parts.iter().sum::<f64>();
        let response = |(parts, k): (&[[f64; ABREAST]; 4], u32)| {
            let [re, im, moment_re, moment_im] = parts.each_ref().map(all);
            // d/dq e^{-ikqξ} = -ikξ e^{-ikqξ}.
            let slope = Complex64::new(moment_re, moment_im) * Complex64::new(0.0, -f64::from(k));
            (Complex64::new(re, im), slope)
        };
        sums.iter().zip(1..).map(response).collect()
    }

    /// α and r of the neutral wave (q, κ) by linear theory; `None` if there is none with α, r > 0.
    pub(crate) fn neutral(&self, q: f64, kappa: f64) -> Option<(f64, f64)> {
        match self.stiffness {
            Some(stiffness) => self.neutral_across(q, kappa, stiffness),
            None => self.neutral_rigid(q, kappa),
        }
    }

    pub(super) fn neutral_rigid(&self, q: f64, kappa: f64) -> Option<(f64, f64)> {
        // 0 = 1 + irq + iq (α/r) r W with W the response: -r² c_1 = α c_1 W + r c_1/(iq).
        let w = self.responses(q, kappa, 1)[0].0 * Complex64::new(0.0, -q);
        // 1 + irq = (α/r) w.
        let ratio = 1.0 / w.re;
        let r = ratio * w.im / q;
        let alpha = ratio * r;
        (alpha > 0.0 && r > 0.0 && alpha.is_finite()).then_some((alpha, r))
    }

    /// The pattern with this r, κ and c_1 = `swing`/(2r): θ' varies by `swing`/r to first order. Newton's method starts
    /// from a pattern nearby, or from linear theory at (`q`, `kappa`).
    pub(crate) fn pattern(
        &self,
        r: f64,
        kappa: f64,
        swing: f64,
        near: Result<&Travelling, f64>,
    ) -> Option<Travelling> {
        let (harmonics, points) = if self.stiffness.is_some() {
            (HARMONICS_ACROSS, POINTS_ACROSS)
        } else {
            (HARMONICS, 0)
        };
        let mut at = match near {
            Ok(near) => near.unknowns.clone(),
            Err(q) => {
                let alpha = self.neutral(q, kappa)?.0;
                let c = vec![Complex64::new(0.0, 0.0); harmonics];
                let mean = 1.0 + alpha * self.tip.value(0.0) / (r * r);
                Unknowns { alpha, q, mean, slowness: 1.0 / r, c, across: vec![0.0; points] }
            }
        };
        if at.across.len() != points {
            return None;
        }
        at.slowness = 1.0 / r;
        at.c[0] = Complex64::new(0.5 * swing / r, 0.0);
        for _ in 0..ITERATIONS {
            let step = match self.stiffness {
                Some(stiffness) => self.newton_across((r, kappa, stiffness), &at)?,
                None => self.newton_rigid(r, kappa, &at)?,
            };
            match step {
                Some(step) => at = at.moved(&step)?,
                None => return self.found(at, kappa),
            }
        }
        None
    }

    /// A step of Newton's method: `Some(None)` if the force balance is met, `None` if there is no step.
    fn newton_rigid(&self, r: f64, kappa: f64, at: &Unknowns) -> Option<Option<DVector<f64>>> {
        let (residual, jacobian) = self.linearised(r, kappa, at)?;
        if residual.amax() < ENOUGH * r.max(1.0) {
            return Some(None);
        }
        jacobian.lu().solve(&residual).map(Some)
    }

    /// Residual of the force balance by harmonics, and its derivatives by α, q, the mean and the real and imaginary parts of c_2, ….
    fn linearised(
        &self,
        r: f64,
        kappa: f64,
        at: &Unknowns,
    ) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let count = 2 * HARMONICS + 1;
        let (here, slopes): (Vec<_>, Vec<_>) =
            self.responses(at.q, kappa, HARMONICS).into_iter().unzip();
        let position = |k: usize, q: f64| Complex64::new(0.0, -r / (k as f64 * q));
        let own = -self.tip.value(0.0) / r;
        let slowness: Vec<f64> = (0..POINTS)
            .map(|i| {
                let sum: f64 = (1..=HARMONICS).map(|k| (at.c[k - 1] * self.wave(k * i)).re).sum();
                1.0 / r + 2.0 * sum
            })
            .collect();
        if !slowness.iter().all(|s| *s > 0.0) {
            return None;
        }
        let of = |function: fn(f64) -> f64| -> Vec<f64> {
            slowness.iter().map(|s| function(*s)).collect()
        };
        let inverse = self.harmonics(&of(|s| 1.0 / s), HARMONICS);
        let square = self.harmonics(&of(|s| -1.0 / (s * s)), 2 * HARMONICS);
        let mut residual = vec![inverse[0].re - at.alpha * own - r * at.mean];
        for k in 1..=HARMONICS {
            let force = at.c[k - 1] * (at.alpha * here[k - 1] + position(k, at.q));
            let left = inverse[k] - force;
            residual.extend([left.re, left.im]);
        }
        let mut jacobian = DMatrix::zeros(count, count);
        let mut fill = |column: usize, values: &[Complex64]| {
            jacobian[(0, column)] = values[0].re;
            for k in 1..=HARMONICS {
                jacobian[(2 * k - 1, column)] = values[k].re;
                jacobian[(2 * k, column)] = values[k].im;
            }
        };
        let zero = Complex64::new(0.0, 0.0);
        let by = |of: &dyn Fn(usize) -> Complex64, mean: f64| -> Vec<Complex64> {
            std::iter::once(Complex64::new(mean, 0.0)).chain((1..=HARMONICS).map(of)).collect()
        };
        fill(0, &by(&|k| -at.c[k - 1] * here[k - 1], -own));
        let moved = |k: usize| -at.c[k - 1] * (at.alpha * slopes[k - 1] - position(k, at.q) / at.q);
        fill(1, &by(&moved, 0.0));
        fill(2, &by(&|_| zero, -r));
        // The change of 1/θ' by c_k is -θ'^-2 times a wave: shifted harmonics of the first factor.
        let shifted = |m: usize, k: usize| {
            if m >= k { square[m - k] } else { square[k - m].conj() }
        };
        for k in 2..=HARMONICS {
            for (part, unit) in
                [Complex64::new(1.0, 0.0), Complex64::new(0.0, 1.0)].into_iter().enumerate()
            {
                let mut values: Vec<Complex64> = (0..=HARMONICS)
                    .map(|m| unit * shifted(m, k) + unit.conj() * square[m + k])
                    .collect();
                values[k] -= unit * (at.alpha * here[k - 1] + position(k, at.q));
                fill(2 * k - 1 + part, &values);
            }
        }
        Some((DVector::from_vec(residual), jacobian))
    }

    /// e^{iφ} at the angle i/POINTS of a turn.
    fn wave(&self, i: usize) -> Complex64 {
        self.turns[i % POINTS]
    }

    /// Complex amplitudes 0 to `last` of values over a wavelength.
    fn harmonics(&self, values: &[f64], last: usize) -> Vec<Complex64> {
        let of = |k: usize| {
            let turned = values.iter().enumerate().map(|(i, v)| self.wave(k * i).conj() * *v);
            turned.sum::<Complex64>() / POINTS as f64
        };
        (0..=last).map(of).collect()
    }

    fn found(&self, at: Unknowns, kappa: f64) -> Option<Travelling> {
        let heights = match self.stiffness {
            Some(_) => self.heights_across(&at, kappa),
            None => self.heights_rigid(&at, kappa),
        };
        let found = Travelling { alpha: at.alpha, q: at.q, heights, unknowns: at };
        (found.alpha > 0.0 && found.q > 0.0).then_some(found)
    }

    /// Complex amplitudes of the height.
    fn heights_rigid(&self, at: &Unknowns, kappa: f64) -> Vec<Complex64> {
        let height = |(i, c): (usize, &Complex64)| {
            let k = (i + 1) as f64;
            let layer = |layer: &Layer| {
                layer.along.fourier(k * at.q) * layer.across.fourier(k * kappa) / self.pitch
            };
            -c * (at.alpha * self.layers.iter().map(layer).sum::<f64>())
        };
        at.c.iter().enumerate().map(height).collect()
    }
}

impl Travelling {
    /// Complex amplitude L of the first harmonic 2 Re L e^{i(qR + κy)} of the lag, in σ. R is the position of the support,
    /// whereas [`heights`](Self::heights) are a function of the position of the tip.
    pub(crate) fn lag(&self) -> Complex64 {
        let Unknowns { q, mean, slowness, c, .. } = &self.unknowns;
        let r = 1.0 / slowness;
        let point = |i: usize| {
            let phase = TAU * i as f64 / LAG_POINTS as f64;
            let wave = |k: usize| c[k - 1] * Complex64::cis(k as f64 * phase);
            let (mut lag, mut speed) = (r * mean, 1.0);
            for k in 1..=c.len() {
                lag += 2.0 * r * (wave(k) / Complex64::new(0.0, k as f64 * q)).re;
                speed += 2.0 * r * wave(k).re;
            }
            // dR = rθ' dx
            lag * speed * Complex64::cis(-phase - q * lag)
        };
        (0..LAG_POINTS).map(point).sum::<Complex64>() / LAG_POINTS as f64
    }
}

impl Unknowns {
    /// Newton's step; `None` if it leaves the domain.
    pub(super) fn moved(mut self, step: &DVector<f64>) -> Option<Self> {
        // Far from the solution a full step of q or α may change sign.
        let part = [(self.alpha, step[0]), (self.q, step[1])]
            .map(|(value, step)| (0.5 * value / step.abs()).min(1.0))
            .into_iter()
            .fold(1.0, f64::min);
        self.alpha -= part * step[0];
        self.q -= part * step[1];
        self.mean -= part * step[2];
        for k in 2..=self.c.len() {
            self.c[k - 1] -= part * Complex64::new(step[2 * k - 1], step[2 * k]);
        }
        let first = 2 * self.c.len() + 1;
        for (across, step) in self.across.iter_mut().zip(step.iter().skip(first)) {
            *across -= part * step;
        }
        (self.alpha.is_finite() && self.q.is_finite()).then_some(self)
    }
}

/// Angle between the crests and the scan axis, in degrees, from 0 to 90.
pub(crate) fn crest_angle(q: f64, kappa: f64) -> f64 {
    q.atan2(kappa.abs()) * 180.0 / PI
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(pitch: f64) -> Lines {
        let tip = TipFunction::gaussian(1.0).unwrap();
        Lines::new(&Footprint::separable(tip, 1.0).unwrap(), pitch).unwrap()
    }

    /// Thresholds of linear theory, PHYSICS: αc = 0.805167 at pitch 1 and r = 1. The neutral curve r(q, κ) has its smallest α
    /// there.
    #[test]
    fn the_neutral_wave_is_that_of_linear_theory() {
        let mut least = f64::INFINITY;
        for i in 0..200 {
            let q = 0.75 + 0.001 * f64::from(i);
            // κ at which r = 1, by bisection.
            let (mut low, mut high) = (-1.2, -0.3);
            let r = |kappa: f64| lines(1.0).neutral(q, kappa).map_or(f64::NAN, |(_, r)| r);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                *(if (r(middle) > 1.0) == (r(low) > 1.0) { &mut low } else { &mut high }) = middle;
            }
            if let Some((alpha, found)) = lines(1.0).neutral(q, low)
                && (found - 1.0).abs() < 1e-9
            {
                least = least.min(alpha);
            }
        }
        assert!((least - 0.805_167).abs() < 2e-6, "{least}");
    }

    /// Central differences have an error of the square of their step.
    #[test]
    fn slopes_of_the_responses_are_their_derivatives() {
        let (lines, q, kappa, step) = (lines(1.0), 0.83, -0.65, 1e-4);
        let [before, here, after] =
            [q - step, q, q + step].map(|q| lines.responses(q, kappa, HARMONICS));
        for ((before, here), after) in before.iter().zip(&here).zip(&after) {
            let slope = (after.0 - before.0) / (2.0 * step);
            assert!((here.1 - slope).norm() < 1e-5 * (1.0 + slope.norm()), "{here:?} {slope}");
        }
    }

    /// α and q of small waves differ from linear theory by the square of the amplitude.
    #[test]
    fn small_patterns_approach_linear_theory_in_second_order() {
        let lines = lines(1.0);
        let (q, kappa) = (0.83, -0.65);
        let (alpha, r) = lines.neutral(q, kappa).unwrap();
        let off = |swing: f64| {
            let found = lines.pattern(r, kappa, swing, Err(q)).unwrap();
            (found.alpha - alpha).abs()
        };
        let ratio = off(0.02) / off(0.01);
        assert!((ratio - 4.0).abs() < 0.03, "{ratio}");
    }

    /// With a pitch beyond reach a line is alone: the pattern is the limit cycle of the crate `cycles`, whose period
    /// at β = 1, α = αc + 0.01, r = 1 is 6.693688892159 (DESIGN, 30-digit arithmetic).
    #[test]
    fn a_single_line_is_the_limit_cycle() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let lines = Lines::new(&Footprint::separable(tip, 0.1).unwrap(), 10.0).unwrap();
        let alpha = 1.069_036_174_947 + 0.01;
        let (mut low, mut high) = (0.05, 0.6);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            let found = lines.pattern(1.0, 0.0, middle, Err(0.942_779)).unwrap();
            *(if found.alpha < alpha { &mut low } else { &mut high }) = middle;
        }
        let found = lines.pattern(1.0, 0.0, low, Err(0.942_779)).unwrap();
        assert!((TAU / found.q - 6.693_688_892_159).abs() < 1e-6, "{}", TAU / found.q);
    }
}
