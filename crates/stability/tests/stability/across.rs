//! Rasters of a tip that gives way across the lines. Judged by thresholds of two prototypes that share no code with this
//! project (PHYSICS.md, section 8), by the equations of one line after another, carried out here in the coordinates along and
//! across and the weight with transforms by Simpson's rule ([`Slow`]), and these by a line integrated in time ([`Timed`]).

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_stability::{
    Raster, RasterCritical, RasterKind, RasterPath, Snaking, StabilityError,
};
use stickslip_tip::{Footprint, Gaussian2d, TipFunction, Wider};

const PATHS: [RasterPath; 2] = [RasterPath::OneWay, RasterPath::Zigzag];

fn gaussian(pitch: f64, stiffness: f64) -> Raster {
    Slow::triple(0.0, 1.0, (1.0, pitch), stiffness).raster()
}

/// The table of PHYSICS.md, section 8, to all digits shown.
#[test]
fn thresholds_are_those_of_the_prototypes() {
    use RasterKind::{Bunching, Ripples};
    let table = [
        // κ_y, α, crests; and the α of lines that bunch at κ_y = 1.
        (0.25, [(10.0, 0.21976, 42.4), (3.0, 0.22506, 35.5)], 0.10816, 5e-6),
        (0.5, [(10.0, 0.43056, 42.7), (3.0, 0.44986, 35.7)], 0.21632, 5e-6),
        (1.0, [(10.0, 0.83391, 43.8), (3.0, 0.89942, 35.7)], 0.43255, 5e-6),
    ];
    for (pitch, ripples, bunching, digits) in table {
        for (stiffness, alpha, angle) in ripples {
            let found = gaussian(pitch, stiffness).critical(RasterPath::OneWay).unwrap();
            assert!((found.alpha - alpha).abs() < digits, "{found:?}");
            assert!((found.crest_angle.unwrap() - angle).abs() < 0.05, "{found:?}");
            assert_eq!(found.kind, Ripples);
        }
        let found = gaussian(pitch, 1.0).critical(RasterPath::OneWay).unwrap();
        assert!((found.alpha - bunching).abs() < digits, "{found:?}");
        assert_eq!(found.kind, Bunching);
    }
    // κ_y = ∞
    for (pitch, alpha, angle) in
        [(0.25, 0.21494, 45.2), (0.5, 0.41879, 46.0), (1.0, 0.80517, 48.3), (2.0, 1.52378, 58.0)]
    {
        let held = Slow::triple(0.0, 1.0, (1.0, pitch), 1.0).held();
        let found = held.critical(RasterPath::OneWay).unwrap();
        assert!((found.alpha - alpha).abs() < 5e-6, "{found:?}");
        assert!((found.crest_angle.unwrap() - angle).abs() < 0.05, "{found:?}");
    }
    let wide = |stiffness: f64| gaussian(2.0, stiffness).critical(RasterPath::OneWay).unwrap();
    let found = wide(10.0);
    assert!(
        (found.alpha - 1.55136).abs() < 5e-6 && (found.crest_angle.unwrap() - 51.9).abs() < 0.05
    );
    // Pairs: straight lines, of which every other one is displaced.
    for (stiffness, alpha, digits) in [(3.0, 1.474, 5e-4), (1.0, 0.4913, 5e-5)] {
        let found = wide(stiffness);
        assert!((found.alpha - alpha).abs() < digits, "{found:?}");
        assert_eq!((found.kind, found.q, found.phase_per_line.abs()), (Bunching, 0.0, PI));
        // At q = 0 and z = -1: α = κ_y r/(ĝ(0) Σ h''(jd)(1 - (-1)^j)).
        let h = |y: f64| (y * y - 1.0) * (-0.5 * y * y).exp();
        let odd: f64 = (0..5).map(|i| 2.0 * h(2.0 * f64::from(2 * i + 1))).sum();
        assert!((found.alpha * (2.0 * PI).sqrt() * odd / stiffness - 1.0).abs() < 1e-13);
    }
}

