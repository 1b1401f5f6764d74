//! Displacement and root stress on the pieces of both gears, position by position.

use std::{collections::BTreeSet, sync::Arc};

use ltca::StaticModel;
use rayon::prelude::*;
use reduction::{ElasticGear, ReductionWay, Window};

use super::{
    Frame, GearView, Shape, View, WindowView, angles,
    packed::{Packed, triangles},
    piece::Piece,
    record::{Recorded, RecordedGear, ViewRecorder},
};
use crate::ExportError;
use scene::Scene;

/// Bytes of all fields in a page at most, before they become text.
const BYTES: usize = 2_400_000;
/// Positions shown at least, and at most where each takes a solve with the factor of a whole gear.
const LEAST: usize = 4;
const FEW: usize = 8;
/// Positions that go through a factor at a time.
const AT_A_TIME: usize = 8;
/// Free degrees of freedom of a gear from the cache up to which its sector is condensed once more for the sake of
/// fields.
const CHEAP_AGAIN: usize = 300_000;

impl ViewRecorder {
    /// [`ViewRecorder::view`]; a picture that does not come out is a warning.
    pub fn view_or_remark(self, scene: &Scene, model: &StaticModel, remarks: &mut Vec<answer::Remark>) -> Option<View> {
        let view = self.view(scene, model);
        remarks.extend(analysis::elastic_gears::part_faults(model.gears()));
        view.map_err(|e| remarks.push(analysis::remark::no_view(e.to_string()))).ok()
    }

    /// What was remembered, with fields where they cost little beside what was solved.
    ///
    /// # Errors
    /// When a field does not come out.
    pub fn view(mut self, scene: &Scene, model: &StaticModel) -> Result<View, ExportError> {
        let shown = model.gears().iter().all(is_cheap);
        if model.gears().iter().any(is_general) {
            thin(&mut self.positions, FEW);
        }
        let pieces: [Option<Piece>; 2] = [0, 1].map(|i| piece(&self.positions, model, i).filter(|_| shown));
        let points: usize = pieces.iter().flatten().map(|p| p.points.len()).sum();
        // Three components of displacement, a stress and a pressure of two bytes each.
        thin(&mut self.positions, (BYTES / (10 * points.max(1))).max(LEAST));
        let window = |i: usize| {
            let of = pieces[i].as_ref().map(|piece| window(piece, &self.positions, &model.gears()[i], i));
            of.transpose()
        };
        let (pinion, wheel) = rayon::join(|| window(0), || window(1));
        let (pinion, wheel) = (pinion?, wheel?);
        let note = note(pinion.is_some() && wheel.is_some());
        let frames = self.positions.into_iter().map(|p| {
            let shift = p.gears.each_ref().map(|g| g.window.as_ref().map_or(0, |w| w.shift));
            Frame { phase: p.phase, angles: angles(scene, model.pair(), p.pinion_angle), shift, bands: p.bands }
        });
        let frames = frames.collect();
        Ok(View {
            gears: [GearView::new(model.pair(), 0, pinion), GearView::new(model.pair(), 1, wheel)],
            frames,
            note,
        })
    }
}

/// At most `most` of the positions, evenly.
fn thin(positions: &mut Vec<Recorded>, most: usize) {
    let every = positions.len().div_ceil(most.max(1)).max(1);
    let mut index = 0;
    positions.retain(|_| {
        index += 1;
        (index - 1) % every == 0
    });
}

/// Whether fields of a gear come without condensing it anew, or that is soon done.
fn is_cheap(gear: &ElasticGear) -> bool {
    match gear {
        ElasticGear::Full(_) => true,
        ElasticGear::Reduced(r) => {
            let known = !r.is_from_record() && r.stack().is_none();
            known || r.stack().is_none() && (r.way() == ReductionWay::CyclicSector && r.free_count() <= CHEAP_AGAIN)
        }
    }
}

fn is_general(gear: &ElasticGear) -> bool {
    matches!(gear, ElasticGear::Reduced(r) if r.way() == ReductionWay::General)
}

/// Teeth of all windows and one more on either side.
fn teeth(positions: &[Recorded], i: usize, z: u32) -> BTreeSet<u32> {
    let all = positions.iter().flat_map(|p| &p.gears[i].teeth);
    all.flat_map(|&t| [t + z - 1, t, t + 1]).map(|t| t % z).collect()
}

fn piece(positions: &[Recorded], model: &StaticModel, i: usize) -> Option<Piece> {
    let gear = model.gears()[i].gear();
    let exact = [&model.pair().pinion, &model.pair().wheel][i];
    Piece::new(gear, exact, &teeth(positions, i, gear.tooth_count()))
}

fn window(piece: &Piece, positions: &[Recorded], gear: &ElasticGear, i: usize) -> Result<WindowView, ExportError> {
    let gears: Vec<&RecordedGear> = positions.iter().map(|p| &p.gears[i]).collect();
    let solved = all_fields(piece, &gears, gear)?;
    let pressures: Vec<Vec<f64>> = positions.iter().filter_map(|p| pressure(piece, &p.gears[i])).collect();
    let nodes: Vec<f64> = piece.points.iter().flat_map(|&n| piece.mesh.nodes[n as usize]).collect();
    Ok(WindowView {
        shape: Shape { points: Packed::new([&nodes[..]]), triangles: triangles(&piece.triangles) },
        teeth: teeth(positions, i, gear.gear().tooth_count()).into_iter().collect(),
        displacement: Packed::new(solved.iter().map(|f| &f[0][..])),
        stress: Packed::new(solved.iter().map(|f| &f[1][..])),
        pressure: if pressures.is_empty() { Packed::empty() } else { Packed::new(pressures.iter().map(|p| &p[..])) },
    })
}

