//! F11: nearly incompressible material.

use analysis::worse;
use fem::{ElementOptions, locks_from};
use mesh::{ElementKind, Extent, GroupNames, MeshedGear, StructuredOptions, generate};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, errors_um, mean},
    pieces::block::{Test, compliance},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 11,
    name: "volumetric locking",
    file: "F11-volumetric-locking",
    scene: scene_text!("F11-volumetric-locking"),
    fails: "Towards a Poisson's ratio of 0.5 elements with as many conditions on their volume as freedoms hardly move at all.",
    does: "Hexahedra of the mesher (incompatible modes; reduced integration) do not lock; meshes of elements that do are warned of.",
    naive: &[],
    look,
};

/// What a pressed cube deflects at this Poisson's ratio, over a fine one, beside the same at 0.3: parts that are lost.
fn lost(kind: ElementKind, poisson: f64) -> Result<f64, EnvelopeError> {
    let options = ElementOptions::default();
    let pressed = |kind, cells, nu| compliance(Test::Pressed, kind, [cells; 3], nu, &options);
    let share = |nu| Ok::<_, EnvelopeError>(pressed(kind, 4, nu)? / pressed(ElementKind::Hex20, 8, nu)?);
    Ok(1.0 - share(poisson)? / share(0.3)?)
}

/// The scene's pinion cut into wedges, as a mesh from elsewhere might be.
fn wedges(bench: &Bench) -> Result<Vec<String>, EnvelopeError> {
    let piece = "wedges";
    let gear = bench.scene(&AS_IT_IS)?.gear_pair()?.pinion;
    let options = StructuredOptions { order: 1, elements_face: 4, extent: Extent::Sector(3), ..Default::default() };
    let mut mesh = generate(&gear, &options).map_err(EnvelopeError::of(piece))?;
    for block in &mut mesh.blocks {
        let halves = [[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]];
        let cut = block.elements().flat_map(|e| halves.map(|h| h.map(|i| e[i]))).flatten().collect();
        block.tags = (1..=2 * block.tags.len() as u64).collect();
        (block.kind, block.connectivity) = (ElementKind::Wedge6, cut);
    }
    let parts = MeshedGear::from_groups(mesh, &GroupNames::default(), gear.teeth());
    let material = fem::Material::new(2000.0, 0.49, 1.2e-9).map_err(EnvelopeError::of(piece))?;
    let full = reduction::FullGear::new(parts.map_err(EnvelopeError::of(piece))?, material, &ElementOptions::default());
    let gear = reduction::ElasticGear::Full(full.map_err(EnvelopeError::of(piece))?);
    Ok(analysis::locking_remark(&gear, "pinion").iter().map(ToString::to_string).collect())
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let (mut own, mut silent, mut worst) = (0.0f64, 0.0f64, 0.0f64);
    for kind in ElementKind::ALL {
        let lost = lost(kind, 0.499)?;
        match (kind, locks_from(kind)) {
            (ElementKind::Hex8 | ElementKind::Hex20, _) => own = worse(own, lost),
            (_, None) => silent = worse(silent, lost),
            (_, Some(_)) => worst = worse(worst, lost),
        }
    }
    let error = |poisson: &str, order: u32| {
        let orders = ["pinion", "wheel"].map(|g| format!("{g}.mesher.order={order}"));
        let settings = [format!("material.poisson={poisson}"), orders[0].clone(), orders[1].clone()];
        Ok::<_, EnvelopeError>(mean(&errors_um(&bench.at_rest(&settings)?)))
    };
    let ratio = |poisson| Ok::<_, EnvelopeError>(error(poisson, 1)? / error(poisson, 2)?);
    let pair = 100.0 * (ratio("0.499")? / ratio("0.3")? - 1.0).abs();
    Ok(vec![
        Figure::new(
            "pressed cube at 0.499 beside 0.3: parts of its compliance that are lost, hex8 and hex20; naive: the worst kind",
            Shown::at_most(own, 0.15),
        )
        .beside(Shown::at_least(worst, 0.8)),
        Figure::new("the same, kinds that are not warned of", Shown::at_most(silent, 0.15)),
        Figure::new("pair: hex8 over hex20, change from 0.3 to 0.499, %", Shown::at_most(pair, 1.5)),
        Figure::new("what is said of wedges at 0.49", Shown::warned(&wedges(bench)?, "lock")),
    ])
}
