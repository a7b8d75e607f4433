//! Where ripples begin to grow from line to line. Judged by thresholds found by an independent prototype (a
//! spectral PDE and direct sums of the closed equation, 1e-8), by the limit of a small pitch, by a single line,
//! and by the recurrence from line to line itself, carried out here line by line with transforms by Simpson's rule
//! ([`Slow`]), which shares no code with the search.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use num_complex::Complex64;
use std::f64::consts::{FRAC_1_SQRT_2, PI};
use stickslip_stability::{
    Raster, RasterCritical, RasterPath, StabilityError, critical, leading_roots,
};
use stickslip_tip::{Footprint, Gaussian, Gaussian2d, Model, TipFunction, Wider};

fn gaussian(pitch: f64) -> Raster {
    let footprint = Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap();
    Raster::new(&footprint, Wider::default(), (1.0, pitch), 1.0).unwrap()
}

#[test]
fn thresholds_are_those_of_the_prototype() {
    for (pitch, one_way, angle, zigzag) in [
        (0.5, 0.418_787, 46.0, 0.457_309),
        (1.0, 0.805_167, 48.3, 0.821_287),
        (2.0, 1.523_778, 58.0, 1.523_781),
    ] {
        let raster = gaussian(pitch);
        let found = raster.critical(RasterPath::OneWay).unwrap();
        assert!((found.alpha - one_way).abs() < 6e-7, "pitch {pitch}: {}", found.alpha);
        assert!((found.crest_angle.unwrap() - angle).abs() < 0.06, "{found:?}");
        let found = raster.critical(RasterPath::Zigzag).unwrap();
        assert!((found.alpha - zigzag).abs() < 6e-7, "pitch {pitch}: {}", found.alpha);
        assert_eq!((found.kappa, found.crest_angle), (None, None));
    }
}

#[test]
fn lines_far_apart_are_single_lines() {
    let tip = TipFunction::gaussian(1.0).unwrap();
    let alone = critical(&Wider::default(), &tip, 1.0).unwrap();
    for path in [RasterPath::OneWay, RasterPath::Zigzag] {
        let found = gaussian(9.0).critical(path).unwrap();
        assert!((found.alpha - alone.alpha).abs() < 1e-12 && (found.q - alone.omega).abs() < 1e-12);
    }
}

/// Σ a exp(-(x-c)²/2w²) exp(-y²/2v²) of a footprint, the recurrence of its ripples from line to line.
struct Slow {
    terms: Vec<Gaussian2d>,
    r: f64,
    pitch: f64,
    path: RasterPath,
}

impl Slow {
    fn triple(beta: f64, width_y: f64, r: f64, pitch: f64, path: RasterPath) -> Self {
        let lobe = |amplitude, center| Gaussian2d {
            amplitude,
            center,
            width: 1.0,
            center_y: 0.0,
            width_y,
        };
        let terms = vec![lobe(1.0, 0.0), lobe(-0.5 * beta, 2.0), lobe(-0.5 * beta, -2.0)];
        Self { terms, r, pitch, path }
    }

    fn raster(&self) -> Raster {
        Raster::new(&slow_footprint(self), Wider::default(), (self.r, self.pitch), 1.0).unwrap()
    }

    /// h(y) of a term; twins in y are given as two terms.
    fn across(g: &Gaussian2d, y: f64) -> f64 {
        (-0.5 * ((y - g.center_y) / g.width_y).powi(2)).exp()
    }

