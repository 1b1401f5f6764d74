#!/usr/bin/env bash
# Runs the default pair with a program that was built for somewhere, where nothing else is: prints `tried ...` or `untested ...`.
#
#   packaging/try.sh empty PROGRAM                  in a root folder that holds the program alone
#   packaging/try.sh wine PROGRAM                   by wine
#   packaging/try.sh qemu-aarch64-static PROGRAM    by an emulator
set -euo pipefail
by=$1 program=$(realpath "$2")
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
results="$place/out/default/summary.json"
case "$by" in
empty)
    if file -b "$program" 2>/dev/null | grep -q "dynamically linked"; then
        echo "untested: it is not static"
        exit 0
    fi
    mkdir -p "$place/tmp" && cp "$program" "$place/ale-gear"
    as=("$(command -v chroot)")
    [ "$(id -u)" = 0 ] || as=("$(command -v unshare)" -r "${as[@]}")
    (cd "$place" && env -i PATH=/ TMPDIR=/tmp "${as[@]}" "$place" /ale-gear) >"$place/log" 2>&1 || { cat "$place/log" >&2; exit 1; }
    ;;
*)
    command -v "$by" >/dev/null || { echo "untested: there is no $by here"; exit 0; }
    (cd "$place" && WINEDEBUG=-all WINEPREFIX="$place/wine" XDG_CACHE_HOME="$place/cache" "$by" "$program") >"$place/log" 2>&1 || { cat "$place/log" >&2; exit 1; }
    ;;
esac
[ -s "$results" ] || { echo "no result" >&2; exit 1; }
echo "tried ($by)"
