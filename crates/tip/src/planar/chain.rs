//! Taylor series of the motion in two coordinates, from the derivatives of the groove under the tip, layer by layer.
//!
//! `A_mn = α ∫ w φ_m(η') g⁽ⁿ⁾(x0 - x') dt'`, the [layers](super::layers) `φ_m` under the tip and their derivatives `ψ_m
//! = dφ_m/dη` obey
//!
//! ```text
//!     A_mn' = α φ_m g⁽ⁿ⁾(0) + x0' A_{m,n+1} - A_mn/T          φ_m' = ψ_m y0'/v         ψ_m = √m φ_{m-1} - √(m+1) φ_{m+1}
//!     M x0'' + x0' = Σ_m φ_m A_m1 + κ(R - x0) + F_x           y0' = (1/v) Σ_m ψ_m A_m0 - κ_y y0 + F_y
//! ```
//!
//! A series of order p requires only the coefficients of `A_mn` up to `t^{p-n}`: p³/6 products for each layer, with the
//! layers in SIMD lanes. If the footprint is a sum of products g(x) h(y), each product has a groove with layers of its
//! own, and their forces add up. If h is a sum of Gaussians, the layers that are read differ from those that visits
//! contribute to. The former are those of [`Bells`]; they obey the same recurrences, and a few more of them are needed.

use super::bells::Bells;
use super::ground::Ground;
use super::layers::{LANES, Lanes, ROOTS, add, add_product, dot, total};
use super::part::Part;
use super::spline::Partials;
use super::weighing::Weighing;
use crate::integrator::taylor::{INVERSE, MOST_ORDER, Series};
use multiversion::multiversion;

/// The terms of the equations of motion during a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Acting {
    /// Stiffness κ_y of the spring across the scan.
    pub(super) stiffness: f64,
    /// Velocity R' of the support.
    pub(super) support: f64,
    /// 1/T; 0 without healing.
    pub(super) healing: f64,
    /// M and the velocity of the tip along the scan at the start, with inertia.
    pub(super) inertia: Option<(f64, f64)>,
    /// Extension R - x0 of the spring at the start.
    pub(super) extension: f64,
    /// y0 at the start.
    pub(super) y: f64,
    /// w at the start and ±1/b for the side of the kink, with a depth limit.
    pub(super) depth: Option<(f64, f64)>,
    /// Undecayed part of the height and the derivatives of the initial surface; `None` if it is flat.
    pub(super) relief: Option<Partials>,
}

/// Second derivatives of the surface under the tip: along, mixed, across.
pub(super) type Curvatures = [f64; 3];

/// The Taylor coefficients of a step, up to a given order.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    order: usize,
    /// The groove of each product of the footprint.
    grooves: Vec<Groove>,
    /// Coefficients of the forces along and across.
    pub(super) force: [[f64; MOST_ORDER]; 2],
    motion: Motion,
    /// Coefficients of the height under the tip and of w, with a depth limit.
    weighing: Weighing,
    ground: Ground,
}

/// The motion as a series.
#[derive(Debug, Clone)]
struct Motion {
    /// Coefficients of x0', the highest first, and of y0'.
    along: [f64; MOST_ORDER],
    across: [f64; MOST_ORDER],
    /// Coefficients of x0 and y0 minus their values at the start.
    displacement: [Series; 2],
}

/// The groove of a product g(x) h(y).
#[derive(Debug, Clone)]
struct Groove {
    order: usize,
    groups: usize,
    /// 1/v, and η at the start.
    per_width: f64,
    eta: f64,
    /// Row k: coefficients of t^k of `A_mn` for n = 0, 1, …, and for each n of all layers m.
    rows: Vec<Lanes>,
    /// Layers of visits.
    visits: Ladder,
    /// Layers that are read, where they differ.
    read: Option<Ladder>,
    /// α g⁽ⁿ⁾(0)
    sources: [f64; MOST_ORDER + 1],
}

