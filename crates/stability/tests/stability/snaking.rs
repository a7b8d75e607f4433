//! Single lines that give way across the scan. Judged by thresholds of two prototypes that share no code with this project
//! (PHYSICS.md, section 8), by roots counted by brute force with transforms by Simpson's rule, and by the linearised equation
//! itself, integrated in time with its whole past ([`Line`]).

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use stickslip_stability::{Snaking, SnakingCritical, StabilityError, critical};
use stickslip_tip::{Footprint, Gaussian2d, TipFunction, Wider};

/// Σ a exp(-(x-c)²/2w²) exp(-(y-d)²/2v²), dragged along y = 0: (x, y) as two springs and its own groove say.
struct Line {
    terms: Vec<Gaussian2d>,
    r: f64,
    stiffness: f64,
    law: Wider,
}

impl Line {
    fn triple(beta: f64, width_y: f64, r: f64, stiffness: f64) -> Self {
        let lobe = |amplitude, center| Gaussian2d {
            amplitude,
            center,
            width: 1.0,
            center_y: 0.0,
            width_y,
        };
        let mut terms = vec![lobe(1.0, 0.0)];
        if beta.abs() > 0.0 {
            terms.extend([lobe(-0.5 * beta, 2.0), lobe(-0.5 * beta, -2.0)]);
        }
        Self { terms, r, stiffness, law: Wider::default() }
    }

    fn footprint(&self) -> Footprint {
        Footprint::gaussian_sum(&self.terms).unwrap()
    }

    fn snaking(&self) -> Snaking {
        Snaking::new(&self.footprint(), self.law, (self.r, self.stiffness)).unwrap()
    }

    fn sum(&self, x: f64, of: impl Fn(f64, f64) -> f64) -> f64 {
        let term = |g: &Gaussian2d| {
            let z = (x - g.center) / g.width;
            g.amplitude * (-0.5 * z * z).exp() * of(g.center_y / g.width_y, g.width_y)
        };
        self.terms.iter().map(term).sum()
    }

    /// f(x,0)
    fn height(&self, x: f64) -> f64 {
        self.sum(x, |z, _| (-0.5 * z * z).exp())
    }

    /// `f_yy(x,0)`
    fn curvature(&self, x: f64) -> f64 {
        self.sum(x, |z, width| (z * z - 1.0) * (-0.5 * z * z).exp() / (width * width))
    }

    fn fading(&self) -> f64 {
        self.law.healing_time.map_or(0.0, |time| 1.0 / (self.r * time))
    }

