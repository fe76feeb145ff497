# awk -F, -f noise.awk wheel.csv: the profile with points 0.2 mm apart or more and noise of 0.01 mm, half of the
# variance in y and half in z.
BEGIN { srand(1) }
function noise() { return 0.01 / sqrt(2) * sqrt(-2 * log(1 - rand())) * cos(6.283185307179586 * rand()) }
!/^[-0-9]/ { print; next }
($1 - y) ^ 2 + ($2 - z) ^ 2 >= 0.04 { y = $1; z = $2; print y + noise() "," z + noise() }
