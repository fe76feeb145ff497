#!/bin/sh
# apps/stability_study.cpp and apps/frequency_study.cpp, seen from outside: what they refuse, columns, rows, shards and
# jobs, and numbers known from elsewhere.
# Usage: stability_frequency.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
stability=$programs/stability_study
frequency=$programs/frequency_study

# --- stability: bad input
s="$stability --output x.csv --n 10"
bad '--critical and --spectrum must not be given together' $s --critical --spectrum
bad '--alpha-T = 0.5 has no effect with --critical' $s --critical --alpha-T 0.5
bad '--alpha = 0.5 has no effect with --critical' $s --critical --alpha 0.5
bad '--method = knothe-bc must be collocation or galerkin with --critical' $s --critical --method knothe-bc
bad 'at least 2' "$stability" --output x.csv --critical --n 1 --alpha-L 0.63
bad '--alpha-T = 0.5 has no effect with --method knothe-bc' $s --method knothe-bc --alpha-T 0.5
bad '--aspect = inf must be positive and finite' $s --aspect inf
bad '--aspect = 0.1 must be larger than' $s --kernel plane --aspect 0.1
bad 'unstable in time' $s --kernel plane --aspect 0.1 --spectrum
bad '--lambda = 1.5 must lie in [0, 1]' $s --lambda 1.5
bad '--omega' $s --omega 1

# --- stability: columns, rows, numbers (kernel and contact of the published values)
s="$stability --poisson 0.25"
good 5 $s --n 20,40 --alpha-T 0.5,0.63
header method,derivative,mesh,n,alpha_L,alpha_T,lambda,unstable_count,uncertain_count,unstable_fraction,spectral_abscissa,cond_G,time_us,spectral_radius,stiffness_ratio
check 'alpha_T up to 0.63 is stable' '$unstable_count == 0 && $uncertain_count == 0 && $unstable_fraction == 0 && $spectral_abscissa < 0 && $cond_G > 1 && $time_us > 0'
check 'spectral radius and stiffness ratio' '$spectral_radius > $n / 2 && $spectral_radius >= -$spectral_abscissa && $stiffness_ratio > $n && $stiffness_ratio <= $spectral_radius / -$spectral_abscissa * (1 + 1e-12)'
good 2 $s --n 1 --alpha 0.5
check 'one element: one eigenvalue' '$spectral_radius == -$spectral_abscissa && $stiffness_ratio == 1'
good 2 $s --n 20 --alpha 0.55
check 'equal alphas above 0.5 are unstable' '$unstable_count > 0 && $unstable_fraction == $unstable_count / 20 && $spectral_abscissa > 0'
good 2 $s --n 20 --alpha 1 --lambda 0.45
check 'lambda below 0.5 is stable' '$unstable_count == 0 && $lambda == 0.45'
good 2 $s --n 30 --mesh cosine --alpha 0.5
check 'cosine mesh is stable' '$unstable_count == 0 && $uncertain_count == 0'
good 2 $s --n 20 --method knothe-bc --jobs 2
check 'knothe-bc: no alpha, no time' '$alpha_L $alpha_T $lambda $time_us == "" && $unstable_count >= 0'
good 2 $s --n 8 --kernel strip --aspect 0.1
good 3 $s --n 20,40 --critical --jobs 2
header method,derivative,mesh,n,alpha_L,critical_alpha_T
check 'critical alpha_T' '($critical_alpha_T - ($n == 20 ? 0.8974 : 0.7687)) ^ 2 < 1e-8'
good 3 $s --n 6 --critical --lambda 0.4,1
check 'no critical alpha_T for lambda below 0.5' '($critical_alpha_T == "") == ($lambda < 0.5)'
good 61 $s --n 60 --spectrum --mesh cosine --alpha 0.5 --aspect 100 --kernel plane
header n,re,im,exact_re,exact_im
rows 'NR == 2 { real = ($re / -0.17302005735 - 1) ^ 2 < 1e-6 && ($exact_re / -0.17302005735 - 1) ^ 2 < 1e-20 && $im == 0 }
    NR == 3 { pair = ($im / 2.98100869072 - 1) ^ 2 < 1e-4 && ($exact_im / 2.98100869072 - 1) ^ 2 < 1e-20 }
    NR == 4 { pair = pair && $im < 0 && $exact_im < 0 } END { exit !(real && pair) }' out || fail 'first eigenvalues'