/// κ_y → 0: α = κ_y r/(ĝ(0) max Re Σ h''(jd)(1 - z^{-j})), q = (κ_y/r) Im/Re of that sum; the difference falls with κ_y².
#[test]
fn a_soft_spring_tends_to_its_limit() {
    for (r, pitch) in [(1.0, 0.5), (0.7, 1.0)] {
        let sum = |theta: f64| -> Complex64 {
            let term = |j: i32| {
                let y = pitch * f64::from(j);
                let turn = Complex64::from_polar(1.0, -theta * f64::from(j));
                (1.0 - turn) * ((y * y - 1.0) * (-0.5 * y * y).exp() * (2.0 * PI).sqrt())
            };
            (1..30).map(term).sum()
        };
        let phases = (0..400_000).map(|i| PI * f64::from(i) / 4e5);
        let best = phases.map(sum).max_by(|a, b| a.re.total_cmp(&b.re)).unwrap();
        let off = |stiffness: f64| {
            let raster = Slow::triple(0.0, 1.0, (r, pitch), stiffness).raster();
            let found = raster.critical(RasterPath::OneWay).unwrap();
            let slope = (found.q * r / stiffness).abs() / (best.im / best.re).abs() - 1.0;
            assert!(slope.abs() < stiffness + 1e-3, "{found:?} {slope}");
            found.alpha * best.re / (stiffness * r) - 1.0
        };
        let [coarse, fine] = [off(0.02), off(0.01)];
        assert!((coarse / fine - 4.0).abs() < 0.1, "{coarse:e} {fine:e}");
        assert!(off(1e-4).abs() < 1e-10);
    }
}

/// κ_y → ∞: the threshold of a tip held on its line, at first order in 1/κ_y.
#[test]
fn a_stiff_spring_tends_to_a_tip_held_on_its_line() {
    let limited = Wider { depth_limit: Some(8.0), ..Wider::default() };
    let healing = Wider { healing_time: Some(40.0), ..Wider::default() };
    let both = Wider { depth_limit: Some(9.0), ..healing };
    for law in [Wider::default(), limited, healing, both] {
        for path in PATHS {
            if path == RasterPath::Zigzag && law.healing_time.is_some() {
                continue;
            }
            let slow =
                Slow { law, left: law.left_after(30.0), ..Slow::triple(0.4, 1.0, (1.0, 0.8), 1.0) };
            let held = slow.held().critical(path).unwrap();
            let off = |stiffness: f64| {
                let raster = slow.held().with_stiffness_across(stiffness).unwrap();
                raster.critical(path).unwrap().alpha / held.alpha - 1.0
            };
            let [coarse, fine] = [off(1e3), off(2e3)];
            assert!((coarse / fine - 2.0).abs() < 0.02, "{law:?} {path:?} {coarse} {fine}");
            assert!(off(1e8).abs() < 1.1e-5 * coarse.abs() + 1e-12, "{law:?} {path:?}");
        }
    }
}

/// Lines far apart are single lines, which snake where their theory says.
#[test]
fn lines_far_apart_snake_as_a_single_line() {
    for (stiffness, kind) in [(0.3, RasterKind::Snaking), (3.0, RasterKind::Ripples)] {
        let slow = Slow::triple(1.0, 1.0, (1.0, 12.0), stiffness);
        let snaking = Snaking::new(&slow.footprint(), Wider::default(), (1.0, stiffness)).unwrap();
        let snaking = snaking.critical().unwrap().unwrap();
        let ripples = slow.held().critical(RasterPath::OneWay).unwrap();
        for path in PATHS {
            let found = slow.raster().critical(path).unwrap();
            assert!((found.alpha - snaking.alpha.min(ripples.alpha)).abs() < 1e-11, "{found:?}");
            assert_eq!(found.kind, kind);
            let near = Slow { pitch: 5.5, ..Slow::triple(1.0, 1.0, (1.0, 12.0), stiffness) };
            let both = near.raster().thresholds(path).unwrap();
            let of = |kind| both.iter().find(|found| found.kind == kind).unwrap().alpha;
            // Lines feel each other by e^{-d²/2} d² = 8e-6.
            assert!((of(RasterKind::Snaking) / snaking.alpha - 1.0).abs() < 3e-5, "{both:?}");
            assert!((of(RasterKind::Ripples) / ripples.alpha - 1.0).abs() < 3e-5, "{both:?}");
        }
    }
}

/// (along, weight, across)
type Deviation = [Complex64; 3];
type Matrix = [[Complex64; 3]; 3];

/// Σ a exp(-(x-c)²/2w²) exp(-(y-d)²/2v²), and what one line after another answers to those before it.
#[derive(Clone)]
struct Slow {
    terms: Vec<Gaussian2d>,
    r: f64,
    pitch: f64,
    stiffness: f64,
    law: Wider,
    /// e^{-X/(rT)}
    left: f64,
}

impl Slow {
    fn triple(beta: f64, width_y: f64, (r, pitch): (f64, f64), stiffness: f64) -> Self {
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
        Self { terms, r, pitch, stiffness, law: Wider::default(), left: 1.0 }
    }

