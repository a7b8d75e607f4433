//! Limit cycles: periodic solutions of (18), their stability, and how they depend on α and r.
//!
//! A cycle is a motion x0(t + T) = x0(t) + rT. On the side of the past f' is a sum of few exponentials
//! ([`stickslip_tip::memory::Fit`]), so that the tip with its past is a state of some twenty numbers, and a cycle the
//! periodic solution of an ordinary differential equation. It is found by Radau collocation on a mesh that
//! follows the motion, with Newton's method for all displacements, the period and, along a branch, a
//! parameter; eliminated step by step, the equations leave a matrix of the size of the state, whose
//! eigenvalues are the Floquet multipliers. `docs/cycles.md` derives it and says what was found with it.
//!
//! ```
//! use stickslip_cycles::{DEFAULT_TOLERANCE, cycle};
//! use stickslip_tip::{Model, TipFunction};
//!
//! let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0)?, 1.2, 1.0)?;
//! let found = cycle(&model, DEFAULT_TOLERANCE)?;
//! assert!(found.is_stable());
//! assert!((found.multipliers()[0].re - 1.0).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod asked;
mod blocks;
mod carrying;
mod carved;
mod change;
mod continuation;
mod corners;
mod depth;
mod embedding;
mod ended;
mod error;
mod guessed;
mod lattice;
mod leading;
mod linearisation;
mod mesh;
mod multipliers;
mod orbit;
mod past;
mod quadrature;
mod ripple;
mod scaling;
mod search;
mod sensitivity;
mod solve;
mod start;
mod steady;
mod step;

pub use continuation::{Branch, Continuation, End, Point, Special, SpecialKind};
pub use embedding::Parameter;
pub use ended::{Ended, Tried};
pub use error::CycleError;
pub use scaling::{Line, Measured, Scaling, ScalingPoint, scaling};
pub use search::{
    ROUGHEST_RESIDUAL, Settled, cycle, cycle_near, cycle_within, settle, small_cycle,
};

use multipliers::multipliers;
use num_complex::Complex;
use ripple::Ripple;
use solve::Closed;
use std::sync::OnceLock;
use stickslip_tip::memory::displacement;
use stickslip_tip::motion::latest_extrema;
use stickslip_tip::{Model, Support, Trajectory};

/// Residuals of (18) that can be asked for.
pub const TOLERANCES: (f64, f64) = (1e-11, 1e-4);
/// What commands ask for.
pub const DEFAULT_TOLERANCE: f64 = 1e-9;

/// A multiplier this close to the unit circle is on it, as far as one can tell.
const ON_THE_CIRCLE: f64 = 1e-7;
/// Multipliers below this modulus are those of the exponentials rather than of f.
const LEAST_MULTIPLIER: f64 = 1e-6;

/// An extremum within this part of a period from the seam is that of the seam.
const AT_THE_SEAM: f64 = 1e-6;
/// Of [`Cycle::error`].
const ERROR_OVER_RESIDUAL: f64 = 0.1;
/// Residuals beyond which ends of steps are no longer that much better than what lies between them.
const COARSE: f64 = 1e-7;
const ERROR_PER_GAP: f64 = 0.01;
const ERROR_OVER_DISPLACEMENT: f64 = 4.0;
/// Under a depth limit heights err too, and by more than slopes: measured beside the non-smooth onset (β = 1, b = 5,
/// α = 1.076) from 1e-4 to 1e-9, at most a third of this.
const ERROR_OVER_DISPLACEMENT_LIMITED: f64 = 12.0;
/// Beyond this amplitude, in widths of the tip, errors grow as it does: a slip begins when a creeping tip gets free, which
/// depends on its velocity, and that is the less the farther it lags behind.
const SHORT_SLIPS: f64 = 2.0;
/// So many times that where f is told by a lattice of exponents.
const ON_LATTICE: f64 = 40.0;

/// A periodic solution of (18). Lengths in σ, times in Γ/k.
#[derive(Clone)]
pub struct Cycle {
    model: Model,
    closed: Closed,
    motion: Trajectory,
    multipliers: Vec<Complex<f64>>,
    extremes: (f64, f64),
    slips: usize,
    /// Once it was asked for.
    amplitude_u: OnceLock<f64>,
}

