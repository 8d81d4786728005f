#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test: the whole suite as users build it, the quick chart of speed against
# accuracy, whose bounds must hold, the suite's fast part under ASan+UBSan, the tests of threaded code under TSan, and the
# lint.
set -euo pipefail
usage() {
    cat <<USAGE
usage: tests/run.sh [--only release|chart|lint|asan|tsan]...
  --only PART   run this part alone; may be repeated (default: all five)
USAGE
}
parts=()
while [ $# -gt 0 ]; do
    case $1 in
        --only) [ $# -ge 2 ] || { usage >&2; exit 2; }; parts+=("$2"); shift 2 ;;
        -h | --help) usage; exit 0 ;;
        *) echo "tests/run.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
    esac
done
[ ${#parts[@]} -gt 0 ] || parts=(release chart lint asan tsan)

cd "$(dirname "$0")/.."
deploy/install-packages.sh
jobs=$(nproc)
started=$SECONDS
for part in "${parts[@]}"; do
    echo "== $part (at $((SECONDS - started)) s)"
    case $part in
        release | asan | tsan)
            declare -A targets=([release]=all [asan]=fast_tests [tsan]=threads_tests)
            cmake --preset "$part" -DMACULA_WARNINGS_AS_ERRORS=ON >/dev/null
            cmake --build --preset "$part" --target "${targets[$part]}" -- -j "$jobs" --quiet
            ctest --preset "$part" -j "$jobs"
            ;;
        chart) tests/chart/run.sh --quick ;;
        lint) tests/lint.sh ;;
        *) echo "tests/run.sh: no part '$part'" >&2; usage >&2; exit 2 ;;
    esac
done
echo "== done in $((SECONDS - started)) s"