    /// G(iq) = ∫_0^∞ f''(y) e^{-iqy}dy along y = 0.
    fn transform(&self, q: f64) -> Complex64 {
        let curvature = |x: f64| -> f64 {
            let term = |g: &Gaussian2d| {
                let z = (x - g.center) / g.width;
                let value = g.amplitude * Self::across(g, 0.0) * (-0.5 * z * z).exp();
                (z * z - 1.0) * value / (g.width * g.width)
            };
            self.terms.iter().map(term).sum()
        };
        let panels = 4000;
        let h = 16.0 / f64::from(panels);
        let term = |i: i32| {
            let weight = if i == 0 || i == panels { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            let y = h * f64::from(i);
            Complex64::from_polar(weight * curvature(y), -q * y)
        };
        (0..=panels).map(term).sum::<Complex64>() * (h / 3.0)
    }

    /// (α/r) q² ĝ(q) h(jd)/D(q), j = 1, 2, …
    fn couplings(&self, alpha: f64, q: f64) -> Vec<Complex64> {
        let ratio = alpha / self.r;
        let own = Complex64::new(1.0, self.r * q) + ratio * self.transform(q);
        let far = self.terms.iter().map(|g| g.center_y + 9.0 * g.width_y).fold(0.0, f64::max);
        let lines = (far / self.pitch).ceil() as i32;
        let at = |j: i32| -> Complex64 {
            let term = |g: &Gaussian2d| {
                let along = (2.0 * PI).sqrt() * g.width * (-0.5 * (q * g.width).powi(2)).exp();
                Complex64::from_polar(g.amplitude * along, -q * g.center)
                    * Self::across(g, self.pitch * f64::from(j))
            };
            self.terms.iter().map(term).sum()
        };
        (1..=lines).map(|j| ratio * q * q * at(j) / own).collect()
    }

    /// The same of a way back: those of the mirror image, conjugate.
    fn couplings_back(&self, alpha: f64, q: f64) -> Vec<Complex64> {
        self.mirrored().couplings(alpha, q).iter().map(Complex64::conj).collect()
    }

    fn mirrored(&self) -> Self {
        let term = |g: &Gaussian2d| Gaussian2d { center: -g.center, ..*g };
        Self { terms: self.terms.iter().map(term).collect(), ..*self }
    }

    fn recurrence(&self, alpha: f64, q: f64, lines: usize) -> (f64, Vec<Complex64>) {
        let forth = self.couplings(alpha, q);
        match self.path {
            RasterPath::OneWay => recurrence(&forth, &forth, lines),
            RasterPath::Zigzag => recurrence(&forth, &self.couplings_back(alpha, q), lines),
        }
    }

    /// Log of how much ripples grow in a line after so many.
    fn grown(&self, alpha: f64, q: f64, lines: usize) -> f64 {
        self.recurrence(alpha, q, lines).0
    }

    /// The same, of the fastest wave, or of the two that are complex conjugate: from the last lines, which obey
    /// y_n = λ y_{n-k}, or y_n = (λ + λ*) y_{n-k} - |λ|² y_{n-2k}, k = 2 on a zigzag.
    fn fastest(&self, alpha: f64, q: f64, waves: usize) -> f64 {
        let (_, last) = self.recurrence(alpha, q, 30_000);
        let step = if self.path == RasterPath::Zigzag { 2 } else { 1 };
        let [now, before, earlier] = [0, 1, 2].map(|i: usize| last[last.len() - 1 - i * step]);
        let square = if waves == 1 {
            (now / before).norm_sqr()
        } else {
            let area = |a: Complex64, b: Complex64| (a * b.conj()).im;
            -area(now, before) / area(earlier, before)
        };
        0.5 * square.ln() / step as f64
    }
}

/// Lines one after another, each line's number its answer to those before it, from a first one that is 1: log of how much
/// they grow in a line on the second half of them, and the last lines, up to a common factor.
fn recurrence(couplings: &[Complex64], back: &[Complex64], lines: usize) -> (f64, Vec<Complex64>) {
    let most = couplings.len();
    let mut tracks = vec![Complex64::new(1.0, 0.0)];
    let (mut log, mut middle) = (0.0, 0.0);
    for n in 1..=lines {
        let these = if n % 2 == 1 { back } else { couplings };
        let next = tracks.iter().rev().zip(these).map(|(a, c)| a * c).sum();
        tracks.push(next);
        if tracks.len() > most + 20 {
            tracks.drain(..20);
            let size = tracks.iter().map(|a| a.norm()).fold(0.0, f64::max);
            if size < 1e-250 {
                return (f64::NEG_INFINITY, vec![]);
            }
            tracks.iter_mut().for_each(|a| *a /= size);
            log += size.ln();
        }
        if n == lines / 2 {
            middle = log + size_of(&tracks, most).ln();
        }
    }
    let end = log + size_of(&tracks, most).ln();
    let rate = (end - middle) / (lines - lines / 2) as f64;
    // What has faded to nothing does not grow.
    (if rate.is_nan() { f64::NEG_INFINITY } else { rate }, tracks)
}

fn size_of(tracks: &[Complex64], most: usize) -> f64 {
    tracks.iter().rev().take(most).map(|a| a.norm_sqr()).sum::<f64>().sqrt()
}

/// That found is a threshold, and the lowest: at its q the recurrence grows above and fades below, by so much as it
/// should at 1e-8 from it; and a little below nothing grows at any of many q, far from that of a single line and close.
fn is_the_threshold(slow: &Slow, found: &RasterCritical) {
    let name = format!("{} {} {:?}: {found:?}", slow.r, slow.pitch, slow.path);
    let RasterCritical { alpha, q, certificate, .. } = *found;
    assert_eq!(certificate.growing_below, Some(0), "{name}");
    assert!(matches!(certificate.growing_above, Some(1 | 2)), "{name}");
    let margin = certificate.margin;
    let waves = certificate.growing_above.unwrap();
    let growth = |part: f64| slow.fastest(alpha * part, q, waves);
    let (below, above) = (growth(1.0 - margin), growth(1.0 + margin));
    assert!(below < -1e-4 && above > 1e-4, "{name}: {below:e} {above:e}");
    // The zero between them, straight on.
    let off = growth(1.0) * 2.0 * margin / (above - below);
    assert!(off.abs() < 1e-8, "{name}: {off:e}");
    let single =
        critical(&Wider::default(), &TipFunction::of_footprint(slow_footprint(slow)), slow.r)
            .unwrap();
    let middle = 2.0 * PI / single.wavelength;
    let wide = (1..120).map(|i| 0.05 * f64::from(i));
    let close = (0..60).flat_map(|i| {
        let off = 0.4 * 10_f64.powf(-0.15 * f64::from(i));
        [middle - off, middle + off, q - off, q + off]
    });
    for other in wide.chain(close).filter(|q| *q > 0.0) {
        let growth = slow.grown(alpha * (1.0 - margin), other, 6000);
        assert!(growth < 0.0, "{name}: {growth:e} at {other}");
    }
}

fn slow_footprint(slow: &Slow) -> Footprint {
    let terms: Vec<Gaussian2d> =
        slow.terms.iter().copied().filter(|g| g.amplitude.abs() > 0.0).collect();
    if let Ok(even) = Footprint::gaussian_sum(&terms) {
        return even;
    }
    let along =
        |g: &Gaussian2d| Gaussian { amplitude: g.amplitude, center: g.center, width: g.width };
    let along = TipFunction::asymmetric_sum(terms.iter().map(along).collect()).unwrap();
    Footprint::separable(along, terms[0].width_y).unwrap()
}

/// The values that the issue on wide pitches gives (found by counting zeros of the determinant).
#[test]
fn thresholds_of_a_zigzag_at_a_wide_pitch_are_those_known() {
    for (beta, r, alpha) in [
        (1.0, 1.0, 1.050_997_0),
        (0.0, 0.5, 0.699_324_2),
        (1.0, 0.5, 0.369_064_2),
        (1.0, 2.0, 3.587_279_5),
    ] {
        let slow = Slow::triple(beta, 1.0, r, 3.0, RasterPath::Zigzag);
        let found = slow.raster().critical(RasterPath::Zigzag).unwrap();
        assert!((found.alpha / alpha - 1.0).abs() < 1e-7, "{found:?}");
        is_the_threshold(&slow, &found);
    }
}

/// Pitches, r, β and widths across the lines at random, both paths.
#[test]
fn no_threshold_is_above_the_first() {
    let mut seed = 12_345_u64;
    let mut random = |low: f64, high: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((seed >> 11) as f64 / (1_u64 << 53) as f64)
    };
    for case in 0..16 {
        let beta = [0.0, 1.0, 0.5, -0.6][case % 4];
        let r = random(-2.0, 2.0).exp2();
        let width_y = if case % 3 == 0 { random(0.6, 1.6) } else { 1.0 };
        let pitch = random(0.12_f64.ln(), 5.0_f64.ln()).exp() * width_y;
        for path in [RasterPath::OneWay, RasterPath::Zigzag] {
            let slow = Slow::triple(beta, width_y, r, pitch, path);
            is_the_threshold(&slow, &slow.raster().critical(path).unwrap());
        }
    }
}

