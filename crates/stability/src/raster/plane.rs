//! The equations of lines if the tip is flexible across them too.
//!
//! Line n deviates by (A_n, C_n) e^{iqx} along and across. Steady motion is displaced across by the same distance on all
//! lines, so that they stay jd apart. As f is even in y, nothing of first order couples both coordinates of one line. With
//! m_y = κ_y + irq, S the transform of `f_yy(x,0)` over x > 0, and E', E'', Λ', Λ'' formed like E and Λ but with h' and h'',
//! (T - N)v = 0 has for v = (A, B, C)
//!
//! ```text
//!     N11 = (K - Σ p²ĝ_l Λ_l)/m          N12 = (φ1 + Σ pĝ_l Λ_l)/m              N13 = (sE' - Σ pĝ_l Λ'_l)/m
//!     N21 = β(φ1(s) - φ1 + sE - Σ pĝ_l Λ_l)   N22 = β(φ + Σ ĝ_l Λ_l)            N23 = β(E' - Σ ĝ_l Λ'_l)
//!     N31 = (sE' - Σ pĝ_l Λ'_l)/m_y      N32 = Σ ĝ_l Λ'_l/m_y                   N33 = (S(s) - S + E'' - Σ ĝ_l Λ''_l)/m_y
//! ```
//!
//! Without a depth limit the second row is 0, and (A, C) remain. Without healing the first column is -p times the second:
//! only R = B - pA and C of a line affect the later lines, and
//!
//! ```text
//!     (T - N22 + pN12) R = (N23 - pN13) C,     (T - N33) C = N32 R
//! ```

use super::patch::{Entry, Patch};
use super::waves::Waves;
use num_complex::Complex64;

/// Parameters of the coordinate across the lines: κ_y, and E' and E''.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sideways {
    pub(super) stiffness: f64,
    pub(super) beside: [f64; 2],
}

impl Sideways {
    /// A tip that is held on its line.
    pub(super) const STIFF: Self = Self { stiffness: f64::INFINITY, beside: [0.0; 2] };
}

/// The functions of q in the entries along the lines, on an interval.
pub(super) struct Along {
    /// 1/m
    pub(super) inverse: Patch,
    /// K/m
    pub(super) groove: Patch,
    /// β
    pub(super) steepness: f64,
    /// φ1(s) + sE
    pub(super) fading: f64,
    /// φ, φ1, G
    pub(super) own: [Patch; 3],
    /// ĝ, pĝ, p²ĝ of every layer
    pub(super) layers: Vec<[Patch; 3]>,
}

/// The functions of q in the entries across the lines, on an interval.
pub(super) struct Across {
    /// 1/m_y
    inverse: Patch,
    /// (S(s) - S + E'')/m_y
    groove: Patch,
    /// E'
    slope: f64,
    /// s
    fading: f64,
}

impl Across {
    pub(super) fn new(waves: &Waves, sideways: Sideways, r: f64, (q, half): (f64, f64)) -> Self {
        let Sideways { stiffness, beside: [slope, curvature] } = sideways;
        let along = [Complex64::new(0.0, r * half), Complex64::ZERO];
        let inverse = Patch { value: Complex64::new(stiffness, r * q), along, rest: 0.0 }.inv();
        let still = waves.across_at(waves.fading.into()).0.re;
        let groove = (Patch::constant(still + curvature) - waves.across(q, half)) * inverse;
        Self { inverse, groove, slope, fading: waves.fading }
    }

    /// N33 of a single line.
    pub(super) fn alone(&self) -> Vec<Entry> {
        vec![Entry::level(self.groove, vec![])]
    }

    /// The two rows of (R, C), or of (A, C) if the surface heals.
    pub(super) fn rows(&self, along: &Along) -> Vec<Entry> {
        if self.fading > 0.0 {
            let rows = self.all_rows(along);
            return [0, 2, 6, 8].map(|i: usize| rows[i].clone()).into();
        }
        let (beta, inverse) = (along.steepness, along.inverse);
        let [height, ..] = along.own;
        let left = along.level(along.groove + height * beta, |g| g[0] * beta - g[2] * inverse);
        let aside =
            along.tilted(Patch::constant(beta * self.slope), |g| g[2] * inverse - g[0] * beta);
        let back = along.tilted(Patch::constant(0.0), |g| g[0] * self.inverse);
        vec![left, aside, back, self.bent(along)]
    }

    /// The three rows of (A, B, C).
    pub(super) fn all_rows(&self, along: &Along) -> Vec<Entry> {
        let (beta, inverse, pull) = (along.steepness, along.inverse, self.inverse);
        let [height, slope, _] = along.own;
        let faded = self.fading * self.slope;
        vec![
            along.level(along.groove, |g| g[2] * inverse * -1.0),
            along.level(slope * inverse, |g| g[1] * inverse),
            along.tilted(inverse * faded, |g| g[1] * inverse * -1.0),
            along.level((Patch::constant(along.fading) - slope) * beta, |g| g[1] * -beta),
            along.level(height * beta, |g| g[0] * beta),
            along.tilted(Patch::constant(beta * self.slope), |g| g[0] * -beta),
            along.tilted(pull * faded, |g| g[1] * pull * -1.0),
            along.tilted(Patch::constant(0.0), |g| g[0] * pull),
            self.bent(along),
        ]
    }

    /// N33
    fn bent(&self, along: &Along) -> Entry {
        Entry { order: 2, ..along.level(self.groove, |g| g[0] * self.inverse * -1.0) }
    }
}

impl Along {
    fn level(&self, own: Patch, lines: impl Fn(&[Patch; 3]) -> Patch) -> Entry {
        Entry::level(own, self.layers.iter().map(lines).collect())
    }

    fn tilted(&self, own: Patch, lines: impl Fn(&[Patch; 3]) -> Patch) -> Entry {
        Entry { order: 1, ..self.level(own, lines) }
    }
}
