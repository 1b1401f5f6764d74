//! Contacts of meshes that have gears in common, solved as one: what presses on one flank of a gear moves all others.
//! Theory (38a).

use faer::MatRef;

use crate::{
    ContactError, Pose,
    complementarity::{Balance, DenseProblem, DenseSolver},
    compliance::{load_columns, opening},
    nodal::ContactRow,
    opening_by_motion,
};

use super::MeshContact;

/// Coordinates of both gears of a mesh.
const OF_MESH: usize = 12;

/// A gear that two of the joined contacts have in common.
#[derive(Debug, Clone, Copy)]
pub struct CommonGear<'a> {
    /// Numbers of the contacts.
    pub contacts: [usize; 2],
    /// Which body of each the gear is: 0 its pinion, 1 its wheel.
    pub bodies: [usize; 2],
    /// Displacements (mm) of the boundary coordinates of the first contact's window of the gear under unit forces (N) on
    /// those of the second one's, each in the frame of its own matrices ([`reduction::GearReducer::compliance_between`]).
    pub compliance: MatRef<'a, f64>,
}

/// Force and approach of something that presses: approach (mm) of row i under a force (N), and its slope (mm/N).
pub type Approach<'a> = &'a dyn Fn(usize, f64) -> (f64, f64);

/// Rolling elements, divided into rows, that press the bore of a gear of some contacts. Row r presses by `shares` of a few
/// of m pressures on the bore, and opens with them.
///
/// ```text
/// g_r = g0_r + l_r . d + sum of S_rj F_j + delta_r(F_r),   S between rows = N U N',   S_ri = N_r U_f' A_i'
/// ```
/// d: coordinates of the bearing, f = l' F the force along them; N: shares, A: supports of slices. Theory (38b).
///
/// Rows that press before any load with forces P deform the gear, whose flanks have their shape so: S_iP P is taken off
/// all gaps. Theory (38c).
pub struct PressedBore<'a> {
    /// Gaps g0_r + l_r . d with all bodies rigid, mm.
    pub gaps: &'a [f64],
    /// l_r: what each of six coordinates opens.
    pub levers: &'a [[f64; 6]],
    /// delta_r.
    pub approach: Approach<'a>,
    /// U: openings of the bore along its pressures under unit ones, mm/N, m x m, symmetric.
    pub compliance: MatRef<'a, f64>,
    /// N: pressures of each row, and its shares in them.
    pub shares: &'a [[(usize, f64); 2]],
    /// Its flanks.
    pub flanks: Vec<FlanksOfBore<'a>>,
    /// P: forces of all rows before any load, N.
    pub preload: f64,
    /// Forces of the rows, N: those to begin with, then those of the solution.
    pub forces: &'a mut Vec<f64>,
}

/// Flanks of a gear whose bore is pressed.
#[derive(Debug, Clone, Copy)]
pub struct FlanksOfBore<'a> {
    /// Number of the contact.
    pub contact: usize,
    /// Which body of it the gear is: 0 its pinion, 1 its wheel.
    pub body: usize,
    /// U_f: displacements (mm) of the boundary coordinates of its window, in the frame of its matrices, under unit pressures (N),
    /// 3n x m.
    pub columns: MatRef<'a, f64>,
}

/// Contacts that are solved as one.
///
/// ```text
/// g_i = g0_i + sum_j S_ij F_j + delta_i(F_i) >= 0,   F_i >= 0,   F_i g_i = 0       i, j: the slices of all contacts
/// S between two contacts = sum over the gears that they have in common of A_i C_ij A_j'
/// ```
/// C_ij is the compliance between the two windows of a gear, A the rows' supports. Rows of bores that rolling elements press
/// come after the slices ([`PressedBore`]). Theory (38a), (38b).
#[derive(Debug)]
pub struct JoinedContacts {
    /// Contacts and bores of the last evaluation, and rows that there is memory for.
    count: usize,
    most: usize,
    solver: DenseSolver,
    compliance: Vec<f64>,
    gaps: Vec<f64>,
    still: Vec<f64>,
    /// df/dq of all contacts and then of all bores, 12 coordinates each (of a bore the first six), row by row.
    tangent: Vec<f64>,
}

impl Default for JoinedContacts {
    fn default() -> Self {
        Self::new()
    }
}

impl JoinedContacts {
    /// Nothing yet: memory grows with the contacts.
    pub fn new() -> Self {
        let [compliance, gaps, still, tangent] = Default::default();
        Self { count: 0, most: 0, solver: DenseSolver::new(0), compliance, gaps, still, tangent }
    }