/// Either half one way, and both on a zigzag, whose ways are not mirror images: the halves alone have other thresholds.
#[test]
fn thresholds_of_a_tip_with_two_sides_are_the_first_too() {
    let slope = |c: f64| c * (-0.5 * c * c).exp();
    for (ahead, r, pitch) in [(-0.4, 1.0, 0.7), (-0.8, 0.6, 1.1), (0.3, 1.5, 0.4), (-0.4, 1.0, 3.0)]
    {
        let lobe = |amplitude, center| Gaussian2d {
            amplitude,
            center,
            width: 1.0,
            center_y: 0.0,
            width_y: 0.9,
        };
        let behind = ahead * slope(2.0) / slope(1.5);
        let terms = vec![lobe(1.0, 0.0), lobe(ahead, 2.0), lobe(behind, -1.5)];
        let of = |path| Slow { terms: terms.clone(), r, pitch, path };
        let [forth, back, zigzag] =
            [of(RasterPath::OneWay), of(RasterPath::OneWay).mirrored(), of(RasterPath::Zigzag)];
        let found = [&forth, &back, &zigzag].map(|slow| {
            let found = slow.raster().critical(slow.path).unwrap();
            is_the_threshold(slow, &found);
            found.alpha
        });
        // From the other end it is the same zigzag.
        let turned = zigzag.mirrored().raster().critical(RasterPath::Zigzag).unwrap().alpha;
        assert!((turned / found[2] - 1.0).abs() < 1e-9, "{turned} {found:?}");
        println!("{ahead} {r} {pitch}: {found:?}");
        assert!((found[0] / found[1] - 1.0).abs() > 0.05, "{found:?}");
    }
}

