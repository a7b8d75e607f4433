//! Taylor series of the motion in two coordinates, from the derivatives of the groove under the tip, layer by layer.
//!
//! `A_mn = α ∫ w φ_m(η') g⁽ⁿ⁾(x0 - x') dt'`, the layers `φ_m` where the tip is and their derivatives `ψ_m = dφ_m/dη` follow
//! each other,
//!
//! ```text
//!     A_mn' = α φ_m g⁽ⁿ⁾(0) + x0' A_{m,n+1} - A_mn/T          φ_m' = ψ_m y0'/v         ψ_m = √m φ_{m-1} - √(m+1) φ_{m+1}
//!     M x0'' + x0' = Σ_m φ_m A_m1 + κ(R - x0) + F_x           y0' = (1/v) Σ_m ψ_m A_m0 - κ_y y0 + F_y
//! ```
//!
//! A series of order p requires only the coefficients of `A_mn` up to `t^{p-n}`: M p³/6 products, with the layers in
//! SIMD lanes.

use super::ground::Ground;
use super::layers::{LANES, Lanes, ROOTS, slopes, values};
use super::spline::Jet;
use super::weighing::Weighing;
use crate::integrator::taylor::{INVERSE, MOST_ORDER, Series};
use multiversion::multiversion;

/// Forces on the tip during the motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Acting {
    /// κ_y
    pub(super) stiffness: f64,
    /// Velocity R' of the support.
    pub(super) support: f64,
    /// 1/T; 0 without healing.
    pub(super) healing: f64,
    /// M and the velocity of the tip along the scan, if there is inertia.
    pub(super) inertia: Option<(f64, f64)>,
    /// Extension R - x0 of the spring.
    pub(super) extension: f64,
    /// y0
    pub(super) y: f64,
    /// η
    pub(super) eta: f64,
    /// v
    pub(super) width: f64,
    /// w now and σ/b, with a depth limit.
    pub(super) depth: Option<(f64, f64)>,
    /// Height and derivatives of the initial surface, undecayed part, unless it is flat.
    pub(super) relief: Option<Jet>,
}

/// Second derivatives of the surface under the tip: along, mixed, across.
pub(super) type Curvatures = [f64; 3];

/// Coefficients of powers of time, up to a given order.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    order: usize,
    groups: usize,
    /// Row k: coefficients of t^k of A, n after n, each of all layers.
    rows: Vec<Lanes>,
    /// Of ψ, then of φ, as they are to be multiplied by `A_m0` and `A_m1`; the highest power first, so that each product of two
    /// series is a sum along both.
    layers: Vec<Lanes>,
    /// α g⁽ⁿ⁾(0)
    sources: [f64; MOST_ORDER + 1],
    /// Coefficients of the forces along and across.
    pub(super) force: [[f64; MOST_ORDER]; 2],
    /// Coefficients of x0', likewise the highest first, and of y0'.
    along: [f64; MOST_ORDER],
    across: [f64; MOST_ORDER],
    /// Coefficients of x0 and y0 minus their values at the start.
    displacement: [Series; 2],
    /// Those of the height under the tip and of w, with a depth limit.
    weighing: Weighing,
    ground: Ground,
}

impl Chain {
    pub(super) fn new(order: usize) -> Self {
        Self {
            order,
            groups: 0,
            rows: vec![],
            layers: vec![],
            sources: [0.0; MOST_ORDER + 1],
            force: [[0.0; MOST_ORDER]; 2],
            along: [0.0; MOST_ORDER],
            across: [0.0; MOST_ORDER],
            displacement: [Series::zero(order), Series::zero(order)],
            weighing: Weighing::new(order),
            ground: Ground::new(),
        }
    }

    pub(super) fn order(&self) -> usize {
        self.order
    }

    /// Coefficients of x0 and y0, minus their values at the start.
    pub(super) fn displacement(&self) -> &[Series; 2] {
        &self.displacement
    }

    /// Coefficients of the height under the tip, with a depth limit.
    pub(super) fn height(&self) -> &Series {
        self.weighing.height()
    }

    /// Coefficients of w, with a depth limit.
    pub(super) fn weights(&self) -> &Series {
        self.weighing.weights()
    }

