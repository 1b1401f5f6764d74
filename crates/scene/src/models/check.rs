//! Checks raw values of the cheaper models' tables.

use crate::schema::{Lumped8Scene, MeshScene, RawLumped8, RawLumped12, RawMesh, StiffnessFrom};
use crate::source::Source;
use crate::spanned::Numbers;
use crate::{Axis, Lumped12Scene, Model, SceneError};

type Checked<T> = Result<T, SceneError>;

/// Highest mesh order of a series.
const ORDERS: usize = 200;
/// Axes that a gear of a lumped model moves along and about.
const MOVES: [Axis; 5] = Axis::ALL;

/// Torques that a model knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Torques {
    /// Steady ones that balance each other.
    Steady,
    /// Those and harmonic ones.
    Series,
    /// Tables too.
    Any,
}

/// What a model of the ladder takes from the scene.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rung {
    /// Name of the model in [analysis].
    pub name: &'static str,
    /// Coordinates of each gear beside the turn, where the model has them fixed.
    pub moves: Option<&'static [Axis]>,
    /// Has a mesh stiffness, and the table [mesh].
    pub mesh: bool,
    /// Has backlash at it.
    pub backlash: bool,
    /// `mesh_damping_ratio` is its damping.
    pub mesh_damping: bool,
    /// Contact lines, and friction on them.
    pub lines: bool,
    /// Which torques it knows.
    pub torques: Torques,
}

impl Rung {
    /// Rung of a model, if it has one.
    pub fn of(model: Model) -> Option<Self> {
        match model {
            Model::Lumped8 => Some(Self {
                name: "lumped8",
                moves: Some(&MOVES[..3]),
                mesh: true,
                backlash: true,
                mesh_damping: true,
                lines: true,
                torques: Torques::Series,
            }),
            Model::Lumped12 => Some(Self {
                name: "lumped12",
                moves: Some(&MOVES),
                mesh: true,
                backlash: false,
                mesh_damping: false,
                lines: true,
                torques: Torques::Series,
            }),
            Model::Shaft18 => Some(Self {
                name: "shaft18",
                moves: Some(&[]),
                mesh: true,
                backlash: true,
                mesh_damping: true,
                lines: false,
                torques: Torques::Steady,
            }),
            Model::Impact => Some(Self {
                name: "impact",
                moves: None,
                mesh: false,
                backlash: true,
                mesh_damping: false,
                lines: false,
                torques: Torques::Any,
            }),
            Model::Mapped => Some(Self {
                name: "mapped",
                moves: None,
                mesh: false,
                backlash: true,
                mesh_damping: true,
                lines: false,
                torques: Torques::Any,
            }),
            Model::Auto | Model::Iso | Model::Reduced | Model::ReducedModes | Model::Full => None,
        }
    }
}

/// Finite numbers, `ORDERS` at most.
pub(super) fn list(s: &Source<'_>, key: &str, raw: &Numbers) -> Checked<Vec<f64>> {
    let Some(values) = raw else { return Ok(Vec::new()) };
    let wrong = |what: String| s.conflict(&values.span(), what, "a short list of numbers, as in [0.2, 0.05]");
    if values.get_ref().len() > ORDERS {
        return Err(wrong(format!("`{key}` has {} numbers, more than {ORDERS}", values.get_ref().len())));
    }
    let numbers: Vec<f64> = values.get_ref().iter().map(|x| *x.get_ref()).collect();
    match numbers.iter().find(|x| !(-1e9..=1e9).contains(*x)) {
        Some(x) => Err(wrong(format!("`{key}` holds {x}, allowed is -1e9 .. 1e9"))),
        None => Ok(numbers),
    }
}

