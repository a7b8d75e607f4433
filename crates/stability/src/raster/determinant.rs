//! The determinant that vanishes where a ripple e^{iqx} neither grows nor fades from line to line.
//!
//! With T = r/a, w = 1/z and m = 1 + irq - Mr²q² the equations of `docs/stability.md` are (T - N)v = 0, N a matrix of
//! functions of q and of Λ_l(w) = Σ_j c^j h_l(jd) w^j. One way, where not both the surface heals and the depth is limited,
//!
//! ```text
//!     Q = T - A,                 A = βφ + K/m + Σ_l (β - p²/m) ĝ_l Λ_l,    K = G(s) - G(p) + s²E
//! ```
//!
//! and where both is so,
//!
//! ```text
//!     Q = (T - N11)(T - N22) - N12 N21,     N11 = (K - Σ p²ĝ_l Λ_l)/m,     N22 = β(φ + Σ ĝ_l Λ_l),
//!     N12 = (φ1 + Σ pĝ_l Λ_l)/m,            N21 = β(φ1(s) - φ1 + sE - Σ pĝ_l Λ_l)
//! ```
//!
//! On the way back of a zigzag (s = 0) what is a line's own is conjugate. With E and O the even and the odd part of Λ, and
//! A = κ + Σ F_l Λ_l as above,
//!
//! ```text
//!     Q = (T - κ - Σ F_l E_l)(T - κ* - Σ F_l* E_l) - (Σ F_l O_l)(Σ F_l* O_l)
//! ```
//!
//! a function of W = w². Q is analytic in w or W within the unit circle, where its zeros are the waves that grow.

use super::lines::Sequence;
use super::patch::Patch;
use super::waves::Waves;
use num_complex::Complex64;

/// Which of the three.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Scalar,
    Full,
    Zigzag,
}

/// own + Σ_l lines_l Λ_l, a function of q on an interval of it but for Λ.
#[derive(Debug, Clone)]
struct Entry {
    own: Patch,
    lines: Vec<Patch>,
}

/// The determinant's functions of q on an interval.
#[derive(Debug, Clone)]
pub(super) struct Wave(Vec<Entry>);

/// Sums over lines on an interval of the phase of w, or of W.
#[derive(Debug, Clone)]
pub(super) struct Phase {
    /// Λ_l, or E_l.
    all: Vec<Patch>,
    /// O_l/w
    odd: Vec<Patch>,
    /// W
    turn: Patch,
}

/// Q(T + τ) = value + slope τ, and + τ² where `curved`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Determinant {
    pub(super) value: Patch,
    pub(super) slope: Patch,
    pub(super) curved: bool,
    /// T - N11, T - N22 and N12 N21.
    factors: Option<[Patch; 3]>,
}

/// A law, a footprint, and how the lines lie.
#[derive(Debug, Clone)]
pub(super) struct Lines {
    pub(super) waves: Waves,
    kind: Kind,
    r: f64,
    mass: f64,
    /// β
    steepness: f64,
    /// E
    beside: f64,
    all: Vec<Sequence>,
    odd: Vec<Sequence>,
}

/// What of the law enters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Terms {
    pub(super) r: f64,
    pub(super) mass: f64,
    pub(super) steepness: f64,
    pub(super) beside: f64,
}

impl Lines {
    /// One way, with c^j h_l(jd) of each layer, j = 1, 2, …
    pub(super) fn one_way(waves: Waves, terms: Terms, heights: &[Vec<f64>]) -> Self {
        let both = waves.fading > 0.0 && terms.steepness.abs() > 0.0;
        let all = heights.iter().map(|h| Sequence::new(h.clone(), 1)).collect();
        Self::of(waves, terms, if both { Kind::Full } else { Kind::Scalar }, [all, vec![]])
    }

    /// To and fro, where nothing heals.
    pub(super) fn zigzag(waves: Waves, terms: Terms, heights: &[Vec<f64>]) -> Self {
        let every_other = |from: usize| {
            let each = heights.iter().map(move |h| h.iter().skip(from).step_by(2).copied());
            each.map(move |h| Sequence::new(h.collect(), from)).collect()
        };
        // h(2d), h(4d), … of W, W², …; h(d), h(3d), … of 1, W, …
        Self::of(waves, terms, Kind::Zigzag, [every_other(1), every_other(0)])
    }

