//! Meshes of gears that are in several of them: each hears through the gear's body what the others press. Theory (38a).

use std::sync::Arc;

use contact::{
    ContactError,
    slice::{CommonGear, JoinedContacts},
};
use faer::Mat;
use ltca::StaticError;
use nalgebra::{SMatrix, Vector3};
use reduction::{ElasticGear, GearReducer, Window};

use crate::{ExactMesh, GearMesh, GearboxError, MeshElement, MeshForces, Meshing, Vector12, train::at_mesh};

/// Compliances that are kept of a gear between two of its meshes: teeth change in turn, and come back.
const KEPT: usize = 3;

/// How the forces of a mesh follow the gears of another one that has a gear in common with it, in the axes of both.
pub(crate) struct AcrossMeshes {
    pub of: usize,
    pub by: usize,
    /// df/dq, N/mm, N, N mm.
    pub tangent: SMatrix<f64, 12, 12>,
}

/// Exact meshes that gears join to one contact.
pub(crate) struct JoinedMeshes {
    /// Numbers of the meshes, ascending.
    pub meshes: Vec<usize>,
    gears: Vec<SharedGear>,
    contacts: JoinedContacts,
}

/// A gear in two meshes.
struct SharedGear {
    /// Places among the joined meshes, and ends of the gear there.
    contacts: [usize; 2],
    ends: [usize; 2],
    /// Directions of both meshes, rad.
    directions: [f64; 2],
    /// Compliances between its windows by where these stand.
    known: Vec<([u32; 2], Mat<f64>)>,
}

impl JoinedMeshes {
    /// The joined meshes of a gearbox; meshes that are not exact are not among them.
    pub fn all(meshes: &[GearMesh], meshing: &[Meshing], elements: &mut [Box<dyn MeshElement>]) -> Vec<Self> {
        let exact: Vec<usize> = (0..meshes.len()).filter(|&i| elements[i].to_join().is_some()).collect();
        let mut group: Vec<usize> = (0..meshes.len()).collect();
        let mut shared = Vec::new();
        for (&i, &j) in exact.iter().flat_map(|i| exact.iter().filter(move |j| *j > i).map(move |j| (i, j))) {
            for (a, b) in (0..2).flat_map(|a| (0..2).map(move |b| (a, b))) {
                if meshes[i].discs[a] == meshes[j].discs[b] {
                    shared.push(([i, j], [a, b]));
                    let [into, from] = [group[i], group[j]];
                    group.iter_mut().filter(|g| **g == from).for_each(|g| *g = into);
                }
            }
        }
        let of_group = |number: usize| {
            let own: Vec<usize> = (0..meshes.len()).filter(|&i| group[i] == number).collect();
            let place = |mesh: usize| own.binary_search(&mesh).ok();
            let gear = |&([i, j], ends): &([usize; 2], [usize; 2])| {
                let directions = [i, j].map(|mesh| meshing[mesh].direction);
                Some(SharedGear { contacts: [place(i)?, place(j)?], ends, directions, known: Vec::new() })
            };
            let gears: Vec<SharedGear> = shared.iter().filter_map(gear).collect();
            (!gears.is_empty()).then(|| Self { meshes: own, gears, contacts: JoinedContacts::new() })
        };
        (0..meshes.len()).filter_map(of_group).collect()
    }

