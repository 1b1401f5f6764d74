//! A mesh at its position between two bodies.

use dynamics::{ElasticDisplacement, Extremes, FlankStates, SideLoads};
use nalgebra::{DMatrix, DVector, Dyn, OMatrix, SMatrix, U12};

use super::{
    MovingMesh,
    lever_mesh::{LEVERS, LeverForces},
    loops,
};
use crate::{GearMesh, GearboxError, MeshForces, Vector12, train::at_mesh};

/// An element, what the coordinates of the motion do to its gears, and its last answer.
pub(super) struct LiveMesh {
    element: Box<dyn MovingMesh>,
    /// D: displacements of both gears in the mesh's own axes by the coordinates z, 12 x n; the turn of the whole train
    /// displaces nothing.
    pub to_gears: OMatrix<f64, U12, Dyn>,
    /// First reduced coordinates of both gears, and the turn from the mesh's axes to the common ones.
    pub gears: [usize; 2],
    pub turn: SMatrix<f64, 12, 12>,
    /// What a turn of the whole train by a radian of the input displaces the gears by, own axes.
    pub by_train: Vector12,
    /// Mesh cycles a radian of the input.
    pub cycles_per_turn: f64,
    /// Levers of a mesh that answers along them; none of others.
    levers: Vec<Lever>,
    /// What it does along them.
    found: LeverForces,
    last: Option<Last>,
}

/// A lever of a mesh, in the coordinates z.
pub(super) struct Lever {
    /// What they move it by, and what a force along it does to them.
    pub row: DVector<f64>,
    /// What an input that balances answers such a force with where it takes energy; none of another.
    pub answer: Option<DVector<f64>>,
}

/// An answer, and what it is to.
struct Last {
    cycles: f64,
    at: ElasticDisplacement,
    reply: MeshForces,
    tangents: bool,
}

impl LiveMesh {
    pub fn new(
        element: Box<dyn MovingMesh>,
        basis: &DMatrix<f64>,
        (gears, rigid): ([usize; 2], &DVector<f64>),
        turn: SMatrix<f64, 12, 12>,
        (cycles_per_turn, balance): (f64, Option<&DVector<f64>>),
    ) -> Self {
        let at_gears = OMatrix::<f64, U12, Dyn>::from_fn(basis.ncols(), |i, j| basis[(gears[i / 6] + i % 6, j)]);
        let by_train = turn.transpose() * Vector12::from_fn(|i, _| rigid[gears[i / 6] + i % 6]);
        let to_gears = turn.transpose() * at_gears;
        let mut element = element;
        let own = element.by_levers().is_some().then(|| element.levers()).flatten();
        let lever = |lever: &Vector12| Lever {
            row: to_gears.tr_mul(lever),
            answer: balance.map(|push| push * -by_train.dot(lever)),
        };
        let levers = own.iter().flatten().take(LEVERS).map(lever).collect();
        Self {
            element,
            to_gears,
            gears,
            turn,
            by_train,
            cycles_per_turn,
            levers,
            found: LeverForces::default(),
            last: None,
        }
    }

    /// What coordinates, or velocities, move the levers by.
    #[inline]
    fn along(&self, z: &DVector<f64>) -> [f64; LEVERS] {
        let mut all = [0.0; LEVERS];
        for (s, lever) in all.iter_mut().zip(&self.levers) {
            *s = loops::along(&lever.row, z);
        }
        all
    }

    /// Moves a mesh with levers to a position; returns false for other meshes.
    #[inline]
    pub fn stand(&mut self, cycles: f64, q: &DVector<f64>) -> bool {
        if self.levers.is_empty() {
            return false;
        }
        let places = self.along(q);
        self.last = None;
        if let Some(own) = self.element.by_levers() {
            own.stand(cycles, &places);
        }
        true
    }

