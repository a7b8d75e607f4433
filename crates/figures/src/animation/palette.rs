//! At most 255 colours for all frames; the index 0 is transparent.

use std::collections::HashMap;

/// If there are too many colours, those with the same leading bits of each channel, of this number, are joined.
const BITS: u8 = 5;
const MOST: usize = 255;

/// A palette, and the indices of the colours found so far.
#[derive(Clone)]
pub(super) struct Palette {
    colours: Vec<[u8; 3]>,
    known: HashMap<[u8; 3], u8>,
}

/// A group of similar colours: the sum of each channel, and the number of pixels.
#[derive(Default, Clone, Copy)]
struct Group {
    sum: [u64; 3],
    count: u64,
}

impl Palette {
    /// The colours of these frames: all of them, or the means of the most frequent groups of similar ones.
    pub(super) fn of(frames: &[Vec<u8>]) -> Self {
        let mut counts: HashMap<[u8; 3], u64> = HashMap::new();
        for pixel in frames.iter().flat_map(|frame| frame.as_chunks().0) {
            *counts.entry(*pixel).or_default() += 1;
        }
        let mut colours: Vec<[u8; 3]> =
            if counts.len() <= MOST { counts.into_keys().collect() } else { means(counts) };
        colours.sort_unstable();
        Self { colours, known: HashMap::new() }
    }

    /// Red, green and blue of every index.
    pub(super) fn bytes(&self) -> Vec<u8> {
        [[0; 3]].iter().chain(&self.colours).flatten().copied().collect()
    }

    /// The indices of these pixels: of the nearest colour, 0 for none.
    pub(super) fn indices(&mut self, pixels: &[Option<[u8; 3]>]) -> Vec<u8> {
        pixels.iter().map(|pixel| pixel.map_or(0, |colour| self.index(colour))).collect()
    }

    /// The colour of an index; `None` of 0.
    pub(super) fn colour(&self, index: u8) -> Option<[u8; 3]> {
        self.colours.get(usize::from(index).checked_sub(1)?).copied()
    }

    /// The index of the nearest colour.
    pub(super) fn index(&mut self, colour: [u8; 3]) -> u8 {
        if let Some(index) = self.known.get(&colour) {
            return *index;
        }
        let apart = |other: &[u8; 3]| -> u32 {
            other.iter().zip(colour).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
        };
        let nearest = (1..=255_u8).zip(&self.colours).min_by_key(|(_, other)| apart(other));
        let index = nearest.map_or(0, |(index, _)| index);
        self.known.insert(colour, index);
        index
    }
}

/// Means of the most frequent groups.
fn means(counts: HashMap<[u8; 3], u64>) -> Vec<[u8; 3]> {
    let mut groups: HashMap<[u8; 3], Group> = HashMap::new();
    for (colour, count) in counts {
        let group = groups.entry(colour.map(|c| c >> (8 - BITS))).or_default();
        group.count += count;
        group.sum.iter_mut().zip(colour).for_each(|(sum, c)| *sum += count * u64::from(c));
    }
    let mut groups: Vec<([u8; 3], Group)> = groups.into_iter().collect();
    // The largest first, equal ones in the order of their colours.
    groups.sort_unstable_by_key(|(key, group)| (std::cmp::Reverse(group.count), *key));
    groups.truncate(MOST);
    let mean = |(_, Group { sum, count }): &([u8; 3], Group)| {
        sum.map(|sum| ((sum + count / 2) / count).min(255) as u8)
    };
    groups.iter().map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_and_many_are_met_closely() {
        let few: Vec<u8> = (0..=200).flat_map(|i| [i, 255 - i, 7]).collect();
        let mut palette = Palette::of(std::slice::from_ref(&few));
        for colour in few.as_chunks().0 {
            let index = usize::from(palette.indices(&[Some(*colour)])[0]);
            assert_eq!(palette.bytes()[3 * index..3 * index + 3], *colour);
        }
        assert_eq!(palette.indices(&[None]), [0]);
        let ramp: Vec<u8> =
            (0..=255_u8).flat_map(|r| (0..8).flat_map(move |g| [r, g, r])).collect();
        let mut palette = Palette::of(std::slice::from_ref(&ramp));
        assert!(palette.bytes().len() <= 3 * 256);
        for colour in ramp.as_chunks().0 {
            let index = usize::from(palette.indices(&[Some(*colour)])[0]);
            let found = &palette.bytes()[3 * index..3 * index + 3];
            assert!(found.iter().zip(colour).all(|(a, b)| a.abs_diff(*b) <= 8), "{colour:?}");
        }
    }
}
