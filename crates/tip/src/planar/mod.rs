//! Two coordinates: a tip that gives way across the scan.
//!
//! Levers are about as soft across the scan as along it. With a spring κ_y across, and the line y = 0,
//!
//! ```text
//!     M x0'' + x0' = α ∫ f_x(x0 - x', y0 - y') e^{-(t-t')/T} dt' + R(t) - x0 + F_x(t)
//!             y0' = α ∫ f_y(x0 - x', y0 - y') e^{-(t-t')/T} dt' - κ_y y0 + F_y(t)
//! ```
//!
//! where primed coordinates are those of the tip at t'. For f(x,y) = g(x) h(y) with a Gaussian h the surface is a few grooves
//! in one dimension, carved by the same visits with other weights (`layers`): with exponentials for g the past is one
//! complex number for each of them and each layer (`modes`), and all is a polynomial system (`chain`). A tip that goes back
//! farther than exponentials hold, as heavy ones do after a slip, or where its support turns, asks Gaussians on a lattice
//! (`lattice`). As κ_y → ∞ the motion becomes that of [`run`](crate::run()).

mod chain;
mod extent;
mod frame;
mod history;
mod integrator;
mod lattice;
mod layers;
mod modes;
mod past;
mod running;
mod scenario;
mod stages;

pub use frame::Layers;
pub use history::{Step, Trajectory, Visit};
pub use running::{PlanarRun, PlanarRunning, run};
pub use scenario::{PlanarError, PlanarScenario};
