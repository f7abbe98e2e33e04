#!/usr/bin/env bash
# object_test.sh FORCESHADE: renderers that are shared objects: the example, and files that are none. hostile_objects.py has the others.
. "$(dirname "$0")/expect.sh"
renderers=$examples/renderers include=$examples/../include
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

# Its allocations in an answer are counted with its time, and nothing else.
allocates() {  # PER ANSWER, OBJECT
  expect 0 "allocations in an answer, on average: $1 times, " -- conform --command "$2" --timing --json timed.json --overwrite
  fits "$examples/../docs/conformance-schema.json" timed.json
  same "$1" "$(python3 -c 'import json; print("%g" % json.load(open("timed.json"))["timing"]["allocations_per_answer"])')"
}
made() {  # TEXT IN OPEN, TEXT IN ANSWER: makes tried.so of the example
  sed -e "s/^  \*hello = .*/&\n  $1;/" -e "s/^  (void)is_reset.*/&\n  $2;/" "$renderers/wall.c" > tried.c
  cc -D_GNU_SOURCE -std=c11 -ffp-contract=off -w -shared -fPIC -I"$include" -o tried.so tried.c ||
    { echo "FAILED: cannot compile $*"; exit 1; }
}
allocates 0 wall.so
made 'free(malloc(5))' 'void* volatile a = malloc(40); void* volatile b = calloc(3, 8); free(a); free(b)'
allocates 2 tried.so
expect 0 "on average: 2 times, 64 bytes" -- conform --command tried.so --timing
made '' 'void* a = realloc(NULL, 1); a = realloc(a, 2); free(a); posix_memalign(\&a, 64, 64); free(a); free(aligned_alloc(64, 64)); free(strdup("x"))'
allocates 5 tried.so
echo "$checks checks passed"
