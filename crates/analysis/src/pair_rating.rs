//! Rating of a static pair by the standard, if its scene requests it.

use geometry::{FlankTolerances, Gear, GearPair};
use ltca::StaticHistory;
use lumped::iso::{IsoFlank, IsoRoot, IsoRootPair};
use rating::{
    ContactField, Deviations, Edition, FilmField, FlankFactors, GearInput, GivenFactors, LoadBin, LocalDamage,
    LocalScuffing, Lubrication, LubricationMethod, MeshLoss, MeshStiffness, MicropittingRating, PairGeometry,
    RatedSpectrum, RatingError, RatingInput, Rolling, RootFactors, ScuffingInput, ScuffingRating, SolvedContact,
    Spectrum, SpectrumRating, StandardMicropitting, StandardRating, local_bending_safety, local_pitting_safety,
    scuffing_rating, standard_micropitting, standard_rating,
};
use scene::{LubricationScene, RatingEdition, RatingScene, Scene};
use serde::Serialize;

use crate::{
    AnalysisError,
    error::place_in,
    loaded_pair::LoadedPair,
    results::PressurePlace,
    solved_load::{SolvedLoad, check_loads},
    solved_mesh::SolvedMesh,
};

/// The coarsest ISO 1328-1 class whose relief counts in K_V.
const RELIEF_CLASS: u32 = 5;
/// The coarsest class whose pairs share the load so evenly that Y_DT falls below 1.
const DEEP_TOOTH_CLASS: u32 = 4;
const NAMES: [&str; 2] = ["pinion", "wheel"];

described::described! {
    /// Safeties of a pair, the smallest first; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct RatingHeadline {
        /// smaller S_H of both gears
        pub least_pitting_safety: f64,
        /// gear with that safety: `pinion` or `wheel`
        pub least_pitting_safety_of: &'static str,
        /// 1 over the smaller S_H, for goals and limits of `ale-gear optimise`, which makes numbers small
        pub pitting_utilisation: f64,
        /// smaller S_F of both gears
        pub least_bending_safety: f64,
        /// gear with that safety: `pinion` or `wheel`
        pub least_bending_safety_of: &'static str,
        /// 1 over the smaller S_F
        pub bending_utilisation: f64,
        /// ratings of the standard
        #[serde(flatten)]
        pub standard: StandardRating,
        /// damage by the load spectrum; missing without `spectrum`
        #[serde(skip_serializing_if = "Option::is_none")]
        pub spectrum: Option<SpectrumRating>,
        /// damage by the load spectrum from the stresses solved under each load; missing without `spectrum` and for models without slices
        #[serde(skip_serializing_if = "Option::is_none")]
        pub local_spectrum: Option<LocalDamage>,
        /// safeties from the solved stresses; missing for models without slices
        #[serde(skip_serializing_if = "Option::is_none")]
        pub local: Option<LocalRating>,
        /// least safety against scuffing: flash temperature with its start of approach, integral temperature, and the solved contact; missing without `scuffing`
        #[serde(skip_serializing_if = "Option::is_none")]
        pub least_scuffing_safety: Option<f64>,
        /// scuffing by the standard; missing without `scuffing`
        #[serde(skip_serializing_if = "Option::is_none")]
        pub scuffing: Option<ScuffingRating>,
        /// scuffing by the solved contact; missing without `scuffing` and for models without slices
        #[serde(skip_serializing_if = "Option::is_none")]
        pub local_scuffing: Option<LocalScuffing>,
        /// micropitting by the solved contact; missing without `micropitting`
        #[serde(skip_serializing_if = "Option::is_none")]
        pub micropitting: Option<MicropittingRating>,
        /// micropitting by the standard, method B; missing without `micropitting` and from a transverse contact ratio of 2 on
        #[serde(skip_serializing_if = "Option::is_none")]
        pub standard_micropitting: Option<StandardMicropitting>,
        /// losses of the mesh by the friction of the oil; missing without `oil_temperature_c` and for models without slices
        #[serde(skip_serializing_if = "Option::is_none")]
        pub mesh_loss: Option<MeshLoss>,
        /// Contact temperature at any place of the flanks.
        #[serde(skip)]
        pub contact_field: Option<ContactField>,
        /// Film at any place of the flanks.
        #[serde(skip)]
        pub film_field: Option<FilmField>,
    }
}

/// What the solved contact says of oil and flanks.
#[derive(Debug, Default)]
struct Oiled {
    scuffing: Option<ScuffingRating>,
    local: Option<(LocalScuffing, ContactField)>,
    micropitting: Option<(MicropittingRating, FilmField)>,
    standard_micropitting: Option<StandardMicropitting>,
    loss: Option<MeshLoss>,
}

