//! Doubts about the reported pattern, and their remedies.

use super::regime::Regime;
use std::fmt;

/// A reason why a result is not reported, or may differ after more lines.
#[derive(Debug, Clone, PartialEq)]
pub enum Doubt {
    /// The tip did not leave the pit at one end of some lines.
    Stuck {
        /// Number of these lines.
        lines: usize,
        /// Number of all lines.
        of: usize,
    },
    /// The lines span too small a distance for a wave vector; about this many lines are sufficient.
    FewLines(usize),
    /// The lines are too short for a wave vector; about this length is sufficient, in σ.
    ShortLines(f64),
    /// One line was scanned repeatedly.
    OneLine,
    /// Only a few lines contain the relief.
    FewVisible {
        /// Approximate number of these lines.
        lines: usize,
        /// Whether the others have healed.
        healed: bool,
    },
    /// The relief is not a wave: fewer than two wavelengths fit. Lines of about this length would show more.
    NoWave(f64),
    /// The surface still changes: the relief of the second half of the evaluated lines over that of the first half.
    Changing(f64),
    /// The surface is steady so far, but differences between lines grow by a factor per line.
    Growing {
        /// Factor per line, above 1.
        factor: f64,
        /// Approximate total number of lines after which ripples would be visible.
        lines: usize,
    },
    /// A measure is, within its error, at the boundary between the reported regime and another, the second one.
    Between(Regime, Regime),
    /// Waves with at least half the power of the strongest, wavelength in σ and crest angle in degrees.
    Rivals(Vec<(f64, f64)>),
    /// Neighbouring lines are in antiphase, κ = ±π/pitch: the sign of κ is not defined.
    Antiphase,
    /// The error of the angle is too large to report it; about this many lines are sufficient.
    Unresolved {
        /// Error (95 %), in degrees.
        error: f64,
        /// Total number of lines.
        lines: usize,
    },
    /// The error of the angle of trenches is too large to report it; lines of about this length are sufficient.
    ShortTrenches {
        /// Error (95 %), in degrees.
        error: f64,
        /// Length of the lines, in σ.
        length: f64,
    },
    /// The relative error of the wavelength is too large to report it.
    Unmeasured(f64),
}

impl fmt::Display for Doubt {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stuck { lines, of } => {
                write!(out, "on {lines} of {of} lines the tip did not leave the pit at an end of them")
            }
            Self::FewLines(lines) => {
                write!(out, "too few lines for a pattern: {lines} would be enough")
            }
            Self::ShortLines(length) => {
                write!(out, "the lines are too short for a pattern: {length:.0} σ would be enough")
            }
            Self::OneLine => out.write_str("a single line, or one scanned again and again, has no pattern"),
            Self::FewVisible { lines, healed } => {
                let others = if *healed { "the others have healed" } else { "others are flat" };
                write!(
                    out,
                    "only about {lines} lines hold the relief ({others}): too few for a pattern"
                )
            }
            Self::NoWave(length) => write!(
                out,
                "the relief along the lines is no wave: fewer than two fit between the edges; lines of about \
                 {length:.0} σ would show whether it fades"
            ),
            Self::Changing(factor) => write!(
                out,
                "the surface still changes from line to line (relief of the second half of the examined lines over \
                 that of the first: {factor:.2}): regime and wavelength may differ after more lines"
            ),
            Self::Growing { factor, lines } => write!(
                out,
                "the differences between lines still grow, by a factor of {factor:.3} from line to line: ripples may \
                 appear after about {lines} lines"
            ),
            Self::Between(here, other) => {
                write!(out, "the surface lies on the boundary between {here} and {other}")
            }
            Self::Rivals(waves) => {
                let wave = |(length, angle): &(f64, f64)| format!("{length:.2} σ at {angle:.0}°");
                let waves: Vec<String> = waves.iter().take(4).map(wave).collect();
                write!(
                    out,
                    "several waves are about as strong as each other: {}",
                    waves.join(", ")
                )
            }
            Self::Antiphase => out.write_str(
                "neighbouring lines are in antiphase (κ = ±π/pitch): the sign of κ, and with it the crest angle, is undefined",
            ),
            Self::Unresolved { error, lines } => write!(
                out,
                "the crest angle is uncertain by ±{:.0}°: about {lines} lines would resolve it if the crests are straight",
                error.min(90.0)
            ),
            Self::ShortTrenches { error, length } => write!(
                out,
                "the angle of the trenches is uncertain by ±{:.0}°: lines of about {:.0} σ would resolve it if the trenches are \
                 straight",
                error.min(90.0),
                length
            ),
            Self::Unmeasured(part) if *part < 1.0 => write!(
                out,
                "the wavelength is uncertain by ±{:.0} %: longer or more lines would resolve it if it is the same everywhere",
                100.0 * part
            ),
            Self::Unmeasured(_) => out.write_str("the wavelength differs from place to place"),
        }
    }
}
