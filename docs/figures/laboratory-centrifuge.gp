# Speed and displacement of the laboratory centrifuge over time, with the stated motor and with a weaker one. Made by
#
#     study=studies/examples/laboratory-centrifuge.toml
#     equipoise simulate $study --set initial.phi=[1.0,4.0] --every 0.5 --until 2500 -o passing.csv
#     equipoise simulate $study --set initial.phi=[1.0,4.0] --every 0.5 --until 2500 -o captured.csv \
#       --set 'speed.torque={stall="0.4 N m", no_load_speed="3200 rpm"}'
#     gnuplot docs/figures/laboratory-centrifuge.gp
set terminal pngcairo size 900,640 font "sans,12"
set output "docs/figures/laboratory-centrifuge.png"
set datafile separator ","
wc = sqrt(110e3/10)          # omega_c of the study, rad/s
rpm = wc*30/pi
R = 60                       # race radius, mm
set grid lc rgb "#dddddd"
set multiplot layout 2,1 margins 0.11,0.97,0.10,0.95 spacing 0.06
set key right center
set format x ""
set ylabel "speed, rpm"
set yrange [0:3400]
set arrow from graph 0,first rpm to graph 1,first rpm nohead dt 2 lc rgb "#888888"
set label "critical speed" at graph 0.99,first rpm+120 right textcolor rgb "#666666"
plot "passing.csv" using ($1/wc):($3*rpm) every ::1 with lines lw 2 lc rgb "#1f77b4" title "stall torque 1.5 N m", \
     "captured.csv" using ($1/wc):($3*rpm) every ::1 with lines lw 2 lc rgb "#d62728" title "0.4 N m: captured"
unset arrow; unset label
set format x "%g"
set key off
set xlabel "time, s"
set ylabel "displacement, mm"
set yrange [0:*]
plot "captured.csv" using ($1/wc):(column("radial")*R) with lines lw 1 lc rgb "#d62728", \
     "passing.csv" using ($1/wc):(column("radial")*R) with lines lw 1 lc rgb "#1f77b4"
unset multiplot
