//! A function across the scan as a sum of Gaussians of one width, and the layers that a tip reads.
//!
//! ```text
//!     h(y) = Σ_k a_k e^{-(y/v - δ_k)²/2}        h(y - y') = Σ_m Φ_m(η) φ_m(η'),        Φ_m(η) = Σ_k a_k φ_m(η - δ_k)
//! ```
//!
//! with the [layers](super::layers) φ. Visits have the layers of a single Gaussian for any h; only the layers that are
//! read depend on h. By the Cauchy-Schwarz inequality the error of M layers is at most Σ|`a_k`| times that of a single
//! Gaussian for visits within a radius and a tip anywhere. The Φ obey the same recurrences as the φ.

use super::earlier::NOTHING;
use super::layers::{Lanes, add_all, slopes, values};
use crate::elementary::exp;

/// A function h across the scan.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bells {
    /// Width v, in σ.
    width: f64,
    /// Amplitudes `a_k` and centers `δ_k` in widths.
    terms: Vec<[f64; 2]>,
}

impl Bells {
    /// One Gaussian about 0.
    pub(super) fn single(width: f64) -> Self {
        Self { width, terms: vec![[1.0, 0.0]] }
    }

    /// Gaussians of these amplitudes and centers d ≥ 0, each with its mirror image.
    pub(super) fn even(width: f64, terms: impl Iterator<Item = (f64, f64)>) -> Self {
        let pair = |(amplitude, center): (f64, f64)| {
            let shift = center / width;
            let twin = (shift > 0.0).then_some([amplitude, -shift]);
            std::iter::once([amplitude, shift]).chain(twin)
        };
        Self { width, terms: terms.flat_map(pair).collect() }
    }

    /// Width v, in σ.
    pub(super) fn width(&self) -> f64 {
        self.width
    }

    /// Whether h is one Gaussian about 0 of height 1.
    pub(super) fn is_single(&self) -> bool {
        self.terms == [[1.0, 0.0]]
    }

    /// Σ|`a_k`|
    pub(super) fn size(&self) -> f64 {
        self.terms.iter().map(|[amplitude, _]| amplitude.abs()).sum()
    }

    /// Largest distance at which h is not 0, in σ.
    pub(super) fn reach(&self) -> f64 {
        let farthest = self.terms.iter().fold(0.0, |most: f64, [_, shift]| most.max(shift.abs()));
        self.width * (farthest + NOTHING)
    }

    /// h and two derivatives at y.
    pub(super) fn jet(&self, y: f64) -> [f64; 3] {
        let mut jet = [0.0; 3];
        for [amplitude, shift] in &self.terms {
            let z = y / self.width - shift;
            if z.abs() < NOTHING {
                let h = amplitude * exp(-0.5 * z * z);
                jet[0] += h;
                jet[1] += -z * h / self.width;
                jet[2] += (z * z - 1.0) * h / (self.width * self.width);
            }
        }
        jet
    }

    /// Sets `phi` to Φ and `psi` to its derivative at η.
    pub(super) fn read(
        &self,
        eta: f64,
        phi: &mut [Lanes],
        psi: &mut [Lanes],
        room: &mut Vec<Lanes>,
    ) {
        let groups = phi.len();
        for (k, [amplitude, shift]) in self.terms.iter().enumerate() {
            if k == 0 {
                values(eta - shift, *amplitude, phi);
                slopes(eta - shift, phi, psi);
                continue;
            }
            room.resize(2 * groups, [0.0; _]);
            let (more, slope) = room.split_at_mut(groups);
            values(eta - shift, *amplitude, more);
            slopes(eta - shift, more, slope);
            add_all(phi, more, 1.0);
            add_all(psi, slope, 1.0);
        }
    }

    /// Φ'' at η for a number of groups of layers.
    pub(super) fn bend<'a>(
        &self,
        eta: f64,
        groups: usize,
        room: &'a mut Vec<Lanes>,
    ) -> &'a [Lanes] {
        room.clear();
        room.resize(4 * groups, [0.0; _]);
        let (sum, rest) = room.split_at_mut(groups);
        let (phi, rest) = rest.split_at_mut(groups);
        let (slope, bend) = rest.split_at_mut(groups);
        for [amplitude, shift] in &self.terms {
            let eta = eta - shift;
            values(eta, *amplitude, phi);
            slopes(eta, phi, slope);
            slopes(eta, slope, bend);
            let all = bend.as_flattened().iter().zip(phi.as_flattened());
            let all = sum.as_flattened_mut().iter_mut().zip(all);
            all.for_each(|(sum, (bend, phi))| *sum += bend - phi);
        }
        sum
    }
}
