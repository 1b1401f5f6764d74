//! Nodes and elements of format 2.2: one record per item, groups stored with each element.

use std::collections::BTreeMap;

use super::cursor::Cursor;
use super::error::{MshError, MshProblem};
use super::raw::{Owner, Raw, RawBlock, RawNodes, Shape};

/// `$Nodes` or `$ParametricNodes`: a count in text, then tag and position of each.
/// Parametric nodes bear dimension and tag of their entity and as many parameters after that.
pub(super) fn nodes(c: &mut Cursor, parametric: bool) -> Result<RawNodes, MshError> {
    let declared = count(c, "the number of nodes")?;
    let count = c.check_room("nodes", declared, if c.binary { 28 } else { 8 })?;
    let mut nodes = RawNodes::with_capacity(count);
    for _ in 0..count {
        c.record_start();
        let place = c.offset();
        let tag = c.natural("a node tag")?;
        let position = [c.real("coordinate x")?, c.real("coordinate y")?, c.real("coordinate z")?];
        nodes.push(tag, position, place, c)?;
        if parametric {
            let dimension = c.int("the dimension of an entity")?;
            c.int("the tag of an entity")?;
            for _ in 0..(if (1..=2).contains(&dimension) { dimension } else { 0 }) {
                c.real("a parameter of a node")?;
            }
        }
        c.record_end()?;
    }
    Ok(nodes)
}

/// A count: text on a line of its own, also in a binary file.
fn count(c: &mut Cursor, expected: &str) -> Result<u64, MshError> {
    c.skip_space();
    let count = c.text(expected)?;
    c.line_end()?;
    Ok(count)
}

/// `$Elements`: a count in text, then type, tags and nodes of each; in binary, runs of one type.
pub(super) fn elements(c: &mut Cursor, raw: &mut Raw) -> Result<(), MshError> {
    let declared = count(c, "the number of elements")?;
    let total = c.check_room("elements", declared, if c.binary { 8 } else { 6 })?;
    let mut sorter = Sorter { blocks: &mut raw.blocks, index: BTreeMap::new() };
    let mut done = 0;
    while done < total {
        if c.binary {
            done += run(c, &mut sorter, (total - done) as u64)?;
        } else {
            line(c, &mut sorter)?;
            done += 1;
        }
    }
    Ok(())
}

/// A run of a binary file: type, number of elements and number of tags, then the elements.
fn run(c: &mut Cursor, sorter: &mut Sorter, left: u64) -> Result<usize, MshError> {
    let start = c.offset();
    let code = c.int("an element type")?;
    let shape = Shape::of_type(code, c).map_err(|e| c.error_at(start, e.problem))?;
    let run = c.natural("the number of elements of a run")?;
    let tags = c.natural("the number of tags")?;
    if run == 0 || run > left {
        let expected = format!("a run of 1 to {left} elements");
        return Err(c.error_at(start, MshProblem::Syntax { expected, found: run.to_string() }));
    }
    let tags = c.check_room("tags of an element", tags, 4)?;
    let run = c.check_room("elements", run, 4 * (1 + tags + shape.node_count()))?;
    for _ in 0..run {
        let place = c.offset();
        let tag = c.natural("an element tag")?;
        body(c, sorter, shape, tags, tag, place)?;
    }
    Ok(run)
}

/// A line of a text file: tag, type, number of tags, tags, nodes.
fn line(c: &mut Cursor, sorter: &mut Sorter) -> Result<(), MshError> {
    c.record_start();
    let place = c.offset();
    let tag = c.natural("an element tag")?;
    let code = c.int("an element type")?;
    let shape = Shape::of_type(code, c)?;
    let tags = c.natural("the number of tags")?;
    let tags = c.check_room("tags of an element", tags, 2)?;
    body(c, sorter, shape, tags, tag, place)?;
    c.record_end()
}

/// Tags and nodes of one element. The first tag is the physical group, 0 for none.
fn body(
    c: &mut Cursor,
    sorter: &mut Sorter,
    shape: Shape,
    tags: usize,
    tag: u64,
    place: usize,
) -> Result<(), MshError> {
    let mut group = 0;
    for i in 0..tags {
        let value = c.int("a tag of the element")?;
        if i == 0 {
            group = value;
        }
    }
    let block = sorter.block(shape, group);
    c.naturals(shape.node_count(), "a node tag", &mut block.nodes)?;
    block.tags.push(tag);
    block.places.push(place);
    Ok(())
}

/// Gathers elements into one block a (type, group), in file order.
struct Sorter<'a> {
    blocks: &'a mut Vec<RawBlock>,
    index: BTreeMap<(Shape, i64), usize>,
}

impl Sorter<'_> {
    fn block(&mut self, shape: Shape, group: i64) -> &mut RawBlock {
        let at = *self.index.entry((shape, group)).or_insert_with(|| {
            self.blocks.push(RawBlock::with_capacity(shape, Owner::Group(group), 0));
            self.blocks.len() - 1
        });
        &mut self.blocks[at]
    }
}
