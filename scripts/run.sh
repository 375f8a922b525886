#!/usr/bin/env bash
# Sets up what is missing, builds svbench, runs a configuration and says where the report is.
#
#   scripts/run.sh [CONFIG [OPTION...]]      CONFIG defaults to configs/quick.toml
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/setup.sh

need_compiler
need_driver
program=${CARGO_TARGET_DIR:-target}/release/svbench
cargo build --release --locked
need_device "$program"
config=${1:-configs/quick.toml}
[ $# -gt 0 ] && shift
exec "$program" run "$config" "$@"
