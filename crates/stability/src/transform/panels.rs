//! G(Λ) by quadrature, for sums of many narrow Gaussians.

use super::{LARGEST_EXPONENT, ROUNDING_OF_EXPONENT, Scaled};
use gauss_quad::GaussLegendre;
use multiversion::multiversion;
use num_complex::Complex64;
use stickslip_tip::Gaussian;
use stickslip_tip::sorting::sort_by_number;

const PANEL_NODES: usize = 32;
/// Largest |Λ + band| times half a panel's width for which 32 nodes integrate to round-off.
const PANEL_PHASE: f64 = 17.0;
/// Number of successive panels for which e^{-Λy} at their starts has a common factor.
const PANELS_PER_EXPONENTIAL: usize = 16;
/// Number of panels that are summed in parallel SIMD lanes.
const LANES: usize = 4;
/// The quadrature serves |Λ| up to this many bands; beyond, the closed form does.
const BANDS_SERVED: f64 = 1.5;
/// Half-range of the quadrature, in widths of each Gaussian: exp(-13²/2) = 2e-37.
const WIDTHS_INTEGRATED: f64 = 13.0;

/// Terms in the order of their centers, and the largest width.
struct Sorted(Vec<Gaussian>, f64);

impl Sorted {
    fn new(terms: &[Gaussian]) -> Self {
        let mut sorted = terms.to_vec();
        sort_by_number(&mut sorted, |item| item.center);
        Self(sorted, terms.iter().map(|g| g.width).fold(0.0, f64::max))
    }

    /// The terms that may not be negligible at y.
    fn about(&self, y: f64) -> &[Gaussian] {
        let Self(terms, widest) = self;
        let far = WIDTHS_INTEGRATED * widest;
        let first = terms.partition_point(|g| g.center < y - far);
        let end = terms.partition_point(|g| g.center <= y + far);
        &terms[first..end]
    }
}

/// f(y), f'(y) and f''(y), including the far tails, which e^{-Λy} amplifies for Re Λ < 0.
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

/// One value for each of [`LANES`] neighbouring panels.
type Lane = [f64; LANES];

/// Quadrature weight times a function, for groups of [`LANES`] panels: in each group node by node, one lane for each
/// panel. The last group is filled up with zeros.
#[derive(Debug, Clone)]
struct Weighted(Vec<Lane>);

impl Weighted {
    /// From values in the order of panels.
    fn new(values: &[f64]) -> Self {
        let some_panels = values.chunks(LANES * PANEL_NODES).flat_map(|some| {
            let at = |i: usize| some.get(i).copied().unwrap_or(0.0);
            (0..PANEL_NODES).map(move |k| std::array::from_fn(|p| at(p * PANEL_NODES + k)))
        });
        Self(some_panels.collect())
    }
}

/// Σg e^{-Λx} and Σx g e^{-Λx} of [`LANES`] panels.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    re: Lane,
    im: Lane,
    moment_re: Lane,
    moment_im: Lane,
}

/// The starts x of [`LANES`] panels, from the start of the first of [`PANELS_PER_EXPONENTIAL`] panels, and e^{-Λx} there.
#[derive(Debug, Clone, Copy)]
struct Starts {
    x: Lane,
    re: Lane,
    im: Lane,
}

type AllStarts = [Starts; PANELS_PER_EXPONENTIAL / LANES];

/// Σg e^{-Λx} and Σx g e^{-Λx} of each group of [`PANELS_PER_EXPONENTIAL`] panels, with x from the start of the first of
/// them. `within` contains e^{-Λx} at the nodes `offsets` of a panel.
///
/// Wider vectors yield the same bits, because lanes do not depend on each other.
#[multiversion(targets("x86_64+avx2"))]
fn sums(
    Weighted(weighted): &Weighted,
    (offsets, within): (&[f64], &[Complex64]),
    starts: &AllStarts,
) -> Vec<[Complex64; 2]> {
    let add = |mut all: Sums, (some, start): (&[Lane], &Starts)| {
        let mut sums = Sums::default();
        for ((weights, x), e) in some.iter().zip(offsets).zip(within) {
            for (p, weight) in weights.iter().enumerate() {
                let (re, im) = (e.re * weight, e.im * weight);
                sums.re[p] += re;
                sums.im[p] += im;
                sums.moment_re[p] += re * x;
                sums.moment_im[p] += im * x;
            }
        }
        for p in 0..LANES {
            let (re, im, x) = (start.re[p], start.im[p], start.x[p]);
            let (a, b) = (sums.re[p], sums.im[p]);
            let (c, d) = (sums.moment_re[p] + x * a, sums.moment_im[p] + x * b);
            all.re[p] += re * a - im * b;
            all.im[p] += re * b + im * a;
            all.moment_re[p] += re * c - im * d;
            all.moment_im[p] += re * d + im * c;
        }
        all
    };
    let both = |panels: &[Lane]| {
        let each = panels.chunks_exact(PANEL_NODES).zip(starts);
        let all = each.fold(Sums::default(), add);
        let sum = |re: Lane, im: Lane| Complex64::new(re.iter().sum(), im.iter().sum());
        [sum(all.re, all.im), sum(all.moment_re, all.moment_im)]
    };
    weighted.chunks(PANEL_NODES * starts.len()).map(both).collect()
}

