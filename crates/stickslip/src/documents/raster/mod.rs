//! Documents of rasters.

mod compare;
mod found;
mod height_map;
mod heights;
mod kept;
mod lines;
mod sweep;

pub use compare::{
    ComparedLine, RasterCompareDocument, RasterCompareFound, RasterCompareParameters,
    RasterCompared, RasterComparedWork,
};
pub use found::RasterFound;
pub use height_map::HeightMap;
pub use heights::RasterSurfaceDocument;
pub use kept::KeptLine;
pub use lines::{LineHistory, RasterHistory, RasterLine, RasterSamples};
pub use sweep::{RasterSweepFound, RasterSweepPoint};