    fn footprint(&self) -> Footprint {
        Footprint::gaussian_sum(&self.terms).unwrap()
    }

    fn held(&self) -> Raster {
        Raster::new(&self.footprint(), self.law, (self.r, self.pitch), self.left).unwrap()
    }

    fn raster(&self) -> Raster {
        self.held().with_stiffness_across(self.stiffness).unwrap()
    }

    /// The derivative of this order in y of exp(-(y-d)²/2v²).
    fn across(g: &Gaussian2d, y: f64, order: usize) -> f64 {
        let z = (y - g.center_y) / g.width_y;
        let polynomial = [1.0, -z, z * z - 1.0][order];
        polynomial * (-0.5 * z * z).exp() / g.width_y.powi(order as i32)
    }

    /// ∫_0^∞ of derivatives of f, (x, y) times, along y = 0, e^{-px}dx: one-sided, by Simpson's rule.
    fn own(&self, p: Complex64, (in_x, in_y): (usize, usize)) -> Complex64 {
        let f = |x: f64| -> f64 {
            let term = |g: &Gaussian2d| {
                let z = (x - g.center) / g.width;
                let polynomial = [1.0, -z, z * z - 1.0][in_x];
                let along = polynomial * (-0.5 * z * z).exp() / g.width.powi(in_x as i32);
                g.amplitude * along * Self::across(g, 0.0, in_y)
            };
            self.terms.iter().map(term).sum()
        };
        let panels = 1600;
        let h = 16.0 / f64::from(panels);
        let term = |i: i32| {
            let weight = if i == 0 || i == panels { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            let x = h * f64::from(i);
            (-p * x).exp() * (weight * f(x))
        };
        (0..=panels).map(term).sum::<Complex64>() * (h / 3.0)
    }

    /// c^j ∫ of derivatives of f along y = jd, e^{-px}dx, over all x: by parts p to the power of those in x.
    fn beside(&self, p: Complex64, j: usize, (in_x, in_y): (usize, usize)) -> Complex64 {
        let term = |g: &Gaussian2d| {
            let along = (p * p * (0.5 * g.width * g.width) - p * g.center).exp()
                * (g.amplitude * g.width * (2.0 * PI).sqrt());
            along * p.powi(in_x as i32) * Self::across(g, self.pitch * j as f64, in_y)
        };
        self.terms.iter().map(term).sum::<Complex64>() * self.left.powi(j as i32)
    }

    fn felt(&self) -> usize {
        let far = self.terms.iter().map(|g| g.center_y + 9.0 * g.width_y).fold(0.0, f64::max);
        (far / self.pitch).ceil() as usize
    }

    fn fading(&self) -> f64 {
        self.law.healing_time.map_or(0.0, |time| 1.0 / (self.r * time))
    }

    /// a = αw0 and ±1/b, from the height under the tip -(a/r)(φ(s) + E).
    fn weighted(&self, alpha: f64) -> (f64, f64) {
        let Some(limit) = self.law.depth_limit else { return (alpha, 0.0) };
        let s = self.fading().into();
        let beside: Complex64 = (1..=self.felt()).map(|j| self.beside(s, j, (0, 0))).sum();
        let depth = (self.own(s, (0, 0)) + beside).re / self.r;
        let (mut low, mut high) = (0.0, alpha);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            let more = middle * (middle * depth.abs() / limit).exp() < alpha;
            if more { low = middle } else { high = middle }
        }
        (0.5 * (low + high), -depth.signum() / limit)
    }

