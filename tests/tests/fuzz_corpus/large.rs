//! Inputs of up to a mebibyte that grow without bound in a reader that multiplies what it finds.

use verification::readers;

use super::within_bounds;

/// Bytes of an input.
const SIZE: usize = 1 << 20;

/// `first`, then as many of `one` as fit into `share` of an input.
fn many(share: f64, one: impl Fn(usize) -> String) -> String {
    let mut text = String::new();
    let most = (share * SIZE as f64) as usize;
    for i in 0.. {
        let next = one(i);
        if text.len() + next.len() > most {
            break;
        }
        text += &next;
    }
    text
}

/// A tetrahedron of format 4.1 and one entity of each dimension that lies in the `groups`.
fn mesh_with(groups: &str, elements: &str, [blocks, total]: [usize; 2]) -> String {
    let count = groups.split_whitespace().count();
    format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 1\n1 0 0 0 1 1 1 {count} {groups} 0\n\
         1 0 0 0 1 1 1 {count} {groups} 0\n$EndEntities\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n\
         0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n{blocks} {total} 1 {total}\n{elements}$EndElements\n"
    )
}

#[test]
fn a_face_in_many_groups() {
    let faces = many(0.4, |i| format!("{} 1 2 3\n", i + 2));
    let count = faces.lines().count();
    for one in [|i| format!("{} ", i + 1), |_| "1 ".to_owned()] {
        let groups = many(0.25, one);
        let elements = format!("3 1 4 1\n1 1 2 3 4\n2 1 2 {count}\n{faces}");
        let text = mesh_with(groups.trim(), &elements, [2, count + 1]);
        within_bounds("faces in groups", readers::mesh, text.as_bytes());
    }
}

#[test]
fn a_volume_in_many_groups() {
    let blocks = many(0.4, |i| format!("3 1 4 1\n{} 1 2 3 4\n", i + 1));
    let count = blocks.lines().count() / 2;
    let groups = many(0.25, |i| format!("{} ", i + 1));
    let text = mesh_with(groups.trim(), &blocks, [count, count]);
    within_bounds("volumes in groups", readers::mesh, text.as_bytes());
}

#[test]
fn flanks_of_many_teeth() {
    let names = many(0.3, |i| format!("2 {} \"flank_left_{i}\"\n", i + 1));
    let count = names.lines().count();
    let faces = many(0.6, |i| format!("{} 2 1 {} 1 2 3\n", i + 2, i % count + 1));
    let text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{count}\n{names}$EndPhysicalNames\n$Nodes\n4\n\
         1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n{}\n1 4 0 1 2 3 4\n{faces}$EndElements\n",
        faces.lines().count() + 1
    );
    within_bounds("flanks", readers::gear_mesh, text.as_bytes());
}

#[test]
fn nodes_at_one_place() {
    let nodes = many(0.5, |i| format!("{} 0 0 0\n", i + 1));
    let count = nodes.lines().count();
    let elements = many(0.45, |i| {
        let at = |k: usize| (4 * i + k) % count + 1;
        format!("{} 4 0 {} {} {} {}\n", i + 1, at(0), at(1), at(2), at(3))
    });
    let text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{count}\n{nodes}$EndNodes\n$Elements\n{}\n{elements}$EndElements\n",
        elements.lines().count()
    );
    within_bounds("nodes at one place", readers::gear_mesh, text.as_bytes());
}

