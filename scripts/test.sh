#!/usr/bin/env bash
# Sets up what is missing and runs the whole test suite; options go to cargo test.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/setup.sh

need_compiler
need_driver
need_validation_layers
program=${CARGO_TARGET_DIR:-target}/release/svbench
cargo build --release --locked
need_device "$program"
# In release: the tests trace rays and rasterise in software.
exec cargo test --release --locked "$@"
