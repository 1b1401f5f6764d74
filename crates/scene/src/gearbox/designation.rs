//! Rolling bearings by their designation: "6206", "7206B", "NU206", "32206".

use super::schema::RollingKind;

/// Boundary dimensions by series and bore code.
const TABLE: &str = include_str!("bearings.csv");

/// What a designation says of a bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Designation {
    /// What rolls in it.
    pub kind: RollingKind,
    /// Bore, mm.
    pub bore: f64,
    /// Outer diameter, mm.
    pub outer_diameter: f64,
    /// Width, mm; of tapered rollers that of both rings together.
    pub width: f64,
    /// Nominal contact angle, degrees; 0 for deep grooves and cylindrical rollers.
    pub contact_angle_deg: f64,
}

/// Why a designation is not taken.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Unknown {
    /// No series is written like this.
    Series,
    /// Letters behind it that are no part of the basic designation.
    Suffix(String),
    /// The series has no bore of that code; its smallest and largest.
    Size([String; 2]),
    /// Angular contact balls without a letter for their angle.
    Angle,
}

/// Letters of the contact angle of angular contact balls, with degrees.
const ANGLES: [(&str, f64); 4] = [("AC", 25.0), ("A", 30.0), ("B", 40.0), ("C", 15.0)];

/// Series of cylindrical rollers, and the table's series with the same dimensions.
const CYLINDERS: [(&str, &str); 6] = [("10", "60"), ("22", "22"), ("23", "23"), ("2", "62"), ("3", "63"), ("4", "64")];
/// Letters of cylindrical roller bearings: their ribs differ, and are not in the law.
const RIBS: [&str; 4] = ["NUP", "NU", "NJ", "N"];
/// Series of angular contact balls, and the table's series with the same dimensions.
const ANGULAR: [(&str, &str); 3] = [("70", "60"), ("72", "62"), ("73", "63")];
const DEEP: [&str; 6] = ["618", "619", "60", "62", "63", "64"];
const CONES: [&str; 6] = ["302", "303", "313", "320", "322", "323"];

