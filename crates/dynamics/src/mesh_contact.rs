//! Contact of two gears that stand where they are told: forces and their tangent. Theory (38).

use contact::{
    Balance, ContactError, ContactRow, DenseProblem, DenseSolver, FlankPair, LocalLaw, LocalState, Pose, Slice,
    SliceHint, SlicePlace, TablePlace, TableWork, Vec3,
};
use faer::MatRef;
use geometry::GearPair;

use crate::{
    ContactSet, StaticError, StaticOptions, Wrench,
    friction::Friction,
    loads::wrenches,
    modal_flanks::{ModalFlanks, ModalRows},
};

/// Forces of the mesh on both gears at given poses, and how they change as the gears move.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshForce {
    /// Force (N) and moment (N mm, about the gear's own centre) on pinion and wheel, common axes.
    pub wrench: [Wrench; 2],
    /// df/dq: f forces and moments, q displacements (mm) and small turns (rad) about the gears' centres, common axes, in the order
    /// pinion x y z, turns about x y z, wheel the same. N/mm, N, N mm.
    ///
    /// ```text
    /// df/dq = -J_t' (S + diag delta')^-1 J      on the active rows
    /// ```
    /// Exact for contact places that stay where they are on the flanks; that they wander changes it by about a thousandth of its largest entries.
    /// Symmetric and negative semi-definite without friction.
    pub tangent: [[f64; 12]; 12],
    /// Normal force of each pair of the window, N, in order of running numbers.
    pub pair_forces: Vec<f64>,
    /// Elastic energy of both gears and the contact, N mm.
    pub strain_energy: f64,
    /// Newton steps.
    pub iterations: usize,
    /// Largest violation of g >= 0, F >= 0, F g = 0 relative to the largest approach.
    pub residual: f64,
}

/// What one evaluation passes over and does; see [`MeshContact::work`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactWork {
    /// Data that it passes over at least once, bytes.
    pub bytes: f64,
    /// Floating-point operations of its linear algebra: those of the search and of the local compliance, a few hundred a slice, are left out.
    pub flops: f64,
}

/// The slice contact of a window: search, compliance and solution, in memory that is used again.
///
/// Poses are those of the frames that the window's matrices are in ([`crate::Equilibrium::poses`]). Slices start from where they were found before, and
/// forces from what they were; neither changes the answer but by round-off.
#[derive(Debug)]
pub struct MeshContact {
    set: ContactSet,
    friction: Option<Friction>,
    /// Of the larger gear's tip, mm.
    radius: f64,
    pairs: Vec<(usize, usize)>,
    hints: Vec<SliceHint>,
    /// How body 1 stood at the last search.
    stood: Option<Pose>,
    /// Force of each station of each pair at the last solution, N.
    memory: Vec<f64>,
    places: Vec<(usize, SlicePlace)>,
    /// What was found at the last poses, and at others before these.
    found: Found,
    before: Found,
    gaps: Vec<f64>,
    levers: Vec<f64>,
    torque_levers: Vec<f64>,
    /// Where the rows' openings stand in the table of a gear, and their loads where friction makes these another thing.
    openings: Vec<TablePlace>,
    loads: Vec<TablePlace>,
    work: [TableWork; 2],
    solver: DenseSolver,
    force: MeshForce,
    /// Normal modes that are coordinates of their own.
    modal: Option<ModalFlanks>,
}

/// Rows and their compliance at some poses.
#[derive(Debug, Default)]
struct Found {
    /// The poses, once there are rows of them.
    at: Option<[Pose; 2]>,
    /// Station of each row, counted over all pairs.
    keys: Vec<usize>,
    rows: Vec<ContactRow>,
    slices: Vec<Slice>,
    laws: Vec<LocalLaw>,
    /// Gaps at these poses, mm; those of the rows follow small motions from there.
    gaps: Vec<f64>,
    compliance: Vec<f64>,
    /// How modes open the rows.
    modal: ModalRows,
}

