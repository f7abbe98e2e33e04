#!/usr/bin/env bash
# object_test.sh FORCESHADE: renderers that are shared objects: the example, and files that are none. hostile_objects.py has the others.
. "$(dirname "$0")/expect.sh"
renderers=$examples/renderers
conform() { "$forceshade" conform --law wall --points 3000 --answer-timeout 120 "$@"; }

# The example, built as its page says, gives what the example in Python gives through another door.
compile=$(grep -o '^cc .*wall\.so.*' "$renderers/README.md") || { echo "FAILED: the README builds no wall.so"; exit 1; }
(cd "$renderers/../.." && sh -c "${compile/-o wall.so/-o $scratch/wall.so} -Wall -Wextra -Wpedantic -Werror") || exit 1
expect 0 "a wall in C 1 renders wall: correctly rounded 3000 of 3000 (100 %)" -- conform --command wall.so
same "$(conform --command "$renderers/wall.py" | tail -n +2)" "$(conform --command wall.so | tail -n +2)"
expect 1 "not applicable: a wall in C 1 does not render bump-2p: it renders the law wall alone" -- \
  "$forceshade" conform --law bump-2p --command wall.so
mkdir "it's a folder"; cp wall.so "it's a folder/wall of mine.so"
expect 0 "a wall in C" -- conform --command "it's a folder/wall of mine.so"

# No object, or not the one that is expected.
expect 2 "missing.so" -- conform --command missing.so
mkdir bin; cp "$forceshade" bin/alone
expect 2 "libexec/forceshade/forceshade-object, which is not there" -- bin/alone conform --law wall --command wall.so
expect 2 "expected --command, got none" -- conform
expect 2 "--command" -- conform --command wall.so --command true
cannot_load() { expect 1 "the renderer failed: \"it cannot be loaded: " -- conform --command "$1"; }
: > empty.so; cannot_load empty.so
yes "no object" | head -n 1000 > text.so; cannot_load text.so
head -c 3000 wall.so > half.so; expect 1 "the renderer was killed by signal 7" -- conform --command half.so  # dlopen maps what is not there

echo "$checks checks passed"
