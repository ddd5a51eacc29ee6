# Share of stalled starts and peak displacement of the laboratory centrifuge by the motor's stall torque, from sommerfeld.csv.
# Run by sommerfeld.sh, which writes that file first.
set terminal pngcairo size 900,640 font "sans,12"
set output "docs/figures/sommerfeld.png"
set datafile separator ","
file = "docs/figures/sommerfeld.csv"
set grid lc rgb "#dddddd"
set multiplot layout 2,1 margins 0.10,0.97,0.10,0.96 spacing 0.06
set key right center
set format x ""
set ylabel "starts, %"
set yrange [-4:104]
plot file using 1:($2*100):($3*100):($4*100) skip 1 with yerrorlines pt 7 lw 2 lc rgb "#d62728" \
       title "stalled, with 95 % intervals", \
     file using 1:($6*100) skip 1 with linespoints pt 6 lw 2 lc rgb "#2ca02c" title "balanced"
set format x "%g"
set xlabel "stall torque, N m"
set ylabel "displacement, mm"
set yrange [0:*]
plot file using 1:7:8:9 skip 1 with yerrorlines pt 7 lw 2 lc rgb "#1f77b4" title "peak, median of all starts", \
     file using 1:10 skip 1 with linespoints pt 6 lw 2 lc rgb "#ff7f0e" title "at the end, median of all starts"
unset multiplot