    /// Forces of all contacts with the frames of their gears at `poses`, and their tangents: each contact then has its own
    /// ([`MeshContact::force`]) as after [`MeshContact::evaluate`].
    ///
    /// A row may be approached by as much as all contacts and bores overlap together, for a gear moves nowhere more than under
    /// its loads.
    ///
    /// # Errors
    /// [`ContactError`] when the contact problem cannot be solved.
    pub fn evaluate(
        &mut self,
        contacts: &mut [&mut MeshContact],
        poses: &[[Pose; 2]],
        common: &[CommonGear<'_>],
        bores: &mut [PressedBore<'_>],
    ) -> Result<(), ContactError> {
        self.count = contacts.len() + bores.len();
        let most = contacts.iter().map(|contact| contact.hints.len()).sum::<usize>()
            + bores.iter().map(|bore| bore.gaps.len()).sum::<usize>();
        if most > self.most {
            (self.most, self.solver) = (most, DenseSolver::new(most));
        }
        let overlaps = bores.iter().map(|bore| bore.gaps.iter().fold(0.0, |most: f64, gap| most.max(-gap)));
        let mut reach = overlaps.sum::<f64>();
        for (contact, poses) in contacts.iter_mut().zip(poses) {
            contact.search_from_hints(poses, f64::INFINITY);
            reach += contact.deepest().max(0.0);
        }
        for (contact, poses) in contacts.iter_mut().zip(poses) {
            contact.contact.bin = None;
            contact.rows_within(poses, reach, None);
        }
        // Forces that each contact has by itself are not far off: gears carry over less than teeth give way. What is not found
        // starts from the forces before.
        for contact in contacts.iter_mut() {
            let _ = contact.solve(Balance::Held, 0);
        }
        let sizes =
            || contacts.iter().map(|contact| contact.rows().len()).chain(bores.iter().map(|bore| bore.gaps.len()));
        let first: Vec<usize> = sizes().scan(0, |at, size| Some(std::mem::replace(at, *at + size))).collect();
        let n = sizes().sum();
        let symmetric = contacts.iter().all(|contact| contact.friction.is_none());
        self.join((&*contacts, poses, common), &*bores, &first, (n, symmetric));
        self.find_gaps(contacts, (&*bores, &first), n);
        self.still.clear();
        self.still.resize(n, 0.0);
        let (owner, now, pressed) = (|row: usize| first.partition_point(|at| *at <= row) - 1, &*contacts, &*bores);
        let local = |row: usize, force: f64| {
            let k = owner(row);
            match now.get(k) {
                Some(contact) => contact.contact.laws.under(row - first[k], force),
                None => (pressed[k - now.len()].approach)(row - first[k], force),
            }
        };
        let start = |row: usize| {
            let k = owner(row);
            match now.get(k) {
                Some(contact) => contact.last_forces[contact.contact.keys[row - first[k]]],
                None => pressed[k - now.len()].forces.get(row - first[k]).copied().unwrap_or(0.0),
            }
        };
        let Self { solver, compliance, gaps, still, .. } = self;
        let compliance = MatRef::from_column_major_slice(&compliance[..], n, n);
        let problem =
            DenseProblem { compliance, symmetric, gaps, levers: still, torque_levers: still, balance: Balance::Held };
        solver.solve(&problem, local, start)?;
        for (contact, &at) in contacts.iter_mut().zip(&first) {
            let rows = at..at + contact.rows().len();
            contact.solver.take_part(solver, rows);
            contact.keep_forces();
            contact.sum_forces();
        }
        for (bore, &at) in bores.iter_mut().zip(&first[contacts.len()..]) {
            bore.forces.clear();
            bore.forces.extend_from_slice(&solver.forces()[at..at + bore.gaps.len()]);
        }
        self.find_tangent(contacts, &*bores, &first);
        Ok(())
    }

    /// df/dq of contact `of` by the coordinates of the gears of contact `by`, N/mm, N, N mm: after an evaluation. Bores have the
    /// numbers after the contacts.
    pub fn tangent(&self, of: usize, by: usize) -> [[f64; OF_MESH]; OF_MESH] {
        let n = OF_MESH * self.count;
        let entry = |p: usize, q: usize| self.tangent[(OF_MESH * of + p) * n + OF_MESH * by + q];
        std::array::from_fn(|p| std::array::from_fn(|q| entry(p, q)))
    }

    /// Gaps of all rows, less what preloads open: those of contacts have them too.
    fn find_gaps(
        &mut self,
        contacts: &mut [&mut MeshContact],
        (bores, first): (&[PressedBore<'_>], &[usize]),
        n: usize,
    ) {
        let Self { gaps, compliance, .. } = self;
        let mut opened = vec![0.0; n];
        for (bore, &at) in bores.iter().zip(&first[contacts.len()..]).filter(|(bore, _)| bore.preload > 0.0) {
            for column in compliance.chunks_exact(n.max(1)).skip(at).take(bore.gaps.len()) {
                opened.iter_mut().zip(column).for_each(|(sum, s)| *sum += bore.preload * s);
            }
        }
        for (contact, &at) in contacts.iter_mut().zip(first) {
            let MeshContact { contact, gaps, .. } = &mut **contact;
            for ((row, gap), opened) in contact.rows.iter_mut().zip(gaps).zip(&opened[at..]) {
                row.gap -= opened;
                *gap -= opened;
            }
        }
        gaps.clear();
        gaps.extend(contacts.iter().flat_map(|contact| &contact.gaps));
        gaps.extend(bores.iter().flat_map(|bore| bore.gaps));
        let start = n - bores.iter().map(|bore| bore.gaps.len()).sum::<usize>();
        gaps[start..].iter_mut().zip(&opened[start..]).for_each(|(gap, opened)| *gap -= opened);
    }

    /// S between the rows of all contacts, column by column.
    fn join(
        &mut self,
        (contacts, poses, common): (&[&mut MeshContact], &[[Pose; 2]], &[CommonGear<'_>]),
        bores: &[PressedBore<'_>],
        first: &[usize],
        (n, symmetric): (usize, bool),
    ) {
        let compliance = &mut self.compliance;
        compliance.clear();
        compliance.resize(n * n, 0.0);
        for (contact, &at) in contacts.iter().zip(first) {
            let m = contact.rows().len();
            for (j, column) in contact.contact.compliance.chunks_exact(m.max(1)).enumerate() {
                compliance[(at + j) * n + at..(at + j) * n + at + m].copy_from_slice(column);
            }
        }
        let supported = |(contact, poses): (&&mut MeshContact, &[Pose; 2])| {
            let rows = contact.rows();
            contact.set.supported_rows(poses, rows, contact.slices(), &vec![1.0; rows.len()])
        };
        let rows: Vec<Vec<ContactRow>> = contacts.iter().zip(poses).map(supported).collect();
        for gear in common {
            let [a, b] = gear.contacts;
            let mut put = |[a, b]: [usize; 2], bodies: [usize; 2], through: MatRef<'_, f64>, both: bool| {
                for (j, load) in rows[b].iter().enumerate() {
                    let mut column = vec![0.0; through.nrows()];
                    load_columns(&load.supports[bodies[1]], |dof, force| {
                        let moved = through.col(dof);
                        column.iter_mut().zip(moved.iter()).for_each(|(sum, u)| *sum += force * u);
                    });
                    for (i, row) in rows[a].iter().enumerate() {
                        let moved = opening(&row.supports[bodies[0]], &column);
                        compliance[(first[b] + j) * n + first[a] + i] += moved;
                        if both {
                            compliance[(first[a] + i) * n + first[b] + j] += moved;
                        }
                    }
                }
            };
            put([a, b], gear.bodies, gear.compliance, symmetric);
            if !symmetric {
                put([b, a], [gear.bodies[1], gear.bodies[0]], gear.compliance.transpose(), false);
            }
        }
        for (bore, &at) in bores.iter().zip(&first[contacts.len()..]) {
            for (j, to) in bore.shares.iter().enumerate() {
                for (i, of) in bore.shares.iter().enumerate() {
                    let part =
                        |&(p, a): &(usize, f64)| to.iter().map(|&(q, b)| a * b * bore.compliance[(p, q)]).sum::<f64>();
                    compliance[(at + j) * n + at + i] = of.iter().map(part).sum();
                }
            }
            for flanks in &bore.flanks {
                let m = flanks.columns.ncols();
                let columns: Vec<Vec<f64>> = (0..m).map(|q| flanks.columns.col(q).iter().copied().collect()).collect();
                for (i, row) in rows[flanks.contact].iter().enumerate() {
                    let (support, row_at) = (&row.supports[flanks.body], first[flanks.contact] + i);
                    let opened: Vec<f64> = columns.iter().map(|column| opening(support, column)).collect();
                    let mut pressed = if symmetric { opened.clone() } else { vec![0.0; m] };
                    if !symmetric {
                        load_columns(support, |dof, force| {
                            pressed.iter_mut().zip(&columns).for_each(|(sum, column)| *sum += force * column[dof]);
                        });
                    }
                    for (r, shares) in bore.shares.iter().enumerate() {
                        let sum = |of: &[f64]| shares.iter().map(|&(q, share)| share * of[q]).sum::<f64>();
                        compliance[(at + r) * n + row_at] += sum(&opened);
                        compliance[row_at * n + at + r] += sum(&pressed);
                    }
                }
            }
        }
    }

    fn find_tangent(&mut self, contacts: &mut [&mut MeshContact], bores: &[PressedBore<'_>], first: &[usize]) {
        let n = OF_MESH * self.count;
        self.tangent.resize(n * n, 0.0);
        let now = &*contacts;
        let fill = |i: usize, openings: &mut [f64], loads: &mut [f64]| {
            let k = first.partition_point(|at| *at <= i) - 1;
            if let Some(bore) = k.checked_sub(now.len()).map(|bore| &bores[bore]) {
                for all in [openings, loads] {
                    all.fill(0.0);
                    all[OF_MESH * k..][..6].copy_from_slice(&bore.levers[i - first[k]]);
                }
                return;
            }
            let contact = &now[k].contact;
            let centres = contact.at.unwrap_or([Pose::identity(); 2]).map(|pose| pose.translation.vector);
            let row = &contact.rows[i - first[k]];
            for (all, direction) in [(openings, row.normal), (loads, row.traction)] {
                all.fill(0.0);
                all[OF_MESH * k..][..OF_MESH].copy_from_slice(&opening_by_motion(row, &direction, &centres));
            }
        };
        self.solver.tangent_of(&mut vec![0.0; 2 * n], fill, &mut self.tangent);
        for (k, contact) in contacts.iter_mut().enumerate() {
            contact.force.tangent = self.tangent(k, k);
        }
    }
}
