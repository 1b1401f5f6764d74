//! Structure of the ParaView files: every array where its offset says and as long as its header says.

use std::io::Read;

use analysis::results::GearPattern;
use export::paraview::{Encoding, Field, PvdEntry, write_pattern_vtu, write_pvd, write_surface, write_vtu};
use geometry::{Flank, Side};
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

fn floats(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(8).map(|c| f64::from_le_bytes(c.try_into().unwrap())).collect()
}

/// A surface is made of quadrilaterals (VTK's type 9), and a field must fit it as well.
#[test]
fn a_surface_is_made_of_quads() {
    let nodes: Vec<[f64; 3]> = (0..6).map(|k| [f64::from(k % 3), f64::from(k / 3), 0.0]).collect();
    let quads = [[0, 1, 4, 3], [1, 2, 5, 4]];
    let heights = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
    let mut out = Vec::new();
    let field = Field { name: "height_mm", components: 1, values: &heights };
    write_surface(&mut out, &nodes, &quads, &[field], Encoding::Zlib).unwrap();
    let [height, points, connectivity, offsets, types] = <[Vec<u8>; 5]>::try_from(arrays(&out)).unwrap();
    assert_eq!((floats(&height), floats(&points).len()), (heights.to_vec(), 18));
    assert_eq!(integers(&connectivity), [0, 1, 4, 3, 1, 2, 5, 4]);
    assert_eq!((integers(&offsets), types), (vec![4, 8], vec![9, 9]));
    let short = Field { values: &heights[1..], ..field };
    assert!(write_surface(&mut Vec::new(), &nodes, &quads, &[short], Encoding::Raw).is_err());
}

/// A pattern in space: every node at the diameter it says, from end face to end face; no quad folded or without area.
#[test]
fn a_pattern_covers_the_flank() {
    let flank = Flank {
        side: Side::Left,
        base_radius: 45.0,
        base_half_angle: 0.07,
        twist: 0.007,
        base_helix_angle: (0.007_f64 * 45.0).atan(),
        centre_angle: 0.0,
        roll_form: 0.2,
        roll_tip: 0.5,
        half_width: 10.0,
    };
    let grid = study::FlankPattern::new([0.2, 0.5], 8, vec![-7.5, -2.5, 2.5, 7.5]).unwrap();
    let pattern = GearPattern { name: "wheel", flank, centre: [95.0, 0.0], face: [-10.0, 10.0], grid };
    let mut out = Vec::new();
    write_pattern_vtu(&pattern, &mut out).unwrap();
    let arrays = arrays(&out);
    let (diameter, points, connectivity) = (floats(&arrays[3]), floats(&arrays[4]), integers(&arrays[5]));
    assert_eq!((diameter.len(), points.len(), connectivity.len()), (6 * 9, 3 * 6 * 9, 4 * 5 * 8));
    let node = |k: usize| nalgebra::Vector3::from_column_slice(&points[3 * k..3 * k + 3]);
    for (k, d) in diameter.iter().enumerate() {
        let p = node(k);
        assert!((2.0 * (p.x - 95.0).hypot(p.y) - d).abs() < 1e-9, "node {k} lies on another diameter than {d} mm");
    }
    assert_eq!((node(0).z, node(53).z), (-10.0, 10.0));
    for quad in connectivity.chunks_exact(4) {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| node(quad[i] as usize));
        let (one, other) = ((b - a).cross(&(d - a)), (d - c).cross(&(b - c)));
        assert!(one.norm() > 0.1 && one.dot(&other) > 0.9 * one.norm() * other.norm(), "{quad:?}: {one} {other}");
    }
}

/// A wider gear's flank is there from end face to end face; pressed is the common face alone, to its very ends.
#[test]
fn beyond_the_common_face_nothing_is_pressed() {
    let flank = Flank {
        side: Side::Left,
        base_radius: 45.0,
        base_half_angle: 0.07,
        twist: 0.007,
        base_helix_angle: (0.007_f64 * 45.0).atan(),
        centre_angle: 0.0,
        roll_form: 0.2,
        roll_tip: 0.5,
        half_width: 10.0,
    };
    let mut grid = study::FlankPattern::new([0.2, 0.5], 8, vec![-1.5, 1.0, 3.5]).unwrap();
    let touches =
        [-1.5, 1.0, 3.5].map(|z| study::Touch { z, engagement: 0.0, roll: 0.35, pressure: 700.0, line_load: 200.0 });
    grid.press(&touches, 0.1).unwrap();
    let pattern = GearPattern { name: "wheel", flank, centre: [95.0, 2.0], face: [-2.75, 4.75], grid };
    let mut out = Vec::new();
    write_pattern_vtu(&pattern, &mut out).unwrap();
    let arrays = arrays(&out);
    let (pressure, points, connectivity) = (floats(&arrays[0]), floats(&arrays[4]), integers(&arrays[5]));
    let height = |node: usize| points[3 * node + 2] - 2.0;
    let heights: Vec<f64> = (0..pressure.len()).step_by(9).map(height).collect();
    assert_eq!(heights, [-10.0, -2.75, -2.75, -1.5, 1.0, 3.5, 4.75, 4.75, 10.0]);
    for quad in connectivity.chunks_exact(4) {
        let nodes = || quad.iter().map(|&n| n as usize);
        let middle = nodes().map(height).sum::<f64>() / 4.0;
        let pressed = nodes().any(|n| pressure[n] > 0.0);
        assert!(!pressed || (middle > -2.75 && middle < 4.75), "pressed at {middle} mm");
    }
    assert_eq!(connectivity.len(), 4 * 6 * 8, "quads between rows at one height");
    for (station, wanted) in [(0, -2.75), (1, -0.25), (3, 4.75)] {
        let edge = pattern.strip_edge(station);
        assert!((edge - wanted).abs() < 1e-12, "edge {station} at {edge} mm");
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
