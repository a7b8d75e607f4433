//! Grid solvers of the full PDE for a tip that carves a surface: reference solutions for faster methods.
//!
//! ```text
//! x0'(t) = -u_x(x0(t), t) + r t - x0(t) + Fext(t)      (10)
//! u_t(x, t) = -α f(x - x0(t)),   u(x, t1) = u0(x)      (11)
//! ```
//!
//! The tip function f is given as a function only ([`Footprint`]); the closed equation is not used. [`solve`] runs
//! one of four discretisations, selected by [`Method`]:
//!
//! | method | unknowns advanced at a stage | slope at the tip | in time |
//! |---|---|---|---|
//! | [`Method::Uniform`] | all N + 1, as in the paper | differences, O(Δx²) | Dormand–Prince 5(4) |
//! | [`Method::Windowed`] | the cells within reach of the tip | the same | the same |
//! | [`Method::Spectral`], [`Method::Sinc`] | the same, 8.7/π per tip width | round-off | Dormand–Prince 8(5,3) |
//!
//! Every sum over cells ends at the [`Footprint::reach`], where f is below round-off: nodes are neglected by
//! distance, never by time. The methods are explicit: a deep groove (a trapped tip) makes the problem stiff, u_xx ~
//! αt, and the number of steps grows with it.
//!
//! [`solve_plane`] and [`scan_plane`] solve the same equations on cells of a plane, for a tip that is free along the
//! scan and across it.
//!
//! # Example
//!
//! ```
//! use stickslip_grid::{Footprint, Gaussian, Method, Problem, Request, Start, Stepping, solve};
//!
//! let f = |x: f64| (-0.5 * x * x).exp();
//! let footprint = Footprint::new(&f, 8.8)?;
//! let (alpha, r) = (1.0, 1.0);
//! let start = Start::steady(alpha, r, footprint, 14.0, 0.0);
//! let end = start.time + 10.0;
//! let problem = Problem::new(alpha, r, footprint, start)?;
//! let request = Request { times: &[end], points: &[14.0] };
//! let gaussians = vec![Gaussian { amplitude: 1.0, center: 0.0, width: 1.0 }];
//! let method = Method::Spectral { gaussians, spacing: 0.36 };
//! let run = solve(&problem, &method, &Stepping::absolute(1e-10), &request)?;
//! // α < αc and no kick: in steady motion the tip advances by 10, and the groove at x = 14 has its full depth.
//! assert!((run.x0[0] - 24.0).abs() < 1e-9);
//! assert!((run.u[0] + std::f64::consts::TAU.sqrt()).abs() < 1e-9);
//! # Ok::<(), stickslip_grid::GridError>(())
//! ```

mod bell;
mod cells;
mod error;
mod footprint;
mod marcher;
mod method;
mod patch;
mod plane;
mod problem;
mod raster;
mod run;
mod scheme;
mod sinc;
mod start;
mod stepping;
mod tableau;
mod theta;
mod three_point;
mod wider;

pub use error::GridError;
pub use footprint::Footprint;
pub use method::{Method, solve, solve_observed};
pub use plane::{
    PlaneMethod, PlaneObserver, PlaneProblem, PlaneRequest, PlaneRun, PlaneScan, PlaneScanned,
    PlaneStart, Product, scan_plane, solve_plane,
};
pub use problem::Problem;
pub use raster::{Layer, LineObserver, RowMethod, Scan, ScanLine, Scanned, scan};
pub use run::{Observer, Request, Run, Work};
pub use start::Start;
pub use stepping::Stepping;
pub use theta::Gaussian;
pub use wider::{Path, Wider};
