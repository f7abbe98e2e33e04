#!/usr/bin/env python3
"""Renderers that do what no renderer may do. `hostile_renderers.py NAME` is one of them; CASES has the words of its verdict."""

import ctypes
import json
import math
import os
import random
import resource
import signal
import struct
import subprocess
import sys
import time

HELLO = {
    "forceshade": "conform 1", "kind": "renderer", "name": "n", "version": "1", "memory": "none", "answers": "force",
    "claims": "definition", "length_unit": "mm", "force_unit": "N", "frame": ["x", "y", "z"], "domain_mm": 10000,
    "rate_Hz": None, "loop_energy_mJ": 0,
}  # fmt: skip
CASES = {}  # name: (words of the verdict, what it does)
NO_OBJECT, LATE, ENDED = "expected a JSON object in one line", "did not answer within", "ended without an answer"
UNASKED, DIGITS, NO_LIST = "wrote without having been asked", "24 hexadecimal digits", 'without a list "answers"'


def case(name, words, play):
    assert name not in CASES, name
    CASES[name] = (words, play)


def write(data):
    while data:
        data = data[os.write(1, data) :]


def text(value):
    return json.dumps(value).encode() + b"\n"


def lines():
    """What conform writes, without a buffer of its own."""
    return map(json.loads, os.fdopen(0, "rb", buffering=0, closefd=False))


def force(at):
    x, y, z = struct.unpack(">3f", bytes.fromhex(at))
    inside = all(abs(one) <= 10_000 for one in (x, y, z))
    return [0, 0, 1.5 * -z if inside and z <= -(2.0**-30) else 0]


def digits(numbers):
    return struct.pack(">3f", *numbers).hex()


def right(asked):
    return {"answers": [digits(force(at)) for at in asked["positions"]]}


def serve(answer=right, hello=HELLO, at_goodbye=lambda: None):
    """A right one, but for what is given: answer(asked) returns JSON, or writes and returns None."""
    for asked in lines():
        if "goodbye" in asked:
            return at_goodbye()
        said = hello if "scene" in asked else answer(asked)
        if said is not None:
            write(said if isinstance(said, bytes) else text(said))


# The hello.
def greets(name, words, said):
    case("hello: " + name, words, lambda: serve(hello=said if isinstance(said, bytes) else text(said)))


def changed(what, words, **changes):
    greets(what, words, HELLO | changes)


def raw(key, value):
    """The hello with the text of a value that Python does not write."""
    return text(HELLO | {key: "@"}).replace(b'"@"', value)


for key in HELLO:
    greets(f"no {key}", f'has no key "{key}"', {one: HELLO[one] for one in HELLO if one != key})
    for value in ([], True):
        changed(f"{key} is {value}", f"has {key} {json.dumps(value)}; expected", **{key: value})
for value in (0, -1, 0.5, 10001, 1e308, "10000", 2**70):
    changed(f"domain_mm {value}", "expected a number from 1 to 10000", domain_mm=value)
for value in (0, -1, 1e7, "1000"):
    changed(f"rate_Hz {value}", "expected a number from 1 to 1e6, or null", rate_Hz=value)
for value in (-1, 1e10, "0"):
    changed(f"loop_energy_mJ {value}", "the most energy that a closed path gives the hand", loop_energy_mJ=value)
for value in (["x", "y"], ["x", "y", "z", "x"], ["x", "x", "y"], ["--x", "y", "z"], ["X", "Y", "Z"], ["", "y", "z"], [0, 1, 2], "xyz", [["x"], "y", "z"]):
    changed(f"frame {value}", "expected a list like", frame=value)
for value in ("conform 10", "conform 1 ", "CONFORM 1", "", "conform 1\0"):
    changed(f"speaks {value!r}", 'expected "conform 1"', forceshade=value)
for key, value in (("memory", "None"), ("answers", "forces"), ("claims", ""), ("length_unit", "mm "), ("force_unit", "n"), ("kind", "simulator")):
    changed(f"{key} {value!r}", f"has {key} {json.dumps(value)}; expected", **{key: value})
changed("an impulse without a rate", "expected a number where it answers with an impulse", answers="impulse")
changed("accepts false without a reason", 'has no key "reason"', accepts=False)
changed("accepts false, reason 7", "has reason 7; expected a text", accepts=False, reason=7)
for value in ("false", 0, None):
    changed(f"accepts {value!r}", "expected true or false", accepts=value)
