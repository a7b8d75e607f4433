//! The cells within reach of the tip so far.

/// Values at consecutive cells, extended on demand; an unvisited cell has its initial value.
pub(crate) struct Cells<'a> {
    first: i64,
    values: Vec<f64>,
    unvisited: &'a dyn Fn(i64) -> f64,
    /// Factor of the initial values of unvisited cells.
    scale: f64,
}

impl<'a> Cells<'a> {
    pub(crate) fn new(unvisited: &'a dyn Fn(i64) -> f64) -> Self {
        Self { first: 0, values: Vec::new(), unvisited, scale: 1.0 }
    }

    pub(crate) fn scale(&mut self, factor: f64) {
        self.scale *= factor;
        self.values.iter_mut().for_each(|value| *value *= factor);
    }

    /// The cells `first` … `first + len - 1`, created if necessary.
    pub(crate) fn range(&mut self, first: i64, len: usize) -> &mut [f64] {
        self.extend(first, first + len as i64);
        let from = (first - self.first) as usize;
        &mut self.values[from..from + len]
    }

    /// One cell, visited or not.
    pub(crate) fn at(&self, cell: i64) -> f64 {
        let visited = usize::try_from(cell - self.first).ok().and_then(|k| self.values.get(k));
        visited.copied().unwrap_or_else(|| self.scale * (self.unvisited)(cell))
    }

    fn extend(&mut self, first: i64, end: i64) {
        let (unvisited, scale) = (self.unvisited, self.scale);
        let new_cell = |cell: i64| scale * unvisited(cell);
        if self.values.is_empty() {
            self.first = first;
        }
        if first < self.first {
            // By half of the present length, so that a long retreat costs linear time.
            let ahead = first - self.values.len() as i64 / 2;
            let new: Vec<f64> = (ahead..self.first).map(new_cell).collect();
            self.values.splice(0..0, new);
            self.first = ahead;
        }
        let old_end = self.first + self.values.len() as i64;
        self.values.extend((old_end..end).map(new_cell));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_keep_what_was_written_while_they_extend_both_ways() {
        let index = |cell: i64| cell as f64;
        let mut cells = Cells::new(&index);
        cells.range(10, 5)[2] = -1.0;
        cells.range(-30, 3);
        cells.range(40, 2);
        for cell in -60..60 {
            let expected = if cell == 12 { -1.0 } else { cell as f64 };
            assert!((cells.at(cell) - expected).abs() < 1e-15, "cell {cell}");
        }
    }
}
