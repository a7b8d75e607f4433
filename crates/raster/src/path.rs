//! Paths of the support, line after line.

/// The path of the support from one line to the next.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "PathName"))]
pub enum Path {
    /// Every line runs in the same direction from x = 0, with the spring relaxed.
    #[default]
    OneWay,
    /// The support turns back at the end of a line and moves on by one pitch; the tip keeps its position.
    Zigzag,
    /// The same line is scanned again from x = 0, with the spring relaxed.
    Repeat,
}

/// The path of the support along one line. Lengths in σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Track {
    /// y of the line.
    pub y: f64,
    /// x of the support at the start.
    pub start: f64,
    /// Length of the path.
    pub length: f64,
    /// Whether the support moves towards smaller x.
    pub backward: bool,
}

/// One line of an area. Lengths in σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaLine {
    /// y of the line.
    pub y: f64,
    /// Smallest x of the line.
    pub start: f64,
    /// Distance that the support moves along it.
    pub length: f64,
}

impl Path {
    /// Line number n, counted from 0, of a raster of this pitch and length.
    #[must_use]
    pub fn track(self, n: usize, pitch: f64, length: f64) -> Track {
        let y = if self == Self::Repeat { 0.0 } else { pitch * n as f64 };
        self.along(n, AreaLine { y, start: 0.0, length })
    }

    /// Line number n, counted from 0, at its place in an area.
    #[must_use]
    pub fn along(self, n: usize, AreaLine { y, start, length }: AreaLine) -> Track {
        let backward = self == Self::Zigzag && n % 2 == 1;
        Track { y, start: if backward { start + length } else { start }, length, backward }
    }
}

impl Track {
    /// x at this distance along the line.
    pub fn x(&self, along: f64) -> f64 {
        self.start + self.sign() * along
    }

    /// Distance of x along the line: the inverse of [`x`](Self::x).
    pub fn along(&self, x: f64) -> f64 {
        self.sign() * (x - self.start)
    }

    /// Direction of the line: 1 towards larger x, -1 towards smaller.
    pub fn sign(&self) -> f64 {
        if self.backward { -1.0 } else { 1.0 }
    }
}
