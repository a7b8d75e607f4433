//! Definition of a raster, and its validity.

use crate::area::Area;
use crate::error::RasterError;
use crate::free::Free;
use crate::path::{Path, Track};
use stickslip_tip::planar::RowLattice;
use stickslip_tip::sorting::ends;
use stickslip_tip::{Footprint, Force, Model, Scenario, Start};

/// Definition of a raster. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone)]
pub struct Plan {
    /// f(x,y); the tip of the model is f(x,0).
    pub footprint: Footprint,
    /// The path of the support from one line to the next.
    pub path: Path,
    /// The scanned area.
    pub area: Area,
    /// Motion across the lines; `None` for a tip that is held on its line.
    pub free: Option<Free>,
    /// External force on the first line, against the time since its start; the groove of this line disturbs all later
    /// ones.
    pub disturbance: Force,
    /// The law, the tolerance and the memory of every line; start, end, kick and force are set for each line.
    pub law: Scenario,
}

/// Largest number of lines within reach of one line.
const MOST_WITHIN_REACH: f64 = 1e4;
/// Memory of a line per wave number, in bytes: one complex amplitude.
const BYTES_OF_A_WAVE: f64 = 16.0;
/// Memory of the lattice per wave number, in bytes: sums, transforms and workspace of four cells.
const BYTES_OF_THE_LATTICE: f64 = 320.0;
/// Memory of the surface around a line per wave number and layer, in bytes, for a tip that is free to move across:
/// heights and slopes on some sixty rows.
const BYTES_OF_ROWS: f64 = 4000.0;
const MOST_MEMORY: f64 = 1e9;
/// Largest number of lattice points of a line.
const MOST_POINTS: f64 = 1e7;
/// Distance in widths at which a Gaussian is negligible: e^{-40.5} = 2.6e-18.
pub(crate) const WIDTHS: f64 = 9.0;

impl Plan {
    /// Lines on a flat surface with the law of `model` and a tolerance of 1e-9.
    pub fn new(
        footprint: Footprint,
        model: Model,
        path: Path,
        pitch: f64,
        lines: usize,
        length: f64,
    ) -> Self {
        Self::over(footprint, model, path, Area::Rectangle { pitch, lines, length })
    }

    /// Lines of any area, otherwise as [`new`](Self::new).
    pub fn over(footprint: Footprint, model: Model, path: Path, area: Area) -> Self {
        let law = Scenario::new(model, area.longest());
        Self { footprint, path, area, free: None, disturbance: Force::default(), law }
    }

    /// The same plan for a tip that is free to move across the lines.
    #[must_use]
    pub fn with_free(self, free: Free) -> Self {
        Self { free: Some(free), ..self }
    }

    /// # Errors
    /// The first parameter that is out of range.
    pub fn validate(&self) -> Result<(), RasterError> {
        if !self.law.model.wider().spring {
            return Err(RasterError::NoSpring);
        }
        let layers = self.footprint.layers().iter();
        if layers.clone().any(|layer| layer.along.reach().is_none()) {
            return Err(RasterError::NeverFades);
        }
        let section = self.footprint.path();
        let differs = |x: f64| (section.value(x) - self.law.model.tip().value(x)).abs() > 1e-12;
        if (-20..20).any(|i| differs(0.37 * f64::from(i) * 8.7 / section.band())) {
            return Err(RasterError::Section);
        }
        let (reach, most) = (self.reach_across(), MOST_POINTS / self.band());
        match (&self.area, self.path) {
            (Area::Rectangle { pitch, length, .. }, path) => {
                let (pitch, length, least) = (*pitch, *length, reach / MOST_WITHIN_REACH);
                if path != Path::Repeat && !(pitch.is_finite() && pitch >= least) {
                    return Err(RasterError::Pitch { pitch, reach, least });
                }
                if !(length > 0.0 && length <= most) {
                    return Err(RasterError::Length { length, most });
                }
            }
            (Area::Lines(_), Path::Repeat) => return Err(RasterError::RepeatedArea),
            (Area::Lines(_), _) => {}
        }
        self.area.validate(most, (reach, MOST_WITHIN_REACH))?;
        self.judge_memory(0.0)?;
        let longest =
            Scenario { until: self.duration_of(self.area.longest()), ..self.line(0, (0.0, 0.0)) };
        longest.validate().map_err(|error| RasterError::Line { line: 1, error })?;
        match &self.free {
            Some(free) => free.validate(&self.footprint, longest),
            None => Ok(()),
        }
    }

