//! The grooves of all lines, and the surface on the next line, in compressed form: few numbers per line, for the
//! lines within reach only.
//!
//! With f(x,y) = Σ_l g_l(x) h_l(y), the surface at y is, in Fourier space along x,
//!
//! ```text
//!     Û(k) = -α Σ_l ĝ_l(k) Σ_m h_l(y - y_m) ρ̂_m(k)
//! ```
//!
//! Here ρ_m is the residence density of line m, the time that the tip spent at each x, weighted by the depth limit
//! and reduced by healing. Only ρ̂_m is stored, up to the band of f: about three complex numbers per tip width of the
//! length of a line.

use crate::line::Line;
use crate::path::Track;
use crate::plan::{Plan, WIDTHS};
use ndarray::Array2;
use num_complex::Complex64;
use rayon::prelude::*;
use stickslip_convolution::{Density, Spectra};
use stickslip_tip::planar::{EarlierGrooves, GrooveRows, RowLattice};
use stickslip_tip::sorting::ends;
use stickslip_tip::{Across, Footprint, Layer, Relief, Wider};

/// ρ̂ of all lines at one y; for a tip that is free to move across, the part of all lines on one row of a lattice.
struct Row {
    y: f64,
    spectrum: Vec<Complex64>,
}

/// A range of x, with the transform of the footprint at its wave numbers.
struct Stretch {
    spectra: Spectra,
    wave_numbers: Vec<f64>,
    /// ĝ_l(k)
    layers: Vec<Vec<Complex64>>,
}

/// Initial distance from a line, in widths of the footprint, up to which the surface is prepared for a tip that is
/// free to move across.
const WIDE: f64 = 5.0;
/// Number of lines whose transforms are computed in parallel; for a tip that is free to move across they are large.
const AT_A_TIME: usize = 64;

/// ρ̂ of all lines that are still within reach.
pub(crate) struct Grooves {
    footprint: Footprint,
    alpha: f64,
    /// The rows of the grooves of a tip that is free to move across.
    lattice: Option<RowLattice>,
    /// The largest distance of this tip from its line for which all rows are present.
    wide: f64,
    /// Law of healing, by which a groove is reduced after another line.
    wider: Wider,
    r: f64,
    reach_across: f64,
    /// Distance along x over which a groove extends beyond the tip's positions.
    reach_along: f64,
    band: f64,
    /// Range of x of the supports.
    supports: (f64, f64),
    /// Largest distance of a tip from this range.
    spare: f64,
    /// Range of y of the remaining lines after each line; empty if no row is dropped.
    ahead: Vec<(f64, f64)>,
    /// Number of lines so far.
    count: usize,
    stretch: Stretch,
    rows: Vec<Row>,
}

impl Stretch {
    fn new(footprint: &Footprint, band: f64, (from, to): (f64, f64), beyond: f64) -> Self {
        let spectra = Spectra::new(band, from - beyond, to + beyond);
        let wave_numbers: Vec<f64> = spectra.wave_numbers().collect();
        let transform =
            |layer: &Layer| wave_numbers.iter().map(|k| layer.along.transform(*k)).collect();
        let layers = footprint.layers().iter().map(transform).collect();
        Self { spectra, wave_numbers, layers }
    }
}

impl Grooves {
    /// No grooves yet; lines out of reach of all later ones are dropped.
    pub(crate) fn new(plan: &Plan) -> Self {
        Self::with(plan, true)
    }

    /// The grooves of all these lines, none dropped.
    pub(crate) fn of_all(plan: &Plan, lines: &[Line]) -> Self {
        let mut grooves = Self::with(plan, false);
        let farthest = lines.par_iter().map(|line| grooves.outside(line)).reduce(|| 0.0, f64::max);
        if farthest > grooves.spare {
            grooves.widen(farthest);
        }
        for some in lines.chunks(AT_A_TIME) {
            let (spectra, lattice) = (&grooves.stretch.spectra, grooves.lattice);
            let rows = |spectra: &mut Spectra, line| rows_of(line, lattice.as_ref(), spectra);
            let rows: Vec<Vec<Row>> = some.par_iter().map_init(|| spectra.clone(), rows).collect();
            some.iter().zip(rows).for_each(|(line, rows)| grooves.put(line, rows));
        }
        grooves
    }