/// Displacement of a point of contact, mm, up to which what was found serves: the gap's second order, curvature times its square over two, is a ten-thousandth of a
/// um then.
const NEAR: f64 = 1e-3;

impl Found {
    fn with_capacity(most: usize) -> Self {
        Self {
            at: None,
            keys: Vec::with_capacity(most),
            rows: Vec::with_capacity(most),
            slices: Vec::with_capacity(most),
            laws: Vec::with_capacity(most),
            gaps: Vec::with_capacity(most),
            compliance: Vec::with_capacity(most * most),
            modal: ModalRows::default(),
        }
    }

    /// Displacements (mm) and small turns (rad) of both gears from here to `poses`, if they are small, and modes open gaps by no more than was reckoned with.
    fn motion_to(&self, poses: &[Pose; 2], radius: f64, modal: Option<&ModalFlanks>) -> Option<[f64; 12]> {
        let at = self.at.as_ref().filter(|_| modal.is_none_or(|modal| modal.largest() <= self.modal.largest))?;
        let mut motion = [0.0; 12];
        for g in 0..2 {
            let moved = poses[g].translation.vector - at[g].translation.vector;
            let turned = (poses[g].rotation * at[g].rotation.inverse()).scaled_axis();
            motion[6 * g..6 * g + 3].copy_from_slice(moved.as_slice());
            motion[6 * g + 3..6 * g + 6].copy_from_slice(turned.as_slice());
            let way = moved.norm() + radius * turned.norm();
            if way > NEAR || way.is_nan() {
                return None;
            }
        }
        Some(motion)
    }

    /// Gaps after a small motion from here.
    fn follow(&mut self, motion: &[f64; 12]) {
        let Self { at, rows, gaps, .. } = self;
        let Some(at) = at else { return };
        let centres = at.map(|p| p.translation.vector);
        for (row, &gap) in rows.iter_mut().zip(gaps.iter()) {
            let opening: f64 = opening(row, &row.normal, &centres).iter().zip(motion).map(|(j, d)| j * d).sum();
            row.gap = gap + opening;
        }
    }
}

/// How displacements and small turns of both gears about their `centres` move a row's point along `direction`: of its normal, how they open its gap.
fn opening(row: &ContactRow, direction: &Vec3, centres: &[Vec3; 2]) -> [f64; 12] {
    let mut j = [0.0; 12];
    for (body, sign) in [1.0, -1.0].into_iter().enumerate() {
        let force = sign * direction;
        let moment = (row.position - centres[body]).cross(&force);
        j[6 * body..6 * body + 3].copy_from_slice(force.as_slice());
        j[6 * body + 3..6 * body + 6].copy_from_slice(moment.as_slice());
    }
    j
}

impl MeshContact {
    /// The contact of a window of slices on reduced gears.
    ///
    /// # Errors
    /// [`StaticError::OutOfRange`] for points ([`crate::Method::Nodal`]) or gears with all their degrees of freedom.
    pub fn new(pair: &GearPair, set: ContactSet, options: &StaticOptions) -> Result<Self, StaticError> {
        let (Some(slices), Some(_)) = (set.slices(), set.windows()) else {
            let expected = "slice contact on reduced gears";
            return Err(StaticError::OutOfRange { name: "contact of given poses", value: 0.0, expected });
        };
        let pairs = set.pairs();
        let most = pairs.len() * slices.stations().len();
        let work = slices.bulk().map(|b| [0, 1].map(|i| TableWork::new(&b[i], most))).unwrap_or_default();
        let friction = Friction::new(pair, options);
        let force = MeshForce {
            wrench: Default::default(),
            tangent: [[0.0; 12]; 12],
            pair_forces: vec![0.0; pairs.len()],
            strain_energy: 0.0,
            iterations: 0,
            residual: 0.0,
        };
        let radius = pair.pinion.tip_radius().max(pair.wheel.tip_radius());
        Ok(Self {
            friction,
            radius,
            hints: vec![SliceHint::default(); most],
            stood: None,
            memory: vec![0.0; most],
            places: Vec::with_capacity(most),
            found: Found::with_capacity(most),
            before: Found::with_capacity(most),
            gaps: Vec::with_capacity(most),
            levers: Vec::with_capacity(most),
            torque_levers: Vec::with_capacity(most),
            openings: Vec::with_capacity(most),
            loads: Vec::with_capacity(if friction.is_some() { most } else { 0 }),
            work,
            solver: DenseSolver::new(most),
            force,
            modal: None,
            pairs,
            set,
        })
    }

