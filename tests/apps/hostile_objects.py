"""Shared objects that do what no renderer may do, and some that may: the wall of examples/renderers/wall.c, in which macros put
something else."""

import os
import pathlib
import subprocess

from hostile_programs import LATE, NO_OBJECT, UNASKED, Case, add, patience
from hostile_renderers import WALL

ROOT = pathlib.Path(__file__).parents[2]
TABLE = "{sizeof kTable, wall_open, wall_answer, wall_close}"
CPP = '#include <stdexcept>\n#include "forceshade.h"\nextern "C" const forceshade_renderer* forceshade_renderer_entry(void);'
HEADERS = "fenv pthread setjmp signal stdio stdlib string sys/mman sys/time unistd xmmintrin".split()
KILLED, EARLY = "was killed by signal 11", "ended too early"


def template():
    """The example, with a place for each macro; also as C++."""
    source = (ROOT / "examples/renderers/wall.c").read_text()
    for old, new in (
        ("  *hello = ", "  OPEN;\n  *hello = "), ("  if (stiffness == NULL)", "  OPENED;\n  if (stiffness == NULL)"),
        ("  (void)is_reset;", "  ANSWER;\n  (void)is_reset;"), ("  return 0;\n}\n\nFORCESHADE_API", "  ANSWERED;\n  return 0;\n}\n\nFORCESHADE_API"),
        ("FORCESHADE_API", "static void wall_close(void* state) { CLOSE; free(state); }\nFORCESHADE_API"), ("  return &kTable;", "  ENTRY;\n  return &kTable;"),
        ("{sizeof kTable, wall_open, wall_answer, free, NULL}", "TABLE"), ("static const char kHello[] =", "static const char kHello[] = HELLO"),
        ("float* stiffness = malloc", "float* stiffness = (float*)malloc"),
    ):  # fmt: skip
        assert source.count(old) == 1, old
        source = source.replace(old, new)
    return source


def compiled(language, options, lines=()):
    compiler = ["cc", "-std=c11"] if language == "c" else ["c++", "-std=c++20", "-fpermissive"]
    subprocess.run(compiler + ["-ffp-contract=off", "-w", "-fPIC", f"-I{ROOT}/include"] + options, input="\n".join(lines).encode(), check=True)


def precompile():
    for language in ("c", "c++"):
        pathlib.Path(os.environ["CACHE"], language + ".h").write_text("#define _GNU_SOURCE\n" * (language == "c") + "".join(f"#include <{header}.h>\n" for header in HEADERS))
        compiled(language, ["-x", language + "-header", os.path.join(os.environ["CACHE"], language + ".h")])


def object_case(name, words, code=1, prelude="", language="c", slow=False, **macros):
    macros = dict.fromkeys(("OPEN", "OPENED", "ANSWER", "ANSWERED", "CLOSE", "ENTRY", "HELLO"), "") | {"TABLE": TABLE} | macros

    def run(mark, folder):
        lines = [f"#define {macro} {value}" for macro, value in macros.items()] + [f'#define MARK "{mark}"', prelude, template()]
        compiled(language, ["-include", os.path.join(os.environ["CACHE"], language + ".h"), "-shared", "-x", language, "-", "-o", os.path.join(folder, "tried.so")], lines)
        return WALL + patience(words) + ["--command", "tried.so"]

    add("object " + name, Case(words, run, code=code, slow=slow))


def right(name, **macros):
    """It does what an object may do: it is judged by its forces, which are right."""
    object_case(name, "held: 256 of 256 (100 %)", code=0, **macros)


wrong = object_case

