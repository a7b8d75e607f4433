//! A line in the plane: request, result, and the function that runs it.

use super::marcher::{Marcher, PlaneObserver};
use super::problem::PlaneProblem;
use super::sheet::Sheet;
use super::tensor::{Factors, PlaneMethod, Tensor};
use crate::{GridError, Request, Stepping, Work};

/// Times at which (x0, y0) is requested, and points (x, y) at which u is requested at the last of them.
pub type PlaneRequest<'a> = Request<'a, [f64; 2]>;

/// Result of a line: trajectory, surface and cost.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneRun {
    /// (x0, y0) at the requested times.
    pub position: Vec<[f64; 2]>,
    /// u at the requested points, at the last requested time.
    pub u: Vec<f64>,
    /// Cost of the run.
    pub work: Work,
}

/// Runs a line from its start to the last requested time.
///
/// # Errors
/// Invalid input; a step lost in round-off; [`GridError::Stopped`].
pub fn solve_plane(
    problem: &PlaneProblem,
    method: &PlaneMethod,
    stepping: &Stepping,
    request: &PlaneRequest,
    observe: &mut PlaneObserver,
) -> Result<PlaneRun, GridError> {
    stepping.check()?;
    problem.check()?;
    request.check(problem.start.time)?;
    let factors = Factors::new(problem.products);
    let tensor = Tensor::new(method, &factors)?;
    let mut sheet = Sheet::default();
    let mut marcher = Marcher::new(problem, (method, &tensor), *stepping, &mut sheet);
    let times = request.times.iter();
    let position =
        times.map(|time| marcher.advance_to(*time, observe)).collect::<Result<_, _>>()?;
    let u = request.points.iter().map(|point| marcher.height(*point)).collect();
    Ok(PlaneRun { position, u, work: marcher.work })
}
