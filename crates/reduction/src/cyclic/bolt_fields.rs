//! What bolts of a cyclic gear carry, and displacements of a gear on them. Theory (13g).

use std::collections::{BTreeMap, BTreeSet};

use faer::{Mat, MatRef};
use fem::dense;
use mesh::Origin;

use super::{between::by_copy, bolts::BoltedGear, recovery::turned_by, seat::turned};
use crate::{ReductionError, load::Load, turned_rows::turn_rows};

impl BoltedGear {
    /// Openings of all bolts along their radii by 1 N of each, mm/N, and forces of the springs that do not open by it.
    pub(crate) fn bolts_under_bolts(&self) -> [Mat<f64>; 2] {
        let moved = self.rows_by_bolts();
        let open = dense::product(self.shares.along.transpose(), moved.as_ref());
        [open, -dense::product(self.shares.springs.as_ref(), moved.as_ref())]
    }

    /// Displacements of a window by 1 N of each bolt, 3n x bolts, and forces of the springs that do not open by 1 N on it, 3
    /// bolts x 3n.
    ///
    /// # Errors
    /// As of [`BoltedGear::compliance`].
    pub(crate) fn flanks_and_bolts(&self, loads: &[Load]) -> Result<[Mat<f64>; 2], ReductionError> {
        let spots = self.spots(loads)?;
        let (seen, m) = (self.seen_by(&spots), self.rows.len());
        let along = self.shares.along.as_ref();
        let flanks =
            dense::product(seen.subcols(0, m), along) - dense::product(seen.as_ref(), self.carried_by_bolts().as_ref());
        let moved = self.moved_by(&spots);
        let carried = dense::product(self.held.as_ref(), moved.as_ref());
        let moved = moved.subrows(0, m) - dense::product(self.moved.as_ref(), carried.as_ref());
        Ok([flanks, -dense::product(self.shares.springs.as_ref(), moved.as_ref())])
    }

    /// Displacements (mm) of the freedoms under bolts by 1 N of each bolt along its radius, m x bolts.
    fn rows_by_bolts(&self) -> Mat<f64> {
        let carried = self.carried_by_bolts();
        dense::product(self.moved.subcols(0, self.rows.len()), self.shares.along.as_ref())
            - dense::product(self.moved.as_ref(), carried.as_ref())
    }

    /// S [U G]' of 1 N of each bolt, (m + 6) x bolts.
    fn carried_by_bolts(&self) -> Mat<f64> {
        let (m, six, along) = (self.rows.len(), self.held.nrows() - self.rows.len(), self.shares.along.as_ref());
        let mut moved = Mat::<f64>::zeros(m + six, along.ncols());
        moved.as_mut().subrows_mut(0, m).copy_from(dense::product(self.moved.subcols(0, m), along));
        moved.as_mut().subrows_mut(m, six).copy_from(dense::product(self.moved.subcols(m, six).transpose(), along));
        dense::product(self.held.as_ref(), moved.as_ref())
    }

    /// Displacement (mm) of nodes of the whole gear (`None`: of every one) under forces (N, 3n x k) on a window with these loads;
    /// one list a column.
    ///
    /// # Errors
    /// As of [`BoltedGear::compliance`]; [`ReductionError::Fem`] for a node that the mesh does not have.
    pub(crate) fn expand(
        &self,
        loads: &[Load],
        forces: MatRef<'_, f64>,
        nodes: Option<&[u32]>,
    ) -> Result<Vec<Vec<[f64; 3]>>, ReductionError> {
        let places = &self.cyclic.part.places;
        let place = |&node: &u32| {
            let wrong = || fem::FemError::Shape { what: "nodes", expected: places.len(), found: node as usize };
            places.get(node as usize).copied().ok_or_else(wrong)
        };
        let nodes: Vec<Origin> = match nodes {
            Some(nodes) => nodes.iter().map(place).collect::<Result<_, _>>()?,
            None => places.clone(),
        };
        let copies: BTreeSet<u32> = nodes.iter().map(|own| own.copy).collect();
        let spots = self.spots(loads)?;
        let (m, k, sector) = (self.rows.len(), forces.ncols(), &self.cyclic.sector);
        let mut moved = Mat::<f64>::zeros(self.held.nrows(), k);
        // Of each copy with forces: those on its loads, and those of bolts.
        let mut on_loads: BTreeMap<u32, Mat<f64>> = BTreeMap::new();
        for own in by_copy(&spots) {
            let mut local = Mat::<f64>::zeros(sector.loads(), k);
            for &(i, load) in &own.nodes {
                local.as_mut().subrows_mut(3 * load, 3).copy_from(forces.subrows(3 * i, 3));
            }
            turn_rows(&mut local, -own.angle);
            moved += self.under_loads(own.copy, local.as_ref());
            on_loads.insert(own.copy, local);
        }
        let answer = dense::product(self.held.as_ref(), moved.as_ref());
        let mut of_bolts: BTreeMap<u32, Mat<f64>> = BTreeMap::new();
        for (i, &(copy, row)) in self.rows.iter().enumerate() {
            let own = of_bolts.entry(copy).or_insert_with(|| Mat::zeros(self.under.own.ncols(), k));
            (0..k).for_each(|j| own[(row, j)] -= answer[(i, j)]);
        }
        let apart = |from: u32| copies.iter().map(move |&to| self.cyclic.apart(from, to));
        let mut ends: BTreeMap<u32, Mat<f64>> = BTreeMap::new();
        let mut add = |from: u32, found: BTreeMap<u32, Mat<f64>>| {
            for &to in &copies {
                let Some(own) = found.get(&self.cyclic.apart(from, to)) else { continue };
                let sum = ends.entry(to).or_insert_with(|| Mat::zeros(own.nrows(), k));
                *sum += own;
            }
        };
        for (&from, own) in &on_loads {
            add(from, self.cyclic.ends_about(own.as_ref(), apart(from)));
        }
        for (&from, own) in &of_bolts {
            add(from, self.cyclic.ends_under(&self.forces(own.as_ref()), apart(from)));
        }
        let mut fields: BTreeMap<u32, Mat<f64>> = BTreeMap::new();
        for &copy in &copies {
            let zeros = || Mat::<f64>::zeros(sector.loads(), k);
            let Some(ends) = ends.get(&copy) else { continue };
            let own = on_loads.get(&copy).cloned().unwrap_or_else(zeros);
            let bolts = of_bolts.get(&copy);
            let moved = bolts.map_or_else(zeros, |own| dense::product(self.under.on_loads.as_ref(), own.as_ref()));
            let mut field = sector.field(sector.basis_with(own.as_ref(), moved.as_ref(), ends.as_ref()).as_ref())?;
            if let Some(own) = bolts {
                field += dense::product(self.under.field(), own.as_ref());
            }
            if let Some(seated) = sector.seat() {
                let motion = turned(answer.subrows(m, answer.nrows() - m), -self.cyclic.angle(copy));
                field -= dense::product(seated.seat.rigid.as_ref(), motion.as_ref());
            }
            fields.insert(copy, field);
        }
        let of_column = |j: usize| {
            let at = |own: &Origin| {
                let Some(field) = fields.get(&own.copy) else { return [0.0; 3] };
                let row = |axis| sector.dofs.dof(own.node, axis).map_or(0.0, |row| field[(row, j)]);
                turned_by(&self.cyclic.turn(own.copy), [0, 1, 2].map(row))
            };
            nodes.iter().map(at).collect()
        };
        Ok((0..k).map(of_column).collect())
    }
}
