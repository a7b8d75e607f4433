//! `stickslip/checkpoint`.

use crate::parameter::strictly;
use crate::{FORMAT_VERSION, KnownScales, Run, Software, Times};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The first line of a checkpoint: what is run, and how far it is.
///
/// After the line come `words` 64-bit words in little-endian order, the state of the computation, and the
/// CRC-32 (IEEE) of all before it, also in little-endian order.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckpointHead {
    /// "stickslip/checkpoint"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// How the machine that made it rounds, such as "x86_64+sse4.1+avx+fma-1c291ca3": only a machine that rounds alike goes
    /// on to the same bits.
    #[serde(default)]
    pub arithmetic: Option<String>,
    /// What was asked for.
    pub order: Order,
    /// Time reached, in Γ/k.
    pub t: f64,
    /// Samples taken.
    pub samples: u64,
    /// What is written of the output (`.jsonl`), or kept for it beside the checkpoint.
    pub written: Mark,
    /// Spent on the integration, in seconds.
    pub seconds: f64,
    /// Words of the state.
    pub words: u64,
}

/// All that a run command asks for, but where its checkpoints are.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Order {
    /// Everything that defines the run.
    #[serde(deserialize_with = "strictly")]
    pub parameters: Run,
    /// When samples are taken.
    pub samples: Times,
    /// File to write, seen from the folder of the checkpoint; `-` for standard output.
    pub output: PathBuf,
    /// What is written.
    pub format: RunFormat,
    /// Whether the document holds the dense history.
    pub history: bool,
    /// Figure to draw, seen from the folder of the checkpoint.
    pub plot: Option<PathBuf>,
    /// Whether the run is repeated to verify it.
    pub verify: bool,
    /// What the run is told in beside the dimensionless numbers, if it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scales: Option<KnownScales>,
    /// Time between two checkpoints, in Γ/k, if any are made.
    pub checkpoint_every: Option<f64>,
}

/// What a run is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RunFormat {
    /// One document with everything.
    Json,
    /// The samples.
    Csv,
    /// Samples and history as NumPy arrays.
    Npz,
    /// JSON Lines: what is run, a line for each sample as the run passes it, what became of it.
    Jsonl,
    /// A few lines for a person.
    Text,
}

/// What a growing file held at some time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// Its length.
    pub bytes: u64,
    /// Their CRC-32 (IEEE).
    pub crc32: u32,
}

impl CheckpointHead {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/checkpoint";

    /// Whether this version of the program wrote it: no other can take it up.
    pub fn is_of_this_program(&self) -> bool {
        self.format == Self::FORMAT
            && self.format_version == FORMAT_VERSION
            && self.software.version == Software::this().version
    }
}
