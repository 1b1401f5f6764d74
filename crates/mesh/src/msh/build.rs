//! Makes a model from the content of a file: groups are resolved, duplicate and unused items are dropped, tags are
//! sorted.

use std::collections::{BTreeMap, BTreeSet};

use super::cursor::Cursor;
use super::error::{MshError, MshProblem};
use super::raw::{Owner, Raw, RawBlock, RawNodes, Shape};
use super::unique::first_of_equals;
use crate::{ElementBlock, ElementKind, Face, Mesh, SurfaceGroup};

/// The model in a file. Every flavour of one mesh gives the same model:
/// nodes and elements stand in the order of their tags, faces of a group by kind and tag.
pub(super) fn build(raw: &Raw, cursor: &mut Cursor) -> Result<Mesh, MshError> {
    let default = RawNodes::default();
    let nodes = raw.nodes.as_ref().unwrap_or(&default);
    cursor.section = "$Nodes".into();
    let numbering = Numbering::new(nodes, cursor)?;
    cursor.section = "$Elements".into();

    let (chosen, volumes) = choose_volumes(raw);
    let mut blocks = elements(raw, &chosen, &numbering, cursor)?;
    if blocks.is_empty() {
        let elements = raw.blocks.iter().filter(|b| matches!(b.shape, Shape::Face(_))).map(|b| b.tags.len()).sum();
        return Err(cursor.error(MshProblem::NoVolumes { elements }));
    }

    // Nodes that no volume element uses would make the stiffness matrix singular: keep the others.
    let mut new_number = vec![u32::MAX; nodes.tags.len()];
    for &node in blocks.iter().flat_map(|b| &b.connectivity) {
        new_number[node as usize] = 0;
    }
    let mut mesh = Mesh { volumes, ..Mesh::default() };
    for (sorted, &original) in numbering.order.iter().enumerate() {
        if new_number[sorted] == 0 {
            new_number[sorted] = mesh.nodes.len() as u32;
            mesh.nodes.push(nodes.positions[original as usize]);
            mesh.node_tags.push(nodes.tags[original as usize]);
        }
    }
    for node in blocks.iter_mut().flat_map(|b| &mut b.connectivity) {
        *node = new_number[*node as usize];
    }
    mesh.blocks = blocks;
    mesh.surfaces = surfaces(raw, &numbering, &new_number, cursor)?;
    Ok(mesh)
}

/// Nodes in ascending order of their tags.
struct Numbering {
    tags: Vec<u64>,
    /// Place in the file's list of the node of each rank.
    order: Vec<u32>,
}

impl Numbering {
    fn new(nodes: &RawNodes, cursor: &Cursor) -> Result<Self, MshError> {
        let count = nodes.tags.len() as u64;
        let limit = u64::from(u32::MAX);
        if count >= limit {
            return Err(cursor.error(MshProblem::TooMany { what: "nodes", declared: count, room: limit - 1 }));
        }
        let mut order: Vec<u32> = (0..count as u32).collect();
        if !nodes.tags.is_sorted() {
            order.sort_by_key(|&i| nodes.tags[i as usize]);
        }
        let tags: Vec<u64> = order.iter().map(|&i| nodes.tags[i as usize]).collect();
        if let Some(twice) = tags.windows(2).position(|w| w[0] == w[1]) {
            let place = nodes.places[order[twice + 1] as usize];
            return Err(cursor.error_at(place, MshProblem::RepeatedNode { tag: tags[twice] }));
        }
        Ok(Self { tags, order })
    }

    /// Rank of the node with that tag.
    fn rank(&self, tag: u64) -> Option<u32> {
        // Tags mostly count up by one; then the rank is known without a search.
        let guess = usize::try_from(tag.checked_sub(*self.tags.first()?)?).ok()?;
        if self.tags.get(guess) == Some(&tag) {
            return Some(guess as u32);
        }
        self.tags.binary_search(&tag).ok().map(|i| i as u32)
    }

    /// Ranks of the nodes of element `i` of a block, appended to `into`.
    fn ranks(&self, block: &RawBlock, i: usize, into: &mut Vec<u32>, cursor: &Cursor) -> Result<(), MshError> {
        let count = block.shape.node_count();
        for &node in &block.nodes[i * count..(i + 1) * count] {
            match self.rank(node) {
                Some(rank) => into.push(rank),
                None => {
                    let problem = MshProblem::UnknownNode { element: block.tags[i], node };
                    return Err(cursor.error_at(block.places[i], problem));
                }
            }
        }
        Ok(())
    }
}

/// Physical tags of a block. A negative tag means the opposite orientation.
fn groups<'a>(raw: &'a Raw, block: &'a RawBlock) -> &'a [i64] {
    match (&block.owner, &raw.entities) {
        (Owner::Group(0), _) | (Owner::Entity(..), None) => &[],
        (Owner::Group(tag), _) => std::slice::from_ref(tag),
        (Owner::Entity(dimension, tag), Some(entities)) => entities.get(&(*dimension, *tag)).map_or(&[], Vec::as_slice),
    }
}

/// Name of a physical group; its tag in digits where the file gives none.
fn name(raw: &Raw, dimension: i64, tag: i64) -> String {
    let tag = tag.saturating_abs();
    raw.names.get(&(dimension, tag)).cloned().unwrap_or_else(|| tag.to_string())
}