    /// αw0: w0 = exp(-αw0 |φ(s)|/(rb)), by halving.
    fn indentation(&self, alpha: f64) -> f64 {
        let Some(limit) = self.law.depth_limit else { return alpha };
        let depth = self.transform(self.fading().into(), |x| self.height(x)).re.abs() / self.r;
        let (mut low, mut high) = (0.0, alpha);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if middle * (middle * depth / limit).exp() < alpha {
                low = middle
            } else {
                high = middle
            }
        }
        0.5 * (low + high)
    }

    /// ∫_0^∞ g e^{-px}dx by Simpson's rule.
    fn transform(&self, p: Complex64, g: impl Fn(f64) -> f64) -> Complex64 {
        let panels = 900;
        let h = 14.0 / f64::from(panels);
        let term = |i: i32| {
            let weight = if i == 0 || i == panels { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            let x = h * f64::from(i);
            (-p * x).exp() * (weight * g(x))
        };
        (0..=panels).map(term).sum::<Complex64>() * (h / 3.0)
    }

    /// λ + κ_y + (αw0/r)(S(λ/r + s) - S(s))
    fn characteristic(&self, alpha: f64, lambda: Complex64) -> Complex64 {
        let a = self.indentation(alpha) / self.r;
        let s = |p: Complex64| self.transform(p, |x| self.curvature(x));
        let fading = self.fading();
        lambda + self.stiffness + a * (s(lambda / self.r + fading) - s(fading.into()))
    }

    /// Turns of it along a half-circle to the right beyond which its first two terms outweigh the others, in small steps.
    fn growing(&self, alpha: f64) -> f64 {
        let step = 16.0 / 4000.0;
        let area: f64 = (0..4000).map(|i| self.curvature(step * f64::from(i)).abs() * step).sum();
        let radius = 3.0 * self.indentation(alpha) / self.r * area;
        // The upper half, which turns it by as much as the lower: down the axis, and back along the circle.
        let at = |part: f64| {
            let lambda = if part <= 1.0 {
                Complex64::new(0.0, radius * (1.0 - part))
            } else {
                Complex64::from_polar(radius, 0.25 * TAU * (part - 1.0))
            };
            self.characteristic(alpha, lambda)
        };
        let mut turned = 0.0;
        for i in 0..120 {
            let [from, to] = [i, i + 1].map(|i| f64::from(i) / 60.0);
            let mut parts = vec![(from, at(from), to, at(to))];
            while let Some((from, first, to, last)) = parts.pop() {
                let middle = 0.5 * (from + to);
                let between = at(middle);
                let turns = [(between / first).arg(), (last / between).arg()];
                if turns.iter().all(|turn| turn.abs() < 0.3) || to - from < 1e-12 {
                    turned += turns[0] + turns[1];
                } else {
                    parts.extend([(middle, between, to, last), (from, first, middle, between)]);
                }
            }
        }
        2.0 * turned / TAU
    }

    /// The fastest pair λ = σ ± iω of y' = a ∫ `f_yy(rτ,0)` e^{-τ/T} (y(t) - y(t-τ)) dτ - κ_y y, integrated by the trapezoidal
    /// rule in τ and in t from a kick: from three late values a time apart.
    fn fastest(&self, alpha: f64, step: f64, until: f64) -> Complex64 {
        let past = (13.0 / self.r / step) as usize;
        let heal = self.law.healing_time.map_or(0.0, |time| 1.0 / time);
        let weight = |i: usize| {
            let tau = step * i as f64;
            let ends = if i == 0 { 0.5 } else { 1.0 };
            ends * step
                * self.indentation(alpha)
                * self.curvature(self.r * tau)
                * (-heal * tau).exp()
        };
        let weights: Vec<f64> = (0..=past).map(weight).collect();
        let all: f64 = weights.iter().sum();
        let own = all - weights[0] - self.stiffness;
        let mut y = vec![0.0; past + 1];
        y.push(1.0);
        let echo = |y: &[f64]| -> f64 {
            weights[1..].iter().zip(y.iter().rev()).map(|(w, y)| w * y).sum()
        };
        let steps = (until / step) as usize;
        let mut force = own - echo(&y[..y.len() - 1]);
        for _ in 0..steps {
            let last = y[y.len() - 1];
            let felt = echo(&y);
            let next = (last + 0.5 * step * (force - felt)) / (1.0 - 0.5 * step * own);
            force = own * next - felt;
            y.push(next);
        }
        // y(t + 2D) = 2 e^{σD} cos(ωD) y(t + D) - e^{2σD} y(t)
        let apart = (1.0 / step).round() as usize;
        let at = |back: usize| {
            let n = y.len() - 1 - back;
            [y[n], y[n - apart], y[n - 2 * apart]]
        };
        let ([a0, a1, a2], [b0, b1, b2]) = (at(0), at(apart / 2));
        let determinant = a1 * b2 - a2 * b1;
        let sum = (a0 * b2 - a2 * b0) / determinant;
        let product = -(a1 * b0 - a0 * b1) / determinant;
        let root = Complex64::new(0.25 * sum * sum - product, 0.0).sqrt();
        (root + 0.5 * sum).ln() / (step * apart as f64)
    }
}

#[test]
fn thresholds_are_those_of_the_prototypes() {
    for (stiffness, alpha) in
        [(0.25, 0.830_541_012_7), (0.5, 1.017_893_766_3), (1.0, 1.416_274_458_1)]
    {
        let found = Line::triple(1.0, 1.0, 1.0, stiffness).snaking().critical().unwrap().unwrap();
        assert!((found.alpha - alpha).abs() < 6e-11, "{found:?}");
        assert_eq!((found.certificate.growing_below, found.certificate.growing_above), (0, 2));
    }
}

