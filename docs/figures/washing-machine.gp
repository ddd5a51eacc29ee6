# Displacement of the washing machine's drum over time: balls free from the start, and held to 600 rpm. Made by
#
#     study=studies/examples/washing-machine.toml
#     equipoise simulate $study --set initial.phi=[0.5,2.0,3.5,5.0] --every 0.1 --until 450 -o free.csv
#     equipoise simulate $study --set initial.phi=[0.5,2.0,3.5,5.0] --every 0.1 --until 450 -o held.csv \
#       --set 'release={speed="600 rpm"}'
#     gnuplot docs/figures/washing-machine.gp
set terminal pngcairo size 900,420 font "sans,12"
set output "docs/figures/washing-machine.png"
set datafile separator ","
wc = sqrt(20e3/40)           # omega_c of the study, rad/s
R = 250                      # race radius, mm
set grid lc rgb "#dddddd"
set xlabel "time, s (40 rpm gained every second)"
set ylabel "displacement, mm"
set xrange [0:20]
set yrange [0:30]
set key right top
limit = 15
set label "cabinet" at 0.2,limit+0.9 textcolor rgb "#666666"
set arrow from 15,graph 0 to 15,graph 0.42 nohead dt 2 lc rgb "#888888"
set label "600 rpm" at 15.2,graph 0.38 textcolor rgb "#666666"
plot "free.csv" using ($1/wc):(column("radial")*R) with lines lw 2 lc rgb "#d62728" title "balls free from the start", \
     "held.csv" using ($1/wc):(column("radial")*R) with lines lw 2 lc rgb "#1f77b4" title "balls held to 600 rpm", \
     limit with lines dt 4 lc rgb "black" notitle