    fn with(plan: &Plan, forgets: bool) -> Self {
        let (reach_along, band, supports) = (plan.reach_along(), plan.band(), plan.area.ends());
        Self {
            alpha: plan.law.model.alpha(),
            lattice: plan.free.as_ref().map(|_| RowLattice::of(&plan.footprint)),
            wide: plan.free.as_ref().map_or(0.0, |_| WIDE * plan.reach_across() / WIDTHS),
            wider: *plan.law.model.wider(),
            r: plan.law.model.r(),
            reach_across: plan.reach_across(),
            reach_along,
            band,
            supports,
            spare: reach_along,
            ahead: if forgets { ahead(plan) } else { vec![] },
            count: 0,
            stretch: Stretch::new(&plan.footprint, band, supports, 2.0 * reach_along),
            footprint: plan.footprint.clone(),
            rows: vec![],
        }
    }

    /// Adds the last of these lines; the earlier ones were added before.
    pub(crate) fn add(&mut self, lines: &[Line]) {
        let Some(line) = lines.last() else { return };
        let farthest = self.outside(line);
        if farthest > self.spare {
            self.widen(farthest);
            self.put_again(lines);
            return;
        }
        self.transform_and_put(line);
    }

    /// Largest distance of the tip from the range of the supports.
    fn outside(&self, line: &Line) -> f64 {
        let (positions, _) = line.residence();
        let outside = |x: &f64| (self.supports.0 - x).max(x - self.supports.1);
        positions.iter().map(outside).fold(0.0, f64::max)
    }

    fn put(&mut self, line: &Line, rows: Vec<Row>) {
        let left = self.wider.left_after(line.track().length / self.r);
        if left < 1.0 {
            self.rows.iter_mut().flat_map(|row| &mut row.spectrum).for_each(|rho| *rho *= left);
        }
        for Row { y, spectrum } in rows {
            match self.rows.iter_mut().rev().find(|row| same(row.y, y)) {
                Some(row) => {
                    row.spectrum.iter_mut().zip(&spectrum).for_each(|(all, new)| *all += new);
                }
                None => self.rows.push(Row { y, spectrum }),
            }
        }
        self.count += 1;
        if let Some((low, high)) = self.ahead.get(self.count) {
            let beyond = self.reach_across + self.wide;
            let (low, high) = (low - beyond, high + beyond);
            self.rows.retain(|row| row.y >= low && row.y <= high);
        }
    }

    /// Extends the range for a tip this far outside. All transforms must then be recomputed from the lines, so that they
    /// do not depend on the time of the extension.
    fn widen(&mut self, farthest: f64) {
        while self.spare < farthest {
            self.spare *= 2.0;
        }
        let beyond = self.spare + self.reach_along;
        self.stretch = Stretch::new(&self.footprint, self.band, self.supports, beyond);
    }

    /// Extends the rows for a tip that moves farther from its line; `lines` are all lines so far.
    pub(crate) fn widen_across(&mut self, lines: &[Line]) {
        self.wide *= 2.0;
        self.put_again(lines);
    }

    fn put_again(&mut self, lines: &[Line]) {
        self.rows.clear();
        self.count = 0;
        lines.iter().for_each(|line| self.transform_and_put(line));
    }

    fn transform_and_put(&mut self, line: &Line) {
        let rows = rows_of(line, self.lattice.as_ref(), &mut self.stretch.spectra);
        self.put(line, rows);
    }

    /// Û at y; `None` if no line is within reach.
    fn surface(&self, y: f64) -> Option<Vec<Complex64>> {
        let within = |row: &&Row| (row.y - y).abs() <= self.reach_across;
        self.rows.iter().find(within)?;
        let mut sum = vec![Complex64::default(); self.stretch.wave_numbers.len()];
        self.rows.iter().filter(within).for_each(|row| self.add_groove(row, y, &mut sum));
        Some(sum)
    }