    /// Flanks and matrices of the window.
    pub fn contact_set(&self) -> &ContactSet {
        &self.set
    }

    /// Goes over to another window with the same flanks; forces are forgotten, they belong to other pairs there.
    pub(crate) fn enter(&mut self, set: ContactSet) {
        self.memory.fill(0.0);
        self.hints.fill(SliceHint::default());
        self.stood = None;
        (self.found.at, self.before.at) = (None, None);
        if let Some(tables) = set.slices().and_then(|s| s.bulk()) {
            self.work.iter_mut().zip(tables).for_each(|(work, table)| work.enter(table));
        }
        self.set = set;
    }

    /// Takes normal modes of both gears on the flanks of this window out of the compliance; they then deform the gears by the amplitudes given.
    pub(crate) fn keep_modes(&mut self, modal: ModalFlanks) {
        (self.found.at, self.before.at) = (None, None);
        self.modal = Some(modal);
    }

    /// Sets the amplitudes of the modes, of pinion and wheel in turn.
    pub(crate) fn deform(&mut self, amplitudes: &[f64]) {
        if let Some(modal) = &mut self.modal {
            modal.deform(amplitudes);
        }
    }

    /// The modes, and forces on them at the last evaluation.
    pub(crate) fn modal(&self) -> Option<&ModalFlanks> {
        self.modal.as_ref()
    }

    /// Forgets the forces of the last solution.
    pub fn forget(&mut self) {
        self.memory.fill(0.0);
    }

    /// Forces with the gears' frames at `poses`.
    ///
    /// # Errors
    /// [`ContactError`] when the contact problem cannot be solved.
    pub fn evaluate(&mut self, poses: &[Pose; 2]) -> Result<&MeshForce, ContactError> {
        self.prepare(poses, None);
        self.forces()
    }

    /// As [`MeshContact::evaluate`], for poses that come in steps and small changes of these: rows that were found for poses next to them, up to a um away, are kept
    /// with their places and compliance, and their gaps follow the motion to first order.
    ///
    /// Forces are then the exact derivative of the strain energy, and the tangent that of the forces.
    ///
    /// # Errors
    /// [`ContactError`] when the contact problem cannot be solved.
    pub fn evaluate_near(&mut self, poses: &[Pose; 2]) -> Result<&MeshForce, ContactError> {
        let motions = [&self.found, &self.before].map(|f| f.motion_to(poses, self.radius, self.modal.as_ref()));
        let motion = match motions {
            [Some(motion), _] => Some(motion),
            [None, other] => {
                std::mem::swap(&mut self.found, &mut self.before);
                other
            }
        };
        match motion {
            Some(motion) => {
                self.found.follow(&motion);
                self.bend();
            }
            None => {
                self.find_places(poses);
                let reach = self.reach();
                self.rows_within(poses, reach + 2.0 * NEAR);
            }
        }
        self.forces()
    }

