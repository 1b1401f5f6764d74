//! Entities, nodes and elements of format 4.1: one block per entity, groups stored with the entity.

use std::collections::BTreeMap;

use super::cursor::Cursor;
use super::error::{MshError, MshProblem};
use super::raw::{Owner, Raw, RawBlock, RawNodes, Shape};

/// Physical tags by (dimension, tag) of an entity.
type Entities = BTreeMap<(i64, i64), Vec<i64>>;

/// `$Entities`, or `$PartitionedEntities`, where the groups of a partitioned mesh stand.
pub(super) fn entities(c: &mut Cursor, partitioned: bool, all: &mut Entities) -> Result<(), MshError> {
    if partitioned {
        c.record_start();
        c.size("the number of partitions")?;
        c.record_end()?;
        c.record_start();
        let declared = c.size("the number of ghost entities")?;
        let ghosts = c.check_room("ghost entities", declared, if c.binary { 8 } else { 4 })?;
        c.record_end()?;
        for _ in 0..ghosts {
            c.record_start();
            c.int("the tag of a ghost entity")?;
            c.int("the partition of a ghost entity")?;
            c.record_end()?;
        }
    }
    c.record_start();
    let mut counts = [0; 4];
    for (count, what) in counts.iter_mut().zip(["points", "curves", "surfaces", "volumes"]) {
        *count = c.size(&format!("the number of {what}"))?;
    }
    c.record_end()?;
    for (dimension, declared) in (0_i64..).zip(counts) {
        // Tag, 3 or 6 coordinates, number of groups; boundary too above points.
        let least = match (c.binary, dimension) {
            (true, 0) => 4 + 3 * 8 + 8,
            (true, _) => 4 + 6 * 8 + 8 + 8,
            (false, 0) => 2 * 5,
            (false, _) => 2 * 9,
        };
        let count = c.check_room("entities", declared, least)?;
        for _ in 0..count {
            let (tag, groups) = entity(c, dimension, partitioned)?;
            all.insert((dimension, tag), groups);
        }
    }
    Ok(())
}

/// One entity: its tag and its physical tags. What bounds it is of no use here.
fn entity(c: &mut Cursor, dimension: i64, partitioned: bool) -> Result<(i64, Vec<i64>), MshError> {
    c.record_start();
    let tag = c.int("the tag of an entity")?;
    if partitioned {
        c.int("the dimension of the parent entity")?;
        c.int("the tag of the parent entity")?;
        list(c, "partitions of an entity")?;
    }
    for _ in 0..(if dimension == 0 { 3 } else { 6 }) {
        c.real("a coordinate of an entity")?;
    }
    let groups = list(c, "physical groups of an entity")?;
    if dimension > 0 {
        list(c, "bounding entities of an entity")?;
    }
    c.record_end()?;
    Ok((tag, groups))
}

/// A counted list of tags.
fn list(c: &mut Cursor, what: &'static str) -> Result<Vec<i64>, MshError> {
    let declared = c.size(&format!("the number of {what}"))?;
    let count = c.check_room(what, declared, if c.binary { 4 } else { 2 })?;
    (0..count).map(|_| c.int("a tag")).collect()
}

/// Numbers of blocks and of things in them, smallest and largest tag.
fn totals(c: &mut Cursor) -> Result<(u64, u64), MshError> {
    c.record_start();
    let blocks = c.size("the number of blocks")?;
    let total = c.size("the total number")?;
    // Other writers give wrong extremes, and nothing here needs them.
    c.size("the smallest tag")?;
    c.size("the largest tag")?;
    c.record_end()?;
    Ok((blocks, total))
}

/// `$Nodes`: blocks of one entity; in each all tags, then all positions.
pub(super) fn nodes(c: &mut Cursor) -> Result<RawNodes, MshError> {
    let start = c.offset();
    let (blocks, total) = totals(c)?;
    let blocks = c.check_room("blocks of nodes", blocks, if c.binary { 20 } else { 8 })?;
    let room = c.check_room("nodes", total, if c.binary { 32 } else { 8 })?;
    let mut nodes = RawNodes::with_capacity(room);
    for _ in 0..blocks {
        c.record_start();
        let dimension = c.int("the dimension of an entity")?;
        c.int("the tag of an entity")?;
        let parametric = c.int("0 or 1 (parametric nodes)")? != 0;
        let declared = c.size("the number of nodes of a block")?;
        let count = c.check_room("nodes", declared, if c.binary { 32 } else { 8 })?;
        c.record_end()?;
        let first = nodes.tags.len();
        for _ in 0..count {
            c.record_start();
            nodes.tags.push(c.size("a node tag")?);
        }
        if count > 0 {
            c.record_end()?;
        }
        let parameters = if parametric { dimension.clamp(0, 3) } else { 0 };
        for i in 0..count {
            c.record_start();
            let place = c.offset();
            let position = [c.real("coordinate x")?, c.real("coordinate y")?, c.real("coordinate z")?];
            for _ in 0..parameters {
                c.real("a parameter of a node")?;
            }
            if let Some(&value) = position.iter().find(|x| !x.is_finite()) {
                let node = nodes.tags[first + i];
                return Err(c.error_at(place, MshProblem::NotFinite { node, value }));
            }
            nodes.positions.push(position);
            nodes.places.push(place);
            c.record_end()?;
        }
    }
    let found = nodes.tags.len() as u64;
    if found != total {
        return Err(c.error_at(start, MshProblem::WrongTotal { what: "nodes", declared: total, found }));
    }
    Ok(nodes)
}

/// `$Elements`: blocks of one entity and one type; in each tag and nodes of every element.
pub(super) fn elements(c: &mut Cursor, raw: &mut Raw) -> Result<(), MshError> {
    let start = c.offset();
    let (blocks, total) = totals(c)?;
    let blocks = c.check_room("blocks of elements", blocks, if c.binary { 20 } else { 8 })?;
    let mut found = 0;
    for _ in 0..blocks {
        c.record_start();
        let place = c.offset();
        let dimension = c.int("the dimension of an entity")?;
        let entity = c.int("the tag of an entity")?;
        let code = c.int("an element type")?;
        let shape = Shape::of_type(code, c).map_err(|e| c.error_at(place, e.problem))?;
        let declared = c.size("the number of elements of a block")?;
        let numbers = 1 + shape.node_count();
        let count = c.check_room("elements", declared, if c.binary { 8 } else { 2 } * numbers)?;
        c.record_end()?;
        let owner = Owner::Entity(dimension, entity);
        let mut block = RawBlock::with_capacity(shape, owner, count);
        for _ in 0..count {
            c.record_start();
            block.places.push(c.offset());
            block.tags.push(c.size("an element tag")?);
            for _ in 1..numbers {
                block.nodes.push(c.size("a node tag")?);
            }
            c.record_end()?;
        }
        found += declared;
        if matches!(&raw.entities, Some(all) if count > 0 && !all.contains_key(&(dimension, entity))) {
            let problem = MshProblem::UnknownEntity { dimension, tag: entity };
            return Err(c.error_at(place, problem));
        }
        raw.blocks.push(block);
    }
    if found != total {
        return Err(c.error_at(start, MshProblem::WrongTotal { what: "elements", declared: total, found }));
    }
    Ok(())
}
