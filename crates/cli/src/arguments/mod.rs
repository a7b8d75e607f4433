//! The command line. Arguments are only parsed here; values are checked where they are used.

mod boundary;
mod brief;
mod compare;
mod continuation;
mod cycle;
mod disturbance;
mod figures;
mod fit;
mod friction;
mod model;
mod named;
mod outlet;
mod plot;
mod question;
mod range;
mod raster;
mod raster_sweep;
mod response;
mod run;
mod shard;
mod stability;
mod surface;
mod sweep;
mod tip;
mod units;
mod verify;

pub(crate) use boundary::BoundaryArguments;
pub(crate) use compare::CompareArguments;
pub(crate) use continuation::ContinueArguments;
pub(crate) use cycle::CycleArguments;
pub(crate) use disturbance::DisturbanceArguments;
pub(crate) use figures::{FigureName, FiguresArguments};
pub(crate) use fit::FitArguments;
pub(crate) use friction::FrictionArguments;
pub(crate) use model::{Length, TipArguments};
pub(crate) use outlet::AnswerArguments;
pub(crate) use outlet::InUnitsArguments;
pub(crate) use outlet::{FieldArguments, Format, OutletArguments};
pub(crate) use plot::PlotArguments;
pub(crate) use question::{Either, Given, Options, Questions};
pub(crate) use range::{Interval, Range};
pub(crate) use raster::{AreaArguments, RasterArguments};
pub(crate) use raster_sweep::RasterSweepArguments;
pub(crate) use response::ResponseArguments;
pub(crate) use run::{HistoryName, RunArguments};
pub(crate) use shard::WorkArguments;
pub(crate) use stability::StabilityArguments;
pub(crate) use surface::SurfaceArguments;
pub(crate) use sweep::{MergeArguments, SweepArguments, SweepThen};
pub(crate) use tip::MeasuredTipArguments;
pub(crate) use units::UnitsArguments;
pub(crate) use verify::VerifyArguments;

use brief::without_help;
use clap::builder::PossibleValuesParser;
use clap::error::ErrorKind;
use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use std::ffi::OsString;
use stickslip::{SCHEMAS, Software};

/// Stick-slip of an AFM tip on a soft surface, from one closed delay equation.
///
/// A tip dragged over a soft surface carves a groove, which pulls back on the tip: above a critical indentation rate
/// the tip sticks, slips and writes ripples. All quantities are dimensionless: lengths in tip widths σ, times in Γ/k,
/// forces in kσ, heights in kσ²/a; --units, or --sigma and related options, report results in nm, s and nN.
#[derive(Debug, Parser)]
#[command(name = "stickslip", version, long_version = Software::BUILD, after_help = EXAMPLES)]
pub(crate) struct Cli {
    /// Print only errors: no progress, no warnings, no summary.
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,

    #[command(subcommand)]
    pub(crate) command: Command,
}

impl Cli {
    /// Reads a command line.
    ///
    /// # Errors
    /// An invalid command line, or a request for help or the version.
    pub(crate) fn read(words: &[OsString]) -> Result<Self, clap::Error> {
        match without_help(|| Self::try_parse_from(words)) {
            Err(error) if error.kind() == ErrorKind::DisplayHelp => Self::try_parse_from(words),
            read => read,
        }
    }
}

/// The output of a call without arguments.
pub(crate) const FIRST_SCREEN: &str = "\
stickslip: stick-slip of an AFM tip on a soft surface, from one closed delay equation

To begin with:
  stickslip stability --r 1
      the critical indentation rate, where stick-slip sets in
  stickslip run --alpha 1.2 --r 1 --kick 0.05 --until 100 -o run.json --plot run.svg
      the motion of the tip, its regime, and a picture
  stickslip surface run.json --at 100 --range 0:110 --spacing 0.1 -o surface.csv
      the surface that the tip has left
  stickslip cycle --alpha 1.2 --r 1
      the periodic motion: period, amplitude, stability
  stickslip sweep --r 1 --alpha 0.5:3:11
      the regime at each of several points

stickslip --help           all commands, with examples
stickslip COMMAND --help   the options of one";