    /// Forces of the rows as they are.
    fn forces(&mut self) -> Result<&MeshForce, ContactError> {
        self.solve(Balance::Held, 0)?;
        let Self { force, found: Found { rows, at, modal: bent, .. }, gaps, solver, set, modal, .. } = self;
        let poses = at.unwrap_or([Pose::identity(); 2]);
        force.wrench = wrenches(&poses, rows, solver.forces());
        let centres = poses.map(|p| p.translation.vector);
        let rigid = |i: usize| {
            let row = &rows[i];
            [row.normal, row.traction].map(|direction| opening(row, &direction, &centres))
        };
        match modal {
            None => force.tangent = solver.tangent(rigid),
            Some(modal) => {
                modal.finish(bent, solver, rigid);
                let (all, n) = (&modal.forces().tangent, 12 + modal.count());
                force.tangent = std::array::from_fn(|i| std::array::from_fn(|j| all[i * n + j]));
            }
        }
        force.pair_forces.fill(0.0);
        for (row, f) in rows.iter().zip(solver.forces()) {
            force.pair_forces[set.pair_of(row.patches.0)] += f;
        }
        // By the dual functional -g F - U*(F), stationary at the solution: what forces are off by shows in its square only.
        let of_row = |((f, o), g): ((&f64, &f64), &f64)| if *f > 0.0 { -f * (g + 0.5 * o) } else { 0.0 };
        let dual = solver.forces().iter().zip(solver.openings()).zip(gaps.iter()).map(of_row).sum::<f64>();
        force.strain_energy = dual + solver.curved_energy();
        (force.iterations, force.residual) = (solver.iterations(), solver.residual());
        Ok(&self.force)
    }

    /// Forces of the last evaluation.
    pub fn force(&self) -> &MeshForce {
        &self.force
    }

    /// Deepest overlap of the flanks with the gears' frames at `poses`, mm; negative where they are apart. Undeformed but for the kept modes, and with these it is
    /// the last evaluation that is lost.
    pub fn overlap(&mut self, poses: &[Pose; 2]) -> f64 {
        if self.modal.is_some() {
            self.prepare(poses, None);
            return self.gaps.iter().fold(f64::MIN, |m, g| m.max(-g));
        }
        self.find_places(poses);
        self.deepest()
    }

    /// Deepest overlap at the places found, mm.
    fn deepest(&self) -> f64 {
        self.places.iter().fold(f64::MIN, |m, (_, p)| m.max(-p.gap()))
    }

    /// Gap up to which a row at the places found may close, mm: the deepest overlap; modes may close a gap, and open the one that would be the deepest overlap.
    fn reach(&self) -> f64 {
        let deepest = self.deepest();
        self.modal.as_ref().map_or(deepest, |modal| deepest.abs() + 2.0 * (modal.largest() + NEAR))
    }

    /// Gaps of the rows as they are, with what the modes open them by.
    fn bend(&mut self) {
        let Self { found: Found { rows, modal: bent, .. }, modal, gaps, .. } = self;
        if let Some(modal) = modal {
            rows.iter_mut().enumerate().for_each(|(i, row)| row.gap += modal.shift(bent, i));
        }
        gaps.clear();
        gaps.extend(rows.iter().map(|r| r.gap));
    }

    /// Where the flanks are nearest, station by station.
    fn find_places(&mut self, poses: &[Pose; 2]) {
        let Self { set, pairs, hints, places, stood, .. } = self;
        places.clear();
        let Some(of_window) = set.slices() else { return };
        let patches = [&set.patches()[0][..], &set.patches()[1][..]];
        let stations = of_window.stations();
        let turned = stood.replace(poses[0]).map_or(0.0, |before| turn(&before, &poses[0]));
        for (p, &numbers) in pairs.iter().enumerate() {
            let pair = FlankPair::new(of_window.flanks(patches, numbers), poses);
            let side = set.side(numbers.0).sign();
            for (i, &z) in stations.iter().enumerate() {
                let key = p * stations.len() + i;
                hints[key].turn(side, turned);
                if let Some(place) = pair.place(z, &mut hints[key]) {
                    places.push((key, place));
                }
            }
        }
    }

