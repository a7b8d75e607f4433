//! Linear theory of one-way rasters under the wider law: a depth limit (61), healing, inertia.
//!
//! Line n deviates by A_n e^{iωt} from even motion, ω = qr, and its weight w0(1 + B_n e^{iωt}). With a = αw0, s = 1/(rT),
//! p = s + iq, what is left of a groove after a line c = e^{-X/(rT)}, one-sided transforms φ, φ1, G of f, f', f''
//! ([`transforms`](super::super::wider)) and ĝ_l(p) = ∫ g_l e^{-px}dx over all x, small deviations obey
//!
//! ```text
//!     P (A_n, B_n) = (a/r) u Σ_j Σ_l c^j h_l(jd) ĝ_l(p) v·(A_{n-j}, B_{n-j}),    u = (p, β),   v = (-p, 1)
//!
//!     P = | 1 + irq - Mr²q² - (a/r)(G(s) - G(p) + s²E)    -(a/r) φ1(p)     |
//!         | -(aβ/r)(φ1(s) - φ1(p) + sE)                    1 - (aβ/r) φ(p) |
//! ```
//!
//! with E = Σ_j Σ_l c^j h_l(jd) ĝ_l(s) of the even grooves beside, u0 = -(a/r)(φ(s) + E) the height under the tip, w0 =
//! e^{-|u0|/b}, and β = ±1/b as u0 is above 0 or below. v·(A, B) is what deviates of the density that a line leaves, one
//! number a line as by the paper's law: growth is that of a recurrence, and the threshold asks that a complex quadratic in a
//! have a real root. α = a e^{|u0|/b} rises with a.

use super::{Raster, RasterCritical, RasterPath, SAMPLES, difference, least_near, wrapped};
use crate::StabilityError;
use crate::wider::PlainTransforms;
use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::roots::zero_between;
use stickslip_tip::{Footprint, TipFunction, Wider};

/// Lines that pass over each other's grooves under the wider law, one way.
#[derive(Debug, Clone)]
pub struct WiderRaster {
    /// Its heights h(jd) are times c^j.
    raster: Raster,
    transforms: PlainTransforms,
    mass: f64,
    /// s
    fading: f64,
    /// u0 = -a times this.
    depth: f64,
    /// E
    beside: f64,
    depth_limit: Option<f64>,
    /// β
    steepness: f64,
}

/// c0 + c1 a + c2 a², which is 0 where a ripple neither grows nor fades.
type Quadratic = [Complex64; 3];

/// What one q says, whatever the phase.
struct At {
    q: f64,
    /// det P
    own: Quadratic,
    /// v·adj(P)u/r, of which the last is 0.
    felt: Quadratic,
    /// ĝ_l(p)
    layers: Vec<Complex64>,
}

/// What is refined lies this near to where it was seen, as a part of it.
const SAME: f64 = 0.3;
/// An a so small carves nothing.
const LEAST: f64 = 1e-9;
/// A height under the tip below this part of those that cancel in it is 0.
const LEVEL: f64 = 1e-9;

impl WiderRaster {
    /// Lines a pitch d apart, dragged at r, of whose grooves so much is left after a line as `left` says: e^{-X/(rT)},
    /// 1 where nothing heals.
    ///
    /// # Errors
    /// As [`Raster::new`]; no spring; J0 and cos x; the height under the tip is 0, where |h| has its corner.
    pub fn new(
        footprint: &Footprint,
        law: Wider,
        (r, pitch): (f64, f64),
        left: f64,
    ) -> Result<Self, StabilityError> {
        let is_gaussians = |tip: &TipFunction| matches!(tip, TipFunction::Gaussians(_));
        if !law.spring {
            return Err(StabilityError::NoSupport);
        }
        if !footprint.layers().iter().all(|layer| is_gaussians(&layer.along)) {
            return Err(StabilityError::PapersLawOnly(
                "a raster of a tip that is no sum of Gaussians",
            ));
        }
        let mut raster = Raster::new(footprint, r, pitch)?;
        for heights in &mut raster.heights {
            let mut kept = 1.0;
            for height in heights.iter_mut() {
                kept *= left;
                *height *= kept;
            }
        }
        let fading = law.healing_time.map_or(0.0, |time| 1.0 / (r * time));
        let transforms = PlainTransforms::new(footprint.path());
        let layers = footprint.layers().iter().zip(&raster.heights);
        let each = layers.map(|(layer, heights)| {
            two_sided(&layer.along, fading.into()).re * heights.iter().sum::<f64>()
        });
        let beside: f64 = each.sum();
        let own = transforms.at(fading.into()).height.re;
        let depth = (own + beside) / r;
        let limit = law.depth_limit;
        if limit.is_some() && (own + beside).abs() <= LEVEL * footprint.path().value(0.0).abs() {
            return Err(StabilityError::Corner);
        }
        let steepness = limit.map_or(0.0, |limit| -depth.signum() / limit);
        let mass = law.inertia.unwrap_or(0.0);
        Ok(Self { raster, transforms, mass, fading, depth, beside, depth_limit: limit, steepness })
    }

