//! F6: what rotation does to elastic bodies.

use std::f64::consts::TAU;

use analysis::worse;
use dynamics::rotation_share;
use fem::{DofMap, ElementOptions, Material, assemble_mass};
use geometry::{Gear, Side};
use mesh::{Extent, GroupNames, MeshedGear, StructuredOptions, generate};
use nalgebra::DMatrix;
use reduction::{GearReducer, ModeChoice, ReductionOptions};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, farthest},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 6,
    name: "gyroscopic and convective terms dropped",
    file: "F06-rotation",
    scene: scene_text!("F06-rotation"),
    fails: "Coriolis and centrifugal forces on elastic deformation are left out, and nobody says how much that is.",
    does: "Nodes move with the material and the window is relabelled, so there are no convective terms; what rotation would change is bounded in every motion, and warned of from a fifteenth on.",
    naive: &["operation.speed_rpm=60000"],
    look,
};

const MODES: usize = 12;
/// Rotation over the lowest elastic frequency.
const RATIOS: [f64; 4] = [0.01, 0.03, 0.1, 0.2];

/// Modes of a gear on its bore with their gyroscopic and centrifugal matrices.
struct Turning {
    squares: Vec<f64>,
    gyroscopic: DMatrix<f64>,
    centrifugal: DMatrix<f64>,
}

impl Turning {
    fn new(gear: &Gear) -> Result<Self, EnvelopeError> {
        let piece = "turning gear";
        let counts = StructuredOptions {
            order: 1,
            elements_profile: 2,
            elements_fillet: 2,
            elements_thickness: 2,
            elements_face: 3,
            elements_rim: 2,
            extent: Extent::Whole,
        };
        let mesh = generate(gear, &counts).map_err(EnvelopeError::of(piece))?;
        let material = Material::STEEL;
        let dofs = DofMap::new(mesh.nodes.len(), &[]);
        let mass = assemble_mass(&mesh, &material, &dofs).map_err(EnvelopeError::of(piece))?;
        let parts =
            MeshedGear::from_groups(mesh, &GroupNames::default(), gear.teeth()).map_err(EnvelopeError::of(piece))?;
        let options =
            ReductionOptions { sides: vec![Side::Left], window: 3, first: 0, elements: ElementOptions::default() };
        let fail = EnvelopeError::of::<reduction::ReductionError>(piece);
        let reducer = GearReducer::new(parts, material, options).map_err(&fail)?;
        let modes = reducer.modes(ModeChoice::Count(MODES)).map_err(&fail)?;
        let n = modes.count();
        let (mut shapes, mut turned, mut weighted) = (Vec::new(), Vec::new(), Vec::new());
        for mode in 0..n {
            let field = modes.field(&reducer, mode).map_err(&fail)?;
            let about: Vec<f64> = field.iter().flat_map(|u| [-u[1], u[0], 0.0]).collect();
            weighted.push(mass.multiply_vector(&about).map_err(EnvelopeError::of(piece))?);
            shapes.push(field.into_iter().flatten().collect::<Vec<f64>>());
            turned.push(about);
        }
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        Ok(Self {
            squares: modes.squares().to_vec(),
            gyroscopic: DMatrix::from_fn(n, n, |i, j| dot(&shapes[i], &weighted[j])),
            centrifugal: DMatrix::from_fn(n, n, |i, j| dot(&turned[i], &weighted[j])),
        })
    }

    /// Frequencies, rad/s, at a rotation in rad/s, ascending.
    fn frequencies(&self, rotation: f64) -> Vec<f64> {
        let n = self.squares.len();
        let mut first_order = DMatrix::zeros(2 * n, 2 * n);
        first_order.view_mut((0, n), (n, n)).fill_with_identity();
        let stiffness = DMatrix::from_diagonal(&self.squares.clone().into()) - rotation * rotation * &self.centrifugal;
        first_order.view_mut((n, 0), (n, n)).copy_from(&-stiffness);
        first_order.view_mut((n, n), (n, n)).copy_from(&(-2.0 * rotation * &self.gyroscopic));
        let mut found: Vec<f64> = first_order.complex_eigenvalues().iter().map(|x| x.im).filter(|w| *w > 0.0).collect();
        found.sort_by(f64::total_cmp);
        found
    }
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let pair = bench.scene(&AS_IT_IS)?.gear_pair()?;
    let gear = Turning::new(&pair.pinion)?;
    let still = gear.frequencies(0.0);
    let lowest = still[0];
    let skew = (&gear.gyroscopic + gear.gyroscopic.transpose()).amax();
    let (mut at_a_tenth, mut over_bound) = (0.0, 0.0f64);
    for ratio in RATIOS {
        let rotation = ratio * lowest;
        let moved = farthest(&gear.frequencies(rotation), &still);
        over_bound = worse(over_bound, moved / (rotation + 0.5 * rotation * rotation / lowest));
        // Of a frequency near the lowest, a force of Coriolis's at that frequency is what the share says.
        let share = rotation_share(rotation / TAU, lowest / TAU, lowest / TAU);
        over_bound = worse(over_bound, (gear.frequencies(rotation)[0] - lowest).abs() / lowest / share);
        if ratio == 0.1 {
            at_a_tenth = 100.0 * moved / lowest;
        }
    }
    let slow = bench.in_motion(&AS_IT_IS)?;
    let fast = bench.in_motion(&bench.naive(&[]))?;
    Ok(vec![
        Figure::new("change of elastic frequencies by rotation over its bound, largest; naive: change at a tenth of the lowest, %", Shown::at_most(over_bound, 1.0))
            .beside(Shown::at_least(at_a_tenth, 1.0)),
        Figure::new("gyroscopic matrix plus its transpose (Coriolis forces do no work)", Shown::at_most(skew, 1e-9)),
        Figure::new("pair at 6000/min: rotation over stiffness", Shown::at_most(slow.headline.elasticity.rotation_over_stiffness, 0.05)),
        Figure::new("what is said at 60 000/min", Shown::warned(&fast.remarks, "Coriolis")),
    ])
}
