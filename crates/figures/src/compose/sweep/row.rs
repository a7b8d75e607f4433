//! Amplitude and period against one parameter. Steady and trapped tips have neither: they are marked at the foot of
//! the axes.

use super::varied::{Phase, Varied};
use crate::axis::extremes;
use crate::compose::axes::WIDE;
use stickslip::{
    ColourName, CurveDocument, EnsembleDocument, PanelDocument, ScaleName, StatisticsDocument,
    StyleName, SweepDocument, SweepPoint,
};

/// A quantity of a point.
type Measure = fn(&SweepPoint) -> Option<f64>;
/// Its statistics over seeds.
type Statistics = fn(&EnsembleDocument) -> &Option<StatisticsDocument>;

/// Panels of dots, one for each quantity that any point has; the first one if none has any.
pub(super) fn panels(document: &SweepDocument, axis: Varied) -> Vec<PanelDocument> {
    let measures: [(&str, Measure, Statistics); 5] = [
        ("amplitude of x₀ (σ)", |p| p.amplitude_x0, |e| &e.amplitude_x0),
        ("period (Γ/k)", |p| p.period, |e| &e.period),
        ("mean of l (σ)", |p| p.mean_l, |e| &e.mean_l),
        ("deviation of l (σ)", |p| p.deviation_l, |e| &e.deviation_l),
        ("distance of slips (σ)", |p| p.slip_distance, |e| &e.slip_distance),
    ];
    // Of motions that need not have settled, where there are several.
    let ensemble = document.ensembles.as_deref().unwrap_or_default().first();
    let measures = &measures[..if ensemble.is_some() { 5 } else { 2 }];
    let is_there = |(_, value, _): &&(&str, Measure, Statistics)| {
        document.points.iter().any(|p| value(&p).is_some())
    };
    let count = measures.iter().filter(|measure| is_there(measure)).count();
    let shown = measures.iter().filter(|measure| count == 0 || is_there(measure));
    let panel = |(label, value, statistics): &(&str, Measure, Statistics)| {
        let mut panel = panel(document, axis, label, *value);
        let found = ensemble
            .filter(|_| axis.label == "seed")
            .and_then(|ensemble| statistics(ensemble).as_ref());
        if let (Some(found), Some(ends)) = (found, extremes(axis.values.iter().copied())) {
            draw(&mut panel, found, ends);
        }
        panel
    };
    shown.take(count.max(1)).map(panel).collect()
}

/// Adds the mean of an ensemble and its spread, and fits the ordinates to them.
fn draw(panel: &mut PanelDocument, found: &StatisticsDocument, (first, last): (f64, f64)) {
    let line = |style, name: &str, at: f64| {
        CurveDocument::new(style, name, &[first, last], &[at, at]).coloured(ColourName::Black)
    };
    panel.curves.push(line(StyleName::Line, "mean", found.mean));
    let spread = found.deviation.unwrap_or_default();
    let beside = [("mean ± deviation", found.mean - spread), ("", found.mean + spread)];
    panel.curves.extend(beside.map(|(name, at)| line(StyleName::Dashed, name, at)));
    let air = 0.1 * (found.largest - found.least).max(spread);
    if air > 0.0
        && panel.y_scale == ScaleName::Linear
        && !panel.curves.iter().any(|c| c.style == StyleName::SmallTriangles)
    {
        panel.y_range = Some([found.least - air, found.largest + air]);
    }
}

fn panel(document: &SweepDocument, axis: Varied, label: &str, value: Measure) -> PanelDocument {
    let mut panel = PanelDocument::new("", (axis.label, label));
    let values = document.points.iter().filter_map(|p| value(&p)).filter(|v| v.is_finite());
    let positive = extremes(values.clone().filter(|v| *v > 0.0));
    if positive.is_some_and(|(low, high)| high > WIDE * low) {
        panel.y_scale = ScaleName::Logarithmic;
    }
    let range = range(extremes(values), positive, panel.y_scale);
    panel.y_range = Some([range.0, range.1]);
    panel.x_range = extremes(axis.values.iter().copied()).map(|(low, high)| {
        let air = 0.02 * (high - low);
        [low - air, high + air]
    });
    for phase in Phase::ALL {
        let here = || document.points.iter().filter(move |p| Phase::of(p) == Some(phase));
        let place = |p: &SweepPoint| axis.values[axis.place(p)];
        let (x, y): (Vec<f64>, Vec<f64>) =
            here().filter_map(|p| Some((place(&p), value(&p)?))).unzip();
        let without: Vec<f64> = here().filter(|p| value(p).is_none()).map(|p| place(&p)).collect();
        let foot = vec![range.2; without.len()];
        let name = phase.name();
        let at_foot = format!("{name} (no value)");
        let kinds = [
            (StyleName::SmallDots, name, x, y),
            (StyleName::SmallTriangles, at_foot.as_str(), without, foot),
        ];
        for (style, name, x, y) in kinds.into_iter().filter(|(_, _, x, _)| !x.is_empty()) {
            panel.curves.push(CurveDocument::new(style, name, &x, &y).coloured(phase.mark()));
        }
    }
    panel
}

/// First and last ordinate, and the ordinate of points without a value, at the foot of the axes and below all values.
fn range(
    all: Option<(f64, f64)>,
    positive: Option<(f64, f64)>,
    scale: ScaleName,
) -> (f64, f64, f64) {
    match (scale, positive, all) {
        (ScaleName::Logarithmic, Some((low, high)), _) => {
            let span = (high / low).ln();
            let at = |part: f64| low * (part * span).exp();
            (at(-0.16), at(1.08), at(-0.11))
        }
        (_, _, Some((_, high))) if high > 0.0 => (0.0, 1.08 * high, 0.02 * high),
        _ => (0.0, 1.0, 0.02),
    }
}

impl Phase {
    /// The colour of a dot; the silver of areas would be too light.
    fn mark(self) -> stickslip::ColourName {
        if self == Self::Steady { stickslip::ColourName::Grey } else { self.colour() }
    }
}
