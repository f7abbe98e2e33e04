"""Renderers that do what no renderer may do."""

import json
import math
import os
import signal
import struct
import time

from hostile_programs import CASES, ENDED, LATE, NO_END, NO_LIST, NO_OBJECT, UNASKED, Door, add_lines, answering, text, write
from hostile_processes import BARE, add_processes, detached, endless

HELLO = {
    "forceshade": "conform 1", "kind": "renderer", "name": "n", "version": "1", "memory": "none", "answers": "force",
    "claims": "definition", "length_unit": "mm", "force_unit": "N", "frame": ["x", "y", "z"], "domain_mm": 10000,
    "rate_Hz": None, "loop_energy_mJ": 0,
}  # fmt: skip
DIGITS = "24 hexadecimal digits"
WALL = ["conform", "--law", "wall", "--stiffness", "1.5", "--points", "256"]
DOOR = Door("renderer", __name__, HELLO, WALL, "--command")
greets, changed, raw = DOOR.greets, DOOR.changed, DOOR.raw


def force(at):
    x, y, z = struct.unpack(">3f", bytes.fromhex(at))
    inside = all(abs(one) <= 10_000 for one in (x, y, z))
    return [0, 0, 1.5 * -z if inside and z <= -(2.0**-30) else 0]


def digits(numbers):
    return struct.pack(">3f", *numbers).hex()


def right(asked):
    return {"answers": [digits(force(at)) for at in asked["positions"]]}


def serve(answer=right, hello=HELLO, at_goodbye=lambda: None):
    """A right one, but for what is given."""
    answering(hello, answer, at_goodbye)


# The hello.
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
greets("a name of 10 MB", "n" * 10, lambda: text(HELLO | {"name": "n" * 10_000_000, "answers": "work"}))
for name, value in (("1e999", b"1e999"), ("NaN", b"NaN"), ("-Infinity", b"-Infinity"), ("0x10", b"0x10"), ("a number of 400 digits", b"9" * 400), ("01", b"01"), ("+1", b"+1")):
    greets(f"domain_mm {name}", "expected", raw("domain_mm", value))
for key, value in (("memory", b'"none","memory":"path"'), ("domain_mm", b'10000,"domain_mm":1'), ("forceshade", b'"conform 1","forceshade":"conform 1"')):
    greets(f"{key} twice", f'has the key "{key}" twice', raw(key, value))
add_lines(DOOR)
changed("a verdict as its name", "n\\nheld", name="n\nheld: 256 of 256 (100 %)", accepts=False, reason="\nheld")


# Answers.
def answers(name, words, answer):
    DOOR.plays("answer: " + name, words, lambda: serve(answer))


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
answers("a right line, a zero byte and more", NO_OBJECT, lambda asked: text(right(asked))[:-1] + b"\0more\n")
answers("accepts false, later", NO_LIST, lambda asked: HELLO | {"accepts": False, "reason": "no"})
answers("twice", UNASKED, lambda asked: text(right(asked)) * 2)
answers("and an empty line", UNASKED, lambda asked: text(right(asked)) + b"\n")
answers("and a byte", UNASKED, lambda asked: text(right(asked)) + b"x")
answers("too late", LATE, lambda asked: time.sleep(100))
DOOR.plays("answer: too late, without a timeout given", LATE + " 10 s", lambda: serve(lambda asked: time.sleep(100)), slow=True)
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


DOOR.plays("answer: one before the positions", UNASKED, lambda: serve(hello=text(HELLO) + text({"answers": ["0" * 24] * 256})))


add_processes(DOOR, slow=False)
DOOR.plays("process: leaves children, and then is wrong", "FAILED", lambda: (detached(env=BARE), serve(lambda asked: {"answers": ["0" * 24] * len(asked["positions"])})))


def at_goodbye(name, words, play):
    DOOR.plays("goodbye: " + name, words, lambda: serve(at_goodbye=play))


at_goodbye("a line", "wrote after goodbye", lambda: write(b"bye\n"))
at_goodbye("answers", "wrote after goodbye", lambda: write(text({"answers": []})))
at_goodbye("exit code 5", "ended with exit code 5", lambda: os._exit(5))
at_goodbye("exit code 255", "ended with exit code 255", lambda: os._exit(255))
at_goodbye("a crash", "was killed by signal 11", lambda: os.kill(os.getpid(), signal.SIGSEGV))
at_goodbye("no end", LATE, lambda: time.sleep(100))
at_goodbye("no end of its process", NO_END, lambda: (os.close(1), time.sleep(100)))
at_goodbye("an endless line", "wrote after goodbye", lambda: endless(1))


# Forces.
def gives(name, answer, hello=HELLO):
    DOOR.plays("forces: " + name, "FAILED", lambda: serve(lambda asked: {"answers": [digits(one) for one in answer(asked)]}, hello),
               slow=True)


def each(change):
    return lambda asked: [change(*force(at), at) for at in asked["positions"]]


for name, value in {"NaN": math.nan, "infinite": math.inf, "minus infinite": -math.inf, "huge": 3e38, "subnormal": 1e-45, "one newton": 1}.items():
    gives(name, each(lambda x, y, z, at, value=value: [x, y, value]))
    gives(name + " along x in contact", each(lambda x, y, z, at, value=value: [value if z else 0, y, z]))
gives("nothing", each(lambda x, y, z, at: [0, 0, 0]))
gives("backwards", each(lambda x, y, z, at: [x, y, -z]))
gives("one number off", each(lambda x, y, z, at: [x, y, z * 1.0000001]))
gives("random", each(lambda x, y, z, at: [x, y, time.perf_counter() % 1]))
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
