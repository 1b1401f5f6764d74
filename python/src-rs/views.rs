//! Arrays of the program as arrays of NumPy, without a copy: the one place of this package with `unsafe`.

use numpy::{
    Element, PyArray,
    ndarray::{ArrayView, Dimension},
};
use pyo3::{prelude::*, types::PyDict};

/// Numbers that `owner` holds as an array that cannot be written to; it keeps `owner` alive.
///
/// `values` must lie in what `owner` holds for as long as it lives: all owners of this package are frozen classes, whose
/// vectors nobody changes.
pub fn view<'py, T: Element, D: Dimension>(
    owner: Bound<'py, PyAny>,
    values: &ArrayView<'_, T, D>,
) -> PyResult<Bound<'py, PyAny>> {
    #[allow(unsafe_code, reason = "the owner holds the numbers, is frozen, and lives as long as the array")]
    let array = unsafe { PyArray::borrow_from_array(values, owner) };
    // Nobody else has seen it yet, and NumPy lets nobody take this back: the owner is no array.
    let closed = PyDict::new(array.py());
    closed.set_item("write", false)?;
    array.call_method("setflags", (), Some(&closed))?;
    Ok(array.into_any())
}
