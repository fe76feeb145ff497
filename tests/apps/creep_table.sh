#!/bin/sh
# creep_table and contact_table seen from outside: rows, shards, and how far the table is from the patches.
# Usage: creep_table.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
creep="$programs/creep_table --n 4 --levels 4 --shapes 4"

# --- a table that cannot be written is refused before the first row
mkdir blocked.csv.bin
bad '--output = ../blocked.csv.bin must be a file that can be written' $creep --output ../blocked.csv
[ ! -e blocked.csv ] || fail 'rows of a table that cannot be written'

# --- rows: solved, and no force above mu N; the same by threads, by parts and again, and the same table
good 301 $creep
check 'forces' '$status == "ok" && $longitudinal_force ^ 2 + $lateral_force ^ 2 <= 1.000001 &&
    ($longitudinal != 0 || $longitudinal_force ^ 2 < 1e-16)'
good 0 $creep --jobs 2 --output whole.csv
for k in 1 2 3; do $creep --shard $k/3 --output part$k.csv & done
wait
[ ! -e part1.csv.bin ] || fail 'a part is taken for a table'
cat part?.csv >rows.csv
cmp rows.csv whole.csv || fail 'parts differ from the whole'
{ echo '# all parts'; sed '9s/^/\n/' rows.csv; } >spaced.csv
for file in rows.csv spaced.csv; do
    good 0 $creep --rows $file --output again.csv
    cmp whole.csv.bin again.csv.bin || fail "the table of $file differs"
done

# --- rows that are missing, doubled or wrong are named. broken TEXT COMMAND PROGRAM ARG...: with rows by the command
broken() {
    text=$1
    eval "$2" >broken.csv
    shift 2
    bad "$text" "$@" --rows "$scratch/broken.csv" --output x.csv
}
broken 'line 12: status = no_solution must be ok' "sed '12s/,ok,/,no_solution,/' spaced.csv" $creep
broken 'line 7: status = ' "sed '7s/,ok,/,,/' rows.csv" $creep
broken 'a_over_b = ' 'cat rows.csv' "$programs/creep_table" --n 4 --levels 4 --shapes 5
broken 'line 7: lateral_force must be a number' "awk -F, -v OFS=, 'NR == 7 { \$9 = \"nan\" } { print }' rows.csv" $creep
broken 'line 7: n = 99 must be' "awk -F, -v OFS=, 'NR == 7 { \$3 = 99 } { print }' rows.csv" $creep

# --- the table against the patches: 6 x 6 elements are rough themselves; without their second mesh the largest is 0.057
good 1 "$programs/creep_table" --n 6 --levels 7 --shapes 5 --a-over-b 0.5,2 --output small.csv --check 400
awk '{ exit !($5 > 0 && $5 + 0 <= 7e-3 && $7 + 0 <= 0.045) }' out || fail "$(cat out)"

# --- a contact table by parts is the one made at once, with the same warning
table="$programs/contact_table --shift -0.002,0.002,5 --yaw 0,0.01,2 --load 8e4,1e5 --quiet --no-fit"
exits 0 0 $table --output whole.contact
complains 'forces differ from patches by' && coarse=$(cat err)
for k in 1 2 3 4; do $table --shard $k/4 --output node$k.csv & done
wait
cat node?.csv >nodes.csv
exits 0 0 $table --rows nodes.csv --output again.contact
complains "$coarse"
cmp whole.contact again.contact || fail 'the contact table of the same rows differs'
broken 'line 42: yaw = 0.01 must be 0, as the options of the grid want it' 'cat node[124].csv' $table
broken 'line 61: the end, after 60 of 80 rows, must be the end of the last part' 'cat node[123].csv' $table
broken 'line 82: must be the end, after all 80 rows' 'cat node?.csv node4.csv' $table
broken 'must end with a line feed: is the last part complete?' 'head -c -1 nodes.csv' $table
broken 'line 10: cut_y and cut_half_width must be the cuts of' "awk -F, -v OFS=, 'NR == 10 { \$6 = 0.71; \$7 = 0.002 } { print }' nodes.csv" $table
broken 'line 3: status = ok must be the status of all rows of a node' "sed '2s/,ok,/,no_contact,/' nodes.csv" $table
broken ': half_length_over_root = -' "awk -F, -v OFS=, 'NR > 1 && \$27 > 0 { \$27 = -\$27 } { print }' nodes.csv" $table
broken 'broken.csv must be of the profiles, the track and the material' 'cat nodes.csv' $table --rail uic60

finish
