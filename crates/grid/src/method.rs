//! The four discretisations, and a function that runs any of them.

use crate::cells::Cells;
use crate::marcher::Marcher;
use crate::scheme::{Scheme, positive, sound};
use crate::sinc::Sinc;
use crate::tableau::{DOP853, DOPRI5};
use crate::theta::Theta;
use crate::three_point::{ThreePoint, WholeGrid};
use crate::{Gaussian, GridError, Observer, Problem, Request, Run, Stepping};
use std::ops::ControlFlow;

/// A discretisation of [`Problem`].
#[derive(Debug, Clone, PartialEq)]
pub enum Method {
    /// The paper's method: u at x_j = j Δx from `from` to `to`, all N + 1 unknowns advanced at every stage by
    /// Dormand–Prince 5(4); the slope at the tip by central differences, interpolated linearly. Order 2.
    Uniform {
        /// Δx
        spacing: f64,
        /// Left end
        from: f64,
        /// Right end
        to: f64,
    },
    /// As [`Method::Uniform`], but a step updates only the cells within reach of the tip. Order 2.
    Windowed {
        /// Δx
        spacing: f64,
    },
    /// For a footprint that is a sum of Gaussians: a lattice with narrower Gaussians for writing and reading; order 8 in
    /// time. With `spacing` ≤ 0.36 the time integration is the only error.
    Spectral {
        /// The terms of the footprint
        gaussians: Vec<Gaussian>,
        /// Spacing in units of the smallest width; π/8.7 reduces its error to round-off
        spacing: f64,
    },
    /// For any smooth footprint: samples and a regularised sinc; order 8 in time. For Gaussians about 3 times the work
    /// of [`Method::Spectral`].
    Sinc {
        /// Spacing of the samples, in units of x: at most π over the largest wave number in f
        spacing: f64,
        /// Cells on either side in the support of the interpolation, 80 for round-off
        half_width: usize,
    },
}

/// Runs `method` from the start to the last requested time.
///
/// # Errors
/// Invalid input; a tip that leaves a [`Method::Uniform`] grid; a step lost in round-off.
pub fn solve(
    problem: &Problem,
    method: &Method,
    stepping: &Stepping,
    request: &Request,
) -> Result<Run, GridError> {
    solve_observed(problem, method, stepping, request, &mut |_, _| ControlFlow::Continue(()))
}

/// As [`solve`], with a callback at the end of each accepted step.
///
/// # Errors
/// As [`solve`]; and [`GridError::Stopped`] if the observer stops the run.
pub fn solve_observed(
    problem: &Problem,
    method: &Method,
    stepping: &Stepping,
    request: &Request,
    observe: &mut Observer,
) -> Result<Run, GridError> {
    stepping.check()?;
    request.check(problem.start.time)?;
    let footprint = problem.footprint;
    let three_point =
        |spacing| Ok::<_, GridError>(ThreePoint { footprint, spacing: positive(spacing)? });
    let everywhere = f64::NEG_INFINITY..f64::INFINITY;
    let (scheme, inside): (Box<dyn Scheme>, _) = match *method {
        Method::Uniform { spacing, from, to } => {
            let whole = WholeGrid::new(three_point(spacing)?, from, to)?;
            let inside = whole.inside();
            (Box::new(whole), inside)
        }
        Method::Windowed { spacing } => (Box::new(three_point(spacing)?), everywhere),
        Method::Spectral { ref gaussians, spacing } => {
            let scheme = Theta::new(gaussians, positive(spacing)?)?;
            (sound(Box::new(scheme), &footprint)?, everywhere)
        }
        Method::Sinc { spacing, half_width } => {
            let scheme = Sinc::checked(footprint, spacing, half_width)?;
            (sound(Box::new(scheme), &footprint)?, everywhere)
        }
    };
    let spacing = scheme.spacing();
    let height = |cell: i64| problem.start.height(cell as f64 * spacing);
    let nothing = |_: i64| 0.0;
    let (cells, tableau, background) = match method {
        // Cells contain the heights themselves,
        Method::Uniform { .. } | Method::Windowed { .. } => (Cells::new(&height), &DOPRI5, None),
        // or only u - u0; u0 and its slope are evaluated on request.
        Method::Spectral { .. } | Method::Sinc { .. } => {
            (Cells::new(&nothing), &DOP853, Some(&problem.start))
        }
    };
    let marcher = Marcher::new(problem, scheme, tableau, *stepping, cells, background);
    let (run, _) =
        run_within(|x0| inside.contains(&x0), observe, |observe| marcher.run(request, observe))?;
    Ok(run)
}

/// A run that ends with [`GridError::LeftGrid`] if the tip is outside the grid at the end of a step.
pub(crate) fn run_within<T>(
    is_inside: impl Fn(f64) -> bool,
    observe: &mut Observer,
    run: impl FnOnce(&mut Observer) -> Result<T, GridError>,
) -> Result<T, GridError> {
    let mut left = None;
    let ran = run(&mut |time, x0| {
        if is_inside(x0) {
            return observe(time, x0);
        }
        left = Some(GridError::LeftGrid { time, x0 });
        ControlFlow::Break(())
    });
    ran.map_err(|error| left.unwrap_or(error))
}
