#!/bin/sh
# The pictures of the studies, as SVG: curves, names of axes and curves, and ticks.
# Usage: pictures.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
command -v gnuplot >/dev/null || { echo "no gnuplot: nothing to check"; exit 0; }
steady=$programs/steady_study traction=$programs/traction_study

# draws PROGRAM ARG...: draws p.svg, and writes its texts to the file words, one on each line, as plain text.
draws() {
    rm -f p.svg
    "$@" --plot p.svg >out 2>err || fail "$*: $(cat err)"
    sed -n 's/.*<text[^>]*>\(.*\)<\/text>.*/\1/p' p.svg | sed 's/<[^>]*>//g' >words
}
says() { grep -qxF -e "$1" words || fail "no '$1' in: $(tr '\n' ';' <words)"; }
# title TEXT: in one line or two
title() { tr '\n' ' ' <words | grep -qF -e "$1" || fail "no title '$1' in: $(tr '\n' ';' <words)"; }
says_not() { ! grep -qF -e "$1" words || fail "'$1' in: $(tr '\n' ';' <words)"; }
curves() { [ "$(grep -c 'id="gnuplot_plot_' p.svg)" -eq "$1" ] || fail "not $1 curves: $(tr '\n' ';' <words)"; }

# ticks at the numbers of elements, even if there is no power of ten between them; as many as there is room for
draws $steady --n 40,50,60,80 --alpha-T 0.5,0.63
for n in 40 50 60 80; do says $n; done
draws $steady --n "$(seq -s, 40 80)"
for n in 40 80; do says $n; done
[ "$(grep -cx '[4-8][0-9]' words)" -ge 5 ] && [ "$(grep -cx '[4-8][0-9]' words)" -lt 30 ] || fail "ticks: $(cat words)"
draws $steady --n 40
says 40
draws "$programs/stability_study" --n 10
says 10 && says_not 9.9 && says_not 10.0
# no ticks at measured times
draws "$programs/precision_study" --scheme cosine:nodes --quantity c11 --n 10,20,40
! grep -Ex '[0-9]+\.[0-9]{2,}' words | grep -vx '0\.0*[12357]' || fail "ticks at times: $(cat words)"

# at most twelve curves, or none and advice; the rows are written
alphas=$(seq -s, 0.4 0.02 0.68)
$traction --n 10 --alpha-T "$alphas" --plot none.svg >out 2>err
[ $? -eq 3 ] && [ ! -e none.svg ] && [ "$(wc -l <out)" -eq 151 ] && grep -q 'would have 15 curves, .* give fewer' err ||
    fail "too many curves: $(cat err)"
# two swept quantities make a map
draws "$programs/stability_study" --n 6 --alpha-L 0,0.2,0.4,0.6,0.8 --alpha-T 0.3,0.5,0.7,0.9,1.1
says 'share of unstable eigenvalues' && says 'αL' && curves 1
draws $traction --n 10 --alpha-T 0.5,0.6
says_not 'the first'
curves 3

# Greek letters, with spaces after subscripts, in a font that every browser has
draws $traction --n 10 --poisson 0,0.25
says 'ν = 0.25' && says 'Carter, ν = 0.25'
draws $steady --n 10,20 --mesh geometric --size-ratio 1,2 --aspect 10,100
says 'b/a = 10, dxT/dxL = 2'
draws "$programs/stability_study" --n 10 --alpha-T 0.5,0.9
says 'αT' && says_not alpha
draws "$programs/stability_study" --n 10,20 --critical
says 'critical αT' && says_not alpha
draws "$programs/transient_study" --step 1 --n 10 --until 1
says '-F / (a G ξref)' && says '|F - Fexact| / (a G ξref)'
! grep '<text>' p.svg || fail 'texts without xml:space'
grep -q 'font-family="sans-serif"' p.svg && ! grep -q Symbol p.svg || fail 'fonts'
# no legend for a single curve, a long title in two lines
draws $steady --n 10,20
title 'Steady rolling, collocation, fd, uniform, αL = 0, αT = 0.63, strip kernel, b/a = 1000, ν = 0.28'
[ "$(grep -c '^|c11 / c11,exact - 1|$' words)" -eq 1 ] || fail "a legend of one curve: $(cat words)"
draws "$programs/friction_study" --transient --n 10 --sine 1,1 --until 2 --derivative analytic --mesh modified-knothe
grep -q '^Rolling with friction, .*,$' words &&
    says_not 'analytic, modified-knothe, n = 10, αL = 0.5, αT = 0.5, λ = 1' ||
    fail "a long title: $(cat words)"

# a panel of errors beside curves that coincide, unless there is no exact value
draws "$programs/frequency_study" --n 10,20 --omega 0.1,1,5
curves 11
[ "$(grep -c '^|c11 / c11,exact - 1|$' words)" -eq 1 ] || fail "no errors: $(cat words)"
draws "$programs/frequency_study" --n 10 --omega 0.1,1,5 --aspect 0.1
says_not 'c11,exact'
# tractions near the trailing edge do not dwarf all others, and the title says so
draws $traction --n 80 --mesh cosine --alpha 0.5
title 'Traction in steady rolling, n = 80, αL = 0.5, αT = 0.5, collocation, fd, cosine, strip kernel, b/a = 1000, ν = 0.28; down to -64.4 at the trailing edge'
says_not '-20'

# modes that grow are in the picture, crossed out and counted, however fast they grow; what decays fast is marked
marks() { grep -c "xlink:href='#gpPt$1'" p.svg; } # those that define others included
crosses() { [ "$(marks 1)" -eq $(($1 + ($1 > 0))) ] || fail "$(marks 1) crosses, not $1 and one in the legend"; }
spectrum="$programs/stability_study --spectrum"
draws $spectrum --n 40 --alpha-T 0.9
title 'Eigenvalues, 7 of 40 unstable, n = 40'
says 'unstable, Re(ν a) > 0' && says 150 && says_not 'beyond the frame'
crosses 7
draws $spectrum --n 20,40 --alpha-T 0.5,0.9
says 'n = 40, αT = 0.9: 7 unstable' && says 'n = 40, αT = 0.5: 0 unstable'
crosses 9
draws $spectrum --n 4 --alpha-T 1.05845703125
title 'Eigenvalues, 1 of 4 unstable'
says 100000 && says 10
crosses 1
draws $spectrum --n 60 --mesh cosine --alpha 0.5
title 'Eigenvalues, none of 60 unstable'
says '21 beyond the frame'
crosses 0
draws $spectrum --n 1 --alpha 0.5
title 'Eigenvalues, none of 1 unstable'
draws $traction --n 80 --alpha-T 0.1
says '1 beyond the frame'

# no line across a point without a value, and a note; a point without neighbours has a marker
draws $steady --n 40 --alpha-T 0.1,0.4,-0.03,0.6,0.9
title '; 1 of 5 values cannot be drawn'
[ "$(cut -d, -f15 out | tr '\n' ' ')" = 'status ok ok assists_creepage ok ok ' ] || fail "no gap: $(cat out)"
grep "^.<path stroke='rgb(  0, 114, 178)'" p.svg | grep -o 'M[^M]*L' | wc -l | grep -qw 2 || fail 'a line across a gap'
draws "$programs/frequency_study" --method polynomial --order 20 --omega "1,$(seq -s, 1000 1030)"
title '; 31 of 32 values cannot be drawn'
[ "$(marks 6)" -ge 3 ] || fail 'a point without neighbours is lost'
# errors of 0
draws $steady --method chebyshev --n 4,8,16 --kernel plane --poisson 0
says '1e-16 or less'
# marks on a short logarithmic axis
draws $steady --n 20,40
says 0.0001 && says '5×10-5' && says '3×10-5'
# labels at the ends of curves, and a legend where ends coincide; of a width and in letters that one column can print
legend() { grep -A4 'id="gnuplot_plot_' p.svg | grep -q '<text'; }
draws $steady --n 20,40 --alpha-T 0.5,0.7
says 'αT = 0.5' && says 'αT = 0.7' && ! legend || fail "a legend beside labels: $(cat words)"
draws "$programs/friction_study" --n 10,20
legend || fail 'no legend of curves that coincide'
grep -q 'viewBox="0 0 600 ' p.svg && ! grep -o 'font-size="[0-9.]*"' p.svg | grep -vqx 'font-size="\(18.00\?\|14.40\?\)"' ||
    fail "letters: $(grep -o 'font-size="[0-9.]*"' p.svg | sort -u)"
# real and imaginary parts in two colours
draws "$programs/frequency_study" --n 10 --omega 0.1,1,5
for colour in '  0, 114, 178' '213,  94,   0'; do grep -q "path stroke='rgb($colour)'" p.svg ||
    fail "no curve in $colour"; done
# what the creepage, the law and the load are; one symbol for the creepage ratio in axis and legend
draws "$programs/friction_study" --n 10 --lateral-ratio 0,0.3
says 'δy = 0.3' && says 'creepage ratio δx = ξx G / (2 (1 - ν) μ p0)'
draws "$programs/friction_study" --n 10 --lateral-ratio 0,0.3 --spin-ratio 0,1
says 'δy = 0.3, δφ = 1'
curves 8
draws "$programs/friction_study" --transient --n 10 --creepage-ratio 0.5 --load-sine 0.5,8 --until 1
title 'Rolling with friction, δ = 0.5, N/N0 = 1 + 0.5 sin(2π q/8), collocation'
draws "$programs/friction_study" --n 10 --falling 0.6,1.2 --layer 0.5 --creepage-ratio 0.5,1
title 'Creep curve, μ falls to μ0 times 0.6, by half at a slip of 1.2, layer 0.5, collocation'
draws "$programs/transient_study" --sine 1,2 --n 10 --until 1
title 'Rolling from rest, a sine of creepage, ω a/V = 2, collocation'

# several panels as PNG, too
for study in "friction_study --n 10" "precision_study --n 4,8 --scheme cosine:nodes --quantity c11,traction,c11_z1" \
    "frequency_study --n 10"; do
    "$programs/"$study --plot p.png >out 2>err && [ "$(tail -c 8 p.png | head -c 4)" = IEND ] ||
        fail "$study as PNG: $(cat err)"
done
# a patch from above: stick, slip, outline, tractions and the pole of spin; curves if there is more to compare
set -- "$programs/patch_study" --n 6 --no-timing
draws "$@" --longitudinal 0.1 --spin 0.2
title 'Patch from above, a/b = 1, ν = 0.28, 6 × 6 elements, ξ = 0.1, η = 0, φ c = 0.2 in μ N / (G a b)'
says stick && says slip && says 'pole of spin' && grep -q '^traction, at most 0\.[0-9]* μ p0$' words ||
    fail "$(cat words)"
curves 5
draws "$programs/patch_study" --n 3 --strips 16 --strip-grading uniform --a-over-b 1,10 --poisson 0.5 --stability
title '; modes grow in 1 of 2'
draws "$@" --longitudinal 2 --spin 0.2 --a-over-b 0.3,3
says slip && says_not stick && says_not 'pole of spin'
curves 6
draws "$@" --longitudinal 0.1,0.2 --spin 0.2
says_not above && says 'ξ G a b / (μ N)' && says '-Mz / (μ N c)'
draws "$@" --longitudinal 0.1,0.2 # rounding is not drawn as a force
says_not ×10
draws "$@" --longitudinal 0.1 --a-over-b 0.5,1,2,4
says a/b && says '-Fx / (μ N)'
draws "$@" --longitudinal 0.1 --transient --dq 0.5 --until 2 --load-sine 0.5,8
says '-Fx / (μ N0)' && says '-Mz / (μ N0 c0)' && says 'load N/N0' && says 'distance rolled q/a'
curves 4
draws "$@" --longitudinal 0.1 --transient --dq 0.5 --until 2 --a-over-b 1,2
says 'a/b = 2' && says '-Mz / (μ N c)' && says_not load
curves 6
# pictures to scale are no higher than their content asks for
draws "$programs/profile_study" --shift 0,0.004 --side both --no-timing
sed -n 's/.*viewBox="0 0 \([0-9]*\) \([0-9]*\)".*/\1 \2/p' p.svg | awk '{ exit !($2 > 1.1 * $1 && $2 < 1.3 * $1) }' ||
    fail "$(grep viewBox p.svg)"

finish
