#!/usr/bin/env bash
# ci_consumer_test.sh BUILD SOURCE: the commands of the workflow and of the GitLab job in examples/ci-consumer/ are run in a clean copy
# of it. What they would fetch has stand-ins: git gives a forceshade/ whose scripts/package makes the packages of this build, and
# apt-get unpacks packages that are files.
set -eu
build=$(realpath "$1") source=$(realpath "$2")
python=/usr/bin/python3
"$python" -c "import yaml" 2> /dev/null || { echo "skipped: python3-yaml is not there"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; cat "$scratch/said"; exit 1; }

mkdir "$scratch/bin" "$scratch/made"
root=$scratch/root
(cd "$build" && cpack -G DEB -B "$scratch/made" > "$scratch/said" 2>&1) || fail "cpack failed"
cat > "$scratch/bin/git" << STAND_IN
#!/bin/sh -e
[ "\$*" = "clone --depth 1 --branch v1 https://example.org/forceshade.git forceshade" ]
[ -x "$source/scripts/package" ]
mkdir -p forceshade/scripts
printf '#!/bin/sh -e\nmkdir -p "\$1"\ncp "$scratch"/made/*.deb "\$1"\n' > forceshade/scripts/package
chmod +x forceshade/scripts/package
STAND_IN
cat > "$scratch/bin/apt-get" << STAND_IN
#!/bin/sh -e
for word; do case \$word in *.deb) dpkg-deb -x "\$word" "$root" ;; esac; done
STAND_IN
chmod +x "$scratch"/bin/*
export PATH="$scratch/bin:$root/usr/bin:$PATH" CMAKE_PREFIX_PATH=$root/usr
export FORCESHADE_REPOSITORY=https://example.org/forceshade.git FORCESHADE_VERSION=v1

for file in .github/workflows/conform.yml .gitlab-ci.yml; do
  rm -rf "$root" "$scratch/project"
  cp -r "$source/examples/ci-consumer" "$scratch/project"
  cd "$scratch/project"
  "$python" "$source/tests/install/ci_commands.py" $file > "$scratch/commands"
  bash -e "$scratch/commands" > "$scratch/said" 2>&1 || fail "the commands of $file"
  grep -q '100% tests passed, 0 tests failed out of 2' "$scratch/said" || fail "$file runs other tests"
  for result in build/bump.xml build/bump.html build/bump_without_its_edge.xml; do
    [ -s $result ] || fail "$file: $result was not written"
  done
  # The kept packages serve a second run, and a renderer that becomes wrong ends it.
  sed -i 's/2 \* fabs(x) <= /2 * fabs(x) < /' bump.c
  rm -rf build forceshade
  ! bash -e "$scratch/commands" > "$scratch/said" 2>&1 || fail "$file lets a wrong renderer pass"
  grep -q '50% tests passed, 1 tests failed out of 2' "$scratch/said" || fail "$file fails for another reason"
  grep -q '<failure' build/bump.xml || fail "$file: build/bump.xml names no failure"
  [ ! -e forceshade ] || fail "$file builds packages that are there"
  echo "$file: its $(wc -l < "$scratch/commands") lines were run twice"
done