    /// Number of entries in a row.
    fn stride(&self) -> usize {
        (self.order + 1) * self.groups
    }

    /// Index of the layers at the start.
    fn first_layers(&self) -> usize {
        (self.order - 1) * 2 * self.groups
    }

    /// Room for the initial values of a series with this number of groups of layers: A, for n = 0 to the order.
    pub(super) fn start(&mut self, groups: usize, alpha: f64, of_tip: &[f64]) -> &mut [Lanes] {
        if groups != self.groups {
            self.groups = groups;
            self.rows = vec![[0.0; LANES]; self.order * self.stride()];
            self.layers = vec![[0.0; LANES]; self.order * 2 * groups];
        }
        self.sources.iter_mut().zip(of_tip).for_each(|(source, of_tip)| *source = alpha * of_tip);
        let stride = self.stride();
        &mut self.rows[..stride]
    }

    /// Computes the layers under the tip, after [`start`](Self::start).
    pub(super) fn stand_at(&mut self, eta: f64) {
        let first = self.first_layers();
        let (psi, phi) = self.layers[first..].split_at_mut(self.groups);
        values(eta, 1.0, phi);
        slopes(eta, phi, psi);
    }

    /// Depth of the groove under the tip at the start, from the values written to the room of
    /// [`start`](Self::start), without the initial surface.
    pub(super) fn depth_now(&self) -> f64 {
        dot(&self.layers[self.first_layers() + self.groups..], &self.rows[..self.groups])
    }

    /// Computes the series from the values written to the room of [`start`](Self::start), and from the forces.
    pub(super) fn run(&mut self, acting: &Acting) {
        if let Some(jet) = &acting.relief {
            self.ground.start(jet);
        }
        if let Some((weight, _)) = acting.depth {
            let relief = acting.relief.map_or(0.0, |jet| jet[0][0]);
            self.weighing.start(relief - self.depth_now(), weight, self.groups);
        }
        run(self, acting);
    }

    /// Curvatures of the surface of the past at the start; `room` has the size of as many groups of layers.
    pub(super) fn curvatures(&self, eta: f64, width: f64, room: &mut Vec<Lanes>) -> Curvatures {
        let groups = self.groups;
        let (psi, phi) = self.layers[self.first_layers()..].split_at(groups);
        room.resize(groups, [0.0; LANES]);
        slopes(eta, psi, room);
        room.as_flattened_mut().iter_mut().zip(phi.as_flattened()).for_each(|(b, phi)| *b -= phi);
        let of = |n: usize, layers: &[Lanes]| dot(layers, &self.rows[n * groups..][..groups]);
        [-of(2, phi), -of(1, psi) / width, -of(0, room) / (width * width)]
    }

    /// The coefficients for a number of groups: if the compiler knows it, it unrolls the loops over them.
    #[inline(always)]
    fn coefficients(&mut self, groups: usize, acting: &Acting) {
        if let Some((_, velocity)) = acting.inertia {
            self.along[MOST_ORDER - 1] = velocity;
        }
        for k in 0..self.order {
            let [across, along] = self.reading(groups, k);
            let [mut along, mut across] = [along, across / acting.width];
            if acting.relief.is_some() {
                let jet = self.ground.at(k);
                (along, across) = (along - jet[1][0], across - jet[0][1]);
            }
            self.advance(k, [along, across], acting);
            if k + 1 < self.order {
                self.next_layers(groups, k, acting);
                self.next_row(groups, k, acting);
                self.next_height(groups, k, acting);
            }
        }
    }

    /// Coefficients of order k of `Σ_m ψ_m A_m0` and `Σ_m φ_m A_m1`.
    #[inline(always)]
    fn reading(&self, groups: usize, k: usize) -> [f64; 2] {
        let (both, stride) = (2 * groups, (self.order + 1) * groups);
        let layers = self.layers[(self.order - 1 - k) * both..].chunks_exact(both);
        let (mut across, mut along) = ([0.0; LANES], [0.0; LANES]);
        for (layers, row) in layers.zip(self.rows.chunks_exact(stride)) {
            let ((psi, phi), (value, slope)) = (layers.split_at(groups), row.split_at(groups));
            for (psi, value) in psi.iter().zip(value) {
                add_product(&mut across, psi, value);
            }
            for (phi, slope) in phi.iter().zip(slope) {
                add_product(&mut along, phi, slope);
            }
        }
        [total(&across), total(&along)]
    }