/// The fields of all positions: displacement (um, three a point) and first principal stress (MPa, NaN above the
/// fillets) at the points.
fn all_fields(
    piece: &Piece,
    positions: &[&RecordedGear],
    gear: &ElasticGear,
) -> Result<Vec<[Vec<f64>; 2]>, ExportError> {
    let mut all = Vec::with_capacity(positions.len());
    // Neighbours in one window go through its factor, and through the elements, together.
    for group in positions.chunk_by(|a, b| shared_window(a, b)).flat_map(|g| g.chunks(AT_A_TIME)) {
        all.extend(fields(piece, &displacements(piece, group, gear)?, gear)?);
    }
    Ok(all)
}

/// Whether two positions have loaded windows with the same matrices.
fn shared_window(a: &RecordedGear, b: &RecordedGear) -> bool {
    let same = a.window.as_ref().zip(b.window.as_ref()).is_some_and(|(a, b)| Arc::ptr_eq(&a.reduced, &b.reduced));
    same && !a.loads.is_empty() && !b.loads.is_empty()
}

/// Displacement of the piece's nodes in the frame of the matrices (mm) at positions that share a window, or at one.
fn displacements(
    piece: &Piece,
    group: &[&RecordedGear],
    gear: &ElasticGear,
) -> Result<Vec<Vec<[f64; 3]>>, ExportError> {
    let Some(first) = group.first() else { return Ok(Vec::new()) };
    match (gear, &first.window) {
        _ if first.loads.is_empty() => Ok(vec![vec![[0.0; 3]; piece.nodes.len()]; group.len()]),
        (ElasticGear::Reduced(r), Some(window)) => {
            let own = Window { reduced: window.reduced.clone(), shift: 0 };
            let forces: Vec<&[f64]> = group.iter().map(|at| &at.loads[..]).collect();
            Ok(r.expand_under(&own, &forces, &piece.nodes)?)
        }
        (ElasticGear::Reduced(_), None) => Err(ExportError::NoWindow),
        (ElasticGear::Full(f), _) => {
            let of = |at: &&RecordedGear| -> Result<Vec<[f64; 3]>, ExportError> {
                let all = f.dofs.to_nodes(&at.loads)?;
                Ok(piece.nodes.iter().map(|&n| all[n as usize]).collect())
            };
            group.iter().map(of).collect()
        }
    }
}

/// Fields of displacements of the piece's nodes.
fn fields(piece: &Piece, moved: &[Vec<[f64; 3]>], gear: &ElasticGear) -> Result<Vec<[Vec<f64>; 2]>, ExportError> {
    let elements = match gear {
        ElasticGear::Reduced(r) => r.elements(),
        ElasticGear::Full(f) => &f.elements,
    };
    let mut at_root = vec![false; piece.mesh.nodes.len()];
    piece.points.iter().zip(&piece.at_root).for_each(|(&n, root)| at_root[n as usize] = *root);
    let all: Vec<&[[f64; 3]]> = moved.iter().map(Vec::as_slice).collect();
    let stresses = fem::nodal_stresses(&piece.mesh, gear.material(), elements, &all, |node| at_root[node as usize])?;
    let of_one = |(moved, stress): (&Vec<[f64; 3]>, &Vec<[f64; 6]>)| {
        let displacement = piece.points.iter().flat_map(|&n| moved[n as usize].map(|u| 1e3 * u)).collect();
        let root = |&n: &u32| {
            if at_root[n as usize] { fem::max_principal(&stress[n as usize]) } else { f64::NAN }
        };
        [displacement, piece.points.iter().map(root).collect()]
    };
    Ok(moved.par_iter().zip(&stresses).map(of_one).collect())
}

/// Pressure at the points, MPa, where nodes have one.
fn pressure(piece: &Piece, at: &RecordedGear) -> Option<Vec<f64>> {
    let of = |&n: &u32| {
        let node = piece.nodes[n as usize];
        at.pressure.binary_search_by_key(&node, |p| p.0).map_or(0.0, |k| at.pressure[k].1)
    };
    (!at.pressure.is_empty()).then(|| piece.points.iter().map(of).collect())
}

fn note(fields: bool) -> String {
    let note = if fields {
        "The window's teeth and one more on either side are the mesh with its fields, all others the exact geometry. Displacement is against the \
         bore; stress is the first principal one (tension positive) below the upper end of the fillets, averaged at the nodes of the \
         teeth shown; grey: no value. Contact bands are drawn wide enough to be seen, and shine through the \
         teeth until the wheel is drawn aside."
    } else {
        "The gears from their exact geometry. They came reduced from the cache, without what displacement and stress are recovered from, and \
         to condense them again would take long: run with `--no-cache` to see these fields. Of a wide gear condensed by \
         its layers there are none."
    };
    note.into()
}
