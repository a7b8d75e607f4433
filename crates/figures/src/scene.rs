//! Moving pictures as data: axes that stay, and their content at any time.

use crate::error::FigureError;
use stickslip::{FigureDocument, KnownScales, PanelDocument};

/// Options of an animation, in addition to its document.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shot {
    /// First and last time shown, in Γ/k, or in the unit of the time axis if scales are known; for a raster, from the
    /// start of the scan. By default the last ripples of a run, and all of a raster.
    pub times: Option<[f64; 2]>,
    /// Scales for axes in nm, s and nN; by default those of the document, if it has any.
    pub scales: Option<KnownScales>,
}

/// Axes, and their content as a function of time.
pub trait Scene {
    /// The axes with everything that does not move: a panel with the surface, and others.
    fn still(&self) -> FigureDocument;

    /// First and last time.
    fn times(&self) -> [f64; 2];

    /// The content at a time between the first and the last, cheapest in ascending order.
    ///
    /// # Errors
    /// The document is damaged.
    fn moment(&mut self, t: f64) -> Result<Moment, FigureError>;
}

/// The content of a scene at one time.
#[derive(Debug, Clone)]
pub struct Moment {
    /// Time, in the unit of the time axis.
    pub t: f64,
    /// Unit of `t`.
    pub unit: String,
    /// A text beside the time; may be empty.
    pub note: String,
    /// For each panel of the still figure, in its units: curves and maps that move. The first curve of the first
    /// panel is the surface, unless that panel has a map.
    pub panels: Vec<PanelDocument>,
    /// Position of the tip in the first panel.
    pub tip: (f64, f64),
    /// Position of the support in the first panel, if there is a spring.
    pub support: Option<(f64, f64)>,
}
