//! A measured flank: depths on a grid.

use std::{collections::BTreeMap, path::Path};

use serde::Serialize;

use crate::GeometryError;

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
/// Between the grid lines the depth is a bicubic with continuous slope in (roll angle, z). Beyond the outermost lines
/// it is continued along the tangent.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TopographyGrid {
    profile: ProfileAxis,
    z: Vec<f64>,
    depths: Vec<f64>,
}

/// Measured flanks: one grid for all teeth, or separate grids for some or all teeth.
///
/// The file is plain text or CSV:
///
/// ```text
/// # depths in um, positive: material removed
/// diameter_mm, -9.0,  0.0,  9.0
///        85.5,  2.1,  0.0,  1.8
///        90.0,  1.9, -0.1,  1.7
///        95.5,  8.0,  6.2,  7.7
/// ```
///
/// The first row has `diameter_mm` or `roll_deg`, then the heights z (mm, the gear's own frame, 0 at mid-face),
/// ascending. Every further row has a diameter or roll angle, ascending, then one depth in um per height. There are at
/// least two rows and two columns of depths. Values are separated by commas, semicolons or blanks; `#` begins a
/// comment.
///
/// With a first column `tooth` every row belongs to one tooth, counted from 0. Diameters ascend within each tooth:
///
/// ```text
/// tooth, diameter_mm, -9.0,  0.0,  9.0
///     0,        85.5,  2.1,  0.0,  1.8
///     0,        95.5,  8.0,  6.2,  7.7
///    15,        85.5,  2.3,  0.1,  1.8
///    15,        95.5,  8.1,  6.0,  7.4
/// ```
///
/// A tooth without rows is a copy of the nearest tooth that has rows; of two equally near teeth the lower number is
/// taken ([`Topography::of_teeth`]).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Topography {
    grids: Vec<TopographyGrid>,
    /// Tooth of each grid, ascending; empty: one grid for all.
    teeth: Vec<u32>,
}