/// Taylor coefficients of the layers under the tip: for each order ψ, then φ. The highest order is first, so that a
/// product of two series is a sum in the order of both arrays.
#[derive(Debug, Clone)]
struct Ladder {
    order: usize,
    groups: usize,
    layers: Vec<Lanes>,
}

impl Ladder {
    fn new(order: usize, groups: usize) -> Self {
        Self { order, groups, layers: vec![[0.0; LANES]; order * 2 * groups] }
    }

    /// ψ and φ at the start.
    fn first(&self) -> (&[Lanes], &[Lanes]) {
        self.layers[(self.order - 1) * 2 * self.groups..].split_at(self.groups)
    }

    /// Sets ψ and φ at the start.
    fn stand_at(&mut self, bells: &Bells, eta: f64, room: &mut Vec<Lanes>) {
        let (psi, phi) =
            self.layers[(self.order - 1) * 2 * self.groups..].split_at_mut(self.groups);
        bells.read(eta, phi, psi, room);
    }

    /// The coefficients of the orders from k down to 0.
    #[inline(always)]
    fn down_from(&self, groups: usize, k: usize) -> &[Lanes] {
        &self.layers[(self.order - 1 - k) * 2 * groups..]
    }

    /// Computes order k + 1 of φ by `φ' = ψ y0'/v`, and from it that of ψ. ψ of the last layer lacks the contribution
    /// of the layer above.
    #[inline(always)]
    fn advance(&mut self, groups: usize, k: usize, motion: &Motion, per_width: f64) {
        let both = 2 * groups;
        let scale = INVERSE[k + 1] * per_width;
        let known = (self.order - 1 - k) * both;
        let (new, before) = self.layers[known - both..].split_at_mut(both);
        let (psi, phi) = new.split_at_mut(groups);
        let before = before.chunks_exact(both);
        for (g, phi) in phi.iter_mut().enumerate() {
            let mut sum = [0.0; LANES];
            for (psi, across) in before.clone().zip(&motion.across[..=k]) {
                add(&mut sum, &psi[g], *across);
            }
            *phi = times(&sum, scale);
        }
        let (psi, phi) = (psi.as_flattened_mut(), phi.as_flattened());
        let highest = groups * LANES - 1;
        psi[0] = -phi[1];
        for m in 1..highest {
            psi[m] = ROOTS[m] * phi[m - 1] - ROOTS[m + 1] * phi[m + 1];
        }
        psi[highest] = ROOTS[highest] * phi[highest - 1];
    }

    /// Completes ψ of the last layer after [`advance`](Self::advance), for a single Gaussian: `ψ = √m φ_{m-1} - η φ_m`.
    #[inline(always)]
    fn close(&mut self, groups: usize, k: usize, y: &Series, (eta, per_width): (f64, f64)) {
        let both = 2 * groups;
        let known = (self.order - 1 - k) * both;
        let (new, before) = self.layers[known - both..].split_at_mut(both);
        let mut top = 0.0;
        for (phi, y) in before.chunks_exact(both).zip(&y.coefficients()[1..]) {
            top += y * phi[both - 1][LANES - 1];
        }
        let top = eta * new[both - 1][LANES - 1] + top * per_width;
        new[groups - 1][LANES - 1] -= top;
    }
}

impl Chain {
    pub(super) fn new(order: usize, products: usize) -> Self {
        let zero = [0.0; MOST_ORDER];
        let displacement = [Series::zero(order), Series::zero(order)];
        Self {
            order,
            grooves: vec![Groove::new(order); products],
            force: [zero; 2],
            motion: Motion { along: zero, across: zero, displacement },
            weighing: Weighing::new(order),
            ground: Ground::new(),
        }
    }

    pub(super) fn order(&self) -> usize {
        self.order
    }

    /// Coefficients of x0 and y0, minus their values at the start.
    pub(super) fn displacement(&self) -> &[Series; 2] {
        &self.motion.displacement
    }

