//! From the model's options to a model.

use crate::arguments::{ModelArguments, TipName};
use crate::failure::Failure;
use crate::files::input::{TipFile, read_tip};
use stickslip_tip::{Gaussian, Model, ModelError, TipFunction, stability};

/// The model that the options ask for.
pub(crate) fn model(arguments: &ModelArguments) -> Result<Model, Failure> {
    let tip = tip(arguments)?;
    let alpha = alpha(arguments, &tip)?;
    Model::new(tip, alpha, arguments.r).map_err(|error| match error {
        ModelError::R(r) => Failure::input(format!("--r {r}"), error),
        ModelError::Alpha(_) => match (arguments.alpha, arguments.alpha_above) {
            (_, Some(above)) => Failure::input(format!("--alpha-above {above}"), error),
            _ => Failure::input(format!("--alpha {alpha}"), error),
        },
    })
}

/// The footprint that the options ask for.
pub(crate) fn tip(arguments: &ModelArguments) -> Result<TipFunction, Failure> {
    let ModelArguments { tip, beta, width, tip_file, .. } = arguments;
    let unused = |option: String, with: &str| {
        Failure::input(option, format!("has no meaning with {with}: leave one of them out"))
    };
    if let Some(path) = tip_file {
        let named = format!("--tip-file {}", path.display());
        if tip.is_some() || beta.is_some() || width.is_some() {
            return Err(unused(named, "--tip, --beta or --width"));
        }
        return from_file(read_tip(path)?).map_err(|error| Failure::input(named, error));
    }
    let name = tip.unwrap_or(TipName::TripleGaussian);
    if let Some(beta) = beta.filter(|_| name != TipName::TripleGaussian) {
        return Err(unused(format!("--beta {beta}"), "a tip without side lobes"));
    }
    if let Some(width) = width.filter(|_| name == TipName::Bessel) {
        return Err(unused(format!("--width {width}"), "--tip bessel"));
    }
    let (b, w) = (beta.unwrap_or(1.0), width.unwrap_or(1.0));
    if !(w.is_finite() && w > 0.0) {
        return Err(Failure::input(format!("--width {w}"), "must be a finite number above 0"));
    }
    match name {
        TipName::Bessel => Ok(TipFunction::Bessel),
        TipName::Gaussian => {
            TipFunction::gaussian(w).map_err(|error| Failure::input(format!("--width {w}"), error))
        }
        TipName::TripleGaussian => TipFunction::triple_gaussian(b, w)
            .map_err(|error| Failure::input(format!("--beta {b}"), error)),
    }
}

fn from_file(file: TipFile) -> Result<TipFunction, stickslip_tip::TipFunctionError> {
    match file {
        TipFile::Table((x, f)) => TipFunction::table(&x, &f),
        TipFile::Gaussians(entries) => TipFunction::gaussian_sum(
            entries
                .iter()
                .map(|g| Gaussian { amplitude: g.amplitude, center: g.center, width: g.width })
                .collect(),
        ),
    }
}

fn alpha(arguments: &ModelArguments, tip: &TipFunction) -> Result<f64, Failure> {
    match (arguments.alpha, arguments.alpha_above) {
        (Some(alpha), None) => Ok(alpha),
        (None, Some(above)) => {
            // A bad r is reported as such when the model is made.
            if !(arguments.r.is_finite() && arguments.r > 0.0) {
                return Ok(0.0);
            }
            let critical = stability::critical(tip, arguments.r).map_err(|error| {
                let advice = "give --alpha instead";
                Failure::input(format!("--alpha-above {above}"), format!("{error}; {advice}"))
            })?;
            Ok(critical.alpha + above)
        }
        (Some(_), Some(_)) => {
            Err(Failure::input("--alpha and --alpha-above", "give one of them, not both"))
        }
        (None, None) => Err(Failure::input(
            "--alpha",
            "the indentation rate is missing: give --alpha A, or --alpha-above D for αc(r) + D",
        )),
    }
}
