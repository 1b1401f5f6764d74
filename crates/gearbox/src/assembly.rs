//! Matrices of shafts, discs, bearings and meshes in the coordinates of all nodes. Theory (78), (79), (79a), (79c).

use fem::beam::{BeamLine, BeamTheory, NODE_COORDINATES};
use nalgebra::{ComplexField, DMatrix, DVector, Matrix6};

use crate::{
    Disc, ElasticBody, GearboxError, Structure, Supports,
    shafts_in_shafts::{quarter, rigid},
};

/// A structure divided into beam elements. Each node has six coordinates (displacements x, y, z in mm, rotations about
/// them in rad); nodes are in the order of the shafts.
///
/// Coordinates of a node are those of its cross-section. The exception is a disc with a reach h: there they are those
/// of the disc's mid-plane, which moves with the section as a rigid body.
///
/// ```text
/// u_section = u - turn x (0, 0, h),   turn_section = turn        q_sections = T q
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Assembly {
    structure: Structure,
    lines: Vec<BeamLine>,
    /// First coordinate of each shaft, and the number of all at the end.
    first: Vec<usize>,
    discs: Vec<usize>,
    bearings: Vec<usize>,
    /// Of bearings in other shafts: first coordinate of the seat's node, and what its six coordinates take off the
    /// displacement of the bearing.
    outer: Vec<Option<(usize, Matrix6<f64>)>>,
    /// First coordinates of the nodes whose disc has a reach, and the reach, mm.
    reaches: Vec<(usize, f64)>,
    supports: Supports,
}

impl Assembly {
    /// Checks the structure and divides its shafts into elements, with nodes at all discs and bearings.
    ///
    /// # Errors
    /// [`GearboxError`] if a value is out of range.
    pub fn new(structure: Structure) -> Result<Self, GearboxError> {
        structure.check()?;
        let mut lines = Vec::with_capacity(structure.shafts.len());
        for (i, shaft) in structure.shafts.iter().enumerate() {
            let of_discs = structure.discs.iter().filter(|d| d.shaft == i).map(Disc::seat_position);
            let of_bearings = structure.bearings.iter().filter(|b| b.shaft == i).map(|b| b.position);
            let in_it = structure.bearings.iter().filter(|b| b.outer == Some(i));
            let of_seats = in_it.filter_map(|b| structure.seat(b)).map(|[_, _, z]| z);
            let places: Vec<f64> = of_discs.chain(of_bearings).chain(of_seats).collect();
            if shaft.pieces.is_empty() {
                lines.push(BeamLine::point());
                continue;
            }
            let line = BeamLine::new(&shaft.pieces, &places, shaft.longest_element, BeamTheory::Timoshenko);
            lines.push(line.map_err(|source| GearboxError::Shaft { shaft: shaft.name.clone(), source })?);
        }
        let mut first = vec![0];
        for line in &lines {
            first.push(first[first.len() - 1] + line.stiffness.nrows());
        }
        let node = |shaft: usize, z: f64| first[shaft] + NODE_COORDINATES * lines[shaft].node_at(z);
        let discs: Vec<usize> = structure.discs.iter().map(|d| node(d.shaft, d.seat_position())).collect();
        let bearings: Vec<usize> = structure.bearings.iter().map(|b| node(b.shaft, b.position)).collect();
        let outer: Vec<Option<(usize, Matrix6<f64>)>> = (structure.bearings.iter())
            .map(|b| {
                b.outer.zip(structure.seat(b)).map(|(shaft, seat)| (node(shaft, seat[2]), -moved(seat, &lines[shaft])))
            })
            .collect();
        let seated = structure.bearings.iter().zip(&bearings).map(|(b, node)| (&b.name, *node));
        let in_shafts = structure.bearings.iter().zip(&outer).filter_map(|(b, own)| Some((&b.name, own.as_ref()?.0)));
        let reaches = reaches(&structure, &discs, &seated.chain(in_shafts).collect::<Vec<_>>())?;
        let supports = Supports::new(&structure)?;
        Ok(Self { structure, lines, first, discs, bearings, outer, reaches, supports })
    }

    /// The structure from which the assembly was made.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Number of coordinates: six per node, then six per open seat of the [`Supports`], then the elastic modes of
    /// gears.
    pub fn size(&self) -> usize {
        self.modes_at() + self.structure.bodies.iter().map(ElasticBody::count).sum::<usize>()
    }

    /// Number of coordinates before those of elastic modes.
    fn modes_at(&self) -> usize {
        self.nodes() + 6 * self.supports.open().len()
    }