good 20 $s --n 20 --spectrum --method knothe-bc
good 9 $s --n 8 --spectrum --aspect 0.1
check 'no exact eigenvalues where the plane model does not decay' '$re != "" && $exact_re == "" && $exact_im == ""'
good 11 $s --n 10 --spectrum --alpha 1
# one element, uniform, alpha = 0: G' and the eigenvalue are zero
good 2 $s --n 1 --spectrum --alpha 0
# schemes with stable eigenvalues that steady rolling shows to be flawed
good 3 $s --n 20 --alpha 0.5,1.5
check 'status' '$unstable_count == 0 && $status == ($alpha_T == 0.5 ? "ok" : "assists_creepage") && $kernel == "strip" && $aspect == 1000 && $poisson == 0.25'
good 2 $s --n 3 --alpha-L 0 --alpha-T 0.1
check 'status of few elements' '$status == "coarse"'
good 2 $s --n 4 --method chebyshev --aspect 0.3
good 3 $s --n 6 --critical --lambda 0.4,1
check 'status without a critical alpha_T' '$status == ($lambda < 0.5 ? "all_stable" : "ok") && $kernel == "strip"'
good 21 $s --n 20 --spectrum --alpha 1.5
check 'status of eigenvalues' '$status == "assists_creepage" && $method == "collocation" && $mesh == "uniform" && $kernel == "strip"'
good 5 $s --n 4 --spectrum --alpha 0.5 --lambda 0
rows 'NR > 1 && ($re == "") != ($status == "not_finite") { bad = 1 } END { exit bad }' out || fail 'infinite eigenvalues'
good 5 $s --n 8 --aspect 10,100 --poisson 0
[ "$(cut -d, -f11 out | sort -u | wc -l)" -eq 5 ] || fail 'contacts that make no difference'
shards $s --n 6,9 --alpha-T 0.5,0.63,0.8
shards $s --n 5,8 --spectrum
shards $s --n 4,6,8 --critical

# --- frequency: bad input
f="$frequency --output x.csv --n 10"
bad '--omega = -1 must be at least 0 and finite' $f --omega -1
bad '--omega = nan must be at least 0 and finite' $f --omega 1,nan
bad '--omega = inf must be at least 0 and finite' $f --omega inf
bad 'repeated items: 1' $f --omega 1,1
bad '--omega-min = 0.1 has no effect with --omega' $f --omega 1 --omega-min 0.1
bad '--points = 5 has no effect with --omega' $f --omega 1 --points 5
bad '--omega-min = 0 must be positive' $f --omega-min 0
bad '--omega-min = nan must be positive' $f --omega-min nan
bad '--omega-max = 0.5 must be larger than --omega-min = 1' $f --omega-min 1 --omega-max 0.5
bad '--points = 0 must be an integer in [2, 1000000]' $f --points 0
bad '--aspect = inf must be positive and finite' $f --omega 1 --aspect inf
bad '--aspect = 0.1 must be larger than' $f --omega 1 --kernel plane --aspect 0.1
bad '--order = 20 has no effect with --method collocation' $f --omega 1 --order 20
bad '--basis = monomial has no effect with --method galerkin' $f --omega 1 --method galerkin --basis monomial
bad '--method = foo must be one of collocation, galerkin, knothe-bc, nodes, chebyshev, polynomial' $f --method foo
p="$frequency --output x.csv --method polynomial"
for option in --n --alpha --alpha-L --alpha-T --lambda; do
    bad "$option = 0.5 has no effect with --method polynomial" $p --omega 1 $option 0.5
