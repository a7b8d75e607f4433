//! Figure of a fit: data, model, residuals, and the profiles of the likelihood.

use super::axes::{after_number, labelled, residual};
use super::drawn::{Drawn, View};
use super::measured_tip::with_error;
use crate::error::FigureError;
use crate::text::literal;
use stickslip::{
    ColourName, CurveDocument, DataFitted, FigureDocument, FitDocument, Law, ModelParameters,
    NumberFitted, PanelDocument, StyleName, TipDocument,
};
use stickslip_tip::sorting::sort_by_number;

/// Signed root of the likelihood at the ends of a 95 % interval.
const END: f64 = 1.96;

impl Drawn for FitDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        if self.data.is_empty() {
            return Err(FigureError::Nothing("there are no data".into()));
        }
        let length = self.parameters.unit.as_deref();
        let words = self.numbers.iter().map(|n| {
            let unit = after_number(unit_of(n, length));
            format!("{} = {}{unit}", symbol(&n.name), with_error(&n.estimate))
        });
        let title = words.collect::<Vec<String>>().join(", ");
        let columns = self.numbers.len().max(1);
        let data = self.data.iter().flat_map(|data| panels(data, length));
        let data = data.map(|panel| PanelDocument { span: columns, ..panel });
        // A number without an interval has no profile.
        let followed = self.numbers.iter().filter(|n| n.profile_values.len() > 1);
        let panels = data.chain(followed.map(|n| profile(n, length))).collect();
        let figure = FigureDocument::new("fit", &title, models(self), panels);
        Ok(FigureDocument { columns, remarks: self.remarks.clone(), ..figure })
    }
}

/// The model, if α and r are known or fitted.
fn models(fit: &FitDocument) -> Vec<ModelParameters> {
    let value = |name: &str| {
        let fitted = fit.numbers.iter().find(|n| n.name == name).map(|n| n.estimate.value);
        fitted.or(fit.parameters.known(name))
    };
    let tip = TipDocument::from(&fit.parameters.tip.clone().unwrap_or_default().0);
    let model = value("alpha").zip(value("r")).map(|(alpha, r)| ModelParameters {
        law: Law {
            depth_limit: value("depth_limit"),
            healing_time: value("healing_time"),
            inertia: value("inertia"),
            ..Law::default()
        },
        ..ModelParameters::papers(tip.clone(), alpha, None, r)
    });
    model.into_iter().collect()
}

fn symbol(name: &str) -> &str {
    match name {
        "alpha" => "α",
        "width" => "σ",
        "beta" => "β",
        "depth_limit" => "b",
        "healing_time" => "T_h",
        "inertia" => "M",
        "alpha_per_load" => "α/load",
        "r_per_velocity" => "r/velocity",
        other => other,
    }
}

/// Data and model, and the residuals.
fn panels(data: &DataFitted, unit: Option<&str>) -> [PanelDocument; 2] {
    let is_series = matches!(data.kind.as_str(), "onsets" | "wavelengths");
    let (x, y) = match data.kind.as_str() {
        "ripple" => ("x", "height"),
        "friction" | "loop" => ("way of the support", "lateral force"),
        "onsets" => ("velocity", "load at onset"),
        _ => ("velocity", "wavelength"),
    };
    // Documents of older versions have the unit of positions among the parameters alone.
    let x = labelled(x, data.x_unit.as_deref().or(unit.filter(|_| !is_series)));
    let y = labelled(y, data.y_unit.as_deref());
    let mut above = PanelDocument::new(&literal(&data.source), (&x, &y));
    let style = if is_series { StyleName::OpenDots } else { StyleName::Points };
    let measured = CurveDocument::new(style, "as measured", &data.x, &data.y);
    above.curves = vec![measured.coloured(ColourName::Grey)];
    // A loop goes there and back: two lines.
    let half = if data.kind == "loop" { data.x.len() / 2 } else { data.x.len() }.max(1);
    let style = if is_series { StyleName::Dots } else { StyleName::Line };
    let lines = data.x.chunks(half).zip(data.model.chunks(half)).enumerate();
    above.curves.extend(lines.map(|(i, (x, model))| {
        let mut rows: Vec<(f64, f64)> = x.iter().copied().zip(model.iter().copied()).collect();
        sort_by_number(&mut rows, |item| item.0);
        let (x, model): (Vec<f64>, Vec<f64>) = rows.into_iter().unzip();
        CurveDocument::new(style, if i == 0 { "model" } else { "" }, &x, &model)
    }));
    let left: Vec<f64> = data.y.iter().zip(&data.model).map(|(y, model)| y - model).collect();
    let difference = residual("model", data.y_unit.as_deref());
    let left = vec![CurveDocument::new(StyleName::Points, "", &data.x, &left)];
    [above, PanelDocument::of_curves((&x, &difference), left)]
}

/// The unit of a parameter; documents of older versions contain only that of lengths.
fn unit_of<'a>(number: &'a NumberFitted, length: Option<&'a str>) -> Option<&'a str> {
    number.unit.as_deref().or(length.filter(|_| number.name == "width"))
}

/// The signed root of the likelihood against the parameter.
fn profile(number: &NumberFitted, unit: Option<&str>) -> PanelDocument {
    let unit = unit_of(number, unit).map(|unit| format!(" ({unit})"));
    let label = format!("{}{}", symbol(&number.name), unit.unwrap_or_default());
    let (x, y) = (&number.profile_values, &number.profile_roots);
    let mut curves = vec![CurveDocument::new(StyleName::Line, "", x, y)];
    if let (Some(first), Some(last)) = (x.first(), x.last()) {
        let ends = [*first, *last];
        let level = |at| CurveDocument::new(StyleName::Dashed, "", &ends, &[at, at]);
        curves.extend([-END, END].map(level));
    }
    PanelDocument::of_curves((&label, "root of likelihood"), curves)
}
