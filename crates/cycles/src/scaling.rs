//! Amplitude and wavelength as functions of the distance from onset: the laws of the paper's Figs. 2, 3 and 5.
//!
//! Near the critical point the square of the amplitude and the wavelength are linear in the distance from it.

use super::{CycleError, Parameter, UnsettledRun, cycle};
use stickslip_stability::{Onset, critical, critical_r, onset_at};
use stickslip_tip::motion::{Oscillation, latest_extrema};
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::{Model, Scenario, TipFunction, Wider, run};

/// A scaling law close to onset, fitted at several distances from it.
#[derive(Debug, Clone, PartialEq)]
pub struct Scaling {
    /// The critical value of the parameter that varies.
    pub critical: f64,
    /// The points, by increasing distance.
    pub points: Vec<ScalingPoint>,
    /// Straight line for the squared amplitude of x0.
    pub amplitude_x0_squared: Line,
    /// Straight line for the squared amplitude of the surface far behind the tip; `None` for runs, which do not
    /// contain it.
    pub amplitude_u_squared: Option<Line>,
    /// Straight line for the wavelength.
    pub wavelength: Line,
}

/// Amplitudes and wavelength at one distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScalingPoint {
    /// Distance of the parameter from its critical value.
    pub distance: f64,
    /// Half the peak-to-peak value of l.
    pub amplitude_x0: f64,
    /// Half the peak-to-peak value of u far behind the tip; `None` for runs.
    pub amplitude_u: Option<f64>,
    /// Wavelength rT.
    pub wavelength: f64,
}

/// The straight line intercept + slope · distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Value at the critical point.
    pub intercept: f64,
    /// Change per unit distance.
    pub slope: f64,
}

/// Source of the amplitudes and wavelengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measured {
    /// Cycles from [`cycle`], with this residual.
    Cycles(f64),
    /// Runs with this tolerance, which start close to the cycle and last until the initial deviation has decayed.
    Runs(f64),
}

/// The scaling laws for the parameter `over` at the value `other` of the fixed parameter, from motions at these
/// distances from the critical point. A distance is negative if oscillations exist below the critical value, as for r.
///
/// # Errors
/// No critical point, or a distance at which there is no small motion.
pub fn scaling(
    tip: &TipFunction,
    (over, other): (Parameter, f64),
    distances: &[f64],
    measured: Measured,
) -> Result<Scaling, CycleError> {
    let born = match over {
        Parameter::Alpha => critical(&Wider::default(), tip, other)?,
        Parameter::R => critical_r(&Wider::default(), tip, other)?,
    };
    let onset = onset_at(tip, born)?;
    let at = |distance: f64| {
        let (alpha, r) = match over {
            Parameter::Alpha => (born.alpha + distance, other),
            Parameter::R => (other, born.r + distance),
        };
        let model = Model::new(tip.clone(), alpha, r);
        let model = model.map_err(|_| CycleError::NotConverged { alpha, r })?;
        match measured {
            Measured::Cycles(tolerance) => of_cycle(&model, distance, tolerance),
            Measured::Runs(tolerance) => of_run(&model, &onset, distance, tolerance),
        }
    };
    let mut points = distances.iter().map(|d| at(*d)).collect::<Result<Vec<_>, _>>()?;
    sort_by_number(&mut points, |item| item.distance);
    let line = |of: &dyn Fn(&ScalingPoint) -> f64| {
        Line::through(&points.iter().map(|p| (p.distance, of(p))).collect::<Vec<_>>())
    };
    let told = points.iter().all(|p| p.amplitude_u.is_some());
    Ok(Scaling {
        critical: if over == Parameter::Alpha { born.alpha } else { born.r },
        amplitude_x0_squared: line(&|p| p.amplitude_x0.powi(2)),
        amplitude_u_squared: told.then(|| line(&|p| p.amplitude_u.unwrap_or(0.0).powi(2))),
        wavelength: line(&|p| p.wavelength),
        points,
    })
}

fn of_cycle(model: &Model, distance: f64, tolerance: f64) -> Result<ScalingPoint, CycleError> {
    let cycle = cycle(model, tolerance)?;
    Ok(ScalingPoint {
        distance,
        amplitude_x0: cycle.amplitude_x0(),
        amplitude_u: Some(cycle.amplitude_u()),
        wavelength: cycle.wavelength(),
    })
}

/// Duration of a run, in e-foldings of the initial deviation.
const FOLDINGS: f64 = 14.0;

fn of_run(
    model: &Model,
    onset: &Onset,
    distance: f64,
    tolerance: f64,
) -> Result<ScalingPoint, CycleError> {
    // Small motions depend on how far α is above its critical value at this r.
    let above = model.alpha() - critical(&Wider::default(), model.tip(), model.r())?.alpha;
    let mut scenario = Scenario::new(model.clone(), 0.0);
    scenario.kick = (onset.amplitude_squared_slope * above).abs().sqrt();
    scenario.tolerance = tolerance;
    // A deviation of the amplitude decays twice as fast as one of steady motion grows.
    let decay = 2.0 * (onset.growth_slope * above).abs();
    let settling = FOLDINGS / decay + 10.0 * onset.critical.period;
    scenario.until = scenario.start_time() + settling;
    let run = run(&scenario)?;
    let (alpha, r) = (model.alpha(), model.r());
    let found = Oscillation::of(&run.trajectory, &latest_extrema(&run.trajectory));
    let oscillation = found.ok_or_else(|| {
        let ended = Some(UnsettledRun { scenario, run }.ended());
        CycleError::NoCycleReached { alpha, r, ended }
    })?;
    let amplitude_x0 = oscillation.amplitude_x0;
    Ok(ScalingPoint {
        distance,
        amplitude_x0,
        amplitude_u: None,
        wavelength: oscillation.wavelength,
    })
}

impl Line {
    /// The straight line, by least squares.
    fn through(points: &[(f64, f64)]) -> Self {
        let n = points.len() as f64;
        let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
        let variance: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
        let slope = covariance / variance;
        Self { intercept: y - slope * x, slope }
    }
}
