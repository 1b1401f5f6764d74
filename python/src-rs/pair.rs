//! A pair with its reduction held in memory, and what it can be asked.

use std::sync::Arc;

use ::mesh::Mesh as MeshedGear;
use ::scene::{
    Document, Kind as SceneKind, Setting,
    optimum::{Optimisation, OptimisationWords},
};
use analysis::{GearCache, NoCache, SharedModels, accuracy::GearMemo, in_time::is_one_motion};
use pyo3::{
    prelude::*,
    types::{PyBool, PyList},
};
use rayon::prelude::*;
use store::available_bytes;
use store::check_memory;
use store::folder::Cache;

use crate::{
    analyses::{self, Held},
    arguments::{Given, number, numbers, path, shown, switch, text, whole},
    at_rest::AtRest,
    error::{Complaint, Kind},
    mesh::Mesh,
    result::Result,
    scene::{Scene, set_of},
    words::{bounds, numbers_of, plan_of, words_of},
    work::{Watch, run},
};

type Answer<T> = std::result::Result<T, Complaint>;

/// A scene whose meshes, reduced gears and contact tables stay in memory from question to question.
#[pyclass(frozen, module = "ale_gear")]
pub struct Pair {
    scene: Scene,
    held: Arc<Kept>,
    /// Threads of each question; `None`: the cores are shared with all others.
    threads: Option<u32>,
}

/// What the threads that work hold as well.
struct Kept {
    models: SharedModels<'static>,
    cache: Arc<GearMemo<'static>>,
    meshes: Option<[MeshedGear; 2]>,
}

impl Kept {
    fn held(&self) -> Held<'_> {
        let meshes = self.meshes.as_ref().map(|[pinion, wheel]| [pinion, wheel]);
        Held { models: &self.models, cache: &*self.cache, meshes }
    }
}

/// The store that the caller names: none, the user's, or a folder.
pub fn cache_of(cache: Given<'_, '_>) -> Answer<Arc<dyn GearCache + Send>> {
    let Some(any) = cache else { return Ok(Arc::new(NoCache)) };
    if !any.is_instance_of::<PyBool>() {
        return Ok(Arc::new(Cache::in_folder(path("cache", any)?)));
    }
    Ok(if switch("cache", any)? { Arc::new(Cache::of_user()) } else { Arc::new(NoCache) })
}

/// Threads of a question: no more than machines have.
pub fn threads_of(any: &Bound<'_, PyAny>) -> Answer<u32> {
    match whole("threads", any, 1)? {
        n if n <= MOST_THREADS => Ok(n),
        n => Err(Complaint::argument(
            "threads",
            format!("is {n}, at most {MOST_THREADS} are made"),
            "take as many as cores",
        )),
    }
}

const MOST_THREADS: u32 = 1024;

fn setting(key: &str, value: impl Into<::scene::Value>) -> Answer<Setting> {
    Ok(Setting::of(key, &value.into())?)
}

impl Pair {
    /// The scene with more keys set, as the command would run it.
    fn asked(&self, more: Vec<Setting>) -> Answer<::scene::Scene> {
        let scene = self.scene.with(more)?.ready();
        check_memory(&scene, available_bytes()).map_err(|e| Complaint::new(Kind::Input, &e, Some(e.hint())))?;
        let many = scene.motion.is_some() && !is_one_motion(&scene);
        if self.held.meshes.is_some() && (!scene.accuracy.is_none() || many) {
            let hint = "write the meshes into files (`Mesh.save`) and name these in the scene";
            let what = "meshes in memory go with one load or motion of reduced gears alone, not with [accuracy], a cheaper model or a sweep";
            return Err(Complaint::new(Kind::Input, what, Some(hint.into())));
        }
        Ok(scene)
    }

