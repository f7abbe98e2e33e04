# SPDX-License-Identifier: BSD-3-Clause
"""stand_in_test.py STAND-IN LIBRARY faults|assumptions|readings: every fault of a client is recorded under its name, a client
without one is not blamed, every assumption can be seen in both of its ways, and what public clients read has answers."""

import ctypes
import os
import subprocess
import sys
import textwrap

from stand_in import PYTHON, Checks, Run

checks = Checks()
program, library, mode = sys.argv[1:4]
here = os.path.dirname(os.path.abspath(__file__))
# Only the deed that is about lateness is judged for it.
PATIENT = ["--assume", "longest-gap=3600000"]
WORDS = {"after-cut": ["--event", "force-button@2"], "after-unplug": ["--event", "unplug@2", "--assume", "unplugged=stale"], "gap": []}
# The deeds that a deed needs before it.
COMES_WITH = {"uncalibrated-force": {"after-cut"}}


def faults():
    sys.path.insert(0, here)
    text = open(os.path.join(here, "client.py")).read()
    names = [line.split('"')[1] for line in text[text.index("DEEDS = {"):].splitlines() if line.startswith('    "')]
    for name in names:
        run = Run(program, library, [*PYTHON, os.path.join(here, "client.py"), name], *WORDS.get(name, PATIENT))
        expected = set() if name == "nothing" else {name}
        checks.expect(set(run.faults) - COMES_WITH.get(name, set()) == expected, f"{name}: {run.faults} {run.err}")
        checks.expect(run.code == (1 if expected else 0), f"{name}: exit code {run.code}")
    help_text = subprocess.run([*PYTHON, program, "dhd", "--library", library, "--help"], capture_output=True, text=True).stdout
    listed = help_text[help_text.index("faults of a client:"):help_text.index("assumptions (")].splitlines()[1:]
    checks.expect({line.split(":")[0].strip() for line in listed} == set(names) - {"nothing"}, f"deeds and faults: {names} {listed}")
    for words, expected in ((["--assume", "x=1"], "is no assumption"), (["--event", "nan@0"], "the number of a reading from 1"),
                            (["--assume", "watchdog=-1"], "expected 0|NUMBER"), (["--library", "/none"], "expected /none")):
        done = subprocess.run([*PYTHON, program, "dhd", "--library", library, *words, "--", "true"], capture_output=True, text=True)
        checks.expect(done.returncode == 2 and expected in done.stderr, f"{words}: {done}")
    idle = Run(program, library, ["true"])
    checks.expect(idle.code == 2 and "the client did not load the library, " + library in idle.err,
                  f"a client that loads nothing: {idle.err}")
    silent = Run(program, library, [*PYTHON, "-c", "import ctypes, os; ctypes.CDLL(os.environ['FORCESHADE_DHD_LIBRARY'])"])
    checks.expect(silent.code == 2 and "the client loaded the library, and called none of its functions" in silent.err,
                  f"a silent client: {silent.err}")
    client = [*PYTHON, os.path.join(here, "client.py"), "nothing"]
    for words, expected in ((["--report", "/none/report"], "/none/report: cannot be written: No such file"),
                            (["--log", "/none/log"], "/none/log: cannot be written: No such file"),
                            (["--judge", "/none/log"], "the client of /none/log did not load the library")):
        done = subprocess.run([*PYTHON, program, "dhd", "--library", library, *PATIENT, *words, "--", *client], capture_output=True,
                              text=True)
        checks.expect(done.returncode == 2 and expected in done.stderr, f"{words}: {done}")


def says(code, *assumptions, events=()):
    """The output of a client."""
    whole = "import sys\nsys.path.insert(0, %r)\nfrom client import *\n" % here + textwrap.dedent(code)
    words = list(PATIENT)
    for one in assumptions:
        words += ["--assume", one]
    for one in events:
        words += ["--event", one]
    run = Run(program, library, [*PYTHON, "-c", whole], *words)
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
    ("serial", BEGIN + "n = ctypes.c_ushort()\ndhd.dhdGetSerialNumber(ctypes.byref(n), ID)\nprint(n.value)" + END,
     {"1234": "1234", "77": "77"}),
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
              "usb": "status()[14] == 5", "deadman": "status()[14] == 6", "saturate": "force(0, 0, 1) == 2",
              "force-error": "force(0, 0, 0) == -1"}
    for name, what in events.items():
        code = BEGIN + "t = time.monotonic()\nresult = read()\nspent = time.monotonic() - t\nprint(%s)  # nan" % what + END
        seen = says(code, events=[name + "@2"])
        checks.expect(seen == "True", f"{name}: {seen}")
    ctypes.CDLL(library)  # it loads into a process that has no such environment