    /// Matrices by which a line answers to those before it, on a way there and on a way back.
    ///
    /// A groove Σ_m (a/r) ∫ e^{-s z} F(z, …) dz of the depth, F = f, or of the forces, F = f_x, f_y, deviates by F_x (A_n -
    /// A_m e^{-iqz}) + F_y (C_n - C_m e^{-iqz}) + F B_m e^{-iqz}. On the way back z and with it F_x changes its sign.
    fn answers(&self, alpha: f64, q: f64) -> [Vec<Matrix>; 2] {
        let s = self.fading();
        let (a, beta) = self.weighted(alpha);
        let (ratio, p) = (a / self.r, Complex64::new(s, q));
        let zero = Complex64::ZERO;
        // Of the forces along, of the depth, and across: how F is differentiated.
        let sorts = [(1, 0), (0, 0), (0, 1)];
        let mut even = [[zero; 3]; 3];
        let mut felt = vec![];
        for j in 1..=self.felt() {
            let mut answer = [[zero; 3]; 3];
            for (row, (x, y)) in sorts.into_iter().enumerate() {
                even[row][0] += self.beside(s.into(), j, (x + 1, y));
                even[row][2] += self.beside(s.into(), j, (x, y + 1));
                answer[row][0] = -self.beside(p, j, (x + 1, y));
                answer[row][1] = self.beside(p, j, (x, y));
                answer[row][2] = -self.beside(p, j, (x, y + 1));
            }
            felt.push(answer);
        }
        let drag = Complex64::new(0.0, q * self.r);
        let mass = self.law.inertia.unwrap_or(0.0) * (q * self.r).powi(2);
        [1.0, -1.0].map(|sign| {
            let way = |z: Complex64| if sign > 0.0 { z } else { z.conj() };
            let mut own = even;
            for (row, (x, y)) in sorts.into_iter().enumerate() {
                // In x of odd order they change their sign with the direction; in y they vanish.
                let along = |in_x: usize| if in_x % 2 == 1 { sign } else { 1.0 };
                if y == 0 {
                    own[row][0] += (self.own(s.into(), (x + 1, 0)) - way(self.own(p, (x + 1, 0))))
                        * along(x + 1);
                    own[row][1] += way(self.own(p, (x, 0))) * along(x);
                } else {
                    own[row][2] += self.own(s.into(), (x, 2)) - way(self.own(p, (x, 2)));
                }
            }
            let weights = [ratio, ratio * beta, ratio];
            let bare = [way(drag) + 1.0 - mass, Complex64::ONE, way(drag) + self.stiffness];
            let mut p = own;
            for row in 0..3 {
                p[row] = own[row].map(|own| -own * weights[row]);
                p[row][row] += bare[row];
            }
            let inverse = inverse(&p);
            let answer = |felt: &Matrix| {
                let mut felt = *felt;
                (0..3).for_each(|row| felt[row] = felt[row].map(|x| x * weights[row]));
                times(&inverse, &felt)
            };
            felt.iter().map(answer).collect()
        })
    }

    /// Log of how much deviations grow in a line after so many, and the last lines up to a factor.
    fn recurrence(
        &self,
        path: RasterPath,
        (alpha, q): (f64, f64),
        lines: usize,
    ) -> (f64, Vec<Deviation>) {
        let ways = self.answers(alpha, q);
        let most = self.felt();
        let c = Complex64::new;
        // No line a multiple of the other, so that two real recurrences do not go in step.
        let mut tracks = vec![
            [c(1.0, 0.2), c(0.0, 0.0), c(0.6, -0.5)],
            [c(0.3, -0.8), c(0.0, 0.0), c(0.2, 0.9)],
        ];
        let (mut log, mut middle) = (0.0, 0.0);
        let size = |tracks: &[Deviation]| {
            tracks.iter().rev().take(most).flatten().map(Complex64::norm_sqr).sum::<f64>().sqrt()
        };
        for n in 2..=lines {
            let way = &ways[if path == RasterPath::Zigzag { n % 2 } else { 0 }];
            let mut next = [Complex64::ZERO; 3];
            for (m, track) in way.iter().zip(tracks.iter().rev()) {
                for (next, row) in next.iter_mut().zip(m) {
                    *next += row.iter().zip(track).map(|(m, x)| m * x).sum::<Complex64>();
                }
            }
            tracks.push(next);
            if tracks.len() > most + 20 {
                tracks.drain(..20);
                let whole = size(&tracks);
                if whole < 1e-250 {
                    return (f64::NEG_INFINITY, vec![]);
                }
                tracks.iter_mut().flatten().for_each(|x| *x /= whole);
                log += whole.ln();
            }
            if n == lines / 2 {
                middle = log + size(&tracks).ln();
            }
        }
        let rate = (log + size(&tracks).ln() - middle) / (lines - lines / 2) as f64;
        (if rate.is_nan() { f64::NEG_INFINITY } else { rate }, tracks)
    }

    /// The same of the fastest wave, or of two whose z are complex conjugate, from the last lines of one coordinate: y_n =
    /// λ y_{n-k}, or y_n = (λ + λ*) y_{n-k} - |λ|² y_{n-2k}, k = 2 on a zigzag.
    fn fastest(&self, path: RasterPath, at: (f64, f64), waves: usize) -> f64 {
        let (_, last) = self.recurrence(path, at, 20_000);
        let step = if path == RasterPath::Zigzag { 2 } else { 1 };
        let end = last[last.len() - 1];
        let i = if end[0].norm() > end[2].norm() { 0 } else { 2 };
        let [now, before, earlier] = [0, 1, 2].map(|n: usize| last[last.len() - 1 - n * step][i]);
        let square = if waves == 1 {
            (now / before).norm_sqr()
        } else {
            let area = |a: Complex64, b: Complex64| (a * b.conj()).im;
            -area(now, before) / area(earlier, before)
        };
        0.5 * square.ln() / step as f64
    }
}

