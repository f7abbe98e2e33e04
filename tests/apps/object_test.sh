#!/usr/bin/env bash
# object_test.sh FORCESHADE: renderers that are shared objects: right ones, wrong ones, and such that do anything else.
. "$(dirname "$0")/expect.sh"
renderers=$examples/renderers include=$examples/../include
conform() { "$forceshade" conform --law wall --points 3000 --answer-timeout 5 "$@"; }

# The example, built as its page says, gives what the example in Python gives through another door.
compile=$(grep -o '^cc .*wall\.so.*' "$renderers/README.md") || { echo "FAILED: the README builds no wall.so"; exit 1; }
(cd "$renderers/../.." && sh -c "${compile/-o wall.so/-o $scratch/wall.so} -Wall -Wextra -Wpedantic -Werror") || exit 1
expect 0 "a wall in C 1 renders wall: correctly rounded 3000 of 3000 (100 %)" -- conform --object wall.so
same "$(conform --command "$renderers/wall.py" | tail -n +2)" "$(conform --object wall.so | tail -n +2)"
expect 1 "not applicable: a wall in C 1 does not render bump-2p: it renders the law wall alone" -- \
  "$forceshade" conform --law bump-2p --object wall.so
mkdir "it's a folder"; cp wall.so "it's a folder/wall of mine.so"
expect 0 "a wall in C" -- conform --object "it's a folder/wall of mine.so"

# The example's wall, in which macros put something else. object OPTIONS: compiles it.
sed -e 's/^  \*hello = .*/&\n  OPEN;/' -e 's/^  (void)is_reset.*/&\n  ANSWER;/' -e 's/^  return &kTable;/  ENTRY;\n&/' \
  -e 's/kTable = {sizeof kTable, wall_open, wall_answer, free};/kTable = TABLE;/' -e 's/^static const char kHello\[\] =$/& HELLO/' \
  -e 's/^FORCESHADE_API.*/static void wall_close(void* state) { CLOSE; free(state); }\n&/' "$renderers/wall.c" > template.c
object() {
  local defaults=() name table='-DTABLE={sizeof kTable, wall_open, wall_answer, wall_close}'
  for name in HELLO OPEN ANSWER CLOSE ENTRY; do case "$*" in *"-D$name="*) ;; *) defaults+=("-D$name=") ;; esac; done
  case "$*" in *-DTABLE=*) ;; *) defaults+=("$table") ;; esac
  cc -D_GNU_SOURCE -std=c11 -ffp-contract=off -w -shared -fPIC -I"$include" -include stdio.h -include signal.h \
    -include unistd.h "${defaults[@]}" "$@" -o tried.so template.c || { echo "FAILED: cannot compile $*"; exit 1; }
}
wrong() { local words=$1; shift; object "$@"; expect 1 "$words" -- conform --object tried.so; }
right() { object "$@"; expect 0 "held: 3000 of 3000" -- conform --object tried.so; }

# No object, or not the one that is expected.
expect 2 "missing.so" -- conform --object missing.so
expect 2 "--command, --object, --simulator or --recording" -- conform
expect 2 "--command" -- conform --object wall.so --command true
cannot_load() { expect 1 "the renderer failed: \"it cannot be loaded: " -- conform --object "$1"; }
: > empty.so; cannot_load empty.so
yes "no object" | head -n 1000 > text.so; cannot_load text.so
head -c 3000 wall.so > half.so; expect 1 "the renderer was killed by signal 7" -- conform --object half.so  # dlopen maps what is not there
wrong "cannot be loaded" -DOPEN='extern void no_such_function(void); no_such_function()'
wrong "it exports no function forceshade_renderer_entry" -Dforceshade_renderer_entry=another_entry
wrong "forceshade_renderer_entry() returned no table" -DENTRY='return NULL'
wrong "its table says that it has 8 bytes; expected 32 or more" -DTABLE='{8, wall_open, wall_answer, wall_close}'
wrong "its table says that it has 0 bytes" -DTABLE='{0}'
wrong "its table has no function open" -DTABLE='{sizeof kTable, NULL, wall_answer, wall_close}'
wrong "its table has no function answer" -DTABLE='{sizeof kTable, wall_open, NULL, wall_close}'
wrong "its table has no function close" -DTABLE='{sizeof kTable, wall_open, wall_answer, NULL}'
right -DTABLE='{1000, wall_open, wall_answer, wall_close}'  # of a later header

