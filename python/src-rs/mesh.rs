//! Meshes from arrays and to arrays. What comes in is read as a file of Gmsh is, so that it is checked as one.

use std::path::Path;

use ::mesh::{ElementKind, Mesh as MeshedGear, MshFormat};
use numpy::{
    PyArray2, PyArrayMethods, PyUntypedArrayMethods,
    ndarray::{Array2, ArrayView2},
};
use pyo3::{
    prelude::*,
    types::{PyDict, PyList, PyMapping},
};

use crate::{
    arguments::{dict, list, path, shown, text},
    error::{Complaint, Kind},
    views::view,
};

type Answer<T> = std::result::Result<T, Complaint>;

/// A mesh of a gear: nodes in mm, volume elements, named faces.
#[pyclass(frozen, module = "ale_gear")]
pub struct Mesh {
    mesh: MeshedGear,
}

/// Gmsh's types of elements by their nodes: three-dimensional ones, and faces.
const VOLUMES: [(usize, i32); 7] = [(4, 4), (6, 6), (8, 5), (10, 11), (15, 18), (20, 17), (27, 12)];
const FACES: [(usize, i32); 5] = [(3, 2), (4, 3), (6, 9), (8, 16), (9, 10)];

impl Mesh {
    /// Mesh of the program.
    pub fn of(mesh: MeshedGear) -> Self {
        Self { mesh }
    }

    /// Meshes of pinion and wheel that an argument gives.
    pub fn two(any: &Bound<'_, PyAny>) -> Answer<[MeshedGear; 2]> {
        let wrong = || {
            let what = format_args!("is {}, wanted are the meshes of pinion and wheel", shown(any)).to_string();
            Complaint::argument("meshes", what, "as `meshes=(pinion, wheel)`, each a Mesh, or what meshio has read")
        };
        let both = list("meshes", any).map_err(|_| wrong())?;
        let [pinion, wheel] = &both[..] else { return Err(wrong()) };
        Ok([Self::one(pinion)?, Self::one(wheel)?])
    }

    /// A mesh of this package, or of meshio.
    fn one(any: &Bound<'_, PyAny>) -> Answer<MeshedGear> {
        if let Ok(own) = any.cast::<Self>() {
            return Ok(own.get().mesh.clone());
        }
        let wrong = |e: PyErr| {
            let what = format_args!("has {}, which is no mesh: {e}", shown(any)).to_string();
            Complaint::argument("meshes", what, "give a Mesh, or what meshio has read")
        };
        let made = Self::from_meshio(any).map_err(wrong)?;
        Ok(made.cast::<Self>().map_err(|e| wrong(e.into()))?.get().mesh.clone())
    }
}

/// Whole numbers of two dimensions; they count nodes from 0.
fn whole_numbers(name: &str, any: &Bound<'_, PyAny>) -> Answer<Array2<i64>> {
    let wrong = |what: String| Complaint::argument(name, what, "give whole numbers, a row of nodes an element");
    let numpy = any.py().import("numpy").map_err(|e| wrong(format!("cannot be looked at: {e}")))?;
    let array = numpy.call_method1("asarray", (any,)).map_err(|_| wrong(format!("is {}, no array", shown(any))))?;
    let kind = array.getattr("dtype").and_then(|d| d.getattr("kind")).and_then(|k| k.extract::<String>());
    if !kind.is_ok_and(|kind| kind == "i" || kind == "u") {
        return Err(wrong("holds other than whole numbers".into()));
    }
    let array = array.call_method1("astype", ("int64",)).map_err(|_| wrong("holds other than whole numbers".into()))?;
    match array.cast::<PyArray2<i64>>() {
        Ok(array) => Ok(array.readonly().as_array().to_owned()),
        Err(_) => Err(wrong("is no table of rows of nodes".into())),
    }
}

/// Positions of nodes, mm.
fn positions(any: &Bound<'_, PyAny>) -> Answer<Array2<f64>> {
    let wrong = |what: String| Complaint::argument("nodes", what, "give an array with a row x, y, z (mm) a node");
    let numpy = any.py().import("numpy").map_err(|e| wrong(format!("cannot be looked at: {e}")))?;
    let array = numpy
        .call_method1("asarray", (any, "float64"))
        .map_err(|_| wrong(format!("is {}, no array of numbers", shown(any))))?;
    match array.cast::<PyArray2<f64>>() {
        Ok(array) if array.shape()[1] == 3 => Ok(array.readonly().as_array().to_owned()),
        _ => Err(wrong("has other than three columns".into())),
    }
}

