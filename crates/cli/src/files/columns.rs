//! Tables of two or three columns from users, without missing values.

use super::text::read_table;
use crate::failure::Failure;
use crate::session::Session;
use std::path::Path;
use stickslip::{Dimension, KnownScales, SurfaceTable};
use stickslip_raster::AreaLine;
use stickslip_tables::{Heading, Sheet, Table};
use stickslip_tip::sorting::sort_numbers;
use stickslip_units::Unit;

/// Two columns read from a file.
pub(crate) type Columns = (Vec<f64>, Vec<f64>);

/// Two columns of numbers with the names in `heading`.
pub(crate) fn read_columns(
    session: &Session,
    option: &str,
    path: &Path,
    heading: &str,
    scales: Option<&KnownScales>,
) -> Result<Columns, Failure> {
    read_table(session, option, path, |table| parse_columns(table, heading, scales))
}

/// Lines of an area, y,start,length.
pub(crate) fn read_area(
    session: &Session,
    option: &str,
    path: &Path,
    scales: Option<&KnownScales>,
) -> Result<Vec<AreaLine>, Failure> {
    let parse = |table: &Table| parse_table(table, "y,start,length", scales);
    let [y, start, length] = read_table(session, option, path, parse)?;
    let columns = y.into_iter().zip(start).zip(length);
    Ok(columns.map(|((y, start), length)| AreaLine { y, start, length }).collect())
}

/// Heights at all points of a grid, x,y,u, in any order.
pub(crate) fn read_surface_table(
    session: &Session,
    option: &str,
    path: &Path,
    scales: Option<&KnownScales>,
) -> Result<SurfaceTable, Failure> {
    let parse = |table: &Table| surface_table(parse_table(table, "x,y,u", scales)?);
    read_table(session, option, path, parse)
}

fn surface_table([x, y, u]: [Vec<f64>; 3]) -> Result<SurfaceTable, String> {
    let axis = |values: &[f64]| {
        let mut axis = values.to_vec();
        sort_numbers(&mut axis);
        axis.dedup();
        axis
    };
    let (all_x, all_y) = (axis(&x), axis(&y));
    let mut rows = vec![vec![None; all_x.len()]; all_y.len()];
    let place = |axis: &[f64], value: f64| axis.partition_point(|known| *known < value);
    for (i, u) in u.iter().enumerate() {
        let entry = &mut rows[place(&all_y, y[i])][place(&all_x, x[i])];
        if entry.replace(*u).is_some() {
            return Err(format!("the point x = {}, y = {} occurs twice", x[i], y[i]));
        }
    }
    let whole = |row: Vec<Option<f64>>| row.into_iter().collect::<Option<Vec<f64>>>();
    let u: Option<Vec<_>> = rows.into_iter().map(whole).collect();
    let (points, needed) = (x.len(), all_x.len() * all_y.len());
    let u = u.ok_or_else(|| {
        format!(
            "{points} points are no grid: {} x and {} y make {needed}",
            all_x.len(),
            all_y.len()
        )
    })?;
    Ok(SurfaceTable { x: all_x, y: all_y, u })
}

/// A profile x,u; or one surface t,x,u, as written by `surface`.
pub(crate) fn read_profile(
    session: &Session,
    option: &str,
    path: &Path,
    scales: Option<&KnownScales>,
) -> Result<Columns, Failure> {
    read_table(session, option, path, |table| parse_profile(table, scales))
}

pub(crate) fn parse_profile(
    table: &Table,
    scales: Option<&KnownScales>,
) -> Result<Columns, String> {
    let mut sheet = whole(table, &["x,u", "t,x,u"])?;
    // The time only distinguishes surfaces, in any unit.
    if sheet.columns.len() == 3 {
        let t = sheet.columns.remove(0);
        sheet.headings.remove(0);
        if let Some(row) = t.iter().position(|time| time.to_bits() != t[0].to_bits()) {
            return Err(format!(
                "holds surfaces at several times, {} and {}: write one with `surface --at T`",
                t[0], t[row]
            ));
        }
    }
    let [x, u] = in_units(sheet, "x,u", scales)?;
    Ok((x, u))
}

fn parse_columns(
    table: &Table,
    heading: &str,
    scales: Option<&KnownScales>,
) -> Result<Columns, String> {
    parse_table::<2>(table, heading, scales).map(|[first, second]| (first, second))
}

/// N columns of numbers, converted to the model's units according to their headings.
fn parse_table<const N: usize>(
    table: &Table,
    names: &str,
    scales: Option<&KnownScales>,
) -> Result<[Vec<f64>; N], String> {
    in_units(whole(table, &[names])?, names, scales)
}

