//! Figures as data, from documents.

mod axes;
mod boundary;
#[cfg(feature = "animation")]
mod carving;
mod compare;
mod continuation;
mod cycle;
mod dense;
mod drawn;
mod fit;
mod fit_image;
mod friction;
#[cfg(feature = "animation")]
mod growing;
mod in_units;
mod load_map;
mod measured_tip;
mod plane;
mod quantity;
mod raster;
mod raster_stability;
mod raster_sweep;
mod response;
mod run;
mod snaking;
mod stability;
mod surface;
mod sweep;
mod tip;
mod walker;
#[cfg(feature = "animation")]
mod wandering;

use crate::axis::can_be_drawn;
use crate::error::FigureError;
#[cfg(feature = "animation")]
use crate::scene::{Scene, Shot};
#[cfg(feature = "animation")]
use in_units::InUnits;
use in_units::{in_units, judge_ranges, view_in_model_units};
use stickslip::{
    BoundaryDocument, Failure, FigureDocument, KnownScales, PanelDocument, Tabular, Unusable,
};

pub use drawn::{Drawn, View};
pub use sweep::judge_sweep;

/// The figure of a document; in nm, s and nN if the view or the document contains the scales of an experiment. Ranges
/// are in the units of the axes.
///
/// # Errors
/// The document is damaged, or contains nothing to draw.
pub fn of<D: Drawn + ?Sized>(document: &D, view: &View) -> Result<FigureDocument, FigureError> {
    let (known, mut view) = (known(view.scales, document), *view);
    if let Some(scales) = &known
        && view.x_range.or(view.y_range).is_some()
    {
        let whole = shown(document, &View::default())?;
        view = whole.panels.first().map_or(view, |first| view_in_model_units(first, scales, &view));
    }
    let figure = in_units(shown(document, &view)?, known.as_ref());
    figure.panels.first().map_or(Ok(()), |first| judge_ranges(first, &view))?;
    Ok(figure)
}

/// The motion in a document; in nm, s and nN if the shot or the document contains the scales of an experiment.
///
/// # Errors
/// The document is damaged, contains no motion, or none at the requested times.
#[cfg(feature = "animation")]
pub fn scene_of<D: Drawn + ?Sized>(
    document: &D,
    shot: &Shot,
) -> Result<Box<dyn Scene>, FigureError> {
    let known = known(shot.scales, document);
    let times = match (shot.times, &known) {
        (Some(times), Some(scales)) => Some(in_units::times_of(times, scales)),
        (times, _) => times,
    };
    let scene = document.scene(&Shot { times, ..*shot })?;
    Ok(Box::new(InUnits::new(scene, known)))
}

/// The scales of an experiment: as requested, or those of the document.
fn known<D: Tabular + ?Sized>(wanted: Option<KnownScales>, document: &D) -> Option<KnownScales> {
    wanted.or_else(|| document.physical().map(|physical| physical.scales))
}

/// The figure in the model's units.
fn shown<D: Drawn + ?Sized>(document: &D, view: &View) -> Result<FigureDocument, FigureError> {
    let mut figure = document.figure(view)?;
    figure.panels.iter().try_for_each(judge)?;
    let Some(first) = figure.panels.first() else {
        return Err(FigureError::Nothing("there is nothing to draw".into()));
    };
    let (x, y) = ((first.x_label.clone(), first.x_range), (first.y_label.clone(), first.y_range));
    for panel in &mut figure.panels {
        // One that shows a part of its own goes on to do so.
        if (&panel.x_label, panel.x_range) == (&x.0, x.1) && view.x_range.is_some() {
            panel.x_range = view.x_range;
        }
        if (&panel.y_label, panel.y_range) == (&y.0, y.1) && view.y_range.is_some() {
            panel.y_range = view.y_range;
        }
    }
    Ok(figure)
}

/// Rejects grids whose size differs from that of their axes.
fn judge(panel: &PanelDocument) -> Result<(), FigureError> {
    let fits = |x: &[f64], y: &[f64], rows: &[usize]| {
        rows.len() == y.len() && rows.iter().all(|row| *row == x.len())
    };
    let map = panel.map.as_ref().is_none_or(|map| {
        let rows: Vec<usize> = map.z.iter().map(Vec::len).collect();
        !map.x.is_empty() && !map.y.is_empty() && fits(&map.x, &map.y, &rows)
    });
    let cells = panel.cells.as_ref().is_none_or(|cells| {
        let rows: Vec<usize> = cells.kinds.iter().map(Vec::len).collect();
        fits(&cells.x, &cells.y, &rows)
    });
    if map && cells {
        return Ok(());
    }
    Err(FigureError::Damaged("a map has not as many rows and columns as its axes".into()))
}

/// Figure of the oscillation along a boundary; in physical units if the view or the document contains the scales of
/// an experiment.
///
/// # Errors
/// The document is damaged, or contains no onset.
pub fn onset_of(document: &BoundaryDocument, view: &View) -> Result<FigureDocument, FigureError> {
    Ok(in_units(boundary::onset_of(document)?, known(view.scales, document).as_ref()))
}

impl Drawn for FigureDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let mut ranges = self.panels.iter().flat_map(|panel| [panel.x_range, panel.y_range]);
        match ranges.find_map(|range| range.filter(|range| !can_be_drawn(*range))) {
            None => Ok(self.clone()),
            Some([low, high]) => {
                Err(FigureError::Damaged(format!("no axis goes from {low:e} to {high:e}")))
            }
        }
    }
}

impl From<Unusable> for FigureError {
    fn from(error: Unusable) -> Self {
        Self::Damaged(error.to_string())
    }
}

impl From<Failure> for FigureError {
    fn from(failure: Failure) -> Self {
        Unusable::from(failure).into()
    }
}
