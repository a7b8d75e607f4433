//! The parameters of the page's questions: names, descriptions with unit and range, and defaults.

use serde::Serialize;
use serde_json::Value;
use stickslip::parameter::{Parameter, parameters};
use stickslip::{Raster, Run, Walker};

/// A parameter, for a slider.
#[derive(Serialize)]
struct Declared {
    name: &'static str,
    description: &'static str,
    default: Option<Value>,
}

/// The parameters of all questions that have sliders.
#[derive(Serialize)]
pub(crate) struct Questions {
    run: Vec<Declared>,
    raster: Vec<Declared>,
    walker: Vec<Declared>,
}

fn declared(all: &'static [Parameter]) -> Vec<Declared> {
    let of = |one: &'static Parameter| Declared {
        name: one.name,
        description: one.description,
        default: one.default_value(),
    };
    all.iter().map(of).collect()
}

pub(crate) fn questions() -> Questions {
    Questions {
        run: declared(parameters::<Run>()),
        raster: declared(parameters::<Raster>()),
        walker: declared(parameters::<Walker>()),
    }
}
