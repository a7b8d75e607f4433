//! Linear stability of steady motion (section IV of the paper), and what follows from it.
//!
//! A small deviation l - l0 ∝ e^{λt} grows or decays with a root λ = rΛ of
//!
//! ```text
//!     h(Λ) = rΛ + 1 + (α/r) G(Λ) = 0,    G(Λ) = ∫_0^∞ f''(y) e^{-Λy}dy      (30)
//! ```
//!
//! [`critical`] and [`Boundary`] find where the first root reaches the imaginary axis, [`roots`] and
//! [`leading_roots`] list all roots right of a line with a [`Certificate`] that none is missing,
//! [`response`] adds them up after a weak pulse, and [`onset`] says what is born at the boundary.
//! [`trapping_alpha`] is the threshold of motion that never returns to stick-slip. `docs/stability.md`
//! derives all of it. Nothing here integrates (18) in time, so either can judge the other.

mod axis;
mod critical;
mod error;
mod scaled_erfc;
mod transform;
mod trapping;

pub use critical::{Critical, critical, critical_r};
pub use error::StabilityError;
pub use trapping::{creep_rates, trapping_alpha};
