#!/usr/bin/env bash
# How many of the instructions of a step are not the integrator's: benches/bookkeeping.sh [SCENE [ACCURACY...]]
#
# Counted by callgrind (Debian: apt-get install valgrind), so that the figure does not depend on what else the machine does.
# Bookkeeping is all of a step but planning, which comes once, and the method that carries the islands: reading and writing
# bodies, looking for neighbours, reports. A scene without contacts or springs must show no instruction of theirs.
set -euo pipefail
cd "$(dirname "$0")/.."
scene=${1:-truth/rope}
shift || true
[ $# -gt 0 ] || set -- 1e-3 1e-6 1e-12
cargo build --release --locked --quiet
counts=$(mktemp)
trap 'rm -f "$counts"' EXIT

# Instructions of the functions whose name matches, with all that they call.
of() { callgrind_annotate --inclusive=yes --threshold=100 "$counts" | tr -d , | grep -v drop_in_place | awk -v name="$1" '!found && $0 ~ name { print $1; found = 1 }'; }

printf '%-10s %14s %14s %14s %12s %s\n' accuracy step planning method bookkeeping "contacts and springs"
for accuracy in "$@"; do
    valgrind --tool=callgrind --callgrind-out-file="$counts" \
        target/release/tautline run "$scene" --seconds 1.5 --accuracy "$accuracy" >/dev/null 2>&1
    step=$(of 'Stepper::step')
    plan=$(of 'Plan::derive')
    method=$(of 'integrate::.*::advance')
    others=$(of 'collide::|::pgs::|Springs::add|SpringSeries::add')
    awk -v accuracy="$accuracy" -v step="$step" -v plan="${plan:-0}" -v method="${method:-0}" -v others="${others:-0}" 'BEGIN {
        printf "%-10s %14d %14d %14d %10.1f %% %d\n", accuracy, step, plan, method, 100 * (1 - method / (step - plan)), others
    }'
done
