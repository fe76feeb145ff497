#!/bin/sh
# --state-space of frequency_study, seen from outside: the files of matrices.
# Usage: state_space.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
f="$programs/frequency_study --kernel plane --aspect 100 --poisson 0.25 --omega 0,0.7,5"

# bad input leaves no file
bad '--state-space = /dev/null/d must be a folder that can be written' $f --n 8 --alpha 0.5 --state-space /dev/null/d
mkdir -p blocked/C.csv
bad '--state-space = blocked/C.csv must be a file' sh -c "cd .. && $f --n 8 --state-space blocked"
[ "$(ls blocked)" = C.csv ] || fail "files are left: $(ls blocked)"

# distances FOLDER: of the c11 of the rows in out from C (i z - A)^-1 B + D of two states, in closed form.
distances() {
    rows 'FILENAME ~ "A.csv" { a[FNR, 1] = $1; a[FNR, 2] = $2 }
        FILENAME ~ "B.csv" { b[FNR] = $1 }
        FILENAME ~ "C.csv" { c1 = $1; c2 = $2 }
        FILENAME ~ "D.csv" { d = $1 }
        FILENAME == "out" && FNR > 1 {
            z = $omega
            re = a[1, 1] * a[2, 2] - a[1, 2] * a[2, 1] - z * z; im = -z * (a[1, 1] + a[2, 2])
            up = c1 * (a[1, 2] * b[2] - a[2, 2] * b[1]) + c2 * (a[2, 1] * b[1] - a[1, 1] * b[2])
            side = z * (c1 * b[1] + c2 * b[2])
            size = re * re + im * im
            print sqrt(((up * re + side * im) / size + d - $c11_re) ^ 2 + ((side * re - up * im) / size - $c11_im) ^ 2)
        }' "$1/A.csv" "$1/B.csv" "$1/C.csv" "$1/D.csv" out
}
mkdir there && echo old >there/A.csv && echo other >there/note
for scheme in '--method chebyshev' '--mesh cosine --alpha 0.5' '--method knothe-bc'; do
    for folder in there made/below; do
        good 4 $f --unchecked --n 2 $scheme --state-space $folder
        distances $folder | awk '$1 < 1e-12 { ++near } END { exit near != 3 || NR != 3 }' ||
            fail "$scheme in $folder: $(distances $folder)"
        [ "$(cat $folder/D.csv)" = 0 ] || fail "D = $(cat $folder/D.csv)"
        grep -q '^# command_line = .*--state-space' $folder/state_space.toml || fail 'companion file'
    done
    rm -r made
done
[ "$(ls there | tr '\n' ' ')$(cat there/note)" = 'A.csv B.csv C.csv D.csv note state_space.toml other' ] ||
    fail "files in a folder that was there: $(ls there)"
grep -q ',-0\|^-0$' there/*.csv && fail 'negative zeros'
# reduced: the steady state of the table, and elsewhere within the bound
value() { sed -n "s/^# $1 = \([^ ]*\).*/\1/p" reduced/state_space.toml; }
good 4 $f --method chebyshev --n 24 --state-space reduced --states 2
[ "$(value states)" = 2 ] || fail 'number of states'
distances reduced | awk -v bound="$(value error_bound)" -v left="$(value largest_hankel_singular_value_left_out)" '
    { good += NR == 1 ? $1 < 1e-13 : $1 <= bound && $1 > bound / 1000 }
    END { exit !(good == 3 && left > 0 && bound >= 2 * left && bound < 0.5) }' || fail "reduced: $(distances reduced)"

# each file whole: a full disk, a table that cannot be written, no gnuplot
f="$f --method chebyshev --n 8"
echo old >there/A.csv
(ulimit -f 1 && $f --state-space there >out 2>err)
[ $? -eq 4 ] && [ "$(wc -l <err)" -eq 1 ] && [ "$(cat there/A.csv)" = old ] || fail "a full disk: $(cat err)"
$f --state-space full/below >/dev/full 2>err
[ $? -eq 4 ] && [ ! -e full ] || fail 'files in spite of an error'
[ -z "$(find . -name '*.part')" ] || fail "temporary files are left: $(find . -name '*.part')"
PATH=/nonexistent $f --state-space full --plot x.svg >out 2>err
[ $? -eq 3 ] && [ "$(wc -l <full/A.csv)" -eq 8 ] && [ "$(wc -l <out)" -eq 4 ] || fail 'files without gnuplot'

finish
