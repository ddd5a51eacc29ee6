#!/bin/sh
# The sweep of the laboratory centrifuge's stall torque: share of starts that stall and peak displacement, with 95 % intervals.
# Writes sommerfeld.csv in this folder, which curves.py draws. From the repository's root, with jq:
#
#     docs/figures/sommerfeld.sh PROGRAM [STARTS]
set -eu
program=${1:-build/release/equipoise}
starts=${2:-150}
study=studies/examples/laboratory-centrifuge.toml
csv=docs/figures/sommerfeld.csv

echo "stall_torque_Nm,stalled,low,high,undecided,balanced,peak_p50_mm,p50_low,p50_high,end_p50_mm" > "$csv"
for torque in 0.3 0.4 0.45 0.48 0.49 0.5 0.55 0.6 0.8 1.0 1.25 1.5 2.0; do
  "$program" basin "$study" --starts "$starts" --json --quiet \
    --set "speed.torque={stall=\"$torque N m\", no_load_speed=\"3200 rpm\"}" |
    jq -r --arg torque "$torque" '
      .stalled as $stalled |
      ([.outcomes[] | select(.name == "balanced")][0].share) as $balanced |
      (.transients.groups[0].figures | map_values(.quantiles[] | select(.probability == 0.5))) as $median |
      [$torque, $stalled.share, $stalled.low, $stalled.high, .undecided.share, $balanced,
       $median.peak_radial.value, $median.peak_radial.low, $median.peak_radial.high, $median.peak_radial_at_end.value] | join(",")' >> "$csv"
done
