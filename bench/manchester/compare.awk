# awk -F, -f compare.awk contact.csv manchester.csv: differences of profile_study from CONTACT over all wheels but the
# one of which CONTACT joins two contacts: quantity, unit, mean, largest, where. Forces over mu N, moments over mu N c,
# c = sqrt(area/pi), each with its own load and area, as CONTACT's grid makes areas larger. With -v rows=1 forces and
# moments of each wheel instead, both signs as on the wheel.
/^#/ { next }
$1 == "side" { for (i = 1; i <= NF; ++i) ref[$i] = i; next }
$1 == "shift" {
    for (i = 1; i <= NF; ++i) own[$i] = i
    print rows ? "side,shift,longitudinal,lateral,moment,contact_longitudinal,contact_lateral,contact_moment" \
               : "quantity,unit,mean,largest,side,shift_mm"
    next
}
NR == FNR { for (name in ref) contact[$1, $2 + 0, name] = $ref[name]; next }
$own["patch"] == 1 {
    side = $own["side"]; shift = 1000 * $own["shift"]; shift = sprintf("%.1f", shift) + 0
    N = contact[side, shift, "load"]; limit = 0.3 * N; c = sqrt(contact[side, shift, "area"] / 3.14159265358979)
    if (rows) {
        M = 300 * $own["load"]; C = 1000 * sqrt($own["area"] / 3.14159265358979)
        printf "%s,%s,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", side, shift, \
            1000 * $own["longitudinal_force"] / M, 1000 * $own["lateral_force"] / M, \
            1e6 * $own["spin_moment"] / M / C, \
            -contact[side, shift, "fx"] / limit, -contact[side, shift, "fs"] / limit, \
            -contact[side, shift, "mn"] / limit / c
        next
    }
    if (side == "right" && shift == 5) next
    add("x", "mm", 1000 * $own["x"] - contact[side, shift, "x"])
    add("y", "mm", 1000 * $own["y"] - contact[side, shift, "y"])
    add("z", "mm", 1000 * $own["z"] - contact[side, shift, "z"])
    add("angle", "rad", $own["angle"] - contact[side, shift, "angle"])
    add("height", "mm", 1000 * $own["height"] - contact[side, shift, "height"])
    add("load", "1", $own["load"] / N - 1)
    add("approach", "1", 1000 * $own["approach"] / contact[side, shift, "approach"] - 1)
    add("peak_pressure", "1", 1e-6 * $own["peak_pressure"] / contact[side, shift, "peak_pressure"] - 1)
    add("area", "1", 1e6 * $own["area"] / contact[side, shift, "area"] - 1)
    add("longitudinal_creepage", "1", $own["longitudinal_creepage"] - contact[side, shift, "cksi"])
    add("lateral_creepage", "1", $own["lateral_creepage"] - contact[side, shift, "ceta"])
    add("spin", "1/mm", 0.001 * $own["spin"] - contact[side, shift, "cphi"])
    add("longitudinal_force", "mu N", (-$own["longitudinal_force"] - contact[side, shift, "fx"]) / limit)
    add("lateral_force", "mu N", (-$own["lateral_force"] - contact[side, shift, "fs"]) / limit)
    C = 1000 * sqrt($own["area"] / 3.14159265358979)
    add("spin_moment", "mu N c", -1e6 * $own["spin_moment"] / (300 * $own["load"] * C) - contact[side, shift, "mn"] / limit / c)
}
function add(name, unit, difference) {
    if (!(name in count)) { order[++names] = name; of[name] = unit; largest[name] = -1 }
    if (difference < 0) difference = -difference
    if ($own["status"] != "ok" && $own["status"] != "doubtful_plane") difference = 1e9
    sum[name] += difference
    ++count[name]
    if (difference > largest[name]) { largest[name] = difference; where[name] = side "," shift }
}
END {
    if (rows) exit
    for (k = 1; k <= names; ++k) {
        name = order[k]
        printf "%s,%s,%.2e,%.2e,%s\n", name, of[name], sum[name] / count[name], largest[name], where[name]
    }
}