described::described! {
    /// Safeties from the stresses of the solved contact; units are in the names, pairs are pinion and wheel.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct LocalRating {
        /// K_A K_V, by which solved stresses grow. The distribution of the load is in them, so neither K_Hbeta nor K_Halpha counts
        pub load_factor: f64,
        /// largest solved pressure times Z_beta and the root of the load factor
        pub contact_stress_mpa: f64,
        /// place of that pressure
        pub contact_stress_at: PressurePlace,
        /// sigma_HG over the contact stress, pinion and wheel
        pub pitting_safety: [f64; 2],
        /// largest first principal stress in the fillets times the load factor; missing without root stress
        #[serde(skip_serializing_if = "Option::is_none")]
        pub root_stress_mpa: Option<[f64; 2]>,
        /// sigma_FG over the root stress; missing without root stress
        #[serde(skip_serializing_if = "Option::is_none")]
        pub bending_safety: Option<[f64; 2]>,
    }
}

impl LocalRating {
    /// Local rating of a solved pair with slices; `None` of others.
    fn of(standard: &StandardRating, solved: &SolvedMesh) -> Option<Self> {
        let (pressure, contact_stress_at) = solved.hardest?;
        let load_factor = standard.application_factor * standard.dynamic_factor;
        let helix = standard.helix_angle_factor;
        let gears = standard.gears();
        let tension = solved.root_tensions;
        Some(Self {
            load_factor,
            contact_stress_mpa: helix * pressure * load_factor.sqrt(),
            contact_stress_at,
            pitting_safety: gears
                .map(|g| local_pitting_safety(g.contact_stress_limit_mpa, pressure, helix, load_factor)),
            root_stress_mpa: tension.map(|both| both.map(|stress| stress * load_factor)),
            bending_safety: tension
                .map(|both| [0, 1].map(|i| local_bending_safety(gears[i].root_stress_limit_mpa, both[i], load_factor))),
        })
    }
}

impl RatingHeadline {
    /// Headline of a solved pair; `None` if the scene requests no rating, or if no face load factor was found.
    pub fn of(scene: &Scene, history: &StaticHistory) -> Option<Self> {
        let pair = scene.gear_pair().ok()?;
        // What the formulas refuse was refused before the work.
        let loads = SolvedLoad::all(scene, &pair, history).ok()?;
        let spectrum = scene.rating.as_ref()?.spectrum.as_ref().map(|own| (own.values(), &loads[..]));
        Self::of_solved(scene, &pair, (&SolvedMesh::of(scene, history), spectrum)).ok()?
    }

