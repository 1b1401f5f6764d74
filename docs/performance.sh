#!/usr/bin/env bash
# Fills docs/performance.md: runs the work-precision charts of both pairs (up to a quarter of an hour each on two quiet cores), then
# the tables of the benches. `--benches` alone leaves the charts as they are; other arguments go to `ale-gear chart`.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ "${1:-}" != --benches ]; then
    cargo build --release -p ale-gear
    program=${CARGO_TARGET_DIR:-target}/release/ale-gear
    mkdir -p docs/performance
    for scene in default:helical-30x30-beta20 iso_tr_6336_30:iso-tr-6336-30; do
        out=out/chart-${scene%%:*}
        "$program" chart "scenes/${scene%%:*}.toml" --out "$out" --into docs/performance.md "$@"
        cp "$out/work_precision.svg" "docs/performance/${scene##*:}.svg"
        cp "$out/chart.csv" "docs/performance/${scene##*:}.csv"
    done
    out=out/chart-motion
    "$program" chart --methods scenes/motion.toml --out "$out" --into docs/performance.md
    for kind in svg csv; do
        cp "$out/motion_precision.$kind" "docs/performance/helical-30x30-beta20-motion.$kind"
    done
    out=out/chart-resonance
    "$program" chart --resonance scenes/resonance.toml --out "$out" --into docs/performance.md \
        --set motion.sweep.speeds=11 --set 'motion.sweep.ways=["up"]' --set motion.mesh_damping_ratio=0.05
    cp "$out/resonance_curves.svg" docs/performance/helical-30x30-beta20-resonance-curves.svg
    for kind in svg csv; do
        cp "$out/resonance_precision.$kind" "docs/performance/helical-30x30-beta20-resonance.$kind"
    done
fi

# Puts what a bench prints between the marks `<!-- NAME -->` and `<!-- end NAME -->` of docs/performance.md.
put() {
    local name=$1 fence=$2 text
    shift 2
    text=$("$@" 2>/dev/null)
    if [ "$fence" = text ]; then text=$(printf '```text\n%s\n```' "$text"); fi
    TEXT=$text perl -0pi -e "s/(<!-- $name -->\n).*?(<!-- end $name -->)/\$1\n\$ENV{TEXT}\n\n\$2/s" docs/performance.md
}
# 24 GiB are what a gear may take, whatever the machine has.
ulimit -v "${MEMORY_KIB:-25165824}"
put offline table cargo bench -p benches --bench offline -- --largest
put ways text cargo bench -p benches --bench reduction
put contact text cargo bench -p benches --bench contact_solve
put motion table cargo bench -p benches --bench dynamic_step
# Where Python has PARDISO (`pip install pypardiso`).
if "${PYTHON:-python3}" -c 'import pypardiso' 2>/dev/null; then
    put factor table cargo bench -p benches --bench factor
fi
