//! A pair under each load of its spectrum: solved cycles, and the inputs of the rating.

use std::{collections::BTreeSet, ops::ControlFlow};

use fem::Wanted;
use gearbox::MeshState;
use geometry::GearPair;
use ltca::{LoadCycle, RootPattern, StaticHistory, StaticModel, StaticPosition};
use rating::{FlankPlace, LoadBin, LocalDamage, RatedLoad, RatedSpectrum, SolvedStress};
use scene::{DataFile, Scene};
use study::FlankPattern;

use crate::{
    AnalysisError, Observer, PhaseWork,
    certificate::verdict,
    error::place_in,
    failure::Failure,
    plausible,
    refused::Refusal,
    results::{diameter, face_load_factor, mesh_roots, patterns, pressed},
    run_phase, solver_error, static_certificate, unless_cancelled,
};

/// The mesh cycles of a scene under each other torque of its load spectrum, as long as they are wanted; none without one,
/// and of models that put no load on places.
///
/// # Errors
/// [`Failure::Static`] where the window is too narrow for a load; [`AnalysisError::Certificate`] of a cycle that does not
/// hold.
pub(crate) fn under_loads(
    scene: &Scene,
    model: &StaticModel,
    (wanted, observer): (Wanted<'_>, &mut dyn Observer),
) -> Result<Vec<LoadCycle>, Failure> {
    let torques = torques(scene);
    if torques.is_empty() || !scene.has_slices() {
        return Ok(Vec::new());
    }
    let (per_cycle, cycles) = (scene.analysis.positions_per_cycle, scene.analysis.cycles);
    run_phase(observer, "load spectrum", PhaseWork::Steps(torques.len() as u64), |progress| {
        let one = |torque_nm: f64| {
            let torque = model.options().torque * torque_nm / scene.operation.torque_nm;
            let goes_on = || if wanted() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
            let solved = model.under_torque(torque);
            let solved =
                solved.and_then(|mut own| own.run_while(per_cycle as usize, cycles as usize, |_, _, _| goes_on()));
            let of_load = |e: AnalysisError| e.of_part(format!("the load of {torque_nm} N m"));
            let history = solved.map_err(|e| match e.is_starved() {
                true => Failure::Static(e),
                false => of_load(solver_error(scene, e)).into(),
            })?;
            progress.tick();
            unless_cancelled(progress)?;
            if !wanted() {
                return Err(AnalysisError::Cancelled.into());
            }
            verdict(&static_certificate(scene, &history.positions), scene).map_err(of_load)?;
            Ok(LoadCycle { torque, positions: history.positions, roots: history.roots })
        };
        torques.into_iter().map(one).collect()
    })
}

/// Refuses a spectrum with a load that the pair is refused under, before any work.
///
/// # Errors
/// [`AnalysisError::Refused`] at the spectrum's place.
pub(crate) fn check_loads(scene: &Scene, pair: &GearPair) -> Result<(), AnalysisError> {
    for torque_nm in torques(scene) {
        let mut under = scene.clone();
        under.operation.torque_nm = torque_nm;
        if let Some(beyond) = plausible::beyond(&under, pair) {
            let hint = "leave the load out of the table, or write it in N m: loads are torques on the driven gear";
            let refused = AnalysisError::from(Refusal::input(format!("a load of the spectrum: {}", beyond.said), hint));
            return Err(refused.at(place_in(scene, &["rating.spectrum"])));
        }
    }
    Ok(())
}

/// Torques of the loads that do damage, N m, each once and ascending, but that of the scene.
fn torques(scene: &Scene) -> Vec<f64> {
    let nominal = scene.operation.torque_nm;
    let Some(spectrum) = scene.rating.as_ref().and_then(|own| own.spectrum.as_ref()).map(DataFile::values) else {
        return Vec::new();
    };
    // Bits of numbers above 0 are in their order.
    let all: BTreeSet<u64> = spectrum.harmful(nominal).map(|bin| bin.torque_nm.to_bits()).collect();
    all.into_iter().map(f64::from_bits).filter(|torque| nominal > 0.0 && *torque != nominal).collect()
}

/// What a rating reads of a pair under one torque.
#[derive(Debug)]
pub(crate) struct SolvedLoad {
    /// Torque on the driven gear, N m.
    pub torque_nm: f64,
    /// K_Hbeta of the solved distribution of the load; `None` where points touch.
    pub face_load_factor: Option<f64>,
    /// Largest pressures on the driving flanks of pinion and wheel; `None` where points touch.
    pub flanks: Option<[FlankPattern; 2]>,
    /// Largest tensions at the points of the fillets; `None` where they are not computed.
    pub roots: Option<[RootPattern; 2]>,
}

impl SolvedLoad {
    /// Values for all torques of a history, including its own; empty if it has no further torques.
    ///
    /// # Errors
    /// [`AnalysisError`] if the positions give no pattern.
    pub fn all(scene: &Scene, pair: &GearPair, history: &StaticHistory) -> Result<Vec<Self>, AnalysisError> {
        if scene.rating.as_ref().is_none_or(|own| own.spectrum.is_none()) || history.positions.is_empty() {
            return Ok(Vec::new());
        }
        let nominal = scene.operation.torque_nm;
        let share = |own: &LoadCycle| own.torque / scene.operation.torque();
        let others = history.under_loads.iter().map(|own| (nominal * share(own), &own.positions, &own.roots));
        let all = std::iter::once((nominal, &history.positions, &history.roots)).chain(others);
        all.map(|own| Self::of(scene, pair, own)).collect()
    }

    /// Values for a mesh of a gearbox, whose slices are those of all its tooth pairs.
    ///
    /// # Errors
    /// [`AnalysisError`] if the slices give no pattern.
    pub fn of_mesh(
        scene: &Scene,
        pair: &GearPair,
        (torque_nm, meshes): (f64, &[&MeshState]),
    ) -> Result<Self, AnalysisError> {
        let slices = || meshes.iter().flat_map(|own| &own.slices);
        let step = meshes.windows(2).map(|two| (two[1].cycles - two[0].cycles).abs()).fold(0.0, f64::max);
        let flank = |gear: usize| pressed(scene, pair, gear, (slices(), step));
        let flanks = if scene.has_slices() { Some([flank(0)?, flank(1)?]) } else { None };
        let count = scene.contact.slices.unwrap_or(1) as usize;
        Ok(Self {
            torque_nm,
            face_load_factor: ltca::face_load_factor(count, slices()),
            flanks,
            roots: mesh_roots(meshes, scene.side()),
        })
    }

    fn of(
        scene: &Scene,
        pair: &GearPair,
        (torque_nm, positions, roots): (f64, &Vec<StaticPosition>, &Option<[RootPattern; 2]>),
    ) -> Result<Self, AnalysisError> {
        let flanks = scene.has_slices().then(|| patterns(scene, pair, positions)).transpose()?;
        Ok(Self {
            torque_nm,
            face_load_factor: face_load_factor(scene.contact.slices.unwrap_or(1) as usize, positions),
            flanks: flanks.map(|both| both.map(|own| own.grid)),
            roots: roots.clone(),
        })
    }

    /// Damage over a life from the pressures and root stresses of all loads; `None` if one of them is not solved, or
    /// has no pressures.
    pub fn damage(all: &[Self], spectrum: &RatedSpectrum, pair: &GearPair) -> Option<LocalDamage> {
        let stress = |own: &RatedLoad| {
            let solved = Self::under(all, &own.load)?;
            let pressures = solved.flanks.as_ref()?.each_ref().map(FlankPattern::max_pressure);
            let tensions = solved.roots.as_ref().map(|both| both.each_ref().map(|own| &own.tension[..]));
            Some(SolvedStress { pressures, tensions })
        };
        let under: Vec<SolvedStress<'_>> = spectrum.loads().iter().map(stress).collect::<Option<_>>()?;
        let grids = all.first()?.flanks.as_ref()?;
        let flank = |gear: usize, cell: usize| {
            let (rolls, base) = (grids[gear].rolls(), [&pair.pinion, &pair.wheel][gear].base_radius());
            let diameter_mm = diameter(base, rolls[cell % rolls.len()]);
            FlankPlace { diameter_mm, z_mm: grids[gear].stations()[cell / rolls.len()] }
        };
        let roots = all.first()?.roots.as_ref();
        LocalDamage::new(spectrum, &under, flank, |gear, point| {
            let [radius, z_mm] = roots.map_or([f64::NAN; 2], |both| both[gear].places[point]);
            FlankPlace { diameter_mm: 2.0 * radius, z_mm }
        })
    }

    /// Result of a load of the spectrum.
    pub fn under<'a>(all: &'a [Self], load: &LoadBin) -> Option<&'a Self> {
        // A torque comes back from N mm.
        all.iter().find(|own| (own.torque_nm - load.torque_nm).abs() <= 1e-12 * load.torque_nm)
    }
}
