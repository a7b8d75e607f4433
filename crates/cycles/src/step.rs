//! One step of the collocation equations for the state of exponentials, and its linearisation.
//!
//! With X = (e, ζ) at the start of a step of length h, displacements d at its nodes and A, b of the method,
//!
//! ```text
//!     v_i = α (Σ_j Re(ζ_j e^{s_j d_i}) + h Σ_k a_ik f'(d_i - d_k)) + e + r h c_i - d_i
//!     0   = d_i - h Σ_k a_ik v_k                           (stickslip_tip::step)
//!     e'  = e + r h - d_s,        ζ_j' = e^{s_j d_s} (ζ_j + w_j h Σ_k b_k e^{-s_j d_k})
//! ```
//!
//! In the extended model healing changes the weights and the decay of visits ([`Carved`]). Inertia changes the matrix hA
//! between force and displacement ([`Carrying`]). A depth limit adds the [heights](LinearHeights) under the tip as
//! unknowns.

use super::blocks::{Square, Vector, inverted};
use super::carrying::Carrying;
use super::carved::{Carved, Heights};
use super::depth::LinearHeights;
use super::embedding::{Embedding, Parameter};
use super::mesh::OfStep;
use super::past::{GrooveOfStep, PastOfStep};
use super::quadrature::missed;
use super::sensitivity::Sensitivity;
use multiversion::multiversion;
use num_complex::Complex;
use stickslip_tip::collocation::{RADAU, STAGES, Stages};
use stickslip_tip::step::OwnGroove;

pub(super) struct LinearStep<'a> {
    equation: &'a Embedding,
    past: PastOfStep<'a>,
    carved: &'a Carved,
    d: &'a Stages,
    h: f64,
    /// The force, which without inertia is the velocity.
    velocity: Vector,
    /// ∂v/∂d, including the change of the heights.
    velocity_slope: Square,
    /// Slope of the groove divided by α, from history and step: ∂v/∂α.
    groove: Vector,
    /// Derivative of `groove` with respect to h.
    groove_rate: Vector,
    carrying: Carrying,
    heights: Option<LinearHeights>,
    /// Largest quadrature error of the force of the step's own groove.
    missed: f64,
}

/// Changes of displacements and heights: one row per stage of the steps so far.
#[derive(Default)]
pub(super) struct OfStages {
    pub(super) displacements: Sensitivity,
    /// Empty without a depth limit.
    pub(super) heights: Sensitivity,
}

impl OfStages {
    /// Drops all rows, and keeps their memory.
    pub(super) fn clear(&mut self) {
        self.displacements.clear();
        self.heights.clear();
    }
}

/// Buffers for the factors of the rows, reused from step to step.
#[derive(Default)]
pub(super) struct Factors {
    /// ∂d/∂X by component of X.
    of_stages: Vec<Stages>,
    /// ∂X'/∂d and ∂X'/∂η by component of X'.
    by_stages: Vec<Stages>,
    by_heights: Vec<Stages>,
    /// The factor of each ζ.
    turns: Vec<Complex<f64>>,
    /// `e^{-s_j d_i}`
    inverses: Vec<[Complex<f64>; STAGES]>,
}

/// The data of a step: its state at the start, its length, its solution.
#[derive(Clone, Copy)]
pub(super) struct Solved<'a> {
    /// rt - x0 at the start of the step.
    pub(super) extension: f64,
    /// x0' at the start of the step.
    pub(super) velocity: f64,
    pub(super) h: f64,
    pub(super) d: &'a Stages,
    pub(super) heights: Option<&'a Heights>,
    pub(super) carved: &'a Carved,
}

