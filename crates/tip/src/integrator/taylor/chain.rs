//! The Taylor series of the tip's motion, from the derivatives of the groove under it.
//!
//! With exponentials for f the system is polynomial. Its unknowns need not be the states of the exponentials: the
//! derivatives of the groove where the tip is, `g_n = α ∫ f⁽ⁿ⁾(x0 - x0(t'))dt' - ∂ⁿu0`, follow each other,
//!
//! ```text
//!     g_n' = α f⁽ⁿ⁾(0) + v g_{n+1} - g_n/T        M v' + v = g_1 + κ(R - x0) + F        x0' = v
//! ```
//!
//! and of `g_n` the coefficients up to `t^{p-n}` are all that x0 takes up to `t^p`: a triangle of p³/6 products, the n
//! side by side.

use crate::memory::ROOM;

/// The highest order.
pub(super) const MOST_ORDER: usize = 28;
/// Lanes that are summed side by side.
const LANES: usize = 4;
/// Of a row, with room for a group of lanes that begins one after the first.
const WIDTH: usize = ROOM + LANES;
type Row = [f64; WIDTH];

/// What acts on the tip while it moves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Acting {
    /// κ
    pub(super) spring: f64,
    /// R', velocity of the support.
    pub(super) support: f64,
    /// 1/T, 0 where nothing heals.
    pub(super) healing: f64,
    /// M and the velocity that the tip has, where there is inertia.
    pub(super) inertia: Option<(f64, f64)>,
    /// R - x0
    pub(super) extension: f64,
}

/// Coefficients of powers of time, up to an order.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    order: usize,
    /// Row k: coefficients of t^k of `g_1`, `g_2`, …
    rows: Box<[Row; MOST_ORDER]>,
    /// Sources: α f', α f'', … at 0.
    sources: Row,
    /// Of the force.
    pub(super) force: [f64; MOST_ORDER],
    velocity: [f64; MOST_ORDER],
    /// Of x0 less its value at the start.
    displacement: [f64; MOST_ORDER + 1],
}

impl Chain {
    pub(super) fn new() -> Self {
        Self {
            order: 0,
            rows: Box::new([[0.0; WIDTH]; MOST_ORDER]),
            sources: [0.0; WIDTH],
            force: [0.0; MOST_ORDER],
            velocity: [0.0; MOST_ORDER],
            displacement: [0.0; MOST_ORDER + 1],
        }
    }

    /// Of x0 less its value at the start.
    pub(super) fn displacement(&self) -> &[f64] {
        &self.displacement[..=self.order]
    }

    pub(super) fn velocity(&self) -> &[f64] {
        &self.velocity[..self.order]
    }

    /// `g_2`, minus the stiffness of the groove, at the start.
    pub(super) fn curvature(&self) -> f64 {
        self.rows[0][1]
    }

    /// Room for `g_1`, `g_2`, … now, and for `α f'(0)`, `α f''(0)`, …
    pub(super) fn start(&mut self, order: usize) -> (&mut [f64], &mut [f64]) {
        self.order = order;
        (&mut self.rows[0][..ROOM], &mut self.sources[..ROOM])
    }

    /// The series, from what [`start`](Self::start) was filled with and from the force.
    pub(super) fn run(&mut self, acting: &Acting) {
        let order = self.order;
        // Of R - x0.
        let mut extension = acting.extension;
        if let Some((_, velocity)) = acting.inertia {
            self.velocity[0] = velocity;
        }
        for k in 0..order {
            let next = 1.0 / (k + 1) as f64;
            let pull = self.rows[k][0] + acting.spring * extension + self.force[k];
            match acting.inertia {
                None => self.velocity[k] = pull,
                Some((mass, _)) if k + 1 < order => {
                    self.velocity[k + 1] = (pull - self.velocity[k]) * next / mass;
                }
                Some(_) => {}
            }
            self.displacement[k + 1] = self.velocity[k] * next;
            extension = if k == 0 { acting.support } else { 0.0 } - self.displacement[k + 1];
            if k + 1 < order {
                self.next_row(k, next, acting.healing);
            }
        }
    }

    /// Row k + 1: of so many `g_n` as the order needs.
    fn next_row(&mut self, k: usize, next: f64, healing: f64) {
        let needed = self.order - 1 - k;
        match needed.div_ceil(LANES) {
            1 => self.products::<1>(k, next, healing),
            2 => self.products::<2>(k, next, healing),
            3 => self.products::<3>(k, next, healing),
            4 => self.products::<4>(k, next, healing),
            5 => self.products::<5>(k, next, healing),
            6 => self.products::<6>(k, next, healing),
            _ => self.products::<7>(k, next, healing),
        }
    }

