//! The Taylor series of several motions in the basic model without external force: `g_n' = α f⁽ⁿ⁾(0) + v g_{n+1}`, x0'
//! = v = `g_1` + R - x0. For one motion, and the notation, see [`chain`](super::super::chain).

use super::super::chain::INVERSE;
use super::super::series::MOST_ORDER;
use super::lanes::Lanes;

/// Number of entries of a row that are summed together. With eight, compilers make vectors of entries instead of lanes
/// and gather their numbers one by one, which takes four times as long with AVX-512.
const BLOCK: usize = 6;
/// Length of a row, odd so that rows do not compete for the same lines of the cache.
const WIDTH: usize = MOST_ORDER + BLOCK + 1;
type Row = [Lanes; WIDTH];

/// The Taylor coefficients of a step of each motion, up to an order.
pub(super) struct Expansion {
    order: usize,
    /// Row k: coefficients of t^k of `g_1`, `g_2`, …
    rows: Box<[Row; MOST_ORDER]>,
    velocity: [Lanes; MOST_ORDER],
    /// Coefficients of x0 minus its value at the start.
    displacement: [Lanes; MOST_ORDER + 1],
}

/// The terms of the equations of motion during a step.
pub(super) struct Acting {
    pub(super) alpha: Lanes,
    /// R', velocity of the support.
    pub(super) support: Lanes,
    /// R - x0 at the start.
    pub(super) extension: Lanes,
}

impl Expansion {
    pub(super) fn new(order: usize) -> Self {
        let rows = Box::new([[Lanes::ZERO; WIDTH]; MOST_ORDER]);
        let (velocity, displacement) = ([Lanes::ZERO; MOST_ORDER], [Lanes::ZERO; MOST_ORDER + 1]);
        Self { order, rows, velocity, displacement }
    }

    /// `g_2`, minus the stiffness of the groove, at the start.
    pub(super) fn curvature(&self) -> &Lanes {
        &self.rows[0][1]
    }

    /// The place of the derivatives `g_n` at the start, from `g_1` on.
    #[inline(always)]
    pub(super) fn start(&mut self) -> &mut [Lanes] {
        &mut self.rows[0][..self.order]
    }

    /// Coefficients of x0 minus its value at the start.
    pub(super) fn displacement(&self) -> &[Lanes] {
        &self.displacement[..=self.order]
    }

    /// Computes the series. `of_tip` are the derivatives of f at 0, from the first on.
    #[inline(always)]
    pub(super) fn run(&mut self, acting: &Acting, of_tip: &[f64]) {
        for k in 0..self.order {
            self.advance(k, acting);
            let needed = self.order - 1 - k;
            let mut n = 0;
            while n < needed {
                match needed - n {
                    0..=2 => self.entries::<2>(k, (n, needed)),
                    3..=4 => self.entries::<4>(k, (n, needed)),
                    _ => self.entries::<BLOCK>(k, (n, needed)),
                }
                n += BLOCK;
            }
            if k == 0 {
                let (entries, of_tip) = (&mut self.rows[1][..needed], &of_tip[..needed]);
                for (entries, of_tip) in entries.chunks_mut(BLOCK).zip(of_tip.chunks(BLOCK)) {
                    for (entry, of_tip) in entries.iter_mut().zip(of_tip) {
                        *entry += acting.alpha * *of_tip;
                    }
                }
            }
        }
    }

    /// Computes the next coefficients of velocity and displacement.
    #[inline(always)]
    fn advance(&mut self, k: usize, acting: &Acting) {
        let extension = match k {
            0 => acting.extension,
            1 => acting.support - self.displacement[1],
            _ => Lanes::ZERO - self.displacement[k],
        };
        self.velocity[k] = self.rows[k][0] + extension;
        self.displacement[k + 1] = self.velocity[k] * INVERSE[k + 1];
    }

    /// Computes `COUNT` entries of row k + 1 from the n-th on, `Σ_i v_i g_{n+1, k-i}` divided by k + 1. Entries from
    /// `needed` on stay 0.
    #[inline(always)]
    fn entries<const COUNT: usize>(&mut self, k: usize, (n, needed): (usize, usize)) {
        let (rows, after) = self.rows.split_at_mut(k + 1);
        let mut sums = [Lanes::ZERO; COUNT];
        for (row, velocity) in rows.iter().rev().zip(&self.velocity) {
            let row: &[Lanes; COUNT] = row[n + 1..].first_chunk().expect("rows have room");
            for (sum, entry) in sums.iter_mut().zip(row) {
                *sum += *velocity * *entry;
            }
        }
        let end = needed.min(n + COUNT);
        for (entry, sum) in after[0][n..end].iter_mut().zip(sums) {
            *entry = sum * INVERSE[k + 1];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::chain::{self, Chain};
    use super::super::lanes::LANES;
    use super::*;
    use crate::memory::ROOM;

    /// Each lane beside the series of one motion, which has other sums of the same products.
    #[test]
    fn a_lane_is_the_series_of_its_motion() {
        // Falling as derivatives of a Gaussian over n! do.
        let number =
            |lane: usize, n: usize| ((7 * lane + 3 * n) as f64).sin() * 0.8_f64.powi(n as i32);
        let of_tip: [f64; ROOM] = std::array::from_fn(|n| number(20, n));
        for order in [10, 17, 25, MOST_ORDER] {
            let mut expansion = Expansion::new(order);
            let lanes = |of: &dyn Fn(usize) -> f64| Lanes(std::array::from_fn(of));
            let acting = Acting {
                alpha: lanes(&|lane| 0.3 + 0.1 * lane as f64),
                support: lanes(&|lane| 0.5 + 0.2 * lane as f64),
                extension: lanes(&|lane| 1.0 - 0.3 * lane as f64),
            };
            // Twice: values of the first expansion do not influence the second.
            for _ in 0..2 {
                for (n, entry) in expansion.start().iter_mut().enumerate() {
                    *entry = acting.alpha * lanes(&|lane| number(lane, n + 1));
                }
                expansion.run(&acting, &of_tip[1..]);
            }
            for lane in 0..LANES {
                let (mut chain, past) = (Chain::new(), std::array::from_fn(|n| number(lane, n)));
                chain.start((order, false), acting.alpha.0[lane], (&past, &of_tip), &[]);
                chain.run(&chain::Acting {
                    spring: 1.0,
                    support: acting.support.0[lane],
                    healing: 0.0,
                    inertia: None,
                    extension: acting.extension.0[lane],
                    depth: None,
                });
                assert!((chain.curvature() - expansion.curvature().0[lane]).abs() < 1e-15);
                for (k, single) in chain.displacement().coefficients().iter().enumerate() {
                    let off = (expansion.displacement()[k].0[lane] - single).abs();
                    assert!(off <= 1e-13 * single.abs().max(1e-3), "{order} {lane} {k}: {off:e}");
                }
            }
        }
    }
}
