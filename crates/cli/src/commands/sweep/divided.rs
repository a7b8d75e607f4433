//! Sweeps computed in parts: conditions for combining documents, and detection of changes.

use crate::arithmetic::arithmetic;
use crate::commands::finished::Part;
use crate::commands::job::Product;
use crate::failure::Failure;
use crate::files::journal::Hashing;
use crc32fast::Hasher;
use serde::Serialize;
use stickslip::{
    Ask, Document, EnsembleDocument, Physical, Points, RasterSweep, RasterSweepDocument,
    RasterSweepFound, RasterSweepPoint, ShardDocument, Software, SweepDocument, SweepFound,
    SweepParameters, SweepPoint,
};
use stickslip_figures::{FigureError, judge_sweep};

/// A document of points that may be computed in parts.
pub(crate) trait Divided: Product + Physical {
    /// A point of the document.
    type Point: Part;
    /// Parameters of all points.
    type Parameters: PartialEq + Ask + Points;

    /// The document of these points.
    fn of(parameters: Self::Parameters, points: <Self::Point as Part>::All) -> Self;

    /// The parameters of the document.
    fn parameters(&self) -> &Self::Parameters;

    /// The version that wrote the document.
    fn software(&self) -> &Software;

    /// The fields that merging changes.
    fn held(&mut self) -> Held<'_, Self::Point>;

    /// The points in this document, by rising index.
    fn points(&self) -> &<Self::Point as Part>::All;

    /// Whether both documents belong to the same grid and were written by the same version.
    fn is_of(&self, other: &Self) -> bool {
        self.parameters() == other.parameters() && self.software() == other.software()
    }

    /// CRC-32 of parameters, points and arithmetic as this program writes them, independent of the layout of the
    /// document.
    fn checksum(&self) -> Result<u32, Failure>;

    /// Adds results that need all points together.
    fn found_together(self) -> Self {
        self
    }

    /// Rejects sweeps that no picture can show.
    fn judge_picture(&self) -> Result<(), FigureError> {
        Ok(())
    }

    /// The finished document, with its checksum.
    fn sealed(self) -> Result<Self, Failure> {
        let mut document = self.found_together();
        let sum = document.checksum()?;
        *document.held().crc32 = Some(sum);
        Ok(document)
    }
}

/// The fields of a part that merging changes.
pub(crate) struct Held<'a, P: Part> {
    pub(super) shard: &'a mut Option<ShardDocument>,
    pub(super) points: &'a mut P::All,
    pub(super) arithmetic: &'a mut Option<String>,
    pub(super) crc32: &'a mut Option<u32>,
}

/// Implements the methods that return fields of the same name.
macro_rules! by_fields {
    ($point:ty, $parameters:ty, $found:expr) => {
        type Point = $point;
        type Parameters = $parameters;

        fn of(parameters: $parameters, points: <$point as Part>::All) -> Self {
            Document::new(parameters, $found(points), vec![])
        }

        fn held(&mut self) -> Held<'_, $point> {
            let found = &mut self.answer;
            Held {
                shard: &mut self.parameters.shard,
                points: &mut found.points,
                arithmetic: &mut found.arithmetic,
                crc32: &mut found.crc32,
            }
        }

        fn points(&self) -> &<$point as Part>::All {
            &self.points
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
    by_fields!(SweepPoint, SweepParameters, |points| SweepFound {
        points,
        ensembles: None,
        arithmetic: Some(arithmetic().into()),
        crc32: None
    });

    fn found_together(mut self) -> Self {
        self.ensembles = EnsembleDocument::all(&self.parameters, &self.points);
        self
    }

    fn judge_picture(&self) -> Result<(), FigureError> {
        judge_sweep(&self.parameters)
    }
}

impl Divided for RasterSweepDocument {
    by_fields!(RasterSweepPoint, RasterSweep, |points| RasterSweepFound {
        points,
        arithmetic: Some(arithmetic().into()),
        crc32: None
    });
}

fn sum(written: &impl Serialize) -> Result<u32, Failure> {
    let mut sum = Hasher::new();
    stickslip::write(&mut Hashing(&mut sum), written).map_err(Failure::run)?;
    Ok(sum.finalize())
}