/// Arrays of elements: one, some in a list, or some by name.
fn tables(name: &str, any: &Bound<'_, PyAny>) -> Answer<Vec<Array2<i64>>> {
    if any.cast::<PyMapping>().is_ok() {
        return dict(name, any, "give arrays by name")?.values().iter().map(|one| whole_numbers(name, &one)).collect();
    }
    let many = any.is_instance_of::<PyList>() || any.is_instance_of::<pyo3::types::PyTuple>();
    let of_arrays = many && any.get_item(0).is_ok_and(|first| first.hasattr("ndim").unwrap_or(false));
    if of_arrays {
        return list(name, any)?.iter().map(|one| whole_numbers(name, one)).collect();
    }
    Ok(vec![whole_numbers(name, any)?])
}

/// A file of Gmsh in memory, format 2.2, binary, with tags from 1.
struct Msh {
    bytes: Vec<u8>,
    elements: Vec<u8>,
    count: usize,
    nodes: i64,
}

impl Msh {
    fn new(nodes: &Array2<f64>, names: &[(usize, String)]) -> Answer<Self> {
        let mut bytes = b"$MeshFormat\n2.2 1 8\n".to_vec();
        bytes.extend(1i32.to_le_bytes());
        bytes.extend(b"\n$EndMeshFormat\n$PhysicalNames\n");
        bytes.extend(format!("{}\n", names.len()).into_bytes());
        for (tag, name) in names {
            bytes.extend(format!("2 {tag} \"{name}\"\n").into_bytes());
        }
        bytes.extend(format!("$EndPhysicalNames\n$Nodes\n{}\n", nodes.nrows()).into_bytes());
        for (k, node) in nodes.rows().into_iter().enumerate() {
            let tag =
                i32::try_from(k + 1).map_err(|_| Complaint::argument("nodes", "has too many rows", "give fewer"))?;
            bytes.extend(tag.to_le_bytes());
            node.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        }
        bytes.extend(b"\n$EndNodes\n");
        Ok(Self { bytes, elements: Vec::new(), count: 0, nodes: nodes.nrows() as i64 })
    }

    /// Elements of one type, all in a group (0: in none).
    fn add(&mut self, name: &str, types: &[(usize, i32)], group: usize, rows: &Array2<i64>) -> Answer<()> {
        let Some((_, kind)) = types.iter().find(|(nodes, _)| *nodes == rows.ncols()) else {
            let known: Vec<String> = types.iter().map(|(nodes, _)| nodes.to_string()).collect();
            let what = format_args!("has rows of {} nodes, known are {}", rows.ncols(), known.join(", ")).to_string();
            return Err(Complaint::argument(name, what, "nodes in Gmsh's order: corners, edges, faces, middle"));
        };
        for row in rows.rows() {
            self.count += 1;
            let group = group as i32;
            [*kind, 1, 2, self.count as i32, group, group].iter().for_each(|x| self.elements.extend(x.to_le_bytes()));
            for &node in row {
                if !(0..self.nodes).contains(&node) {
                    let what = format_args!("names node {node}, there are {} from 0", self.nodes).to_string();
                    return Err(Complaint::argument(name, what, "nodes count from 0, by their row in `nodes`"));
                }
                self.elements.extend((node as i32 + 1).to_le_bytes());
            }
        }
        Ok(())
    }

    fn mesh(mut self) -> Answer<MeshedGear> {
        self.bytes.extend(format!("$Elements\n{}\n", self.count).into_bytes());
        self.bytes.extend(self.elements);
        self.bytes.extend(b"\n$EndElements\n");
        Ok(MeshedGear::parse(&self.bytes, Path::new("mesh in memory"))?)
    }
}

/// Name of a kind of elements, as meshio has it.
fn kind_name(kind: ElementKind) -> &'static str {
    match kind {
        ElementKind::Hex8 => "hexahedron",
        ElementKind::Hex20 => "hexahedron20",
        ElementKind::Hex27 => "hexahedron27",
        ElementKind::Tet4 => "tetra",
        ElementKind::Tet10 => "tetra10",
        ElementKind::Wedge6 => "wedge",
        ElementKind::Wedge15 => "wedge15",
    }
}

/// A list as a table of rows.
fn rows<T>(list: &[T], shape: (usize, usize)) -> Answer<ArrayView2<'_, T>> {
    ArrayView2::from_shape(shape, list).map_err(|e| Complaint::new(Kind::Internal, e, None))
}

fn helper<'py>(name: &str, any: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    any.py().import("ale_gear._meshes")?.getattr(name)?.call1((any,))
}