    /// Forces of its meshes at displacements of all meshes, put at their places among all replies, and how they follow each
    /// other's gears.
    pub fn evaluate(
        &mut self,
        (meshes, elements): (&[GearMesh], &mut [Box<dyn MeshElement>]),
        displacements: &[Vector12],
        replies: &mut [Option<MeshForces>],
    ) -> Result<Vec<AcrossMeshes>, GearboxError> {
        let Self { meshes: own, gears, contacts } = self;
        let joined = elements.iter_mut().enumerate().filter(|(i, _)| own.binary_search(i).is_ok());
        let mut exact: Vec<&mut ExactMesh> =
            joined.filter_map(|(_, element)| element.to_join()?.downcast_mut()).collect();
        exact.iter_mut().zip(own.iter()).for_each(|(mesh, &i)| mesh.place(&displacements[i]));
        for gear in gears.iter_mut() {
            let of = gear.contacts.map(|k| &*exact[k]);
            gear.find(of).map_err(|source| at_mesh(&meshes[own[gear.contacts[1]]], source))?;
        }
        let common: Vec<CommonGear<'_>> = gears.iter().filter_map(SharedGear::common).collect();
        let poses: Vec<_> = exact.iter().map(|mesh| mesh.poses).collect();
        let mut all: Vec<_> = exact.iter_mut().map(|mesh| &mut mesh.contact).collect();
        let found = contacts.evaluate(&mut all, &poses, &common);
        found.map_err(|source| at_mesh(&meshes[own[0]], exact[0].failed(source)))?;
        let turns: Vec<_> =
            exact.iter().zip(own.iter()).map(|(mesh, &i)| mesh.generalised(&displacements[i])).collect();
        let mut across = Vec::new();
        for (k, (mesh, &i)) in exact.iter().zip(own.iter()).enumerate() {
            replies[i] = Some(mesh.forces(&displacements[i]));
            for (m, &by) in own.iter().enumerate().filter(|(m, _)| *m != k) {
                let tangent = contacts.tangent(k, m);
                let mut tangent = SMatrix::from_fn(|p, q| tangent[p][q]);
                if let Some(g) = &turns[k] {
                    tangent = g * tangent;
                }
                if let Some(g) = &turns[m] {
                    tangent *= g.transpose();
                }
                across.push(AcrossMeshes { of: i, by, tangent });
            }
        }
        Ok(across)
    }
}

impl SharedGear {
    /// Makes the compliance between the windows of the gear in two meshes, where it is not known; the last one is that of the
    /// windows as they stand.
    fn find(&mut self, meshes: [&ExactMesh; 2]) -> Result<(), GearboxError> {
        let gear = ["pinion", "wheel"][self.ends[1]];
        let failed = |source| GearboxError::from(StaticError::from(ContactError::Reduction { gear, source }));
        let [(a, own), (b, theirs)] = match [reduced(meshes[0], self.ends[0]), reduced(meshes[1], self.ends[1])] {
            [Some(a), Some(b)] => [a, b],
            _ => return Err(failed(reduction::ReductionError::OtherReduction)),
        };
        // Alike teeth: windows that are as far apart have the same compliance in their frames. How far that is shows where the
        // frames stand, for the teeth of a ring of gears are counted anew in every mesh.
        let (key, shifts) = if a.is_cyclic() && b.is_cyclic() {
            let angle = |k: usize| {
                let x = meshes[k].poses[self.ends[k]].rotation * Vector3::x();
                self.directions[k] + x.y.atan2(x.x)
            };
            let apart = ((angle(0) - angle(1)) / a.gear().pitches_on(1)).round() as i64;
            let apart = apart.rem_euclid(i64::from(a.gear().tooth_count())) as u32;
            ([apart, 0], [apart, 0])
        } else {
            let first = [own, theirs].map(|window| window.reduced.teeth.first().copied().unwrap_or(0));
            (first, [own.shift, theirs.shift])
        };
        let last = match self.known.iter().position(|known| known.0 == key) {
            Some(at) => self.known.remove(at),
            None => {
                let at = |window: &Window, shift: u32| Window { reduced: Arc::clone(&window.reduced), shift };
                let [own, theirs] = [at(own, shifts[0]), at(theirs, shifts[1])];
                (key, a.compliance_between(&own, (b, &theirs)).map_err(failed)?)
            }
        };
        if self.known.len() == KEPT {
            self.known.remove(0);
        }
        self.known.push(last);
        Ok(())
    }

    fn common(&self) -> Option<CommonGear<'_>> {
        let compliance = self.known.last()?.1.as_ref();
        Some(CommonGear { contacts: self.contacts, bodies: self.ends, compliance })
    }
}

/// Reduction of a gear of a mesh, and its window as it stands.
fn reduced(mesh: &ExactMesh, end: usize) -> Option<(&GearReducer, &Window)> {
    let windows = mesh.contact.contact_set().windows()?;
    match &mesh.gears[end] {
        ElasticGear::Reduced(reducer) => Some((reducer, &windows[end])),
        ElasticGear::Full(_) => None,
    }
}
