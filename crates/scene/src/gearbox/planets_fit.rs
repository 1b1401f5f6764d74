//! Checks that planets of a gearbox file have room, and that their teeth can mesh.

use std::f64::consts::{PI, TAU};

use toml::Spanned;

use super::{
    file::{GearboxGear, GearboxMesh, GearboxShaft},
    planets::{Group, ON_AXIS, Planet, WrittenOut},
    schema::RawPlanets,
    values::Checked,
};
use crate::Source;

/// Share of a pitch by which teeth may miss each other: digits of stated angles.
const MISSED: f64 = 1e-4;

impl WrittenOut {
    /// Checks that gears of two planets of a group do not touch.
    pub fn apart(
        &self,
        s: &Source<'_>,
        table: &Spanned<RawPlanets>,
        group: usize,
        (shafts, gears, meshes): (&[GearboxShaft], &[GearboxGear], &[GearboxMesh]),
    ) -> Checked<()> {
        let own = |shaft: usize| self.shafts[shaft].filter(|p| p.group == group);
        for (i, mesh) in meshes.iter().enumerate() {
            if self.meshes[i].planet.is_none_or(|p| p.group != group) {
                continue;
            }
            let pair = mesh.scene.gear_pair()?;
            for (gear, shape) in mesh.gears.into_iter().zip([&pair.pinion, &pair.wheel]) {
                let Some(Planet { planet, .. }) = own(gears[gear].shaft) else { continue };
                // Copies of a shaft stand one after the other.
                let first = |g: usize, planet: usize| gears[g].shaft - planet;
                let same = (0..gears.len()).filter(|g| {
                    let of = own(gears[*g].shaft).filter(|p| p.planet != planet);
                    of.is_some_and(|p| first(*g, p.planet) == first(gear, planet))
                        && gears[*g].position == gears[gear].position
                });
                let place = |g: usize| shafts[gears[g].shaft].origin;
                for other in same {
                    let [a, b] = [place(gear), place(other)];
                    let apart = (b[0] - a[0]).hypot(b[1] - a[1]);
                    let tip = 2.0 * shape.tip_radius();
                    if apart <= tip {
                        let said = format!(
                            "\"{}\" and \"{}\" run into each other: their axes are {apart:.3} mm apart, the tip diameter is {tip:.3} mm",
                            gears[gear].name, gears[other].name
                        );
                        return Err(s.conflict(
                            &table.span(),
                            said,
                            "fewer planets, other `angles_deg`, or smaller gears",
                        ));
                    }
                }
            }
        }
        Ok(())
    }

    /// Checks that teeth of every planet meet tooth spaces of all central gears. Theory (85c).
    ///
    /// ```text
    /// psi (z_a z_pb - z_b z_pa)/(2 pi gcd(z_pa, z_pb)) whole        z_b < 0 of a ring; z_p: teeth of the planet in mesh a and b
    /// ```
    pub fn go_in(
        &self,
        s: &Source<'_>,
        table: &Spanned<RawPlanets>,
        group: usize,
        (shafts, gears, meshes): (&[GearboxShaft], &[GearboxGear], &[GearboxMesh]),
    ) -> Checked<()> {
        let Group { around, angles, .. } = &self.groups[group];
        let Some(middle) = shafts.iter().find(|own| own.name == *around) else { return Ok(()) };
        let is_planet = |gear: usize| self.shafts[gears[gear].shaft].is_some_and(|p| p.group == group);
        let is_central = |gear: usize| {
            let at = shafts[gears[gear].shaft].origin;
            (at[0] - middle.origin[0]).hypot(at[1] - middle.origin[1]) < ON_AXIS
        };
        // Teeth of the central gear, signed, of the planet, and the name of the central gear.
        let central = |(i, mesh): (usize, &GearboxMesh)| {
            self.meshes[i].planet.filter(|p| p.group == group && p.planet == 0)?;
            let planet = mesh.gears.iter().position(|g| is_planet(*g))?;
            let other = 1 - planet;
            let teeth = |k: usize| {
                let own = [&mesh.scene.pinion, &mesh.scene.wheel][k];
                let teeth = i64::from(own.teeth);
                if own.is_internal() { -teeth } else { teeth }
            };
            is_central(mesh.gears[other]).then(|| (teeth(other), teeth(planet), gears[mesh.gears[other]].name.as_str()))
        };
        let all: Vec<(i64, i64, &str)> = meshes.iter().enumerate().filter_map(central).collect();
        for (i, a) in all.iter().enumerate() {
            for b in &all[i + 1..] {
                let steps = (a.0 * b.1 - b.0 * a.1) as f64 / gcd(a.1, b.1) as f64;
                for (planet, angle) in angles.iter().enumerate() {
                    let turns = angle * steps / TAU;
                    let missed = turns - turns.round();
                    if missed.abs() > MISSED {
                        let said = format!(
                            "planet {} at {:.4} degrees does not go in: with its teeth in \"{}\" it misses those of \"{}\" by {:.2} pitches",
                            planet + 1,
                            angle.to_degrees(),
                            a.2,
                            b.2,
                            missed.abs()
                        );
                        let step = 360.0 / steps.abs();
                        let nearest = (2.0 * PI * turns.round() / steps).to_degrees();
                        let advice = format!(
                            "angles are multiples of {step:.6} degrees, the nearest is {nearest:.6} (`angles_deg`); or take other teeth"
                        );
                        return Err(s.conflict(&table.span(), said, advice));
                    }
                }
            }
        }
        Ok(())
    }
}

fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}
