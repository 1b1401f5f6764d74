//! One sector of a cyclic gear, and the positions of a larger mesh's nodes in its copies.

use std::f64::consts::TAU;

use geometry::Side;
use mesh::{BoreCoupling, Copies, ElementBlock, Face, Mesh, MeshedGear, Origin};
use nalgebra::{DMatrix, DVector};

use super::turn::{PitchTurn, face_nodes};
use crate::elastic_bore::{ElasticBore, faces_in_part};

/// A sector and the mesh whose nodes lie in its copies.
///
/// ```text
/// copy k = the sector turned by k 2 pi / z;   left cut (clockwise) of copy k + 1 = right cut of copy k     (a ring: the other way round)
/// ```
#[derive(Debug)]
pub(crate) struct SectorMesh {
    pub teeth: u32,
    /// -1 where copies follow each other clockwise, else +1.
    pub way: f64,
    pub mesh: Mesh,
    /// Nodes that do not move, numbers of the sector.
    pub held: Vec<u32>,
    /// What stands on springs in their place.
    pub bore: Option<ElasticBore>,
    /// Faces of a bore that is held by its means in their place.
    pub seat: Option<Vec<Face>>,
    /// Nodes of the left cut and those of the right one on which they fall when turned by one pitch, held ones too.
    pub cuts: Vec<[u32; 2]>,
    /// Copy and node of the sector (never of the right cut) under each node of the larger mesh.
    pub places: Vec<Origin>,
    /// Node of the larger mesh by copy and node of the sector; `NOWHERE` for those that it does not have.
    numbers: Vec<u32>,
}

const NOWHERE: u32 = u32::MAX;
/// Fewer teeth than this, and a sector may be its own neighbour's neighbour.
const FEWEST_TEETH: u32 = 4;
/// What tips the balance where an element lies as near to two sectors, in pitches.
const TIE: f64 = 1e-6;

impl SectorMesh {
    /// Mesh of a periodic one-tooth sector; `None` when its copies share the axis.
    pub(crate) fn of_sector(sector: &MeshedGear, copies: &Copies) -> Option<Self> {
        let teeth = sector.tooth_count();
        if copies.on_axis || teeth < FEWEST_TEETH {
            return None;
        }
        let cuts = copies.cuts.clone();
        // Whoever is held in one copy is held where it is a node of the next one.
        let mut held = sector.held_nodes().to_vec();
        let is_held = |n: &u32| sector.held_nodes().binary_search(n).is_ok();
        held.extend(cuts.iter().filter(|pair| pair.iter().any(is_held)).flatten());
        held.sort_unstable();
        held.dedup();
        let places = copies.origins.clone();
        let bore = ElasticBore::of(sector);
        let seat = (sector.bore_coupling() == BoreCoupling::Distributing).then(|| sector.bore().faces.clone());
        Some(Self::new((teeth, sector.numbering_sign()), sector.mesh().clone(), (held, bore, seat), cuts, places))
    }

    /// Sector mesh of a whole gear that is cyclic: the elements about tooth 0.
    ///
    /// From every orbit of elements one is taken, the one nearest to the twisted centre line of tooth 0; which one
    /// changes the cuts, not the gear. `None` when a node belongs to more than two neighbouring sectors.
    pub(crate) fn of_whole(gear: &MeshedGear, turn: &PitchTurn) -> Option<Self> {
        let teeth = gear.tooth_count();
        if teeth < FEWEST_TEETH {
            return None;
        }
        let centre = CentreLine::of_tooth_0(gear)?;
        let mesh = gear.mesh();
        let mut blocks = Vec::new();
        let mut used = vec![false; mesh.nodes.len()];
        for (block, images) in mesh.blocks.iter().zip(&turn.elements) {
            let elements: Vec<&[u32]> = block.elements().collect();
            let away = |e: u32| (centre.pitches_from(mesh, elements[e as usize]) - TIE).abs();
            let mut part = ElementBlock { kind: block.kind, connectivity: Vec::new(), tags: Vec::new() };
            for orbit in orbits(images, teeth)? {
                let (_, own) = orbit.iter().map(|&e| (away(e), e)).min_by(|a, b| a.0.total_cmp(&b.0))?;
                part.connectivity.extend_from_slice(elements[own as usize]);
                part.tags.push(block.tags[own as usize]);
            }
            part.connectivity.iter().for_each(|&n| used[n as usize] = true);
            blocks.push(part);
        }
        let own: Vec<u32> = (0..mesh.nodes.len() as u32).filter(|&n| used[n as usize]).collect();
        let number = |n: u32| own.partition_point(|&known| known < n) as u32;
        let mut cuts = Vec::new();
        let mut places = vec![Origin { copy: 0, node: 0 }; mesh.nodes.len()];
        for orbit in orbits(&turn.nodes, teeth)? {
            let inside: Vec<usize> = (0..orbit.len()).filter(|&i| used[orbit[i] as usize]).collect();
            let at = match inside[..] {
                [at] => at,
                [a, b] if b == a + 1 => a,
                [0, b] if b + 1 == orbit.len() => b,
                _ => return None,
            };
            let (here, next) = (orbit[at], orbit[(at + 1) % orbit.len()]);
            if inside.len() == 2 {
                cuts.push([number(here), number(next)]);
            }
            for copy in 0..teeth {
                let there = orbit[(at + copy as usize) % orbit.len()];
                places[there as usize] = Origin { copy, node: number(here) };
            }
        }
        cuts.sort_unstable();
        let held = (0..own.len() as u32).filter(|&i| gear.held_nodes().binary_search(&own[i as usize]).is_ok());
        let held = held.collect();
        for node in blocks.iter_mut().flat_map(|b| &mut b.connectivity) {
            *node = number(*node);
        }
        let nodes = own.iter().map(|&n| mesh.nodes[n as usize]).collect();
        let node_tags = own.iter().map(|&n| mesh.node_tags[n as usize]).collect();
        let part = Mesh { nodes, node_tags, blocks, ..Mesh::default() };
        let in_part = |n: u32| used[n as usize].then(|| number(n));
        let bore = ElasticBore::of(gear).map(|bore| bore.in_part(&part, in_part));
        let by_means = gear.bore_coupling() == BoreCoupling::Distributing;
        let seat = by_means.then(|| faces_in_part(&gear.bore().faces, &part, in_part));
        Some(Self::new((teeth, gear.numbering_sign()), part, (held, bore, seat), cuts, places))
    }

