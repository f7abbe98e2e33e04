# SPDX-License-Identifier: BSD-3-Clause
"""stand_in_test.py STAND-IN LIBRARY faults|assumptions: every fault of a client is recorded under its name, a client without one is
not blamed, and every assumption can be seen in both of its ways."""

import ctypes
import os
import subprocess
import sys
import textwrap

from stand_in import Checks, Run

checks = Checks()
program, library, mode = sys.argv[1:4]
here = os.path.dirname(os.path.abspath(__file__))
# Only the deed that is about lateness is judged for it.
PATIENT = ["--assume", "longest-gap=3600000"]
WORDS = {"after-cut": ["--event", "force-button@2"], "after-unplug": ["--event", "unplug@2", "--assume", "unplugged=stale"], "gap": []}
# What a deed cannot be done without.
COMES_WITH = {"uncalibrated-force": {"after-cut"}}


def faults():
    sys.path.insert(0, here)
    text = open(os.path.join(here, "client.py")).read()
    names = [line.split('"')[1] for line in text[text.index("DEEDS = {"):].splitlines() if line.startswith('    "')]
    for name in names:
        run = Run(program, library, [sys.executable, os.path.join(here, "client.py"), name], *WORDS.get(name, PATIENT))
        expected = set() if name == "nothing" else {name}
        checks.expect(set(run.faults) - COMES_WITH.get(name, set()) == expected, f"{name}: {run.faults} {run.err}")
        checks.expect(run.code == (1 if expected else 0), f"{name}: exit code {run.code}")
    help_text = subprocess.run([sys.executable, program, "dhd", "--library", library, "--help"], capture_output=True, text=True).stdout
    listed = help_text[help_text.index("faults of a client:"):help_text.index("assumptions (")].splitlines()[1:]
    checks.expect({line.split(":")[0].strip() for line in listed} == set(names) - {"nothing"}, f"deeds and faults: {names} {listed}")
    for words, expected in ((["--assume", "x=1"], "is no assumption"), (["--event", "nan@0"], "the number of a reading from 1"),
                            (["--assume", "watchdog=-1"], "expected 0|NUMBER"), (["--library", "/none"], "expected /none")):
        done = subprocess.run([sys.executable, program, "dhd", "--library", library, *words, "--", "true"], capture_output=True, text=True)
        checks.expect(done.returncode == 2 and expected in done.stderr, f"{words}: {done}")
    idle = Run(program, library, ["true"])
    checks.expect(idle.code == 2 and "loaded the library" in idle.err, f"a client that loads nothing: {idle.err}")


def says(code, *assumptions, events=()):
    """What a client prints."""
    whole = "import sys\nsys.path.insert(0, %r)\nfrom client import *\n" % here + textwrap.dedent(code)
    words = list(PATIENT)
    for one in assumptions:
        words += ["--assume", one]
    for one in events:
        words += ["--event", one]
    run = Run(program, library, [sys.executable, "-c", whole], *words)
    checks.expect(not run.faults or "nan" in code or "xpert" in code, f"{code}: {run.faults} {run.err}")
    return run.out.strip()


