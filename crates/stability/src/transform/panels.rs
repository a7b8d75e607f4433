//! G(Λ) by quadrature, for sums of many narrow Gaussians.

use super::{LARGEST_EXPONENT, ROUNDING_OF_EXPONENT, Scaled};
use gauss_quad::GaussLegendre;
use num_complex::Complex64;
use stickslip_tip::Gaussian;

/// Nodes on each quadrature panel.
const PANEL_NODES: usize = 32;
/// |Λ + band| times half a panel's width that 32 nodes integrate to round-off.
const PANEL_PHASE: f64 = 17.0;
/// e^{-Λy} at the start of a panel comes from that of the panel before, but for every so many.
const PANELS_PER_EXPONENTIAL: usize = 8;
/// The quadrature serves |Λ| up to this many bands; beyond, the closed form does.
const BANDS_SERVED: f64 = 1.5;
/// The quadrature covers so many widths of each Gaussian: exp(-13²/2) = 2e-37.
const WIDTHS_INTEGRATED: f64 = 13.0;

/// Terms by their centers, and the largest width.
struct Sorted(Vec<Gaussian>, f64);

impl Sorted {
    fn new(terms: &[Gaussian]) -> Self {
        let mut sorted = terms.to_vec();
        sorted.sort_by(|a, b| a.center.total_cmp(&b.center));
        Self(sorted, terms.iter().map(|g| g.width).fold(0.0, f64::max))
    }

    /// All that may matter at y.
    fn about(&self, y: f64) -> &[Gaussian] {
        let Self(terms, widest) = self;
        let far = WIDTHS_INTEGRATED * widest;
        let first = terms.partition_point(|g| g.center < y - far);
        let end = terms.partition_point(|g| g.center <= y + far);
        &terms[first..end]
    }
}

/// f(y), f'(y) and f''(y), with the far tails that e^{-Λy} brings up for Re Λ < 0.
fn derivatives(terms: &Sorted, y: f64) -> [f64; 3] {
    let scaled = |g: &Gaussian| (y - g.center) / g.width;
    let near =
        terms.about(y).iter().map(|g| (g, scaled(g))).filter(|(_, z)| z.abs() < WIDTHS_INTEGRATED);
    near.fold([0.0; 3], |[height, slope, curvature], (g, z)| {
        let value = g.amplitude / g.width * (-0.5 * z * z).exp();
        let curvature = curvature + (z * z - 1.0) * value / g.width;
        [height + value * g.width, slope - z * value, curvature]
    })
}

/// Gauss-Legendre quadrature of f'' e^{-Λy} on equal panels over the reach of the tip; near Λ = 0 of
/// Λ f' e^{-Λy}, which is the same by parts and does not cancel there.
#[derive(Debug, Clone)]
pub(super) struct Panels {
    width: f64,
    /// Nodes within a panel, from its start.
    offsets: Vec<f64>,
    /// Weight times f at every node, panel by panel.
    height: Vec<f64>,
    /// Weight times f' likewise.
    slope: Vec<f64>,
    /// Weight times f'' likewise.
    curvature: Vec<f64>,
    /// |Λ| below which the integral by parts is of the smaller terms.
    by_parts_below: f64,
    largest_lambda: f64,
}

impl Panels {
    pub(super) fn new(terms: &[Gaussian], band: f64) -> Self {
        let far = |g: &Gaussian| g.center.abs() + WIDTHS_INTEGRATED * g.width;
        let reach = terms.iter().map(far).fold(0.0, f64::max);
        let largest_lambda = BANDS_SERVED * band;
        let phase = band + largest_lambda;
        let panels = (0.5 * reach * phase / PANEL_PHASE).ceil().max(1.0);
        let width = reach / panels;
        let rule =
            GaussLegendre::new(PANEL_NODES.try_into().unwrap_or(std::num::NonZero::<usize>::MIN));
        let mut pairs: Vec<(f64, f64)> = rule.as_node_weight_pairs().to_vec();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let offsets: Vec<f64> = pairs.iter().map(|(x, _)| 0.5 * width * (1.0 + x)).collect();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let starts = (0..panels as u32).map(|i| f64::from(i) * width);
        let terms = &Sorted::new(terms);
        let weighted: Vec<[f64; 3]> = starts
            .flat_map(|start| {
                let node = |(x, w): (&f64, &(f64, f64))| {
                    derivatives(terms, start + x).map(|f| 0.5 * width * w.1 * f)
                };
                offsets.iter().zip(&pairs).map(node).collect::<Vec<_>>()
            })
            .collect();
        let [height, slope, curvature] =
            [0, 1, 2].map(|order: usize| weighted.iter().map(|f| f[order]).collect::<Vec<f64>>());
        let area = |weighted: &[f64]| weighted.iter().map(|v| v.abs()).sum::<f64>();
        let by_parts_below = area(&curvature) / area(&slope).max(f64::MIN_POSITIVE);
        Self { width, offsets, height, slope, curvature, by_parts_below, largest_lambda }
    }

