# Vibration of the angle grinder around the place to which its weight pulls it, over time, with thin and with thicker oil. Made by
#
#     study=studies/examples/angle-grinder.toml
#     equipoise simulate $study --set initial.phi=[1.0,2.0,4.0,5.0] --every 0.02 --until 200 -o thin.csv
#     equipoise simulate $study --set initial.phi=[1.0,2.0,4.0,5.0] --every 0.02 --until 200 -o thick.csv \
#       --set "balancer.drag=20 mN s/m"
#     gnuplot docs/figures/angle-grinder.gp
set terminal pngcairo size 900,420 font "sans,12"
set output "docs/figures/angle-grinder.png"
set datafile separator ","
wc = sqrt(9000/2.2)          # omega_c of the study, rad/s
R = 25e3                     # race radius, um
sag = 9.81/wc**2*1e6*(2.2 + 4*0.88216e-3)/2.2   # with the balls' weight, um
# The rotating frame's x and y turned back into fixed axes.
X(a,x,y) = R*(x*cos(a) - y*sin(a))
Y(a,x,y) = R*(x*sin(a) + y*cos(a)) + sag
size(a,x,y) = sqrt(X(a,x,y)**2 + Y(a,x,y)**2)
set grid lc rgb "#dddddd"
set xlabel "time since switched on, s"
set ylabel "displacement, um"
set xrange [0:3]
set yrange [0:*]
set key right top
bare = 27.356                # without balls at full speed, as explain says
set arrow from 0.5,graph 0 to 0.5,graph 1 nohead dt 2 lc rgb "#888888"
set label "full speed" at 0.52,graph 0.94 textcolor rgb "#666666"
plot "thin.csv" using ($1/wc):(size($2,$4,$5)) every ::1 with lines lw 1 lc rgb "#d62728" title "3 mN s/m, as stated", \
     "thick.csv" using ($1/wc):(size($2,$4,$5)) every ::1 with lines lw 2 lc rgb "#1f77b4" title "20 mN s/m", \
     bare with lines dt 4 lc rgb "black" title "without balls, at full speed"
