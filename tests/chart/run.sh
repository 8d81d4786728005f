#!/usr/bin/env bash
# Charts of speed against accuracy: builds macula-chart, makes a Python environment in build/chart-env, and runs
# chart.py in it.
set -euo pipefail
usage() {
    cat <<USAGE
usage: tests/chart/run.sh [--quick | --full | --rows NAME... | --from-csv FILE] [--out DIR] [--with-fvvdp]
  --quick          small pictures, under 5 minutes; fails if a bound breaks (default)
  --full           the display's true size, both scenes, half an hour and more
  --rows NAME...   these rows alone; summary.md has the names
  --from-csv FILE  measures nothing: summary and charts of a table of rows
  --out DIR        where rows.csv, summary.md and the charts go (default: out/chart)
  --with-fvvdp     installs pyfvvdp for JOD, a tool from outside under CC BY-NC
USAGE
}
wanted=(flip-evaluator==1.7)
for argument in "$@"; do
    case $argument in
        -h | --help) usage; exit 0 ;;
        --with-fvvdp) wanted+=(pyfvvdp==1.2.2) ;;
    esac
done

. "$(dirname "$0")/build.sh"
# Debian's NumPy and Matplotlib are seen from within; what Debian has not comes from PyPI, where that can be reached.
python=$root/build/chart-env/bin/python
[ -x "$python" ] || /usr/bin/python3 -m venv --system-site-packages "$root/build/chart-env"
for package in "${wanted[@]}"; do
    module=${package%%==*}
    "$python" -c "import ${module//-/_}" 2>/dev/null ||
        "$python" -m pip install --quiet --disable-pip-version-check --retries 1 --timeout 20 "$package" ||
        echo "tests/chart: $package cannot be installed; the run goes on without it" >&2
done
exec "$python" "$root/tests/chart/chart.py" --program "$program" "$@"