impl<'a> LinearStep<'a> {
    /// `groove` is that of the history in which the equations are solved, `past` the history in which they are linearised.
    /// `None` if the equations are singular.
    pub(super) fn new(
        equation: &'a Embedding,
        (past, groove): (PastOfStep<'a>, GrooveOfStep<'_>),
        step: Solved<'a>,
    ) -> Option<Self> {
        let Solved { extension, h, d, carved, .. } = step;
        let GrooveOfStep { slope: past_slope, height: past_height } = groove;
        let law = equation.law();
        let between = OwnGroove::new(&equation.tip, d);
        let weighted = carved.weighted();
        // What is carved in a unit step: of one of length h it is h times as much, unless it heals.
        let (mut own, mut own_slope) = ([0.0; STAGES], [[0.0; STAGES]; STAGES]);
        between.add_slope(&weighted, &mut own);
        between.add_derivatives(&weighted, &mut own_slope);
        let (own, pull) = (Vector::from(own), law.pull(extension, h));
        // Without healing the weights grow in proportion to h.
        let mut rate = carved.rate().map_or(<[f64; STAGES]>::from(own), |weights| {
            let mut rate = [0.0; STAGES];
            between.add_slope(&weights, &mut rate);
            rate
        });
        for (rate, (fading, slope)) in rate.iter_mut().zip(carved.fading().iter().zip(past_slope)) {
            *rate += fading * slope;
        }
        let groove = Vector::from(*past_slope) + own * carved.times;
        let velocity = Vector::from_fn(|i, _| law.velocity(pull[i], d[i], 0.0, groove[i]));
        let curvature = past.curvature();
        let mut velocity_slope = Square::from_fn(|i, k| match own_slope[i][k] * carved.times {
            own if i == k => law.velocity_slope(0.0, curvature[i] + own),
            own => law.alpha * own,
        });
        let heights = step.heights.zip(past_height).and_then(|(heights, history)| {
            LinearHeights::new(equation, history, (&groove, &between), (d, heights, carved))
        });
        if let Some(heights) = &heights {
            velocity_slope -= heights.stiffness();
        }
        Some(Self {
            equation,
            past,
            carved,
            d,
            h,
            velocity,
            velocity_slope,
            groove,
            groove_rate: Vector::from(rate),
            carrying: Carrying::new(&equation.wider, h, step.velocity)?,
            heights,
            missed: law.alpha * carved.times * missed(&equation.tip, d, &between),
        })
    }

    /// Data for the mesh: the largest stiffness 1 + u_xx within the step, and its quadrature error.
    pub(super) fn of_step(&self) -> OfStep {
        let diagonal = self.velocity_slope.diagonal();
        let stiffness = diagonal.iter().fold(1.0, |m: f64, s| m.max(s.abs()));
        OfStep { stiffness, missed: self.missed }
    }

    /// Carries the sensitivities of the state over the step, which is the fraction `share` of the period, and appends
    /// those of its displacements and heights. `None` if the stage equations are singular.
    pub(super) fn carry(
        &self,
        (free, share): (Parameter, f64),
        state: &mut Sensitivity,
        stages: &mut OfStages,
        room: &mut Factors,
    ) -> Option<()> {
        // With H = by_force and V = ∂v/∂d, δd = (1 - HV)⁻¹ H δv = (H⁻¹ - V)⁻¹ δv.
        let gain = inverted(self.carrying.to_force - self.velocity_slope)?;
        let by_state = self.heights_by_state();
        self.stages_by_state(&by_state, &gain, &mut room.of_stages);
        let constants = self.constants(free, share, &gain);
        let OfStages { displacements, heights } = &mut *stages;
        displacements.append_contracted(state, &room.of_stages, &constants);
        if let Some(linear) = &self.heights {
            linear.follow(&by_state, (free, share), state, (displacements, heights));
        }
        self.carry_state((free, share), stages, state, room);
        Some(())
    }

    /// Changes of the displacements with the period and with the free parameter, and those that solve the equations.
    fn constants(&self, free: Parameter, share: f64, gain: &Square) -> [Vector; 3] {
        let Carrying { by_force, to_force, by_force_rate, glide, glide_rate, .. } = &self.carrying;
        let advance = Vector::from_fn(|i, _| self.equation.r * RADAU.c[i]);
        let mut by_length = self.groove_rate * self.equation.alpha + advance;
        let mut by_parameter = match free {
            Parameter::Alpha => self.groove,
            Parameter::R => Vector::from(RADAU.c) * self.h,
        };
        let mut missed = by_force * self.velocity - Vector::from(*self.d) + glide;
        let lengthened = by_force_rate * self.velocity + glide_rate;
        if let Some(heights) = &self.heights {
            by_length += heights.force_by_length();
            missed -= by_force * heights.force_missed();
            if free == Parameter::Alpha {
                by_parameter += heights.force_by_alpha();
            }
        }
        let by_length = (to_force * lengthened + by_length) * share;
        [by_length, by_parameter, to_force * missed].map(|force| gain * force)
    }

    /// ∂d/∂X = gain ∂v/∂X, by component of X. `by_state` is the derivative of the heights.
    fn stages_by_state(&self, by_state: &[Vector], gain: &Square, into: &mut Vec<Stages>) {
        let modes = self.past.terms.len();
        into.clear();
        into.resize(1 + 2 * modes, [0.0; STAGES]);
        into[0] = Stages::from(gain * Vector::from([1.0; STAGES]));
        let left = self.carved.left().map(|left| self.equation.alpha * left);
        let by_past = Square::from_fn(|i, k| gain[(i, k)] * left[k]);
        let (re, im) = into[1..].split_at_mut(modes);
        products(&by_past, self.past.exponentials, re, im);
        if let Some(heights) = &self.heights {
            for (stages, height) in into.iter_mut().zip(by_state) {
                *stages = Stages::from(Vector::from(*stages) + gain * heights.force(height));
            }
        }
        let Carrying { to_force, by_velocity, .. } = &self.carrying;
        into.extend(by_velocity.map(|glide| Stages::from(gain * (to_force * glide))));
    }

