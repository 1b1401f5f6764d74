//! Rows of a motion, read back from its files: the same bits as they were written from.

use analysis::{
    motion::{BearingRow, EnergyRow, MotionLayout, MotionRow, RootStressRow},
    results::PressureSpot,
};
use study::{Columns, StudyError};

use super::{At, Column, EnergyRows, MotionRows, Rows, energy, motion_history as of};

/// Columns of one file, row by row.
struct Reader<'a>(&'a Columns);

impl Reader<'_> {
    /// A column that stands once, or that of a gear.
    fn of<R: Rows>(&self, column: Column<R>, gear: usize, row: usize) -> Result<f64, StudyError> {
        self.at(column, At { gear, pair: 0 }, row)
    }

    fn at<R: Rows>(&self, column: Column<R>, at: At, row: usize) -> Result<f64, StudyError> {
        let name = column.name_at(at);
        self.0.series(&name)?.get(row).copied().ok_or(StudyError::NoColumn { name })
    }

    /// A column that not every layout has.
    fn if_there(&self, column: Column<MotionRows>, gear: usize, row: usize) -> f64 {
        self.of(column, gear, row).unwrap_or(0.0)
    }

    fn vector<const N: usize>(
        &self,
        columns: [Column<MotionRows>; N],
        gear: usize,
        row: usize,
    ) -> Result<[f64; N], StudyError> {
        let mut all = [0.0; N];
        for (value, column) in all.iter_mut().zip(columns) {
            *value = self.of(column, gear, row)?;
        }
        Ok(all)
    }

    fn both<const N: usize>(&self, columns: [Column<MotionRows>; N], row: usize) -> Result<[[f64; N]; 2], StudyError> {
        Ok([self.vector(columns, 0, row)?, self.vector(columns, 1, row)?])
    }

    fn bearing(&self, layout: &MotionLayout, gear: usize, row: usize) -> Result<Option<Box<BearingRow>>, StudyError> {
        if !layout.free(gear).contains(&true) {
            return Ok(None);
        }
        Ok(Some(Box::new(BearingRow {
            force_n: self.vector([of::BEARING_FORCE_X, of::BEARING_FORCE_Y, of::BEARING_FORCE_Z], gear, row)?,
            moment_nmm: self.vector([of::BEARING_MOMENT_X, of::BEARING_MOMENT_Y], gear, row)?,
            displacement_um: [of::DISPLACEMENT_X, of::DISPLACEMENT_Y, of::DISPLACEMENT_Z]
                .map(|column| self.if_there(column, gear, row)),
            tilt_urad: [of::TILT_X, of::TILT_Y].map(|column| self.if_there(column, gear, row)),
        })))
    }

    fn root_stress(&self, gear: usize, row: usize) -> Result<RootStressRow, StudyError> {
        let columns = [of::ROOT_TENSION, of::ROOT_COMPRESSION, of::ROOT_VON_MISES, of::ROOT_ERROR];
        let [max_principal_mpa, min_principal_mpa, von_mises_mpa, estimated_error_percent] =
            self.vector(columns, gear, row)?;
        Ok(RootStressRow { max_principal_mpa, min_principal_mpa, von_mises_mpa, estimated_error_percent })
    }

    fn spot(&self, row: usize) -> Result<Option<PressureSpot>, StudyError> {
        let [number, z_mm, pinion_diameter_mm] =
            self.vector([of::PRESSURE_PLACE, of::PRESSURE_Z, of::PRESSURE_DIAMETER], 0, row)?;
        Ok(PressureSpot::of_number(number as usize, z_mm, pinion_diameter_mm))
    }
}

/// The ledger at a row.
fn energy_row(reader: &Reader<'_>, row: usize) -> Result<EnergyRow, StudyError> {
    let value = |column: Column<EnergyRows>| reader.of(column, 0, row);
    Ok(EnergyRow {
        time_s: value(energy::TIME)?,
        kinetic_mj: value(energy::KINETIC)?,
        elastic_mj: value(energy::ELASTIC)?,
        supplied_mj: value(energy::SUPPLIED)?,
        parametric_mj: value(energy::PARAMETRIC)?,
        dissipated_mj: value(energy::DISSIPATED)?,
        residual_mj: value(energy::RESIDUAL)?,
    })
}

