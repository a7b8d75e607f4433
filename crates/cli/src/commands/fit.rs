//! `stickslip fit`.

use super::ask::{context, refusal, refuse_unknown};
use super::fit_image::{fit_image, without_width};
use super::job::{Job, judge_places};
use super::model::tip_and_draws;
use super::tip::in_unit;
use crate::arguments::FitArguments;
use crate::failure::Failure;
use crate::files::measured::{Common, ratio, read_measured};
use crate::session::Session;
use serde_json::{Value, json};
use std::path::Path;
use stickslip::{Ask, Fit, FitDocument, Measured, Tip, parameter};
use stickslip_tables::{Heading, Sheet};
use stickslip_units::Unit;

pub(crate) fn fit(session: &Session, arguments: &FitArguments) -> Result<(), Failure> {
    let FitArguments { options, outlet, plot, .. } = arguments;
    judge(arguments)?;
    if let Some(path) = &arguments.image {
        return fit_image(session, arguments, path);
    }
    let mut read = options.files().to_vec();
    read.extend(arguments.ripple.iter().map(|path| ("--ripple", Some(&**path))));
    read.extend(arguments.friction.iter().map(|path| ("--friction", Some(&**path))));
    read.push(("--onsets", arguments.onsets.as_deref()));
    read.push(("--wavelengths", arguments.wavelengths.as_deref()));
    judge_places(outlet, plot.as_deref(), &read)?;
    let question = question(session, arguments)?;
    let job = Job::open(session, FitDocument::FORMAT, outlet, plot.as_deref())?;
    let refused = |failure| match failure {
        stickslip::Failure::Refused(refused) if refused.parameter == "data" => {
            Failure::input(refused.value.unwrap_or_default(), refused.why)
        }
        other => refusal(other, &options.tip, &[]),
    };
    job.finish(question.ask(&context(session)).map_err(refused)?)
}

/// Rejects gains out of range, and options of data that are not given.
fn judge(arguments: &FitArguments) -> Result<(), Failure> {
    let FitArguments { height_gain, force_gain, .. } = arguments;
    let (has_image, has_lateral) = (arguments.image.is_some(), arguments.lateral_image.is_some());
    let has_forces = has_lateral || !arguments.friction.is_empty();
    for (option, gain) in [("--height-gain", height_gain), ("--force-gain", force_gain)] {
        if let Some(gain) = gain.filter(|gain| !(gain.is_finite() && *gain > 0.0)) {
            return Err(Failure::number(option, gain, "must be a finite number above 0"));
        }
    }
    let idle = [
        ("--retrace-image", arguments.retrace_image.is_some(), has_image, "--image"),
        ("--lateral-image", has_lateral, has_image, "--image"),
        ("--pitch", arguments.pitch.is_some(), has_image, "--image"),
        ("--height-gain", height_gain.is_some(), !arguments.ripple.is_empty(), "--ripple"),
        ("--force-gain", force_gain.is_some(), has_forces, "--friction or --lateral-image"),
    ];
    match idle.into_iter().find(|(_, is_given, has_data, _)| *is_given && !has_data) {
        None => Ok(()),
        Some((option, .., data)) => {
            Err(Failure::input(option, format!("has no effect without {data}: leave it out")))
        }
    }
}

/// The question of the options, with the data of the files.
fn question(session: &Session, arguments: &FitArguments) -> Result<Fit, Failure> {
    let options = without_width(arguments);
    let (tip, draws) = tip_and_draws(session, &options.tip)?;
    let tip = options.tip.is_given().then_some(Tip(tip));
    let mut values = options.values(session)?;
    refuse_unknown::<Fit, _>(&options, &values, "--ripple and other data of lines")?;
    let is_free = |name: &str| {
        values
            .get("free")
            .and_then(Value::as_array)
            .is_some_and(|names| names.contains(&json!(name)))
    };
    if is_free("beta") && tip.is_some() {
        let message =
            "is that of the triple Gaussian, and free: leave --beta, --tip and --tip-file out";
        return Err(Failure::input("--free beta", message));
    }
    let (data, unit) = data(session, arguments, values.get("unit").and_then(Value::as_str))?;
    if let Some(width) = arguments.options.tip.width {
        let width = in_unit("--width", width, unit.as_deref())?;
        values.insert("width".into(), json!(width));
    }
    if data.is_empty() {
        let message = "at least one of these data files is needed";
        return Err(Failure::input(
            "--ripple, --friction, --onsets, --wavelengths, --image",
            message,
        ));
    }
    let question: Fit = parameter::question(values)?;
    Ok(Fit { draws, data, unit, ..question })
}

/// The measured data, and the unit of lengths.
fn data(
    session: &Session,
    arguments: &FitArguments,
    unit: Option<&str>,
) -> Result<(Vec<Measured>, Option<String>), Failure> {
    let mut files = Files::of(session, unit)?;
    let mut found = vec![];
    for path in &arguments.ripple {
        found.push(files.ripple(path, arguments.height_gain)?);
    }
    for path in &arguments.friction {
        found.push(files.friction(path, arguments.force_gain)?);
    }
    if let Some(path) = &arguments.onsets {
        let (source, [velocity, load]) = files.series("--onsets", path)?;
        let [velocity_unit, load_unit] = files.units_of_series();
        found.push(Measured::Onsets { source, velocity, load, velocity_unit, load_unit });
    }
    if let Some(path) = &arguments.wavelengths {
        let (source, [velocity, load, wavelength]) = files.series("--wavelengths", path)?;
        let [velocity_unit, load_unit] = files.units_of_series();
        found.push(Measured::Wavelengths {
            source,
            velocity,
            load,
            wavelength,
            velocity_unit,
            load_unit,
        });
    }
    Ok((found, files.lengths.unit().map(str::to_owned)))
}