done
bad '--mesh = cosine has no effect with --method polynomial' $p --omega 1 --mesh cosine
bad '--kernel = strip must be plane with --method polynomial' $p --omega 1 --kernel strip
bad '--aspect = 0.1 must be larger than' $p --omega 1 --aspect 0.1
bad '--order = 0 must be an integer in' $p --omega 1 --order 0
bad '--basis = foo must be one of monomial, chebyshev' $p --omega 1 --basis foo
bad 'chebyshev' $p --omega 20 --basis monomial
bad 'chebyshev' $p --omega 1 --basis monomial --order 100000000
bad 'chebyshev' $p --omega 1,50 --basis monomial --order 60

# --- frequency: columns, rows, numbers
f="$frequency --poisson 0.25 --kernel plane"
good 184 "$frequency"
good 4 $f --n 60 --omega 0,1,5
header n,omega,c11_re,c11_im,exact_re,exact_im,relative_error
check 'uniform 0/0.63' '$relative_error < 2.2e-4 && $relative_error > 0'
rows 'NR == 2 { ok = $c11_im == 0 && $exact_im == 0 && ($exact_re - 2.0943951023931953) ^ 2 < 1e-28 } END { exit !ok }' out ||
    fail 'the steady limit'
good 22 $f --n 60 --mesh cosine --alpha 0.5 --omega-min 1e-3 --omega-max 5 --points 21
check 'cosine 0.5/0.5' '$relative_error < 3e-4'
rows 'NR == 2 { first = $omega == 1e-3 } NR == 12 { middle = ($omega / sqrt(5e-3) - 1) ^ 2 < 1e-24 }
    NR == 22 { last = $omega == 5 } END { exit !(first && middle && last) }' out || fail 'spacing of the frequencies'
for method in galerkin knothe-bc; do
    good 3 $f --n 20 --method $method --omega 0.5,1e300
    check "$method: finite at every frequency" '$c11_re != "" && $exact_re != "" && $relative_error < 10'
