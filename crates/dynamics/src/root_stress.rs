//! Stress in the root fillets at a solved station.
//!
//! ```text
//! sigma(x_i) = S_i u_B        at the surface nodes x_i of the window's fillets
//! ```
//! S are the stress modes of the reduced gear ([`reduction::StressModes`]), made once a window (once a gear if it is cyclic):
//! no station goes back to the whole mesh. With all degrees of freedom kept, the nodal stress operator takes their place.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, PoisonError},
};

use faer::MatRef;
use fem::StressOperator;
use geometry::{GearPair, Side};
use mesh::RootFillets;
use reduction::{ReducedGear, ReductionError, StressModes};
use serde::Serialize;

use crate::{ElasticGear, StaticError, parts::Parts};

/// How element stresses become one stress a node; said wherever a root stress is handed on.
///
/// CalculiX prints the same of a mesh: values at the points of highest accuracy (hex: 2^3 Gauss points), carried to
/// the nodes by the linear field through them, tensors averaged over the elements of a node, principal values taken last.
pub const ROOT_STRESS_AVERAGING: &str =
    "extrapolated from Gauss points, tensors averaged over the elements of a node, then principal values";

/// The largest of some stress measure in a fillet, and where.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StressPeak {
    /// MPa, tension positive.
    pub stress: f64,
    /// The mesh file's tag of the node (1, 2, ... for a generated mesh); of a periodic sector its own node, which every tooth has.
    pub node: u64,
    /// Distance of the node from the gear's axis, mm.
    pub radius: f64,
    /// Height of the node, mm from mid-face.
    pub z: f64,
}

/// Stress on the surface of one root fillet, from the root form circle to the middle of the tooth space.
///
/// Recovered as [`ROOT_STRESS_AVERAGING`] says. The fillet below the loaded flank is in tension, the other one of the tooth in
/// compression.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FilletStress {
    /// Tooth, 0 .. z-1.
    pub tooth: u32,
    /// Which of its two fillets.
    pub side: Side,
    /// Largest principal stress.
    pub max_principal: StressPeak,
    /// Smallest principal stress: the greatest compression.
    pub min_principal: StressPeak,
    /// Largest von Mises stress.
    pub von_mises: StressPeak,
}

const NAMES: [&str; 2] = ["pinion", "wheel"];

/// Fillets of both gears and the maps to their stress, window by window.
#[derive(Debug)]
pub(crate) struct RootStress {
    fillets: [RootFillets; 2],
    /// By gear, first tooth and number of teeth in the matrices' frame.
    windows: Mutex<BTreeMap<(usize, u32, usize), Arc<WindowRoots>>>,
}

/// The fillets of one window.
#[derive(Debug)]
struct WindowRoots {
    /// Tooth and side in the matrices' frame, and the places of the nodes in `nodes`.
    fillets: Vec<(u32, Side, Vec<usize>)>,
    /// Numbers of the mesh, fillet by fillet.
    nodes: Vec<u32>,
    map: StressMap,
}

#[derive(Debug)]
enum StressMap {
    /// From boundary coordinates of these matrices.
    Modes(Arc<ReducedGear>, StressModes),
    /// From all free degrees of freedom.
    Operator(StressOperator),
}

impl RootStress {
    /// Finds the fillets of both gears.
    pub(crate) fn new(pair: &GearPair, gears: &[ElasticGear; 2]) -> Self {
        let [pinion, wheel] = gears;
        let fillets = [RootFillets::new(pinion.gear(), &pair.pinion), RootFillets::new(wheel.gear(), &pair.wheel)];
        Self { fillets, windows: Mutex::default() }
    }

    /// Stress in every fillet of both windows, tooth by tooth counter-clockwise, right fillet before left, beside them the
    /// fillets that share a space with the window's outermost teeth.
    ///
    /// `displacements` are those of an equilibrium; without any the gears are at rest.
    pub(crate) fn of(
        &self,
        parts: &Parts,
        displacements: Option<&[Vec<f64>; 2]>,
    ) -> Result<[Vec<FilletStress>; 2], StaticError> {
        let mut both = [Vec::new(), Vec::new()];
        for (i, result) in both.iter_mut().enumerate() {
            let fail = |source| StaticError::Reduction { gear: NAMES[i], source };
            let roots = self.window(parts, i).map_err(fail)?;
            let stress = match displacements {
                Some(u) => roots.stress(&u[i]).map_err(fail)?,
                None => vec![[0.0; 6]; roots.nodes.len()],
            };
            *result = roots.fillets.iter().filter_map(|f| roots.fillet(f, &stress, parts, i)).collect();
        }
        Ok(both)
    }

