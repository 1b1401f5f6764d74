//! Stress in the root fillets at a solved station.
//!
//! ```text
//! sigma(x_i) = S_i u_B        at the surface nodes x_i of the window's fillets
//! ```
//! S are the stress modes of the reduced gear ([`reduction::StressModes`]), computed once per window (once per gear if
//! it is cyclic). So no station needs the whole mesh. For gears with all degrees of freedom the stress operator is used
//! instead.
//!
//! There are two recoveries of the stress. The first uses only the displacement of the free surface; it is the reported
//! stress. The second uses the Gauss points of the elements; its difference from the first shows how far the mesh has
//! converged.

mod fillet;
mod pattern;
mod turn;

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, PoisonError},
};

use contact::ContactError;
use faer::MatRef;
use fem::{DofMap, ElementOptions, Material, StressOperator};
use fillet::{Fillet, Surroundings, fallback_radius};
use geometry::{GearPair, Side};
use mesh::{Face, Mesh, RootFillets};
pub use pattern::RootPattern;
use reduction::{ElasticGear, ReducedGear, ReductionError, StressModes};
use serde::Serialize;

use crate::{StaticError, WindowedPair};

/// Definition of the root stress, given wherever a root stress is reported.
pub const ROOT_STRESS_DEFINITION: &str = "largest peak of the stress on the free surface of the root fillets, from the 20 deg tangent to the \
    middle of the tooth space, over the whole face width; stress that rises up to the flank is of contact and left out";

/// Recovery of the root stress from the displacement of the mesh, given with the definition.
pub const ROOT_STRESS_RECOVERY: &str = "strains in the surface from the displacement of its faces, no stress across it, by \
    polynomials through the most accurate points of the faces about each node, then principal values";

/// Share of the difference between the two recoveries that is the error of the better one.
///
/// Both converge to the same stress, the one from Gauss points from farther off. Measured on random pairs
/// (docs/validation.md).
const ERROR_SHARE: f64 = 0.35;
/// Error that both recoveries share, over stress and the square of the angle by which the surface turns within one
/// face, 1/rad^2: where both are wrong alike, they agree. Measured there, too: six faces along a fillet turn by 15 to
/// 18 deg, and are 1.3 % off at the most.
const ERROR_OF_TURN: f64 = 0.15;
/// The same of elements of order 1, 1/rad^2, and what each radius of depth below the surface beyond the first adds. Measured on
/// a spur and a helical pair with 2 to 16 elements along the fillet and 2 to 32 over the rim.
const ERROR_OF_TURN_ORDER_1: f64 = 2.0;
const ERROR_OF_DEPTH: f64 = 0.6;

/// Largest value of a stress measure in a fillet, and its position.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StressPeak {
    /// Stress, MPa, positive in tension.
    pub stress: f64,
    /// Largest value of the same measure in the whole fillet from the Gauss points of the elements, MPa, as other
    /// programs print it.
    pub from_volume: f64,
    /// Largest value at the node and at the nodes that share a face with it, MPa.
    pub beside: f64,
    /// Largest angle by which the surface of the gear's fillets turns within one face, rad: the size of the faces
    /// divided by their radius.
    pub turn: f64,
    /// Depth of the elements of order 1 below the surface of the fillets over its radius; 0 of other elements.
    pub depth: f64,
    /// Tag of the node in the mesh file (1, 2, ... for a generated mesh). For a periodic sector it is the sector's own
    /// node, which every tooth has.
    pub node: u64,
    /// Distance of the node from the gear's axis, mm.
    pub radius: f64,
    /// Height of the node, mm from mid-face.
    pub z: f64,
}

/// Stress on the surface of one root fillet, from its 20 deg tangent to the middle of the tooth space.
///
/// Recovered as described in [`ROOT_STRESS_RECOVERY`]. The fillet below the loaded flank is in tension, the tooth's
/// other fillet in compression.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FilletStress {
    /// Tooth number, 0 .. z-1.
    pub tooth: u32,
    /// Side of the tooth on which the fillet lies.
    pub side: Side,
    /// Largest principal stress.
    pub max_principal: StressPeak,
    /// Smallest principal stress: the greatest compression.
    pub min_principal: StressPeak,
    /// Largest von Mises stress.
    pub von_mises: StressPeak,
}