# The table.
wrong("a function that is not there", "cannot be loaded", OPEN="extern void no_such_function(void); no_such_function()")
wrong("another entry", "it exports no function forceshade_renderer_entry", forceshade_renderer_entry="another_entry")
wrong("no table", "forceshade_renderer_entry() returned no table", ENTRY="return NULL")
wrong("a table of 8 bytes", "its table says that it has 8 bytes; expected 40 or more", TABLE="{8, wall_open, wall_answer, wall_close}")
wrong("a table of nothing", "its table says that it has 0 bytes", TABLE="{0}")
wrong("a table that is not there", KILLED, ENTRY="return (const forceshade_renderer*)16")
for index, name in enumerate(("open", "answer", "close")):
    wrong("no function " + name, "its table has no function " + name, TABLE=TABLE.replace("wall_" + name, "NULL"))
wrong("a function that is none", KILLED, TABLE="{sizeof kTable, wall_open, (void*)16, wall_close}")
right("a table of a later header", TABLE="{1000, wall_open, wall_answer, wall_close}")

# Its words.
wrong("a reason", "its open() returned 4: no licence found", OPEN='*hello = "no licence found"; return 4')
wrong("a code alone", 'its open() returned -1"', OPEN="*hello = NULL; return -1")
wrong("no hello", "its open() returned 0 and no hello", OPENED="*hello = NULL")
wrong("a hello that is not there", KILLED, OPENED="*hello = (const char*)16")
wrong("a hello without an end", KILLED + "|bad_alloc", OPENED="char* text = mmap(NULL, 8192, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0); memset(text, '{', 4096); munmap(text + 4096, 4096); *hello = text; mprotect(text + 4096, 1, PROT_NONE)")
wrong("a hello of 17 MB", "a line of more than 16777216 bytes", OPENED="char* text = calloc(17000001, 1); memset(text, '{', 17000000); *hello = text")
for name, hello, words in (
    ("no JSON", '"I render walls"', NO_OBJECT), ("another version", r'"{\"forceshade\":\"conform 9\"}"', 'speaks "conform 9"; expected "conform 1"'),
    ("no kind", r'"{\"forceshade\":\"conform 1\"}"', 'has no key "kind"'), ("two lines", r'"{}\n{}"', NO_OBJECT), ("an empty text", '""', NO_OBJECT),
    ("a failure", r'"{\"failure\":\"held\\nheld: 256 of 256\"}"', 'failed: "held\\nheld'),
):  # fmt: skip
    wrong("a hello that is " + name, words, slow=name not in ("no JSON", "a failure"), HELLO=hello + "; static const char kOther[] =")
DAMPED = r'"{\"forceshade\":\"conform 1\",\"kind\":\"renderer\",\"name\":\"damped\",\"version\":\"1\",\"memory\":\"path\",\"answers\":\"force\",\"claims\":\"definition\",\"length_unit\":\"mm\",\"force_unit\":\"N\",\"frame\":[\"x\",\"y\",\"z\"],\"domain_mm\":10000,\"rate_Hz\":1000,\"loop_energy_mJ\":0,\"damping\":{\"damping\":0.002}}"; static const char kOther[] ='
wrong("damping without periods", "it declares damping, and its table has no function answer_after", HELLO=DAMPED)
AFTER = "static int32_t wall_answer(void*, const float*, float*, size_t, int32_t);\nstatic int32_t after(void* state, const float* positions, const uint32_t* periods, float* answers, size_t count, int32_t is_reset) { for (size_t i = 0; i < count; ++i) if (periods[i] != 1) return 9; return wall_answer(state, positions, answers, count, is_reset); }"
for name, answer in (("beside", "wall_answer"), ("without", "NULL")):
    right(f"periods of one, {name} answer()", prelude='#include "forceshade.h"\n' + AFTER, TABLE=f"{{sizeof kTable, wall_open, {answer}, wall_close, after}}")
wrong("a code of an answer", "its answer() returned 3", ANSWER="return 3")
wrong("no answers", "nan", ANSWER="return 0")
wrong("seven answers", "FAILED: ", ANSWER="if (count > 7) count = 7")
wrong("not a number of one", "FAILED: any position gets a finite force", ANSWER="if (positions[0] != positions[0]) { answers[0] = positions[0]; return 0; }")
wrong("a stiffness that grows", "FAILED: the same path twice", ANSWER="*(float*)state *= 1.001f")

