//! Static equilibrium of shafts, bearings and gears under torques. Theory (81), (83), (84).

use geometry::Sense;
use nalgebra::{DMatrix, DVector, Dyn, OMatrix, SMatrix, U12};

use crate::{
    Assembly, ExactMesh, FlankForces, GearMesh, GearboxError, MeshElement, MeshForces, ModalForces, RollersOnBore,
    Structure, Train, Vector12,
    compliant_support::CompliantBearing,
    equilibrium::Norms,
    even_mesh::{guessed_lever, guessed_stiffness, turn},
    joined_meshes::JoinedMeshes,
    mesh_element::spread,
    rolling_bearing::RollingState,
    seats::Seats,
    train::at_mesh,
    turned_seat::TurnedSprings,
    unconstrained::check_held,
};

/// A torque on a disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torque {
    /// Index of the disc.
    pub disc: usize,
    /// Torque, N mm about +z. It must act against the rotation of its shaft, because only the input drives.
    pub torque: f64,
}

/// Operation of a gearbox: input, sense, torques, held shafts.
#[derive(Debug, Clone, PartialEq)]
pub struct Operation {
    /// Disc whose rotation is given: the input coupling.
    pub input: usize,
    /// Sense of rotation of the input.
    pub sense: Sense,
    /// Torques of the outputs.
    pub torques: Vec<Torque>,
    /// Angle of tooth 0 of each disc relative to the mark of its shaft, rad ([`Train::new`]).
    pub keys: Vec<f64>,
    /// Shafts that are rigid in rigid bearings: they only rotate about their axes. A single pair consists of two of
    /// them.
    pub held: Vec<usize>,
}

/// A gearbox in static equilibrium: any number of shafts and meshes.
pub struct StaticGearbox {
    pub(crate) assembly: Assembly,
    pub(crate) meshes: Vec<GearMesh>,
    pub(crate) train: Train,
    pub(crate) operation: Operation,
    pub(crate) held: Vec<bool>,
    pub(crate) seats: Seats,
    pub(crate) elements: Vec<Box<dyn MeshElement>>,
    /// Meshes that are one contact.
    pub(crate) joined: Vec<JoinedMeshes>,
    /// First coordinates of both gears of each mesh among the seats', and the turn of its axes.
    pub(crate) places: Vec<([usize; 2], SMatrix<f64, 12, 12>)>,
    /// Displacements of both gears of each mesh in its own axes by the coordinates z, 12 x n.
    pub(crate) to_gears: Vec<OMatrix<f64, U12, Dyn>>,
    /// Load on the seats.
    pub(crate) load: DVector<f64>,
    pub(crate) stiffness: DMatrix<f64>,
    /// Bearings with rolling elements.
    pub(crate) compliant_support: Vec<CompliantBearing>,
    /// Springs whose seats turn with a carrier.
    pub(crate) turned_springs: Vec<TurnedSprings>,
    pub(crate) norms: Norms,
    /// Angle and solution of the last two positions, the last one first.
    pub(crate) last: Vec<(f64, DVector<f64>)>,
    /// Meshes of the last position, in their own axes.
    pub(crate) replies: Vec<MeshForces>,
}

