//! What a result says beside its numbers.

use pyo3::prelude::*;

use crate::scene::of_value;

/// What a user should hear of a result: a code for programs, a sentence for people.
#[pyclass(frozen, module = "ale_gear")]
pub struct Remark(answer::Remark);

impl Remark {
    /// All of `said`, in their order.
    pub fn all(said: &[answer::Remark]) -> Vec<Self> {
        said.iter().cloned().map(Self).collect()
    }
}

#[pymethods]
impl Remark {
    /// What programs know it by: a row of docs/remarks.md.
    #[getter]
    fn code(&self) -> &str {
        self.0.code()
    }

    /// The sentence, without what to do.
    #[getter]
    fn text(&self) -> String {
        self.0.text()
    }

    /// What to do; `None` where there is nothing to do.
    #[getter]
    fn hint(&self) -> Option<String> {
        self.0.hint()
    }

    /// Numbers and names by their names, which end with the unit.
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        of_value(py, &serde_json::to_value(&self.0).unwrap_or_default()["values"])
    }

    /// The sentence, and what to do behind a semicolon.
    fn __str__(&self) -> String {
        self.0.to_string()
    }

    fn __repr__(&self) -> String {
        format!("<Remark {}: {}>", self.0.code(), self.0)
    }
}
