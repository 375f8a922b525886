#!/usr/bin/env bash
# Draws the shadow mask of every method and variant of the shipped configurations, on the four shipped scenes and
# at two moments of each flight, and writes a line for each mask: hash, moment, configuration, scene and
# method. Two versions of the program draw the same masks where `diff` finds nothing:
#
#   scripts/masks.sh --bin OLD/svbench before.txt
#   scripts/masks.sh after.txt
#   diff before.txt after.txt
#
#   scripts/masks.sh [--bin SVBENCH] [--size WxH] OUT [CONFIG...]
#
# Without --bin, the program of this checkout is used, which must be built. CONFIG defaults to those below. Models
# are searched as by `svbench run` (SVBENCH_MODELS); a scene without its model has no masks.
set -euo pipefail

fail() {
    printf '%s\n' "$*" >&2
    exit 2
}
usage="usage: scripts/masks.sh [--bin SVBENCH] [--size WxH] OUT [CONFIG...]"

root=$(cd "$(dirname "$0")/.." && pwd)
program=${CARGO_TARGET_DIR:-$root/target}/release/svbench
size=320x240
while [ $# -gt 0 ]; do
    case $1 in
    --bin | --size)
        [ $# -ge 2 ] || fail "$1: a value is missing; $usage"
        case $1 in --bin) program=$2 ;; --size) size=$2 ;; esac
        shift 2
        ;;
    -*) fail "unknown option $1; $usage" ;;
    *) break ;;
    esac
done
[ $# -gt 0 ] || fail "$usage"
[ -x "$program" ] || fail "$program: no such program; build it (cargo build --release) or name one with --bin"
out=$1
shift
configs=("$@")
[ $# -gt 0 ] || configs=("$root"/configs/{variants,accuracy,precision,stability,table1}.toml)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export SVBENCH_CACHE=${SVBENCH_CACHE-$work/cache}

# A run keeps the masks of its first verified frame; which frames are verified decides where on the flight that is.
moments=(start middle)
verified() {
    case $1 in
    start) echo 'verify_every = 1' ;;
    middle) echo 'verified_frames = 1' ;;
    esac
}

# plan CONFIG MOMENT: the configuration's methods on the four scenes, one frame each.
plan() {
    printf 'title = "Masks"\nsize = [%s, %s]\nframes = 1\nwarmup_frames = 0\n' "${size%x*}" "${size#*x}"
    verified "$2"
    printf '[[scenes]]\nscene = "%s"\n' sphere_grid sphere_objects dragon sponza
    sed -n '/^\[\[methods\]\]/,$p' "$1"
}

: >"$work/masks"
for config in "${configs[@]}"; do
    [ -r "$config" ] || fail "$config: cannot be read"
    name=$(basename "$config" .toml)
    for moment in "${moments[@]}"; do
        plan "$config" "$moment" >"$work/plan.toml"
        status=0
        "$program" run "$work/plan.toml" --out "$work/run" >"$work/log" 2>&1 || status=$?
        # 1: some cells have no mask, as on a device that lacks a stage; the others are there.
        [ "$status" -le 1 ] || { cat "$work/log" >&2; fail "$name, $moment: exit code $status"; }
        count=0
        for mask in "$work"/run/images/*_mask.png; do
            [ -e "$mask" ] || continue
            file=${mask##*/}
            hash=$(sha256sum <"$mask")
            printf '%.16s %-6s %-9s %s\n' "$hash" "$moment" "$name" "${file%_mask.png}" >>"$work/masks"
            count=$((count + 1))
        done
        printf '%s, %s: %d masks\n' "$name" "$moment" "$count" >&2
        rm -rf "$work/run"
    done
done
[ -s "$work/masks" ] || fail "no mask was drawn"
sort -k 3 "$work/masks" >"$out"