    /// Solves scenes at rest, side by side where there are several.
    fn at_rest(&self, py: Python<'_>, scenes: Vec<::scene::Scene>, progress: Given<'_, '_>) -> PyResult<Vec<Result>> {
        let held = Arc::clone(&self.held);
        run(py, progress, self.threads, move |watch| {
            let solve = |scene: &::scene::Scene, watch: &mut Watch| {
                Result::at_rest(&scene.name, AtRest::solve(scene, &held.models, &*held.cache, watch)?)
            };
            match &scenes[..] {
                [one] => Ok(vec![solve(one, watch)?]),
                all => {
                    let beside: Vec<Watch> = all.iter().map(|_| watch.beside()).collect();
                    let each = all.par_iter().zip(beside);
                    each.map(|(scene, mut own)| solve(scene, &mut own)).collect()
                }
            }
        })
    }

    fn in_time(&self, py: Python<'_>, mut more: Vec<Setting>, progress: Given<'_, '_>) -> PyResult<Py<Result>> {
        if self.scene.inner().analysis.kind == SceneKind::Static {
            more.insert(0, setting("analysis.kind", "dynamic")?);
        }
        let (scene, held) = (self.asked(more)?, Arc::clone(&self.held));
        let result = run(py, progress, self.threads, move |watch| analyses::in_time(&scene, held.held(), watch))?;
        that_holds(py, result)
    }
}

/// The result as Python has it; one that does not hold is raised with its exception.
pub fn that_holds(py: Python<'_>, result: Result) -> PyResult<Py<Result>> {
    let failure = result.failure();
    let result = Py::new(py, result)?;
    let Some(failure) = failure else { return Ok(result) };
    let error = PyErr::from(failure);
    error.value(py).setattr("result", &result)?;
    Err(error)
}

#[pymethods]
impl Pair {
    /// Pair of a scene; `meshes` of pinion and wheel take the place of the scene's, `cache` is the folder of reduced
    /// gears (`True`: the user's, as the command has it), `threads` those of each question: with one, questions asked
    /// by threads of Python run side by side.
    #[new]
    #[pyo3(signature = (scene, *, meshes = None, cache = None, threads = None))]
    fn new(
        scene: &Bound<'_, PyAny>,
        meshes: Given<'_, '_>,
        cache: Given<'_, '_>,
        threads: Given<'_, '_>,
    ) -> Answer<Self> {
        let Ok(scene) = scene.cast::<Scene>() else {
            let what = format_args!("is {}, wanted is a Scene", shown(scene)).to_string();
            return Err(Complaint::argument("scene", what, "as `Pair(Scene.read(\"scene.toml\"))`"));
        };
        let meshes = meshes.map(Mesh::two).transpose()?;
        let threads = threads.map(threads_of).transpose()?;
        let cache = Arc::new(GearMemo::holding(cache_of(cache)?));
        let models = SharedModels::holding(Arc::clone(&cache) as Arc<dyn GearCache + Send>);
        let models = match &meshes {
            Some(meshes) => models.with_meshes(meshes.clone()),
            None => models,
        };
        Ok(Self { scene: scene.get().clone(), held: Arc::new(Kept { models, cache, meshes }), threads })
    }

    /// The scene.
    #[getter]
    fn scene(&self) -> Scene {
        self.scene.clone()
    }