    fn add_groove(&self, row: &Row, y: f64, sum: &mut [Complex64]) {
        for (layer, transform) in self.footprint.layers().iter().zip(&self.stretch.layers) {
            let height = -self.alpha * self.height(layer.across, y - row.y);
            let terms = row.spectrum.iter().zip(transform);
            sum.iter_mut().zip(terms).for_each(|(sum, (rho, g))| *sum += rho * (height * g));
        }
    }

    /// The factor of a row in the surface at this distance from it.
    fn height(&self, across: Across, distance: f64) -> f64 {
        match &self.lattice {
            None => across.value(distance),
            Some(lattice) => lattice.height(across, distance),
        }
    }

    /// The surface around this track, in the frame of the track, for a tip that is free to move across. `None` if no
    /// line is within reach.
    pub(crate) fn around(&mut self, track: &Track) -> Option<EarlierGrooves> {
        let lattice = self.lattice?;
        let beyond = self.reach_across + self.wide;
        let within = |row: &&Row| (row.y - track.y).abs() <= beyond;
        let rows: Vec<&Row> = self.rows.iter().filter(within).collect();
        let place = |row: &Row| lattice.row_at(row.y);
        let first = rows.iter().map(|row| place(row)).min()?;
        let last = rows.iter().map(|row| place(row)).max()?;
        let count = usize::try_from(last - first + 1).unwrap_or(0);
        let Stretch { spectra, wave_numbers, layers: transforms } = &mut self.stretch;
        let layer = |(layer, transform): (&Layer, &Vec<Complex64>)| {
            let (mut heights, mut slopes) = (spectra.rows(count), spectra.rows(count));
            for row in &rows {
                let n = usize::try_from(place(row) - first).unwrap_or(0);
                let terms = row.spectrum.iter().zip(transform);
                let height: Vec<Complex64> =
                    terms.map(|(rho, g)| rho * (-self.alpha * g)).collect();
                let terms = height.iter().zip(&*wave_numbers);
                let slope: Vec<Complex64> =
                    terms.map(|(height, k)| Complex64::new(0.0, *k) * height).collect();
                spectra.set_row(&mut heights, n, &height);
                spectra.set_row(&mut slopes, n, &slope);
            }
            GrooveRows { across: layer.across, heights, slopes }
        };
        let layers = self.footprint.layers().iter().zip(&*transforms).map(layer).collect();
        let frame = (track.y, self.wide);
        Some(EarlierGrooves::new(lattice, first, layers, frame, (track.start, track.backward)))
    }

    /// The surface along this track, in the frame of the track. `None` if no line is within reach.
    pub(crate) fn relief(&mut self, track: &Track) -> Option<Relief> {
        let heights = self.surface(track.y)?;
        let slope = |(height, k): (&Complex64, &f64)| Complex64::new(0.0, *k) * height;
        let slopes: Vec<Complex64> =
            heights.iter().zip(&self.stretch.wave_numbers).map(slope).collect();
        let fields = (self.stretch.spectra.field(&heights), self.stretch.spectra.field(&slopes));
        Some(Relief::on_lattice(fields.0, fields.1, (track.start, track.backward)))
    }

    /// The heights at every y (rows) and every x (columns).
    pub(crate) fn heights(&self, x: &[f64], y: &[f64]) -> Array2<f64> {
        self.table(x, y, |y| self.surface(*y))
    }

    /// The groove of each line alone at its own y (rows), at every x (columns).
    fn own_heights(&self, x: &[f64]) -> Array2<f64> {
        self.table(x, &self.rows, |row| {
            let mut sum = vec![Complex64::default(); self.stretch.wave_numbers.len()];
            self.add_groove(row, row.y, &mut sum);
            Some(sum)
        })
    }

    /// For each place a row of S(x) at every x, where `of` returns Ŝ of the place; 0 where it returns `None`.
    fn table<P: Sync>(
        &self,
        x: &[f64],
        places: &[P],
        of: impl Fn(&P) -> Option<Vec<Complex64>> + Sync,
    ) -> Array2<f64> {
        let mut table = Array2::zeros((places.len(), x.len()));
        let cells = table.as_slice_mut().unwrap_or_default();
        let rows = cells.par_chunks_mut(x.len().max(1)).zip(places);
        rows.for_each_init(
            || self.stretch.spectra.clone(),
            |spectra, (row, place)| {
                if let Some(heights) = of(place) {
                    read(spectra, &heights, x, row);
                }
            },
        );
        table
    }

