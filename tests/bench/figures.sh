#!/usr/bin/env bash
# Prints the figures that tests/bench/README.md records: builds what is needed, then measures one after another.
# Leave the machine alone meanwhile.
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake --preset release >/dev/null
cmake --build --preset release -- --quiet
bin=build/release/tests

step() { printf '\n== %s\n' "$*"; }

step "Tracing with all that belongs to it against bare Embree on the same rays (share_of_bare_speed)"
for scene in "--scene air-shed" "--scene bunny-box" "--scene bunny-box --plain"; do
    echo "-- $scene"
    # shellcheck disable=SC2086 # options, not one word
    $bin/trace_bench --display desktop $scene --benchmark_filter='bare/(100|18)/' 2>/dev/null
done
step "Code for features that the scene does not need, forced on (time_with_over_without, by bit of scenes/needs.h)"
$bin/trace_bench --display desktop --plain --benchmark_filter=unused_feature 2>/dev/null
step "Tracing without the bounce bound (time_without_over_with, 1 / 2 / 4 / 8 bounces)"
for scene in bunny-box air-shed; do
    $bin/trace_bench --display desktop --scene $scene --benchmark_filter=unbounded_bounces 2>/dev/null
done
step "Cost of a sample and memory of a triangle, 45 k to 5 M triangles"
$bin/scaling_bench 2>/dev/null
step "Shimmer and accuracy of filtered textures"
$bin/shimmer_bench 378 4
step "Kernels of reflectance, texture lookup"
$bin/lobes_bench 2>/dev/null
$bin/texture_bench 2>/dev/null
step "Trace and reconstruct at each share against full sampling"
$bin/speedup_bench vive bunny-box 15
step "Plan of one eye, one core"
$bin/plan_bench --benchmark_repetitions=5 --benchmark_report_aggregates_only --benchmark_filter='plan/vive' 2>/dev/null
step "Reconstruction of colour and depth, one eye 1512x1680, C++ path, one core"
$bin/reconstruct_bench --benchmark_filter='cpp/.*threads:1' 2>/dev/null
step "Masks and meshes: making, triangulating, files; reading and planning"
$bin/mask_bench 2>/dev/null
$bin/mesh_bench 2>/dev/null
$bin/mesh_plan_bench 2>/dev/null
repeated="--benchmark_repetitions=5 --benchmark_enable_random_interleaving=true"
step "Reconstructions of meshes and tiles, one eye 1512x1680, one core"
# shellcheck disable=SC2086 # options, not one word
$bin/mesh_reconstruct_bench $repeated --benchmark_filter='(cpp/(tiles|table|raster)/percent:(54|27)/threads:1|gl/(table|raster)/percent:27)' 2>/dev/null
$bin/scattered_bench 27 9
step "Published samplers on grids: plan and reconstruction of one eye, one core"
# shellcheck disable=SC2086
$bin/rivals_bench $repeated --benchmark_filter='cpp|plan' 2>/dev/null
step "Demo: desktop, 18 %, client and server on this machine"
deploy/demo.sh --seconds 20 --out "$PWD/out/figures" | sed -n '/^frames shown/,/gaze_to_frame/p'
step "Server memory: Bunny Box, one client, vive (peak resident size)"
state=$(mktemp -d)
trap 'kill "$server" 2>/dev/null; rm -rf "$state"' EXIT
build/release/server/macula-server --listen 127.0.0.1:0 --state "$state" 2>"$state/log" &
server=$!
until grep -q 'listening on' "$state/log"; do sleep .2; done
build/release/client/macula-client --connect "127.0.0.1:$(sed -n 's/.*listening on .*:\([0-9]*\)$/\1/p' "$state/log")" \
    --state "$state" --headset vive --seconds 10 2>/dev/null | head -n 2
grep VmHWM "/proc/$server/status"
