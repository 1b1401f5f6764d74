//! `.vtu`: a mesh or a surface with fields for ParaView, appended binary data, raw or zlib.

use std::io::{self, Write};

use flate2::Compression;
use flate2::write::ZlibEncoder;
use mesh::{ElementBlock, ElementKind};

/// How the appended data are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// Uncompressed: fastest to write.
    Raw,
    /// Deflated: about half the size.
    Zlib,
}

/// Values at every node, or in every element.
#[derive(Debug, Clone, Copy)]
pub struct Field<'a> {
    /// Name in ParaView.
    pub name: &'a str,
    /// Numbers a node or element: 1, 3 (a vector) or 6 (xx, yy, zz, xy, yz, xz).
    pub components: usize,
    /// All numbers, node by node.
    pub values: &'a [f64],
}

/// Block size of compressed arrays, bytes.
const BLOCK: usize = 1 << 15;

/// `vtk[k] = gmsh[PERMUTATION[k]]`; `None` where both orders agree.
fn permutation(kind: ElementKind) -> Option<&'static [usize]> {
    match kind {
        ElementKind::Hex20 => Some(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]),
        ElementKind::Hex27 => {
            Some(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26])
        }
        ElementKind::Tet10 => Some(&[0, 1, 2, 3, 4, 5, 6, 7, 9, 8]),
        ElementKind::Wedge15 => Some(&[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11]),
        ElementKind::Hex8 | ElementKind::Tet4 | ElementKind::Wedge6 => None,
    }
}

fn cell_type(kind: ElementKind) -> u8 {
    match kind {
        ElementKind::Tet4 => 10,
        ElementKind::Hex8 => 12,
        ElementKind::Wedge6 => 13,
        ElementKind::Tet10 => 24,
        ElementKind::Hex20 => 25,
        ElementKind::Wedge15 => 26,
        ElementKind::Hex27 => 29,
    }
}

/// VTK's number of the quadrilateral.
const QUAD: u8 = 9;

/// Cells as VTK lists them.
#[derive(Default)]
struct Cells {
    connectivity: Vec<i64>,
    offsets: Vec<i64>,
    types: Vec<u8>,
}

struct Array {
    attributes: String,
    bytes: Vec<u8>,
}

fn floats(attributes: String, values: impl Iterator<Item = f64>) -> Array {
    Array { attributes: format!("type=\"Float64\" {attributes}"), bytes: values.flat_map(f64::to_le_bytes).collect() }
}

fn integers(name: &str, values: impl Iterator<Item = i64>) -> Array {
    Array { attributes: format!("type=\"Int64\" Name=\"{name}\""), bytes: values.flat_map(i64::to_le_bytes).collect() }
}

