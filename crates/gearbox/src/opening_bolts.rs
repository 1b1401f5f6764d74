//! Bolts of an elastic gear that carry its meshes: those that open are rows of their contact problem. Theory (38c).

use contact::slice::{FlanksOfBore, PressedBore};
use faer::Mat;
use mesh::Bolts;
use reduction::{BoltCompliance, BoltsAndFlanks, ReductionError};

use crate::pressed_bore::SeenBy;

/// Windows of a mesh of which matrices are kept: teeth change in turn, and come back.
const KEPT: usize = 3;

/// Force of a bolt on its gear, N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoltForce {
    /// Along the radius, positive where the bolt presses, with what it presses by before any load.
    pub radial: f64,
    /// Along the circumference, counter-clockwise seen from +z.
    pub tangential: f64,
    /// Along +z.
    pub axial: f64,
    /// Whether it has lifted off.
    pub open: bool,
}

/// Bolts of a gear of some joined meshes.
pub(crate) struct BoltsOfGear {
    /// Disc of the gear.
    pub disc: usize,
    /// Places of the gear's meshes among the joined ones, and its end there.
    pub meshes: Vec<(usize, usize)>,
    bolts: Bolts,
    levers: Vec<[f64; 6]>,
    gaps: Vec<f64>,
    shares: Vec<[(usize, f64); 2]>,
    own: Option<BoltCompliance>,
    /// By mesh and first tooth of the window; the last ones are those of the windows as they stand.
    known: Vec<((usize, u32), BoltsAndFlanks)>,
    /// Forces along the radii of bolts that open, N.
    forces: Vec<f64>,
}

impl BoltsOfGear {
    pub fn new(disc: usize, meshes: Vec<(usize, usize)>, bolts: Bolts) -> Self {
        let count = if bolts.opens_beyond.is_some() { bolts.count as usize } else { 0 };
        let preload = bolts.opens_beyond.unwrap_or(0.0);
        Self {
            disc,
            meshes,
            bolts,
            // A bolt is between the gear and its own shaft: it carries on no motion of theirs.
            levers: vec![[0.0; 6]; count],
            gaps: vec![-preload / bolts.stiffness[0]; count],
            shares: (0..count).map(|bolt| [(bolt, 1.0), (bolt, 0.0)]).collect(),
            own: None,
            known: Vec::new(),
            forces: vec![preload; count],
        }
    }

    /// Makes what is known of the gear where its meshes stand, if it is not: `seen` by each of them.
    pub fn stand(&mut self, seen: &[SeenBy<'_>]) -> Result<(), ReductionError> {
        if self.own.is_none() {
            self.own = Some(seen[0].reducer.bolt_compliance()?);
        }
        for (mesh, own) in seen.iter().enumerate() {
            let key = (mesh, own.window.reduced.teeth.first().copied().unwrap_or(0));
            let last = match self.known.iter().position(|known| known.0 == key) {
                Some(at) => self.known.remove(at),
                None => (key, own.reducer.bolts_and_flanks(own.window)?),
            };
            if self.known.len() >= KEPT * seen.len() {
                self.known.remove(0);
            }
            self.known.push(last);
        }
        Ok(())
    }

    /// What each mesh knows where it stands.
    fn now(&self) -> impl Iterator<Item = (&(usize, usize), &BoltsAndFlanks)> {
        let first = self.known.len().saturating_sub(self.meshes.len());
        self.meshes.iter().zip(self.known[first..].iter().map(|known| &known.1))
    }

    /// Law of a bolt along its radius: approach (mm) under a force (N), and its slope.
    pub fn law(&self) -> impl Fn(usize, f64) -> (f64, f64) + use<> {
        let stiffness = self.bolts.stiffness[0];
        move |_, force| (force / stiffness, 1.0 / stiffness)
    }

    /// Rows of bolts that open; `None` of others.
    pub fn pressed<'a>(&'a mut self, under: contact::slice::Approach<'a>) -> Option<PressedBore<'a>> {
        let own = self.own.as_ref().filter(|_| !self.gaps.is_empty())?;
        let first = self.known.len().saturating_sub(self.meshes.len());
        let flanks = self.meshes.iter().zip(&self.known[first..]);
        let flanks =
            flanks.map(|(&(contact, body), known)| FlanksOfBore { contact, body, columns: known.1.flanks.as_ref() });
        Some(PressedBore {
            gaps: &self.gaps,
            levers: &self.levers,
            approach: under,
            compliance: own.openings.as_ref(),
            shares: &self.shares,
            flanks: flanks.collect(),
            preload: self.bolts.opens_beyond.unwrap_or(0.0),
            forces: &mut self.forces,
        })
    }

    /// Forces of all bolts with these forces (N) on the coordinates of the gear in each of its meshes.
    pub fn carried(&self, on_flanks: &[Vec<f64>]) -> Vec<BoltForce> {
        let count = self.bolts.count as usize;
        let mut sums = vec![0.0; 3 * count];
        let mut add = |springs: &Mat<f64>, forces: &[f64]| {
            for (column, &force) in springs.col_iter().zip(forces).filter(|(_, force)| **force != 0.0) {
                sums.iter_mut().zip(column.iter()).for_each(|(sum, own)| *sum += own * force);
            }
        };
        for ((_, known), forces) in self.now().zip(on_flanks) {
            add(&known.springs, forces);
        }
        let preload = self.bolts.opens_beyond.unwrap_or(0.0);
        if let Some(own) = self.own.as_ref().filter(|_| !self.forces.is_empty()) {
            let beyond: Vec<f64> = self.forces.iter().map(|force| force - preload).collect();
            add(&own.springs, &beyond);
        }
        let bolt = |i: usize| {
            let lifts = self.forces.get(i);
            // Bolts that open have no other spring along the radius.
            let radial = lifts.copied().unwrap_or(sums[3 * i]);
            let open = lifts.is_some_and(|force| *force == 0.0);
            BoltForce { radial, tangential: sums[3 * i + 1], axial: sums[3 * i + 2], open }
        };
        (0..count).map(bolt).collect()
    }
}
