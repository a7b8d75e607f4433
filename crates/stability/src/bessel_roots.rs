//! Roots for f = J0: (44), squared to a quartic, without the roots of the other branch of the square root.
//!
//! With s = √(Λ²+1), κ = α/r: p(Λ) = s((r - κ)Λ + 1) + κΛ² = 0, (45). Squared, and divided by Λ⁴
//! (Λ = 0 is no root), μ = 1/Λ solves μ⁴ + 2aμ³ + (1+a²)μ² + 2aμ + a² - κ² = 0, a = r - κ.

use super::StabilityError;
use super::certificate::{Certificate, Region, Spectrum, with_conjugates};
use super::newton::{polish, simultaneous};
use super::one_sided::bessel_root;
use super::transform::Scaled;
use super::winding::{argument_along, whole};
use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::Model;

const I: Complex64 = Complex64::I;

#[derive(Debug, Clone, Copy)]
struct Branch {
    r: f64,
    kappa: f64,
}

/// The roots right of `bound`; all of them if it is `None`.
pub(super) fn spectrum(model: &Model, bound: Option<f64>) -> Result<Spectrum, StabilityError> {
    let branch = Branch::new(model);
    let all = branch.upper_roots();
    let leftmost = all.iter().map(|z| z.re).fold(0.0, f64::min);
    let left = bound.map_or(1.3 * leftmost - 0.5, |bound| bound / model.r());
    let (region, counted, left) = branch.counted(left)?;
    let inside: Vec<Complex64> = all.into_iter().filter(|z| z.re >= left).collect();
    let roots = with_conjugates(&inside, model.r());
    let certificate = branch.certificate(region, counted, &roots);
    let found = certificate.found;
    if found == counted {
        Ok(Spectrum { roots, certificate })
    } else {
        Err(StabilityError::RootsMissing { counted, found })
    }
}

pub(super) fn certify(
    model: &Model,
    bound: f64,
    roots: &[Complex64],
) -> Result<Certificate, StabilityError> {
    let branch = Branch::new(model);
    let (region, counted, _) = branch.counted(bound / model.r())?;
    Ok(branch.certificate(region, counted, roots))
}

impl Branch {
    fn new(model: &Model) -> Self {
        Self { r: model.r(), kappa: model.alpha() / model.r() }
    }

    /// p and p'.
    fn at(&self, lambda: Complex64) -> Scaled {
        let s = bessel_root(lambda);
        let linear = lambda * (self.r - self.kappa) + 1.0;
        Scaled {
            value: s * linear + lambda * lambda * self.kappa,
            derivative: lambda / s * linear
                + s * (self.r - self.kappa)
                + lambda * (2.0 * self.kappa),
            log_scale: 0.0,
        }
    }

    /// p on the upper (`side` 1) or lower (-1) lip of the cut, at Λ = i - t², and its derivative with
    /// respect to t, which has no singularity.
    fn beside_cut(&self, t: f64, side: f64) -> Scaled {
        let lambda = I - t * t;
        let far = (lambda + I).sqrt();
        let s = far * I * (side * t);
        let s_slope = I * side * (far - t * t / far);
        let linear = lambda * (self.r - self.kappa) + 1.0;
        let lambda_slope = -2.0 * t;
        Scaled {
            value: s * linear + lambda * lambda * self.kappa,
            derivative: s_slope * linear
                + (s * (self.r - self.kappa) + lambda * (2.0 * self.kappa)) * lambda_slope,
            log_scale: 0.0,
        }
    }

    /// Sum of the sizes of the terms of p.
    fn size(&self, lambda: Complex64) -> f64 {
        let s = bessel_root(lambda).norm();
        let linear = (self.r + self.kappa) * lambda.norm() + 1.0;
        (s * linear + self.kappa * lambda.norm_sqr()).max(f64::MIN_POSITIVE)
    }

    /// |p| relative to its terms or, if smaller, the size of Newton's step relative to Λ: close to a branch point no
    /// floating-point Λ makes p small.
    fn residual(&self, lambda: Complex64) -> f64 {
        let p = self.at(lambda);
        let step = p.value.norm() / (p.derivative.norm() * lambda.norm());
        (p.value.norm() / self.size(lambda)).min(if step.is_finite() { step } else { 1.0 })
    }