    /// Headline of a mesh under the torque and at the speed of its scene, and under a spectrum of loads with what is solved
    /// under each of them; `None` likewise.
    pub(crate) fn of_solved(
        scene: &Scene,
        pair: &GearPair,
        (solved, spectrum): (&SolvedMesh, Option<SolvedSpectrum<'_>>),
    ) -> Result<Option<Self>, AnalysisError> {
        let Some(rating) = &scene.rating else { return Ok(None) };
        let Some(face_load) = rating.face_load_factor.or(solved.face_load_factor) else { return Ok(None) };
        let loads = spectrum.map_or(&[][..], |(_, loads)| loads);
        let (mut standard, spectrum, oiled) = rated((scene, rating), pair, face_load, (Some(solved), spectrum))?;
        standard
            .outside
            .extend(oiled.micropitting.as_ref().and_then(|_| rating::micropitting_scope(pair.wheel.signed_teeth())));
        let gears = standard.gears();
        let least = |of: fn(&rating::GearRating) -> f64| {
            let [pinion, wheel] = gears.map(of);
            if wheel < pinion { (wheel, NAMES[1]) } else { (pinion, NAMES[0]) }
        };
        let (pitting, bending) = (least(|g| g.pitting_safety), least(|g| g.bending_safety));
        Ok(Some(Self {
            least_pitting_safety: pitting.0,
            least_pitting_safety_of: pitting.1,
            pitting_utilisation: 1.0 / pitting.0,
            least_bending_safety: bending.0,
            least_bending_safety_of: bending.1,
            bending_utilisation: 1.0 / bending.0,
            local: LocalRating::of(&standard, solved),
            least_scuffing_safety: oiled.scuffing.map(|s| {
                let local = oiled.local.as_ref().map_or(f64::INFINITY, |(local, _)| local.safety);
                s.least_safety().min(local)
            }),
            scuffing: oiled.scuffing,
            local_scuffing: oiled.local.as_ref().map(|(local, _)| *local),
            micropitting: oiled.micropitting.as_ref().map(|(rating, _)| *rating),
            standard_micropitting: oiled.standard_micropitting,
            mesh_loss: oiled.loss,
            contact_field: oiled.local.map(|(_, field)| field),
            film_field: oiled.micropitting.map(|(_, field)| field),
            local_spectrum: spectrum.as_ref().and_then(|own| SolvedLoad::damage(loads, own, pair)),
            spectrum: spectrum.map(|own| own.rating()),
            standard,
        }))
    }
}

/// What a user should hear of the rating of a solved pair.
pub(crate) fn remarks(scene: &Scene, history: &StaticHistory) -> Vec<answer::Remark> {
    RatingHeadline::of(scene, history).iter().flat_map(RatingHeadline::remarks).collect()
}

impl RatingHeadline {
    /// What a user should hear of it.
    pub(crate) fn remarks(&self) -> Vec<answer::Remark> {
        let headline = self;
        let outside = headline.standard.outside.iter();
        let mut all: Vec<answer::Remark> =
            outside.map(|o| crate::remark::rating_outside(o.quantity, o.value, o.clause, o.range)).collect();
        for (name, gear) in NAMES.into_iter().zip(headline.standard.gears()) {
            let safeties = [("pitting", gear.pitting_safety), ("tooth root breakage", gear.bending_safety)];
            let low = safeties.into_iter().filter(|(_, safety)| *safety < 1.0);
            all.extend(low.map(|(failure, safety)| crate::remark::rating_fails(name, failure, safety)));
        }
        let of_pair =
            [("scuffing", headline.least_scuffing_safety), ("micropitting", headline.micropitting.map(|m| m.safety))];
        let low = of_pair.into_iter().filter_map(|(failure, safety)| Some((failure, safety.filter(|s| *s < 1.0)?)));
        all.extend(low.map(|(failure, safety)| crate::remark::rating_fails("pair", failure, safety)));
        for (name, damage) in NAMES.into_iter().zip(headline.spectrum.iter().flat_map(|s| [s.pinion, s.wheel])) {
            let sums = [("pitting", damage.pitting_damage), ("tooth root breakage", damage.bending_damage)];
            let high = sums.into_iter().filter(|(_, sum)| *sum > 1.0);
            all.extend(high.map(|(failure, sum)| crate::remark::spectrum_fails(name, failure, sum)));
        }
        if let Some(local) = &headline.local_spectrum {
            let roots = local.bending_damage.zip(local.bending_damage_at);
            for (k, name) in NAMES.into_iter().enumerate() {
                let flank = Some(("pitting", local.pitting_damage[k], local.pitting_damage_at[k]));
                let root = roots.map(|(sums, at)| ("tooth root breakage", sums[k], at[k]));
                let high = flank.into_iter().chain(root).filter(|(_, sum, _)| *sum > 1.0);
                all.extend(high.map(|(failure, sum, at)| {
                    crate::remark::local_spectrum_fails(name, failure, sum, at.diameter_mm, at.z_mm)
                }));
            }
        }
        all
    }
}

/// Refuses a scene whose rating has no value, before any work.
///
/// # Errors
/// [`AnalysisError::Rating`], [`AnalysisError::Lumped`] where a standard has no value.
pub(crate) fn check(scene: &Scene, pair: &GearPair) -> Result<(), AnalysisError> {
    let Some(rating) = &scene.rating else { return Ok(()) };
    check_loads(scene, pair)?;
    let spectrum = rating.spectrum.as_ref().map(|own| (own.values(), &[][..]));
    let found = rated((scene, rating), pair, rating.face_load_factor.unwrap_or(1.0), (None, spectrum));
    found.map(|_| ()).map_err(|e| e.of_part("[rating]").at(place_in(scene, &["rating.life_h"])))
}

/// A spectrum with what is solved under its loads.
pub(crate) type SolvedSpectrum<'a> = (&'a Spectrum, &'a [SolvedLoad]);

/// What a rating is made of: the standard's, that of each load where there is a spectrum, oil and flanks.
type Rated = (StandardRating, Option<RatedSpectrum>, Oiled);

/// The ratings with a face load factor K_Hbeta; those of the solved contact with a history alone.
fn rated(
    (scene, rating): (&Scene, &RatingScene),
    pair: &GearPair,
    face_load: f64,
    (solved, spectrum): (Option<&SolvedMesh>, Option<SolvedSpectrum<'_>>),
) -> Result<Rated, AnalysisError> {
    let loaded = LoadedPair::of(scene, pair);
    let gears = [&pair.pinion, &pair.wheel];
    let application = rating.application_factor;
    // Gears under light loads are softer.
    let stiffness = |torque: f64| -> Result<MeshStiffness, AnalysisError> {
        let found = LoadedPair { torque: application * torque, ..loaded }.iso_stiffness()?;
        let blanks = rating.gear_blank_factor;
        Ok(MeshStiffness { single: blanks * found.c_single, mesh: blanks * found.c_mesh })
    };
    let ratios = IsoRootPair {
        eps_alpha: pair.transverse_contact_ratio(),
        eps_beta: pair.overlap_ratio(),
        fine: rating.tolerance_class <= DEEP_TOOTH_CLASS,
    };
    let tolerances = gears.map(|gear| FlankTolerances::new(gear, rating.tolerance_class));
    let cos = pair.pinion.transverse_pressure_angle().cos();
    let larger = |of: fn(&FlankTolerances) -> f64| of(&tolerances[0]).max(of(&tolerances[1]));
    let unknown = |what: &str| crate::refused::Refusal::input(format!("no {what}"), "name one of its table");
    let lubricant = rating.oil().ok_or_else(|| unknown("lubricant"))?;
    let input = |i: usize| -> Result<GearInput<'_>, AnalysisError> {
        let own = rating.gears()[i];
        Ok(GearInput {
            material: rating.material_of(i).ok_or_else(|| unknown("material"))?,
            density: scene.gears()[i].material.density_kg_m3,
            root: root(gears[i], ratios)?,
            flank_roughness_um: own.flank_roughness_rz_um,
            root_roughness_um: own.root_roughness_rz_um,
            reversed_load_ratio: own.reversed_load_ratio.unwrap_or(0.0),
            meshes_per_turn: f64::from(own.meshes_per_turn.unwrap_or(1)),
        })
    };
    let input = RatingInput {
        edition: match rating.edition {
            RatingEdition::Iso2019 => Edition::Iso2019,
            RatingEdition::Iso2006 => Edition::Iso2006,
        },
        geometry: numbers(pair),
        flank: flank(&loaded),
        stiffness: stiffness(loaded.torque)?,
        gears: [input(0)?, input(1)?],
        lubricant,
        deviations: Deviations {
            base_pitch_um: rating.base_pitch_deviation_um.unwrap_or_else(|| cos * larger(|t| t.single_pitch_um)),
            profile_form_um: rating.profile_form_deviation_um.unwrap_or_else(|| larger(|t| t.profile_form_um)),
            is_fine: rating.tolerance_class <= RELIEF_CLASS,
        },
        tip_relief_um: rating.tip_relief_um,
        tangential_force: loaded.tangential_force(),
        pinion_speed_rpm: scene.pinion_speed().abs() * 30.0 / std::f64::consts::PI,
        factors: GivenFactors {
            application,
            face_load,
            dynamic: rating.dynamic_factor,
            transverse: rating.transverse_load_factor,
        },
        life_h: rating.life_h,
        limited_pitting: rating.limited_pitting,
        long_life: rating.long_life_factor,
    };
    let nominal = [scene.operation.torque_nm, scene.operation.speed_rpm];
    // Loads without torque, which have no stiffness, do no damage.
    let at_load = |bin: &LoadBin, loads: &[SolvedLoad]| {
        let torque = loaded.torque * bin.torque_nm / scene.operation.torque_nm;
        let solved = SolvedLoad::under(loads, bin).and_then(|own| own.face_load_factor);
        let face_load_factor = bin.face_load_factor.or(solved.filter(|_| rating.face_load_factor.is_none()));
        LoadBin { face_load_factor, stiffness: stiffness(torque).ok(), ..*bin }
    };
    let of_loads = |(own, loads): SolvedSpectrum<'_>| {
        RatedSpectrum::new(&input, &own.without_light(nominal[0]).with_loads(|bin| at_load(bin, loads)), nominal)
    };
    let spectrum = spectrum.map(of_loads).transpose()?;
    let standard = standard_rating(&input)?;
    let oiled = oiled(scene, rating, &loaded, (&input, &standard), solved)?;
    Ok((standard, spectrum, oiled))
}