    /// Coefficients of the height under the tip, with a depth limit.
    pub(super) fn height(&self) -> &Series {
        self.weighing.height()
    }

    /// Coefficients of w, with a depth limit.
    pub(super) fn weights(&self) -> &Series {
        self.weighing.weights()
    }

    /// Room for the initial values of the groove of a product: `A_mn` for n = 0 to the order. `of_tip` are the
    /// derivatives of g at 0.
    pub(super) fn start(
        &mut self,
        product: usize,
        groups: usize,
        (alpha, of_tip): (f64, &[f64]),
    ) -> &mut [Lanes] {
        self.grooves[product].start(groups, alpha, of_tip)
    }

    /// Computes the layers of a product under the tip, after [`start`](Self::start).
    pub(super) fn stand_at(
        &mut self,
        product: usize,
        bells: &Bells,
        eta: f64,
        room: &mut Vec<Lanes>,
    ) {
        self.grooves[product].stand_at(bells, eta, room);
    }

    /// Depth of the grooves under the tip at the start, from the values written to the room of
    /// [`start`](Self::start), without the initial surface.
    pub(super) fn depth_now(&self) -> f64 {
        let depth =
            |groove: &Groove| dot(groove.reading().first().1, &groove.rows[..groove.groups]);
        self.grooves.iter().map(depth).sum()
    }

    /// Computes the series from the values written to the room of [`start`](Self::start), and from the forces.
    pub(super) fn run(&mut self, acting: &Acting) {
        if let Some(jet) = &acting.relief {
            self.ground.start(jet);
        }
        if let Some((weight, _)) = acting.depth {
            let relief = acting.relief.map_or(0.0, |jet| jet[0][0]);
            self.weighing.start(relief - self.depth_now(), weight);
        }
        run(self, acting);
    }

    /// Curvatures of the surface of the past at the start.
    pub(super) fn curvatures(&self, parts: &[Part], room: &mut Vec<Lanes>) -> Curvatures {
        let mut sum = [0.0; 3];
        for (groove, part) in self.grooves.iter().zip(parts) {
            let curvatures = groove.curvatures(&part.bells, room);
            sum.iter_mut().zip(curvatures).for_each(|(sum, curvature)| *sum += curvature);
        }
        sum
    }

    /// Computes the coefficients. If the compiler knows the number of groups of a single groove, it unrolls the loops
    /// over them.
    #[inline(always)]
    fn coefficients(&mut self, known: Option<usize>, acting: &Acting) {
        if let Some((_, velocity)) = acting.inertia {
            self.motion.along[MOST_ORDER - 1] = velocity;
        }
        for k in 0..self.order {
            let (mut along, mut across) = (0.0, 0.0);
            for groove in &self.grooves {
                let [slope, beside] = groove.slopes(known, k);
                along += slope;
                across += beside * groove.per_width;
            }
            if acting.relief.is_some() {
                let jet = self.ground.at(k);
                (along, across) = (along - jet[1][0], across - jet[0][1]);
            }
            self.advance(k, [along, across], acting);
            if k + 1 < self.order {
                for groove in &mut self.grooves {
                    groove.next(known, k, (&self.motion, &mut self.weighing), acting);
                }
                self.next_height(known, k, acting);
            }
        }
    }

    /// Computes the next coefficients of the initial surface under the tip and, with a depth limit, of height and
    /// weight.
    #[inline(always)]
    fn next_height(&mut self, known: Option<usize>, k: usize, acting: &Acting) {
        let mut relief = 0.0;
        if acting.relief.is_some() {
            let Motion { along, across, .. } = &self.motion;
            self.ground.advance(along, across, acting.healing);
            relief = self.ground.at(k + 1)[0][0];
        }
        if let Some((_, rate)) = acting.depth {
            let depth: f64 = self.grooves.iter().map(|groove| groove.depth(known, k + 1)).sum();
            self.weighing.advance(k, relief - depth, rate);
        }
    }