    fn window(&self, parts: &Parts, i: usize) -> Result<Arc<WindowRoots>, ReductionError> {
        let key = (i, parts.set.first_teeth()[i], parts.window.count());
        let mut windows = self.windows.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(roots) = windows.get(&key).filter(|roots| roots.serves(parts, i)) {
            return Ok(roots.clone());
        }
        let roots = Arc::new(WindowRoots::new(&self.fillets[i], parts, i)?);
        windows.insert(key, roots.clone());
        Ok(roots)
    }
}

impl WindowRoots {
    fn new(found: &RootFillets, parts: &Parts, i: usize) -> Result<Self, ReductionError> {
        let elastic = &parts.gears[i];
        let z = elastic.gear().tooth_count();
        let (first, count) = (parts.set.first_teeth()[i], parts.window.count() as u32);
        let (mut fillets, mut nodes) = (Vec::new(), Vec::new());
        let mut add = |tooth: u32, side: Side, needed: bool| {
            let tooth = tooth % z;
            let own = found.nodes(tooth, side);
            if own.is_empty() {
                return if needed { Err(ReductionError::MissingFillet { tooth, side }) } else { Ok(()) };
            }
            fillets.push((tooth, side, (nodes.len()..nodes.len() + own.len()).collect()));
            nodes.extend_from_slice(own);
            Ok(())
        };
        // A sector may end with the window's outermost teeth.
        if count < z {
            add(first + z - 1, Side::Left, false)?;
        }
        for tooth in first..first + count {
            add(tooth, Side::Right, true)?;
            add(tooth, Side::Left, true)?;
        }
        if count < z {
            add(first + count, Side::Right, false)?;
        }
        let map = match (elastic, parts.set.windows()) {
            (ElasticGear::Reduced(gear), Some(windows)) => {
                let modes = gear.stress_modes(&windows[i], &nodes)?;
                StressMap::Modes(windows[i].reduced.clone(), modes)
            }
            (ElasticGear::Reduced(gear), None) => {
                // No set of a reduced gear is without its window; the operator would serve all the same.
                let (mesh, dofs) = (gear.gear().mesh(), gear.dofs());
                StressMap::Operator(StressOperator::new(mesh, gear.material(), gear.elements(), dofs, &nodes)?)
            }
            (ElasticGear::Full(gear), _) => {
                let (mesh, dofs) = (gear.gear.mesh(), &gear.dofs);
                StressMap::Operator(StressOperator::new(mesh, &gear.material, &gear.elements, dofs, &nodes)?)
            }
        };
        Ok(Self { fillets, nodes, map })
    }

    /// Whether the map is that of the matrices now in use.
    fn serves(&self, parts: &Parts, i: usize) -> bool {
        match (&self.map, parts.set.windows()) {
            (StressMap::Modes(mine, _), Some(windows)) => Arc::ptr_eq(mine, &windows[i].reduced),
            (StressMap::Operator(_), None) => true,
            _ => false,
        }
    }

    fn stress(&self, u: &[f64]) -> Result<Vec<[f64; 6]>, ReductionError> {
        match &self.map {
            StressMap::Modes(_, modes) => modes.stress(u),
            StressMap::Operator(operator) => {
                let s = operator.apply(MatRef::from_column_major_slice(u, u.len(), 1))?;
                Ok((0..self.nodes.len()).map(|i| [0, 1, 2, 3, 4, 5].map(|k| s[(6 * i + k, 0)])).collect())
            }
        }
    }

    /// Peaks of one fillet, as the gear itself numbers tooth and node.
    fn fillet(
        &self,
        (tooth, side, places): &(u32, Side, Vec<usize>),
        stress: &[[f64; 6]],
        parts: &Parts,
        i: usize,
    ) -> Option<FilletStress> {
        let elastic = &parts.gears[i];
        let mesh = elastic.gear().mesh();
        let window = parts.set.windows().map(|w| &w[i]);
        let peak = |measure: fn(&[f64; 6]) -> f64, sign: f64| {
            let values = places.iter().map(|&at| (at, measure(&stress[at])));
            // The first of equals, so that nothing depends on how the nodes are gone through.
            let (at, stress) = values.reduce(|best, v| if sign * v.1 > sign * best.1 { v } else { best })?;
            let node = self.nodes[at];
            let [x, y, z] = mesh.nodes[node as usize];
            let own = match (elastic, window) {
                (ElasticGear::Reduced(gear), Some(window)) => gear.material_node(window, node),
                _ => node,
            };
            Some(StressPeak { stress, node: mesh.node_tags[own as usize], radius: x.hypot(y), z })
        };
        Some(FilletStress {
            tooth: (tooth + window.map_or(0, |w| w.shift)) % elastic.gear().tooth_count(),
            side: *side,
            max_principal: peak(fem::max_principal, 1.0)?,
            min_principal: peak(fem::min_principal, -1.0)?,
            von_mises: peak(fem::von_mises, 1.0)?,
        })
    }
}