impl Cycle {
    fn new(closed: Closed) -> Result<Self, CycleError> {
        let (retreat, most) = (closed.orbit.retreat(), closed.equation.retreat());
        if retreat > most {
            return Err(CycleError::Retreat { retreat, most });
        }
        let (alpha, r) = (closed.equation.alpha, closed.equation.r);
        let model = closed.equation.model().ok_or(CycleError::NotConverged { alpha, r })?;
        let multipliers = multipliers(&closed);
        let multipliers = multipliers.ok_or(CycleError::Multipliers { alpha, r })?;
        let (law, support) = (closed.equation.wider, Support::Moving(r));
        let motion = Trajectory::under(law, support, closed.orbit.steps(r));
        let extrema = latest_extrema(&motion);
        let lowest = extrema.iter().map(|e| e.l).fold(f64::INFINITY, f64::min);
        // The maximum at the seam was the highest of the guess; another may have overtaken it.
        let highest = extrema.iter().map(|e| e.l).fold(motion.l(0.0), f64::max);
        let extremes = (lowest, highest);
        // Around a period there are as many maxima as minima. One of them is at the seam, seen at either end of it or at
        // none: a maximum, or where the guess was another cycle a minimum.
        let (from, to) = (AT_THE_SEAM * motion.end(), (1.0 - AT_THE_SEAM) * motion.end());
        let within: Vec<_> = extrema.iter().filter(|e| e.t > from && e.t < to).collect();
        let maxima = within.iter().filter(|e| e.is_maximum).count();
        let slips = maxima.max(within.len() - maxima);
        let amplitude_u = OnceLock::new();
        Ok(Self { model, closed, motion, multipliers, extremes, slips, amplitude_u })
    }

    /// Footprint, α and r.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// T
    #[must_use]
    pub fn period(&self) -> f64 {
        self.closed.orbit.period
    }

    /// rT, the wavelength of the surface left behind.
    #[must_use]
    pub fn wavelength(&self) -> f64 {
        self.model.r() * self.period()
    }

    /// Half peak-to-peak of l, that is of x0 less its steady advance.
    #[must_use]
    pub fn amplitude_x0(&self) -> f64 {
        0.5 * (self.extremes.1 - self.extremes.0)
    }

    /// Half peak-to-peak of the surface left far behind, (35), in kσ²/a. Where it heals, u at the distance D behind the
    /// support is U(x) e^{-D/(rT)} with a periodic U, and this is half peak-to-peak of U: at most `f64::MAX`.
    #[must_use]
    pub fn amplitude_u(&self) -> f64 {
        let amplitude = || self.ripple().amplitude();
        *self
            .amplitude_u
            .get_or_init(|| Some(amplitude()).filter(|u| u.is_finite()).unwrap_or(f64::MAX))
    }

    /// u(x) far behind the tip, (35), a periodic function of x; x0(t) is that of [`motion`](Self::motion). Where the surface
    /// heals that is 0.
    #[must_use]
    pub fn surface_behind(&self, x: &[f64]) -> Vec<f64> {
        if self.model.wider().healing_time.is_some() {
            return vec![0.0; x.len()];
        }
        let ripple = self.ripple();
        x.iter().map(|x| ripple.height(*x)).collect()
    }

    fn ripple(&self) -> Ripple {
        Ripple::new(self.model.tip(), self.model.alpha(), &self.motion)
    }

    /// Smallest and largest l.
    #[must_use]
    pub fn extremes(&self) -> (f64, f64) {
        self.extremes
    }

    /// Maxima of l in one period.
    #[must_use]
    pub fn slips(&self) -> usize {
        self.slips
    }

    /// x0(t) over one period from t = 0, where l is at its maximum.
    #[must_use]
    pub fn motion(&self) -> &Trajectory {
        &self.motion
    }

    /// The Floquet multipliers above 1e-6 in modulus, the largest first: by how much small deviations grow in a period.
    /// One of them is 1, that of a shift in time. Those of the sum that stands for f, which another sum has not, are
    /// left out; of a footprint with much detail only those above 0.01 are surely all there.
    #[must_use]
    pub fn multipliers(&self) -> &[Complex<f64>] {
        let count = self.multipliers.partition_point(|m| m.norm() >= LEAST_MULTIPLIER);
        &self.multipliers[..count]
    }

