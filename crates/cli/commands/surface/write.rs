//! Surfaces to files.

use super::places::Places;
use super::units::Scale;
use crate::arguments::SurfaceArguments;
use crate::failure::Failure;
use crate::files::gsf::{Field, gsf};
use crate::files::npz::Npz;
use crate::files::output::{Output, OutputFormat};
use std::io::{self, Write};
use stickslip_documents::{SurfaceDocument, SurfaceImage};

/// What is written: a document, or an image alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SurfaceFormat {
    Document(OutputFormat),
    /// Gwyddion Simple Field.
    Gsf,
}

impl SurfaceFormat {
    /// By the extension of the output, refused where that does not go with the other options.
    pub(super) fn of(arguments: &SurfaceArguments) -> Result<Self, Failure> {
        let path = &arguments.output;
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        let refused = |what: String, advice: &str| Err(Failure::input(what, advice));
        if extension.as_deref() != Some("gsf") {
            if let Some(units) = &arguments.units {
                let named = format!("--units {}", units.display());
                let advice =
                    "only .gsf files carry units: name the output so, or leave the option out";
                return refused(named, advice);
            }
            return OutputFormat::or_also(path, ", .gsf").map(Self::Document);
        }
        let named = format!("--output {}", path.display());
        if arguments.y_range.is_none() {
            return refused(named, "a .gsf file holds an image: give --y-range LO,HI too");
        }
        if arguments.x.is_some() {
            let advice =
                "a .gsf image has evenly spaced columns: give --range and --spacing, not --x";
            return refused(named, advice);
        }
        match arguments.at.as_deref() {
            Some(times) if times.len() != 1 => {
                refused(named, "a .gsf file holds one image: give one time with --at")
            }
            _ => Ok(Self::Gsf),
        }
    }
}

pub(super) fn write(
    document: &SurfaceDocument,
    format: SurfaceFormat,
    places: &Places,
    scale: &Scale,
    output: Output,
) -> Result<(), Failure> {
    match format {
        SurfaceFormat::Document(OutputFormat::Json) => output.write_json(document),
        SurfaceFormat::Document(OutputFormat::Csv) => csv(document, output),
        SurfaceFormat::Document(OutputFormat::Npz) => npz(document, places, output),
        SurfaceFormat::Gsf => output.write_bytes(&field(document, places, scale)),
    }
}

fn csv(document: &SurfaceDocument, output: Output) -> Result<(), Failure> {
    let SurfaceDocument { surfaces, images, .. } = document;
    if images.is_empty() {
        let t: Vec<f64> = surfaces.iter().flat_map(|s| s.x.iter().map(|_| s.t)).collect();
        let x: Vec<f64> = surfaces.iter().flat_map(|s| s.x.iter().copied()).collect();
        let u: Vec<f64> = surfaces.iter().flat_map(|s| s.u.iter().copied()).collect();
        return output.write_csv("t,x,u", &[&t, &x, &u]);
    }
    output.write_with(|out| {
        writeln!(out, "t,x,y,u")?;
        images.iter().try_for_each(|image| write_image(image, out))
    })
}

/// A line a point. The text of a position serves for its whole row or column: shortest digits are what
/// takes the time.
fn write_image(image: &SurfaceImage, out: &mut dyn Write) -> io::Result<()> {
    let starts: Vec<String> = image.x.iter().map(|x| format!("{},{x},", image.t)).collect();
    let mut lines = String::new();
    for (y, row) in image.y.iter().zip(&image.u) {
        let y = format!("{y},");
        lines.clear();
        for (start, u) in starts.iter().zip(row) {
            lines.extend([start, &y, &u.to_string(), "\n"]);
        }
        out.write_all(lines.as_bytes())?;
    }
    Ok(())
}

/// `u` has an axis for t, one for y in an image, and one for x.
fn npz(document: &SurfaceDocument, places: &Places, output: Output) -> Result<(), Failure> {
    let SurfaceDocument { surfaces, images, .. } = document;
    let mut npz = Npz::new();
    npz.vector("t", &places.t)?;
    npz.vector("x", &places.x)?;
    if images.is_empty() {
        npz.matrix("u", &surfaces.iter().map(|s| s.u.clone()).collect::<Vec<_>>())?;
    } else {
        npz.vector("y", &places.y)?;
        let shape = [images.len(), places.y.len(), places.x.len()];
        let values = images.iter().flat_map(|image| image.u.concat()).collect();
        npz.cube("u", shape, values)?;
    }
    output.write_bytes(&npz.bytes()?)
}

fn field(document: &SurfaceDocument, places: &Places, scale: &Scale) -> Vec<u8> {
    let image = &document.images[0];
    let model = &document.parameters.model;
    gsf(&Field {
        title: &format!("u(x,y) at time {}, alpha {}, r {}", image.t, model.alpha, model.r),
        first: [scale.length * places.x[0], scale.length * places.y[0]],
        spacing: [scale.length * places.spacing.unwrap_or(1.0), scale.length * places.spacing_y],
        unit: scale.unit,
        rows: &image.u,
        factor: scale.height,
    })
}
