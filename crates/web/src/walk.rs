//! A walker in the plane.

use crate::limits::{MOST_TIME, Patience};
use crate::refusal::Refusal;
use serde_json::{Map, Value};
use stickslip::parameter::question;
use stickslip::{Ask, Failure, Walker, WalkerDocument};

/// The document of a walker with these parameters, as far as it comes before the page's patience ends.
pub(crate) fn walker(asked: &str, now: fn() -> f64) -> Result<WalkerDocument, Refusal> {
    let values: Map<String, Value> = serde_json::from_str(asked).map_err(Refusal::Json)?;
    let walker: Walker = question(values).map_err(Failure::Refused)?;
    if walker.until > MOST_TIME {
        return Err(Refusal::TooLong(walker.until));
    }
    let patience = Patience::from(now);
    let mut document = walker.ask(&patience.context())?;
    document.work.seconds = patience.seconds();
    Ok(document)
}
