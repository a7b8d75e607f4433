//! `stickslip fit`.

use super::job::{Job, judge_places};
use super::model::tip_and_draws;
use crate::arguments::{FitArguments, ScanName, TipArguments};
use crate::failure::{Failure, Typed};
use crate::files::heading::Heading;
use crate::files::measured::{Common, read_measured};
use crate::files::sheet::Sheet;
use std::path::Path;
use stickslip::{Document, FitDocument, FitFound, FitParameters, NumberHeld, TipName};
use stickslip_measurement::{
    Data, Fit, FitError, FitRequest, Name, Scan, Shape, Track, Values, fit as fitted,
};
use stickslip_stability::critical;
use stickslip_tip::{Gaussian, TipFunction, Wider};
use stickslip_units::Unit;

pub(crate) fn fit(arguments: &FitArguments) -> Result<(), Failure> {
    let tip_file = arguments.tip.tip_file.as_deref();
    let mut read = vec![("--tip-file", tip_file)];
    read.extend(arguments.ripple.iter().map(|path| ("--ripple", Some(&**path))));
    read.extend(arguments.friction.iter().map(|path| ("--friction", Some(&**path))));
    read.push(("--onsets", arguments.onsets.as_deref()));
    read.push(("--wavelengths", arguments.wavelengths.as_deref()));
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    let request = request(arguments)?;
    let (data, unit) = data(arguments)?;
    if data.is_empty() {
        let message = "give what was measured: one of these at least";
        return Err(Failure::input("--ripple, --friction, --onsets, --wavelengths", message));
    }
    let data = reduced(data)?;
    let job = Job::open::<FitDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let given: Vec<Data> = data.iter().map(|(_, data)| data.clone()).collect();
    let mut found = fitted(&given, &request).map_err(|error| match error {
        FitError::NoStart | FitError::Stopped => Failure::Run(error.to_string()),
        error => Failure::input(named(&data), error),
    })?;
    if is_assumed(&arguments.tip) && request.shape != Shape::Triple {
        found.remarks.insert(0, ASSUMED.into());
    }
    let tip = fitted_tip(&request, &found)?;
    let critical_alpha =
        found.values.get(Name::R).and_then(|r| critical(&Wider::default(), &tip, r).ok());
    let held = Name::ALL.into_iter().filter_map(|name| {
        Some(NumberHeld { name: name.word().into(), value: request.known.get(name)? })
    });
    let parameters = FitParameters {
        tip: (&tip).into(),
        known: held.collect(),
        robust: arguments.robust,
        unit,
        scan: request.scan.map(|scan| scan.word().into()),
        footprints: request.footprints.len(),
    };
    let answer = FitFound::of(&found, &data, critical_alpha.map(|at| at.alpha));
    job.finish::<FitDocument>(Document::new(parameters, answer, found.remarks))
}

/// Warning for a fit without a given footprint.
const ASSUMED: &str = "no footprint is given: the triple Gaussian of the paper, β = 1, is assumed; give the measured one with --tip-file";

/// Whether no option of the footprint is given.
fn is_assumed(tip: &TipArguments) -> bool {
    tip.tip.is_none() && tip.beta.is_none() && tip.tip_file.is_none()
}

/// The rows by ascending position, averaged if there are more than a few thousand.
fn reduced(data: Given) -> Result<Given, Failure> {
    let one = |(source, data): (String, Data)| {
        let data = data.reduced().map_err(|error| Failure::input(&source, error))?;
        Ok((source, data))
    };
    data.into_iter().map(one).collect()
}

/// The footprint of the options and, if it was measured, the footprints drawn within its error.
fn footprints(arguments: &TipArguments) -> Result<(TipFunction, Vec<TipFunction>), Failure> {
    let (tip, draws) = tip_and_draws(&TipArguments { width: None, ..arguments.clone() })?;
    let file = arguments.tip_file.as_deref().unwrap_or(Path::new(""));
    let refused = |error| Failure::input(format!("--tip-file {}: draws", file.display()), error);
    let drawn = draws.iter().map(|draw| {
        TipFunction::gaussian_sum(draw.iter().map(Gaussian::from).collect()).map_err(refused)
    });
    Ok((tip, drawn.collect::<Result<_, _>>()?))
}

/// The names of the files, as given.
fn named(data: &[(String, Data)]) -> String {
    data.iter().map(|(source, _)| source.as_str()).collect::<Vec<&str>>().join(", ")
}

fn fitted_tip(request: &FitRequest, found: &Fit) -> Result<TipFunction, Failure> {
    match &request.shape {
        Shape::Known(tip) => Ok(tip.clone()),
        Shape::Triple => {
            TipFunction::triple_gaussian(found.values.get(Name::Beta).unwrap_or(1.0), 1.0)
                .map_err(|error| Failure::Run(error.to_string()))
        }
    }
}

/// Names for `--free`.
const MORE: [(&str, Name); 4] = [
    ("beta", Name::Beta),
    ("depth-limit", Name::DepthLimit),
    ("healing-time", Name::HealingTime),
    ("inertia", Name::Inertia),
];

