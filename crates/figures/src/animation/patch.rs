//! The part of a frame that differs from the frame before.

use super::palette::Palette;
use crate::error::FigureError;

/// Largest difference of a channel (0 to 255) at which a pixel is left as it is; palette colours are off by as much.
pub(super) const NEAR: u8 = 8;

/// A writer of frames.
pub(super) trait Writer {
    /// Appends a frame that is shown for this time.
    fn frame(&mut self, patch: &Patch, milliseconds: u32) -> Result<(), FigureError>;

    /// The bytes of the file.
    fn finish(self: Box<Self>) -> Result<Vec<u8>, FigureError>;
}

/// A rectangle of pixels; an unchanged pixel is `None`. Its left and upper edges are even, as WebP requires.
pub(super) struct Patch {
    pub(super) left: usize,
    pub(super) top: usize,
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) pixels: Vec<Option<[u8; 3]>>,
}

impl Patch {
    /// The smallest rectangle with all pixels that differ; all of the first frame, one pixel of a frame without a
    /// change.
    pub(super) fn between(
        before: Option<&[u8]>,
        now: &[u8],
        (width, height): (usize, usize),
    ) -> Self {
        let Some(before) = before else {
            let pixels = now.as_chunks().0.iter().copied().map(Some).collect();
            return Self { left: 0, top: 0, width, height, pixels };
        };
        let [(before, _), (now, _)] = [before, now].map(<[u8]>::as_chunks::<3>);
        let (mut left, mut right, mut top, mut bottom) = (width, 0, height, 0);
        for y in 0..height {
            let row = width * y..width * (y + 1);
            let (a, b) = (&before[row.clone()], &now[row]);
            if a == b {
                continue;
            }
            (top, bottom) = (top.min(y), y + 1);
            let differs = |i: &usize| a[*i] != b[*i];
            let first = (0..width).find(differs).unwrap_or(width);
            let last = (0..width).rev().find(differs).map_or(0, |i| i + 1);
            (left, right) = (left.min(first), right.max(last));
        }
        if top >= bottom {
            (left, right, top, bottom) = (0, 1, 0, 1);
        }
        let (left, top) = (left - left % 2, top - top % 2);
        let mut pixels = Vec::with_capacity((right - left) * (bottom - top));
        for y in top..bottom {
            let places = width * y + left..width * y + right;
            pixels.extend(places.map(|i| (before[i] != now[i]).then_some(now[i])));
        }
        Self { left, top, width: right - left, height: bottom - top, pixels }
    }

    /// Replaces colours by those of the palette. Pixels that already show a colour within `near` of the new one are
    /// dropped, because heights beside a line change a little with each line. `shown` contains the palette index of each
    /// pixel of the frame, which has this width.
    pub(super) fn reduce(
        &mut self,
        palette: &mut Palette,
        shown: &mut [u8],
        width: usize,
        near: u8,
    ) {
        for (i, pixel) in self.pixels.iter_mut().enumerate() {
            let Some(colour) = *pixel else { continue };
            let place =
                &mut shown[width * (self.top + i / self.width) + self.left + i % self.width];
            if palette.colour(*place).is_some_and(|there| is_near(there, colour, near)) {
                *pixel = None;
                continue;
            }
            *place = palette.index(colour);
            *pixel = palette.colour(*place);
        }
    }
}

/// Whether no channel differs by more than `near`.
fn is_near(a: [u8; 3], b: [u8; 3], near: u8) -> bool {
    a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_close_to_those_shown_are_left_and_others_replaced() {
        let mut palette = Palette::of(&[vec![10, 10, 10, 200, 200, 200]]);
        let mut shown = vec![0; 2];
        for (now, seen) in [(12, Some([10; 3])), (18, None), (190, Some([200; 3])), (192, None)] {
            let pixels = vec![Some([now; 3]), None];
            let mut patch = Patch { left: 0, top: 0, width: 2, height: 1, pixels };
            patch.reduce(&mut palette, &mut shown, 2, NEAR);
            assert_eq!(patch.pixels, [seen, None], "{now}");
        }
    }

    #[test]
    fn a_patch_holds_all_that_differs_and_no_more() {
        let size = (6, 5);
        let before = vec![7; 3 * 30];
        let mut now = before.clone();
        for (x, y) in [(3, 2), (4, 3)] {
            now[3 * (6 * y + x) + 1] = 9;
        }
        let patch = Patch::between(Some(&before), &now, size);
        assert_eq!((patch.left, patch.top, patch.width, patch.height), (2, 2, 3, 2));
        let changed = Some([7, 9, 7]);
        assert_eq!(patch.pixels, [None, changed, None, None, None, changed]);
        let same = Patch::between(Some(&now), &now, size);
        assert_eq!((same.width, same.height, &same.pixels[..]), (1, 1, &[None][..]));
        assert_eq!(Patch::between(None, &now, size).pixels.len(), 30);
    }
}