    /// Levers of a mesh with levers, and its forces along them at a position; `None` for other meshes.
    #[inline]
    pub fn answer(
        &mut self,
        cycles: f64,
        [q, v]: [&DVector<f64>; 2],
        energy_rate: bool,
    ) -> Option<(&[Lever], &LeverForces)> {
        if self.levers.is_empty() {
            return None;
        }
        let (places, rates) = (self.along(q), self.along(v));
        self.last = None;
        let own = self.element.by_levers()?;
        own.stand(cycles, &places);
        own.answer(&rates, energy_rate, &mut self.found);
        Some((&self.levers, &self.found))
    }

    /// Forces at a position. The tangent is accurate only if `tangents` is set. Asking again at the same position costs
    /// nothing.
    pub fn reply(
        &mut self,
        mesh: &GearMesh,
        cycles: f64,
        at: &ElasticDisplacement,
        tangents: bool,
    ) -> Result<&MeshForces, GearboxError> {
        let serves = |last: &Last| last.cycles == cycles && last.at == *at && (last.tangents || !tangents);
        if !self.last.as_ref().is_some_and(serves) {
            self.last = None;
        }
        match &mut self.last {
            Some(known) => Ok(&known.reply),
            unknown => {
                let (element, named) = (&mut *self.element, |source| at_mesh(mesh, source));
                element.go_to(cycles).map_err(named)?;
                deform(element, &at.q);
                let answer = if tangents { element.evaluate(&at.d) } else { element.evaluate_forces(&at.d) };
                let reply = answer.map_err(named)?;
                Ok(&unknown.insert(Last { cycles, at: at.clone(), reply, tangents }).reply)
            }
        }
    }

    /// Change of its energy with the mesh cycles at the last position ([`MovingMesh::energy_change`]); its last reply
    /// is discarded.
    pub fn energy_change(&mut self, mesh: &GearMesh) -> Result<f64, GearboxError> {
        self.last = None;
        self.element.energy_change().map_err(|source| at_mesh(mesh, source))
    }

    /// Energy at a position off the path of the motion; its last reply is discarded.
    pub fn energy_at(&mut self, mesh: &GearMesh, cycles: f64, at: &ElasticDisplacement) -> Result<f64, GearboxError> {
        self.last = None;
        deform(&mut *self.element, &at.q);
        self.element.energy_at(cycles, &at.d).map_err(|source| at_mesh(mesh, source))
    }

    /// Returns an error for a position to which its teeth cannot be followed.
    pub fn check_pace(&self, mesh: &GearMesh, cycles: f64) -> Result<(), GearboxError> {
        self.element.check_pace(cycles).map_err(|source| at_mesh(mesh, source))
    }

    /// Ends a step at the last position, with the coordinates moving at `v`: tooth changes are made, and it is checked
    /// that no other contact would add forces.
    pub fn accept(&mut self, mesh: &GearMesh, v: &DVector<f64>, extremes: &mut Extremes) -> Result<(), GearboxError> {
        let moving = || {
            let rates = &self.to_gears * v;
            Vector12::from_fn(|i, _| rates[i])
        };
        if self.element.accept(&moving, extremes).map_err(|source| at_mesh(mesh, source))? {
            self.last = None;
        }
        Ok(())
    }

    /// Positions of the windows of its teeth, if it has windows.
    pub fn windows(&self) -> Option<FlankStates> {
        self.element.windows()
    }

    /// Restores the windows of its teeth.
    pub fn restore(&mut self, windows: &FlankStates) -> Result<(), GearboxError> {
        self.last = None;
        self.element.restore_windows(windows)
    }

    /// Number of its own cycles after which the mesh repeats ([`MovingMesh::period`]).
    pub fn period(&self) -> u64 {
        self.element.period()
    }

    /// Discards its memory of earlier positions.
    pub fn forget(&mut self) {
        self.last = None;
        self.element.forget();
    }

    /// Loads on its flanks at the last position.
    pub fn loads(&self) -> Vec<SideLoads<'_>> {
        self.element.loads()
    }

    /// The element, at its last position.
    pub fn element(&mut self) -> &mut dyn MovingMesh {
        &mut *self.element
    }
}

fn deform(element: &mut dyn MovingMesh, amplitudes: &DVector<f64>) {
    if !amplitudes.is_empty() {
        element.deform(amplitudes);
    }
}
