//! The Taylor series of the motion in two coordinates, from the derivatives of the groove under the tip, layer by layer.
//!
//! `A_mn = α ∫ w φ_m(η') g⁽ⁿ⁾(x0 - x') dt'`, the layers `φ_m` where the tip is and their derivatives `ψ_m = dφ_m/dη` follow
//! each other,
//!
//! ```text
//!     A_mn' = α φ_m g⁽ⁿ⁾(0) + x0' A_{m,n+1} - A_mn/T          φ_m' = ψ_m y0'/v         ψ_m = √m φ_{m-1} - √(m+1) φ_{m+1}
//!     M x0'' + x0' = Σ_m φ_m A_m1 + κ(R - x0) + F_x           y0' = (1/v) Σ_m ψ_m A_m0 - κ_y y0 + F_y
//! ```
//!
//! and of `A_mn` the coefficients up to `t^{p-n}` are all that a series of order p takes: M p³/6 products, the layers side by
//! side.

use super::layers::{LANES, Lanes, ROOTS, slopes, values};
use crate::integrator::taylor::{INVERSE, MOST_ORDER, Series};
use multiversion::multiversion;

/// What acts on the tip while it moves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Acting {
    /// κ_y
    pub(super) stiffness: f64,
    /// R', velocity of the support.
    pub(super) support: f64,
    /// 1/T, 0 where nothing heals.
    pub(super) healing: f64,
    /// M and the velocity along that the tip has, where there is inertia.
    pub(super) inertia: Option<(f64, f64)>,
    /// R - x0
    pub(super) extension: f64,
    /// y0
    pub(super) y: f64,
    /// η
    pub(super) eta: f64,
    /// v
    pub(super) width: f64,
}

/// Second derivatives of the surface under the tip: along, mixed, across.
pub(super) type Curvatures = [f64; 3];

/// Coefficients of powers of time, up to an order.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    order: usize,
    groups: usize,
    /// Row k: coefficients of t^k of A, n after n, each of all layers.
    rows: Vec<Lanes>,
    /// Row k: of φ, and of ψ.
    phi: Vec<Lanes>,
    psi: Vec<Lanes>,
    /// α g⁽ⁿ⁾(0)
    sources: [f64; MOST_ORDER + 1],
    /// Of the forces along and across.
    pub(super) force: [[f64; MOST_ORDER]; 2],
    /// Of x0' and y0'.
    velocity: [[f64; MOST_ORDER]; 2],
    /// Of x0 and y0 less their values at the start.
    displacement: [Series; 2],
}

impl Chain {
    pub(super) fn new(order: usize) -> Self {
        Self {
            order,
            groups: 0,
            rows: vec![],
            phi: vec![],
            psi: vec![],
            sources: [0.0; MOST_ORDER + 1],
            force: [[0.0; MOST_ORDER]; 2],
            velocity: [[0.0; MOST_ORDER]; 2],
            displacement: [Series::zero(order), Series::zero(order)],
        }
    }

    pub(super) fn order(&self) -> usize {
        self.order
    }

    /// Of x0 and y0, less their values at the start.
    pub(super) fn displacement(&self) -> &[Series; 2] {
        &self.displacement
    }

    /// Entries of a row.
    fn stride(&self) -> usize {
        (self.order + 1) * self.groups
    }

    /// Room for what a series of so many groups of layers begins with: A, n after n, from 0 to the order.
    pub(super) fn start(&mut self, groups: usize, alpha: f64, of_tip: &[f64]) -> &mut [Lanes] {
        if groups != self.groups {
            self.groups = groups;
            self.rows = vec![[0.0; LANES]; self.order * self.stride()];
            self.phi = vec![[0.0; LANES]; self.order * groups];
            self.psi = self.phi.clone();
        }
        self.sources.iter_mut().zip(of_tip).for_each(|(source, of_tip)| *source = alpha * of_tip);
        let stride = self.stride();
        &mut self.rows[..stride]
    }

