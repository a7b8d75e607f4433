//! Quantities in their usual notation: a number, a prefix and a unit.

use crate::UnitsError;

/// Units of the quantities that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// kg/s, or N·s/m
    Damping,
    /// N/m
    Stiffness,
    /// m
    Length,
    /// m/s
    Velocity,
    /// N
    Force,
    /// s
    Time,
    /// kg
    Mass,
    /// 1/s
    Rate,
    /// V
    Voltage,
}

impl std::fmt::Display for Unit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.notation().0[0])
    }
}

impl Unit {
    /// Spellings, the first of them for messages, and an example.
    fn notation(self) -> (&'static [&'static str], &'static str) {
        match self {
            Self::Damping => (&["kg/s", "Ns/m", "N s/m", "N*s/m", "N·s/m"], "20ug/s or 1e-8kg/s"),
            Self::Stiffness => (&["N/m"], "0.5N/m"),
            Self::Length => (&["m"], "30nm"),
            Self::Velocity => (&["m/s"], "1um/s"),
            Self::Force => (&["N"], "10nN"),
            Self::Time => (&["s"], "5ms"),
            Self::Mass => (&["kg"], "20pg"),
            Self::Rate => (&["1/s", "/s", "rad/s"], "50/s"),
            Self::Voltage => (&["V"], "50mV"),
        }
    }

    pub(crate) fn example(self) -> &'static str {
        self.notation().1
    }

    /// The value in SI units of a number with this unit and prefixes, such as `50nm`, `0.5 N/m`,
    /// `1um/s`, `3µm/s` or `2mN/mm`.
    ///
    /// # Errors
    /// [`UnitsError::Bare`] for a number without a unit; [`UnitsError::Syntax`].
    pub fn parse(self, text: &str) -> Result<f64, UnitsError> {
        let error = || UnitsError::Syntax { text: text.to_owned(), unit: self };
        let trimmed = text.trim();
        let (number, suffix) = number_and_suffix(trimmed).ok_or_else(error)?;
        if suffix.is_empty() {
            return Err(UnitsError::Bare { text: text.to_owned(), unit: self });
        }
        self.one(suffix).map(|one| number * one).filter(|v| v.is_finite()).ok_or_else(error)
    }

    /// The value in SI units of 1 `unit`, in the notation of people and instruments: `nm`, `µm`, `Å`,
    /// `nanometers`, `nN`, `um/s`. `None` if `unit` is not a unit of this quantity.
    #[must_use]
    pub fn one(self, unit: &str) -> Option<f64> {
        let unit = unit.trim();
        let spelt = self.notation().0.iter().find_map(|spelling| scale_of(unit, spelling));
        spelt.or_else(|| self.in_words(&unit.to_lowercase()))
    }

    /// The value of a unit written in words, in small letters, or of the ångström.
    fn in_words(self, unit: &str) -> Option<f64> {
        const ANGSTROM: [&str; 7] =
            ["å", "a\u{30a}", "angstrom", "angstroms", "ångström", "ångstrom", "ångströms"];
        let bases: &[&str] = match self {
            Self::Length if ANGSTROM.contains(&unit) => return Some(1e-10),
            Self::Length if ["micron", "microns"].contains(&unit) => return Some(1e-6),
            Self::Length => &["meter", "meters", "metre", "metres"],
            Self::Force => &["newton", "newtons"],
            Self::Time => &["second", "seconds", "sec"],
            Self::Voltage => &["volt", "volts"],
            Self::Damping | Self::Stiffness | Self::Velocity | Self::Mass | Self::Rate => &[],
        };
        bases.iter().find_map(|base| match unit.strip_suffix(base)? {
            "" => Some(1.0),
            "femto" => Some(1e-15),
            "pico" => Some(1e-12),
            "nano" => Some(1e-9),
            "micro" => Some(1e-6),
            "milli" => Some(1e-3),
            "centi" => Some(1e-2),
            "kilo" => Some(1e3),
            _ => None,
        })
    }
}

