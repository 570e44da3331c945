#!/bin/sh
# Other ways to solve the same contacts, side by side with this library, in one run.
#
#   benches/rivals/run.sh
#
# Sets up what it needs in target/rivals (a Python environment with NumPy and SciPy, programs built
# by the C compiler), says what is not installed and goes on without it. All results go to
# target/rivals/all.tsv; what is printed is the fastest setting of each program within each error.
# A second table is that of rough surfaces that repeat, by tamaas; it takes some minutes on its own.
# README.md says what is compared, and how fair that is.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../.."
to=$PWD/target/rivals
mkdir -p "$to"
: >"$to/found.tsv"
without() { echo "without $*" >&2; }

if command -v "${CC:-cc}" >/dev/null; then
    "${CC:-cc}" -O3 -march=native "$here/paper.c" -o "$to/paper" -lm && "$to/paper" >>"$to/found.tsv"
    if pkg-config --exists gsl 2>/dev/null; then
        "${CC:-cc}" -O3 -march=native "$here/gsl_qawc.c" -o "$to/gsl_qawc" \
            $(pkg-config --cflags --libs gsl) && "$to/gsl_qawc" >>"$to/found.tsv"
    else
        without "GSL: pkg-config does not know it"
    fi
else
    without "the programs in C: no C compiler"
fi

python=$to/venv/bin/python
if ! "$python" -c 'import scipy' 2>/dev/null; then
    python3 -m venv "$to/venv" 2>/dev/null &&
        "$python" -m pip install --quiet -r "$here/requirements.txt" || true
fi
if "$python" -c 'import scipy' 2>/dev/null; then
    for program in bem_fft scipy_qawc; do
        "$python" "$here/$program.py" >>"$to/found.tsv"
    done
else
    without "SciPy and the boundary elements: python3 with venv and pip is needed"
fi

# Built anew each time, as it is this checkout's.
if "$python" -m pip install --quiet "$here/../../python" 2>/dev/null; then
    "$python" "$here/linecontact_python.py" >>"$to/found.tsv"
else
    without "this library in Python: python3 with venv, pip and cargo is needed"
fi

cargo bench --quiet --bench tasks -- judge "$to/found.tsv" >"$to/all.tsv"

# Evaluations of the curves and microseconds; "-" where no setting gets there.
awk -F'\t' '
    NR == 1 { next }
    !($1 in tasks) { tasks[$1]; task[++n] = $1 }
    !($2 in names) { names[$2]; name[++m] = $2 }
    {
        for (digits = 3; digits <= 12; digits += 3) {
            key = $1 SUBSEP digits SUBSEP $2
            if ($4 + 0 <= 10 ^ -digits && (!(key in least) || $7 + 0 < least[key])) {
                least[key] = $7 + 0
                cell[key] = $6 ", " sprintf($7 < 100 ? "%.1f" : "%.0f", $7)
            }
        }
    }
    END {
        line = "| task | error of P |"; rule = "|---|---|"
        for (j = 1; j <= m; j++) { line = line " " name[j] " |"; rule = rule "---|" }
        print line; print rule
        for (i = 1; i <= n; i++) for (digits = 3; digits <= 12; digits += 3) {
            line = "| " task[i] " | 1e-" digits " |"
            for (j = 1; j <= m; j++) {
                key = task[i] SUBSEP digits SUBSEP name[j]
                line = line " " (key in cell ? cell[key] : "-") " |"
            }
            print line
        }
    }' "$to/all.tsv"
echo
echo "Evaluations of the curves, microseconds; $(sed -n 's/^model name.*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)"

if "$python" -m pip install --quiet tamaas 2>/dev/null; then
    echo
    cargo bench --quiet --bench several -- periodic |
        "$python" "$here/tamaas_periodic.py" 2>"$to/tamaas_periodic.tsv"
else
    without "tamaas: pip finds no wheel for this machine"
fi
