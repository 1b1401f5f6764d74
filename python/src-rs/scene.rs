//! A checked scene: from tables, from text, from a file, from REXS, or the one of the program.

use std::path::{Path, PathBuf};

use ::scene::{Document, Setting, Starter, all_keys, json_schema, read_pair, read_rexs};
use analysis::{gears, resolution::with_slices};
use pyo3::{
    prelude::*,
    types::{PyBool, PyDict, PyList, PyString},
};
use store::available_bytes;
use store::check_memory;

use crate::{
    arguments::{Given, path, text, whole},
    error::{Complaint, Kind},
    mesh::Mesh,
    remark::Remark,
    values::settings,
};

/// A scene that was checked: a pair, its load, and what is computed.
#[pyclass(frozen, module = "ale_gear")]
#[derive(Debug, Clone)]
pub struct Scene {
    document: Document,
    settings: Vec<Setting>,
    scene: ::scene::Scene,
}

/// What messages call a scene that no file has.
const NAME: &str = "scene";

impl Scene {
    fn checked(document: Document, settings: Vec<Setting>) -> Result<Self, Complaint> {
        let scene = document.scene(&settings)?;
        // Of tables alone the settings are the scene, and nothing was set beside it.
        let scene = if document.is_empty() { ::scene::Scene { set: Vec::new(), ..scene } } else { scene };
        Ok(Self { document, settings, scene })
    }

    /// This scene with more keys set.
    pub fn with(&self, more: impl IntoIterator<Item = Setting>) -> Result<Self, Complaint> {
        let all = self.settings.iter().cloned().chain(more).collect();
        Self::checked(self.document.clone(), all)
    }

    /// As the command runs it.
    pub fn ready(&self) -> ::scene::Scene {
        with_slices(self.scene.clone())
    }

    /// What was read, and the settings, for many cases of it.
    pub fn parts(&self) -> (Document, Vec<Setting>) {
        (self.document.clone(), self.settings.clone())
    }

    /// What it says, wherever it stands.
    fn meaning(&self) -> ::scene::Scene {
        ::scene::Scene { file: PathBuf::new(), set: Vec::new(), ..self.scene.standing_alone() }
    }

    /// The checked scene itself.
    pub fn inner(&self) -> &::scene::Scene {
        &self.scene
    }
}

/// Keys that an argument sets; none without it.
pub fn set_of(tables: Given<'_, '_>) -> Result<Vec<Setting>, Complaint> {
    tables.map_or_else(|| Ok(Vec::new()), settings)
}

/// JSON as Python has it.
pub fn of_json<'py>(py: Python<'py>, json: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (json,))
}

/// Values of JSON as Python's.
pub fn of_value<'py>(py: Python<'py>, value: &serde_json::Value) -> PyResult<Bound<'py, PyAny>> {
    use serde_json::Value;
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(own) => PyBool::new(py, *own).to_owned().into_any(),
        Value::Number(own) => match own.as_i64() {
            Some(whole) => whole.into_pyobject(py)?.into_any(),
            None => own.as_f64().unwrap_or(f64::NAN).into_pyobject(py)?.into_any(),
        },
        Value::String(own) => own.into_pyobject(py)?.into_any(),
        Value::Array(all) => {
            let all = all.iter().map(|own| of_value(py, own)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, all)?.into_any()
        }
        Value::Object(all) => {
            let dict = PyDict::new(py);
            for (key, own) in all {
                dict.set_item(key, of_value(py, own)?)?;
            }
            dict.into_any()
        }
    })
}

#[pymethods]
impl Scene {
    /// A scene of tables: `Scene({"pinion": {...}, ...})`, `Scene(pinion={...}, ...)`, or keys with dots.
    #[new]
    #[pyo3(signature = (tables = None, /, *, folder = None, **keywords))]
    fn new(
        tables: Given<'_, '_>,
        folder: Given<'_, '_>,
        keywords: Option<&Bound<'_, PyDict>>,
    ) -> Result<Self, Complaint> {
        let folder = folder.map_or_else(|| Ok(PathBuf::new()), |any| path("folder", any))?;
        let mut all = set_of(tables)?;
        if let Some(keywords) = keywords {
            all.extend(settings(keywords.as_any())?);
        }
        Self::checked(Document::new(String::new(), &folder.join(NAME)), all)
    }

    /// A scene file.
    #[staticmethod]
    #[pyo3(signature = (file, *, set = None))]
    fn read(file: &Bound<'_, PyAny>, set: Given<'_, '_>) -> Result<Self, Complaint> {
        let file = path("file", file)?;
        Self::checked(Document::read(&file)?, set_of(set)?)
    }

    /// The text of a scene file; `file` is what messages name and what paths are relative to.
    #[staticmethod]
    #[pyo3(signature = (toml, *, file = None, set = None))]
    fn from_toml(toml: &Bound<'_, PyAny>, file: Given<'_, '_>, set: Given<'_, '_>) -> Result<Self, Complaint> {
        let file = file.map_or_else(|| Ok(PathBuf::from("scene.toml")), |any| path("file", any))?;
        Self::checked(Document::new(text("toml", toml)?, &file), set_of(set)?)
    }