/// Principal stresses at a point of a fillet's surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilletPlace {
    /// Distance from the gear's axis, mm.
    pub radius: f64,
    /// Height from mid-face, mm.
    pub z: f64,
    /// Largest principal stress, MPa. The principal stress across the surface is 0.
    pub max_principal: f64,
    /// Smallest principal stress, MPa.
    pub min_principal: f64,
}

/// A fillet with the stress at all its points.
#[derive(Debug, Clone, PartialEq)]
pub struct FilletField {
    /// Peaks of the stress measures.
    pub peaks: FilletStress,
    /// Points of the fillet, one per node of the mesh.
    pub places: Vec<FilletPlace>,
}

impl FilletField {
    /// Scales the stress to `load` times the load.
    pub fn grow(&mut self, load: f64) {
        self.peaks = self.peaks.times(load);
        for place in &mut self.places {
            place.max_principal *= load;
            place.min_principal *= load;
        }
    }
}

impl FilletStress {
    /// The stress under `load` times the load.
    pub fn times(&self, load: f64) -> Self {
        let of = |peak: StressPeak| StressPeak {
            stress: load * peak.stress,
            from_volume: load * peak.from_volume,
            beside: load * peak.beside,
            ..peak
        };
        let [max_principal, min_principal, von_mises] =
            [self.max_principal, self.min_principal, self.von_mises].map(of);
        Self { max_principal, min_principal, von_mises, ..*self }
    }
}

impl StressPeak {
    /// The smaller of the two recovered values, MPa. The largest of several peaks is chosen by it, because within an
    /// element of a force at the corner of a tooth the recoveries differ.
    pub fn seen(&self) -> f64 {
        if self.beside.abs() < self.stress.abs() { self.beside } else { self.stress }
    }

    /// Estimated relative difference of `stress` from that on an infinitely fine mesh; 0 without load.
    ///
    /// A fixed share of the difference between two recoveries that converge to the same value at different rates, plus
    /// an estimate of the error that both have in common: 0.35 |stress - beside| / |stress| + 0.15 turn^2. Elements of order 1
    /// give too small a stress: for the last term 2 turn^2 + 0.6 max(depth - 1, 0).
    pub fn relative_error(&self) -> f64 {
        let in_common = if self.depth > 0.0 {
            ERROR_OF_TURN_ORDER_1 * self.turn.powi(2) + ERROR_OF_DEPTH * (self.depth - 1.0).max(0.0)
        } else {
            ERROR_OF_TURN * self.turn.powi(2)
        };
        let off = ERROR_SHARE * (self.stress - self.beside).abs() + in_common * self.stress.abs();
        if off > 0.0 { off / self.stress.abs() } else { 0.0 }
    }
}

const NAMES: [&str; 2] = ["pinion", "wheel"];

/// Fillets of both gears and the maps to their stress, per window.
#[derive(Debug)]
pub struct RootStress {
    fillets: [RootFillets; 2],
    /// Radius below which stress is looked for on fillets without a peak, mm.
    fallback: [f64; 2],
    /// Roots of the windows solved so far, by gear, first tooth and number of teeth in the matrices' frame.
    windows: Mutex<BTreeMap<(usize, u32, usize), Arc<WindowRoots>>>,
}

/// The fillets of one window.
#[derive(Debug)]
struct WindowRoots {
    fillets: Vec<Fillet>,
    /// Numbers of the mesh, fillet by fillet.
    nodes: Vec<u32>,
    /// Stress recovery from the free surface, and from the elements.
    maps: [StressMap; 2],
}

#[derive(Debug)]
enum StressMap {
    /// Recovery from boundary coordinates of these matrices.
    Modes(Arc<ReducedGear>, StressModes),
    /// Recovery from all free degrees of freedom.
    Operator(StressOperator),
}

