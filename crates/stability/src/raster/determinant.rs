//! The determinant that vanishes where a ripple e^{iqx} neither grows nor fades from line to line.
//!
//! With T = r/a, w = 1/z and m = 1 + irq - Mr²q² the equations of `docs/explanation/rasters.md` are (T - N)v = 0, N a matrix of
//! functions of q and of Λ_l(w) = Σ_j c^j h_l(jd) w^j. For one-way lines without healing or without a depth limit,
//!
//! ```text
//!     Q = T - A,                 A = βφ + K/m + Σ_l (β - p²/m) ĝ_l Λ_l,    K = G(s) - G(p) + s²E
//! ```
//!
//! and with both,
//!
//! ```text
//!     Q = (T - N11)(T - N22) - N12 N21,     N11 = (K - Σ p²ĝ_l Λ_l)/m,     N22 = β(φ + Σ ĝ_l Λ_l),
//!     N12 = (φ1 + Σ pĝ_l Λ_l)/m,            N21 = β(φ1(s) - φ1 + sE - Σ pĝ_l Λ_l)
//! ```
//!
//! On the retrace of a zigzag (s = 0) the functions of q are the complex conjugates. With E and O the even and the odd part
//! of Λ, and A = κ + Σ F_l Λ_l as above,
//!
//! ```text
//!     Q = (T - κ - Σ F_l E_l)(T - κ* - Σ F_l* E_l) - (Σ F_l O_l)(Σ F_l* O_l)
//! ```
//!
//! a function of W = w². For a footprint that is not even, the conjugates of κ and F of its mirror image replace κ* and F*.
//! Q is analytic in w or W within the unit circle, where its zeros are the waves that grow.
//!
//! If the tip is flexible across the lines, Q = det(T - N) has the rows of `plane.rs`, on a zigzag twice. A and F_l are then
//! matrices: Σ F_l E_l adds to κ as above, and Σ F_l O_l couples trace and retrace.

use super::lines::Sequence;
use super::on_cell::Determinant;
use super::patch::{Entry, Patch};
use super::plane::{Across, Along, Sideways};
use super::polynomial::{Polynomial, minor, null_vector};
use super::waves::Waves;
use num_complex::Complex64;

/// The form of N.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar,
    Full,
    Zigzag,
    /// A single line that deviates across the scan only.
    Across,
    /// Two rows, along and across, one way.
    Plane,
    /// Three rows: along, weight and across, one way.
    PlaneFull,
    /// Two rows, along and across, for the trace and two for the retrace.
    PlaneZigzag,
}

/// The functions of q in the determinant, on an interval; on a zigzag also those of the retrace.
#[derive(Debug, Clone)]
pub(super) struct Wave(Vec<Entry>, Vec<Entry>);

/// Sums over lines on an interval of the phase of w, or of W.
#[derive(Debug, Clone)]
pub(super) struct Phase {
    /// Λ_l, or E_l on a zigzag, of h and, if the tip is flexible across the lines, of h' and h''.
    all: Vec<Vec<Patch>>,
    /// O_l/w
    odd: Vec<Vec<Patch>>,
    /// W
    turn: Patch,
}

/// A law, a footprint and an arrangement of lines.
#[derive(Debug, Clone)]
pub(super) struct Lines {
    pub(super) waves: Waves,
    /// The transforms of the mirrored footprint, for the retrace, if the footprint is not even.
    pub(super) back: Option<Waves>,
    pub(super) kind: Kind,
    pub(super) terms: Terms,
    pub(super) all: Vec<Vec<Sequence>>,
    pub(super) odd: Vec<Vec<Sequence>>,
}

/// The parameters of the law that enter the determinant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Terms {
    pub(super) r: f64,
    pub(super) mass: f64,
    /// Relative change of the indentation rate with the height of the surface, -sign(u)/b; 0 without a depth limit.
    pub(super) steepness: f64,
    /// E
    pub(super) beside: f64,
    pub(super) across: Option<Sideways>,
}

/// c^j h_l(jd) of each layer, j = 1, 2, …, and, if the tip is flexible across the lines, the same with h' and h''.
pub(super) type Heights = Vec<Vec<Vec<f64>>>;

