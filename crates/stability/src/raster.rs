//! Linear stability of a raster: many scan lines beside each other, each in the grooves of those before it.
//!
//! Line n, at y = n d, moves over what the earlier lines left. A small ripple A_n e^{iqx} of its track answers to
//! those of the earlier lines, with f(x,y) = Σ_k g_k(x) h_k(y),
//!
//! ```text
//!     D(q) A_n = (α/r) q² Σ_{j≥1} Σ_k ĝ_k(q) h_k(jd) A_{n-j},      D(q) = 1 + irq + (α/r) G(iq)
//! ```
//!
//! with G of (30) and ĝ the Fourier transform. A_n ∝ zⁿ grows from line to line where |z| > 1, so that the
//! threshold is the smallest α with a root on |z| = 1, z = e^{iφ}: crests qx + κy = const., κ = φ/d, that stand
//! oblique to the scan lines. On the way back of a zigzag q changes its sign: D becomes D* on every other line.
//! `docs/stability.md` derives it.

mod growth;
mod wider;

pub use wider::WiderRaster;

use super::transform::CurvatureTransform;
use super::{StabilityError, critical};
use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::Footprint;
use stickslip_tip::roots::zero_between;

/// How the tip goes from one line to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RasterPath {
    /// Every line in the same direction.
    OneWay,
    /// The way back is the next line.
    Zigzag,
}

/// Where ripples begin to grow from line to line. Lengths in σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RasterCritical {
    /// The smallest α with a ripple that does not fade from line to line.
    pub alpha: f64,
    /// r
    pub r: f64,
    /// Its wave number along the lines.
    pub q: f64,
    /// Phase φ from one line to the next, between -π and π; on a zigzag it goes to and fro.
    pub phase_per_line: f64,
    /// φ/d, the wave number across the lines; `None` on a zigzag.
    pub kappa: Option<f64>,
    /// Between crests and scan lines, in degrees: atan(q/|κ|); `None` on a zigzag.
    pub crest_angle: Option<f64>,
    /// 2π/q
    pub wavelength_x: f64,
}

/// Lines that pass over each other's grooves.
#[derive(Debug, Clone)]
pub struct Raster {
    footprint: Footprint,
    transform: CurvatureTransform,
    r: f64,
    pitch: f64,
    /// h_k(jd) of each layer, j = 1, 2, …
    heights: Vec<Vec<f64>>,
}

/// Samples of q and of κ in the search for the first crossing.
const SAMPLES: u32 = 400;
/// h_k(jd) below this share of the largest is none.
const NEGLIGIBLE: f64 = 1e-17;
/// Lines beyond so many are not summed: the pitch is refused.
const MOST_LINES: usize = 1_000_000;
/// Grooves that change a line by less than this leave it alone.
const ALONE: f64 = 1e-13;
/// Step of the differences that a minimum is found by; their error is its fourth power.
const DIFFERENCE: f64 = 1e-3;

impl Raster {
    /// Lines a pitch d apart, dragged at r.
    ///
    /// # Errors
    /// r or the pitch not a positive finite number, or a pitch so small that the lines within reach cannot be summed.
    pub fn new(footprint: &Footprint, r: f64, pitch: f64) -> Result<Self, StabilityError> {
        if !(r.is_finite() && r > 0.0) {
            return Err(StabilityError::R(r));
        }
        let widest = footprint.layers().iter().map(|layer| layer.across);
        let reach = widest.map(|h| h.center + 9.0 * h.width).fold(0.0, f64::max);
        let lines = (reach / pitch).ceil();
        if !(pitch.is_finite() && pitch > 0.0 && lines < MOST_LINES as f64) {
            return Err(StabilityError::Pitch(pitch));
        }
        let transform = CurvatureTransform::new(footprint.path());
        let layers = footprint.layers().iter();
        let heights = layers.map(|layer| {
            let height = |j: usize| layer.across.value(pitch * j as f64);
            let largest = layer.across.value(layer.across.center);
            let negligible = |h: &f64| h.abs() < NEGLIGIBLE * largest;
            let mut heights: Vec<f64> = (1..=lines as usize).map(height).collect();
            let kept = heights.iter().rposition(|h| !negligible(h)).map_or(0, |last| last + 1);
            heights.truncate(kept);
            heights
        });
        let heights = heights.collect();
        Ok(Self { footprint: footprint.clone(), transform, r, pitch, heights })
    }

    /// The first ripple that does not fade from line to line.
    ///
    /// On a zigzag the crossing is that at z = ±1, where the two directions mirror each other. A scan of all phases for
    /// Gaussian tips found none at a smaller α.
    ///
    /// # Errors
    /// As [`critical`]: no ripple grows, however large α.
    pub fn critical(&self, path: RasterPath) -> Result<RasterCritical, StabilityError> {
        let found = match path {
            RasterPath::OneWay => self.one_way(),
            RasterPath::Zigzag => self.zigzag(),
        };
        if self.is_alone() {
            let alone = critical(self.footprint.path(), self.r)?;
            let q = 2.0 * PI / alone.wavelength;
            return Ok(self.threshold(path, alone.alpha, q, 0.0));
        }
        let (alpha, q, phase) = found.ok_or(StabilityError::NoCrossing { r: self.r })?;
        Ok(self.threshold(path, alpha, q, phase))
    }

