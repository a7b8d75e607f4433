//! Animations of `stickslip plot`.

use crate::arguments::PlotArguments;
use crate::commands::figure::drawing_failure;
use crate::commands::in_units::scales;
use crate::commands::plot::{OPTION, range, read_drawn, undrawn, width};
use crate::failure::Failure;
use crate::files::distinct::distinct;
use crate::files::output::Output;
use crate::session::Session;
use stickslip_figures::{self as figures, AnimationFormat, Drawn, FigureError, Film, Shot};

pub(super) fn write(
    session: &Session,
    arguments: &PlotArguments,
    format: AnimationFormat,
) -> Result<(), Failure> {
    refuse_options_of_pictures(arguments)?;
    let film = film(arguments)?;
    let times = range("--times", arguments.times.as_deref())?;
    let units = ("--units", arguments.in_units.units.as_deref());
    let read = [(OPTION, Some(&*arguments.document)), units];
    distinct(&[("--output", Some(&*arguments.output))], &read)?;
    let output = Output::open("--output", &arguments.output)?;
    let document = read_drawn(session, &arguments.document)?;
    let document = document.drawn();
    let scales = scales(session, &arguments.in_units, None, one_r(arguments, document))?;
    let known = scales.or_else(|| document.physical().map(|physical| physical.scales));
    let unit = if known.is_some_and(|known| known.time.is_some()) { "s" } else { "Γ/k" };
    if let Some((_, Some(given))) =
        times.filter(|(_, given)| given.is_some_and(|given| given != unit))
    {
        return Err(drawing_failure(&FigureError::Unit(given, format!("of times in {unit}"))));
    }
    let shot = Shot { times: times.map(|(times, _)| times), scales };
    let failed = |error| undrawn(&arguments.document, &error);
    let mut scene = figures::scene_of(document, &shot).map_err(failed)?;
    output.write_bytes(&figures::animate(&mut *scene, format, &film).map_err(failed)?)
}

/// r, from which the scale of time follows if the velocity of the support is given.
fn one_r(arguments: &PlotArguments, document: &dyn Drawn) -> Option<f64> {
    arguments.in_units.velocity.as_ref()?;
    figures::scene_of(document, &Shot::default()).ok()?.still().one_r()
}

fn film(arguments: &PlotArguments) -> Result<Film, Failure> {
    let given = |name: &str, value: Option<f64>| value.map(|value| format!("{name} {value}"));
    let options = [given("--seconds", arguments.seconds), given("--fps", arguments.fps)];
    let options: Vec<String> = options.into_iter().flatten().collect();
    Film::new(arguments.seconds, arguments.fps, width(arguments)?)
        .map_err(|error| Failure::input(options.join(" "), error))
}

fn refuse_options_of_pictures(arguments: &PlotArguments) -> Result<(), Failure> {
    let given = [
        ("--x-range", arguments.x_range.is_some(), "use --times LO:HI"),
        ("--y-range", arguments.y_range.is_some(), "leave it out"),
        ("--dpi", arguments.dpi.is_some(), "use --width, in pixels"),
        ("--onset", arguments.onset, "leave it out"),
    ];
    match given.into_iter().find(|(_, given, _)| *given) {
        Some((option, _, remedy)) => {
            Err(Failure::input(option, format!("has no meaning for an animation: {remedy}")))
        }
        None => Ok(()),
    }
}
