//! Headings of columns: names, and units in all usual notations.

use stickslip_units::Unit;

/// The heading of a column; may be empty.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Heading {
    text: String,
    /// The unit as written, known or not.
    unit: Option<String>,
}

const UNITS: [Unit; 6] =
    [Unit::Length, Unit::Time, Unit::Force, Unit::Velocity, Unit::Stiffness, Unit::Damping];
/// Notations for no unit, and for the units of the model.
const NONE: [&str; 9] = ["", "-", "1", "--", "σ", "sigma", "Γ/k", "kσ", "kσ²/a"];
/// Units of other quantities that may occur in a row of units.
const OTHERS: [&str; 14] =
    ["V", "mV", "uV", "µV", "nA", "pA", "deg", "°", "Hz", "kHz", "a.u.", "arb.", "%", "px"];

impl Heading {
    /// A heading, with its unit if it contains one.
    #[must_use]
    pub fn of(text: &str) -> Self {
        Self { text: text.to_owned(), unit: unit_in(text).map(|(_, unit)| unit) }
    }

    /// The heading with a unit that is given elsewhere.
    pub(crate) fn with_unit(self, unit: &str) -> Result<Self, String> {
        let unit = unit.trim();
        let is_same = |own: &str| {
            own == unit
                || UNITS.iter().any(|of| of.one(own).is_some() && of.one(own) == of.one(unit))
        };
        match &self.unit {
            _ if NONE.contains(&unit) => Ok(self),
            Some(own) if !is_same(own) => {
                Err(format!("the heading `{}` has two units, {own} and {unit}", self.text))
            }
            Some(_) => Ok(self),
            None => Ok(Self { unit: Some(unit.to_owned()), ..self }),
        }
    }

    /// The heading as written.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The unit as written, known or not.
    #[must_use]
    pub fn written_unit(&self) -> Option<&str> {
        self.unit.as_deref()
    }

    /// Its name without the unit.
    #[must_use]
    pub fn name(&self) -> &str {
        let name = unit_in(&self.text).and_then(|(start, _)| self.text.get(..start));
        name.unwrap_or(&self.text).trim()
    }

    /// The unit of a quantity, and its value in SI units; `None` if there is none.
    ///
    /// # Errors
    ///
    /// The heading has the unit of another quantity.
    pub fn unit(&self, of: Unit) -> Result<Option<(&str, f64)>, String> {
        let Some(unit) = self.unit.as_deref() else { return Ok(None) };
        match of.one(unit) {
            Some(one) => Ok(Some((unit, one))),
            None => Err(format!(
                "the heading `{}` has the unit `{unit}`, where a unit such as {} is needed",
                self.text,
                example(of)
            )),
        }
    }
}

fn example(of: Unit) -> &'static str {
    match of {
        Unit::Length => "nm or um",
        Unit::Time => "s or ms",
        Unit::Force => "nN or uN",
        Unit::Velocity => "um/s",
        Unit::Stiffness => "N/m",
        Unit::Damping => "kg/s",
        Unit::Mass => "kg",
        Unit::Rate => "1/s",
        Unit::Voltage => "V or mV",
    }
}

fn is_known(unit: &str) -> bool {
    UNITS.iter().any(|of| of.one(unit).is_some())
}

/// Position and text of the unit in a heading: x (nm), x [nm], x_nm, x/nm, x in nm, x, nm.
///
/// Any text in brackets counts as a unit; `x_0` has none.
fn unit_in(text: &str) -> Option<(usize, String)> {
    let mut in_brackets = None;
    for (open, close) in [('(', ')'), ('[', ']'), ('{', '}'), ('<', '>')] {
        for (start, _) in text.match_indices(open) {
            let Some((unit, _)) = text[start + 1..].split_once(close) else { continue };
            let unit = unit.trim();
            if is_known(unit) {
                return Some((start, unit.to_owned()));
            }
            if !NONE.contains(&unit) {
                in_brackets = Some((start, unit.to_owned()));
            }
        }
    }
    after_mark(text).or(in_brackets)
}

fn after_mark(text: &str) -> Option<(usize, String)> {
    let text = text.replace("_per_", "/");
    let first = text.find('/').filter(|start| !text[..*start].contains(['_', ' ']));
    let last =
        [" in ", "_", ",", ":", " "].into_iter().filter_map(|mark| Some((text.rfind(mark)?, mark)));
    let places = first.map(|start| (start, "/")).into_iter().chain(last);
    places.into_iter().find_map(|(start, mark)| {
        let unit = text[start + mark.len()..].trim();
        // A single letter behind a blank is rather a name.
        let is_unit = is_known(unit) && (mark != " " || unit.chars().count() > 1);
        // Letters that no encoding has left as they were.
        let is_garbled = mark == "_" && unit.contains(['?', '\u{fffd}', 'Â', 'Î']);
        let is_voltage = mark == "_" && Unit::Voltage.one(unit).is_some();
        (is_unit || is_garbled || is_voltage).then(|| (start, unit.to_owned()))
    })
}

/// The units in a row of units; `None` for any other row.
pub(crate) fn units_of_row(fields: &[&str]) -> Option<Vec<String>> {
    let unit = |field: &&str| {
        let inner = ["()", "[]", "{}", "<>"].into_iter().find_map(|pair| {
            let mut ends = pair.chars();
            field.strip_prefix(ends.next()?)?.strip_suffix(ends.next()?)
        });
        let is_unit =
            inner.is_some() || is_known(field) || NONE.contains(field) || OTHERS.contains(field);
        is_unit.then(|| inner.unwrap_or(field).trim().to_owned())
    };
    let units: Vec<String> = fields.iter().map(unit).collect::<Option<_>>()?;
    // `V,N` are names rather than volts and newtons.
    let is_sure = |(field, unit): (&&str, &String)| {
        is_known(unit) && (*field != unit || unit.chars().count() > 1)
    };
    let are_all = units.len() > 1 && units.iter().all(|unit| is_known(unit));
    (are_all || fields.iter().zip(&units).any(is_sure)).then_some(units)
}

