//! The phase diagram: regimes over two parameters.

use super::varied::{Phase, Varied};
use crate::cells::sorted;
use crate::compose::axes::{ALPHA, R};
use stickslip::{ColourName, CurveDocument, PanelDocument, StyleName, SweepDocument};
use stickslip_stability::{critical, trapping_alpha};
use stickslip_tip::{TipFunction, Wider};

/// A column of cells for every value of the slow parameter, with the lines of theory.
pub(super) fn panel(document: &SweepDocument, slow: Varied, fast: Varied) -> PanelDocument {
    let mut panel = PanelDocument::new("", (slow.label, fast.label));
    let mut kinds = vec![vec![None; slow.values.len()]; fast.values.len()];
    for point in document.points.iter() {
        let kind = Phase::of(&point).and_then(|p| Phase::ALL.iter().position(|all| *all == p));
        kinds[fast.place(&point)][slow.place(&point)] = kind;
    }
    let names = Phase::ALL.iter().map(|phase| phase.name().into()).collect();
    let colours = Phase::ALL.iter().map(|phase| phase.colour()).collect();
    let cells = sorted((slow.values, fast.values), &kinds, names, colours);
    (panel.x_range, panel.y_range) = (ends(&cells.x), ends(&cells.y));
    panel.cells = Some(cells);
    panel.curves = lines(document, slow, fast);
    panel
}

fn ends(values: &[f64]) -> Option<[f64; 2]> {
    let (first, last) = (*values.first()?, *values.last()?);
    (first < last).then_some([first, last])
}

/// αc and the trapping threshold, if α is one of the axes.
fn lines(document: &SweepDocument, slow: Varied, fast: Varied) -> Vec<CurveDocument> {
    let parameters = &document.parameters;
    let is_above = fast.label != ALPHA;
    // Theory is about α: over another axis it has no line here.
    if parameters.axes.iter().any(|axis| axis.name.label() == fast.label) {
        return vec![];
    }
    if parameters.alpha.as_ref().or(parameters.alpha_above.as_ref()).is_none_or(|a| a.len() < 2) {
        return vec![];
    }
    // Values in the points cost nothing.
    let mut known = vec![None; slow.values.len()];
    for point in document.points.iter() {
        let known = &mut known[slow.place(&point)];
        *known = known.or(point.critical_alpha);
    }
    let known = known.into_iter().enumerate();
    let thresholds: Vec<(f64, f64, f64)> =
        known.map(|(i, known)| threshold(document, slow, i, known)).collect();
    let x: Vec<f64> = thresholds.iter().map(|t| t.0).collect();
    let line = |style, name: &str, y: fn(&(f64, f64, f64)) -> f64, colour| {
        let shown: Vec<f64> =
            thresholds.iter().map(|t| if is_above { y(t) - t.1 } else { y(t) }).collect();
        let curve = CurveDocument::new(style, name, &x, &shown).coloured(colour);
        CurveDocument { smooth: true, ..curve }
    };
    vec![
        line(StyleName::Line, "α_c", |t| t.1, ColourName::Black),
        line(StyleName::Dashed, "α of trapping", |t| t.2, ColourName::Green),
    ]
}

/// The i-th value of the slow parameter, αc at this value, computed unless `known`, and the trapping threshold; NaN if
/// there is none.
fn threshold(
    document: &SweepDocument,
    slow: Varied,
    i: usize,
    known: Option<f64>,
) -> (f64, f64, f64) {
    let parameters = &document.parameters;
    let of_r = slow.label == R;
    let r = if of_r { slow.values[i] } else { parameters.r.first().copied().unwrap_or(f64::NAN) };
    let tip = if of_r { parameters.tips.first() } else { parameters.tips.get(i) };
    let of = |value: &dyn Fn(&TipFunction) -> Option<f64>| tip.and_then(|tip| value(&tip.0));
    let onset =
        known.or_else(|| of(&|tip| critical(&Wider::default(), tip, r).ok().map(|c| c.alpha)));
    let trapped = of(&|tip| trapping_alpha(tip, r).ok());
    (slow.values[i], onset.unwrap_or(f64::NAN), trapped.unwrap_or(f64::NAN))
}
