//! `stickslip figures`: the figures and numbers of the paper.
//!
//! The library `reproduction` computes the documents; the pictures are drawn from these alone.

use super::figure::drawing_failure;
use crate::arguments::{FigureName, FiguresArguments};
use crate::failure::Failure;
use crate::files::output::Output;
use crate::files::place;
use crate::session::Session;
use clap::ValueEnum;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;
use stickslip::FigureDocument;
use stickslip_figures::{self as figures, FigureFormat, Size, View};
use stickslip_reproduction as reproduction;

pub(crate) fn figures(session: &Session, arguments: &FiguresArguments) -> Result<(), Failure> {
    let folder = arguments.out_dir.as_path();
    std::fs::create_dir_all(folder).map_err(|error| {
        let said = match error.kind() {
            io::ErrorKind::AlreadyExists => "is a file".into(),
            io::ErrorKind::NotFound => "cannot be made".into(),
            kind => kind.to_string(),
        };
        let message = format!("{said}; name a folder that can be made");
        Failure::file("--out-dir", folder, message)
    })?;
    let _reserved = place::folder("--out-dir", folder)?;
    let asked = arguments.only.as_deref().unwrap_or(FigureName::value_variants());
    let names = FigureName::value_variants().iter().filter(|name| asked.contains(name));
    for name in names {
        let started = Instant::now();
        let files = make(*name, folder)?;
        let seconds = started.elapsed().as_secs_f64();
        session.remark(format_args!("{} in {seconds:.1} s", files.join(", ")));
    }
    Ok(())
}

/// Makes one figure or table and returns the names of its files.
fn make(name: FigureName, folder: &Path) -> Result<Vec<String>, Failure> {
    let Some(figure) = name.figure() else {
        let (json, text) = ("reproduction.json", "reproduction.md");
        let table = reproduction::table().map_err(Failure::run)?;
        open(&folder.join(json))?.write_json(&table)?;
        open(&folder.join(text))?.write_bytes(reproduction::page(&table).as_bytes())?;
        return Ok(vec![json.into(), text.into()]);
    };
    write(&reproduction::figure(&figure).map_err(Failure::run)?, folder)
}

/// Writes the document and its pictures.
fn write(document: &FigureDocument, folder: &Path) -> Result<Vec<String>, Failure> {
    let place = |extension: &str| -> (String, PathBuf) {
        let name = format!("{}.{extension}", document.name);
        (name.clone(), folder.join(name))
    };
    let (json, path) = place("json");
    open(&path)?.write_json(document)?;
    let drawn = figures::of(document, &View::default()).map_err(|error| drawing_failure(&error))?;
    let mut files = vec![json];
    for extension in ["svg", "png"] {
        let (name, path) = place(extension);
        // A build without PNG draws SVG alone.
        let Ok(format) = FigureFormat::of(&path) else { continue };
        let bytes = figures::draw(&drawn, format, &Size::default());
        let bytes = bytes.map_err(|error| drawing_failure(&error))?;
        open(&path)?.write_bytes(&bytes)?;
        files.push(name);
    }
    Ok(files)
}

fn open(path: &Path) -> Result<Output, Failure> {
    Output::open("--out-dir", path)
}
