//! `.pvd`: which ParaView file belongs to which time and gear.

use std::fmt::Write;

/// One file of a series.
#[derive(Debug, Clone, PartialEq)]
pub struct PvdEntry {
    /// Time, s.
    pub time_s: f64,
    /// 0: pinion, 1: wheel.
    pub part: usize,
    /// File name, relative to the `.pvd`.
    pub file: String,
}

/// The collection as XML.
pub fn write_pvd(entries: &[PvdEntry]) -> String {
    let mut xml = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n",
    );
    for PvdEntry { time_s, part, file } in entries {
        // Writing to a String cannot fail.
        let _ = writeln!(xml, "    <DataSet timestep=\"{time_s:e}\" group=\"\" part=\"{part}\" file=\"{file}\"/>");
    }
    xml.push_str("  </Collection>\n</VTKFile>\n");
    xml
}
