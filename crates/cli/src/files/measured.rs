//! Measured columns from instruments, and the common units of several files.

use super::text::read_table;
use crate::failure::Failure;
use crate::session::Session;
use std::path::Path;
use stickslip::Refused;
use stickslip_tables::{Heading, Sheet, Table};
use stickslip_units::Unit;

/// The table in a file, with one of these numbers of columns. Rows with missing values are omitted, with a warning.
pub(crate) fn read_measured(
    session: &Session,
    option: &str,
    path: &Path,
    columns: &[usize],
) -> Result<Sheet, Failure> {
    let sheet = read_table(session, option, path, |table| parse_measured(table, columns))?;
    if let Some(first) = sheet.missing.first() {
        let (count, all) = (sheet.missing.len(), sheet.missing.len() + sheet.columns[0].len());
        session.remark(format_args!(
            "stickslip: {option} {}: {count} of {all} rows have no value and are left out, the first in {} {first}",
            path.display(),
            sheet.counted
        ));
    }
    Ok(sheet)
}

/// Names of columns of positions.
const POSITIONS: [&str; 7] = ["x", "position", "distance", "pos", "way", "displacement", "lateral"];

pub(crate) fn parse_measured(table: &Table, columns: &[usize]) -> Result<Sheet, String> {
    let sheet = table.sheet(columns)?;
    if sheet.columns.is_empty() {
        return Err("there is no row of numbers in it".into());
    }
    let name = |i: usize| sheet.headings.get(i).map(|heading| heading.name().to_lowercase());
    // t,x,u is a surface. Behind a position, `lateral` is a force and `displacement` that of a lever; so is a voltage.
    let is_position = |name: &str| POSITIONS.contains(&name);
    let has_position = |name: &str| name.split(|c: char| !c.is_alphanumeric()).any(is_position);
    let is_length = |i: usize| sheet.headings[i].unit(Unit::Length).is_ok();
    if let Some((first, second)) = name(0).zip(name(1))
        && is_position(&second)
        && is_length(1)
        && !has_position(&first)
        && first != "t"
    {
        let [first, second] = [0, 1].map(|i| sheet.headings[i].text());
        return Err(format!("the columns are `{first}` and `{second}`: positions come first"));
    }
    Ok(sheet)
}

/// The unit of a quantity in the first of several files, to which the others are converted.
pub(crate) struct Common {
    of: Unit,
    first: Option<First>,
}

struct First {
    /// The file, or option, that gives the unit.
    named: String,
    unit: Option<String>,
    /// The unit in SI units, if known.
    one: Option<f64>,
}

impl Common {
    /// The unit is taken from the first column.
    pub(crate) fn of(of: Unit) -> Self {
        Self { of, first: None }
    }

    /// Lengths, in the unit of --unit if it is given: it also applies to columns without a unit.
    pub(crate) fn lengths(unit: Option<&str>) -> Result<Self, Failure> {
        let mut lengths = Self::of(Unit::Length);
        if let Some(unit) = unit {
            let one = Some(Refused::metres("unit", unit)?);
            let (named, unit) = (format!("--unit {unit}"), Some(unit.trim().into()));
            lengths.first = Some(First { named, unit, one });
        }
        Ok(lengths)
    }

    /// The unit, if there is one.
    pub(crate) fn unit(&self) -> Option<&str> {
        self.first.as_ref()?.unit.as_deref()
    }

    /// Takes the unit of a run, unless one is known.
    pub(crate) fn of_run(&mut self, named: &str, unit: &str) -> Result<(), Failure> {
        let one = self.of.one(unit);
        let Some(first) = &self.first else {
            self.first = Some(First { named: named.into(), unit: Some(unit.to_owned()), one });
            return Ok(());
        };
        if first.one.map(f64::to_bits) == one.map(f64::to_bits) {
            return Ok(());
        }
        let other = first.unit.as_deref().unwrap_or_default();
        let message = format!(
            "the run is in {unit}, and {} in {other}: leave the unit out, or give runs with the same scales",
            first.named
        );
        Err(Failure::input(named, message))
    }

    /// The factor from the unit of a column to the common unit.
    pub(crate) fn factor(&mut self, named: &str, heading: &Heading) -> Result<f64, Failure> {
        let refused = |message: String| Failure::input(named, message);
        let found = heading.unit(self.of).map_err(refused)?;
        let (unit, one) = (found.map(|(unit, _)| unit.to_owned()), found.map(|(_, one)| one));
        let Some(first) = &self.first else {
            self.first = Some(First { named: named.into(), unit, one });
            return Ok(1.0);
        };
        match (first.one, one) {
            (Some(first), Some(one)) => Ok(one / first),
            (None, None) => Ok(1.0),
            // The unit of the option applies to all columns without a unit.
            (Some(_), None) if first.named.starts_with("--unit") => Ok(1.0),
            (Some(_), None) => Err(refused(format!(
                "the heading `{}` has no unit, where {} has {}: add the unit to the heading",
                heading.text(),
                first.named,
                first.unit.as_deref().unwrap_or_default()
            ))),
            (None, Some(_)) => Err(refused(format!(
                "the heading `{}` has a unit, where {} has none: add it to the heading there",
                heading.text(),
                first.named
            ))),
        }
    }
}

