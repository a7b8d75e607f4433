//! Numbers with a dimension within texts. They are written in the model's units or, where the scales of an experiment are
//! known, in the units of the axes.

use crate::number::{plus_minus, seven_digits};
use stickslip::{Dimension, FigureDocument, KnownScales, to_its_digits};

/// Marks around a number within a text, and between its parts: characters for private use.
const BEGIN: char = '\u{e000}';
const BETWEEN: char = '\u{e001}';
const END: char = '\u{e002}';

/// A number with a dimension, and its error if that is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quantity {
    pub(super) value: f64,
    pub(super) error: Option<f64>,
    /// Its unit in the model, such as `kσ²/a`.
    pub(super) unit: &'static str,
}

impl Quantity {
    pub(super) fn new(value: f64, unit: &'static str) -> Self {
        Self { value, error: None, unit }
    }

    /// The number for a text, written as `plain` in the model's units.
    pub(super) fn in_text(self, plain: &str) -> String {
        let Self { value, error, unit } = self;
        let error = error.map_or(String::new(), |error| format!("{error:e}"));
        let parts = [plain, &format!("{value:e}"), &error, unit];
        format!("{BEGIN}{}{END}", parts.join(&BETWEEN.to_string()))
    }
}

/// Writes all numbers in the texts of a figure: as they are in the model's units, or in nm, s and nN.
pub(super) fn settle(figure: &mut FigureDocument, scales: Option<&KnownScales>) {
    let write = |text: &mut String| *text = written(text, scales);
    write(&mut figure.title);
    for panel in &mut figure.panels {
        write(&mut panel.heading);
        panel.curves.iter_mut().filter_map(|curve| curve.name.as_mut()).for_each(write);
        panel.notes.iter_mut().for_each(|note| write(&mut note.text));
    }
}

fn written(text: &str, scales: Option<&KnownScales>) -> String {
    let mut whole = String::with_capacity(text.len());
    for (i, piece) in text.split(BEGIN).enumerate() {
        match piece.split_once(END).filter(|_| i > 0) {
            Some((number, rest)) => {
                whole.push_str(&one(number, scales));
                whole.push_str(rest);
            }
            None => whole.push_str(piece),
        }
    }
    whole
}

/// A number from its parts.
fn one(number: &str, scales: Option<&KnownScales>) -> String {
    let mut parts = number.split(BETWEEN);
    let plain = parts.next().unwrap_or_default().to_owned();
    let value = parts.next().and_then(|value| value.parse::<f64>().ok());
    let error = parts.next().and_then(|error| error.parse::<f64>().ok());
    let (Some(scales), Some(value), Some(unit)) = (scales, value, parts.next()) else {
        return plain;
    };
    let known = Dimension::of_unit(unit).and_then(|d| Some((d.factor(scales)?, d.unit())));
    let Some((factor, physical)) = known else {
        return if plain.ends_with(unit) { plain } else { format!("{plain}\u{a0}{unit}") };
    };
    let rounded = |value: f64| format!("{value:.4e}").parse().unwrap_or(value);
    let digits = match error {
        Some(error) if plain.contains('±') => plus_minus(value * factor, error * factor),
        Some(error) => to_its_digits(value * factor, error * factor),
        None => seven_digits(rounded(value * factor)),
    };
    format!("{digits}\u{a0}{physical}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_follow_the_axes_and_texts_without_scales_stay() {
        let scales =
            KnownScales { length: Some(30e-9), time: Some(0.5), height: None, force: None };
        let time = Quantity { value: 7.0, error: Some(0.002), unit: "Γ/k" };
        let text = format!(
            "T = {}, b = {}, d = {}",
            time.in_text("7.0000(20)"),
            Quantity::new(3.0, "kσ²/a").in_text("3"),
            Quantity::new(0.8, "σ").in_text("0.8"),
        );
        assert_eq!(written(&text, None), "T = 7.0000(20), b = 3, d = 0.8");
        let said = written(&text, Some(&scales)).replace('\u{a0}', " ");
        let period = to_its_digits(3.5, 0.001);
        assert_eq!(said, format!("T = {period} s, b = 3 kσ²/a, d = 24 nm"));
        let length =
            Quantity { value: 4.46, error: Some(0.71), unit: "σ" }.in_text("4.46 ± 0.71 σ");
        assert_eq!(written(&length, None), "4.46 ± 0.71 σ");
        assert_eq!(written(&length, Some(&scales)).replace('\u{a0}', " "), "134 ± 21 nm");
        for odd in ["\u{e000}", "a\u{e002}", "\u{e000}\u{e001}\u{e002}", "\u{e000}x"] {
            assert!(written(odd, Some(&scales)).chars().count() <= odd.chars().count());
        }
    }
}
