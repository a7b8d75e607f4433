//! Exponentials for the default footprints of the commands, stored because fitting them takes longer than most runs.
//!
//! They equal the results of [`Fit::new`](super::Fit::new) to the last bit.

use super::certificate::FitCertificate;
use super::term::Term;
use crate::elementary::{log10, pow};
use crate::tip_function::{Gaussian, TipFunction};
use num_complex::Complex;

/// A sum and its certificate; the first lines of the file say what is where.
type Sum = (&'static str, [u32; 2], [f64; 3], &'static [[f64; 4]]);

#[expect(clippy::unreadable_literal, reason = "written by a test")]
static TABLE: &[Sum] = include!("standard/table.rs");

const fn gaussian(amplitude: f64, center: f64) -> Gaussian {
    Gaussian { amplitude, center, width: 1.0 }
}
/// (48) with β = 1, and β = 0, both of width 1.
const TRIPLE_GAUSSIAN: [Gaussian; 3] =
    [gaussian(1.0, 0.0), gaussian(-0.5, -2.0), gaussian(-0.5, 2.0)];
const GAUSSIAN: [Gaussian; 1] = [gaussian(1.0, 0.0)];

/// The stored terms; `None` for another footprint, or an accuracy that is not a quarter of a decade in the table.
pub(super) fn known(tip: &TipFunction, wanted: f64) -> Option<(Vec<Term>, FitCertificate)> {
    let TipFunction::Gaussians(sum) = tip else { return None };
    let name = match sum.terms() {
        terms if terms == TRIPLE_GAUSSIAN => "triple-gaussian",
        terms if terms == GAUSSIAN => "gaussian",
        _ => return None,
    };
    let exact = |quarters: &u32| accuracy(*quarters).to_bits() == wanted.to_bits();
    let quarters = nearest_quarter(wanted).filter(exact)?;
    let is_wanted = |(footprint, [from, to], ..): &&Sum| {
        *footprint == name && (*from..=*to).contains(&quarters)
    };
    let (_, _, [slope, curvature, area], terms) = *TABLE.iter().find(is_wanted)?;
    let term = |[s, si, w, wi]: &[f64; 4]| Term {
        exponent: Complex::new(*s, *si),
        weight: Complex::new(*w, *wi),
    };
    Some((terms.iter().map(term).collect(), FitCertificate { slope, curvature, area }))
}

/// 10^(-quarters/4), computed as in [`accuracy_needed`](super::accuracy_needed).
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
        [("triple-gaussian", tip(1.0)), ("gaussian", tip(0.0))]
    }

    /// The table is what the algorithm finds today, character by character. Where the algorithm changes, the message
    /// names the file to put in its place.
    #[test]
    fn the_table_is_what_is_found() {
        const WRITTEN: &str = include_str!("standard/table.rs");
        let (head, _) = WRITTEN.split_once("&[").unwrap();
        let mut text = format!("{head}&[\n");
        for (name, tip) in tips() {
            text += &tabulated(name, &tip);
        }
        text += "]\n";
        if text != WRITTEN {
            let file = std::env::temp_dir().join("table.rs");
            std::fs::write(&file, text).unwrap();
            panic!("standard/table.rs is not what is found: that is in {}", file.display());
        }
    }

    fn tabulated(name: &str, tip: &TipFunction) -> String {
        let found =
            |quarters| Some((quarters, Fit::new(tip, accuracy(quarters), Retreat::Small).ok()?));
        let fits: Vec<(u32, Fit)> = QUARTERS.filter_map(found).collect();
        let mut text = String::new();
        for alike in fits.chunk_by(|a, b| a.1.terms() == b.1.terms()) {
            let (from, to) = (alike[0].0, alike[alike.len() - 1].0);
            let (fit, certificate) = (&alike[0].1, alike[0].1.certificate());
            let FitCertificate { slope, curvature, area } = certificate;
            let errors = [slope, curvature, area];
            writeln!(text, "(\"{name}\", [{from}, {to}], {errors:?}, &[").unwrap();
            for Term { exponent: s, weight: w } in fit.terms() {
                writeln!(text, "{:?},", [s.re, s.im, w.re, w.im]).unwrap();
            }
            text += "]),\n";
        }
        text
    }

    #[test]
    fn a_fit_from_the_table_is_the_one_found_and_others_are_not_in_it() {
        for (_, tip) in tips() {
            for quarters in [24, 40, 44, 48] {
                let (wanted, back) = (accuracy(quarters), Retreat::Small);
                let found = Fit::new(&tip, wanted, back).unwrap();
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
