//! The points finished so far, in a file beside the output: JSON Lines, one for the grid and one for each point,
//! in the order in which they were finished. A sweep that is killed loses the points that were being computed.

use crate::documents::{ShardDocument, SweepParameters, SweepPoint};
use crate::failure::Failure;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, remove_file};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// What a sweep has so far.
pub(super) struct Journal {
    points: BTreeMap<usize, SweepPoint>,
    file: Option<(PathBuf, File)>,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Heading {
    format: String,
    version: String,
    parameters: SweepParameters,
    shard: Option<ShardDocument>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    index: usize,
    point: SweepPoint,
}

impl Journal {
    /// That of a sweep to this output, with what an earlier one left. There is none for standard output and
    /// devices.
    ///
    /// # Errors
    /// It cannot be written, or is that of another sweep.
    pub(super) fn open(
        output: &Path,
        parameters: &SweepParameters,
        shard: Option<ShardDocument>,
    ) -> Result<Self, Failure> {
        let is_file = output != Path::new("-") && output.metadata().map_or(true, |m| m.is_file());
        if !is_file {
            return Ok(Self { points: BTreeMap::new(), file: None });
        }
        let mut name = output.as_os_str().to_owned();
        name.push(".journal");
        let path = PathBuf::from(name);
        let heading = Heading {
            format: "stickslip/sweep-journal".into(),
            version: env!("CARGO_PKG_VERSION").into(),
            parameters: parameters.clone(),
            shard,
        };
        let refused =
            |message: String| Failure::input(format!("--output {}", output.display()), message);
        let (file, points) = open(&path, &heading).map_err(|error| match error {
            Unusable::Io(error) => refused(format!("its journal {}: {error}", path.display())),
            Unusable::Other => refused(format!(
                "{} is what another sweep has finished so far: give that sweep again, choose another output, or remove the file",
                path.display()
            )),
        })?;
        if !points.is_empty() {
            eprintln!("stickslip: {} points are in {} already", points.len(), path.display());
        }
        Ok(Self { points, file: Some((path, file)) })
    }

    pub(super) fn has(&self, index: usize) -> bool {
        self.points.contains_key(&index)
    }

    /// Keeps a point: once this returns, a kill does not lose it.
    pub(super) fn add(&mut self, index: usize, point: SweepPoint) -> Result<(), Failure> {
        let entry = Entry { index, point };
        if let Some((path, file)) = &mut self.file {
            append(file, &entry)
                .map_err(|error| Failure::Write { target: path.display().to_string(), error })?;
        }
        self.points.insert(index, entry.point);
        Ok(())
    }

    /// Where it is kept.
    pub(super) fn place(&self) -> Option<std::path::Display<'_>> {
        self.file.as_ref().map(|(path, _)| path.display())
    }

    /// All points, in order of the grid.
    pub(super) fn points(&self) -> Vec<SweepPoint> {
        self.points.values().cloned().collect()
    }

    /// The output is complete: it is not needed any more.
    pub(super) fn remove(self) {
        if let Some((path, _)) = self.file {
            // A journal that stays does no harm.
            let _ = remove_file(path);
        }
    }
}

enum Unusable {
    Io(io::Error),
    Other,
}

impl From<io::Error> for Unusable {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

/// The journal for this heading, new or with its points, cut after its last whole line.
fn open(path: &Path, heading: &Heading) -> Result<(File, BTreeMap<usize, SweepPoint>), Unusable> {
    let mut file =
        OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
    let mut text = String::new();
    file.read_to_string(&mut text)?;
    let whole = text.rfind('\n').map_or(0, |end| end + 1);
    let mut lines = text[..whole].lines();
    let mut points = BTreeMap::new();
    let Some(first) = lines.next() else {
        file.set_len(0)?;
        file.rewind()?;
        append(&mut file, heading)?;
        return Ok((file, points));
    };
    let found: Heading = serde_json::from_str(first).map_err(|_| Unusable::Other)?;
    if found != *heading {
        return Err(Unusable::Other);
    }
    for line in lines {
        let Entry { index, point } = serde_json::from_str(line).map_err(|_| Unusable::Other)?;
        points.insert(index, point);
    }
    file.set_len(whole as u64)?;
    file.seek(io::SeekFrom::End(0))?;
    Ok((file, points))
}

/// One line, in one write.
fn append(file: &mut File, line: &impl Serialize) -> io::Result<()> {
    let mut bytes = serde_json::to_vec(line)?;
    bytes.push(b'\n');
    file.write_all(&bytes)
}