/// One line over the grooves of others, integrated in time with its own past: none of it linearised.
struct Timed<'a> {
    slow: &'a Slow,
    /// 1 on a way there, -1 on a way back.
    way: f64,
    /// αw0
    a: f64,
    q: f64,
    /// Which line before is no even one, and its deviation: e^{iqx} times this.
    other: (usize, Deviation),
}

/// Where, on which line, αw times a time, and how long ago.
type Visit = [f64; 4];

impl Timed<'_> {
    /// The height under a tip at (x, y), and the forces along and across.
    fn groove(&self, (x, y): (f64, f64), visits: impl Iterator<Item = Visit>) -> [f64; 3] {
        let heal = self.slow.law.healing_time.map_or(0.0, |time| 1.0 / time);
        let mut sums = [0.0; 3];
        for [at, line, weight, ago] in visits {
            let part = weight * (-heal * ago).exp();
            for g in &self.slow.terms {
                let z = (x - at - g.center) / g.width;
                let bell = g.amplitude * (-0.5 * z * z).exp() * part;
                let [h, slope] = [0, 1].map(|order: usize| Slow::across(g, y - line, order));
                sums =
                    [sums[0] - bell * h, sums[1] - bell * z / g.width * h, sums[2] + bell * slope];
            }
        }
        sums
    }

    /// Visits of the lines before near X = ±rt, by the trapezoidal rule, which of Gaussians has no error to speak of.
    fn before(&self, t: f64, is_even: bool) -> Vec<Visit> {
        let Slow { r, pitch, law, left, .. } = *self.slow;
        let spacing = 0.5;
        let middle = (self.way * r * t / spacing).round();
        let visit = |lines: usize, i: i32| {
            let x = spacing * (middle + f64::from(i));
            let here = Complex64::from_polar(1.0, self.q * x);
            let (j, deviation) = self.other;
            let deviates = lines == j && !is_even;
            let [along, weight, across] =
                deviation.map(|part| if deviates { (part * here).re } else { 0.0 });
            // c = e^{-X/(rT)} for every line between; without healing it does not matter when.
            let lines = lines as f64;
            let ago = law.healing_time.map_or(0.0, |time| t - x / r - time * left.ln() * lines);
            [x + along, across - pitch * lines, self.a * (1.0 + weight) * spacing / r, ago]
        };
        let lines = 1..=self.slow.felt();
        lines
            .flat_map(|line| (-20..=20).map(move |i| (line, i)))
            .map(|(l, i)| visit(l, i))
            .collect()
    }

    /// (along, weight, across) of this line, what of them goes as e^{iqx} when all else has faded: by Heun's method, and the
    /// trapezoidal rule over its past, in so many steps a period.
    fn answer(&self, steps: usize, periods: usize) -> Deviation {
        let Slow { r, stiffness, law, .. } = *self.slow;
        let step = 2.0 * PI / (self.q * r) / steps as f64;
        let past = (10.0 / (r * step)) as usize;
        let place = |n: i64| self.way * r * step * n as f64;
        // Where this line was, and w over that of even motion, an even past before the first.
        let mut track: Vec<[f64; 3]> = vec![];
        let visits = |track: &[[f64; 3]], n: i64| -> Vec<Visit> {
            let visit = |i: usize| {
                let then = n - i as i64;
                let [x, y, w] = usize::try_from(then).map_or([place(then), 0.0, 1.0], |n| track[n]);
                [x, y, self.a * w * step, step * i as f64]
            };
            (1..=past).map(visit).collect()
        };
        let now = self.groove((0.0, 0.0), [[0.0, 0.0, 0.5 * self.a * step, 0.0]].into_iter())[0];
        let all = visits(&track, 0).into_iter().chain(self.before(0.0, true));
        let even = self.groove((0.0, 0.0), all);
        let limited = |height: f64| law.depth_limit.map_or(1.0, |b| (-height.abs() / b).exp());
        let still = limited(even[0] + now);
        // Forces beyond those of even motion, and w.
        let felt = |track: &[[f64; 3]], n: i64, x: f64, y: f64| {
            let all = visits(track, n).into_iter().chain(self.before(step * n as f64, false));
            let [height, along, across] = self.groove((x, y), all);
            let weight = (0..30).fold(1.0, |w, _| limited(height + now * w) / still);
            ([along - even[1], across - even[2]], weight)
        };
        let mass = law.inertia.unwrap();
        let [mut x, mut v, mut y] = [0.0; 3];
        let mut sums = [Complex64::ZERO; 3];
        for n in 0..(steps * periods) as i64 {
            let ([along, across], weight) = felt(&track, n, place(n) + x, y);
            track.push([place(n) + x, y, weight]);
            let first = [v, (along - v - x) / mass, across - stiffness * y];
            let [x1, v1, y1] = [x + step * first[0], v + step * first[1], y + step * first[2]];
            let ([along, across], _) = felt(&track, n + 1, place(n + 1) + x1, y1);
            let second = [v1, (along - v1 - x1) / mass, across - stiffness * y1];
            if n >= (steps * (periods - 1)) as i64 {
                let turn = Complex64::from_polar(2.0 / steps as f64, -self.q * place(n));
                for (sum, part) in sums.iter_mut().zip([x, weight - 1.0, y]) {
                    *sum += turn * part;
                }
            }
            let next = |now: f64, i: usize| now + 0.5 * step * (first[i] + second[i]);
            [x, v, y] = [next(x, 0), next(v, 1), next(y, 2)];
        }
        sums
    }
}

