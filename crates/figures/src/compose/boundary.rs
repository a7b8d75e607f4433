//! Figure of the stability boundary, and of the oscillation at onset.

use super::axes::{ALPHA, R};
use super::drawn::{Drawn, View};
use super::tip::law_name;
use crate::axis::extremes;
use crate::error::FigureError;
use stickslip::{
    BoundaryBranch, BoundaryDocument, CurveDocument, FigureDocument, ModelParameters, NoteDocument,
    PanelDocument, ScaleName, SpacingName, StyleName,
};

/// Space above the boundary, as a factor of the largest α.
const AIR: f64 = 1.15;

impl Drawn for BoundaryDocument {
    /// The critical α against r, with the unstable region above shaded, and lines in it at which further pairs of
    /// roots cross the imaginary axis.
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        if self.r.is_empty() {
            let message = "steady motion is stable for every α at each of these r";
            return Err(FigureError::Nothing(message.into()));
        }
        let title = format!("Stability of steady motion, {}", law_name(&any(self)));
        let scale = scale(self);
        let mut panel = PanelDocument::new("", (R, ALPHA));
        (panel.x_scale, panel.y_scale) = (scale, scale);
        let mut curve =
            CurveDocument::new(StyleName::Boundary, "boundary, α = α_c(r)", &self.r, &self.alpha);
        curve.smooth = self.r.len() < 400;
        panel.curves.push(curve);
        let turns = |b: &BoundaryBranch| !b.r.is_sorted() && !b.r.iter().rev().is_sorted();
        if self.branches.len() > 1 || self.branches.iter().any(turns) {
            for (i, branch) in self.branches.iter().enumerate() {
                let name = if i == 0 { "where pairs of roots cross" } else { "" };
                let BoundaryBranch { r, alpha, .. } = branch;
                panel.curves.push(CurveDocument::new(StyleName::Dotted, name, r, alpha));
            }
        }
        // The branches may go to infinity: the axes are those of the boundary.
        let of = |values: &[f64]| extremes(values.iter().copied().filter(|v| v.is_finite()));
        if let (Some(x), Some(y)) = (of(&self.r), of(&self.alpha)) {
            panel.x_range = (x.1 > x.0).then_some([x.0, x.1]);
            panel.y_range = Some(match scale {
                ScaleName::Linear => [0.0, AIR * y.1],
                ScaleName::Logarithmic => [y.0 / 1.5, y.1 * 2.0],
            });
            panel.notes = notes(self, &panel);
        }
        Ok(FigureDocument::new("boundary", &title, models(self), vec![panel]))
    }
}

/// d ln α/d(a²), with a = half the peak-to-peak of x0: the small oscillation exists above the boundary if it is
/// positive, below if it is negative.
pub(super) fn onset_of(document: &BoundaryDocument) -> Result<FigureDocument, FigureError> {
    let title = format!("Oscillation at onset, {}", law_name(&any(document)));
    let slopes = &document.onset.amplitude_squared_slope;
    let excess: Vec<f64> = slopes
        .iter()
        .zip(&document.alpha)
        .map(|(slope, alpha)| slope.map_or(f64::NAN, |slope| 1.0 / (slope * alpha)))
        .collect();
    let finite = excess.iter().copied().filter(|v| v.is_finite());
    let (Some((low, high)), Some((first, last))) =
        (extremes(finite), extremes(document.r.iter().copied()))
    else {
        return Err(FigureError::Nothing("no point of the boundary has a criticality".into()));
    };
    let curves = vec![
        CurveDocument::new(StyleName::Dashed, "", &[first, last], &[0.0; 2]),
        CurveDocument::new(StyleName::Line, "", &document.r, &excess),
    ];
    let mut panel = PanelDocument::of_curves((R, "d ln α/d(a²) (σ⁻²)"), curves);
    panel.x_scale = scale(document);
    panel.x_range = (last > first).then_some([first, last]);
    // Room on the other side of zero for the name of that side.
    let (low, high) = (low.min(-0.2 * high), high.max(-0.2 * low));
    let air = 0.06 * (high - low);
    panel.y_range = Some([low - air, high + air]);
    let middle = match panel.x_scale {
        ScaleName::Linear => 0.5 * (first + last),
        ScaleName::Logarithmic => (first * last).sqrt(),
    };
    panel.notes = vec![
        NoteDocument::new("supercritical", (middle, 0.1 * high)),
        NoteDocument::new("subcritical", (middle, 0.6 * low)),
    ];
    Ok(FigureDocument::new("criticality", &title, models(document), vec![panel]))
}

fn scale(document: &BoundaryDocument) -> ScaleName {
    match document.parameters.spacing {
        SpacingName::Linear => ScaleName::Linear,
        SpacingName::Logarithmic => ScaleName::Logarithmic,
    }
}

/// The model at the first point.
fn models(document: &BoundaryDocument) -> Vec<ModelParameters> {
    let first = document.r.first().zip(document.alpha.first());
    first.map(|(r, alpha)| document.parameters.at(*r, *alpha)).into_iter().collect()
}

/// The law that all points share; α and r are arbitrary.
fn any(document: &BoundaryDocument) -> ModelParameters {
    document.parameters.at(document.parameters.r_range[0], 0.0)
}

/// Part of the height of an axis that a name needs.
const LEAST_ROOM: f64 = 0.1;

/// Names of the regions that have room for one, placed where a region is highest, but not at the sides.
fn notes(document: &BoundaryDocument, panel: &PanelDocument) -> Vec<NoteDocument> {
    let (Some([left, right]), Some([bottom, top])) = (panel.x_range, panel.y_range) else {
        return vec![];
    };
    let logarithmic = panel.x_scale == ScaleName::Logarithmic;
    let on = |value: f64| if logarithmic { value.ln() } else { value };
    let back = |value: f64| if logarithmic { value.exp() } else { value };
    let part = |r: f64| (on(r) - on(left)) / (on(right) - on(left));
    let inside = |(r, a): &(&f64, &f64)| (0.2..0.8).contains(&part(**r)) && a.is_finite();
    let middle: Vec<(&f64, &f64)> = document.r.iter().zip(&document.alpha).filter(inside).collect();
    let lowest = middle.iter().min_by(|a, b| a.1.total_cmp(b.1));
    let highest = middle.iter().max_by(|a, b| a.1.total_cmp(b.1));
    let note = |text, r: f64, from: f64, to: f64| {
        let fits = on(to) - on(from) > LEAST_ROOM * (on(top) - on(bottom));
        fits.then(|| NoteDocument::new(text, (r, back(0.5 * (on(from) + on(to))))))
    };
    let unstable = lowest.and_then(|(r, a)| note("unstable", **r, **a, top));
    let stable = highest.and_then(|(r, a)| note("stable", **r, bottom, **a));
    unstable.into_iter().chain(stable).collect()
}
