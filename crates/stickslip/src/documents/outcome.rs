//! The regime at the end of a run, as stored in documents.

use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_outcome::{Oscillation, Prospect, Regime, Snaking};
use stickslip_surface::Ripple;

/// Regimes of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RegimeName {
    /// l stays at l0, in agreement with linear theory; without a spring, the tip stays at rest.
    Steady,
    /// A periodic motion.
    StickSlip,
    /// The tip creeps logarithmically in its own pit and never slips.
    Trapped,
    /// A tip without a spring moves at a constant velocity.
    Drifting,
    /// The tip oscillates periodically across the scan, and therefore along it.
    Snaking,
    /// The motion has not settled.
    Transient,
}

impl From<Regime> for RegimeName {
    fn from(regime: Regime) -> Self {
        match regime {
            Regime::Steady => Self::Steady,
            Regime::StickSlip => Self::StickSlip,
            Regime::Trapped => Self::Trapped,
            Regime::Drifting => Self::Drifting,
            Regime::Transient => Self::Transient,
        }
    }
}

/// The word in documents.
impl std::fmt::Display for RegimeName {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.serialize(out)
    }
}

/// The periodic motion at the end of the run. Amplitudes are half peak-to-peak. Period, wavelength and amplitudes of
/// the settled motion lie within the errors.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OscillationDocument {
    /// Period T, in Γ/k.
    pub period: f64,
    /// Error of the period, in Γ/k.
    #[serde(default)]
    pub period_error: Option<f64>,
    /// r times the period, in σ.
    pub wavelength: f64,
    /// Error of the wavelength, in σ.
    #[serde(default)]
    pub wavelength_error: Option<f64>,
    /// Half peak-to-peak of l (the oscillation of x0 about its steady advance), in σ.
    pub amplitude_x0: f64,
    /// Error of `amplitude_x0`, in σ.
    #[serde(default)]
    pub amplitude_x0_error: Option<f64>,
    /// Half peak-to-peak of the surface far behind the tip, (35), in kσ²/a; on a healing surface, of U(x) in u = U
    /// e^{-D/(r T_h)}, with the healing time T_h and the distance D behind the support. Null if less than one
    /// wavelength lies out of reach of the tip, or if f does not decay.
    pub amplitude_u: Option<f64>,
    /// Error of `amplitude_u`, in kσ²/a; null if `amplitude_u` is.
    #[serde(default)]
    pub amplitude_u_error: Option<f64>,
    /// Number of maxima of l in one period.
    pub slips: usize,
    /// Largest change of a maximum of l from one period to the next, over the amplitude.
    pub drift: f64,
}

impl OscillationDocument {
    /// The periodic motion, with the ripple behind the tip if it could be computed.
    pub fn of(motion: &Oscillation, ripple: Option<Ripple>) -> Self {
        let amplitude_u = ripple.map(|ripple| ripple.amplitude);
        Self {
            period: motion.period,
            period_error: Some(motion.period_error),
            wavelength: motion.wavelength,
            wavelength_error: Some(motion.wavelength_error),
            amplitude_x0: motion.amplitude_x0,
            amplitude_x0_error: Some(motion.amplitude_x0_error),
            amplitude_u,
            amplitude_u_error: amplitude_u.map(|u| motion.amplitude_u_error(u)),
            slips: motion.slips,
            drift: motion.drift,
        }
    }
}

/// The periodic motion of a tip that oscillates across the scan. Amplitudes are half peak-to-peak. Period and amplitudes of the
/// settled motion lie within the errors, provided that changes from period to period decay geometrically.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SwingDocument {
    /// Period of y0, in Γ/k; the motion along the scan has half this period.
    pub period: f64,
    /// Error of the period, in Γ/k.
    pub period_error: f64,
    /// r times the period, in σ.
    pub wavelength: f64,
    /// Error of the wavelength, in σ.
    pub wavelength_error: f64,
    /// Half peak-to-peak of y0, in σ.
    pub amplitude_y0: f64,
    /// Error of `amplitude_y0`, in σ.
    pub amplitude_y0_error: f64,
    /// Half peak-to-peak of R - x0, in σ.
    pub amplitude_x0: f64,
    /// Error of `amplitude_x0`, in σ.
    #[serde(default)]
    pub amplitude_x0_error: Option<f64>,
    /// Change of the largest y0 in the last period, over the amplitude.
    pub drift: f64,
}

