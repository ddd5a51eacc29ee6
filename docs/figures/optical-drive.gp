# RMS velocity of the optical drive at full speed by the rolling resistance of its balls, from optical-drive.csv.
# Run by optical-drive.sh, which writes that file first.
set terminal pngcairo size 900,440 font "sans,12"
set output "docs/figures/optical-drive.png"
set datafile separator ","
file = "docs/figures/optical-drive.csv"
set grid lc rgb "#dddddd"
set xlabel "rolling resistance over normal force (stiction twice that)"
set ylabel "RMS velocity at 10 000 rpm, mm/s"
set xrange [-0.00005:0.00205]
set yrange [0:50]
set key left top
of(runout, column) = $1 == runout ? column : NaN
plot file using 2:(of(5,$6)) skip 1 with linespoints pt 6 dt 2 lw 2 lc rgb "#1f77b4" title "runout 5 um: 90 % of starts below", \
     file using 2:(of(5,$3)):4:5 skip 1 with yerrorlines pt 7 lw 2 lc rgb "#1f77b4" title "median, with 95 % interval", \
     file using 2:(of(20,$6)) skip 1 with linespoints pt 6 dt 2 lw 2 lc rgb "#d62728" title "runout 20 um: 90 % of starts below", \
     file using 2:(of(20,$3)):4:5 skip 1 with yerrorlines pt 7 lw 2 lc rgb "#d62728" title "median, with 95 % interval", \
     12 with lines dt 4 lc rgb "black" title "limit"
