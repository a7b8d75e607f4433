//! Dimensions: the units of which a dimensionless number is a multiple.

use super::KnownScales;

/// Number of nanometres in a metre, and of nanonewtons in a newton.
const NANO: f64 = 1e9;

/// Exponents of σ, Γ/k, kσ²/a and kσ, the model's units of length, time, height and force. Heights are lengths with
/// their own unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dimension {
    length: i32,
    time: i32,
    height: i32,
    force: i32,
}

const fn of(length: i32, time: i32, height: i32, force: i32) -> Dimension {
    Dimension { length, time, height, force }
}

impl Dimension {
    pub(super) const LENGTH: Self = of(1, 0, 0, 0);
    pub(super) const TIME: Self = of(0, 1, 0, 0);
    pub(super) const HEIGHT: Self = of(0, 0, 1, 0);
    pub(crate) const FORCE: Self = of(0, 0, 0, 1);
    pub(super) const VELOCITY: Self = of(1, -1, 0, 0);
    pub(super) const RATE: Self = of(0, -1, 0, 0);
    pub(super) const WAVE_NUMBER: Self = of(-1, 0, 0, 0);
    pub(super) const AREA: Self = of(2, 0, 0, 0);
    pub(super) const WORK: Self = of(1, 0, 0, 1);
    pub(super) const VOLUME: Self = of(2, 0, 1, 0);
    pub(super) const LYAPUNOV: Self = of(-2, -1, 0, 0);
    /// Dimension of inertia: Γ²/k = (kσ) (Γ/k)²/σ.
    pub(super) const INERTIA: Self = of(-1, 2, 0, 1);
    /// Dimension of the indentation rate: N is α in units of (kσ²/a)/(Γ/k).
    pub(super) const INDENTATION: Self = of(0, -1, 1, 0);

    /// The dimension of a unit as written in labels and descriptions, such as `kσ²/a`.
    pub fn of_unit(unit: &str) -> Option<Self> {
        Some(match unit {
            "σ" => Self::LENGTH,
            "Γ/k" => Self::TIME,
            "kσ²/a" => Self::HEIGHT,
            "kσ" => Self::FORCE,
            "kσ/Γ" => Self::VELOCITY,
            "k/Γ" => Self::RATE,
            "1/σ" => Self::WAVE_NUMBER,
            "σ²" => Self::AREA,
            "σ⁻²" => of(-2, 0, 0, 0),
            "kσ²" => Self::WORK,
            "kσ⁴/a" => Self::VOLUME,
            "k/(Γσ²)" => Self::LYAPUNOV,
            "Γ²/k" => Self::INERTIA,
            "k²σ²/(aΓ)" => Self::INDENTATION,
            _ => return None,
        })
    }

    /// The model's unit of this dimension in nm, s and nN; `None` if a scale that it needs is unknown.
    pub fn factor(self, scales: &KnownScales) -> Option<f64> {
        let KnownScales { length, time, height, force } = *scales;
        let parts = [
            (self.length, length.map(|metres| metres * NANO)),
            (self.time, time),
            (self.height, height.map(|metres| metres * NANO)),
            (self.force, force.map(|newtons| newtons * NANO)),
        ];
        let factor = parts.into_iter().filter(|(power, _)| *power != 0);
        let factor = factor.map(|(power, scale)| scale.map(|scale| scale.powi(power)));
        factor.product::<Option<f64>>().filter(|factor| factor.is_finite() && *factor > 0.0)
    }

    /// Exponents of nm, s and nN.
    fn powers(self) -> [(&'static str, i32); 3] {
        [("nN", self.force), ("nm", self.length + self.height), ("s", self.time)]
    }

    /// A quantity in nm, s and nN as a number of the model; `None` if a scale that it needs is unknown.
    ///
    /// Ratios of decimals such as 40 nm/(20 nm) may miss the exact decimal by a few units of the last place. Within
    /// four units the number of 15 digits is returned: a quantity has the same bits as the dimensionless number.
    pub fn number(self, quantity: f64, scales: &KnownScales) -> Option<f64> {
        Some(Self::rounded(quantity / self.factor(scales)?))
    }

    /// The number of 15 digits within four units of the last place, or else the number itself.
    pub fn rounded(number: f64) -> f64 {
        let typed: f64 = format!("{number:.14e}").parse().unwrap_or(number);
        let is_same = (typed - number).abs() <= 4.0 * f64::EPSILON * number.abs();
        if is_same { typed } else { number }
    }

    /// The suffix of names of numbers with this dimension, such as `nm_per_s`.
    pub fn suffix(self) -> String {
        let written = |(unit, power): (&str, i32)| match power.abs() {
            1 => unit.to_owned(),
            power => format!("{unit}{power}"),
        };
        let above = self.powers().into_iter().filter(|(_, power)| *power > 0).map(written);
        let below = self.powers().into_iter().filter(|(_, power)| *power < 0).map(written);
        let below = below.map(|unit| format!("per_{unit}"));
        above.chain(below).collect::<Vec<_>>().join("_")
    }

    /// The unit in its usual notation, such as `nm/s`.
    pub fn unit(self) -> String {
        let written = |(unit, power): (&str, i32)| match power.abs() {
            1 => unit.to_owned(),
            2 => format!("{unit}²"),
            3 => format!("{unit}³"),
            power => format!("{unit}^{power}"),
        };
        let part = |sign: i32| {
            let powers = self.powers().into_iter().filter(|(_, power)| power * sign > 0);
            powers.map(written).collect::<Vec<_>>()
        };
        let (above, below) = (part(1).join(" "), part(-1));
        let above = if above.is_empty() { "1".to_owned() } else { above };
        match below.len() {
            0 => above,
            1 => format!("{above}/{}", below[0]),
            _ => format!("{above}/({})", below.join(" ")),
        }
    }
}
