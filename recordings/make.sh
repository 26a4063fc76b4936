#!/bin/sh
# Makes the golden recordings from their origins. This is how they were made; the files that are
# committed are never made again, for a recording of the past must replay for ever.
#
# Usage: recordings/make.sh DATA OUT
#   DATA  folder with homer_plus/, virtualhome/ and spark_dsg/ (see recordings/NOTICE.md)
#   OUT   new folder; nothing in it is overwritten
set -eu
data=$(cd "$1" && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)
cd "$(dirname "$0")/.."

run() { cargo run --quiet --release -- "$@"; }

temporary=$(mktemp -d)
trap 'rm -r "$temporary"' EXIT
day="$temporary/household_day.csv"
awk -F, 'NR == 1 || ($1 == "train" && $2 == 0)' "$data/homer_plus/household_a.csv" > "$day"
run import actions "$day" \
    --graph "$data/virtualhome/scene2.json" \
    --places "$data/homer_plus/extra_places.csv" \
    --initial "$data/homer_plus/initial_a.csv" \
    -o "$out/household_day.mcap"
run simulate --seed 1 -o "$out/paper_mission.mcap"
rm "$out/paper_mission.truth.mcap"
run import spark-dsg "$data/spark_dsg/apartment_dsg.json" -o "$out/hydra_apartment.mcap"
SCENEFOLD_MAKE_RECORDINGS="$out" cargo test --quiet --test it synthetic
sha256sum "$out"/*.mcap
