//! The points of a sweep, packed.

use super::{SourceName, SweepPoint};
use crate::RegimeName;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// The points of a sweep in 40 to 130 bytes each, where a `SweepPoint` takes more than 300: a map may have millions.
/// In a document they are an array of points.
#[derive(Clone, Default)]
pub struct SweepPoints {
    /// Pieces, none of which is moved when another is added.
    pieces: Vec<Vec<u8>>,
    /// Where each point begins: a piece, and a place in it.
    starts: Vec<(u32, u32)>,
}

/// Length of a piece in bytes, unless a single point takes more.
const PIECE: usize = 1 << 17;

impl SweepPoints {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.starts.len()
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.starts.is_empty()
    }

    /// Adds a point at the end.
    pub fn push(&mut self, point: SweepPoint) {
        let most = PIECE - 8 * (NUMBERS + point.at.len());
        if self.pieces.last().is_none_or(|piece| piece.len() + SHORT > most) {
            self.pieces.push(Vec::with_capacity(PIECE));
        }
        let place = self.pieces.len() - 1;
        self.starts.push((place as u32, self.pieces[place].len() as u32));
        pack(point, &mut self.pieces[place]);
    }

    /// The point at a place of the list.
    ///
    /// # Panics
    /// The list has no such place.
    pub fn at(&self, place: usize) -> SweepPoint {
        unpack(&mut from(&self.pieces, self.starts[place])).expect("a point was packed here")
    }

    /// The points in the order of the list.
    pub fn iter(&self) -> impl Iterator<Item = SweepPoint> + Clone {
        (0..self.len()).map(|place| self.at(place))
    }

    /// The indices of the points in the grid, in the order of the list.
    pub fn indices(&self) -> impl Iterator<Item = usize> {
        self.starts.iter().map(|start| index_at(&self.pieces, *start))
    }

    /// Sorts the points by their index.
    pub fn sort(&mut self) {
        let Self { pieces, starts } = self;
        starts.sort_unstable_by_key(|start| (index_at(pieces, *start), *start));
    }
}

impl SweepPoint {
    /// All of the point in base64: a tenth of the work of JSON.
    pub fn to_text(&self) -> String {
        let mut bytes = vec![];
        pack(self.clone(), &mut bytes);
        STANDARD.encode(bytes)
    }

    /// The point whose text this is; `None` if it is that of no point.
    pub fn from_text(text: &str) -> Option<Self> {
        let bytes = STANDARD.decode(text).ok()?;
        let mut rest = &*bytes;
        unpack(&mut rest).filter(|_| rest.is_empty())
    }
}

impl Extend<SweepPoint> for SweepPoints {
    fn extend<I: IntoIterator<Item = SweepPoint>>(&mut self, points: I) {
        points.into_iter().for_each(|point| self.push(point));
    }
}

impl FromIterator<SweepPoint> for SweepPoints {
    fn from_iter<I: IntoIterator<Item = SweepPoint>>(points: I) -> Self {
        let mut packed = Self::default();
        packed.extend(points);
        packed
    }
}

impl fmt::Debug for SweepPoints {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

impl Serialize for SweepPoints {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl<'de> Deserialize<'de> for SweepPoints {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Points)
    }
}

struct Points;

impl<'de> Visitor<'de> for Points {
    type Value = SweepPoints;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array of points")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut points: A) -> Result<SweepPoints, A::Error> {
        let mut packed = SweepPoints::default();
        while let Some(point) = points.next_element()? {
            packed.push(point);
        }
        Ok(packed)
    }
}

/// Number of fields of a point that are a number or nothing.
const NUMBERS: usize = 17;

/// The fields that are a number or nothing, in the order in which they are packed.
fn numbers(point: &mut SweepPoint) -> [&mut Option<f64>; NUMBERS] {
    [
        &mut point.width,
        &mut point.beta,
        &mut point.alpha,
        &mut point.critical_alpha,
        &mut point.period,
        &mut point.period_error,
        &mut point.wavelength,
        &mut point.wavelength_error,
        &mut point.amplitude_x0,
        &mut point.amplitude_x0_error,
        &mut point.amplitude_u,
        &mut point.amplitude_u_error,
        &mut point.mean_l,
        &mut point.deviation_l,
        &mut point.slip_distance,
        &mut point.slip_distance_error,
        &mut point.multiplier,
    ]
}

