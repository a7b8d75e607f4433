//! Input files from users or from a host: tip functions and documents, with all their errors.

use super::columns::{Columns, whole};
use super::text::{read_table, unreadable};
use crate::failure::Failure;
use crate::session::Session;
use serde::Deserialize;
use std::fs::File;
use std::io::{self, BufReader, Cursor, Read};
use std::path::Path;
use stickslip::{self as documents, MeasuredTipDocument, RasterDocument, RunDocument, Unusable};
use stickslip_saved::Saved;
use stickslip_tables::Table;

/// Largest size of a document: a run of some ten million steps.
const LARGEST_DOCUMENT: u64 = 4 << 30;

/// A tip file: JSON {"gaussians":[…]}, CSV `x,f` or CSV `x,y,f`.
pub(crate) enum TipFile {
    Gaussians(Vec<GaussianEntry>),
    Table(Columns),
    Table2d([Vec<f64>; 3]),
    /// A document of `stickslip tip`.
    Measured(Box<MeasuredTipDocument>),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct TipJson {
    gaussians: Vec<GaussianEntry>,
}

/// One Gaussian of a tip file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GaussianEntry {
    pub(crate) amplitude: f64,
    pub(crate) center: f64,
    pub(crate) width: f64,
    /// Centre in y, for a tip in three dimensions.
    #[serde(default)]
    pub(crate) center_y: Option<f64>,
    /// Width in y, for a tip in three dimensions.
    #[serde(default)]
    pub(crate) width_y: Option<f64>,
}

pub(crate) fn read_tip(session: &Session, path: &Path) -> Result<TipFile, Failure> {
    const OPTION: &str = "--tip-file";
    read_table(session, OPTION, path, parse_tip)
}

pub(crate) fn parse_tip(table: &Table) -> Result<TipFile, String> {
    let text = match table {
        Table::Text(text) if text.trim_start().starts_with('{') => text,
        _ => return table_of(table),
    };
    let kind = documents::kind_of(&mut text.as_bytes(), MeasuredTipDocument::FORMAT);
    if kind.is_ok_and(|kind| kind.format.is_some()) {
        let measured = MeasuredTipDocument::read(&mut text.as_bytes());
        return measured.map(|m| TipFile::Measured(Box::new(m))).map_err(|e| e.to_string());
    }
    let tip: TipJson = serde_json::from_str(text).map_err(|error| {
        format!(
            "{error}; expected {{\"gaussians\":[{{\"amplitude\":1,\"center\":0,\"width\":1}},…]}}"
        )
    })?;
    Ok(TipFile::Gaussians(tip.gaussians))
}

/// The columns of a tip file, whose positions must be in σ.
fn table_of(table: &Table) -> Result<TipFile, String> {
    let sheet = whole(table, &["x,f", "x,y,f"])?;
    let positions = &sheet.headings[..sheet.headings.len() - 1];
    if let Some(heading) = positions.iter().find(|heading| heading.written_unit().is_some()) {
        return Err(format!(
            "the heading `{}` has a unit, and a tip file is in σ: `stickslip tip` makes one of a profile in any unit and \
             prints its σ",
            heading.text()
        ));
    }
    let [first, second, third] =
        [0, 1, 2].map(|i| sheet.columns.get(i).cloned().unwrap_or_default());
    Ok(if sheet.columns.len() == 3 {
        TipFile::Table2d([first, second, third])
    } else {
        TipFile::Table((first, second))
    })
}

/// A document of `stickslip run` or `stickslip raster`.
pub(crate) enum RunOrRaster {
    Run(Box<RunDocument>),
    Raster(Box<RasterDocument>),
}

/// Reads a document of `stickslip run` or `stickslip raster`.
pub(crate) fn read_scanned(session: &Session, path: &Path) -> Result<RunOrRaster, Failure> {
    if let Some(run) = session.document(path) {
        return Ok(RunOrRaster::Run(Box::new(run)));
    }
    let refused = |error: Unusable| Failure::file("RUN.json", path, error);
    let (kind, mut source) =
        documents::identified(open(session, "RUN.json", path)?, RunDocument::FORMAT)
            .map_err(refused)?;
    if kind.format.as_deref() == Some(RasterDocument::FORMAT) {
        let raster = RasterDocument::read(&mut source).map_err(refused)?;
        return Ok(RunOrRaster::Raster(Box::new(raster)));
    }
    let run = RunDocument::read(&mut source).map_err(refused)?;
    Ok(RunOrRaster::Run(Box::new(run)))
}

/// The document of `stickslip run` in a file; `None` if the file holds no JSON.
pub(crate) fn run_in(
    session: &Session,
    option: &str,
    path: &Path,
) -> Result<Option<RunDocument>, Failure> {
    if let Some(document) = session.document(path) {
        return Ok(Some(document));
    }
    // A pipe can be read once only: it is a table.
    if !session.supplies(path) && !path.metadata().is_ok_and(|file| file.is_file()) {
        return Ok(None);
    }
    let mut bytes = BufReader::new(open(session, option, path)?).bytes().map_while(Result::ok);
    if bytes.find(|byte| !byte.is_ascii_whitespace()) != Some(b'{') {
        return Ok(None);
    }
    read_document(session, option, path).map(Some)
}

/// Reads a document of `stickslip run` from an open file.
pub(crate) fn read_run_from(reader: impl Read, path: &Path) -> Result<RunDocument, Failure> {
    RunDocument::read(&mut reader.take(LARGEST_DOCUMENT))
        .map_err(|error| Failure::file("RUN.json", path, error))
}

/// Reads a document of this kind.
pub(crate) fn read_document<D: Saved>(
    session: &Session,
    option: &str,
    path: &Path,
) -> Result<D, Failure> {
    if let Some(document) = session.document(path) {
        return Ok(document);
    }
    D::read(&mut open(session, option, path)?).map_err(|error| Failure::file(option, path, error))
}

/// The format of the document in a file; `None` if it names none.
pub(crate) fn format_of(
    session: &Session,
    option: &str,
    path: &Path,
    wanted: &str,
) -> Result<Option<String>, Failure> {
    let kind = documents::kind_of(&mut open(session, option, path)?, wanted);
    let refused = |error| Failure::file(option, path, error);
    kind.map(|kind| kind.format).map_err(refused)
}

/// Opens the stream of a document (`-`: standard input), limited to the largest size.
pub(crate) fn open(session: &Session, option: &str, path: &Path) -> Result<Box<dyn Read>, Failure> {
    if let Some(bytes) = session.bytes(path) {
        return Ok(Box::new(Cursor::new(bytes)));
    }
    if path == Path::new("-") {
        return Ok(Box::new(io::stdin().take(LARGEST_DOCUMENT)));
    }
    let file = File::open(path).map_err(|error| Failure::file(option, path, unreadable(error)))?;
    Ok(Box::new(file.take(LARGEST_DOCUMENT)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_nested_too_deep_is_refused() {
        let nested = |depth: usize| format!("{}1{}", "[".repeat(depth), "]".repeat(depth));
        for depth in [200, 1_000_000] {
            let tip = format!("{{\"gaussians\":{}}}", nested(depth));
            assert!(parse_tip(&Table::Text(tip)).is_err());
            let run = format!(
                "{{\"format\":\"stickslip/run\",\"format_version\":1,\"software\":{}}}",
                nested(depth)
            );
            let refused =
                documents::read::<RunDocument>(&run, RunDocument::FORMAT).unwrap_err().to_string();
            assert!(!refused.is_empty() && refused.len() < 300, "{refused}");
        }
    }
}
