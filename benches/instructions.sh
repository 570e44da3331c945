#!/bin/sh
# Instructions of one call, counted by valgrind: unlike a time the same in every run.
#
#   benches/instructions.sh [PIECES...]      default 1 100
#   benches/instructions.sh --check          compares with benches/instructions.tsv, within 2 %
#   benches/instructions.sh --update         keeps those of this run there
#
# A compiler other than the one that the counts kept are of makes other counts: --check says so and compares
# nothing.
#
# Each case of benches/embedding.rs, several.rs, default.rs and questions.rs, compiled as one in benches/counted.rs, is
# run few and many times, and the difference divided, so that neither starting up nor making the bodies counts. Both
# numbers have as many digits: the length of the arguments moves the stack, and with it some 20 000 instructions of the
# start.
# Without AVX-512, which valgrind does not know:
# RUSTFLAGS="-C target-cpu=native" may end in an illegal instruction.
set -eu
cd "$(dirname "$0")/.."
command -v valgrind >/dev/null || { echo "valgrind is not installed: nothing counted"; exit 0; }
way=print kept=benches/instructions.tsv compiler="# $(rustc --version | cut -d' ' -f1,2)"
case "${1:-}" in --*) way=$1; set -- ;; esac
[ $# -gt 0 ] || set -- 1 100
if [ "$way" = --check ] && [ "$compiler" != "$(head -n 1 "$kept")" ]; then
    echo "instructions: kept are those of $(head -n 1 "$kept"), not of $compiler: nothing compared"
    exit 0
fi
bench=$(cargo bench --bench counted --no-run 2>&1 | sed -n 's/.*Executable.*(\(.*\))$/\1/p')
[ -x "$bench" ] || { echo "the benches do not build: cargo bench --no-run"; exit 1; }

# Prints the instructions of one run of a bench.
instructions() {
    BENCH=$1 && shift
    export BENCH
    valgrind --tool=cachegrind --cache-sim=no --cachegrind-out-file=/dev/null \
        "$bench" "$@" 2>&1 | sed -n 's/.*I *refs: *//p' | tr -d ,
}

counts() {
    printf 'scalar\tpieces\tcold\tload\tbody\tmoment\tturned\tP1\tP100\tP10k\n'
    for scalar in f64 f32; do
        for pieces in "$@"; do
            printf '%s\t%s' "$scalar" "$pieces"
            for case in cold load body moment turned P1 P100 P10k; do
                few=03 many=33
                [ "$case" = P10k ] && few=1 many=2
                less=$(instructions embedding repeat "$case" "$scalar" "$pieces" "$few")
                more=$(instructions embedding repeat "$case" "$scalar" "$pieces" "$many")
                printf '\t%s' $(((more - less) / (many - few)))
            done
            echo
        done
    done

    printf '\nscene\tcold\twarm\n'
    for scene in word one two ten rough; do
        printf '%s' "$scene"
        for start in cold warm; do
            few=05 many=25
            [ "$scene" = rough ] && few=1 many=2
            less=$(instructions several repeat "$scene" "$start" "$few")
            more=$(instructions several repeat "$scene" "$start" "$many")
            printf '\t%s' $(((more - less) / (many - few)))
        done
        echo
    done

    printf '\nscene\tcold\tbare-cold\tnext\tbare-next\n'
    for scene in parabola circle example3 example4 wave layer0.3 layer1; do
        printf '%s' "$scene"
        for case in cold bare-cold next bare-next; do
            # An even number, as two loads take turns.
            few=04 many=24
            less=$(instructions default repeat "$scene" "$case" "$few")
            more=$(instructions default repeat "$scene" "$case" "$many")
            printf '\t%s' $(((more - less) / (many - few)))
        done
        echo
    done

    printf '\nscene\tpressures\twarm-pressures\tready\tstress\tshear\tapproach\tby-approach\tcertify\n'
    for scene in parabola example4 wave; do
        printf '%s' "$scene"
        for case in pressures warm-pressures ready stress shear approach by-approach certify; do
            few=2 many=6
            [ "$case" = shear ] && few=1 many=2
            less=$(instructions questions repeat "$scene" "$case" "$few")
            more=$(instructions questions repeat "$scene" "$case" "$many")
            printf '\t%s' $(((more - less) / (many - few)))
        done
        echo
    done
}

case $way in
print) counts "$@" ;;
--update) { echo "$compiler"; counts "$@"; } >"$kept" ;;
--check)
    found=$(mktemp)
    { echo "$compiler"; counts "$@"; } >"$found"
    awk -F '\t' '
        NR == FNR { kept[FNR] = $0; lines = FNR; next }
        {
            n = split(kept[FNR], old, "\t")
            same = n == NF
            for (i = 1; i <= NF && same; i++) {
                number = $i ~ /^[0-9]+$/ && old[i] ~ /^[0-9]+$/
                off = number ? $i - old[i] : 0
                same = number ? off <= 0.02 * old[i] && -off <= 0.02 * old[i] : $i == old[i]
            }
            if (!same) { print "kept  " kept[FNR] "\nfound " $0; bad = 1 }
        }
        END {
            if (bad || FNR != lines) { print "if that is meant, keep it with --update"; exit 1 }
            print "instructions as kept, within 2 %"
        }' "$kept" "$found" || { rm "$found"; exit 1; }
    rm "$found"
    ;;
*) echo "$way: give --check, --update or numbers of pieces" && exit 2 ;;
esac