    pub(super) fn serves(&self, lambda: Complex64) -> bool {
        lambda.norm() <= self.largest_lambda
    }

    pub(super) fn at(&self, lambda: Complex64) -> Scaled {
        if lambda.norm() >= self.by_parts_below {
            return self.integral(&self.curvature, lambda);
        }
        let slope = self.integral(&self.slope, lambda);
        let derivative = slope.value + lambda * slope.derivative;
        Scaled { value: lambda * slope.value, derivative, ..slope }
    }

    /// ∫f e^{-Λy}dy and its derivative, where [`Self::at`] is by parts.
    pub(super) fn height_near_origin(&self, lambda: Complex64) -> Option<(Complex64, Complex64)> {
        let is_near = lambda.norm() < self.by_parts_below && self.serves(lambda);
        let unscaled = |f: Scaled| (f.value * f.log_scale.exp(), f.derivative * f.log_scale.exp());
        is_near.then(|| unscaled(self.integral(&self.height, lambda)))
    }

    /// Σ|terms| of [`Self::at`] times e^{-`log_scale`}.
    pub(super) fn size(&self, lambda: Complex64, log_scale: f64) -> f64 {
        let by_parts = lambda.norm() < self.by_parts_below;
        let weighted = if by_parts { &self.slope } else { &self.curvature };
        let nodes = self.offsets.len();
        let at = |(i, weight): (usize, &f64)| {
            #[expect(clippy::cast_precision_loss, reason = "a count")]
            let y = (i / nodes) as f64 * self.width + self.offsets[i % nodes];
            let rounding = 1.0 + ROUNDING_OF_EXPONENT * lambda.norm() * y;
            weight.abs() * (-lambda.re * y - log_scale).exp() * rounding
        };
        let sum: f64 = weighted.iter().enumerate().map(at).sum();
        if by_parts { sum * lambda.norm() } else { sum }
    }

    /// ∫g e^{-Λy}dy of `weighted` g, and its derivative.
    fn integral(&self, weighted: &[f64], lambda: Complex64) -> Scaled {
        let within: Vec<Complex64> = self.offsets.iter().map(|x| (-lambda * x).exp()).collect();
        let panels = weighted.chunks_exact(self.offsets.len());
        #[expect(clippy::cast_precision_loss, reason = "a count")]
        let length = self.width * panels.len() as f64;
        let largest = -lambda.re * length;
        let log_scale = if largest > LARGEST_EXPONENT { largest } else { 0.0 };
        let mut value = Complex64::ZERO;
        let mut derivative = Complex64::ZERO;
        let (mut start, mut carry) = (0.0, Complex64::ONE);
        let along = (-lambda * self.width).exp();
        for (i, panel) in panels.enumerate() {
            let mut sum = Complex64::ZERO;
            let mut moment = Complex64::ZERO;
            for ((weight, e), x) in panel.iter().zip(&within).zip(&self.offsets) {
                let term = e * *weight;
                sum += term;
                moment += term * *x;
            }
            // A few multiplications are as exact as an exponential, and sooner done.
            carry = match i % PANELS_PER_EXPONENTIAL {
                0 => (-lambda * start - log_scale).exp(),
                _ => carry * along,
            };
            value += carry * sum;
            derivative -= carry * (moment + sum * start);
            start += self.width;
        }
        Scaled { value, derivative, log_scale }
    }
}
