//! Motion in two coordinates: a tip that also moves across the scan.
//!
//! Cantilevers are about as soft across the scan as along it. With a spring κ_y across, and the line y = 0,
//!
//! ```text
//!     M x0'' + x0' = α ∫ w f_x(x0 - x', y0 - y') e^{-(t-t')/T} dt' + R(t) - x0 + F_x(t)
//!             y0' = α ∫ w f_y(x0 - x', y0 - y') e^{-(t-t')/T} dt' - κ_y y0 + F_y(t)
//! ```
//!
//! where primed coordinates are those of the tip at t', and w is the weight that a depth limit gives to t' (1 without
//! one). Every f(x,y) is a sum of few products g(x) h(y) (`products`). For each of them the surface consists of some
//! one-dimensional grooves, which the same positions carve with different weights (`layers`). With
//! exponentials for g the past is one complex number for each exponential and each layer (`modes`), and the equations
//! are a polynomial system (`chain`). If the tip retreats beyond the range of validity of the exponentials, Gaussians
//! on a lattice replace them (`lattice`): this occurs after slips of heavy tips, and where the support turns. The memory `fft`
//! convolves densities of all layers (`fields`), and `direct` sums over all positions (`visits`). As κ_y
//! → ∞ the motion becomes that of [`run`](crate::run()).

mod bells;
mod chain;
mod earlier;
mod extent;
mod fields;
mod frame;
mod ground;
mod history;
mod integrator;
mod jet;
mod lattice;
mod layered;
mod layers;
mod modes;
mod part;
mod past;
mod products;
mod running;
mod scenario;
mod spline;
mod stages;
mod texture;
mod visits;
mod weighing;

pub use earlier::{EarlierGrooves, GrooveRows, RowLattice};
pub use frame::Layers;
pub use history::{STEP_NUMBERS, Step, Trajectory, Visit};
pub use integrator::PlanarRunning;
pub use jet::Jet;
pub use products::ProductsError;
pub use running::{PlanarRun, run};
pub use scenario::{PlanarError, PlanarScenario};
pub use texture::{HeightTable, Texture, TextureError};
