//! Flanks, contact points and matrices of one window of both gears.

use std::sync::Arc;

use ale::ToothWindow;
use geometry::{Gear, GearPair, ModifiedFlank, Side};
use reduction::{ElasticGear, LayerStack, Window};

use crate::{
    Condensed, ContactError, ContactOptions, FullContact, Method, Pose,
    complementarity::{Law, LinearContact},
    compliance::boundary_forces,
    flank::{Candidates, ContactPoint, FlankPatch, GapSource, contact_points},
    nodal::{ContactRow, LinePoints, Scene, line_points},
    slice::{HalfTeeth, SliceSet, TableFlanks},
};

/// All data that the contact of one window needs, in the frames of the window's matrices.
///
/// Copies share everything except the position of the window.
#[derive(Debug, Clone)]
pub struct ContactSet {
    shared: Arc<Shared>,
    /// Reduced windows; `None` for full gears.
    windows: Option<[Window; 2]>,
}

/// Data that all windows with the same matrices share.
#[derive(Debug)]
struct Shared {
    patches: [Vec<FlankPatch>; 2],
    /// What points need; none for slices, which find their partner without it.
    nodal: Option<NodalFlanks>,
    /// Side of each patch.
    sides: [Vec<Side>; 2],
    /// First tooth of each gear's window in the frame of its matrices.
    first: [u32; 2],
    slices: Option<Arc<SliceSet>>,
    /// Whether a gear's teeth differ, so that the flanks of a window belong to its very teeth.
    own_teeth: [bool; 2],
}

/// What the contact of points needs beside the flank patches.
#[derive(Debug)]
struct NodalFlanks {
    /// Contact points of each patch of the pinion.
    points: Vec<Vec<ContactPoint>>,
    /// Faces of both gears for stage 1.
    trees: [Candidates; 2],
    /// Axial stations for points of least gap: twice as many as Gauss points lie along the face.
    stations: usize,
}

impl NodalFlanks {
    fn new([first, second]: [&[FlankPatch]; 2], options: &ContactOptions) -> Self {
        let points = first.iter().map(|p| contact_points(p, options.points_per_face_edge, options.gap)).collect();
        let stations = first.first().map_or(0, |p| {
            let [low, high] = p.range();
            let faces = ((high[1] - low[1]) / p.mean_face_size()[1]).round().max(1.0);
            2 * faces as usize * options.points_per_face_edge
        });
        Self { points, trees: [Candidates::new(first), Candidates::new(second)], stations }
    }
}

const NAMES: [&str; 2] = ["pinion", "wheel"];

impl ContactSet {
    /// Sets up the flanks of a window.
    ///
    /// # Errors
    /// [`ContactError`] if a flank is missing or does not lie on its smooth surface.
    pub fn new(
        pair: &GearPair,
        gears: &[ElasticGear; 2],
        window: &ToothWindow,
        options: &ContactOptions,
    ) -> Result<Self, ContactError> {
        let first_teeth = window.first_teeth();
        let geometry = [&pair.pinion, &pair.wheel];
        let of = |i: usize| {
            let own = (geometry[i], slice_width(pair, options));
            flanks(&gears[i], own, first_teeth[i], window.count(), options, NAMES[i])
        };
        let [Flanks { patches: p1, sides: s1, first: f1, window: w1, condensed: c1 }, second] = [of(0)?, of(1)?];
        let Flanks { patches: p2, sides: s2, first: f2, window: w2, condensed: c2 } = second;
        let behind = (options.method == Method::Slice)
            .then(|| {
                let named = |p: &[FlankPatch], s: &[Side]| -> Vec<(u32, Side)> {
                    p.iter().zip(s).map(|(p, &s)| (p.tooth as u32, s)).collect()
                };
                let flanks = [named(&p1, &s1), named(&p2, &s2)];
                let number = |i: usize, flank, node| boundary_number(&gears[i], [&w1, &w2][i].as_ref(), flank, node);
                HalfTeeth::new(pair, gears, [&flanks[0], &flanks[1]], number, options)
            })
            .transpose()?;
        let windows = w1.zip(w2).map(|(a, b)| [a, b]);
        let tabulated =
            [(&p1, &c1, &gears[0]), (&p2, &c2, &gears[1])].map(|(patches, condensed, gear)| match condensed {
                Some((condensed, stack)) => TableFlanks::Layers { condensed, stack: *stack, whole: patches },
                None => {
                    let cyclic = matches!(gear, ElasticGear::Reduced(r) if r.is_cyclic());
                    TableFlanks::Whole { patches, alike: cyclic && options.sides().len() == 1 }
                }
            });
        let behind = behind
            .map(|half| half.with_tables(tabulated, gears, windows.as_ref(), options).map(Arc::new))
            .transpose()?;
        let slices = behind.map(|half| Arc::new(SliceSet::new(pair, half, options)));
        let nodal = (options.method == Method::Nodal).then(|| NodalFlanks::new([&p1, &p2], options));
        let own_teeth = geometry.map(Gear::has_own_teeth);
        let (patches, sides, first) = ([p1, p2], [s1, s2], [f1, f2]);
        let shared = Arc::new(Shared { patches, nodal, sides, first, slices, own_teeth });
        Ok(Self { shared, windows })
    }