    /// Computes the next coefficients of velocities and displacements from those of the forces of the grooves.
    #[inline(always)]
    fn advance(&mut self, k: usize, groove: [f64; 2], acting: &Acting) {
        let next = INVERSE[k + 1];
        let Motion { along, across, displacement: [x, y] } = &mut self.motion;
        let (extension, y_now) = match k {
            0 => (acting.extension, acting.y),
            1 => (acting.support - x.at(1), y.at(1)),
            _ => (-x.at(k), y.at(k)),
        };
        let (pull, at) = (groove[0] + (extension + self.force[0][k]), MOST_ORDER - 1 - k);
        match acting.inertia {
            None => along[at] = pull,
            Some((mass, _)) if k + 1 < self.order => {
                along[at - 1] = (pull - along[at]) * next / mass;
            }
            Some(_) => {}
        }
        across[k] = groove[1] + (self.force[1][k] - acting.stiffness * y_now);
        x.set(k + 1, along[at] * next);
        y.set(k + 1, across[k] * next);
    }
}

impl Groove {
    fn new(order: usize) -> Self {
        Self {
            order,
            groups: 0,
            per_width: 1.0,
            eta: 0.0,
            rows: vec![],
            visits: Ladder::new(order, 0),
            read: None,
            sources: [0.0; MOST_ORDER + 1],
        }
    }

    /// Number of entries in a row.
    fn stride(&self) -> usize {
        (self.order + 1) * self.groups
    }

    fn start(&mut self, groups: usize, alpha: f64, of_tip: &[f64]) -> &mut [Lanes] {
        if groups != self.groups {
            self.groups = groups;
            self.rows = vec![[0.0; LANES]; self.order * self.stride()];
            self.visits = Ladder::new(self.order, groups);
            self.read = None;
        }
        self.sources.iter_mut().zip(of_tip).for_each(|(source, of_tip)| *source = alpha * of_tip);
        let stride = self.stride();
        &mut self.rows[..stride]
    }

    fn stand_at(&mut self, bells: &Bells, eta: f64, room: &mut Vec<Lanes>) {
        (self.eta, self.per_width) = (eta, 1.0 / bells.width());
        self.visits.stand_at(&Bells::single(bells.width()), eta, room);
        if !bells.is_single() {
            // Order k of layer m takes order 0 of layer m + k.
            let groups = self.groups + (self.order - 1).div_ceil(LANES);
            let read = self.read.get_or_insert_with(|| Ladder::new(self.order, groups));
            read.stand_at(bells, eta, room);
        }
    }

    /// The layers that are read.
    #[inline(always)]
    fn reading(&self) -> &Ladder {
        self.read.as_ref().unwrap_or(&self.visits)
    }

    fn curvatures(&self, bells: &Bells, room: &mut Vec<Lanes>) -> Curvatures {
        let (groups, per_width) = (self.groups, self.per_width);
        let (psi, phi) = self.reading().first();
        let of = |n: usize, layers: &[Lanes]| dot(layers, &self.rows[n * groups..][..groups]);
        let [along, mixed] = [of(2, phi), of(1, psi)];
        let bend = bells.bend(self.eta, groups, room);
        [-along, -mixed * per_width, -of(0, bend) * (per_width * per_width)]
    }

    /// Coefficients of order k of `Σ_m φ_m A_m1` and `Σ_m ψ_m A_m0`.
    #[inline(always)]
    fn slopes(&self, known: Option<usize>, k: usize) -> [f64; 2] {
        let groups = known.unwrap_or(self.groups);
        let ladder = self.reading();
        let wide = known.unwrap_or(ladder.groups);
        let stride = (self.order + 1) * groups;
        let layers = ladder.down_from(wide, k).chunks_exact(2 * wide);
        let (mut across, mut along) = ([0.0; LANES], [0.0; LANES]);
        for (layers, row) in layers.zip(self.rows.chunks_exact(stride)) {
            let ((psi, phi), (value, slope)) = (layers.split_at(wide), row.split_at(groups));
            for (psi, value) in psi.iter().zip(value) {
                add_product(&mut across, psi, value);
            }
            for (phi, slope) in phi[..groups].iter().zip(slope) {
                add_product(&mut along, phi, slope);
            }
        }
        [total(&along), total(&across)]
    }

