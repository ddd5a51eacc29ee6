#!/bin/sh
# The sweep of the optical drive's rolling resistance for a race that runs out by 5 and by 20 um: RMS velocity at full speed.
# Writes optical-drive.csv in this folder, which curves.py draws. From the repository's root, with jq:
#
#     docs/figures/optical-drive.sh PROGRAM [STARTS]
set -eu
program=${1:-build/release/equipoise}
starts=${2:-300}
study=studies/examples/optical-drive.toml
csv=docs/figures/optical-drive.csv

echo "runout_um,rolling,velocity_p50_mm_per_s,p50_low,p50_high,velocity_p90_mm_per_s,balanced" > "$csv"
for runout in 5 20; do
  for rolling in 0 0.0002 0.0005 0.001 0.0015 0.002; do
    "$program" basin "$study" --starts "$starts" --json --quiet \
      --set "balancer.race_offset=[\"$runout um\", \"0 um\"]" \
      --set balancer.rolling=$rolling --set "balancer.stiction=$(awk "BEGIN { print 2 * $rolling }")" |
      jq -r --arg runout $runout --arg rolling $rolling '
        .transients.groups[0].figures.rms_velocity.quantiles as $velocity |
        ($velocity[] | select(.probability == 0.5)) as $median |
        ($velocity[] | select(.probability == 0.9)) as $ninety |
        [$runout, $rolling, $median.value, $median.low, $median.high, $ninety.value,
         ([.outcomes[] | select(.name | startswith("balanced")) | .share] | add)] | join(",")' >> "$csv"
  done
done