    fn threshold(&self, path: RasterPath, alpha: f64, q: f64, phase: f64) -> RasterCritical {
        let kappa = (path == RasterPath::OneWay).then_some(phase / self.pitch);
        RasterCritical {
            alpha,
            r: self.r,
            q,
            phase_per_line: phase,
            kappa,
            crest_angle: kappa.map(|kappa| q.atan2(kappa.abs()).to_degrees()),
            wavelength_x: 2.0 * PI / q,
        }
    }

    fn is_alone(&self) -> bool {
        self.heights.iter().flatten().all(|h| h.abs() < ALONE)
    }

    /// D(q).
    fn denominator(&self, q: f64, ratio: f64) -> Complex64 {
        Complex64::new(1.0, self.r * q) + ratio * self.g(q)
    }

    /// G(iq).
    fn g(&self, q: f64) -> Complex64 {
        self.transform.at(Complex64::new(0.0, q)).value
    }

    /// q² Σ_k ĝ_k(q) h_k((j+1)d).
    fn coupling(&self, q: f64, j: usize) -> f64 {
        let layers = self.footprint.layers().iter().zip(&self.heights);
        let layer = |(layer, heights): (&stickslip_tip::Layer, &Vec<f64>)| {
            heights.get(j).map_or(0.0, |h| h * layer.along.fourier(q))
        };
        q * q * layers.map(layer).sum::<f64>()
    }

    /// q² ĝ_k(q) of each layer.
    fn ripples(&self, q: f64) -> Vec<f64> {
        let layers = self.footprint.layers().iter();
        layers.map(|layer| q * q * layer.along.fourier(q)).collect()
    }

    /// Σ_j h_k(jd) e^{-ijφ} of each layer, over the odd and over the even j.
    fn phased(&self, phase: f64) -> Vec<[Complex64; 2]> {
        let sums = |heights: &Vec<f64>| {
            let mut sums = [Complex64::new(0.0, 0.0); 2];
            for (j, h) in heights.iter().enumerate() {
                sums[j % 2] += Complex64::from_polar(*h, -phase * (j + 1) as f64);
            }
            sums
        };
        self.heights.iter().map(sums).collect()
    }

    /// Wave numbers in which the footprint has anything to say.
    fn wave_numbers(&self) -> Vec<f64> {
        let step = self.footprint.path().band() / f64::from(SAMPLES);
        (1..=SAMPLES).map(|i| step * f64::from(i)).collect()
    }
}

/// What one q and one φ say of a one-way raster: with K = G - q² Σ ĝ L(φ), D = C L asks that (1 + irq) + (α/r)K = 0,
/// so that K(1 - irq) is real and negative.
fn real_alpha(
    r: f64,
    q: f64,
    g: Complex64,
    ripples: &[f64],
    phased: &[[Complex64; 2]],
) -> (f64, f64) {
    let sums = phased.iter().map(|[odd, even]| odd + even);
    let lines: Complex64 = ripples.iter().zip(sums).map(|(ripple, sum)| ripple * sum).sum();
    let m = (g - lines) * Complex64::new(1.0, -r * q);
    (-r * (1.0 + (r * q).powi(2)) / m.re, m.im)
}

impl Raster {
    /// α, q and φ of the first crossing of a one-way raster.
    fn one_way(&self) -> Option<(f64, f64, f64)> {
        let q = self.wave_numbers();
        let at: Vec<(f64, Complex64, Vec<f64>)> =
            q.iter().map(|q| (*q, self.g(*q), self.ripples(*q))).collect();
        let farthest = PI.min(self.footprint.path().band() * self.pitch);
        let step = farthest / f64::from(SAMPLES);
        let mut first: Option<(f64, f64, f64)> = None;
        for i in -SAMPLES.cast_signed()..=SAMPLES.cast_signed() {
            let phase = step * f64::from(i);
            let phased = self.phased(phase);
            let seen = |(q, g, ripples): &(f64, Complex64, Vec<f64>)| {
                real_alpha(self.r, *q, *g, ripples, &phased)
            };
            let mut before = seen(&at[0]);
            for pair in at.windows(2) {
                let here = seen(&pair[1]);
                if before.1 * here.1 < 0.0 && before.0 > 0.0 && here.0 > 0.0 {
                    let share = before.1 / (before.1 - here.1);
                    let alpha = before.0 + share * (here.0 - before.0);
                    if first.is_none_or(|(least, ..)| alpha < least) {
                        first = Some((alpha, pair[0].0 + share * (pair[1].0 - pair[0].0), phase));
                    }
                }
                before = here;
            }
        }
        let (_, q, phase) = first?;
        let spacing = at[1].0 - at[0].0;
        let crossing = |phase: f64| self.crossing(phase, q, spacing);
        let slope =
            |phase: f64| difference(step, phase, |phase| crossing(phase).map_or(f64::NAN, |c| c.0));
        let phase = least_near(slope, phase, step);
        crossing(phase).map(|(alpha, q)| (alpha, q, wrapped(phase)))
    }

