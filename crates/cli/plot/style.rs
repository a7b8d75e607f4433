//! Sizes in pixels, and the colours of Okabe and Ito, which the colour-blind can tell apart.

/// Every figure is this wide, and legible when shown so.
pub(super) const WIDTH: f64 = 900.0;
/// Height of a panel that is alone in its figure.
pub(super) const TALL: f64 = 540.0;
/// Height of a panel that shares its figure.
pub(super) const LOW: f64 = 290.0;

/// Room right of the axes, for half of the last tick label.
pub(super) const MARGIN_RIGHT: f64 = 28.0;
/// Room above the axes when no legend is there.
pub(super) const MARGIN_TOP: f64 = 16.0;
/// Room below the axes, for tick labels and axis label.
pub(super) const MARGIN_BOTTOM: f64 = 54.0;

pub(super) const TICK_SIZE: u32 = 14;
pub(super) const LABEL_SIZE: u32 = 16;
pub(super) const LEGEND_SIZE: u32 = 14;
pub(super) const TITLE_SIZE: u32 = 18;

pub(super) const BLUE: &str = "#0072B2";
pub(super) const VERMILLION: &str = "#D55E00";
/// Of marks: darker than the grid.
pub(super) const GREY: &str = "#7F7F7F";
pub(super) const BLACK: &str = "#000000";
pub(super) const GRID: &str = "#E4E4E4";

/// Colours of the curves of one panel, in order.
pub(super) const PALETTE: [&str; 7] =
    [BLUE, VERMILLION, "#009E73", "#CC79A7", "#E69F00", "#56B4E9", BLACK];

/// Width of a text in DejaVu Sans, from above: a digit takes 0.64 of the size, few letters more.
pub(super) fn text_width(text: &str, size: u32) -> f64 {
    0.64 * f64::from(size) * text.chars().count() as f64
}
