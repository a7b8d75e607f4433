//! The time as a power series of the displacement, for several motions in the basic model without external force.
//!
//! While the tip moves forward, its velocity v and its slowness t' = dt/dx = 1/v obey, as functions of its displacement x
//! from the start of a step,
//!
//! ```text
//! v(x) = α g(x) + α ∫_0^x f'(x - y) t'(y)dy + R(t(x)) - x0 - x,    v t' = 1,
//! ```
//!
//! where g is the groove of all earlier steps. It does not move, so that two products of series remain, p²
//! multiplications for the order p. As a function of time, x takes p³/6: the derivatives of the groove under a moving
//! tip form a triangle.

use super::super::chain::INVERSE;
use super::super::series::MOST_ORDER;
use super::lanes::Lanes;

/// The coefficients of a step of each motion, up to an order.
pub(super) struct Series {
    order: usize,
    /// Coefficients of v, of t', and of the time that has elapsed.
    velocity: [Lanes; WIDTH],
    slowness: [Lanes; WIDTH],
    time: [Lanes; WIDTH + 1],
}

/// The terms of the equations of motion during a step.
pub(super) struct Acting {
    pub(super) alpha: Lanes,
    /// R', velocity of the support.
    pub(super) support: Lanes,
    /// R - x0 at the start.
    pub(super) extension: Lanes,
}

/// Number of coefficients that are computed together. With eight, compilers make vectors of coefficients instead of
/// lanes and gather their numbers one by one, which takes four times as long with AVX-512.
const BLOCK: usize = 4;
const WIDTH: usize = MOST_ORDER;
const _: () = assert!(WIDTH.is_multiple_of(BLOCK));

/// Factors of the coefficients of t' in those of the integral: `f⁽ⁿ⁻ᵏ⁾(0) k!/n!` at row k, index n.
pub(super) type OwnGroove = [[f64; WIDTH]; WIDTH];

/// These factors, from the derivatives of f at 0 on the side of the past, f itself first.
pub(super) fn own_groove(of_tip: &[f64]) -> Box<OwnGroove> {
    let mut rows = Box::new([[0.0; WIDTH]; WIDTH]);
    for (k, row) in rows.iter_mut().enumerate() {
        let mut over = 1.0;
        for (n, factor) in row.iter_mut().enumerate().skip(k + 1) {
            over *= n as f64;
            *factor = of_tip[n - k] / over;
        }
    }
    rows
}

impl Series {
    pub(super) fn new(order: usize) -> Self {
        let zero = [Lanes::ZERO; WIDTH];
        Self { order, velocity: zero, slowness: zero, time: [Lanes::ZERO; WIDTH + 1] }
    }

    /// The place of the coefficients of α g.
    #[inline(always)]
    pub(super) fn start(&mut self) -> &mut [Lanes] {
        &mut self.velocity[..self.order]
    }

    /// The velocities at the start.
    pub(super) fn velocity(&self) -> &Lanes {
        &self.velocity[0]
    }

    /// Coefficients of the time that has elapsed.
    pub(super) fn time(&self) -> &[Lanes] {
        &self.time[..=self.order]
    }

    /// Computes the series.
    #[inline(always)]
    pub(super) fn run(&mut self, acting: &Acting, own: &OwnGroove) {
        self.begin(acting, own);
        for n in (BLOCK..self.order).step_by(BLOCK) {
            self.go_on(n, acting, own);
        }
    }

    /// Computes the first block of coefficients.
    #[inline(always)]
    fn begin(&mut self, acting: &Acting, own: &OwnGroove) {
        let Self { velocity, slowness, time, .. } = self;
        velocity[0] += acting.extension;
        velocity[1] = velocity[1] - Lanes::all(1.0);
        slowness[0] = velocity[0].map(f64::recip);
        time[1] = slowness[0];
        for n in 1..BLOCK {
            let (mut groove, mut product) = (Lanes::ZERO, Lanes::ZERO);
            for k in 0..n {
                groove += slowness[k] * own[k][n];
            }
            velocity[n] += acting.alpha * groove + acting.support * time[n];
            for k in 0..n {
                product += slowness[k] * velocity[n - k];
            }
            slowness[n] = (Lanes::ZERO - product) * slowness[0];
            time[n + 1] = slowness[n] * INVERSE[n + 1];
        }
    }

