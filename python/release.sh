#!/usr/bin/env bash
# All of a release of the Python package but its upload: wheel, source, checks, trial in clean environments.
# docs/releasing.md says what comes before and after. Needs cargo, Python 3 and a network for pip.
set -euo pipefail
cd "$(dirname "$0")/.."
out=out/release
rm -rf "$out" && mkdir -p "$out"

python3 -m venv "$out/tools"
"$out/tools/bin/pip" install --quiet --disable-pip-version-check "maturin>=1.9,<2" ziglang twine
PATH="$PWD/$out/tools/bin:$PATH"

# One wheel for Python 3.10 and newer; zig links it against a glibc as old as that of manylinux2014.
maturin build --release --zig --compatibility manylinux2014 --manifest-path python/Cargo.toml --out "$out/dist"
twine check "$out"/dist/*
wheel=$(ls "$out"/dist/*.whl)
bytes=$(stat -c %s "$wheel")
[ "$bytes" -lt 20000000 ] || { echo "$wheel has $bytes bytes, 20 MB are allowed" >&2; exit 1; }

# Every Python from 3.10 on that this machine has.
tried=()
for python in $(ls /usr/bin/python3.1? "$HOME"/.pyenv/versions/3.1?.*/bin/python 2>/dev/null); do
    "$python" -c 'import sys; sys.exit(sys.version_info < (3, 10))' 2>/dev/null || continue
    rm -rf "$out/try" && "$python" -m venv "$out/try" 2>/dev/null || continue
    "$out/try/bin/pip" install --quiet --disable-pip-version-check "$wheel"
    "$out/try/bin/python" python/tests/first_run.py
    tried+=("$("$python" -V)")
done
[ ${#tried[@]} -gt 0 ] || { echo "no Python to try the wheel on" >&2; exit 1; }
printf '%s: %s bytes, tried on %s\n' "$wheel" "$bytes" "$(IFS=,; echo "${tried[*]}")"
echo "what is left:  twine upload $wheel"