/// One side alone: the root of (30) with the transform by Simpson's rule over x > 0, and the growth exponents there.
#[test]
fn the_threshold_of_a_line_is_that_of_the_side_ahead() {
    let slope = |c: f64| c * (-0.5 * c * c).exp();
    let lobe = |amplitude, center| Gaussian2d {
        amplitude,
        center,
        width: 1.0,
        center_y: 0.0,
        width_y: 1.0,
    };
    let terms = vec![lobe(1.0, 0.0), lobe(-0.4, 2.0), lobe(-0.4 * slope(2.0) / slope(1.5), -1.5)];
    let slow = Slow { terms, r: 0.8, pitch: 1.0, path: RasterPath::OneWay };
    let found = [slow.mirrored(), slow].map(|slow| {
        let tip = slow_footprint(&slow).path().clone();
        let at = critical(&Wider::default(), &tip, slow.r).unwrap();
        let q = at.omega / slow.r;
        let left = Complex64::new(1.0, slow.r * q) + at.alpha / slow.r * slow.transform(q);
        assert!(left.norm() < 1e-9, "{left}");
        let model = Model::new(tip, at.alpha, slow.r).unwrap();
        let root = leading_roots(&model, 2).unwrap().roots[0];
        assert!((root - Complex64::new(0.0, at.omega)).norm() < 1e-10, "{root} {at:?}");
        at.alpha
    });
    println!("{found:?}");
    assert!((found[0] / found[1] - 1.0).abs() > 0.1, "{found:?}");
}

/// What is not derived for sides that differ is refused.
#[test]
fn a_zigzag_of_two_sides_under_a_depth_limit_is_refused() {
    let lobes = [
        (1.0, 0.0),
        (-0.4, 2.0),
        (-0.4 * 2.0 * (-2.0_f64).exp() / (1.5 * (-1.125_f64).exp()), -1.5),
    ];
    let term = |(amplitude, center)| Gaussian { amplitude, center, width: 1.0 };
    let tip = TipFunction::asymmetric_sum(lobes.map(term).to_vec()).unwrap();
    let footprint = Footprint::separable(tip, 1.0).unwrap();
    let limited = Wider { depth_limit: Some(5.0), ..Wider::default() };
    let raster = Raster::new(&footprint, limited, (1.0, 0.5), 1.0).unwrap();
    assert!(raster.critical(RasterPath::OneWay).is_ok());
    assert!(matches!(raster.critical(RasterPath::Zigzag), Err(StabilityError::EvenOnly(_))));
    assert!(matches!(raster.with_stiffness_across(1.0), Err(StabilityError::EvenOnly(_))));
}

