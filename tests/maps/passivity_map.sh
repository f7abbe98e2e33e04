#!/usr/bin/env bash
# Simulates how stiff a sampled wall may be over friction and damping (some minutes) and draws the border of Abbott and
# Okamura over it: docs/passivity.csv and docs/passivity.png.
set -euo pipefail
cd "$(dirname "$0")/../.."
scripts/build release forceshade_passivity_map
csv=docs/passivity.csv
build/release/tests/forceshade_passivity_map > "$csv"
awk -F, 'NR > 1 { e = ($3 / $4 - 1) * 100; if (e < low) low = e; if (e > high) high = e }
         END { printf "simulated over theoretical border: %+.1f %% to %+.1f %%\n", low, high }' "$csv"
gnuplot << END
set datafile separator ','
set terminal pngcairo size 900,700 font 'sans-serif,13' background '#ffffff'
set output 'docs/passivity.png'
set title "Largest quiet stiffness of a sampled spring wall: 0.05 kg, {/:Italic T} = 1 ms, Δ = 30 µm"
set xlabel "Coulomb friction {/:Italic f}_c (N)"
set ylabel "damping {/:Italic b} (N·s/m)"
set cblabel "{/:Italic K} (N/mm), simulated"
set logscale xycb
half = 40 ** (1.0 / 30)  # of a cell: 16 points over a factor of 40, on both axes
set xrange [0.0015 / half:0.06 * half]
set yrange [0.05 / half:2 * half]
set xtics (0.002, 0.005, 0.01, 0.02, 0.05)
set ytics (0.05, 0.1, 0.2, 0.5, 1, 2)
set cbtics (0.1, 0.2, 0.5, 1, 2, 4)
set palette defined (0 '#e3eef8', 1 '#9ecae1', 2 '#4292c6', 3 '#08306b')
set key below
set style textbox opaque noborder fillcolor '#ffffff' margins 0.4, 0.4
do for [k in "0.2 0.5 1 2"] {
  f = k * 1000 * 3e-5 / 2
  b = k * 1000 * 1e-3 / 2
  set arrow from f, b to 0.06 * half, b nohead lw 2 dt 2 lc rgb '#d55e00' front
  set arrow from f, b to f, 2 * half nohead lw 2 dt 2 lc rgb '#d55e00' front
  set label k." N/mm" at f * 1.04, b * 1.16 front boxed tc rgb '#a34400'
}
plot '< tail -n +2 $csv' using 1:2:(\$1/half):(\$1*half):(\$2/half):(\$2*half):3 with boxxyerror fs solid noborder lc palette notitle, \
     NaN with lines lw 2 dt 2 lc rgb '#d55e00' title \
       "{/:Italic K} = min(2{/:Italic b}/{/:Italic T}, 2{/:Italic f}_c/Δ): Abbott and Okamura 2005"
END
echo "$PWD/$csv, $PWD/docs/passivity.png"
