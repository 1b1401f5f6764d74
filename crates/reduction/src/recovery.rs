//! Recovers fields, mass and stress of the gear from the coordinates of a window.

use faer::{Mat, MatRef};
use fem::dense;
use nalgebra::{Rotation3, Vector3};

use crate::{
    GearReducer, ReductionError, Window,
    cyclic::PitchTurn,
    general::{GeneralGear, Seen},
    reducer::Method,
    stress_modes::KnownStress,
    stress_recovery::StressRecovery,
};

impl GearReducer {
    /// Displacement (mm) of every node of the mesh in the gear's own frame, for window coordinates `u` and no other
    /// load: T u = [u_B; Phi_IC u_B].
    ///
    /// # Errors
    /// [`ReductionError::WrongLength`]; [`ReductionError::NotPositiveDefinite`] if the coordinates do not determine
    /// forces, because a grid has more nodes than the mesh can resolve.
    pub fn expand(&self, window: &Window, u: &[f64]) -> Result<Vec<[f64; 3]>, ReductionError> {
        check_length(window, u)?;
        let u = MatRef::from_column_major_slice(u, u.len(), 1);
        let forces = || window.reduced.forces_of(u).ok_or_else(|| singular(window));
        Ok(self.field(window, None, || u.to_owned(), forces)?.pop().unwrap_or_default())
    }

    /// Displacement at several nodes of the mesh, in the given order, for several `forces` (N) at once on the
    /// coordinates of one window. For a cyclic gear only the sectors with these nodes are visited, for any other gear
    /// the branches of the factor with these nodes, and the factor only once. If u = C f, the result is that of
    /// [`GearReducer::expand`], without use of C^-1.
    ///
    /// # Errors
    /// [`ReductionError::WrongLength`]; [`ReductionError::Fem`] if the mesh does not have one of the nodes.
    pub fn expand_under(
        &self,
        window: &Window,
        forces: &[&[f64]],
        nodes: &[u32],
    ) -> Result<Vec<Vec<[f64; 3]>>, ReductionError> {
        forces.iter().try_for_each(|f| check_length(window, f))?;
        let forces = Mat::from_fn(window.reduced.coordinates(), forces.len(), |i, j| forces[j][i]);
        let moved = || dense::product(window.reduced.compliance().as_ref(), forces.as_ref());
        self.field(window, Some(nodes), moved, || Ok(forces.clone()))
    }

    /// At some nodes (`None`: all) for coordinates of the window (mm), or for the forces (N) that hold these,
    /// whichever the method goes by; one column a field.
    fn field(
        &self,
        window: &Window,
        nodes: Option<&[u32]>,
        coordinates: impl Fn() -> Mat<f64>,
        forces: impl Fn() -> Result<Mat<f64>, ReductionError>,
    ) -> Result<Vec<Vec<[f64; 3]>>, ReductionError> {
        if let Some(bolted) = self.bolted()? {
            return bolted.expand(&self.loads(window)?, forces()?.as_ref(), nodes);
        }
        match self.method()? {
            Method::Cyclic(cyclic) => cyclic.expand(forces()?.as_ref(), window.shift, nodes),
            Method::General(general, turn) => {
                let loads = if self.is_last(window) { None } else { Some(self.loads(window)?) };
                let (seen, coordinates, forces) = match &loads {
                    None => (Seen::Last, coordinates(), Mat::new()),
                    Some(loads) => (Seen::Loads(loads), Mat::new(), forces()?),
                };
                let turn = turn.as_ref().filter(|_| window.shift > 0);
                if let (Some(nodes), None) = (nodes, turn) {
                    return general.fields_at((seen, nodes), &coordinates, &forces);
                }
                let fields = general.fields(seen, &coordinates, &forces)?;
                (0..fields.ncols()).map(|j| self.some_of(window, fields.col_as_slice(j), turn, nodes)).collect()
            }
        }
    }

    /// Nodes (`None`: all) of a field of the whole gear on its free degrees of freedom.
    fn some_of(
        &self,
        window: &Window,
        field: &[f64],
        turn: Option<&PitchTurn>,
        nodes: Option<&[u32]>,
    ) -> Result<Vec<[f64; 3]>, ReductionError> {
        let field = self.dofs.to_nodes(field)?;
        let field = match turn {
            Some(turn) => self.turned(window, &field, turn),
            None => field,
        };
        let Some(nodes) = nodes else { return Ok(field) };
        let count = field.len();
        let wrong = |n: u32| fem::FemError::Shape { what: "nodes", expected: count, found: n as usize };
        let at = |&n: &u32| field.get(n as usize).copied().ok_or_else(|| wrong(n));
        Ok(nodes.iter().map(at).collect::<Result<_, _>>()?)
    }

    /// A field of the whole gear, moved on by the window's shift.
    fn turned(&self, window: &Window, field: &[[f64; 3]], turn: &PitchTurn) -> Vec<[f64; 3]> {
        let forward = Rotation3::from_axis_angle(&Vector3::z_axis(), self.frame_angle(window));
        let mut image: Vec<u32> = (0..field.len() as u32).collect();
        for _ in 0..window.shift {
            image.iter_mut().for_each(|n| *n = turn.nodes[*n as usize]);
        }
        let mut turned = vec![[0.0; 3]; field.len()];
        for (&to, u) in image.iter().zip(field) {
            turned[to as usize] = (forward * Vector3::from(*u)).into();
        }
        turned
    }