# numbers(): the result, and what a function writes into arrays of these lengths. near(): prints where that is not what is expected.
NUMBERS = """
def numbers(name, *counts, words=(), kind=N):
    places = [(kind * count)(*([kind(-7)] * count)) for count in counts]
    return getattr(dhd, name)(*words, *places, ID), *(list(place) for place in places)
def near(name, expected, *counts, **more):
    result, *all = numbers(name, *counts, **more)
    flat = [value for values in all for value in values]
    if result != 0 or len(flat) != len(expected) or any(abs(a - b) > 1e-9 for a, b in zip(flat, expected)):
        print(name, result, flat, expected)
I, U = ctypes.c_int, ctypes.c_uint
"""
# Readings of public clients, with the values of a device at rest in the joints that it lacks.
READINGS = """
version = [I() for _ in range(4)]
dhd.dhdGetSDKVersion(*(ctypes.byref(part) for part in version))
if [part.value for part in version] < [3, 16, 0, 0]: print("SDK", version)
begin()
force(0, 0, 1.5)
read()
at = [value.value for value in values]
near("dhdGetForce", [0, 0, 1.5], 1, 1, 1)
near("dhdGetForceAndTorque", [0, 0, 1.5, 0, 0, 0], *[1] * 6)
near("dhdGetForceAndTorqueAndGripperForce", [0, 0, 1.5, 0, 0, 0, 0], *[1] * 7)
near("dhdGetVersion", [3.1], 1)
near("dhdGetEffectorMass", [0.1], 1)
dhd.dhdSetEffectorMass(N(0.25), ID)
near("dhdGetEffectorMass", [0.25], 1)
for unit in ("Rad", "Deg"):
    near("dhdGetAngularVelocity" + unit, [0, 0, 0], 1, 1, 1)
    near("dhdGetGripperAngularVelocity" + unit, [0], 1)
    near("dhdGetBaseAngleX" + unit, [0], 1)
near("dhdGetGripperLinearVelocity", [0], 1)
dhd.dhdSetBaseAngleXDeg(N(90), ID)
near("dhdGetBaseAngleXRad", [1.5707963267948966], 1)
near("dhdGetDeviceAngleDeg", [90], 1)
for name, lengths, more in (("dhdGetPositionAndOrientationRad", [1] * 6, [0] * 3), ("dhdGetPositionAndOrientationDeg", [1] * 6, [0] * 3),
                            ("dhdGetPositionAndOrientationFrame", [1, 1, 1, 9], [1, 0, 0, 0, 1, 0, 0, 0, 1])):
    result, *got = numbers(name, *lengths)
    flat = [value for part in got for value in part]
    if result != 0 or flat[3:] != more or max(abs(a - b) for a, b in zip(flat, at)) > 0.02: print(name, result, flat, at)
dhd.dhdGetMaxTorque.restype = dhd.dhdGetMaxGripperForce.restype = N
if (dhd.dhdGetMaxTorque(ID), dhd.dhdSetMaxTorque(N(0.5), ID), dhd.dhdGetMaxTorque(ID), dhd.dhdGetMaxGripperForce(ID)) != (-1, 0, 0.5, -1):
    print("torque")
print(dhd.dhdEmulateButton(1, ID), dhd.dhdErrorGetLast(), numbers("dhdGetGripperThumbPos", 1, 1, 1)[0])
dhd.dhdEnableExpertMode()
joints = numbers("dhdGetJointAngles", 8)
if joints[0] != 0 or joints[1][3:] != [0] * 5 or max(abs(q * 0.1 - x) for q, x in zip(joints[1], at)) > 0.02: print(joints, at)
near("dhdGetJointAngleRange", [-1.5] * 3 + [0] * 5 + [1.5] * 3 + [0] * 5, 8, 8)
near("dhdJointAnglesToInertiaMatrix", [0.09 if i in (0, 7, 14) else 0 for i in range(36)], 36, words=[(N * 8)()])
near("dhdGetDeltaJacobian", [0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1], 9)
near("dhdGetWristJointAngles", [0, 0, 0], 1, 1, 1)
near("dhdGetWristEncoders", [0, 0, 0], 1, 1, 1, kind=I)
near("dhdDeltaPositionToEncoder", [1000, -2000, 0], 1, 1, 1, words=[N(0.01), N(-0.02), N(0)], kind=I)
near("dhdDeltaEncoderToPosition", [0.01, -0.02, 0], 1, 1, 1, words=[I(1000), I(-2000), I(0)])
near("dhdDeltaEncodersToJointAngles", [0.1, -0.2, 0], 1, 1, 1, words=[I(1000), I(-2000), I(0)])
near("dhdGetEncRange", [-15000] * 3 + [0] * 5 + [15000] * 3 + [0] * 5, 8, 8, kind=I)
near("dhdGetVelocityThreshold", [255], 1, kind=U)
dhd.dhdSetVelocityThreshold(U(70), ID)
near("dhdGetVelocityThreshold", [70], 1, kind=U)
dhd.dhdSetWatchdog(33, ID)
near("dhdGetWatchdog", [33], 1, kind=ctypes.c_ubyte)
print(dhd.dhdSetMot((ctypes.c_ushort * 8)(), 0, ID), dhd.dhdErrorGetLast(), dhd.drdOpen(), dhd.dhdErrorGetLast(), dhd.drdIsSupported() & 1)
text = ctypes.create_string_buffer(b"x" * 20)
print(dhd.dhdGetComponentVersionStr(U(0), text, ctypes.c_size_t(4), ID), text.value.decode(), dhd.dhdEmulateButton(1, ID), end=" ")
"""


