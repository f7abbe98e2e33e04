"""Simulators that do what no simulator may do."""

import json
import os
import time

from hostile_processes import add_processes, detached
from hostile_programs import CASES, ENDED, LATE, NO_END, NO_LIST, NO_OBJECT, SEEN, Case, Door, add, add_lines, answering, patience, text, write

HELLO = {
    "forceshade": "conform 1", "kind": "simulator", "name": "n", "version": "1", "reports": "force", "constraint": "hard", "binary": 64,
    "sides": "two", "smallest_radius_m": 0, "speed_cap_m_per_s": None, "settings": "none",
}  # fmt: skip
DOOR = Door("simulator", __name__, HELLO, ["conform", "simulator"], "--command")
STEP = {"position": [0, 0, 1], "velocity": [0, 0, 0], "contacts": []}
greets, changed, raw = DOOR.greets, DOOR.changed, DOOR.raw

# The hello.
for key in HELLO:
    greets(f"no {key}", f'has no key "{key}"', {one: HELLO[one] for one in HELLO if one != key})
    for value in ([], True):
        changed(f"{key} is {value}", f"has {key} {json.dumps(value)}; expected", **{key: value})
for key, values in {
    "kind": ("renderer", "Simulator", ""), "reports": ("forces", ""), "constraint": ("firm", "HARD"), "binary": (16, 80, "64", 64.5, None, [64]),
    "sides": ("three", 2), "smallest_radius_m": (-1, "0", None), "speed_cap_m_per_s": (-1, "fast"), "forceshade": ("conform 10", "conform 1 ", "conform 1\0"),
}.items():  # fmt: skip
    for value in values:
        changed(f"{key} {value!r}", "; expected", **{key: value})
for key in ("smallest_radius_m", "speed_cap_m_per_s"):
    for value in (b"1e999", b"NaN", b"-Infinity", b"9" * 400, b"01", b"+1"):
        greets(f"{key} {value[:20].decode()}", "expected", raw(key, value))
greets("binary twice", 'has the key "binary" twice', raw("binary", b'64,"binary":32'))
changed("accepts false without a reason", 'has no key "reason"', accepts=False)
changed("accepts 0", "expected true or false", accepts=0)
changed("accepts false in every scene", "not applicable", accepts=False, reason="no\nheld: all", slow=True)
greets("a name of 10 MB", "n" * 10, lambda: text(HELLO | {"name": "n" * 10_000_000, "constraint": "none"}))
add_lines(DOOR, slow=True)
for name, its in CASES.items():
    if name.startswith("simulator hello: ") and not name.startswith("simulator hello: no "):
        its.slow = True  # they are read as a renderer's
        SEEN.discard(("simulator", its.words))


# The motion.
def moves(name, words, answer, **options):
    DOOR.plays("motion: " + name, words, lambda: answering(HELLO, answer), **options)


def still(asked):
    return [STEP] * len(asked["applied"])


def among(name, words, slow=False, **changes):
    """One of the steps is something else."""
    moves(name, words, lambda asked: {"motion": still(asked)[1:] + [STEP | changes]}, slow=slow)


for key, size in (("position", 3), ("velocity", 3)):
    for value in (None, 0, "0", {}, True, [], [0] * (size - 1), [0] * (size + 1), [[0] * size], ["0"] * size, [0, 0, True], [0, 0, {}]):
        among(f"{key} {value!r}", f"{key} of step 239 is {json.dumps(value, separators=(',', ':'))}; expected a list of three", slow=key == "velocity", **{key: value})
for value in (None, 0, "none", {"force": 1}):
    among(f"contacts {value!r}", "expected a list of contacts", contacts=value)
for value in (None, 1, [], [0, 0, 1], [0, 0, 1, 1, 1], {"force": 1}, ["0", 0, 1, 1], [[0, 0, 1], 1]):
    among(f"a contact {value!r}", "expected a list of four numbers", contacts=[[0, 0, 1, 1], value])
for name, value in {"none": [], "one": [STEP], "1 fewer": [STEP] * 239, "1 more": [STEP] * 241, "nested": [[STEP] * 240]}.items():
    moves(f"{name} of 240 steps", 'entries of "motion"', lambda asked, value=value: {"motion": value})
for value in (None, 0, "still", {}, True):
    moves(f"{value!r} instead of a list", NO_LIST, lambda asked, value=value: {"motion": value})