    /// Coefficient of order k of the depth `Σ_m φ_m A_m0`.
    #[inline(always)]
    fn depth(&self, known: Option<usize>, k: usize) -> f64 {
        let groups = known.unwrap_or(self.groups);
        let ladder = self.reading();
        let wide = known.unwrap_or(ladder.groups);
        let stride = (self.order + 1) * groups;
        let layers = ladder.down_from(wide, k).chunks_exact(2 * wide);
        let mut sum = [0.0; LANES];
        for (layers, row) in layers.zip(self.rows.chunks_exact(stride)) {
            for (phi, value) in layers[wide..].iter().zip(&row[..groups]) {
                add_product(&mut sum, phi, value);
            }
        }
        total(&sum)
    }

    /// Computes the next coefficients of layers and of `A_mn`.
    #[inline(always)]
    fn next(
        &mut self,
        known: Option<usize>,
        k: usize,
        (motion, weighing): (&Motion, &mut Weighing),
        acting: &Acting,
    ) {
        let groups = known.unwrap_or(self.groups);
        self.visits.advance(groups, k, motion, self.per_width);
        self.visits.close(groups, k, &motion.displacement[1], (self.eta, self.per_width));
        if let Some(read) = &mut self.read {
            read.advance(read.groups, k, motion, self.per_width);
        }
        self.next_row(groups, k, (&motion.along, weighing), acting);
    }

    /// Computes row k + 1 of `A_mn` by `Σ_i x0'_i A_{n+1,k-i}`.
    #[inline(always)]
    fn next_row(
        &mut self,
        groups: usize,
        k: usize,
        (along, weighing): (&[f64; MOST_ORDER], &mut Weighing),
        acting: &Acting,
    ) {
        let stride = (self.order + 1) * groups;
        let (before, after) = self.rows.split_at_mut((k + 1) * stride);
        let row = &mut after[..(self.order - k) * groups];
        let layers = self.visits.down_from(groups, k);
        let phi = match acting.depth {
            None => &layers[groups..2 * groups],
            Some(_) => weighing.carve(k, groups, layers),
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
        let factors = &along[MOST_ORDER - 1 - k..];
        let sums = Sums { rows: before, stride, factors, scale };
        let (blocks, rest) = row.as_chunks_mut::<BLOCK>();
        let done = groups + blocks.len() * BLOCK;
        for (b, block) in blocks.iter_mut().enumerate() {
            sums.add(groups + b * BLOCK, block);
        }
        for (i, entry) in rest.iter_mut().enumerate() {
            sums.add(done + i, std::array::from_mut(entry));
        }
    }
}

/// Number of entries of a row that are summed together.
const BLOCK: usize = 4;

/// The sum of rows, `stride` entries apart, times their `factors`, multiplied by `scale`.
struct Sums<'a> {
    rows: &'a [Lanes],
    stride: usize,
    factors: &'a [f64],
    scale: f64,
}

impl Sums<'_> {
    /// Adds the sum for the entries of a row from `from` on, in the same order on every machine.
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
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn run(chain: &mut Chain, acting: &Acting) {
    let known = match &chain.grooves[..] {
        [groove] if groove.read.is_none() => groove.groups,
        _ => 0,
    };
    match known {
        1 => chain.coefficients(Some(1), acting),
        2 => chain.coefficients(Some(2), acting),
        _ => chain.coefficients(None, acting),
    }
}

// Loops throughout: closures that iterators call are not compiled for wider vectors.

#[inline(always)]
fn times(row: &Lanes, factor: f64) -> Lanes {
    let mut product = [0.0; LANES];
    for i in 0..LANES {
        product[i] = factor * row[i];
    }
    product
}
