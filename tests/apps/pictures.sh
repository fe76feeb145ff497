#!/bin/sh
# The pictures of the studies, as SVG: curves, names of axes and curves, and ticks.
# Usage: pictures.sh FOLDER-OF-PROGRAMS
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$(dirname "$0")/functions.sh"
command -v gnuplot >/dev/null || { echo "no gnuplot: nothing to check"; exit 0; }
PATH=$programs:$PATH

# draws PROGRAM ARG...: draws p.svg, and writes its texts to the file words, one on each line, as plain text.
draws() {
    rm -f p.svg
    "$@" --plot p.svg >out 2>err || fail "$*: $(cat err)"
    sed -n 's/.*<text[^>]*>\(.*\)<\/text>.*/\1/p' p.svg | sed 's/<[^>]*>//g' >words
}
# shows TEXT...: each as a text of its own; `title TEXT`: in one line or two; `hides TEXT...`: none with any of them.
shows() { for text; do grep -qxF -e "$text" words || fail "no '$text' in: $(tr '\n' ';' <words)"; done; }
title() { tr '\n' ' ' <words | grep -qF -e "$1" || fail "no title '$1' in: $(tr '\n' ';' <words)"; }
hides() { for text; do ! grep -qF -e "$text" words || fail "'$text' in: $(tr '\n' ';' <words)"; done; }
count() { [ "$(grep -c "$2" p.svg)" -eq "$1" ] || fail "$(grep -c "$2" p.svg), not $1, $2: $(tr '\n' ';' <words)"; }
curves() { count "$1" 'id="gnuplot_plot_'; }
# place TEXT: x and y of the first text like this
place() {
    awk -v text=">$1<" 'match($0, /translate\([0-9.]*,[0-9.]*/) { at = substr($0, RSTART + 10, RLENGTH - 10) }
        /<text/ && index($0, text) { sub(",", " ", at); print at; exit }' p.svg
}
legend() { grep -A4 'id="gnuplot_plot_' p.svg | grep -q '<text'; }

# ticks at the numbers of elements, as many as there is room for, on short logarithmic axes, and none at measured times
draws steady_study --n "$(seq -s, 40 80)"
shows 40 80
[ "$(grep -cx '[4-8][0-9]' words)" -ge 5 ] && [ "$(grep -cx '[4-8][0-9]' words)" -lt 30 ] || fail "ticks: $(cat words)"
draws stability_study --n 10
shows 10
hides 9.9 10.0 alpha
draws steady_study --n 20,40
shows 20 40 0.0001 5×10-5 3×10-5
draws precision_study --scheme cosine:nodes --quantity c11 --n 10,20,40
! grep -Ex '[0-9]+\.[0-9]{2,}' words | grep -vx '0\.0*[12357]' || fail "ticks at times: $(cat words)"

# at most twelve curves, or none and advice; the rows are written; two swept quantities make a map
exits 3 151 traction_study --n 10 --alpha-T "$(seq -s, 0.4 0.02 0.68)" --plot none.svg
[ ! -e none.svg ] && grep -q 'would have 15 curves, .* give fewer' err || fail "too many curves: $(cat err)"
draws stability_study --n 6 --alpha-L 0,0.2,0.4,0.6,0.8 --alpha-T 0.3,0.5,0.7,0.9,1.1
shows 'share of unstable eigenvalues' αL αT
title 'Stability, collocation, finite differences, uniform mesh, n = 6,'
curves 1

# Greek letters, with spaces after subscripts, in a font that every browser has, of a width and in letters that one
# column can print
draws traction_study --n 10 --poisson 0,0.25
shows 'ν = 0.25' 'Carter, ν = 0.25'
draws transient_study --step 1 --n 10 --until 1
shows '-F / (a G ξref)' '|F - Fexact| / (a G ξref)' exact
grep -q '<text>' p.svg && fail 'texts without xml:space'
grep -q 'font-family="sans-serif"' p.svg && ! grep -q Symbol p.svg || fail 'fonts'
grep -q 'viewBox="0 0 600 ' p.svg &&
    ! grep -o 'font-size="[0-9.]*"' p.svg | grep -vqx 'font-size="\(18.00\?\|14.40\?\)"' ||
    fail "letters: $(grep -o 'font-size="[0-9.]*"' p.svg | sort -u)"
# no legend for a single curve, a long title in two lines; labels at the ends of curves, a legend where they coincide
draws steady_study --n 10,20
title 'Steady rolling, collocation, finite differences, uniform mesh, αL = 0, αT = 0.63, strip kernel, b/a = 1000, ν = 0.28'
[ "$(grep -c '^|c11 / c11,exact - 1|$' words)" -eq 1 ] || fail "a legend of one curve: $(cat words)"
draws steady_study --n 20,40 --alpha-T 0.5,0.7
shows 'αT = 0.5' 'αT = 0.7'
legend && fail 'a legend beside labels'
draws friction_study --n 10,20
shows 'Carter'
legend || fail 'no legend of curves that coincide'