    /// The pair of a stage of a REXS file, with torque and speed of `set`.
    #[staticmethod]
    #[pyo3(signature = (file, *, stage = None, set = None))]
    fn from_rexs(file: &Bound<'_, PyAny>, stage: Given<'_, '_>, set: Given<'_, '_>) -> Result<Self, Complaint> {
        let file = path("file", file)?;
        let stage = stage.map_or(Ok(1), |any| whole("stage", any, 1))? as usize;
        let wrong = |e: ::scene::RexsError| {
            Complaint::new(Kind::Input, format_args!("{}: {e}", file.display()), e.hint()).about(&file)
        };
        let text = read_rexs(&file).map_err(wrong)?;
        let starter = read_pair(&text, stage, 1, &Starter::default()).map_err(wrong)?.starter;
        let name = file.with_extension("toml");
        Self::checked(Document::new(starter.text(&name.display().to_string()), &name), set_of(set)?)
    }

    /// The scene of the program, with its meshes: 30/30 teeth, module 3 mm, helix angle 20 degrees, 150 N m.
    #[staticmethod]
    #[pyo3(signature = (*, set = None))]
    fn default(set: Given<'_, '_>) -> Result<Self, Complaint> {
        Self::checked(Document::default_scene(), set_of(set)?)
    }

    /// This scene with some keys set otherwise.
    #[pyo3(signature = (tables = None, /, **keywords))]
    fn set(&self, tables: Given<'_, '_>, keywords: Option<&Bound<'_, PyDict>>) -> Result<Self, Complaint> {
        let mut more = set_of(tables)?;
        if let Some(keywords) = keywords {
            more.extend(settings(keywords.as_any())?);
        }
        self.with(more)
    }

    /// What the command looks at before it begins: that a pair runs, and that memory is enough. What comes back are
    /// remarks.
    fn validate(&self) -> Result<Vec<Remark>, Complaint> {
        let scene = self.ready();
        let pair = scene.gear_pair()?;
        check_memory(&scene, available_bytes()).map_err(|e| Complaint::new(Kind::Input, &e, Some(e.hint())))?;
        Ok(Remark::all(&gears::remarks(&pair)))
    }

    /// Geometry of the pair as the summary has it: diameters, contact ratios, backlash.
    fn geometry<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let pair = self.scene.gear_pair().map_err(Complaint::from)?;
        let facts = serde_json::to_string(&gears::geometry_facts(&pair)).unwrap_or_default();
        of_json(py, &facts)
    }

    /// Meshes of pinion and wheel: read, or made by the built-in mesher.
    fn meshes(&self, py: Python<'_>) -> Result<(Mesh, Mesh), Complaint> {
        let scene = self.ready();
        let [pinion, wheel] = py.detach(|| {
            let pair = scene.gear_pair()?;
            analysis::meshes::pair_meshes(&scene, &pair).map_err(Complaint::from)
        })?;
        Ok((Mesh::of(pinion.gear.mesh().clone()), Mesh::of(wheel.gear.mesh().clone())))
    }

    /// The scene file that says the same with every default written out.
    fn to_toml(&self) -> String {
        self.scene.to_toml()
    }

    /// All keys with their values, defaults filled in.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        of_json(py, &serde_json::to_string(&self.scene).unwrap_or_default())
    }

    /// The number of a key, defaults filled in.
    fn __getitem__(&self, key: &Bound<'_, PyAny>) -> PyResult<f64> {
        let key = text("key", key)?;
        self.scene.number_at(&key).ok_or_else(|| {
            let what = format_args!("is \"{key}\", which is no number of this scene").to_string();
            Complaint::argument("key", what, "tables and key with dots between them, as \"operation.torque_nm\"").into()
        })
    }

    /// Name of the case, for titles.
    #[getter]
    fn name(&self) -> &str {
        &self.scene.name
    }

    /// What messages call it.
    #[getter]
    fn file(&self) -> &Path {
        &self.scene.file
    }

    /// Every key that a scene may have, with dots.
    #[staticmethod]
    fn keys() -> Vec<String> {
        all_keys()
    }

    /// JSON Schema of all documents; each kind stands in `$defs`.
    #[staticmethod]
    fn schema(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        of_json(py, &json_schema().to_string())
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| other.get().meaning() == self.meaning())
    }

    fn __repr__<'py>(&self, py: Python<'py>) -> Bound<'py, PyString> {
        let s = &self.scene;
        let (teeth, module) = ([s.pinion.teeth, s.wheel.teeth], s.pair.normal_module_mm);
        let said = format!(
            "Scene({:?}: {}/{} teeth, module {module} mm, helix angle {} deg, {} N m)",
            s.name, teeth[0], teeth[1], s.pinion.helix_angle_deg, s.operation.torque_nm
        );
        PyString::new(py, &said)
    }
}