    /// α and q near `q` at a phase.
    fn crossing(&self, phase: f64, q: f64, spacing: f64) -> Option<(f64, f64)> {
        let phased = self.phased(phase);
        let at = |q: f64| real_alpha(self.r, q, self.g(q), &self.ripples(q), &phased);
        let ends =
            (1..=8).map(|n| spacing * f64::from(n)).map(|far| ((q - far).max(0.5 * q), q + far));
        let (low, high) = ends.into_iter().find(|(low, high)| at(*low).1 * at(*high).1 < 0.0)?;
        let q = zero_between(|q| at(q).1, low, high);
        Some((at(q).0, q))
    }

    /// α, q and the phase between the two directions at the first crossing of a zigzag.
    fn zigzag(&self) -> Option<(f64, f64, f64)> {
        let phased = self.phased(0.0);
        let alpha = |q: f64| self.zigzag_alpha(q, &phased);
        let q = self.wave_numbers();
        let seen = |q: &f64| alpha(*q).map(|alpha| (alpha, *q));
        let first = q.iter().filter_map(seen).min_by(|a, b| a.0.total_cmp(&b.0));
        let step = q[1] - q[0];
        // Lines that hardly feel each other grow beside the q of a single line alone, on a stretch between samples.
        let (near, step) = match first.map(|(_, q)| q) {
            Some(q) => (q, 0.5 * step),
            None => self.beside_single_line(&phased)?,
        };
        let slope = |q: f64| difference(step, q, |q| alpha(q).unwrap_or(f64::NAN));
        let q = least_near(slope, near, step);
        let alpha = alpha(q)?;
        let (d, c) = (self.denominator(q, alpha / self.r), alpha / self.r);
        let [odd, even] = self.summed(q, &phased);
        Some((alpha, q, ((d - c * even) / (c * odd)).arg()))
    }

    /// The q of a single line, and how far beside it a weak coupling may move it: |D| = |C| there, and D changes by more
    /// than r in a unit of q.
    fn beside_single_line(&self, phased: &[[Complex64; 2]]) -> Option<(f64, f64)> {
        let alone = critical(self.footprint.path(), self.r).ok()?;
        let q = 2.0 * PI / alone.wavelength;
        let coupling = self.summed(q, phased).map(|sum| alone.alpha / self.r * sum.norm());
        Some((q, 0.1 * coupling[0].max(coupling[1]) / self.r))
    }

    /// q² Σ_k ĝ_k L_k over odd and even lines.
    fn summed(&self, q: f64, phased: &[[Complex64; 2]]) -> [Complex64; 2] {
        let ripples = self.ripples(q);
        [0, 1].map(|which| {
            ripples.iter().zip(phased).map(|(ripple, sums)| ripple * sums[which]).sum()
        })
    }

    /// The smallest α > 0 with (D - C_e)(D* - C_e) = C_o²: a quadratic in α/r at z = 1, with C_e and C_o of the even
    /// and odd lines.
    fn zigzag_alpha(&self, q: f64, phased: &[[Complex64; 2]]) -> Option<f64> {
        let g = self.g(q);
        let [odd, even] = self.summed(q, phased).map(|sum| sum.re);
        let square = g.norm_sqr() - 2.0 * even * g.re + even * even - odd * odd;
        let linear = g.re + self.r * q * g.im - even;
        let constant = 1.0 + (self.r * q).powi(2);
        let root = (linear * linear - square * constant).max(0.0).sqrt();
        // Of a x² + 2bx + c, without cancellation.
        let far = -linear - linear.signum() * root;
        let real = linear * linear >= square * constant;
        let roots =
            [constant / far, far / square].into_iter().filter(|x| *x > 0.0 && x.is_finite());
        roots.min_by(f64::total_cmp).filter(|_| real).map(|x| x * self.r)
    }
}

/// Where a slope passes zero near x, looked for ever farther out; x where it does not.
fn least_near(slope: impl Fn(f64) -> f64, x: f64, step: f64) -> f64 {
    let brackets = (0..7).map(|n| step * f64::from(1 << n)).map(|far| (x - far, x + far));
    let bracket = brackets.into_iter().find(|(low, high)| slope(*low) * slope(*high) < 0.0);
    bracket.map_or(x, |(low, high)| zero_between(slope, low, high))
}

/// f' by differences of fourth order.
fn difference(scale: f64, x: f64, f: impl Fn(f64) -> f64) -> f64 {
    let h = DIFFERENCE.min(0.1 * scale);
    (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h)
}

/// Between -π and π.
fn wrapped(phase: f64) -> f64 {
    phase - 2.0 * PI * (phase / (2.0 * PI)).round()
}
