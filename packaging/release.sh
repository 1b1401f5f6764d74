#!/usr/bin/env bash
# The program as files that run without anything installed: built, checked, tried in an empty place, packed.
#
#   packaging/release.sh              all targets that this machine can build
#   packaging/release.sh TARGET...    these
#
# A target is built where rustc has its standard library (`rustup target add TARGET`) or its source (`rust-src`), and a
# linker is there: that of this machine, or zig, which comes as a wheel. What cannot be built or tried is said so.
# docs/releasing.md says what comes before and after.
set -euo pipefail
cd "$(dirname "$0")/.."
out=$PWD/out/packages
mkdir -p "$out"
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)
host=$(rustc -vV | sed -n 's/^host: //p')
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=("$host" x86_64-unknown-linux-musl aarch64-unknown-linux-musl x86_64-pc-windows-gnu)
told=()

tools() {
    [ -x "$out/tools/bin/cargo-zigbuild" ] && return
    python3 -m venv "$out/tools"
    "$out/tools/bin/pip" install --quiet --disable-pip-version-check ziglang cargo-zigbuild
}

has_std() { ls "$(rustc --print target-libdir --target "$1")"/libstd-*.rlib >/dev/null 2>&1; }
has_source() { [ -e "$(rustc --print sysroot)/lib/rustlib/src/rust/library/Cargo.lock" ]; }

for target in "${targets[@]}"; do
    flags=() how=(build)
    if ! has_std "$target"; then
        if has_source; then
            # The standard library is built with the program: a switch of cargo that is not yet stable.
            export RUSTC_BOOTSTRAP=1
            flags=(-Z build-std=std,panic_abort)
        else
            told+=("$target: not built: rustc has neither its standard library nor the source of it")
            continue
        fi
    fi
    if [ "$target" != "$host" ]; then
        tools
        export PATH="$out/tools/bin:$PATH"
        how=(zigbuild)
    fi
    # No shared library at all: the file runs on every Linux.
    case "$target" in
    *-linux-*) static="-C target-feature=+crt-static" ;;
    *) static="" ;;
    esac
    if ! RUSTFLAGS="$static ${RUSTFLAGS:-}" cargo "${how[@]}" "${flags[@]}" --release --workspace --bin ale-gear --target "$target"; then
        told+=("$target: not built: see above")
        continue
    fi
    end=""
    case "$target" in *windows*) end=.exe ;; esac
    name=ale-gear-$version-$target
    rm -rf "$out/$name" && mkdir -p "$out/$name"
    cp "${CARGO_TARGET_DIR:-target}/$target/release/ale-gear$end" README.md LICENSE-MIT LICENSE-APACHE NOTICES.txt "$out/$name"
    program=$out/$name/ale-gear$end
    case "$target" in
    *windows*) tried=$("packaging/try.sh" wine "$program") ;;
    x86_64-*) tried=$("packaging/try.sh" empty "$program") ;;
    aarch64-*) tried=$("packaging/try.sh" qemu-aarch64-static "$program") ;;
    *) tried="untested" ;;
    esac
    (cd "$out" && tar -czf "$name.tar.gz" "$name")
    told+=("$target: $(stat -c %s "$program") bytes, $tried: $out/$name.tar.gz")
done
printf '%s\n' "${told[@]}"
