//! A tip that is free to move across the lines.

use crate::error::RasterError;
use stickslip_tip::planar::PlanarScenario;
use stickslip_tip::{Footprint, Force, Scenario};

/// Motion across the lines: y0' = -`u_y` + κ_y (`y_n` - y0) on line n.
#[derive(Debug, Clone)]
pub struct Free {
    /// Stiffness κ_y of the spring across the lines, in units of that along them.
    pub stiffness: f64,
    /// Initial displacement of the tip from the first line, in σ.
    pub kick: f64,
    /// External force across the lines, on the first line, against the time since its start.
    pub disturbance: Force,
}

impl Free {
    /// Free motion on a spring of this stiffness, not disturbed.
    pub fn new(stiffness: f64) -> Self {
        Self { stiffness, kick: 0.0, disturbance: Force::default() }
    }

    /// # Errors
    /// A parameter is out of range, or not available in two coordinates.
    pub(crate) fn validate(
        &self,
        footprint: &Footprint,
        longest: Scenario,
    ) -> Result<(), RasterError> {
        let scenario = self.scenario(footprint, longest, (0, self.kick));
        scenario.validate().map_err(|error| RasterError::of_free(0, error))
    }

    /// The run of line n, from its motion along the scan; the tip starts `off` its line.
    pub(crate) fn scenario(
        &self,
        footprint: &Footprint,
        along: Scenario,
        (n, off): (usize, f64),
    ) -> PlanarScenario {
        let model = along.model.clone().with_footprint(footprint.clone());
        let force_across = if n == 0 { self.disturbance.clone() } else { Force::default() };
        let scenario = PlanarScenario::new(Scenario { model, ..along }, self.stiffness);
        PlanarScenario { kick_across: off, force_across, ..scenario }
    }
}
