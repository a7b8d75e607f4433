//! Layers across the scan: a Gaussian of the distance between two points as a sum of products.
//!
//! About a center c, with the width v of the Gaussian, η = (y - c)/v and `φ_m(η) = η^m e^{-η²/2}/√m!`,
//!
//! ```text
//!     e^{-(η-η')²/2} = Σ_m φ_m(η) φ_m(η')        dφ_m/dη = √m φ_{m-1} - √(m+1) φ_{m+1}
//! ```
//!
//! The squares of `φ_m(η)` are the probabilities of a Poisson distribution of mean η². Therefore, by the
//! Cauchy-Schwarz inequality, the sum of the layers from M on is at most P[Poisson(ρ²) ≥ M] for any two points within
//! ρ of the center. A change of center is a rotation of the φ, as long as none of them is truncated:
//!
//! ```text
//!     φ_a(η - D) = Σ_b T_ab(D) φ_b(η)            T_0b = e^{-D²/2} D^b/√b!
//!                                                √(a+1) T_{a+1,b} = √b T_{a,b-1} - D T_ab
//! ```
//!
//! (`φ_m(η)` are the amplitudes of a coherent state of the harmonic oscillator, T is its displacement operator.)

use crate::elementary::exp;
use crate::integrator::taylor::MOST_ORDER;

/// Number of layers in a SIMD vector; the number of layers is a multiple of it.
pub(super) const LANES: usize = 8;
/// A group of layers.
pub(super) type Lanes = [f64; LANES];
/// Largest number of layers, for a range of 20 widths: more would cost more than a sum over the history.
const MOST: usize = 256;
/// Number of roots: for the layers, and for some more that their series need.
const MOST_ROOTS: usize = MOST + MOST_ORDER + LANES;

/// `φ_m` at η multiplied by a weight, as many as `phi` holds.
pub(super) fn values(eta: f64, weight: f64, phi: &mut [Lanes]) {
    let mut value = weight * exp(-0.5 * eta * eta);
    for (phi, roots) in phi.iter_mut().zip(INVERSE_ROOTS.as_chunks::<LANES>().0) {
        for i in 0..LANES {
            phi[i] = value;
            value *= eta * roots[i];
        }
    }
}

/// dφ/dη at η, from φ: `√m φ_{m-1} - η φ_m`. A second application, to the result, gives the second derivative plus φ.
pub(super) fn slopes(eta: f64, phi: &[Lanes], slope: &mut [Lanes]) {
    let mut below = 0.0;
    let roots = ROOTS.as_chunks::<LANES>().0;
    for ((slope, phi), roots) in slope.iter_mut().zip(phi).zip(roots) {
        for i in 0..LANES {
            slope[i] = roots[i] * below - eta * phi[i];
            below = phi[i];
        }
    }
}

/// √m
pub(super) const ROOTS: [f64; MOST_ROOTS + LANES] = {
    let mut roots = [0.0; MOST_ROOTS + LANES];
    let mut m = 1;
    while m < MOST_ROOTS + LANES {
        roots[m] = root(m as f64);
        m += 1;
    }
    roots
};

/// 1/√(m+1)
const INVERSE_ROOTS: [f64; MOST_ROOTS] = {
    let mut inverse = [0.0; MOST_ROOTS];
    let mut m = 0;
    while m < MOST_ROOTS {
        inverse[m] = 1.0 / ROOTS[m + 1];
        m += 1;
    }
    inverse
};

/// √x for x ≥ 1, by Newton's iteration: its values decrease until round-off.
const fn root(x: f64) -> f64 {
    let mut root = x;
    loop {
        let next = 0.5 * (root + x / root);
        if next >= root {
            return root;
        }
        root = next;
    }
}

/// P[Poisson(mean) ≥ count]
pub(super) fn poisson_tail(mean: f64, count: usize) -> f64 {
    let mut term = (1..=count).fold(exp(-mean), |term, m| term * mean / m as f64);
    let (mut sum, mut m) = (0.0, count);
    while term > f64::EPSILON * sum || (m as f64) < mean {
        sum += term;
        m += 1;
        term *= mean / m as f64;
    }
    sum.min(1.0)
}