    fn of(waves: Waves, terms: Terms, kind: Kind, [all, odd]: [Vec<Sequence>; 2]) -> Self {
        let Terms { r, mass, steepness, beside } = terms;
        Self { waves, kind, r, mass, steepness, beside, all, odd }
    }

    /// A single line over the same even grooves.
    pub(super) fn alone(&self) -> Self {
        let kind = if self.kind == Kind::Zigzag { Kind::Scalar } else { self.kind };
        Self { kind, all: vec![], odd: vec![], ..self.clone() }
    }

    pub(super) fn is_alone(&self) -> bool {
        self.all.is_empty()
    }

    /// Centre and half of the interval of phases: all of them one way; on a zigzag those of Im W ≥ 0, as Q(W*) = Q(W)*.
    pub(super) fn phases(&self) -> (f64, f64) {
        let half = std::f64::consts::PI;
        if self.kind == Kind::Zigzag { (0.5 * half, 0.5 * half) } else { (0.0, half) }
    }

    /// The middle of an interval of phases, or a phase in it at which a zigzag's determinant is real: 0 or π.
    pub(super) fn symmetric(&self, centre: f64, half: f64) -> f64 {
        let nearest = if centre < 0.5 * std::f64::consts::PI { 0.0 } else { std::f64::consts::PI };
        let is_within = (centre - nearest).abs() < 1.5 * half;
        if self.is_zigzag() && is_within { nearest } else { centre }
    }

    pub(super) fn is_zigzag(&self) -> bool {
        self.kind == Kind::Zigzag
    }

    /// Lines that are felt at all, at most.
    pub(super) fn felt(&self) -> usize {
        self.all.iter().chain(&self.odd).map(Sequence::len).max().unwrap_or(0)
    }

    pub(super) fn phase(&self, centre: f64, half: f64) -> Phase {
        let each = |sums: &[Sequence]| sums.iter().map(|s| s.patch(centre, half)).collect();
        let value = Complex64::from_polar(1.0, centre);
        let along = [Complex64::ZERO, value * Complex64::I * half];
        let turn = Patch { value, along, rest: 0.5 * half * half };
        Phase { all: each(&self.all), odd: each(&self.odd), turn }
    }

    /// Largest |T| of a real T with Q = 0 at wave numbers of at least q; falls with q.
    ///
    /// Without a depth limit the imaginary part of m T = K - Σ p²ĝ_l Λ_l, in which K has a real constant, says
    /// rqT ≤ |G(p)| + Σ|p²ĝ_l|Σ|h_l|; on a zigzag the same follows for both directions together. With it, |T| is at most the
    /// sum of |N11|, |N22| and √|N12 N21|.
    pub(super) fn largest_beyond(&self, q: f64) -> f64 {
        let p = q.hypot(self.waves.fading);
        let [height, slope, curvature] = self.waves.own_bounds(p);
        let layers = self.waves.layer_bounds(p);
        let all = |order: usize| -> f64 {
            let sums = layers.iter().zip(self.totals());
            sums.map(|(layer, total)| layer[order] * total).sum()
        };
        let drag = self.r * q;
        if self.steepness.abs() <= 0.0 {
            return (curvature + all(2)) / drag;
        }
        let steep = self.steepness.abs();
        let still = self.still().abs();
        let [_, steady, _] = self.waves.steady;
        let groove = (curvature + still + all(2)) / drag;
        let weight = steep * (height + all(0));
        let felt = slope + all(1);
        let fading = (steady + self.waves.fading * self.beside).abs();
        groove + weight + (felt / drag * steep * (fading + felt)).sqrt()
    }

    /// Of T where it is large: that of a single line, or less.
    pub(super) fn scale(&self) -> f64 {
        let [.., far] = self.waves.own_bounds(1e9);
        let [.., near] = self.waves.own_bounds(0.0);
        // Where both bounds of G are the same.
        let q = 1e9 * far / near;
        near.min(near / (self.r * q))
    }