# a panel of errors beside curves that coincide, unless there is no exact value; real and imaginary parts in two colours
draws frequency_study --n 10,20 --omega 0.1,1,5
curves 8 # n = 10 and 20 coincide but in errors
shows '|c11 / c11,exact - 1|'
for colour in '  0, 114, 178' '213,  94,   0'; do grep -q "path stroke='rgb($colour)'" p.svg || fail "$colour"; done
# curves that coincide are one; panels are equally wide
draws frequency_study --n 20,40 --omega 0.1,0.2,0.5
shows 'n = 20, 40' 'Re, n = 20, 40' 'n = 40'
curves 8
sed -n 's/^.<path .*d=.M\([0-9.]*\),[0-9.]* L\1,[0-9.]* L\([0-9.]*\),.*Z.*/\1 \2/p' p.svg |
    awk '{ width = $2 - $1; least = NR == 1 || width < least ? width : least; most = width > most ? width : most }
        END { print NR, least, most; exit NR < 3 || most - least > 0.5 }' >frames || fail "frames of other widths: $(cat frames)"
draws frequency_study --n 10 --omega 0.1,1,5 --aspect 0.1
hides c11,exact
draws steady_study --method chebyshev --n 4,8,16 --kernel plane --poisson 0
shows '1e-16 or less'
# tractions near the trailing edge do not dwarf all others, and the title says so
draws traction_study --n 80 --mesh cosine --alpha 0.5
title ', ν = 0.28; down to -64.4 at the trailing edge'
hides -20

# modes that grow are in the picture, crossed out and counted; what decays fast is marked
draws stability_study --spectrum --n 20,40 --alpha-T 0.5,0.9
shows 'n = 40, αT = 0.9: 7 unstable' 'n = 40, αT = 0.5: 0 unstable'
count 10 "xlink:href='#gpPt1'" # and one in the legend
draws stability_study --spectrum --n 4 --alpha-T 1.05845703125
title 'Eigenvalues, 1 of 4 unstable'
shows 100000 10 'unstable, Re(ν a) > 0'
draws stability_study --spectrum --n 60 --mesh cosine --alpha 0.5
title 'Eigenvalues, none of 60 unstable'
shows '21 beyond the frame'
count 0 "xlink:href='#gpPt1'"

# no line across a point without a value, and a note; a point without neighbours has a marker
draws steady_study --n 40 --alpha-T 0.1,0.4,-0.03,0.6,0.9
title '; 1 of 5 values cannot be drawn'
grep "^.<path stroke='rgb(  0, 114, 178)'" p.svg | grep -o 'M[^M]*L' | wc -l | grep -qw 2 || fail 'a line across a gap'
draws frequency_study --method polynomial --order 20 --omega "1,$(seq -s, 1000 1030)"
title '; 31 of 32 values cannot be drawn'
[ "$(grep -c "xlink:href='#gpPt6'" p.svg)" -ge 3 ] || fail 'a point without neighbours is lost'
for empty in 'transient_study --step 1' 'friction_study --transient --creepage-ratio 0.5'; do
    exits 3 1 $empty --until 0.1 --shard 1/100 --plot s.svg
    grep -q 'no point to draw' err || fail "a plot of no row: $empty: $(cat err)"
done

# what the creepage, the law and the load are
draws friction_study --n 10 --lateral-ratio 0,0.3 --spin-ratio 0,1
shows 'δy = 0.3, δφ = 1' 'creepage ratio δx = ξx G / (2 (1 - ν) μ p0)'
curves 8
draws friction_study --n 10 --falling 0.6,1.2 --layer 0.5 --creepage-ratio 0.5,1
title 'Creep curve, μ falls to μ0 times 0.6, by half at a slip of 1.2, layer 0.5, collocation'
draws friction_study --n 20 --mesh uniform --alpha 1.5 --creepage-ratio 0.5
hides bound # of tractions that are wrong
draws friction_study --transient --n 10 --creepage-ratio 0.5 --lateral-ratio 0.2 --load-sine 0.5,8 --until 1
title 'Rolling with friction, δx = 0.5, δy = 0.2, N/N0 = 1 + 0.5 sin(2π q/8), collocation'
grep -q lateral words && grep -q load words && ! grep -q Carter words || fail "load and lateral force: $(cat words)"
draws friction_study --transient --n 10 --sine 1,1 --until 2
grep -q Hysteresis words || fail "no loop: $(cat words)"