    /// The next coefficients of the initial surface under the tip, and with a depth limit of height and weight.
    #[inline(always)]
    fn next_height(&mut self, groups: usize, k: usize, acting: &Acting) {
        let mut relief = 0.0;
        if acting.relief.is_some() {
            self.ground.advance(&self.along, &self.across, acting.healing);
            relief = self.ground.at(k + 1)[0][0];
        }
        if let Some((_, rate)) = acting.depth {
            let height = relief - self.depth(groups, k + 1);
            self.weighing.advance(k, height, rate);
        }
    }

    /// Coefficient of order k of the depth `Σ_m φ_m A_m0`.
    #[inline(always)]
    fn depth(&self, groups: usize, k: usize) -> f64 {
        let (both, stride) = (2 * groups, (self.order + 1) * groups);
        let layers = self.layers[(self.order - 1 - k) * both..].chunks_exact(both);
        let mut sum = [0.0; LANES];
        for (layers, row) in layers.zip(self.rows.chunks_exact(stride)) {
            for (phi, value) in layers[groups..].iter().zip(&row[..groups]) {
                add_product(&mut sum, phi, value);
            }
        }
        total(&sum)
    }

    /// The next coefficients of velocities and displacements, from those of the forces of the groove.
    #[inline(always)]
    fn advance(&mut self, k: usize, groove: [f64; 2], acting: &Acting) {
        let next = INVERSE[k + 1];
        let [x, y] = &mut self.displacement;
        let (extension, y_now) = match k {
            0 => (acting.extension, acting.y),
            1 => (acting.support - x.at(1), y.at(1)),
            _ => (-x.at(k), y.at(k)),
        };
        let (pull, at) = (groove[0] + (extension + self.force[0][k]), MOST_ORDER - 1 - k);
        match acting.inertia {
            None => self.along[at] = pull,
            Some((mass, _)) if k + 1 < self.order => {
                self.along[at - 1] = (pull - self.along[at]) * next / mass;
            }
            Some(_) => {}
        }
        self.across[k] = groove[1] + (self.force[1][k] - acting.stiffness * y_now);
        x.set(k + 1, self.along[at] * next);
        y.set(k + 1, self.across[k] * next);
    }

    /// φ by `φ' = ψ y0'/v`, and ψ of its neighbours; of the last layer by `ψ = √m φ_{m-1} - η φ_m`.
    #[inline(always)]
    fn next_layers(&mut self, groups: usize, k: usize, acting: &Acting) {
        let both = 2 * groups;
        let (scale, y) = (INVERSE[k + 1] / acting.width, &self.displacement[1]);
        let known = (self.order - 1 - k) * both;
        let (new, before) = self.layers[known - both..].split_at_mut(both);
        let (psi, phi) = new.split_at_mut(groups);
        let before = before.chunks_exact(both);
        for (g, phi) in phi.iter_mut().enumerate() {
            let mut sum = [0.0; LANES];
            for (psi, across) in before.clone().zip(&self.across[..=k]) {
                add(&mut sum, &psi[g], *across);
            }
            *phi = times(&sum, scale);
        }
        let mut top = 0.0;
        for (phi, y) in before.zip(&y.coefficients()[1..]) {
            top += y * phi[both - 1][LANES - 1];
        }
        let top = acting.eta * phi[groups - 1][LANES - 1] + top / acting.width;
        let (psi, phi) = (psi.as_flattened_mut(), phi.as_flattened());
        let highest = groups * LANES - 1;
        psi[0] = -phi[1];
        for m in 1..highest {
            psi[m] = ROOTS[m] * phi[m - 1] - ROOTS[m + 1] * phi[m + 1];
        }
        psi[highest] = ROOTS[highest] * phi[highest - 1] - top;
    }

