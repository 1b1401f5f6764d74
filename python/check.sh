#!/usr/bin/env bash
# The Python package as its users get it: a wheel, built here, tried in an environment with nothing else in it, then its
# types, its tests and its notebooks. Needs cargo, Python 3 with venv, and a network for pip.
set -euo pipefail
cd "$(dirname "$0")/.."
out=out/python
rm -rf "$out" && mkdir -p "$out"
environment() {
    python3 -m venv "$out/$1"
    "$out/$1/bin/pip" install --quiet --disable-pip-version-check "${@:2}"
}

environment tools "maturin>=1.9,<2"
# A workspace of its own, so what the tests of Rust have built does not serve.
CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-$PWD/target}/python" \
    "$out/tools/bin/maturin" build --quiet --release --manifest-path python/Cargo.toml --out "$out/dist"
wheel=$(ls "$out"/dist/*.whl)

environment clean "$wheel"
"$out/clean/bin/python" python/tests/first_run.py

environment tests "$wheel[test,mesh,notebook,dask,tables]"
PATH="$PWD/$out/tests/bin:$PATH"
python -m mypy.stubtest ale_gear
python -m pytest python/tests
for notebook in python/notebooks/*.py; do
    printf '%s (%ss so far)\n' "$notebook" "$SECONDS"
    MPLBACKEND=Agg python "$notebook" >"$out/notebook.log" 2>&1 || { cat "$out/notebook.log"; exit 1; }
done
echo "$(basename "$wheel") holds: $SECONDS s"
