#!/usr/bin/env bash
# x87_test.sh FORCESHADE LIBRARY: the exact side is exact also where a library that is loaded with it sets the x87 to 53 bits.
. "$(dirname "$0")/expect.sh"
library=$(realpath "$2")
export ASAN_OPTIONS=verify_asan_link_order=0  # of a build with sanitizers
bump=(--law bump-cylinder)
expect 0 "" -- "$forceshade" conform positions "${bump[@]}" --points 20000 --out asked.csv
expect 0 "" -- "$forceshade" force asked.csv "${bump[@]}" --out forces.csv
energy=("$forceshade" energy --height-map "$examples/leather.toml" --depth 0.2 --stiffness 0.5)
same "$("${energy[@]}")" "$(LD_PRELOAD=$library "${energy[@]}")"
for preloaded in "" "$library"; do
  expect 0 "correctly rounded 20000 of 20000" -- env LD_PRELOAD="$preloaded" "$forceshade" conform judge "${bump[@]}" forces.csv
  expect 0 "held" -- env LD_PRELOAD="$preloaded" "$forceshade" certify "${bump[@]}" --points 30000 --out certificate --overwrite
  expect 0 "held" -- env LD_PRELOAD="$preloaded" "$forceshade" properties "${bump[@]}" --cases 500
done
echo "$checks checks"
