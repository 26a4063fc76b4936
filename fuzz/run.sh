#!/usr/bin/env bash
# Runs every fuzz target for a while. Usage: fuzz/run.sh [SECONDS]. Works on the stable toolchain:
# there is no unsafe code here to sanitise, and panics, hangs and memory are watched without.
# Unoptimised, for a short run is over before an optimised build is.
# SCENEFOLD_FUZZ_SEED=N starts elsewhere than the last time; in CI the way is always the same.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds="${1:-60}"
command -v cargo-fuzz >/dev/null || cargo install cargo-fuzz --locked --quiet
SCENEFOLD_FUZZ_SEEDS="$PWD/fuzz/corpus" cargo test --quiet --test it fuzz_seeds
for target in reader wire importers updater_bytes expr_at model_reply; do
  echo "-- $target"
  cargo fuzz run --dev --sanitizer none "$target" -- -seed="${SCENEFOLD_FUZZ_SEED:-1}" -max_total_time="$seconds" -timeout=10 \
    -rss_limit_mb=1024 -max_len=65536 -print_final_stats=1 2>&1 \
    | { grep -E "ERROR|SUMMARY|panicked|artifact|stat::|Done" || true; }
done