    /// First coordinate of the modes of every [`ElasticBody`], and the first of its disc.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = (usize, usize, &ElasticBody)> {
        let mut next = self.modes_at();
        self.structure.bodies.iter().map(move |body| {
            let at = next;
            next += body.count();
            (at, self.discs[body.disc], body)
        })
    }

    /// Coordinates of elastic modes.
    pub(crate) fn modes(&self) -> std::ops::Range<usize> {
        self.modes_at()..self.size()
    }

    /// Coordinates that a mesh between two discs has: six of each gear, then the modes of each.
    fn of_mesh(&self, discs: [usize; 2]) -> impl Iterator<Item = usize> {
        let of_disc = discs.into_iter().flat_map(|disc| self.discs[disc]..self.discs[disc] + 6);
        of_disc.chain(self.modes_of_mesh(discs))
    }

    fn modes_of_mesh(&self, discs: [usize; 2]) -> impl Iterator<Item = usize> {
        let of = move |disc: usize| self.bodies().filter(move |(_, _, body)| body.disc == disc);
        discs.into_iter().flat_map(of).flat_map(|(at, _, body)| at..at + body.count())
    }

    /// Number of coordinates of nodes.
    fn nodes(&self) -> usize {
        self.first[self.lines.len()]
    }

    /// Index of the first of the six coordinates of a disc.
    pub fn disc(&self, disc: usize) -> Option<usize> {
        self.discs.get(disc).copied()
    }

    /// Bearings and housing.
    pub fn supports(&self) -> &Supports {
        &self.supports
    }

    /// First coordinate and elements of each shaft.
    pub(crate) fn lines(&self) -> impl Iterator<Item = (usize, &BeamLine)> {
        self.first.iter().copied().zip(&self.lines)
    }

    /// Displacements T q of the cross-sections at all nodes.
    pub fn of_sections(&self, q: &DVector<f64>) -> DVector<f64> {
        let mut own = q.clone();
        for &(at, reach) in &self.reaches {
            own[at] -= reach * q[at + 4];
            own[at + 1] += reach * q[at + 3];
        }
        own
    }

    /// T' m T, from cross-sections to coordinates; in place.
    fn to_coordinates(&self, m: &mut DMatrix<f64>) {
        for &(at, reach) in &self.reaches {
            for (turn, shift, arm) in [(at + 4, at, -reach), (at + 3, at + 1, reach)] {
                for i in 0..m.nrows() {
                    m[(i, turn)] += arm * m[(i, shift)];
                }
                for j in 0..m.ncols() {
                    m[(turn, j)] += arm * m[(shift, j)];
                }
            }
        }
    }

    /// Displacements at the bearings out of those of all nodes, six a bearing, and those of open seats.
    pub(crate) fn at_bearings(&self, q: &DVector<f64>) -> DVector<f64> {
        let of = |i: usize| self.of_support(i).map(|(at, share)| share * q[at]).sum();
        DVector::from_fn(self.supports.stiffness.nrows(), |i, _| of(i))
    }

    /// What a coordinate of the supports is made of: indices among all coordinates, and the share of each.
    fn of_support(&self, i: usize) -> impl Iterator<Item = (usize, f64)> {
        let shafts = 6 * self.bearings.len();
        let open = (i >= shafts).then(|| (self.nodes() + i - shafts, 1.0));
        let ends = (i < shafts).then(|| self.bearing_ends(i / 6)).into_iter().flatten();
        let shares = ends.flat_map(move |(node, own)| (0..6).map(move |k| (node + k, own[(i % 6, k)])));
        shares.filter(|(_, share)| *share != 0.0).chain(open)
    }

    /// What moves a bearing: first coordinates of nodes, and what their six add to the displacement of its shaft against its
    /// seat; its own shaft first.
    pub(crate) fn bearing_ends(&self, bearing: usize) -> impl Iterator<Item = (usize, &Matrix6<f64>)> {
        let outer = self.outer[bearing].as_ref().map(|(node, own)| (*node, own));
        [(self.bearings[bearing], &ITSELF)].into_iter().chain(outer)
    }

    /// First coordinate of a bearing's open seat.
    pub(crate) fn open_seat(&self, bearing: usize) -> Option<usize> {
        let at = self.supports.open().iter().position(|b| *b == bearing)?;
        Some(self.nodes() + 6 * at)
    }

    /// Forces of preloaded bearings on all coordinates with nothing displaced, N, N mm.
    pub(crate) fn preload(&self) -> DVector<f64> {
        let mut all = DVector::zeros(self.size());
        for (i, force) in self.supports.preload.iter().enumerate() {
            self.of_support(i).for_each(|(at, share)| all[at] += share * force);
        }
        all
    }

    /// Compression of a mesh spring, mm.
    pub(crate) fn compression(&self, spring: usize, q: &DVector<f64>) -> f64 {
        let spring = &self.structure.springs[spring];
        let of = |g: usize| q.fixed_rows::<6>(self.discs[spring.discs[g]]).dot(&spring.levers[g]);
        of(0) + of(1)
    }

    /// Stiffness of shafts, bearings, housing and mesh springs: N/mm, N, N mm.
    pub fn stiffness(&self) -> DMatrix<f64> {
        let mut k = self.stiffness_without_meshes();
        self.add_meshes(&mut k);
        k
    }

    /// What holds the shafts: bearings and housing, and meshes where they count; the shafts' own stiffness left out.
    pub(crate) fn holding(&self, with_meshes: bool) -> DMatrix<f64> {
        let mut k = DMatrix::zeros(self.size(), self.size());
        self.add_supports(&mut k, &self.supports.stiffness);
        if with_meshes {
            self.add_meshes(&mut k);
        }
        k
    }

    fn add_meshes(&self, k: &mut DMatrix<f64>) {
        for spring in &self.structure.springs {
            let mut lever = DVector::zeros(self.size());
            for (disc, own) in spring.discs.iter().zip(&spring.levers) {
                let mut rows = lever.fixed_rows_mut::<6>(self.discs[*disc]);
                rows += own;
            }
            k.ger(spring.stiffness, &lever, &lever, 1.0);
        }
        for mesh in &self.structure.elastic_meshes {
            let at: Vec<usize> = self.of_mesh(mesh.discs).collect();
            for (i, j) in (0..at.len()).flat_map(|i| (0..at.len()).map(move |j| (i, j))) {
                k[(at[i], at[j])] += 0.5 * (mesh.stiffness[(i, j)] + mesh.stiffness[(j, i)]);
            }
        }
    }

    /// Displacements of both gears of a mesh, and the amplitudes of their modes, out of those of all coordinates.
    pub(crate) fn at_mesh<T: ComplexField + Copy>(&self, discs: [usize; 2], q: &DVector<T>) -> DVector<T> {
        let own: Vec<T> = self.of_mesh(discs).map(|at| q[at]).collect();
        DVector::from_vec(own)
    }

    /// Adds forces on both gears of a mesh, and on their modes.
    pub(crate) fn add_at_mesh<T: ComplexField + Copy>(
        &self,
        discs: [usize; 2],
        own: &DVector<T>,
        all: &mut DVector<T>,
    ) {
        self.of_mesh(discs).zip(own.iter()).for_each(|(at, force)| all[at] += *force);
    }

    /// Stiffness of shafts, gear bodies, bearings and housing: N/mm, N, N mm.
    pub(crate) fn stiffness_without_meshes(&self) -> DMatrix<f64> {
        let mut k = self.of_shafts(|line| &line.stiffness);
        self.to_coordinates(&mut k);
        self.add_supports(&mut k, &self.supports.stiffness);
        for (at, _, body) in self.bodies() {
            body.squares.iter().enumerate().for_each(|(i, square)| k[(at + i, at + i)] += square);
        }
        k
    }

    /// Takes a shaft that does not move out of a stiffness: its seats, among the `kept` coordinates, and its other nodes
    /// meet nothing.
    pub(crate) fn hold(&self, shaft: usize, k: &mut DMatrix<f64>, kept: &[usize]) {
        for i in self.first[shaft]..self.first[shaft + 1] {
            k.row_mut(i).fill(0.0);
            k.column_mut(i).fill(0.0);
            if !kept.contains(&i) {
                k[(i, i)] = 1.0;
            }
        }
    }

    /// Positions of the nodes of a shaft, mm, and the first coordinate of the first of them.
    pub(crate) fn line(&self, shaft: usize) -> (usize, &BeamLine) {
        (self.first[shaft], &self.lines[shaft])
    }

    /// Height at which each node's coordinates are on a shaft, mm from its z = 0: that of its cross-section, or of the
    /// disc's middle where that has a reach.
    pub(crate) fn heights(&self, shaft: usize) -> Vec<f64> {
        let (first, line) = self.line(shaft);
        let reach = |at: usize| self.reaches.iter().find(|(node, _)| *node == at).map_or(0.0, |(_, reach)| *reach);
        line.positions().iter().enumerate().map(|(i, z)| z + reach(first + NODE_COORDINATES * i)).collect()
    }

    /// First coordinate of a bearing's node.
    pub(crate) fn bearing(&self, bearing: usize) -> usize {
        self.bearings[bearing]
    }

    /// Consistent mass of the shafts plus the mass of discs and machines: t, t mm, t mm^2.
    pub fn mass(&self) -> DMatrix<f64> {
        let mut m = self.of_shafts(|line| &line.mass);
        self.to_coordinates(&mut m);
        for (disc, &at) in self.structure.discs.iter().zip(&self.discs) {
            disc.inertia().into_iter().enumerate().for_each(|(axis, value)| m[(at + axis, at + axis)] += value);
        }
        for machine in &self.structure.machines {
            let at = self.discs[machine.disc] + 5;
            m[(at, at)] += machine.inertia;
        }
        for (at, disc, body) in self.bodies() {
            for i in 0..body.count() {
                m[(at + i, at + i)] += 1.0;
                for axis in 0..6 {
                    m[(at + i, disc + axis)] += body.coupling[(i, axis)];
                    m[(disc + axis, at + i)] += body.coupling[(i, axis)];
                }
            }
        }
        m
    }

    /// Damping of the bearings: N s/mm, N s, N mm s.
    pub fn damping(&self) -> DMatrix<f64> {
        let mut c = DMatrix::zeros(self.size(), self.size());
        self.add_supports(&mut c, &self.supports.damping);
        c
    }

    /// Gyroscopic matrix of shafts and discs that spin at `speeds` (rad/s about +z, one per shaft), t mm^2/s;
    /// skew-symmetric.
    ///
    /// # Errors
    /// [`GearboxError::Count`] for another number of speeds, [`GearboxError::OutOfRange`] if a speed is not a finite
    /// number.
    pub fn gyroscopic(&self, speeds: &[f64]) -> Result<DMatrix<f64>, GearboxError> {
        let wanted = self.lines.len();
        if speeds.len() != wanted {
            return Err(GearboxError::Count { what: "speeds of shafts", found: speeds.len(), wanted });
        }
        if let Some((shaft, &value)) = self.structure.shafts.iter().zip(speeds).find(|(_, s)| !s.is_finite()) {
            return Err(GearboxError::OutOfRange { part: shaft.name.clone(), quantity: "speed, rad/s", value });
        }
        let mut g = DMatrix::zeros(self.size(), self.size());
        for ((at, line), speed) in self.lines().zip(speeds) {
            let n = line.gyroscopic.nrows();
            g.view_mut((at, at), (n, n)).copy_from(&(*speed * &line.gyroscopic));
        }
        self.to_coordinates(&mut g);
        for (disc, &at) in self.structure.discs.iter().zip(&self.discs) {
            let momentum = disc.polar_inertia * speeds[disc.shaft];
            g[(at + 3, at + 4)] += momentum;
            g[(at + 4, at + 3)] -= momentum;
        }
        for (at, disc, body) in self.bodies() {
            let speed = speeds[self.structure.discs[body.disc].shaft];
            for i in 0..body.count() {
                for j in 0..body.count() {
                    g[(at + i, at + j)] += speed * body.gyroscopic[(i, j)];
                }
                for axis in 0..6 {
                    g[(disc + axis, at + i)] += speed * body.rigid_gyroscopic[(axis, i)];
                    g[(at + i, disc + axis)] -= speed * body.rigid_gyroscopic[(axis, i)];
                }
            }
        }
        Ok(g)
    }

    /// Damping of the bearings that are seated in no shaft.
    pub(crate) fn damping_in_space(&self) -> DMatrix<f64> {
        let mut own = self.supports.damping.clone();
        for (i, _) in self.structure.bearings.iter().enumerate().filter(|(_, bearing)| bearing.outer.is_some()) {
            own.rows_mut(6 * i, 6).fill(0.0);
            own.columns_mut(6 * i, 6).fill(0.0);
        }
        let mut c = DMatrix::zeros(self.size(), self.size());
        self.add_supports(&mut c, &own);
        c
    }

    /// J: all coordinates turned by a right angle about z, per rad of a turn of their axes. Theory (86b).
    pub(crate) fn quarter_turn(&self) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(self.size(), self.size());
        for at in (0..self.modes_at()).step_by(6) {
            all.fixed_view_mut::<6, 6>(at, at).copy_from(&quarter());
        }
        for (at, _, body) in self.bodies() {
            // Patterns count from axes that turn: the gear's frame falls back.
            all.view_mut((at, at), body.turning.shape()).copy_from(&-&body.turning);
        }
        all
    }

    /// First coordinates of the nodes of discs and bearings, each once and ascending, and their shafts.
    pub(crate) fn seat_nodes(&self) -> Vec<(usize, usize)> {
        let structure = &self.structure;
        let discs = structure.discs.iter().zip(&self.discs).map(|(d, at)| (*at, d.shaft));
        let ends = |(i, b): (usize, &crate::Bearing)| {
            let shafts = [Some(b.shaft), b.outer].into_iter().flatten();
            self.bearing_ends(i).map(|(node, _)| node).zip(shafts).collect::<Vec<_>>()
        };
        let bearings = structure.bearings.iter().enumerate().flat_map(ends);
        let mut all: Vec<(usize, usize)> = discs.chain(bearings).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Displacements of all coordinates a rad of the input with the whole train turned; `ratios` of all shafts and of the frame in
    /// space.
    pub(crate) fn turned(&self, (ratios, frame): (&[f64], f64)) -> DVector<f64> {
        let places = self.places_of_axes();
        let mut all = DVector::zeros(self.size());
        for ((at, line), ratio) in self.lines().zip(ratios) {
            for node in (0..line.positions().len()).map(|i| at + 6 * i) {
                (all[node], all[node + 1], all[node + 5]) = (-frame * places[node + 1], frame * places[node], *ratio);
            }
        }
        all
    }

    /// Place of every node's axis from the axis of the frame, as displacements of all coordinates, mm. Theory (86b).
    pub(crate) fn places_of_axes(&self) -> DVector<f64> {
        let mut all = DVector::zeros(self.size());
        let Some(axis) = self.structure.fixed.map(|shaft| self.structure.shafts[shaft].origin) else { return all };
        for (shaft, (at, line)) in self.structure.shafts.iter().zip(self.lines()) {
            for i in 0..line.positions().len() {
                (0..2).for_each(|k| all[at + 6 * i + k] = shaft.origin[k] - axis[k]);
            }
        }
        all
    }

    fn of_shafts(&self, matrix: impl Fn(&BeamLine) -> &DMatrix<f64>) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(self.size(), self.size());
        for (at, line) in self.lines() {
            let own = matrix(line);
            all.view_mut((at, at), (own.nrows(), own.ncols())).copy_from(own);
        }
        all
    }

    fn add_supports(&self, all: &mut DMatrix<f64>, own: &DMatrix<f64>) {
        let shares: Vec<Vec<(usize, f64)>> = (0..own.nrows()).map(|i| self.of_support(i).collect()).collect();
        for (i, rows) in shares.iter().enumerate() {
            for (j, columns) in shares.iter().enumerate() {
                for ((a, left), (b, right)) in rows.iter().flat_map(|x| columns.iter().map(move |y| (x, y))) {
                    all[(*a, *b)] += left * right * own[(i, j)];
                }
            }
        }
    }
}

