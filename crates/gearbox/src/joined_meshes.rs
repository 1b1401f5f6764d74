//! Meshes of gears that are in several of them: each hears through the gear's body what the others press. Theory (38a).

use std::{any::Any, sync::Arc};

use contact::{
    ContactError,
    slice::{CommonGear, JoinedContacts},
};
use faer::Mat;
use ltca::StaticError;
use mesh::Bolts;
use nalgebra::{DVector, SMatrix, Vector3};
use reduction::{ElasticGear, GearReducer, Window};

use crate::{
    ExactMesh, GearMesh, GearboxError, MeshElement, MeshForces, Meshing, Structure, Vector12,
    compliant_support::CompliantBearing,
    opening_bolts::{BoltForce, BoltsOfGear},
    pressed_bore::{BoreFailure, BoreOfGear, SeenBy},
    rolling_bearing::RollingReply,
    train::at_mesh,
};

/// Compliances that are kept of a gear between two of its meshes: teeth change in turn, and come back.
const KEPT: usize = 3;

/// How the forces of a mesh or bearing follow the gears of another one that has a gear in common with it, in the axes of both.
/// Bearings with rolling elements have the numbers after the meshes, and six coordinates: the displacement of the shaft
/// against the seat.
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
    /// Bores that rolling elements press.
    pub bores: Vec<BoreOfGear>,
    /// Bolts of gears.
    bolts: Vec<BoltsOfGear>,
    /// Directions of the meshes, rad.
    directions: Vec<f64>,
    contacts: JoinedContacts,
}

/// Forces of joined meshes and of the bearings in their gears, and how they follow each other.
pub(crate) struct JoinedForces<'a> {
    /// Of all meshes.
    pub replies: &'a mut [Option<MeshForces>],
    /// Of all bearings with rolling elements.
    pub pressed: &'a mut [Option<RollingReply>],
    pub across: &'a mut Vec<AcrossMeshes>,
}

/// A gear in two meshes.
struct SharedGear {
    /// Places among the joined meshes, and ends of the gear there.
    contacts: [usize; 2],
    ends: [usize; 2],
    /// Directions of both meshes, rad.
    directions: [f64; 2],
    /// Compliances between its windows, the last one as these stand.
    known: Vec<Arc<Known>>,
}

/// Compliance between two windows of a gear: planets have it in common, and so have places as far apart on sun and ring.
struct Known {
    /// Where the windows stand.
    key: [u32; 2],
    /// Gears of both meshes, which of them it is, and its windows.
    of: [(Arc<[ElasticGear; 2]>, usize, Window); 2],
    compliance: Mat<f64>,
}

impl Known {
    /// Whether it is that of other windows as well.
    fn is(&self, key: [u32; 2], of: &[(Arc<[ElasticGear; 2]>, usize, Window); 2]) -> bool {
        let same = |a: &(Arc<[ElasticGear; 2]>, usize, Window), b: &(Arc<[ElasticGear; 2]>, usize, Window)| {
            Arc::ptr_eq(&a.0, &b.0) && a.1 == b.1 && Arc::ptr_eq(&a.2.reduced, &b.2.reduced)
        };
        self.key == key && self.of.iter().zip(of).all(|(a, b)| same(a, b))
    }
}

