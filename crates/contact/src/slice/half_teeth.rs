//! Half teeth behind the flanks of a window, and their part of the compliance. Theory (19a), (19b).

use std::sync::Arc;

use faer::Mat;
use geometry::{Gear, GearPair, Side};
use reduction::{ElasticGear, LayerStack, LocalCompliance, Window};

use crate::{
    Bulk, BulkBody, BulkTable, ContactError, ContactOptions,
    compliance::Keeper,
    flank::FlankPatch,
    nodal::{ContactRow, Support},
    opening,
    slice::ToothLayer,
};

/// What stands behind the slices of a window, however many there are: half teeth, patch by patch of both gears, and the
/// compliance between all places of the flanks.
#[derive(Debug)]
pub(crate) struct HalfTeeth {
    bodies: [Vec<FlankBody>; 2],
    /// Whether edges may press off the line of action.
    corner_contact: bool,
    /// Bulk compliance of both gears in tables, unless it is to be exact.
    bulk: Option<[BulkTable; 2]>,
}

/// Flanks of a gear that a table is made of.
#[derive(Debug, Clone, Copy)]
pub(crate) enum TableFlanks<'a> {
    /// Flanks of the mesh that is condensed.
    Whole {
        /// One a tooth, or two.
        patches: &'a [FlankPatch],
        /// Whether there is one a tooth, and the teeth are all alike.
        alike: bool,
    },
    /// A wide gear.
    Layers {
        /// Flanks of the shorter gear that is condensed.
        condensed: &'a [FlankPatch],
        /// How many of the layers these are.
        stack: LayerStack,
        /// Flanks of the wide gear.
        whole: &'a [FlankPatch],
    },
}

/// The half tooth behind one patch.
#[derive(Debug)]
struct FlankBody {
    layer: ToothLayer,
    local: Arc<LocalCompliance>,
    /// Boundary number of each of the half tooth's nodes, ascending.
    boundary: Vec<u32>,
}

impl HalfTeeth {
    /// Half teeth behind the patches of both gears. `flanks` gives tooth and side of each patch, `number` the boundary
    /// number of a mesh node.
    ///
    /// # Errors
    /// [`ContactError::Reduction`] if a half tooth cannot be condensed.
    pub fn new(
        pair: &GearPair,
        gears: &[ElasticGear; 2],
        flanks: [&[(u32, Side)]; 2],
        number: impl Fn(usize, (u32, Side), u32) -> Option<u32>,
        options: &ContactOptions,
    ) -> Result<Self, ContactError> {
        let geometry = [&pair.pinion, &pair.wheel];
        let mut bodies = [Vec::new(), Vec::new()];
        for (i, of_gear) in bodies.iter_mut().enumerate() {
            for &(tooth, side) in flanks[i] {
                let number = |node| number(i, (tooth, side), node);
                // Of a gear of layers the first tooth tells all: the half teeth of the others are not asked for.
                let stacked = matches!(&gears[i], ElasticGear::Reduced(r) if r.stack().is_some());
                let known = of_gear.first().filter(|_| stacked).map(|first: &FlankBody| Arc::clone(&first.local));
                of_gear.push(flank_body((&gears[i], geometry[i]), (tooth, side), number, i, known)?);
            }
        }
        Ok(Self { bodies, corner_contact: options.corner_contact, bulk: None })
    }

