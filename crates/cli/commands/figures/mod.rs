//! `stickslip figures`: the paper, redrawn and audited.
//!
//! Each figure is a function that computes its document; the pictures are drawn from the document alone.

mod bifurcation;
mod criticality;
mod fig1;
mod fig2;
mod fig3;
mod fig4;
mod fig5;
mod fig6;
mod fig7;
mod kymograph;
mod onset;
mod parts;
mod reproduction;
mod tips;
mod work_precision;

use crate::arguments::{FigureName, FiguresArguments};
use crate::failure::Failure;
use crate::files::output::Output;
use crate::files::place;
use crate::message::say;
use clap::ValueEnum;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;
use stickslip_documents::FigureDocument;
use stickslip_figures::{self as figures, FigureFormat, Size};

pub(crate) fn figures(arguments: &FiguresArguments) -> Result<(), Failure> {
    let folder = arguments.out_dir.as_path();
    std::fs::create_dir_all(folder).map_err(|error| {
        let named = format!("--out-dir {}", folder.display());
        let said = match error.kind() {
            io::ErrorKind::AlreadyExists => "is a file".into(),
            io::ErrorKind::NotFound => "cannot be made".into(),
            kind => kind.to_string(),
        };
        Failure::input(named, format!("{said}; name a folder that can be made"))
    })?;
    let _reserved = place::folder("--out-dir", folder)?;
    let asked = arguments.only.as_deref().unwrap_or(FigureName::value_variants());
    let names = FigureName::value_variants().iter().filter(|name| asked.contains(name));
    for name in names {
        let started = Instant::now();
        let files = make(*name, folder)?;
        let seconds = started.elapsed().as_secs_f64();
        say(format_args!("{} in {seconds:.1} s", files.join(", ")));
    }
    Ok(())
}

/// Makes one of them; the names of its files.
fn make(name: FigureName, folder: &Path) -> Result<Vec<String>, Failure> {
    let document = match name {
        FigureName::Fig1 => fig1::figure(),
        FigureName::Fig2 => fig2::figure(),
        FigureName::Fig3 => fig3::figure(),
        FigureName::Fig4 => fig4::figure(),
        FigureName::Fig5 => fig5::figure(),
        FigureName::Fig6 => fig6::figure(),
        FigureName::Fig7 => fig7::figure(),
        FigureName::Bifurcation => bifurcation::figure(),
        FigureName::Criticality => criticality::figure(),
        FigureName::Kymograph => kymograph::figure(),
        FigureName::WorkPrecision => work_precision::figure(),
        FigureName::Reproduction => return reproduction::write(folder),
    };
    write(&document?, folder)
}

/// The document and its pictures.
fn write(document: &FigureDocument, folder: &Path) -> Result<Vec<String>, Failure> {
    let place = |extension: &str| -> (String, PathBuf) {
        let name = format!("{}.{extension}", document.name);
        (name.clone(), folder.join(name))
    };
    let (json, path) = place("json");
    open(&path)?.write_json(document)?;
    let mut files = vec![json];
    for extension in ["svg", "png"] {
        let (name, path) = place(extension);
        // A build without PNG draws SVG alone.
        let Ok(format) = FigureFormat::of(&path) else { continue };
        let bytes = figures::draw(document, format, &Size::default())
            .map_err(|error| Failure::Run(format!("cannot draw {name}: {error}")))?;
        open(&path)?.write_bytes(&bytes)?;
        files.push(name);
    }
    Ok(files)
}

fn open(path: &Path) -> Result<Output, Failure> {
    Output::open("--out-dir", path)
}
