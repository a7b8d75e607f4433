//! The imaginary axis Λ = iΩ, on which (42) and (43) hold.
//!
//! With c(Ω) = -∫f'' cos = Ω² f̂(Ω)/2 and s(Ω) = (1/Ω)∫f'' sin, (42) is r = s/c and (43) is αc = r/c.

use super::crossings::zeros;
use super::kept::Kept;
use super::one_sided::OneSided;
use num_complex::Complex64;
use std::f64::consts::PI;
use std::sync::Arc;
use stickslip_tip::{TipFunction, stop};

/// Number of samples per period of the fastest oscillation that the reach of the tip allows.
const SAMPLES_PER_PERIOD: f64 = 8.0;
const MOST_SAMPLES: f64 = 2e5;
/// For a footprint given as a table, values of c below this fraction of the largest one are round-off.
const ROUNDOFF: f64 = 1e-12;
/// Number of successive samples of round-off after which the scan of a table ends.
const FADED_SPAN: usize = 64;

/// c and s at one Ω.
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisPoint {
    pub(super) wave_number: f64,
    pub(super) cosine: f64,
    pub(super) sine: f64,
}

/// c and s, sampled so densely that no crossing lies unseen between two samples.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    footprint: OneSided,
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
        let footprint = OneSided::new(tip);
        let reach = tip.reach().unwrap_or(1.0);
        let step = (2.0 * PI / (SAMPLES_PER_PERIOD * reach)).max(tip.band() / MOST_SAMPLES);
        let roundoff = if footprint.is_closed_form() { 0.0 } else { ROUNDOFF };
        let mut axis = Self { footprint, samples: vec![], least: 0.0 };
        axis.samples.push(axis.at(0.0));
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

    /// c and s at Ω ≥ 0.
    pub(super) fn at(&self, wave_number: f64) -> AxisPoint {
        let tip = self.footprint.tip();
        if wave_number <= 0.0 {
            return AxisPoint { wave_number, cosine: 0.0, sine: tip.value(0.0) };
        }
        let (g, _) = self.footprint.plain(Complex64::new(0.0, wave_number)).curvature;
        let cosine = if self.footprint.is_closed_form() && tip.is_even() {
            0.5 * wave_number * wave_number * tip.fourier(wave_number)
        } else {
            -g.re
        };
        AxisPoint { wave_number, cosine, sine: -g.im / wave_number }
    }

    /// Every Ω with c > 0 at which (42) gives this r, ascending.
    pub(super) fn crossings_of_r(&self, r: f64) -> Vec<AxisPoint> {
        self.zeros(|p| r * p.cosine - p.sine)
    }

    /// Every Ω with c > 0 at which (43) gives this α, ascending.
    pub(super) fn crossings_of_alpha(&self, alpha: f64) -> Vec<AxisPoint> {
        self.zeros(|p| alpha * p.cosine * p.cosine - p.sine)
    }

    fn zeros(&self, g: impl Fn(&AxisPoint) -> f64) -> Vec<AxisPoint> {
        let samples: Vec<(f64, f64)> = self.samples.iter().map(|p| (p.wave_number, g(p))).collect();
        let zeros = zeros(|q| g(&self.at(q)), &samples).into_iter().map(|q| self.at(q));
        zeros.filter(|p| p.cosine > self.least && p.sine > 0.0).collect()
    }
}
