//! Bolts of a gear: what they open, move and carry. Theory (13g), (38c).

use faer::Mat;
use mesh::{Bolts, MeshedGear};

use super::{GearReducer, Method, ReductionWatch, ReductionWay, condense::bolted_again};
use crate::{ReductionError, Window, bolt_shares::BoltShares, cyclic::BoltedGear, general::GeneralGear};

/// What bolts do to each other and to themselves.
#[derive(Debug, Clone, PartialEq)]
pub struct BoltCompliance {
    /// Openings (mm) of all bolts along their radii by 1 N of each, which presses the gear; symmetric.
    pub openings: Mat<f64>,
    /// Forces (N) on the gear of the springs of all bolts that do not open, by the same: each bolt along the radius in the way
    /// in which it presses, along the circumference counter-clockwise, along z; 3 bolts x bolts.
    pub springs: Mat<f64>,
}

/// What bolts and the flanks of a window do to each other.
#[derive(Debug, Clone, PartialEq)]
pub struct BoltsAndFlanks {
    /// Displacements (mm) of the window's coordinates, in the frame of its matrices, by 1 N of each bolt, 3n x bolts.
    pub flanks: Mat<f64>,
    /// Forces (N) on the gear of the springs that do not open by 1 N on the coordinates, 3 bolts x 3n, as in [`BoltCompliance`].
    pub springs: Mat<f64>,
}

impl GearReducer {
    /// The bolts of the gear.
    pub fn bolts(&self) -> Option<Bolts> {
        self.gear.bore_coupling().foundation()?.bolts()
    }

    /// What bolts do to each other, the gear held by springs that do not open.
    ///
    /// # Errors
    /// [`ReductionError::NoBolts`]; those of a gear that cannot be condensed again.
    pub fn bolt_compliance(&self) -> Result<BoltCompliance, ReductionError> {
        let [openings, springs] = match self.bolted()? {
            Some(bolted) => bolted.bolts_under_bolts(),
            None => {
                let (general, shares) = self.general_bolts()?;
                let [along, springs] = [&shares.along, &shares.springs.transpose().to_owned()].map(on_freedoms);
                [general.between(&along, &along)?, -general.between(&springs, &along)?]
            }
        };
        let openings =
            Mat::from_fn(openings.nrows(), openings.ncols(), |i, j| 0.5 * (openings[(i, j)] + openings[(j, i)]));
        Ok(BoltCompliance { openings, springs })
    }

    /// What bolts and the flanks of a window do to each other.
    ///
    /// # Errors
    /// As of [`GearReducer::bolt_compliance`].
    pub fn bolts_and_flanks(&self, window: &Window) -> Result<BoltsAndFlanks, ReductionError> {
        if let Some(bolted) = self.bolted()? {
            let [flanks, springs] = bolted.flanks_and_bolts(&self.loads(window)?)?;
            return Ok(BoltsAndFlanks { flanks, springs });
        }
        let (general, shares) = self.general_bolts()?;
        let [along, springs] = [&shares.along, &shares.springs.transpose().to_owned()].map(on_freedoms);
        let own = general.forces_on(&self.coordinate_forces(window)?);
        Ok(BoltsAndFlanks { flanks: general.between(&own, &along)?, springs: -general.between(&springs, &own)? })
    }

    /// The sector of a gear that was condensed to one, and bolts.
    pub(crate) fn bolted(&self) -> Result<Option<&BoltedGear>, ReductionError> {
        if self.summary.way != ReductionWay::SectorAndBolts {
            return Ok(None);
        }
        let again = || {
            let (options, watch) = (&self.options, ReductionWatch::IDLE);
            let made = bolted_again(&self.gear, &self.material, options, &self.coordinates, watch)?;
            made.map(Box::new).ok_or(ReductionError::OtherGear)
        };
        self.bolted.get_or_init(again).as_ref().map(|own| Some(&**own)).map_err(Clone::clone)
    }

    /// The factor of a gear that is not cyclic, and its bolts on the freedoms of the mesh.
    fn general_bolts(&self) -> Result<(&GeneralGear, BoltShares), ReductionError> {
        let (Some(bolts), Method::General(general, _)) = (self.bolts(), self.method()?) else {
            return Err(ReductionError::NoBolts);
        };
        let gear: &MeshedGear = &self.gear;
        let points = bolts.points(gear.mesh(), &gear.bore().faces, (1, 0.0)).map_err(ReductionError::bore)?;
        let row = |_: u32, node: u32| self.dofs.dof(node, 0);
        let shares = BoltShares::new((&bolts, &points), (self.dofs.free_count(), &row), gear.numbering_sign());
        Ok((general, shares))
    }
}

/// Columns as forces on freedoms.
fn on_freedoms(columns: &Mat<f64>) -> Vec<Vec<(usize, f64)>> {
    let of =
        |column: faer::ColRef<'_, f64>| column.iter().copied().enumerate().filter(|(_, force)| *force != 0.0).collect();
    columns.col_iter().map(of).collect()
}
