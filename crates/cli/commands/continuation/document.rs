//! From branches to their document.

use super::{Found, Origin};
use crate::arguments::{ContinueArguments, OverName};
use crate::documents::{
    ContinueDocument, ContinueParameters, CycleBranch, EndName, FORMAT_VERSION, ModelParameters,
    Software, SpecialDocument, SpecialName, TipDocument,
};
use stickslip_cycles::{End, Point, Special, SpecialKind};
use stickslip_stability::trapping_alpha;

pub(super) fn of(
    arguments: &ContinueArguments,
    origin: &Origin,
    found: &[Found],
    remarks: Vec<String>,
) -> ContinueDocument {
    let first = &found[0].branch.points[0];
    let counts = found.iter().map(|f| f.branch.special.len());
    // Where the special points of each branch begin in the list of all.
    let offsets: Vec<usize> = counts
        .scan(0, |sum, count| {
            *sum += count;
            Some(*sum - count)
        })
        .collect();
    let special = found
        .iter()
        .enumerate()
        .flat_map(|(i, f)| f.branch.special.iter().map(move |special| of_special(i, special)));
    let from = |f: &Found| f.from.map(|(branch, place)| offsets[branch] + place);
    // In steady creep α/r is what counts.
    let ratio = trapping_alpha(origin.tip(), 1.0).ok();
    ContinueDocument {
        format: ContinueDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        parameters: ContinueParameters {
            model: ModelParameters {
                tip: TipDocument::from(origin.tip()),
                alpha: first.alpha,
                alpha_above: arguments.start.model.alpha_above,
                r: first.r,
            },
            over: arguments.over,
            to: arguments.to,
            switch: arguments.switch,
            longest_period: arguments.longest_period,
            longest_step: arguments.longest_step,
            most_points: arguments.most_points,
            tolerance: arguments.start.tolerance,
        },
        branches: found.iter().map(|f| branch(f, from(f))).collect(),
        special: special.collect(),
        trapping: ratio.map(|ratio| match arguments.over {
            OverName::Alpha => ratio * first.r,
            OverName::R => first.alpha / ratio,
        }),
        interrupted: false,
        remarks,
    }
}

fn branch(found: &Found, from: Option<usize>) -> CycleBranch {
    let points = &found.branch.points;
    let column = |of: fn(&Point) -> f64| points.iter().map(of).collect();
    CycleBranch {
        from,
        alpha: column(|p| p.alpha),
        r: column(|p| p.r),
        period: column(|p| p.period),
        amplitude_x0: column(|p| p.amplitude_x0),
        amplitude_u: column(|p| p.amplitude_u),
        stable: points.iter().map(|p| p.stable).collect(),
        multiplier_re: column(|p| p.leading.re),
        multiplier_im: column(|p| p.leading.im),
        end: match found.branch.end {
            End::Reached => EndName::Reached,
            End::LongPeriod => EndName::LongPeriod,
            End::Steady => EndName::Steady,
            End::Halved => EndName::Halved,
            End::ManyPoints => EndName::ManyPoints,
            End::Lost => EndName::Lost,
            End::Interrupted => EndName::Interrupted,
        },
    }
}

fn of_special(branch: usize, special: &Special) -> SpecialDocument {
    SpecialDocument {
        kind: match special.kind {
            SpecialKind::Hopf => SpecialName::Hopf,
            SpecialKind::Fold => SpecialName::Fold,
            SpecialKind::PeriodDoubling => SpecialName::PeriodDoubling,
            SpecialKind::PeriodHalving => SpecialName::PeriodHalving,
            SpecialKind::BranchPoint => SpecialName::BranchPoint,
            SpecialKind::Torus => SpecialName::Torus,
        },
        branch,
        alpha: special.alpha,
        r: special.r,
        period: special.period,
        amplitude_x0: special.cycle.as_ref().map_or(0.0, |cycle| cycle.amplitude_x0()),
    }
}