#[test]
fn long_keys_and_many_tables_of_scenes() {
    let long = "a".repeat(SIZE - 8);
    let deep = "a.".repeat(SIZE / 2 - 8);
    let texts = [
        format!("{long} = 1\n"),
        format!("{deep}b = 1\n"),
        format!("[{deep}b]\n"),
        format!("a = {}\n", "[".repeat(SIZE - 8)),
        format!("a = {}\n", "{a=".repeat(SIZE / 3 - 8)),
        format!("[pinion]\npitch_errors_um = [{}]\n", "1,".repeat(SIZE / 2 - 40)),
        format!("[pinion]\nteeth = \"{long}\"\n"),
        format!("name = \"{long}\""),
        many(1.0, |i| format!("a{i} = 1\n")),
        many(1.0, |i| format!("[a{i}]\n")),
        many(1.0, |_| "[[pinion.shaft.discs]]\n".into()),
        many(1.0, |_| "\"\\u0000\" = 1\n".into()),
        "\r".repeat(SIZE),
        "\u{e9}".repeat(SIZE / 2),
    ];
    for (i, text) in texts.iter().enumerate() {
        within_bounds(&format!("scene {i}"), readers::scene, text.as_bytes());
        within_bounds(&format!("study {i}"), readers::study, text.as_bytes());
    }
    within_bounds("setting", readers::setting, format!("{}=1", &deep[..1 << 16]).as_bytes());
    within_bounds("long setting", readers::setting, format!("{long}=1").as_bytes());
    let words = many(0.02, |i| format!("operation.torque_nm={i}\n"));
    within_bounds("many settings", readers::setting, words.as_bytes());
}

#[test]
fn studies_of_many_words() {
    let asks = "[[quantity]]\ncolumn = \"ste_um\"\n";
    let case = "[[case]]\nscene = \"iso.toml\"\nvalue = 1\n";
    let set = many(0.95, |i| format!("\"operation.torque_nm={i}\","));
    within_bounds("words of one case", readers::study, format!("{case}set = [{set}]\n{asks}").as_bytes());
    let cases = many(0.95, |i| format!("{case}label = \"{i}\"\n"));
    within_bounds("cases", readers::study, format!("{cases}{asks}").as_bytes());
    let asked = many(0.95, |_| asks.to_owned());
    within_bounds("quantities", readers::study, format!("{case}{asked}").as_bytes());
}

#[test]
fn xml_without_end() {
    let texts = [
        format!("<model {}/>", many(0.95, |i| format!("a{i}='' "))),
        format!("<model {}/>", many(0.95, |i| format!("xmlns:a{i}='b{i}' "))),
        "<a>".repeat(SIZE / 3),
        format!("<model>{}", "<a>".repeat(SIZE / 3 - 4)),
        format!("<model><relations>{}</relations></model>", "<relation type='stage'/>".repeat(40_000)),
        format!("<model xmlns='x'>{}</model>", many(0.9, |i| format!("<a xmlns:b{i}='c'/>"))),
        many(0.9, |_| "&amp;".into()),
    ];
    for (i, text) in texts.iter().enumerate() {
        within_bounds(&format!("REXS {i}"), readers::rexs, text.as_bytes());
    }
}

#[test]
fn wide_and_long_tables() {
    let wide = many(0.45, |i| format!(" {i}"));
    let zeros = "0 ".repeat(wide.split_whitespace().count());
    within_bounds("topography", readers::topography, format!("roll_deg{wide}\n1 {zeros}\n2 {zeros}\n").as_bytes());
    let long = many(0.9, |i| format!("{i} 0 0\n"));
    within_bounds("topography", readers::topography, format!("roll_deg -9 9\n{long}").as_bytes());
    within_bounds("pitch errors", readers::pitch_errors, "0 ".repeat(SIZE / 2).as_bytes());
    let names = many(0.9, |i| format!("c{i},"));
    within_bounds("rows", readers::rows, format!("{names}\n").as_bytes());
    within_bounds("rows", readers::rows, ",".repeat(SIZE).as_bytes());
}

/// The summary of a result, with this headline and these inputs.
fn summary(headline: &str, inputs: &str) -> String {
    format!("{{\"program\":\"ale-gear\",\"schema\":1,\"headline\":{{{headline}}},\"inputs\":{{{inputs}}}}}")
}

