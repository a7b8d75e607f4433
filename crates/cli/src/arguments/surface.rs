//! `stickslip surface`.

use super::brief::Brief;
use super::{FieldArguments, Format, InUnitsArguments, Interval};
use clap::Args;
use std::path::PathBuf;

/// Reconstruct the surface u(x,t) from a run, or u(x,y) from a raster.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, brief())]
pub(crate) struct SurfaceArguments {
    /// Document of `stickslip run` or `stickslip raster`; `-` is standard input.
    #[arg(value_name = "RUN.json")]
    pub(crate) run: PathBuf,

    /// Times within the run, in Γ/k [default: its end].
    #[arg(long, value_name = "T1,T2,…", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) at: Option<Vec<f64>>,

    /// Positions, in σ.
    #[arg(long, value_name = "X1,X2,…", value_delimiter = ',', allow_hyphen_values = true, conflicts_with_all = ["range", "spacing"])]
    pub(crate) x: Option<Vec<f64>>,

    /// First and last position, in σ, and the number of positions [default: from 12 behind the start of the tip to 12
    /// ahead of its end].
    #[arg(long, value_name = "LO:HI:N", allow_hyphen_values = true)]
    pub(crate) range: Option<Interval>,

    /// Distance of the positions, in σ, if the range contains no number of positions [default: 0.05].
    #[arg(long, value_name = "DX", allow_hyphen_values = true)]
    pub(crate) spacing: Option<f64>,

    /// First and last position across the path, in σ, and the number of positions: images u(x,y,t) instead of curves
    /// u(x,t).
    #[arg(
        long,
        value_name = "LO:HI:N",
        allow_hyphen_values = true,
        help_heading = "Three dimensions"
    )]
    pub(crate) y_range: Option<Interval>,

    /// Positions across the lines of a raster, in σ [default: those of the lines].
    #[arg(
        long,
        value_name = "Y1,Y2,…",
        value_delimiter = ',',
        allow_hyphen_values = true,
        conflicts_with = "y_range",
        help_heading = "Three dimensions"
    )]
    pub(crate) y: Option<Vec<f64>>,

    /// Distance of the positions across the path [default: that of --spacing].
    #[arg(
        long,
        value_name = "DY",
        requires = "y_range",
        allow_hyphen_values = true,
        help_heading = "Three dimensions"
    )]
    pub(crate) spacing_y: Option<f64>,

    /// V in f(x,y) = f(x) exp(-y²/(2 V²)), for a run whose tip file had no f(x,y) [default: the width of the tip's
    /// Gaussians].
    #[arg(
        long,
        value_name = "V",
        requires = "y_range",
        allow_hyphen_values = true,
        help_heading = "Three dimensions"
    )]
    pub(crate) width_y: Option<f64>,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    /// Only the groove far behind the tip, (35), without the initial surface.
    #[arg(long)]
    pub(crate) far_behind: bool,

    /// File to write: .json, .csv (`t,x,u` or `t,x,y,u`), .npz, or .gsf (Gwyddion, one image of up to 1e9 points); `-` is
    /// standard output.
    #[arg(short, long, value_name = "FILE", default_value = "-", help_heading = "Output")]
    pub(crate) output: PathBuf,

    /// Output format, independent of the file name [default: by its extension; on standard output text for a
    /// terminal, else json].
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = "Output")]
    pub(crate) format: Option<Format>,

    #[command(flatten)]
    pub(crate) fields: FieldArguments,

    /// Draw the surfaces to this .svg, .png or .pdf; images as height maps with a colour bar.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  stickslip surface run.json --at 457 --range 400:460 --spacing 0.02 \\
        -o surface.csv
  stickslip surface run.json --at 100,200,457 --plot surface.png
  An image for Gwyddion, and a height map of the same:
    stickslip surface run.json --range 400:450 --y-range -2:2 \\
        --spacing 0.025 -o image.gsf --plot map.png
  In nm, by a document of `stickslip units`; and the same surface as the initial one of another run:
    stickslip surface run.json --units units.json -o surface.csv
    stickslip run --alpha 1.2 --r 1 --start flat \\
        --initial-surface surface.csv --units units.json --until 60
  Profiles of a raster along two lines, and an image of it:
    stickslip surface raster.json --range 0:60 --spacing 0.1 --y 10,10.25 \\
        -o profiles.csv
    stickslip surface raster.json --range 0:60 --y-range 0:128 \\
        --spacing 0.25 -o image.gsf
  Piped:
    stickslip run --alpha 1.2 --r 1 --kick 0.05 \\
        --until 80 | stickslip surface - --x 60,60.5,61";