fn request(arguments: &FitArguments) -> Result<FitRequest, Failure> {
    let mut free = vec![];
    for word in &arguments.free {
        let found = MORE.iter().find(|(name, _)| name == word).map(|(_, name)| *name);
        free.push(found.ok_or_else(|| {
            let names = MORE.map(|(name, _)| name).join(", ");
            Failure::input(
                format!("--free {word}"),
                format!("{names} will do; α, r and σ are free unless given"),
            )
        })?);
    }
    let TipArguments { width, beta, tip: name, .. } = arguments.tip;
    let mut known = Values::default();
    for (option, name, value) in [
        ("--alpha", Name::Alpha, arguments.alpha),
        ("--r", Name::R, arguments.r),
        ("--width", Name::Width, width),
        ("--depth-limit", Name::DepthLimit, arguments.depth_limit),
        ("--healing-time", Name::HealingTime, arguments.healing_time),
        ("--inertia", Name::Inertia, arguments.inertia),
    ] {
        let Some(value) = value else { continue };
        if !(value.is_finite() && value > 0.0) {
            let message = "must be a finite number above 0";
            return Err(Failure::input(format!("{option} {}", Typed(value)), message));
        }
        known.set(name, value);
    }
    let is_triple =
        matches!(name, None | Some(TipName::TripleGaussian)) && arguments.tip.tip_file.is_none();
    let (shape, footprints) = if free.contains(&Name::Beta) {
        if !is_triple || beta.is_some() {
            let message =
                "is that of the triple Gaussian, and free: leave --beta, --tip and --tip-file out";
            return Err(Failure::input("--free beta", message));
        }
        (Shape::Triple, vec![])
    } else {
        let (tip, drawn) = footprints(&arguments.tip)?;
        (Shape::Known(tip), drawn)
    };
    let scan = arguments.scan.map(|scan| match scan {
        ScanName::Right => Scan::Right,
        ScanName::Left => Scan::Left,
    });
    Ok(FitRequest { shape, known, free, robust: arguments.robust, scan, footprints })
}

/// Data, each with the name of its file.
type Given = Vec<(String, Data)>;

/// The measured data, and the unit of lengths.
fn data(arguments: &FitArguments) -> Result<(Given, Option<String>), Failure> {
    let mut files = Files::of(arguments)?;
    let mut found = vec![];
    let mut give = |option: &str, path: &Path, data: Data| {
        found.push((format!("{option} {}", path.display()), data));
    };
    for path in &arguments.ripple {
        give("--ripple", path, files.ripple(path, arguments.height_gain)?);
    }
    for path in &arguments.friction {
        give("--friction", path, files.friction(path, arguments.force_gain)?);
    }
    if let Some(path) = &arguments.onsets {
        let [velocity, load] = files.series("--onsets", path)?;
        give("--onsets", path, Data::Onsets { velocity, load });
    }
    if let Some(path) = &arguments.wavelengths {
        let [velocity, load, wavelength] = files.series("--wavelengths", path)?;
        give("--wavelengths", path, Data::Wavelengths { velocity, load, wavelength });
    }
    Ok((found, files.lengths.unit().map(str::to_owned)))
}

/// The data files; each quantity is converted to the unit of the first file.
struct Files {
    lengths: Common,
    forces: Common,
    velocities: Common,
    loads: Common,
}

impl Files {
    fn of(arguments: &FitArguments) -> Result<Self, Failure> {
        let given = |unit: &String| Common::given(Unit::Length, "--unit", unit);
        let lengths = arguments.unit.as_ref().map(given).transpose()?;
        Ok(Self {
            lengths: lengths.unwrap_or(Common::of(Unit::Length)),
            forces: Common::of(Unit::Force),
            velocities: Common::of(Unit::Velocity),
            loads: Common::of(Unit::Force),
        })
    }

    fn ripple(&mut self, path: &Path, gain: Option<f64>) -> Result<Data, Failure> {
        let named = format!("--ripple {}", path.display());
        let mut sheet = read_measured("--ripple", path, &[2, 3])?;
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
        if is_known && self.lengths.unit().is_some() {
            scale(&mut y, self.lengths.factor(&named, &headings[1])?);
        } else if gain.is_some() {
            headings[1].unit(Unit::Length).map_err(|error| Failure::input(&named, error))?;
        }
        Ok(Data::Ripple(Track::new(x, y, gain)))
    }

    fn friction(&mut self, path: &Path, gain: Option<f64>) -> Result<Data, Failure> {
        let named = format!("--friction {}", path.display());
        let Sheet { headings, mut columns, .. } = read_measured("--friction", path, &[2, 3])?;
        scale(&mut columns[0], self.lengths.factor(&named, &headings[0])?);
        for (column, heading) in columns.iter_mut().zip(&headings).skip(1) {
            // A gain is fitted to forces of any unit; the two ways of a loop have the same.
            let is_known = matches!(heading.unit(Unit::Force), Ok(Some(_)));
            if gain.is_some() || is_known {
                scale(column, self.forces.factor(&named, heading)?);
            } else if heading.written_unit() != headings[1].written_unit() {
                let message = format!(
                    "`{}` and `{}` have different units",
                    headings[1].text(),
                    heading.text()
                );
                return Err(Failure::input(named, message));
            }
        }
        if columns.len() == 3 {
            let [x, y, back] = taken("--friction", path, columns)?;
            return Ok(Data::Loop(Track::new(x, y, gain), back));
        }
        let [x, y] = taken("--friction", path, columns)?;
        Ok(Data::Friction(Track::new(x, y, gain)))
    }

    /// Velocities and loads, and with three columns wavelengths.
    fn series<const N: usize>(
        &mut self,
        option: &str,
        path: &Path,
    ) -> Result<[Vec<f64>; N], Failure> {
        let named = format!("{option} {}", path.display());
        let Sheet { headings, mut columns, .. } = read_measured(option, path, &[N])?;
        let quantities = [&mut self.velocities, &mut self.loads, &mut self.lengths];
        for ((column, heading), quantity) in columns.iter_mut().zip(&headings).zip(quantities) {
            scale(column, quantity.factor(&named, heading)?);
        }
        taken(option, path, columns)
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
        Failure::input(format!("{option} {}", path.display()), message)
    })
}