/// Writes one unstructured grid.
///
/// `nodes` in mm, `blocks` in Gmsh node order (turned into VTK's here); `point_fields` have as many entries
/// as there are nodes, `cell_fields` as there are elements, in the order of the blocks.
///
/// # Errors
/// [`io::ErrorKind::InvalidInput`] when a field has another number of values than the grid asks for; else what `out`
/// reports.
pub fn write_vtu(
    out: &mut impl Write,
    nodes: &[[f64; 3]],
    blocks: &[ElementBlock],
    point_fields: &[Field<'_>],
    cell_fields: &[Field<'_>],
    encoding: Encoding,
) -> io::Result<()> {
    write_grid(out, nodes, &Cells::of_blocks(blocks), point_fields, cell_fields, encoding)
}

/// Writes a surface of quads, each with its corners in turn; `nodes` in mm, `point_fields` as in [`write_vtu`].
///
/// # Errors
/// As [`write_vtu`].
pub fn write_surface(
    out: &mut impl Write,
    nodes: &[[f64; 3]],
    quads: &[[u32; 4]],
    point_fields: &[Field<'_>],
    encoding: Encoding,
) -> io::Result<()> {
    write_grid(out, nodes, &Cells::of_quads(quads), point_fields, &[], encoding)
}

fn write_grid(
    out: &mut impl Write,
    nodes: &[[f64; 3]],
    grid: &Cells,
    point_fields: &[Field<'_>],
    cell_fields: &[Field<'_>],
    encoding: Encoding,
) -> io::Result<()> {
    let cells = grid.types.len();
    for (fields, count) in [(point_fields, nodes.len()), (cell_fields, cells)] {
        if let Some(f) = fields.iter().find(|f| f.values.len() != count * f.components) {
            let message = format!("field {}: {} values for {count} x {}", f.name, f.values.len(), f.components);
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
    }
    let field = |f: &Field<'_>| {
        floats(format!("Name=\"{}\" NumberOfComponents=\"{}\"", f.name, f.components), f.values.iter().copied())
    };
    let sections = [
        ("PointData", point_fields.iter().map(field).collect()),
        ("CellData", cell_fields.iter().map(field).collect()),
        ("Points", vec![floats("NumberOfComponents=\"3\"".into(), nodes.iter().flatten().copied())]),
        ("Cells", grid.arrays()),
    ];

    let compressor = match encoding {
        Encoding::Raw => "",
        Encoding::Zlib => " compressor=\"vtkZLibDataCompressor\"",
    };
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(
        out,
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"{compressor}>"
    )?;
    writeln!(out, "<UnstructuredGrid>")?;
    writeln!(out, "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{cells}\">", nodes.len())?;
    let mut appended = Vec::new();
    for (name, arrays) in sections {
        writeln!(out, "<{name}>")?;
        for Array { attributes, bytes } in arrays {
            writeln!(out, "<DataArray {attributes} format=\"appended\" offset=\"{}\"/>", appended.len())?;
            append(&mut appended, &bytes, encoding)?;
        }
        writeln!(out, "</{name}>")?;
    }
    write!(out, "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_")?;
    out.write_all(&appended)?;
    write!(out, "\n</AppendedData>\n</VTKFile>\n")
}

impl Cells {
    fn of_blocks(blocks: &[ElementBlock]) -> Self {
        let mut cells = Self::default();
        for block in blocks {
            let order = permutation(block.kind);
            for element in block.elements() {
                match order {
                    None => cells.push(cell_type(block.kind), element.iter().copied()),
                    Some(order) => cells.push(cell_type(block.kind), order.iter().map(|&k| element[k])),
                }
            }
        }
        cells
    }

    fn of_quads(quads: &[[u32; 4]]) -> Self {
        let mut cells = Self::default();
        quads.iter().for_each(|&quad| cells.push(QUAD, quad));
        cells
    }

    fn push(&mut self, kind: u8, nodes: impl IntoIterator<Item = u32>) {
        self.connectivity.extend(nodes.into_iter().map(i64::from));
        self.offsets.push(self.connectivity.len() as i64);
        self.types.push(kind);
    }

    fn arrays(&self) -> Vec<Array> {
        vec![
            integers("connectivity", self.connectivity.iter().copied()),
            integers("offsets", self.offsets.iter().copied()),
            Array { attributes: "type=\"UInt8\" Name=\"types\"".into(), bytes: self.types.clone() },
        ]
    }
}

/// One array: its header of 64-bit numbers, then its bytes.
fn append(to: &mut Vec<u8>, bytes: &[u8], encoding: Encoding) -> io::Result<()> {
    if encoding == Encoding::Raw {
        to.extend((bytes.len() as u64).to_le_bytes());
        to.extend(bytes);
        return Ok(());
    }
    // Number of blocks, size of a block, size of the last one if it is partial, then each compressed size.
    let mut packed = Vec::new();
    for block in bytes.chunks(BLOCK) {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(block)?;
        packed.push(encoder.finish()?);
    }
    let header = [packed.len() as u64, BLOCK as u64, (bytes.len() % BLOCK) as u64];
    for number in header.into_iter().chain(packed.iter().map(|b| b.len() as u64)) {
        to.extend(number.to_le_bytes());
    }
    to.extend(packed.into_iter().flatten());
    Ok(())
}
