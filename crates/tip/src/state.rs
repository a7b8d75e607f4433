//! The state of a computation as a list of 64-bit words: exact, and without a text format.
//!
//! Data are read in the order in which they were written. Numbers keep their bits, so that a resumed computation
//! yields the same results as an uninterrupted one.

use crate::history::{STEP_NUMBERS, Step};
use thiserror::Error;

/// A saved state: 64-bit words, in the order in which they were written.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct State {
    words: Vec<u64>,
}

/// Errors in a saved state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Damaged {
    /// Fewer words than announced.
    #[error("it ends too early")]
    Short,
    /// Words after the last one expected.
    #[error("it has {0} words too many")]
    Long(usize),
    /// A number out of its range.
    #[error("it has a number out of range")]
    OutOfRange,
    /// A state of another kind: another memory or another fit.
    #[error("it is that of another {0}")]
    Other(&'static str),
}

/// Reads a [`State`] from its beginning.
#[derive(Debug, Clone)]
pub struct Reader<'a> {
    words: &'a [u64],
}

/// Data that can be saved between two steps, and restored.
pub trait Saved {
    /// Writes all data, from which [`restore`](Self::restore) recovers the same bits.
    fn save(&self, state: &mut State);

    /// Reads the data that [`save`](Self::save) wrote, into an object of the same type and options.
    ///
    /// # Errors
    /// The state is damaged or of another kind.
    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged>;
}

/// Bound on the cell numbers of lattices; the sum of two such numbers does not overflow.
const LARGEST_WHOLE: u64 = 1 << 61;

impl State {
    /// A state from words of another source.
    pub fn from_words(words: Vec<u64>) -> Self {
        Self { words }
    }

    /// The words.
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// A reader at the beginning of the state.
    pub fn reader(&self) -> Reader<'_> {
        Reader { words: &self.words }
    }

    /// Writes a number.
    pub fn number(&mut self, value: f64) {
        self.words.push(value.to_bits());
    }

    /// Writes a count.
    pub fn count(&mut self, value: u64) {
        self.words.push(value);
    }

    /// Writes an integer.
    pub fn whole(&mut self, value: i64) {
        self.words.push(value.cast_unsigned());
    }

    /// Writes a truth value.
    pub fn flag(&mut self, value: bool) {
        self.words.push(u64::from(value));
    }

    /// Writes the count of numbers, and the numbers.
    pub fn numbers(&mut self, values: impl ExactSizeIterator<Item = f64>) {
        self.count(values.len() as u64);
        self.words.extend(values.map(f64::to_bits));
    }

    /// Writes the count of pairs, and the pairs.
    pub fn pairs<'a>(&mut self, pairs: impl ExactSizeIterator<Item = &'a (f64, f64)>) {
        self.count(pairs.len() as u64);
        pairs.for_each(|(a, b)| self.words.extend([a.to_bits(), b.to_bits()]));
    }

    /// Writes the count of steps, and the steps.
    pub fn steps<'a>(&mut self, steps: impl ExactSizeIterator<Item = &'a Step>) {
        self.count(steps.len() as u64);
        steps.for_each(|step| self.step(step));
    }

    /// Writes a step.
    pub fn step(&mut self, step: &Step) {
        self.words.extend(step.numbers().map(f64::to_bits));
    }
}

impl Reader<'_> {
    fn word(&mut self) -> Result<u64, Damaged> {
        let (first, rest) = self.words.split_first().ok_or(Damaged::Short)?;
        self.words = rest;
        Ok(*first)
    }

    /// Reads a number; infinities are allowed, NaN is not.
    ///
    /// # Errors
    /// No words left, or NaN.
    pub fn number(&mut self) -> Result<f64, Damaged> {
        let value = f64::from_bits(self.word()?);
        if value.is_nan() { Err(Damaged::OutOfRange) } else { Ok(value) }
    }

    /// Reads a finite number.
    ///
    /// # Errors
    /// No words left, or a number that is not finite.
    pub fn finite(&mut self) -> Result<f64, Damaged> {
        self.number().and_then(|x| if x.is_finite() { Ok(x) } else { Err(Damaged::OutOfRange) })
    }

    /// Reads a number of at most this absolute value.
    ///
    /// # Errors
    /// No words left, or a larger number.
    pub fn within(&mut self, most: f64) -> Result<f64, Damaged> {
        let value = self.finite()?;
        if value.abs() <= most { Ok(value) } else { Err(Damaged::OutOfRange) }
    }

    /// Reads a count.
    ///
    /// # Errors
    /// No words left.
    pub fn count(&mut self) -> Result<u64, Damaged> {
        self.word()
    }

    /// Reads an integer.
    ///
    /// # Errors
    /// No words left, or an integer out of the range of lattices.
    pub fn whole(&mut self) -> Result<i64, Damaged> {
        let value = self.word()?.cast_signed();
        if value.unsigned_abs() <= LARGEST_WHOLE { Ok(value) } else { Err(Damaged::OutOfRange) }
    }

    /// Reads a truth value.
    ///
    /// # Errors
    /// No words left, or neither 0 nor 1.
    pub fn flag(&mut self) -> Result<bool, Damaged> {
        match self.word()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(Damaged::OutOfRange),
        }
    }

    /// Reads the number of the following items, of `words_each` words each; the remaining words must suffice for
    /// them.
    ///
    /// # Errors
    /// Too few words left.
    pub fn length(&mut self, words_each: usize) -> Result<usize, Damaged> {
        let length = usize::try_from(self.word()?).map_err(|_| Damaged::Short)?;
        if length <= self.words.len() / words_each { Ok(length) } else { Err(Damaged::Short) }
    }

    /// Reads finite numbers with their count.
    ///
    /// # Errors
    /// Too few words left, or a number that is not finite.
    pub fn numbers(&mut self) -> Result<Vec<f64>, Damaged> {
        (0..self.length(1)?).map(|_| self.finite()).collect()
    }

    /// Reads pairs of finite numbers with their count.
    ///
    /// # Errors
    /// Too few words left, or a number that is not finite.
    pub fn pairs(&mut self) -> Result<Vec<(f64, f64)>, Damaged> {
        (0..self.length(2)?).map(|_| Ok((self.finite()?, self.finite()?))).collect()
    }

    /// Reads a step.
    ///
    /// # Errors
    /// Too few words left, a number that is not finite, or a duration that is not positive.
    pub fn step(&mut self) -> Result<Step, Damaged> {
        let mut numbers = [0.0; STEP_NUMBERS];
        for number in &mut numbers {
            *number = f64::from_bits(self.word()?);
        }
        let step = Step::from_numbers(numbers);
        if step.is_sound() { Ok(step) } else { Err(Damaged::OutOfRange) }
    }

    /// Reads steps with their count.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn steps(&mut self) -> Result<Vec<Step>, Damaged> {
        (0..self.length(STEP_NUMBERS)?).map(|_| self.step()).collect()
    }

    /// Checks that all words have been read.
    ///
    /// # Errors
    /// Words left.
    pub fn finish(self) -> Result<(), Damaged> {
        if self.words.is_empty() { Ok(()) } else { Err(Damaged::Long(self.words.len())) }
    }
}
