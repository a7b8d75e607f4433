//! Kinds over a grid as coloured cells, equal ones of a column in one piece.

use crate::curve::Frame;
use crate::style::colour;
use crate::svg::{Paint, Svg, number};
use std::fmt::Write;
use stickslip_documents::CellsDocument;

/// The cells, a path for each kind. Each reaches half-way to its neighbours; those at the ends are cut by the axes,
/// which reach from the first middle to the last.
pub(crate) fn draw(cells: &CellsDocument, frame: Frame, svg: &mut Svg) {
    let (x, y) = (edges(&cells.x), edges(&cells.y));
    for (kind, name) in cells.colours.iter().enumerate() {
        let mut path = String::new();
        for i in 0..cells.x.len() {
            let here = |row: &Vec<Option<usize>>| row.get(i).copied().flatten() == Some(kind);
            let mut from = 0;
            for piece in cells.kinds.chunk_by(|a, b| here(a) == here(b)) {
                let to = from + piece.len();
                if here(&piece[0]) {
                    push(frame, (x[i], x[i + 1]), (y[from], y[to]), &mut path);
                }
                from = to;
            }
        }
        svg.path(&path, Paint { crisp: true, ..Paint::fill(colour(*name)) });
    }
}

fn push(frame: Frame, x: (f64, f64), y: (f64, f64), path: &mut String) {
    let (Some((left, bottom)), Some((right, top))) =
        (frame.place((x.0, y.0)), frame.place((x.1, y.1)))
    else {
        return;
    };
    let [left, right, top, bottom] = [left, right, top, bottom].map(number);
    let _ = write!(path, "M{left} {bottom}H{right}V{top}H{left}Z");
}

/// Between the middles, and at the first and the last.
fn edges(middles: &[f64]) -> Vec<f64> {
    let between = middles.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let ends = (middles.first().copied(), middles.last().copied());
    ends.0.into_iter().chain(between).chain(ends.1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_meet_half_way_and_do_not_reach_beyond_what_was_computed() {
        assert_eq!(edges(&[0.5, 1.5, 3.5]), [0.5, 1.0, 2.5, 3.5]);
    }
}