    /// Roots on this sheet with Im Λ ≥ 0.
    fn upper_roots(&self) -> Vec<Complex64> {
        if self.kappa <= 0.0 {
            return vec![Complex64::new(-1.0 / self.r, 0.0)];
        }
        let mut roots: Vec<Complex64> = Vec::new();
        for mu in quartic(self.r - self.kappa, self.kappa) {
            let raw = mu.inv();
            if !raw.is_finite() || raw.norm() > 1e12 * (1.0 + 1.0 / self.r) {
                continue;
            }
            let is_real = raw.im.abs() < 1e-6 * raw.norm();
            let start = if is_real { Complex64::new(raw.re, 0.0) } else { raw };
            let mut z = polish(|z| self.at(z), start);
            if is_real && z.im.abs() < 1e-9 * z.norm() {
                z.im = 0.0;
            }
            z.im = z.im.abs();
            let is_close = (z - Complex64::new(raw.re, raw.im.abs())).norm() < 1e-3 * raw.norm();
            let is_new = roots.iter().all(|k| (k - z).norm() > 1e-9 * z.norm());
            if is_close && is_new && self.residual(z) < 1e-11 {
                roots.push(z);
            }
        }
        roots
    }

    /// Number of roots right of `left` by the argument principle on the upper half of the cut plane.
    fn counted(&self, left: f64) -> Result<(Region, usize, f64), StabilityError> {
        let shift = |n: i32| 1e-6 * (4.0_f64.powi(n) - 1.0);
        let counted = (0..8).find_map(|n| self.counted_at(left - shift(n)).ok());
        counted.ok_or(StabilityError::RootOnContour { re: left * self.r })
    }

    fn counted_at(&self, left: f64) -> Result<(Region, usize, f64), StabilityError> {
        if self.kappa <= 0.0 {
            let (right, top) = ((left + 1.0).max(0.0), 1.0);
            let region =
                Region { re_min: self.r * left, re_max: self.r * right, im_max: self.r * top };
            return Ok((region, usize::from(-1.0 / self.r >= left), left));
        }
        // |G| ≤ 1/|Λ| for |Λ| ≥ 2 off the strip between the cuts, so h ≠ 0 beyond these.
        let far = 2.0 + 2.0 / self.r + 2.0 * (self.kappa / self.r).sqrt();
        let right = far.max(left + 1.0);
        let corner = |re: f64, im: f64| Complex64::new(re, im);
        let mut turned = argument_along(|z| self.at(z), &[corner(right, 0.0), corner(right, far)])?;
        turned += argument_along(|z| self.at(z), &[corner(right, far), corner(left, far)])?;
        if left < 0.0 {
            let length = corner((-left).sqrt(), 0.0);
            let above = [corner(left, far), corner(left, 1.0 + 1e-14)];
            let below = [corner(left, 1.0 - 1e-14), corner(left, 0.0)];
            turned += argument_along(|z| self.at(z), &above)?;
            turned += argument_along(|t| self.beside_cut(t.re, 1.0), &[length, Complex64::ZERO])?;
            turned += argument_along(|t| self.beside_cut(t.re, -1.0), &[Complex64::ZERO, length])?;
            turned += argument_along(|z| self.at(z), &below)?;
        } else {
            turned += argument_along(|z| self.at(z), &[corner(left, far), corner(left, 0.0)])?;
        }
        let on_contour = StabilityError::RootOnContour { re: left * self.r };
        let count = whole(turned, PI).ok_or(on_contour)?;
        let region = Region { re_min: self.r * left, re_max: self.r * right, im_max: self.r * far };
        Ok((region, count, left))
    }

    fn certificate(&self, region: Region, counted: usize, roots: &[Complex64]) -> Certificate {
        let inside: Vec<Complex64> =
            roots.iter().filter(|z| region.contains(**z)).map(|z| z / self.r).collect();
        let is_first =
            |i: usize, z: Complex64| inside[..i].iter().all(|k| (k - z).norm() > 1e-9 * z.norm());
        let found = inside
            .iter()
            .enumerate()
            .filter(|(i, z)| self.residual(**z) < 1e-9 && is_first(*i, **z))
            .count();
        let error = |z: &Complex64| {
            let p = self.at(*z);
            (p.value.norm() + 4.0 * f64::EPSILON * self.size(*z)) / p.derivative.norm()
        };
        Certificate {
            region,
            counted,
            found,
            largest_residual: inside.iter().map(|z| self.residual(*z)).fold(0.0, f64::max),
            largest_error: self.r * inside.iter().map(error).fold(0.0, f64::max),
        }
    }
}

/// The four μ, by simultaneous iteration (Durand and Kerner).
fn quartic(a: f64, kappa: f64) -> [Complex64; 4] {
    simultaneous([2.0 * a, 1.0 + a * a, 2.0 * a, (a - kappa) * (a + kappa)])
}