    /// Rejects rasters whose grooves do not fit in memory, with tips up to `outside` beyond the range of their
    /// supports.
    ///
    /// # Errors
    /// The grooves take more than a gigabyte.
    pub fn judge_memory(&self, outside: f64) -> Result<(), RasterError> {
        let (low, high) = self.area.ends();
        // The stretch of the lattice is made longer by doubling what lies beside the supports.
        let period = high - low + 6.0 * self.reach_along() + 4.0 * outside;
        let waves = period * self.band() / std::f64::consts::TAU;
        let rows = if self.path == Path::Repeat { 1 } else { self.lines() };
        let (stored, lattice) = match self.free {
            None => (rows as f64, BYTES_OF_THE_LATTICE),
            Some(_) => (self.rows(), BYTES_OF_ROWS * self.footprint.layers().len() as f64),
        };
        let bytes = waves * (BYTES_OF_A_WAVE * stored + lattice);
        if bytes <= MOST_MEMORY {
            return Ok(());
        }
        Err(RasterError::Memory { lines: rows, extent: high - low + 2.0 * outside, bytes })
    }

    /// Number of rows that the grooves of a tip that is free to move across occupy, if it remains near its lines.
    fn rows(&self) -> f64 {
        let (low, high) = ends((0..self.lines()).map(|n| self.track(n).y));
        let (spacing, reach) = (RowLattice::of(&self.footprint).y(1), 2.0 * self.reach_across());
        (high - low + reach).min(reach * self.lines() as f64) / spacing
    }

    /// Number of lines.
    pub fn lines(&self) -> usize {
        self.area.len()
    }

    /// Line number n, counted from 0.
    pub fn track(&self, n: usize) -> Track {
        self.area.track(self.path, n)
    }

    /// Duration X/r of line number n, counted from 0.
    pub fn duration(&self, n: usize) -> f64 {
        self.duration_of(self.track(n).length)
    }

    /// Time in which the support moves this distance.
    pub fn duration_of(&self, length: f64) -> f64 {
        length / self.law.model.r()
    }

    /// The run of line n in its frame, where the support moves to larger x, and the footprint of a retrace is mirrored. The
    /// tip starts `ahead` of the support, with this velocity if it has inertia.
    pub(crate) fn line(&self, n: usize, (ahead, velocity): (f64, f64)) -> Scenario {
        let has_inertia = self.law.model.wider().inertia.is_some();
        Scenario {
            start: Start::Flat,
            start_position: 0.0,
            kick: -ahead,
            start_velocity: has_inertia.then_some(velocity),
            path: None,
            until: self.duration(n),
            force: if n == 0 { self.disturbance.clone() } else { Force::default() },
            model: if self.track(n).backward {
                self.law.model.mirrored()
            } else {
                self.law.model.clone()
            },
            ..self.law.clone()
        }
    }

    /// Largest distance in y over which a line has an effect.
    pub fn reach_across(&self) -> f64 {
        let of = |across: &stickslip_tip::Across| across.center + WIDTHS * across.width;
        self.footprint.layers().iter().map(|layer| of(&layer.across)).fold(0.0, f64::max)
    }

    /// Largest distance in x over which a groove has an effect.
    pub(crate) fn reach_along(&self) -> f64 {
        let layers = self.footprint.layers().iter();
        layers.filter_map(|layer| layer.along.reach()).fold(0.0, f64::max)
    }

    /// Largest wave number in x of all layers.
    pub(crate) fn band(&self) -> f64 {
        self.footprint.layers().iter().map(|layer| layer.along.band()).fold(0.0, f64::max)
    }
}
