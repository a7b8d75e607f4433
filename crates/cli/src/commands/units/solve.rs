//! All six quantities from those given.

use crate::arguments::{ModelArguments, UnitsArguments};
use crate::failure::{Failure, Typed};
use crate::files::input::{TipFile, read_tip};
use stickslip::UnitsParameters;
use stickslip_stability as stability;
use stickslip_tip::{TipFunction, Wider};
use stickslip_units::{Physical, Unit};

/// A quantity: option, symbol, unit, and its exponents in r (12) and α (13).
struct Quantity {
    option: &'static str,
    symbol: &'static str,
    unit: Unit,
    in_r: i32,
    in_alpha: i32,
}

const fn quantity(
    option: &'static str,
    symbol: &'static str,
    unit: Unit,
    (in_r, in_alpha): (i32, i32),
) -> Quantity {
    Quantity { option, symbol, unit, in_r, in_alpha }
}

/// The quantities, in the order of [`Given::values`].
const QUANTITIES: [Quantity; 6] = [
    quantity("--damping", "Γ", Unit::Damping, (1, 1)),
    quantity("--stiffness", "k", Unit::Stiffness, (-1, -2)),
    quantity("--tip-width", "σ", Unit::Length, (-1, -2)),
    quantity("--indentation-rate", "N", Unit::Velocity, (0, 1)),
    quantity("--slope-force", "a", Unit::Force, (0, 1)),
    quantity("--velocity", "v0", Unit::Velocity, (1, 0)),
];
const TIP_WIDTH: usize = 2;
const INDENTATION_RATE: usize = 3;

/// The values of the options, in SI units.
#[derive(Debug)]
pub(super) struct Given {
    values: [Option<f64>; 6],
    alpha: Option<f64>,
    r: Option<f64>,
}

impl Given {
    pub(super) fn read(arguments: &UnitsArguments, tip: &TipFunction) -> Result<Self, Failure> {
        let texts = [
            &arguments.damping,
            &arguments.stiffness,
            &arguments.tip_width,
            &arguments.indentation_rate,
            &arguments.slope_force,
            &arguments.velocity,
        ];
        let mut values = [None; 6];
        for (i, (quantity, text)) in QUANTITIES.iter().zip(texts).enumerate() {
            values[i] = text.as_deref().map(|text| read(quantity, text, i)).transpose()?;
        }
        // A measured tip brings its σ along, unless α and r are to tell another.
        let alone = arguments.tip_width.is_none() && arguments.model.tip.tip_file.is_some();
        let missing = values.iter().filter(|value| value.is_none()).count();
        let numbers = usize::from(arguments.model.r.is_some())
            + usize::from(arguments.model.alpha.or(arguments.model.alpha_above).is_some());
        let of_file = if alone && missing > numbers { sigma_of(arguments)? } else { None };
        values[TIP_WIDTH] = values[TIP_WIDTH].or(of_file);
        let r = arguments.model.r;
        if let Some(r) = r.filter(|r| !(r.is_finite() && *r > 0.0)) {
            let message = "the dimensionless support velocity must be a finite number above 0";
            return Err(Failure::input(format!("--r {}", Typed(r)), message));
        }
        let given = Self { values, alpha: alpha(&arguments.model, tip, r)?, r };
        given.judge_number()?;
        Ok(given)
    }

    /// Checks that as many quantities are missing as dimensionless numbers are given.
    fn judge_number(&self) -> Result<(), Failure> {
        let missing = self.missing();
        let given = usize::from(self.r.is_some()) + usize::from(self.alpha.is_some());
        if missing.len() == given {
            return Ok(());
        }
        let numbers = match (self.alpha, self.r) {
            (Some(_), Some(_)) => "--alpha and --r",
            (Some(_), None) => "--alpha",
            (None, Some(_)) => "--r",
            (None, None) => "",
        };
        if missing.len() > given {
            let names: Vec<&str> = missing.iter().map(|i| QUANTITIES[*i].option).collect();
            let advice = match given {
                0 => "give all six quantities, or --alpha or --r instead of one of them".into(),
                _ => format!("{numbers} can replace {given} of them: give the others"),
            };
            return Err(Failure::input(names.join(", "), format!("missing: {advice}")));
        }
        let advice = format!("leave out {given} of the six quantities, to be solved for");
        Err(Failure::input(numbers, advice))
    }

