//! Figure of a fit to an image of ripples: the image with its crests, and the mean ripple beside that of the model.

use super::axes::{after_number, labelled};
use super::drawn::{Drawn, View};
use super::measured_tip::with_error;
use super::raster::crest_lines;
use crate::error::FigureError;
use stickslip::{
    ColourName, ColoursName, CurveDocument, FigureDocument, FitImageDocument, MapDocument,
    ModelParameters, PanelDocument, StyleName, TipDocument,
};

impl Drawn for FitImageDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let unit = self.parameters.unit.as_deref();
        let height = labelled("height", self.parameters.height_unit.as_deref());
        let title =
            format!("Ripples: α = {}, r = {}", with_error(&self.alpha), with_error(&self.r));
        let tip = TipDocument::from(&self.parameters.tip.clone().unwrap_or_default().0);
        let model = ModelParameters::papers(tip, self.alpha.value, None, self.r.value);
        let image = &self.levelled;
        let ends = |at: &[f64]| match at {
            [first, .., last] if first < last => Ok([*first, *last]),
            _ => Err(FigureError::Damaged("the image has no positions".into())),
        };
        let (x, y) = (ends(&image.x)?, ends(&image.y)?);
        let heading = format!(
            "{}{} at {}°",
            with_error(&self.wavelength),
            after_number(unit),
            with_error(&self.crest_angle)
        );
        let heading = heading.replace(" ± ", "\u{a0}±\u{a0}");
        let mut surface =
            PanelDocument::new(&heading, (&labelled("x", unit), &labelled("y", unit)));
        surface.curves = vec![crest_lines((&x, &y), (self.q, self.kappa), self.phase)];
        surface.map = Some(MapDocument {
            x: image.x.clone(),
            y: image.y.clone(),
            z: image.rows.clone(),
            z_label: height.clone(),
            colours: ColoursName::Cividis,
            z_range: None,
        });
        let ripple = ripple(self, (&labelled("distance from the crest", unit), &height));
        let figure = FigureDocument::new("fit-image", &title, vec![model], vec![surface, ripple]);
        Ok(FigureDocument { columns: 2, remarks: self.remarks.clone(), ..figure })
    }
}

/// The mean ripple with its error, and that of the model.
fn ripple(document: &FitImageDocument, labels: (&str, &str)) -> PanelDocument {
    let profile = &document.profile;
    let (x, height) = (&profile.distance, &profile.height);
    let rows = || height.iter().zip(&profile.error);
    let high: Vec<f64> = rows().map(|(height, error)| height + 1.96 * error).collect();
    let low: Vec<f64> = rows().map(|(height, error)| height - 1.96 * error).collect();
    let curves = vec![
        CurveDocument::band("95 % of the mean", x, &low, &high).coloured(ColourName::Silver),
        CurveDocument::new(StyleName::Points, "as measured", x, height).coloured(ColourName::Grey),
        CurveDocument::new(StyleName::Line, "model", x, &profile.model),
    ];
    PanelDocument { curves, ..PanelDocument::new("mean ripple", labels) }
}
