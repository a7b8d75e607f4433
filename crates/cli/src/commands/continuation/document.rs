//! From branches to their document.

use super::{Found, Origin};
use crate::arguments::ContinueArguments;
use stickslip::{
    ContinueDocument, ContinueFound, ContinueParameters, CycleBranch, Document, ModelParameters,
    OverName, SpecialDocument, TipDocument,
};
use stickslip_stability::trapping_alpha;

pub(super) fn of(
    arguments: &ContinueArguments,
    origin: &Origin,
    found: &[Found],
    (remarks, interrupted): (Vec<String>, bool),
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
    let special = found.iter().enumerate().flat_map(|(i, f)| {
        f.branch.special.iter().map(move |special| SpecialDocument::of(i, special))
    });
    let from = |f: &Found| f.from.map(|(branch, place)| offsets[branch] + place);
    // In steady creep α/r is what counts; under a depth limit, or where the surface heals, no tip is held for ever.
    let ratio = trapping_alpha(origin.tip(), 1.0).ok().filter(|_| origin.wider().traps());
    let papers = ModelParameters::papers(
        TipDocument::from(origin.tip()),
        first.alpha,
        arguments.start.model.alpha_above,
        first.r,
    );
    let parameters = ContinueParameters {
        model: ModelParameters { law: (*origin.wider()).into(), ..papers },
        over: arguments.over,
        to: arguments.to,
        switch: arguments.switch,
        longest_period: arguments.longest_period,
        longest_step: arguments.longest_step,
        most_points: arguments.most_points,
        tolerance: arguments.start.tolerance,
    };
    let branches = found.iter().map(|f| CycleBranch::of(&f.branch, from(f))).collect();
    let trapping = ratio.map(|ratio| match arguments.over {
        OverName::Alpha => ratio * first.r,
        OverName::R => first.alpha / ratio,
    });
    let special = special.collect();
    let found = ContinueFound { branches, special, trapping, interrupted };
    Document::new(parameters, found, remarks)
}
