//! APNG, by the crate png.

use super::palette::Palette;
use super::patch::{Patch, Writer};
use crate::error::{FigureError, unpacked};
use crate::picture::side;
use png::{BlendOp, DisposeOp, EncodingError, Filter};

pub(super) struct Apng {
    size: (usize, usize),
    palette: Palette,
    /// All frames; the file is written at the end, because it begins with their number.
    parts: Vec<Part>,
}

struct Part {
    place: [u32; 4],
    indices: Vec<u8>,
    milliseconds: u32,
}

impl Apng {
    pub(super) fn new(size: (usize, usize), palette: Palette) -> Self {
        Self { size, palette, parts: vec![] }
    }

    fn written(&self) -> Result<Vec<u8>, EncodingError> {
        let mut bytes = vec![];
        let mut encoder = png::Encoder::new(&mut bytes, side(self.size.0), side(self.size.1));
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_palette(self.palette.bytes());
        encoder.set_trns(vec![0]);
        encoder.set_filter(Filter::NoFilter);
        encoder.set_compression(png::Compression::Balanced);
        encoder.set_animated(side(self.parts.len()), 0)?;
        let mut writer = encoder.write_header()?;
        for part in &self.parts {
            let [left, top, width, height] = part.place;
            writer.reset_frame_position()?;
            writer.set_frame_dimension(width, height)?;
            writer.set_frame_position(left, top)?;
            writer.set_blend_op(BlendOp::Over)?;
            writer.set_dispose_op(DisposeOp::None)?;
            writer.set_frame_delay(u16::try_from(part.milliseconds).unwrap_or(u16::MAX), 1000)?;
            writer.write_image_data(&part.indices)?;
        }
        writer.finish()?;
        Ok(bytes)
    }
}

impl Writer for Apng {
    fn frame(&mut self, patch: &Patch, milliseconds: u32) -> Result<(), FigureError> {
        let place = [patch.left, patch.top, patch.width, patch.height].map(side);
        let indices = self.palette.indices(&patch.pixels);
        self.parts.push(Part { place, indices, milliseconds });
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<Vec<u8>, FigureError> {
        self.written().map_err(unpacked)
    }
}
