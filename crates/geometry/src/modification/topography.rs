//! A flank as it was measured: depths on a grid.

use std::path::Path;

use serde::Serialize;

use super::data_file::{DataFileError, number, rows};

/// Grid lines along the profile, ascending.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ProfileAxis {
    /// Roll angles, rad.
    Roll(Vec<f64>),
    /// Diameters, mm.
    Diameter(Vec<f64>),
}

/// Depths over (roll angle or diameter, z), mm, positive where material is removed.
///
/// Between the grid lines a bicubic with continuous slope, in (roll angle, z); beyond the outermost lines it goes on
/// along the tangent. The file is plain text or CSV:
///
/// ```text
/// # depths in um, positive: material removed
/// diameter_mm, -9.0,  0.0,  9.0
///        85.5,  2.1,  0.0,  1.8
///        90.0,  1.9, -0.1,  1.7
///        95.5,  8.0,  6.2,  7.7
/// ```
///
/// First row: `diameter_mm` or `roll_deg`, then the heights z (mm, own frame of the gear, 0 at mid-face), ascending.
/// Every further row: a diameter or roll angle, ascending, then one depth in um a height. At least two rows and two
/// columns of depths. Commas, semicolons and blanks separate; `#` begins a comment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Topography {
    profile: ProfileAxis,
    z: Vec<f64>,
    depths: Vec<f64>,
}

impl Topography {
    /// Reads the text of a file; `path` is what messages name.
    ///
    /// # Errors
    /// [`DataFileError`] with file and line.
    pub fn parse(text: &str, path: &Path) -> Result<Self, DataFileError> {
        const HEADING: &str = "`diameter_mm` or `roll_deg`, then heights in mm";
        let too_few = |what, found| DataFileError::TooFew { path: path.to_owned(), what, found, wanted: 2 };
        let mut rows = rows(text);
        let Some((line, heading)) = rows.next() else { return Err(too_few("rows of depths", 0)) };
        let by_diameter = match heading[0] {
            "diameter_mm" => true,
            "roll_deg" => false,
            found => {
                return Err(DataFileError::Syntax {
                    path: path.to_owned(),
                    line,
                    expected: HEADING,
                    found: found.to_owned(),
                });
            }
        };
        let mut z = Vec::with_capacity(heading.len() - 1);
        for word in &heading[1..] {
            push_rising(&mut z, number(path, line, word)?, "z", path, line)?;
        }
        if z.len() < 2 {
            return Err(too_few("heights", z.len()));
        }
        let (mut places, mut depths) = (Vec::new(), Vec::new());
        for (line, words) in rows {
            if words.len() != heading.len() {
                let (found, wanted) = (words.len(), heading.len());
                return Err(DataFileError::RowLength { path: path.to_owned(), line, found, wanted });
            }
            let name = if by_diameter { "diameter_mm" } else { "roll_deg" };
            push_rising(&mut places, number(path, line, words[0])?, name, path, line)?;
            for word in &words[1..] {
                depths.push(1e-3 * number(path, line, word)?);
            }
        }
        if places.len() < 2 {
            return Err(too_few("rows of depths", places.len()));
        }
        let profile = if by_diameter {
            ProfileAxis::Diameter(places)
        } else {
            ProfileAxis::Roll(places.into_iter().map(f64::to_radians).collect())
        };
        Ok(Self { profile, z, depths })
    }

    /// Grid lines along the profile.
    pub fn profile(&self) -> &ProfileAxis {
        &self.profile
    }

    /// Grid lines along the face, mm.
    pub fn heights(&self) -> &[f64] {
        &self.z
    }

    /// Depths, mm, profile line by profile line.
    pub fn depths(&self) -> &[f64] {
        &self.depths
    }
}

fn push_rising(
    values: &mut Vec<f64>,
    value: f64,
    name: &'static str,
    path: &Path,
    line: usize,
) -> Result<(), DataFileError> {
    if let Some(&before) = values.last().filter(|b| value <= **b) {
        return Err(DataFileError::Order { path: path.to_owned(), line, name, before, value });
    }
    values.push(value);
    Ok(())
}
