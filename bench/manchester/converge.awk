# awk -F, -f converge.awk finest.csv table.csv...: the errors of tables of profile_study against the finest, mean and
# largest over all wheels: relative ones of approach, peak pressure and area, of forces over mu N, of the moment over mu
# N c, c = sqrt(area/pi).
FNR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; if (NR > 1) print_means(); next }
NR == FNR { for (name in at) finest[$1, $4, $5, name] = $at[name]; next }
{
    limit = 0.3 * finest[$1, $4, $5, "load"]
    arm = sqrt(finest[$1, $4, $5, "area"] / 3.14159265358979)
    add("approach", 0); add("peak_pressure", 0); add("area", 0)
    add("longitudinal_force", limit); add("lateral_force", limit); add("spin_moment", limit * arm)
    ++count
}
function add(name, scale) {
    difference = ($at[name] - finest[$1, $4, $5, name]) / (scale ? scale : finest[$1, $4, $5, name])
    if (difference < 0) difference = -difference
    sum[name] += difference
    if (difference > largest[name]) largest[name] = difference
}
function print_means() {
    for (name in sum) printf "%s: %s %.1e, %.1e\n", file, name, sum[name] / count, largest[name]
    delete sum; delete largest; count = 0; file = FILENAME
}
END { print_means() }
