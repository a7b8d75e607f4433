//! Bounds of T and of the wave numbers at which T may exceed a given value: they make the region of a search finite.

use super::determinant::{Kind, Lines};
use super::lines::Sequence;
use super::plane::Sideways;

impl Lines {
    /// Bound of |T| for real T with Q = 0 at wave numbers of at least q; it decreases with q.
    ///
    /// Without a depth limit the imaginary part of m T = K - Σ p²ĝ_l Λ_l, in which the constant of K is real, yields
    /// rqT ≤ |G(p)| + Σ|p²ĝ_l|Σ|h_l|. On a zigzag this also holds for trace and retrace together. With a depth limit, |T|
    /// is at most the sum of |N11|, |N22| and √|N12 N21|.
    ///
    /// If the tip is flexible across the lines, |T| is at most the largest eigenvalue of a matrix of bounds of |N|.
    pub(super) fn largest_beyond(&self, q: f64) -> f64 {
        let p = q.hypot(self.waves.fading);
        let [height, slope, curvature] = self.own_bounds(p);
        let layers = self.waves.layer_bounds(p);
        let sums = |power: usize, order: usize| -> f64 {
            let sums = layers.iter().zip(self.totals(order));
            sums.map(|(layer, total)| layer[power] * total).sum()
        };
        let all = |power: usize| sums(power, 0);
        let drag = self.terms.r * q;
        if let Some(sideways) = self.terms.across {
            return self.largest_across(sideways, p, drag, &sums);
        }
        if self.terms.steepness.abs() <= 0.0 {
            return (curvature + all(2)) / drag;
        }
        let steep = self.terms.steepness.abs();
        let still = self.still().abs();
        let [_, steady, _] = self.waves.steady;
        let groove = (curvature + still + all(2)) / drag;
        let weight = steep * (height + all(0));
        let felt = slope + all(1);
        let fading = (steady + self.waves.fading * self.terms.beside).abs();
        groove + weight + (felt / drag * steep * (fading + felt)).sqrt()
    }

    /// Bounds of |φ|, |φ1|, |G| on trace and retrace for |p| ≥ `distance`.
    fn own_bounds(&self, distance: f64) -> [f64; 3] {
        let forth = self.waves.own_bounds(distance);
        let back = self.back.as_ref().map_or(forth, |back| back.own_bounds(distance));
        [0, 1, 2].map(|i: usize| forth[i].max(back[i]))
    }

    /// A scale of T: the largest T of a single line, or less.
    pub(super) fn scale(&self) -> f64 {
        let (bound, spring): (&dyn Fn(f64) -> f64, f64) = match (self.kind, self.terms.across) {
            (Kind::Across, Some(across)) => (&|p| self.waves.across_bound(p), across.stiffness),
            _ => (&|p| self.waves.own_bounds(p)[2], 1.0),
        };
        let (far, near) = (bound(1e9), bound(0.0));
        // Where both bounds of G are the same.
        let q = 1e9 * far / near;
        (near / spring).min(near / (self.terms.r * q))
    }

    /// [`Self::largest_beyond`] for a tip that is flexible across the lines; |m| and |m_y| are at least `drag`.
    fn largest_across(
        &self,
        sideways: Sideways,
        p: f64,
        drag: f64,
        sums: &dyn Fn(usize, usize) -> f64,
    ) -> f64 {
        let [height, slope, curvature] = self.waves.own_bounds(p);
        let still = self.waves.across_at(self.waves.fading.into()).0.re;
        let [tilt, bend] = sideways.beside.map(f64::abs);
        let across = (still.abs() + bend + self.waves.across_bound(p) + sums(0, 2)) / drag;
        if self.kind == Kind::Across {
            return self.waves.across_bound(p) / drag;
        }
        let (steep, fading) = (self.terms.steepness.abs(), self.waves.fading);
        let groove = (curvature + self.still().abs() + sums(2, 0)) / drag;
        let weight = steep * (height + sums(0, 0));
        let faded = (fading * tilt + sums(1, 1)) / drag;
        let raised = steep * (tilt + sums(0, 1));
        if self.kind != Kind::PlaneFull && fading > 0.0 {
            return largest_eigenvalue(&[[groove, faded], [faded, across]]);
        }
        if self.kind != Kind::PlaneFull {
            let aside = raised + sums(2, 1) / drag;
            return largest_eigenvalue(&[[groove + weight, aside], [sums(0, 1) / drag, across]]);
        }
        let [_, steady, _] = self.waves.steady;
        let felt = slope + sums(1, 0);
        let lost = steep * ((steady + fading * self.terms.beside).abs() + felt);
        largest_eigenvalue(&[
            [groove, felt / drag, faded],
            [lost, weight, raised],
            [faded, sums(0, 1) / drag, across],
        ])
    }

    /// Σ_j|h_l| of each layer, or of derivatives of h.
    fn totals(&self, order: usize) -> Vec<f64> {
        let all = self.all.get(order).map_or(&[][..], Vec::as_slice);
        let odd = self.odd.get(order).map_or(&[][..], Vec::as_slice);
        let mut totals: Vec<f64> = all.iter().map(Sequence::total).collect();
        totals.iter_mut().zip(odd).for_each(|(total, odd)| *total += odd.total());
        totals
    }
}

/// A bound of the largest eigenvalue of a matrix of numbers ≥ 0: the largest (Mx)_i/x_i of any x > 0 (Collatz).
fn largest_eigenvalue<const N: usize>(m: &[[f64; N]; N]) -> f64 {
    let times = |x: &[f64; N]| m.map(|row| row.iter().zip(x).map(|(m, x)| m * x).sum::<f64>());
    let mut x = [1.0; N];
    let mut least = f64::INFINITY;
    for _ in 0..20 {
        let next = times(&x);
        let largest = next.iter().zip(&x).map(|(next, x)| next / x).fold(0.0, f64::max);
        least = least.min(largest);
        let size = next.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        // No component may vanish.
        x = std::array::from_fn(|i| next[i] / size + 1e-3 * x[i]);
    }
    least
}