impl SwingDocument {
    /// The document of a motion behind a support of velocity r.
    pub(crate) fn of(motion: &Snaking, r: f64) -> Self {
        Self {
            period: motion.period,
            period_error: motion.period_error,
            wavelength: r * motion.period,
            wavelength_error: r * motion.period_error,
            amplitude_y0: motion.amplitude,
            amplitude_y0_error: motion.amplitude_error,
            amplitude_x0: motion.amplitude_along,
            amplitude_x0_error: Some(motion.amplitude_along_error),
            drift: motion.drift,
        }
    }
}

/// Prediction for a run that has not settled.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TransientDocument {
    /// The predicted regime; null if there is no prediction.
    pub towards: Option<RegimeName>,
    /// Predicted time until the motion has settled, in Γ/k; null if there is no prediction.
    pub time: Option<f64>,
}

impl From<Prospect> for TransientDocument {
    fn from(Prospect { towards, time }: Prospect) -> Self {
        Self { towards: towards.map(Into::into), time }
    }
}

/// Number of significant digits of a double, minus one.
const DIGITS: i32 = 14;
/// Powers of ten that are written without an exponent.
const PLAIN: std::ops::Range<i32> = -5..15;

/// A value rounded to its certain digits, with the error of the last one in parentheses: 6.6936889(2). Very small and
/// very large values have an exponent: 2.5(3)e-12.
///
/// ```
/// use stickslip::to_its_digits;
///
/// assert_eq!(to_its_digits(6.693_688_892, 1.3e-7), "6.6936889(2)");
/// assert_eq!(to_its_digits(0.196, 0.0099), "0.20(2)");
/// assert_eq!(to_its_digits(1234.5, 30.0), "1230(40)");
/// assert_eq!(to_its_digits(2.0, 0.0), "2.00000000000000(1)");
/// assert_eq!(to_its_digits(2.5e-12, 2e-13), "2.5(3)e-12");
/// assert_eq!(to_its_digits(0.0, 0.0), "0");
/// ```
pub fn to_its_digits(value: f64, error: f64) -> String {
    let size = value.abs().max(error.abs());
    if !(value.is_finite() && error.is_finite()) {
        return format!("{value:e}(?)");
    }
    if size <= 0.0 {
        return "0".into();
    }
    let exponent = place(size);
    if PLAIN.contains(&exponent) {
        return plainly(value, error.abs());
    }
    // In two steps: of the smallest numbers the power itself would overflow.
    let half = exponent / 2;
    let scaled = |number: f64| number * 10_f64.powi(-half) * 10_f64.powi(half - exponent);
    format!("{}e{exponent}", plainly(scaled(value), scaled(error.abs())))
}

/// The power of ten of the first digit.
#[expect(clippy::cast_possible_truncation, reason = "an exponent of ten")]
fn place(size: f64) -> i32 {
    size.abs().max(f64::MIN_POSITIVE).log10().floor() as i32
}

fn plainly(value: f64, error: f64) -> String {
    let mut last = place(error).max(place(value) - DIGITS);
    // Rounding takes half a unit of the last digit besides.
    let off_by = |last: i32| (error / 10_f64.powi(last) + 0.5).ceil();
    if off_by(last) >= 10.0 {
        last += 1;
    }
    let off = off_by(last);
    if last >= 0 {
        let unit = 10_f64.powi(last);
        return format!("{:.0}({:.0})", (value / unit).round() * unit, off * unit);
    }
    format!("{value:.*}({off:.0})", last.unsigned_abs() as usize)
}

/// A value with `count` significant digits, without trailing zeros.
///
/// ```
/// use stickslip::digits;
///
/// let cases = [(1.0690361749, 7), (0.0, 7), (2e-9, 3), (1234567.0, 7), (-0.5, 3), (1e300, 4)];
/// let shown = cases.map(|(value, count)| digits(value, count));
/// assert_eq!(shown, ["1.069036", "0", "2e-9", "1234567", "-0.5", "1e300"]);
/// ```
pub fn digits(value: f64, count: usize) -> String {
    let exponent = if value.abs() > 0.0 { place(value) } else { 0 };
    if !value.is_finite() || !PLAIN.contains(&exponent) {
        let mantissa = format!("{value:.*e}", count - 1);
        let Some((number, exponent)) = mantissa.split_once('e') else { return mantissa };
        return format!("{}e{exponent}", without_zeros(number));
    }
    let decimals = i64::try_from(count).unwrap_or(0) - 1 - i64::from(exponent);
    let decimals = usize::try_from(decimals).unwrap_or(0);
    without_zeros(&format!("{value:.decimals$}")).into()
}

fn without_zeros(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}
