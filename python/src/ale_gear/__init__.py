"""Loaded tooth contact and vibration of helical gear pairs by reduced finite elements.

    import ale_gear

    pair = ale_gear.Pair(ale_gear.Scene.read("scene.toml")).reduce()
    result = pair.static(torque_nm=150.0)
    result["ste_um"]            # a column, read-only, in the solver's own memory
    result.save("out")          # the files that the command writes

Keys, columns and signs are those of the command: docs/scene.md, docs/outputs.md, docs/conventions.md.
"""

from ._native import Gearbox, Mesh, Pair, Remark, Result, Scene, __version__
from .errors import (
    AleGearError,
    ArgumentError,
    InexactError,
    InputError,
    InternalError,
    NoResultError,
    SceneError,
)

__all__ = [
    "AleGearError",
    "ArgumentError",
    "Gearbox",
    "InexactError",
    "InputError",
    "InternalError",
    "Mesh",
    "NoResultError",
    "Pair",
    "Remark",
    "Result",
    "Scene",
    "SceneError",
    "__version__",
]
