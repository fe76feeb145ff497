#!/bin/sh
# --state-space of frequency_study, seen from outside: the files of matrices.
# Usage: state_space.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
frequency="$programs/frequency_study --method chebyshev"
plane='--kernel plane --aspect 100 --poisson 0.25'
f="$frequency --omega 0,0.7,5 --n 8"

# bad input leaves no file
bad '--state-space = /dev/null/d must be a folder that can be written' $f --state-space /dev/null/d
bad '--output = /nonexistent/x.csv must be' $f --state-space "$scratch/d/e/f" --output /nonexistent/x.csv

mkdir -p blocked/C.csv
bad '--state-space = blocked/C.csv must be a file' sh -c "cd .. && $f --state-space blocked"
[ "$(ls blocked)" = C.csv ] || fail "files are left: $(ls blocked)"

# c11 z A B C D: real and imaginary part of C (i z - A)^-1 B + D, by elimination in real numbers.
c11() {
    awk -v z="$1" -F, 'FILENAME ~ "A.csv" {
            n = NF; for (k = 1; k <= n; ++k) { m[FNR, k] = -$k; m[FNR + NF, k + NF] = -$k }
            m[FNR, FNR + n] = -z; m[FNR + n, FNR] = z }
        FILENAME ~ "B.csv" { m[FNR, 2 * n + 1] = $1; m[FNR + n, 2 * n + 1] = 0; good += NF == 1 }
        FILENAME ~ "C.csv" { for (k = 1; k <= n; ++k) c[k] = $k; good += NF == n }
        FILENAME ~ "D.csv" { d = $1; good += NF == 1 }
        END {
            N = 2 * n
            for (i = 1; i <= N; ++i) {
                p = i
                for (r = i + 1; r <= N; ++r) if (m[r, i] ^ 2 > m[p, i] ^ 2) p = r
                for (k = i; k <= N + 1; ++k) { t = m[i, k]; m[i, k] = m[p, k]; m[p, k] = t }
                for (r = 1; r <= N; ++r) {
                    if (r == i || m[r, i] == 0) continue
                    t = m[r, i] / m[i, i]
                    for (k = i; k <= N + 1; ++k) m[r, k] -= t * m[i, k]
                }
            }
            re = d
            for (k = 1; k <= n; ++k) {
                re += c[k] * m[k, N + 1] / m[k, k]; im += c[k] * m[k + n, N + 1] / m[k + n, k + n]
            }
            if (good == n + 2) printf "%.17g %.17g\n", re, im
        }' "$2/A.csv" "$2/B.csv" "$2/C.csv" "$2/D.csv"
}

# --- the state space: its matrices give the c11 of the table
mkdir there && echo old >there/A.csv && echo other >there/note
for scheme in '--method chebyshev --n 8' '--method chebyshev --n 1' '--mesh cosine --alpha 0.5 --n 15' \
    '--method knothe-bc --n 9'; do
    for folder in there made/below; do
        good 4 "$programs/frequency_study" --omega 0,0.7,5 --state-space $folder $plane $scheme
        tail -n +2 out | while IFS=, read -r _ z re im _; do
            c11 "$z" $folder | awk -v re="$re" -v im="$im" '{ read = 1
                exit ($1 - re) ^ 2 + ($2 - im) ^ 2 > 1e-24 * (re ^ 2 + im ^ 2) }
                END { if (!read) exit 1 }' || echo "$z"
        done >wrong
        [ ! -s wrong ] || fail "c11 of the files at omega = $(cat wrong): $scheme in $folder"
        [ "$(cat $folder/D.csv)" = 0 ] || fail "D = $(cat $folder/D.csv)"
        grep -q '^# command_line = .*--state-space' $folder/state_space.toml || fail 'companion file'
    done
    [ "$(ls there | tr '\n' ' ')$(cat there/note)" = 'A.csv B.csv C.csv D.csv note state_space.toml other' ] ||
        fail "files in a folder that was there: $(ls there)"
    rm -r made
done
$f $plane --state-space exact >out
rows 'NR == 3 { exit !($relative_error < 1e-13 && $relative_error != "") }' out || fail 'the table beside the files'
grep -q ',-0\|^-0$' exact/*.csv && fail 'negative zeros'
# reduced: the steady state of the table, and elsewhere within the bound
$frequency --n 24 --omega 0,0.7,5 $plane --state-space reduced --states 5 >out
[ "$(wc -l <reduced/A.csv)" -eq 5 ] && grep -q '^# states = 5$' reduced/state_space.toml || fail 'number of states'
value() { sed -n "s/^# $1 = \([^ ]*\).*/\1/p" reduced/state_space.toml; }
tail -n +2 out | while IFS=, read -r _ z re im _; do
    c11 "$z" reduced | awk -v z="$z" -v re="$re" -v im="$im" -v bound="$(value error_bound)" \
        -v left="$(value largest_hankel_singular_value_left_out)" '{ error = sqrt(($1 - re) ^ 2 + ($2 - im) ^ 2)
            read = left > 0 && bound >= 2 * left && bound < 0.02
            exit z == 0 ? error > 1e-13 : error > bound || error < bound / 1000 } END { if (!read) exit 1 }' ||
                echo "$z"
done >wrong
[ ! -s wrong ] || fail "the reduced system at omega = $(cat wrong)"
if command -v python3 >/dev/null && python3 -c 'import numpy' 2>/dev/null; then
    python3 - <<'END' || fail 'numpy does not read the files'
import numpy as np
A, B, C, D = (np.loadtxt(f'exact/{name}.csv', delimiter=',', ndmin=2) for name in 'ABCD')
assert A.shape == (8, 8) and C.shape == (1, 8) and B.shape == (8, 1) and D.shape == (1, 1)
END
fi
printf 'state-space = "configured"\nmethod = "chebyshev"\nn = 3\nomega = 1\n' >c.toml
good 2 "$programs/frequency_study" --config c.toml
[ -s configured/A.csv ] || fail '--state-space in a configuration file'

# --- each file whole: a full disk, a table that cannot be written
echo old >exact/A.csv
(ulimit -f 1 && $f --state-space exact >out 2>err)
[ $? -eq 4 ] && [ "$(wc -l <err)" -eq 1 ] && [ "$(cat exact/A.csv)" = old ] || fail "a full disk: $(cat err)"
$f --state-space full/below >/dev/full 2>err
[ $? -eq 4 ] && [ ! -e full ] || fail 'files in spite of an error'
[ -z "$(find . -name '*.part')" ] || fail "temporary files are left: $(find . -name '*.part')"
PATH=/nonexistent $f --state-space full --plot x.svg >out 2>err
[ $? -eq 3 ] && [ "$(wc -l <full/A.csv)" -eq 8 ] && [ "$(wc -l <out)" -eq 4 ] || fail 'files without gnuplot'

finish
