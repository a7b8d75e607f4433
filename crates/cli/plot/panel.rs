//! One set of axes with its curves, drawn by kuva.

use super::axis::{Axis, Fit};
use super::curve::Curve;
use super::legend::Legend;
use super::map::Drawn;
use super::style::{
    GRID, LABEL_SIZE, MARGIN_BOTTOM, MARGIN_RIGHT, MARGIN_TOP, TICK_SIZE, WIDTH, text_width,
};
use kuva::Theme;
use kuva::prelude::{Layout, TickFormat};
use kuva::render::annotations::{ShadedRegion, TextAnnotation};
use kuva::render::render::{Primitive, Scene, TextAnchor, render_multiple};

/// Axes, labels and curves.
pub(super) struct Panel<'a> {
    /// Above the axes; may be empty.
    pub(super) heading: &'a str,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) x_label: &'a str,
    pub(super) y_label: &'a str,
    pub(super) height: f64,
    /// Drawn in this order.
    pub(super) curves: Vec<Curve<'a>>,
    pub(super) shades: Vec<Shade<'a>>,
    pub(super) notes: Vec<Note<'a>>,
    /// A height map that fills the axes.
    pub(super) map: Option<Drawn<'a>>,
}

/// An area in a light colour, behind the curves.
pub(super) enum Shade<'a> {
    /// Between two abscissas.
    Columns(f64, f64, &'static str),
    /// From a curve to the top of the panel.
    Above(&'a [f64], &'a [f64], &'static str),
}

/// A text at a place of the panel.
pub(super) struct Note<'a> {
    pub(super) text: &'a str,
    pub(super) x: f64,
    pub(super) y: f64,
}

impl<'a> Panel<'a> {
    /// A panel fitted to its curves: full width for the abscissas unless a curve winds back, air
    /// for the ordinates, which have the size `natural` by nature (0: unknown).
    pub(super) fn fitted(
        labels: (&'a str, &'a str),
        curves: Vec<Curve<'a>>,
        height: f64,
        natural: f64,
    ) -> Self {
        let abscissas = curves.iter().flat_map(|c| c.x.iter().copied());
        let winding = curves.iter().any(|c| !c.x.is_sorted());
        let padding = if winding { 0.06 } else { 0.0 };
        let ordinates = curves.iter().flat_map(|c| c.y.iter().copied());
        Self {
            heading: "",
            x: Axis::fit(abscissas, Fit { padding, natural: 0.0, ticks: 9.0 }),
            y: Axis::fit(ordinates, Fit { padding: 0.06, natural, ticks: height / 65.0 }),
            x_label: labels.0,
            y_label: labels.1,
            height,
            curves,
            shades: Vec::new(),
            notes: Vec::new(),
            map: None,
        }
    }

    /// Room that tick labels and axis label need on the left.
    pub(super) fn margin_left(&self) -> f64 {
        let labels = self.y.labels();
        let widest = labels.iter().map(|l| text_width(l, TICK_SIZE)).fold(0.0, f64::max);
        widest + 14.0 + 1.9 * f64::from(LABEL_SIZE)
    }

    /// Room right of the axes.
    pub(super) fn margin_right(&self) -> f64 {
        self.map.as_ref().map_or(MARGIN_RIGHT, Drawn::margin_right)
    }

    /// Draws the panel, its axes between `left` and `right`.
    pub(super) fn draw(&self, (left, right): (f64, f64)) -> Scene {
        let legend = self.legend(left, right);
        let top = self.top(&legend);
        let shades = self.shades.iter().filter_map(|shade| self.band(shade));
        let curves = self.curves.iter().map(|curve| self.plot(curve));
        let mut scene =
            render_multiple(shades.chain(curves).collect(), self.layout((left, right), top));
        legend.draw(left, self.legend_top(), &mut scene);
        scene.add(self.y_title(top));
        if !self.heading.is_empty() {
            scene.add(self.heading_line(left));
        }
        if let Some(map) = &self.map {
            map.draw_bar(right, (top, self.bottom()), &mut scene);
        }
        scene
    }

    /// The map's picture, drawn upon the panel at this place of the sheet.
    pub(super) fn image(&self, (left, right): (f64, f64), above: f64) -> Option<String> {
        let top = self.top(&self.legend(left, right));
        let map = self.map.as_ref()?;
        Some(map.image((left, right), (above + top, above + self.bottom())))
    }

    fn legend(&self, left: f64, right: f64) -> Legend<'_> {
        Legend::of(&self.curves, right - left)
    }

    /// Where the axes end above and below.
    fn top(&self, legend: &Legend) -> f64 {
        self.legend_top() + legend.height()
    }

    fn legend_top(&self) -> f64 {
        let line = 1.5 * f64::from(LABEL_SIZE);
        MARGIN_TOP + if self.heading.is_empty() { 0.0 } else { line }
    }

    fn bottom(&self) -> f64 {
        self.height - MARGIN_BOTTOM
    }

    fn layout(&self, (left, right): (f64, f64), top: f64) -> Layout {
        let (x, y) = (self.x.clone(), self.y.clone());
        let mut layout = Layout::new((x.low, x.high), (y.low, y.high))
            .with_width(WIDTH)
            .with_height(self.height)
            .with_force_margins(left, WIDTH - right)
            .with_force_margins_y(top, MARGIN_BOTTOM)
            .with_x_axis_min(x.low)
            .with_x_axis_max(x.high)
            .with_y_axis_min(y.low)
            .with_y_axis_max(y.high)
            .with_x_tick_step(x.step)
            .with_y_tick_step(y.step)
            .with_x_tick_format(tick_format(x))
            .with_y_tick_format(tick_format(y))
            .with_box_axes()
            .with_tick_size(TICK_SIZE)
            .with_label_size(LABEL_SIZE)
            .with_body_size(LABEL_SIZE)
            .with_x_label(self.x_label)
            .with_theme(Theme { grid_color: GRID.to_owned(), ..Theme::light() });
        for shade in &self.shades {
            if let Shade::Columns(from, to, colour) = *shade {
                let region = ShadedRegion::vertical(from, to).with_color(colour);
                layout = layout.with_shaded_region(region.with_opacity(SHADE_OPACITY));
            }
        }
        for note in &self.notes {
            let text = TextAnnotation::new(note.text, note.x, note.y);
            layout = layout.with_annotation(text.with_font_size(LABEL_SIZE));
        }
        layout
    }

    fn heading_line(&self, left: f64) -> Primitive {
        Primitive::Text {
            x: left,
            y: MARGIN_TOP + 0.55 * f64::from(LABEL_SIZE),
            content: self.heading.to_owned(),
            size: LABEL_SIZE,
            anchor: TextAnchor::Start,
            rotate: None,
            bold: false,
            color: None,
        }
    }

    /// The label of the ordinates. Ours, because kuva puts it next to the tick labels, hence at
    /// another place in every panel.
    fn y_title(&self, top: f64) -> Primitive {
        Primitive::Text {
            x: 1.3 * f64::from(LABEL_SIZE),
            y: 0.5 * (top + self.height - MARGIN_BOTTOM),
            content: self.y_label.to_owned(),
            size: LABEL_SIZE,
            anchor: TextAnchor::Middle,
            rotate: Some(-90.0),
            bold: false,
            color: None,
        }
    }
}

pub(super) const SHADE_OPACITY: f64 = 0.16;

fn tick_format(axis: Axis) -> TickFormat {
    TickFormat::Custom(std::sync::Arc::new(move |value| axis.label(value)))
}
