#!/usr/bin/env bash
# simulator_test.sh FORCESHADE: simulators through the door of processes: an exact one, and the same one wrong in one thing.
# hostile_simulators.py has such that do not keep to the protocol.
. "$(dirname "$0")/expect.sh"
exact=$(realpath "$(dirname "$0")/exact_simulator.py")
conform() { "$forceshade" conform simulator --answer-timeout 120 "$@"; }

expect 0 "an exact simulator 1, a simulator: it has none" -- \
  conform --command "python3 -S $exact" --json held.json --junit found.xml --out page.html
same "0 true 26" "$(grep -c '"held": false' held.json) $(sed -n 's/^  "held": \(.*\),/\1/p' held.json) $(grep -c '<testcase' found.xml)"
same "1 1 1" "$(grep -c '<svg role="img"' page.html) $(grep -c '>Held</p>' page.html) $(grep -c '</html>' page.html)"

# Wrong in one thing, and what it declares is another thing too. tests/conformance/planted_simulator_defects_test.cpp has the others.
changed "$exact" '"smallest_radius_m": 0' '"smallest_radius_m": 0.05' '"reports": "force"' '"reports": "impulse"'  # and it is a force
expect 1 "not applicable to 11 cases, since its smallest radius is 0.05 m" -- conform --command "python3 -S mutated.py" --json found.json
fits "$examples/../docs/conformance-schema.json" held.json found.json
same "the static force is the same at any rate
what is reported agrees with the motion" "$(jq -r '.invariants[] | select(.held == false) | .name' found.json)"

expect 2 "conform simulator: expected --command, got none" -- conform
expect 2 'unknown option "--law"' -- conform --law wall --command true
