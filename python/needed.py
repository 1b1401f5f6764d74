"""Packages that ale-gear needs, with those of the extras named: python needed.py EXTRA ..."""
import pathlib
import sys

try:
    import tomllib
except ModuleNotFoundError:  # Python 3.10
    from pip._vendor import tomli as tomllib

project = tomllib.loads((pathlib.Path(__file__).parent / "pyproject.toml").read_text())["project"]
extras = project["optional-dependencies"]
print(*project["dependencies"], *(package for extra in sys.argv[1:] for package in extras[extra]), sep="\n")
