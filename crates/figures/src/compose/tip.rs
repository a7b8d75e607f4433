//! Names of tips and models in titles.

use super::quantity::Quantity;
use crate::number::{seven_digits, short};
use stickslip::{
    Gaussian, Law, ModelParameters, PathName, Raster, RunDocument, TipDocument, to_its_digits,
};
use stickslip_tip::sorting::sort_by_number;

/// Largest difference of numbers that count as equal.
const SAME: f64 = 1e-9;

/// A name such as "β = 1" for the triple Gaussian (48) of width 1.
pub(crate) fn tip_name(tip: &TipDocument) -> String {
    match tip {
        TipDocument::Bessel {} => "f = J₀(x)".into(),
        TipDocument::Cosine {} => "f = cos x".into(),
        TipDocument::Footprint { .. } => "f(x, y) of a file".into(),
        TipDocument::Gaussians { gaussians } => gaussians_name(gaussians),
    }
}

/// Tip, α and r.
pub(crate) fn model_name(model: &ModelParameters) -> String {
    let [alpha, r] = [model.alpha, model.r].map(seven_digits);
    let dragged = if model.law.no_spring { ", no spring".into() } else { format!(", r = {r}") };
    format!("{}, α = {alpha}{dragged}{}", tip_name(&model.tip), terms_name(&model.law))
}

/// Model and motion of a run.
pub(crate) fn run_title(run: &RunDocument) -> String {
    let name = model_name(&run.parameters.model_parameters());
    let motion = run.oscillation.as_ref().map_or(String::new(), |o| {
        let rounded = || seven_digits(format!("{:.4e}", o.period).parse().unwrap_or(o.period));
        let period = o.period_error.map_or_else(rounded, |error| to_its_digits(o.period, error));
        let quantity = Quantity { value: o.period, error: o.period_error, unit: "Γ/k" };
        format!(", T = {}", quantity.in_text(&period))
    });
    let swing = run.snaking.as_ref().map_or(String::new(), |swing| {
        let (value, error) = (swing.period, Some(swing.period_error));
        let period = to_its_digits(swing.period, swing.period_error);
        format!(", T = {}", Quantity { value, error, unit: "Γ/k" }.in_text(&period))
    });
    let stiffness = stiffness_name(run.parameters.stiffness_across);
    format!("{name}{stiffness}: {}{motion}{swing}", run.regime)
}

/// The stiffness across the scan, such as ", κ_y = 2"; empty for a tip that is held on its line.
pub(crate) fn stiffness_name(stiffness: Option<f64>) -> String {
    stiffness.map_or(String::new(), |stiffness| format!(", κ_y = {}", short(stiffness)))
}

/// Model and path of a raster.
pub(crate) fn raster_title(parameters: &Raster) -> String {
    let stiffness = stiffness_name(parameters.stiffness_across);
    format!("{}{stiffness}, {}", model_name(&parameters.model_parameters()), path_name(parameters))
}

fn path_name(parameters: &Raster) -> String {
    let pitch = parameters.pitch.map_or(String::new(), |pitch| {
        format!(", pitch {}", Quantity::new(pitch, "σ").in_text(&format!("{} σ", short(pitch))))
    });
    let path = match parameters.path {
        PathName::OneWay => "one-way",
        PathName::Zigzag => "zigzag",
        PathName::Repeat => "one line repeated",
    };
    let shape = parameters.area.as_ref().map_or("", |_| ", area from a file");
    format!("{path}{pitch}{shape}")
}

/// Tip and extensions of the basic model, which are the same at every α and r.
pub(crate) fn law_name(model: &ModelParameters) -> String {
    tip_name(&model.tip) + &terms_name(&model.law)
}

/// The terms of the extended model, such as ", b = 3, T_h = 50".
pub(crate) fn terms_name(law: &Law) -> String {
    let wider = [
        ("b", law.depth_limit, "kσ²/a"),
        ("T_h", law.healing_time, "Γ/k"),
        ("M", law.inertia, "Γ²/k"),
    ];
    let there = wider.into_iter().filter_map(|(name, value, unit)| Some((name, value?, unit)));
    let said = |(name, value, unit): (&str, f64, &'static str)| {
        format!(", {name} = {}", Quantity::new(value, unit).in_text(&seven_digits(value)))
    };
    there.map(said).collect()
}

fn gaussians_name(gaussians: &[Gaussian]) -> String {
    if let Some((beta, width)) = triple(gaussians) {
        return with_width(&format!("β = {}", short(beta)), width);
    }
    match gaussians {
        [g] if is(g.amplitude, 1.0) && is(g.center, 0.0) => {
            if is(g.width, std::f64::consts::FRAC_1_SQRT_2) {
                return "f = exp(−x²)".into();
            }
            with_width("f = exp(−x²/2)", g.width)
        }
        // A table is made of many.
        many if many.len() > 9 => "f of a table".into(),
        some => {
            // As `stickslip tip` counts them: a pair on either side of the middle as one.
            let count = some.iter().filter(|g| g.center >= 0.0).count();
            format!("f = sum of {count} Gaussian{}", if count == 1 { "" } else { "s" })
        }
    }
}

fn with_width(name: &str, width: f64) -> String {
    if is(width, 1.0) { name.into() } else { format!("{name}, width {}", short(width)) }
}

fn is(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * b.abs().max(1.0)
}

/// β and the width of a triple Gaussian (48), exp(-x²/2w²) - β exp(-(x ± 2w)²/2w²)…; `None` for any other sum.
fn triple(gaussians: &[Gaussian]) -> Option<(f64, f64)> {
    let [a, b, c] = gaussians else { return None };
    let mut all = [a, b, c];
    sort_by_number(&mut all, |item| item.center);
    let [left, middle, right] = all;
    let width = middle.width;
    let alike = is(left.amplitude, right.amplitude)
        && is(left.width, width)
        && is(right.width, width)
        && is(left.center, -right.center)
        && is(middle.center, 0.0)
        && is(middle.amplitude, 1.0);
    let model = stickslip_tip::TipFunction::triple_gaussian(1.0, width).ok()?;
    let stickslip_tip::TipFunction::Gaussians(sum) = &model else { return None };
    let lobe = sum.terms().iter().find(|g| g.center > 0.0)?;
    (alike && is(right.center, lobe.center)).then(|| (right.amplitude / lobe.amplitude, width))
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_tip::{Gaussian, TipFunction};

    fn name(tip: &TipFunction) -> String {
        tip_name(&tip.into())
    }

    #[test]
    fn tips_are_called_what_the_command_line_calls_them() {
        for (beta, width, said) in
            [(1.0, 1.0, "β = 1"), (0.5, 1.0, "β = 0.5"), (0.3, 2.0, "β = 0.3, width 2")]
        {
            assert_eq!(name(&TipFunction::triple_gaussian(beta, width).unwrap()), said);
        }
        assert_eq!(name(&TipFunction::gaussian(1.0).unwrap()), "f = exp(−x²/2)");
        let narrow = std::f64::consts::FRAC_1_SQRT_2;
        assert_eq!(name(&TipFunction::gaussian(narrow).unwrap()), "f = exp(−x²)");
        assert_eq!(name(&TipFunction::Bessel), "f = J₀(x)");
        let lobe = |amplitude, center| Gaussian { amplitude, center, width: 0.7 };
        let sum = vec![lobe(1.0, 0.0), lobe(0.3, -1.5), lobe(0.3, 1.5)];
        assert_eq!(name(&TipFunction::gaussian_sum(sum).unwrap()), "f = sum of 2 Gaussians");
    }
}
