//! `stickslip/checkpoint`.

use crate::parameter::strictly;
use crate::schema::JsonSchema;
use crate::{FORMAT_VERSION, KnownScales, Run, Software, Times};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The first line of a checkpoint: definition and progress of the run.
///
/// The line is followed by the state of the computation, `words` 64-bit words in little-endian order. Then follows the
/// CRC-32 (IEEE) of everything before it, also in little-endian order.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckpointHead {
    /// "stickslip/checkpoint"
    pub format: String,
    /// Version of the format; 1.
    pub format_version: u32,
    /// The program that wrote the checkpoint.
    pub software: Software,
    /// Floating-point arithmetic of the machine that made the checkpoint, such as "x86_64-30e62884":
    /// only a machine with the same arithmetic continues with identical bits.
    #[serde(default)]
    pub arithmetic: Option<String>,
    /// The request of the run command.
    pub order: Order,
    /// Time reached, in Γ/k.
    pub t: f64,
    /// Number of samples taken so far.
    pub samples: u64,
    /// The part of the output (`.jsonl`) already written, or of the samples kept beside the checkpoint.
    pub written: Mark,
    /// Time spent on the integration, in seconds.
    pub seconds: f64,
    /// Number of words of the state.
    pub words: u64,
}

/// The whole request of a run command, except the location of its checkpoints.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Order {
    /// Everything that defines the run.
    #[serde(deserialize_with = "strictly")]
    pub parameters: Run,
    /// Times of the samples.
    pub samples: Times,
    /// Output file, relative to the folder of the checkpoint; `-` for standard output.
    pub output: PathBuf,
    /// Format of the output.
    pub format: RunFormat,
    /// Whether the document contains the dense history.
    pub history: bool,
    /// File of the figure to draw, relative to the folder of the checkpoint; null without a figure.
    pub plot: Option<PathBuf>,
    /// Whether the run is repeated to verify it.
    pub verify: bool,
    /// Scales for results in physical units, if requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scales: Option<KnownScales>,
    /// Time between two checkpoints, in Γ/k, if any are made.
    pub checkpoint_every: Option<f64>,
}

/// Output formats of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RunFormat {
    /// One document with all results.
    Json,
    /// The samples.
    Csv,
    /// Samples and history as NumPy arrays.
    Npz,
    /// JSON Lines: the definition of the run, a line for each sample during the run, and the result.
    Jsonl,
    /// A short summary as text.
    Text,
}

/// State of a growing file at some time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// Length of the file, in bytes.
    pub bytes: u64,
    /// CRC-32 (IEEE) of the first `bytes` bytes.
    pub crc32: u32,
}

impl CheckpointHead {
    /// The value of the field `format`.
    pub const FORMAT: &'static str = "stickslip/checkpoint";

    /// Whether this build of the program wrote it: no other version or commit can resume it.
    pub fn is_of_this_build(&self) -> bool {
        self.format == Self::FORMAT
            && self.format_version == FORMAT_VERSION
            && self.software == Software::this()
    }
}
