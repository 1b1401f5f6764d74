#!/usr/bin/env bash
# Fills docs/performance.md: runs the work-precision charts of both pairs. Up to a quarter of an hour each on two quiet cores.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release -p ale-gear
program=${CARGO_TARGET_DIR:-target}/release/ale-gear
mkdir -p docs/performance
for scene in default:helical-30x30-beta20 iso_tr_6336_30:iso-tr-6336-30; do
    out=out/chart-${scene%%:*}
    "$program" chart "scenes/${scene%%:*}.toml" --out "$out" --into docs/performance.md "$@"
    for kind in svg png; do
        cp "$out/work_precision.$kind" "docs/performance/${scene##*:}.$kind"
    done
    cp "$out/chart.csv" "docs/performance/${scene##*:}.csv"
done
