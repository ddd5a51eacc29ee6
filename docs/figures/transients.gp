# One start of the washing machine: what is measured on its way and at its end. Made by
#
#     equipoise simulate studies/new/washing-machine.toml --set initial.phi=[0.3,1.2,3.0,5.0] \
#       --every "0.005 s" --until "14 s" -o run.csv
#     gnuplot docs/figures/transients.gp
set terminal pngcairo size 900,460 font "sans,12"
set output "docs/figures/transients.png"
set datafile separator ","
wc = 2*pi*3.6                # omega_c of the study, rad/s
R = 250                      # race radius, mm
set key off
set logscale y
set xrange [0:14]
set yrange [0.1:100]
set xlabel "time, s"
set ylabel "radial displacement, mm"
set grid lc rgb "#eeeeee"
set arrow 1 from 0,15 to 14,15 nohead dt 2 lc rgb "#d62728"
set label 1 "limits.displacement" at 13.8,18 right tc rgb "#d62728"
set arrow 2 from 0,1 to 14,1 nohead dt 2 lc rgb "#2ca02c"
set label 2 "limits.settled" at 13.8,1.25 right tc rgb "#2ca02c"
set label 3 "peak displacement" at 6.3,38 right
set arrow 3 from 6.35,36 to 6.75,28 lc rgb "#444444"
set label 4 "time above the limit:\nall pieces together" at 8.4,36 left
set arrow 4 from 6.34,15 to 7.18,15 nohead lw 5 lc rgb "#d62728"
set arrow 8 from 7.41,15 to 7.89,15 nohead lw 5 lc rgb "#d62728"
set arrow 5 from 8.35,33 to 7.6,16.5 lc rgb "#444444"
set arrow 6 from 0,0.16 to 9.3,0.16 heads lc rgb "#2ca02c"
set label 5 "settling time, from release (here at 0)" at 4.6,0.21 center tc rgb "#2ca02c"
set arrow 7 from 9.3,1 to 9.3,0.13 nohead dt 3 lc rgb "#2ca02c"
plot "run.csv" using ($1/wc):(column("radial")*R) with lines lw 1.5 lc rgb "#1f77b4"
