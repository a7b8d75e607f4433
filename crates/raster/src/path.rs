//! Where the support goes: line after line.

/// How the support goes from one line to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Path {
    /// Every line from x = 0, in the same direction, with the spring relaxed.
    OneWay,
    /// The support turns back at the end of a line and goes one pitch further; the tip starts where it was.
    Zigzag,
    /// The same line again, from x = 0, with the spring relaxed.
    Repeat,
}

/// The way of the support along one line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Track {
    /// Where the line lies.
    pub y: f64,
    /// Where the support starts.
    pub start: f64,
    /// How far it goes.
    pub length: f64,
    /// Towards smaller x.
    pub backward: bool,
}

/// One line of an area. Lengths in σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaLine {
    /// Where it lies.
    pub y: f64,
    /// Its smallest x.
    pub start: f64,
    /// How far the support goes along it.
    pub length: f64,
}

impl Path {
    /// Line number n, counted from 0, of a raster of this pitch and length.
    #[must_use]
    pub fn track(self, n: usize, pitch: f64, length: f64) -> Track {
        let y = if self == Self::Repeat { 0.0 } else { pitch * n as f64 };
        self.along(n, AreaLine { y, start: 0.0, length })
    }

    /// Line number n, counted from 0, where it lies there.
    #[must_use]
    pub fn along(self, n: usize, AreaLine { y, start, length }: AreaLine) -> Track {
        let backward = self == Self::Zigzag && n % 2 == 1;
        Track { y, start: if backward { start + length } else { start }, length, backward }
    }
}

impl Track {
    /// x of what lies this far along the line.
    #[must_use]
    pub fn x(&self, along: f64) -> f64 {
        self.start + self.sign() * along
    }

    /// How far along the line x lies: the inverse of [`x`](Self::x).
    #[must_use]
    pub fn along(&self, x: f64) -> f64 {
        self.sign() * (x - self.start)
    }

    /// That of dx over what is gone along the line.
    #[must_use]
    pub fn sign(&self) -> f64 {
        if self.backward { -1.0 } else { 1.0 }
    }
}