/// The rows of a motion from the columns of `history.csv` and `energy.csv`, row by row. Displacements along coordinates
/// that are not free
/// have no column, and are 0.
///
/// # Errors
/// [`StudyError::NoColumn`] for files of another layout.
pub fn motion_rows(layout: &MotionLayout, history: &Columns, energy: &Columns) -> Result<Vec<MotionRow>, StudyError> {
    let (of_history, of_energy) = (Reader(history), Reader(energy));
    let one = |row: usize| {
        let value = |column: Column<MotionRows>| of_history.of(column, 0, row);
        let pair = |pair: i64| of_history.at(of::PAIR_FORCE, At { gear: 0, pair }, row);
        let root_stress = layout
            .has_root_stress()
            .then(|| Ok::<_, StudyError>(Box::new([of_history.root_stress(0, row)?, of_history.root_stress(1, row)?])));
        Ok(MotionRow {
            time_s: value(of::TIME)?,
            pinion_angle_deg: value(of::PINION_ANGLE)?,
            mesh_phase: value(of::MESH_PHASE)?,
            speed_rpm: [value(of::PINION_SPEED)?, value(of::WHEEL_SPEED)?],
            dte_um: value(of::DTE)?,
            dte_rate_um_per_s: value(of::DTE_RATE)?,
            contact_line_length_mm: value(of::LINE_LENGTH)?,
            pairs_in_contact: value(of::PAIRS)? as u32,
            force_n: of_history.both([of::FORCE_X, of::FORCE_Y, of::FORCE_Z], row)?,
            moment_nmm: of_history.both([of::MOMENT_X, of::MOMENT_Y, of::MOMENT_Z], row)?,
            pair_normal_force_n: layout.pairs().map(pair).collect::<Result<_, _>>()?,
            bearing: [of_history.bearing(layout, 0, row)?, of_history.bearing(layout, 1, row)?],
            normal_force_n: value(of::NORMAL_FORCE)?,
            coast_normal_force_n: value(of::COAST_FORCE)?,
            drive_torque_nm: value(of::DRIVE_TORQUE)?,
            load_torque_nm: value(of::LOAD_TORQUE)?,
            max_pressure_mpa: value(of::MAX_PRESSURE)?,
            max_pressure_at: of_history.spot(row)?,
            tooth_changes: value(of::TOOTH_CHANGES)? as u64,
            root_stress: root_stress.transpose()?,
            energy: energy_row(&of_energy, row)?,
        })
    };
    (0..history.len()).map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ENERGY, MOTION_HISTORY, parse_columns};
    use scene::Scene;

    /// Whatever stands in a row comes back from its files to the same bits, also where it is no number.
    #[test]
    fn rows_read_back_to_the_same_bits() {
        let scene = Scene::builder()
            .pinion(24, 15.0)
            .wheel(31)
            .normal_module_mm(3.0)
            .face_width_mm(20.0)
            .torque_nm(100.0)
            .set("output.root_stress", true)
            .build()
            .unwrap();
        let layout = MotionLayout::of(&scene, 3);
        let mut next = 0.1f64;
        let mut number = || {
            next = (next * 1234.567 + 0.618_033_988_749).rem_euclid(7.3) - 2.0;
            next / 3.0
        };
        let rows: Vec<MotionRow> = (0..9u32)
            .map(|k| MotionRow {
                time_s: number(),
                pinion_angle_deg: number(),
                mesh_phase: number(),
                speed_rpm: [number(), number()],
                dte_um: number(),
                dte_rate_um_per_s: 1e9 * number(),
                contact_line_length_mm: number(),
                pairs_in_contact: k % 3,
                force_n: [[number(), -0.0, number()], [number(), 0.0, number()]],
                moment_nmm: [[number(), number(), number()], [number(), number(), number()]],
                pair_normal_force_n: layout.pairs().map(|_| number()).collect(),
                bearing: [None, None],
                normal_force_n: number(),
                coast_normal_force_n: number(),
                drive_torque_nm: 1e-9 * number(),
                load_torque_nm: number(),
                max_pressure_mpa: number(),
                max_pressure_at: PressureSpot::of_number(k as usize % 5, number(), number()),
                tooth_changes: u64::from(k),
                root_stress: Some(Box::new(
                    [RootStressRow {
                        max_principal_mpa: number(),
                        min_principal_mpa: if k == 3 { f64::INFINITY } else { number() },
                        von_mises_mpa: number(),
                        estimated_error_percent: number(),
                    }; 2],
                )),
                energy: EnergyRow {
                    time_s: number(),
                    kinetic_mj: number(),
                    elastic_mj: number(),
                    supplied_mj: number(),
                    parametric_mj: number(),
                    dissipated_mj: number(),
                    residual_mj: 1e-17 * number(),
                },
            })
            .collect();
        let pairs: Vec<i64> = layout.pairs().collect();
        let history = MOTION_HISTORY.sheet(&layout, &pairs).csv(&layout, &rows);
        let energy = ENERGY.sheet(&(), &[]).csv(&(), rows.iter().map(|r| &r.energy));
        let read = motion_rows(&layout, &parse_columns(&history).unwrap(), &parse_columns(&energy).unwrap()).unwrap();
        assert_eq!(read, rows);
        assert_eq!(MOTION_HISTORY.sheet(&layout, &pairs).csv(&layout, &read), history);
        assert!(motion_rows(&layout, &parse_columns(&energy).unwrap(), &parse_columns(&energy).unwrap()).is_err());
    }
}