fn in_units<const N: usize>(
    mut sheet: Sheet,
    names: &str,
    scales: Option<&KnownScales>,
) -> Result<[Vec<f64>; N], String> {
    in_model_units(&mut sheet.columns, names, &sheet.headings, scales)?;
    let count = sheet.columns.len();
    sheet
        .columns
        .try_into()
        .map_err(|_| format!("{count} columns of numbers; `{names}` are needed"))
}

/// A table without missing values and with one of these sets of columns, such as `x,u` or `t,x,u`.
pub(super) fn whole(table: &Table, names: &[&str]) -> Result<Sheet, String> {
    let counts: Vec<usize> = names.iter().map(|names| names.split(',').count()).collect();
    let of = names.join("` or `");
    let mut sheet = table.sheet(&counts).map_err(|error| format!("{error} (columns `{of}`)"))?;
    if sheet.columns.is_empty() {
        // An empty table is rejected by its later use.
        sheet.columns = vec![vec![]; counts[0]];
        sheet.headings = vec![Heading::default(); counts[0]];
    }
    if let Some(place) = sheet.missing.first() {
        return Err(format!("{} {place}: a value is missing (columns `{of}`)", sheet.counted));
    }
    let count = sheet.columns.len();
    let names = names.iter().find(|names| names.split(',').count() == count).copied();
    judge_order(&sheet.headings, names.unwrap_or_default())?;
    Ok(sheet)
}

/// Rejects the same names in another order.
fn judge_order(headings: &[Heading], names: &str) -> Result<(), String> {
    let wanted: Vec<String> = names.split(',').map(str::to_lowercase).collect();
    let found: Vec<String> = headings.iter().map(|heading| heading.name().to_lowercase()).collect();
    let sorted = |names: &[String]| {
        let mut names = names.to_vec();
        names.sort();
        names
    };
    if found != wanted && sorted(&found) == sorted(&wanted) {
        return Err(format!("its columns are `{}`: `{names}` are needed", found.join(",")));
    }
    Ok(())
}

/// The unit of the model of a column by its name; `None` if it has no dimension.
fn meant(name: &str) -> Option<&'static str> {
    Some(match name {
        "x" | "y" | "R" | "start" | "length" => "σ",
        "u" => "kσ²/a",
        "t" => "Γ/k",
        "force" => "kσ",
        _ => return None,
    })
}

/// The quantity that a unit of the model measures, and the number of nm, s or nN in its SI unit.
pub(crate) fn measured_in(unit: &str) -> (Unit, f64) {
    const NANO: f64 = 1e9;
    match unit {
        "Γ/k" => (Unit::Time, 1.0),
        "k/Γ" => (Unit::Rate, 1.0),
        "Γ²/k" => (Unit::Mass, 1.0),
        "kσ" | "nN" => (Unit::Force, NANO),
        "kσ/Γ" | "k²σ²/(aΓ)" => (Unit::Velocity, NANO),
        _ => (Unit::Length, NANO),
    }
}