    /// Coordinates of the window `to`, in its own frame, of the field that has coordinates `u` in the window `from`.
    /// Theory (15).
    ///
    /// ```text
    /// kept teeth:    u_B(to) = u_B(from)
    /// oncoming one:  u_B(to) = rows of Phi_IC of the old window times u_B(from)
    /// ```
    /// # Errors
    /// Those of [`GearReducer::expand`].
    pub fn carry(&self, from: &Window, to: &Window, u: &[f64]) -> Result<Vec<f64>, ReductionError> {
        let (z, loads) = (self.gear().tooth_count(), self.loads(to)?);
        if let Method::Cyclic(cyclic) = self.method()? {
            return cyclic.carry(&self.forces(from, u)?, (to.shift + z - from.shift) % z, &loads);
        }
        let field = self.expand(from, u)?;
        let back = Rotation3::from_axis_angle(&Vector3::z_axis(), -self.frame_angle(to));
        let mut carried = Vec::with_capacity(3 * loads.len());
        for load in &loads {
            let moved = |&(n, w): &(u32, f64)| w * Vector3::from(field[self.material_node(to, n) as usize]);
            let mean: Vector3<f64> = load.iter().map(moved).sum();
            carried.extend_from_slice((back * mean).as_slice());
        }
        Ok(carried)
    }

    /// Columns `columns` of T = [I; Phi_IC] of the first window, one row per free degree of freedom of the mesh.
    ///
    /// # Errors
    /// [`ReductionError::WrongLength`] if a column does not exist; otherwise those of [`GearReducer::expand`].
    pub fn constraint_modes(&self, columns: &[usize]) -> Result<Mat<f64>, ReductionError> {
        let n = self.base.coordinates();
        if let Some(&given) = columns.iter().find(|&&c| c >= n) {
            return Err(ReductionError::WrongLength { given, wanted: n });
        }
        let window = Window { reduced: self.base.clone(), shift: 0 };
        let mut modes = Mat::zeros(self.dofs.free_count(), columns.len());
        for (j, &column) in columns.iter().enumerate() {
            let mut unit = vec![0.0; n];
            unit[column] = 1.0;
            let field = self.expand(&window, &unit)?;
            for (i, &node) in self.dofs.free_nodes().iter().enumerate() {
                (0..3).for_each(|axis| modes[(3 * i + axis, j)] = field[node as usize][axis]);
            }
        }
        Ok(modes)
    }

    /// M^ = T' M T of the first window, t; the same for every window of a cyclic gear.
    ///
    /// # Errors
    /// [`ReductionError::Fem`]; [`ReductionError::NotPositiveDefinite`] as for [`GearReducer::expand`].
    pub fn condensed_mass(&self) -> Result<Mat<f64>, ReductionError> {
        let window = Window { reduced: self.base.clone(), shift: 0 };
        let stiffness = self.stiffness_of(&window)?;
        match self.method()? {
            Method::Cyclic(cyclic) => cyclic.mass(stiffness),
            Method::General(general, _) if self.is_last(&window) => {
                general.mass(Seen::Last, self.gear().mesh(), self.material(), stiffness)
            }
            Method::General(general, _) => {
                general.mass(Seen::Loads(&self.loads(&window)?), self.gear().mesh(), self.material(), stiffness)
            }
        }
    }

    /// Stress at `nodes` (6 rows a node) for unit coordinates of a window or unit forces on them, in the frame of its
    /// matrices, by some recoveries.
    pub(crate) fn stress_of<const N: usize>(
        &self,
        window: &Window,
        nodes: &[u32],
        recoveries: [StressRecovery<'_>; N],
    ) -> [Result<KnownStress, ReductionError>; N] {
        match self.method() {
            Err(e) => recoveries.map(|_| Err(e.clone())),
            Ok(Method::Cyclic(cyclic)) => {
                cyclic.stress(nodes, recoveries).map(|stress| stress.map(KnownStress::Sectors))
            }
            Ok(Method::General(general, _)) => {
                recoveries.map(|recovery| self.stress_of_whole(general, window, nodes, recovery))
            }
        }
    }

    fn stress_of_whole(
        &self,
        general: &GeneralGear,
        window: &Window,
        nodes: &[u32],
        recovery: StressRecovery<'_>,
    ) -> Result<KnownStress, ReductionError> {
        let (mesh, count) = (self.gear().mesh(), window.reduced.coordinates());
        let operator = match recovery {
            StressRecovery::Volume => {
                fem::StressOperator::new(mesh, self.material(), self.elements(), &self.dofs, nodes)?
            }
            StressRecovery::Surface(faces) => {
                fem::StressOperator::on_surface(mesh, self.material(), &self.dofs, faces, nodes)?
            }
        };
        if self.is_last(window) {
            return general.stress(Seen::Last, count, &operator).map(KnownStress::Displacements);
        }
        general.stress(Seen::Loads(&self.loads(window)?), count, &operator).map(KnownStress::Forces)
    }

    fn stiffness_of<'a>(&self, window: &'a Window) -> Result<&'a Mat<f64>, ReductionError> {
        let first = window.reduced.teeth.first().copied().unwrap_or(0);
        window.reduced.stiffness().ok_or(ReductionError::NotPositiveDefinite { first })
    }

    /// Forces that hold a window's coordinates at `u`, N.
    fn forces(&self, window: &Window, u: &[f64]) -> Result<Vec<f64>, ReductionError> {
        check_length(window, u)?;
        window.reduced.forces(u).ok_or_else(|| singular(window))
    }
}

fn singular(window: &Window) -> ReductionError {
    ReductionError::NotPositiveDefinite { first: window.reduced.teeth.first().copied().unwrap_or(0) }
}

fn check_length(window: &Window, u: &[f64]) -> Result<(), ReductionError> {
    let (given, wanted) = (u.len(), window.reduced.coordinates());
    if given == wanted { Ok(()) } else { Err(ReductionError::WrongLength { given, wanted }) }
}
