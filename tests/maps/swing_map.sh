#!/usr/bin/env bash
# Simulates a hand on a virtual wall over the rate of the loop and the stiffness (some minutes) and draws what it is given:
# docs/swing.csv and docs/swing.png.
set -euo pipefail
cd "$(dirname "$0")/../.."
scripts/build release forceshade_swing_map
csv=docs/swing.csv
build/release/tests/forceshade_swing_map > "$csv"
cells=$(mktemp)
trap 'rm -f "$cells"' EXIT
# The worst of the models and hands in each cell: controller, rate, stiffness, energy, swing, tripped.
awk -F, 'NR > 1 { k = $2 " " $4 " " $5; if ($6 > e[k]) e[k] = $6; if ($7 > s[k]) s[k] = $7; if ($10 != "no") t[k] = 1; seen[k] = 1 }
         END { for (k in seen) print k, e[k], s[k] + 0, t[k] + 0 }' "$csv" | sort > "$cells"
awk '{ if ($4 > e[$1]) e[$1] = $4; t[$1] += $6 }
  END { for (c in e) printf "%s: at most %.1f mJ; %d cells with a trip\n", c, e[c], t[c] }' "$cells"
gnuplot << END
set terminal pngcairo size 1250,900 font 'sans-serif,12' background '#ffffff'
set output 'docs/swing.png'
set multiplot layout 2,3 title "A hand on a virtual wall for 6 s, simulated: the worst of three devices, pressing or stroking" font ',14'
set logscale xyz
set logscale cb
half_x = 40 ** (1.0 / 22)  # of a cell: 12 points over these factors
half_y = 80 ** (1.0 / 22)
set xrange [100 / half_x:4000 * half_x]
set yrange [0.1 / half_y:8 * half_y]
set xtics (100, 300, 1000, 3000)
set ytics (0.1, 0.2, 0.5, 1, 2, 5)
set xlabel "rate of the loop (Hz)"
set ylabel "stiffness {/:Italic K} (N/mm)"
set palette defined (0 '#f3f7fb', 1 '#9ecae1', 2 '#3182bd', 3 '#08306b')
passive(rate) = 2 * rate * (1.3 + 0.0108) / 1e3
set key below samplen 3
do for [what in "energy swing"] {
  column = what eq "energy" ? 4 : 5
  set cblabel what eq "energy" ? "energy (mJ)" : "swing within 0.1 s (mm)"
  if (what eq "energy") { set cbrange [1:200]; set cbtics (1, 3, 10, 30, 100) }
  if (what ne "energy") { set cbrange [0.1:10]; set cbtics (0.1, 0.3, 1, 3, 10) }
  floor = what eq "energy" ? 1 : 0.1
  do for [controller in "damping tank observer"] {
    set title controller.", ".what
    plot "< awk '\$1 == \"".controller."\"' $cells" \
      using 2:3:(\$2/half_x):(\$2*half_x):(\$3/half_y):(\$3*half_y):(column(column) > floor ? column(column) : floor) \
           with boxxyerror fs solid noborder lc palette notitle, \
         "< awk '\$1 == \"".controller."\" && \$6 > 0' $cells" using 2:3 with points pt 2 ps 1.1 lw 1.5 lc rgb '#d55e00' \
           title "the supervisor ended a run", \
         passive(x) with lines lw 2 dt 2 lc rgb '#d55e00' title "{/:Italic b} = {/:Italic KT}/2, warned of above"
  }
}
END
echo "$PWD/$csv, $PWD/docs/swing.png"
