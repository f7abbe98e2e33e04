#!/usr/bin/env bash
# readme_test.sh FORCESHADE SOURCE: a reader can type the commands of the README, of the samples (whose recorded forces are computed
# again), and the first of docs/using.md, twice, as they are printed. So that this takes seconds, the nine laws become one where a
# certificate is made, and the height map a plane; properties have fewer cases, and loops do not wait for the clock. The second time,
# certificates have less evidence, and are made after the runs that need them.
set -u
. "$(dirname "$0")/page.sh"
forceshade=$(realpath "$1") source=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
mkdir -p build/release/apps
ln -s "$forceshade" build/release/apps/forceshade
for folder in examples recordings; do ln -s "$source/$folder" $folder; done
printf 'render = "height-map"\n[[part]]\nshape = "plane"\nslope_x = 0.25\n' > ramp.toml

# The blocks of shell commands, without those of the scripts, which build and test everything.
{ cat "$source/README.md" "$source/examples/samples/README.md"; cd "$source/docs" && sed -n '/^## First commands/,/^## Options/p' using.md; } | page_blocks sh |
  grep -v '^scripts/\|^export ' |
  sed -e '/ certify --law /s/ --law all / --law bump-1p-shaded /' -e '/ drive /s/$/ --pace none/' \
    -e '/ certify \| drive /s/examples\/leather\.toml/ramp.toml/' -e 's/ --cases 10000 / --cases 100 /' \
    -e '/ conform /s/$/ --points 256/' > commands
setting=$(grep '^export PATH=' "$source/README.md") && eval "$setting" || { echo "FAILED: the README sets no PATH"; exit 1; }
count=$(grep -c '\(^\|| \)forceshade ' commands)
[ "$count" -ge 14 ] || { echo "FAILED: found only $count commands in the pages"; exit 1; }

for time in first second; do
  if [ $time = second ]; then
    { grep -v ' certify ' commands; sed -n 's/ --points [0-9]*//; s/ certify .*/& --points 1000 --cases 20/p' commands; } > again
    mv again commands
  fi
  number=0
  while IFS= read -r command; do
    number=$((number + 1))
    bash -c "$command" > output 2>&1 < /dev/null || { echo "FAILED the $time time: $command"; cat output; exit 1; }
  done < commands
  find build -type f | LC_ALL=C sort > files.$time
done
[ "$(wc -l < files.first)" -ge 20 ] || { echo "FAILED: the commands wrote only: $(cat files.first)"; exit 1; }
diff files.first files.second || { echo "FAILED: other files were written the second time"; exit 1; }
echo "$number commands ran twice"
