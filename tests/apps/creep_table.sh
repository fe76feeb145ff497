#!/bin/sh
# creep_table and contact_table seen from outside: rows, shards, and how far the table is from the patches.
# Usage: creep_table.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
creep="$programs/creep_table"
coarse="--n 4 --levels 4 --shapes 4"

# --- a table that cannot be written is refused before the first row
mkdir blocked.csv.bin
bad '--output = ../blocked.csv.bin must be a file that can be written' "$creep" $coarse --output ../blocked.csv
[ -e blocked.csv ] && fail 'rows of a table that cannot be written'

# --- rows: solved, and no force above mu N
good 301 "$creep" $coarse
status=$(column status)
check 'a node has no forces' "\$$status == \"ok\""
x=$(column longitudinal_force) y=$(column lateral_force)
check 'a force exceeds mu N' "\$$x * \$$x + \$$y * \$$y <= 1.000001"
check 'the force of no longitudinal creepage' "\$$(column longitudinal) != 0 || \$$x * \$$x < 1e-16"

# --- the same rows by threads, by parts and again, and the same table
good 0 "$creep" $coarse --jobs 2 --output whole.csv
cmp -s out whole.csv && fail 'standard output is the file'
for k in 1 2 3; do "$creep" $coarse --shard $k/3 --output part$k.csv & done
wait
[ -e part1.csv.bin ] && fail 'a part is taken for a table'
cat part?.csv >rows.csv
cmp rows.csv whole.csv || fail 'parts differ from the whole'
good 0 "$creep" $coarse --rows rows.csv --output again.csv
cmp whole.csv.bin again.csv.bin || fail 'the table of the same rows differs'
[ "$(head -c 20 whole.csv.bin)" = 'rollbem creep forces' ] || fail 'no binary table'
{ echo '# all parts'; sed '9s/^/\n/' rows.csv; } >spaced.csv
good 0 "$creep" $coarse --rows spaced.csv --output again.csv
cmp whole.csv.bin again.csv.bin || fail 'the table of rows with comments and empty lines'
sed '12s/,ok,/,no_solution,/' spaced.csv >broken.csv
bad 'line 12: status = no_solution must be ok' "$creep" $coarse --rows "$scratch/broken.csv" --output x.csv
bad 'a_over_b = ' "$creep" --n 4 --levels 4 --shapes 5 --rows "$scratch/rows.csv" --output x.csv
bad 'line 2: a_over_b = 0.1 must be 0.2' "$creep" $coarse --a-over-b 0.2,5 --rows "$scratch/rows.csv" --output x.csv
sed '7s/ok/no_solution/; 7s/,[^,]*,\([^,]*,[^,]*,[^,]*,[^,]*,no_solution\)/,,\1/' rows.csv >broken.csv
bad 'line 7: spin_moment must be a number; status = no_solution' \
    "$creep" $coarse --rows "$scratch/broken.csv" --output x.csv
awk -F, -v OFS=, 'NR == 7 { $9 = "nan" } { print }' rows.csv >broken.csv
bad 'line 7: lateral_force must be a number' "$creep" $coarse --rows "$scratch/broken.csv" --output x.csv
awk -F, -v OFS=, 'NR == 7 { $3 = 99 } { print }' rows.csv >broken.csv
bad 'line 7: n = 99 must be' "$creep" $coarse --rows "$scratch/broken.csv" --output x.csv

# --- the table against the patches: 6 x 6 elements are rough themselves; without their second mesh the largest is 0.057
good 1 "$creep" --n 6 --levels 7 --shapes 5 --a-over-b 0.5,2 --output small.csv --check 400
awk '{ if ($5 + 0 > 7e-3 || $7 + 0 > 0.045 || $5 + 0 <= 0) exit 1 }' out || fail "$(cat out)"
cp small.csv out
check 'the force of no longitudinal creepage on two meshes' "\$$(column longitudinal) != 0 || \$$x * \$$x < 1e-16"

# --- a contact table by parts is the one made at once; parts that are missing, doubled or misplaced are named
table="$programs/contact_table"
small='--shift -0.002,0.002,7 --yaw 0,0.01,2 --load 8e4,1e5 --quiet'
good 0 "$table" $small --output whole.contact
for k in 1 2 3 4; do "$table" $small --shard $k/4 --output node$k.csv & done
wait
cat node?.csv >nodes.csv
good 0 "$table" $small --rows nodes.csv --output again.contact
cmp whole.contact again.contact || fail 'the contact table of the same rows differs'
cat node1.csv node2.csv node4.csv >broken.csv
bad 'line 58: yaw = 0.01 must be 0, as the options of the grid want it' \
    "$table" $small --rows "$scratch/broken.csv" --output x.contact
cat node1.csv node2.csv node3.csv >broken.csv
bad 'line 85: the end, after 84 of 112 rows, must be the end of the last part' \
    "$table" $small --rows "$scratch/broken.csv" --output x.contact
cat node?.csv node4.csv >broken.csv
bad 'line 114: must be the end, after all 112 rows' \
    "$table" $small --rows "$scratch/broken.csv" --output x.contact
cat node1.csv node2.csv node2.csv node4.csv >broken.csv
bad 'line 58: load = 80000 must be 100000' "$table" $small --rows "$scratch/broken.csv" --output x.contact
cat node1.csv node3.csv node2.csv node4.csv >broken.csv
bad 'line 30: load = 1e+05 must be 80000' "$table" $small --rows "$scratch/broken.csv" --output x.contact
sed '10s/,1,,,/,1,0.73,0.002,/' nodes.csv >broken.csv
bad 'line 10: cut_y and cut_half_width must be the cuts of the first rows' \
    "$table" $small --rows "$scratch/broken.csv" --output x.contact
sed '2s/,ok,/,no_contact,/' nodes.csv >broken.csv
bad 'line 3: status = ok must be the status of all rows of a node' \
    "$table" $small --rows "$scratch/broken.csv" --output x.contact
head -c -1 nodes.csv >broken.csv
bad 'must end with a line feed: is the last part complete?' \
    "$table" $small --rows "$scratch/broken.csv" --output x.contact
awk -F, -v OFS=, 'NR == 2 { $17 = -$17 } { print }' nodes.csv >broken.csv
bad 'line 2: half_length_over_root = -' "$table" $small --rows "$scratch/broken.csv" --output x.contact
bad 'nodes.csv must be of the profiles, the track and the material' \
    "$table" $small --rail uic60 --rows "$scratch/nodes.csv" --output x.contact
exit $failures
