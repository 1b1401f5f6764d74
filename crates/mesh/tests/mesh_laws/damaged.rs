//! Damaged files: each gives an error that names the section and the place, none a panic.

use crate::common::data;
use mesh::{Mesh, MeshError};
use proptest::prelude::*;

fn text(name: &str) -> String {
    std::fs::read_to_string(data(name)).unwrap()
}

/// The error of a damaged file must contain each of `parts`.
fn refused(bytes: &[u8], parts: &[&str]) {
    let error = match Mesh::parse(bytes, "gear.msh") {
        Ok(mesh) => panic!("read {} elements, expected an error with {parts:?}", mesh.element_count()),
        Err(error) => error,
    };
    let message = error.to_string();
    for part in parts.iter().chain(&["gear.msh: "]) {
        assert!(message.contains(part), "`{message}` lacks `{part}`");
    }
    assert!(matches!(error, MeshError::Msh(_)));
    assert!(error.hint().is_some());
}

/// A file with one place changed.
fn changed(file: &str, from: &str, to: &str) -> Vec<u8> {
    let before = text(file);
    assert!(before.contains(from), "{file} has no `{from}`");
    before.replacen(from, to, 1).into_bytes()
}

#[test]
fn damaged_headers() {
    refused(b"", &["no $MeshFormat section", "line 1"]);
    refused(b"hello", &["line 1", "expected a section such as $Nodes, found `hello`"]);
    refused(b"$NOD\n1\n1 0 0 0\n$ENDNOD\n", &["format version 1 is not supported"]);
    refused(b"$Nodes\n", &["$Nodes", "no $MeshFormat section"]);
    refused(b"$MeshFormat\nx 0 8\n", &["$MeshFormat, line 2", "found `x`"]);
    refused(b"$MeshFormat\n4.1 2 8\n", &["$MeshFormat, line 2", "`2 8`"]);
    refused(b"$MeshFormat\n4.1 0 4\n$EndMeshFormat\n", &["$MeshFormat", "`0 4`"]);
    refused(b"$MeshFormat\n4.1 0 8\n", &["line 3", "expected $EndMeshFormat, found the end of the file"]);
    refused(b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n", &["no $Nodes section"]);
    refused(b"$MeshFormat\n4.1 1 8\n\0\0\0\x01\n$EndMeshFormat\n", &["$MeshFormat, byte 20", "big-endian"]);
    refused(b"$MeshFormat\n4.1 1 8\n\x02\0\0\0\n$EndMeshFormat\n", &["byte 20", "found 2"]);
    refused(b"$MeshFormat\n4.1 1 8\n\x01", &["$MeshFormat", "the end of the file"]);
}

#[test]
fn damaged_nodes() {
    refused(&changed("hex8_a22.msh", "1 0 0 1.3\n", "1 0 nan 1.3\n"), &["$Nodes, line 14", "node 1 is NaN"]);
    refused(&changed("hex8_a22.msh", "1 0 0 1.3\n", "1 0 inf 1.3\n"), &["$Nodes, line 14", "node 1 is inf"]);
    refused(
        &changed("hex8_a22.msh", "1 0 0 1.3\n", "1 0 1.3\n"),
        &["$Nodes, line 14", "coordinate z", "end of the line"],
    );
    refused(&changed("hex8_a22.msh", "1 0 0 1.3\n", "1 0 0 1.3 9\n"), &["$Nodes, line 14", "found `9`"]);
    refused(&changed("hex8_a22.msh", "1 0 0 1.3\n", "1 0 0 1,3\n"), &["$Nodes, line 14", "found `1,3`"]);
    refused(&changed("hex8_a22.msh", "1 0 0 1.3\n", "-1 0 0 1.3\n"), &["$Nodes, line 14", "found `-1`"]);
    refused(&changed("hex8_a22.msh", "1 0 0 1.3\n", "2 0 0 1.3\n"), &["$Nodes", "node 2 is defined twice"]);
    refused(&changed("hex8_a22.msh", "$Nodes\n12", "$Nodes\n11"), &["$Nodes", "expected $EndNodes"]);
    refused(
        &changed("hex8_a22.msh", "$Nodes\n12", "$Nodes\n13"),
        &["$Nodes", "expected a node tag, found `$EndNodes`"],
    );
    let many = changed("hex8_a22.msh", "$Nodes\n12", "$Nodes\n18446744073709551615");
    refused(&many, &["$Nodes", "18446744073709551615 nodes declared", "room for"]);
    refused(&changed("hex8_a22.msh", "$Nodes\n12", "$Nodes\n"), &["$Nodes, line 14", "found `0`"]);
    refused(&changed("hex8_a22.msh", "$EndNodes", "$EndNode"), &["$Nodes", "expected $EndNodes"]);
    let nodes = text("hex8_a22.msh");
    let start = nodes.find("$Nodes").unwrap();
    let end = nodes.find("$Elements").unwrap();
    let without = [&nodes[..start], &nodes[end..]].concat();
    refused(without.as_bytes(), &["no $Nodes section"]);
    let twice = [&nodes[..end], &nodes[start..end], &nodes[end..]].concat();
    refused(twice.as_bytes(), &["a second $Nodes section"]);
    let without = &nodes[..end];
    refused(without.as_bytes(), &["end of file", "no $Elements section"]);
}

#[test]
fn damaged_elements() {
    let at = "9 5 2 1 1 3 1 2 4 12 10 9 11\n";
    let file = "hex8_a22.msh";
    refused(&changed(file, at, "9 7 2 1 1 3 1 2 4 12\n"), &["$Elements, line 37", "type 7 (5-node pyramid)"]);
    refused(&changed(file, at, "9 99 2 1 1 3 1 2 4 12\n"), &["$Elements, line 37", "type 99 (unknown)"]);
    refused(
        &changed(file, at, "9 5 2 1 1 3 1 2 4 12 10 9\n"),
        &["$Elements, line 37", "a node tag", "end of the line"],
    );
    refused(&changed(file, at, "9 5 2 1 1 3 1 2 4 12 10 9 11 8\n"), &["$Elements, line 37", "found `8`"]);
    refused(&changed(file, at, "9 5 2 1 1 3 1 2 4 12 10 9 77\n"), &["$Elements, line 37", "uses node 77"]);
    refused(&changed(file, at, "9 5 2 1 1 3 1 2 4 12 10 9 -7\n"), &["$Elements, line 37", "found `-7`"]);
    refused(&changed(file, at, "9 5 1000000 1 1 3 1 2 4 12 10 9 11\n"), &["$Elements, line 37", "1000000 tags"]);
    refused(&changed(file, "$Elements\n10", "$Elements\n11"), &["$Elements", "found `$EndElements`"]);
    refused(&changed(file, "$Elements\n10", "$Elements\n9"), &["$Elements", "expected $EndElements, found `10`"]);
    refused(&changed(file, "$Elements\n10", "$Elements\n999999999"), &["$Elements", "999999999 elements declared"]);
    let whole = text(file);
    let cut = whole.find("9 5 2").unwrap();
    let faces = whole[..cut].replace("$Elements\n10", "$Elements\n8") + "$EndElements\n";
    refused(faces.as_bytes(), &["no volume elements, only 6 of lower dimension"]);
    refused(&changed(file, "3 1 \"gear\"", "3 1 gear"), &["$PhysicalNames, line 10", "in quotes"]);
    refused(&changed(file, "3 1 \"gear\"", "3 \"gear\""), &["$PhysicalNames, line 10", "the tag of a group"]);
}

#[test]
fn damaged_blocks_of_41() {
    let file = "hex8_a41.msh";
    let whole = text(file);
    let nodes = whole.split("$Nodes\n").nth(1).unwrap().lines().next().unwrap();
    refused(&changed(file, nodes, &nodes.replace(" 12 ", " 13 ")), &["$Nodes", "13 nodes declared, 12 found"]);
    refused(&changed(file, nodes, &nodes.replace(" 12 ", " 9999999 ")), &["$Nodes", "9999999 nodes declared"]);
    let elements = whole.split("$Elements\n").nth(1).unwrap().lines().next().unwrap();
    refused(&changed(file, elements, &elements.replacen(" 10 ", " 12 ", 1)), &["12 elements declared, 10 found"]);
    let body = whole.find("$Elements").unwrap();
    let stray = whole[..body].to_owned() + &whole[body..].replace("\n3 1 5 2\n", "\n3 8 5 2\n");
    refused(stray.as_bytes(), &["$Elements", "entity 8 of dimension 3"]);
    let entities = whole.find("$EndEntities").unwrap();
    refused(&whole.as_bytes()[..entities - 20], &["$Entities", "found the end of"]);
}

/// A surface group that goes on over a body outside the model.
#[test]
fn a_group_half_on_another_body() {
    // The first body alone is in a volume; the group takes in a face of the second.
    let groups = text("overlap_a22.msh");
    let mut lines: Vec<&str> = groups.lines().collect();
    let start = lines.iter().position(|l| *l == "$Elements").unwrap();
    let volumes = lines[start..].iter().filter(|l| l.contains(" 5 2 1 2 ")).count();
    assert_eq!(volumes, 2, "elements of the second body");
    lines.retain(|l| !l.contains(" 5 2 1 2 "));
    let stray = "60 3 2 3 7 10 9 11 12";
    lines.insert(start + 2, stray);
    let count: usize = lines[start + 1].parse().unwrap();
    let count = (count - 1).to_string();
    lines[start + 1] = &count;
    refused(lines.join("\n").as_bytes(), &["$Elements, line", "which no volume element of the model uses"]);
}

/// A file cut anywhere is an error or, past its last element, the mesh.
#[test]
fn cut_short_anywhere() {
    for file in ["hex8_a41.msh", "hex8_b41.msh", "hex8_a22.msh", "hex8_b22.msh", "partitioned_b41.msh"] {
        let bytes = std::fs::read(data(file)).unwrap();
        let whole = Mesh::parse(&bytes, file).unwrap();
        let mark = b"$EndElements";
        let end = bytes.windows(mark.len()).position(|w| w == mark).unwrap() + mark.len();
        for length in 0..bytes.len() {
            match Mesh::parse(&bytes[..length], file) {
                Ok(mesh) => assert!(mesh == whole && length >= end, "{file} cut to {length} bytes"),
                Err(error) => {
                    let message = error.to_string();
                    assert!(message.contains("line ") || message.contains("byte "), "{message}");
                }
            }
        }
    }
}

/// Counts of binary files, each set to nonsense.
#[test]
fn nonsense_counts_in_binary() {
    for file in ["hex8_b41.msh", "hex8_b22.msh", "partitioned_b41.msh", "parametric_b22.msh"] {
        let bytes = std::fs::read(data(file)).unwrap();
        for at in 20..bytes.len() - 8 {
            for fill in [0xFF, 0x7F] {
                let mut bad = bytes.clone();
                bad[at..at + 8].fill(fill);
                // Some bytes are coordinates, bounds or extremes that may be anything; none may panic.
                let _ = Mesh::parse(&bad, file);
            }
        }
    }
}

#[test]
fn binary_damage_names_section_and_byte() {
    let bytes = std::fs::read(data("hex8_b41.msh")).unwrap();
    let find = |what: &[u8]| bytes.windows(what.len()).position(|w| w == what).unwrap() + what.len();
    let nodes = find(b"$Nodes\n");
    let mut bad = bytes.clone();
    bad[nodes + 8..nodes + 16].fill(0xFF);
    refused(&bad, &["$Nodes, byte", "18446744073709551615 nodes declared"]);
    let mut bad = bytes.clone();
    let one = bytes[nodes..].windows(8).position(|w| w == 1.3_f64.to_le_bytes()).unwrap() + nodes;
    bad[one..one + 8].copy_from_slice(&f64::NAN.to_le_bytes());
    refused(&bad, &["$Nodes, byte", "is NaN"]);
    let elements = find(b"$Elements\n");
    let mut bad = bytes.clone();
    bad[elements + 40..elements + 44].copy_from_slice(&7_i32.to_le_bytes());
    refused(&bad, &["$Elements, byte", "element type 7"]);
    refused(&bytes[..elements + 100], &["$Elements, byte"]);
    let bytes = std::fs::read(data("hex8_b22.msh")).unwrap();
    let elements = bytes.windows(13).position(|w| w == b"$Elements\n10\n").unwrap() + 13;
    let mut bad = bytes.clone();
    bad[elements + 4..elements + 8].copy_from_slice(&77_i32.to_le_bytes());
    refused(&bad, &["$Elements, byte", "a run of 1 to 10 elements, found 77"]);
    bad[elements + 4..elements + 8].copy_from_slice(&(-1_i32).to_le_bytes());
    refused(&bad, &["$Elements, byte", "found -1"]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Bytes overwritten, cut out and put in at random: a mesh or an error, never a panic.
    #[test]
    fn mangled_bytes_do_not_panic(
        file in 0_usize..8,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0_u8..4), 1..8),
    ) {
        let names = ["hex8_a41", "hex8_b41", "hex8_a22", "hex8_b22", "partitioned_a41", "partitioned_b41", "tet10_b22", "parametric_a41"];
        let mut bytes = std::fs::read(data(&format!("{}.msh", names[file]))).unwrap();
        for (index, value, how) in changes {
            if bytes.is_empty() { break; }
            let at = index.index(bytes.len());
            match how {
                0 => bytes[at] = value,
                1 => { bytes.remove(at); }
                2 => bytes.insert(at, value),
                // Digits are likely to stay numbers.
                _ => bytes[at] = b'0' + value % 10,
            }
        }
        if let Ok(mesh) = Mesh::parse(&bytes, "mangled") {
            let _ = mesh::MeshInfo::new(&mesh);
            let _ = mesh::MeshReport::new(&mesh);
            let _ = mesh::MeshedGear::from_groups(mesh, &mesh::GroupNames::default(), 30);
        }
    }

    /// Any bytes at all.
    #[test]
    fn noise_does_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        prop_assert!(Mesh::parse(&bytes, "noise").is_err());
        let all = [b"$MeshFormat\n4.1 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Elements\n".as_slice(), &bytes].concat();
        prop_assert!(Mesh::parse(&all, "noise").is_err());
    }
}