    /// The series, from what was put into the room that [`start`](Self::start) gave, and from the forces.
    pub(super) fn run(&mut self, acting: &Acting) {
        values(acting.eta, &mut self.phi[..self.groups]);
        slopes(acting.eta, &self.phi[..self.groups], &mut self.psi[..self.groups]);
        run(self, acting);
    }

    /// Of the surface of the past, at the start.
    pub(super) fn curvatures(&self, eta: f64, width: f64) -> Curvatures {
        let groups = self.groups;
        let (phi, psi) = (&self.phi[..groups], &self.psi[..groups]);
        let mut bend = psi.to_vec();
        slopes(eta, psi, &mut bend);
        bend.as_flattened_mut().iter_mut().zip(phi.as_flattened()).for_each(|(b, phi)| *b -= phi);
        let of = |n: usize, layers: &[Lanes]| dot(layers, &self.rows[n * groups..][..groups]);
        [-of(2, phi), -of(1, psi) / width, -of(0, &bend) / (width * width)]
    }

    #[inline(always)]
    fn coefficients(&mut self, acting: &Acting) {
        if let Some((_, velocity)) = acting.inertia {
            self.velocity[0][0] = velocity;
        }
        for k in 0..self.order {
            let along = self.reading::<1>(k);
            let across = self.reading::<0>(k) / acting.width;
            self.advance(k, [along, across], acting);
            if k + 1 < self.order {
                self.next_layers(k, acting);
                self.next_row(k, acting);
            }
        }
    }

    /// Coefficient k of `Σ_m φ_m A_m1`, or of `Σ_m ψ_m A_m0`.
    #[inline(always)]
    fn reading<const N: usize>(&self, k: usize) -> f64 {
        let (groups, stride) = (self.groups, self.stride());
        let layers = if N == 1 { &self.phi } else { &self.psi };
        let mut sums = [[0.0; LANES]; 2];
        for (i, layers) in layers[..(k + 1) * groups].chunks_exact(groups).enumerate() {
            let row = &self.rows[(k - i) * stride + N * groups..][..groups];
            let sum = &mut sums[i % 2];
            for (a, b) in layers.iter().zip(row) {
                (0..LANES).for_each(|i| sum[i] += a[i] * b[i]);
            }
        }
        total(&std::array::from_fn(|i| sums[0][i] + sums[1][i]))
    }

    /// The next coefficients of velocities and displacements, from those of what the groove pushes with.
    #[inline(always)]
    fn advance(&mut self, k: usize, groove: [f64; 2], acting: &Acting) {
        let next = INVERSE[k + 1];
        let [x, y] = &mut self.displacement;
        let (extension, y_now) = match k {
            0 => (acting.extension, acting.y),
            1 => (acting.support - x.at(1), y.at(1)),
            _ => (-x.at(k), y.at(k)),
        };
        let pull = groove[0] + (extension + self.force[0][k]);
        match acting.inertia {
            None => self.velocity[0][k] = pull,
            Some((mass, _)) if k + 1 < self.order => {
                self.velocity[0][k + 1] = (pull - self.velocity[0][k]) * next / mass;
            }
            Some(_) => {}
        }
        self.velocity[1][k] = groove[1] + (self.force[1][k] - acting.stiffness * y_now);
        x.set(k + 1, self.velocity[0][k] * next);
        y.set(k + 1, self.velocity[1][k] * next);
    }

