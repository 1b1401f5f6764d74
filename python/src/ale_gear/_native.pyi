"""The compiled part of `ale_gear`. Held against it by `python -m mypy.stubtest`."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from types import ModuleType
from typing import Any, Literal, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Path = str | PathLike[str]
_Tables = Mapping[str, Any]
_Progress = Callable[[str, int, int | None, str], object] | bool | None

__all__ = ["Gearbox", "Mesh", "Pair", "Remark", "Result", "Scene", "__version__"]
__version__: str

@final
class Scene:
    """A scene that was checked: a pair, its load, and what is computed."""

    def __new__(cls, tables: _Tables | None = None, /, *, folder: _Path | None = None, **keywords: Any) -> Scene: ...
    @staticmethod
    def read(file: _Path, *, set: _Tables | None = None) -> Scene: ...
    @staticmethod
    def from_toml(toml: str, *, file: _Path | None = None, set: _Tables | None = None) -> Scene: ...
    @staticmethod
    def from_rexs(file: _Path, *, stage: int | None = None, set: _Tables | None = None) -> Scene: ...
    @staticmethod
    def default(*, set: _Tables | None = None) -> Scene: ...
    @staticmethod
    def keys() -> list[str]: ...
    @staticmethod
    def schema() -> dict[str, Any]: ...
    def set(self, tables: _Tables | None = None, /, **keywords: Any) -> Scene: ...
    def validate(self) -> list[Remark]: ...
    def geometry(self) -> dict[str, Any]: ...
    def meshes(self) -> tuple[Mesh, Mesh]: ...
    def to_toml(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    @property
    def name(self) -> str: ...
    @property
    def file(self) -> Path: ...
    def __getitem__(self, key: str, /) -> float: ...
    def __eq__(self, other: object, /) -> bool: ...

@final
class Mesh:
    """A mesh of a gear: nodes in mm, volume elements, named faces."""

    def __new__(
        cls,
        nodes: ArrayLike,
        cells: ArrayLike | Sequence[ArrayLike] | Mapping[str, ArrayLike],
        groups: Mapping[str, ArrayLike | Sequence[ArrayLike]],
    ) -> Mesh: ...
    @staticmethod
    def read(file: _Path) -> Mesh: ...
    @staticmethod
    def from_meshio(mesh: Any) -> Mesh: ...
    @staticmethod
    def from_gmsh(gmsh: ModuleType) -> Mesh: ...
    def to_meshio(self) -> Any: ...
    def save(self, file: _Path) -> None: ...
    @property
    def nodes(self) -> NDArray[np.float64]: ...
    @property
    def cells(self) -> dict[str, NDArray[np.uint32]]: ...
    @property
    def groups(self) -> dict[str, list[NDArray[np.uint32]]]: ...

@final
class Pair:
    """A scene whose meshes, reduced gears and contact tables stay in memory from question to question."""

    def __new__(
        cls,
        scene: Scene,
        *,
        meshes: Sequence[Any] | None = None,
        cache: _Path | bool | None = None,
        threads: int | None = None,
    ) -> Pair: ...
    @property
    def scene(self) -> Scene: ...
    def reduce(self, *, progress: _Progress = None) -> Pair: ...
    @overload
    def static(
        self,
        torque_nm: float | None = None,
        *,
        positions: int | None = None,
        fields: bool | None = None,
        set: _Tables | None = None,
        progress: _Progress = None,
    ) -> Result: ...
    @overload
    def static(
        self,
        torque_nm: Sequence[float] | NDArray[np.float64],
        *,
        positions: int | None = None,
        fields: bool | None = None,
        set: _Tables | None = None,
        progress: _Progress = None,
    ) -> list[Result]: ...
    def motion(self, *, set: _Tables | None = None, progress: _Progress = None) -> Result: ...
    def curve(
        self,
        from_: float,
        to: float,
        *,
        key: str | None = None,
        set: _Tables | None = None,
        progress: _Progress = None,
    ) -> Result: ...
    def vary(
        self,
        vary: Mapping[str, Sequence[float] | NDArray[np.float64] | float | str],
        outputs: str | Sequence[str],
        *,
        samples: int | None = None,
        design: Literal["latin-hypercube", "sobol", "random"] | None = None,
        seed: int | None = None,
        set: _Tables | None = None,
        progress: _Progress = None,
    ) -> Result: ...
    def optimise(
        self,
        parameters: Mapping[str, Sequence[float] | str] | None = None,
        *,
        torques_nm: float | Sequence[float] | None = None,
        measure: Literal["peak-to-peak", "rms", "harmonics"] | None = None,
        max_pressure_mpa: float | None = None,
        max_edge_pressure_mpa: float | None = None,
        evaluations: int | None = None,
        front: int | None = None,
        set: _Tables | None = None,
        progress: _Progress = None,
    ) -> Result: ...
    def optimise_numbers(
        self,
        parameters: Mapping[str, Sequence[float] | str],
        goals: str | Sequence[str],
        *,
        limits: Mapping[str, float] | None = None,
        evaluations: int | None = None,
        set: _Tables | None = None,
        progress: _Progress = None,
    ) -> Result: ...
    def run(self, *, set: _Tables | None = None, progress: _Progress = None) -> Result: ...

@final
class Gearbox:
    """A gearbox file that was checked, with the scenes of its pairs."""

    @staticmethod
    def read(file: _Path) -> Gearbox: ...
    @staticmethod
    def parse(toml: str, file: _Path | None = None) -> Gearbox: ...
    @property
    def name(self) -> str: ...
    @property
    def shafts(self) -> list[str]: ...
    @property
    def bearings(self) -> list[str]: ...
    @property
    def meshes(self) -> list[str]: ...
    def run(
        self,
        *,
        cache: bool | _Path | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> Result: ...
    def vary(
        self,
        vary: Mapping[str, Sequence[float] | NDArray[np.float64] | float | str],
        outputs: str | Sequence[str],
        *,
        samples: int | None = None,
        design: Literal["latin-hypercube", "sobol", "random"] | None = None,
        seed: int | None = None,
        cache: bool | _Path | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> Result: ...
    def optimise(
        self,
        parameters: Mapping[str, Sequence[float] | str],
        goals: str | Sequence[str],
        *,
        limits: Mapping[str, float] | None = None,
        evaluations: int | None = None,
        cache: bool | _Path | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> Result: ...

@final
class Remark:
    """What a user should hear of a result: a code for programs, a sentence for people."""

    @property
    def code(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def hint(self) -> str | None: ...
    @property
    def values(self) -> dict[str, float | str]: ...

@final
class Result:
    """The answer to a scene: columns by name, headline numbers, files."""

    @property
    def kind(self) -> Literal["static", "dynamic", "plan", "optimum", "gearbox"]: ...
    @property
    def name(self) -> str: ...
    @property
    def rows(self) -> int: ...
    @property
    def columns(self) -> dict[str, Any]: ...
    @property
    def headline(self) -> dict[str, Any]: ...
    @property
    def summary(self) -> dict[str, Any]: ...
    @property
    def remarks(self) -> list[Remark]: ...
    @property
    def holds(self) -> bool: ...
    @property
    def files(self) -> list[str]: ...
    def keys(self) -> list[str]: ...
    def read(self, file: str) -> dict[str, Any]: ...
    def save(self, folder: _Path) -> None: ...
    def address(self, name: str) -> int: ...
    def to_pandas(self) -> Any: ...
    def to_xarray(self) -> Any: ...
    def to_pyvista(self, position: int | None = None) -> Any: ...
    def _fields(self) -> Path | None: ...
    def _repr_html_(self) -> str: ...
    def __getitem__(self, name: str, /) -> Any: ...
    def __len__(self) -> int: ...
    def __contains__(self, name: object, /) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
