//! Output of surfaces.

use super::places::{MOST_PIXELS, MOST_PIXELS_OF_GSF, Places};
use crate::arguments::{Format, SurfaceArguments};
use crate::commands::in_units::{in_metres, scales_of};
use crate::commands::job::{Job, format};
use crate::failure::Failure;
use crate::files::output::Output;
use crate::session::Session;
use ndarray::Array2;
use std::io;
use stickslip::{
    Document, InUnits, KnownScales, Physical, SurfaceCurve, SurfaceDocument, SurfaceFound,
    SurfaceImage, SurfaceParameters,
};
use stickslip_tables::{Frame, gsf, header, pixels};

/// The output: a document, or an image alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SurfaceFormat {
    Document(Format),
    /// Gwyddion Simple Field.
    Gsf,
}

impl SurfaceFormat {
    /// Largest number of points of an image.
    pub(super) fn most_pixels(self) -> f64 {
        if self == Self::Gsf { MOST_PIXELS_OF_GSF } else { MOST_PIXELS }
    }

    /// Checks that a .gsf file of a run gets an image.
    pub(super) fn judge_of_run(self, arguments: &SurfaceArguments) -> Result<(), Failure> {
        if let Some(y) = arguments.y.as_ref().and_then(|y| y.first()) {
            let advice = "is for rasters: a run has --y-range LO:HI";
            return Err(Failure::number("--y", *y, advice));
        }
        if self == Self::Gsf && arguments.y_range.is_none() {
            let advice = "a .gsf file contains an image: give --y-range LO:HI too";
            return Err(Failure::file("--output", &arguments.output, advice));
        }
        Ok(())
    }

    /// The format by the extension of the output; rejected if it does not suit the other options.
    pub(super) fn of(session: &Session, arguments: &SurfaceArguments) -> Result<Self, Failure> {
        let path = &arguments.output;
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        let refused = |advice| Err(Failure::file("--output", path, advice));
        if extension.as_deref() != Some("gsf") || arguments.format.is_some() {
            return format(session, arguments.format, path, ", .gsf").map(Self::Document);
        }
        if arguments.y.is_some() {
            return refused("a .gsf image has evenly spaced rows: give --y-range, not --y");
        }
        if arguments.x.is_some() {
            return refused(
                "a .gsf image has evenly spaced columns: give --range and --spacing, not --x",
            );
        }
        match arguments.at.as_deref() {
            Some(times) if times.len() != 1 => {
                refused("a .gsf file contains one image: give one time with --at")
            }
            _ => Ok(Self::Gsf),
        }
    }
}

/// The unit of length and the unit of height in m.
type InMetres = (f64, f64, &'static str);

impl SurfaceFormat {
    /// The scales of surfaces of a document with this r, and the units of a .gsf file.
    pub(super) fn scales(
        self,
        session: &Session,
        arguments: &SurfaceArguments,
        physical: Option<&InUnits>,
        r: f64,
    ) -> Result<(Option<KnownScales>, Option<InMetres>), Failure> {
        let is_gsf = self == Self::Gsf;
        let scales = scales_of(session, &arguments.in_units, physical, r, is_gsf)?;
        let unit = is_gsf.then(|| in_metres(scales.as_ref())).transpose()?;
        Ok((scales, unit))
    }

    /// The output of a document with surfaces.
    pub(super) fn job(
        self,
        session: &Session,
        document: &str,
        arguments: &SurfaceArguments,
    ) -> Result<Job, Failure> {
        let format = match self {
            Self::Document(format) => format,
            Self::Gsf => Format::Json,
        };
        let (output, plot) = (&arguments.output, arguments.plot.as_deref());
        Job::of_format(session, document, format, output, &arguments.fields, plot)
    }
}

/// Writes surfaces of a run, or an image in the units of a .gsf file. `rows` computes the heights at a time: an image, or
/// the single row of a curve.
pub(super) fn surfaces(
    job: Job,
    parameters: SurfaceParameters,
    places: &Places,
    (scales, in_metres): (Option<KnownScales>, Option<InMetres>),
    rows: impl Fn(f64) -> Result<Array2<f64>, String>,
) -> Result<(), Failure> {
    let Places { t, x, y, .. } = places;
    let mut found = SurfaceFound { surfaces: vec![], images: vec![] };
    for t in t.iter().copied() {
        let heights = rows(t).map_err(Failure::Run)?;
        let u: Vec<Vec<f64>> = heights.rows().into_iter().map(|row| row.to_vec()).collect();
        if y.is_empty() {
            found.surfaces.push(SurfaceCurve { t, x: x.clone(), u: u.concat() });
        } else {
            found.images.push(SurfaceImage { t, x: x.clone(), y: y.clone(), u });
        }
    }
    let result: SurfaceDocument = Document::new(parameters, found, vec![]);
    let result = result.in_units(scales.as_ref());
    match in_metres {
        None => job.finish(result),
        Some(unit) => job.finish_bytes(&field(&result, places, unit), result),
    }
}

/// The image, for Gwyddion.
fn field(
    document: &SurfaceDocument,
    places: &Places,
    (length, height, unit): (f64, f64, &str),
) -> Vec<u8> {
    let image = &document.images[0];
    let model = &document.parameters.model;
    let frame = Frame {
        title: &title(image.t, model.alpha, model.r),
        counts: [image.x.len(), image.y.len()],
        first: [length * places.x[0], length * places.y[0]],
        spacing: [length * places.spacing.unwrap_or(1.0), length * places.spacing_y],
        unit,
    };
    gsf(&frame, &image.u, height)
}

/// The title of an image of a run.
pub(super) fn title(t: f64, alpha: f64, r: f64) -> String {
    format!("u(x,y) at time {t}, alpha {alpha}, r {r}")
}

/// Number of rows of a large image that are computed at a time.
const ROWS: usize = 64;

/// Writes an image that is larger than a document may be to a .gsf file, some rows at a time. `rows` computes the heights
/// at some y.
pub(super) fn large(
    arguments: &SurfaceArguments,
    (places, y): (&Places, &[f64]),
    title: &str,
    (length, height, unit): (f64, f64, &str),
    rows: impl Fn(&[f64]) -> Result<Array2<f64>, String>,
) -> Result<(), Failure> {
    if let Some(path) = &arguments.plot {
        let advice = "draws at most 1e7 points: leave it out, or take a larger --spacing";
        return Err(Failure::file("--plot", path, advice));
    }
    if let Some(field) = arguments.fields.print.first() {
        let advice = "is available for images of at most 1e7 points: leave it out";
        return Err(Failure::input(format!("--print {field}"), advice));
    }
    let spacing_y = match y {
        [first, .., last] => (last - first) / (y.len() - 1) as f64,
        _ => places.spacing_y,
    };
    let frame = Frame {
        title,
        counts: [places.x.len(), y.len()],
        first: [length * places.x[0], length * y[0]],
        spacing: [length * places.spacing.unwrap_or(1.0), length * spacing_y],
        unit,
    };
    Output::open("--output", &arguments.output)?.write_with(|out| {
        out.write_all(&header(&frame))?;
        y.chunks(ROWS).try_for_each(|y| {
            let heights = rows(y).map_err(io::Error::other)?;
            let heights = heights.as_standard_layout();
            out.write_all(&pixels(heights.as_slice().unwrap_or_default(), height))
        })
    })
}