impl StressMap {
    /// Maps of a window: recovery from the free surface, and from the elements.
    fn both(
        windowed: &WindowedPair,
        i: usize,
        nodes: &[u32],
        faces: &[Vec<Face>],
    ) -> Result<[Self; 2], ReductionError> {
        let operators = |mesh: &Mesh, material: &Material, elements: &ElementOptions, dofs: &DofMap| {
            let surface = StressOperator::on_surface(mesh, material, dofs, faces, nodes)?;
            let volume = StressOperator::new(mesh, material, elements, dofs, nodes)?;
            Ok([surface, volume].map(Self::Operator))
        };
        match (&windowed.gears[i], windowed.set.windows()) {
            (ElasticGear::Reduced(gear), Some(windows)) => {
                let modes = gear.both_stress_modes(&windows[i], nodes, faces)?;
                Ok(modes.map(|modes| Self::Modes(windows[i].reduced.clone(), modes)))
            }
            // No set of a reduced gear is without its window; the operator would serve all the same.
            (ElasticGear::Reduced(gear), None) => {
                operators(gear.gear().mesh(), gear.material(), gear.elements(), gear.dofs())
            }
            (ElasticGear::Full(gear), _) => operators(gear.gear.mesh(), &gear.material, &gear.elements, &gear.dofs),
        }
    }

    /// Stress under what [`Equilibrium::loads_on`] has of a gear.
    fn stress(&self, u: &[f64]) -> Result<Vec<[f64; 6]>, ReductionError> {
        match self {
            Self::Modes(_, modes) => modes.stress_under(u),
            Self::Operator(operator) => {
                let s = operator.apply(MatRef::from_column_major_slice(u, u.len(), 1))?;
                let at = |i: usize| [0, 1, 2, 3, 4, 5].map(|k| s[(6 * i + k, 0)]);
                Ok((0..operator.node_count()).map(at).collect())
            }
        }
    }
}

impl RootStress {
    /// Finds the fillets of both gears.
    pub fn new(pair: &GearPair, gears: &[ElasticGear; 2]) -> Self {
        let [pinion, wheel] = gears;
        let fillets = [RootFillets::new(pinion.gear(), &pair.pinion), RootFillets::new(wheel.gear(), &pair.wheel)];
        let fallback = [&pair.pinion, &pair.wheel].map(fallback_radius);
        Self { fillets, fallback, windows: Mutex::default() }
    }

    /// Stress in every fillet of both windows, tooth by tooth counter-clockwise, the right fillet before the left. The
    /// fillets that share a tooth space with the outermost teeth are included.
    ///
    /// `loads` are those of an equilibrium: forces (N) on the boundary coordinates of reduced gears, displacements (mm)
    /// of whole gears. Without loads the stress is zero.
    ///
    /// # Errors
    /// [`StaticError`] where the stress has no maps.
    pub fn of(
        &self,
        windowed: &WindowedPair,
        loads: Option<&[Vec<f64>; 2]>,
    ) -> Result<[Vec<FilletStress>; 2], StaticError> {
        self.each(windowed, loads, |_, _, peaks| peaks)
    }

    /// The same fillets with the stress at all their points.
    ///
    /// # Errors
    /// The errors of [`RootStress::of`].
    pub fn fields(
        &self,
        windowed: &WindowedPair,
        loads: Option<&[Vec<f64>; 2]>,
    ) -> Result<[Vec<FilletField>; 2], StaticError> {
        self.each(windowed, loads, |roots, (i, fillet, stress), peaks| {
            let nodes = &windowed.gears[i].gear().mesh().nodes;
            let place = |at: usize| {
                let [x, y, z] = nodes[roots.nodes[at] as usize];
                FilletPlace {
                    radius: x.hypot(y),
                    z,
                    max_principal: fem::max_principal(&stress[at]),
                    min_principal: fem::min_principal(&stress[at]),
                }
            };
            FilletField { peaks, places: fillet.places().map(place).collect() }
        })
    }

    /// Something of every fillet of both windows, by its roots, gear and stress from the free surface, and its peaks.
    fn each<T>(
        &self,
        windowed: &WindowedPair,
        loads: Option<&[Vec<f64>; 2]>,
        of: impl Fn(&WindowRoots, (usize, &Fillet, &[[f64; 6]]), FilletStress) -> T,
    ) -> Result<[Vec<T>; 2], StaticError> {
        let mut both = [Vec::new(), Vec::new()];
        for (i, result) in both.iter_mut().enumerate() {
            let fail = |source| ContactError::Reduction { gear: NAMES[i], source };
            let roots = self.window(windowed, i).map_err(fail)?;
            let stress = match loads {
                Some(loads) => roots.stress(&loads[i]).map_err(fail)?,
                None => [(); 2].map(|()| vec![[0.0; 6]; roots.nodes.len()]),
            };
            let one = |f: &Fillet| Some(of(&roots, (i, f, &stress[0]), roots.fillet(f, &stress, windowed, i)?));
            *result = roots.fillets.iter().filter_map(one).collect();
        }
        Ok(both)
    }

