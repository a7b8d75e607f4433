//! Figure of the growth of ripples from line to line.

use super::drawn::{Drawn, View};
use super::quantity::Quantity;
use super::tip::{model_name, stiffness_name, terms_name, tip_name};
use crate::error::FigureError;
use crate::number::short;
use stickslip::{
    ColourName, CurveDocument, FigureDocument, PanelDocument, RasterBoundaryDocument, RasterKind,
    RasterStabilityDocument, StyleName, ThresholdColumns,
};

/// Space above the lowest thresholds, as a factor.
const AIR: f64 = 1.3;

impl Drawn for RasterStabilityDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let model = &self.parameters.model_parameters();
        let Some(growth) = &self.growth else {
            let message =
                "there is no growth over wave numbers to draw: give --alpha, and no zigzag";
            return Err(FigureError::Nothing(message.into()));
        };
        let lines = match self.parameters.pitch {
            Some(pitch) => {
                let pitch = Quantity::new(pitch, "σ").in_text(&format!("{} σ", short(pitch)));
                format!("lines {pitch} apart")
            }
            None => "one line repeated".into(),
        };
        let across = stiffness_name(self.parameters.stiffness_across);
        let title = format!("{}, {lines}{across}", model_name(model));
        let q = &growth.q;
        let ends = [0.0, q.last().copied().unwrap_or(1.0)];
        let factor = vec![
            CurveDocument::new(StyleName::Thin, "", &ends, &[1.0, 1.0]),
            CurveDocument::new(StyleName::Line, "", q, &growth.factor),
        ];
        let phase = vec![CurveDocument::new(StyleName::Line, "", q, &growth.phase)];
        let panels = vec![
            PanelDocument::of_curves(("q (1/σ)", "growth from line to line"), factor),
            PanelDocument::of_curves(("q (1/σ)", "phase from line to line"), phase),
        ];
        Ok(FigureDocument::new("raster-stability", &title, vec![model.clone()], panels))
    }
}

impl Drawn for RasterBoundaryDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let parameters = &self.parameters;
        let law = terms_name(&parameters.law) + &stiffness_name(parameters.stiffness_across);
        let title =
            format!("{}, r = {}{law}", tip_name(&(&parameters.tip.0).into()), short(parameters.r));
        let one_way = match &self.thresholds {
            Some(columns) => by_kind(&self.pitch, columns),
            None => vec![CurveDocument::new(StyleName::Line, "one-way", &self.pitch, &self.alpha)],
        };
        let mut threshold = PanelDocument::of_curves(("pitch (σ)", "critical α"), one_way);
        let alpha = self.alpha_zigzag.clone();
        let mut zigzag = CurveDocument::with_gaps(StyleName::Dashed, "zigzag", &self.pitch, alpha);
        zigzag.colour = self.thresholds.as_ref().map(|_| ColourName::Black);
        if self.alpha_zigzag.iter().any(Option::is_some) {
            threshold.curves.push(zigzag);
        }
        if self.thresholds.is_some() {
            // Of a kind that comes far later the end is not drawn.
            let lowest = self.alpha.iter().chain(self.alpha_zigzag.iter().flatten());
            let highest = lowest.copied().fold(0.0, f64::max);
            threshold.y_range = (highest > 0.0).then_some([0.0, AIR * highest]);
        }
        let angles = match &self.thresholds {
            Some(columns) => angles(&self.pitch, &self.crest_angle, &columns.kind),
            None => vec![CurveDocument::new(StyleName::Line, "", &self.pitch, &self.crest_angle)],
        };
        let angle = PanelDocument::of_curves(("pitch (σ)", "crest to scan axis (°)"), angles);
        Ok(FigureDocument::new("raster-boundary", &title, vec![], vec![threshold, angle]))
    }
}

/// Kinds of waves and their colours.
const KINDS: [(RasterKind, ColourName); 3] = [
    (RasterKind::Ripples, ColourName::Blue),
    (RasterKind::Bunching, ColourName::Vermillion),
    (RasterKind::Snaking, ColourName::Green),
];

fn by_kind(pitch: &[f64], columns: &ThresholdColumns) -> Vec<CurveDocument> {
    let ThresholdColumns { ripples, bunching, snaking, .. } = columns;
    let curves = KINDS.iter().zip([ripples, bunching, snaking]);
    let drawn = curves.filter(|(_, alpha)| alpha.iter().any(Option::is_some));
    let curve = |((kind, colour), alpha): (&(RasterKind, ColourName), &Vec<Option<f64>>)| {
        CurveDocument::with_gaps(StyleName::Line, kind.as_str(), pitch, alpha.clone())
            .coloured(*colour)
    };
    drawn.map(curve).collect()
}

/// Angles of the critical waves, interrupted where their kind changes.
fn angles(pitch: &[f64], angle: &[f64], first: &[RasterKind]) -> Vec<CurveDocument> {
    let of = |kind: RasterKind| {
        let rows = angle.iter().zip(first);
        rows.map(|(angle, first)| (*first == kind).then_some(*angle)).collect()
    };
    let kinds = KINDS.iter().filter(|(kind, _)| first.contains(kind));
    let curve = |(kind, colour): &(RasterKind, ColourName)| {
        CurveDocument::with_gaps(StyleName::Line, "", pitch, of(*kind)).coloured(*colour)
    };
    kinds.map(curve).collect()
}
