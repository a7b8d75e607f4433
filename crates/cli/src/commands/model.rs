//! From the options of a footprint to a footprint.

use super::summary::quoted;
use crate::arguments::{Length, TipArguments};
use crate::failure::Failure;
use crate::files::input::{GaussianEntry, TipFile, read_tip};
use crate::session::Session;
use std::path::Path;
use stickslip::{NamedTip, judge_details};
use stickslip_measurement::{Verdict, judge};
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::{Footprint, Gaussian, Gaussian2d, TipFunction};

/// The footprint in the options.
pub(crate) fn tip(session: &Session, arguments: &TipArguments) -> Result<TipFunction, Failure> {
    tip_and_draws(session, arguments).map(|(tip, _)| tip)
}

/// The footprint, and for a measured one the terms of those drawn within its error.
pub(crate) fn tip_and_draws(
    session: &Session,
    arguments: &TipArguments,
) -> Result<(TipFunction, Vec<Vec<Gaussian>>), Failure> {
    let TipArguments { tip, beta, width, tip_file, retrace } = arguments;
    let unused = |option: String, with: &str| {
        Failure::input(option, format!("has no meaning with {with}: leave one of them out"))
    };
    if let Some(path) = tip_file {
        if tip.is_some() || beta.is_some() || width.is_some() {
            let option = format!("--tip-file {}", path.display());
            return Err(unused(option, "--tip, --beta or --width"));
        }
        let mut file = read_tip(session, path)?;
        let draws = match &mut file {
            TipFile::Measured(measured) => std::mem::take(&mut measured.draws),
            _ => vec![],
        };
        let table = match &file {
            TipFile::Table(table) => Some(table.clone()),
            TipFile::Table2d(columns) => Some(on_path(columns)),
            _ => None,
        };
        let tip = from_file(file).map_err(|message| Failure::file("--tip-file", path, message))?;
        if *retrace && tip.is_even() {
            let message = "has no effect on a tip with two equal sides: leave it out";
            return Err(Failure::input("--retrace", message));
        }
        let tip = if *retrace { tip.mirrored() } else { tip };
        if let Some((x, f)) = table {
            judge_table(session, path, (&x, &f), &tip)?;
        }
        return Ok((tip, draws));
    }
    let width = match width {
        Some(Length::Metres(_)) => {
            let message = "is a factor here, f(x/W) with x in σ: give a number without a unit";
            return Err(Failure::input("--width", message));
        }
        Some(Length::Bare(width)) => Some(*width),
        None => None,
    };
    Ok((NamedTip { name: *tip, beta: *beta, width }.tip()?, vec![]))
}

/// The rows of f(x,y) on the path of the tip with x ≥ 0, by ascending x.
fn on_path([x, y, f]: &[Vec<f64>; 3]) -> (Vec<f64>, Vec<f64>) {
    let nearest = y.iter().fold(f64::INFINITY, |least: f64, y| least.min(y.abs()));
    let rows = x.iter().zip(y).zip(f).filter(|((x, y), _)| **x >= 0.0 && y.abs() <= nearest);
    let mut rows: Vec<(f64, f64)> = rows.map(|((x, _), f)| (*x, *f)).collect();
    sort_by_number(&mut rows, |item| item.0);
    rows.dedup_by_key(|row| row.0.to_bits());
    rows.into_iter().unzip()
}