/// Gauss-Legendre quadrature of f'' e^{-Λy} on equal panels over the reach of the tip; near Λ = 0 of
/// Λ f' e^{-Λy}, which is the same by parts and does not cancel there.
#[derive(Debug, Clone)]
pub(crate) struct Panels {
    count: usize,
    width: f64,
    /// Nodes within a panel, from its start.
    offsets: Vec<f64>,
    /// Weight times f at every node.
    height: Weighted,
    /// Weight times f' at every node.
    slope: Weighted,
    /// Absolute values of `slope`.
    slope_size: Weighted,
    /// Weight times f'' at every node.
    curvature: Weighted,
    curvature_size: Weighted,
    /// |Λ| below which the integral by parts has the smaller terms.
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
        sort_by_number(&mut pairs, |item| item.0);
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
        let sizes =
            |values: &[f64]| Weighted::new(&values.iter().map(|v| v.abs()).collect::<Vec<f64>>());
        Self {
            count: height.len() / PANEL_NODES,
            width,
            offsets,
            height: Weighted::new(&height),
            slope_size: sizes(&slope),
            slope: Weighted::new(&slope),
            curvature_size: sizes(&curvature),
            curvature: Weighted::new(&curvature),
            by_parts_below,
            largest_lambda,
        }
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

    /// ∫f e^{-Λy}dy and its derivative where [`Self::at`] integrates by parts, else `None`.
    pub(super) fn height_near_origin(&self, lambda: Complex64) -> Option<(Complex64, Complex64)> {
        let is_near = lambda.norm() < self.by_parts_below && self.serves(lambda);
        let unscaled = |f: Scaled| (f.value * f.log_scale.exp(), f.derivative * f.log_scale.exp());
        is_near.then(|| unscaled(self.integral(&self.height, lambda)))
    }

    /// Σ|terms| of [`Self::at`] times e^{-`log_scale`}.
    pub(super) fn size(&self, lambda: Complex64, log_scale: f64) -> f64 {
        let by_parts = lambda.norm() < self.by_parts_below;
        let sizes = if by_parts { &self.slope_size } else { &self.curvature_size };
        // Exponents are the larger the further out: ∫|g| (1 + c |Λ| y) e^{-Re Λ y}dy.
        let sum = self.integral(sizes, Complex64::new(lambda.re, 0.0));
        let rounded = ROUNDING_OF_EXPONENT * lambda.norm() * -sum.derivative.re;
        let size = (sum.value.re + rounded) * (sum.log_scale - log_scale).exp();
        if by_parts { size * lambda.norm() } else { size }
    }