    /// Σ_j|h_l| of each layer.
    fn totals(&self) -> Vec<f64> {
        let mut totals: Vec<f64> = self.all.iter().map(Sequence::total).collect();
        totals.iter_mut().zip(&self.odd).for_each(|(total, odd)| *total += odd.total());
        totals
    }

    /// G(s) + s²E
    fn still(&self) -> f64 {
        let [_, _, curvature] = self.waves.steady;
        curvature + self.waves.fading.powi(2) * self.beside
    }

    pub(super) fn wave(&self, centre: f64, half: f64) -> Wave {
        let (r, mass, beta) = (self.r, self.mass * self.r * self.r, self.steepness);
        let m = Patch {
            value: Complex64::new(1.0 - mass * centre * centre, r * centre),
            along: [Complex64::new(-2.0 * mass * centre, r) * half, Complex64::ZERO],
            rest: mass * half * half,
        };
        let inverse = m.inv();
        let [height, slope, curvature] = self.waves.own(centre, half);
        let groove = (Patch::constant(self.still()) - curvature) * inverse;
        let layers = if self.is_alone() { vec![] } else { self.waves.layers(centre, half) };
        let each = |of: &dyn Fn(&[Patch; 3]) -> Patch| layers.iter().map(of).collect::<Vec<_>>();
        if self.kind != Kind::Full {
            let lines = each(&|g| g[0] * beta - g[2] * inverse);
            return Wave(vec![Entry { own: groove + height * beta, lines }]);
        }
        let [_, steady, _] = self.waves.steady;
        let fading = Patch::constant(steady + self.waves.fading * self.beside);
        Wave(vec![
            Entry { own: groove, lines: each(&|g| g[2] * inverse * -1.0) },
            Entry { own: height * beta, lines: each(&|g| g[0] * beta) },
            Entry { own: slope * inverse, lines: each(&|g| g[1] * inverse) },
            Entry { own: (fading - slope) * beta, lines: each(&|g| g[1] * -beta) },
        ])
    }

    /// Q about T.
    pub(super) fn determinant(&self, wave: &Wave, phase: &Phase, t: f64) -> Determinant {
        let t = Patch::constant(t);
        let entries = &wave.0;
        let [x, y, product] = match self.kind {
            Kind::Scalar => {
                let value = t - entries[0].with(&phase.all);
                let slope = Patch::constant(1.0);
                return Determinant { value, slope, curved: false, factors: None };
            }
            Kind::Full => {
                let [a, b, c, d] = [0, 1, 2, 3].map(|i: usize| entries[i].with(&phase.all));
                [t - a, t - b, c * d]
            }
            Kind::Zigzag => {
                let (there, back) = (&entries[0], entries[0].conj());
                let felt = there.felt(&phase.odd) * back.felt(&phase.odd) * phase.turn;
                [t - there.with(&phase.all), t - back.with(&phase.all), felt]
            }
        };
        Determinant {
            value: x * y - product,
            slope: x + y,
            curved: true,
            factors: Some([x, y, product]),
        }
    }

    /// The groove of a way back as a multiple of that of the way before it, where Q = 0.
    pub(super) fn back_by_forth(&self, wave: &Wave, phase: &Phase, t: f64) -> Complex64 {
        let there = &wave.0[0];
        let own = there.with(&phase.all).value;
        (t - own) / (there.felt(&phase.odd).value * phase.turn.value)
    }
}

impl Entry {
    fn with(&self, sums: &[Patch]) -> Patch {
        self.own + self.felt(sums)
    }

    fn felt(&self, sums: &[Patch]) -> Patch {
        let each = self.lines.iter().zip(sums);
        each.fold(Patch::constant(0.0), |felt, (line, sum)| felt + *line * *sum)
    }

    fn conj(&self) -> Self {
        Self { own: self.own.conj(), lines: self.lines.iter().map(|l| l.conj()).collect() }
    }
}