moves("steps that are numbers", "position of step 0 is null", lambda asked: {"motion": [0] * 240})
moves("another key", NO_LIST, lambda asked: {"answers": still(asked)})
moves("what it was asked", NO_LIST, lambda asked: asked)
moves("the hello again", NO_LIST, lambda asked: HELLO)
moves("NaN as Python writes it", NO_OBJECT, lambda asked: {"motion": [STEP | {"position": [float("nan"), 0, 0]}] * 240})
moves("1e999", NO_OBJECT, lambda asked: text({"motion": still(asked)}).replace(b"[0, 0, 1]", b"[0, 0, 1e999]"))
moves("a key twice", 'the key "velocity" twice', lambda asked: text({"motion": still(asked)}).replace(b'"velocity"', b'"velocity": [0, 0, 0], "velocity"'))
moves("a million brackets", NO_OBJECT, lambda asked: b'{"motion":' + b"[" * 1_000_000 + b"\n")
moves("two million contacts", NO_OBJECT, lambda asked: text({"motion": still(asked)}).replace(b"[]", b"[" + b"0," * 2_000_000 + b"0]", 1))
moves("a line that is cut", NO_OBJECT, lambda asked: text({"motion": still(asked)})[:4096] + b"\n")
moves("a refusal without a reason", 'has no key "reason"', lambda asked: {"accepts": False})
moves("twice", "wrote after goodbye", lambda asked: text({"motion": still(asked)}) * 2)
moves("late", LATE, lambda asked: time.sleep(100))
moves("never whole", LATE, lambda asked: write(text({"motion": still(asked)})[:5000]) or time.sleep(100))
moves("half a line, then death", ENDED, lambda asked: write(text({"motion": still(asked)})[:5000]) or os._exit(0))
moves("a crash in the middle", "was killed by signal 6", lambda asked: write(text({"motion": still(asked)})[:5000]) or os.abort())
moves("children are left", 'entries of "motion"', lambda asked: detached(env={"PATH": os.environ["PATH"]}) or {"motion": []})
DOOR.plays("goodbye: a line", "wrote after goodbye", lambda: answering(HELLO, lambda asked: {"motion": still(asked)}, lambda: write(b"bye\n")))
DOOR.plays("goodbye: no end", LATE, lambda: answering(HELLO, lambda asked: {"motion": still(asked)}, lambda: time.sleep(100)))
DOOR.plays("goodbye: no end of its process", NO_END, lambda: answering(HELLO, lambda asked: {"motion": still(asked)}, lambda: (os.close(1), time.sleep(100))))
DOOR.plays("goodbye: exit code 5", "ended with exit code 5", lambda: answering(HELLO, lambda asked: {"motion": still(asked)}, lambda: os._exit(5)))
add_processes(DOOR, slow=True)


# Motion of the right form, which all scenes are asked for: sed writes it, since it starts fast.
def wrong(name, words, step, slow=True):
    said = json.dumps(step).replace("&", "\\&")
    script = f's/.*"scene".*/{json.dumps(HELLO)}/; /goodbye/d; s/"applied"/"motion"/; s/\\[[^][]+\\]/{said}/g'

    def run(mark, folder):
        with open(os.path.join(folder, "script"), "w") as file:
            file.write(script)
        return DOOR.arguments + patience(words) + [DOOR.option, "exec sed -u -E -f script"]

    add("simulator motion: " + name, Case(words, run, slow=slow))


wrong("no numbers", "FAILED: every answer is a finite number", STEP | {"position": [None] * 3, "velocity": [None] * 3, "contacts": [[None] * 4]}, slow=False)
wrong("a velocity that is no number", "FAILED: every answer is a finite number", STEP | {"velocity": [0, None, 0]})
wrong("a contact that is no number", "FAILED: every answer is a finite number", STEP | {"contacts": [[0, 0, 1, None]]})
wrong("still", "FAILED: a flat floor keeps the speed", STEP)
wrong("1e308", "FAILED: a flat floor keeps the speed", STEP | {"position": [1e308, -1e308, -1e308], "velocity": [1e308] * 3, "contacts": [[1e308] * 4]})
wrong("1e-320", "FAILED: a flat floor keeps the speed", STEP | {"position": [1e-320] * 3, "velocity": [1e-320] * 3, "contacts": [[0, 0, 1e-320, 1e-320]]})
wrong("a hundred contacts", "FAILED: what is reported agrees with the motion", STEP | {"contacts": [[0, 0, 1, 9.81]] * 100})