/// Bound on the sum of the layers from `count` on, in f and in v `f_y`, for past positions and a tip within a radius.
///
/// `(φ_m')² ≤ 2(m φ_{m-1}² + (m+1) φ_{m+1}²)`, and m φ_{m-1}² = φ_{m-1}² + η² φ_{m-2}².
pub(super) fn error(radius: f64, count: usize) -> f64 {
    let mean = radius * radius;
    let tail = |count: usize| poisson_tail(mean, count);
    let slopes = tail(count - 1) + mean * (tail(count - 2) + tail(count));
    (tail(count) * tail(count).max(2.0 * slopes)).sqrt()
}

/// As [`error`], for past positions within a radius and a tip at any position: the squares of all φ sum to 1, and so do
/// those of their derivatives.
pub(super) fn error_of_visits(radius: f64, count: usize) -> f64 {
    poisson_tail(radius * radius, count).sqrt()
}

/// Largest distances of past positions and tip from the center, in widths, for a number of layers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Radii {
    /// Radius for both, while the number of layers is unchanged.
    pub(super) tip: f64,
    /// Radius for past positions if the number changes later, for any position of the tip: missing layers cannot be
    /// added later.
    pub(super) visits: f64,
}

impl Radii {
    /// The radii within which this number of layers has an error of at most `allowed`; `None` for more layers than
    /// the largest number.
    pub(super) fn of(count: usize, allowed: f64) -> Option<Self> {
        // Errors grow with the radius.
        let largest = |error: fn(f64, usize) -> f64| {
            let (mut low, mut high) = (0.0, (count as f64).sqrt());
            while high - low > 1e-3 {
                let middle = 0.5 * (low + high);
                let holds = error(middle, count) <= allowed;
                (low, high) = if holds { (middle, high) } else { (low, middle) };
            }
            low
        };
        (count <= MOST).then(|| Self { tip: largest(error), visits: largest(error_of_visits) })
    }

    /// The radii for a tip that reads the layers at any distance: as it moves on, its positions are past ones.
    pub(super) fn for_any_tip(self) -> Self {
        Self { tip: self.visits, ..self }
    }
}

/// Applies T for a change of the center by D widths; each of `states` is a vector of layers.
pub(super) fn recenter(distance: f64, states: &mut [Lanes], groups: usize) {
    let count = groups * LANES;
    let mut matrix = vec![0.0; count * count];
    let mut entry = exp(-0.5 * distance * distance);
    for b in 0..count {
        matrix[b] = entry;
        entry *= distance * INVERSE_ROOTS[b];
    }
    for a in 0..count - 1 {
        for b in 0..count {
            let left = if b > 0 { ROOTS[b] * matrix[a * count + b - 1] } else { 0.0 };
            let next = (left - distance * matrix[a * count + b]) * INVERSE_ROOTS[a];
            matrix[(a + 1) * count + b] = next;
        }
    }
    let mut moved = vec![0.0; count];
    for state in states.chunks_exact_mut(groups).map(<[Lanes]>::as_flattened_mut) {
        for (moved, row) in moved.iter_mut().zip(matrix.chunks_exact(count)) {
            *moved = row.iter().zip(&*state).map(|(t, z)| t * z).sum();
        }
        state.copy_from_slice(&moved);
    }
}

/// These vectors of layers with another number of groups than `before`; new layers are 0.
pub(super) fn resized(
    states: &[Lanes],
    before: usize,
    (count, groups): (usize, usize),
) -> Vec<Lanes> {
    let mut resized = vec![[0.0; LANES]; count * groups];
    let kept = groups.min(before);
    if kept > 0 {
        let pairs = resized.chunks_exact_mut(groups).zip(states.chunks_exact(before));
        pairs.for_each(|(new, old)| new[..kept].copy_from_slice(&old[..kept]));
    }
    resized
}

/// `Σ_m a_m b_m`.
pub(super) fn dot(a: &[Lanes], b: &[Lanes]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        add_product(&mut sums, a, b);
    }
    total(&sums)
}

// A loop: closures that iterators call are not compiled for wider vectors.

#[inline(always)]
pub(super) fn add(sum: &mut Lanes, row: &Lanes, factor: f64) {
    for i in 0..LANES {
        sum[i] += factor * row[i];
    }
}

/// Adds a vector of layers times a factor.
#[inline(always)]
pub(super) fn add_all(sum: &mut [Lanes], layers: &[Lanes], factor: f64) {
    for (sum, layers) in sum.iter_mut().zip(layers) {
        add(sum, layers, factor);
    }
}

