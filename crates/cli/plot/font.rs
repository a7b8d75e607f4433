//! The font DejaVu Sans, which kuva carries.
//!
//! kuva gives its fonts away only inside an SVG, as data URLs: the first of them is the regular
//! face.

use kuva::backend::svg::SvgBackend;
use kuva::render::render::Scene;

const OPENING: &str = "data:font/truetype;base64,";

/// The bytes of the TrueType file; empty should kuva ever change its ways, which a test would tell.
pub(super) fn dejavu_sans() -> Vec<u8> {
    let svg = SvgBackend::new().with_embedded_font(true).render_scene(&Scene::new(1.0, 1.0));
    let encoded = svg.split_once(OPENING).and_then(|(_, rest)| rest.split_once('\''));
    encoded.map(|(text, _)| from_base64(text)).unwrap_or_default()
}

/// Decodes up to the padding.
fn from_base64(text: &str) -> Vec<u8> {
    let values: Vec<u8> = text.bytes().map_while(six_bits).collect();
    let mut bytes = Vec::with_capacity(values.len() * 3 / 4);
    for group in values.chunks(4) {
        let bits = group.iter().fold(0, |bits, &v| bits << 6 | u32::from(v));
        let bits = bits << (6 * (4 - group.len()));
        bytes.extend_from_slice(&bits.to_be_bytes()[1..group.len()]);
    }
    bytes
}

fn six_bits(letter: u8) -> Option<u8> {
    match letter {
        b'A'..=b'Z' => Some(letter - b'A'),
        b'a'..=b'z' => Some(letter - b'a' + 26),
        b'0'..=b'9' => Some(letter - b'0' + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_decoded_with_and_without_padding() {
        assert_eq!(from_base64("c3RpY2s="), b"stick");
        assert_eq!(from_base64("c2xpcA=="), b"slip");
        assert_eq!(from_base64("QUZN"), b"AFM");
    }

    #[test]
    fn kuva_still_carries_a_truetype_font() {
        let font = dejavu_sans();
        assert_eq!(font[..4], [0, 1, 0, 0]);
        assert!(font.len() > 500_000);
    }
}