    /// The groove of each of these lines alone at its own y (rows), at every x (columns), after the last of them.
    pub(crate) fn own_heights_of(plan: &Plan, lines: &[Line], x: &[f64]) -> Array2<f64> {
        let mut all = Self::of_all(plan, lines);
        if all.lattice.is_none() {
            return all.own_heights(x);
        }
        let mut left = 1.0;
        let mut own = Array2::zeros((lines.len(), x.len()));
        for (line, mut row) in lines.iter().zip(own.rows_mut()).rev() {
            let heights = all.own_heights_of_free(line, left);
            if let Some(row) = row.as_slice_mut() {
                read(&mut all.stretch.spectra, &heights, x, row);
            }
            left *= all.wider.left_after(line.track().length / all.r);
        }
        own
    }

    /// Û of one line alone at its own y, from a tip that is free to move across; `left` of it has not yet healed.
    fn own_heights_of_free(&mut self, line: &Line, left: f64) -> Vec<Complex64> {
        let Stretch { spectra, wave_numbers, layers: transforms } = &mut self.stretch;
        let mut sum = vec![Complex64::default(); wave_numbers.len()];
        let visits = line.visits();
        for (layer, transform) in self.footprint.layers().iter().zip(&*transforms) {
            let mut density = Density::new(spectra.spacing());
            for visit in &visits {
                let height = layer.across.value(line.track().y - visit.y);
                density.add(visit.x, -self.alpha * left * height * visit.weight);
            }
            let rho = spectra.of(&density);
            let terms = rho.iter().zip(transform);
            sum.iter_mut().zip(terms).for_each(|(sum, (rho, g))| *sum += rho * *g);
        }
        sum
    }
}

/// The rows of the groove of a line.
fn rows_of(line: &Line, lattice: Option<&RowLattice>, spectra: &mut Spectra) -> Vec<Row> {
    match lattice {
        None => vec![row_of(line, spectra)],
        Some(lattice) => rows_of_free(line, lattice, spectra),
    }
}

/// ρ̂ of a line of a tip that is held on it.
fn row_of(line: &Line, spectra: &mut Spectra) -> Row {
    let (positions, weights) = line.residence();
    let mut density = Density::new(spectra.spacing());
    positions.iter().zip(&weights).for_each(|(x, weight)| density.add(*x, *weight));
    Row { y: line.track().y, spectrum: spectra.of(&density) }
}

/// The rows of a lattice for the groove of a line of a tip that is free to move across.
fn rows_of_free(line: &Line, lattice: &RowLattice, spectra: &mut Spectra) -> Vec<Row> {
    let visits = line.visits();
    let (first, last) = lattice.touched(ends(visits.iter().map(|visit| visit.y)));
    let count = |rows: i64| usize::try_from(rows).unwrap_or(0);
    let mut densities = spectra.rows(count(last - first + 1));
    let mut shares = vec![];
    for visit in visits {
        let (from, to) = lattice.touched((visit.y, visit.y));
        shares.resize(count(to - from + 1), 0.0);
        lattice.shares(visit.y, from, &mut shares);
        shares.iter_mut().for_each(|share| *share *= visit.weight);
        densities.add(visit.x, count(from - first), &shares);
    }
    let mut row = |n: usize| {
        let spectrum = spectra.of_row(&densities, n);
        Row { y: lattice.y(first + n as i64), spectrum }
    };
    (0..densities.count()).map(&mut row).collect()
}

/// Writes S at every x, with the transform `heights`, to `at`; 0 outside the range of the lattice.
fn read(spectra: &mut Spectra, heights: &[Complex64], x: &[f64], at: &mut [f64]) {
    let field = spectra.field(heights);
    let range = field.range();
    for (at, x) in at.iter_mut().zip(x) {
        *at = if range.contains(x) { field.value(*x) } else { 0.0 };
    }
}

