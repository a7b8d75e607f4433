//! The phase diagram of a sweep over two parameters.

use crate::documents::{RangeDocument, RegimeName, SweepDocument, SweepParameters, SweepPoint};
use crate::failure::Failure;
use crate::plot::{self, Phase};

/// The range that is drawn along, besides that of α.
fn across(parameters: &SweepParameters) -> Option<(RangeDocument, &'static str)> {
    let beta = parameters.beta.filter(|beta| beta.points > 1);
    match (parameters.r.points > 1, beta) {
        (true, None) => Some((parameters.r, "r = Γv₀/(kσ)")),
        (false, Some(beta)) => Some((beta, "β")),
        _ => None,
    }
}

fn up(parameters: &SweepParameters) -> Option<(RangeDocument, &'static str)> {
    let alpha = parameters.alpha.map(|alpha| (alpha, "α = ΓNa/(k²σ²)"));
    let above = parameters.alpha_above.map(|above| (above, "α − αc"));
    alpha.or(above).filter(|(range, _)| range.points > 1)
}

/// Refuses a grid that is no plane.
pub(super) fn judge(parameters: &SweepParameters) -> Result<(), Failure> {
    if across(parameters).is_some() && up(parameters).is_some() {
        return Ok(());
    }
    let advice = "a phase diagram needs a range of α and one of either r or beta: give --alpha LO:HI:N --r LO:HI:N";
    Err(Failure::input("--plot", advice))
}

/// An SVG document.
pub(super) fn draw(document: &SweepDocument) -> String {
    let parameters = &document.parameters;
    let (Some((x, x_label)), Some((y, y_label))) = (across(parameters), up(parameters)) else {
        return String::new();
    };
    let (index, of) = document.shard.map_or((1, 1), |shard| (shard.index, shard.of));
    let mut phases = vec![None; x.points * y.points];
    for (i, point) in document.points.iter().enumerate() {
        if let Some(cell) = phases.get_mut(index - 1 + i * of) {
            *cell = phase(point);
        }
    }
    plot::phases(&plot::PhaseFigure {
        title: "What the motion comes to",
        labels: (x_label, y_label),
        x: (x.low, x.high, x.points),
        y: (y.low, y.high, y.points),
        phases: &phases,
    })
}

fn phase(point: &SweepPoint) -> Option<Phase> {
    Some(match (point.regime?, point.slips) {
        (RegimeName::Steady, _) => Phase::Steady,
        (RegimeName::StickSlip, Some(1)) => Phase::OneSlip,
        (RegimeName::StickSlip, Some(2)) => Phase::TwoSlips,
        (RegimeName::StickSlip, _) => Phase::MoreSlips,
        (RegimeName::Trapped, _) => Phase::Trapped,
        (RegimeName::Transient, _) => Phase::Unsettled,
    })
}