#[pymethods]
impl Mesh {
    /// Mesh of arrays: `nodes` (n x 3, mm), `cells` (rows of nodes, in Gmsh's order, from 0), `groups` of faces by
    /// name.
    #[new]
    fn new(nodes: &Bound<'_, PyAny>, cells: &Bound<'_, PyAny>, groups: &Bound<'_, PyAny>) -> Answer<Self> {
        let nodes = positions(nodes)?;
        let groups = dict("groups", groups, "as {\"bore\": faces, \"flank_left_0\": faces, ...}")?;
        let mut names = Vec::new();
        for (k, name) in groups.keys().iter().enumerate() {
            let name = text("groups", &name)?;
            if name.is_empty() || name.contains(['"', '\n', '\r']) {
                return Err(Complaint::argument("groups", format_args!("has the name {name:?}"), "give a plain name"));
            }
            names.push((k + 1, name));
        }
        let mut file = Msh::new(&nodes, &names)?;
        for rows in tables("cells", cells)? {
            file.add("cells", &VOLUMES, 0, &rows)?;
        }
        for ((tag, name), faces) in names.iter().zip(groups.values()) {
            for rows in tables(name, &faces)? {
                file.add(name, &FACES, *tag, &rows)?;
            }
        }
        Ok(Self { mesh: file.mesh()? })
    }

    /// A mesh file of Gmsh, format 4.1 or 2.2.
    #[staticmethod]
    fn read(py: Python<'_>, file: &Bound<'_, PyAny>) -> Answer<Self> {
        let file = path("file", file)?;
        Ok(Self { mesh: py.detach(|| MeshedGear::read(&file)).map_err(|e| Complaint::from(e).about(&file))? })
    }

    /// What meshio has read; groups are those of Gmsh, or sets of cells.
    #[staticmethod]
    fn from_meshio<'py>(mesh: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        helper("from_meshio", mesh)
    }

    /// The mesh of the model that Gmsh's Python API has at hand, `gmsh` being its module.
    #[staticmethod]
    fn from_gmsh<'py>(gmsh: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        helper("from_gmsh", gmsh)
    }

    /// As meshio has it.
    fn to_meshio<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        helper("to_meshio", slf.as_any())
    }

    /// Writes it as a file of Gmsh, format 4.1, binary.
    fn save(&self, py: Python<'_>, file: &Bound<'_, PyAny>) -> Answer<()> {
        let file = path("file", file)?;
        py.detach(|| self.mesh.write(&file, MshFormat::Binary41)).map_err(|e| {
            Complaint::new(Kind::Input, format_args!("{}: {e}", file.display()), Some("may you write there?".into()))
        })
    }

    /// Positions, mm: n x 3, read-only, in the program's own memory.
    #[getter]
    fn nodes<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let nodes = &slf.get().mesh.nodes;
        view(slf.clone().into_any(), &rows(nodes.as_flattened(), (nodes.len(), 3))?)
    }

    /// Volume elements by kind, as meshio names them; rows of nodes from 0 in Gmsh's order, read-only.
    #[getter]
    fn cells<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(slf.py());
        for block in &slf.get().mesh.blocks {
            let rows = rows(&block.connectivity, (block.tags.len(), block.kind.node_count()))?;
            all.set_item(kind_name(block.kind), view(slf.clone().into_any(), &rows)?)?;
        }
        Ok(all)
    }

    /// Named faces: a list of arrays each, one a kind of faces; rows of nodes from 0 in Gmsh's order.
    #[getter]
    fn groups<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(slf.py());
        for group in &slf.get().mesh.surfaces {
            let tables = PyList::empty(slf.py());
            for (count, _) in FACES {
                let of_kind = group.faces.iter().filter(|face| face.nodes().len() == count);
                let flat: Vec<u32> = of_kind.flat_map(|face| face.nodes().iter().copied()).collect();
                if let (false, Ok(rows)) = (flat.is_empty(), Array2::from_shape_vec((flat.len() / count, count), flat))
                {
                    tables.append(PyArray2::from_owned_array(slf.py(), rows))?;
                }
            }
            all.set_item(&group.name, tables)?;
        }
        Ok(all)
    }

    fn __repr__(&self) -> String {
        let elements: usize = self.mesh.blocks.iter().map(|block| block.tags.len()).sum();
        let (nodes, groups) = (self.mesh.nodes.len(), self.mesh.surfaces.len());
        format!("Mesh({nodes} nodes, {elements} elements, {groups} groups)")
    }
}