impl StaticGearbox {
    /// Gearbox with one element per mesh, in order; `elements` makes them from the running of the mesh.
    ///
    /// # Errors
    /// [`GearboxError`] if parts do not fit together, a torque drives, or a part can move freely.
    pub fn new(
        structure: Structure,
        meshes: Vec<GearMesh>,
        operation: Operation,
        mut elements: impl FnMut(usize, &GearMesh, &crate::Meshing) -> Result<Box<dyn MeshElement>, GearboxError>,
    ) -> Result<Self, GearboxError> {
        let train = Train::new(&structure, &meshes, &operation.keys, operation.input, operation.sense)?;
        check(&structure, &train, &operation)?;
        let mut held = vec![false; structure.shafts.len()];
        operation.held.iter().for_each(|&shaft| held[shaft] = true);
        check_held(&structure, &held, (&meshes, &train), operation.input)?;
        let assembly = Assembly::new(structure)?;
        let mut discs: Vec<usize> = meshes.iter().flat_map(|m| m.discs).collect();
        discs.extend(operation.torques.iter().map(|t| t.disc).chain([operation.input]));
        let seats = Seats::new(&assembly, &discs, &held, operation.input)?;
        let mut load = seats.of_all(&assembly.preload(), &assembly);
        for torque in &operation.torques {
            if let Some(at) = seats.of_disc(&assembly, torque.disc) {
                load[at + 5] += torque.torque;
            }
        }
        let stiffness = seats.basis.transpose() * &seats.stiffness * &seats.basis;
        let compliant_support = CompliantBearing::all(&assembly, &seats, &held);
        let turned_springs = TurnedSprings::all(&assembly, &seats);
        let mut rough = DMatrix::zeros(seats.size(), seats.size());
        let force = guessed_force(&meshes, &operation);
        for own in &compliant_support {
            own.add_stiffness(&assembly.structure().bearings[own.bearing].rough_stiffness(force), &mut rough);
        }
        let mut guessed = &stiffness + seats.basis.transpose() * rough * &seats.basis;
        let (mut places, mut made, mut to_gears) = (Vec::new(), Vec::new(), Vec::new());
        for (i, (mesh, meshing)) in meshes.iter().zip(train.meshing()).enumerate() {
            let at = mesh.discs.map(|d| seats.of_disc(&assembly, d).unwrap_or(0));
            let turn = turn(meshing.direction);
            let named = |source: GearboxError| at_mesh(mesh, source);
            made.push(elements(i, mesh, meshing).map_err(named)?);
            let lever = seats.basis.transpose() * spread(seats.size(), at, &(turn * guessed_lever(mesh, meshing)?));
            guessed.ger(guessed_stiffness(&mesh.pair), &lever, &lever, 1.0);
            let at_gears =
                OMatrix::<f64, U12, Dyn>::from_fn(seats.basis.ncols(), |k, j| seats.basis[(at[k / 6] + k % 6, j)]);
            to_gears.push(turn.transpose() * at_gears);
            places.push((at, turn));
        }
        let norms = Norms::new(guessed)?;
        Ok(Self {
            assembly,
            meshes,
            train,
            operation,
            held,
            seats,
            elements: made,
            joined: Vec::new(),
            places,
            to_gears,
            load,
            stiffness,
            compliant_support,
            turned_springs,
            norms,
            last: Vec::new(),
            replies: Vec::new(),
        })
    }

    /// The gearbox with exact meshes of one gear joined to one contact: what one of them presses moves, through the elastic
    /// body of the gear, the flanks in the others. Without it each mesh acts alone on the body.
    ///
    /// ```text
    /// g_i = g0_i + sum_j S_ij F_j + delta_i(F_i),   S between two meshes = A_1 C_12 A_2'
    /// ```
    /// i, j: slices of all joined meshes; C_12: compliance between the windows of the gear
    /// ([`reduction::GearReducer::compliance_between`]). [`StaticGearbox::solve`] fails where a gear is not reduced from the
    /// same mesh in all of its meshes. Theory (38a).
    ///
    /// Rolling elements in the bore of such a gear ([`crate::Bearing::bore_of`]) press its body as well, in the same contact
    /// problem, theory (38b); without it, and where their gear is in no exact mesh, their rings are rigid.
    #[must_use]
    pub fn joined(mut self) -> Self {
        let meshes = (&self.meshes[..], self.train.meshing());
        self.joined = JoinedMeshes::all(meshes, &mut self.elements, &self.compliant_support);
        self
    }

    /// Rollers of a bearing that press the bore of a gear, at the last position; `None` of other bearings.
    pub fn rollers_on_bore(&self, bearing: usize) -> Option<RollersOnBore> {
        let mut bores = self.joined.iter().flat_map(|joined| &joined.bores);
        bores.find(|bore| self.compliant_support[bore.bearing].bearing == bearing)?.rollers()
    }