    fn missing(&self) -> Vec<usize> {
        (0..6).filter(|i| self.values[*i].is_none()).collect()
    }

    /// r and α with 1 for the missing quantities.
    fn of_the_known(&self) -> (f64, f64) {
        let product = |power: fn(&Quantity) -> i32| {
            let factor =
                |(q, value): (&Quantity, &Option<f64>)| value.unwrap_or(1.0).powi(power(q));
            QUANTITIES.iter().zip(&self.values).map(factor).product::<f64>()
        };
        (product(|q| q.in_r), product(|q| q.in_alpha))
    }

    /// All quantities; the missing ones follow from r and α.
    pub(super) fn solved(&self) -> Result<Physical, Failure> {
        let (known_r, known_alpha) = self.of_the_known();
        let r = self.r.map(|r| r / known_r);
        let alpha = self.alpha.map(|alpha| alpha / known_alpha);
        let mut values = self.values;
        match (self.missing().as_slice(), r, alpha) {
            (&[i], Some(r), _) => values[i] = power(r, QUANTITIES[i].in_r, 1),
            (&[i], None, Some(alpha)) => values[i] = power(alpha, QUANTITIES[i].in_alpha, 1),
            (&[i, j], Some(r), Some(alpha)) => {
                let (a, b) = (&QUANTITIES[i], &QUANTITIES[j]);
                // r = a^p b^q, α = a^s b^t.
                let determinant = a.in_r * b.in_alpha - b.in_r * a.in_alpha;
                let solve = |in_alpha: i32, in_r: i32| {
                    let (from_r, from_alpha) =
                        (power(r, determinant, in_alpha)?, power(alpha, determinant, -in_r)?);
                    Some(from_r * from_alpha)
                };
                values[i] = solve(b.in_alpha, b.in_r);
                values[j] = solve(-a.in_alpha, -a.in_r);
            }
            _ => {}
        }
        self.physical(values)
    }

    fn physical(&self, values: [Option<f64>; 6]) -> Result<Physical, Failure> {
        let names: Vec<&str> = self.missing().iter().map(|i| QUANTITIES[*i].option).collect();
        let usable = |(i, v): (usize, &Option<f64>)| {
            v.is_some_and(|v| v.is_finite() && (v > 0.0 || (i == INDENTATION_RATE && v >= 0.0)))
        };
        if !values.iter().enumerate().all(usable) {
            let message = "do not follow from the given ones by r = Γ v0/(kσ) and α = Γ N a/(σ² k²); leave out others";
            return Err(Failure::input(names.join(", "), message));
        }
        let [damping, stiffness, tip_width, indentation_rate, slope_force, velocity] =
            values.map(|value| value.unwrap_or(f64::NAN));
        let physical =
            Physical { damping, stiffness, tip_width, indentation_rate, slope_force, velocity };
        physical.validated().map_err(|error| Failure::input("the quantities", error))
    }

    pub(super) fn parameters(
        &self,
        tip: &TipFunction,
        alpha_above: Option<f64>,
    ) -> UnitsParameters {
        let [damping, stiffness, tip_width, indentation_rate, slope_force, velocity] = self.values;
        UnitsParameters {
            tip: tip.into(),
            damping,
            stiffness,
            tip_width,
            indentation_rate,
            slope_force,
            velocity,
            alpha: self.alpha,
            alpha_above,
            r: self.r,
        }
    }
}

/// base^(numerator/denominator): exactly base or 1 if that is the result, `None` for a denominator of 0.
fn power(base: f64, denominator: i32, numerator: i32) -> Option<f64> {
    (denominator != 0).then(|| base.powf(f64::from(numerator) / f64::from(denominator)))
}

/// σ in m from a tip file that `stickslip tip` wrote for a profile with a unit.
fn sigma_of(arguments: &UnitsArguments) -> Result<Option<f64>, Failure> {
    let Some(path) = &arguments.model.tip.tip_file else { return Ok(None) };
    match read_tip(path)? {
        TipFile::Measured(measured) => Ok(measured.sigma_metres),
        _ => Ok(None),
    }
}