    /// φ by `φ' = ψ y0'/v`, and ψ of its neighbours; of the last layer by `ψ = √m φ_{m-1} - η φ_m`.
    #[inline(always)]
    fn next_layers(&mut self, k: usize, acting: &Acting) {
        let groups = self.groups;
        let scale = INVERSE[k + 1] / acting.width;
        let phi = &mut self.phi[(k + 1) * groups..][..groups];
        phi.fill([0.0; LANES]);
        for (i, psi) in self.psi[..(k + 1) * groups].chunks_exact(groups).enumerate() {
            let factor = scale * self.velocity[1][k - i];
            for (phi, psi) in phi.iter_mut().zip(psi) {
                (0..LANES).for_each(|i| phi[i] += factor * psi[i]);
            }
        }
        let last = |row: usize| self.phi[row * groups..].as_flattened()[groups * LANES - 1];
        let y = &self.displacement[1];
        let eta = (1..=k + 1).map(|i| y.at(i) * last(k + 1 - i)).sum::<f64>() / acting.width;
        let top = acting.eta * last(k + 1) + eta;
        let phi = self.phi[(k + 1) * groups..][..groups].as_flattened();
        let psi = self.psi[(k + 1) * groups..][..groups].as_flattened_mut();
        let highest = psi.len() - 1;
        psi[0] = -phi[1];
        for m in 1..highest {
            psi[m] = ROOTS[m] * phi[m - 1] - ROOTS[m + 1] * phi[m + 1];
        }
        psi[highest] = ROOTS[highest] * phi[highest - 1] - top;
    }

    /// Row k + 1 of A, by `Σ_i x0'_i A_{n+1,k-i}`.
    #[inline(always)]
    fn next_row(&mut self, k: usize, acting: &Acting) {
        let (groups, stride) = (self.groups, self.stride());
        let length = (self.order - k) * groups;
        let (before, after) = self.rows.split_at_mut((k + 1) * stride);
        let factors = &self.velocity[0][..=k];
        let row = &mut after[..length];
        let (blocks, rest) = row.as_chunks_mut::<BLOCK>();
        let done = blocks.len() * BLOCK;
        for (b, block) in blocks.iter_mut().enumerate() {
            *block = products(before, (stride, groups + b * BLOCK), factors);
        }
        for (b, entry) in rest.iter_mut().enumerate() {
            [*entry] = products(before, (stride, groups + done + b), factors);
        }
        let (next, old) = (INVERSE[k + 1], &before[k * stride..][..length]);
        let phi = &self.phi[k * groups..][..groups];
        let sources = row.chunks_exact_mut(groups).zip(old.chunks_exact(groups)).zip(&self.sources);
        for ((new, old), source) in sources {
            for ((new, old), phi) in new.iter_mut().zip(old).zip(phi) {
                for i in 0..LANES {
                    new[i] = next * (new[i] + source * phi[i] - acting.healing * old[i]);
                }
            }
        }
    }
}

/// Entries of a row that are summed side by side.
const BLOCK: usize = 4;

/// `Σ_i factor_i` row_{k-i} of so many entries, in this order on every machine.
#[inline(always)]
fn products<const N: usize>(
    rows: &[Lanes],
    (stride, from): (usize, usize),
    factors: &[f64],
) -> [Lanes; N] {
    let mut sums = [[0.0; LANES]; N];
    let mut at = (factors.len() - 1) * stride + from;
    for factor in factors {
        let row: &[Lanes; N] =
            rows[at..].first_chunk().unwrap_or_else(|| unreachable!("a row is longer"));
        for (sum, row) in sums.iter_mut().zip(row) {
            (0..LANES).for_each(|i| sum[i] += factor * row[i]);
        }
        at = at.wrapping_sub(stride);
    }
    sums
}

/// Compiled for wider vectors too: no products are fused with sums, and each lane is a sum of its own, so that the bits are
/// the same.
#[multiversion(targets("x86_64+avx2"))]
fn run(chain: &mut Chain, acting: &Acting) {
    chain.coefficients(acting);
}

/// Σ_m of products.
pub(super) fn dot(a: &[Lanes], b: &[Lanes]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        (0..LANES).for_each(|i| sums[i] += a[i] * b[i]);
    }
    total(&sums)
}

#[inline(always)]
fn total(sums: &Lanes) -> f64 {
    ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]))
}