    /// The first ripple that does not fade from line to line.
    ///
    /// # Errors
    /// No ripple grows, however large α.
    pub fn critical(&self) -> Result<RasterCritical, StabilityError> {
        let none = StabilityError::NoCrossing { r: self.raster.r };
        let (a, q, phase) = self.first().ok_or(none)?;
        if !self.alpha(a).is_finite() {
            return Err(none);
        }
        Ok(self.raster.threshold(RasterPath::OneWay, self.alpha(a), q, phase))
    }

    /// The growth from line to line, as [`Raster::growth`].
    #[must_use]
    pub fn growth(&self, alpha: f64, q: f64) -> Complex64 {
        super::growth::settled(&self.answers(alpha, q))
    }

    /// c_j, j = 1, 2, …: what deviates of the density that a line leaves is Σ c_j of what deviated of that j lines before.
    #[must_use]
    pub fn answers(&self, alpha: f64, q: f64) -> Vec<Complex64> {
        let a = self.density(alpha);
        let at = self.at(q);
        let factor = value(&at.felt, a) * a / value(&at.own, a);
        let most = self.raster.heights.iter().map(Vec::len).max().unwrap_or(0);
        let answer = |j: usize| {
            let heights = self.raster.heights.iter().zip(&at.layers);
            let each = heights.map(|(heights, g)| heights.get(j).map_or(0.0.into(), |h| g * h));
            factor * each.sum::<Complex64>()
        };
        (0..most).map(answer).collect()
    }

    /// α of a.
    fn alpha(&self, a: f64) -> f64 {
        self.depth_limit.map_or(a, |limit| a * (a * self.depth.abs() / limit).exp())
    }

    /// a of α.
    fn density(&self, alpha: f64) -> f64 {
        if self.depth_limit.is_none() {
            return alpha;
        }
        zero_between(|a| self.alpha(a) - alpha, 0.0, alpha)
    }

    fn at(&self, q: f64) -> At {
        let (r, s) = (self.raster.r, self.fading);
        let p = Complex64::new(s, q);
        let (even, here) = (self.transforms.at(s.into()), self.transforms.at(p));
        let (beta, beside) = (self.steepness, self.beside);
        let m = Complex64::new(1.0 - self.mass * (r * q).powi(2), r * q);
        let k = [
            (even.curvature - here.curvature + s * s * beside) / r,
            here.slope / r,
            (even.slope - here.slope + s * beside) * beta / r,
            here.height * beta / r,
        ];
        let own = [1.0.into(), -(m * k[3] + k[0]), k[0] * k[3] - k[1] * k[2]];
        let own = [m * own[0], own[1], own[2]];
        let felt = [m * beta - p * p, p * p * k[3] - p * beta * k[1] + p * k[2] - k[0] * beta];
        let felt = [felt[0] / r, felt[1] / r, 0.0.into()];
        let layers = self.raster.footprint.layers().iter();
        At { q, own, felt, layers: layers.map(|layer| two_sided(&layer.along, p)).collect() }
    }

