//! A Gaussian at equidistant points with two exponentials.

use crate::patch::Patch;

/// exp(-(x_j - c)²/2s²) on x_j = j h: with m the cell nearest to c and d = x_m - c,
///
/// exp(-(d + i h)²/2s²) = e^{-d²/2s²} · (e^{-d h/s²})^i · e^{-i²h²/2s²},
///
/// the last factor from a table (fast Gaussian gridding; L. Greengard and J.-Y. Lee, SIAM Review 46
/// (2004) 443). Relative error about i ulp.
///
/// Four neighbours are computed together, so that their powers are independent of one another.
#[derive(Debug, Clone)]
pub(crate) struct Bell {
    spacing: f64,
    /// 1/2s²
    steepness: f64,
    /// e^{-i²h²/2s²}, i = 1, 2, …, until below 1e-17; a multiple of four long
    right: Vec<f64>,
    /// `right` backwards
    left: Vec<f64>,
}

impl Bell {
    pub(crate) fn new(width: f64, spacing: f64) -> Self {
        let steepness = 0.5 / (width * width);
        let cells = ((8.85 * width / spacing).ceil() as usize).next_multiple_of(4);
        let right: Vec<f64> =
            (1..=cells).map(|i| (-steepness * (i as f64 * spacing).powi(2)).exp()).collect();
        let left = right.iter().rev().copied().collect();
        Self { spacing, steepness, right, left }
    }

    /// Index of the cell nearest to `center`.
    pub(crate) fn nearest(&self, center: f64) -> i64 {
        (center / self.spacing).round() as i64
    }

    /// Number of cells on either side of the nearest that [`Bell::add`] fills.
    pub(crate) fn half_width(&self) -> usize {
        self.right.len()
    }

    /// Adds `factor` times the Gaussian about `center`; `out` must hold all of its cells.
    pub(crate) fn add(&self, factor: f64, center: f64, out: &mut Patch) {
        let nearest = self.nearest(center);
        let d = nearest as f64 * self.spacing - center;
        let peak = factor * (-self.steepness * d * d).exp();
        let q = (-2.0 * self.steepness * d * self.spacing).exp();
        let (q2, p) = (q * q, 1.0 / q);
        let p2 = p * p;

        let middle = (nearest - out.first) as usize;
        let (before, from) = out.values.split_at_mut(middle);
        from[0] += peak;
        let rising = [q, q2, q * q2, q2 * q2].map(|power| peak * power);
        let cells = from[1..].as_chunks_mut::<4>().0.iter_mut();
        sweep(cells.zip(self.right.as_chunks::<4>().0), rising, q2 * q2);
        let falling = [p2 * p2, p * p2, p2, p].map(|power| peak * power);
        let cells = before.as_rchunks_mut::<4>().1.iter_mut().rev();
        sweep(cells.zip(self.left.as_chunks::<4>().0.iter().rev()), falling, p2 * p2);
    }
}

/// cell += power · table in groups of four, the powers growing by `factor` from one group to the next.
fn sweep<'a>(
    fours: impl Iterator<Item = (&'a mut [f64; 4], &'a [f64; 4])>,
    mut powers: [f64; 4],
    factor: f64,
) {
    for (cells, table) in fours {
        for ((cell, t), power) in cells.iter_mut().zip(table).zip(&mut powers) {
            *cell += *power * t;
            *power *= factor;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_exponentials_give_the_whole_gaussian() {
        let (width, spacing) = (0.7, 0.36);
        let bell = Bell::new(width, spacing);
        for k in -20..20 {
            let center = 0.037 * f64::from(k);
            let mut patch = Patch::default();
            let half = bell.half_width();
            patch.reset(bell.nearest(center) - half as i64, 2 * half + 1);
            bell.add(3.0, center, &mut patch);
            for (cell, value) in (patch.first..).zip(&patch.values) {
                let z = (cell as f64 * spacing - center) / width;
                let exact = 3.0 * (-0.5 * z * z).exp();
                assert!((value - exact).abs() <= 3e-14 * exact, "{value} for {exact} at z = {z}");
            }
            assert!(patch.values[0] < 3e-17);
        }
    }
}
