//! What is in a mesh, and what is wrong with it.

use std::{fmt::Write, path::Path};

use mesh::{Finding, MeshInfo, MeshReport, Numbered, Severity};

/// A short table of what is in a mesh.
pub fn mesh_info_table(file: &Path, mesh: &MeshInfo) -> String {
    let mut t = format!("{}\n", file.display());
    let mut line = |label: &str, value: String| {
        // Writing to a String cannot fail.
        let _ = writeln!(t, "  {label:<16} {value}");
    };
    line("nodes", format!("{} ({} DOF)", mesh.nodes, 3 * mesh.nodes));
    for (kind, count) in &mesh.elements {
        line("elements", format!("{count} {kind}"));
    }
    line("volume", format!("{:.3} mm^3", mesh.volume));
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        line(name, format!("{:.4} .. {:.4} mm", mesh.low[axis], mesh.high[axis]));
    }
    line("radius", format!("{:.4} .. {:.4} mm", mesh.radius_range[0], mesh.radius_range[1]));
    line("angle", format!("{:.2} deg", mesh.gear.angle_deg));
    let unknown = || "not known".to_owned();
    line("bore radius", mesh.gear.bore_radius.map_or_else(unknown, |r| format!("{r:.4} mm")));
    line("teeth", mesh.gear.teeth.map_or_else(unknown, |z| z.to_string()));
    line("teeth with flanks", mesh.gear.named_teeth.to_string());
    line("volumes", mesh.volumes.join(", "));
    line("surfaces", format!("{} groups", mesh.surfaces.len()));
    let mut surfaces: Vec<_> = mesh.surfaces.iter().collect();
    // Tooth 2 before tooth 10.
    surfaces.sort_by_cached_key(|g| Numbered::of(&g.name).map_or((g.name.clone(), 0), |n| (n.pattern, n.number)));
    for g in surfaces {
        let _ = writeln!(t, "    {:<20} {:>7} faces {:>7} nodes {:>12.3} mm^2", g.name, g.faces, g.nodes, g.area);
    }
    t
}

fn severity(finding: &Finding) -> &'static str {
    match finding.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    }
}

/// What was found as JSON.
pub fn mesh_findings_json(report: &MeshReport) -> String {
    let one = |f: &Finding| {
        serde_json::json!({
            "severity": severity(f), "text": f.text, "count": f.count, "elements": f.elements, "nodes": f.nodes
        })
    };
    format!("{:#}\n", serde_json::Value::from(report.findings.iter().map(one).collect::<Vec<_>>()))
}

/// What was found, a line each, with the tags of elements and nodes below.
pub fn mesh_findings(report: &MeshReport) -> String {
    let mut t = String::new();
    for finding in &report.findings {
        // Writing to a String cannot fail.
        let _ = writeln!(t, "{}: {}", severity(finding), finding.text);
        for (what, tags) in [("elements", &finding.elements), ("nodes", &finding.nodes)] {
            if !tags.is_empty() {
                let shown: Vec<String> = tags.iter().map(u64::to_string).collect();
                let _ = writeln!(t, "  {what} {}", shown.join(" "));
            }
        }
    }
    t
}
