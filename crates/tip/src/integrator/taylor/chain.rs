//! The Taylor series of the tip's motion, from the derivatives of the groove under it.
//!
//! With exponentials for f the system is polynomial. Its unknowns need not be the states of the exponentials: the
//! derivatives of the groove under the tip, `g_n = α ∫ w f⁽ⁿ⁾(x0 - x0(t'))dt' - ∂ⁿu0`, obey
//!
//! ```text
//!     g_n' = α w f⁽ⁿ⁾(0) + v g_{n+1} - g_n/T        M v' + v = g_1 + κ(R - x0) + F        x0' = v
//! ```
//!
//! For x0 up to `t^p`, `g_n` is needed up to `t^{p-n}`: a triangle of p³/6 products, with n in the SIMD lanes. With a
//! depth limit b, `-g_0` is the height and `w' = σ w g_0'/b`, where σ = ±1 is the side of the kink; otherwise w = 1.

use super::series::{MOST_ORDER, Series};
use crate::memory::ROOM;
use multiversion::multiversion;

const LANES: usize = 4;
/// Length of a row, with room for a group of lanes that begins at its second entry.
const WIDTH: usize = ROOM + LANES;
type Row = [f64; WIDTH];
/// 1/k at index k.
pub(crate) const INVERSE: [f64; MOST_ORDER + 1] = {
    let mut inverse = [0.0; MOST_ORDER + 1];
    let mut k = 1;
    while k <= MOST_ORDER {
        inverse[k] = 1.0 / k as f64;
        k += 1;
    }
    inverse
};

/// The terms of the equation of motion during a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Acting<'a> {
    pub(super) alpha: f64,
    /// Derivatives of f at 0, on the side of the past, from the 0th on.
    pub(super) of_tip: &'a [f64; ROOM],
    /// κ: 1, or 0 without a spring.
    pub(super) spring: f64,
    /// R', velocity of the support.
    pub(super) support: f64,
    /// 1/T; 0 without healing.
    pub(super) healing: f64,
    /// M and the velocity of the tip at the start, with inertia.
    pub(super) inertia: Option<(f64, f64)>,
    /// R - x0 at the start.
    pub(super) extension: f64,
    /// w at the start and σ/b, with a depth limit.
    pub(super) depth: Option<(f64, f64)>,
}

/// The Taylor coefficients of a step, up to an order.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    order: usize,
    /// Row k: coefficients of t^k of `g_1`, `g_2`, …, with a depth limit from `g_0` on.
    rows: Box<[Row; MOST_ORDER]>,
    /// Index of `g_1` in a row.
    slope: usize,
    /// Coefficients of the force.
    pub(super) force: [f64; MOST_ORDER],
    /// Coefficients of the velocity, the highest first, so that a product of two series is a sum in the order of both
    /// arrays.
    velocity: [f64; MOST_ORDER],
    /// Coefficients of w, the highest first, with room to fill the lanes.
    weight: [f64; MOST_ORDER + LANES],
    /// Coefficients of w'/w = σ `g_0'`/b.
    rate: [f64; MOST_ORDER],
    displacement: Series,
    height: Series,
    weights: Series,
}

impl Chain {
    pub(super) fn new() -> Self {
        Self {
            order: 0,
            rows: Box::new([[0.0; WIDTH]; MOST_ORDER]),
            slope: 0,
            force: [0.0; MOST_ORDER],
            velocity: [0.0; MOST_ORDER],
            weight: [0.0; MOST_ORDER + LANES],
            rate: [0.0; MOST_ORDER],
            displacement: Series::zero(0),
            height: Series::zero(0),
            weights: Series::zero(0),
        }
    }

    /// The series of x0 minus its value at the start.
    pub(super) fn displacement(&self) -> &Series {
        &self.displacement
    }

    /// The series of the height under the tip, with a depth limit.
    pub(super) fn height(&self) -> &Series {
        &self.height
    }

    /// The series of w.
    pub(super) fn weights(&self) -> &Series {
        &self.weights
    }