    /// Forces of an exact mesh on the nodes of both gears where equilibrium was looked for last; `None` of other meshes.
    pub fn flank_forces(&mut self, mesh: usize) -> Option<[FlankForces; 2]> {
        let direction = self.train.meshing().get(mesh)?.direction;
        self.elements[mesh].to_join()?.downcast_mut::<ExactMesh>()?.flank_forces(direction)
    }

    /// Nominal motion of the train.
    pub fn train(&self) -> &Train {
        &self.train
    }

    /// Matrices and parts of the structure.
    pub fn assembly(&self) -> &Assembly {
        &self.assembly
    }

    /// Forces and tangents of the meshes at the last solved position, in their own axes; empty before the first.
    pub fn replies(&self) -> &[MeshForces] {
        &self.replies
    }

    /// What a mesh does to the elastic modes of its gears at displacements of the last position, its own axes; `None` for
    /// elements that keep none.
    ///
    /// # Errors
    /// [`GearboxError`] where the modes find no equilibrium.
    pub(crate) fn modal(&mut self, mesh: usize, at: &Vector12) -> Result<Option<ModalForces>, GearboxError> {
        let Some(element) = self.elements.get_mut(mesh) else { return Ok(None) };
        element.modal(at).map_err(|source| at_mesh(&self.meshes[mesh], source))
    }

    /// Places of the gears of a mesh among the seats' coordinates, and the rotation of its axes.
    pub(crate) fn place(&self, mesh: usize) -> &([usize; 2], SMatrix<f64, 12, 12>) {
        &self.places[mesh]
    }

    /// What holds the seats beside the meshes: forces that shafts, loads and meshes leave over, zero in free coordinates
    /// but for those of rolling elements whose seats do not turn.
    pub(crate) fn reactions(
        &self,
        seats: &DVector<f64>,
        forces: &[Vector12],
        rolling: &[Option<RollingState>],
    ) -> DVector<f64> {
        let mut left = &self.seats.stiffness * seats - &self.load;
        for ((at, _), force) in self.places.iter().zip(forces) {
            left -= spread(left.len(), *at, force);
        }
        self.turned_springs.iter().for_each(|own| left -= own.beside_still(seats));
        for own in &self.compliant_support {
            if let Some((at, of_ends)) = rolling[own.bearing].and_then(|state| own.at_ends(&state, seats)) {
                left -= spread(left.len(), at, &of_ends);
            }
        }
        left
    }
}

/// Checks that loads and held shafts exist, and that loads do not drive.
pub(crate) fn check(structure: &Structure, train: &Train, operation: &Operation) -> Result<(), GearboxError> {
    let count = structure.shafts.len();
    if let Some(&shaft) = operation.held.iter().find(|s| **s >= count) {
        return Err(GearboxError::NoShaft { part: "what is held".into(), shaft, count });
    }
    structure.check_held_seats(&operation.held)?;
    for torque in &operation.torques {
        structure.has_discs("a torque", [torque.disc; 2])?;
        structure.turns_in_space("a torque", torque.disc)?;
        let disc = &structure.discs[torque.disc];
        let (part, value) = (disc.name.clone(), torque.torque);
        if !value.is_finite() {
            return Err(GearboxError::OutOfRange { part, quantity: "torque, N mm", value });
        }
        let speed = train.ratios_in_space()[disc.shaft] * operation.sense.sign() as f64;
        if value * speed > 0.0 {
            return Err(GearboxError::Drives { disc: part, torque_nmm: value });
        }
    }
    Ok(())
}

/// Force of a mesh by the largest torque, N: what bearings are taken to carry where the search begins.
pub(crate) fn guessed_force(meshes: &[GearMesh], operation: &Operation) -> f64 {
    let torque = operation.torques.iter().map(|t| t.torque.abs()).fold(0.0, f64::max);
    let radius = meshes.iter().map(|m| m.pair.wheel.base_radius().abs()).fold(0.0, f64::max);
    // Without a load any force will do.
    if torque > 0.0 && radius > 0.0 { torque / radius } else { 1.0 }
}