    /// ∫g e^{-Λy}dy of `weighted` g, and its derivative.
    fn integral(&self, weighted: &Weighted, lambda: Complex64) -> Scaled {
        let within: Vec<Complex64> = self.offsets.iter().map(|x| (-lambda * x).exp()).collect();
        #[expect(clippy::cast_precision_loss, reason = "a count")]
        let start = |panel: usize| self.width * panel as f64;
        let largest = -lambda.re * start(self.count);
        let log_scale = if largest > LARGEST_EXPONENT { largest } else { 0.0 };
        let starts: AllStarts = std::array::from_fn(|i| {
            let x: Lane = std::array::from_fn(|p| start(i * LANES + p));
            let e = x.map(|x| (-lambda * x).exp());
            Starts { x, re: e.map(|e| e.re), im: e.map(|e| e.im) }
        });
        let (mut value, mut derivative) = (Complex64::ZERO, Complex64::ZERO);
        let sums = sums(weighted, (&self.offsets, &within), &starts);
        for (i, [sum, moment]) in sums.into_iter().enumerate() {
            let start = start(i * PANELS_PER_EXPONENTIAL);
            let carry = (-lambda * start - log_scale).exp();
            value += carry * sum;
            derivative -= carry * (moment + sum * start);
        }
        Scaled { value, derivative, log_scale }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{closed_forms, transform_of_heights};
    use super::*;
    use stickslip_tip::TipFunction;

    /// Rows enough for some forty panels, with a kink, without which fewer would suffice.
    fn terms() -> (Vec<Gaussian>, f64) {
        let x: Vec<f64> = (0..90).map(|i| 0.1 * f64::from(i)).collect();
        let smooth = |x: f64| (1.0 - 0.3 * x * x) * (-0.5 * x * x).exp();
        let f: Vec<f64> = x.iter().map(|x| smooth(*x) + 1e-9 * (4.0 - x).max(0.0)).collect();
        let tip = TipFunction::table(&x, &f).unwrap();
        let TipFunction::Gaussians(sum) = &tip else { unreachable!("a table is a sum") };
        (sum.terms().to_vec(), tip.band())
    }

    const LAMBDAS: [(f64, f64); 7] = [
        (0.01, 0.02),
        (0.0, 0.9),
        (2.0, 3.0),
        (-1.5, 2.0),
        (-30.0, 1.0),
        (0.0, 50.0),
        (-40.0, 60.0),
    ];

    /// Judge: the closed form of each Gaussian, which shares nothing with the quadrature.
    #[test]
    fn the_quadrature_is_the_closed_form() {
        let (terms, band) = terms();
        let panels = Panels::new(&terms, band);
        assert!(panels.count > 2 * PANELS_PER_EXPONENTIAL, "{}", panels.count);
        for (re, im) in LAMBDAS {
            let lambda = Complex64::new(re, im);
            assert!(panels.serves(lambda));
            let (found, exact) = (panels.at(lambda), closed_forms(&terms, lambda));
            let scale = (found.log_scale - exact.log_scale).exp();
            let size = panels.size(lambda, exact.log_scale);
            let apart = (found.value * scale - exact.value).norm();
            // Closed forms of narrow Gaussians cancel: what they are of is rounded.
            assert!(apart < 1e-12 * (size + 10.0 * lambda.norm()), "{lambda}: {apart} {size}");
            let slopes = (found.derivative * scale - exact.derivative).norm();
            assert!(slopes < 1e-11 * (10.0 + 9.0 * size), "{lambda}: {slopes} {size}");
        }
        let lambda = Complex64::new(0.01, 0.02);
        let (height, slope) = panels.height_near_origin(lambda).unwrap();
        let (exact, exact_slope) = transform_of_heights(&terms, lambda);
        assert!((height - exact).norm() < 1e-12 && (slope - exact_slope).norm() < 1e-12);
    }

    /// Judge: the sum over nodes as it is written, each with its own exponential.
    #[test]
    fn sizes_are_sums_over_all_nodes() {
        let (terms, band) = terms();
        let panels = Panels::new(&terms, band);
        for (re, im) in LAMBDAS {
            let (lambda, log_scale) = (Complex64::new(re, im), 20.0);
            let by_parts = lambda.norm() < panels.by_parts_below;
            let Weighted(weighted) = if by_parts { &panels.slope } else { &panels.curvature };
            let (mut sum, mut nodes) = (0.0, 0);
            for (i, some) in weighted.iter().enumerate() {
                for (p, weight) in some.iter().enumerate() {
                    let panel = i / PANEL_NODES * LANES + p;
                    let y = panel as f64 * panels.width + panels.offsets[i % PANEL_NODES];
                    let rounding = 1.0 + ROUNDING_OF_EXPONENT * lambda.norm() * y;
                    sum += weight.abs() * (-lambda.re * y - log_scale).exp() * rounding;
                    nodes += usize::from(weight.abs() > 0.0);
                }
            }
            let sum = if by_parts { sum * lambda.norm() } else { sum };
            let found = panels.size(lambda, log_scale);
            assert!((found / sum - 1.0).abs() < 1e-12, "{lambda}: {found} {sum}");
            assert!(nodes > panels.count * PANEL_NODES / 2, "{nodes}");
        }
    }
}
