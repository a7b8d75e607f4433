//! All six quantities from those given.

use crate::Refused;
use stickslip_units::Physical;

/// A quantity: name, symbol, and its exponents in r (12) and α (13).
pub(super) struct Quantity {
    pub(super) name: &'static str,
    pub(super) symbol: &'static str,
    in_r: i32,
    in_alpha: i32,
}

const fn quantity(
    name: &'static str,
    symbol: &'static str,
    (in_r, in_alpha): (i32, i32),
) -> Quantity {
    Quantity { name, symbol, in_r, in_alpha }
}

/// The quantities, in the order of [`Given::values`].
pub(super) const QUANTITIES: [Quantity; 6] = [
    quantity("damping", "Γ", (1, 1)),
    quantity("stiffness", "k", (-1, -2)),
    quantity("tip_width", "σ", (-1, -2)),
    quantity("indentation_rate", "N", (0, 1)),
    quantity("slope_force", "a", (0, 1)),
    quantity("velocity", "v0", (1, 0)),
];
pub(super) const INDENTATION_RATE: usize = 3;

/// The parameter named where all quantities together are invalid.
pub(super) const QUANTITIES_TOGETHER: &str =
    "damping and stiffness and tip_width and indentation_rate and slope_force and velocity";

pub(super) fn is_allowed(index: usize, value: f64) -> bool {
    value.is_finite() && (value > 0.0 || (index == INDENTATION_RATE && value >= 0.0))
}

/// The quantities in SI units, and the dimensionless numbers given instead of some of them.
#[derive(Debug)]
pub(super) struct Given {
    pub(super) values: [Option<f64>; 6],
    pub(super) alpha: Option<f64>,
    pub(super) r: Option<f64>,
}

impl Given {
    /// Checks that as many quantities are missing as dimensionless numbers are given.
    pub(super) fn judge_number(&self) -> Result<(), Refused> {
        let missing = self.missing();
        let given = usize::from(self.r.is_some()) + usize::from(self.alpha.is_some());
        if missing.len() == given {
            return Ok(());
        }
        let (names, said) = match (self.alpha, self.r) {
            (Some(_), Some(_)) => ("alpha and r", "{alpha} and {r}"),
            (Some(_), None) => ("alpha", "{alpha}"),
            (None, Some(_)) => ("r", "{r}"),
            (None, None) => ("", ""),
        };
        if missing.len() > given {
            let advice = match given {
                0 => "give all six quantities, or {alpha} or {r} instead of one of them".into(),
                _ => format!("{said} can replace {given} of them: give the others"),
            };
            return Err(Refused::whole(self.names(), format!("missing: {advice}")));
        }
        let advice = format!("leave out {given} of the six quantities, to be solved for");
        Err(Refused::whole(names, advice))
    }

    /// The names of the missing quantities.
    fn names(&self) -> String {
        let names: Vec<&str> = self.missing().iter().map(|i| QUANTITIES[*i].name).collect();
        names.join(" and ")
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
    pub(super) fn solved(&self) -> Result<Physical, Refused> {
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

    fn physical(&self, values: [Option<f64>; 6]) -> Result<Physical, Refused> {
        let usable = |(i, v): (usize, &Option<f64>)| v.is_some_and(|v| is_allowed(i, v));
        if !values.iter().enumerate().all(usable) {
            let why = "do not follow from the given ones by r = Γ v0/(kσ) and α = Γ N a/(σ² k²); leave out others";
            return Err(Refused::whole(self.names(), why));
        }
        let [damping, stiffness, tip_width, indentation_rate, slope_force, velocity] =
            values.map(|value| value.unwrap_or(f64::NAN));
        let physical =
            Physical { damping, stiffness, tip_width, indentation_rate, slope_force, velocity };
        physical.validated().map_err(|error| Refused::whole(QUANTITIES_TOGETHER, error))
    }
}

/// base^(numerator/denominator): exactly base or 1 if that is the result, `None` for a denominator of 0.
fn power(base: f64, denominator: i32, numerator: i32) -> Option<f64> {
    (denominator != 0).then(|| base.powf(f64::from(numerator) / f64::from(denominator)))
}