    /// Row k + 1 of A, by `Σ_i x0'_i A_{n+1,k-i}`.
    #[inline(always)]
    fn next_row(&mut self, groups: usize, k: usize, acting: &Acting) {
        let stride = (self.order + 1) * groups;
        let (before, after) = self.rows.split_at_mut((k + 1) * stride);
        let row = &mut after[..(self.order - k) * groups];
        let layers = &self.layers[(self.order - 1 - k) * 2 * groups..];
        let phi = match acting.depth {
            None => &layers[groups..2 * groups],
            Some(_) => self.weighing.carve(k, groups, layers, 2 * groups),
        };
        let scale = INVERSE[k + 1];
        for (new, source) in row.chunks_exact_mut(groups).zip(&self.sources) {
            for (new, phi) in new.iter_mut().zip(phi) {
                *new = times(phi, scale * source);
            }
        }
        if acting.healing > 0.0 {
            for (new, old) in row.iter_mut().zip(&before[k * stride..]) {
                add(new, old, -scale * acting.healing);
            }
        }
        let factors = &self.along[MOST_ORDER - 1 - k..];
        let sums = Sums { rows: before, stride, factors, scale };
        let (blocks, rest) = row.as_chunks_mut::<BLOCK>();
        let done = groups + blocks.len() * BLOCK;
        let (fours, rest_of_fours) = rest.as_chunks_mut::<4>();
        let done_fours = done + fours.len() * 4;
        let (twos, ones) = rest_of_fours.as_chunks_mut::<2>();
        let done_twos = done_fours + twos.len() * 2;
        for (b, block) in blocks.iter_mut().enumerate() {
            sums.add(groups + b * BLOCK, block);
        }
        for block in fours {
            sums.add(done, block);
        }
        for block in twos {
            sums.add(done_fours, block);
        }
        for entry in ones {
            sums.add(done_twos, std::array::from_mut(entry));
        }
    }
}

/// Number of entries of a row that are summed in SIMD lanes.
const BLOCK: usize = 12;

/// Rows one after the other, with factors of them and one of their sum.
struct Sums<'a> {
    rows: &'a [Lanes],
    stride: usize,
    factors: &'a [f64],
    scale: f64,
}

impl Sums<'_> {
    /// Adds the sum of the rows times their factors, from a given entry on; in this order on every machine.
    #[inline(always)]
    fn add<const N: usize>(&self, from: usize, to: &mut [Lanes; N]) {
        let mut sums = [[0.0; LANES]; N];
        for (row, factor) in self.rows.chunks_exact(self.stride).zip(self.factors) {
            let Some((row, _)) = row[from..].split_first_chunk::<N>() else { return };
            for (sum, row) in sums.iter_mut().zip(row) {
                add(sum, row, *factor);
            }
        }
        for (to, sum) in to.iter_mut().zip(&sums) {
            add(to, sum, self.scale);
        }
    }
}

/// Also compiled for wider vectors: products and sums are not fused, and each lane is a separate sum, so that the
/// bits are the same.
#[multiversion(targets("x86_64+avx2"))]
fn run(chain: &mut Chain, acting: &Acting) {
    match chain.groups {
        2 => chain.coefficients(2, acting),
        3 => chain.coefficients(3, acting),
        4 => chain.coefficients(4, acting),
        groups => chain.coefficients(groups, acting),
    }
}

/// Σ_m of products.
pub(super) fn dot(a: &[Lanes], b: &[Lanes]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        add_product(&mut sums, a, b);
    }
    total(&sums)
}

// Loops throughout: closures that iterators call are not compiled for wider vectors.

#[inline(always)]
fn add(sum: &mut Lanes, row: &Lanes, factor: f64) {
    for i in 0..LANES {
        sum[i] += factor * row[i];
    }
}

#[inline(always)]
fn add_product(sum: &mut Lanes, a: &Lanes, b: &Lanes) {
    for i in 0..LANES {
        sum[i] += a[i] * b[i];
    }
}

#[inline(always)]
fn times(row: &Lanes, factor: f64) -> Lanes {
    let mut product = [0.0; LANES];
    for i in 0..LANES {
        product[i] = factor * row[i];
    }
    product
}

#[inline(always)]
fn total(sums: &Lanes) -> f64 {
    // One after the other: sums in pairs would be made in pairs from the start.
    ((sums[0] + sums[1]) + sums[2]) + sums[3]
}
