# SPDX-License-Identifier: BSD-3-Clause
"""drive_test.py FORCESHADE: a certified run over the example of docs/command-device.md, whose recording is verified; `device list`, `check`
and the words of a program that fails; and that the page's lines and the example's fit the schema."""

import json
import os
import re
import subprocess
import sys
import tempfile

forceshade = os.path.abspath(sys.argv[1])
sources = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
# Where the system permits it, a busy machine does not make the program late.
FIRST = "chrt --fifo 50 " if subprocess.run("chrt --fifo 50 true", shell=True, capture_output=True).returncode == 0 else ""
EXAMPLE = f"command:exec {FIRST}python3 {sources}/examples/devices/stroking_hand.py"
# What it says on a machine that is too busy for a run, after which a run is tried again.
BUSY = ("update rate        wrong", "too irregular", "did not answer within 0.01 s", "no frame of the device came in time", "stopped the run: watchdog")
wrong = 0


def expect(holds, words):
    global wrong
    if not holds:
        wrong += 1
        print("WRONG:", words, flush=True)


def ran(*words, folder, code=0):
    for _ in range(20):
        run = subprocess.run([forceshade, *words], cwd=folder, text=True, capture_output=True, timeout=250)
        if not any(busy in run.stdout + run.stderr for busy in BUSY):
            break
    expect(run.returncode == code, f"{words}: exit code {run.returncode}, expected {code}: {run.stdout}{run.stderr}")
    return run.stdout + run.stderr


def fits_schema():
    try:
        import jsonschema
    except ImportError:
        print("the schema was not checked: the Python package jsonschema is not there")
        return
    with open(sources + "/docs/command-device-schema.json") as file:
        schema = json.load(file)
    jsonschema.Draft7Validator.check_schema(schema)
    with open(sources + "/docs/command-device.md") as file:
        lines = [json.loads(line) for block in re.findall(r"```json\n(.*?)```", file.read(), re.S) for line in block.splitlines()]
    expect(len(lines) >= 5, f"the page has {len(lines)} lines of the protocol")
    example = subprocess.run([sys.executable, EXAMPLE.split()[-1]], input='{"force_N":[0,0,0.1]}\n{"end":true}\n', text=True,
                             capture_output=True, check=True).stdout
    for line in lines + [json.loads(line) for line in example.splitlines()]:
        try:
            jsonschema.validate(line, schema)
        except jsonschema.ValidationError as error:
            expect(False, f"{line}: {error.message}")
    for bad in ({"forceshade-device": 2}, {**lines[0], "peek": 1}, {"time_s": 1, "position_mm": [0, 0]}, {"force_N": [0, 0, None]}):
        expect(not jsonschema.Draft7Validator(schema).is_valid(bad), f"the schema allows {bad}")


def main():
    fits_schema()
    with tempfile.TemporaryDirectory() as folder:
        listed = ran("device", "list", folder=folder)
        expect("command:PROGRAM" in listed, listed)
        checked = ran("device", "check", EXAMPLE, "--seconds", "1", folder=folder)
        expect("simulated hand" in checked, checked)
        ran("certify", "--law", "wall", "--stiffness", "0.5", "--out", "certificate", folder=folder)
        drive = ["drive", "--law", "wall", "--stiffness", "0.5", "--watchdog-timeout", "1", "--device"]
        certified = ["--certificate", "certificate/certificate.json", "--seconds", "4", "--record", "run.fsr", "--json", "summary",
                     "--overwrite"]
        said = ran(*drive, EXAMPLE, *certified, folder=folder)
        expect("the program answered" in said, said)
        with open(folder + "/summary") as file:
            summary = json.load(file)
        expect(summary["device"]["model"] == "simulated hand" and summary["paced_by"] == "device", f"summary: {summary}")
        expect(summary["peak_force_N"] > 0.1, f"no contact: {summary}")
        print(ran("recording", "verify", "run.fsr", folder=folder), end="")
        said = ran(*drive, "command:echo no arm is connected >&2; exit 1", "--uncertified", folder=folder, code=3)
        expect("the program ended with exit code 1" in said and "no arm is connected" in said, said)
        said = ran(*drive, "command:no-such-program", "--uncertified", folder=folder, code=3)
        expect("the shell knows no such command" in said, said)
        said = ran(*drive, "command", "--uncertified", folder=folder, code=2)
        expect("command:PROGRAM" in said, said)
    return 1 if wrong else 0


sys.exit(main())
