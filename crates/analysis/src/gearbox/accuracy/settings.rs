//! Discretisation settings of a gearbox solution.

use scene::{Scene, gearbox::Gearbox};

use crate::accuracy::{CalibratedMesh, Calibration, Rung, has_own_mesh};

/// Positions of a cycle that the ladder begins with, at least, and ends with; slices and shaft elements that it ends with.
const POSITIONS: [u32; 2] = [8, 256];
const MOST_SLICES: u32 = 768;
const MOST_ELEMENTS: u32 = 128;
/// Half and a quarter of the positions are held against all.
const QUARTERS: u32 = 4;
/// Rung that the ladder begins on, and the coarsest that a mesh which is given is held against: one is coarser.
const FIRST: Rung = Rung::ALL[1];

/// Settings of a gearbox, mesh by mesh where they are the meshes'.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Settings {
    /// Rung that both gears of a mesh are on; `None`: as its scene has them.
    pub rungs: Vec<Option<Rung>>,
    /// Slices.
    pub slices: Vec<u32>,
    /// Positions in a cycle of the first mesh.
    pub positions: u32,
    /// Elements along every shaft, at least.
    pub shaft_elements: u32,
}

/// What is the program's to choose, mesh by mesh: what the scene of a pair says nothing of.
#[derive(Debug, Clone)]
pub(super) struct Free {
    pub meshes: Vec<bool>,
    pub slices: Vec<bool>,
}

impl Free {
    /// Settings of a gearbox.
    pub fn of(file: &Gearbox) -> Self {
        let counts =
            ["order", "elements_profile", "elements_fillet", "elements_thickness", "elements_face", "elements_rim"];
        let keys: Vec<String> =
            ["pinion", "wheel"].iter().flat_map(|gear| counts.map(|key| format!("{gear}.mesher.{key}"))).collect();
        let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
        let scenes = || file.meshes.iter().map(|mesh| &mesh.scene);
        let mut meshes: Vec<bool> = scenes().map(|own| !has_own_mesh(own) && own.place_of(&keys).is_none()).collect();
        // A gear has one mesh: who shares it with a mesh that is given takes that.
        let touch = |i: usize, k: usize| file.meshes[i].gears.iter().any(|gear| file.meshes[k].gears.contains(gear));
        while let Some(bound) =
            (0..meshes.len()).find(|&i| meshes[i] && (0..meshes.len()).any(|k| !meshes[k] && touch(i, k)))
        {
            meshes[bound] = false;
        }
        Self { meshes, slices: scenes().map(|own| own.place_of(&["contact.slices"]).is_none()).collect() }
    }
}

impl Settings {
    /// Settings to try first; `scenes` are those of the meshes with their slices.
    pub fn first(file: &Gearbox, free: &Free, scenes: &[Scene]) -> Self {
        Self {
            rungs: free.meshes.iter().map(|free| free.then_some(FIRST)).collect(),
            // Half of one would tell nothing.
            slices: scenes.iter().map(|own| own.contact.slices.unwrap_or(2).max(2)).collect(),
            positions: file.positions_per_cycle.max(POSITIONS[0]).next_multiple_of(QUARTERS),
            shaft_elements: file.shaft_elements.max(2),
        }
    }

    /// The gearbox with these settings, without `[accuracy]`.
    pub fn gearbox(&self, file: &Gearbox) -> Gearbox {
        let mut own = Gearbox { accuracy: Default::default(), ..file.clone() };
        for ((mesh, rung), slices) in own.meshes.iter_mut().zip(&self.rungs).zip(&self.slices) {
            if let Some(rung) = rung {
                mesh.scene = rung.scene(&mesh.scene);
            }
            mesh.scene.contact.slices = Some(*slices);
        }
        one_face(&mut own);
        (own.positions_per_cycle, own.shaft_elements) = (self.positions, self.shaft_elements);
        own
    }

    /// The rung of the meshes that the program chooses.
    pub fn rung(&self) -> Option<Rung> {
        self.rungs.iter().flatten().next().copied()
    }

