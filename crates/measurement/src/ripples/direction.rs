//! The direction of the scan lines in an image, from the noise between them.
//!
//! Lines that are scanned one after another have heights of their own, by drift and low-frequency noise, or have been levelled line
//! by line. Across the lines neighbouring pixels differ by noise alone. The criterion compares, along x and along y,
//!
//! ```text
//! R = N <(m_{i+1} - 2 m_i + m_{i-1})²> / (6 s²),   s² = <(z_{i+1,j+1} - z_{i+1,j} - z_{i,j+1} + z_{i,j})²> / 4
//! ```
//!
//! with the heights z and the mean m_i of the N pixels of line i. For independent noise R is 1; it is large for lines with
//! heights of their own, and 0 for levelled ones. Second differences of ripples, which are smooth, do not alternate as those of
//! noise do.

use crate::image::Image;

/// R of lines with heights of their own is above this limit.
const UNEVEN: f64 = 10.0;
/// R of levelled lines is below this limit.
const LEVELLED: f64 = 1e-3;
/// R of noise is between these limits; ripples only a few pixels long enlarge s.
const NOISE: [f64; 2] = [1e-2, 3.0];
/// Largest correlation of neighbouring second differences: -2/3 for noise, -1/2 for a random walk, positive for ripples.
const ALTERNATING: f64 = -0.3;

/// Whether the scan lines seem to lie along y, as in a transposed image.
pub fn has_lines_along_y(image: &Image) -> bool {
    let rows = image.rows();
    let (count, length) = (rows.len() as f64, image.x().len() as f64);
    let square = mean(rows.windows(2).flat_map(|pair| {
        let steps = pair[0].iter().zip(&pair[1]).map(|(a, b)| b - a).collect::<Vec<f64>>();
        steps.windows(2).map(|step| 0.25 * (step[1] - step[0]).powi(2)).collect::<Vec<f64>>()
    }));
    let of_rows: Vec<f64> = rows.iter().map(|row| mean(row.iter().copied())).collect();
    let of_columns: Vec<f64> =
        (0..image.x().len()).map(|i| mean(rows.iter().map(|row| row[i]))).collect();
    let [(along_y, noise_of_rows), (along_x, noise_of_columns)] =
        [alternation(&of_rows), alternation(&of_columns)];
    let ratio = |squares: f64, pixels: f64| pixels * squares / (6.0 * square);
    let (of_rows, of_columns) = (ratio(along_y, length), ratio(along_x, count));
    let is_noise = (NOISE[0]..=NOISE[1]).contains(&of_rows) && noise_of_rows < ALTERNATING;
    // Where there is little noise, the ripples themselves are smooth from row to row.
    let is_even = is_noise || of_rows <= NOISE[1] && noise_of_rows >= ALTERNATING;
    let is_uneven = of_columns > UNEVEN && noise_of_columns < ALTERNATING;
    is_even && is_uneven || is_noise && of_columns < LEVELLED
}

/// Mean square of the second differences, and the correlation of neighbouring ones.
fn alternation(means: &[f64]) -> (f64, f64) {
    let second: Vec<f64> = means.windows(3).map(|m| m[2] - 2.0 * m[1] + m[0]).collect();
    let square = mean(second.iter().map(|d| d * d));
    let product = mean(second.windows(2).map(|pair| pair[0] * pair[1]));
    (square, product / square)
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value));
    sum / count
}
