//! The collocation equations of one step, in a single place: the integrator solves them, and limit cycles linearise
//! them.
//!
//! With the displacements d of the tip at the nodes of a step of length h, and the Butcher matrix A,
//!
//! ```text
//!     d_i = h Σ_k a_ik v_k
//!     v_i = α g_i - u0'(x_i) + p_i - κd_i        p: the pull of the support and of forces
//!     g_i = past_i + Σ_k b_ik f'(d_i - d_k)      b = hA: weights of the step's own groove
//! ```
//!
//! All terms of the extended model are here. With a [`Depth`] limit the weight w of each node multiplies the columns of
//! b, and the heights, which determine w, are further unknowns. A surface that heals replaces b by another matrix,
//! [`healing`]. A further term of the force belongs to [`Law`], together with its derivative. Inertia changes the
//! relation of d to v, [`Equations::residual`].

mod depth;
mod estimate;
mod healing;
mod inertia;
mod law;
mod linear_system;
mod own;

pub use depth::{Depth, Known, LimitedFactors, StageResiduals};
pub(crate) use estimate::fastest;
pub use estimate::{defect, interpolation_error, longest_displacement, velocity_at_end};
pub use healing::{healing, healing_rate};
pub use inertia::Inertia;
pub use law::{Equations, Law};
pub(crate) use linear_system::Factors;
pub use own::{Matrix, OwnGroove, OwnHeight, carving};