BEGIN, END = "begin()\n", "\nend()"
LAST = "dhd.dhdErrorGetLast()"
# The code, the values, and what it prints with each.
ASSUMPTIONS = [
    ("set-force-off", "begin(enabled=False)\nprint(force(0, 0, 0), %s == NOT_ENABLED)" % LAST + END, {"error": "-1 True", "ok": "0 False"}),
    ("not-finite", BEGIN + "print(force(NAN, 0, 0))  # nan" + END, {"refuse": "-1", "accept": "0"}),
    ("watchdog", BEGIN + "force(0, 0, 0)\ntime.sleep(0.06)\nprint(status()[5], status()[14])" + END, {"0": "1 0", "240": "0 3"}),
    ("watchdog-works", BEGIN + "dhd.dhdEnableExpertMode()\nprint(dhd.dhdSetWatchdog(255, ID))" + END, {"yes": "0", "no": "-1"}),
    ("time-guard", BEGIN + "print(read())" + END, {"0": "0", "600000000": "1"}),
    ("last-error", """
begin(enabled=False)
dhd.dhdEnableForce(1, ID)
other = threading.Thread(target=lambda: dhd.dhdOpenType(0))  # expert: a second opening is a fault, and not the point
other.start()
other.join()
print(dhd.dhdErrorGetLast())""" + END, {"thread": "0", "process": "20"}),
    ("error-kept", "assert dhd.dhdOpenSerial(7) == -1\n" + BEGIN + "print(%s)" % LAST + END, {"yes": "5", "no": "0"}),
    ("expert", BEGIN + """
other = threading.Thread(target=dhd.dhdEnableExpertMode)
other.start()
other.join()
print(dhd.dhdSetWatchdog(0, ID))""" + END, {"process": "0", "thread": "-1"}),
    ("status-length", BEGIN + "print(status()[16], status()[17])" + END, {"17": "0 -7", "16": "-7 -7"}),
    ("brakes", "begin(enabled=False)\nprint(status()[6])" + END, {"on": "1", "off": "0"}),
    ("forces", "begin(enabled=False)\nprint(status()[5])" + END, {"off": "0", "on": "1"}),
    ("enable-uncalibrated", "begin(enabled=False)\ndhd.dhdReset(ID)\nprint(dhd.dhdEnableForce(1, ID))" + END, {"error": "-1", "ok": "0"}),
    ("max-force", BEGIN + "dhd.dhdSetMaxForce(N(2), ID)\nprint(force(0, 0, 4))" + END, {"scale": "2", "ignore": "0"}),
    ("call-time", BEGIN + "t = time.monotonic()\nread()\nprint(time.monotonic() - t > 0.05)" + END, {"60000": "True"}),
    ("serial", BEGIN + "n = ctypes.c_ushort()\ndhd.dhdGetSerialNumber(ctypes.byref(n), ID)\nprint(n.value)" + END, {"1234": "1234", "77": "77"}),
    ("calibrated", "begin(enabled=False)\nprint(status()[3])" + END, {"yes": "0", "no": "1"}),
    ("available", "print(dhd.dhdGetAvailableCount(), dhd.dhdOpen())\ndhd.dhdClose(ID) if dhd.dhdGetAvailableCount() else 0",
     {"yes": "1 0", "no": "0 -1"}),
    ("pressed", BEGIN + "print(dhd.dhdGetButtonMask(ID), dhd.dhdGetButton(0, ID))" + END, {"no": "0 0", "yes": "1 1"}),
    ("clock", BEGIN + "y = values[1].value\n[read() for _ in range(200)]\nprint(abs(values[1].value - y) > 0.005)" + END,
     {"1000": "True"}),
]


def assumptions():
    for name, code, values in ASSUMPTIONS:
        for value, expected in values.items():
            seen = says(code, name + "=" + value)
            checks.expect(seen == expected, f"{name}={value}: expected {expected}, got {seen}")
    for name, expected in {"omega.3": "33 0 0 0", "omega.7-left": "37 1 1 1", "sigma.7": "104 0 1 1", "falcon": "60 0 0 0",
                           "lambda.3": "203 0 0 0"}.items():
        code = "print(dhd.dhdGetSystemType(ID), *(f(ID) & 1 for f in (dhd.dhdIsLeftHanded, dhd.dhdHasWrist, dhd.dhdHasGripper)))"
        seen = says(BEGIN + code + END, "model=" + name)
        checks.expect(seen == expected, f"{name}: {seen}")
    code = BEGIN + "print(read(), %s == COM)\ndhd.dhdClose(ID)" % LAST
    unplug = {"error": "-1 True", "stale": "0 False"}
    for value, expected in unplug.items():
        seen = says(code, "unplugged=" + value, events=["unplug@2"])
        checks.expect(seen == expected, f"unplugged={value}: {seen}")
    blocks = BEGIN + """
read()
other = threading.Thread(target=read, daemon=True)
other.start()
other.join(0.3)
print(other.is_alive(), flush=True)
dhd.dhdClose(ID)"""
    seen = says(blocks, "unplugged=block", events=["unplug@2"])
    checks.expect(seen == "True", f"unplugged=block: {seen}")
    events = {"nan": "values[1].value != values[1].value", "garbage": "values[1].value > 1e29", "wrong-unit": "values[2].value > 9",
              "jump": "values[1].value > 0.04", "time-guard": "result == 1", "read-error": "result == -1", "late": "spent > 0.1",
              "uncalibrated": "status()[3] == 1", "press": "dhd.dhdGetButtonMask(ID) == 1", "power-off": "status()[0] == 0",
              "error": "status()[9] == 1", "force-button": "status()[14] == 1", "overspeed": "status()[14] == 2",
              "usb": "status()[14] == 5", "deadman": "status()[14] == 6", "saturate": "force(0, 0, 1) == 2", "force-error": "force(0, 0, 0) == -1"}
    for name, what in events.items():
        code = BEGIN + "t = time.monotonic()\nresult = read()\nspent = time.monotonic() - t\nprint(%s)  # nan" % what + END
        seen = says(code, events=[name + "@2"])
        checks.expect(seen == "True", f"{name}: {seen}")
    ctypes.CDLL(library)  # it loads into a process that has no such environment


if __name__ == "__main__":
    least = {"faults": (faults, 47), "assumptions": (assumptions, 116)}
    least[mode][0]()
    sys.exit(checks.exit_code(least[mode][1]))
