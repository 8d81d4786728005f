# Sourced by run.sh and tables.sh: sets `root` and `program`, and builds macula-chart with what it needs.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=$root/build/release/tests/macula-chart
"$root/deploy/install-packages.sh"
(
    cd "$root"
    cmake --preset release >/dev/null
    cmake --build --preset release --target macula-chart -- -j "$(nproc)" --quiet
)
