//! Terms sorted into layers, and sums of layers along the path.

use super::{Across, Gaussian2d, Layer};
use crate::sorting::sort_by_number;
use crate::{Gaussian, TipFunction, TipFunctionError};

/// The layers of a sum of two-dimensional Gaussians: one for each width in y and distance of the center from y = 0.
pub(super) fn of(terms: &[Gaussian2d]) -> Result<Vec<Layer>, TipFunctionError> {
    validate(terms)?;
    let mut acrosses: Vec<Across> = vec![];
    for across in terms.iter().map(across_of) {
        if !acrosses.iter().any(|other| same(other, &across)) {
            acrosses.push(across);
        }
    }
    let mut layers = vec![];
    for across in acrosses {
        // One of each pair of twins stands for both: `Across` holds both centers.
        let along: Vec<Gaussian> = terms
            .iter()
            .filter(|term| term.center_y >= 0.0 && same(&across_of(term), &across))
            .map(|t| Gaussian { amplitude: t.amplitude, center: t.center, width: t.width })
            .collect();
        match TipFunction::asymmetric_sum(along) {
            Ok(along) => layers.push(Layer { along, across }),
            // Terms of amplitude 0 make no layer.
            Err(TipFunctionError::Zero) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(layers)
}

fn validate(terms: &[Gaussian2d]) -> Result<(), TipFunctionError> {
    for (i, term) in terms.iter().enumerate() {
        let index = i + 1;
        let numbers = [term.amplitude, term.center, term.width, term.center_y, term.width_y];
        if !numbers.iter().all(|v| v.is_finite()) {
            return Err(TipFunctionError::NotFinite { index });
        }
        if let Some(&width) = [term.width, term.width_y].iter().find(|width| **width <= 0.0) {
            return Err(TipFunctionError::Width { index, width });
        }
    }
    match terms.iter().find(|term| !has_twin_across(terms, term)) {
        None => Ok(()),
        Some(term) => Err(TipFunctionError::NotEvenAcross {
            center: term.center,
            center_y: term.center_y,
            mirror: -term.center_y,
        }),
    }
}

fn across_of(term: &Gaussian2d) -> Across {
    Across { center: term.center_y.abs(), width: term.width_y }
}

fn close(a: f64, b: f64, scale: f64) -> bool {
    (a - b).abs() <= 1e-12 * scale
}

fn same(a: &Across, b: &Across) -> bool {
    close(a.width, b.width, a.width) && close(a.center, b.center, a.width)
}

/// Whether the mirror image of `term` at y = 0 is among `terms` as often as `term` itself, to round-off.
fn has_twin_across(terms: &[Gaussian2d], term: &Gaussian2d) -> bool {
    let total = |center_y: f64| -> f64 {
        terms
            .iter()
            .filter(|g| {
                close(g.center, term.center, term.width)
                    && close(g.width, term.width, term.width)
                    && close(g.width_y, term.width_y, term.width_y)
                    && close(g.center_y, center_y, term.width_y)
            })
            .map(|g| g.amplitude)
            .sum()
    };
    close(total(term.center_y), total(-term.center_y), term.amplitude.abs().max(1e-300))
}

/// The terms of Σ_k g_k(x) `factor`(h_k), those of equal center and width combined: f(x,0) for the factor h(0).
/// Layers that are not Gaussian are omitted.
pub(super) fn combined(layers: &[Layer], factor: impl Fn(&Across) -> f64) -> Vec<Gaussian> {
    let scaled = |layer: &Layer| {
        let TipFunction::Gaussians(sum) = &layer.along else { return vec![] };
        let factor = factor(&layer.across);
        let term = |g: &Gaussian| Gaussian { amplitude: factor * g.amplitude, ..*g };
        sum.terms().iter().map(term).collect()
    };
    let mut all: Vec<Gaussian> = layers.iter().flat_map(scaled).collect();
    sort_by_number(&mut all, |g| g.width);
    sort_by_number(&mut all, |g| g.center);
    let alike = |a: &Gaussian, b: &Gaussian| {
        close(a.center, b.center, a.width) && close(a.width, b.width, a.width)
    };
    let total = |group: &[Gaussian]| Gaussian {
        amplitude: group.iter().map(|g| g.amplitude).sum(),
        ..group[0]
    };
    all.chunk_by(alike).map(total).collect()
}
