//! A walker in the plane.

use crate::limits::{MOST_TIME, Stopwatch};
use crate::refusal::Refusal;
use serde_json::{Map, Value};
use stickslip::parameter::question;
use stickslip::{Ask, Failure, Walker, WalkerDocument};

/// The document of a walker with these parameters, cut off at the page's limit of computing time.
pub(crate) fn walker(parameters: &str, now: fn() -> f64) -> Result<WalkerDocument, Refusal> {
    let values: Map<String, Value> = serde_json::from_str(parameters).map_err(Refusal::Json)?;
    let walker: Walker = question(values).map_err(Failure::Refused)?;
    if walker.until > MOST_TIME {
        return Err(Refusal::TooLong(walker.until));
    }
    let stopwatch = Stopwatch::from(now);
    let mut document = walker.ask(&stopwatch.context())?;
    document.work.seconds = stopwatch.seconds();
    Ok(document)
}