    fn new(
        (teeth, way): (u32, f64),
        mesh: Mesh,
        (held, bore, seat): (Vec<u32>, Option<ElasticBore>, Option<Vec<Face>>),
        cuts: Vec<[u32; 2]>,
        places: Vec<Origin>,
    ) -> Self {
        let count = mesh.nodes.len();
        let mut numbers = vec![NOWHERE; count * teeth as usize];
        for (place, number) in places.iter().zip(0..) {
            numbers[place.copy as usize * count + place.node as usize] = number;
        }
        Self { teeth, way, mesh, held, bore, seat, cuts, places, numbers }
    }

    /// The larger mesh's node at a place.
    pub(crate) fn node_at(&self, place: Origin) -> Option<u32> {
        let at = place.copy as usize * self.mesh.nodes.len() + place.node as usize;
        self.numbers.get(at).copied().filter(|&n| n != NOWHERE)
    }

    /// The right cut's node on which a left cut's node falls.
    pub(crate) fn right_of(&self, left: u32) -> Option<u32> {
        self.cuts.binary_search_by_key(&left, |c| c[0]).ok().map(|at| self.cuts[at][1])
    }

    /// Free degrees of freedom of the whole gear.
    pub(crate) fn free_count(&self) -> usize {
        let right_free = self.cuts.iter().filter(|c| self.held.binary_search(&c[1]).is_err()).count();
        3 * (self.mesh.nodes.len() - self.held.len() - right_free) * self.teeth as usize
    }
}

/// Cycles of a permutation; `None` unless all have that length.
fn orbits(images: &[u32], length: u32) -> Option<Vec<Vec<u32>>> {
    let mut seen = vec![false; images.len()];
    let mut all = Vec::with_capacity(images.len() / length.max(1) as usize);
    for first in 0..images.len() as u32 {
        if seen[first as usize] {
            continue;
        }
        let mut orbit = Vec::with_capacity(length as usize);
        let mut at = first;
        while !std::mem::replace(&mut seen[at as usize], true) {
            orbit.push(at);
            at = images[at as usize];
        }
        if orbit.len() != length as usize {
            return None;
        }
        all.push(orbit);
    }
    Some(all)
}

/// Where tooth 0 is: angle = middle + twist z.
struct CentreLine {
    middle: f64,
    twist: f64,
    pitch: f64,
}

impl CentreLine {
    /// Fitted to the flank nodes of tooth 0: it only chooses elements, so a parabola along the profile is near enough.
    fn of_tooth_0(gear: &MeshedGear) -> Option<Self> {
        let pitch = gear.pitches_on(1);
        let nodes = &gear.mesh().nodes;
        let flanks = [Side::Left, Side::Right].map(|side| gear.flank(0, side).map(face_nodes));
        let [Some(left), Some(right)] = flanks else { return None };
        let [x, y, _] = nodes[*left.first()? as usize];
        let reference = y.atan2(x);
        let points = |flank: &[u32]| -> Vec<[f64; 3]> {
            let polar = flank.iter().map(|&n| {
                let [x, y, z] = nodes[n as usize];
                [x.hypot(y), reference + wrapped(y.atan2(x) - reference), z]
            });
            polar.collect()
        };
        let flanks = [points(&left), points(&right)];
        let all = flanks.iter().flatten();
        let [low, high] = all.fold([f64::INFINITY, 0.0], |[a, b], p| [p[0].min(a), p[0].max(b)]);
        let (radius, half) = (0.5 * (low + high), (0.5 * (high - low)).max(f64::MIN_POSITIVE));
        let width = nodes.iter().fold(f64::MIN_POSITIVE, |m, p| m.max(p[2].abs()));
        let mut fits = [[0.0; 2]; 2];
        for (fit, points) in fits.iter_mut().zip(&flanks) {
            let a = DMatrix::from_fn(points.len(), 4, |i, j| {
                let [r, _, z] = points[i];
                [1.0, z / width, (r - radius) / half, ((r - radius) / half).powi(2)][j]
            });
            let b = DVector::from_iterator(points.len(), points.iter().map(|p| p[1]));
            let x = a.svd(true, true).solve(&b, 1e-12).ok()?;
            *fit = [x[0], x[1] / width];
        }
        let mean = |k: usize| 0.5 * (fits[0][k] + fits[1][k]);
        Some(Self { middle: mean(0), twist: mean(1), pitch })
    }

    /// How far the middle of an element is from the centre line, pitches.
    fn pitches_from(&self, mesh: &Mesh, element: &[u32]) -> f64 {
        let mut sum = [0.0; 3];
        for &n in element {
            sum.iter_mut().zip(mesh.nodes[n as usize]).for_each(|(s, x)| *s += x / element.len() as f64);
        }
        wrapped(sum[1].atan2(sum[0]) - self.middle - self.twist * sum[2]) / self.pitch
    }
}

/// An angle within half a turn.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
