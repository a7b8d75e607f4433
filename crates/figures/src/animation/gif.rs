//! GIF, by the crate gif.

use super::palette::Palette;
use super::patch::{Patch, Writer};
use crate::error::{FigureError, unpacked};
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use std::borrow::Cow;

pub(super) struct Gif {
    encoder: Encoder<Vec<u8>>,
    palette: Palette,
}

impl Gif {
    pub(super) fn new(
        (width, height): (usize, usize),
        palette: Palette,
    ) -> Result<Self, FigureError> {
        let mut encoder =
            Encoder::new(vec![], side(width), side(height), &palette.bytes()).map_err(unpacked)?;
        encoder.set_repeat(Repeat::Infinite).map_err(unpacked)?;
        Ok(Self { encoder, palette })
    }
}

impl Writer for Gif {
    fn frame(&mut self, patch: &Patch, milliseconds: u32) -> Result<(), FigureError> {
        let frame = Frame {
            delay: u16::try_from(milliseconds / 10).unwrap_or(u16::MAX),
            dispose: DisposalMethod::Keep,
            transparent: Some(0),
            left: side(patch.left),
            top: side(patch.top),
            width: side(patch.width),
            height: side(patch.height),
            buffer: Cow::Owned(self.palette.indices(&patch.pixels)),
            ..Frame::default()
        };
        self.encoder.write_frame(&frame).map_err(unpacked)
    }

    fn finish(self: Box<Self>) -> Result<Vec<u8>, FigureError> {
        self.encoder.into_inner().map_err(unpacked)
    }
}

/// A length in pixels; the number of pixels of a frame is limited far below this type's range.
fn side(length: usize) -> u16 {
    u16::try_from(length).unwrap_or(u16::MAX)
}
