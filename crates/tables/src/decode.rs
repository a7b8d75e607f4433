//! Decoding of text: UTF-8, UTF-16 and Windows-1252 (which includes Latin-1), with or without a byte order mark.

/// Windows-1252 from 0x80 to 0x9f, with NUL for undefined characters. From 0xa0 on it agrees with Latin-1 and
/// Unicode.
const WINDOWS_1252: [char; 32] = [
    '€', '\0', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\0', 'Ž', '\0', '\0', '‘',
    '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\0', 'ž', 'Ÿ',
];

/// The text of a file, without a byte order mark.
///
/// # Errors
///
/// The bytes are not text, with the first line that is not.
pub fn decoded(bytes: Vec<u8>) -> Result<String, String> {
    match bytes.as_slice() {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => {
            Err("is text in UTF-32: save it in UTF-8".into())
        }
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => utf8(rest.to_vec()),
        bytes => match zeros(bytes) {
            [0, 0] => utf8(bytes.to_vec()),
            // Digits and separators have a zero in their upper half: it is most of one half of a table, and next to none of the other.
            [even, odd] if even > bytes.len() / 4 && odd <= even / 16 => {
                utf16(bytes, u16::from_be_bytes)
            }
            [even, odd] if odd > bytes.len() / 4 && even <= odd / 16 => {
                utf16(bytes, u16::from_le_bytes)
            }
            _ => Err("is not text in UTF-8, UTF-16 or Latin-1: it contains zero bytes".into()),
        },
    }
}

/// Number of zero bytes at even and at odd positions.
fn zeros(bytes: &[u8]) -> [usize; 2] {
    let mut count = [0, 0];
    for (i, _) in bytes.iter().enumerate().filter(|(_, byte)| **byte == 0) {
        count[i % 2] += 1;
    }
    count
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, String> {
    let (pairs, rest) = bytes.as_chunks::<2>();
    if !rest.is_empty() {
        return Err(
            "is not text in UTF-8, and as UTF-16 it is cut off in the middle of a character".into(),
        );
    }
    let mut text = String::with_capacity(pairs.len());
    for character in char::decode_utf16(pairs.iter().map(|pair| unit(*pair))) {
        text.push(character.map_err(|_| {
            format!("line {} is damaged: half a character of UTF-16", lines_in(&text))
        })?);
    }
    no_zeros(text)
}

fn utf8(bytes: Vec<u8>) -> Result<String, String> {
    match String::from_utf8(bytes) {
        Ok(text) => no_zeros(text),
        Err(error) => windows_1252(error.as_bytes()).and_then(no_zeros),
    }
}

fn windows_1252(bytes: &[u8]) -> Result<String, String> {
    let mut text = String::with_capacity(bytes.len() + bytes.len() / 8);
    for byte in bytes {
        let character = match byte {
            0x80..=0x9f => WINDOWS_1252[usize::from(byte - 0x80)],
            byte => char::from(*byte),
        };
        if character == '\0' {
            return Err(format!(
                "line {} is not text in UTF-8, UTF-16 or Latin-1: byte {byte:#04x}",
                lines_in(&text)
            ));
        }
        text.push(character);
    }
    Ok(text)
}

fn no_zeros(text: String) -> Result<String, String> {
    match text.find('\0') {
        None => Ok(text),
        Some(at) => Err(format!(
            "line {} is not text in UTF-8, UTF-16 or Latin-1: it contains zero bytes",
            lines_in(&text[..at])
        )),
    }
}

/// The number of the line on which a text ends.
fn lines_in(text: &str) -> usize {
    1 + lines(text).count().saturating_sub(usize::from(!text.ends_with(['\n', '\r'])))
}

/// The lines of a text, with any line end: LF, CR LF, CR, and the separators of Unicode.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = text;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let end = rest.find(['\n', '\r', '\u{85}', '\u{2028}', '\u{2029}']);
        let (line, end) = end.map_or((rest, ""), |end| rest.split_at(end));
        let end_of_line =
            if end.starts_with("\r\n") { 2 } else { end.chars().next().map_or(0, char::len_utf8) };
        rest = &end[end_of_line..];
        Some(line)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "x (µm)\tz (Å)\r\n0,5\t−1,25\r\n";

    /// Bytes of the text in the encoding of Python's `text.encode("utf-16-le")` and similar.
    fn utf16_bytes(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(bytes).collect()
    }

    #[test]
    fn a_text_is_the_same_in_every_encoding() {
        let marked = format!("\u{feff}{TEXT}");
        for bytes in [
            TEXT.as_bytes().to_vec(),
            marked.as_bytes().to_vec(),
            utf16_bytes(TEXT, u16::to_le_bytes),
            utf16_bytes(TEXT, u16::to_be_bytes),
            utf16_bytes(&marked, u16::to_le_bytes),
            utf16_bytes(&marked, u16::to_be_bytes),
        ] {
            assert_eq!(decoded(bytes).unwrap(), TEXT);
        }
        // Windows-1252 has no U+2212, but an en dash.
        let latin = b"x (\xb5m)\tz (\xc5)\r\n0,5\t\x961,25\r\n";
        assert_eq!(decoded(latin.to_vec()).unwrap(), TEXT.replace('−', "–"));
    }

    #[test]
    fn what_is_not_text_is_refused() {
        let cut = utf16_bytes(TEXT, u16::to_le_bytes);
        for (bytes, word) in [
            (&b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"[..], "not text"),
            (b"0,1\n2,\0\n3,4\n", "zero bytes"),
            (b"0,1\n2,3\n4,\x81\n", "line 3"),
            (b"\xff\xfe\0\0x\0\0\0", "UTF-32"),
            (&cut[..cut.len() - 1], "cut off"),
            (b"1\0\r\0\n\0\x01\xd8,\0", "line 2"),
        ] {
            let refused = decoded(bytes.to_vec()).unwrap_err();
            assert!(refused.contains(word), "{refused} for {word}");
        }
    }
}
