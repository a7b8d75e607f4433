//! The dense solution of a run, and its surface u(x,t).

use crate::failed::unusable;
use pyo3::PyResult;
use stickslip::RunDocument;
use stickslip_surface::Surface;
use stickslip_tip::{Support, Trajectory};

/// Rows l, x0, velocity and lag at times `t`; NaN if a quantity is not defined for the support.
pub(crate) fn at(trajectory: &Trajectory, t: &[f64]) -> PyResult<Vec<f64>> {
    let (start, end) = (trajectory.start(), trajectory.end());
    if let Some(t) = t.iter().find(|t| !(start..=end).contains(*t)) {
        return Err(unusable(format!(
            "t = {t} is outside of the run, which lasts from {start} to {end}"
        )));
    }
    let none = |_: &f64| f64::NAN;
    let support = trajectory.support();
    let row = |of: &dyn Fn(&f64) -> f64| t.iter().map(of).collect::<Vec<f64>>();
    let l = match support {
        Support::Moving(_) => row(&|t| trajectory.l(*t)),
        Support::Path(_) | Support::None => row(&none),
    };
    let lag = match support {
        Support::None => row(&none),
        Support::Moving(_) | Support::Path(_) => row(&|t| trajectory.lag(*t)),
    };
    let (x0, velocity) = (row(&|t| trajectory.x0(*t)), row(&|t| trajectory.velocity(*t)));
    Ok([l, x0, velocity, lag].concat())
}

/// Heights u(x,t), one row for each t; the same numbers as those of `stickslip surface`.
pub(crate) fn heights(
    run: &RunDocument,
    trajectory: &Trajectory,
    x: &[f64],
    t: &[f64],
) -> PyResult<Vec<f64>> {
    let model = run.parameters.model_parameters().model().map_err(unusable)?;
    let scenario = run.parameters.scenario().map_err(unusable)?;
    let initial = scenario.initial_surface().map_err(unusable)?;
    let surface = Surface::new(&model, &initial, trajectory);
    let mut rows = Vec::with_capacity(x.len() * t.len());
    for t in t {
        let row = surface.heights(*t, x);
        rows.extend(row.map_err(unusable)?);
    }
    Ok(rows)
}