impl JoinedMeshes {
    /// The joined meshes of a gearbox; meshes that are not exact are not among them.
    pub fn all(
        (meshes, meshing): (&[GearMesh], &[Meshing]),
        elements: &mut [Box<dyn MeshElement>],
        supports: &[CompliantBearing],
    ) -> Vec<Self> {
        let exact: Vec<usize> = (0..meshes.len()).filter(|&i| elements[i].to_join().is_some()).collect();
        let reduced_bolts: Vec<[Option<Bolts>; 2]> =
            elements.iter_mut().map(|element| element.to_join().map_or([None; 2], bolts_of_mesh)).collect();
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
            let bore = |(at, support): (usize, &CompliantBearing)| {
                let ends = own.iter().enumerate().flat_map(|(k, mesh)| [0, 1].map(|end| (k, *mesh, end)));
                let is_exact = |mesh: &usize| exact.binary_search(mesh).is_ok();
                let of_gear =
                    ends.filter(|(_, mesh, end)| is_exact(mesh) && support.bore_of == Some(meshes[*mesh].discs[*end]));
                let seen: Vec<(usize, usize)> = of_gear.map(|(k, _, end)| (k, end)).collect();
                (!seen.is_empty()).then(|| BoreOfGear::new(at, seen))
            };
            let bores: Vec<BoreOfGear> = supports.iter().enumerate().filter_map(bore).collect();
            let bolts = bolts_of((meshes, &own), &reduced_bolts);
            let directions = own.iter().map(|&mesh| meshing[mesh].direction).collect();
            let joined = Self { meshes: own, gears, bores, bolts, directions, contacts: JoinedContacts::new() };
            (!(joined.gears.is_empty() && joined.bores.is_empty() && joined.bolts.is_empty())).then_some(joined)
        };
        (0..meshes.len()).filter_map(of_group).collect()
    }

    /// Forces of its meshes and bearings at displacements of all meshes and of all seats, put at their places among all.
    pub fn evaluate(
        &mut self,
        (meshes, elements): (&[GearMesh], &mut [Box<dyn MeshElement>]),
        (structure, supports): (&Structure, &[CompliantBearing]),
        (displacements, y): (&[Vector12], &DVector<f64>),
        found: JoinedForces<'_>,
    ) -> Result<(), GearboxError> {
        let Self { meshes: own, gears, bores, bolts, directions, contacts } = self;
        let joined = elements.iter_mut().enumerate().filter(|(i, _)| own.binary_search(i).is_ok());
        let mut exact: Vec<&mut ExactMesh> =
            joined.filter_map(|(_, element)| element.to_join()?.downcast_mut()).collect();
        exact.iter_mut().zip(own.iter()).for_each(|(mesh, &i)| mesh.place(&displacements[i]));
        for k in 0..gears.len() {
            let others: Vec<Arc<Known>> = gears.iter().flat_map(|gear| &gear.known).cloned().collect();
            let gear = &mut gears[k];
            let of = gear.contacts.map(|k| &*exact[k]);
            gear.find(of, &others).map_err(|source| at_mesh(&meshes[own[gear.contacts[1]]], source))?;
        }
        for bore in bores.iter_mut() {
            stand(bore, (&exact, directions), (structure, supports))
                .map_err(|source| at_mesh(&meshes[own[bore.meshes[0].0]], source))?;
        }
        for own_bolts in bolts.iter_mut() {
            stand_on(own_bolts, (&exact, directions))
                .map_err(|source| at_mesh(&meshes[own[own_bolts.meshes[0].0]], source))?;
        }
        let common: Vec<CommonGear<'_>> = gears.iter().filter_map(SharedGear::common).collect();
        let poses: Vec<_> = exact.iter().map(|mesh| mesh.poses).collect();
        let bearings: Vec<usize> = bores.iter().map(|bore| bore.bearing).collect();
        let laws: Vec<_> =
            bearings.iter().map(|&at| move |_: usize, force: f64| supports[at].law().lamina_under(force)).collect();
        let pressing = bores.iter_mut().zip(&laws).filter_map(|(bore, law)| {
            let moved = supports[bore.bearing].seen(y);
            bore.pressed(&moved, law)
        });
        let of_bolts: Vec<_> = bolts.iter().map(BoltsOfGear::law).collect();
        let opening = bolts.iter_mut().zip(&of_bolts).filter_map(|(own, law)| own.pressed(law));
        // Bolts come after bearings, which have numbers of their own.
        let mut pressing: Vec<_> = pressing.chain(opening).collect();
        let mut all: Vec<_> = exact.iter_mut().map(|mesh| &mut mesh.contact).collect();
        let solved = contacts.evaluate(&mut all, &poses, &common, &mut pressing);
        drop(pressing);
        solved.map_err(|source| at_mesh(&meshes[own[0]], exact[0].failed(source)))?;
        let turns: Vec<_> =
            exact.iter().zip(own.iter()).map(|(mesh, &i)| mesh.generalised(&displacements[i])).collect();
        for (mesh, &i) in exact.iter().zip(own.iter()) {
            found.replies[i] = Some(mesh.forces(&displacements[i]));
        }
        let first = own.len();
        for (k, bore) in bores.iter().enumerate() {
            let tangent = contacts.tangent(first + k, first + k);
            let stiffness = nalgebra::Matrix5::from_fn(|p, q| -tangent[p][q]);
            found.pressed[bore.bearing] = Some(bore.reply(&supports[bore.bearing]).stiff(stiffness));
        }
        let count = first + bores.len();
        let number = |k: usize| if k < first { own[k] } else { meshes.len() + bearings[k - first] };
        for (k, m) in (0..count).flat_map(|k| (0..count).map(move |m| (k, m))).filter(|(k, m)| k != m) {
            let tangent = contacts.tangent(k, m);
            let mut tangent = SMatrix::from_fn(|p, q| tangent[p][q]);
            if let Some(Some(g)) = turns.get(k) {
                tangent = g * tangent;
            }
            if let Some(Some(g)) = turns.get(m) {
                tangent *= g.transpose();
            }
            found.across.push(AcrossMeshes { of: number(k), by: number(m), tangent });
        }
        Ok(())
    }
}

impl JoinedMeshes {
    /// Forces of the bolts of all gears on these after an evaluation, by disc.
    pub fn bolt_forces(&self, elements: &mut [Box<dyn MeshElement>]) -> Vec<(usize, Vec<BoltForce>)> {
        let joined = elements.iter_mut().enumerate().filter(|(i, _)| self.meshes.binary_search(i).is_ok());
        let exact: Vec<&mut ExactMesh> = joined.filter_map(|(_, element)| element.to_join()?.downcast_mut()).collect();
        let of_gear = |bolts: &BoltsOfGear| {
            let on = |&(k, end): &(usize, usize)| {
                let mesh = &exact[k];
                mesh.contact.boundary_forces(&mesh.poses).map(|[a, b]| if end == 0 { a } else { b }).unwrap_or_default()
            };
            (bolts.disc, bolts.carried(&bolts.meshes.iter().map(on).collect::<Vec<_>>()))
        };
        self.bolts.iter().map(of_gear).collect()
    }
}

