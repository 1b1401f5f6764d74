//! Windows of a condensed gear, and quantities related to them.

use std::sync::Arc;

use geometry::{Gear, Side};
use mesh::BoreCoupling;

use super::{GearReducer, Method, ReductionWay};
use crate::{
    LocalCompliance, ReductionError, Window,
    load::{Coordinates, Load, missing},
};

impl GearReducer {
    /// The window whose first tooth is `first`.
    ///
    /// # Errors
    /// [`ReductionError::MissingFlank`] if the mesh ends before the window does.
    pub fn window(&self, first: u32) -> Result<Window, ReductionError> {
        let z = self.gear.tooth_count();
        let (first, base) = (first % z, self.options.first % z);
        if first == base || self.is_cyclic() {
            return Ok(Window { reduced: self.base.clone(), shift: (first + z - base) % z });
        }
        if self.summary.way == ReductionWay::CyclicSector {
            return Ok(Window { reduced: self.base.clone(), shift: 0 });
        }
        // Of a gear on bolts as well: in its own frame.
        Ok(Window { reduced: self.window_of_teeth(first)?, shift: 0 })
    }

    /// Whether the window that starts at tooth `first` has the same matrices as another window. No matrix is computed
    /// for the answer.
    pub fn shares_matrices(&self, window: &Window, first: u32) -> bool {
        self.is_cyclic() || window.reduced.teeth.first() == Some(&(first % self.gear.tooth_count()))
    }

    /// Half tooth of the mesh behind one flank, condensed on first request. `geometry` is the gear that was meshed.
    ///
    /// # Errors
    /// [`ReductionError::MissingFlank`], [`ReductionError::Fem`].
    pub fn local_compliance(
        &self,
        geometry: &Gear,
        tooth: u32,
        side: Side,
    ) -> Result<Arc<LocalCompliance>, ReductionError> {
        let mut halves = self.asked.halves();
        if let Some(half) = halves.get(&(tooth, side)) {
            return Ok(half.clone());
        }
        let (elements, flank) = (&self.options.elements, (tooth, side));
        let half = match &self.coordinates {
            Coordinates::FlankNodes => {
                LocalCompliance::new(&self.gear, geometry, &self.material, elements, tooth, side)?
            }
            Coordinates::Grids(grids) => {
                let grid = grids.get(&flank).ok_or_else(|| missing(&self.gear, flank))?;
                LocalCompliance::on_grid(&self.gear, geometry, &self.material, elements, flank, grid)?
            }
        };
        let half = Arc::new(half);
        halves.insert(flank, half.clone());
        Ok(half)
    }

    /// Position, among a window's boundary nodes, of a node of [`GearReducer::flank`].
    pub fn boundary_position(&self, window: &Window, (tooth, side): (u32, Side), node: u32) -> Option<usize> {
        let Coordinates::Grids(grids) = &self.coordinates else { return window.reduced.position(node) };
        let mut at = 0;
        for &t in &window.reduced.teeth {
            for &s in &window.reduced.sides {
                let grid = grids.get(&(t, s))?;
                if (t, s) == (tooth, side) {
                    return ((node as usize) < grid.positions.len()).then_some(at + node as usize);
                }
                at += grid.positions.len();
            }
        }
        None
    }

    /// Angle of a window's frame relative to the gear's own frame, rad.
    pub fn frame_angle(&self, window: &Window) -> f64 {
        self.gear.pitches_on(window.shift)
    }

    /// The mesh nodes that correspond to a window's boundary nodes, rotated by the window's shift.
    pub fn material_nodes(&self, window: &Window) -> Vec<u32> {
        window.reduced.nodes.iter().map(|&n| self.material_node(window, n)).collect()
    }

    /// The mesh node at the position of `node` of the window's frame, rotated by the window's shift.
    ///
    /// `node` itself if the mesh consists of several sectors only and does not contain this position.
    pub fn material_node(&self, window: &Window, node: u32) -> u32 {
        if window.shift == 0 {
            return node;
        }
        match self.method() {
            Ok(Method::Cyclic(cyclic)) => cyclic.turned_node(node, window.shift).unwrap_or(node),
            Ok(Method::General(_, Some(turn))) => {
                (0..window.shift).fold(node, |n, _| turn.nodes.get(n as usize).copied().unwrap_or(n))
            }
            Ok(Method::General(_, None)) | Err(_) => node,
        }
    }

    /// Whether the window's nodes are last in the factor, and it tells of all else from them alone: it does not know
    /// the reactions of a bore that is held by its means.
    pub(crate) fn is_last(&self, window: &Window) -> bool {
        let by_means = self.gear.bore_coupling() == BoreCoupling::Distributing;
        self.coordinates.are_nodes() && !by_means && Arc::ptr_eq(&window.reduced, &self.base)
    }

    /// Unit loads of a window's coordinates.
    pub(crate) fn loads(&self, window: &Window) -> Result<Vec<Load>, ReductionError> {
        self.coordinates.loads(&self.gear, &window.reduced.teeth, &self.options.sides)
    }
}