/// The factor from one unit of lengths, forces or voltages to another, 1 where both are unknown; `None` if they belong to
/// different quantities, or one of them is unknown.
pub(crate) fn ratio(unit: Option<&str>, to: Option<&str>) -> Option<f64> {
    if unit == to {
        return Some(1.0);
    }
    let (unit, to) = (unit?, to?);
    let quantities = [Unit::Force, Unit::Length, Unit::Voltage];
    quantities.iter().find_map(|of| Some(of.one(unit)? / of.one(to)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_read_as_instruments_write_them() {
        for text in [
            "x_nm,z_nm\n0,1\n2,3e-1\n",
            "# a comment\n\u{20}\nx_nm; z_nm\r\n0; 1\r\n2;0.3\r\n",
            "Profile 1\nx_nm\tz_nm\n0\t1\n2\t0.3",
            "x_nm z_nm\n 0  1\n 2  0.3\n",
            "x_nm;z_nm\r0;1\r2;0,3\r",
            "x_nm,z_nm\n\"0,0\",\"1,0\"\n\"2,0\",\"0,3\"\n",
        ] {
            let found = parse_measured(&text.into(), &[2]).unwrap();
            assert_eq!(found.columns, [[0.0, 2.0], [1.0, 0.3]], "{text}");
            let headings: Vec<&str> = found.headings.iter().map(Heading::text).collect();
            assert_eq!(headings, ["x_nm", "z_nm"], "{text}");
        }
        assert_eq!(
            parse_measured(
                &"1.5,2,3
"
                .into(),
                &[3]
            )
            .unwrap()
            .headings,
            vec![Heading::default(); 3]
        );
        for heading in [
            "x_nm,lateral (V)",
            "distance_nm,displacement_nm",
            "Scan distance [nm],Lateral [mV]",
            "Scan distance [nm],Lateral",
            "Support (nm),Lateral (nN)",
        ] {
            let text = format!("{heading}\n0,1.5\n2,3\n");
            assert!(parse_measured(&(*text).into(), &[2]).is_ok(), "{heading}");
        }
        for text in
            ["", "x,f\n", "0,1\n2\n", "0,1\nx,f\n", "z,x\n0,1.5\n2,3\n", "n,x\n0,1.5\n2,3\n"]
        {
            assert!(parse_measured(&text.into(), &[2]).is_err(), "{text}");
        }
    }

    /// A row without any value, such as `;NaN`, is a row with every separator, and not a comment.
    #[test]
    fn a_row_without_any_value_is_one_with_every_separator() {
        for separator in [",", ";", "\t"] {
            let text = "x,z\n-10.5,1.2\n,NaN\n0.5,-3e-1\n5.25,-0.75\n".replace(',', separator);
            let found = parse_measured(&(*text).into(), &[2]).unwrap();
            assert_eq!(found.missing, [3], "{text}");
            assert_eq!(found.columns[0], [-10.5, 0.5, 5.25], "{text}");
        }
    }

    #[test]
    fn units_of_several_files_meet_in_that_of_the_first() {
        let mut common = Common::of(Unit::Length);
        let factor = |common: &mut Common, heading: &str| {
            common.factor("--ripple a.csv", &Heading::of(heading))
        };
        assert_eq!(factor(&mut common, "x_nm").unwrap().to_bits(), 1_f64.to_bits());
        assert!((factor(&mut common, "x (µm)").unwrap() / 1e3 - 1.0).abs() < 1e-15);
        assert_eq!(common.unit(), Some("nm"));
        for heading in ["x", "t (s)", "x (foo)"] {
            assert!(factor(&mut common, heading).is_err(), "{heading}");
        }
        let mut common = Common::of(Unit::Length);
        assert!(factor(&mut common, "x").is_ok() && factor(&mut common, "x_nm").is_err());
        let mut common = Common::lengths(Some("um")).unwrap();
        assert!((factor(&mut common, "x_nm").unwrap() / 1e-3 - 1.0).abs() < 1e-15);
        assert!(factor(&mut common, "x").is_ok() && Common::lengths(Some("N")).is_err());
    }
}
