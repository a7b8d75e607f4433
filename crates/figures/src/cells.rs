//! Categories over a grid as coloured cells; equal neighbours of a column are merged.

use crate::curve::Frame;
use crate::drawing::{Drawing, Paint, Path, Rect, Step};
use crate::style::colour;
use stickslip::{CellsDocument, ColourName};
use stickslip_tip::sorting;

/// Draws the cells, a path for each category. A cell extends half-way to its neighbours; cells at the ends are symmetric
/// unless the axes cut them.
pub(crate) fn draw(cells: &CellsDocument, frame: Frame, drawing: &mut Drawing) {
    let (x, y) = (edges(&cells.x), edges(&cells.y));
    for (kind, name) in cells.colours.iter().enumerate() {
        let mut path = Path::default();
        for i in 0..cells.x.len() {
            let here = |row: &Vec<Option<usize>>| row.get(i).copied().flatten() == Some(kind);
            let mut from = 0;
            for piece in cells.kinds.chunk_by(|a, b| here(a) == here(b)) {
                let to = from + piece.len();
                if here(&piece[0]) {
                    path.0.extend(cell(frame, (x[i], x[i + 1]), (y[from], y[to])));
                }
                from = to;
            }
        }
        drawing.path(path, Paint { crisp: true, ..Paint::fill(colour(*name)) });
    }
}

fn cell(frame: Frame, x: (f64, f64), y: (f64, f64)) -> Option<Step> {
    let (left, bottom) = frame.place((x.0, y.0))?;
    let (right, top) = frame.place((x.1, y.1))?;
    Some(Step::Rect(Rect { left, top, right, bottom }))
}

/// Cells at positions in any order; `kinds` has a row for each y.
pub(crate) fn sorted(
    (x, y): (&[f64], &[f64]),
    kinds: &[Vec<Option<usize>>],
    names: Vec<String>,
    colours: Vec<ColourName>,
) -> CellsDocument {
    let ((x, columns), (y, rows)) = (ascending(x), ascending(y));
    let row = |row: &usize| columns.iter().map(|column| kinds[*row][*column]).collect();
    CellsDocument { kinds: rows.iter().map(row).collect(), x, y, names, colours }
}

/// The values in ascending order, with the index of each.
pub(crate) fn ascending(values: &[f64]) -> (Vec<f64>, Vec<usize>) {
    let places = sorting::ascending(values);
    (places.iter().map(|place| values[*place]).collect(), places)
}

/// The edges of cells with these centres; the first edge is not below 0 if all centres are above 0.
pub(crate) fn edges(middles: &[f64]) -> Vec<f64> {
    let between: Vec<f64> = middles.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    let beyond = |end: f64, edge: Option<&f64>| end + edge.map_or(0.0, |edge| end - edge);
    let first = middles.first().map(|low| {
        let edge = beyond(*low, between.first());
        if *low > 0.0 { edge.max(0.0) } else { edge }
    });
    let last = middles.last().map(|high| beyond(*high, between.last()));
    first.into_iter().chain(between).chain(last).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_meet_half_way_and_reach_as_far_at_the_ends() {
        assert_eq!(edges(&[0.75, 1.5, 3.5]), [0.375, 1.125, 2.5, 4.5]);
        assert_eq!(edges(&[0.25, 1.5]), [0.0, 0.875, 2.125]);
        assert_eq!(edges(&[-1.0, 1.0]), [-2.0, 0.0, 2.0]);
        assert_eq!(edges(&[2.0]), [2.0, 2.0]);
    }
}