/// The matrices of [`Slow`] themselves, under depth limit, healing and inertia and on both ways: a line integrated in time
/// over the grooves of others, one of which deviates a little. The error falls with the square of the step.
#[test]
fn a_line_integrated_in_time_answers_as_its_matrices_say() {
    let c = Complex64::new;
    let limited = Wider { depth_limit: Some(4.0), inertia: Some(0.3), ..Wider::default() };
    let healing = Wider { healing_time: Some(12.0), ..limited };
    for (law, left, way, j) in [
        (limited, 1.0, 1.0, 1),
        (limited, 1.0, -1.0, 2),
        (healing, 0.7, 1.0, 1),
        (healing, 0.7, 1.0, 2),
    ] {
        let slow = Slow { law, left, ..Slow::triple(0.0, 0.9, (1.1, 0.9), 1.4) };
        let (alpha, q) = (0.6, 0.7);
        let deviation = [c(0.7, -0.4), c(0.3, 0.5), c(-0.2, 0.8)].map(|part| part * 1e-4);
        let m = slow.answers(alpha, q)[usize::from(way < 0.0)][j - 1];
        let wanted: Vec<Complex64> =
            m.iter().map(|row| row.iter().zip(deviation).map(|(m, x)| m * x).sum()).collect();
        let line = Timed { slow: &slow, way, a: slow.weighted(alpha).0, q, other: (j, deviation) };
        let off = [100, 200].map(|steps| {
            let found = line.answer(steps, 7);
            [0, 1, 2].map(|i: usize| (found[i] - wanted[i]) / wanted[i])
        });
        for i in 0..3 {
            let [coarse, fine] = off.map(|off| off[i]);
            let order = (coarse.norm() / fine.norm()).log2();
            assert!((order - 2.0).abs() < 0.15, "{law:?} {way} {i} {order}");
            let extrapolated = ((fine * 4.0 - coarse) / 3.0).norm();
            assert!(extrapolated < 3e-5, "{law:?} {way} {i} {extrapolated:e}");
        }
    }
}

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    let entry = |i: usize, j: usize| (0..3).map(|k| a[i][k] * b[k][j]).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// By elimination.
fn inverse(m: &Matrix) -> Matrix {
    let mut left = *m;
    let mut right: Matrix = std::array::from_fn(|i| {
        std::array::from_fn(|j| if i == j { Complex64::ONE } else { Complex64::ZERO })
    });
    for i in 0..3 {
        let pivot =
            (i..3).max_by(|a, b| left[*a][i].norm().total_cmp(&left[*b][i].norm())).unwrap();
        left.swap(i, pivot);
        right.swap(i, pivot);
        let scale = left[i][i].inv();
        left[i] = left[i].map(|x| x * scale);
        right[i] = right[i].map(|x| x * scale);
        for row in (0..3).filter(|row| *row != i) {
            let part = left[row][i];
            for k in 0..3 {
                let (l, r) = (left[i][k], right[i][k]);
                left[row][k] -= part * l;
                right[row][k] -= part * r;
            }
        }
    }
    right
}

