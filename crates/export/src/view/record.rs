//! What a solved position is remembered by until the run is over.

use contact::SliceResult;
use geometry::Side;
use ltca::{Equilibrium, StaticModel, StaticPosition};
use reduction::{ElasticGear, Window};

use super::{Band, DIGITS, FRAMES};
use answer::Numbers;
use scene::Scene;

/// Remembers some positions of the first mesh cycle.
#[derive(Debug)]
pub struct ViewRecorder {
    per_cycle: usize,
    every: usize,
    pub(super) positions: Vec<Recorded>,
}

/// One position.
#[derive(Debug)]
pub(super) struct Recorded {
    pub phase: f64,
    /// rad, from the middle position of pair 0.
    pub pinion_angle: f64,
    pub bands: Vec<Band>,
    pub gears: [RecordedGear; 2],
}

/// One gear at a position.
#[derive(Debug)]
pub(super) struct RecordedGear {
    /// Window of a reduced gear.
    pub window: Option<Window>,
    /// Teeth of the window in the frame of the matrices.
    pub teeth: Vec<u32>,
    /// Forces on the boundary coordinates, N, or of a whole gear the displacements of all free ones, mm; none without
    /// load.
    pub loads: Vec<f64>,
    /// Pressure (MPa) at nodes of the mesh; where contact is made of slices, their bands say more.
    pub pressure: Vec<(u32, f64)>,
}

impl ViewRecorder {
    /// Recorder of a scene's first mesh cycle.
    pub fn new(scene: &Scene) -> Self {
        let per_cycle = scene.analysis.positions_per_cycle as usize;
        Self { per_cycle, every: per_cycle.div_ceil(FRAMES).max(1), positions: Vec::new() }
    }

    /// Takes note of a position, the model standing where it was found.
    pub fn position(&mut self, index: usize, position: &StaticPosition, model: &StaticModel) {
        if index >= self.per_cycle || !index.is_multiple_of(self.every) {
            return;
        }
        let loads = model.last().map(|e| e.loads_on(model.contact_set())).unwrap_or_default();
        let mut loads = loads.into_iter();
        let gears = [0, 1].map(|i| RecordedGear::new(i, position, model, loads.next().unwrap_or_default()));
        self.positions.push(Recorded {
            phase: position.mesh_phase,
            pinion_angle: position.pinion_angle,
            bands: bands(position),
            gears,
        });
    }
}

impl RecordedGear {
    fn new(i: usize, position: &StaticPosition, model: &StaticModel, loads: Vec<f64>) -> Self {
        let window = model.contact_set().windows().map(|w| w[i].clone());
        let (first, z) = (model.contact_set().first_teeth()[i], model.gears()[i].gear().tooth_count());
        let teeth = match &window {
            Some(window) => window.reduced.teeth.clone(),
            None => (0..model.window().count() as u32).map(|k| (first + k) % z).collect(),
        };
        let sliced = position.pairs.iter().any(|p| !p.slices.is_empty());
        let pressure = match model.last().filter(|_| !sliced) {
            Some(e) => pressures(i, model, e, window.as_ref()),
            None => Vec::new(),
        };
        Self { window, teeth, loads, pressure }
    }
}

/// Pressure at nodes of the mesh in the frame of the matrices.
fn pressures(i: usize, model: &StaticModel, e: &Equilibrium, window: Option<&Window>) -> Vec<(u32, f64)> {
    let nodes = match (window, &model.gears()[i]) {
        (Some(window), _) => &window.reduced.nodes[..],
        (None, ElasticGear::Full(gear)) => gear.dofs.free_nodes(),
        (None, ElasticGear::Reduced(_)) => return Vec::new(),
    };
    let all = contact::line::nodal_pressures(&model.contact_set().patches()[i], i, &e.rows, &e.solution.forces);
    all.into_iter().filter_map(|(at, pressure)| Some((*nodes.get(at as usize)?, pressure))).collect()
}

/// The loaded slices of a position as bands, one a pair and side.
pub(super) fn bands(position: &StaticPosition) -> Vec<Band> {
    let sides = [Side::Left, Side::Right];
    let all = position.pairs.iter().flat_map(|pair| sides.map(|side| (pair, side)));
    let bands = all.filter_map(|(pair, side)| {
        let slices: Vec<&SliceResult> = pair.slices.iter().filter(|s| s.side == side).collect();
        let numbers = |f: &dyn Fn(&SliceResult) -> f64| Numbers(slices.iter().map(|s| f(s)).collect(), DIGITS);
        (!slices.is_empty()).then(|| Band {
            teeth: [pair.pinion_tooth, pair.wheel_tooth],
            side: side.sign(),
            z: [numbers(&|s| s.z), numbers(&|s| s.wheel_z)],
            roll: [numbers(&|s| s.roll[0]), numbers(&|s| s.roll[1])],
            half_width: numbers(&|s| s.half_width),
            pressure: numbers(&|s| s.pressure),
        })
    });
    bands.collect()
}
