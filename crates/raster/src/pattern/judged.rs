//! The wave vector that is told, judged by patterns whose wave vector is known as they are made of it.

use super::wave::{Sheet, Wave};
use ndarray::Array2;
use std::f64::consts::{PI, TAU};

/// Evenly distributed in [0, 1): a 64-bit linear congruential generator (Knuth's MMIX), for patterns that are the same in
/// every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// Crests, and what may lie over them.
struct Made {
    q: f64,
    kappa: f64,
    pitch: f64,
    rows: usize,
    /// Columns that all lines have alike, of this amplitude.
    columns: f64,
    /// By how much crests are weaker between columns.
    modulation: f64,
    harmonic: f64,
    noise: f64,
}

const SPACING: f64 = 0.25;
const POINTS: usize = 260;
const BAND: f64 = 8.7;

impl Made {
    /// Oblique crests as micrographs have them, on as many lines as are looked at.
    fn random(random: &mut Random) -> Self {
        loop {
            let (wavelength, angle) = (random.between(2.6, 7.0), random.between(25.0, 75.0_f64));
            let k = TAU / wavelength;
            let (pitch, rows) = (random.between(0.25, 1.5), random.between(48.0, 140.0) as usize);
            let made = Self {
                q: k * angle.to_radians().sin(),
                kappa: -k * angle.to_radians().cos(),
                pitch,
                rows,
                columns: 0.0,
                modulation: 0.0,
                harmonic: 0.0,
                noise: 0.0,
            };
            // Fewer crests than these, or two lines to a crest, are not told from what all lines do alike or go the other way.
            let crests = made.kappa.abs() * pitch * rows as f64 / TAU;
            if crests > 6.0 && made.kappa.abs() * pitch < 0.8 * PI {
                return made;
            }
        }
    }

    fn sheet(&self, random: &mut Random) -> Sheet {
        let (period, phase) = (random.between(8.0, 12.0), random.between(0.0, TAU));
        let heights = Array2::from_shape_fn((self.rows, POINTS), |(n, i)| {
            let (x, y) = (SPACING * i as f64, self.pitch * n as f64);
            let (crest, column) = (self.q * x + self.kappa * y + phase, TAU * x / period);
            let wave = crest.cos() + self.harmonic * (2.0 * crest + 0.7).cos();
            let wave = wave * (1.0 + self.modulation * column.cos());
            wave + self.columns * (column + 1.0).cos() + self.noise * random.between(-1.7, 1.7)
        });
        Sheet::new(heights, (0.0, SPACING), self.pitch, BAND)
    }

    /// What is told, in parts of what a sheet of this size resolves.
    fn error(&self, random: &mut Random) -> f64 {
        let sheet = self.sheet(random);
        let Some(found) = Wave::of_ripples(&sheet) else { return f64::INFINITY };
        let (dq, dk) = (TAU / (SPACING * POINTS as f64), TAU / (self.pitch * self.rows as f64));
        ((found.q - self.q) / dq).hypot((found.kappa - self.kappa) / dk)
    }
}

/// How many of 60 patterns are told wrong, by more than a half of what their sheet resolves.
fn missed(what: impl Fn(&mut Made)) -> usize {
    let mut random = Random(7);
    let one = |_| {
        let mut made = Made::random(&mut random);
        what(&mut made);
        made.error(&mut random)
    };
    (0..60).map(one).filter(|error| *error > 0.5).count()
}

#[test]
fn crests_are_told_whatever_lies_over_them() {
    let nothing = |_: &mut Made| {};
    assert_eq!(missed(nothing), 0);
    assert_eq!(missed(|made| made.noise = 1.0), 0);
    // As strong again: nine times the power, of which ten are too much.
    assert_eq!(missed(|made| made.columns = 2.5), 0);
    assert_eq!(missed(|made| made.modulation = 0.9), 0);
    // A sharp crest is as long as its fundamental, even if that is the weaker.
    assert_eq!(missed(|made| made.harmonic = 1.2), 0);
    let all = |made: &mut Made| {
        (made.noise, made.columns, made.modulation, made.harmonic) = (0.5, 1.5, 0.8, 0.5);
    };
    assert_eq!(missed(all), 0);
}

/// Columns far stronger than the crests are what is told.
#[test]
fn columns_that_drown_the_crests_are_told_instead() {
    let mut random = Random(3);
    for _ in 0..40 {
        let made = Made { columns: 6.0, ..Made::random(&mut random) };
        let found = Wave::of_ripples(&made.sheet(&mut random)).unwrap();
        assert!(found.kappa.abs() < 0.1 * found.q, "{found:?}");
    }
}

/// The limit of the rule: crests that are cut into pieces all the way, so that what is left of them are two side bands, are
/// told by the longer of these.
#[test]
fn crests_without_a_carrier_are_told_by_a_side_band() {
    let mut random = Random(5);
    let made = Made {
        q: 1.3,
        kappa: -1.2,
        pitch: 0.5,
        rows: 100,
        modulation: 1e4,
        ..Made::random(&mut random)
    };
    let found = Wave::of_ripples(&made.sheet(&mut random)).unwrap();
    assert!((found.kappa - made.kappa).abs() < 0.02 && found.q < made.q - 0.4, "{found:?}");
}