/// Scuffing, micropitting and losses, as far as the scene asks for them.
fn oiled(
    scene: &Scene,
    rating: &RatingScene,
    loaded: &LoadedPair<'_>,
    (pair, standard): (&RatingInput<'_>, &StandardRating),
    solved: Option<&SolvedMesh>,
) -> Result<Oiled, RatingError> {
    let Some(oil_temperature_c) = rating.oil_temperature_c else { return Ok(Oiled::default()) };
    let input = ScuffingInput {
        pair,
        standard,
        lubrication: Lubrication {
            lubricant: pair.lubricant.clone(),
            oil_temperature_c,
            method: match rating.lubrication {
                Some(LubricationScene::Spray) => LubricationMethod::Spray,
                Some(LubricationScene::Submerged) => LubricationMethod::Submerged,
                Some(LubricationScene::Dip) | None => LubricationMethod::Dip,
            },
            // The scene is asked for them.
            roughness_ra_um: rating.gears().map(|gear| gear.flank_roughness_ra_um.unwrap_or(f64::NAN)),
        },
        young: loaded.young(),
        poisson: loaded.poisson(),
        driver: loaded.driver.opposite().driven(),
        structural_factor: rating.structural_factor.unwrap_or(f64::NAN),
    };
    input.lubrication.checked()?;
    let scuffing = rating.scuffing.then(|| scuffing_rating(&input)).transpose()?;
    let (material, permissible) = (rating.material_factor, rating.permissible_specific_film_thickness);
    let material = material.unwrap_or(f64::NAN);
    let standard_micropitting = match rating.micropitting {
        true => standard_micropitting(&input, material, permissible)?,
        false => None,
    };
    let Some(solved) = solved else { return Ok(Oiled { scuffing, standard_micropitting, ..Oiled::default() }) };
    let rolling = Rolling::new(&pair.geometry, pair.pinion_speed_rpm);
    let turning = scene.pinion_speed().abs() * [1.0, 1.0 / pair.geometry.ratio().abs()][input.driver];
    let power_w = 1e-3 * turning * solved.moments[input.driver] / solved.positions.max(1) as f64;
    let places = solved.pressed.clone();
    let solved = SolvedContact::new(input.lubrication.clone(), rolling, places, solved.positions, power_w);
    let local = if rating.scuffing { solved.scuffing(&input)? } else { None };
    let micropitting = if rating.micropitting { solved.micropitting(&input, material, permissible)? } else { None };
    Ok(Oiled { scuffing, local, micropitting, standard_micropitting, loss: solved.loss() })
}

/// The numbers of a pair that ratings need.
fn numbers(pair: &GearPair) -> PairGeometry {
    let gears = [&pair.pinion, &pair.wheel];
    let diameter = |of: fn(&Gear) -> f64| gears.map(|gear| 2.0 * of(gear));
    let data = pair.pinion.data();
    PairGeometry {
        teeth: gears.map(Gear::teeth),
        normal_module: data.normal_module,
        helix_angle: data.helix_angle.abs(),
        base_helix_angle: pair.base_helix_angle().abs(),
        normal_pressure_angle: data.normal_pressure_angle,
        transverse_pressure_angle: pair.pinion.transverse_pressure_angle(),
        working_pressure_angle: pair.working_pressure_angle(),
        centre_distance: pair.centre_distance(),
        face_width: pair.face_width(),
        reference_diameter: diameter(Gear::reference_radius),
        base_diameter: diameter(Gear::base_radius),
        tip_diameter: diameter(Gear::tip_radius),
        root_diameter: diameter(Gear::root_radius),
        bore_diameter: gears.map(|gear| gear.data().bore_diameter),
        path_of_contact: pair.path_of_contact(),
        eps_alpha: pair.transverse_contact_ratio(),
        eps_beta: pair.overlap_ratio(),
    }
}

fn flank(loaded: &LoadedPair<'_>) -> FlankFactors {
    let iso = IsoFlank::new(loaded.pair, loaded.young(), loaded.poisson());
    FlankFactors {
        zone: iso.zone,
        elasticity: iso.elasticity,
        contact_ratio: iso.contact_ratio,
        helix: iso.helix,
        single_contact: iso.single_contact.unwrap_or([1.0; 2]),
    }
}

fn root(gear: &Gear, ratios: IsoRootPair) -> Result<RootFactors, AnalysisError> {
    let root = IsoRoot::new(gear, ratios)?;
    Ok(RootFactors {
        form: root.y_form / root.f_eps,
        load_share: root.f_eps,
        stress_correction: root.y_stress,
        notch: root.root_chord / (2.0 * root.fillet_radius),
        rim: root.y_rim,
        deep_tooth: root.y_deep_tooth,
    })
}