#[inline(always)]
pub(super) fn add_product(sum: &mut Lanes, a: &Lanes, b: &Lanes) {
    for i in 0..LANES {
        sum[i] += a[i] * b[i];
    }
}

#[inline(always)]
pub(super) fn total(sums: &Lanes) -> f64 {
    // In memory first: the compiler would otherwise take the lanes apart where the sums are made.
    let sums = std::hint::black_box(*sums);
    const { assert!(LANES == 8, "the sum is one of eight lanes") };
    let pair = |i: usize| sums[i] + sums[i + 4];
    (pair(0) + pair(2)) + (pair(1) + pair(3))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn phi(eta: f64, groups: usize) -> Vec<Lanes> {
        let mut phi = vec![[0.0; LANES]; groups];
        values(eta, 1.0, &mut phi);
        phi
    }

    fn product(a: &[Lanes], b: &[Lanes]) -> f64 {
        a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
    }

    /// Errors of h and h' at these two points, by h itself.
    fn missed(a: f64, b: f64, groups: usize) -> f64 {
        let (phi, other) = (phi(a, groups), phi(b, groups));
        let mut slope = phi.clone();
        slopes(a, &phi, &mut slope);
        let h = (-0.5 * (a - b) * (a - b)).exp();
        let value = (product(&phi, &other) - h).abs();
        value.max((product(&slope, &other) + (a - b) * h).abs())
    }

    /// The largest for points within a radius.
    fn worst(radius: f64, groups: usize) -> f64 {
        let ends = [-radius, -0.3 * radius, 0.8 * radius, radius];
        ends.iter().flat_map(|a| ends.map(|b| missed(*a, b, groups))).fold(0.0, f64::max)
    }

    #[test]
    fn layers_are_as_near_as_asked_within_their_radii_and_not_far_beyond() {
        for allowed in [1e-4, 1e-7, 1e-10, 1e-13] {
            for groups in 2..=10 {
                let count = LANES * groups;
                let Radii { tip: radius, visits } = Radii::of(count, allowed).unwrap();
                let (met, bound) = (worst(radius, groups), error(radius, count));
                println!("{allowed:e} {count}: {radius:.3} {visits:.3} {met:.1e} {bound:.1e}");
                assert!(bound <= allowed && met <= bound + 2e-15, "{count}: {met:e} {bound:e}");
                assert!(worst(1.6 * radius, groups) > allowed, "{allowed:e} {count}");
                // Of visits so near, a tip that is anywhere.
                let of_visits = [0.5, 1.0, 2.0, 3.0, 5.0].map(|tip| missed(tip, visits, groups));
                let worst = of_visits.into_iter().fold(0.0, f64::max);
                assert!(worst <= allowed + 2e-15, "{count}: {worst:e} {allowed:e}");
            }
        }
    }

    #[test]
    fn the_tail_is_that_of_the_distribution() {
        // 1 - e^{-2}(1 + 2 + 2 + 4/3)
        let exact = 1.0 - (-2.0_f64).exp() * (5.0 + 4.0 / 3.0);
        assert!((poisson_tail(2.0, 4) - exact).abs() < 1e-15);
        assert!((poisson_tail(30.0, 1) - 1.0).abs() < 1e-12 && poisson_tail(0.0, 3) < 1e-300);
    }

    #[test]
    fn second_derivatives_follow_from_first_ones() {
        let (phi, eta) = (phi(0.8, 6), 0.8);
        let (mut slope, mut twice) = (phi.clone(), phi.clone());
        slopes(eta, &phi, &mut slope);
        slopes(eta, &slope, &mut twice);
        // About another point near: h'' = ((η-η')² - 1) h.
        let other = self::phi(0.5, 6);
        let exact = (0.09 - 1.0) * (-0.045_f64).exp();
        assert!((product(&twice, &other) - product(&phi, &other) - exact).abs() < 1e-13);
    }

    #[test]
    fn a_visit_about_another_center_is_the_same_visit() {
        for distance in [-0.7, 0.2, 1.1] {
            let mut moved = phi(0.4, 10);
            recenter(distance, &mut moved, 10);
            for (a, b) in moved.as_flattened().iter().zip(phi(0.4 - distance, 10).as_flattened()) {
                assert!((a - b).abs() < 1e-14, "{distance}: {a} {b}");
            }
        }
    }
}