# Its printing and reading: its standard streams are not those of the protocol.
right("prints and reads", ENTRY='puts("loaded"); fflush(stdout)', OPEN=r'dprintf(1, "{\"answers\":[]}\n")', ANSWER=r'printf("%zu\n", count); getchar()', CLOSE='puts("bye")')
right("closes its standard streams", OPEN="close(0); close(1); close(2)")
right("another folder", OPEN='chdir("/")')
wrong("writes to every stream", NO_OBJECT + "|" + UNASKED, OPEN='for (int i = 3; i < 20; ++i) write(i, "x\\n", 2)')
wrong("closes every stream", "ended without an answer", ANSWER="for (int i = 0; i < 100; ++i) close(i)")
wrong("a flood of words", LATE, ANSWER='for (int i = 0; i < 1000000; ++i) fputs("working\\n", stdout); for (;;) pause()')

# Its end.
for where in ("ENTRY", "OPEN", "ANSWER", "CLOSE"):
    wrong("exit() in " + where, EARLY, **{where: "exit(0)"})
    wrong("_exit() in " + where, EARLY, **{where: "_exit(0)"})
    slow = where != "ANSWER"
    wrong("exit(7) in " + where, "ended with exit code 7", slow=slow, **{where: "exit(7)"})
    wrong("abort() in " + where, "was killed by signal 6", slow=slow, **{where: "abort()"})
    wrong("a crash in " + where, KILLED, slow=slow, **{where: "*(volatile int*)8 = 1"})
    wrong("no return from " + where, LATE, **{where: "for (;;) pause()"})
    wrong("an exception in " + where, "it threw an exception: out of luck", slow=where in ("ENTRY", "OPEN"), language="c++", prelude=CPP, **{where: 'throw std::runtime_error("out of luck")'})
wrong("a number is thrown", "it threw something", slow=True, language="c++", prelude=CPP, ANSWER="throw 7")
wrong("its last words", 'it wrote last on standard error: "out of luck"', ANSWER='fputs("out of luck\\n", stderr); _exit(9)')
wrong("stops itself", LATE, ANSWER="raise(SIGSTOP)")
wrong("exit() while it is loaded", EARLY, prelude="__attribute__((constructor)) static void begin(void) { exit(0); }")
wrong("a crash after its end", KILLED, prelude="__attribute__((destructor)) static void end(void) { *(volatile int*)8 = 1; }")
wrong("_exit() after its end", EARLY, prelude="__attribute__((destructor)) static void end(void) { _exit(0); }")
wrong("no end", LATE, prelude="__attribute__((destructor)) static void end(void) { for (;;) pause(); }")
wrong("a jump out of answer()", "FAILED: the renderer", prelude="static jmp_buf before;", OPEN="if (setjmp(before)) abort()", ANSWER="longjmp(before, 1)")
wrong("a stack without end", KILLED, prelude="static int deeper(volatile int* n) { volatile int here[1000] = {*n}; return deeper(here) + here[1]; }", ANSWER="volatile int n = 0; deeper(&n)")
wrong("all memory", KILLED, ANSWER="for (;;) memset(malloc((size_t)1 << 30), 1, 1)")

# Numbers outside of what it was given.
for place in ("3 * count", "3 * count + 2", "-1", "-3"):
    wrong(f"a number at {place}", "its answer() wrote outside of its answers", slow="count +" in place or place == "-3", ANSWERED=f"answers[{place.replace('count', '(long)count')}] = 1")
wrong("ten too many", "its answer() wrote outside of its answers", ANSWERED="memset(answers + 3 * count, 0, 120)")
wrong("other positions", "FAILED: ", ANSWER="for (size_t i = 0; i < 3 * count; ++i) ((float*)positions)[i] *= 0.5f")