/// Units of columns on a separate line, such as `units: nm nm` or `XUnit = µm`; may be empty.
pub(crate) fn units_of_line(line: &str, columns: usize) -> Vec<(usize, String)> {
    let Some((key, value)) = line.split_once([':', '=', '\t']) else { return vec![] };
    let key: String = key.to_lowercase().chars().filter(char::is_ascii_lowercase).collect();
    let units: Vec<String> = value
        .split([' ', '\t', ',', ';'])
        .map(|unit| unit.trim_matches(['"', '(', ')', '[', ']']).to_owned())
        .filter(|unit| !unit.is_empty())
        .collect();
    let all = |units: &[String]| (0..columns).zip(units.iter().cloned()).collect();
    match (&*key, units.as_slice()) {
        ("unit" | "units", [unit]) => all(&vec![unit.clone(); columns]),
        ("unit" | "units", units) if units.len() == columns => all(units),
        (
            "xunit" | "xunits" | "unitx" | "unitsx" | "xaxisunit" | "xaxisunits" | "xunitlabel",
            [unit],
        ) => {
            vec![(0, unit.clone())]
        }
        (
            "yunit" | "yunits" | "unity" | "unitsy" | "yaxisunit" | "yaxisunits" | "yunitlabel"
            | "zunit" | "zunits" | "unitz" | "unitsz",
            [unit],
        ) if columns > 1 => {
            vec![(columns - 1, unit.clone())]
        }
        ("xyunit" | "xyunits", [unit]) => all(&vec![unit.clone(); columns]),
        _ => vec![],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_found_wherever_they_are_written() {
        for heading in [
            "x_nm",
            "x (nm)",
            "x [nm]",
            "x/nm",
            "scan distance (nm)",
            "Height (trace) [nm]",
            "x in nm",
            "x, nm",
            "x nm",
            "x {nm}",
        ] {
            let (_, one) = Heading::of(heading).unit(Unit::Length).unwrap().unwrap();
            assert!((one / 1e-9 - 1.0).abs() < 1e-15, "{heading}");
        }
        for heading in ["x (µm)", "x (μm)", "x_um", "x [micron]", "x/µm"] {
            let (_, one) = Heading::of(heading).unit(Unit::Length).unwrap().unwrap();
            assert!((one / 1e-6 - 1.0).abs() < 1e-15, "{heading}");
        }
        for heading in ["x (Å)", "x (\u{212b})", "x_angstrom", "x [A\u{30a}]"] {
            let (_, one) = Heading::of(heading).unit(Unit::Length).unwrap().unwrap();
            assert!((one / 1e-10 - 1.0).abs() < 1e-15, "{heading}");
        }
        let (unit, one) = Heading::of("velocity_nm_per_s")
            .unit(Unit::Velocity)
            .map(Option::unwrap)
            .map(|(u, o)| (u.to_owned(), o))
            .unwrap();
        assert!(unit == "nm/s" && (one / 1e-9 - 1.0).abs() < 1e-15);
        for heading in ["x", "", "x_", "x ()", "x_0", "x_foo", "load N", "x (σ)", "trace/retrace"]
        {
            assert_eq!(Heading::of(heading).unit(Unit::Length), Ok(None), "{heading}");
        }
        for heading in ["x (furlong)", "x [px]", "t (ms)", "x_?m", "x (\u{fffd}m)", "x_N"] {
            assert!(Heading::of(heading).unit(Unit::Length).is_err(), "{heading}");
        }
        assert_eq!(Heading::of("x_nm").name(), "x");
        assert_eq!(Heading::of("lateral_mV").written_unit(), Some("mV"));
        // A boundary of no character.
        assert!(!Heading::of("a_per_bµµµ_per_c_nm").name().is_empty());
        assert_eq!(Heading::of("t (s)").name(), "t");
    }

    #[test]
    fn rows_and_lines_of_units_are_known() {
        let row = |fields: &[&str]| units_of_row(fields);
        assert_eq!(row(&["nm", "nm"]).unwrap(), ["nm", "nm"]);
        assert_eq!(row(&["(Å)", "[V]"]).unwrap(), ["Å", "V"]);
        assert_eq!(row(&["m", "m"]).unwrap(), ["m", "m"]);
        assert_eq!(row(&["µm", ""]).unwrap(), ["µm", ""]);
        for names in [&["x", "z"][..], &["v", "N"], &["V", "N"], &["x (nm)", "z (nm)"], &["", ""]] {
            assert_eq!(row(names), None, "{names:?}");
        }
        assert_eq!(units_of_line("units: m m", 2), [(0, "m".into()), (1, "m".into())]);
        assert_eq!(units_of_line("XUnits = µm", 2), [(0, "µm".into())]);
        assert_eq!(units_of_line("Y_Unit_Label\tnm", 2), [(1, "nm".into())]);
        assert_eq!(units_of_line("scan rate: 1 Hz", 2), []);
    }

    #[test]
    fn two_units_of_a_column_are_refused() {
        assert!(Heading::of("x_nm").with_unit("um").is_err());
        assert!(Heading::of("x_um").with_unit("µm").is_ok());
        assert_eq!(
            Heading::of("x").with_unit("nm").unwrap().unit(Unit::Length).unwrap().unwrap().0,
            "nm"
        );
    }
}
