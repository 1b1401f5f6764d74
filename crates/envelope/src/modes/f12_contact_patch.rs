//! F12: the contact patch test.

use analysis::worse;
use contact::complementarity::Law;
use mesh::ElementKind;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, errors_um, mean},
    pieces::contact_patch::contact_patch_deviation,
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 12,
    name: "contact patch test",
    file: "F12-contact-patch",
    scene: scene_text!("F12-contact-patch"),
    fails: "Points pressed against the faces of a mesh that does not match pass a uniform pressure on as a scattered one, on any mesh.",
    does: "Surface against surface at Gauss points with consistent weights and exact contact: a uniform pressure passes.",
    naive: &["contact.points_per_face_edge=1"],
    look,
};

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let worst = |per_edge, law| {
        let mut worst = 0.0f64;
        for kind in [ElementKind::Hex8, ElementKind::Hex20] {
            worst = contact_patch_deviation(kind, per_edge, law)?.into_iter().fold(worst, worse);
        }
        Ok::<_, EnvelopeError>(100.0 * worst)
    };
    let (exact, few) = (worst(6, Law::Exact)?, worst(2, Law::Penalty(1e7))?);
    let points = |settings: &[String]| Ok::<_, EnvelopeError>(mean(&errors_um(&bench.at_rest(settings)?)));
    let (one, usual) = (points(&bench.naive(&[]))?, mean(&errors_um(&bench.at_rest(&AS_IT_IS)?)));
    let many = points(&["contact.points_per_face_edge=12".to_owned()])?;
    Ok(vec![
        Figure::new(
            "meshes that do not match: displacement of the faces off uniform, %; naive: two points an edge, penalty",
            Shown::at_most(exact, 0.01),
        )
        .beside(Shown::at_least(few, 1.0)),
        Figure::new(
            "mean transmission error with 6 points an edge against 12, % off",
            Shown::at_most(100.0 * (usual / many - 1.0).abs(), 0.4),
        )
        .beside(Shown::at_least(100.0 * (one / many - 1.0).abs(), 0.5)),
    ])
}
