//! probe
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]
mod support;
use contact::{GapSource, Law};
use fem::{ElementOptions, IncompatibleModes, Integration};
use support::Case;

#[test]
fn probe() {
    for (mesh, elements, gap, wanted) in [
        (
            "ref_qcoarse_hex20",
            ElementOptions { integration: Integration::Reduced, ..ElementOptions::default() },
            GapSource::Smooth,
            include_str!("/tmp/q.txt"),
        ),
        (
            "ref_coarse_hex8",
            ElementOptions { incompatible_modes: IncompatibleModes::WithoutJacobianRatio, ..ElementOptions::default() },
            GapSource::Facet,
            include_str!("/tmp/c.txt"),
        ),
    ] {
        let case = Case::reference(mesh, elements);
        let mut o = case.options();
        o.law = Law::Penalty(1e7);
        o.gap = gap;
        o.points_per_face_edge = 8;
        o.root_stress = true;
        let t = std::time::Instant::now();
        let mut model = case.reduced(o);
        println!("{mesh} setup {:?}", t.elapsed());
        let t = std::time::Instant::now();
        let h = model.run(8, 1, |_, _, _| ()).unwrap();
        println!("run {:?}", t.elapsed());
        for (p, w) in h.positions.iter().zip(wanted.lines()) {
            let m = [0, 1].map(|g| p.root_stress[g].iter().map(|f| f.max_principal.stress).fold(0.0f64, f64::max));
            let v = [0, 1].map(|g| p.root_stress[g].iter().map(|f| f.von_mises.stress).fold(0.0f64, f64::max));
            println!("{} {w} {m:.2?} vm {v:.2?}", p.mesh_phase);
        }
    }
}