impl Lines {
    pub(super) fn one_way(waves: Waves, terms: Terms, heights: &Heights) -> Self {
        let both = waves.fading > 0.0 && terms.steepness.abs() > 0.0;
        let kind = match (terms.across.is_some(), both) {
            (false, false) => Kind::Scalar,
            (false, true) => Kind::Full,
            (true, false) => Kind::Plane,
            (true, true) => Kind::PlaneFull,
        };
        let sequence = |h: &Vec<f64>| Sequence::new(h.clone(), 1);
        let all = heights.iter().map(|layers| layers.iter().map(sequence).collect()).collect();
        Self { waves, back: None, kind, terms, all, odd: vec![] }
    }

    /// Zigzag lines on a surface that does not heal, with other transforms on the retrace if the footprint is not even.
    pub(super) fn zigzag(
        (waves, back): (Waves, Option<Waves>),
        terms: Terms,
        heights: &Heights,
    ) -> Self {
        let every_other = |from: usize| {
            let sequence = |h: &Vec<f64>| {
                Sequence::new(h.iter().skip(from).step_by(2).copied().collect(), from)
            };
            heights.iter().map(|layers| layers.iter().map(sequence).collect()).collect()
        };
        let kind = if terms.across.is_some() { Kind::PlaneZigzag } else { Kind::Zigzag };
        // h(2d), h(4d), … of W, W², …; h(d), h(3d), … of 1, W, …
        Self { waves, back, kind, terms, all: every_other(1), odd: every_other(0) }
    }

    /// A single line that deviates across the scan only.
    pub(super) fn single_across(waves: Waves, terms: Terms) -> Self {
        Self { waves, back: None, kind: Kind::Across, terms, all: vec![], odd: vec![] }
    }

    /// A single line over the steady grooves of the same earlier lines.
    pub(super) fn alone(&self) -> Self {
        let kind = match self.kind {
            Kind::Zigzag => Kind::Scalar,
            Kind::PlaneZigzag => Kind::Plane,
            kind => kind,
        };
        Self { kind, back: None, all: vec![], odd: vec![], ..self.clone() }
    }

    /// [`Self::alone`], and, if the footprint is not even, also a single retrace.
    pub(super) fn each_alone(&self) -> Vec<Self> {
        let alone = self.alone();
        let back = self.back.clone().map(|waves| Self { waves, ..alone.clone() });
        std::iter::once(alone).chain(back).collect()
    }

    /// [`Self::alone`] with deviations along the scan only, and with deviations across it only.
    pub(super) fn alone_each(&self) -> [Self; 2] {
        let alone = self.alone();
        let both = alone.kind == Kind::PlaneFull;
        let kind = if both { Kind::Full } else { Kind::Scalar };
        let terms = Terms { across: None, ..alone.terms };
        [Self { kind, terms, ..alone.clone() }, Self { kind: Kind::Across, ..alone }]
    }

    pub(super) fn is_alone(&self) -> bool {
        self.all.is_empty()
    }

    /// Centre and half-width of the interval of phases: all phases; on a zigzag with an even footprint only those with
    /// Im W ≥ 0, because Q(W*) = Q(W)*.
    pub(super) fn phases(&self) -> (f64, f64) {
        let half = std::f64::consts::PI;
        if self.is_mirrored() { (0.5 * half, 0.5 * half) } else { (0.0, half) }
    }

    /// The middle of an interval of phases, or a phase in it at which a zigzag's determinant is real: 0 or π.
    pub(super) fn symmetric(&self, centre: f64, half: f64) -> f64 {
        let nearest = if centre < 0.5 * std::f64::consts::PI { 0.0 } else { std::f64::consts::PI };
        let is_within = (centre - nearest).abs() < 1.5 * half;
        if self.is_mirrored() && is_within { nearest } else { centre }
    }

    pub(super) fn is_zigzag(&self) -> bool {
        matches!(self.kind, Kind::Zigzag | Kind::PlaneZigzag)
    }

    /// Whether trace and retrace are mirror images of each other, so that Q(W*) = Q(W)*.
    pub(super) fn is_mirrored(&self) -> bool {
        self.is_zigzag() && self.back.is_none()
    }

    pub(super) fn is_plane(&self) -> bool {
        matches!(self.kind, Kind::Plane | Kind::PlaneFull | Kind::PlaneZigzag)
    }

