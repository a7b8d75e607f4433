//! Sums over the Gaussians of a table, which have one width and lie on an evenly spaced lattice.

use super::term::{Gaussian, WIDTHS_OF_REACH};
use crate::elementary::exp;

/// Smallest number of terms for which a lattice saves time.
const MANY: usize = 32;

/// A lattice that contains all terms, in the order 0, -1, 1, -2, 2 and so on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Lattice {
    /// Distance Δ of the terms.
    spacing: f64,
    /// Width w of all terms.
    width: f64,
    /// exp(-(jΔ/w)²/2) for j = 0, 1, 2 and so on, as far as it is not negligible.
    fading: Vec<f64>,
}

impl Lattice {
    /// The lattice of these terms; `None` if there is none.
    pub(super) fn of(terms: &[Gaussian]) -> Option<Self> {
        let (width, spacing) = (terms.first()?.width, terms.get(2)?.center);
        let same = |a: f64, b: f64| (a - b).abs() <= 0.0;
        let at = |(i, g): (usize, &Gaussian)| {
            #[expect(clippy::cast_precision_loss, reason = "a table has 2000 rows")]
            let distance = i.div_ceil(2) as f64 * spacing;
            same(g.center, if i.is_multiple_of(2) { distance } else { -distance })
                && same(g.width, width)
        };
        let is_lattice = terms.len() >= MANY && spacing > 0.0 && terms.iter().enumerate().all(at);
        // Further apart than that, neighbours do not see each other, and there is nothing to gain.
        if !is_lattice || spacing > WIDTHS_OF_REACH * width {
            return None;
        }
        // From the term next to x, which is up to half a spacing away.
        let farthest = WIDTHS_OF_REACH + 0.5 * spacing / width;
        let each = (0..terms.len()).map(|j| j as f64 * spacing / width);
        let fading = each.take_while(|z| *z < farthest).map(|z| exp(-0.5 * z * z)).collect();
        Some(Self { spacing, width, fading })
    }

    /// Passes width, z = (x-c)/w and value of each term that is not negligible at x.
    ///
    /// With z = u for the nearest term, its neighbours have z = u - jΔ/w, and
    ///
    /// ```text
    ///     exp(-(u - jΔ/w)²/2) = exp(-u²/2) exp(uΔ/w)^j exp(-(jΔ/w)²/2)
    /// ```
    ///
    /// so that two exponentials suffice for all terms. Each power adds one rounding error, to terms that decay much
    /// faster.
    #[inline]
    pub(super) fn near(&self, terms: &[Gaussian], x: f64, mut take: impl FnMut(f64, f64, f64)) {
        let nearest = (x / self.spacing).round();
        let is_near = nearest.abs() <= (terms.len() + self.fading.len()) as f64;
        // Nor is what is no number.
        if !is_near {
            return;
        }
        let (apart, u) = (self.spacing / self.width, (x - nearest * self.spacing) / self.width);
        let ratio = exp(u * apart);
        let inverse = 1.0 / ratio;
        #[expect(clippy::cast_possible_truncation, reason = "a few thousand")]
        let nearest = nearest as isize;
        let mut add = |j: isize, value: f64| {
            let k = nearest + j;
            let term = if k > 0 { 2 * k } else { -2 * k - isize::from(k < 0) };
            if let Some(g) = terms.get(term.unsigned_abs()) {
                take(self.width, u - j as f64 * apart, g.amplitude * value);
            }
        };
        let top = exp(-0.5 * u * u);
        add(0, top);
        let (mut after, mut before) = (top, top);
        for (j, fading) in (1..).zip(&self.fading[1..]) {
            after *= ratio;
            before *= inverse;
            add(j, after * fading);
            add(-j, before * fading);
        }
    }
}