changed("a name of 10 MB", "n" * 10, name="n" * 10_000_000, answers="work")
for name, value in (("1e999", b"1e999"), ("NaN", b"NaN"), ("-Infinity", b"-Infinity"), ("0x10", b"0x10"), ("a number of 400 digits", b"9" * 400), ("01", b"01"), ("+1", b"+1")):
    greets(f"domain_mm {name}", "expected", raw("domain_mm", value))
for key, value in (("memory", b'"none","memory":"path"'), ("domain_mm", b'10000,"domain_mm":1'), ("forceshade", b'"conform 1","forceshade":"conform 1"')):
    greets(f"{key} twice", f'has the key "{key}" twice', raw(key, value))
right_hello = text(HELLO)
for name, said in {
    "empty line": b"\n", "spaces": b"   \n", "a NUL": b"\0\n", "a BOM before": None, "UTF-16": right_hello.decode().encode("utf-16"),
    "UTF-32": right_hello.decode().encode("utf-32"), "not UTF-8": raw("name", b'"\xff\xfe"'), "half a surrogate": raw("name", b'"\\ud800"'),
    "a NUL within": raw("name", b'"a\0b"'), "a tab in a text": raw("name", b'"a\tb"'), "a comment": b"// hello\n", "a comment at the end": right_hello[:-1] + b" // x\n",
    "garbage at the end": right_hello[:-1] + b"x\n", "two objects": right_hello[:-1] * 2 + b"\n", "an array": b"[" + right_hello[:-1] + b"]\n",
    "null": b"null\n", "a number": b"1\n", "a text": b'"conform 1"\n', "single quotes": right_hello.replace(b'"', b"'"), "a comma too many": right_hello[:-2] + b",}\n",
    "no end": right_hello[:-2] + b"\n", "half of it": right_hello[:60] + b"\n", "a million brackets": b"[" * 1_000_000 + b"\n", "a million objects": b'{"a":' * 1_000_000 + b"\n",
    "YAML": b"forceshade: conform 1\n", "HTML": b"<html>\n", "random bytes": random.Random(1).randbytes(5000).replace(b"\n", b"") + b"\n",
    "a carriage return alone": right_hello[:-1].replace(b", ", b",\r", 1)[:40] + b"\n", "over several lines": json.dumps(HELLO, indent=1).encode() + b"\n",
}.items():  # fmt: skip
    greets(name, NO_OBJECT, said)
greets("twice", UNASKED, right_hello * 2)
greets("an empty object", 'has no key "forceshade"', {})
greets("an answer", 'has no key "forceshade"', {"answers": []})
greets("what it got", "expected", b'{"forceshade":"conform 1","scene":{}}\n')
greets("16 million brackets", NO_OBJECT, b"[" * 16_000_000 + b"\n")
greets("16 million objects", NO_OBJECT, b'{"":' * 4_000_000 + b"\n")
greets("8 million numbers", NO_OBJECT, raw("forceshade", b"[" + b"1," * 8_000_000 + b"1]"))
changed("a verdict as its name", "n\\nheld", name="n\nheld: 256 of 256 (100 %)", accepts=False, reason="\nheld")


# Answers.
def answers(name, words, answer):
    case("answer: " + name, words, lambda: serve(answer))


def among(name, words, value):
    """One of the answers is something else."""
    answers(name, words, lambda asked: {"answers": right(asked)["answers"][:-1] + [value]})


for name, value in {
    "23 digits": "0" * 23, "25 digits": "0" * 25, "no digits": "", "letters": "g" * 24, "signs": "-0000000" * 3, "spaces": " " * 24, "a prefix": "0x" + "0" * 22,
    "48 digits": "0" * 48, "a number": 1, "null": None, "true": True, "a list": [0, 0, 0], "an object": {"force": "0" * 24}, "digits that are not ASCII": "\u0660" * 24,
    "a NUL": "\0" * 24, "a megabyte": "0" * 1_000_000,
}.items():  # fmt: skip
    among("one is " + name, DIGITS, value)
