//! Structure of the ParaView files: every array where its offset says and as long as its header says.

use std::io::Read;

use ale_gear::output::{Encoding, Field, PvdEntry, write_pvd, write_vtu};
use mesh::{ElementBlock, ElementKind};

const KINDS: [ElementKind; 7] = [
    ElementKind::Hex8,
    ElementKind::Hex20,
    ElementKind::Hex27,
    ElementKind::Tet4,
    ElementKind::Tet10,
    ElementKind::Wedge6,
    ElementKind::Wedge15,
];

fn file(encoding: Encoding) -> Vec<u8> {
    let nodes: Vec<[f64; 3]> = (0..27).map(|k| [f64::from(k), 0.5, -1.0]).collect();
    let block = |&kind: &ElementKind| ElementBlock {
        kind,
        connectivity: (0..kind.node_count() as u32).collect(),
        tags: vec![1],
    };
    let blocks: Vec<ElementBlock> = KINDS.iter().map(block).collect();
    let displacement: Vec<f64> = (0..81).map(f64::from).collect();
    let point = Field { name: "displacement", components: 3, values: &displacement };
    let cell = Field { name: "stress", components: 1, values: &[7.0; 7] };
    let mut out = Vec::new();
    write_vtu(&mut out, &nodes, &blocks, &[point], &[cell], encoding).unwrap();
    out
}

/// The arrays of a file in the order of their offsets.
fn arrays(file: &[u8]) -> Vec<Vec<u8>> {
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let start = file.windows(marker.len()).position(|w| w == marker).unwrap();
    let (xml, data) = (std::str::from_utf8(&file[..start]).unwrap(), &file[start + marker.len()..]);
    let zlib = xml.contains("vtkZLibDataCompressor");
    let number = |at: usize| u64::from_le_bytes(data[at..at + 8].try_into().unwrap()) as usize;
    xml.split("offset=\"")
        .skip(1)
        .map(|rest| {
            let offset: usize = rest.split('"').next().unwrap().parse().unwrap();
            if !zlib {
                return data[offset + 8..offset + 8 + number(offset)].to_vec();
            }
            let (blocks, size, last) = (number(offset), number(offset + 8), number(offset + 16));
            let mut at = offset + 24 + 8 * blocks;
            let mut all = Vec::new();
            for k in 0..blocks {
                let length = number(offset + 24 + 8 * k);
                flate2::read::ZlibDecoder::new(&data[at..at + length]).read_to_end(&mut all).unwrap();
                at += length;
            }
            let want = if last == 0 { blocks * size } else { (blocks - 1) * size + last };
            assert_eq!(all.len(), want);
            all
        })
        .collect()
}

fn integers(bytes: &[u8]) -> Vec<i64> {
    bytes.chunks_exact(8).map(|c| i64::from_le_bytes(c.try_into().unwrap())).collect()
}

/// Both encodings hold the same arrays: fields, points, cells.
#[test]
fn raw_and_zlib_say_the_same() {
    let raw = arrays(&file(Encoding::Raw));
    assert_eq!(raw, arrays(&file(Encoding::Zlib)));
    let [displacement, stress, points, connectivity, offsets, types] = raw.as_slice() else { panic!("{}", raw.len()) };
    assert_eq!((displacement.len(), stress.len(), points.len()), (27 * 24, 7 * 8, 27 * 24));
    assert_eq!(integers(offsets), [8, 28, 55, 59, 69, 75, 90]);
    assert_eq!(types.as_slice(), [12, 25, 29, 10, 24, 13, 26]);
    assert_eq!(connectivity.len(), 90 * 8);
}

/// Every element keeps all of its nodes, corners first and in place; the edge nodes of a hex20 follow VTK:
/// bottom ring, top ring, uprights.
#[test]
fn nodes_are_renumbered_to_vtk() {
    let raw = arrays(&file(Encoding::Raw));
    let (connectivity, offsets) = (integers(&raw[3]), integers(&raw[4]));
    let mut start = 0;
    for (kind, end) in KINDS.iter().zip(offsets) {
        let mut element = connectivity[start..end as usize].to_vec();
        start = end as usize;
        if *kind == ElementKind::Hex20 {
            assert_eq!(element[8..], [8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]);
        }
        element.sort_unstable();
        assert_eq!(element, (0..kind.node_count() as i64).collect::<Vec<_>>(), "{kind:?}");
    }
}

#[test]
fn a_field_of_another_length_is_refused() {
    let field = Field { name: "pressure", components: 1, values: &[0.0; 3] };
    let error = write_vtu(&mut Vec::new(), &[[0.0; 3]; 4], &[], &[field], &[], Encoding::Raw).unwrap_err();
    assert_eq!(error.to_string(), "field pressure: 3 values for 4 x 1");
}

#[test]
fn a_collection_names_time_part_and_file() {
    let entry = PvdEntry { time_s: 0.25, part: 1, file: "wheel_0001.vtu".into() };
    let line = "<DataSet timestep=\"2.5e-1\" group=\"\" part=\"1\" file=\"wheel_0001.vtu\"/>";
    assert!(write_pvd(&[entry]).contains(line));
}