/// The bearing of a designation, in small or capital letters, with or without spaces.
pub(super) fn designation(word: &str) -> Result<Designation, Unknown> {
    let word: String = word.chars().filter(|c| !c.is_whitespace()).collect::<String>().to_uppercase();
    let (letters, rest) = word.split_at(word.find(|c: char| c.is_ascii_digit()).ok_or(Unknown::Series)?);
    let (digits, suffix) = rest.split_at(rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len()));
    let suffix = suffix.trim_start_matches('-');
    let (series, code) = digits.split_at(digits.len().checked_sub(2).ok_or(Unknown::Series)?);
    let bare = |known: &str| {
        if suffix.is_empty() || suffix == known { Ok(()) } else { Err(Unknown::Suffix(suffix.to_owned())) }
    };
    let same = |all: &[(&str, &'static str)]| all.iter().find(|(own, _)| *own == series).map(|(_, of)| *of);
    let (kind, of, angle) = if RIBS.contains(&letters) {
        let of = same(&CYLINDERS).ok_or(Unknown::Series)?;
        bare("")?;
        (RollingKind::CylindricalRoller, of, None)
    } else if !letters.is_empty() {
        return Err(Unknown::Series);
    } else if let Some(of) = same(&ANGULAR) {
        let angle = ANGLES.iter().find(|(letter, _)| *letter == suffix).map(|(_, angle)| *angle);
        let unknown = || if suffix.is_empty() { Unknown::Angle } else { Unknown::Suffix(suffix.to_owned()) };
        (RollingKind::AngularContactBall, of, Some(angle.ok_or_else(unknown)?))
    } else if DEEP.contains(&series) {
        bare("")?;
        (RollingKind::DeepGrooveBall, series, None)
    } else if CONES.contains(&series) {
        // Boundary dimensions that the standard has changed once are marked so.
        bare(if series == "320" { "X" } else { "" })?;
        (RollingKind::TaperedRoller, series, None)
    } else {
        return Err(Unknown::Series);
    };
    let row = rows(of).find(|row| row[0] == code).ok_or_else(|| {
        let codes = || rows(of).map(|row| format!("{letters}{series}{}", row[0]));
        Unknown::Size([codes().next().unwrap_or_default(), codes().last().unwrap_or_default()])
    })?;
    let number = |i: usize| row[i].parse().unwrap_or(f64::NAN);
    let [bore, outer_diameter, width, cone] = [1, 2, 3, 4].map(number);
    Ok(Designation { kind, bore, outer_diameter, width, contact_angle_deg: angle.unwrap_or(cone) })
}

/// Rows of a series: code, bore, outer diameter, width, contact angle.
fn rows(series: &str) -> impl Iterator<Item = [&'static str; 5]> {
    let of = TABLE.lines().filter_map(|line| line.split_once(',')).filter(move |(own, _)| *own == series);
    of.filter_map(|(_, rest)| rest.split(',').collect::<Vec<_>>().try_into().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dimensions of ISO 15 and ISO 355, angles of the letters.
    #[test]
    fn a_designation_says_type_and_boundary_dimensions() {
        type K = RollingKind;
        let cases = [
            ("6206", K::DeepGrooveBall, [30.0, 62.0, 16.0, 0.0]),
            ("6003", K::DeepGrooveBall, [17.0, 35.0, 10.0, 0.0]),
            ("61810", K::DeepGrooveBall, [50.0, 65.0, 7.0, 0.0]),
            ("7206 b", K::AngularContactBall, [30.0, 62.0, 16.0, 40.0]),
            ("7310-AC", K::AngularContactBall, [50.0, 110.0, 27.0, 25.0]),
            ("NU206", K::CylindricalRoller, [30.0, 62.0, 16.0, 0.0]),
            ("NJ2210", K::CylindricalRoller, [50.0, 90.0, 23.0, 0.0]),
            ("N1010", K::CylindricalRoller, [50.0, 80.0, 16.0, 0.0]),
            ("32206", K::TaperedRoller, [30.0, 62.0, 21.25, 14.0361]),
            ("32006X", K::TaperedRoller, [30.0, 55.0, 17.0, 16.0]),
            ("31306", K::TaperedRoller, [30.0, 72.0, 20.75, 28.8108]),
        ];
        for (word, kind, [bore, outer_diameter, width, contact_angle_deg]) in cases {
            let wanted = Designation { kind, bore, outer_diameter, width, contact_angle_deg };
            assert_eq!(designation(word), Ok(wanted), "{word}");
        }
    }

    /// Along a series everything grows, and no contact angle is beyond what its kind has.
    #[test]
    fn the_table_grows_along_each_series() {
        for series in DEEP.iter().chain(&CONES).chain(&["22", "23"]) {
            let number = |row: &[&str; 5], i: usize| row[i].parse::<f64>().unwrap();
            let all: Vec<_> = rows(series).collect();
            assert!(all.len() > 10, "{series}: {} rows", all.len());
            for row in &all {
                let [bore, outer, width, angle] = [1, 2, 3, 4].map(|i| number(row, i));
                assert!(outer > 1.1 * bore && width < outer - bore + 20.0, "{series}{}", row[0]);
                assert_eq!(CONES.contains(series), (10.0..30.0).contains(&angle), "{series}{}", row[0]);
            }
            for pair in all.windows(2) {
                let grows = |i: usize| number(&pair[0], i) < number(&pair[1], i);
                assert!(grows(1) && grows(2) && number(&pair[0], 3) <= number(&pair[1], 3), "{series}{}", pair[1][0]);
            }
        }
    }

    #[test]
    fn what_is_no_basic_designation_is_told_apart() {
        let cases = [
            ("", Unknown::Series),
            ("bearing", Unknown::Series),
            ("22220", Unknown::Series),
            ("6", Unknown::Series),
            ("é6206", Unknown::Series),
            ("6206-2RS1", Unknown::Suffix("2RS1".into())),
            ("6206/C3", Unknown::Suffix("/C3".into())),
            ("NU206 ECP", Unknown::Suffix("ECP".into())),
            ("7206", Unknown::Angle),
            ("7206E", Unknown::Suffix("E".into())),
            ("6299", Unknown::Size(["6200".into(), "6240".into()])),
        ];
        for (word, wanted) in cases {
            assert_eq!(designation(word), Err(wanted), "{word}");
        }
    }
}