    /// A window of the same gears with the micro-geometry of `pair` and another number of slices; matrices, tables and
    /// faces are shared. `None` if that window has different matrices.
    ///
    /// # Errors
    /// [`ContactError`] for a window that the gears do not have.
    pub fn modified(
        &self,
        pair: &GearPair,
        gears: &[ElasticGear; 2],
        window: &ToothWindow,
        options: &ContactOptions,
    ) -> Result<Option<Self>, ContactError> {
        let Some(windows) = self.windows_with_these_matrices(gears, window)? else { return Ok(None) };
        let (shared, geometry) = (&self.shared, [&pair.pinion, &pair.wheel]);
        let patches = [0, 1].map(|i| {
            let shift = i64::from(windows[i].shift);
            let of_flank = |(patch, &side): (&FlankPatch, &Side)| {
                let flank = geometry[i].modified_flank_at(side, patch.tooth, patch.tooth + shift);
                patch.with_surface(Box::new(as_contact_sees_it(flank, slice_width(pair, options))))
            };
            shared.patches[i].iter().zip(&shared.sides[i]).map(of_flank).collect::<Vec<_>>()
        });
        let nodal = shared.nodal.as_ref().map(|_| NodalFlanks::new(patches.each_ref().map(|p| &p[..]), options));
        let own_teeth = geometry.map(Gear::has_own_teeth);
        let slices = shared.slices.as_ref().map(|slices| Arc::new(slices.cut_anew(pair, options)));
        let (sides, first) = (shared.sides.clone(), shared.first);
        let shared = Arc::new(Shared { patches, nodal, sides, first, slices, own_teeth });
        Ok(Some(Self { shared, windows: Some(windows) }))
    }

    /// A window's own where its matrices are those of this set, of the same teeth in their frames.
    fn windows_with_these_matrices(
        &self,
        gears: &[ElasticGear; 2],
        window: &ToothWindow,
    ) -> Result<Option<[Window; 2]>, ContactError> {
        let Some(mine) = &self.windows else { return Ok(None) };
        let first = window.first_teeth();
        let mut next = mine.clone();
        // A window with matrices of its own takes long to make, and nobody has asked for it here.
        if (0..2).any(|i| !gears[i].shares_matrices(&mine[i], first[i])) {
            return Ok(None);
        }
        for i in 0..2 {
            let w = gears[i].window(first[i]).map_err(|source| ContactError::Reduction { gear: NAMES[i], source })?;
            let Some(w) = w else { return Ok(None) };
            if !Arc::ptr_eq(&w.reduced, &mine[i].reduced) || w.reduced.teeth.len() != window.count() {
                return Ok(None);
            }
            next[i] = w;
        }
        Ok(Some(next))
    }

    /// Moves this set to another window and returns whether that is possible: the matrices and the teeth in their
    /// frames must be the same.
    pub fn move_to(&mut self, gears: &[ElasticGear; 2], window: &ToothWindow) -> Result<bool, ContactError> {
        let next = self.windows_with_these_matrices(gears, window)?;
        let (Some(mine), Some(next)) = (&mut self.windows, next) else { return Ok(false) };
        // Teeth with errors of their own are others in another place.
        if (0..2).any(|i| next[i].shift != mine[i].shift && self.shared.own_teeth[i]) {
            return Ok(false);
        }
        *mine = next;
        Ok(true)
    }

