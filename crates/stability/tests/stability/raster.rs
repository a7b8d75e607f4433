//! Where ripples begin to grow from line to line. Judged by thresholds found by an independent prototype (a
//! spectral PDE and direct sums of the closed equation, 1e-8), by the limit of a small pitch, by a single line,
//! and by the recurrence from line to line itself.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::f64::consts::{FRAC_1_SQRT_2, PI};
use stickslip_stability::{Raster, RasterPath, critical};
use stickslip_tip::{Footprint, TipFunction, Wider};

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
    let alone = critical(&tip, 1.0).unwrap();
    for path in [RasterPath::OneWay, RasterPath::Zigzag] {
        let found = gaussian(9.0).critical(path).unwrap();
        assert!((found.alpha - alone.alpha).abs() < 1e-12 && (found.q - alone.omega).abs() < 1e-12);
    }
}

/// Between them they are nearly single lines: the thresholds rise to that of one, a zigzag's above the other's. (Lines of a
/// zigzag that hardly felt each other once had none.)
#[test]
fn lines_that_hardly_feel_each_other_are_nearly_single_lines() {
    let alone = critical(&TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap();
    let mut before = 0.0;
    for pitch in [2.2, 2.6, 3.0, 3.5, 4.0, 4.5, 5.0] {
        let raster = gaussian(pitch);
        let [one_way, zigzag] =
            [RasterPath::OneWay, RasterPath::Zigzag].map(|path| raster.critical(path).unwrap());
        let felt = (-0.5 * pitch * pitch).exp();
        assert!(zigzag.alpha > before && zigzag.alpha < alone.alpha, "{pitch}: {zigzag:?}");
        assert!((alone.alpha - zigzag.alpha) < 4.0 * felt, "{pitch}: {zigzag:?}");
        assert!((zigzag.alpha - one_way.alpha) > -1e-9, "{pitch}: {zigzag:?} {one_way:?}");
        before = zigzag.alpha;
    }
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

#[test]
fn another_pass_flattens_long_ripples_and_deepens_none_at_small_alpha() {
    let raster = gaussian(1.0);
    // 1 + C/D: both passes carve alike where a ripple is too fine to be felt.
    assert!((raster.repeat_gain(0.5, 8.0).norm() - 1.0).abs() < 1e-9);
    let q = 0.75;
    let (weak, strong) = (raster.repeat_gain(0.01, q), raster.repeat_gain(1.5, q));
    assert!(strong.norm() > weak.norm() && weak.norm() > 1.0, "{weak} {strong}");
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
