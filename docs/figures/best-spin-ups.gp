# The spin-ups of studies/designs/best-spin-up-to-*.toml and best-free-spin-up-to-2.0.toml, for docs/how-to/design.md.
# From the repository's root: gnuplot docs/figures/best-spin-ups.gp
set encoding utf8
set terminal pngcairo size 1200,620 font ",15"
set output "docs/figures/best-spin-ups.png"
set border 3 linecolor rgb "#666666"
set tics nomirror
set grid linecolor rgb "#dddddd"
set xlabel "time, 1/ω_c"
set ylabel "speed, ω_c"
set xrange [0:540]
set yrange [0:8.6]
set key outside top center horizontal samplen 2
$to_2_0 << EOD
0 0
160 8
286.082 2.0747
326.742 1.41306
489.407 2
540 2
EOD
$to_2_4 << EOD
0 0
193.603 7.88794
317.556 1.69028
401.05 5.46848
484.611 2.4
540 2.4
EOD
$to_5_0 << EOD
0 0
191.203 0.734567
259.039 0.160394
356.177 1.09596
455.189 5
540 5
EOD
$free_to_2_0 << EOD
0 0
164.77 1.11343
237.711 2.45313
348.693 5.92489
434.736 2
540 2
EOD
$released << EOD
143.268 7.163
228.773 6.133
50.1302 0.1926
EOD
plot $to_2_0 with lines linewidth 3 linecolor rgb "#0072B2" title "to 2.0", \
  $to_2_4 with lines linewidth 3 linecolor rgb "#D55E00" title "to 2.4", \
  $to_5_0 with lines linewidth 3 linecolor rgb "#009E73" title "to 5.0", \
  $free_to_2_0 with lines linewidth 3 dashtype (8,5) linecolor rgb "#0072B2" title "to 2.0, balls never held", \
  $released with points pointtype 6 pointsize 2 linewidth 2 linecolor rgb "#333333" title "balls let go"