    /// Half teeth with the bulk compliance of the given windows in tables, if tables are requested and reach the
    /// requested accuracy. A gear that is condensed by its layers must have tables.
    ///
    /// # Errors
    /// [`ContactError::Layers`] if its table is not accurate enough.
    pub fn with_tables(
        mut self,
        flanks: [TableFlanks<'_>; 2],
        gears: &[ElasticGear; 2],
        windows: Option<&[Window; 2]>,
        options: &ContactOptions,
    ) -> Result<Self, ContactError> {
        let layers = flanks.iter().any(|flanks| matches!(flanks, TableFlanks::Layers { .. }));
        let tolerance = match options.bulk {
            Bulk::Table(tolerance) => Some(tolerance),
            Bulk::Exact => layers.then_some(0.0),
        };
        if let (Some(tolerance), Some(windows)) = (tolerance, windows) {
            let table = |i: usize| {
                let local = self.bodies[i].iter().map(|half| (half.boundary.clone(), half.local.clone()));
                let body = Arc::new(BulkBody { reduced: windows[i].reduced.clone(), local: local.collect() });
                match flanks[i] {
                    TableFlanks::Whole { patches, alike } => {
                        let bulk = body.with(patches);
                        let keeper = match &gears[i] {
                            ElasticGear::Reduced(gear) => Some(Keeper { gear, window: &windows[i], body: &body }),
                            ElasticGear::Full(_) => None,
                        };
                        let whole = BulkTable::new(&bulk, tolerance, keeper);
                        Ok(whole.or_else(|| alike.then(|| BulkTable::of_teeth_alike(&bulk, tolerance)).flatten()))
                    }
                    TableFlanks::Layers { condensed, stack, whole } => {
                        BulkTable::of_layers(&body.with(condensed), stack, whole, tolerance).map(Some)
                    }
                }
            };
            let (first, second) = rayon::join(|| table(0), || table(1));
            self.bulk = first?.zip(second?).map(|(a, b)| [a, b]);
        }
        if layers && self.bulk.is_none() {
            return Err(ContactError::Layers { error: f64::INFINITY, most: tolerance.unwrap_or(0.0) });
        }
        Ok(self)
    }

    /// Bulk compliance of both gears in tables; `None` if it is exact.
    pub fn bulk(&self) -> Option<&[BulkTable; 2]> {
        self.bulk.as_ref()
    }

    /// Whether edges may touch off the line of action.
    pub fn has_corner_contact(&self) -> bool {
        self.corner_contact
    }

    /// Layer of the tooth behind a patch of a gear.
    pub fn layer(&self, gear: usize, patch: usize) -> &ToothLayer {
        &self.bodies[gear][patch].layer
    }

    /// X = - sum over both bodies of A W_c A' between rows on the same tooth, mm/N.
    pub fn correction(&self, rows: &[ContactRow]) -> Mat<f64> {
        let mut x = Mat::zeros(rows.len(), rows.len());
        let mut start = 0;
        // Rows come pair by pair, and a tooth belongs to one pair.
        for group in rows.chunk_by(|a, b| a.patches == b.patches) {
            let bodies = [&self.bodies[0][group[0].patches.0], &self.bodies[1][group[0].patches.1]];
            for (b, flank_body) in bodies.iter().enumerate() {
                let local: Vec<Support> = group.iter().map(|row| flank_body.own(&row.supports[b])).collect();
                for (j, column) in local.iter().map(|s| flank_body.displacement(s)).enumerate() {
                    for (i, support) in local.iter().enumerate() {
                        x[(start + i, start + j)] -= opening(support, &column);
                    }
                }
            }
            start += group.len();
        }
        x
    }
}

impl FlankBody {
    /// A support in the half tooth's own numbers.
    fn own(&self, support: &Support) -> Support {
        let mut own = *support;
        for node in &mut own.nodes[..support.count] {
            *node = self.boundary.partition_point(|b| b < node) as u32;
        }
        own
    }

    /// W_c A' for a unit force at the support, mm/N.
    fn displacement(&self, support: &Support) -> Vec<f64> {
        let w = &self.local.compliance;
        let mut u = vec![0.0; w.nrows()];
        for k in 0..support.count {
            for axis in 0..3 {
                let f = support.weights[k] * support.load[axis];
                let column = w.col(3 * support.nodes[k] as usize + axis);
                u.iter_mut().zip(column.iter()).for_each(|(u, c)| *u += f * c);
            }
        }
        u
    }
}

/// The half tooth behind a flank; with the half tooth `known` of another its layer alone.
fn flank_body(
    (gear, geometry): (&ElasticGear, &Gear),
    (tooth, side): (u32, Side),
    number: impl Fn(u32) -> Option<u32>,
    which: usize,
    known: Option<Arc<LocalCompliance>>,
) -> Result<FlankBody, ContactError> {
    let fail = |source| ContactError::Reduction { gear: ["pinion", "wheel"][which], source };
    let is_known = known.is_some();
    let local = match (known, gear) {
        (Some(known), _) => known,
        (None, ElasticGear::Reduced(r)) => r.local_compliance(geometry, tooth, side).map_err(fail)?,
        (None, ElasticGear::Full(f)) => {
            Arc::new(LocalCompliance::new(&f.gear, geometry, &f.material, &f.elements, tooth, side).map_err(fail)?)
        }
    };
    let material = gear.material();
    let flank = geometry.flank_of(side, i64::from(tooth));
    let (profile, edge_radius) = (local.layer.clone(), geometry.data().tip_edge_radius);
    let layer = ToothLayer::new(flank, material.young_mpa(), material.poisson(), local.overshoot, profile, edge_radius);
    let numbered = |&node: &u32| {
        number(node).ok_or_else(|| ContactError::NotOnBoundary { patch: format!("tooth {tooth}'s flank"), node })
    };
    let boundary = match is_known {
        true => Vec::new(),
        false => local.nodes.iter().map(numbered).collect::<Result<_, _>>()?,
    };
    Ok(FlankBody { layer, local, boundary })
}
