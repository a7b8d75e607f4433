//! Colour scales for heights, suitable for colour-blind readers and for print.

use crate::style::Colour;
use stickslip::ColoursName;

/// The colour at a position on the scale, 0 to 1.
pub(crate) fn at(colours: ColoursName, part: f64) -> Colour {
    let part = part.clamp(0.0, 1.0);
    let of = |gradient: colorous::Gradient, part| {
        let colour = gradient.eval_continuous(part);
        [colour.r, colour.g, colour.b]
    };
    match colours {
        ColoursName::Grey => [(255.0 * part).round() as u8; 3],
        ColoursName::Cividis => of(colorous::CIVIDIS, part),
        // The library's is red first.
        ColoursName::BlueRed => of(colorous::RED_BLUE, 1.0 - part),
    }
}

/// The colour in SVG notation.
pub(crate) fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_and_the_middle_are_what_they_are_called() {
        let lightness = |c: [u8; 3]| c.iter().map(|c| u32::from(*c)).sum::<u32>();
        assert_eq!(at(ColoursName::Grey, 0.0), [0; 3]);
        assert!(
            lightness(at(ColoursName::Cividis, 0.0)) < lightness(at(ColoursName::Cividis, 1.0))
        );
        let [below, zero, above] = [0.0, 0.5, 1.0].map(|part| at(ColoursName::BlueRed, part));
        assert!(below[2] > below[0] && above[0] > above[2] && zero.iter().all(|c| *c > 230));
    }
}
