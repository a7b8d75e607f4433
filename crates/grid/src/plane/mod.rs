//! The full PDE in the plane, for a tip that is free along the scan and across it.
//!
//! The cells cover a plane, and the tip reads the slopes in both coordinates from them. Discretisations are tensor
//! products of discretisations in one coordinate, and a step updates only the cells within reach of the tip.

mod marcher;
mod problem;
mod product;
mod raster;
mod run;
mod sheet;
mod start;
mod tensor;

pub use marcher::PlaneObserver;
pub use problem::PlaneProblem;
pub use product::Product;
pub use raster::{PlaneScan, PlaneScanned, scan_plane};
pub use run::{PlaneRequest, PlaneRun, solve_plane};
pub use start::PlaneStart;
pub use tensor::PlaneMethod;