/// The smallest and the largest y of the lines from each one on; after the last, an empty range.
pub(crate) fn ahead(plan: &Plan) -> Vec<(f64, f64)> {
    let mut ends = (f64::INFINITY, f64::NEG_INFINITY);
    let mut ahead = vec![ends];
    for n in (0..plan.lines()).rev() {
        let y = plan.track(n).y;
        ends = (ends.0.min(y), ends.1.max(y));
        ahead.push(ends);
    }
    ahead.reverse();
    ahead
}

/// Whether two values of y are equal, so that their products can be shared.
pub(crate) fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::Path;
    use stickslip_tip::{Model, Step, TipFunction, Work, nodes_and_weights};

    fn plan() -> Plan {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let footprint = Footprint::separable(tip.clone(), 1.3).unwrap();
        Plan::new(footprint, Model::new(tip, 0.7, 1.0).unwrap(), Path::OneWay, 0.8, 61, 15.0)
    }

    /// Line n with a tip that moves evenly from `from` to `to`.
    fn line(plan: &Plan, n: usize, (from, to): (f64, f64)) -> Line {
        let h = 15.0 / 40.0;
        let step = |i: u32| {
            let t = h * f64::from(i);
            let x = from + (to - from) * f64::from(i) / 40.0;
            let nodes = nodes_and_weights().0;
            let displacement = std::array::from_fn(|j| (to - from) / 40.0 * nodes[j]);
            Step { t, h, extension: t - x, displacement, height: None }
        };
        Line::new(plan.track(n), &plan.law.model, (0..40).map(step).collect(), Work::default())
    }

    /// The sum over all lines and all nodes of their histories.
    fn direct(plan: &Plan, lines: &[Line], x: f64, y: f64) -> f64 {
        let of = |line: &Line| -> f64 {
            let (positions, weights) = line.residence();
            let visits = positions.iter().zip(&weights);
            visits.map(|(p, w)| w * plan.footprint.value(x - p, y - line.track().y)).sum()
        };
        -0.7 * lines.iter().map(of).sum::<f64>()
    }

    /// A tip far outside of its support's range extends the stretch, and the result does not depend on the time of
    /// the extension.
    #[test]
    fn a_tip_far_outside_is_held_too() {
        let plan = plan();
        let ends = [(0.0, 14.0), (-31.0, 12.0), (1.0, 14.0), (0.0, 60.0), (2.0, 13.0)];
        let lines: Vec<Line> = (0..5).map(|n| line(&plan, n, ends[n])).collect();
        let mut grooves = Grooves::new(&plan);
        for n in 1..=lines.len() {
            grooves.add(&lines[..n]);
        }
        let again = Grooves::of_all(&plan, &lines);
        for y in [0.0, 2.1, 4.0] {
            let relief = grooves.relief(&Track { y, ..plan.track(0) }).unwrap();
            let x: Vec<f64> = (0..220).map(|i| 0.5 * f64::from(i) - 40.0).collect();
            let whole = again.heights(&x, &[y]);
            for (x, whole) in x.iter().zip(&whole) {
                let wanted = direct(&plan, &lines, *x, y);
                assert!((relief.height(*x) - wanted).abs() < 1e-12, "{x} {y}");
                assert_eq!(relief.height(*x).to_bits(), whole.to_bits(), "{x} {y}");
            }
        }
    }

    /// Lines out of reach of all later ones are dropped without a change of the sum.
    #[test]
    fn no_more_lines_are_held_than_are_felt() {
        let plan = plan();
        let lines: Vec<Line> = (0..60).map(|n| line(&plan, n, (0.0, 14.0))).collect();
        let mut grooves = Grooves::new(&plan);
        for n in 1..=lines.len() {
            grooves.add(&lines[..n]);
            assert!(grooves.rows.len() <= 1 + (plan.reach_across() / 0.8) as usize);
        }
        let y = plan.track(60).y;
        let relief = grooves.relief(&plan.track(60)).unwrap();
        for x in [-2.0, 3.3, 9.0, 15.5] {
            assert!((relief.height(x) - direct(&plan, &lines, x, y)).abs() < 1e-13);
        }
    }
}