/// The mesh of a model; without a word on its stiffness that of the reduced model.
pub(crate) fn mesh(s: &Source<'_>, raw: &RawMesh, rung: Rung) -> Checked<MeshScene> {
    let given = raw.stiffness_n_per_um.is_some();
    let from = match &raw.stiffness_from {
        None if given => StiffnessFrom::Series,
        _ => choice!(s, raw.stiffness_from)?,
    };
    let series = from == StiffnessFrom::Series;
    if let (true, false, Some(word)) = (series, given, &raw.stiffness_from) {
        let what = "`stiffness_from = \"series\"` without a series";
        return Err(s.conflict(&word.span(), what, "give `stiffness_n_per_um` (and the amplitudes about it)"));
    }
    if let (false, Some(mean)) = (series, &raw.stiffness_n_per_um) {
        let what = "`stiffness_n_per_um` and `stiffness_from` both say what the stiffness is";
        return Err(s.conflict(&mean.span(), what, "keep one of them"));
    }
    let amplitudes = [
        ("stiffness_cos_n_per_um", &raw.stiffness_cos_n_per_um, series, "a mean, `stiffness_n_per_um`"),
        ("stiffness_sin_n_per_um", &raw.stiffness_sin_n_per_um, series, "a mean, `stiffness_n_per_um`"),
        ("error_cos_um", &raw.error_cos_um, from != StiffnessFrom::Reduced, "a model that is not fed with an error"),
        ("error_sin_um", &raw.error_sin_um, from != StiffnessFrom::Reduced, "a model that is not fed with an error"),
    ];
    for (key, raw, fits, wanted) in amplitudes {
        if let (Some(raw), false) = (raw, fits) {
            return Err(s.conflict(
                &raw.span(),
                format!("`{key}` wants {wanted}"),
                "leave it out, or give the mean stiffness",
            ));
        }
    }
    if let (Some(half), false) = (&raw.half_backlash_um, rung.backlash) {
        let what = format!("`half_backlash_um` means nothing to the model \"{}\", whose mesh is linear", rung.name);
        return Err(s.conflict(&half.span(), what, "leave it out, or use `model = \"lumped8\"`"));
    }
    if let (Some(word), false) = (&raw.line_sharing, rung.lines) {
        let what = format!("`line_sharing` means nothing to the model \"{}\", which has no friction", rung.name);
        return Err(s.conflict(&word.span(), what, "leave it out"));
    }
    let read = MeshScene::read(s, raw, f64::INFINITY)?;
    Ok(MeshScene {
        stiffness_from: from,
        stiffness_cos_n_per_um: list(s, "stiffness_cos_n_per_um", &raw.stiffness_cos_n_per_um)?,
        stiffness_sin_n_per_um: list(s, "stiffness_sin_n_per_um", &raw.stiffness_sin_n_per_um)?,
        error_cos_um: list(s, "error_cos_um", &raw.error_cos_um)?,
        error_sin_um: list(s, "error_sin_um", &raw.error_sin_um)?,
        line_sharing: read.line_sharing.filter(|_| rung.lines),
        ..read
    })
}

pub(crate) fn lumped8(s: &Source<'_>, raw: &RawLumped8) -> Checked<Lumped8Scene> {
    let both = [
        ("speed_fluctuation_rpm", &raw.speed_fluctuation_rpm, "speed_fluctuation_hz"),
        ("speed_fluctuation_hz", &raw.speed_fluctuation_hz, "speed_fluctuation_rpm"),
    ];
    let read = Lumped8Scene::read(s, raw, f64::INFINITY)?;
    let fluctuates = read.speed_fluctuation_rpm > 0.0;
    if let Some((key, Some(value), other)) = both.into_iter().find(|(_, v, other)| {
        let gone = both.iter().any(|(k, v, _)| k == other && v.is_none());
        // An amplitude of zero needs no frequency.
        v.is_some() && gone && (fluctuates || *other == "speed_fluctuation_rpm")
    }) {
        return Err(s.conflict(&value.span(), format!("`{key}` without `{other}`"), "give both, or leave both out"));
    }
    Ok(read)
}

pub(crate) fn lumped12(s: &Source<'_>, raw: &RawLumped12) -> Checked<Lumped12Scene> {
    let made = Lumped12Scene::read(s, raw, f64::INFINITY)?;
    match (&raw.damping_to_hz, &raw.damping_from_hz) {
        (Some(at), _) | (None, Some(at)) if made.damping_to_hz <= made.damping_from_hz => {
            let what = format!(
                "`damping_to_hz` is {}, not above `damping_from_hz`, {}",
                made.damping_to_hz, made.damping_from_hz
            );
            Err(s.conflict(&at.span(), what, "the ratio holds at both and is less between them"))
        }
        _ => Ok(made),
    }
}
