//! Growth of ripples from line to line.

use super::drawn::{Drawn, View};
use super::tip::{model_name, tip_name};
use crate::error::FigureError;
use crate::number::short;
use stickslip::{
    CurveDocument, FigureDocument, PanelDocument, RasterBoundaryDocument, RasterStabilityDocument,
    StyleName,
};

impl Drawn for RasterStabilityDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let model = &self.parameters.model_parameters();
        let Some(growth) = &self.growth else {
            let message =
                "there is no growth over wave numbers to draw: give --alpha, and no zigzag";
            return Err(FigureError::Nothing(message.into()));
        };
        let lines = match self.parameters.pitch {
            Some(pitch) => format!("lines {} σ apart", short(pitch)),
            None => "one line repeated".into(),
        };
        let title = format!("{}, {lines}", model_name(model));
        let mut figure = FigureDocument::new("raster-stability", &title, vec![model.clone()]);
        let q = &growth.q;
        let ends = [0.0, q.last().copied().unwrap_or(1.0)];
        let mut factor = PanelDocument::new("", ("q (1/σ)", "growth from line to line"));
        factor.curves = vec![
            CurveDocument::new(StyleName::Thin, "", &ends, &[1.0, 1.0]),
            CurveDocument::new(StyleName::Line, "", q, &growth.factor),
        ];
        let mut phase = PanelDocument::new("", ("q (1/σ)", "phase from line to line"));
        phase.curves = vec![CurveDocument::new(StyleName::Line, "", q, &growth.phase)];
        figure.panels = vec![factor, phase];
        Ok(figure)
    }
}

impl Drawn for RasterBoundaryDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let parameters = &self.parameters;
        let wider = [
            (", b = ", parameters.law.depth_limit),
            (", T = ", parameters.law.healing_time),
            (", M = ", parameters.law.inertia),
        ];
        let wider =
            wider.iter().filter_map(|(name, value)| value.map(|v| format!("{name}{}", short(v))));
        let law = wider.collect::<String>();
        let title =
            format!("{}, r = {}{law}", tip_name(&(&parameters.tip.0).into()), short(parameters.r));
        let mut figure = FigureDocument::new("raster-boundary", &title, vec![]);
        let mut threshold = PanelDocument::new("", ("pitch (σ)", "critical α"));
        let one_way = CurveDocument::new(StyleName::Line, "one-way", &self.pitch, &self.alpha);
        let mut zigzag = CurveDocument::new(StyleName::Dashed, "zigzag", &self.pitch, &[]);
        zigzag.y = self.alpha_zigzag.clone();
        threshold.curves = vec![one_way];
        if self.alpha_zigzag.iter().any(Option::is_some) {
            threshold.curves.push(zigzag);
        }
        let mut angle = PanelDocument::new("", ("pitch (σ)", "crest to scan axis (°)"));
        angle.curves =
            vec![CurveDocument::new(StyleName::Line, "", &self.pitch, &self.crest_angle)];
        figure.panels = vec![threshold, angle];
        Ok(figure)
    }
}