/// At its q the recurrence grows above the threshold and fades below, at 1e-6 from it; a little below nothing grows at any of
/// many q.
fn is_the_threshold(slow: &Slow, path: RasterPath, found: &RasterCritical) {
    let RasterCritical { alpha, q, certificate, .. } = *found;
    let name =
        format!("{} {} {} {path:?} {:?}: {found:?}", slow.r, slow.pitch, slow.stiffness, slow.law);
    assert_eq!(certificate.growing_below, Some(0), "{name}");
    assert!(matches!(certificate.growing_above, Some(1 | 2)), "{name}");
    let waves = certificate.growing_above.unwrap();
    let growth = |part: f64| slow.fastest(path, (alpha * part, q), waves);
    let [below, at, above] = [1.0 - 1e-6, 1.0, 1.0 + 1e-6].map(growth);
    assert!(below < 0.0 && above > 0.0, "{name}: {below:e} {above:e}");
    let off = at * 2e-6 / (above - below);
    assert!(off.abs() < 1e-9, "{name}: {off:e}");
    let wide = (0..40).map(|i| 0.1 * f64::from(i));
    let close = (0..20).flat_map(|i| {
        let off = 0.3 * 10_f64.powf(-0.15 * f64::from(i));
        [q - off, q + off]
    });
    for other in wide.chain(close).filter(|q| *q >= 0.0) {
        let (growth, _) = slow.recurrence(path, (alpha * (1.0 - 1e-3), other), 1500);
        assert!(growth < 1e-5, "{name}: {growth:e} at {other}");
    }
}

/// Pitches, r, footprints, stiffness and laws, both paths.
#[test]
fn no_threshold_is_above_the_first() {
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
    let plain = Wider::default();
    let limited = Wider { depth_limit: Some(4.0), inertia: Some(0.3), ..plain };
    let healing = Wider { healing_time: Some(30.0), inertia: Some(0.2), ..plain };
    let both = Wider { depth_limit: Some(5.0), ..healing };
    let triple = Slow::triple;
    let cases = [
        triple(0.0, 1.0, (1.0, 0.5), 1.0),
        triple(0.0, 1.0, (1.0, 2.0), 3.0),
        triple(1.0, 1.0, (0.6, 1.1), 0.7),
        triple(0.5, 0.7, (1.8, 0.6), 2.0),
        triple(1.0, 1.0, (1.0, 3.0), 0.3),
        Slow { terms: ring(0.4), ..triple(0.0, 1.0, (1.2, 0.7), 1.5) },
        Slow { terms: ring(-0.5), ..triple(0.0, 1.0, (0.8, 1.0), 2.5) },
        Slow { law: limited, ..triple(0.3, 1.0, (1.0, 0.8), 2.0) },
        Slow { law: limited, ..triple(0.0, 1.0, (1.0, 1.5), 0.8) },
        Slow { law: healing, left: 0.6, ..triple(0.0, 1.0, (1.0, 0.9), 2.0) },
        Slow { law: both, left: 0.7, ..triple(0.4, 1.0, (1.1, 0.8), 1.2) },
    ];
    for slow in cases {
        for path in PATHS {
            if path == RasterPath::Zigzag && slow.law.healing_time.is_some() {
                let error = slow.raster().critical(path);
                assert_eq!(error, Err(StabilityError::HealingZigzag));
                continue;
            }
            is_the_threshold(&slow, path, &slow.raster().critical(path).unwrap());
        }
    }
}
/// What a line answers to those before it, to Simpson's rule; the growth that follows from it; every threshold a zero of
/// det(1 - Σ M_j z^{-j}) at its phase.
#[test]
fn lines_answer_as_their_equations_say() {
    let plain = Wider::default();
    let limited = Wider { depth_limit: Some(4.0), inertia: Some(0.3), ..plain };
    let both = Wider { healing_time: Some(30.0), ..limited };
    for (law, left) in [(plain, 1.0), (limited, 1.0), (both, 0.6)] {
        let slow = Slow { law, left, ..Slow::triple(0.5, 0.9, (1.1, 0.9), 1.4) };
        let raster = slow.raster();
        for (alpha, q) in [(0.6, 0.0), (0.9, 0.7), (2.0, 1.6)] {
            let [wanted, _] = slow.answers(alpha, q);
            let answers = raster.answers_in_plane(alpha, q);
            for (answer, wanted) in answers.iter().zip(&wanted) {
                for (x, y) in answer.iter().flatten().zip(wanted.iter().flatten()) {
                    assert!((x - y).norm() < 2e-9, "{law:?} {x} {y}");
                }
            }
            assert!(wanted[answers.len()..].iter().flatten().flatten().all(|x| x.norm() < 1e-14));
        }
        for found in raster.thresholds(RasterPath::OneWay).unwrap() {
            let RasterCritical { alpha, q, phase_per_line, certificate, .. } = found;
            assert_ne!(certificate.growing_below, certificate.growing_above);
            let [answers, _] = slow.answers(alpha, q);
            let mut m = [[Complex64::ZERO; 3]; 3];
            for (j, answer) in answers.iter().enumerate() {
                let turn = Complex64::from_polar(1.0, -phase_per_line * (j + 1) as f64);
                (0..9).for_each(|i| m[i / 3][i % 3] -= answer[i / 3][i % 3] * turn);
            }
            (0..3).for_each(|i| m[i][i] += 1.0);
            let determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
                - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
                + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
            assert!(determinant.norm() < 2e-8, "{found:?} {determinant}");
        }
        let first = raster.critical(RasterPath::OneWay).unwrap();
        let z = raster.growth(first.alpha, first.q);
        assert!(
            (z - Complex64::from_polar(1.0, first.phase_per_line)).norm() < 1e-6,
            "{z} {first:?}"
        );
    }
}