    /// The multipliers without that of a shift in time.
    pub fn nontrivial_multipliers(&self) -> impl Iterator<Item = Complex<f64>> + '_ {
        let distance = |m: &Complex<f64>| (m - 1.0).norm();
        let nearest = (0..self.multipliers.len()).min_by(|a, b| {
            distance(&self.multipliers[*a]).total_cmp(&distance(&self.multipliers[*b]))
        });
        let others = self.multipliers().iter().enumerate();
        others.filter(move |(i, _)| Some(*i) != nearest).map(|(_, m)| *m)
    }

    /// Whether every small deviation but a shift in time dies out.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.nontrivial_multipliers().all(|m| m.norm() < 1.0 + ON_THE_CIRCLE)
    }

    /// Estimate of the largest residual of (18) at any time.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.closed.residual
    }

    /// The largest modulus of the multipliers but that of a shift in time.
    #[must_use]
    pub fn leading_multiplier(&self) -> f64 {
        self.nontrivial_multipliers().map(|m| m.norm()).fold(0.0, f64::max)
    }

    /// Estimate of the error of the period (in Γ/k) and of the amplitude of x0 (in σ).
    ///
    /// Both are had at the ends of steps, which err by far less than the residual would make them; a slow
    /// multiplier makes more of that. What the sum misses that stands for f displaces the tip everywhere, and adds
    /// up in the same way; what a lattice of exponents misses of a table changes its curvature by more than its slope.
    /// Measured against residuals of 1e-11 from αc + 1e-5 to relaxation, with a margin of ten; what comes of the sum
    /// with one of two and a half. Long slips make more of either, by as much as they are long: of 29 cycles with
    /// amplitudes from 0.02 to 785 at residuals from 3e-10 to 1e-5 the worst erred by two thirds of what is told.
    #[must_use]
    pub fn error(&self) -> f64 {
        let gap = (1.0 - self.leading_multiplier()).abs().max(f64::EPSILON);
        let over_residual = ERROR_OVER_RESIDUAL * (1.0 + self.residual() / COARSE).sqrt();
        let of_steps = self.residual() * (over_residual + ERROR_PER_GAP / gap);
        let limited = self.model.wider().depth_limit.is_some();
        let over = if limited { ERROR_OVER_DISPLACEMENT_LIMITED } else { ERROR_OVER_DISPLACEMENT };
        let over = if self.closed.equation.is_on_lattice() { ON_LATTICE * over } else { over };
        let of_the_sum = over * self.displacement() * (1.0 + 1.0 / gap);
        let widths = self.amplitude_x0() / self.closed.equation.width();
        (widths / SHORT_SLIPS).max(1.0) * (of_steps + of_the_sum)
    }

    /// How far what the sum misses of f' may displace the tip, in σ.
    fn displacement(&self) -> f64 {
        displacement(&self.model, self.closed.equation.fine.certificate().slope)
    }

    /// The same of the amplitude of the surface left behind, in kσ²/a.
    #[must_use]
    pub fn amplitude_u_error(&self) -> f64 {
        let relative = self.error() / self.amplitude_x0() + self.error() / self.period();
        3.0 * relative * self.amplitude_u()
    }

    /// Steps of the mesh.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.closed.orbit.stages.len()
    }

    /// In the unit of [`solve::MOST_WORK`].
    fn work(&self) -> f64 {
        self.closed.equation.work((self.iterations() * self.steps()) as f64)
    }

    /// Linearisations that it took.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.closed.iterations
    }
}

impl std::fmt::Debug for Cycle {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut fields = out.debug_struct("Cycle");
        fields.field("alpha", &self.model.alpha()).field("r", &self.model.r());
        fields.field("period", &self.period()).field("amplitude_x0", &self.amplitude_x0());
        fields.field("multipliers", &self.multipliers()).finish_non_exhaustive()
    }
}

/// A cycle whose l swings by less than this is none.
const LEAST_AMPLITUDE: f64 = 1e-9;

impl Closed {
    /// Whether Newton's method has fallen to steady motion, of which every period is one.
    fn is_steady(&self) -> bool {
        let r = self.equation.r;
        let motion = self.orbit.trajectory(r);
        let swing = |t: f64| (motion.l(t) - motion.l(0.0)).abs();
        motion.steps().iter().map(|step| swing(step.t)).fold(0.0, f64::max) < LEAST_AMPLITUDE
    }
}