    /// Largest number of earlier lines in a sum.
    pub(super) fn felt(&self) -> usize {
        self.all.iter().chain(&self.odd).flatten().map(Sequence::len).max().unwrap_or(0)
    }

    pub(super) fn phase(&self, centre: f64, half: f64) -> Phase {
        let each = |sums: &[Vec<Sequence>]| {
            let layers = sums.iter();
            layers.map(|layers| layers.iter().map(|s| s.patch(centre, half)).collect()).collect()
        };
        let value = Complex64::from_polar(1.0, centre);
        let along = [Complex64::ZERO, value * Complex64::I * half];
        let turn = Patch { value, along, rest: 0.5 * half * half };
        Phase { all: each(&self.all), odd: each(&self.odd), turn }
    }

    /// G(s) + s²E
    pub(super) fn still(&self) -> f64 {
        let [_, _, curvature] = self.waves.steady;
        curvature + self.waves.fading.powi(2) * self.terms.beside
    }

    pub(super) fn wave(&self, centre: f64, half: f64) -> Wave {
        let entries = self.entries(&self.waves, (centre, half));
        let back = match &self.back {
            _ if !self.is_zigzag() => vec![],
            None => entries.iter().map(Entry::conj).collect(),
            Some(waves) => self.entries(waves, (centre, half)).iter().map(Entry::conj).collect(),
        };
        Wave(entries, back)
    }

    fn entries(&self, waves: &Waves, (centre, half): (f64, f64)) -> Vec<Entry> {
        let Terms { r, mass, steepness: beta, beside, across } = self.terms;
        let mass = mass * r * r;
        let m = Patch {
            value: Complex64::new(1.0 - mass * centre * centre, r * centre),
            along: [Complex64::new(-2.0 * mass * centre, r) * half, Complex64::ZERO],
            rest: mass * half * half,
        };
        let inverse = m.inv();
        let [height, slope, curvature] = waves.own(centre, half);
        let groove = (Patch::constant(self.still()) - curvature) * inverse;
        let layers = if self.is_alone() { vec![] } else { waves.layers(centre, half) };
        let [_, steady, _] = self.waves.steady;
        let fading = steady + self.waves.fading * beside;
        if let Some(sideways) = across {
            let own = [height, slope, curvature];
            let along = Along { inverse, groove, steepness: beta, fading, own, layers };
            let across = Across::new(waves, sideways, r, (centre, half));
            return match self.kind {
                Kind::Across => across.alone(),
                Kind::PlaneFull => across.all_rows(&along),
                _ => across.rows(&along),
            };
        }
        let each = |of: &dyn Fn(&[Patch; 3]) -> Patch| layers.iter().map(of).collect::<Vec<_>>();
        if self.kind != Kind::Full {
            let lines = each(&|g| g[0] * beta - g[2] * inverse);
            return vec![Entry::level(groove + height * beta, lines)];
        }
        let fading = Patch::constant(fading);
        vec![
            Entry::level(groove, each(&|g| g[2] * inverse * -1.0)),
            Entry::level(height * beta, each(&|g| g[0] * beta)),
            Entry::level(slope * inverse, each(&|g| g[1] * inverse)),
            Entry::level((fading - slope) * beta, each(&|g| g[1] * -beta)),
        ]
    }

    /// Q(T + τ) for T = `t`.
    pub(super) fn determinant(&self, wave: &Wave, phase: &Phase, t: f64) -> Determinant {
        let t = Patch::constant(t);
        let entries = &wave.0;
        Determinant::of_two(match self.kind {
            Kind::Scalar | Kind::Across => {
                return Determinant::linear(t - entries[0].with(&phase.all));
            }
            Kind::Plane | Kind::PlaneFull | Kind::PlaneZigzag => {
                return Determinant::in_plane(Polynomial::of(&self.matrix(wave, phase, t)));
            }
            Kind::Full => {
                let [a, b, c, d] = [0, 1, 2, 3].map(|i: usize| entries[i].with(&phase.all));
                [t - a, t - b, c * d]
            }
            Kind::Zigzag => {
                let (there, back) = (&entries[0], &wave.1[0]);
                let felt = there.felt(&phase.odd) * back.felt(&phase.odd) * phase.turn;
                [t - there.with(&phase.all), t - back.with(&phase.all), felt]
            }
        })
    }

