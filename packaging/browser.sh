#!/usr/bin/env bash
# The page that solves a pair in the browser itself: one file, out/packages/ale-gear.html.
#
# It needs the standard library of the target (`rustup target add wasm32-unknown-unknown`); wasm-bindgen comes from crates.io.
set -euo pipefail
cd "$(dirname "$0")/.."
target=wasm32-unknown-unknown out=$PWD/out/packages
mkdir -p "$out"
ls "$(rustc --print target-libdir --target $target)"/libstd-*.rlib >/dev/null 2>&1 || { echo "not built: rustc has no standard library for $target" >&2; exit 1; }
version=$(sed -n '/^name = "wasm-bindgen"$/{n;s/version = "\(.*\)"/\1/p}' Cargo.lock)
[ "$("$out/bin/wasm-bindgen" --version 2>/dev/null)" = "wasm-bindgen $version" ] ||
    cargo install --quiet --root "$out" --version "$version" --target-dir "${CARGO_TARGET_DIR:-target}/wasm-bindgen" wasm-bindgen-cli
# Random numbers are drawn by nobody; instructions of 128 bits are in every browser since 2023.
RUSTFLAGS='--cfg getrandom_backend="unsupported" -C target-feature=+simd128' \
    cargo build --release -p browser --lib --target $target
"$out/bin/wasm-bindgen" --target no-modules --no-typescript --remove-name-section --remove-producers-section \
    --out-dir "$out/browser" "${CARGO_TARGET_DIR:-target}/$target/release/browser.wasm"
cargo run --quiet --profile test --workspace --bin browser_page -- "$out/browser" "$out/ale-gear.html"
# Where there is a browser it is opened, and must have the numbers of the program.
ALE_GEAR_PAGE=$out/ale-gear.html cargo test --quiet --workspace --test other_programs
echo "$(stat -c %s "$out/ale-gear.html") bytes: $out/ale-gear.html"