/// Footprints that are no product, some of them raised beside the path, so that lines push each other both ways.
#[test]
fn thresholds_of_footprints_that_are_no_product_are_the_first_too() {
    let mut complex = 0;
    for (ring, width_y, r, pitch) in
        [(-0.3, 0.8, 1.0, 0.7), (-0.6, 0.5, 0.6, 1.1), (0.4, 0.6, 2.0, 0.5), (-0.9, 0.9, 1.5, 1.9)]
    {
        let at = |amplitude, center, center_y, width, width_y| Gaussian2d {
            amplitude,
            center,
            width,
            center_y,
            width_y,
        };
        let side = |center_y| at(ring, 0.0, center_y, 1.2, width_y);
        let terms = vec![
            at(1.0, 0.0, 0.0, 1.0, 0.9),
            side(1.7),
            side(-1.7),
            at(-0.2, 1.9, 0.0, 0.8, 1.1),
            at(-0.2, -1.9, 0.0, 0.8, 1.1),
        ];
        for path in [RasterPath::OneWay, RasterPath::Zigzag] {
            let slow = Slow { terms: terms.clone(), r, pitch, path };
            let found = slow.raster().critical(path).unwrap();
            is_the_threshold(&slow, &found);
            complex += usize::from(found.certificate.growing_above == Some(2));
        }
    }
    // On some zigzags it is not at z = ±1 that the first wave grows, but at two phases at once.
    assert!(complex > 0);
}

/// Thresholds rise with the pitch to that of a single line, and none is above it; a zigzag's is above that of one-way lines.
#[test]
fn lines_that_hardly_feel_each_other_are_nearly_single_lines() {
    for (beta, r) in [(0.0, 1.0), (1.0, 1.0), (1.0, 0.3), (0.0, 3.0), (0.0, 100.0), (1.0, 0.01)] {
        let tip = TipFunction::triple_gaussian(beta, 1.0).unwrap();
        let alone = critical(&Wider::default(), &tip, r).unwrap();
        let footprint = Footprint::separable(tip, 1.0).unwrap();
        let mut before = 0.0;
        for i in 0..40 {
            let pitch = 2.2 + 0.1 * f64::from(i);
            let raster = Raster::new(&footprint, Wider::default(), (r, pitch), 1.0).unwrap();
            let [one_way, zigzag] =
                [RasterPath::OneWay, RasterPath::Zigzag].map(|path| raster.critical(path).unwrap());
            let felt = (-0.5 * pitch * pitch).exp();
            let above = zigzag.alpha / alone.alpha - 1.0;
            assert!(zigzag.alpha > before && above < 1e-12, "{pitch}: {zigzag:?}");
            assert!(-above < 4.0 * felt, "{pitch}: {zigzag:?}");
            assert!(zigzag.alpha / one_way.alpha > 1.0 - 1e-12, "{pitch}: {zigzag:?} {one_way:?}");
            before = zigzag.alpha;
        }
    }
}

/// Under the wider law a zigzag's lines answer as one-way ones do, the way back with the complex conjugate: at the threshold
/// that recurrence neither grows nor fades. (Nonlinear runs: `crates/raster/tests/raster/wider_linear_theory.rs`.)
#[test]
fn a_zigzag_under_the_wider_law_has_its_threshold_where_ripples_neither_grow_nor_fade() {
    let round = Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap();
    let limited = Wider { depth_limit: Some(8.0), ..Wider::default() };
    let heavy = Wider { inertia: Some(0.5), ..Wider::default() };
    let both = Wider { inertia: Some(0.4), ..limited };
    for law in [limited, heavy, both] {
        for pitch in [0.3, 1.0, 2.0] {
            let raster = Raster::new(&round, law, (1.0, pitch), 1.0).unwrap();
            let [found, one_way] =
                [RasterPath::Zigzag, RasterPath::OneWay].map(|path| raster.critical(path).unwrap());
            assert!(found.alpha > one_way.alpha * (1.0 - 1e-10), "{law:?} {found:?}");
            let grown = |alpha: f64, q: f64, lines: usize| {
                let forth = raster.answers(alpha, q);
                let back: Vec<Complex64> = forth.iter().map(Complex64::conj).collect();
                recurrence(&forth, &back, lines)
            };
            assert!(grown(found.alpha, found.q, 30_000).0.abs() < 1e-9, "{law:?} {found:?}");
            let above = 1.0 + found.certificate.margin;
            assert!(grown(found.alpha * above, found.q, 30_000).0 > 1e-4);
            for i in 1..150 {
                let q = 0.02 * f64::from(i);
                assert!(grown(0.998 * found.alpha, q, 3000).0 < 0.0, "{law:?} {q}");
            }
        }
    }
    let healing = Wider { healing_time: Some(100.0), ..Wider::default() };
    let error = Raster::new(&round, healing, (1.0, 1.0), 0.5).unwrap().critical(RasterPath::Zigzag);
    assert_eq!(error, Err(StabilityError::HealingZigzag));
}