/// The data files; each quantity is converted to the unit of the first file.
struct Files<'a> {
    session: &'a Session,
    lengths: Common,
    forces: Common,
    velocities: Common,
    loads: Common,
}

impl<'a> Files<'a> {
    fn of(session: &'a Session, unit: Option<&str>) -> Result<Self, Failure> {
        Ok(Self {
            session,
            lengths: Common::lengths(unit)?,
            forces: Common::of(Unit::Force),
            velocities: Common::of(Unit::Velocity),
            loads: Common::of(Unit::Force),
        })
    }

    fn ripple(&mut self, path: &Path, gain: Option<f64>) -> Result<Measured, Failure> {
        let named = format!("--ripple {}", path.display());
        let mut sheet = read_measured(self.session, "--ripple", path, &[2, 3])?;
        if sheet.columns.len() == 3 {
            // As `stickslip surface` writes it.
            if sheet.headings.iter().map(Heading::name).ne(["t", "x", "u"]) {
                let message = "3 columns; 2 are needed, or a surface t,x,u";
                return Err(Failure::input(named, message));
            }
            sheet.headings.remove(0);
            sheet.columns.remove(0);
        }
        let Sheet { headings, columns, .. } = sheet;
        let [mut x, mut y] = taken("--ripple", path, columns)?;
        scale(&mut x, self.lengths.factor(&named, &headings[0])?);
        // Heights in the unit of the positions, of which a gain k/a is, where both are known. Volts are scaled by the gain.
        let is_known = matches!(headings[1].unit(Unit::Length), Ok(Some(_)));
        let mut height_unit = headings[1].written_unit();
        if is_known && self.lengths.unit().is_some() {
            scale(&mut y, self.lengths.factor(&named, &headings[1])?);
            height_unit = self.lengths.unit();
        } else if gain.is_some() {
            headings[1].unit(Unit::Length).map_err(|error| Failure::input(&named, error))?;
        }
        let height_unit = height_unit.map(str::to_owned);
        Ok(Measured::Ripple { source: named, x, y, gain, height_unit })
    }

    fn friction(&mut self, path: &Path, gain: Option<f64>) -> Result<Measured, Failure> {
        let named = format!("--friction {}", path.display());
        let Sheet { headings, mut columns, .. } =
            read_measured(self.session, "--friction", path, &[2, 3])?;
        scale(&mut columns[0], self.lengths.factor(&named, &headings[0])?);
        let mut force_unit = headings[1].written_unit();
        for (column, heading) in columns.iter_mut().zip(&headings).skip(1) {
            // A gain is fitted to forces of any unit; the two ways of a loop have the same.
            let is_known = matches!(heading.unit(Unit::Force), Ok(Some(_)));
            if gain.is_some() || is_known {
                scale(column, self.forces.factor(&named, heading)?);
                force_unit = self.forces.unit();
            } else if let Some(factor) = ratio(heading.written_unit(), headings[1].written_unit()) {
                scale(column, factor);
            } else {
                let message = format!(
                    "`{}` and `{}` have different units",
                    headings[1].text(),
                    heading.text()
                );
                return Err(Failure::input(named, message));
            }
        }
        let force_unit = force_unit.map(str::to_owned);
        let back = if columns.len() == 3 { columns.pop() } else { None };
        let [x, y] = taken("--friction", path, columns)?;
        Ok(Measured::Friction { source: named, x, y, back, gain, force_unit })
    }

    /// The units of velocities and loads; `None` where unknown.
    fn units_of_series(&self) -> [Option<String>; 2] {
        [&self.velocities, &self.loads].map(|quantity| quantity.unit().map(str::to_owned))
    }

    /// The name of the data, and N columns: velocities, loads and, if N is 3, wavelengths.
    fn series<const N: usize>(
        &mut self,
        option: &str,
        path: &Path,
    ) -> Result<(String, [Vec<f64>; N]), Failure> {
        let named = format!("{option} {}", path.display());
        let Sheet { headings, mut columns, .. } = read_measured(self.session, option, path, &[N])?;
        let quantities = [&mut self.velocities, &mut self.loads, &mut self.lengths];
        for ((column, heading), quantity) in columns.iter_mut().zip(&headings).zip(quantities) {
            scale(column, quantity.factor(&named, heading)?);
        }
        Ok((named, taken(option, path, columns)?))
    }
}

fn scale(column: &mut [f64], factor: f64) {
    column.iter_mut().for_each(|value| *value *= factor);
}

/// A table with exactly N columns.
fn taken<const N: usize>(
    option: &str,
    path: &Path,
    columns: Vec<Vec<f64>>,
) -> Result<[Vec<f64>; N], Failure> {
    columns.try_into().map_err(|columns: Vec<Vec<f64>>| {
        let message = format!("{} columns; {N} are needed", columns.len());
        Failure::file(option, path, message)
    })
}
