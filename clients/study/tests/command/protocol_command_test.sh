#!/usr/bin/env bash
# protocol_command_test.sh FORCESHADE-STUDY: protocols as their users check and prepare them, wrong usage, and the help.
. "$(dirname "$0")/../../../../tests/apps/expect.sh"
study=$forceshade
checked() { "$study" experiment check protocol.toml; }

expect 2 "forceshade-study: expected a command: experiment, analyze" -- "$study"
expect 2 'unknown command "analyse"; expected one of: experiment analyze man completion; the nearest is analyze' -- "$study" analyse
expect 2 "'forceshade-study help experiment check' shows what is expected" -- "$study" experiment check --sekonds 3
expect 2 "--watchdog-timeout: expected without --free-run, got both" -- "$study" experiment run p.toml --participant P --session s \
  --certificates none --device null --free-run --watchdog-timeout 1
expect 2 'and not "overall", which the tables use, got "overall"' -- "$study" experiment run p.toml --participant overall --session s \
  --device mouse --certificates none
expect 2 '--bids: expected another folder than --csv, got "./x"' -- "$study" experiment export s --csv x --bids ./x
expect 2 '--bids: expected another folder than --csv, got "x/"' -- "$study" experiment export s --csv x --bids x/
for command in "" experiment "experiment check" "experiment prepare" "experiment run" "experiment resume" "experiment virtual" \
  "experiment export" "experiment verify" "experiment recompute" analyze man completion; do
  same "" "$("$study" help $command | grep -nE '^.{101,}$')"
  expect 0 ".SH EXAMPLES" -- "$study" man $command
  [ "${command:-experiment}" = experiment ] || expect 0 "  forceshade-study $command" -- "$study" help $command
done
. <("$study" completion bash)
COMP_WORDS=(forceshade-study experiment pre) COMP_CWORD=2
_forceshade-study
same prepare "${COMPREPLY[*]}"

# Keys that are missing, misspelt or unknown, and a line that is no TOML.
cp "$examples/english.toml" .
sed 's/^name/nmae/' "$examples/matching.toml" > protocol.toml
expect 2 'key name is missing' -- checked
sed 's/^resume/resme/' "$examples/matching.toml" > protocol.toml
expect 2 'key resume is missing' -- checked
sed '/^block_order/a block_oder = "random"' "$examples/matching.toml" > protocol.toml
expect 2 'unknown key block_oder; the nearest is block_order' -- checked
sed 's/^name = /name : /' "$examples/matching.toml" > protocol.toml
expect 2 "expected KEY = VALUE on a line (expected '=', got ':')" -- checked
printf '{"law": "wall"}\n' > protocol.toml
expect 2 "protocol.toml: expected a TOML file, got a JSON file" -- checked

# Stimuli that are files: each has the stiffness of its protocol.
protocol() { sed -e '/^stimuli/,/^\]/d' -e "s|^radii_mil.*|stimuli = [ $1 ]|" "$examples/classification.toml" > protocol.toml; }
mkdir inputs
printf 'render = "height-map"\n[[part]]\nshape = "plane"\nslope_x = 0.1\nheight_mm = 0\n' > inputs/ramp.toml
printf 'height-map = "ramp.toml"\nstiffness = 0.5\n' > inputs/soft.toml
printf 'height-map = "ramp.toml"\nstiffness = 0.25\n' > inputs/map.toml
protocol '{ name = "a", subject = "inputs/soft.toml" }, { name = "b", height-map = "inputs/ramp.toml" }'
expect 0 "2 bumps can be rendered" -- checked
"$study" experiment prepare protocol.toml --out certificates > /dev/null || { echo "FAILED: prepare"; exit 1; }
same 1 "$(ls certificates | wc -l)"  # both are the same renderer
protocol '{ name = "a", subject = "inputs/map.toml" }'
expect 2 "inputs/map.toml: stiffness: expected that of the protocol, 0.5 N/mm, got 0.25 N/mm" -- \
  "$study" experiment prepare protocol.toml --out other
protocol '{ name = "a", subject = "absent.toml" }'
expect 2 "expected a file, found none at" -- checked
echo OFF > ball.off
protocol '{ mesh = "ball.off", unit = "ft" }'
expect 2 'unit: expected mm, cm, m or in, got "ft"' -- checked
echo "$checks checks passed"