    /// `g_2`, minus the stiffness of the groove, at the start.
    pub(super) fn curvature(&self) -> f64 {
        self.rows[0][self.slope + 1]
    }

    /// Minus the height under the tip at the start, with a depth limit.
    pub(super) fn depth_now(&self) -> f64 {
        self.rows[0][0]
    }

    /// Sets the data at the start of the series, derivatives from the 0th on: `past` of the groove divided by α, and
    /// `relief` of u0.
    pub(super) fn start(
        &mut self,
        (order, with_height): (usize, bool),
        alpha: f64,
        past: &[f64; ROOM],
        relief: &[f64],
    ) {
        if order != self.order {
            self.order = order;
            self.displacement = Series::zero(order);
            (self.height, self.weights) = (Series::zero(order - 1), Series::zero(order - 1));
        }
        self.slope = usize::from(with_height);
        let from = 1 - self.slope;
        let first = &mut self.rows[0][..=order - from];
        first.iter_mut().zip(&past[from..]).for_each(|(g, past)| *g = alpha * past);
        first.iter_mut().zip(relief.iter().skip(from)).for_each(|(g, relief)| *g -= relief);
    }

    /// Computes the series from the data of [`start`](Self::start) and from the force.
    pub(super) fn run(&mut self, acting: &Acting) {
        run(self, acting);
    }

    #[inline(always)]
    fn coefficients(&mut self, acting: &Acting) {
        if let Some((_, velocity)) = acting.inertia {
            self.velocity[MOST_ORDER - 1] = velocity;
        }
        self.weight[MOST_ORDER - 1] = acting.depth.map_or(1.0, |(weight, _)| weight);
        self.weights.set(0, self.weight[MOST_ORDER - 1]);
        self.height.set(0, -self.rows[0][0]);
        self.rate = [0.0; MOST_ORDER];
        // Each row as far as the order needs it: ever fewer groups of lanes.
        let k = self.rows_of::<7>(0, acting);
        let k = self.rows_of::<6>(k, acting);
        let k = self.rows_of::<5>(k, acting);
        let k = self.rows_of::<4>(k, acting);
        let k = self.rows_of::<3>(k, acting);
        let k = self.rows_of::<2>(k, acting);
        let k = self.rows_of::<1>(k, acting);
        self.advance(k, acting);
    }

    /// Computes the rows after k that need this number of groups of lanes, and returns the index of the last one.
    #[inline(always)]
    fn rows_of<const GROUPS: usize>(&mut self, mut k: usize, acting: &Acting) -> usize {
        let needed = self.order - 1 + self.slope;
        while k + 1 < self.order && needed > k + LANES * (GROUPS - 1) {
            self.advance(k, acting);
            self.products::<GROUPS>(k, acting);
            if let Some((_, rate)) = acting.depth {
                self.weigh(k, rate);
            }
            k += 1;
        }
        k
    }

    /// Computes the next coefficients of velocity and displacement.
    #[inline(always)]
    fn advance(&mut self, k: usize, acting: &Acting) {
        let next = INVERSE[k + 1];
        let extension = match k {
            0 => acting.extension,
            1 => acting.support - self.displacement.at(1),
            _ => -self.displacement.at(k),
        };
        let pull = self.rows[k][self.slope] + (acting.spring * extension + self.force[k]);
        let at = MOST_ORDER - 1 - k;
        match acting.inertia {
            None => self.velocity[at] = pull,
            Some((mass, _)) if k + 1 < self.order => {
                self.velocity[at - 1] = (pull - self.velocity[at]) * next / mass;
            }
            Some(_) => {}
        }
        self.displacement.set(k + 1, self.velocity[at] * next);
    }