    /// The set of another window with the same matrices: this one if it serves that window, otherwise one with the
    /// flanks of the teeth there. `None` if that window has different matrices.
    ///
    /// # Errors
    /// [`ContactError`] for a window that the gears do not have.
    pub fn in_window(
        &self,
        pair: &GearPair,
        gears: &[ElasticGear; 2],
        window: &ToothWindow,
        options: &ContactOptions,
    ) -> Result<Option<Self>, ContactError> {
        let mut own = self.clone();
        if own.move_to(gears, window)? { Ok(Some(own)) } else { self.modified(pair, gears, window, options) }
    }

    /// Whether another window has the same flanks and matrices.
    pub fn shares_flanks(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shared, &other.shared)
    }

    /// The reduced windows of both gears.
    pub fn windows(&self) -> Option<&[Window; 2]> {
        self.windows.as_ref()
    }

    /// First tooth of each gear's window in the frame of its matrices.
    pub fn first_teeth(&self) -> [u32; 2] {
        self.shared.first
    }

    /// Flank patches of both gears.
    pub fn patches(&self) -> &[Vec<FlankPatch>; 2] {
        &self.shared.patches
    }

    /// Number of contact points of the window, or of slices of all its pairs.
    pub fn candidate_count(&self) -> usize {
        let points = |nodal: &NodalFlanks| nodal.points.iter().map(Vec::len).sum();
        let slices = |slices: &SliceSet| self.pairs().len() * slices.stations().len();
        self.shared.nodal.as_ref().map(points).or(self.slices().map(slices)).unwrap_or(0)
    }

    /// Side of a patch of the pinion.
    pub fn side(&self, patch: usize) -> Side {
        self.shared.sides[0][patch]
    }

    /// Patch of the pinion's (0) or wheel's (1) flank of a window pair; pairs are counted from 0 in ascending running
    /// number.
    pub fn patch_of(&self, gear: usize, pair: usize, side: Side) -> Option<usize> {
        let count = self.shared.patches[gear].len() / self.kept_sides();
        // The wheel's teeth run against the pair numbers.
        let tooth = if gear == 0 { pair } else { count.checked_sub(pair + 1)? };
        (0..self.kept_sides())
            .map(|s| tooth * self.kept_sides() + s)
            .find(|&p| self.shared.sides[gear].get(p) == Some(&side))
    }

    /// Window pair of a patch of the pinion, counted from 0.
    pub fn pair_of(&self, patch: usize) -> usize {
        patch / self.kept_sides()
    }

    /// Whether a patch of the pinion and one of the wheel face each other. Any others stay whole tooth
    /// thicknesses apart, yet their smooth surfaces, which go on behind the teeth, may look like deep penetration.
    pub(crate) fn partners(&self, (first, second): (usize, usize)) -> bool {
        self.partner_of(first) == Some(second)
    }

    /// The wheel's patch that one of the pinion faces. Driving flanks: of the pair's own tooth. Behind them a tooth of
    /// the pinion is followed by the next tooth of the wheel, which belongs to the neighbouring pair; of the last tooth
    /// in the window it is not kept.
    fn partner_of(&self, first: usize) -> Option<usize> {
        let sides = &self.shared.sides[0];
        let (side, pair) = (*sides.get(first)?, self.pair_of(first));
        let pair = match side {
            side if sides.first() == Some(&side) => Some(pair),
            Side::Left => Some(pair + 1),
            Side::Right => pair.checked_sub(1),
        };
        self.patch_of(1, pair?, side)
    }

    fn kept_sides(&self) -> usize {
        let first = self.shared.patches[0].first().map(|p| p.tooth);
        self.shared.patches[0].iter().take_while(|p| Some(p.tooth) == first).count().max(1)
    }

    /// Points of smallest gap of the window's pairs with the gears at `poses`. Empty if points need an area (penalty
    /// law), or if gaps are not those of the smooth flanks.
    ///
    /// They are taken at the unloaded pose, so that they do not move while the pose is iterated.
    pub fn line_points(&self, options: &ContactOptions, poses: &[Pose; 2]) -> LinePoints {
        let mut line = LinePoints::new();
        let Some(nodal) = &self.shared.nodal else { return line };
        if options.law != Law::Exact || options.gap != GapSource::Smooth {
            return line;
        }
        let [first, second] = &self.shared.patches;
        for (a, b) in self.pairs() {
            line.insert((a, b), line_points(&first[a], &second[b], poses, nodal.stations));
        }
        line
    }

    /// The flanks of the window for a search of points; `line` has the points of smallest gap. `None` for contact of
    /// slices.
    pub fn scene<'a>(&'a self, options: &ContactOptions, line: &'a LinePoints) -> Option<Scene<'a>> {
        let nodal = self.shared.nodal.as_ref()?;
        Some(Scene {
            first: &self.shared.patches[0],
            points: &nodal.points,
            second: &self.shared.patches[1],
            first_tree: &nodal.trees[0],
            second_tree: &nodal.trees[1],
            source: options.gap,
            line,
        })
    }

    /// The slices, for contact of slices.
    pub fn slices(&self) -> Option<&SliceSet> {
        self.shared.slices.as_deref()
    }

    /// Pairs of patches that face each other.
    pub fn pairs(&self) -> Vec<(usize, usize)> {
        let partner = |p: usize| Some((p, self.partner_of(p)?));
        (0..self.shared.patches[0].len()).filter_map(partner).collect()
    }

    /// Displacements of both gears' boundary coordinates, mm, in the frames of the matrices, under forces (N) on rows
    /// with known nodes. `None` if there are no matrices of the flanks, or not for their whole width.
    pub fn displacements_under(&self, rows: &[ContactRow], forces: &[f64]) -> Option<[Vec<f64>; 2]> {
        let [a, b] = self.windows.as_ref()?;
        let compliance = [a.reduced.compliance().as_ref(), b.reduced.compliance().as_ref()];
        if compliance.iter().any(|c| c.ncols() < c.nrows()) {
            return None;
        }
        Some(Condensed::new(rows, compliance).displacements(forces))
    }

    /// Forces (N) on both gears' boundary coordinates, in the frames of the matrices, from forces on rows with known
    /// nodes. `None` if there are no matrices of the flanks.
    pub fn forces_of(&self, rows: &[ContactRow], forces: &[f64]) -> Option<[Vec<f64>; 2]> {
        let windows = self.windows.as_ref()?;
        Some([0, 1].map(|i| boundary_forces(rows, forces, i, windows[i].reduced.coordinates())))
    }

    /// X F of slices, mm: what their rows open beside the matrices of both gears under forces F (N), without the local
    /// approach; negative, for it is what the matrices have of the half teeth. Zero for contact of points. Theory (38).
    pub fn beside_matrices(&self, rows: &[ContactRow], forces: &[f64]) -> Vec<f64> {
        let Some(slices) = &self.shared.slices else { return vec![0.0; rows.len()] };
        let correction = slices.correction(rows);
        let of_row = |i: usize| forces.iter().enumerate().map(|(j, f)| correction[(i, j)] * f).sum();
        (0..rows.len()).map(of_row).collect()
    }

    /// S between rows, mm/N, column by column, from the matrices as they are.
    pub(crate) fn exact_compliance(&self, rows: &[ContactRow], out: &mut Vec<f64>) {
        out.clear();
        if let Some([a, b]) = &self.windows {
            let compliance = [a.reduced.compliance().as_ref(), b.reduced.compliance().as_ref()];
            let correction = self.shared.slices.as_ref().map(|s| s.correction(rows));
            Condensed::new(rows, compliance).corrected(correction).matrix(out);
        }
    }

    /// The elastic model for the rows.
    pub fn bodies<'a>(
        &'a self,
        gears: &'a [ElasticGear; 2],
        rows: &'a [ContactRow],
    ) -> Result<Box<dyn LinearContact + 'a>, ContactError> {
        let correction = self.shared.slices.as_ref().map(|s| s.correction(rows));
        match (&self.windows, gears) {
            (Some([a, b]), _) => {
                let compliance = [a.reduced.compliance().as_ref(), b.reduced.compliance().as_ref()];
                Ok(Box::new(Condensed::new(rows, compliance).corrected(correction)))
            }
            (None, [ElasticGear::Full(a), ElasticGear::Full(b)]) => {
                Ok(Box::new(FullContact::new(rows, [a, b], correction)))
            }
            _ => Err(ContactError::MixedGears),
        }
    }
}

