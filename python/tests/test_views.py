"""Columns are the solver's own memory."""

import gc

import numpy as np
import pytest


def address(array) -> int:
    return array.__array_interface__["data"][0]


def test_a_column_lies_where_the_solver_has_it(pair):
    result = pair.static()
    for name in result:
        assert address(result[name]) == result.address(name), name
        assert address(result[name]) == address(result[name]), "each view is the same memory"
        assert result[name].base is not None


def test_a_column_cannot_be_written_to(pair):
    column = pair.static()["ste_um"]
    assert not column.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        column[0] = 0.0
    with pytest.raises(ValueError, match="WRITEABLE"):
        column.flags.writeable = True


def test_a_column_outlives_its_result_and_its_pair(scene):
    from ale_gear import Pair

    column = Pair(scene).static()["ste_um"]
    before = column.copy()
    gc.collect()
    # What the memory would be given to, were it free.
    others = [np.full(len(column), float(i)) for i in range(10_000)]
    assert np.array_equal(column, before) and len(others) == 10_000


def test_nodes_and_cells_lie_where_the_program_has_them(scene):
    mesh, _ = scene.meshes()
    assert address(mesh.nodes) == address(mesh.nodes)
    (kind, cells), = mesh.cells.items()
    assert kind == "hexahedron" and cells.shape[1] == 8 and int(cells.max()) < len(mesh.nodes)
    nodes = mesh.nodes
    del mesh
    gc.collect()
    assert not nodes.flags.writeable and np.isfinite(nodes).all()


def test_tables_of_others_hold_the_same_numbers(pair):
    pandas = pytest.importorskip("pandas")
    xarray = pytest.importorskip("xarray")
    result = pair.static()
    table, data = result.to_pandas(), result.to_xarray()
    assert isinstance(table, pandas.DataFrame) and isinstance(data, xarray.Dataset)
    assert list(table.columns) == result.keys() and len(table) == result.rows
    assert np.array_equal(table["ste_um"].to_numpy(), result["ste_um"])
    assert np.array_equal(data["ste_um"].to_numpy(), result["ste_um"])
    assert data["ste_um"].attrs["units"] == "um" and list(data.coords) == ["pinion_angle_deg"]


def test_a_notebook_shows_the_charts_of_the_report(pair):
    shown = pair.static()._repr_html_()
    assert "Static transmission error" in shown and shown.count("<svg") >= 4 and "<script" not in shown
    assert "mean_ste_um" in shown


def test_fields_are_those_of_paraview(scene):
    pyvista = pytest.importorskip("pyvista")
    from ale_gear import InputError, Pair

    result = Pair(scene).static(positions=2, fields=True)
    blocks = result.to_pyvista(1)
    assert list(blocks.keys()) == ["pinion", "wheel"]
    assert float(np.abs(blocks["pinion"].point_data["displacement_mm"]).max()) > 0
    assert isinstance(blocks["wheel"], pyvista.UnstructuredGrid)
    with pytest.raises(InputError, match="position 2") as caught:
        result.to_pyvista(2)
    assert caught.value.hint
