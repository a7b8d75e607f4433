//! Footprints of a tip that is not symmetric, one for each direction of motion.
//!
//! A tip that moves forward meets only the surface before it: in the history integral f'(x0(t) - x0(t')) has an argument
//! of one sign, so that only the leading half of f counts. Forward motion is therefore that of the even footprint f(|x|), and
//! backward motion that of f(-|x|). An even fit to the whole profile is the mean of both, and right for neither. The grooves of
//! earlier lines of a raster, and a tip that turns back, depend on both halves.

use super::shape::{bell, value};
use super::{MeasuredTip, Request, TipError, tip};
use crate::Profile;
use crate::least_squares::{Residuals, differences, minimum};
use crate::projection::project;
use stickslip_tip::Gaussian;
use stickslip_tip::sorting::sort_by_number;

/// The footprints of either direction, with the same σ.
#[derive(Debug, Clone, PartialEq)]
pub struct Sides {
    /// The half at positions above the apex: for motion towards larger positions.
    pub forward: MeasuredTip,
    /// The half at positions below the apex: for motion towards smaller positions.
    pub backward: MeasuredTip,
    /// Position of the apex, in the unit of the profile.
    pub apex: f64,
}

/// Fraction of the profile, at either end, that counts as background.
const ENDS: f64 = 0.15;
/// Height relative to the apex above which rows determine its position.
const HIGH: f64 = 0.5;
/// Fewest intervals between rows for a fit of the apex, and the step of its parameters.
const FEWEST: usize = 8;
const STEP: f64 = 1e-6;
/// Width of the Gaussians of [`Sides::footprint`] over that of the narrowest Gaussian of the halves.
const NARROWED: f64 = 0.5;
/// Width of these Gaussians over their spacing.
const WIDTH_PER_SPACING: f64 = 1.2;
/// Distance beyond which a Gaussian is negligible, in widths.
const WIDTHS: f64 = 5.0;
/// Largest number of these Gaussians on either side.
const MOST_POINTS: f64 = 300.0;
/// Weight of the rows that fix f(0) and f'(0).
const APEX: f64 = 1e3;
/// Steps of Newton's method.
const NEWTON: usize = 4;

/// Fits both halves of a profile, each as an even footprint about the apex.
///
/// The background is a line through both ends of the profile. The apex is the given centre, or that of a Gaussian with two widths
/// through the rows above half of its height. Every row counts once: the rows of a half are taken alternately at positive and
/// negative distance, so that the offset of the half is determined too. σ is the mean of both widths unless it is given.
///
/// # Errors
/// As [`tip`], for either half.
pub fn sides(profile: &Profile, request: &Request) -> Result<Sides, TipError> {
    let height = above_ground(profile);
    let apex = request.centre.or_else(|| position(profile.x(), &height)).ok_or_else(nothing)?;
    let half = |sign: f64| half(profile.x(), &height, apex, sign);
    let (before, behind) = (half(1.0).ok_or_else(nothing)?, half(-1.0).ok_or_else(nothing)?);
    let centred = Request { centre: Some(0.0), ..*request };
    let sigma = match request.sigma {
        Some(sigma) => sigma,
        None => {
            let quick = Request { resamples: 0, ..centred };
            0.5 * (tip(&before, &quick)?.sigma.value + tip(&behind, &quick)?.sigma.value)
        }
    };
    let known = Request { sigma: Some(sigma), ..centred };
    Ok(Sides { forward: tip(&before, &known)?, backward: tip(&behind, &known)?, apex })
}

fn nothing() -> TipError {
    TipError::Nothing { residual: 0.0, variation: 0.0 }
}

impl Sides {
    /// The difference of the thresholds of both directions, relative to their mean. A fit that is even in x hides it.
    pub fn asymmetry(&self) -> f64 {
        let [forward, backward] = [&self.forward, &self.backward].map(|t| t.critical_alpha.value);
        2.0 * (forward - backward) / (forward + backward)
    }

    /// One smooth function with f(0) = 1 and f'(0) = 0 that has the forward half at x > 0 and the backward half at x < 0, x in
    /// σ: Gaussians on a lattice, half as wide as the narrowest of both halves. `None` if it cannot be determined.
    ///
    /// The halves meet with different curvatures, which no smooth function has. For Gaussian sides whose widths differ by a
    /// factor of 1.6 the halves of the function have the thresholds of the sides within 5e-4.
    pub fn footprint(&self) -> Option<Vec<Gaussian>> {
        let halves = [&self.forward.gaussians, &self.backward.gaussians];
        let all = || halves.into_iter().flatten();
        let narrowest = all().map(|g| g.width).fold(f64::INFINITY, f64::min);
        let width = NARROWED * narrowest;
        let reach = all().map(|g| g.center.abs() + WIDTHS * g.width).fold(0.0, f64::max);
        let spacing = width / WIDTH_PER_SPACING;
        let count = (reach / spacing).ceil();
        if count > MOST_POINTS {
            return None;
        }
        let term = |i: i32| Gaussian { amplitude: 1.0, center: f64::from(i) * spacing, width };
        let count = count as i32;
        let mut terms: Vec<Gaussian> = (-count..=count).map(term).collect();
        let rows: Vec<f64> =
            (-4 * count..=4 * count).map(|i| 0.25 * f64::from(i) * spacing).collect();
        let wanted = rows.iter().map(|x| value(halves[usize::from(*x < 0.0)], *x));
        // The last rows hold the apex in its place.
        let wanted: Vec<f64> = wanted.chain([APEX * value(halves[0], 0.0), 0.0]).collect();
        let column = |g: &Gaussian| {
            let each = rows.iter().map(|x| bell(g, *x));
            each.chain([APEX * bell(g, 0.0), APEX * slope(g, 0.0)]).collect()
        };
        let columns: Vec<Vec<f64>> = terms.iter().map(column).collect();
        let fitted = project(&columns, &wanted)?;
        terms.iter_mut().zip(&fitted.coefficients).for_each(|(g, c)| g.amplitude = *c);
        // What is left of f'(0), by a step of Newton's method or some.
        for _ in 0..NEWTON {
            let sum = |of: fn(&Gaussian, f64) -> f64| terms.iter().map(|g| of(g, 0.0)).sum::<f64>();
            let away = -sum(slope) / sum(curvature);
            terms.iter_mut().for_each(|g| g.center -= away);
        }
        let top = value(&terms, 0.0);
        terms.iter_mut().for_each(|g| g.amplitude /= top);
        Some(terms)
    }