    /// Puts given meshes on a rung each: their own if it belongs to the ladder and has a coarser one below it,
    /// otherwise [`FIRST`]. The same settings if no mesh is given.
    pub fn on_rungs(&self, file: &Gearbox) -> Self {
        let one = |(mesh, rung): (&scene::gearbox::GearboxMesh, &Option<Rung>)| {
            let own = Rung::of(&mesh.scene).filter(|own| *own >= FIRST && !has_own_mesh(&mesh.scene));
            rung.or(own).or(Some(FIRST))
        };
        Self { rungs: file.meshes.iter().zip(&self.rungs).map(one).collect(), ..self.clone() }
    }

    /// All meshes one rung coarser, and the smallest ratio of their element counts.
    pub fn coarser(&self) -> (Self, f64) {
        let coarser = |rung: &Option<Rung>| rung.map(|own| own.coarser().unwrap_or(own));
        let own = Self { rungs: self.rungs.iter().map(coarser).collect(), ..self.clone() };
        let both = self.rungs.iter().flatten().zip(own.rungs.iter().flatten());
        let ratio =
            |(fine, coarse): (&Rung, &Rung)| f64::from(fine.elements_profile) / f64::from(coarse.elements_profile);
        let least = both.map(ratio).fold(f64::INFINITY, f64::min);
        (own, least)
    }

    /// The same with half the slices.
    pub fn fewer_slices(&self) -> Self {
        Self { slices: self.slices.iter().map(|n| n / 2).collect(), ..self.clone() }
    }

    /// The same with a given number of positions.
    pub fn with_positions(&self, positions: u32) -> Self {
        Self { positions, ..self.clone() }
    }

    /// The same with half the shaft elements.
    pub fn fewer_elements(&self) -> Self {
        Self { shaft_elements: self.shaft_elements / 2, ..self.clone() }
    }

    /// Finer rungs for the meshes that the program chooses, up to the finest with laws of pairs.
    pub fn finer_rungs(&self) -> impl Iterator<Item = Rung> + use<> {
        let own = self.rung();
        let known = |rung: &Rung| Calibration::committed().knows(CalibratedMesh::Rung(rung.elements_profile));
        Rung::ALL.into_iter().filter(known).filter(move |rung| own.is_some_and(|own| *rung > own))
    }

    /// The same, with the meshes that the program chooses on a rung.
    pub fn on(&self, rung: Rung) -> Self {
        Self { rungs: self.rungs.iter().map(|own| own.map(|_| rung)).collect(), ..self.clone() }
    }

    /// The same with twice the slices that the program chooses; `None` if there are none, or if there would be too
    /// many.
    pub fn more_slices(&self, free: &Free) -> Option<Self> {
        let slices: Vec<u32> =
            self.slices.iter().zip(&free.slices).map(|(n, free)| if *free { 2 * n } else { *n }).collect();
        let fits =
            slices != self.slices && slices.iter().zip(&self.slices).all(|(n, old)| n == old || *n <= MOST_SLICES);
        fits.then(|| Self { slices, ..self.clone() })
    }

    /// The same with twice the positions.
    pub fn more_positions(&self) -> Option<Self> {
        let positions = 2 * self.positions;
        (positions <= POSITIONS[1]).then(|| self.with_positions(positions))
    }

    /// The same with twice the shaft elements.
    pub fn more_elements(&self) -> Option<Self> {
        let shaft_elements = 2 * self.shaft_elements;
        (shaft_elements <= MOST_ELEMENTS).then(|| Self { shaft_elements, ..self.clone() })
    }
}

/// Gears of several meshes, whose faces may differ in width: along the face each has the most elements that one of them asks for.
fn one_face(file: &mut Gearbox) {
    let mut most = vec![0; file.gears.len()];
    for mesh in &file.meshes {
        for (&gear, own) in mesh.gears.iter().zip(mesh.scene.gears()) {
            most[gear] = most[gear].max(own.mesher.map_or(0, |m| m.elements_face));
        }
    }
    for mesh in &mut file.meshes {
        let gears = [&mut mesh.scene.pinion, &mut mesh.scene.wheel];
        for (&gear, own) in mesh.gears.iter().zip(gears) {
            if let Some(mesher) = &mut own.mesher {
                mesher.elements_face = most[gear];
            }
        }
    }
}