# several panels, also as PNG
precision_study --n 4,8 --scheme cosine:nodes --quantity c11,traction,c11_z1 --plot p.png >out 2>err &&
    [ "$(tail -c 8 p.png | head -c 4)" = IEND ] || fail "as PNG: $(cat err)"
# a scheme has the same colour in every panel, although friction lacks two of them; small errors have a floor
draws precision_study --n 40 --scheme polynomial,closed-form,cosine:collocation:0.5/0.5,chebyshev \
    --quantity c11,response,friction
# the first curve of the last panel belongs to the cosine mesh
awk '/id="gnuplot_plot_/ { split($0, part, /<title>|<.title>/); curve = /gnuplot_plot_1c"/ ? "last" : part[2] }
    match($0, /rgb\([^)]*\)/) && curve { colours[curve] = substr($0, RSTART, RLENGTH); curve = "" }
    END { exit !("polynomial" in colours && colours["last"] == colours["cosine:collocation:0.5/0.5"] &&
        colours["last"] != colours["polynomial"]) }' p.svg || fail 'colours of the panels'
[ "$(grep -c chebyshev words)" -eq 1 ] && [ "$(grep -cx 'Pareto front' words)" -eq 1 ] || fail "legends: $(cat words)"
grep -q '1e-14 or less' words && ! grep -q 'quantities drawn' words || fail "no floor, or a note: $(cat words)"
draws precision_study --n 10 --scheme cosine:collocation:0.5/0.5 --quantity traction,c11_z0.1,c11_z1,transient
title 'traction (3 of 4 quantities drawn)'
# a patch from above: stick, slip, outline, tractions and the pole of spin; curves if there is more to compare
set -- patch_study --n 6 --no-timing
draws "$@" --longitudinal 0.1 --spin 0.2
title 'Patch from above, a/b = 1, ν = 0.28, 6 × 6 elements, ξ = 0.1, η = 0, φ c = 0.2 in μ N / (G a b)'
shows stick slip 'pole of spin'
grep -q '^traction, at most 0\.[0-9]* μ p0$' words || fail "$(cat words)"
curves 5
draws "$@" --longitudinal 2 --spin 0.2 --a-over-b 0.3,3
shows slip
hides stick 'pole of spin'
draws "$@" --longitudinal 0.1,0.2 --spin 0,0.2
hides above ×10 # rounding is not drawn as a force
shows 'ξ G a b / (μ N)' '-Mz / (μ N c)'
draws "$@" --longitudinal 0.1 --transient --dq 0.5 --until 2 --load-sine 0.5,8
shows '-Fx / (μ N0)' '-Mz / (μ N0 c0)' 'load N/N0' 'distance rolled q/a'
title 'Patch in time, a/b = 1, ν = 0.28, 6 × 6 elements, ξ = 0.1, η = 0, φ c = 0 in μ N / (G a b)'
draws patch_study --n 3 --strips 16 --strip-grading uniform --a-over-b 1,10 --poisson 0.5 --stability
title '; modes grow in 1 of 2'
# an extrapolated force serves for comparison; long labels of a legend end within the picture
long=richardson:modified-knothe-0.3:galerkin:0/0.63
sed "s,^richardson:cosine:collocation:0.5/0.5,$long," "$root/bench/results/error_against_time.csv" >long.csv
draws precision_study --front long.csv --quantity friction
title 'friction; front without extrapolated schemes'
place "$long" | awk -v letters=${#long} '{ exit !(NF == 2 && $1 + 10.5 * letters < 600) }' ||
    fail "a legend that ends at the frame: $(place "$long")"
# pictures to scale are no higher than their content asks for; each shift has its number, the legend is below the axis
draws profile_study --shift 0,0.001,0.002,0.003,0.004,0.005,0.006,0.007,0.008 --side both --no-timing
for shift in 0 1 2 3 4 5 6 7 8; do
    [ "$(grep -cx "$shift" words)" -ge 2 ] || fail "shift $shift at the contact points: $(cat words)"
done
{ place "y from the rail's origin, field side to the right [mm]" && place rail; } |
    awk 'NR == 1 { axis = $2 } END { exit !(NR == 2 && $2 - axis > 18) }' || fail "the legend is on the axis"
draws profile_study --shift -0.002,0.004 --side both --no-timing
[ "$(grep -cx -e -2 words)" -eq 2 ] && [ "$(grep -cx 4 words)" -eq 2 ] || fail "shifts at contact points: $(cat words)"
title 'Where the right wheel, lifted by 25 mm, touches the rail; numbers: lateral shift [mm]'
sed -n 's/.*viewBox="0 0 \([0-9]*\) \([0-9]*\)".*/\1 \2/p' p.svg | awk '{ exit !($2 > 1.2 * $1 && $2 < 1.7 * $1) }' ||
    fail "$(grep viewBox p.svg)"

finish