/// The displacement of a shaft at its own node.
const ITSELF: Matrix6<f64> = Matrix6::new(
    1.0, 0.0, 0.0, 0.0, 0.0, 0.0, //
    0.0, 1.0, 0.0, 0.0, 0.0, 0.0, //
    0.0, 0.0, 1.0, 0.0, 0.0, 0.0, //
    0.0, 0.0, 0.0, 1.0, 0.0, 0.0, //
    0.0, 0.0, 0.0, 0.0, 1.0, 0.0, //
    0.0, 0.0, 0.0, 0.0, 0.0, 1.0,
);

/// Displacements and turns at a place of a shaft's body (mm from its origin) by those of the node of its height; a rigid
/// body has one node alone, at its z = 0.
fn moved([x, y, z]: [f64; 3], line: &BeamLine) -> Matrix6<f64> {
    rigid([x, y, if line.positions().len() > 1 { 0.0 } else { z }])
}

/// Reach of the disc at each node that has one. Nothing else may be there: it would have to know which coordinates
/// those of the node are.
fn reaches(
    structure: &Structure,
    discs: &[usize],
    bearings: &[(&String, usize)],
) -> Result<Vec<(usize, f64)>, GearboxError> {
    let with_reach = structure.discs.iter().enumerate().filter(|(_, d)| d.reach != 0.0);
    let one = |(i, disc): (usize, &Disc)| {
        let other_disc = structure.discs.iter().zip(discs).enumerate().find(|(j, (_, n))| *j != i && **n == discs[i]);
        let other_bearing = bearings.iter().find(|(_, node)| *node == discs[i]);
        match other_disc.map(|(_, (d, _))| &d.name).or(other_bearing.map(|(name, _)| *name)) {
            Some(other) => Err(GearboxError::SharedSeat { disc: disc.name.clone(), other: other.clone() }),
            None => Ok((discs[i], disc.reach)),
        }
    };
    with_reach.map(one).collect()
}
