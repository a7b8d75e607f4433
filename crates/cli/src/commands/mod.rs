//! One file or folder per command, and [the list of them](carried_out).

mod ask;
mod boundary;
mod compare;
mod completions;
mod continuation;
mod cycle;
mod figures;
mod fit;
mod friction;
pub(crate) mod model;
mod plot;
pub(crate) mod quantities;
pub(crate) mod raster;
mod response;
pub(crate) mod run;
mod schema;
mod stability;
pub(crate) mod surface;
pub(crate) mod sweep;
mod tip;
mod units;
mod verify;

pub(crate) mod fields;
mod figure;
mod finished;
mod fit_image;
mod in_units;
mod job;
mod progress;
mod summary;

use crate::arguments::Command;
use crate::failure::Failure;
use crate::session::Session;

/// Carries out a command.
pub(crate) fn carried_out(session: &Session, command: &Command) -> Result<(), Failure> {
    match command {
        Command::Run(arguments) => run::run(session, arguments),
        Command::Verify(arguments) => verify::verify(session, arguments),
        Command::Surface(arguments) => surface::surface(session, arguments),
        Command::Stability(arguments) => stability::stability(session, arguments),
        Command::Boundary(arguments) => boundary::boundary(session, arguments),
        Command::Compare(arguments) => compare::compare(session, arguments),
        Command::Response(arguments) => response::response(session, arguments),
        Command::Cycle(arguments) => cycle::cycle(session, arguments),
        Command::Continue(arguments) => continuation::follow(session, arguments),
        Command::Sweep(arguments) => sweep::sweep(session, arguments),
        Command::Raster(arguments) => raster::raster(session, arguments),
        Command::Tip(arguments) => tip::measured_tip(session, arguments),
        Command::Fit(arguments) => fit::fit(session, arguments),
        Command::Friction(arguments) => friction::friction(session, arguments),
        Command::Units(arguments) => units::units(session, arguments),
        Command::Plot(arguments) => plot::plot(session, arguments),
        Command::Figures(arguments) => figures::figures(session, arguments),
        Command::Schema(arguments) => schema::schema(arguments),
        Command::Completions(arguments) => completions::completions(arguments),
    }
}
