# The paper's rotor under a motor, by its stall torque, from paper-rotor-with-motor.csv and paper-rotor-brought-at-once.csv.
# Run by paper-rotor-with-motor.sh, which writes those first.
set terminal pngcairo size 900,760 font "sans,12"
set output "docs/figures/paper-rotor-with-motor.png"
set datafile separator ","
file = "docs/figures/paper-rotor-with-motor.csv"
limits = "docs/figures/paper-rotor-brought-at-once.csv"
stats limits using 2 skip 1 every ::0::0 nooutput
free = STATS_mean * 100
stats limits using 2 skip 1 every ::1::1 nooutput
held = STATS_mean * 100
set grid lc rgb "#dddddd"
set logscale x
set xrange [0.0025:25]
set multiplot layout 2,1 margins 0.09,0.97,0.09,0.97 spacing 0.05
set key top right
set format x ""
set ylabel "starts, %"
set yrange [-3:105]
plot file using 1:($2*100):($3*100):($4*100) skip 1 with yerrorlines pt 7 ps 0.8 lw 2 lc rgb "#2ca02c" \
       title "balanced, balls free from the start", \
     file using 1:($6*100):($7*100):($8*100) skip 1 with yerrorlines pt 5 ps 0.8 lw 2 lc rgb "#1f77b4" \
       title "balanced, balls held until 1.5", \
     file using 1:($5*100) skip 1 with linespoints pt 6 dt 2 lw 2 lc rgb "#98df8a" title "stalled or captured at resonance, free", \
     file using 1:($9*100) skip 1 with linespoints pt 4 dt 2 lw 2 lc rgb "#aec7e8" title "stalled, captured or never let go, held", \
     free with lines dt 3 lw 2 lc rgb "#2ca02c" title "brought to 2.4 at once, free", \
     held with lines dt 3 lw 2 lc rgb "#1f77b4" title "brought to 2.4 at once, held until 1.5"
set format x "%g"
set xlabel "stall torque, M R^2 {/Symbol w}_c^2"
set ylabel "mean psi' of what is not balanced"
set yrange [0:2.6]
set key bottom right
resonance = 1 / sqrt(1.1)
plot file using 1:10 skip 1 with linespoints pt 7 ps 0.8 lw 2 lc rgb "#d62728" title "most frequent motion", \
     resonance with lines dt 2 lw 2 lc rgb "#7f7f7f" title "resonance with the balls"
unset multiplot
