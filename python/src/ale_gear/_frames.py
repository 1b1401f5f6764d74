"""Results as other packages have tables and fields. These are imported when they are asked for."""

from __future__ import annotations

import html as _html
import re
from pathlib import Path
from typing import Any

from .errors import ArgumentError, InputError

# Endings of columns, and the units that they stand for.
_UNITS = {
    "um_per_s": "um/s",
    "n_per_um": "N/um",
    "nmm": "N mm",
    "nm": "N m",
    "um": "um",
    "mm": "mm",
    "mpa": "MPa",
    "n": "N",
    "deg": "deg",
    "s": "s",
    "rpm": "1/min",
    "hz": "Hz",
    "w": "W",
    "percent": "%",
    "urad": "urad",
}


def unit(column: str) -> str:
    """The unit that the name of a column ends in; nothing for numbers without one."""
    for ending, name in _UNITS.items():
        if column.endswith("_" + ending):
            return name
    return ""


def _needs(package: str, extra: str) -> Any:
    try:
        return __import__(package)
    except ImportError:
        raise InputError(
            f"this needs the package {package}", key=package, hint=f"pip install 'ale-gear[{extra}]'"
        ) from None


def to_pandas(result: Any) -> Any:
    pandas = _needs("pandas", "tables")
    table = pandas.DataFrame(dict(result.columns), copy=False)
    table.attrs["name"] = result.name
    return table


def to_xarray(result: Any) -> Any:
    xarray = _needs("xarray", "tables")
    columns = dict(result.columns)
    if not columns:
        raise InputError("the result has no rows", hint="see `result.files`")
    first = next(name for name in _abscissae(columns) if name in columns)
    variables = {
        name: (first, values, {"units": unit(name)}) for name, values in columns.items() if name != first
    }
    coordinate = (first, columns[first], {"units": unit(first)})
    return xarray.Dataset(variables, coords={first: coordinate}, attrs={"name": result.name})


def _abscissae(columns: dict[str, Any]) -> list[str]:
    return ["pinion_angle_deg", *columns] if "dte_um" not in columns else ["time_s", *columns]


def to_pyvista(result: Any, position: object) -> Any:
    pyvista = _needs("pyvista", "plot")
    if position is None:
        position = 0
    if isinstance(position, bool) or not isinstance(position, int) or position < 0:
        raise ArgumentError(
            f"`position` is {position!r}, wanted is a whole number from 0 on",
            key="position",
            hint="positions count from 0",
        )
    folder = result._fields()
    files = [Path(folder) / f"{gear}_{position:05}.vtu" for gear in ("pinion", "wheel")] if folder else []
    if not files or not all(file.is_file() for file in files):
        raise InputError(
            f"the result has no fields at position {position}",
            key="position",
            hint="ask for them: `pair.static(fields=True)`; of a motion by `output.vtu` of the scene",
        )
    blocks = pyvista.MultiBlock()
    for gear, file in zip(("pinion", "wheel"), files):
        blocks[gear] = pyvista.read(str(file))
    return blocks


def html(result: Any, pictures: list[str]) -> str:
    """Headline numbers and the charts of the report."""
    rows = []
    for key, value in result.headline.items():
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            continue
        rows.append(f"<tr><td><code>{_html.escape(key)}</code></td><td>{value:.6g}</td></tr>")
    told = "".join(f"<p>&#9888; {_html.escape(str(said))}</p>" for said in result.remarks)
    held = "" if result.holds else "<p><strong>This result failed a check.</strong></p>"
    shown = "".join(f'<div style="max-width:820px">{_scaled(svg)}</div>' for svg in pictures)
    return (
        f"<div><h3>{_html.escape(result.name)}</h3>{held}{told}"
        f"<details><summary>Headline numbers</summary><table>{''.join(rows)}</table></details>{shown}</div>"
    )


def _scaled(svg: str) -> str:
    """A picture that fits the cell of a notebook."""
    return re.sub(r"<svg ", '<svg style="max-width:100%;height:auto" ', svg, count=1)
