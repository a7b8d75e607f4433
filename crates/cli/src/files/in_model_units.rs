//! Columns whose headings have units nm, s or nN, converted to the model's units.

use super::heading::Heading;
use stickslip::{Dimension, KnownScales};
use stickslip_units::Unit;

/// The unit of the model of a column by its name; `None` if it has no dimension.
fn meant(name: &str) -> Option<&'static str> {
    Some(match name {
        "x" | "y" | "R" | "start" | "length" => "σ",
        "u" => "kσ²/a",
        "t" => "Γ/k",
        "force" => "kσ",
        _ => return None,
    })
}

/// The quantity that a unit of the model measures, and the number of nm, s or nN in its SI unit.
pub(crate) fn measured_in(unit: &str) -> (Unit, f64) {
    const NANO: f64 = 1e9;
    match unit {
        "Γ/k" => (Unit::Time, 1.0),
        "k/Γ" => (Unit::Rate, 1.0),
        "Γ²/k" => (Unit::Mass, 1.0),
        "kσ" | "nN" => (Unit::Force, NANO),
        "kσ/Γ" | "k²σ²/(aΓ)" => (Unit::Velocity, NANO),
        _ => (Unit::Length, NANO),
    }
}

/// The columns called `names`; those with a unit in their heading are divided by the scales.
pub(super) fn in_model_units(
    columns: &mut [Vec<f64>],
    names: &str,
    headings: &[Heading],
    scales: Option<&KnownScales>,
) -> Result<(), String> {
    for ((column, name), heading) in columns.iter_mut().zip(names.split(',')).zip(headings) {
        let Some(multiple) = meant(name) else { continue };
        let (unit, per_si) = measured_in(multiple);
        let Some((_, one)) = heading.unit(unit)? else { continue };
        let factor = Dimension::of_unit(multiple).and_then(|of| of.factor(scales?));
        let factor = factor.ok_or_else(|| {
            format!(
                "the heading `{}` has a unit, but {multiple} is not known in it: give --units, or --sigma and \
                 the other scales; or the column in {multiple}, without a unit in its heading",
                heading.text()
            )
        })?;
        let factor = factor / (one * per_si);
        column.iter_mut().for_each(|value| *value /= factor);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCALES: KnownScales = KnownScales {
        length: Some(30e-9),
        time: Some(0.02),
        height: Some(18e-9),
        force: Some(6e-9),
    };

    fn converted(names: &str, headings: [&str; 2], scales: Option<&KnownScales>) -> Vec<Vec<f64>> {
        let mut columns = vec![vec![1.0, 60.0], vec![1.0, 36.0]];
        in_model_units(&mut columns, names, &headings.map(Heading::of), scales).unwrap();
        columns
    }

    #[test]
    fn units_of_headings_are_turned_into_the_models() {
        let close = |found: &[f64], wanted: f64| (found[1] / wanted - 1.0).abs() < 1e-14;
        let found = converted("x,u", ["x_nm", "u (um)"], Some(&SCALES));
        assert!(close(&found[0], 2.0) && close(&found[1], 2000.0), "{found:?}");
        let found = converted("t,force", ["t_ms", "force_nN"], Some(&SCALES));
        assert!(close(&found[0], 3.0) && close(&found[1], 6.0), "{found:?}");
        // No unit, or nothing that is one: as it is.
        for headings in [["x", "u"], ["x_0", "u_1"], ["", ""]] {
            assert_eq!(converted("x,u", headings, Some(&SCALES)), [[1.0, 60.0], [1.0, 36.0]]);
        }
    }

    #[test]
    fn a_unit_of_something_else_is_refused() {
        for headings in [["x (ms)", "u"], ["x", "u (V)"], ["x", "u (foo)"]] {
            let mut columns = vec![vec![1.0], vec![1.0]];
            let headings = headings.map(Heading::of);
            assert!(in_model_units(&mut columns, "x,u", &headings, Some(&SCALES)).is_err());
        }
    }

    #[test]
    fn a_unit_without_a_scale_is_refused() {
        let length = KnownScales { height: None, ..SCALES };
        for scales in [None, Some(&length)] {
            let mut columns = vec![vec![1.0], vec![1.0]];
            let headings = ["x_nm", "u_nm"].map(Heading::of);
            let refused = in_model_units(&mut columns, "x,u", &headings, scales).unwrap_err();
            assert!(refused.contains("--sigma"), "{refused}");
        }
    }
}
