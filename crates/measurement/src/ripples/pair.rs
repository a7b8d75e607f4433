//! Images of one area: trace and, optionally, retrace. Both show the same surface, each with offsets, slopes and noise of its
//! own.

use crate::image::{Image, ImageError};

/// Images of the trace and, optionally, of the retrace.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub(super) trace: Image,
    pub(super) retrace: Option<Image>,
    /// Distance by which the ripples of the retrace are further along the lines.
    pub(super) shift: f64,
    /// Weights of the pixels of trace and retrace, with a mean of 1.
    pub(super) weights: [f64; 2],
}

impl Pair {
    pub(super) fn alone(image: &Image) -> Self {
        Self { trace: image.clone(), retrace: None, shift: 0.0, weights: [1.0; 2] }
    }

    /// Both images, made smaller in the same way.
    pub(super) fn each(
        &self,
        smaller: impl Fn(&Image) -> Result<Image, ImageError>,
    ) -> Result<Self, ImageError> {
        let retrace = self.retrace.as_ref().map(&smaller).transpose()?;
        Ok(Self { trace: smaller(&self.trace)?, retrace, ..*self })
    }
}