/// The columns called `names`; those with a unit in their heading are divided by the scales.
fn in_model_units(
    columns: &mut [Vec<f64>],
    names: &str,
    headings: &[Heading],
    scales: Option<&KnownScales>,
) -> Result<(), String> {
    for ((column, name), heading) in columns.iter_mut().zip(names.split(',')).zip(headings) {
        let Some(multiple) = meant(name) else { continue };
        let (unit, per_si) = measured_in(multiple);
        let Some((_, one)) = heading.unit(unit)? else { continue };
        let factor = Dimension::of_unit(multiple).and_then(|of| of.factor(scales?));
        let factor = factor.ok_or_else(|| {
            format!(
                "the heading `{}` has a unit, but {multiple} is not known in it: give --units, or --sigma and \
                 the other scales; or the column in {multiple}, without a unit in its heading",
                heading.text()
            )
        })?;
        let factor = factor / (one * per_si);
        column.iter_mut().for_each(|value| *value /= factor);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_is_put_together_from_points_in_any_order() {
        let table = |text: &str| surface_table(parse_table(&text.into(), "x,y,u", None).unwrap());
        let found = table("x,y,u\n1.5,2,6\n0.5,2,5\n0.5,1,3\n1.5,1,4\n").unwrap();
        assert_eq!((found.x, found.y), (vec![0.5, 1.5], vec![1.0, 2.0]));
        assert_eq!(found.u, [[3.0, 4.0], [5.0, 6.0]]);
        let missing = table("x,y,u\n1.5,2,6\n0.5,2,5\n0.5,1,3\n").unwrap_err();
        assert!(missing.contains("3 points are no grid"), "{missing}");
        let twice = table("x,y,u\n1.5,2,6\n1.5,2,5\n").unwrap_err();
        assert!(twice.contains("twice"), "{twice}");
    }

    #[test]
    fn a_heading_and_comments_are_skipped() {
        let (x, u) = parse_columns(&"# measured\nx,u\n0, 1\n2,3e-1\n".into(), "x,u", None).unwrap();
        assert_eq!(x.len(), 2);
        assert!((u[1] - 0.3).abs() < 1e-16);
    }

    #[test]
    fn a_line_that_is_not_two_numbers_is_named() {
        for (text, line) in [
            ("1,2\n3\n", 2),
            ("1,2\n3,4,5\n", 2),
            ("x,u\n1,2\nfoo,3\n", 3),
            ("1,2e\n3,4\n", 1),
            ("x,u\n1.5,2\n3,\n", 3),
            ("x,u\n1.5,2\nNaN,2\n", 3),
            ("x,u\nO.5,2\n1.5,2\n", 2),
            ("x;u\r1,5;2\r3,5;1.5\r", 3),
        ] {
            let message = parse_columns(&text.into(), "x,u", None).unwrap_err();
            assert!(message.contains(&format!("line {line}")), "{message}");
        }
    }

    #[test]
    fn columns_in_another_order_are_refused() {
        for text in ["u,x\n0,1.5\n", "u_nm;x_nm\n0;1\n"] {
            let message = parse_columns(&text.into(), "x,u", None).unwrap_err();
            assert!(message.contains("`x,u` are needed"), "{message}");
        }
    }

    /// Ambiguous decimal commas between commas are rejected, and never read as separate digits.
    #[test]
    fn commas_that_may_be_decimal_marks_are_refused() {
        for text in
            ["0,00\n0,25\n", "0,5\n0,7\n0,9\n1,2\n", "u\n1,5\n2,5\n", "1,05\n2,10\n", "0,-0\n1,5\n"]
        {
            let message = parse_columns(&text.into(), "x,u", None).unwrap_err();
            assert!(message.contains("commas may be decimal marks"), "{text}: {message}");
        }
        for text in ["0,1,50\n1,1,48\n", "0,0,1,5\n0,5,1,25\n"] {
            assert!(parse_profile(&text.into(), None).is_err(), "{text}");
        }
        assert!(parse_columns(&"0,1\n1,7\n".into(), "x,u", None).is_ok());
        assert!(parse_columns(&"x,u\n0,1\n1,7\n".into(), "x,u", None).is_ok());
        // Or groups of thousands.
        assert!(parse_columns(&"x;u\n999;1\n1,001;2\n".into(), "x,u", None).is_err());
        assert!(parse_columns(&"x;u\n0,999;1\n1,001;2\n".into(), "x,u", None).is_ok());
    }

    const SCALES: KnownScales = KnownScales {
        length: Some(30e-9),
        time: Some(0.02),
        height: Some(18e-9),
        force: Some(6e-9),
    };

    fn converted(names: &str, headings: [&str; 2], scales: Option<&KnownScales>) -> Vec<Vec<f64>> {
        let mut columns = vec![vec![1.0, 60.0], vec![1.0, 36.0]];
        in_model_units(&mut columns, names, &headings.map(Heading::of), scales).unwrap();
        columns
    }

    #[test]
    fn units_of_headings_are_turned_into_the_models() {
        let close = |found: &[f64], wanted: f64| (found[1] / wanted - 1.0).abs() < 1e-14;
        let found = converted("x,u", ["x_nm", "u (um)"], Some(&SCALES));
        assert!(close(&found[0], 2.0) && close(&found[1], 2000.0), "{found:?}");
        let found = converted("t,force", ["t_ms", "force_nN"], Some(&SCALES));
        assert!(close(&found[0], 3.0) && close(&found[1], 6.0), "{found:?}");
        // No unit, or nothing that is one: as it is.
        for headings in [["x", "u"], ["x_0", "u_1"], ["", ""]] {
            assert_eq!(converted("x,u", headings, Some(&SCALES)), [[1.0, 60.0], [1.0, 36.0]]);
        }
    }

    #[test]
    fn a_unit_of_something_else_is_refused() {
        for headings in [["x (ms)", "u"], ["x", "u (V)"], ["x", "u (foo)"]] {
            let mut columns = vec![vec![1.0], vec![1.0]];
            let headings = headings.map(Heading::of);
            assert!(in_model_units(&mut columns, "x,u", &headings, Some(&SCALES)).is_err());
        }
    }

    #[test]
    fn a_unit_without_a_scale_is_refused() {
        let length = KnownScales { height: None, ..SCALES };
        for scales in [None, Some(&length)] {
            let mut columns = vec![vec![1.0], vec![1.0]];
            let headings = ["x_nm", "u_nm"].map(Heading::of);
            let refused = in_model_units(&mut columns, "x,u", &headings, scales).unwrap_err();
            assert!(refused.contains("--sigma"), "{refused}");
        }
    }
}
