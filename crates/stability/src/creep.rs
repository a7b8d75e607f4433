//! Trapping: all rates p at which a tip that its own groove holds may creep, x0 ~ (1/p) ln t, and the threshold of it. The
//! rates are the roots of 1 + (α/r) G(p) = 0 with a positive real part, α/r = 1/Q(p) with Q = -G.
//!
//! If the tip hardly moves, the time θ(x) at which it reaches x obeys a linear equation with the solutions Σ C e^{px}
//! over these roots (`docs/explanation/trapping.md`). The root of largest real part dominates. If it is real, the
//! tip is held permanently; if it is one of a complex pair, θ reaches a maximum, so that every stick ends in a slip.

use super::StabilityError;
use super::certificate::{Certificate, Region, Spectrum, with_conjugates};
use super::characteristic::Characteristic;
use super::half_plane::HalfPlane;
use super::law::Law;
use super::newton::simultaneous;
use super::one_sided::OneSided;
use num_complex::Complex64;
use stickslip_tip::roots::bisected;
use stickslip_tip::{Model, TipFunction};

/// The creep that the equations allow at given α and r.
#[derive(Debug, Clone, PartialEq)]
pub struct Creep {
    /// All p with a positive real part, in 1/σ, by falling real part, both of each conjugate pair.
    pub roots: Vec<Complex64>,
    /// dQ/dp at each root, where Q(p) = -G(p).
    pub slopes: Vec<Complex64>,
    /// Certificate that no root is missing.
    pub certificate: Certificate,
}

impl Creep {
    /// The real roots p, ascending: for each of them x0 ~ (1/p) ln t solves (10) at large t.
    pub fn rates(&self) -> Vec<f64> {
        self.roots.iter().rev().filter(|p| p.im.abs() <= 0.0).map(|p| p.re).collect()
    }

    /// The attracting rate: the root of largest real part, if it is real. If it is not, no tip is trapped
    /// permanently.
    pub fn attracting(&self) -> Option<f64> {
        self.roots.first().filter(|p| p.im.abs() <= 0.0).map(|p| p.re)
    }
}

/// All rates of creep at the α and r of the model, found and counted as [`super::roots`] are.
///
/// # Errors
/// As [`super::roots`]; an extended model.
pub fn creep(model: &Model) -> Result<Creep, StabilityError> {
    if !model.wider().is_basic() || *model.tip() == TipFunction::Cosine {
        return Err(StabilityError::PapersLawOnly("the creep of a trapped tip"));
    }
    let Spectrum { roots, certificate } = if model.alpha() <= 0.0 {
        Spectrum::none()
    } else if *model.tip() == TipFunction::Bessel {
        bessel(model.alpha() / model.r())
    } else {
        let h = Characteristic::of(Law::of_creep(model));
        HalfPlane::counted(&h, 0.0)?.spectrum(&h)?
    };
    let roots: Vec<Complex64> = roots.into_iter().filter(|p| p.re > 0.0).collect();
    let footprint = OneSided::new(model.tip());
    let slopes = roots.iter().map(|p| -footprint.plain(*p).curvature.1).collect();
    Ok(Creep { roots, slopes, certificate })
}

