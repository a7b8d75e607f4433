//! WebP: lossless pictures by the crate image-webp, in the container of an animation (RFC 9649, section 2.7).

use super::patch::{Patch, Writer};
use crate::error::{FigureError, unpacked};
use crate::picture::side;
use image_webp::{ColorType, EncoderParams, WebPEncoder};

/// Flags of VP8X for transparency and animation.
const ALPHA: u8 = 1 << 4;
const ANIMATION: u8 = 1 << 1;
/// Bytes before the first chunk of a file, and of the header of a chunk.
const FILE_HEAD: usize = 12;
const CHUNK_HEAD: usize = 8;

pub(super) struct Webp {
    chunks: Vec<u8>,
}

impl Webp {
    pub(super) fn new((width, height): (usize, usize)) -> Self {
        let mut chunks = vec![];
        let mut head = vec![ALPHA | ANIMATION, 0, 0, 0];
        head.extend(three(width - 1));
        head.extend(three(height - 1));
        push(&mut chunks, b"VP8X", &head);
        // White, and repeated for ever.
        push(&mut chunks, b"ANIM", &[255, 255, 255, 255, 0, 0]);
        Self { chunks }
    }
}

impl Writer for Webp {
    fn frame(&mut self, patch: &Patch, milliseconds: u32) -> Result<(), FigureError> {
        let rgba = |pixel: &Option<[u8; 3]>| pixel.map_or([0; 4], |[r, g, b]| [r, g, b, 255]);
        let pixels: Vec<u8> = patch.pixels.iter().flat_map(rgba).collect();
        let size = (patch.width, patch.height);
        // Differences between neighbours are small in a whole picture, and large where changed pixels are few.
        let (plain, predicted) = (encoded(&pixels, size, false)?, encoded(&pixels, size, true)?);
        let file = if plain.len() < predicted.len() { plain } else { predicted };
        let mut frame = vec![];
        for number in [
            patch.left / 2,
            patch.top / 2,
            patch.width - 1,
            patch.height - 1,
            milliseconds as usize,
        ] {
            frame.extend(three(number));
        }
        // Drawn over the frame before, and left there.
        frame.push(0);
        frame.extend(&file[FILE_HEAD..]);
        push(&mut self.chunks, b"ANMF", &frame);
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<Vec<u8>, FigureError> {
        let mut file = b"RIFF".to_vec();
        file.extend(four(self.chunks.len() + 4));
        file.extend(b"WEBP");
        file.extend(self.chunks);
        Ok(file)
    }
}

/// A file of one picture, of pixels or of their differences from a prediction by their neighbours.
fn encoded(
    pixels: &[u8],
    (width, height): (usize, usize),
    is_predicted: bool,
) -> Result<Vec<u8>, FigureError> {
    let mut params = EncoderParams::default();
    params.use_predictor_transform = is_predicted;
    let mut file = vec![];
    let mut encoder = WebPEncoder::new(&mut file);
    encoder.set_params(params);
    encoder.encode(pixels, side(width), side(height), ColorType::Rgba8).map_err(unpacked)?;
    Ok(file)
}

/// Appends a chunk: its name, its length, and its content, of even length.
fn push(chunks: &mut Vec<u8>, name: &[u8; 4], content: &[u8]) {
    chunks.reserve(CHUNK_HEAD + content.len() + 1);
    chunks.extend(name);
    chunks.extend(four(content.len()));
    chunks.extend(content);
    chunks.extend((content.len() % 2 == 1).then_some(0));
}

fn four(number: usize) -> [u8; 4] {
    side(number).to_le_bytes()
}

fn three(number: usize) -> [u8; 3] {
    let [a, b, c, _] = four(number);
    [a, b, c]
}
