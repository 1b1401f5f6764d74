//! The sections of a `.msh` file, in any order.

use std::path::Path;

use super::cursor::Cursor;
use super::error::{MshError, MshProblem};
use super::raw::Raw;
use super::{v2, v4};

/// Families of the format that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Version {
    V2,
    V4,
}

/// Reads all sections of use; the cursor is left at the end, for messages about the whole.
pub(super) fn parse<'a>(bytes: &'a [u8], path: &'a Path) -> Result<(Raw, Cursor<'a>), MshError> {
    let mut c = Cursor::new(bytes, path);
    let version = header(&mut c)?;
    let mut raw = Raw::default();
    let mut seen: Vec<String> = Vec::new();
    while let Some(name) = c.open_section()? {
        let known = ["$PhysicalNames", "$Entities", "$PartitionedEntities", "$Nodes", "$ParametricNodes", "$Elements"];
        if !known.contains(&name.as_str()) {
            c.skip_section()?;
            continue;
        }
        if seen.contains(&name) {
            return Err(c.error(MshProblem::RepeatedSection { name }));
        }
        match (name.as_str(), version) {
            ("$PhysicalNames", _) => physical_names(&mut c, &mut raw)?,
            ("$Nodes", Version::V4) => raw.nodes = Some(v4::nodes(&mut c)?),
            ("$Nodes" | "$ParametricNodes", _) => {
                raw.nodes = Some(v2::nodes(&mut c, name == "$ParametricNodes")?);
            }
            ("$Elements", _) => {
                raw.has_elements = true;
                match version {
                    Version::V2 => v2::elements(&mut c, &mut raw)?,
                    Version::V4 => v4::elements(&mut c, &mut raw)?,
                }
            }
            _ => v4::entities(&mut c, name == "$PartitionedEntities", raw.entities.get_or_insert_default())?,
        }
        c.close_section()?;
        seen.push(name);
    }
    c.section = "end of file".into();
    for (present, name) in [(raw.nodes.is_some(), "$Nodes"), (raw.has_elements, "$Elements")] {
        if !present {
            return Err(c.error(MshProblem::NoSection { name }));
        }
    }
    Ok((raw, c))
}

/// `$MeshFormat`: version, text or binary, size of a real; in binary the number 1 as bytes.
fn header(c: &mut Cursor) -> Result<Version, MshError> {
    match c.open_section()? {
        Some(name) if name == "$MeshFormat" => {}
        Some(name) if name == "$NOD" || name == "$PARA" => {
            return Err(c.error(MshProblem::Version { found: "1".into() }));
        }
        _ => {
            return Err(c.error(MshProblem::NoSection { name: "$MeshFormat" }));
        }
    }
    c.skip_space();
    let text: String = c.text("a format version")?;
    let version = match text.as_str() {
        "2" | "2.0" | "2.1" | "2.2" => Version::V2,
        "4.1" => Version::V4,
        _ if text.parse::<f64>().is_ok() => {
            return Err(c.error(MshProblem::Version { found: text }));
        }
        _ => {
            let (expected, found) = ("a format version".into(), format!("`{}`", short(&text)));
            return Err(c.error(MshProblem::Syntax { expected, found }));
        }
    };
    let mode: i64 = c.text("0 (text) or 1 (binary)")?;
    let size: i64 = c.text("8, the size of a real")?;
    if !(0..=1).contains(&mode) || size != 8 {
        let expected = "`0 8` (text) or `1 8` (binary) after the version".into();
        return Err(c.error(MshProblem::Syntax { expected, found: format!("`{mode} {size}`") }));
    }
    c.line_end()?;
    if mode == 1 {
        c.binary = true;
        let start = c.offset();
        match c.int("the number 1 as 4 bytes")? {
            1 => {}
            0x0100_0000 => return Err(c.error_at(start, MshProblem::BigEndian)),
            other => {
                let (expected, found) = ("the number 1 as 4 bytes".into(), other.to_string());
                return Err(c.error_at(start, MshProblem::Syntax { expected, found }));
            }
        }
    }
    c.close_section()?;
    Ok(version)
}

fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

/// `$PhysicalNames`: dimension, tag and name of each group, always in text.
fn physical_names(c: &mut Cursor, raw: &mut Raw) -> Result<(), MshError> {
    c.skip_space();
    let declared = c.text("the number of physical names")?;
    let count = c.check_room("physical names", declared, 6)?;
    c.line_end()?;
    for _ in 0..count {
        c.skip_space();
        let dimension = c.text("the dimension of a group")?;
        let tag = c.text("the tag of a group")?;
        let name = c.quoted("the name of a group in quotes")?;
        c.line_end()?;
        raw.names.insert((dimension, tag), name);
    }
    Ok(())
}