/// The footprint in a file.
pub(crate) fn from_file(file: TipFile) -> Result<TipFunction, String> {
    let tip = match file {
        TipFile::Table((x, f)) => TipFunction::table(&x, &f),
        TipFile::Table2d([x, y, f]) => Footprint::table(&x, &y, &f).map(TipFunction::of_footprint),
        TipFile::Measured(measured) if measured.image.is_some() && measured.sides.is_some() => {
            let why = "it has an f(x,y) with equal sides, and sides that differ of f(x): run `stickslip tip` without \
                       --both-sides for the former; print sides.footprint for the latter, with --width-y";
            return Err(why.into());
        }
        TipFile::Measured(measured) if measured.image.is_some() => {
            let widths = measured.image.iter().flat_map(|image| &image.widths);
            let terms = measured.gaussians.iter().zip(widths).map(|(g, width_y)| Gaussian2d {
                amplitude: g.amplitude,
                center: g.center,
                width: g.width,
                center_y: 0.0,
                width_y: *width_y,
            });
            let terms: Vec<Gaussian2d> = terms.collect();
            if terms.len() < measured.gaussians.len() {
                return Err("image: a width is missing".into());
            }
            Footprint::gaussian_sum(&terms).map(TipFunction::of_footprint)
        }
        TipFile::Measured(measured) => {
            let sides = measured.sides.as_ref().and_then(|sides| sides.footprint.as_ref());
            let gaussians = sides.map_or(&measured.gaussians, |sides| &sides.gaussians);
            TipFunction::asymmetric_sum(gaussians.clone())
        }
        TipFile::Gaussians(entries) if entries.iter().any(is_2d) => {
            let terms: Option<Vec<Gaussian2d>> = entries.iter().map(gaussian_2d).collect();
            let terms =
                terms.ok_or("width_y is given for some Gaussians: give it for all of them")?;
            Footprint::gaussian_sum(&terms).map(TipFunction::of_footprint)
        }
        TipFile::Gaussians(entries) => TipFunction::asymmetric_sum(
            entries
                .iter()
                .map(|g| Gaussian { amplitude: g.amplitude, center: g.center, width: g.width })
                .collect(),
        ),
    };
    let tip = tip.map_err(|error| error.to_string())?;
    judge_details(&tip).map_err(|error| error.to_string())?;
    Ok(tip)
}

fn is_2d(entry: &GaussianEntry) -> bool {
    entry.width_y.is_some() || entry.center_y.is_some()
}

/// A Gaussian in x and y, by default centred on the path; `None` without a width in y.
fn gaussian_2d(entry: &GaussianEntry) -> Option<Gaussian2d> {
    let GaussianEntry { amplitude, center, width, .. } = *entry;
    let center_y = entry.center_y.unwrap_or(0.0);
    entry.width_y.map(|width_y| Gaussian2d { amplitude, center, width, center_y, width_y })
}

/// Rejects a table whose result depends on noise, and warns if noise has an effect or if that is unknown.
fn judge_table(
    session: &Session,
    path: &Path,
    (x, f): (&[f64], &[f64]),
    tip: &TipFunction,
) -> Result<(), Failure> {
    let option = format!("--tip-file {}", path.display());
    let advice = match tip.footprint() {
        Some(_) => "fit it: `stickslip tip IMAGE.gsf -o tip.json` with the original image, then --tip-file tip.json".into(),
        None => format!(
            "fit it: `stickslip tip {} --half --sigma 1σ -o tip.json`, then --tip-file tip.json",
            quoted(path.display().to_string())
        ),
    };
    match judge((x, f), tip) {
        Verdict::Sound => Ok(()),
        Verdict::Few { rows } => {
            session.say(format_args!(
                "stickslip: {option}: {rows} rows are too few to distinguish noise from shape: 2 % of noise can halve alpha_c"
            ));
            Ok(())
        }
        Verdict::Felt { change } => {
            session.say(format_args!(
                "stickslip: {option}: its noise may change alpha_c by {:.0} % (r = 1); {advice}",
                100.0 * change
            ));
            Ok(())
        }
        Verdict::Decided { table, fitted } => {
            let instead =
                fitted.map(|fitted| format!(" where a sum of few Gaussians has {fitted:.4}"));
            let message = format!(
                "the noise dominates: alpha_c = {table:.4} at r = 1{}; {advice}",
                instead.unwrap_or_default()
            );
            Err(Failure::input(option, message))
        }
    }
}
