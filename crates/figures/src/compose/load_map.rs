//! Figure of a map of loads: the wavelength of ripples over load and velocity, the critical load, and the measured point.

use super::drawn::{Drawn, View};
use super::sweep::Phase;
use super::tip::tip_name;
use crate::error::FigureError;
use crate::number::short;
use stickslip::{
    CellsDocument, ColourName, ColoursName, CurveDocument, FigureDocument, LoadMapDocument,
    LoadPoint, MapDocument, PanelDocument, RegimeName, StyleName,
};
use stickslip_tip::sorting::sort_numbers;

/// Regimes without ripples, with their colours in sweeps; the last is that of failed points.
const OTHERS: [(&str, Option<RegimeName>, ColourName); 4] = [
    ("steady", Some(RegimeName::Steady), Phase::Steady.colour()),
    ("trapped", Some(RegimeName::Trapped), Phase::Trapped.colour()),
    ("not settled", Some(RegimeName::Transient), Phase::Unsettled.colour()),
    ("unknown", None, ColourName::Grey),
];

/// Percentile of the wavelengths at which the colour scale ends: towards trapping wavelengths have no bound.
const SHOWN: usize = 85;

impl Drawn for LoadMapDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let parameters = &self.parameters;
        let columns = self.velocity.len();
        if columns < 2
            || self.points.len() != columns * columns
            || self.critical_load.len() != columns
        {
            return Err(FigureError::Damaged("the points do not fill a grid".into()));
        }
        let loads: Vec<f64> = self.points.iter().step_by(columns).map(|point| point.load).collect();
        let growth = match parameters.width_exponent {
            _ if parameters.load_widths.is_some() => ", σ by a table".into(),
            0.0 => String::new(),
            exponent => format!(", σ ∝ F^{{{}}}", short(exponent)),
        };
        let title = format!(
            "{}, α = {} at {} nN{growth}",
            tip_name(&(&parameters.tip.0).into()),
            short(parameters.alpha),
            short(parameters.load)
        );
        let mut panel = PanelDocument::new("", ("velocity (kσ/Γ)", "load (nN)"));
        panel.map = wavelengths(self, &loads);
        panel.cells = Some(regimes(self, &loads));
        let [bottom, top] = parameters.load_range;
        let inside = |load: &Option<f64>| {
            load.filter(|load| (bottom..=top).contains(load)).unwrap_or(f64::NAN)
        };
        let critical: Vec<f64> = self.critical_load.iter().map(inside).collect();
        if critical.iter().any(|load| load.is_finite()) {
            let curve =
                CurveDocument::new(StyleName::Line, "critical load", &self.velocity, &critical);
            panel.curves.push(curve.coloured(ColourName::Vermillion));
        }
        let (v, f) = (self.lever.velocity, self.lever.load);
        let [left, right] = parameters.r_range;
        if (left..=right).contains(&v) && (bottom..=top).contains(&f) {
            let lever = CurveDocument::new(StyleName::Dots, "lever", &[v], &[f]);
            panel.curves.push(lever.coloured(ColourName::Black));
        }
        Ok(FigureDocument::new("load-map", &title, vec![], vec![panel]))
    }
}

/// The wavelength where there are ripples; cells cover the other points.
fn wavelengths(document: &LoadMapDocument, loads: &[f64]) -> Option<MapDocument> {
    let points = &document.points;
    let mut lengths: Vec<f64> = points.iter().filter_map(|p| p.wavelength).collect();
    sort_numbers(&mut lengths);
    let (low, high) = (*lengths.first()?, *lengths.get(lengths.len() * SHOWN / 100)?);
    let row = |row: &[LoadPoint]| row.iter().map(|p| p.wavelength.unwrap_or(low)).collect();
    Some(MapDocument {
        x: document.velocity.clone(),
        y: loads.to_vec(),
        z: points.chunks(document.velocity.len()).map(row).collect(),
        z_label: "distance of ripples (σ)".into(),
        colours: ColoursName::Cividis,
        z_range: (low < high).then_some([low, high]),
    })
}

/// The regimes of the points without ripples.
fn regimes(document: &LoadMapDocument, loads: &[f64]) -> CellsDocument {
    let (points, columns) = (&document.points, document.velocity.len());
    let occurs = |of: &Option<RegimeName>| points.iter().any(|p| is_bare(p) && kind_of(p) == *of);
    let named: Vec<_> = OTHERS.iter().filter(|(_, regime, _)| occurs(regime)).collect();
    let kind = |point: &LoadPoint| {
        let regime = kind_of(point);
        named.iter().position(|(_, of, _)| *of == regime).filter(|_| is_bare(point))
    };
    CellsDocument {
        x: document.velocity.clone(),
        y: loads.to_vec(),
        kinds: points.chunks(columns).map(|row| row.iter().map(kind).collect()).collect(),
        names: named.iter().map(|(name, ..)| (*name).into()).collect(),
        colours: named.iter().map(|(.., colour)| *colour).collect(),
    }
}

/// Whether a point has no wavelength.
fn is_bare(point: &LoadPoint) -> bool {
    point.wavelength.is_none()
}

/// The regime of a point without ripples; any other than steady and trapped counts as not settled.
fn kind_of(point: &LoadPoint) -> Option<RegimeName> {
    match point.regime? {
        regime @ (RegimeName::Steady | RegimeName::Trapped) => Some(regime),
        _ => Some(RegimeName::Transient),
    }
}
