//! Contact of both sides, kept while the state does not change.

use super::PairMechanism;
use crate::{elastic_displacement::ElasticDisplacement, mesh_side::SideContacts};
use ltca::StaticError;

impl PairMechanism {
    /// Contact of both sides. The last result is kept, because several callers ask for it at the end of a step.
    pub(super) fn contact(
        &mut self,
        t: f64,
        d: &ElasticDisplacement,
        tangents: bool,
    ) -> Result<SideContacts, StaticError> {
        let serves = |last: &&SideContacts| last.at.0 == t && last.at.1 == *d && (last.tangents || !tangents);
        if let Some(last) = self.last.as_ref().filter(serves) {
            return Ok(last.clone());
        }
        let cycles = self.cycles(t);
        let Self { pair, drive_side, coast_side, last, .. } = self;
        let station = ale::Station::at_cycles(cycles);
        let fail = |source| StaticError::Contact { cycle: station.cycle, phase: station.phase, source };
        *last = None;
        let driving = drive_side.evaluate(pair, cycles, d, tangents).map_err(fail)?;
        let coast =
            coast_side.as_mut().map(|side| side.evaluate(pair, cycles, d, tangents)).transpose().map_err(fail)?;
        let side_contacts = SideContacts { at: (t, d.clone()), driving, coast, tangents };
        *last = Some(side_contacts.clone());
        Ok(side_contacts)
    }

    /// Strain energy of both sides and nothing else; the last contact is lost.
    pub(super) fn contact_energy(&mut self, t: f64, at: &ElasticDisplacement) -> Result<f64, StaticError> {
        let cycles = self.cycles(t);
        let Self { pair, drive_side, coast_side, last, .. } = self;
        let station = ale::Station::at_cycles(cycles);
        let fail = |source| StaticError::Contact { cycle: station.cycle, phase: station.phase, source };
        *last = None;
        let mut sum = 0.0;
        for side in std::iter::once(drive_side).chain(coast_side.as_mut()) {
            sum += side.energy(pair, cycles, at).map_err(fail)?;
        }
        Ok(sum)
    }
}
