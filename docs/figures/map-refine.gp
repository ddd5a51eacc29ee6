# What `map --refine 32` computes of the basins at Omega = 2.4. From the repository's root, with jq and gnuplot:
#
#     equipoise map studies/paper/table-2-omega-2.4.toml --size 256x256 --refine 32 --json > map.json
#     jq -r '[.outcome, .time] | transpose | to_entries[] | .key as $y | .value | transpose | to_entries[]
#            | [.key, $y, .value[0], if .value[1] then 1 else 0 end] | @tsv' map.json > map.tsv
#     gnuplot docs/figures/map-refine.gp
set terminal pngcairo size 900,470 font "sans,12"
set output "docs/figures/map-refine.png"
unset key
unset colorbox
set size ratio 1
set xrange [-0.5:255.5]
set yrange [-0.5:255.5]
unset xtics
unset ytics
set multiplot layout 1,2 margins 0.02,0.98,0.02,0.92 spacing 0.03
set cbrange [0:3]
set palette defined (0 "#000000", 1 "#9ecae1", 2 "#fdae6b", 3 "#31a354")
set title "outcomes"
plot "map.tsv" using 1:2:3 with image
set cbrange [0:1]
set palette defined (0 "#f2f2f2", 1 "#333333")
set title "pixels computed (dark), filled in (light)"
plot "map.tsv" using 1:2:4 with image
unset multiplot
