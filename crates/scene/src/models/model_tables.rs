//! The tables of a scene's model, except those with only default values.

use toml::Spanned;

use super::check::{Rung, lumped8, lumped12, mesh};
use super::impact::impact;
use super::shaft::shaft18;
use crate::schema::{ImpactScene, Lumped8Scene, Lumped12Scene, MeshScene, RawScene, Shaft18Scene};
use crate::source::Source;
use crate::{Model, SceneError};

type Checked<T> = Result<T, SceneError>;

/// Tables, each set exactly for the models that have it.
pub(crate) struct ModelTables {
    pub mesh: Option<MeshScene>,
    pub lumped8: Option<Lumped8Scene>,
    pub lumped12: Option<Lumped12Scene>,
    pub shaft18: Option<Shaft18Scene>,
    pub impact: Option<ImpactScene>,
}

/// The tables of a scene's model, checked.
pub(crate) fn model_tables(s: &Source<'_>, raw: &RawScene, model: Model) -> Checked<ModelTables> {
    let meshed = Rung::of(model).filter(|r| r.mesh);
    Ok(ModelTables {
        mesh: match meshed {
            Some(rung) => table(&raw.mesh, true, |w| mesh(s, w, rung))?,
            None => None,
        },
        lumped8: table(&raw.lumped8, model == Model::Lumped8, |w| lumped8(s, w))?,
        lumped12: table(&raw.lumped12, model == Model::Lumped12, |w| lumped12(s, w))?,
        shaft18: table(&raw.shaft18, model == Model::Shaft18, |w| shaft18(s, w))?,
        impact: table(&raw.impact, model == Model::Impact, |w| impact(s, w))?,
    })
}

/// The checked table of a scene that asks for it, of its defaults where it is not written.
pub(crate) fn table<R: Default, T>(
    raw: &Option<Spanned<R>>,
    wanted: bool,
    checked: impl FnOnce(&R) -> Checked<T>,
) -> Checked<Option<T>> {
    match raw {
        _ if !wanted => Ok(None),
        Some(table) => checked(table.get_ref()).map(Some),
        None => checked(&R::default()).map(Some),
    }
}