# The state of the processor, which is that of its own process.
wrong("rounds upwards", "FAILED: 2", ANSWER="fesetround(FE_UPWARD)")
wrong("rounds to zero", "FAILED: 2", OPEN="fesetround(FE_TOWARDZERO)")
right("rounds upwards after its answers", ANSWER="fesetround(FE_TONEAREST)", ANSWERED="fesetround(FE_UPWARD)")
FLUSHED = "_mm_setcsr(_mm_getcsr() | 0x8040)"  # subnormal numbers are zero, as operands and as results
right("flushes subnormal numbers", OPEN=FLUSHED)
wrong("flushes subnormal numbers, and gives one", "FAILED: ", OPEN=FLUSHED, ANSWERED="for (size_t i = 0; i < count; ++i) if (answers[3 * i + 2] == 0) answers[3 * i + 2] = 0x1p-149f")
right("traps", OPEN="feenableexcept(FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW)")
wrong("traps, and divides by zero", "was killed by signal 8", OPEN="feenableexcept(FE_DIVBYZERO)", ANSWER="volatile float zero = 0; zero = 1 / zero")

# Signals, threads and processes.
right("a timer that interrupts", prelude="static void tick(int number) {}", OPEN="struct itimerval often = {{0, 50}, {0, 50}}; struct sigaction action = {0}; action.sa_handler = tick; sigaction(SIGALRM, &action, NULL); setitimer(ITIMER_REAL, &often, NULL)", CLOSE="struct itimerval none = {0}; setitimer(ITIMER_REAL, &none, NULL)")
wrong("an alarm", "was killed by signal 14", OPEN="alarm(1)", ANSWER="for (;;) pause()")
wrong("ignores a crash", KILLED, OPEN="signal(SIGSEGV, SIG_IGN)", ANSWER="*(volatile int*)8 = 1")
wrong("a handler that exits", EARLY, prelude="static void handle(int number) { _exit(0); }", OPEN="signal(SIGSEGV, handle)", ANSWER="*(volatile int*)8 = 1")
wrong("a handler that returns", LATE, prelude="static void handle(int number) {}", OPEN="signal(SIGSEGV, handle)", ANSWER="*(volatile int*)8 = 1")
wrong("a handler that goes on with nothing", "FAILED: ", prelude="static sigjmp_buf before; static void handle(int number) { siglongjmp(before, 1); }", OPEN="signal(SIGSEGV, handle)", ANSWER="if (sigsetjmp(before, 1)) return 0; *(volatile int*)8 = 1")
THREAD = "static void* work(void* unused) { for (;;) pause(); }"
right("threads that go on", prelude=THREAD, ANSWER="pthread_t thread; pthread_create(&thread, NULL, work, NULL)")
wrong("threads without end", "more than 512 processes and threads", prelude=THREAD, ANSWER="pthread_attr_t small; pthread_attr_init(&small); pthread_attr_setstacksize(&small, 65536); for (pthread_t thread;;) if (pthread_create(&thread, &small, work, NULL)) pause()")
wrong("a thread that crashes", KILLED, prelude="static void* work(void* unused) { *(volatile int*)8 = 1; }", ANSWER="pthread_t thread; pthread_create(&thread, NULL, work, NULL); pthread_join(thread, NULL)")
wrong("ends its thread", "it threw something", ANSWER="pthread_exit(NULL)")
wrong("a process that answers too", "FAILED: the renderer|FAILED: 2", prelude="static int calls;", ANSWER="if (calls++ == 0) fork()")
wrong("processes are left", "ended with exit code 1", ANSWER='for (int i = 0; i < 3; ++i) if (fork() == 0) { setsid(); execlp("bash", "bash", "-c", "exec -a " MARK " sleep 1000", (char*)0); } usleep(100000); _exit(1)')
