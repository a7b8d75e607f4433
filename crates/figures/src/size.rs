//! Size of a figure.

use crate::error::FigureError;

/// Units per millimetre: a unit is half a point, 1/144 inch.
const UNITS: f64 = 144.0 / 25.4;
/// Default width of a figure, in units.
const DEFAULT: f64 = 900.0;
/// Smallest width of a figure, in units; narrower axes have no space for labels.
const NARROWEST: f64 = 280.0;
const WIDEST: f64 = 20_000.0;
/// Pixels per unit at the default resolution, 288 per inch.
#[cfg(feature = "png")]
const DENSITY: f64 = 2.0;
const DOTS: (f64, f64) = (10.0, 10_000.0);

/// Width of a figure, in the unit of the request.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Width {
    /// Width on paper. Letters have 7 to 9 points for any width.
    Millimetres(f64),
    /// Width on a screen, and of a PNG at any resolution. Letters are 14 to 18 pixels high.
    Pixels(f64),
}

/// Width and resolution.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Size {
    width: Option<Width>,
    dots_per_inch: Option<f64>,
}

impl std::str::FromStr for Width {
    type Err = FigureError;

    /// Parses a width such as `85mm` or `600px`.
    fn from_str(text: &str) -> Result<Self, FigureError> {
        let lower = text.trim().to_ascii_lowercase();
        let number = |digits: &str| digits.trim().parse::<f64>().ok().filter(|w| w.is_finite());
        let width = if let Some(digits) = lower.strip_suffix("mm") {
            number(digits).map(Self::Millimetres)
        } else {
            lower.strip_suffix("px").and_then(number).map(Self::Pixels)
        };
        width
            .filter(|width| (NARROWEST..=WIDEST).contains(&width.units()))
            .ok_or_else(|| FigureError::Width(NARROWEST / UNITS, WIDEST / UNITS, NARROWEST, WIDEST))
    }
}

impl Width {
    fn units(self) -> f64 {
        match self {
            Self::Millimetres(mm) => mm * UNITS,
            Self::Pixels(px) => px,
        }
    }
}

impl Size {
    /// A size with this width, by default 900 px, and this resolution of a PNG in pixels per inch.
    ///
    /// # Errors
    ///
    /// The resolution is out of range.
    pub fn new(width: Option<Width>, dots_per_inch: Option<f64>) -> Result<Self, FigureError> {
        match dots_per_inch {
            Some(dots) if !(DOTS.0..=DOTS.1).contains(&dots) => {
                Err(FigureError::Resolution(DOTS.0, DOTS.1))
            }
            _ => Ok(Self { width, dots_per_inch }),
        }
    }

    /// Width in units.
    pub(crate) fn units(&self) -> f64 {
        self.width.map_or(DEFAULT, Width::units)
    }

    /// Width and height as written in the SVG.
    pub(crate) fn written(&self, height: f64) -> (String, String) {
        let number = crate::svg::number;
        match self.width {
            Some(Width::Millimetres(mm)) => {
                (format!("{}mm", number(mm)), format!("{}mm", number(height / UNITS)))
            }
            _ => (number(self.units()), number(height)),
        }
    }

    /// Pixels of a PNG per unit and per inch. A width in pixels is that of the PNG; the resolution then determines
    /// its size on paper.
    #[cfg(feature = "png")]
    pub(crate) fn pixels(&self) -> (f64, f64) {
        let per_inch = 144.0;
        match (self.width, self.dots_per_inch) {
            (Some(Width::Pixels(_)), dots) => (1.0, dots.unwrap_or(per_inch)),
            (_, Some(dots)) => (dots / per_inch, dots),
            (_, None) => (DENSITY, DENSITY * per_inch),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_in_millimetres_or_pixels() {
        assert_eq!("85mm".parse::<Width>().unwrap(), Width::Millimetres(85.0));
        assert_eq!(" 600 PX".parse::<Width>().unwrap(), Width::Pixels(600.0));
        for text in ["", "85", "mm", "-5mm", "1e9px", "nanpx", "3in"] {
            let message = text.parse::<Width>().unwrap_err().to_string();
            assert!(message.contains("85mm"), "{text}: {message}");
        }
    }

    #[cfg(feature = "png")]
    #[test]
    fn pixels_follow_from_millimetres_and_resolution() {
        let of = |width: Option<&str>, dots| {
            let size = Size::new(width.map(|w| w.parse().unwrap()), dots).unwrap();
            let (density, per_inch) = size.pixels();
            ((size.units() * density).round(), per_inch)
        };
        assert_eq!(of(None, None), (1800.0, 288.0));
        assert_eq!(of(Some("127mm"), Some(300.0)), (1500.0, 300.0));
        assert_eq!(of(Some("640px"), None), (640.0, 144.0));
        assert!(Size::new(None, Some(0.0)).is_err() && Size::new(None, Some(f64::NAN)).is_err());
    }
}