    /// Computes a block of coefficients, from the n-th on.
    #[inline(always)]
    fn go_on(&mut self, n: usize, acting: &Acting, own: &OwnGroove) {
        let Self { velocity, slowness, time, .. } = self;
        let (mut groove, mut product) = ([Lanes::ZERO; BLOCK], [Lanes::ZERO; BLOCK]);
        for (known, factors) in slowness[..n].iter().zip(own) {
            for (sum, factor) in groove.iter_mut().zip(block(factors, n)) {
                *sum += *known * *factor;
            }
        }
        for (k, known) in slowness[..n].iter().enumerate().skip(BLOCK) {
            for (sum, factor) in product.iter_mut().zip(block(velocity, n - k)) {
                *sum += *known * *factor;
            }
        }
        // What is left contains coefficients of this block.
        let (first, before) = (*block(velocity, 0), *block(velocity, n - BLOCK));
        let known = *block(slowness, 0);
        let (new, velocity) = (block_mut(slowness, n), block_mut(velocity, n));
        for i in 0..BLOCK {
            for k in 0..i {
                groove[i] += new[k] * own[n + k][n + i];
                product[i] += new[k] * first[i - k];
            }
            for k in (1..BLOCK).rev() {
                let factor = if k > i { before[BLOCK + i - k] } else { velocity[i - k] };
                product[i] += known[k] * factor;
            }
            velocity[i] += acting.alpha * groove[i] + acting.support * time[n + i];
            product[i] += known[0] * velocity[i];
            new[i] = (Lanes::ZERO - product[i]) * known[0];
            time[n + i + 1] = new[i] * INVERSE[n + i + 1];
        }
    }
}

/// The block that begins with the n-th entry.
#[inline(always)]
fn block<T>(of: &[T; WIDTH], n: usize) -> &[T; BLOCK] {
    of[n..].first_chunk().expect("whole blocks")
}

#[inline(always)]
fn block_mut<T>(of: &mut [T; WIDTH], n: usize) -> &mut [T; BLOCK] {
    of[n..].first_chunk_mut().expect("whole blocks")
}

#[cfg(test)]
mod tests {
    use super::super::super::chain::{self, Chain};
    use super::super::lanes::LANES;
    use super::*;
    use crate::memory::ROOM;

    /// Each lane beside the series of the displacement in powers of time, which has nothing in common with it: at the time
    /// of a displacement the other leads to this displacement.
    #[test]
    fn a_lane_is_the_inverse_of_the_series_in_time() {
        // Falling as derivatives of a Gaussian over n! do.
        let number =
            |lane: usize, n: usize| ((7 * lane + 3 * n) as f64).sin() * 0.8_f64.powi(n as i32);
        let of_tip: [f64; ROOM] = std::array::from_fn(|n| number(20, n));
        let factorial = |n: usize| (1..=n).map(|i| i as f64).product::<f64>();
        for order in [10, 17, 25, MOST_ORDER] {
            let mut series = Series::new(order);
            let lanes = |of: &dyn Fn(usize) -> f64| Lanes(std::array::from_fn(of));
            let acting = Acting {
                alpha: lanes(&|lane| 0.3 + 0.1 * lane as f64),
                support: lanes(&|lane| 0.5 + 0.2 * lane as f64),
                extension: lanes(&|lane| 3.0 - 0.3 * lane as f64),
            };
            // Twice: values of the first series do not influence the second.
            for _ in 0..2 {
                for (n, entry) in series.start().iter_mut().enumerate() {
                    *entry = acting.alpha * lanes(&|lane| number(lane, n + 1) / factorial(n));
                }
                series.run(&acting, &own_groove(&of_tip));
            }
            for lane in 0..LANES {
                let (mut chain, past) = (Chain::new(), std::array::from_fn(|n| number(lane, n)));
                chain.start((order, false), acting.alpha.0[lane], &past, &[]);
                chain.run(&chain::Acting {
                    alpha: acting.alpha.0[lane],
                    of_tip: &of_tip,
                    spring: 1.0,
                    support: acting.support.0[lane],
                    healing: 0.0,
                    inertia: None,
                    extension: acting.extension.0[lane],
                    depth: None,
                });
                let displacement = chain.displacement().coefficients();
                let horner = |sum: f64, x: f64, c: f64| sum * x + c;
                let miss = |x: f64| {
                    let t =
                        series.time().iter().rev().fold(0.0, |sum, c| horner(sum, x, c.0[lane]));
                    let back = displacement.iter().rev().fold(0.0, |sum, c| horner(sum, t, *c));
                    (back / x - 1.0).abs()
                };
                // The first coefficient that is missing, and round-off.
                let allowed = |x: f64| 0.1 * x.powi(order as i32) + 3e-15;
                for x in [0.02, 0.1, 0.2] {
                    assert!(miss(x) < allowed(3.0 * x), "{order} {lane} {x}: {:e}", miss(x));
                }
            }
        }
    }
}
