//! Figure of a raster sweep: regimes over pitch and α, or wavelength, angle and coherence of the ripples.

use super::drawn::{Drawn, View};
use super::quantity::Quantity;
use super::tip::tip_name;
use crate::cells::{ascending, edges, sorted};
use crate::error::FigureError;
use crate::number::short;
use stickslip::{
    ColourName, CurveDocument, FigureDocument, NoteDocument, PanelDocument, PathName, Pattern,
    RasterRegimeName, RasterSweepDocument, RasterSweepPoint, StyleName,
};

/// Regimes with their colours, in the order of the legend.
const REGIMES: [(RasterRegimeName, ColourName); 7] = [
    (RasterRegimeName::Steady, ColourName::Silver),
    (RasterRegimeName::Ripples, ColourName::Sky),
    (RasterRegimeName::Pits, ColourName::Orange),
    (RasterRegimeName::Disordered, ColourName::Purple),
    (RasterRegimeName::StuckAtTheEdge, ColourName::Grey),
    (RasterRegimeName::Unknown, ColourName::Black),
    // Of tips that are free to move across the lines only: in the legend where there are any.
    (RasterRegimeName::Bunched, ColourName::Green),
];
/// Largest number of points with a printed angle.
const MOST_ANGLES: usize = 150;

impl Drawn for RasterSweepDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let parameters = &self.parameters;
        let panels = match (parameters.pitch.as_slice(), parameters.alpha.as_slice()) {
            ([], _) | (_, []) => {
                return Err(FigureError::Damaged("the grid has no points".into()));
            }
            ([_], [_]) => {
                let message = "a single point makes no picture: give a range LO:HI:N".into();
                return Err(FigureError::Nothing(message));
            }
            ([_], alpha) => row(self, "α", alpha),
            (pitch, [_]) => row(self, "pitch (σ)", pitch),
            _ => vec![map(self)],
        };
        Ok(FigureDocument::new("raster-sweep", &title(self), vec![], panels))
    }
}

fn title(document: &RasterSweepDocument) -> String {
    let parameters = &document.parameters;
    let path = match parameters.path {
        PathName::Zigzag => "zigzag",
        PathName::OneWay | PathName::Repeat => "one-way",
    };
    let limit = parameters.law.depth_limit.map_or(String::new(), |b| {
        format!(", b = {}", Quantity::new(b, "kσ²/a").in_text(&short(b)))
    });
    let length = Quantity::new(parameters.length, "σ");
    let length = length.in_text(&format!("{} σ", short(parameters.length)));
    let (tip, r) = (tip_name(&(&parameters.tip.0).into()), short(parameters.r));
    format!("{tip}, r = {r}{limit}, {path}, {} lines of {length}", parameters.lines)
}

/// A cell for each point, with the crest angle of ripples and pits, and the threshold of linear theory.
fn map(document: &RasterSweepDocument) -> PanelDocument {
    let parameters = &document.parameters;
    let mut panel = PanelDocument::new("angles: crests to scan axis", ("pitch (σ)", "α"));
    let columns = parameters.alpha.len();
    let kind = |point: &RasterSweepPoint| {
        let regime = point.regime?;
        REGIMES.iter().position(|(name, _)| *name == regime)
    };
    let mut kinds = vec![vec![None; parameters.pitch.len()]; columns];
    for point in &document.points {
        let row = kinds.get_mut(point.index % columns);
        if let Some(cell) = row.and_then(|row| row.get_mut(point.index / columns)) {
            *cell = kind(point);
        }
    }
    let is_bunched = |point: &RasterSweepPoint| point.regime == Some(RasterRegimeName::Bunched);
    let hidden = usize::from(!document.points.iter().any(is_bunched));
    let named = &REGIMES[..REGIMES.len() - hidden];
    let names = named.iter().map(|(name, _)| name.to_string()).collect();
    let colours = named.iter().map(|(_, colour)| *colour).collect();
    let cells = sorted((&parameters.pitch, &parameters.alpha), &kinds, names, colours);
    // Whole cells, for the numbers in them.
    (panel.x_range, panel.y_range) = (ends(&cells.x), ends(&cells.y));
    panel.cells = Some(cells);
    if document.points.len() <= MOST_ANGLES {
        panel.notes = document.points.iter().filter_map(angle).collect();
    }
    panel.curves.extend(threshold(document));
    panel
}

fn ends(values: &[f64]) -> Option<[f64; 2]> {
    let edges = edges(values);
    Some([*edges.first()?, *edges.last()?])
}

/// The crest angle at a point with ripples or pits.
fn angle(point: &RasterSweepPoint) -> Option<NoteDocument> {
    let is_ordered =
        matches!(point.regime, Some(RasterRegimeName::Ripples | RasterRegimeName::Pits));
    let found = point.pattern.as_ref().filter(|_| is_ordered)?;
    let text = format!("{:.0}°", found.crest_angle?);
    Some(NoteDocument::new(&text, (point.pitch, point.alpha)))
}

/// αc for growth from line to line against the pitch; `None` if it is outside of the axes.
fn threshold(document: &RasterSweepDocument) -> Option<CurveDocument> {
    let parameters = &document.parameters;
    let (x, pitches) = ascending(&parameters.pitch);
    let [low, high] = ends(&ascending(&parameters.alpha).0)?;
    // The first point of each pitch has it as well as any.
    let of = |pitch: usize| {
        let first = document.points.iter().find(|p| p.index == pitch * parameters.alpha.len())?;
        first.critical_alpha.filter(|at| (low..=high).contains(at))
    };
    let y: Vec<f64> = pitches.iter().map(|pitch| of(*pitch).unwrap_or(f64::NAN)).collect();
    let curve = CurveDocument::new(StyleName::Line, "α_c from line to line", &x, &y);
    y.iter().any(|y| y.is_finite()).then_some(curve.coloured(ColourName::Black))
}

/// Wavelength, angle and coherence of ripples against the parameter that varies.
fn row(document: &RasterSweepDocument, label: &str, values: &[f64]) -> Vec<PanelDocument> {
    type Measure = fn(&Pattern) -> Option<f64>;
    let measures: [(&str, Measure); 3] = [
        ("wavelength (σ)", |p| p.wavelength),
        ("crests to scan axis (°)", |p| p.crest_angle),
        ("coherence", |p| Some(p.coherence)),
    ];
    let curve = |measure: Measure, (regime, colour): (RasterRegimeName, ColourName)| {
        let value = |point: &RasterSweepPoint| match &point.pattern {
            Some(pattern) if point.regime == Some(regime) => measure(pattern).unwrap_or(f64::NAN),
            _ => f64::NAN,
        };
        // Points of other parts are not here.
        let mut y = vec![f64::NAN; values.len()];
        for point in &document.points {
            if let Some(here) = y.get_mut(point.index) {
                *here = value(point);
            }
        }
        let curve = CurveDocument::new(StyleName::Dots, &regime.to_string(), values, &y);
        y.iter().any(|y| y.is_finite()).then_some(curve.coloured(colour))
    };
    let panel = |(y_label, measure): (&str, Measure)| {
        let curves = REGIMES.into_iter().filter_map(|regime| curve(measure, regime));
        PanelDocument::of_curves((label, y_label), curves.collect())
    };
    measures.into_iter().map(panel).collect()
}
