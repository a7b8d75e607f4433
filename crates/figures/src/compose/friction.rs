//! Figure of a friction loop: trace and retrace, with the kinetic force and the static peaks.

use super::axes::after_number;
use super::drawn::{Drawn, View};
use super::measured_tip::with_error;
use crate::error::FigureError;
use stickslip::{
    ColourName, CurveDocument, FigureDocument, FrictionDocument, PanelDocument, StyleName,
};

impl Drawn for FrictionDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let x = &self.rows.x;
        let [first, .., last] = &**x else {
            return Err(FigureError::Nothing("the loop has no rows".into()));
        };
        let said = |estimate, unit: &Option<String>| {
            let unit = after_number(unit.as_deref());
            format!("{}{unit}", with_error(estimate)).replace(' ', "\u{a0}")
        };
        let title = format!(
            "Friction loop: kinetic {}, static {}, work {}",
            said(&self.kinetic, &self.force_unit),
            said(&self.static_peak, &self.force_unit),
            said(&self.work, &self.work_unit)
        );
        let label = |name: &str, unit: &Option<String>| match unit {
            Some(unit) => format!("{name} ({unit})"),
            None => name.into(),
        };
        let labels =
            (label("support at x", &self.length_unit), label("lateral force", &self.force_unit));
        let mut curves = vec![];
        let (ends, offset) = ([*first, *last], self.offset.value);
        for (name, force, style) in [
            ("kinetic", self.kinetic.value, StyleName::Dashed),
            ("static", self.static_peak.value, StyleName::Dotted),
        ] {
            for (name, at) in [(name, offset + force), ("", offset - force)] {
                let line = CurveDocument::new(style, name, &ends, &[at, at]);
                curves.push(line.coloured(ColourName::Grey));
            }
        }
        let trace = CurveDocument::new(StyleName::Line, "trace", x, &self.rows.trace);
        let retrace = CurveDocument::new(StyleName::Line, "retrace", x, &self.rows.retrace);
        curves.extend([trace, retrace.coloured(ColourName::Vermillion)]);
        let panel = PanelDocument::of_curves((&labels.0, &labels.1), curves);
        let figure = FigureDocument::new("friction", &title, vec![], vec![panel]);
        Ok(FigureDocument { remarks: self.remarks.clone(), ..figure })
    }
}