const EXAMPLES: &str = "Examples:
  stickslip run --alpha-above 0.01 --r 1 --kick 0.01 --until 457 \\
        -o run.json --plot run.svg
  stickslip verify run.json
  stickslip surface run.json --at 457 --range -5:460 --spacing 0.02 \\
        -o surface.csv
  stickslip stability --r 1
  stickslip boundary --r-range 0.05:3:200 -o boundary.csv \\
        --plot boundary.svg
  stickslip response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60 \\
        -o response.csv
  stickslip compare --alpha 1.2 --r 1 --kick 0.05 --until 76
  stickslip cycle --alpha 1.2 --r 1 -o cycle.json --plot cycle.svg
  stickslip continue --r 1 --over alpha --to 1.88 --switch -o branches.json \\
        --plot branches.svg
  stickslip sweep --r 0.1:2:40 --alpha 0.05:4:40 -o map.json --plot map.svg
  stickslip raster --tip gaussian --alpha 0.45 --r 1 --pitch 0.5 \\
        --lines 256 --length 60 -o raster.json --plot raster.png
  stickslip tip measured.csv -o tip.json --plot tip.svg
  stickslip fit --ripple ripples.csv --tip-file tip.json -o fit.json \\
        --plot fit.svg
  stickslip friction trace.csv retrace.csv -o friction.json \\
        --plot friction.svg
  stickslip units --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm \\
        --slope-force 5nN --indentation-rate 200nm/s --velocity 1um/s
  stickslip plot run.json -o run.pdf --width 85mm
  stickslip figures --out-dir figures
  stickslip schema run
  stickslip completions bash

`stickslip COMMAND --help` explains each command and gives examples.";

/// The commands, each with its line in the list of commands; the rest of a command is built when it is needed.
#[derive(Debug, Subcommand)]
#[command(defer = true)]
pub(crate) enum Command {
    /// Integrate the motion of the tip and classify the result.
    Run(Box<RunArguments>),
    /// Check a saved run.
    Verify(VerifyArguments),
    /// Reconstruct the surface from a run or a raster.
    Surface(SurfaceArguments),
    /// Compute the critical point of steady motion, and all growth exponents.
    Stability(StabilityArguments),
    /// Compute the critical α against r, or of a raster against the pitch.
    Boundary(BoundaryArguments),
    /// Compare the closed equation with the full equations on a grid.
    Compare(Box<CompareArguments>),
    /// Compute the linear response of steady motion to weak pulses.
    Response(ResponseArguments),
    /// Compute the periodic motion at given α and r, and its stability.
    Cycle(CycleArguments),
    /// Follow a branch of cycles in α or r, and find its special points.
    Continue(ContinueArguments),
    /// Find the motion that the tip settles into, over a grid of parameters.
    Sweep(Box<SweepArguments>),
    /// Scan an area line by line, and report the pattern of the lines.
    Raster(Box<RasterArguments>),
    /// Fit a footprint to a measured profile or image.
    Tip(MeasuredTipArguments),
    /// Estimate α, r and σ from measured ripples, images and forces, with 95 % intervals.
    Fit(Box<FitArguments>),
    /// Compute friction forces and work from a loop of lateral force.
    Friction(FrictionArguments),
    /// Convert measured quantities to the numbers of the model, and back.
    Units(UnitsArguments),
    /// Draw a saved document.
    Plot(PlotArguments),
    /// Redraw the paper's figures, and compare its numbers with ours.
    Figures(FiguresArguments),
    /// Print the JSON Schema of a document.
    Schema(SchemaArguments),
    /// Print the completions of the command line for a shell.
    Completions(CompletionsArguments),
}

/// Print the JSON Schema of a document.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  stickslip schema run > run.schema.json")]
pub(crate) struct SchemaArguments {
    /// Kind of document.
    #[arg(value_parser = PossibleValuesParser::new(SCHEMAS.iter().map(|(name, _)| *name)))]
    pub(crate) name: String,
}

/// Print the completions of the command line for a shell.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  bash: stickslip completions bash > ~/.local/share/bash-completion/completions/stickslip
  zsh:  stickslip completions zsh > FOLDER/_stickslip, FOLDER being one of $fpath
  fish: stickslip completions fish > ~/.config/fish/completions/stickslip.fish")]
pub(crate) struct CompletionsArguments {
    /// Shell to complete commands in.
    pub(crate) shell: Shell,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn examples_fit_a_terminal() {
        let mut program = Cli::command();
        program.build();
        let commands = std::iter::once(&program).chain(program.get_subcommands());
        let helps = commands.filter_map(|command| {
            command.get_after_long_help().or(command.get_after_help()).map(ToString::to_string)
        });
        let helps: Vec<String> = helps.collect();
        assert!(helps.len() > 15);
        let lines = helps.iter().flat_map(|help| help.lines());
        for line in lines.filter(|line| line.trim_start().starts_with("stickslip")) {
            assert!(line.chars().count() <= 79, "{line}");
        }
    }
}