impl Wave {
    /// By how much what the determinant is made of may vary with q on a cell, and with the phase.
    pub(super) fn spreads(&self, phase: &Phase) -> [f64; 2] {
        let mut spreads = [0.0; 2];
        for entry in &self.0 {
            spreads[0] += entry.own.reach();
            let odd = phase.odd.iter().map(|sum| *sum * phase.turn);
            for sums in [&phase.all, &odd.collect()] {
                for (line, sum) in entry.lines.iter().zip(sums) {
                    spreads[0] += line.reach() * sum.size();
                    spreads[1] += line.size() * sum.reach();
                }
            }
        }
        spreads
    }
}

impl Determinant {
    /// Whether Q has no zero at any real T from this on, anywhere on the cell.
    pub(super) fn has_none(&self) -> bool {
        if let Some([x, y, product]) = &self.factors
            && x.distance_to_negative() * y.distance_to_negative() > product.size()
        {
            return true;
        }
        self.is_beside_axis() || self.multipliers().any(|mu| self.is_positive(mu))
    }

    /// How near the cell, or a cell beside it, comes to a zero to first order: the larger, the nearer.
    pub(super) fn promise(&self) -> f64 {
        let turned: f64 = self.value.along.iter().map(|l| l.im.abs()).sum();
        if self.value.value.im.abs() > 2.0 * turned {
            return f64::NEG_INFINITY;
        }
        let least = |mu: f64| self.part(&self.value, mu, 0.0);
        let most = self.multipliers().map(least).fold(f64::NEG_INFINITY, f64::max);
        -most / self.slope.value.norm()
    }

    /// Re (1 - iμ) Q > 0 for all T: then Q ≠ 0.
    fn is_positive(&self, mu: f64) -> bool {
        let value = self.part(&self.value, mu, 1.0);
        let slope = self.part(&self.slope, mu, 1.0);
        value > 0.0 && (slope >= 0.0 || self.curved && slope * slope < 4.0 * value)
    }

    /// Im Q ≠ 0 for all T, or Re Q ≠ 0 where it vanishes.
    fn is_beside_axis(&self) -> bool {
        let range = |f: &Patch, part: fn(&Complex64) -> f64| {
            let slopes: f64 = f.along.iter().map(|l| part(l).abs()).sum();
            let off = slopes + f.rest;
            (part(&f.value) - off, part(&f.value) + off)
        };
        let (low, high) = range(&self.value, |z| z.im);
        if !self.curved {
            return low > 0.0 || high < 0.0;
        }
        if low <= 0.0 && high >= 0.0 {
            return false;
        }
        // Im Q = value + slope τ of the other sign at 0: what brings it to 0 is a slope towards it.
        let (least, most) = range(&self.slope, |z| z.im);
        let (near, far) = if low > 0.0 { (low, high) } else { (-high, -low) };
        let (steepest, flattest) = if low > 0.0 { (-least, -most) } else { (most, least) };
        if steepest <= 0.0 {
            return true;
        }
        let first = near / steepest;
        let last = if flattest > 0.0 { far / flattest } else { f64::INFINITY };
        let (value, slope) = (range(&self.value, |z| z.re), range(&self.slope, |z| z.re));
        // Re Q = value + slope τ + τ² from the first to the last of these τ: below 0 at both ends, or above 0 throughout.
        let below = |tau: f64| value.1 + (slope.1 + tau) * tau < 0.0;
        let least = (-0.5 * slope.0).clamp(first, last.max(first));
        let above = value.0 + (slope.0 + least) * least > 0.0;
        above || last.is_finite() && below(first) && below(last)
    }

    /// The least of Re (1 - iμ) f on the cell.
    fn part(&self, f: &Patch, mu: f64, rests: f64) -> f64 {
        let part = |z: &Complex64| z.re + mu * z.im;
        let slopes: f64 = f.along.iter().map(|l| part(l).abs()).sum();
        part(&f.value) - slopes - rests * (1.0 + mu * mu).sqrt() * f.rest
    }

    /// Of Re Q > 0 under the condition Im Q = 0, to first order on the cell: the dual problem has its largest value at one
    /// of these.
    fn multipliers(&self) -> impl Iterator<Item = f64> {
        let each = self.value.along.map(|l| -l.re / l.im);
        std::iter::once(0.0).chain(each).filter(|mu| mu.is_finite())
    }
}
