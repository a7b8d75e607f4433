//! Conversion of a finished figure to nm, s and nN; the unit of an axis is read from its label.

use super::View;
#[cfg(feature = "animation")]
use super::axes::L;
use super::axes::{ALPHA, EXTENSION, LAG, LAG_OF_STEADY_SUPPORT, N, R, SPRING, SPRING_FORCE, V0};
use super::quantity::settle;
use crate::error::FigureError;
#[cfg(feature = "animation")]
use crate::scene::{Moment, Scene};
use stickslip::{CurveDocument, Dimension, FigureDocument, KnownScales, PanelDocument};

/// An axis: the factor of its numbers, and its new label.
struct Axis {
    factor: f64,
    label: String,
}

impl Axis {
    fn of(label: &str, scales: &KnownScales) -> Self {
        let dimensionless = label;
        // The extension of the spring in σ is its force in kσ, which an instrument measures.
        let is_extension = [LAG.1, LAG_OF_STEADY_SUPPORT, SPRING].contains(&label);
        let label = match label {
            R => V0,
            ALPHA => N,
            _ if is_extension && scales.force.is_some() => SPRING_FORCE,
            _ => label,
        };
        scaled(label, scales).unwrap_or_else(|| Self { factor: 1.0, label: dimensionless.into() })
    }

    fn one(&self, value: &mut f64) {
        *value *= self.factor;
    }

    fn all(&self, values: &mut [f64]) {
        values.iter_mut().for_each(|value| self.one(value));
    }

    fn some(&self, values: &mut [Option<f64>]) {
        values.iter_mut().flatten().for_each(|value| self.one(value));
    }
}

/// The converted axis; `None` for a label without a unit, or with a unit of unknown scale.
fn scaled(label: &str, scales: &KnownScales) -> Option<Axis> {
    let (name, unit) = label.strip_suffix(')')?.rsplit_once(" (")?;
    let dimension = Dimension::of_unit(unit)?;
    let label = format!("{name} ({})", dimension.unit());
    Some(Axis { factor: dimension.factor(scales)?, label })
}

/// Rejects a range whose unit is not that of its axis.
pub(super) fn judge_ranges(panel: &PanelDocument, view: &View) -> Result<(), FigureError> {
    let labels = [&panel.x_label, &panel.y_label];
    let mut units = view.range_units.into_iter().zip(labels);
    let other = units.find_map(|(unit, label)| {
        unit.filter(|unit| !label.ends_with(&format!(" ({unit})"))).zip(Some(label))
    });
    other.map_or(Ok(()), |(unit, label)| Err(FigureError::Unit(unit, label.clone())))
}

/// The options of a figure converted to the model's units, with the axes of its first panel.
pub(super) fn view_in_model_units(
    panel: &PanelDocument,
    scales: &KnownScales,
    view: &View,
) -> View {
    let along = |label: &str, range: Option<[f64; 2]>| {
        range.map(|ends| ends.map(|end| end / Axis::of(label, scales).factor))
    };
    View {
        x_range: along(&panel.x_label, view.x_range),
        y_range: along(&panel.y_label, view.y_range),
        ..*view
    }
}

/// The figure in nm, s and nN where their scales are known, and otherwise in the model's units.
pub(super) fn in_units(mut figure: FigureDocument, scales: Option<&KnownScales>) -> FigureDocument {
    if let Some(scales) = scales {
        figure.panels.iter_mut().for_each(|panel| convert(panel, scales));
    }
    settle(&mut figure, scales);
    figure
}

fn convert(panel: &mut PanelDocument, scales: &KnownScales) {
    let (x, y) = (Axis::of(&panel.x_label, scales), Axis::of(&panel.y_label, scales));
    let PanelDocument { curves, map, cells, notes, shades, .. } = panel;
    let is_force = panel.y_label == LAG.1 && scales.force.is_some();
    for CurveDocument { x: abscissas, y: ordinates, low, name, .. } in curves {
        x.all(abscissas);
        y.some(ordinates);
        low.iter_mut().for_each(|low| y.some(low));
        if let Some(name) = name.as_mut().filter(|_| is_force) {
            *name = name.replace(EXTENSION[0], EXTENSION[1]);
        }
    }
    if let Some(map) = map {
        let z = Axis::of(&map.z_label, scales);
        x.all(&mut map.x);
        y.all(&mut map.y);
        map.z.iter_mut().for_each(|row| z.all(row));
        map.z_range.iter_mut().for_each(|range| z.all(range));
        map.z_label = z.label;
    }
    if let Some(cells) = cells {
        x.all(&mut cells.x);
        y.all(&mut cells.y);
    }
    for note in notes {
        x.one(&mut note.x);
        y.one(&mut note.y);
    }
    shades.iter_mut().for_each(|shade| x.all(shade));
    panel.x_range.iter_mut().for_each(|range| x.all(range));
    panel.y_range.iter_mut().for_each(|range| y.all(range));
    panel.natural.iter_mut().for_each(|natural| y.one(natural));
    (panel.x_label, panel.y_label) = (x.label, y.label);
}

/// Times in the unit of a time axis, converted to Γ/k.
#[cfg(feature = "animation")]
pub(super) fn times_of(times: [f64; 2], scales: &KnownScales) -> [f64; 2] {
    times.map(|t| t / Axis::of(L.0, scales).factor)
}

/// A scene in nm, s and nN where their scales are known, and otherwise in the model's units.
#[cfg(feature = "animation")]
pub(super) struct InUnits {
    scene: Box<dyn Scene>,
    scales: Option<KnownScales>,
}

#[cfg(feature = "animation")]
impl InUnits {
    pub(super) fn new(scene: Box<dyn Scene>, scales: Option<KnownScales>) -> Self {
        Self { scene, scales }
    }
}

#[cfg(feature = "animation")]
impl Scene for InUnits {
    fn still(&self) -> FigureDocument {
        in_units(self.scene.still(), self.scales.as_ref())
    }

    fn times(&self) -> [f64; 2] {
        let Some(scales) = &self.scales else { return self.scene.times() };
        self.scene.times().map(|t| t * Axis::of(L.0, scales).factor)
    }

    fn moment(&mut self, t: f64) -> Result<Moment, FigureError> {
        let Some(scales) = &self.scales else { return self.scene.moment(t) };
        let time = Axis::of(L.0, scales);
        let mut moment = self.scene.moment(t / time.factor)?;
        let unit = time.label.trim_end_matches(')').rsplit_once('(');
        (moment.t, moment.unit) = (t, unit.map_or(String::new(), |(_, unit)| unit.into()));
        if let Some(first) = moment.panels.first() {
            let axes = (Axis::of(&first.x_label, scales), Axis::of(&first.y_label, scales));
            moment.tip = (moment.tip.0 * axes.0.factor, moment.tip.1 * axes.1.factor);
            moment.support = moment.support.map(|(x, y)| (x * axes.0.factor, y * axes.1.factor));
        }
        moment.panels.iter_mut().for_each(|panel| convert(panel, scales));
        Ok(moment)
    }
}