/// Flanks of one gear's window.
struct Flanks {
    patches: Vec<FlankPatch>,
    sides: Vec<Side>,
    /// First tooth in the frame of the matrices.
    first: u32,
    window: Option<Window>,
    /// Of a wide gear the flanks of the one that is condensed in its place; `patches` then have no mesh.
    condensed: Option<(Vec<FlankPatch>, LayerStack)>,
}

/// Axial length of a slice, mm; none where points are pressed.
fn slice_width(pair: &GearPair, options: &ContactOptions) -> Option<f64> {
    (options.method == Method::Slice).then(|| pair.face_width() / options.slices.max(1) as f64)
}

/// Slices of an axial length (mm) see a measured flank by its smooth part, and the rest by means over their bands; points
/// see it as it is.
fn as_contact_sees_it(flank: ModifiedFlank, slice: Option<f64>) -> ModifiedFlank {
    match slice {
        Some(width) => flank.split(width),
        None => flank,
    }
}

/// Flank patches of one gear's window, tooth by tooth counter-clockwise, in the frame of its matrices.
fn flanks(
    elastic: &ElasticGear,
    (geometry, slice): (&Gear, Option<f64>),
    first: u32,
    count: usize,
    options: &ContactOptions,
    name: &'static str,
) -> Result<Flanks, ContactError> {
    let gear = elastic.gear();
    let z = gear.tooth_count();
    let window = elastic.window(first).map_err(|source| ContactError::Reduction { gear: name, source })?;
    let teeth: Vec<u32> = match &window {
        Some(w) => w.reduced.teeth.clone(),
        None => (0..count as u32).map(|i| (first + i) % z).collect(),
    };
    // The frame of a cyclic gear's matrices is turned against the gear: pitch errors stay with the gear's own teeth.
    let shift = window.as_ref().map_or(0, |w| w.shift);
    let (mut patches, mut sides, mut condensed) = (Vec::new(), Vec::new(), Vec::new());
    let stack = match elastic {
        ElasticGear::Reduced(r) => r.stack(),
        ElasticGear::Full(_) => None,
    };
    for &tooth in &teeth {
        for side in options.sides() {
            let (nodes, faces) = flank_mesh(elastic, tooth, side).ok_or_else(|| ContactError::Reduction {
                gear: name,
                source: reduction::ReductionError::MissingFlank { tooth, side, available: gear.teeth() },
            })?;
            let number = |node: u32| boundary_number(elastic, window.as_ref(), (tooth, side), node);
            let flank = || geometry.modified_flank_at(side, i64::from(tooth), i64::from(tooth + shift));
            let surface = || Box::new(as_contact_sees_it(flank(), slice));
            let patch = FlankPatch::new(i64::from(tooth), surface(), nodes, faces, number, options.surface_tolerance)
                .map_err(|source| ContactError::Flank { gear: name, source: Box::new(source) })?;
            if stack.is_some() {
                let ([[low, _], [high, _]], half) = (patch.range(), 0.5 * geometry.data().face_width);
                patches.push(FlankPatch::rigid(i64::from(tooth), surface(), [[low, -half], [high, half]]));
                condensed.push(patch);
            } else {
                patches.push(patch);
            }
            sides.push(side);
        }
    }
    let first = teeth.first().copied().unwrap_or(0);
    Ok(Flanks { patches, sides, first, window, condensed: stack.map(|stack| (condensed, stack)) })
}

/// Nodes and faces that carry the load of a flank: the mesh's own, or those of the grid over it.
fn flank_mesh(elastic: &ElasticGear, tooth: u32, side: Side) -> Option<(&[[f64; 3]], &[mesh::Face])> {
    match elastic {
        ElasticGear::Reduced(r) => r.flank(tooth, side),
        ElasticGear::Full(f) => f.gear.flank(tooth, side).map(|faces| (&f.gear.mesh().nodes[..], faces)),
    }
}

/// Number that a node of a flank has among the boundary nodes of a gear; `None` for a node that its matrices do not
/// know.
fn boundary_number(elastic: &ElasticGear, window: Option<&Window>, flank: (u32, Side), node: u32) -> Option<u32> {
    let position = match (window, elastic) {
        (Some(window), ElasticGear::Reduced(r)) => r.boundary_position(window, flank, node),
        (None, ElasticGear::Full(f)) => f.dofs.position(node),
        _ => None,
    };
    position.map(|p| p as u32)
}
