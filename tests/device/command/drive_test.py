# SPDX-License-Identifier: BSD-3-Clause
"""drive_test.py FORCESHADE: a certified run over the example of docs/command-device.md, whose recording is verified; `device list`, `check`
and the words of a program that fails; and that the page's lines and the example's fit the schema."""

import json
import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(1, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import checks as shared  # noqa: E402

checks = shared.Checks()
forceshade = os.path.abspath(sys.argv[1])
sources = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
EXAMPLE = f"command:exec {shared.in_real_time()}python3 {sources}/examples/devices/stroking_hand.py"


def ran(*words, folder, code=0):
    run = subprocess.run([forceshade, *words], cwd=folder, text=True, capture_output=True)
    checks.expect(run.returncode == code, f"{words}: exit code {run.returncode}, expected {code}: {run.stdout}{run.stderr}")
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
    checks.expect(len(lines) >= 5, f"the page has {len(lines)} lines of the protocol")
    example = subprocess.run([sys.executable, EXAMPLE.split()[-1]], input='{"force_N":[0,0,0.1]}\n{"end":true}\n', text=True,
                             capture_output=True, check=True).stdout
    for line in lines + [json.loads(line) for line in example.splitlines()]:
        try:
            jsonschema.validate(line, schema)
        except jsonschema.ValidationError as error:
            checks.expect(False, f"{line}: {error.message}")
    for bad in ({"forceshade-device": 2}, {**lines[0], "peek": 1}, {"time_s": 1, "position_mm": [0, 0]}, {"force_N": [0, 0, None]}):
        checks.expect(not jsonschema.Draft7Validator(schema).is_valid(bad), f"the schema allows {bad}")


def main():
    fits_schema()
    with tempfile.TemporaryDirectory() as folder:
        listed = ran("device", "list", folder=folder)
        checks.expect("command:PROGRAM" in listed, listed)
        checked = ran("device", "check", EXAMPLE, "--seconds", "1", folder=folder)
        checks.expect("simulated hand" in checked, checked)
        drive = ["drive", "--law", "wall", "--stiffness", "0.5", "--watchdog-timeout", "1", "--device"]
        certified = shared.certify_wall(forceshade, folder) + ["--seconds", "4"]
        said = ran(*drive, EXAMPLE, *certified, folder=folder)
        checks.expect("the program answered" in said, said)
        summary = shared.recorded(forceshade, folder, checks)
        checks.expect(summary["device"]["model"] == "simulated hand", f"summary: {summary}")
        checks.expect(summary["peak_force_N"] > 0.1, f"no contact: {summary}")
        said = ran(*drive, "command:echo no arm is connected >&2; exit 1", "--uncertified", folder=folder, code=3)
        checks.expect("the program ended with exit code 1" in said and "no arm is connected" in said, said)
        said = ran(*drive, "command:no-such-program", "--uncertified", folder=folder, code=3)
        checks.expect("the shell knows no such command" in said, said)
        said = ran(*drive, "command", "--uncertified", folder=folder, code=2)
        checks.expect("command:PROGRAM" in said, said)


main()
sys.exit(checks.exit_code(16))