done
good 2 "$frequency" --n 20 --aspect 0.1 --omega 1
check 'no exact value where the plane model does not decay' '$c11_re != "" && $exact_re == "" && $relative_error == ""'
good 6 "$frequency" --method polynomial --omega 0,1,5,50,200
check 'Chebyshev basis: machine precision' '$n == "" && $relative_error < 1e-12 && $order > 0'
good 2 "$frequency" --method polynomial --basis monomial --order 20 --omega 1 --kernel plane
check 'monomial basis' '$relative_error < 1e-13 && $order == 20'
good 3 "$frequency" --method polynomial --order 10,12 --omega 1
rows 'NR == 2 { low = $relative_error } END { exit !($relative_error < low / 10 && low > 1e-13) }' out || fail 'a higher order is better'
check 'the estimate bounds the error' '$error_estimate >= $relative_error && $error_estimate < 1e-7 && $rcond == ""'
good 2 "$frequency" --method polynomial --order 5 --omega 1
check 'an order that is too low gives an estimate alone' '$c11_re $c11_im $relative_error == "" && $exact_re != "" && $error_estimate > 1e-7'
good 4 $f --n 200 --omega 1,1e4,1e6
check 'condition' '$rcond > 0 && $rcond < 1 && $error_estimate == ""'
rows 'NR == 2 { near = $rcond } END { exit !($rcond < near / 1e3) }' out || fail 'the condition at high frequencies'
good 3 $f --n 40,41 --alpha 1.5 --omega 1
check 'a scheme that does not converge' '$c11_re $c11_im $relative_error == "" && $exact_re != ""'
check 'its status' '$status == "assists_creepage"'
good 3 $f --n 40,41 --alpha 1.5 --omega 1 --unchecked
check 'unchecked' '$c11_re != "" && $relative_error > 0.05 && $status == "assists_creepage"'
good 2 $f --n 3 --alpha-T 0.1 --omega 0
check 'few elements' '$c11_re == "" && $status == "coarse"'
good 2 "$frequency" --method polynomial --order 5 --omega 1
check 'status of a low order' '$c11_re == "" && $status == "not_converged" && $method == "polynomial" && $kernel == "plane" && $nodes == "" && $basis == "chebyshev"'
good 3 "$frequency" --method polynomial --order 5,60 --basis monomial --omega 50 --unchecked
check 'orders that the paper prints' '$c11_re != "" && $relative_error != "" && $status == "not_converged" && $basis == "monomial"'
good 5 $f --n 20 --aspect 10,100 --poisson 0 --omega 1
check 'each contact has its own exact value' '$relative_error < 1e-3 && $kernel == "plane"'
[ "$(cut -d, -f5 out | sort -u | wc -l)" -eq 5 ] || fail 'exact values of contacts'
good 5 "$frequency" --method polynomial --aspect 10,100 --poisson 0,0.3 --omega 1
check 'the same by polynomials' '$relative_error < 1e-12'
bad '--aspect = 0.1 must be larger than' $f --n 20 --aspect 100,0.1 --omega 1
# matrices that are not finite lose their row only, and name the option where there can be no row
wide='--aspect 1000,1e-308'
good 3 "$stability" --n 6 $wide
check 'stability with an aspect that is too small' '$status == ($aspect == 1000 ? "ok" : "not_finite") && ($unstable_count == "") == ($aspect != 1000)'
good 3 "$stability" --n 6 $wide --critical
check 'critical alpha_T with an aspect that is too small' '$status == ($aspect == 1000 ? "ok" : "not_finite") && ($critical_alpha_T == "") == ($aspect != 1000)'
good 9 "$stability" --n 4 $wide --spectrum
check 'eigenvalues with an aspect that is too small' '($status == "not_finite") == ($aspect != 1000) && ($re == "") == ($aspect != 1000)'
good 5 "$frequency" --n 6 $wide --omega 0,1
check 'c11 with an aspect that is too small' '($rcond == "") == ($c11_re == "") && $status == ($aspect == 1000 ? "ok" : "not_finite") && ($c11_re == "") == ($aspect != 1000)'
bad '--aspect = 1e-308 must be such that G and G'"'"' are finite' "$programs/transient_study" --step 1 --n 6 $wide
good 2 "$frequency" --method polynomial --omega 1 --aspect 1e308
check 'the largest aspect' '$c11_re > 0 && $relative_error < 1e-12'
good 2 "$frequency" --method polynomial --basis monomial --order 200 --omega 1
check 'an estimate that is not zero' '$status == "ok" && $rcond == "" && $error_estimate >= $relative_error && $error_estimate < 1e-14'
shards $f --n 7,9 --omega 0.1,1,3
shards "$frequency" --method polynomial --order 10,20 --omega 0.1,1,3

# --- plots
if command -v gnuplot >/dev/null; then
    for arguments in '--alpha-T 0.6,0.9' '--lambda 0.4,1' '--spectrum' '--critical'; do
        good "$("$stability" --n 8,10 $arguments | wc -l)" "$stability" --n 8,10 $arguments --plot s.svg
        [ "$(grep -c '</svg>' s.svg)" -eq 1 ] || fail "plot of $arguments"
    done
    good 7 "$frequency" --n 5,10 --omega 0.1,1,5 --plot f.svg
    [ "$(grep -c '</svg>' f.svg)" -eq 1 ] && grep -q 'Im, exact' f.svg && grep -q 'Re c' f.svg || fail 'both panels'
    good 9 "$frequency" --n 5,10 --omega 1,5 --aspect 10,100 --plot f.svg
    grep -q 'Im, exact, b/a = 10, ' f.svg || fail 'exact curves of two contacts'
    good 62 "$frequency" --method polynomial --plot p.svg
    grep -q 'Im, computed' p.svg || fail 'default orders make one curve'
fi

finish
