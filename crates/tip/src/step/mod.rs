//! The collocation equations of one step, written down once: the integrator solves them, cycles linearise
//! them.
//!
//! With the displacements d of the tip at the nodes of a step of length h, and the Butcher matrix A,
//!
//! ```text
//!     d_i = h Σ_k a_ik v_k
//!     v_i = α g_i - u0'(x_i) + p_i - κd_i        p: the pull of the support and of forces
//!     g_i = past_i + Σ_k b_ik f'(d_i - d_k)      b = hA: what the step itself carves
//! ```
//!
//! Whatever changes the law changes it here. The weight w of each visit under a [`Depth`] limit multiplies the
//! columns of b, with the heights that it depends on as further unknowns; a surface that heals makes b another
//! matrix, [`healing`]; a further term of the force goes into [`Law`], with its derivative beside it; an inertia
//! is another way from v to d, [`Equations::residual`].

mod depth;
mod estimate;
mod healing;
mod inertia;
mod law;
mod linear_system;
mod own;

pub use depth::{Depth, Known, LimitedFactors, Missed};
pub use estimate::{defect, interpolation_error, longest_displacement, velocity_at_end};
pub use healing::{healing, healing_rate};
pub use inertia::Inertia;
pub use law::{Equations, Law};
pub(crate) use linear_system::Factors;
pub use own::{Matrix, OwnGroove, OwnHeight, carving};