for name, value in {"none": [], "one": ["0" * 24], "1023 more": ["0" * 24] * 2047, "one nested": [["0" * 24]]}.items():
    answers(name, "positions with", lambda asked, value=value: {"answers": value})
answers("one too few", "positions with", lambda asked: {"answers": right(asked)["answers"][:-1]})
answers("one too many", "positions with", lambda asked: {"answers": right(asked)["answers"] + ["0" * 24]})
for name, value in {"a text": "0" * 24, "null": None, "an object": {}, "a number": 0}.items():
    answers(f"{name} instead of a list", NO_LIST, lambda asked, value=value: {"answers": value})
answers("another key", NO_LIST, lambda asked: {"forces": right(asked)["answers"]})
answers("what it was asked", NO_LIST, lambda asked: asked)
answers("the hello again", NO_LIST, lambda asked: HELLO)
answers("key twice", 'the key "answers" twice', lambda asked: b'{"answers":[],' + text(right(asked))[1:])
for name, said in {"an empty line": b"\n", "a word": b"ok\n", "a list": b"[]\n", "not UTF-8": b'{"answers":["\xff"]}\n', "a million brackets": b'{"answers":' + b"[" * 1_000_000 + b"\n",
                   "NaN": b'{"answers":[NaN]}\n'}.items():  # fmt: skip
    answers("a line that is " + name, NO_OBJECT, lambda asked, said=said: said)
answers("accepts false, later", NO_LIST, lambda asked: HELLO | {"accepts": False, "reason": "no"})
answers("twice", UNASKED, lambda asked: text(right(asked)) * 2)
answers("and an empty line", UNASKED, lambda asked: text(right(asked)) + b"\n")
answers("and a byte", UNASKED, lambda asked: text(right(asked)) + b"x")
answers("too late", LATE, lambda asked: time.sleep(100))
answers("half a line, then silence", LATE, lambda asked: write(text(right(asked))[:50]) or time.sleep(100))
answers("half a line, then death", ENDED, lambda asked: write(text(right(asked))[:50]) or os._exit(0))
answers("a line without its end", ENDED, lambda asked: write(text(right(asked))[:-1]) or os._exit(0))
answers("a line, then death", "ended", lambda asked: write(text(right(asked))) or os._exit(0))
answers("exit code 3", "ended with exit code 3", lambda asked: os._exit(3))


def drip(asked):
    for one in text(right(asked)):
        write(bytes([one]))
        time.sleep(0.02)


answers("a byte at a time", LATE, drip)


case("answer: one before the positions", UNASKED, lambda: serve(hello=right_hello + text({"answers": ["0" * 24] * 256})))


def at_goodbye(name, words, play):
    case("goodbye: " + name, words, lambda: serve(at_goodbye=play))


at_goodbye("a line", "wrote after goodbye", lambda: write(b"bye\n"))
at_goodbye("answers", "wrote after goodbye", lambda: write(text({"answers": []})))
at_goodbye("exit code 5", "ended with exit code 5", lambda: os._exit(5))
at_goodbye("exit code 255", "ended with exit code 255", lambda: os._exit(255))
at_goodbye("a crash", "was killed by signal 11", lambda: os.kill(os.getpid(), signal.SIGSEGV))
at_goodbye("no end", LATE, lambda: time.sleep(100))
at_goodbye("no end of its process", "did not end", lambda: (os.close(1), time.sleep(100)))
at_goodbye("an endless line", "wrote after goodbye", lambda: endless(1))


# Processes.
def endless(stream, block=b"x" * 65536):
    while True:
        try:
            os.write(stream, block)
        except OSError:
            os._exit(0)


def process(name, words, play):
    case("process: " + name, words, play)


def once_greeted(play):
    return lambda: serve(lambda asked: play())


for number in (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 24, 25, 26, 27, 29, 30, 31, 64):
    process(f"signal {number}", f"was killed by signal {number} (", lambda number=number: (signal.signal(number, signal.SIG_DFL) if number != 9 else 0, os.kill(os.getpid(), number)))
for code in (0, 1, 2, 77, 126, 128, 255):
    process(f"exit code {code}", f"ended with exit code {code} without" if code else ENDED, lambda code=code: os._exit(code))
