//! Lateral forces of a run, for the numbers of its friction loop.

use super::friction::{K_SIGMA, SIGMA};
use crate::{ForceTrack, Refused, RunDocument, SupportPathParameters};
use stickslip_tip::friction::ends_of_loops;

/// Number of nm in 1 m, and of nN in 1 N.
const NANO: f64 = 1e9;

/// Lateral forces at the sample times of a run, against the position of the support: in nm and nN if the run has these
/// scales, otherwise in σ and kσ.
#[derive(Debug, Clone)]
pub struct RunForces {
    /// Times, in Γ/k.
    t: Vec<f64>,
    rows: ForceTrack,
    path: Option<SupportPathParameters>,
    /// Unit of the positions: nm or σ.
    pub unit: &'static str,
    /// Unit of the forces: nN; nm for lags of a run without k; or kσ.
    pub force_unit: &'static str,
}

impl RunForces {
    /// The samples of a run.
    ///
    /// # Errors
    /// The run has no support, or its samples are damaged.
    pub fn of(run: &RunDocument) -> Result<Self, Refused> {
        let refused = |why: &str| Refused::whole("trace", why);
        let samples = &run.samples;
        let no_support = || refused("the run has no lateral force, because it has no spring");
        let lag = samples.lag.as_ref().ok_or_else(no_support)?;
        if !samples.are_even() {
            return Err(refused("damaged: the columns of the samples differ in length"));
        }
        let scales = run.physical.as_ref().map(|physical| physical.scales).unwrap_or_default();
        let length = scales.length.map(|length| NANO * length);
        let force = scales.force.map(|force| NANO * force);
        let along = length.unwrap_or(1.0);
        let across = if length.is_some() { force.unwrap_or(along) } else { 1.0 };
        let x = samples.x0.iter().zip(lag).map(|(x0, lag)| (x0 + lag) * along).collect();
        let (unit, force_unit) = match (length, force) {
            (None, _) => (SIGMA, K_SIGMA),
            (Some(_), None) => ("nm", "nm"),
            (Some(_), Some(_)) => ("nm", "nN"),
        };
        Ok(Self {
            t: samples.t.clone(),
            rows: ForceTrack { x, force: lag.iter().map(|lag| lag * across).collect() },
            path: run.parameters.support_path.clone(),
            unit,
            force_unit,
        })
    }

    /// All samples, for a run that is one way of a loop.
    pub fn way(&self) -> ForceTrack {
        self.rows.clone()
    }

    /// Trace and retrace of the last closed loop: the samples at which the support moves towards larger and towards smaller
    /// positions.
    ///
    /// # Errors
    /// The support does not return to where it began.
    pub fn last_loop(&self) -> Result<[ForceTrack; 2], Refused> {
        let refused = |why: &str| Refused::whole("trace", why);
        let none = || {
            refused(
                "the run has no closed loop: let the support return by {support_path}, or give the run of the retrace too",
            )
        };
        let path = self.path.as_ref().ok_or_else(none)?;
        let knots = path.path().map_err(|error| Refused::whole("trace", error))?;
        let end = self.t.last().copied().unwrap_or_default();
        let ends: Vec<f64> =
            ends_of_loops(&knots).into_iter().take_while(|at| *at <= end).collect();
        let last = *ends.last().ok_or_else(none)?;
        let first = if ends.len() > 1 { ends[ends.len() - 2] } else { path.t[0] };
        let mut ways = [ForceTrack::default(), ForceTrack::default()];
        for (i, t) in self.t.iter().enumerate() {
            // Where the support turns, the sample belongs to the way that ends.
            let piece = path.t.partition_point(|knot| knot < t);
            if *t <= first || *t > last || !(1..path.t.len()).contains(&piece) {
                continue;
            }
            let moved = path.displacement[piece] - path.displacement[piece - 1];
            if moved.abs() > 0.0 {
                let way = &mut ways[usize::from(moved < 0.0)];
                way.x.push(self.rows.x[i]);
                way.force.push(self.rows.force[i]);
            }
        }
        Ok(ways)
    }
}
