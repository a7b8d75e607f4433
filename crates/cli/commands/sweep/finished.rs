//! The points that are finished, kept in a file beside the output as they come: a line for the grid, then a
//! line a point. A kill at any moment costs the points under way and at most the line being written.

use crate::failure::Failure;
use serde::{Deserialize, Serialize};
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use stickslip_documents::{Software, SweepParameters, SweepPoint};

/// What has been finished so far, and where it is kept, if it is.
#[derive(Debug)]
pub(super) struct Finished {
    points: Vec<SweepPoint>,
    kept: Option<(PathBuf, File)>,
}

/// The first line: points of another grid, or another version, are not ours to go on from.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Head {
    software: Software,
    parameters: SweepParameters,
}

impl Finished {
    /// Nothing yet, and nothing kept.
    pub(super) fn in_memory() -> Self {
        Self { points: vec![], kept: None }
    }

    /// What an interrupted sweep over the same grid left beside `output`, or nothing.
    pub(super) fn beside(output: &Path, parameters: &SweepParameters) -> Result<Self, Failure> {
        let mut path = output.as_os_str().to_owned();
        path.push(".partial");
        let path = PathBuf::from(path);
        let refused = |message: String| {
            let advice = "remove it, or choose another --output";
            Failure::input(
                format!("--output {}", output.display()),
                format!("{} {message}; {advice}", path.display()),
            )
        };
        let head = Head { software: Software::this(), parameters: parameters.clone() };
        let opened = open(&path, &head);
        let (file, points) = opened.map_err(|error| refused(error.to_string()))?;
        Ok(Self { points, kept: Some((path, file)) })
    }

    pub(super) fn points(&self) -> &[SweepPoint] {
        &self.points
    }

    /// Adds a point, and keeps it before anything else is done.
    pub(super) fn add(&mut self, point: SweepPoint) -> io::Result<()> {
        if let Some((_, file)) = &mut self.kept {
            file.write_all(&line(&point)?)?;
        }
        self.points.push(point);
        Ok(())
    }

    /// Where the points are kept.
    pub(super) fn path(&self) -> Option<&Path> {
        self.kept.as_ref().map(|(path, _)| path.as_path())
    }

    /// The points by rising index.
    pub(super) fn in_order(&self) -> Vec<SweepPoint> {
        let mut points = self.points.clone();
        points.sort_by_key(|point| point.index);
        points
    }

    /// The file is not needed any more.
    pub(super) fn remove(self) {
        if let Some((path, _)) = self.kept {
            std::fs::remove_file(path).ok();
        }
    }
}

fn line(value: &impl Serialize) -> io::Result<Vec<u8>> {
    let mut line = serde_json::to_vec(value)?;
    line.push(b'\n');
    Ok(line)
}

fn open(path: &Path, head: &Head) -> io::Result<(File, Vec<SweepPoint>)> {
    let mut file =
        OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
    file.try_lock().map_err(|_| io::Error::other("is in use by another sweep"))?;
    let mut text = vec![];
    file.read_to_end(&mut text)?;
    let mut lines =
        text.split_inclusive(|byte| *byte == b'\n').filter(|line| line.ends_with(b"\n"));
    let mut points = vec![];
    let mut length = 0;
    match lines.next() {
        Some(first) if serde_json::from_slice::<Head>(first).ok().as_ref() == Some(head) => {
            length += first.len();
        }
        Some(_) => return Err(io::Error::other("holds the points of another sweep")),
        None => {}
    }
    let whole = lines.map_while(|line| Some((line.len(), serde_json::from_slice(line).ok()?)));
    for (bytes, point) in whole {
        length += bytes;
        points.push(point);
    }
    // What a kill left of the last line goes.
    file.set_len(length as u64)?;
    file.seek(SeekFrom::End(0))?;
    if length == 0 {
        file.write_all(&line(head)?)?;
    }
    Ok((file, points))
}