/// The longest prefix of `text` that is a finite number, and the rest.
fn number_and_suffix(text: &str) -> Option<(f64, &str)> {
    let plain = |c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | 'e' | 'E');
    let end = text.find(|c| !plain(c)).unwrap_or(text.len());
    (1..=end).rev().find_map(|end| {
        let number: f64 = text[..end].parse().ok()?;
        number.is_finite().then(|| (number, text[end..].trim_start()))
    })
}

/// The factor from `suffix` to `unit`; SI prefixes are allowed before the numerator, and before the denominator if
/// there is one.
fn scale_of(suffix: &str, unit: &str) -> Option<f64> {
    match (suffix.split_once('/'), unit.split_once('/')) {
        (Some((above, below)), Some((unit_above, unit_below))) => {
            Some(prefixed(above.trim(), unit_above)? / prefixed(below.trim(), unit_below)?)
        }
        (None, None) => prefixed(suffix, unit),
        _ => None,
    }
}

/// The factor of an SI prefix before `unit`. Grams are taken as 1e-3 kg.
fn prefixed(text: &str, unit: &str) -> Option<f64> {
    if unit == "kg" {
        return Some(prefixed(text, "g")? * 1e-3);
    }
    // The prefix of a product is that of its first factor, and of a second, that of the unit.
    match text.strip_suffix(unit)? {
        "" => Some(1.0),
        "f" => Some(1e-15),
        "p" => Some(1e-12),
        "n" => Some(1e-9),
        "u" | "µ" | "μ" => Some(1e-6),
        "m" => Some(1e-3),
        "c" => Some(1e-2),
        "k" => Some(1e3),
        "M" => Some(1e6),
        "G" => Some(1e9),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, wanted: f64) {
        assert!((found - wanted).abs() <= 1e-14 * wanted.abs(), "{found} for {wanted}");
    }

    #[test]
    fn quantities_are_read_with_prefixes() {
        let read = [
            (Unit::Length, "50nm", 50e-9),
            (Unit::Length, " 0.05 µm ", 50e-9),
            (Unit::Length, "5e-8m", 50e-9),
            (Unit::Length, "500 Å", 50e-9),
            (Unit::Length, "500\u{212b}", 50e-9),
            (Unit::Length, "50 nanometers", 50e-9),
            (Unit::Stiffness, "0.5N/m", 0.5),
            (Unit::Stiffness, "0.5 nN/nm", 0.5),
            (Unit::Stiffness, "500mN/m", 0.5),
            (Unit::Velocity, "1um/s", 1e-6),
            (Unit::Velocity, "2mm/ms", 2.0),
            (Unit::Force, "10nN", 1e-8),
            (Unit::Force, "-3pN", -3e-12),
            (Unit::Time, "16ms", 0.016),
            (Unit::Damping, "20ug/s", 2e-8),
            (Unit::Damping, "1e-8kg/s", 1e-8),
            (Unit::Damping, "1uNs/m", 1e-6),
            (Unit::Damping, "1 mN s/m", 1e-3),
            (Unit::Mass, "20pg", 2e-14),
            (Unit::Rate, "50/s", 50.0),
            (Unit::Rate, "2 rad/ms", 2e3),
        ];
        for (unit, text, wanted) in read {
            close(unit.parse(text).unwrap(), wanted);
        }
    }

    #[test]
    fn what_is_no_quantity_is_refused() {
        for text in ["", "nm", "50 apples", "50N", "50nm/s", "1e999m", "NaN m", "inf", "50 A"] {
            assert!(Unit::Length.parse(text).is_err(), "{text}");
        }
        // 30 may be meant in nm: that it was taken for 30 m in silence has cost a result.
        for text in ["30", "5e-8", " 1 ", "-2", "0"] {
            assert!(matches!(Unit::Length.parse(text), Err(UnitsError::Bare { .. })), "{text}");
        }
        let message = Unit::Length.parse("50 apples").unwrap_err().to_string();
        assert!(message.contains("50 apples") && message.contains("30nm"), "{message}");
    }
}
