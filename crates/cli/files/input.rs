//! Files that users give, or that a host supplies: two-column CSV, tip functions, documents. All of it may be wrong.

use crate::failure::Failure;
use crate::host;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::Path;
use stickslip_documents::{
    self as documents, MeasuredTipDocument, RasterDocument, RunDocument, Unusable,
};
use stickslip_raster::AreaLine;

/// Two columns read from a CSV file.
pub(crate) type Columns = (Vec<f64>, Vec<f64>);

/// Measured series are small; this is a million rows and more.
pub(crate) const LARGEST_TABLE: u64 = 64 << 20;
/// A run of some ten million steps.
const LARGEST_DOCUMENT: u64 = 4 << 30;

/// The text of a file (`-`: standard input), if it is not larger than `most` bytes.
pub(crate) fn read_text(option: &str, path: &Path, most: u64) -> Result<String, Failure> {
    let text = if let Some(bytes) = host::bytes(path) {
        text_of(&*bytes, most)
    } else if path == Path::new("-") {
        text_of(io::stdin().lock(), most)
    } else {
        File::open(path).map_err(unreadable).and_then(|file| text_of(file, most))
    };
    text.map_err(|message| Failure::input(format!("{option} {}", path.display()), message))
}

fn text_of(reader: impl Read, most: u64) -> Result<String, String> {
    let mut text = String::new();
    match reader.take(most + 1).read_to_string(&mut text) {
        Err(error) if error.kind() == io::ErrorKind::InvalidData => {
            Err("cannot be read: it is no text in UTF-8".into())
        }
        Err(error) => Err(unreadable(error)),
        Ok(_) if text.len() as u64 > most => {
            Err(format!("larger than {} MB, the most that is read", most >> 20))
        }
        Ok(_) => Ok(text),
    }
}

#[expect(clippy::needless_pass_by_value, reason = "what map_err hands over")]
pub(super) fn unreadable(error: io::Error) -> String {
    format!("cannot be read: {error}")
}

/// Two columns of numbers from CSV, a heading allowed, `#` comments skipped.
pub(crate) fn read_columns(option: &str, path: &Path, heading: &str) -> Result<Columns, Failure> {
    let text = read_text(option, path, LARGEST_TABLE)?;
    parse_columns(&text, heading)
        .map_err(|message| Failure::input(format!("{option} {}", path.display()), message))
}

/// Lines of an area, y,start,length.
pub(crate) fn read_area(option: &str, path: &Path) -> Result<Vec<AreaLine>, Failure> {
    let text = read_text(option, path, LARGEST_TABLE)?;
    let [y, start, length] = parse_table(&text, "y,start,length")
        .map_err(|message| Failure::input(format!("{option} {}", path.display()), message))?;
    let columns = y.into_iter().zip(start).zip(length);
    Ok(columns.map(|((y, start), length)| AreaLine { y, start, length }).collect())
}

/// A profile x,u; or one surface t,x,u, as `surface` writes it.
pub(crate) fn read_profile(option: &str, path: &Path) -> Result<Columns, Failure> {
    let text = read_text(option, path, LARGEST_TABLE)?;
    parse_profile(&text)
        .map_err(|message| Failure::input(format!("{option} {}", path.display()), message))
}

pub(crate) fn parse_profile(text: &str) -> Result<Columns, String> {
    if width_of(text) != 3 {
        return parse_columns(text, "x,u");
    }
    let [t, x, u] = parse_table(text, "t,x,u")?;
    match t.iter().position(|time| time.to_bits() != t[0].to_bits()) {
        None => Ok((x, u)),
        Some(row) => Err(format!(
            "holds surfaces at several times, {} and {}: write one with `surface --at T`",
            t[0], t[row]
        )),
    }
}

fn parse_columns(text: &str, heading: &str) -> Result<Columns, String> {
    parse_table::<2>(text, heading).map(|[first, second]| (first, second))
}