    /// Rows and their compliance with the gears' frames at `poses`: gaps up to `reach` (mm), or as far as the flanks overlap.
    ///
    /// When nothing turns, no row is approached by more than the deepest overlap: loads on other teeth close a gap by some per cent of it at most, so rows that gape by
    /// more stay open.
    pub(crate) fn prepare(&mut self, poses: &[Pose; 2], reach: Option<f64>) {
        self.find_places(poses);
        let reach = reach.unwrap_or_else(|| self.reach());
        self.rows_within(poses, reach);
    }

    /// Rows of the places found that are no farther apart than `reach`, mm, and their compliance.
    fn rows_within(&mut self, poses: &[Pose; 2], reach: f64) {
        let Self { set, pairs, hints, places, found, friction, .. } = self;
        let Found { at, keys, rows, slices, .. } = found;
        *at = Some(*poses);
        keys.clear();
        rows.clear();
        slices.clear();
        let Some(of_window) = set.slices() else { return };
        let patches = [&set.patches()[0][..], &set.patches()[1][..]];
        let stations = of_window.stations();
        let tabulated = of_window.bulk().is_some();
        let pair_at = |pair| FlankPair::new(of_window.flanks(patches, pair), poses);
        for of_pair in places.chunk_by(|a, b| a.0 / stations.len() == b.0 / stations.len()) {
            let numbers = pairs[of_pair[0].0 / stations.len()];
            let pair = pair_at(numbers);
            for (key, place) in of_pair.iter().filter(|(_, place)| place.gap() <= reach) {
                let point = key % stations.len();
                let made = pair.slice(place, numbers, point, of_window.length());
                let Some((mut row, slice)) = made.filter(|(row, s)| row.gap <= reach && of_window.may_touch(s)) else {
                    continue;
                };
                // Tables do not ask which nodes a row rests on.
                if !tabulated && !pair.support(&mut row, &slice, &mut hints[*key]) {
                    continue;
                }
                keys.push(*key);
                rows.push(friction.map_or(row, |f| f.on(poses, row)));
                slices.push(slice);
            }
        }
        found.laws.clear();
        found.laws.extend(found.slices.iter().map(|s| s.local.law()));
        found.gaps.clear();
        found.gaps.extend(found.rows.iter().map(|r| r.gap));
        self.compliance();
        self.bend();
    }

    /// S between the rows, from both gears' tables or matrices.
    fn compliance(&mut self) {
        let Self { set, found, openings, loads, work, friction, modal, .. } = self;
        let Found { rows, slices, compliance, modal: bent, .. } = found;
        let n = rows.len();
        let symmetric = friction.is_none();
        if let Some(modal) = modal {
            modal.begin(bent, n, !symmetric, NEAR);
        }
        let Some(tables) = set.slices().and_then(|s| s.bulk()) else {
            set.exact_compliance(rows, compliance);
            if let Some(modal) = modal {
                modal.read_rows(bent, rows);
                modal.take_from(bent, n, compliance);
            }
            return;
        };
        compliance.clear();
        compliance.resize(n * n, 0.0);
        for (b, table) in tables.iter().enumerate() {
            let places = |out: &mut Vec<TablePlace>, load: bool| {
                out.clear();
                out.extend(rows.iter().zip(slices.iter()).filter_map(|(row, slice)| {
                    let patch = [row.patches.0, row.patches.1][b];
                    let support = &row.supports[b];
                    let direction = if load { &support.load } else { &support.direction };
                    table.place(&set.patches()[b][patch], patch, slice.at[b], Some(direction))
                }));
            };
            places(openings, false);
            if symmetric {
                table.add(openings, openings, true, &mut work[b], compliance);
            } else {
                places(loads, true);
                table.add(openings, loads, false, &mut work[b], compliance);
            }
            if let Some(modal) = modal {
                modal.read_places(bent, b, openings, false);
                modal.read_places(bent, b, loads, true);
            }
        }
        if symmetric {
            for j in 0..n {
                for i in j + 1..n {
                    compliance[i * n + j] = compliance[j * n + i];
                }
            }
        }
        if let Some(modal) = modal {
            modal.take_from(bent, n, compliance);
        }
    }