const REGIMES: [RegimeName; 6] = [
    RegimeName::Steady,
    RegimeName::StickSlip,
    RegimeName::Trapped,
    RegimeName::Transient,
    RegimeName::Drifting,
    RegimeName::Snaking,
];
const SOURCES: [SourceName; 3] = [SourceName::Stability, SourceName::Cycle, SourceName::Run];

/// Bytes of a point besides its numbers and its error.
const SHORT: usize = 26;

/// Appends a point: its index and r, a mask of the other fields that it has, and these fields.
fn pack(mut point: SweepPoint, bytes: &mut Vec<u8>) {
    let SweepPoint { index, r, regime, source, slips, .. } = point;
    let (at, error) = (std::mem::take(&mut point.at), point.error.take());
    let numbers = numbers(&mut point).map(|value| *value);
    let has = numbers.iter().enumerate();
    let has = has.fold(0_u32, |has, (i, value)| has | (u32::from(value.is_some()) << i));
    let place = |found: Option<usize>| found.map_or(0, |place| place as u8 + 1);
    let regime = place(REGIMES.iter().position(|known| Some(*known) == regime));
    let source = place(SOURCES.iter().position(|known| Some(*known) == source));
    let lengths = [slips, error.as_ref().map(String::len)];
    let [slips, long] = lengths.map(|length| u8::from(length.is_some()));
    bytes.extend((index as u32).to_le_bytes());
    bytes.extend(r.to_le_bytes());
    bytes.extend(has.to_le_bytes());
    bytes.extend([regime | source << 3 | slips << 6 | long << 7, at.len() as u8]);
    lengths.iter().flatten().for_each(|length| bytes.extend((*length as u32).to_le_bytes()));
    numbers.iter().flatten().chain(&at).for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes.extend(error.unwrap_or_default().as_bytes());
}

/// The point at the beginning of `bytes`; `None` if there is none.
fn unpack(bytes: &mut &[u8]) -> Option<SweepPoint> {
    let index = u32::from_le_bytes(take(bytes)?) as usize;
    let r = f64::from_le_bytes(take(bytes)?);
    let has = u32::from_le_bytes(take(bytes)?);
    let [kind, axes] = take(bytes)?;
    let mut length = |bit: u8| match kind >> bit & 1 {
        1 => take(bytes).map(|length| Some(u32::from_le_bytes(length) as usize)),
        _ => Some(None),
    };
    let (slips, error) = (length(6)?, length(7)?);
    let [regime, source] = [kind & 7, kind >> 3 & 7].map(usize::from);
    let mut point = SweepPoint::at(index, None, r, None);
    for (i, value) in numbers(&mut point).into_iter().enumerate() {
        if has >> i & 1 == 1 {
            *value = Some(f64::from_le_bytes(take(bytes)?));
        }
    }
    point.at = (0..axes).map(|_| take(bytes).map(f64::from_le_bytes)).collect::<Option<_>>()?;
    point.regime = regime.checked_sub(1).and_then(|place| REGIMES.get(place).copied());
    point.source = source.checked_sub(1).and_then(|place| SOURCES.get(place).copied());
    point.slips = slips;
    if let Some(length) = error {
        let (text, rest) = bytes.split_at_checked(length)?;
        point.error = Some(String::from_utf8_lossy(text).into_owned());
        *bytes = rest;
    }
    Some(point)
}

fn index_at(pieces: &[Vec<u8>], start: (u32, u32)) -> usize {
    take(&mut from(pieces, start)).map_or(0, u32::from_le_bytes) as usize
}

fn from(pieces: &[Vec<u8>], (piece, start): (u32, u32)) -> &[u8] {
    &pieces[piece as usize][start as usize..]
}

/// The next bytes, if there are as many.
fn take<const N: usize>(bytes: &mut &[u8]) -> Option<[u8; N]> {
    let (taken, rest) = bytes.split_first_chunk()?;
    *bytes = rest;
    Some(*taken)
}
