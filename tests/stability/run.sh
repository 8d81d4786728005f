#!/usr/bin/env bash
# Runs every case of the stability suite, those that take long too, and prints them as one table.
set -euo pipefail
usage() {
    cat <<USAGE
usage: tests/stability/run.sh [--quick] [--build DIR]
  --quick      only the cases that ctest runs
  --build DIR  a configured build tree (default: build/release, configured if need be)
USAGE
}
build=
export MACULA_STABILITY=full
while [ $# -gt 0 ]; do
    case $1 in
        --quick) MACULA_STABILITY= ;;
        --build) [ $# -ge 2 ] || { usage >&2; exit 2; }; build=$2; shift ;;
        -h | --help) usage; exit 0 ;;
        *) echo "tests/stability/run.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
    esac
    shift
done
cd "$(dirname "$0")/../.."
if [ -z "$build" ]; then
    build=build/release
    cmake --preset release >/dev/null
fi
cmake --build "$build" --target stability_suite -- --quiet >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
result=0
ctest --test-dir "$build" -L stability --verbose >"$log" || result=$?
echo '| case | figure | measured | bound | reason |'
echo '|---|---|---|---|---|'
sed -nE 's/^[0-9]+: (\| .* \|)$/\1/p' "$log" | sort -V
if [ $result -ne 0 ]; then
    grep -E '^[0-9]+: .*(Failure|bound |pictures: )|\*\*\*' "$log" >&2 || tail -n 50 "$log" >&2
fi
exit $result