# What it says.
wrong 'its open() returned 4: no licence found' -DOPEN='*hello = "no licence found"; return 4'
wrong 'its open() returned -1"' -DOPEN='*hello = NULL; return -1'
wrong "its open() returned 0 and no hello" -DOPEN='*hello = NULL'
wrong "expected a JSON object in one line" -DHELLO='"I render walls"; static const char kOther[] ='
wrong 'speaks "conform 9"; expected "conform 1"' -DHELLO='"{\"forceshade\":\"conform 9\"}"; static const char kOther[] ='
wrong 'has no key "kind"' -DHELLO='"{\"forceshade\":\"conform 1\"}"; static const char kOther[] ='
wrong "its answer() returned 3" -DANSWER='return 3'
wrong "nan" -DANSWER='return 0'
wrong "FAILED: " -DANSWER='if (count > 7) { count = 7; }'
wrong "FAILED: any position gets a finite force" -DANSWER='if (positions[0] != positions[0]) { answers[0] = positions[0]; return 0; }'
wrong "FAILED: the same path twice" -DANSWER='*(float*)state *= 1.001f'

# What it does. Its standard streams are not those of the protocol.
right -DENTRY='puts("loaded"); fflush(stdout)' -DOPEN='dprintf(1, "{\"answers\":[]}\n")' -DANSWER='printf("%zu\n", count); getchar()' -DCLOSE='puts("bye")'
right -DOPEN='close(0); close(1); close(2)'
killed="was killed by signal 11"
wrong "$killed" -DENTRY='raise(SIGSEGV)'
wrong "$killed" -DOPEN='*(volatile int*)8 = 1'
wrong "$killed" -DANSWER='if (is_reset == 0) *(volatile int*)8 = 1'
wrong "$killed" -DCLOSE='raise(SIGSEGV)'
wrong "$killed" -DTABLE='{sizeof kTable, wall_open, (void*)16, wall_close}'
wrong "was killed by signal 6" -DOPEN='abort()'
wrong 'it wrote last on standard error: "out of luck"' -DANSWER='fputs("out of luck\n", stderr); _exit(9)'
wrong "ended with exit code 7 without an answer" -DANSWER='exit(7)'
wrong "ended without an answer" -DOPEN='exit(0)'
wrong "ended with exit code 5" -DCLOSE='exit(5)'
wrong "ended without an answer" -DANSWER='for (int i = 0; i < 100; ++i) close(i)'
wrong "$killed" -DANSWER='for (;;) memset(malloc((size_t)1 << 30), 1, 1)'  # up to the limit, where malloc gives NULL
for where in ENTRY OPEN ANSWER CLOSE; do
  object -D$where='for (;;) pause()'
  expect 1 "did not answer within 0.3 s" -- "$forceshade" conform --law wall --object tried.so --answer-timeout 0.3
done
object -DANSWER='raise(SIGSTOP)'
expect 1 "did not answer within 0.3 s" -- "$forceshade" conform --law wall --object tried.so --answer-timeout 0.3
mark=forceshade_left_by_object_$$
wrong "ended with exit code 1" -DANSWER="for (int i = 0; i < 3; ++i) if (fork() == 0) { setsid(); execlp(\"bash\", \"bash\", \"-c\", \"exec -a $mark sleep 1000\", (char*)0); } usleep(100000); _exit(1)"
same "" "$(pgrep -f $mark || true)"
# What it allocates in an answer, however, is counted with its time, and nothing else; in C++ too.
allocates() {  # PER ANSWER, OBJECT
  expect 0 "allocations in an answer, on average: $1 times, " -- conform --object "$2" --timing --json timed.json --overwrite
  fits "$examples/../docs/conformance-schema.json" timed.json
  same "$1" "$(python3 -c 'import json; print("%g" % json.load(open("timed.json"))["timing"]["allocations_per_answer"])')"
}
allocates 0 wall.so
object -DOPEN='free(malloc(5))' -DANSWER='void* volatile a = malloc(40); void* volatile b = calloc(3, 8); free(a); free(b)'
allocates 2 tried.so
expect 0 "on average: 2 times, 64 bytes" -- conform --object tried.so --timing
object -DANSWER='void* a = realloc(NULL, 1); a = realloc(a, 2); free(a); posix_memalign(&a, 64, 64); free(a); free(aligned_alloc(64, 64)); free(strdup("x"))'
allocates 5 tried.so
cat > throws.cpp << 'END'
#include <stdexcept>
#include "forceshade.h"
extern "C" FORCESHADE_API const forceshade_renderer* forceshade_renderer_entry() { throw std::runtime_error("no table today"); }
END
c++ -shared -fPIC -I"$include" -o throws.so throws.cpp
expect 1 "it threw an exception: no table today" -- conform --object throws.so
echo "$checks checks passed"