process("a program that is not there", "exit code", lambda: os.execv("/no/such/program", ["x"]))
process("a folder as a program", "exit code", lambda: os.execv("/", ["x"]))
process("another program", NO_OBJECT, lambda: os.execvp("cat", ["cat", "/proc/self/status"]))
process("an exception", "RuntimeError: no licence", lambda: exec("raise RuntimeError('no licence')"))
process("an exception later", "ended with exit code 1 without an answer", once_greeted(lambda: exec("raise ValueError")))
process("a null pointer", "was killed by signal 11", once_greeted(lambda: ctypes.string_at(0)))
process("an abort", "was killed by signal 6", once_greeted(os.abort))
process("a stack without end", "was killed by signal 11", lambda: (resource.setrlimit(resource.RLIMIT_STACK, (65536, 65536)), ctypes.CDLL(None).qsort, ctypes.memset(ctypes.addressof(ctypes.c_char()) - 2**40, 0, 1)))
process("never an answer", LATE, lambda: time.sleep(100))
process("reads nothing, writes nothing", LATE, lambda: (os.close(0), time.sleep(100)))
process("spins", LATE, lambda: [None for _ in iter(int, 1) if False])
process("ignores every signal", LATE, lambda: ([signal.signal(one, signal.SIG_IGN) for one in (1, 2, 3, 10, 12, 13, 15)], time.sleep(100)))
process("stops itself", LATE, lambda: os.kill(os.getpid(), signal.SIGSTOP))
process("stops itself later", LATE, once_greeted(lambda: os.kill(os.getpid(), signal.SIGSTOP)))
process("closes its output", "closed its output, and did not end", lambda: (os.close(1), time.sleep(100)))
process("closes its output later", "closed its output, and did not end", once_greeted(lambda: (os.close(1), time.sleep(100))))
process("closes everything", "closed its output, and did not end", lambda: (os.closerange(0, 1000), time.sleep(100)))
process("floods its output", "a line of more than 16777216 bytes", lambda: endless(1))
process("floods its output later", "a line of more than 16777216 bytes", once_greeted(lambda: endless(1)))
process("floods with lines", NO_LIST + "|" + UNASKED, lambda: endless(1, right_hello))
process("floods with empty lines", NO_OBJECT, lambda: endless(1, b"\n" * 65536))
process("floods with NULs", "a line of more than 16777216 bytes", lambda: endless(1, bytes(65536)))
process("floods standard error", LATE, lambda: endless(2))
process("floods standard error later", LATE, once_greeted(lambda: endless(2, b"error\n")))
process("escapes on standard error", "\\x1b", lambda: (os.write(2, b"\x1b[2J\x1b]0;held\x07"), os._exit(1)))
process("a verdict on standard error", "ended with exit code 1", lambda: (os.write(2, b"held: 256 of 256 (100 %)\n\n\n"), os._exit(1)))
process("takes all memory", "MemoryError", lambda: bytearray(10**11))
process("takes memory bit by bit", "MemoryError", lambda: [bytearray(2**27) for _ in range(1000)])
process("writes a file without end", "exit code", lambda: exec("f = open('large', 'wb')\nwhile True: f.write(bytes(2**20))"))
process("opens files without end", "exit code", lambda: exec("a = []\nwhile True: a.append(open('/dev/null'))"))


def leaves(name, words, play):
    """Starts what shall not outlive the run: the mark is in the arguments of what it starts."""
    process("leaves " + name, words, play)


def sleeper(**options):
    mark = os.environ["MARK"]
    options.setdefault("stdout", subprocess.DEVNULL)
    return subprocess.Popen(["bash", "-c", f"exec -a {mark} sleep 300"], stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options)


def detached(**options):
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            sleeper(**options)
        os._exit(0)
    time.sleep(0.2)