impl TopographyGrid {
    /// A grid of depths (mm), stored profile line by profile line.
    ///
    /// # Errors
    /// [`GeometryError::OutOfRange`] if there are fewer than two lines in either direction, if lines do not ascend, or
    /// if the number of depths does not match.
    pub fn new(profile: ProfileAxis, z: Vec<f64>, depths: Vec<f64>) -> Result<Self, GeometryError> {
        let (ProfileAxis::Roll(lines) | ProfileAxis::Diameter(lines)) = &profile;
        let fault = |name, value: usize, expected| GeometryError::OutOfRange { name, value: value as f64, expected };
        for (name, axis) in [("profile lines of a topography", lines), ("heights of a topography", &z)] {
            let rises = axis.len() >= 2 && axis.windows(2).all(|pair| pair[0] < pair[1]);
            if !rises || axis.iter().any(|value| !value.is_finite()) {
                return Err(fault(name, axis.len(), "at least 2, ascending"));
            }
        }
        if depths.len() != lines.len() * z.len() || depths.iter().any(|value| !value.is_finite()) {
            return Err(fault("depths of a topography", depths.len(), "a number for each profile line and height"));
        }
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

    /// Depths, mm, stored profile line by profile line.
    pub fn depths(&self) -> &[f64] {
        &self.depths
    }
}

impl From<TopographyGrid> for Topography {
    fn from(grid: TopographyGrid) -> Self {
        Self { grids: vec![grid], teeth: Vec::new() }
    }
}

impl From<BTreeMap<u32, TopographyGrid>> for Topography {
    fn from(of_teeth: BTreeMap<u32, TopographyGrid>) -> Self {
        let (teeth, grids) = of_teeth.into_iter().unzip();
        Self { grids, teeth }
    }
}

impl Topography {
    /// Parses the text of a file; `path` is only used in messages.
    ///
    /// # Errors
    /// [`DataFileError`] with file and line.
    pub fn parse(text: &str, path: &Path) -> Result<Self, DataFileError> {
        const HEADING: &str = "`diameter_mm` or `roll_deg`, then heights in mm";
        let too_few = |what, found| DataFileError::TooFew { path: path.to_owned(), what, found, wanted: 2 };
        let mut rows = rows(text);
        let Some((line, heading)) = rows.next() else { return Err(too_few("rows of depths", 0)) };
        let by_tooth = heading[0] == "tooth";
        let axis = heading.get(usize::from(by_tooth)).copied().unwrap_or_default();
        let by_diameter = match axis {
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
        let name = if by_diameter { "diameter_mm" } else { "roll_deg" };
        let before = 1 + usize::from(by_tooth);
        let mut z = Vec::with_capacity(heading.len() - before);
        for word in &heading[before..] {
            push_rising(&mut z, number(path, line, word)?, "z", path, line)?;
        }
        if z.len() < 2 {
            return Err(too_few("heights", z.len()));
        }
        // Places and depths of each tooth; of all teeth under `None`.
        let mut lines: BTreeMap<Option<u32>, (Vec<f64>, Vec<f64>)> = BTreeMap::new();
        for (line, words) in rows {
            if words.len() != heading.len() {
                let (found, wanted) = (words.len(), heading.len());
                return Err(DataFileError::RowLength { path: path.to_owned(), line, found, wanted });
            }
            let tooth = by_tooth.then(|| tooth_number(path, line, words[0])).transpose()?;
            let (places, depths) = lines.entry(tooth).or_default();
            push_rising(places, number(path, line, words[before - 1])?, name, path, line)?;
            for word in &words[before..] {
                depths.push(1e-3 * number(path, line, word)?);
            }
        }
        if lines.is_empty() {
            return Err(too_few("rows of depths", 0));
        }
        let (mut grids, mut teeth) = (Vec::new(), Vec::new());
        for (tooth, (places, depths)) in lines {
            if places.len() < 2 {
                return Err(too_few("rows of depths", places.len()));
            }
            let profile = if by_diameter {
                ProfileAxis::Diameter(places)
            } else {
                ProfileAxis::Roll(places.into_iter().map(f64::to_radians).collect())
            };
            grids.push(TopographyGrid { profile, z: z.clone(), depths });
            teeth.extend(tooth);
        }
        Ok(Self { grids, teeth })
    }

    /// The distinct grids; grids of single teeth in the order of the teeth.
    pub fn grids(&self) -> &[TopographyGrid] {
        &self.grids
    }

    /// Teeth with grids of their own, ascending; empty if one grid holds for all teeth.
    pub fn teeth(&self) -> &[u32] {
        &self.teeth
    }

    /// Index of the grid of each tooth of a gear with `count` teeth: its own, or that of the nearest tooth with a grid.
    /// Empty if all teeth have the same grid.
    ///
    /// # Errors
    /// [`GeometryError::NoSuchTooth`] if the topography names a tooth that the gear does not have.
    pub fn of_teeth(&self, count: u32) -> Result<Vec<usize>, GeometryError> {
        if let Some(&tooth) = self.teeth.last().filter(|tooth| **tooth >= count) {
            return Err(GeometryError::NoSuchTooth { tooth, teeth: count });
        }
        let away = |a: u32, b: u32| (a.abs_diff(b)).min(count - a.abs_diff(b));
        let nearest = |tooth: u32| (0..self.teeth.len()).min_by_key(|&i| away(tooth, self.teeth[i])).unwrap_or(0);
        Ok(if self.grids.len() < 2 { Vec::new() } else { (0..count).map(nearest).collect() })
    }
}

fn tooth_number(path: &Path, line: usize, word: &str) -> Result<u32, DataFileError> {
    word.parse().map_err(|_| DataFileError::Syntax {
        path: path.to_owned(),
        line,
        expected: "a tooth, counted from 0",
        found: word.to_owned(),
    })
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
