//! `stickslip plot`.

use super::InUnitsArguments;
use clap::Args;
use std::path::PathBuf;

/// Draw a saved document: a run, a surface, a cycle, a sweep, or any other JSON output that has a picture.
///
/// The picture is that of the command's own `--plot`, with a width, a resolution and axes of your choice. A name that
/// ends in .gif, .webp or .apng makes an animation of a run or a raster. The tip carves the surface, seen from above if it
/// moves across the scan; a raster grows line by line. The first frame shows the end of the motion.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct PlotArguments {
    /// The document, JSON; `-` for standard input.
    #[arg(value_name = "DOCUMENT.json")]
    pub(crate) document: PathBuf,

    /// The picture: .svg, .png or .pdf; or an animation: .gif, .webp or .apng.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,

    /// Width of the picture with its unit: 85mm on paper, 600px on a screen [default: 900px; of an animation 640px]
    ///
    /// On paper letters have 7 to 9 points for any width. A width in pixels is also that of a PNG.
    #[arg(long, value_name = "WIDTH")]
    pub(crate) width: Option<String>,

    /// Pixels per inch of a PNG [default: 288; for a width in pixels 144]
    #[arg(long, value_name = "N")]
    pub(crate) dpi: Option<f64>,

    /// Abscissas shown, LO:HI, of the first panel and of all panels with the same axis, in its unit. A run is drawn
    /// from its history, with the resolution that the range requires.
    #[arg(long, value_name = "LO:HI", allow_hyphen_values = true)]
    pub(crate) x_range: Option<String>,

    /// Ordinates shown, LO:HI, of the first panel and of all panels with the same axis.
    #[arg(long, value_name = "LO:HI", allow_hyphen_values = true)]
    pub(crate) y_range: Option<String>,

    /// First and last time of an animation, LO:HI, in the unit of its time axis; for a raster, from the start of the scan
    /// [default: the last ripples of a run, all of a raster]
    #[arg(long, value_name = "LO:HI", allow_hyphen_values = true)]
    pub(crate) times: Option<String>,

    /// Duration of an animation in seconds [default: 10]
    #[arg(long, value_name = "S")]
    pub(crate) seconds: Option<f64>,

    /// Frames per second of an animation [default: 20]
    #[arg(long, value_name = "N")]
    pub(crate) fps: Option<f64>,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    /// For a boundary, draw the oscillation at onset, as `boundary --plot-onset` does.
    #[arg(long)]
    pub(crate) onset: bool,
}

const EXAMPLES: &str = "Examples:
  stickslip plot run.json -o run.pdf --width 85mm
  stickslip plot run.json -o slips.png --x-range 400:420 --dpi 300
  stickslip plot run.json -o run.svg --sigma 30nm --stiffness 0.2N/m \\
        --velocity 1um/s --slope-force 5nN
  stickslip plot boundary.json --onset -o criticality.svg
  stickslip plot run.json -o carving.gif --times 400:440 --seconds 8";