/// Bolts of both gears of an exact mesh.
fn bolts_of_mesh(element: &mut dyn Any) -> [Option<Bolts>; 2] {
    let bolts = |gear: &ElasticGear| match gear {
        ElasticGear::Reduced(reducer) => reducer.bolts(),
        ElasticGear::Full(_) => None,
    };
    element.downcast_ref::<ExactMesh>().map_or([None; 2], |mesh| [0, 1].map(|end| bolts(&mesh.gears[end])))
}

/// Bolts of all gears of some meshes.
fn bolts_of((meshes, own): (&[GearMesh], &[usize]), reduced: &[[Option<Bolts>; 2]]) -> Vec<BoltsOfGear> {
    let mut all: Vec<BoltsOfGear> = Vec::new();
    for (k, end) in (0..own.len()).flat_map(|k| [0, 1].map(move |end| (k, end))) {
        let (disc, Some(bolts)) = (meshes[own[k]].discs[end], reduced[own[k]][end]) else { continue };
        match all.iter_mut().find(|known| known.disc == disc) {
            Some(known) => known.meshes.push((k, end)),
            None => all.push(BoltsOfGear::new(disc, vec![(k, end)], bolts)),
        }
    }
    all
}

/// Makes what is known of bolts where their gear stands.
fn stand_on(bolts: &mut BoltsOfGear, (exact, directions): (&[&mut ExactMesh], &[f64])) -> Result<(), GearboxError> {
    let end = bolts.meshes[0].1;
    let failed = |source| {
        let gear = ["pinion", "wheel"][end];
        GearboxError::from(StaticError::from(ContactError::Reduction { gear, source }))
    };
    let seen: Option<Vec<SeenBy<'_>>> = bolts.meshes.iter().map(|own| seen_by((exact, directions), own)).collect();
    let seen = seen.ok_or_else(|| failed(reduction::ReductionError::OtherReduction))?;
    bolts.stand(&seen).map_err(failed)
}

/// A gear as one of its meshes sees it.
fn seen_by<'a>((exact, directions): (&'a [&mut ExactMesh], &[f64]), &(k, end): &(usize, usize)) -> Option<SeenBy<'a>> {
    let (reducer, window) = reduced(exact[k], end)?;
    let cyclic = if reducer.is_cyclic() { 0.0 } else { reducer.frame_angle(window) };
    Some(SeenBy { reducer, window, angle: directions[k] + exact[k].frame_angle(end) - cyclic })
}

/// Makes what is known of a bore where its gear stands.
fn stand(
    bore: &mut BoreOfGear,
    (exact, directions): (&[&mut ExactMesh], &[f64]),
    (structure, supports): (&Structure, &[CompliantBearing]),
) -> Result<(), GearboxError> {
    let support = &supports[bore.bearing];
    let failed = |gear: usize, failure: BoreFailure| match failure {
        BoreFailure::Reduction(source) => {
            let gear = ["pinion", "wheel"][gear];
            GearboxError::from(StaticError::from(ContactError::Reduction { gear, source }))
        }
        BoreFailure::Bore(source) => {
            GearboxError::Bore { bearing: structure.bearings[support.bearing].name.clone(), source }
        }
    };
    let end = bore.meshes[0].1;
    let seen: Option<Vec<SeenBy<'_>>> = bore.meshes.iter().map(|own| seen_by((exact, directions), own)).collect();
    let seen = seen.ok_or_else(|| failed(end, BoreFailure::Reduction(reduction::ReductionError::OtherReduction)))?;
    bore.stand(support, &seen).map_err(|failure| failed(end, failure))
}

impl SharedGear {
    /// Makes the compliance between the windows of the gear in two meshes, where it is not known; the last one is that of the
    /// windows as they stand.
    fn find(&mut self, meshes: [&ExactMesh; 2], others: &[Arc<Known>]) -> Result<(), GearboxError> {
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
        let at = |window: &Window, shift: u32| Window { reduced: Arc::clone(&window.reduced), shift };
        let [own, theirs] = [at(own, shifts[0]), at(theirs, shifts[1])];
        let [first, second] = meshes.map(|mesh| Arc::clone(&mesh.gears));
        let of = [(first, self.ends[0], own), (second, self.ends[1], theirs)];
        let last = match self.known.iter().position(|known| known.is(key, &of)) {
            Some(at) => self.known.remove(at),
            None => match others.iter().find(|known| known.is(key, &of)) {
                Some(known) => Arc::clone(known),
                None => {
                    let compliance = a.compliance_between(&of[0].2, (b, &of[1].2)).map_err(failed)?;
                    Arc::new(Known { key, of, compliance })
                }
            },
        };
        if self.known.len() == KEPT {
            self.known.remove(0);
        }
        self.known.push(last);
        Ok(())
    }

    fn common(&self) -> Option<CommonGear<'_>> {
        let compliance = self.known.last()?.compliance.as_ref();
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
