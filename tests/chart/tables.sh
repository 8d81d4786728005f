#!/usr/bin/env bash
# Tables beside the chart: builds macula-chart and measures one. FLIP and JOD are there once run.sh has made their Python
# environment in build/chart-env.
set -euo pipefail
usage() {
    cat <<USAGE
usage: tests/chart/tables.sh paper | ablation [options]
  paper      frame time and speed-up beside the paper's Table 1: results/paper-table.md
  ablation   what each model of the pipeline is worth: results/ablation.md
  --help     after either: its options
USAGE
}
table=${1:-}
case $table in
    paper) script=paper_table.py ;;
    ablation) script=ablation.py ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
esac
shift

. "$(dirname "$0")/build.sh"
python=$root/build/chart-env/bin/python
[ -x "$python" ] || python=/usr/bin/python3
exec "$python" -B "$root/tests/chart/$script" --program "$program" "$@"