    /// Computes row k + 1 by `Σ_i v_i g_{n+1, k-i}`, the same order on every machine. In short rows alternate products
    /// go to two sums.
    #[inline(always)]
    fn products<const GROUPS: usize>(&mut self, k: usize, acting: &Acting) {
        let (rows, after) = self.rows.split_at_mut(k + 1);
        let factors = &self.velocity[MOST_ORDER - 1 - k..][..=k];
        // Few sums would wait for each other; many fill the registers.
        let other = usize::from(GROUPS <= FEW);
        let mut sums = [[[0.0; LANES]; GROUPS]; 2];
        // An index: of iterators over rows so long the lengths would be divisions.
        let mut i = 1;
        while other == 1 && i + 1 < k {
            add(&mut sums[0], groups(&rows[i][1..]), factors[i]);
            add(&mut sums[1], groups(&rows[i + 1][1..]), factors[i + 1]);
            i += 2;
        }
        while i < k {
            add(&mut sums[0], groups(&rows[i][1..]), factors[i]);
            i += 1;
        }
        if k == 0 || acting.depth.is_some() {
            let weight = acting.alpha * self.weight[MOST_ORDER - 1 - k];
            add(&mut sums[other], groups(&acting.of_tip[1 - self.slope..]), weight);
        }
        if acting.healing > 0.0 {
            add(&mut sums[other], groups(&rows[k]), -acting.healing);
        }
        // What has only just been found comes last, already divided by k + 1: little waits for it.
        let next = INVERSE[k + 1];
        let (of_last, of_first) = (if k > 0 { next * factors[k] } else { 0.0 }, next * factors[0]);
        let (last, first) = (groups::<GROUPS>(&rows[k][1..]), groups::<GROUPS>(&rows[0][1..]));
        // Not stored entry by entry: compilers cannot see that these are three rows.
        let mut row = [[0.0; LANES]; GROUPS];
        for g in 0..GROUPS {
            for i in 0..LANES {
                let (even, odd) = (sums[0][g][i], sums[1][g][i]);
                let sum = if GROUPS <= FEW { even + odd } else { even };
                row[g][i] = (next * sum + of_last * last[g][i]) + of_first * first[g][i];
            }
        }
        after[0][..LANES * GROUPS].copy_from_slice(row.as_flattened());
    }

    /// Computes the next coefficient of w by `w' = rate w g_0'`.
    #[inline(always)]
    fn weigh(&mut self, k: usize, rate: f64) {
        let depth = self.rows[k + 1][0];
        let newest = rate * (k + 1) as f64 * depth;
        self.height.set(k + 1, -depth);
        // What is not yet known counts as 0.
        let count = k.div_ceil(LANES);
        let known = self.rate.as_chunks::<LANES>().0[..count].iter();
        let weights = self.weight[MOST_ORDER - 1 - k..].as_chunks::<LANES>().0;
        let mut sums = [0.0; LANES];
        for (rates, weights) in known.zip(&weights[..count]) {
            for i in 0..LANES {
                sums[i] += rates[i] * weights[i];
            }
        }
        self.rate[k] = newest;
        if k + 1 < MOST_ORDER {
            let sum = (sums[0] + sums[2]) + (sums[1] + sums[3]);
            let first = self.weight[MOST_ORDER - 1];
            let weight = INVERSE[k + 1] * (sum + newest * first);
            self.weight[MOST_ORDER - 2 - k] = weight;
            self.weights.set(k + 1, weight);
        }
    }
}

/// Also compiled for wider vectors, chosen at run time. No products are fused with sums, and each lane is a separate
/// sum, so that the bits are the same.
#[multiversion(targets("x86_64+avx2"))]
fn run(chain: &mut Chain, acting: &Acting) {
    chain.coefficients(acting);
}

/// Largest number of groups of lanes in a short row.
const FEW: usize = 2;

/// The groups of lanes with which this part of a row begins.
#[inline(always)]
fn groups<const GROUPS: usize>(row: &[f64]) -> &[[f64; LANES]; GROUPS] {
    row.as_chunks().0.first_chunk().expect("rows have room for all groups")
}

/// Adds a row times a factor.
#[inline(always)]
fn add<const GROUPS: usize>(
    sum: &mut [[f64; LANES]; GROUPS],
    row: &[[f64; LANES]; GROUPS],
    factor: f64,
) {
    for (sum, row) in sum.iter_mut().zip(row) {
        for (sum, entry) in sum.iter_mut().zip(row) {
            *sum += factor * entry;
        }
    }
}

#[cfg(test)]
mod tests;
