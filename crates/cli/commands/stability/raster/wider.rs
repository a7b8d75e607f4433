//! `stickslip stability --pitch` under the wider law.

use super::growth_of;
use super::scales_of;
use crate::arguments::StabilityArguments;
use crate::commands::footprint::footprint;
use crate::commands::grooves::left;
use crate::commands::job::Job;
use crate::commands::model::{tip, wide_model, wider as wider_law};
use crate::failure::{Failure, Typed};
use stickslip_documents::{
    ModelParameters, PathName, Physical, RasterStabilityDocument, RasterStabilityParameters,
};
use stickslip_stability::{RasterCritical, StabilityError, WiderRaster};
use stickslip_tip::Model;

pub(super) fn stability(arguments: &StabilityArguments) -> Result<(), Failure> {
    let (law, tip) = (wider_law(&arguments.model.wider), tip(&arguments.model.tip)?);
    let (footprint, width_y) = footprint(arguments.width_y, &tip)?;
    let path = arguments.path.unwrap_or(PathName::OneWay);
    if path != PathName::OneWay {
        return Err(Failure::input(
            "--path",
            "under the wider law linear theory knows one-way lines only: leave it out, or --depth-limit, \
             --healing-time and --inertia",
        ));
    }
    let missing = |option: &'static str, message| move || Failure::input(option, message);
    let r = arguments.model.r.ok_or_else(missing("--r", "give the support velocity, --r R"))?;
    let pitch = arguments
        .pitch
        .ok_or_else(missing("--pitch", "give the distance of the lines, --pitch D"))?;
    let at = (r, pitch);
    let left = left(arguments.length, &law, r)?;
    let raster = WiderRaster::new(&footprint, law, at, left).map_err(|error| refused(error, at))?;
    let scales = scales_of(arguments)?;
    let job = Job::open::<RasterStabilityDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let critical = raster.critical();
    let given = &arguments.model;
    let is_given = given.alpha.is_some() || given.alpha_above.is_some();
    let model = match critical {
        _ if is_given => wide_model(given)?,
        Ok(RasterCritical { alpha, .. }) => Model::under(law, tip.clone(), alpha, r)
            .map_err(|error| Failure::Run(error.to_string()))?,
        Err(error) => return Err(refused(error, at)),
    };
    let alpha = model.alpha();
    let growth = || growth_of(tip.band(), |q| raster.growth(alpha, q).to_polar());
    let stable = critical.as_ref().map_or(true, |at| alpha < at.alpha);
    let none = critical.as_ref().err().map(|error| format!("critical: {error}"));
    let parameters = RasterStabilityParameters {
        model: ModelParameters::of(&model, given.alpha_above),
        width_y,
        path,
        pitch: Some(pitch),
        length: arguments.length,
        at_critical_point: !is_given,
    };
    let document = RasterStabilityDocument::new(
        parameters,
        critical.as_ref().ok(),
        is_given.then_some(stable),
        is_given.then(growth),
        none.into_iter().collect(),
    );
    job.finish(document.in_units(scales.as_ref()))
}

fn refused(error: StabilityError, (r, pitch): (f64, f64)) -> Failure {
    match error {
        StabilityError::R(_) => Failure::input(format!("--r {}", Typed(r)), error),
        StabilityError::NoSupport => Failure::input("--no-spring", error),
        StabilityError::Corner => Failure::input("--depth-limit", error),
        StabilityError::PapersLawOnly(_) => Failure::input("--tip", error),
        error => Failure::input(format!("--pitch {}", Typed(pitch)), error),
    }
}