/// Which blocks of volume elements belong to the model, and the names of their groups:
/// those in a physical volume, or all where there is none.
fn choose_volumes(raw: &Raw) -> (Vec<usize>, Vec<String>) {
    let is_volume = |b: &RawBlock| matches!(b.shape, Shape::Volume(_)) && !b.tags.is_empty();
    let all: Vec<usize> = (0..raw.blocks.len()).filter(|&i| is_volume(&raw.blocks[i])).collect();
    let grouped: Vec<usize> = all.iter().copied().filter(|&i| !groups(raw, &raw.blocks[i]).is_empty()).collect();
    // Blocks of one entity are in the same groups: each entity once.
    let mut owners: Vec<&RawBlock> = grouped.iter().map(|&i| &raw.blocks[i]).collect();
    owners.sort_unstable_by_key(|b| b.owner);
    owners.dedup_by_key(|b| b.owner);
    let names: BTreeSet<String> =
        owners.into_iter().flat_map(|b| groups(raw, b)).map(|&tag| name(raw, 3, tag)).collect();
    (if grouped.is_empty() { all } else { grouped }, names.into_iter().collect())
}

/// Volume elements by kind in order of their tags, each once: format 2.2 writes an element once
/// a group, every copy with a tag of its own, and a copy left in would double the stiffness.
fn elements(
    raw: &Raw,
    chosen: &[usize],
    numbering: &Numbering,
    cursor: &Cursor,
) -> Result<Vec<ElementBlock>, MshError> {
    let mut by_kind: BTreeMap<ElementKind, Vec<(u64, usize, usize)>> = BTreeMap::new();
    for &b in chosen {
        let block = &raw.blocks[b];
        if let Shape::Volume(kind) = block.shape {
            by_kind.entry(kind).or_default().extend(block.tags.iter().enumerate().map(|(i, &tag)| (tag, b, i)));
        }
    }
    let mut blocks = Vec::new();
    for (kind, mut list) in by_kind {
        list.sort_unstable();
        let mut all = Vec::with_capacity(list.len() * kind.node_count());
        for &(_, b, i) in &list {
            numbering.ranks(&raw.blocks[b], i, &mut all, cursor)?;
        }
        let keep = first_of_equals(&all, kind.node_count());
        let mut block = ElementBlock {
            kind,
            connectivity: Vec::with_capacity(keep.len() * kind.node_count()),
            tags: Vec::with_capacity(keep.len()),
        };
        for i in keep {
            block.tags.push(list[i].0);
            block.connectivity.extend_from_slice(&all[i * kind.node_count()..(i + 1) * kind.node_count()]);
        }
        blocks.push(block);
    }
    Ok(blocks)
}

/// Surface groups in name order. Groups of other bodies are left out as a whole.
fn surfaces(
    raw: &Raw,
    numbering: &Numbering,
    new_number: &[u32],
    cursor: &Cursor,
) -> Result<Vec<SurfaceGroup>, MshError> {
    // A face has a place for each group that it is in: more of them than bytes are no mesh.
    let in_groups: u64 = raw.blocks.iter().map(|b| in_groups(raw, b)).sum();
    let room = cursor.length();
    if in_groups > room {
        return Err(cursor.error(MshProblem::TooMany { what: "faces in groups", declared: in_groups, room }));
    }
    // Faces by group as (kind, tag, block, element), with the sign of the group.
    let mut by_name: BTreeMap<String, Vec<_>> = BTreeMap::new();
    for (b, block) in raw.blocks.iter().enumerate() {
        let Shape::Face(kind) = block.shape else {
            continue;
        };
        for &group in groups(raw, block) {
            // Format 2.2 has turned the faces of a negative group already.
            let turned = group < 0 && matches!(block.owner, Owner::Entity(..));
            let list = by_name.entry(name(raw, 2, group)).or_default();
            list.extend(block.tags.iter().enumerate().map(|(i, &tag)| (kind, tag, b, i, turned)));
        }
    }
    let mut surfaces = Vec::new();
    let mut ranks = Vec::new();
    for (name, mut list) in by_name {
        list.sort_unstable();
        let mut faces = Vec::with_capacity(list.len());
        let mut off_body = None;
        for (kind, tag, b, i, turned) in list {
            let block = &raw.blocks[b];
            ranks.clear();
            numbering.ranks(block, i, &mut ranks, cursor)?;
            if let Some(stray) = ranks.iter().position(|&r| new_number[r as usize] == u32::MAX) {
                let node = block.nodes[i * kind.node_count() + stray];
                off_body.get_or_insert((tag, node, block.places[i]));
                continue;
            }
            ranks.iter_mut().for_each(|r| *r = new_number[*r as usize]);
            let face = Face::new(kind, &ranks);
            faces.push(if turned { face.reversed() } else { face });
        }
        match off_body {
            Some((face, node, place)) if !faces.is_empty() => {
                let problem = MshProblem::FaceOffBody { group: name, face, node };
                return Err(cursor.error_at(place, problem));
            }
            _ => {}
        }
        drop_copies(&mut faces);
        if !faces.is_empty() {
            surfaces.push(SurfaceGroup { name, faces });
        }
    }
    Ok(surfaces)
}

/// Faces of a block, each as often as there are groups that it is in.
fn in_groups(raw: &Raw, block: &RawBlock) -> u64 {
    match block.shape {
        // To look through the groups of an empty block takes time as well.
        Shape::Face(_) => block.tags.len().max(1) as u64 * groups(raw, block).len() as u64,
        _ => 0,
    }
}

/// Leaves each face once, where it stood first.
fn drop_copies(faces: &mut Vec<Face>) {
    let mut seen = BTreeSet::new();
    faces.retain(|face| seen.insert(face.corner_key()));
}
