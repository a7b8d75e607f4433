//! Disturbances of a run, read from files and checked.

use crate::arguments::DisturbanceArguments;
use crate::commands::ask::context;
use crate::failure::{Failure, Typed};
use crate::files::columns::{read_columns, read_profile};
use crate::files::distinct::Named;
use crate::session::Session;
use std::path::Path;
use stickslip::{
    Ask, ForceTable, KnownScales, Noise, Profile, Run, RunScenario, SupportPathParameters,
};
use stickslip_tip::Pulse;

/// A run with the noise, surface, forces and path from options and files, resolved, and its scenario. Warns of forces
/// that do not act in it.
///
/// # Errors
/// A file cannot be read, a pulse is invalid, or the parameters define no run; `refused` converts the last of these errors.
pub(crate) fn disturbed(
    session: &Session,
    run: Run,
    (arguments, support_path): (&DisturbanceArguments, Option<&Path>),
    scales: Option<&KnownScales>,
    refused: impl Fn(stickslip::Failure) -> Failure,
) -> Result<(Run, RunScenario), Failure> {
    let run = with_files(session, run, arguments, support_path, scales)?;
    let run = run.resolved(&context(session)).map_err(&refused)?;
    let scenario = run.prepared().map_err(refused)?;
    warn_of_idle(session, arguments, &run, scenario.span());
    Ok((run, scenario))
}

fn with_files(
    session: &Session,
    mut run: Run,
    arguments: &DisturbanceArguments,
    support_path: Option<&Path>,
    scales: Option<&KnownScales>,
) -> Result<Run, Failure> {
    if let Some(path) = &arguments.initial_surface {
        let (x, u) = read_profile(session, "--initial-surface", path, scales)?;
        run.initial_surface = Some(Profile { x, u });
    }
    if let Some(path) = &arguments.force_file {
        let (t, force) = read_columns(session, "--force-file", path, "t,force", scales)?;
        run.force = Some(ForceTable { t, force });
    }
    if let Some(path) = support_path {
        let (t, displacement) = read_columns(session, "--support-path", path, "t,R", scales)?;
        run.support_path = Some(SupportPathParameters { t, displacement });
    }
    if !arguments.pulse.is_empty() {
        run.pulses = parse_pulses(&arguments.pulse)?;
    }
    if let Some(amplitude) = arguments.noise {
        let spacing = arguments.noise_spacing.unwrap_or(Noise::SPACING);
        let seed = arguments.seed.unwrap_or(Noise::SEED);
        run.noise = Some(Noise { amplitude, spacing, seed });
    } else if let Some(name) = arguments.of_noise() {
        return Err(Failure::input(name, "has no effect without noise: give --noise too"));
    }
    Ok(run)
}

/// The input files of a run with disturbances, which must not be overwritten.
pub(crate) fn files_read<'a>(
    tip_file: Option<&'a Path>,
    disturbance: &'a DisturbanceArguments,
    support_path: Option<&'a Path>,
) -> [Named<'a>; 4] {
    [
        ("--tip-file", tip_file),
        ("--initial-surface", disturbance.initial_surface.as_deref()),
        ("--force-file", disturbance.force_file.as_deref()),
        ("--support-path", support_path),
    ]
}

/// Distance from the centre of a pulse, in widths, beyond which its force is round-off: exp(-9²/2) = 3e-18.
const WIDTHS_FELT: f64 = 9.0;

/// Distance before the centre of a pulse, in widths, up to which a thousandth of its impulse has acted.
const WIDTHS_CUT: f64 = 3.09;

/// Warns of each force that ends before the motion begins, begins after it has ended, or has begun already when the
/// motion begins. It is not an error, because runs of several lengths may share their forces.
fn warn_of_idle(session: &Session, arguments: &DisturbanceArguments, run: &Run, span: (f64, f64)) {
    warn_of_pulses_outside(session, &arguments.pulse, &run.pulses, span);
    let (Some(path), Some(table)) = (&arguments.force_file, &run.force) else { return };
    let (Some(first), Some(last)) = (table.t.first(), table.t.last()) else { return };
    let mut rows = table.t.iter().zip(&table.force);
    let whole_from = rows.find(|(_, force)| force.abs() > 0.0).map_or(*last, |(t, _)| *t);
    let acts = Acts { ends: (*first, *last), core: *first, whole_from, least_time: None };
    acts.warn(session, &format!("--force-file {}", path.display()), span);
}

/// The same for pulses alone, as typed and as parsed.
pub(crate) fn warn_of_pulses_outside(
    session: &Session,
    texts: &[String],
    pulses: &[Pulse],
    span: (f64, f64),
) {
    for (text, pulse) in texts.iter().zip(pulses) {
        let Pulse { time, width, .. } = *pulse;
        let half = WIDTHS_FELT * width;
        let acts = Acts {
            ends: (time - half, time + half),
            core: time,
            whole_from: time - WIDTHS_CUT * width,
            least_time: Some(span.0 + WIDTHS_CUT * width),
        };
        acts.warn(session, &format!("--pulse {text}"), span);
    }
}

/// Times at which a force acts.
struct Acts {
    /// First and last time.
    ends: (f64, f64),
    /// The time that a run needs to reach.
    core: f64,
    /// A motion that begins later lacks a part of the force.
    whole_from: f64,
    /// The least centre T at which the pulse acts as a whole; `None` for a table.
    least_time: Option<f64>,
}

impl Acts {
    /// Warns if the force acts outside of this span, or in part.
    fn warn(&self, session: &Session, option: &str, (start, until): (f64, f64)) {
        let said = if self.ends.0 >= until {
            let (until, after) = (Typed(until), Typed(self.core));
            format!(
                "has no effect: it comes after the end at t = {until}: give an --until above {after}"
            )
        } else if self.ends.1 <= start {
            format!(
                "has no effect: it is over before the start at t = {}: give a later time",
                Typed(start)
            )
        } else if self.whole_from < start {
            let later = self.least_time.map_or("later times".into(), |least| {
                format!("a time of at least {}", Typed((100.0 * least).ceil() / 100.0))
            });
            format!(
                "begins before the start at t = {}, and that part of it is left out: give {later}",
                Typed(start)
            )
        } else {
            return;
        };
        session.remark(format_args!("stickslip: {option} {said}"));
    }
}

/// All values of `--pulse`.
pub(crate) fn parse_pulses(texts: &[String]) -> Result<Vec<Pulse>, Failure> {
    texts.iter().map(|text| parse_pulse(text)).collect()
}

/// A, T and W of one `--pulse`.
fn parse_pulse(text: &str) -> Result<Pulse, Failure> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[amplitude, time, width])
            if amplitude.is_finite() && time.is_finite() && width.is_finite() && width > 0.0 =>
        {
            Ok(Pulse { amplitude, time, width })
        }
        _ => Err(Failure::input(
            format!("--pulse {text}"),
            "needs three finite numbers A,T,W: amplitude, time and width, the width above 0, such as \
             --pulse 2,30,0.5",
        )),
    }
}
