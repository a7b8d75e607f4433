//! Surfaces in three dimensions: f(x,y) and its images.

use super::places::Places;
use crate::arguments::SurfaceArguments;
use crate::failure::Failure;
use crate::session::Session;
use ndarray::Array2;
use stickslip::AcrossParameters;
use stickslip::lines::footprint;
use stickslip_surface::Surface;
use stickslip_tip::{Footprint, Model};

/// Requested images, and their footprint.
#[derive(Debug)]
pub(super) struct Images {
    footprint: Footprint,
    /// V, if f(x,y) = f(x)h(y).
    width_y: Option<f64>,
    far_behind: bool,
    /// k'/k above which y0 = 0 is certainly stable.
    stiffness_needed: f64,
}

impl Images {
    /// The images; `None` without `--y-range`.
    pub(super) fn requested(
        arguments: &SurfaceArguments,
        model: &Model,
        places: &Places,
    ) -> Result<Option<Self>, Failure> {
        if places.y.is_empty() {
            return Ok(None);
        }
        let (footprint, width_y) = footprint(arguments.width_y, model.tip())?;
        let stiffness_needed = footprint.transverse_stiffness_needed(model.steady_density());
        let far_behind = arguments.far_behind;
        if arguments.plot.is_some() && (places.spacing.is_none() || places.x.len() < 2) {
            let named = format!("--x with {} values", places.x.len());
            let advice = "a height map needs evenly spaced columns: give --range and --spacing";
            return Err(Failure::input(named, advice));
        }
        Ok(Some(Self { footprint, width_y, far_behind, stiffness_needed }))
    }

    /// Warns if the tip might leave its line. It is not an error: y0 = 0 always solves (54), (55), a sufficiently
    /// stiff k' makes it stable, and the paper's tip (48) is an example.
    pub(super) fn warn(&self, session: &Session) {
        let needed = self.stiffness_needed;
        if needed > 0.0 {
            let bound = if needed.is_finite() {
                format!("certain where the transverse spring k' is above {needed:.4} k")
            } else {
                "certain for no transverse spring k'".into()
            };
            session.remark(format_args!(
                "stickslip: the surface is that of a tip on the line y = 0, but f_yy(x,0) > 0 for some x may push it \
                 off this line: in steady motion y0 = 0 is stable for {bound}"
            ));
        }
    }

    pub(super) fn parameters(&self) -> AcrossParameters {
        let needed = self.stiffness_needed;
        AcrossParameters {
            width_y: self.width_y,
            transverse_stiffness_needed: needed.is_finite().then_some(needed),
        }
    }

    /// u at every y (rows) and every x (columns).
    pub(super) fn heights(
        &self,
        surface: &Surface,
        t: f64,
        (x, y): (&[f64], &[f64]),
    ) -> Result<Array2<f64>, String> {
        let image = if self.far_behind {
            surface.image_far_behind(&self.footprint, t, x, y)
        } else {
            surface.image(&self.footprint, t, x, y)
        };
        image.map_err(|error| error.to_string())
    }
}
