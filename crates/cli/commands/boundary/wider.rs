//! `stickslip boundary` under the wider law.

use super::{Asked, OPTION};
use crate::arguments::Interval;
use crate::commands::model::refused_wider;
use crate::commands::progress::Progress;
use crate::failure::Failure;
use stickslip_documents::{BoundaryDocument, LimitColumns, OnsetColumns};
use stickslip_stability::{
    OnsetKind, StabilityError, WiderCritical, critical_under, least_depth_limit, memory_length,
};
use stickslip_tip::{TipFunction, Wider};

/// αc of each r, and what leaves nothing unstable. That nothing is unstable at all is an answer too.
pub(super) fn document(
    asked: &Asked,
    (law, tip): (&Wider, &TipFunction),
    typed: &Interval,
) -> Result<BoundaryDocument, Failure> {
    let points = asked.values.len();
    let mut progress = Progress::new(0.0, points as f64).at_every_call();
    let (mut along, mut left_out, mut least) = (vec![], vec![], vec![]);
    for (n, r) in asked.values.iter().enumerate() {
        match critical_under(law, tip, *r) {
            Ok(found) => along.push(found),
            Err(error @ (StabilityError::NoCrossing { .. } | StabilityError::Unsettled { .. })) => {
                left_out.push(error);
            }
            Err(StabilityError::Wider(error)) => return Err(refused_wider(&error)),
            Err(error) => return Err(typed.refused(OPTION, error)),
        }
        least.push(least_depth_limit(law, tip, *r).ok());
        progress.counted(n as f64 + 1.0, || format!("{} of {points} steps", n + 1));
    }
    let (critical, onset) =
        (along.iter().map(|at| &at.critical), OnsetColumns::unknown(along.len()));
    Ok(BoundaryDocument {
        kind: along.iter().map(|at| at.kind.into()).collect(),
        limits: Some(LimitColumns {
            r: asked.values.clone(),
            least_depth_limit: least,
            memory_length: memory_length(tip).ok(),
        }),
        remarks: remarks(&along, &left_out),
        ..BoundaryDocument::new(asked.parameters(law, tip), critical, onset)
    })
}

fn remarks(along: &[WiderCritical], left_out: &[StabilityError]) -> Vec<String> {
    let first = left_out.first();
    let mut said: Vec<String> = first
        .map(|error| format!("{} values of r are left out: {error}", left_out.len()))
        .into_iter()
        .collect();
    if along.iter().any(|at| at.kind == OnsetKind::NonSmooth) {
        let message = "kind non-smooth: the height under the tip is 0 in steady motion, where |h| of the depth limit \
                       has a corner: alpha is where a small oscillation keeps its amplitude, and at finite amplitude \
                       onset moves";
        said.push(message.into());
    }
    if !along.is_empty() {
        said.push(
            "onset: the leading order of small cycles is had under the paper's law only".into(),
        );
    }
    said
}