    /// `Σ_i v_i g_{n+1, k-i}`, every other product of a sum of its own: in this order on every machine.
    #[inline]
    fn products<const GROUPS: usize>(&mut self, k: usize, next: f64, healing: f64) {
        let (rows, velocity) = (&self.rows[..=k], &self.velocity[..=k]);
        let mut sums = [[[0.0; LANES]; GROUPS]; 2];
        let mut pairs = rows.chunks_exact(2);
        let mut factors = velocity.rchunks_exact(2);
        for (rows, factors) in pairs.by_ref().zip(factors.by_ref()) {
            for ((sum, row), factor) in sums.iter_mut().zip(rows).zip(factors.iter().rev()) {
                add::<GROUPS>(sum, row, *factor);
            }
        }
        if let (Some(row), Some(factor)) = (pairs.remainder().first(), factors.remainder().first())
        {
            add::<GROUPS>(&mut sums[0], row, *factor);
        }
        if k == 0 {
            for (sum, source) in sums[1].as_flattened_mut().iter_mut().zip(&self.sources) {
                *sum += source;
            }
        }
        let (before, after) = self.rows.split_at_mut(k + 1);
        let [even, odd] = &sums;
        let lanes = even.as_flattened().iter().zip(odd.as_flattened()).zip(&before[k]);
        for (new, ((even, odd), old)) in after[0].iter_mut().zip(lanes) {
            *new = next * ((even + odd) - healing * old);
        }
    }
}

/// Adds a row, from its second entry on, times a factor.
#[inline(always)]
fn add<const GROUPS: usize>(sum: &mut [[f64; LANES]; GROUPS], row: &Row, factor: f64) {
    for (sum, row) in sum.iter_mut().zip(row[1..].as_chunks::<LANES>().0) {
        for (sum, entry) in sum.iter_mut().zip(row) {
            *sum += factor * entry;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex;

    const ORDER: usize = 22;
    const ALPHA: f64 = 1.3;

    /// (s, w, z)
    fn modes() -> Vec<[Complex<f64>; 3]> {
        let c = Complex::new;
        vec![
            [c(-1.9, 0.0), c(0.7, 0.0), c(1.2, 0.0)],
            [c(-1.4, 1.1), c(-0.4, 0.9), c(0.3, 0.5)],
            [c(-2.2, 2.6), c(0.2, -0.3), c(-0.2, 0.1)],
        ]
    }

    /// The definition: z' = 1 + (sv - 1/T)z for each exponential, and v from all of them. Displacements.
    fn by_modes(acting: &Acting, force: &[f64]) -> Vec<f64> {
        let modes = modes();
        let mut z: Vec<Vec<Complex<f64>>> = modes.iter().map(|m| vec![m[2]]).collect();
        let (mut v, mut d) = (vec![], vec![0.0]);
        v.extend(acting.inertia.map(|(_, velocity)| velocity));
        for k in 0..ORDER {
            let slope: f64 = modes.iter().zip(&z).map(|(m, z)| (m[1] * z[k]).re).sum();
            let extension = match k {
                0 => acting.extension,
                1 => acting.support - d[1],
                _ => -d[k],
            };
            let pull = ALPHA * slope + acting.spring * extension + force[k];
            match acting.inertia {
                None => v.push(pull),
                Some((mass, _)) => v.push((pull - v[k]) / (mass * (k + 1) as f64)),
            }
            for (m, z) in modes.iter().zip(&mut z) {
                let carried: Complex<f64> = (0..=k).map(|i| v[i] * z[k - i]).sum();
                let source = if k == 0 { 1.0 } else { 0.0 };
                let next = m[0] * carried + source - acting.healing * z[k];
                z.push(next / (k + 1) as f64);
            }
            d.push(v[k] / (k + 1) as f64);
        }
        d
    }

    #[test]
    fn the_series_is_that_of_the_exponentials() {
        let force: Vec<f64> = (0..ORDER).map(|k| 0.3 / (1.0 + (k * k) as f64)).collect();
        for (healing, inertia) in [(0.0, None), (0.7, None), (0.4, Some((0.6, 0.9)))] {
            let acting = Acting { spring: 1.0, support: 0.8, healing, inertia, extension: 1.7 };
            let mut chain = Chain::new();
            // Left over from a step before.
            chain.rows.iter_mut().flatten().for_each(|entry| *entry = 7.0);
            let (groove, sources) = chain.start(ORDER);
            for n in 0..ORDER {
                let power = |m: &[Complex<f64>; 3]| m[1] * m[0].powu(n as u32);
                groove[n] = ALPHA * modes().iter().map(|m| (power(m) * m[2]).re).sum::<f64>();
                sources[n] = ALPHA * modes().iter().map(|m| power(m).re).sum::<f64>();
            }
            chain.force[..ORDER].copy_from_slice(&force);
            chain.run(&acting);
            let (slow, fast) = (by_modes(&acting, &force), chain.displacement());
            assert_eq!(slow.len(), fast.len());
            for (k, (slow, fast)) in slow.iter().zip(fast).enumerate() {
                assert!((slow - fast).abs() <= 1e-11 * slow.abs(), "{k}: {slow} {fast}");
            }
        }
    }
}
