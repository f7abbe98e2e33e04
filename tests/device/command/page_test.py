# SPDX-License-Identifier: BSD-3-Clause
"""page_test.py FORCESHADE: the lines of docs/command-device.md and those of its example fit the schema, and the command has words for a
program that fails."""

import json
import os
import re
import subprocess
import sys

sys.path.insert(1, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from checks import Checks  # noqa: E402

checks = Checks()
sources = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))


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
    example = subprocess.run([sys.executable, sources + "/examples/devices/stroking_hand.py"],
                             input='{"force_N":[0,0,0.1]}\n{"end":true}\n',
                             text=True, capture_output=True, check=True).stdout
    for line in lines + [json.loads(line) for line in example.splitlines()]:
        try:
            jsonschema.validate(line, schema)
        except jsonschema.ValidationError as error:
            checks.expect(False, f"{line}: {error.message}")
    for bad in ({"forceshade-device": 2}, {**lines[0], "peek": 1}, {"time_s": 1, "position_mm": [0, 0]}, {"force_N": [0, 0, None]}):
        checks.expect(not jsonschema.Draft7Validator(schema).is_valid(bad), f"the schema allows {bad}")


fits_schema()
for device, code, words in (("command:echo no arm is connected >&2; exit 1", 3,
                             ("the program ended with exit code 1", "no arm is connected")),
                            ("command:no-such-program", 3, ("the shell knows no such command",)), ("command", 2, ("command:PROGRAM",))):
    run = subprocess.run([sys.argv[1], "drive", "--law", "wall", "--certificate", "none", "--device", device],
                         text=True, capture_output=True)
    checks.expect(run.returncode == code and all(word in run.stderr for word in words), f"{device}: {run}")
hand = f"command:{sys.executable} {sources}/examples/devices/stroking_hand.py"
for device, said in ((hand, 1), ("null", 0)):
    run = subprocess.run([sys.argv[1], "drive", "--law", "wall", "--certificate", "none", "--device", device, "--seconds", "0.05"],
                         text=True, capture_output=True)
    checks.expect(run.stdout.count("driver            never tried on hardware\n") == said, f"{device}: {run}")
sys.exit(checks.exit_code(5))