    /// ∂g/∂X of the heights -α g, by component of X; empty without a depth limit.
    fn heights_by_state(&self) -> Vec<Vector> {
        if self.heights.is_none() {
            return vec![];
        }
        let left = self.carved.left();
        let scaled = self.past.exponentials.iter().zip(self.past.terms);
        let scaled = scaled.map(|(e, term)| e.map(|e| e / term.exponent));
        let scaled: Vec<[Complex<f64>; STAGES]> = scaled.collect();
        let re = scaled.iter().map(|e| Vector::from_fn(|i, _| e[i].re * left[i]));
        let im = scaled.iter().map(|e| Vector::from_fn(|i, _| -e[i].im * left[i]));
        let inertia = self.equation.wider.inertia.map(|_| Vector::zeros());
        [Vector::zeros()].into_iter().chain(re).chain(im).chain(inertia).collect()
    }

    /// δX' from δX, δd and the changes of the heights.
    fn carry_state(
        &self,
        (free, share): (Parameter, f64),
        stages: &OfStages,
        state: &mut Sensitivity,
        room: &mut Factors,
    ) {
        let modes = self.past.terms.len();
        let rows = self.equation.state_len();
        let Factors { by_stages, by_heights, turns, inverses, .. } = room;
        by_stages.clear();
        by_stages.resize(rows, [0.0; STAGES]);
        by_heights.clear();
        by_heights.resize(if self.heights.is_some() { rows } else { 0 }, [0.0; STAGES]);
        by_stages[0][STAGES - 1] = -1.0;
        let left = self.carved.left()[STAGES - 1];
        turns.clear();
        turns.extend(self.past.exponentials.iter().map(|e| e[STAGES - 1] * left));
        state.multiply_pairs(1, turns);
        inverses.clear();
        inverses.extend_from_slice(self.past.exponentials);
        invert(inverses.as_flattened_mut());
        state.constants(0)[0] += self.equation.r * share;
        if free == Parameter::R {
            state.constants(0)[1] += self.h;
        }
        let [stays, rate, by_height] = self.carved.at_end();
        let fading = self.carved.fading()[STAGES - 1];
        for (j, term) in self.past.terms.iter().enumerate() {
            let e = self.past.exponentials[j][STAGES - 1];
            let (re, im) = (1 + j, 1 + modes + j);
            let (weight, inverses) = (term.weight * e, &inverses[j]);
            let moved = -term.exponent * weight * self.carved.times;
            (by_stages[re], by_stages[im]) = times(inverses, &stays, moved);
            let last = term.exponent * self.past.after[j];
            by_stages[re][STAGES - 1] += last.re;
            by_stages[im][STAGES - 1] += last.im;
            if self.heights.is_some() {
                (by_heights[re], by_heights[im]) = times(inverses, &by_height, weight);
            }
            let spent: Complex<f64> = inverses.iter().zip(&rate).map(|(e, b)| e * b).sum();
            let spent = weight * spent;
            let faded = e * self.past.zeta[j] * (left * fading);
            state.constants(re)[0] += (spent.re + faded.re) * share;
            state.constants(im)[0] += (spent.im + faded.im) * share;
        }
        if self.equation.wider.inertia.is_some() {
            // The velocity at the end is the slope of the polynomial there, whatever it was before.
            let slope = &RADAU.derivative[STAGES - 1];
            by_stages[rows - 1] = slope.map(|w| w / self.h);
            let velocity: f64 = slope.iter().zip(self.d).map(|(w, d)| w * d).sum::<f64>() / self.h;
            state.clear_row(rows - 1);
            state.constants(rows - 1)[0] -= velocity / self.h * share;
        }
        state.add_expanded(by_stages, &stages.displacements);
        if self.heights.is_some() {
            state.add_expanded(by_heights, &stages.heights);
        }
    }
}

/// The product of a matrix with the real parts, and minus the imaginary parts, of all these vectors.
///
/// Compiled for wider vectors too: lanes are independent of each other.
#[multiversion(targets("x86_64+avx2"))]
fn products(
    matrix: &Square,
    vectors: &[[Complex<f64>; STAGES]],
    re: &mut [Stages],
    im: &mut [Stages],
) {
    let (columns, _) = matrix.as_slice().as_chunks::<STAGES>();
    for ((re, im), vector) in re.iter_mut().zip(im).zip(vectors) {
        let mut sums = [[0.0; STAGES]; 2];
        for (column, factor) in columns.iter().zip(vector) {
            for i in 0..STAGES {
                sums[0][i] += column[i] * factor.re;
                sums[1][i] -= column[i] * factor.im;
            }
        }
        (*re, *im) = (sums[0], sums[1]);
    }
}