fn read(quantity: &Quantity, text: &str, index: usize) -> Result<f64, Failure> {
    let named = || format!("{} {text}", quantity.option);
    let value = quantity.unit.parse(text).map_err(|error| Failure::input(named(), error))?;
    let allowed = value > 0.0 || (index == INDENTATION_RATE && value >= 0.0);
    if allowed {
        return Ok(value);
    }
    let least = if index == INDENTATION_RATE { "0 or above" } else { "above 0" };
    Err(Failure::input(named(), format!("{} must be {least}", quantity.symbol)))
}

fn alpha(
    arguments: &ModelArguments,
    tip: &TipFunction,
    r: Option<f64>,
) -> Result<Option<f64>, Failure> {
    match (arguments.alpha, arguments.alpha_above) {
        (Some(_), Some(_)) => {
            Err(Failure::input("--alpha and --alpha-above", "give one of them, not both"))
        }
        (None, Some(above)) => {
            let named = format!("--alpha-above {}", Typed(above));
            let r = r.ok_or_else(|| {
                Failure::input(&named, "αc is a function of r: give --r R, or --alpha A instead")
            })?;
            let critical = stability::critical(&Wider::default(), tip, r).map_err(|error| {
                Failure::input(&named, format!("{error}; give --alpha instead"))
            })?;
            judged(critical.alpha + above, named).map(Some)
        }
        (Some(alpha), None) => judged(alpha, format!("--alpha {}", Typed(alpha))).map(Some),
        (None, None) => Ok(None),
    }
}

fn judged(alpha: f64, named: String) -> Result<f64, Failure> {
    if alpha.is_finite() && alpha >= 0.0 {
        return Ok(alpha);
    }
    Err(Failure::input(named, "α must be a finite number, 0 or above"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [f64; 6] = [2e-3, 0.07, 30e-9, 150e-9, 4e-9, 3e-6];

    fn physical(values: [f64; 6]) -> Physical {
        let [damping, stiffness, tip_width, indentation_rate, slope_force, velocity] = values;
        Physical { damping, stiffness, tip_width, indentation_rate, slope_force, velocity }
    }

    /// Every pair of quantities that r and α determine is recovered, and every other pair is rejected.
    #[test]
    fn what_is_left_out_comes_back() {
        let (r, alpha) = (physical(ALL).r(), physical(ALL).alpha());
        let mut solvable = 0;
        for i in 0..6 {
            for j in i + 1..6 {
                let mut values = ALL.map(Some);
                (values[i], values[j]) = (None, None);
                let given = Given { values, alpha: Some(alpha), r: Some(r) };
                let Ok(found) = given.solved() else { continue };
                solvable += 1;
                let wanted = physical(ALL);
                assert!((found.r() / r - 1.0).abs() < 1e-13, "{i} {j}");
                assert!((found.alpha() / alpha - 1.0).abs() < 1e-13, "{i} {j}");
                assert!((found.velocity / wanted.velocity - 1.0).abs() < 1e-12, "{i} {j}");
                assert!((found.damping / wanted.damping - 1.0).abs() < 1e-12, "{i} {j}");
            }
        }
        // k with σ, and N with a, enter as products only.
        assert_eq!(solvable, 15 - 2);
    }

    #[test]
    fn a_single_quantity_comes_back_from_either_number() {
        let (r, alpha) = (physical(ALL).r(), physical(ALL).alpha());
        for i in 0..6 {
            let mut values = ALL.map(Some);
            values[i] = None;
            let from_alpha = Given { values, alpha: Some(alpha), r: None }.solved();
            assert_eq!(from_alpha.is_ok(), QUANTITIES[i].in_alpha != 0);
            let from_r = Given { values, alpha: None, r: Some(r) }.solved();
            assert_eq!(from_r.is_ok(), QUANTITIES[i].in_r != 0);
            for found in [from_alpha, from_r].into_iter().flatten() {
                assert!((found.alpha() / alpha - 1.0).abs() < 1e-13);
                assert!((found.r() / r - 1.0).abs() < 1e-13);
            }
        }
    }
}