/// N columns of numbers.
fn parse_table<const N: usize>(text: &str, heading: &str) -> Result<[Vec<f64>; N], String> {
    let mut columns = std::array::from_fn(|_| vec![]);
    for (index, record) in csv_reader(text).records().enumerate() {
        let record = record.map_err(|error| format!("not CSV: {error}"))?;
        let line = record.position().map_or(0, csv::Position::line);
        let numbers: Result<Vec<f64>, _> = record.iter().map(str::parse).collect();
        match numbers {
            Ok(row) if row.len() == N => {
                columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
            }
            Err(_) if index == 0 && is_heading(&record) => {}
            _ => {
                let count = ["no", "one", "two", "three"].get(N).unwrap_or(&"too many");
                return Err(format!(
                    "line {line} is not {count} numbers `{heading}` separated by commas"
                ));
            }
        }
    }
    Ok(columns)
}

fn csv_reader(text: &str) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes())
}

/// Fields of the first line.
fn width_of(text: &str) -> usize {
    csv_reader(text).records().next().and_then(Result::ok).map_or(0, |record| record.len())
}

/// A first line without any number; a mistyped row is none.
fn is_heading(record: &csv::StringRecord) -> bool {
    record.iter().all(|field| field.parse::<f64>().is_err())
}

/// A tip file: JSON {"gaussians":[…]}, CSV `x,f` or CSV `x,y,f`.
pub(crate) enum TipFile {
    Gaussians(Vec<GaussianEntry>),
    Table(Columns),
    Table2d([Vec<f64>; 3]),
    /// What `stickslip tip` made of a profile.
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
    /// Center in y, for a tip in three dimensions.
    #[serde(default)]
    pub(crate) center_y: Option<f64>,
    /// Width in y, for a tip in three dimensions.
    #[serde(default)]
    pub(crate) width_y: Option<f64>,
}

pub(crate) fn read_tip(path: &Path) -> Result<TipFile, Failure> {
    const OPTION: &str = "--tip-file";
    let text = read_text(OPTION, path, LARGEST_TABLE)?;
    parse_tip(&text)
        .map_err(|message| Failure::input(format!("{OPTION} {}", path.display()), message))
}

pub(crate) fn parse_tip(text: &str) -> Result<TipFile, String> {
    if !text.trim_start().starts_with('{') {
        return if width_of(text) == 3 {
            parse_table(text, "x,y,f").map(TipFile::Table2d)
        } else {
            parse_columns(text, "x,f").map(TipFile::Table)
        };
    }
    let kind = documents::kind_of(text.as_bytes(), MeasuredTipDocument::FORMAT);
    if kind.is_ok_and(|kind| kind.format.is_some()) {
        let measured = documents::read(text, MeasuredTipDocument::FORMAT);
        return measured.map(|m| TipFile::Measured(Box::new(m))).map_err(|e| e.to_string());
    }
    let tip: TipJson = serde_json::from_str(text).map_err(|error| {
        format!(
            "{error}; expected {{\"gaussians\":[{{\"amplitude\":1,\"center\":0,\"width\":1}},…]}}"
        )
    })?;
    Ok(TipFile::Gaussians(tip.gaussians))
}

/// What `stickslip run` or `stickslip raster` wrote.
pub(crate) enum RunOrRaster {
    Run(Box<RunDocument>),
    Raster(Box<RasterDocument>),
}

/// A document that `stickslip run` or `stickslip raster` wrote.
pub(crate) fn read_scanned(path: &Path) -> Result<RunOrRaster, Failure> {
    if let Some(run) = host::document(path) {
        return Ok(RunOrRaster::Run(Box::new(run)));
    }
    let refused = |error: Unusable| Failure::input(format!("RUN.json {}", path.display()), error);
    let (kind, source) =
        documents::told(open("RUN.json", path)?, RunDocument::FORMAT).map_err(refused)?;
    if kind.format.as_deref() == Some(RasterDocument::FORMAT) {
        let raster = documents::read_from(source, RasterDocument::FORMAT).map_err(refused)?;
        return Ok(RunOrRaster::Raster(Box::new(raster)));
    }
    let run = documents::read_from(source, RunDocument::FORMAT).map_err(refused)?;
    Ok(RunOrRaster::Run(Box::new(run)))
}