/// The lowest threshold of each kind, the first being that of all.
#[test]
fn thresholds_of_each_kind_are_listed() {
    use RasterKind::{Bunching, Ripples, Snaking};
    let cases = [
        (0.0, 1.0, 2.0, [Ripples, Bunching]),
        (0.0, 2.0, 3.0, [Bunching, Ripples]),
        (0.0, 2.0, 10.0, [Ripples, Bunching]),
        (1.0, 3.0, 0.3, [Snaking, Ripples]),
    ];
    for (beta, pitch, stiffness, kinds) in cases {
        for path in PATHS {
            let raster = Slow::triple(beta, 1.0, (1.0, pitch), stiffness).raster();
            let found = raster.thresholds(path).unwrap();
            assert_eq!(found[0], raster.critical(path).unwrap());
            assert!(found.is_sorted_by(|a, b| a.alpha < b.alpha));
            let same = found.iter().map(|found| found.kind).eq(kinds);
            assert!(same || path == RasterPath::Zigzag && stiffness < 2.5, "{found:?}");
        }
    }
    // At q = 0 on a zigzag lines are as those that go one way.
    let [one_way, zigzag] = PATHS.map(|path| gaussian(2.0, 10.0).thresholds(path).unwrap()[1]);
    assert!((one_way.alpha / zigzag.alpha - 1.0).abs() < 1e-12);
    let held = Slow::triple(0.0, 1.0, (1.0, 1.0), 1.0).held();
    assert_eq!(held.thresholds(RasterPath::OneWay).unwrap().len(), 1);
}

/// A measured footprint: rows of a table in place of the Gaussian itself.
#[test]
fn a_table_has_the_thresholds_of_what_it_tabulates() {
    let [x, y] = [0.25, 0.3].map(|step| (0..26).map(|i| step * f64::from(i)).collect::<Vec<f64>>());
    let points = y.iter().flat_map(|y| x.iter().map(move |x| (*x, *y)));
    let (xs, ys): (Vec<f64>, Vec<f64>) = points.unzip();
    let f: Vec<f64> = xs.iter().zip(&ys).map(|(x, y)| (-0.5 * (x * x + y * y)).exp()).collect();
    let table = Footprint::table(&xs, &ys, &f).unwrap();
    for stiffness in [1.0, 3.0] {
        let raster = Raster::new(&table, Wider::default(), (1.0, 1.0), 1.0).unwrap();
        let raster = raster.with_stiffness_across(stiffness).unwrap();
        let [found, wanted] =
            [&raster, &gaussian(1.0, stiffness)].map(|r| r.critical(RasterPath::OneWay).unwrap());
        assert!((found.alpha / wanted.alpha - 1.0).abs() < 1e-6, "{found:?} {wanted:?}");
    }
}

#[test]
fn what_gives_way_to_no_spring_is_refused() {
    for stiffness in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-12] {
        let error = Slow::triple(0.0, 1.0, (1.0, 1.0), 1.0).held().with_stiffness_across(stiffness);
        assert!(error.unwrap_err().to_string().contains("stiffness across"));
    }
    let bessel = Footprint::separable(TipFunction::Bessel, 1.0).unwrap();
    let raster = Raster::new(&bessel, Wider::default(), (1.0, 1.0), 1.0).unwrap();
    assert!(matches!(raster.with_stiffness_across(1.0), Err(StabilityError::NoRipples)));
}