/// The transform of J0 is infinite at q = 1, and so is what lines make of a ripple beside it.
#[test]
fn a_tip_whose_transform_is_infinite_has_no_threshold() {
    let bessel = Footprint::separable(TipFunction::Bessel, 1.0).unwrap();
    let raster = Raster::new(&bessel, Wider::default(), (1.0, 1.0), 1.0).unwrap();
    assert_eq!(raster.critical(RasterPath::OneWay), Err(StabilityError::NoRipples));
}

/// d → 0: rq = erfi(|κ|/√2) and αc/d = r/(π max q² e^{-(q²+κ²)/2}); the difference falls with d.
#[test]
fn a_small_pitch_tends_to_its_limit() {
    let erfi = |x: f64| {
        let term = |(n, power): (u32, f64)| power / f64::from(2 * n + 1);
        let mut power = x;
        let mut sum = 0.0;
        for n in 0..200 {
            sum += term((n, power));
            power *= x * x / f64::from(n + 1);
        }
        2.0 / PI.sqrt() * sum
    };
    let gain = |kappa: f64| {
        let q = erfi(kappa * FRAC_1_SQRT_2);
        q * q * (-0.5 * (q * q + kappa * kappa)).exp()
    };
    let largest = (1..20_000).map(|i| gain(1e-4 * f64::from(i))).fold(0.0, f64::max);
    let off = |pitch: f64| {
        let found = gaussian(pitch).critical(RasterPath::OneWay).unwrap();
        (found.alpha / pitch - 1.0 / (PI * largest)).abs()
    };
    let (coarse, fine) = (off(0.04), off(0.02));
    assert!(fine < 0.03 && fine < 0.6 * coarse, "{coarse} {fine}");
}

/// At the threshold the recurrence from line to line neither grows nor fades, with the phase that is told; it does
/// at other α, and at other q it fades.
#[test]
fn at_the_threshold_a_ripple_neither_grows_nor_fades() {
    let triple = TipFunction::triple_gaussian(0.6, 1.0).unwrap();
    let footprint = Footprint::separable(triple, 0.7).unwrap();
    for (r, pitch) in [(1.0, 0.5), (0.4, 0.8), (2.0, 1.1)] {
        let raster = Raster::new(&footprint, Wider::default(), (r, pitch), 1.0).unwrap();
        let found = raster.critical(RasterPath::OneWay).unwrap();
        let z = raster.growth(found.alpha, found.q);
        assert!((z.norm() - 1.0).abs() < 1e-9, "{z}");
        assert!((z.arg() - found.phase_per_line).abs() < 1e-7, "{z} {found:?}");
        assert!(raster.growth(1.05 * found.alpha, found.q).norm() > 1.001);
        for part in [0.7, 0.9, 0.97, 1.03, 1.1, 1.5] {
            assert!(raster.growth(found.alpha, part * found.q).norm() < 1.0, "{part}");
        }
    }
}

/// It was not a number, and the document of it could not be read.
#[test]
fn a_ripple_does_not_grow_on_lines_that_feel_no_other_or_carve_nothing() {
    assert_eq!(gaussian(0.5).growth(0.0, 0.7), Complex64::ZERO);
    let flexible = gaussian(0.5).with_stiffness_across(0.5).unwrap();
    assert_eq!(flexible.growth(0.0, 0.7), Complex64::ZERO);
    let far = gaussian(100.0);
    assert_eq!(far.growth(0.3, 0.7), Complex64::ZERO);
    assert_eq!(far.with_stiffness_across(0.5).unwrap().growth(0.3, 0.7), Complex64::ZERO);
}

