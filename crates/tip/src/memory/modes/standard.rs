//! Exponentials of the footprints that commands take by default: found once, for they cost more than most runs.
//!
//! They are those that [`Fit::reaching_back`](super::Fit::reaching_back) finds, to the last bit.

mod table;

use super::certificate::FitCertificate;
use super::term::Term;
use crate::elementary::{log10, pow};
use crate::tip_function::{Gaussian, TipFunction};
use num_complex::Complex;

/// The fit to any of the accuracies from 10^(-from/4) to 10^(-to/4), for a small retreat.
struct Standard {
    quarters: (u32, u32),
    /// Errors of the slope and of the curvature, and the area of the first.
    certificate: [f64; 3],
    /// Re s, Im s, Re w, Im w.
    terms: &'static [[f64; 4]],
}

const fn gaussian(amplitude: f64, center: f64) -> Gaussian {
    Gaussian { amplitude, center, width: 1.0 }
}
/// (48) with β = 1, and β = 0, both of width 1.
const TRIPLE_GAUSSIAN: [Gaussian; 3] =
    [gaussian(1.0, 0.0), gaussian(-0.5, -2.0), gaussian(-0.5, 2.0)];
const GAUSSIAN: [Gaussian; 1] = [gaussian(1.0, 0.0)];

/// The terms, if they are known: of these footprints, to a whole quarter of a decade.
pub(super) fn known(tip: &TipFunction, wanted: f64) -> Option<(Vec<Term>, FitCertificate)> {
    let TipFunction::Gaussians(sum) = tip else { return None };
    let table: &[Standard] = match sum.terms() {
        terms if terms == TRIPLE_GAUSSIAN => &table::TRIPLE_GAUSSIAN,
        terms if terms == GAUSSIAN => &table::GAUSSIAN,
        _ => return None,
    };
    let exact = |quarters: &u32| accuracy(*quarters).to_bits() == wanted.to_bits();
    let quarters = nearest_quarter(wanted).filter(exact)?;
    let found = table.iter().find(|fit| (fit.quarters.0..=fit.quarters.1).contains(&quarters))?;
    let term = |[s, si, w, wi]: &[f64; 4]| Term {
        exponent: Complex::new(*s, *si),
        weight: Complex::new(*w, *wi),
    };
    let [slope, curvature, area] = found.certificate;
    let terms = found.terms.iter().map(term).collect();
    Some((terms, FitCertificate { slope, curvature, area }))
}

/// 10^(-quarters/4), as [`accuracy_needed`](super::accuracy_needed) has it.
fn accuracy(quarters: u32) -> f64 {
    pow(10.0, -f64::from(quarters) / 4.0)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within range")]
fn nearest_quarter(wanted: f64) -> Option<u32> {
    let quarters = (-4.0 * log10(wanted)).round();
    (1.0..100.0).contains(&quarters).then_some(quarters as u32)
}

#[cfg(test)]
mod tests {
    use super::super::{Fit, Retreat};
    use super::*;
    use std::fmt::Write;

    /// What is tabulated: from 1e-3 to where these footprints are no longer fitted.
    const QUARTERS: std::ops::RangeInclusive<u32> = 12..=58;

    fn tips() -> [(&'static str, TipFunction); 2] {
        let tip = |beta| TipFunction::triple_gaussian(beta, 1.0).unwrap();
        [("TRIPLE_GAUSSIAN", tip(1.0)), ("GAUSSIAN", tip(0.0))]
    }

    /// The table is what the algorithm finds today, character by character. Where the algorithm changes, the message
    /// names the file to put in its place.
    #[test]
    fn the_table_is_what_is_found() {
        let head = include_str!("standard/table.rs").split("\n\n").next().unwrap();
        let mut text = format!("{head}\n\nuse super::Standard;\n");
        for (name, tip) in tips() {
            text += &tabulated(name, &tip);
        }
        if text != include_str!("standard/table.rs") {
            let file = std::env::temp_dir().join("table.rs");
            std::fs::write(&file, text).unwrap();
            panic!("standard/table.rs is not what is found: that is in {}", file.display());
        }
    }

    fn tabulated(name: &str, tip: &TipFunction) -> String {
        let found = |quarters| Some((quarters, Fit::new(tip, accuracy(quarters)).ok()?));
        let fits: Vec<(u32, Fit)> = QUARTERS.filter_map(found).collect();
        let alike: Vec<_> = fits.chunk_by(|a, b| a.1.terms() == b.1.terms()).collect();
        let mut text = String::new();
        writeln!(
            text,
            "\n#[rustfmt::skip]\npub(super) static {name}: [Standard; {}] = [",
            alike.len()
        )
        .unwrap();
        for alike in alike {
            let (from, to) = (alike[0].0, alike[alike.len() - 1].0);
            let (fit, certificate) = (&alike[0].1, alike[0].1.certificate());
            let FitCertificate { slope, curvature, area } = certificate;
            writeln!(text, "    Standard {{ quarters: ({from}, {to}), terms: &[").unwrap();
            for Term { exponent: s, weight: w } in fit.terms() {
                writeln!(text, "        [{:?}, {:?}, {:?}, {:?}],", s.re, s.im, w.re, w.im)
                    .unwrap();
            }
            writeln!(text, "    ], certificate: [{slope:?}, {curvature:?}, {area:?}] }},").unwrap();
        }
        text + "];\n"
    }

    #[test]
    fn a_fit_from_the_table_is_the_one_found_and_others_are_not_in_it() {
        for (_, tip) in tips() {
            for quarters in [24, 40, 44, 48] {
                let (wanted, back) = (accuracy(quarters), Retreat::Small);
                let found = Fit::reaching_back(&tip, wanted, back).unwrap();
                assert_eq!(*Fit::cached(&tip, wanted, back).unwrap(), found);
                assert!(known(&tip, wanted).is_some() && known(&tip, 1.001 * wanted).is_none());
            }
        }
        for other in [TipFunction::gaussian(1.1), TipFunction::triple_gaussian(0.9, 1.0)] {
            assert!(known(&other.unwrap(), accuracy(40)).is_none());
        }
        for wanted in [0.0, -1.0, f64::NAN, f64::INFINITY, 1.0] {
            assert!(known(&tips()[0].1, wanted).is_none());
        }
    }
}
