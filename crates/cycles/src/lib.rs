//! Limit cycles: periodic solutions of (18), their stability, and how they depend on α and r.
//!
//! A cycle is a motion x0(t + T) = x0(t) + rT. Behind the tip f' is fitted by a sum of few exponentials
//! ([`stickslip_tip::memory::Fit`]), so that the tip with its past is a state of some twenty numbers. A cycle is then a
//! periodic solution of an ordinary differential equation. It is found by Radau collocation on a mesh that
//! follows the motion, with Newton's method for all displacements, the period and, along a branch, a
//! parameter. Elimination step by step reduces the equations to a matrix of the size of the state, whose
//! eigenvalues are the Floquet multipliers. `docs/explanation/cycles.md` derives the equations, and
//! `docs/findings/README.md` has the results.
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
mod step;

pub use continuation::{Branch, Continuation, End, Point, Special, SpecialKind};
pub use embedding::Parameter;
pub use ended::{Ended, UnsettledRun};
pub use error::CycleError;
pub use scaling::{Line, Measured, Scaling, ScalingPoint, scaling};
pub use search::{
    ROUGHEST_RESIDUAL, Settled, cycle, cycle_near, cycle_within, settle, small_cycle,
};

use multipliers::{multipliers, without_shift};
use num_complex::Complex;
use ripple::Ripple;
use solve::Closed;
use std::sync::OnceLock;
use stickslip_tip::memory::displacement;
use stickslip_tip::motion::latest_extrema;
use stickslip_tip::{Model, Support, Trajectory};

/// Smallest and largest admissible residual of (18).
pub const TOLERANCES: (f64, f64) = (1e-11, 1e-4);
/// Default residual of the commands.
pub const DEFAULT_TOLERANCE: f64 = 1e-9;

/// A multiplier this close to the unit circle cannot be distinguished from one on it.
const ON_THE_CIRCLE: f64 = 1e-7;
/// Multipliers of smaller modulus belong to the exponentials rather than to f.
const LEAST_MULTIPLIER: f64 = 1e-6;

/// An extremum closer than this fraction of a period to the seam, the start and end of the period, counts as lying on it.
const AT_THE_SEAM: f64 = 1e-6;
/// Backward motion, as a fraction of the largest admissible one, beyond which no step along a branch stays admissible.
const AT_THE_FARTHEST: f64 = 0.999;
/// Coefficient of the residual in [`Cycle::error`].
const ERROR_OVER_RESIDUAL: f64 = 0.1;
/// Residual above which the ends of steps are no longer much more accurate than the points between them.
const COARSE: f64 = 1e-7;
const ERROR_PER_GAP: f64 = 0.01;
const ERROR_OVER_DISPLACEMENT: f64 = 4.0;
/// [`ERROR_OVER_DISPLACEMENT`] under a depth limit, where heights contribute a larger error than slopes. Close to the
/// non-smooth onset (β = 1, b = 5, α = 1.076), at residuals from 1e-4 to 1e-9, the error is at most a third of the estimate.
const ERROR_OVER_DISPLACEMENT_LIMITED: f64 = 12.0;
/// Amplitude, in widths of the tip, above which errors grow in proportion to the amplitude. A slip begins when a creeping
/// tip escapes from its groove, and the farther the tip lags behind, the more slowly it creeps.
const SHORT_SLIPS: f64 = 2.0;
/// Additional factor of the error if f' is fitted by a lattice of exponents.
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
    /// Computed at the first request.
    amplitude_u: OnceLock<f64>,
}

impl Cycle {
    fn new(closed: Closed) -> Result<Self, CycleError> {
        let (retreat, most) = (closed.orbit.retreat(), closed.equation.retreat());
        if retreat > most {
            return Err(CycleError::Retreat { retreat, most });
        }
        let (alpha, r) = (closed.equation.alpha, closed.equation.r);
        let model = closed.equation.model().ok_or(closed.equation.lost())?;
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

    /// The model: footprint, α and r.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Period T.
    pub fn period(&self) -> f64 {
        self.closed.orbit.period
    }

    /// rT, the wavelength of the surface far behind the tip.
    pub fn wavelength(&self) -> f64 {
        self.model.r() * self.period()
    }

    /// Half the peak-to-peak value of l, that is, of x0 minus its steady advance.
    pub fn amplitude_x0(&self) -> f64 {
        0.5 * (self.extremes.1 - self.extremes.0)
    }

    /// Half the peak-to-peak value of the surface far behind the tip, (35), in kσ²/a. If the surface heals, with the
    /// healing time T_h, u at the distance D behind the support is U(x) e^{-D/(rT_h)} with a periodic U. The result is
    /// then half the peak-to-peak value of U, at most `f64::MAX`.
    pub fn amplitude_u(&self) -> f64 {
        let amplitude = || self.ripple().amplitude();
        *self
            .amplitude_u
            .get_or_init(|| Some(amplitude()).filter(|u| u.is_finite()).unwrap_or(f64::MAX))
    }

    /// u(x) far behind the tip, (35), a periodic function of x for the x0(t) of [`motion`](Self::motion). It is 0 if
    /// the surface heals.
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
    pub fn extremes(&self) -> (f64, f64) {
        self.extremes
    }

    /// Number of maxima of l in one period.
    pub fn slips(&self) -> usize {
        self.slips
    }

    /// The largest backward motion of the tip, in σ, if cycles cannot have a notably larger one, so that a branch ends
    /// here; else `None`.
    pub fn farthest_retreat(&self) -> Option<f64> {
        let retreat = self.closed.orbit.retreat();
        (retreat > AT_THE_FARTHEST * self.closed.equation.retreat()).then_some(retreat)
    }

    /// x0(t) over one period from t = 0, where l is at its maximum.
    pub fn motion(&self) -> &Trajectory {
        &self.motion
    }

    /// The Floquet multipliers above 1e-6 in modulus, the largest first: the factors by which small deviations grow in
    /// a period. One of them is 1, that of a shift in time. Multipliers that stem from the sum of exponentials, because
    /// another sum does not reproduce them, are left out. For a footprint with much detail the list is complete only
    /// above 0.01.
    pub fn multipliers(&self) -> &[Complex<f64>] {
        let count = self.multipliers.partition_point(|m| m.norm() >= LEAST_MULTIPLIER);
        &self.multipliers[..count]
    }

    /// The multipliers except that of a shift in time.
    pub fn nontrivial_multipliers(&self) -> impl Iterator<Item = Complex<f64>> + '_ {
        without_shift(&self.multipliers).filter(|m| m.norm() >= LEAST_MULTIPLIER)
    }

