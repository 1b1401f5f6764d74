#!/usr/bin/env bash
# The Python package: its types, its tests and its notebooks. Needs cargo, Python 3 with venv, and a network for pip.
#
#   python/check.sh         the compiled module on what the tests of Rust have built, laid into an environment
#   python/check.sh wheel   a wheel as users get it, optimised, tried in an environment with nothing else in it first
set -euo pipefail
cd "$(dirname "$0")/.."
out=out/python
rm -rf "$out" && mkdir -p "$out"
environment() {
    python3 -m venv "$out/$1"
    "$out/$1/bin/pip" install --quiet --disable-pip-version-check "${@:2}"
}

case "${1:-module}" in
wheel)
    environment tools "maturin>=1.9,<2"
    "$out/tools/bin/maturin" build --quiet --release --manifest-path python/Cargo.toml --out "$out/dist"
    wheel=$(ls "$out"/dist/*.whl)
    environment clean "$wheel"
    "$out/clean/bin/python" python/tests/first_run.py
    environment tests "$wheel[test,mesh,notebook,dask,tables]"
    ;;
module)
    # All of the workspace: for the package alone shared crates would have other features, and would be built again.
    cargo build --quiet --workspace --lib --profile test
    mapfile -t needed < <(python3 python/needed.py test mesh notebook dask tables)
    environment tests "${needed[@]}"
    package=$("$out/tests/bin/python" -c "import sysconfig; print(sysconfig.get_path('platlib'))")/ale_gear
    cp -r python/src/ale_gear "$package"
    cp "${CARGO_TARGET_DIR:-target}/debug/lib_native.so" "$package/_native.abi3.so"
    "$out/tests/bin/python" python/tests/first_run.py
    ;;
*)
    echo "python/check.sh [wheel]" >&2
    exit 2
    ;;
esac

PATH="$PWD/$out/tests/bin:$PATH"
python -m mypy.stubtest ale_gear
python -m pytest python/tests
for notebook in python/notebooks/*.py; do
    printf '%s (%ss so far)\n' "$notebook" "$SECONDS"
    MPLBACKEND=Agg python "$notebook" >"$out/notebook.log" 2>&1 || { cat "$out/notebook.log"; exit 1; }
done
echo "the package holds: $SECONDS s"
