//! `stickslip surface`.

use clap::Args;
use std::path::PathBuf;

/// Reconstruct the surface u(x,t) from a run.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct SurfaceArguments {
    /// Document that `stickslip run` wrote; `-` is standard input.
    #[arg(value_name = "RUN.json")]
    pub(crate) run: PathBuf,

    /// Times within the run [default: its end].
    #[arg(long, value_name = "T1,T2,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) at: Option<Vec<f64>>,

    /// Positions, in σ.
    #[arg(long, value_name = "X1,X2,…", value_delimiter = ',', allow_hyphen_values = true, conflicts_with_all = ["range", "spacing"])]
    pub(crate) x: Option<Vec<f64>>,

    /// First and last position [default: from 12 behind the start of the tip to 12 ahead of its end].
    #[arg(long, value_name = "LO,HI", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) range: Option<Vec<f64>>,

    /// Distance of the positions in the range [default: 0.05].
    #[arg(long, value_name = "DX", allow_hyphen_values = true)]
    pub(crate) spacing: Option<f64>,

    /// Only what the tip has carved, as the surface is left far behind it, (35): without the initial
    /// surface.
    #[arg(long)]
    pub(crate) far_behind: bool,

    /// File to write: .json, .csv (`t,x,u`) or .npz; `-` is JSON on standard output.
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    pub(crate) output: PathBuf,

    /// Draw the surfaces to this .svg or .png.
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  stickslip surface run.json --at 457 --range 400,460 --spacing 0.02 -o surface.csv
  stickslip surface run.json --at 100,200,457 --plot surface.png
  stickslip run --alpha 1.2 --r 1 --kick 0.05 --until 80 | stickslip surface - --x 60,60.5,61";