#[test]
fn results_of_many_numbers() {
    let key = "k".repeat(SIZE / 2);
    let ones = format!("[{}1]", "1,".repeat(SIZE / 5));
    let numbers = many(0.9, |i| format!("\"a{i}\":1,"));
    let texts = [
        summary(&format!("\"{key}\":1"), ""),
        summary(&format!("\"{key}\":{ones}"), ""),
        summary("", &format!("\"{key}\":{ones}")),
        summary(&format!("\"a\":[{}1]", "1,".repeat(SIZE / 2 - 100)), ""),
        summary(&format!("{numbers}\"b\":1"), ""),
        summary("", &format!("{numbers}\"b\":1")),
    ];
    for (i, text) in texts.iter().enumerate() {
        within_bounds(&format!("summary {i}"), readers::results, text.as_bytes());
    }
}

#[test]
fn results_of_many_columns_and_ways() {
    let head = summary("\"a\":1", "");
    let long = "c".repeat(SIZE / 2);
    let names = many(0.4, |i| format!("c{i},"));
    let zeros = "0,".repeat(names.matches(',').count());
    let commas = ",".repeat(SIZE / 2);
    let ways = many(0.4, |i| format!("w{i},1\n"));
    let phases = many(0.9, |i| format!("{},1\n", i % 2));
    let tables = [
        format!("mesh_phase,{names}x\n0,{zeros}0\n1,{zeros}0\n"),
        format!("way,{long}\n{ways}"),
        format!("way,a\n{}", many(0.9, |i| format!("w{i},1\n"))),
        format!("way,{commas}\n{ways}"),
        format!("{long},mesh_phase\n1,0\n"),
        format!("mesh_phase,a\n{phases}"),
        format!("time_s,a\n{phases}"),
    ];
    for (i, table) in tables.iter().enumerate() {
        within_bounds(&format!("rows {i}"), readers::results, format!("{head}\0{table}").as_bytes());
    }
}

#[test]
fn counts_of_records_that_promise_too_much() {
    for count in [u32::MAX, 1 << 31, 1 << 20] {
        let mut payload = vec![0, 1];
        payload.extend([0; 16]);
        for _ in 0..64 {
            payload.extend(count.to_le_bytes());
        }
        within_bounds("record", readers::record, &payload);
        within_bounds("record", readers::record, &readers::sealed_record(&payload)[..100]);
    }
    within_bounds("zeros", readers::record, &vec![0; SIZE]);
}

#[test]
fn elements_about_one_edge() {
    let elements = many(0.55, |i| format!("{} 4 0 1 2 {} {}\n", i + 1, i + 3, i + 4));
    let count = elements.lines().count();
    let nodes = many(0.4, |i| format!("{} 0 0 {}\n", i + 1, i % 10));
    let there = nodes.lines().count();
    let elements: String = elements.lines().take(there - 4).map(|line| format!("{line}\n")).collect();
    let count = count.min(there - 4);
    let text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{there}\n{nodes}$EndNodes\n$Elements\n{count}\n{elements}\
         $EndElements\n"
    );
    within_bounds("elements about one edge", readers::gear_mesh, text.as_bytes());
}

/// What a page is made of unpacks from nothing: gzip makes a thousandth of it.
#[test]
fn pages_that_unpack_without_end() {
    let page = |context: &str| format!("{{\"template\":\"page.html\",\"context\":{context}}}");
    let texts = [
        page(&format!("[{}0]", "0,".repeat(16 * SIZE))),
        page(&format!("[{}0]", "{\"\":0},".repeat(SIZE))),
        page(&format!("[{}0]", "[0],".repeat(SIZE))),
        page(&format!("{}{}", "[".repeat(SIZE), "]".repeat(SIZE))),
        page(&format!("{{{}\"a\":1}}", many(4.0, |i| format!("\"a{i}\":1,")))),
        page(&format!("{{\"name\":\"{}\"}}", "<".repeat(6 * SIZE))),
    ];
    for (i, text) in texts.iter().enumerate() {
        within_bounds(&format!("page {i}"), readers::page, text.as_bytes());
    }
}