/// A document that `stickslip run` wrote, from a file that is open.
pub(crate) fn read_run_from(reader: impl Read, path: &Path) -> Result<RunDocument, Failure> {
    documents::read_from(reader.take(LARGEST_DOCUMENT), RunDocument::FORMAT)
        .map_err(|error| Failure::input(format!("RUN.json {}", path.display()), error))
}

/// A document of this format, that of a command of the same name.
pub(crate) fn read_document<D: DeserializeOwned + Clone + 'static>(
    option: &str,
    path: &Path,
    wanted: &str,
) -> Result<D, Failure> {
    if let Some(document) = host::document(path) {
        return Ok(document);
    }
    documents::read_from(open(option, path)?, wanted)
        .map_err(|error| Failure::input(format!("{option} {}", path.display()), error))
}

/// What the document in a file says it is; `None` where it does not.
pub(crate) fn format_of(
    option: &str,
    path: &Path,
    wanted: &str,
) -> Result<Option<String>, Failure> {
    let kind = documents::kind_of(open(option, path)?, wanted);
    let refused = |error| Failure::input(format!("{option} {}", path.display()), error);
    kind.map(|kind| kind.format).map_err(refused)
}

/// The stream of a document (`-`: standard input), which ends where it would be larger than any.
pub(crate) fn open(option: &str, path: &Path) -> Result<Box<dyn Read>, Failure> {
    if let Some(bytes) = host::bytes(path) {
        return Ok(Box::new(Cursor::new(bytes)));
    }
    if path == Path::new("-") {
        return Ok(Box::new(io::stdin().take(LARGEST_DOCUMENT)));
    }
    let file = File::open(path).map_err(|error| {
        Failure::input(format!("{option} {}", path.display()), unreadable(error))
    })?;
    Ok(Box::new(file.take(LARGEST_DOCUMENT)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heading_and_comments_are_skipped() {
        let (x, u) = parse_columns("# measured\nx,u\n0, 1\n2,3e-1\n", "x,u").unwrap();
        assert_eq!(x.len(), 2);
        assert!((u[1] - 0.3).abs() < 1e-16);
    }

    /// A file one byte too long is refused, one of just the length is read; more is never asked for.
    #[test]
    fn no_more_is_read_than_the_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        std::fs::write(&path, "0,1\n2,3\n").unwrap();
        assert_eq!(read_text("--force-file", &path, 8).unwrap(), "0,1\n2,3\n");
        let refused = read_text("--force-file", &path, 7).unwrap_err();
        assert!(refused.to_string().contains("larger than"), "{refused}");
    }

    /// It would not come back.
    #[cfg(unix)]
    #[test]
    fn a_device_without_end_is_refused() {
        let endless = read_text("--force-file", Path::new("/dev/zero"), 1 << 20).unwrap_err();
        assert!(endless.to_string().contains("larger than"), "{endless}");
    }

    #[test]
    fn what_is_nested_too_deep_is_refused() {
        let nested = |depth: usize| format!("{}1{}", "[".repeat(depth), "]".repeat(depth));
        for depth in [200, 1_000_000] {
            let tip = format!("{{\"gaussians\":{}}}", nested(depth));
            assert!(parse_tip(&tip).is_err());
            let run = format!(
                "{{\"format\":\"stickslip/run\",\"format_version\":1,\"software\":{}}}",
                nested(depth)
            );
            let refused =
                documents::read::<RunDocument>(&run, RunDocument::FORMAT).unwrap_err().to_string();
            assert!(!refused.is_empty() && refused.len() < 300, "{refused}");
        }
    }

    #[test]
    fn a_line_that_is_not_two_numbers_is_named() {
        for (text, line) in
            [("1,2\n3\n", 2), ("1,2\n3,4,5\n", 2), ("x,u\n1,2\nfoo,3\n", 3), ("1,2e\n3,4\n", 1)]
        {
            let message = parse_columns(text, "x,u").unwrap_err();
            assert!(message.contains(&format!("line {line}")), "{message}");
        }
    }
}