/// Replaces each of these numbers by its inverse.
///
/// Compiled for wider vectors too: lanes are independent of each other.
#[multiversion(targets("x86_64+avx2"))]
fn invert(numbers: &mut [Complex<f64>]) {
    for number in numbers {
        let scale = 1.0 / (number.re * number.re + number.im * number.im);
        *number = Complex::new(number.re * scale, -number.im * scale);
    }
}

/// Real and imaginary parts of these numbers, each multiplied by its factor and by the common factor `of_all`.
#[inline]
fn times(
    numbers: &[Complex<f64>; STAGES],
    factors: &Stages,
    of_all: Complex<f64>,
) -> (Stages, Stages) {
    let (mut re, mut im) = ([0.0; STAGES], [0.0; STAGES]);
    for k in 0..STAGES {
        let (a, b) = (numbers[k].re * factors[k], numbers[k].im * factors[k]);
        (re[k], im[k]) = (of_all.re * a - of_all.im * b, of_all.re * b + of_all.im * a);
    }
    (re, im)
}

#[cfg(test)]
mod tests {
    use super::super::past::Past;
    use super::*;
    use stickslip_tip::elementary::complex_exp;
    use stickslip_tip::memory::{Groove, Policy};
    use stickslip_tip::step::{Equations, Law};
    use stickslip_tip::{Model, TipFunction};

    /// The inverses of e^z are e^{-z}, of sizes that a step from a bad guess has too.
    #[test]
    fn inverses_are_inverses() {
        for re in [-150.0, -3.0, 0.0, 0.7, 150.0] {
            let exponents = [-2.0, 0.0, 1.0, 40.0].map(|im| Complex::new(re, im));
            let mut inverses = exponents.map(complex_exp);
            invert(&mut inverses);
            for (inverse, exponent) in inverses.into_iter().zip(exponents) {
                assert!((inverse * complex_exp(exponent) - 1.0).norm() < 1e-15, "{exponent}");
                assert!((inverse / complex_exp(-exponent) - 1.0).norm() < 1e-13, "{exponent}");
            }
        }
    }

    /// Comparison with the equations of the integrator and its memory, on the steps of a cycle: the history agrees,
    /// and all derived quantities.
    #[test]
    fn a_step_of_a_cycle_and_of_the_integrator_are_the_same() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let model = Model::new(tip.clone(), 1.2, 1.0).unwrap();
        let found = crate::cycle(&model, 1e-9).unwrap();
        let (equation, orbit) = (&found.closed.equation, &found.closed.orbit);
        let law = Law::of(&model);
        let carved = orbit.carved(&equation.wider);
        let past = Past::of(&equation.fine, (orbit, &carved)).unwrap();
        let grooves = past.grooves(false);
        let mut memory = Policy::with_fit(tip.clone(), equation.fine.clone()).unwrap();
        let steps = || orbit.lengths().zip(&orbit.stages);
        for _ in 0..8 {
            steps().for_each(|(h, d)| memory.remember(d, &RADAU.b().map(|b| b * h)));
        }
        let mut extension = orbit.extension;
        let zero = [0.0; STAGES];
        for (n, (h, d)) in steps().enumerate() {
            let slope = grooves.of_step(n).slope;
            let (velocity, carved) = (0.0, &carved[n]);
            let solved = Solved { extension, velocity, h, d, heights: None, carved };
            let history = (past.of_step(n), grooves.of_step(n));
            let step = LinearStep::new(equation, history, solved).unwrap();
            let (mut told, mut curvature) = (zero, zero);
            memory.groove(d, &mut Groove::new(&mut told, &mut curvature));
            let near = |a: f64, b: f64, allowed: f64, what: &str| {
                assert!((a - b).abs() < allowed, "{what} of step {n}: {a} {b}");
            };
            let equations = Equations::new(law, h, law.pull(extension, h), None, None);
            let own = OwnGroove::new(&tip, d);
            let velocity = equations.velocity(d, &told, &zero, &own);
            let residual = equations.residual(d, &velocity);
            let jacobian = equations.jacobian(&curvature, &zero, &own);
            let ha = Square::from_fn(|i, k| h * RADAU.a[i][k]);
            let missed = Vector::from(*d) - ha * step.velocity;
            let ours = Square::identity() - ha * step.velocity_slope;
            for i in 0..STAGES {
                near(slope[i], told[i], 1e-9, "past");
                near(step.velocity[i], velocity[i], 1e-9, "velocity");
                near(missed[i], residual[i], 1e-9, "residual");
                near(residual[i], 0.0, 1e-8, "solution");
                (0..STAGES).for_each(|k| near(ours[(i, k)], jacobian[i][k], 1e-9, "jacobian"));
            }
            extension += equation.r * h - d[STAGES - 1];
            memory.remember(d, &RADAU.b().map(|b| b * h));
        }
    }
}
