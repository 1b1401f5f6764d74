//! What a user should hear of a gearbox in motion.

use std::f64::consts::TAU;

use answer::Remark;
use scene::gearbox::{Gearbox, GearboxDrive, GearboxMotion};

use super::{GearboxMotionResult, orders::MotionOrder, swings::few_modes};
use crate::{
    remark,
    run_up::{coarse_cut, cut_peak},
};

impl GearboxMotionResult {
    /// What a user should hear of the motion; meshes by their names.
    pub(super) fn remarks(&self, file: &Gearbox, asked: &GearboxMotion) -> Vec<Remark> {
        let torque = self.run_up.and_then(|run_up| run_up.remark("the input", "more `cycles` make it gentler"));
        let cut = self.run_up.and_then(|_| self.coarse_cut(file));
        // A motion that a torque drives has no given speed at which it could come back.
        let alone =
            (self.common_period.is_none() && asked.drive != GearboxDrive::Torque).then(remark::no_common_period);
        let own = self.map_remarks.iter().cloned().chain(self.unsettled(asked));
        let growth = asked.to_speed_rpm.map_or(1.0, |to| (to / asked.speed_rpm).max(1.0));
        let fastest = growth * self.mesh_frequencies.iter().fold(0.0, |m: f64, hz| m.max(*hz));
        let few = few_modes(file, &self.gear_modes, fastest);
        own.chain(torque).chain(cut).chain(alone).chain(few).collect()
    }

    /// The order cut with fewest points across its peak: of each mesh the order with the largest amplitude of its own
    /// transmission error.
    fn coarse_cut(&self, file: &Gearbox) -> Option<Remark> {
        let largest = |mesh: usize| {
            let cut = |order: usize| -> Vec<&MotionOrder> {
                self.orders.iter().filter(|o| (o.mesh, o.order) == (mesh, order)).collect()
            };
            let peak =
                |cut: &[&MotionOrder]| cut_peak(&cut.iter().map(|o| o.transmission_errors[mesh]).collect::<Vec<_>>());
            let orders = self.orders.iter().filter(|o| o.mesh == mesh).map(|o| o.order).max().unwrap_or(0);
            let all = (1..=orders).filter_map(|order| {
                let cut = cut(order);
                let peak = peak(&cut)?;
                Some((peak, cut[peak.at]))
            });
            all.max_by(|a, b| a.1.transmission_errors[mesh].total_cmp(&b.1.transmission_errors[mesh]))
        };
        let (peak, at) = (0..file.meshes.len()).filter_map(largest).min_by_key(|(peak, _)| peak.points)?;
        let of = format!(" of mesh {}", file.meshes[at.mesh].name);
        coarse_cut(
            peak,
            (&of, at.order),
            at.speed.abs() * 60.0 / TAU,
            "more `cycles` or fewer `waterfall_cycles` show it better",
        )
    }

    /// What a user should hear of a motion that was to settle.
    fn unsettled(&self, asked: &GearboxMotion) -> Option<Remark> {
        let (tolerance, most) = asked.settle?;
        let found = self.periodicity?;
        let early = self.warm_up_cycles < u64::from(most);
        if found.residual <= tolerance {
            return None;
        }
        Some(if early {
            remark::repeats_and_drifts(tolerance, self.warm_up_cycles, found.residual)
        } else {
            let why = "it may be chaotic, have pitch errors, or need more `warm_up_cycles`";
            remark::not_periodic(self.warm_up_cycles, found.residual, tolerance, why)
        })
    }
}