#[test]
fn another_pass_flattens_long_ripples_and_deepens_none_at_small_alpha() {
    let raster = gaussian(1.0);
    // 1 + C/D: both passes carve alike where a ripple is too fine to be felt.
    assert!((raster.repeat_gain(0.5, 8.0).norm() - 1.0).abs() < 1e-9);
    let q = 0.75;
    let (weak, strong) = (raster.repeat_gain(0.01, q), raster.repeat_gain(1.5, q));
    assert!(strong.norm() > weak.norm() && weak.norm() > 1.0, "{weak} {strong}");
}

/// Oracle: 1 + (α/r) q² f̂/D for f = J0, with f̂ = 2/√(1-q²) and G(iq) = -q²/√(1-q²) - iq; for q > 1, f̂ = 0.
#[test]
fn another_pass_with_j0_has_the_gain_of_its_closed_form() {
    let footprint = Footprint::separable(TipFunction::Bessel, 1.0).unwrap();
    for (alpha, r) in [(0.3, 1.0), (2.0, 0.4)] {
        let raster = Raster::new(&footprint, Wider::default(), (r, 1e6), 1.0).unwrap();
        for q in [0.1, 0.4, 0.9, 0.999] {
            let (ratio, pull) = (alpha / r, q * q / f64::sqrt(1.0 - q * q));
            let d = Complex64::new(1.0 - ratio * pull, r * q - ratio * q);
            let (found, wanted) = (raster.repeat_gain(alpha, q), 1.0 + 2.0 * ratio * pull / d);
            assert!(
                (found - wanted).norm() < 1e-13 * wanted.norm(),
                "{alpha} {q}: {found} {wanted}"
            );
        }
        assert_eq!(raster.repeat_gain(alpha, 1.2), Complex64::ONE);
    }
}

#[test]
fn what_is_no_pitch_is_refused() {
    let footprint = Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap();
    for pitch in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-9] {
        let error =
            Raster::new(&footprint, Wider::default(), (1.0, pitch), 1.0).unwrap_err().to_string();
        assert!(error.contains("pitch"), "{error}");
    }
    assert!(Raster::new(&footprint, Wider::default(), (-1.0, 1.0), 1.0).is_err());
}

/// Bounds that are infinite, times layers that are not felt at all, are no numbers: the search once stopped on them.
#[test]
fn a_zigzag_of_a_table_with_inertia_at_a_wide_pitch_has_the_threshold_of_its_product() {
    let [x, y] = [0.2, 0.3].map(|step| (0..30).map(|i| step * f64::from(i)).collect::<Vec<f64>>());
    let (xs, ys): (Vec<f64>, Vec<f64>) =
        y.iter().flat_map(|y| x.iter().map(move |x| (*x, *y))).unzip();
    let f = |x: f64, y: f64| (1.0 - 0.2 * x * x) * (-0.5 * (x * x + y * y)).exp();
    let values: Vec<f64> = xs.iter().zip(&ys).map(|(x, y)| f(*x, *y)).collect();
    let table = Footprint::table(&xs, &ys, &values).unwrap();
    let product = Footprint::separable(table.path().clone(), 1.0).unwrap();
    let heavy = Wider { inertia: Some(0.4), ..Wider::default() };
    let [found, wanted] = [table, product].map(|footprint| {
        let raster = Raster::new(&footprint, heavy, (2.0, 2.0), 1.0).unwrap();
        raster.critical(RasterPath::Zigzag).unwrap()
    });
    assert!((found.alpha / wanted.alpha - 1.0).abs() < 1e-7, "{found:?} {wanted:?}");
}

/// Along the imaginary axis G(p) = ∫f''e^{-px}dx over x > 0 with p = s + iq, s = 1/(rT) = 100, is -1/p + 3/p³ or so for a
/// Gaussian: of a line alone T has the sign of -Im G < 0 at every q, and e^{-100 X} = 0 of it is left for the next.
#[test]
fn lines_on_a_surface_that_heals_at_once_are_stable_for_certain() {
    let footprint = Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap();
    for (r, healing) in [(0.1, 0.1), (1.0, 0.01), (1.0, 1e-4)] {
        let law = Wider { healing_time: Some(healing), ..Wider::default() };
        let left = (-20.0 / (r * healing)).exp();
        let raster = Raster::new(&footprint, law, (r, 0.5), left).unwrap();
        let found = raster.critical(RasterPath::OneWay);
        assert_eq!(found, Err(StabilityError::NoCrossing { r }), "{healing}");
    }
}
