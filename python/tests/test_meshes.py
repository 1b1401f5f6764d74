"""Meshes from arrays are those of files, and are looked at as these are."""

import numpy as np
import pytest

from ale_gear import InputError, Mesh, Pair, Scene


@pytest.fixture(scope="module")
def coarse(top):
    return Scene.read(top / "scenes/coarse.toml", set={"analysis.positions_per_cycle": 2})


def parts(mesh):
    return mesh.nodes, list(mesh.cells.values()), mesh.groups


def test_arrays_in_and_out_are_the_same_mesh(coarse):
    for mesh in coarse.meshes():
        again = Mesh(*parts(mesh))
        assert np.array_equal(again.nodes, mesh.nodes)
        assert all(np.array_equal(again.cells[kind], rows) for kind, rows in mesh.cells.items())
        assert again.groups.keys() == mesh.groups.keys()


def test_meshes_in_memory_give_the_bits_of_files(coarse):
    of_files = Pair(coarse).static()
    meshes = [Mesh(*parts(mesh)) for mesh in coarse.meshes()]
    in_memory = Pair(coarse, meshes=meshes).reduce().static()
    assert in_memory["ste_um"].tobytes() == of_files["ste_um"].tobytes()
    pair = Pair(coarse, meshes=meshes)
    varied = pair.vary({"operation.torque_nm": [150.0]}, "mean_ste_um")
    assert varied["mean_ste_um"][0] == of_files.headline["mean_ste_um"]


def test_what_meshio_has_read_is_a_mesh(coarse, top):
    meshio = pytest.importorskip("meshio")
    files = [top / "meshes" / f"coarse_hex8_{gear}.msh" for gear in ("pinion", "wheel")]
    read = [meshio.read(file) for file in files]
    assert Pair(coarse, meshes=read).static()["ste_um"].tobytes() == Pair(coarse).static()["ste_um"].tobytes()


@pytest.mark.parametrize("file", ["sector3_hex20.msh", "sector3_hex27.msh", "sector3_tet10.msh",
                                  "sector3_tet4.msh", "sector3_wedge6.msh"])
def test_every_kind_of_element_goes_through_meshio_and_back(file, top):
    """But for quadratic wedges, which meshio 5.3 does not know."""
    pytest.importorskip("meshio")
    mesh = Mesh.read(top / "meshes" / file)
    again = Mesh.from_meshio(mesh.to_meshio())
    assert np.array_equal(again.nodes, mesh.nodes)
    for kind, rows in mesh.cells.items():
        assert np.array_equal(again.cells[kind], rows), kind
    assert again.groups.keys() == mesh.groups.keys()


def test_a_mesh_is_saved_and_read(tmp_path, top):
    mesh = Mesh.read(top / "meshes/periodic_hex8.msh")
    mesh.save(tmp_path / "again.msh")
    assert np.array_equal(Mesh.read(tmp_path / "again.msh").nodes, mesh.nodes)


def test_a_mesh_of_another_gear_is_refused(coarse, top):
    nodes, cells, groups = parts(coarse.meshes()[0])
    with pytest.raises(InputError, match="metres") as caught:
        Pair(coarse, meshes=[Mesh(nodes * 1e-3, cells, groups), coarse.meshes()[1]]).static()
    assert caught.value.hint and "1000" in caught.value.hint
    with pytest.raises(InputError) as caught:
        Pair(coarse, meshes=[Mesh(nodes, cells, {"bore": groups["bore"]}), coarse.meshes()[1]]).static(set={"pinion.teeth": 29})
    assert caught.value.hint
    with pytest.raises(InputError, match="NaN|not finite|finite"):
        broken = np.array(nodes)
        broken[0, 0] = np.nan
        Mesh(broken, cells, groups)


def test_cheaper_models_take_no_meshes_from_memory(coarse):
    with pytest.raises(InputError, match="in memory") as caught:
        Pair(coarse, meshes=coarse.meshes()).curve(1500.0, 3000.0, set={"analysis.model": "mapped"})
    assert "Mesh.save" in caught.value.hint