    /// Reads or makes the meshes, reduces the gears and maps their contact; every later question finds them. What comes
    /// back is the pair.
    #[pyo3(signature = (*, progress = None))]
    fn reduce<'py>(slf: &Bound<'py, Self>, progress: Given<'_, 'py>) -> PyResult<Bound<'py, Self>> {
        let own = slf.get();
        let (scene, held) = (own.asked(Vec::new())?, Arc::clone(&own.held));
        run(slf.py(), progress, slf.get().threads, move |_| Ok(held.models.reduce(&scene)?))?;
        Ok(slf.clone())
    }

    /// Solves the pair at rest through its mesh cycle: one torque, or several side by side.
    #[pyo3(name = "static")]
    #[pyo3(signature = (torque_nm = None, *, positions = None, fields = None, set = None, progress = None))]
    fn static_<'py>(
        &self,
        py: Python<'py>,
        torque_nm: Given<'_, 'py>,
        positions: Given<'_, 'py>,
        fields: Given<'_, 'py>,
        set: Given<'_, 'py>,
        progress: Given<'_, 'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut more = set_of(set)?;
        if self.scene.inner().analysis.kind == SceneKind::Dynamic {
            let what = "the scene is one in time";
            let hint = "call `motion()`, or set `analysis.kind` to \"static\" in the scene";
            return Err(Complaint::new(Kind::Scene, what, Some(hint.into())).into());
        }
        if let Some(any) = positions {
            more.push(setting("analysis.positions_per_cycle", i64::from(whole("positions", any, 1)?))?);
        }
        if fields.map_or(Ok(false), |any| switch("fields", any))? {
            more.push(setting("output.vtu", true)?);
        }
        let (torques, several) = match torque_nm {
            Some(any) => numbers("torque_nm", any)?,
            None => (Vec::new(), false),
        };
        let scenes = if torques.is_empty() && !several {
            vec![self.asked(more)?]
        } else {
            let at = |torque: &f64| {
                let own = setting("operation.torque_nm", *torque)?;
                self.asked(more.iter().cloned().chain([own]).collect())
            };
            torques.iter().map(at).collect::<Answer<Vec<_>>>()?
        };
        let mut results = Vec::new();
        for result in self.at_rest(py, scenes, progress)? {
            results.push(that_holds(py, result)?);
        }
        match (several, results.pop()) {
            (false, Some(one)) => Ok(one.into_bound(py).into_any()),
            (_, last) => {
                results.extend(last);
                Ok(PyList::new(py, results)?.into_any())
            }
        }
    }

    /// Follows the pair in time, as [motion] of the scene says.
    #[pyo3(signature = (*, set = None, progress = None))]
    fn motion(&self, py: Python<'_>, set: Given<'_, '_>, progress: Given<'_, '_>) -> PyResult<Py<Result>> {
        self.in_time(py, set_of(set)?, progress)
    }

    /// Follows the periodic motions along a key from one value to another, around folds: a resonance curve.
    #[pyo3(signature = (from_, to, *, key = None, set = None, progress = None))]
    fn curve(
        &self,
        py: Python<'_>,
        from_: &Bound<'_, PyAny>,
        to: &Bound<'_, PyAny>,
        key: Given<'_, '_>,
        set: Given<'_, '_>,
        progress: Given<'_, '_>,
    ) -> PyResult<Py<Result>> {
        let key = key.map_or_else(|| Ok("operation.speed_rpm".to_owned()), |any| text("key", any))?;
        let mut more = set_of(set)?;
        more.push(setting("motion.run", "continuation")?);
        more.push(setting("motion.continuation.key", key)?);
        more.push(setting("motion.continuation.from", number("from_", from_)?)?);
        more.push(setting("motion.continuation.to", number("to", to)?)?);
        self.in_time(py, more, progress)
    }

    /// Solves many cases of the scene: by list, grid or sample; a row of wanted numbers a case.
    #[pyo3(signature = (vary, outputs, *, samples = None, design = None, seed = None, set = None, progress = None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn vary(
        &self,
        py: Python<'_>,
        vary: &Bound<'_, PyAny>,
        outputs: &Bound<'_, PyAny>,
        samples: Given<'_, '_>,
        design: Given<'_, '_>,
        seed: Given<'_, '_>,
        set: Given<'_, '_>,
        progress: Given<'_, '_>,
    ) -> PyResult<Py<Result>> {
        let (document, settings) = self.parts(set)?;
        let (plan, words) = plan_of((document, settings), (vary, outputs), (samples, design, seed))?;
        let again = format!("ale_gear.Pair(scene).vary({words})");
        let held = Arc::clone(&self.held);
        let result = run(py, progress, self.threads, move |watch| analyses::vary(&plan, &again, held.held(), watch))?;
        that_holds(py, result)
    }

    /// Searches the quietest micro-geometry within bounds and limits, by exact derivatives.
    #[pyo3(signature = (
        parameters = None, *, torques_nm = None, measure = None, max_pressure_mpa = None,
        max_edge_pressure_mpa = None, evaluations = None, front = None, set = None, progress = None
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn optimise(
        &self,
        py: Python<'_>,
        parameters: Given<'_, '_>,
        torques_nm: Given<'_, '_>,
        measure: Given<'_, '_>,
        max_pressure_mpa: Given<'_, '_>,
        max_edge_pressure_mpa: Given<'_, '_>,
        evaluations: Given<'_, '_>,
        front: Given<'_, '_>,
        set: Given<'_, '_>,
        progress: Given<'_, '_>,
    ) -> PyResult<Py<Result>> {
        let parameters = parameters.map_or_else(|| Ok(Vec::new()), |any| words_of("parameters", any, bounds))?;
        let measure = measure.map(|any| text("measure", any)).transpose()?;
        let words = OptimisationWords {
            parameters: &parameters,
            torques_nm: &torques_nm.map_or_else(|| Ok((Vec::new(), true)), |any| numbers("torques_nm", any))?.0,
            measure: measure.as_deref(),
            max_pressure_mpa: max_pressure_mpa.map(|any| number("max_pressure_mpa", any)).transpose()?,
            max_edge_pressure_mpa: max_edge_pressure_mpa.map(|any| number("max_edge_pressure_mpa", any)).transpose()?,
            goals: &[],
            limits: &[],
            evaluations: evaluations.map_or(Ok(20), |any| whole("evaluations", any, 1))?,
            front: front.map_or(Ok(0), |any| whole("front", any, 0))?,
        };
        let (document, settings) = self.parts(set)?;
        let plan = Optimisation::of_scene(document, &settings, &words).map_err(Complaint::from)?;
        let again = format!("ale_gear.Pair(scene).optimise({parameters:?}, measure={measure:?})");
        let held = Arc::clone(&self.held);
        let result =
            run(py, progress, self.threads, move |watch| analyses::optimum(&plan, &again, held.held(), watch))?;
        that_holds(py, result)
    }

    /// Searches the design whose numbers of the headline are smallest in the mean, within limits, by differences; of a pair
    /// at rest or in time.
    #[pyo3(signature = (parameters, goals, *, limits = None, evaluations = None, set = None, progress = None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn optimise_numbers(
        &self,
        py: Python<'_>,
        parameters: &Bound<'_, PyAny>,
        goals: &Bound<'_, PyAny>,
        limits: Given<'_, '_>,
        evaluations: Given<'_, '_>,
        set: Given<'_, '_>,
        progress: Given<'_, '_>,
    ) -> PyResult<Py<Result>> {
        let (plan, words) = numbers_of(self.parts(set)?, (parameters, goals), (limits, evaluations))?;
        let again = format!("ale_gear.Pair(scene).optimise_numbers({words})");
        let held = Arc::clone(&self.held);
        let result =
            run(py, progress, self.threads, move |watch| analyses::number_optimum(&plan, &again, held.held(), watch))?;
        that_holds(py, result)
    }

    /// Runs the scene as it stands, at rest or in time: `ale-gear run`.
    #[pyo3(signature = (*, set = None, progress = None))]
    fn run(&self, py: Python<'_>, set: Given<'_, '_>, progress: Given<'_, '_>) -> PyResult<Py<Result>> {
        let more = set_of(set)?;
        let scene = self.asked(more.clone())?;
        if scene.analysis.kind == SceneKind::Dynamic {
            return self.in_time(py, more, progress);
        }
        match self.at_rest(py, vec![scene], progress)?.pop() {
            Some(result) => that_holds(py, result),
            None => Err(Complaint::new(Kind::Internal, "no result", None).into()),
        }
    }

    fn __repr__(&self) -> String {
        format!("Pair({:?})", self.scene.inner().name)
    }
}

impl Pair {
    /// Text, name and settings of the scene with more keys set.
    fn parts(&self, set: Given<'_, '_>) -> Answer<(Document, Vec<Setting>)> {
        Ok(self.scene.with(set_of(set)?)?.parts())
    }
}