    /// Warnings about the result.
    pub fn remarks(&self) -> Vec<String> {
        let [forward, backward] = [&self.forward, &self.backward];
        let apart = (forward.apex - backward.apex).abs();
        let noise = f64::hypot(forward.residual, backward.residual);
        let mut remarks = vec![];
        if apart > 3.0 * noise {
            remarks.push(format!(
                "the halves have different heights at the apex, {:.3e} and {:.3e}: give the centre, or check the profile",
                forward.apex, backward.apex
            ));
        }
        let named = [("trace", forward), ("retrace", backward)];
        remarks.extend(named.into_iter().flat_map(|(name, half)| {
            half.remarks().into_iter().map(move |remark| format!("{name}: {remark}"))
        }));
        remarks
    }
}

fn slope(g: &Gaussian, x: f64) -> f64 {
    -(x - g.center) / g.width.powi(2) * bell(g, x)
}

fn curvature(g: &Gaussian, x: f64) -> f64 {
    (((x - g.center) / g.width).powi(2) - 1.0) * bell(g, x) / g.width.powi(2)
}

/// Heights above the line through both ends.
fn above_ground(profile: &Profile) -> Vec<f64> {
    let (first, last) = profile.ends();
    let margin = ENDS * (last - first);
    let is_end = |x: f64| x < first + margin || x > last - margin;
    let (x, f): (Vec<f64>, Vec<f64>) =
        profile.x().iter().zip(profile.f()).filter(|(x, _)| is_end(**x)).unzip();
    let line = project(&[vec![1.0; x.len()], x], &f).map_or(vec![0.0; 2], |p| p.coefficients);
    profile.x().iter().zip(profile.f()).map(|(x, f)| f - line[0] - line[1] * x).collect()
}

/// Position of the apex.
fn position(x: &[f64], height: &[f64]) -> Option<f64> {
    let top = (0..x.len()).max_by(|a, b| height[*a].abs().total_cmp(&height[*b].abs()))?;
    let is_high = |i: &usize| height[*i] / height[top] > HIGH;
    // Only those next to it: a lobe may be high too.
    let first = (0..=top).rev().take_while(is_high).last()?;
    let last = (top..x.len()).take_while(is_high).last()?;
    if last - first < FEWEST {
        return Some(x[top]);
    }
    let scale = 0.5 * (x[last] - x[first]);
    let rows = (first..=last).map(|i| ((x[i] - x[top]) / scale, height[i] / height[top])).collect();
    let found = minimum(&TwoWidths { rows }, &[1.0, 0.0, 0.0, 0.0])?;
    Some(x[top] + scale * found.parameters[1])
}

/// A exp(-(x - c)²/(2w²)) with a width for either side; the parameters are A, c, ln w above c and ln w below c.
struct TwoWidths {
    rows: Vec<(f64, f64)>,
}

impl Residuals for TwoWidths {
    fn at(&self, parameters: &[f64]) -> Option<Vec<f64>> {
        let [height, centre, above, below] = *parameters else { return None };
        let off = |(x, f): &(f64, f64)| {
            let away = x - centre;
            let width = if away > 0.0 { above } else { below };
            height * (-0.5 * (away / width.exp()).powi(2)).exp() - f
        };
        Some(self.rows.iter().map(off).collect())
    }

    fn derivatives(&self, here: &[f64], parameters: &[f64]) -> Option<Vec<Vec<f64>>> {
        differences(self, (here, parameters), STEP)
    }
}

/// The rows on one side of the apex, alternately on either side of 0.
fn half(x: &[f64], height: &[f64], apex: f64, sign: f64) -> Option<Profile> {
    let rows = x.iter().zip(height).map(|(x, f)| (sign * (x - apex), *f));
    let mut rows: Vec<(f64, f64)> = rows.filter(|(x, _)| *x >= 0.0).collect();
    sort_by_number(&mut rows, |item| item.0);
    let sided = rows.into_iter().enumerate();
    let (x, f) = sided.map(|(i, (x, f))| (if i % 2 == 0 { x } else { -x }, f)).unzip();
    Profile::new(x, f).ok()
}