    /// Whether every small deviation except a shift in time decays.
    pub fn is_stable(&self) -> bool {
        self.nontrivial_multipliers().all(|m| m.norm() < 1.0 + ON_THE_CIRCLE)
    }

    /// Estimate of the largest residual of (18) at any time.
    pub fn residual(&self) -> f64 {
        self.closed.residual
    }

    /// The largest modulus of the multipliers except that of a shift in time.
    pub fn leading_multiplier(&self) -> f64 {
        self.nontrivial_multipliers().map(|m| m.norm()).fold(0.0, f64::max)
    }

    /// Estimate of the error of the period (in Γ/k) and of the amplitude of x0 (in σ).
    ///
    /// Both are evaluated at the ends of steps, where the error is far smaller than the residual suggests; a slow
    /// multiplier amplifies it. The residual of the sum of exponentials displaces the tip everywhere, and these
    /// displacements are amplified in the same way. For a table fitted by a lattice of exponents, the residual of the
    /// curvature is larger than that of the slope. The coefficients come from a comparison with cycles at a residual
    /// of 1e-11, from αc + 1e-5 to relaxation oscillations. They include a safety factor of 10, or of 2.5 for the
    /// contribution of the sum. Long slips increase both errors in proportion to their length. Of 29 cycles with
    /// amplitudes from 0.02 to 785 at residuals from 3e-10 to 1e-5, the largest error was two thirds of the estimate.
    pub fn error(&self) -> f64 {
        let gap = (1.0 - self.leading_multiplier()).abs().max(f64::EPSILON);
        let over_residual = ERROR_OVER_RESIDUAL * (1.0 + self.residual() / COARSE).sqrt();
        let of_steps = self.residual() * (over_residual + ERROR_PER_GAP / gap);
        let limited = self.model.wider().depth_limit.is_some();
        let over = if limited { ERROR_OVER_DISPLACEMENT_LIMITED } else { ERROR_OVER_DISPLACEMENT };
        let over = if self.closed.equation.is_on_lattice() { ON_LATTICE * over } else { over };
        // What the residual of the sum for f' may do to the tip.
        let displaced = displacement(&self.model, self.closed.equation.fine.certificate().slope);
        let of_the_sum = over * displaced * (1.0 + 1.0 / gap);
        let widths = self.amplitude_x0() / self.closed.equation.width();
        (widths / SHORT_SLIPS).max(1.0) * (of_steps + of_the_sum)
    }

    /// Estimate of the error of [`amplitude_u`](Self::amplitude_u), in kσ²/a.
    pub fn amplitude_u_error(&self) -> f64 {
        let relative = self.error() / self.amplitude_x0() + self.error() / self.period();
        3.0 * relative * self.amplitude_u()
    }

    /// Number of steps of the mesh.
    pub fn steps(&self) -> usize {
        self.closed.orbit.stages.len()
    }

    /// Work, in the unit of [`solve::MOST_WORK`].
    fn work(&self) -> f64 {
        self.closed.equation.work((self.iterations() * self.steps()) as f64)
    }

    /// Number of linearisations that the solution took.
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

/// A cycle in which l varies by less than this is steady motion.
const LEAST_AMPLITUDE: f64 = 1e-9;

impl Closed {
    /// Whether Newton's method has converged to steady motion, of which any time is a period.
    fn is_steady(&self) -> bool {
        let r = self.equation.r;
        let motion = self.orbit.trajectory(r);
        let swing = |t: f64| (motion.l(t) - motion.l(0.0)).abs();
        motion.steps().iter().map(|step| swing(step.t)).fold(0.0, f64::max) < LEAST_AMPLITUDE
    }
}
