#!/usr/bin/env bash
# Simulates up to which stiffness a damped wall is passive, and stable, on the simulated devices (some minutes), beside the
# condition of docs/damping.md and linear theory: docs/damping-map.csv and docs/damping-map.png.
set -euo pipefail
cd "$(dirname "$0")/../.."
csv=docs/damping-map.csv
if [ "${1:-}" != --draw ]; then
  scripts/build release forceshade_damping_map
  build/release/tests/forceshade_damping_map > "$csv"
fi
gnuplot << END
set datafile separator ','
set terminal pngcairo size 1000,960 font 'sans-serif,12' background '#ffffff'
set output 'docs/damping-map.png'
set logscale xy
set xrange [1e-6:0.063]
set yrange [1e-3:100]
set multiplot layout 3, 3 margins 0.075, 0.985, 0.185, 0.965 spacing 0.02, 0.04
of(device, rate, share, column) = \
  strcol(1) eq device && \$2 == rate && \$3 == share ? (column(column) > 0 ? column(column) : 1e-4) : NaN
set style fill solid noborder
do for [s = 1:3] {
  share = word("1 0.3 0.1", s) + 0
  do for [r = 1:3] {
    rate = word("1000 500 200", r) + 0
    set title sprintf("%d Hz, {/:Italic α} = %g", rate, share) offset 0, -0.7
    if (r == 1) { set ylabel "{/:Italic K} (N/mm)"; set format y '10^{%T}' } else { unset ylabel; set format y "" }
    if (s == 3) { set xlabel "{/:Italic B} (N·s/mm)"; set format x '10^{%T}' } else { unset xlabel; set format x "" }
    unset key
    if (s == 3 && r == 2) { set key at screen 0.53, 0.07 center center vertical maxrows 3 Left reverse width -2 samplen 2 }
    plot '$csv' using 4:(of("premium-1.5", rate, share, 8)) with filledcurves y1=1e-4 lc rgb '#c6dbef' \
         title "stable, simulated: Premium 1.5", \
         '' using 4:(of("premium-1.5", rate, share, 5)) with filledcurves y1=1e-4 lc rgb '#2171b5' \
         title "passive: no path found that gives energy", \
         '' using 4:(of("premium-1.5", rate, share, 9)) with lines lw 2 lc rgb '#000000' title "stable by linear theory", \
         '' using 4:(of("omni", rate, share, 8)) with lines lw 1.5 dt 3 lc rgb '#444444' title "stable, simulated: Omni", \
         '' using 4:(of("premium-1.5", rate, share, 6)) with lines lw 2 lc rgb '#d55e00' \
         title "{/:Italic b} = {/:Italic KT}/2 + {/:Italic γB}", \
         '' using 4:(of("premium-1.5", rate, share, 7)) with lines lw 2 dt 2 lc rgb '#e69f00' title "passive by linear theory"
  }
}
END
echo "$PWD/$csv, $PWD/docs/damping-map.png"