leaves("a child", ENDED, lambda: sleeper())
leaves("a child with its output", LATE, lambda: sleeper(stdout=None))
leaves("ten children", ENDED, lambda: [sleeper() for _ in range(10)])
leaves("a session", ENDED, lambda: sleeper(start_new_session=True))
leaves("a daemon", ENDED, lambda: detached())
leaves("a session without environment", ENDED, lambda: sleeper(start_new_session=True, env={"PATH": os.environ["PATH"]}))
leaves("a daemon without environment", ENDED, lambda: detached(env={"PATH": os.environ["PATH"]}))
leaves("a daemon without environment, and is killed", "was killed by signal 9", lambda: (detached(env={"PATH": os.environ["PATH"]}), os.kill(os.getpid(), 9)))
leaves("a daemon without environment, and sleeps", LATE, lambda: (detached(env={"PATH": os.environ["PATH"]}), time.sleep(100)))
leaves("a child that is stopped", ENDED, lambda: os.kill(sleeper().pid, signal.SIGSTOP))
leaves("children, and then is wrong", "FAILED", lambda: (detached(env={"PATH": os.environ["PATH"]}), serve(lambda asked: {"answers": ["0" * 24] * len(asked["positions"])})))
process("kills its group", "was killed by signal 15", lambda: os.kill(0, signal.SIGTERM))
process("kills what started it", "ended the process that watches it", lambda: (os.kill(os.getppid(), signal.SIGKILL), time.sleep(100)))


def forks(most=3000):
    """A bomb with an end, since a test must not take a machine along."""
    for _ in range(most):
        if os.fork() == 0:
            time.sleep(20)
            os._exit(0)
    time.sleep(100)


def doubles(generations=11):
    for _ in range(generations):
        os.fork()
    time.sleep(20)


process("forks", "more than 512 processes and threads", forks)
process("forks as a doubling tree", "more than 512 processes and threads", doubles)
process("forks in sessions of their own", "more than 512 processes and threads", lambda: [os.setsid() or time.sleep(20) or os._exit(0) for _ in range(2000) if os.fork() == 0] or time.sleep(100))


# Forces.
def gives(name, answer, hello=HELLO):
    case("forces: " + name, "FAILED", lambda: serve(lambda asked: {"answers": [digits(one) for one in answer(asked)]}, hello))


def each(change):
    return lambda asked: [change(*force(at), at) for at in asked["positions"]]


for name, value in {"NaN": math.nan, "infinite": math.inf, "minus infinite": -math.inf, "huge": 3e38, "subnormal": 1e-45, "one newton": 1}.items():
    gives(name, each(lambda x, y, z, at, value=value: [x, y, value]))
    gives(name + " along x in contact", each(lambda x, y, z, at, value=value: [value if z else 0, y, z]))
gives("nothing", each(lambda x, y, z, at: [0, 0, 0]))
gives("backwards", each(lambda x, y, z, at: [x, y, -z]))
gives("one number off", each(lambda x, y, z, at: [x, y, z * 1.0000001]))
gives("random", each(lambda x, y, z, at: [x, y, random.random()]))
gives("in mN", each(lambda x, y, z, at: [x, y, 1000 * z]))
gives("of the wrong axis", each(lambda x, y, z, at: [z, x, y]))
gives("in the opposite byte order", lambda asked: [struct.unpack("<3f", bytes.fromhex(digits(force(at)))) for at in asked["positions"]])
gives("its position", each(lambda x, y, z, at: struct.unpack(">3f", bytes.fromhex(at))))
gives("in the opposite order", lambda asked: [force(at) for at in asked["positions"]][::-1])
gives("shifted by one", lambda asked: [[0, 0, 0]] + [force(at) for at in asked["positions"]][:-1])
kept = []


def previous(asked):
    before = kept[-1:]
    kept.append([force(at) for at in asked["positions"]])
    return (before[0] + [[0, 0, 0]] * 1024)[: len(kept[-1])] if before else kept[-1]


gives("of the request before", previous)
gives("NaN where the position is none", each(lambda x, y, z, at: [x, y, z if all(math.isfinite(one) for one in struct.unpack(">3f", bytes.fromhex(at))) else math.nan]))


def tired(asked):
    kept.append(0)
    return [[x, y, z * (1 if len(kept) < 4 else 1.5)] for x, y, z in map(force, asked["positions"])]


gives("that grow from request to request", tired)
gives("that grow, of one that claims invariants alone", tired, HELLO | {"claims": "invariants"})
gives("NaN, of one that claims invariants alone", each(lambda x, y, z, at: [x, y, math.nan]), HELLO | {"claims": "invariants"})
gives("nothing, of one that claims invariants alone", each(lambda x, y, z, at: [0, 0, 0]), HELLO | {"claims": "invariants"})

if __name__ == "__main__":
    CASES[sys.argv[1]][1]()
