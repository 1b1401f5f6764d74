//! Ratio of the compliance of a pair with other bodies, from coarse meshes of solid gears. Only ratios of the results
//! are used.

use contact::{Bulk, Method};
use fem::{ElementOptions, Material};
use geometry::{Gear, GearData, GearPair};
use ltca::{StaticModel, StaticOptions};
use mesh::{Extent, GroupNames, MeshedGear, StructuredOptions};
use reduction::{ElasticGear, GearReducer, ReductionOptions};

/// Positions of the mesh cycle over which is averaged.
const POSITIONS: usize = 4;
const SLICES: usize = 8;
/// Teeth by which the window may grow.
const WIDER: usize = 2;

/// What is varied of a gear.
#[derive(Debug, Clone, Copy)]
pub(super) struct Body {
    /// mm.
    pub bore_diameter: f64,
    pub extent: Extent,
}

/// A pair of which coarse models are made; flanks are nominal, axes parallel.
#[derive(Debug)]
pub(super) struct Coarse<'a> {
    pair: &'a GearPair,
    materials: [&'a Material; 2],
    options: StaticOptions,
}

impl<'a> Coarse<'a> {
    /// The pair under the torque of `options`.
    pub fn new(pair: &'a GearPair, materials: [&'a Material; 2], options: &StaticOptions) -> Self {
        let plain = StaticOptions::new(options.torque, pair);
        let window = Some(options.window_teeth(pair));
        let options = StaticOptions { window, ..plain }.with_contact(|c| {
            c.driver = options.contact.driver;
            c.sense = options.contact.sense;
            c.slices = SLICES;
            // Few slices at few positions: a table would take longer to make than it saves.
            c.bulk = Bulk::Exact;
        });
        debug_assert_eq!(options.contact.method, Method::Slice);
        Self { pair, materials, options }
    }

    /// Solid gears with the pair's own bores.
    pub fn solid(&self) -> [Body; 2] {
        [&self.pair.pinion, &self.pair.wheel]
            .map(|gear| Body { bore_diameter: gear.data().bore_diameter, extent: Extent::Periodic })
    }

    /// Mean transmission error with bodies `b` divided by that with bodies `a`; `None` if one of them cannot be made or
    /// solved.
    pub fn ratio(&self, a: [Body; 2], b: [Body; 2]) -> Option<f64> {
        let (b, a) = rayon::join(|| self.mean_error(b), || self.mean_error(a));
        let ratio = b? / a?;
        ratio.is_finite().then_some(ratio)
    }

    /// Mean static transmission error, mm; a softer pair than the user's may need a wider window.
    fn mean_error(&self, bodies: [Body; 2]) -> Option<f64> {
        let least = self.options.window.unwrap_or_default();
        (least..=least + WIDER).find_map(|window| self.in_window(bodies, window))
    }

    fn in_window(&self, bodies: [Body; 2], window: usize) -> Option<f64> {
        let asked = StaticOptions { window: Some(window), ..self.options.clone() };
        let first = StaticModel::first_teeth(self.pair, &asked).ok()?;
        let nominal = [&self.pair.pinion, &self.pair.wheel].map(|gear| gear.data());
        let gears: Vec<Gear> = nominal
            .into_iter()
            .zip(bodies)
            .map(|(data, body)| Gear::new(GearData { bore_diameter: body.bore_diameter, ..data.clone() }).ok())
            .collect::<Option<_>>()?;
        let pair = GearPair::new(gears[0].clone(), gears[1].clone(), Some(self.pair.centre_distance())).ok()?;
        let pair = pair.with_mid_face_offset(self.pair.mid_face_offset()).ok()?;
        let elastic = |i: usize| {
            let mesh = mesh::generate(&gears[i], &mesher(bodies[i].extent)).ok()?;
            let (mesh, _) = MeshedGear::find(mesh, &gears[i], &GroupNames::default()).ok()?;
            let options = ReductionOptions {
                sides: asked.contact.sides(),
                window,
                first: first[i],
                elements: ElementOptions::default(),
            };
            Some(ElasticGear::Reduced(GearReducer::new(mesh, *self.materials[i], options).ok()?))
        };
        let mut model = StaticModel::new(pair.clone(), [elastic(0)?, elastic(1)?], asked.clone()).ok()?;
        let history = model.run(POSITIONS, 1, |_, _, _| ()).ok()?;
        Some(history.positions.iter().map(|p| p.transmission_error).sum::<f64>() / POSITIONS as f64)
    }
}

/// Quadratic elements, two in every direction.
fn mesher(extent: Extent) -> StructuredOptions {
    StructuredOptions {
        order: 2,
        elements_profile: 2,
        elements_fillet: 2,
        elements_thickness: 2,
        elements_face: 2,
        elements_rim: 2,
        extent,
    }
}