    /// Makes the maps of both windows, that no position waits for them.
    pub(crate) fn prepare(&self, windowed: &WindowedPair) -> Result<(), StaticError> {
        for (i, gear) in NAMES.into_iter().enumerate() {
            self.window(windowed, i).map_err(|source| ContactError::Reduction { gear, source })?;
        }
        Ok(())
    }

    fn window(&self, windowed: &WindowedPair, i: usize) -> Result<Arc<WindowRoots>, ReductionError> {
        let key = (i, windowed.set.first_teeth()[i], windowed.window.count());
        let mut windows = self.windows.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(roots) = windows.get(&key).filter(|roots| roots.serves(windowed, i)) {
            return Ok(roots.clone());
        }
        let roots = Arc::new(WindowRoots::new(&self.fillets[i], self.fallback[i], windowed, i)?);
        windows.insert(key, roots.clone());
        Ok(roots)
    }
}

impl WindowRoots {
    fn new(found: &RootFillets, fallback: f64, windowed: &WindowedPair, i: usize) -> Result<Self, ReductionError> {
        let elastic = &windowed.gears[i];
        let z = elastic.gear().tooth_count();
        let (first, count) = (windowed.set.first_teeth()[i], windowed.window.count() as u32);
        let (mut fillets, mut nodes) = (Vec::new(), Vec::new());
        let about = Surroundings::new(found, elastic.gear().mesh(), fallback);
        let mut add = |tooth: u32, side: Side, needed: bool| {
            let tooth = tooth % z;
            let own = found.nodes(tooth, side);
            if own.is_empty() {
                return if needed { Err(ReductionError::MissingFillet { tooth, side }) } else { Ok(()) };
            }
            fillets.push(about.fillet(tooth, side, own, nodes.len()));
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
        let maps = StressMap::both(windowed, i, &nodes, found.faces())?;
        Ok(Self { fillets, nodes, maps })
    }

    /// Whether the map is that of the matrices now in use.
    fn serves(&self, windowed: &WindowedPair, i: usize) -> bool {
        match (&self.maps[0], windowed.set.windows()) {
            (StressMap::Modes(mine, _), Some(windows)) => Arc::ptr_eq(mine, &windows[i].reduced),
            (StressMap::Operator(_), None) => true,
            _ => false,
        }
    }

    /// Stress by both recoveries, MPa.
    fn stress(&self, u: &[f64]) -> Result<[Vec<[f64; 6]>; 2], ReductionError> {
        let [surface, volume] = &self.maps;
        Ok([surface.stress(u)?, volume.stress(u)?])
    }

    /// Peaks of one fillet, as the gear itself numbers tooth and node.
    fn fillet(
        &self,
        fillet: &Fillet,
        [surface, volume]: &[Vec<[f64; 6]>; 2],
        windowed: &WindowedPair,
        i: usize,
    ) -> Option<FilletStress> {
        let elastic = &windowed.gears[i];
        let mesh = elastic.gear().mesh();
        let window = windowed.set.windows().map(|w| &w[i]);
        let peak = |measure: fn(&[f64; 6]) -> f64, sign: f64| {
            let (first, second) = (|at: usize| measure(&surface[at]), |at: usize| measure(&volume[at]));
            let at = fillet.peak(first, second, sign)?;
            let node = self.nodes[at];
            let [x, y, z] = mesh.nodes[node as usize];
            let own = match (elastic, window) {
                (ElasticGear::Reduced(gear), Some(window)) => gear.material_node(window, node),
                _ => node,
            };
            Some(StressPeak {
                stress: first(at),
                from_volume: fillet.largest(second, sign)?,
                beside: fillet.beside(at, second, sign),
                turn: fillet.coarseness.turn,
                depth: fillet.coarseness.depth,
                node: mesh.node_tags[own as usize],
                radius: x.hypot(y),
                z,
            })
        };
        Some(FilletStress {
            tooth: (fillet.tooth + window.map_or(0, |w| w.shift)) % elastic.gear().tooth_count(),
            side: fillet.side,
            max_principal: peak(fem::max_principal, 1.0)?,
            min_principal: peak(fem::min_principal, -1.0)?,
            von_mises: peak(fem::von_mises, 1.0)?,
        })
    }
}