    /// The a at which a ripple of this q and phase neither grows nor fades: two, or one, any complex numbers.
    fn roots(&self, at: &At, phased: &[[Complex64; 2]]) -> [Option<Complex64>; 2] {
        let sums = at.layers.iter().zip(phased).map(|(g, [odd, even])| g * (odd + even));
        let lines: Complex64 = sums.sum();
        let constant = at.own[0];
        let half = 0.5 * (at.own[1] - lines * at.felt[0]);
        let square = at.own[2] - lines * at.felt[1];
        let root = (half * half - square * constant).sqrt();
        // Of a x² + 2bx + c, without cancellation.
        let far = if (half.conj() * root).re >= 0.0 { -half - root } else { -half + root };
        let finite = |x: Complex64| Some(x).filter(|x| x.is_finite());
        [finite(constant / far), finite(far / square)]
    }

    /// a, q and φ of the first crossing.
    fn first(&self) -> Option<(f64, f64, f64)> {
        let q = self.raster.wave_numbers();
        let spacing = q[1] - q[0];
        let farthest = PI.min(self.raster.footprint.path().band() * self.raster.pitch);
        let step = farthest / f64::from(SAMPLES);
        let mut seen = self.crossings(&q, step);
        seen.sort_by(|one, other| one.0.total_cmp(&other.0));
        let refined = |(a, q, phase): &(f64, f64, f64)| {
            let crossing = |phase: f64| self.crossing(phase, (*a, *q), spacing);
            // Roots that pass each other between samples seem to cross where none does.
            crossing(*phase).filter(|found| (found.0 / a - 1.0).abs() < SAME)?;
            let slope = |phase: f64| {
                difference(step, phase, |phase| crossing(phase).map_or(f64::NAN, |c| c.0))
            };
            let phase = least_near(slope, *phase, step);
            let found = crossing(phase).map(|(a, q)| (a, q, wrapped(phase)));
            found.filter(|found| (found.0 / a - 1.0).abs() < SAME)
        };
        seen.iter().find_map(refined)
    }

    /// Where the roots between samples of q become real, at every phase.
    fn crossings(&self, q: &[f64], step: f64) -> Vec<(f64, f64, f64)> {
        let at: Vec<At> = q.iter().map(|q| self.at(*q)).collect();
        let mut seen = vec![];
        for i in -SAMPLES.cast_signed()..=SAMPLES.cast_signed() {
            let phase = step * f64::from(i);
            let phased = self.raster.phased(phase);
            let roots: Vec<_> = at.iter().map(|at| self.roots(at, &phased)).collect();
            for (n, pair) in roots.windows(2).enumerate() {
                for before in pair[0].iter().flatten() {
                    let Some(here) = nearest(&pair[1], *before) else { continue };
                    let share = before.im / (before.im - here.im);
                    let a = before.re + share * (here.re - before.re);
                    if before.im * here.im < 0.0 && before.re > LEAST && here.re > LEAST {
                        seen.push((a, at[n].q + share * (q[1] - q[0]), phase));
                    }
                }
            }
        }
        seen
    }

    /// a and q near those given, at a phase.
    fn crossing(&self, phase: f64, (a, q): (f64, f64), spacing: f64) -> Option<(f64, f64)> {
        let phased = self.raster.phased(phase);
        let at = |q: f64| nearest(&self.roots(&self.at(q), &phased), a.into());
        let sign = |q: f64| at(q).map_or(f64::NAN, |a| a.im);
        let ends =
            (1..=8).map(|n| spacing * f64::from(n)).map(|far| ((q - far).max(0.5 * q), q + far));
        let (low, high) = ends.into_iter().find(|(low, high)| sign(*low) * sign(*high) < 0.0)?;
        let q = zero_between(sign, low, high);
        at(q).map(|a| (a.re, q))
    }
}

fn value(quadratic: &Quadratic, a: f64) -> Complex64 {
    quadratic[0] + (quadratic[1] + quadratic[2] * a) * a
}

fn nearest(roots: &[Option<Complex64>; 2], to: Complex64) -> Option<Complex64> {
    let off = |a: &Complex64| (a - to).norm();
    roots.iter().flatten().copied().min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// ∫ g e^{-px}dx over all x.
fn two_sided(tip: &TipFunction, p: Complex64) -> Complex64 {
    let TipFunction::Gaussians(sum) = tip else { return Complex64::ZERO };
    let term = |g: &stickslip_tip::Gaussian| {
        let area = g.amplitude * g.width * (2.0 * PI).sqrt();
        (0.5 * p * p * g.width * g.width - p * g.center).exp() * area
    };
    sum.terms().iter().map(term).sum()
}