    /// T - N for a tip that is flexible across the lines.
    fn matrix(&self, wave: &Wave, phase: &Phase, t: Patch) -> Vec<Vec<Patch>> {
        let entries = &wave.0;
        let rows = entries.len().isqrt();
        let minus = |sum: Patch| sum * -1.0;
        if self.kind != Kind::PlaneZigzag {
            let row = |i: usize| {
                let entry = |j: usize| minus(entries[i * rows + j].with(&phase.all));
                (0..rows).map(|j| if i == j { t + entry(j) } else { entry(j) }).collect()
            };
            return (0..rows).map(row).collect();
        }
        let row = |i: usize| {
            let (is_back, i) = (i >= rows, i % rows);
            let of = if is_back { &wave.1 } else { entries };
            let entry = |column: usize| {
                let (to_back, j) = (column >= rows, column % rows);
                let entry = &of[i * rows + j];
                match (is_back == to_back, i == j) {
                    (true, true) => t - entry.with(&phase.all),
                    (true, false) => minus(entry.with(&phase.all)),
                    (false, _) if is_back => minus(entry.felt(&phase.odd)),
                    (false, _) => minus(entry.felt(&phase.odd) * phase.turn),
                }
            };
            (0..2 * rows).map(entry).collect()
        };
        (0..2 * rows).map(row).collect()
    }

    /// Share of the deviations along the lines in a wave. dT is a weighted mean of the changes of the diagonal entries of N;
    /// the share is the real part of the weights of the entries along the lines.
    pub(super) fn share_along(&self, wave: &Wave, phase: &Phase, t: f64) -> f64 {
        let x = self.matrix(wave, phase, Patch::constant(t));
        let is_along = |i: usize| match self.kind {
            Kind::PlaneFull => i < 2,
            _ => i.is_multiple_of(2),
        };
        let (mut along, mut all) = (Complex64::ZERO, Complex64::ZERO);
        for i in 0..x.len() {
            let others: Vec<usize> = (0..x.len()).filter(|j| *j != i).collect();
            let part = minor(&x, &others, &others).value;
            all += part;
            along += if is_along(i) { part } else { Complex64::ZERO };
        }
        (along / all).re
    }

    /// Contribution to T, for deviations across, of a line's own groove: the real part of (S(s) - S)/m_y.
    pub(super) fn own_across(&self, q: f64) -> f64 {
        let single = Sideways { beside: [0.0; 2], ..self.terms.across.unwrap_or(Sideways::STIFF) };
        let across = Across::new(&self.waves, single, self.terms.r, (q, 0.0));
        across.alone().iter().map(|entry| entry.own.value.re).sum()
    }

    /// Ratio of the ripple of a retrace to that of the trace before it, where Q = 0. If the tip is flexible across the
    /// lines, the ratio is for the coordinate with the larger deviation.
    pub(super) fn back_by_forth(&self, wave: &Wave, phase: &Phase, t: f64) -> Complex64 {
        if self.kind == Kind::PlaneZigzag {
            let null = null_vector(&self.matrix(wave, phase, Patch::constant(t)));
            let i = usize::from(null[1].norm() > null[0].norm());
            return null[2 + i] / null[i];
        }
        let there = &wave.0[0];
        let own = there.with(&phase.all).value;
        (t - own) / (there.felt(&phase.odd).value * phase.turn.value)
    }
}

impl Wave {
    /// Bounds on the variation of the entries of N on a cell, with q and with the phase.
    pub(super) fn spreads(&self, phase: &Phase) -> [f64; 2] {
        let mut spreads = [0.0; 2];
        for entry in &self.0 {
            spreads[0] += entry.own.reach();
            let sums = |all: &[Vec<Patch>]| all.get(entry.order).cloned().unwrap_or_default();
            let odd = sums(&phase.odd).into_iter().map(|sum| sum * phase.turn);
            for sums in [sums(&phase.all), odd.collect()] {
                for (line, sum) in entry.lines.iter().zip(&sums) {
                    spreads[0] += line.reach() * sum.size();
                    spreads[1] += line.size() * sum.reach();
                }
            }
        }
        spreads
    }
}