def readings():
    for model, emulated in (("omega.3", "-1 6 -1\n-1 10 -1 10 0\n0 3.1 -1"), ("omega.7", "0 0 0\n-1 10 -1 10 0\n0 3.1 0")):
        seen = says(NUMBERS + READINGS + END, "model=" + model)
        checks.expect(seen == emulated, f"{model}: {seen}")
    for name, words in (("dhdGetJointAngles", "None"), ("dhdGetEncoder", "0"), ("dhdSetMot", "None, 0")):
        run = Run(program, library, [*PYTHON, "-c", f"import sys\nsys.path.insert(0, {here!r})\nfrom client import *\nbegin()\n"
                                     f"dhd.{name}({words}, ID)\nend()"], *PATIENT)
        checks.expect(set(run.faults) == {"no-expert-mode"}, f"{name}: {run.faults}")
    for name, count in (("dhdGetForce", 3), ("dhdGetPositionAndOrientationRad", 6), ("dhdGetPositionAndOrientationFrame", 4),
                        ("dhdGetEffectorMass", 1)):
        for gap in range(count):
            code = BEGIN + f"places = [(N * 9)() for _ in range({count})]\nplaces[{gap}] = None\nprint(dhd.{name}(*places, ID))" + END
            run = Run(program, library, [*PYTHON, "-c", f"import sys\nsys.path.insert(0, {here!r})\nfrom client import *\n{code}"],
                      *PATIENT)
            checks.expect(set(run.faults) == {"null-argument"} and run.out.strip() == "-1",
                          f"{name} without {gap}: {run.faults} {run.out} {run.err}")
    # A client that looks where FDSDK names the vendor's SDK.
    place = "os.path.join(os.environ['FDSDK'], 'lib', 'release', f'lin-{os.uname().machine}-gcc', 'libdrd.so.3')"
    run = Run(program, library, [*PYTHON, "-c", f"import ctypes, os\nprint(ctypes.CDLL({place}).dhdGetDeviceCount())"])
    checks.expect(run.code == 0 and run.out.strip() == "1", f"FDSDK: {run.out} {run.err}")


if __name__ == "__main__":
    least = {"faults": (faults, 52), "assumptions": (assumptions, 116), "readings": (readings, 20)}
    least[mode][0]()
    sys.exit(checks.exit_code(least[mode][1]))
