//! What is swept in parts: what makes documents of parts those of one whole, and how it is told that one was changed.

use crate::commands::finished::Part;
use crate::commands::job::Product;
use crate::failure::Failure;
use serde::Serialize;
use serde::de::DeserializeOwned;
use stickslip::{
    EnsembleDocument, Physical, RasterSweepDocument, RasterSweepParameters, RasterSweepPoint,
    ShardDocument, Software, SweepDocument, SweepParameters, SweepPoint,
};
use stickslip_figures::{Drawn, FigureError, judge_sweep};

/// A document of points that may be computed in parts.
pub(crate) trait Divided:
    Product + Drawn + Physical + DeserializeOwned + Clone + Send + Sync + 'static
{
    /// One of them.
    type Point: Part;
    /// What is asked of all points.
    type Parameters: PartialEq;
    /// Its `format`.
    const FORMAT: &'static str;

    /// What it was asked for.
    fn parameters(&self) -> &Self::Parameters;

    /// The version that wrote it.
    fn software(&self) -> &Software;

    /// What merging changes.
    fn held(&mut self) -> Held<'_, Self::Point>;

    /// Those that are here, by rising index.
    fn points(&self) -> &[Self::Point];

    /// Those of the whole grid.
    fn count(&self) -> usize;

    /// Whether both are of the same grid, and written by the same version.
    fn is_of(&self, other: &Self) -> bool {
        self.parameters() == other.parameters() && self.software() == other.software()
    }

    /// CRC-32 of parameters, points and how the machine rounds, as this program writes them, however the document is
    /// laid out.
    fn checksum(&self) -> Result<u32, Failure>;

    /// The one r of all points, if there is one.
    fn velocity(&self) -> Option<f64>;

    /// The same with what all points together tell.
    fn told_together(self) -> Self {
        self
    }

    /// Refuses what no picture shows.
    fn judge_picture(&self) -> Result<(), FigureError> {
        Ok(())
    }

    /// The finished document, with its checksum.
    fn sealed(self) -> Result<Self, Failure> {
        let mut document = self.told_together();
        let sum = document.checksum()?;
        *document.held().crc32 = Some(sum);
        Ok(document)
    }
}

/// Of a part.
pub(crate) struct Held<'a, P> {
    pub(super) shard: &'a mut Option<ShardDocument>,
    pub(super) points: &'a mut Vec<P>,
    pub(super) arithmetic: &'a mut Option<String>,
    pub(super) crc32: &'a mut Option<u32>,
}

/// What is read off fields of the same names.
macro_rules! by_fields {
    ($point:ty, $parameters:ty) => {
        type Point = $point;
        type Parameters = $parameters;
        const FORMAT: &'static str = Self::FORMAT;

        fn held(&mut self) -> Held<'_, $point> {
            let found = &mut self.answer;
            Held {
                shard: &mut self.parameters.shard,
                points: &mut found.points,
                arithmetic: &mut found.arithmetic,
                crc32: &mut found.crc32,
            }
        }

        fn points(&self) -> &[$point] {
            &self.points
        }

        fn count(&self) -> usize {
            self.parameters.points()
        }

        fn parameters(&self) -> &$parameters {
            &self.parameters
        }

        fn software(&self) -> &Software {
            &self.software
        }

        fn checksum(&self) -> Result<u32, Failure> {
            sum(&(&self.parameters, &self.points, &self.arithmetic))
        }
    };
}

impl Divided for SweepDocument {
    by_fields!(SweepPoint, SweepParameters);

    fn velocity(&self) -> Option<f64> {
        self.parameters.velocity()
    }

    fn told_together(mut self) -> Self {
        self.ensembles = EnsembleDocument::all(&self.parameters, &self.points);
        self
    }

    fn judge_picture(&self) -> Result<(), FigureError> {
        judge_sweep(&self.parameters)
    }
}

impl Divided for RasterSweepDocument {
    by_fields!(RasterSweepPoint, RasterSweepParameters);

    fn velocity(&self) -> Option<f64> {
        Some(self.parameters.r)
    }
}

fn sum(written: &impl Serialize) -> Result<u32, Failure> {
    let text = serde_json::to_vec(written);
    Ok(crc32fast::hash(&text.map_err(|error| Failure::Run(error.to_string()))?))
}
