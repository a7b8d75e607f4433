//! Documents of rasters.

mod compare;
mod found;
mod height_map;
mod heights;
mod lines;
mod pattern;
mod sweep;

pub use compare::{
    ComparedLine, RasterCompareDocument, RasterCompareFound, RasterCompareParameters,
    RasterCompared, RasterComparedWork,
};
pub use found::{RasterFound, RasterWork};
pub use height_map::HeightMap;
pub use heights::RasterSurfaceDocument;
pub use lines::{KeptLine, LineHistory, LineRegimeName, RasterHistory, RasterLine, RasterSamples};
pub use pattern::{PatternDocument, RasterRegimeName};
pub use sweep::{RasterSweepFound, RasterSweepPoint};
