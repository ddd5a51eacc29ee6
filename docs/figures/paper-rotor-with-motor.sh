#!/bin/sh
# The paper's rotor under a motor, by the motor's stall torque: the share of starts that balance, balls free from the start
# or held until psi' = 1.5, the share that stalls, is captured at resonance or never let go, and the speed of what is not balanced. Torque
# towards infinity: the same rotor brought to 2.4 at once. Writes paper-rotor-with-motor.csv and
# paper-rotor-brought-at-once.csv in this folder, which curves.py draws. From the repository's root, with jq:
#
#     docs/figures/paper-rotor-with-motor.sh PROGRAM [STARTS]
set -eu
program=${1:-build/release/equipoise}
starts=${2:-4000}
study=studies/paper-rotor-with-motor.toml
csv=docs/figures/paper-rotor-with-motor.csv
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

shares='(.outcomes[] | select(.name == "balanced") | [.share, .low, .high]),
  [([.outcomes[] | select(.name | test("captured|stalled")) | .share] | add // 0) + .stalled.share + .undecided.share]'

echo "stall_torque,balanced_free,low,high,hangs_free,balanced_held,held_low,held_high,hangs_held,other_speed" > "$csv"
for torque in 0.003 0.005 0.007 0.009 0.011 0.012 0.014 0.017 0.02 0.025 0.03 0.04 0.05 0.07 0.1 0.15 0.2 0.3 0.5 1 2 5 10 20; do
  set -- "$study" --json --quiet --set "speed.torque={stall=$torque, no_load_speed=2.4}"
  "$program" basin "$@" --starts "$starts" > "$scratch/free"
  "$program" basin "$@" --starts "$starts" --set release.speed=1.5 > "$scratch/held"
  "$program" attractors "$@" > "$scratch/list"
  jq -rn --arg torque "$torque" --slurpfile free "$scratch/free" --slurpfile held "$scratch/held" \
    --slurpfile list "$scratch/list" "
      def shares: $shares;"'
      [[$torque], ($free[0] | shares), ($held[0] | shares),
       [[$list[0].attractors[] | select(.name != "balanced" and .stable)] | max_by(.share) | .speed.mean]]
      | add | join(",")' >> "$csv"
done

# Brought there at once: from 0 to 2.4 in a millionth of a unit of time, the inertial velocities kept.
prompt() {
  sed -e '/^inertia/d' -e '/^torque/d' -e 's/^profile.*/profile = "ramp"\nfinal = 2.4\nduration = 1e-6/' "$study" > "$scratch/prompt.toml"
  "$program" basin "$scratch/prompt.toml" --json --quiet --starts "$starts" --set "release.$1" |
    jq -r "def shares: $shares; [shares] | add | .[:3] | join(\",\")"
}
echo "release,balanced,low,high" > docs/figures/paper-rotor-brought-at-once.csv
echo "free,$(prompt time=0)" >> docs/figures/paper-rotor-brought-at-once.csv
echo "held,$(prompt speed=1.5)" >> docs/figures/paper-rotor-brought-at-once.csv