    /// Solves the contact of the rows; with a moment, for the turn of gear `body`.
    pub(crate) fn solve(&mut self, balance: Balance, body: usize) -> Result<(), ContactError> {
        let Self { found, gaps, levers, torque_levers, memory, solver, .. } = self;
        let Found { keys, rows, slices, laws, compliance, .. } = found;
        let n = rows.len();
        levers.clear();
        torque_levers.clear();
        levers.extend(rows.iter().map(|r| r.levers[body]));
        torque_levers.extend(rows.iter().map(|r| r.torque_levers[body]));
        let problem = DenseProblem {
            compliance: MatRef::from_column_major_slice(&compliance[..], n, n),
            symmetric: self.friction.is_none(),
            gaps,
            levers,
            torque_levers,
            balance,
        };
        let local = |i: usize, force: f64| {
            let LocalState { approach, slope, .. } = laws[i].under(force / slices[i].length);
            (approach, slope / slices[i].length)
        };
        solver.solve(&problem, local, |i| memory[keys[i]])?;
        memory.fill(0.0);
        keys.iter().zip(solver.forces()).for_each(|(&key, &f)| memory[key] = f);
        Ok(())
    }

    /// What the last evaluation passed over and did, from the sizes of its arrays.
    pub fn work(&self) -> ContactWork {
        let (n, m) = (self.found.rows.len() as f64, self.solver.active().len() as f64);
        let steps = self.solver.iterations() as f64;
        let touched = self.work.each_ref().map(|w| w.touched() as f64);
        let places: f64 = self.openings.iter().chain(&self.loads).map(|p| p.points() as f64).sum::<f64>() / n.max(1.0);
        let of_row = size_of::<ContactRow>() + size_of::<Slice>() + 2 * size_of::<TablePlace>();
        let of_station = size_of::<SliceHint>() + size_of::<(usize, SlicePlace)>();
        let doubles = touched.iter().map(|t| t * t).sum::<f64>() + n * n + m * m + 12.0 * m;
        let tables: f64 = touched.iter().map(|t| 2.0 * places * n * t + places * n * n).sum();
        let newton = steps * (m * m * m / 3.0 + 2.0 * m * m + 2.0 * n * m);
        let tangent = 12.0 * m * m + 156.0 * m;
        ContactWork {
            bytes: 8.0 * doubles + n * of_row as f64 + (self.hints.len() * of_station) as f64,
            flops: tables + newton + tangent,
        }
    }

    /// Rows of the last solution, in order of pair and height.
    pub fn rows(&self) -> &[ContactRow] {
        &self.found.rows
    }

    /// The rows with the nodes that they rest on, at the poses of the last evaluation.
    pub fn supported_rows(&mut self, poses: &[Pose; 2]) -> Vec<ContactRow> {
        let Self { set, pairs, hints, found: Found { keys, rows, slices, .. }, .. } = self;
        let mut rows = rows.clone();
        let Some(of_window) = set.slices() else { return rows };
        let patches = [&set.patches()[0][..], &set.patches()[1][..]];
        for ((row, slice), &key) in
            rows.iter_mut().zip(slices.iter()).zip(keys.iter()).filter(|((r, _), _)| !r.is_supported())
        {
            let numbers = pairs[key / of_window.stations().len()];
            FlankPair::new(of_window.flanks(patches, numbers), poses).support(row, slice, &mut hints[key]);
        }
        rows
    }

    /// Slices of the rows.
    pub fn slices(&self) -> &[Slice] {
        &self.found.slices
    }

    /// Forces, openings and active rows of the last solution.
    pub fn solver(&self) -> &DenseSolver {
        &self.solver
    }
}

/// How far a body has turned about its own axis, rad.
fn turn(before: &Pose, now: &Pose) -> f64 {
    let q = (before.rotation.inverse() * now.rotation).into_inner();
    2.0 * q.k.atan2(q.w)
}
