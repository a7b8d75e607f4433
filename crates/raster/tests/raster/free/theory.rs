//! Small deviations of both coordinates go from line to line as linear theory says (`Raster::with_stiffness_across`, which
//! knows nothing of runs). Weak pulses along and across on the first line, with either sign: half the difference is linear, to
//! the square of the pulses. With X and Y of even motion, A = ∫ δx e^{-iqX} dt and C = ∫ δy e^{-iqX} dt follow from the motion
//! itself:
//!
//! ```text
//!     -iqA = δ∫ e^{-iqx0} dt          C = δ∫ (y0 - Y) e^{-iqx0} dt          (A, 0, C)_n = Σ_j M_j (A, 0, C)_{n-j}
//! ```
//!
//! On the way back of a zigzag M is conjugate, and of the other sign where it couples the two coordinates.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use super::lines::{footprint, scanned};
use num_complex::Complex64;
use stickslip_raster::{Area, AreaLine, Free, Line, Path, Plan};
use stickslip_stability::{Raster, RasterPath};
use stickslip_tip::{Force, Model, Pulse, Wider};

/// Of the pulses.
const WEAK: f64 = 1e-3;

struct Case {
    beta: f64,
    alpha: f64,
    stiffness: f64,
    pitch: f64,
    path: Path,
    lines: usize,
    length: f64,
}

impl Case {
    fn plan(&self, sign: f64) -> Plan {
        let footprint = footprint(self.beta, 1.0).0;
        let pulse = |amplitude: f64, part: f64| {
            let time = part * self.length;
            let pulse = Pulse { amplitude: sign * WEAK * amplitude, time, width: 0.7 };
            Force::new(vec![pulse], None).unwrap()
        };
        let model = Model::new(footprint.path().clone(), self.alpha, 1.0).unwrap();
        let free = Free { disturbance: pulse(1.0, 0.5), ..Free::new(self.stiffness) };
        let plan = Plan::over(footprint, model, self.path, self.area());
        let mut plan = Plan { disturbance: pulse(0.7, 0.52), ..plan.with_free(free) };
        plan.law.tolerance = 3e-12;
        plan
    }

    /// Lines on which even motion is one pitch apart from the first line on: each is displaced by as much as the grooves
    /// of the lines before it push the tip aside.
    fn area(&self) -> Area {
        let volume = footprint(self.beta, 1.0).0.layers()[0].along.integral();
        let line = |n: usize| {
            let push = |j: usize| {
                let y = self.pitch * j as f64;
                self.alpha * volume * y * (-0.5 * y * y).exp()
            };
            let y = self.pitch * n as f64 + (1..=n).map(push).sum::<f64>() / self.stiffness;
            AreaLine { y, start: 0.0, length: self.length }
        };
        Area::Lines((0..self.lines).map(line).collect())
    }

    fn theory(&self) -> Raster {
        let at = (1.0, self.pitch);
        let held = Raster::new(&footprint(self.beta, 1.0).0, Wider::default(), at, 1.0).unwrap();
        held.with_stiffness_across(self.stiffness).unwrap()
    }

    /// (A, C) of every line at each q.
    fn deviations(&self, q: &[f64]) -> Vec<Vec<[Complex64; 2]>> {
        let pair = [1.0, -1.0].map(|sign| scanned(&self.plan(sign)));
        let even = |line: &Line| line.y0(0.4 * self.length);
        for (n, line) in pair[0].iter().enumerate() {
            assert!((even(line) - self.pitch * n as f64).abs() < 1e-7, "{n}: {}", even(line));
        }
        let integrals = |line: &Line, y: f64, q: f64| {
            let mut sums = [Complex64::ZERO; 2];
            for visit in line.visits() {
                let wave = Complex64::from_polar(visit.weight, -q * visit.x);
                sums[0] += wave;
                sums[1] += wave * (visit.y - y);
            }
            sums
        };
        let of = |n: usize, q: f64| {
            let y = 0.5 * (even(&pair[0][n]) + even(&pair[1][n]));
            let [up, down] = [0, 1].map(|k: usize| integrals(&pair[k][n], y, q));
            let along = (up[0] - down[0]) / Complex64::new(0.0, -2.0 * q);
            // At q = 0 what one coordinate deviates by does not act on the other, and only C is known from the motion.
            [if q > 0.0 { along } else { Complex64::ZERO }, 0.5 * (up[1] - down[1])]
        };
        q.iter().map(|q| (0..self.lines).map(|n| of(n, *q)).collect()).collect()
    }

    /// Relative error of the last line's deviations, as answers to those of all earlier lines.
    fn errors(&self, q: &[f64]) -> Vec<f64> {
        let (theory, found, last) = (self.theory(), self.deviations(q), self.lines - 1);
        let is_back = self.plan(1.0).track(last).backward;
        let error = |(found, q): (&Vec<[Complex64; 2]>, &f64)| {
            let mut wanted = [Complex64::ZERO; 2];
            let answers = theory.answers_in_plane(self.alpha, *q);
            for (m, earlier) in answers.iter().zip(found[..last].iter().rev()) {
                for (i, wanted) in wanted.iter_mut().enumerate() {
                    for (k, earlier) in earlier.iter().enumerate() {
                        let m = m[2 * i][2 * k];
                        let back = if i == k { m.conj() } else { -m.conj() };
                        *wanted += earlier * if is_back { back } else { m };
                    }
                }
            }
            let size = found[last].iter().map(|x| x.norm()).fold(0.0, f64::max);
            let miss = wanted.iter().zip(&found[last]).map(|(a, b)| (a - b).norm());
            miss.fold(0.0, f64::max) / size
        };
        found.iter().zip(q).map(error).collect()
    }
}

/// At the wave numbers of ripples, of bunching and of straight trenches, q = 0 (where lines with ∫g = 0 do not meet), somewhat below the threshold: there lines are all alike but for what
/// deviates, and what begins at the edge does not come to the middle.
#[test]
fn every_line_answers_along_and_across_as_theory_says() {
    for (name, beta, stiffness, pitch, path, lines, q) in [
        ("ripples", 0.0, 3.0, 1.0, Path::OneWay, 8, [1.0, 0.05, 0.0]),
        ("bunching", 0.0, 0.8, 1.0, Path::OneWay, 8, [0.05, 0.4, 0.0]),
        ("side lobes", 1.0, 2.0, 1.0, Path::OneWay, 8, [0.9, 1.2, 1.05]),
        ("pairs", 0.0, 1.0, 2.0, Path::OneWay, 5, [0.05, 0.4, 0.0]),
        ("there and back", 0.0, 1.0, 1.0, Path::Zigzag, 8, [0.05, 0.4, 0.0]),
    ] {
        let case = Case { beta, alpha: 1.0, stiffness, pitch, path, lines, length: 150.0 };
        let way = if path == Path::Zigzag { RasterPath::Zigzag } else { RasterPath::OneWay };
        let critical = case.theory().critical(way).unwrap();
        let case = Case { alpha: 0.6 * critical.alpha, ..case };
        let errors = case.errors(&q);
        println!("{name}, {:?}: α {:.4}, {errors:?}", critical.kind, case.alpha);
        assert!(errors.iter().all(|error| *error < 1e-6), "{name}: {errors:?}");
    }
}