/// κ_y → 0: α_y/r² = A(κ_y/r), whose difference from A(0) falls with κ_y.
#[test]
fn a_weak_spring_tends_to_its_limit_and_thresholds_scale_with_r() {
    let at = |r: f64, stiffness: f64| {
        Line::triple(1.0, 1.0, r, stiffness).snaking().critical().unwrap().unwrap()
    };
    let off = |stiffness: f64| at(1.0, stiffness).alpha - 0.654_488_250_419;
    assert!((off(1e-7) * 2.0 - off(2e-7)).abs() < 2e-12);
    assert!(off(1e-8).abs() < 1e-8);
    assert!((off(2e-4) / off(1e-4) - 2.0).abs() < 1e-3);
    for r in [0.01, 0.3, 7.0] {
        for part in [0.05, 0.4, 1.5] {
            let (one, other) = (at(1.0, part), at(r, r * part));
            assert!((other.alpha / (r * r * one.alpha) - 1.0).abs() < 1e-12, "{r} {part}");
            assert!((other.wavelength / one.wavelength - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn a_line_snakes_before_it_sticks_and_slips_on_a_weak_spring_only() {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let sticks = critical(&Wider::default(), &tip, 1.0).unwrap().alpha;
    let snakes = |stiffness: f64| {
        Line::triple(1.0, 1.0, 1.0, stiffness).snaking().critical().unwrap().unwrap().alpha
    };
    assert!(snakes(0.566_15) < sticks && sticks < snakes(0.566_25));
}

/// At β = 1 the height under the steady tip is 0 and its weight 1: no depth limit moves the threshold across, though along the
/// scan there is no linear theory. Elsewhere it moves by e^{-h0/b}.
#[test]
fn a_depth_limit_enters_by_the_weight_of_the_steady_tip() {
    let limited = Wider { depth_limit: Some(2.0), ..Wider::default() };
    for (beta, stiffness) in [(1.0, 0.5), (0.8, 0.3)] {
        let [free, held] = [Wider::default(), limited].map(|law| {
            let line = Line { law, ..Line::triple(beta, 1.0, 1.0, stiffness) };
            line.snaking().critical().unwrap().unwrap()
        });
        let depth = free.alpha * (1.0 - beta) * (0.5 * PI).sqrt();
        assert!((held.alpha / free.alpha / (0.5 * depth).exp() - 1.0).abs() < 1e-13);
        assert!((held.omega / free.omega - 1.0).abs() < 1e-15);
    }
}

/// Footprints with lobes, rings and other widths, healing and a depth limit.
fn lines() -> Vec<Line> {
    let at = |amplitude, center, center_y, width, width_y| Gaussian2d {
        amplitude,
        center,
        width,
        center_y,
        width_y,
    };
    let ring = |height: f64| {
        let sides = [1.7, -1.7].map(|y| at(height, 0.0, y, 1.2, 0.8));
        let ends = [1.9, -1.9].map(|x| at(-0.2, x, 0.0, 0.8, 1.1));
        [&[at(1.0, 0.0, 0.0, 1.0, 0.9)][..], &sides, &ends].concat()
    };
    let healing = Wider { healing_time: Some(10.0), ..Wider::default() };
    let limited = Wider { depth_limit: Some(3.0), ..Wider::default() };
    let both =
        Wider { depth_limit: Some(2.0), healing_time: Some(15.0), inertia: Some(0.4), ..limited };
    vec![
        Line::triple(1.0, 0.7, 0.8, 0.4),
        Line { law: healing, ..Line::triple(1.0, 1.0, 1.0, 0.5) },
        Line { law: limited, ..Line::triple(0.8, 1.0, 1.0, 0.3) },
        Line { law: both, ..Line::triple(0.9, 1.2, 1.3, 0.2) },
        Line { terms: ring(0.5), r: 1.0, stiffness: 0.6, law: Wider::default() },
        Line { terms: ring(0.7), r: 0.7, stiffness: 0.3, law: both },
    ]
}

/// By brute force nothing grows below the threshold, at many α, and a pair does above.
#[test]
fn thresholds_are_those_of_roots_counted_by_brute_force() {
    for line in lines() {
        let SnakingCritical { alpha, omega, .. } = line.snaking().critical().unwrap().unwrap();
        let at = |part: f64| line.growing(part * alpha);
        for part in [0.2, 0.5, 0.8, 0.95, 1.0 - 1e-4] {
            assert!(at(part).abs() < 1e-3, "{part} {}", at(part));
        }
        assert!((at(1.0 + 1e-4) - 2.0).abs() < 1e-3, "{}", at(1.0 + 1e-4));
        let left = line.characteristic(alpha, Complex64::new(0.0, omega));
        // Simpson's rule is off by 3e-9.
        assert!(left.norm() < 2e-8, "{left}");
    }
}

/// A Gaussian and J0 do not, nor does a footprint that is flat across.
#[test]
fn footprints_that_never_snake_are_told() {
    for stiffness in [1e-6, 0.3, 40.0] {
        let line = Line::triple(0.0, 1.0, 1.0, stiffness);
        assert_eq!(line.snaking().critical(), Ok(None));
        for alpha in [0.1, 3.0, 200.0] {
            assert_eq!(line.snaking().unstable_count(alpha), Ok(0));
        }
        assert!(line.growing(5.0).abs() < 1e-3);
    }
    let bessel = Footprint::separable(TipFunction::Bessel, 1.0).unwrap();
    let bessel = Snaking::new(&bessel, Wider::default(), (1.0, 0.5)).unwrap();
    assert_eq!(bessel.critical(), Ok(None));
    assert_eq!(bessel.unstable_count(1.0), Err(StabilityError::AcrossGaussiansOnly));
    // h'' of twins one width off the line is 0 on it.
    let flat: Vec<Gaussian2d> = [1.0, -1.0]
        .map(|center_y| Gaussian2d {
            amplitude: 1.0,
            center: 0.0,
            width: 1.0,
            center_y,
            width_y: 1.0,
        })
        .into();
    let flat = Line { terms: flat, ..Line::triple(0.0, 1.0, 1.0, 0.5) }.snaking();
    assert_eq!(flat.critical(), Ok(None));
    assert!((flat.leading_roots(3.0, 1).unwrap().roots[0] + 0.5).norm() < 1e-13);
}

/// A measured footprint: rows of a table in place of the Gaussians themselves.
#[test]
fn a_table_snakes_where_what_it_tabulates_does() {
    let line = Line::triple(1.0, 1.0, 1.0, 0.5);
    let [x, y] = [0.2, 0.3].map(|step| (0..36).map(|i| step * f64::from(i)).collect::<Vec<f64>>());
    let (xs, ys): (Vec<f64>, Vec<f64>) =
        y.iter().flat_map(|y| x.iter().map(move |x| (*x, *y))).unzip();
    let f: Vec<f64> =
        xs.iter().zip(&ys).map(|(x, y)| line.height(*x) * (-0.5 * y * y).exp()).collect();
    let table = Footprint::table(&xs, &ys, &f).unwrap();
    let snaking = Snaking::new(&table, Wider::default(), (1.0, 0.5)).unwrap();
    let [found, wanted] =
        [snaking, line.snaking()].map(|snaking| snaking.critical().unwrap().unwrap());
    assert!((found.alpha / wanted.alpha - 1.0).abs() < 1e-6, "{found:?} {wanted:?}");
    assert_eq!((found.certificate.growing_below, found.certificate.growing_above), (0, 2));
}

/// The leading pair against the equation in time, whose error falls with the square of its step.
#[test]
fn deviations_grow_as_the_leading_roots_say() {
    for (line, part) in lines().into_iter().zip([1.3, 1.2, 1.4, 1.2, 1.1, 1.3]) {
        let alpha = part * line.snaking().critical().unwrap().unwrap().alpha;
        let spectrum = line.snaking().leading_roots(alpha, 4).unwrap();
        assert!(spectrum.certificate.is_complete());
        let leading = spectrum.roots[0];
        assert!(leading.re > 0.0 && leading.im > 0.0);
        let off = [0.04, 0.02, 0.01].map(|step| line.fastest(alpha, step, 60.0) - leading);
        for pair in off.windows(2) {
            let order = (pair[0].norm() / pair[1].norm()).log2();
            assert!((order - 2.0).abs() < 0.05, "{order} {off:?} {leading}");
        }
        let extrapolated = (off[2] * 4.0 - off[1]) / 3.0;
        assert!(extrapolated.norm() < 2e-7, "{extrapolated:e}");
    }
}

#[test]
fn what_is_no_stiffness_is_refused() {
    let footprint = Line::triple(1.0, 1.0, 1.0, 1.0).footprint();
    for stiffness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = Snaking::new(&footprint, Wider::default(), (1.0, stiffness)).unwrap_err();
        assert!(error.to_string().contains("stiffness across"), "{error}");
    }
    let free = Wider { spring: false, ..Wider::default() };
    assert!(matches!(Snaking::new(&footprint, free, (1.0, 1.0)), Err(StabilityError::NoSupport)));
}