/// Roots for f = J0, κ = α/r: G = -p/(s(s+p)) with s = √(p²+1), so that s(s + p) = κp. With s = κ(1 + κ/z) this is
/// p = -(z + κ)²/z and z³ + 4κz² + (5κ²+1)z + 2κ³ = 0. Roots with Re s < 0 are on the other sheet. If κ is small, a pair lies
/// as close as κ³ to the imaginary axis and as κ² to the branch points ±i, where the cubic in p does not resolve it.
fn bessel(kappa: f64) -> Spectrum {
    let real = |z: Complex64| if z.im.abs() < 1e-9 * z.norm() { z.re.into() } else { z };
    let mut upper: Vec<(Complex64, Complex64)> = vec![];
    for z in simultaneous([4.0 * kappa, 5.0 * kappa * kappa + 1.0, 2.0 * kappa.powi(3)]).map(real) {
        let u = kappa / z + 1.0;
        let (mut p, s) = (-u * u * z, u * kappa);
        if p.im.abs() > 0.0 {
            // p² = s² - 1, without the difference of nearly equal numbers in the real part.
            p.re = s.re * s.im / p.im;
        }
        let is_new = upper.iter().all(|(known, _)| (known - p).norm() > 1e-9 * p.norm());
        if p.im >= 0.0 && p.re > 0.0 && s.re > 0.0 && is_new {
            upper.push((p, s));
        }
    }
    let largest =
        |f: &dyn Fn(&(Complex64, Complex64)) -> f64| upper.iter().map(f).fold(0.0, f64::max);
    let residual = |(p, s): &(Complex64, Complex64)| (1.0 - p * kappa / (s * (s + p))).norm() / 2.0;
    // Where two roots meet, the slope of the equation vanishes.
    let error = |(p, s): &(Complex64, Complex64)| {
        let slope = (p * (p * p + 2.0) / (s * s * s) - 1.0) * kappa;
        4.0 * f64::EPSILON * p.norm().max(2.0 / slope.norm())
    };
    let far = 2.0 + 2.0 * kappa;
    let roots = with_conjugates(&upper.iter().map(|(p, _)| *p).collect::<Vec<_>>(), 1.0);
    let certificate = Certificate {
        region: Region { re_min: 0.0, re_max: far, im_max: far },
        counted: roots.len(),
        found: roots.len(),
        largest_residual: largest(&residual),
        largest_error: largest(&error),
    };
    Spectrum { roots, certificate }
}

/// Number of samples of ln p in the search for the largest Q.
const SAMPLES: u32 = 400;

/// Trapping threshold r/max_p Q(p), Q(p) = p ∫_0^∞ e^{-ps}(-f'(s))ds: the smallest α with a creep x0 ~ (1/p) ln t. For a
/// footprint with several peaks this creep need not be attracting: see [`Creep::attracting`].
///
/// # Errors
/// `r` is not a positive finite number, or Q is nowhere positive.
pub fn trapping_alpha(tip: &TipFunction, r: f64) -> Result<f64, StabilityError> {
    StabilityError::unless_positive(r)?;
    let (_, largest) = Push::new(tip).largest().ok_or(StabilityError::NoTrapping)?;
    Ok(r / largest)
}

struct Push {
    footprint: OneSided,
    slowest: f64,
    fastest: f64,
}

impl Push {
    fn new(tip: &TipFunction) -> Self {
        let reach = tip.reach().unwrap_or(10.0);
        Self { footprint: OneSided::new(tip), slowest: 1e-2 / reach, fastest: 10.0 * tip.band() }
    }

    /// Q and Q'.
    fn q(&self, p: f64) -> (f64, f64) {
        let (g, slope) = self.footprint.plain(Complex64::new(p, 0.0)).curvature;
        (-g.re, -slope.re)
    }

    /// p and Q at the highest maximum of Q, if that is positive.
    fn largest(&self) -> Option<(f64, f64)> {
        let ratio = (self.fastest / self.slowest).powf(1.0 / f64::from(SAMPLES));
        let sample = |i: u32| self.slowest * ratio.powi(i.cast_signed());
        let samples = (0..=SAMPLES).map(sample).map(|p| (p, self.q(p).0));
        let (highest, _) = samples.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let rises = |p: f64| self.q(p).1 > 0.0;
        let is_narrow = |(low, high): (f64, f64)| high - low <= 4.0 * f64::EPSILON * high;
        let (p, _) = bisected((highest / ratio, highest * ratio), rises, is_narrow);
        let q = self.q(p).0;
        (q > 0.0).then_some((p, q))
    }
}
