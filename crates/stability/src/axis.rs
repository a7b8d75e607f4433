//! The imaginary axis Λ = iΩ, on which (42) and (43) hold.
//!
//! With c(Ω) = -∫f'' cos = Ω² f̂(Ω)/2 and s(Ω) = (1/Ω)∫f'' sin, (42) is r = s/c and (43) is αc = r/c.

use super::kept::Kept;
use super::transform::CurvatureTransform;
use num_complex::Complex64;
use std::f64::consts::PI;
use std::sync::Arc;
use stickslip_tip::roots::zero_between;
use stickslip_tip::{TipFunction, stop};

/// Number of samples per period of the fastest oscillation that the reach of the tip allows.
const SAMPLES_PER_PERIOD: f64 = 8.0;
const MOST_SAMPLES: f64 = 2e5;
/// For a footprint given as a table, values of c below this fraction of the largest one are round-off.
const ROUNDOFF: f64 = 1e-12;
/// Number of successive samples of round-off after which the scan of a table ends.
const FADED_SPAN: usize = 64;

/// c and s at one Ω, with their derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisPoint {
    pub(super) wave_number: f64,
    pub(super) cosine: f64,
    pub(super) sine: f64,
    cosine_slope: f64,
    sine_slope: f64,
}

impl AxisPoint {
    /// r c - s, which vanishes where (42) holds, and its derivative.
    fn mismatch(&self, r: f64) -> (f64, f64) {
        (r * self.cosine - self.sine, r * self.cosine_slope - self.sine_slope)
    }

    /// α c² - s, which vanishes where (43) holds for given α, and its derivative.
    fn alpha_mismatch(&self, alpha: f64) -> (f64, f64) {
        (
            alpha * self.cosine * self.cosine - self.sine,
            2.0 * alpha * self.cosine * self.cosine_slope - self.sine_slope,
        )
    }
}

/// c and s, sampled so densely that no crossing lies unseen between two samples.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    tip: TipFunction,
    transform: CurvatureTransform,
    samples: Vec<AxisPoint>,
    /// c below this is round-off.
    least: f64,
}

impl Axis {
    /// The scan for this footprint, from the cache if it is recent.
    pub(super) fn of(tip: &TipFunction) -> Arc<Self> {
        static KEPT: Kept<Axis> = Kept::new();
        KEPT.of(tip, || Self::new(tip))
    }

    fn new(tip: &TipFunction) -> Self {
        let transform = CurvatureTransform::new(tip);
        let reach = tip.reach().unwrap_or(1.0);
        let step = (2.0 * PI / (SAMPLES_PER_PERIOD * reach)).max(tip.band() / MOST_SAMPLES);
        let roundoff = if transform.is_closed_form() { 0.0 } else { ROUNDOFF };
        let mut axis = Self { tip: tip.clone(), transform, samples: Vec::new(), least: 0.0 };
        let (mut largest, mut faded, mut wave_number) = (0.0_f64, 0, 0.0);
        while wave_number < tip.band() && faded < FADED_SPAN && !stop::is_requested() {
            wave_number += step;
            let point = axis.at(wave_number);
            largest = largest.max(point.cosine.abs());
            axis.least = roundoff * largest;
            faded = if point.cosine.abs() < axis.least { faded + 1 } else { 0 };
            axis.samples.push(point);
        }
        axis
    }

    /// c and s at Ω > 0.
    pub(super) fn at(&self, wave_number: f64) -> AxisPoint {
        let g = self.transform.at(Complex64::new(0.0, wave_number));
        let sine = -g.value.im / wave_number;
        let cosine = if self.transform.is_closed_form() && self.tip.is_even() {
            0.5 * wave_number * wave_number * self.tip.fourier(wave_number)
        } else {
            -g.value.re
        };
        AxisPoint {
            wave_number,
            cosine,
            sine,
            cosine_slope: g.derivative.im,
            sine_slope: -(g.derivative.re + sine) / wave_number,
        }
    }

    /// Every Ω with c > 0 at which (42) gives this r, ascending.
    pub(super) fn crossings_of_r(&self, r: f64) -> Vec<AxisPoint> {
        self.zeros(|p| p.mismatch(r))
    }

    /// Every Ω with c > 0 at which (43) gives this α, ascending.
    pub(super) fn crossings_of_alpha(&self, alpha: f64) -> Vec<AxisPoint> {
        self.zeros(|p| p.alpha_mismatch(alpha))
    }

    /// Zeros of g between samples: by sign changes of g, and of g' where a pair may hide.
    fn zeros(&self, g: impl Fn(&AxisPoint) -> (f64, f64)) -> Vec<AxisPoint> {
        let mut zeros = Vec::new();
        // At Ω → 0, c → 0 and s → f(0).
        let mut before = (0.0, (-self.tip.value(0.0), 0.0));
        for sample in &self.samples {
            let here = (sample.wave_number, g(sample));
            let (left, right) = (before.1, here.1);
            if left.0 * right.0 <= 0.0 {
                zeros.push(self.refine(&g, before, here));
            } else if left.0 * left.1 < 0.0 && right.0 * right.1 > 0.0 {
                zeros.extend(self.hidden_pair(&g, before, here));
            }
            before = here;
        }
        zeros.retain(|p| p.cosine > self.least && p.sine > 0.0);
        zeros
    }

    /// The pair of zeros of g between two samples of equal sign, if g has the other sign at the extremum between them.
    fn hidden_pair(
        &self,
        g: &impl Fn(&AxisPoint) -> (f64, f64),
        left: (f64, (f64, f64)),
        right: (f64, (f64, f64)),
    ) -> Vec<AxisPoint> {
        // The slopes at either side fall towards the extremum: it is out of reach of zero.
        let reach = 2.0 * (left.1.1.abs() + right.1.1.abs()) * (right.0 - left.0);
        if left.1.0.abs().min(right.1.0.abs()) > reach {
            return Vec::new();
        }
        let slope = |wave_number: f64| g(&self.at(wave_number)).1;
        let extremum = zero_between(slope, left.0, right.0);
        let at = (extremum, g(&self.at(extremum)));
        if at.1.0 * left.1.0 > 0.0 {
            return Vec::new();
        }
        vec![self.refine(g, left, at), self.refine(g, at, right)]
    }

    /// Newton's method kept within a bracket by bisection (Press et al., Numerical Recipes, 9.4).
    fn refine(
        &self,
        g: &impl Fn(&AxisPoint) -> (f64, f64),
        left: (f64, (f64, f64)),
        right: (f64, (f64, f64)),
    ) -> AxisPoint {
        let (mut lo, mut hi) = (left.0, right.0);
        let rising = right.1.0 > 0.0;
        let mut x = lo + (hi - lo) * (left.1.0 / (left.1.0 - right.1.0)).clamp(0.01, 0.99);
        let mut point = self.at(x);
        for _ in 0..100 {
            let (value, slope) = g(&point);
            if (value > 0.0) == rising {
                hi = x
            } else {
                lo = x
            }
            let newton = x - value / slope;
            let next = if newton >= lo && newton <= hi { newton } else { 0.5 * (lo + hi) };
            let done = (next - x).abs() <= 4.0 * f64::EPSILON * x;
            x = next;
            point = self.at(x);
            if done || value.abs() <= 0.0 {
                break;
            }
        }
        point
    }
}
