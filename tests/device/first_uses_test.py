# SPDX-License-Identifier: BSD-3-Clause
"""first_uses_test.py FORCESHADE haply|dhd|command LIBRARY: a first contact (`device try`) and a session of an experiment over an
arm behind its stand-in, which blames the client for nothing. The recordings are verified. LIBRARY is the stand-in's for DHD."""

import os
import pty
import subprocess
import sys
import tempfile
import time

import arms
from checks import Checks

PROMPT = "Press Enter when this is done"
PROTOCOL = """experiment = "classification"
name = "two trials"
language = "{sources}/examples/experiments/english.toml"
width_mil = 1000
stiffness_N_per_mm = 0.5
resume = "trial"
stimuli = [{{ law = "bump-1p-shaded" }}]
radii_mil = [1000]
repetitions = 2
"""


def ran(forceshade, *words, folder, **more):
    return subprocess.run([forceshade, *words], cwd=folder, text=True, capture_output=True, timeout=120, **more)


def on_terminal(command, folder, environment, presses):
    """Its exit code, and all that it showed on a terminal of its own, where Enter is pressed so many times, at each prompt."""
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(folder)
        os.execve(command[0], command, {**os.environ, **environment})
    shown, pressed = "", 0
    while True:
        try:
            some = os.read(terminal, 4096)
        except OSError:  # it has ended
            break
        shown += some.decode(errors="replace")
        if pressed < presses and shown.count(PROMPT) > pressed:
            os.write(terminal, b"\n")
            pressed += 1
    os.close(terminal)
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), shown


def tried(forceshade, kind, folder):
    with arms.KINDS[kind](options=arms.KINDS[kind].held) as arm:
        command = [forceshade, "device", "try", arm.device, "--uncertified", "--seconds", "3", "--record", "try.fsr",
                   "--overwrite", "--watchdog-timeout", "1"]
        code, shown = on_terminal(command, folder, arm.environment, 2)
        return code, shown, arm.verdict()


def session(forceshade, kind, folder, name):
    """Answers the first trial once the arm has felt the bump for a second."""
    with arms.KINDS[kind]() as arm:
        command = [forceshade, "experiment", "run", "protocol.toml", "--participant", "P1", "--session", name, "--device", arm.device, "--terminal",
                   "--uncertified", "--watchdog-timeout", "1"]
        client = subprocess.Popen(command, cwd=folder, text=True, env={**os.environ, **arm.environment}, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT)
        try:
            client.stdin.write("\n\n")
            client.stdin.flush()
            felt = arm.first("contact", is_alive=lambda: client.poll() is None)
            time.sleep(1 if felt else 0)
            shown, _ = client.communicate("1\n2\n" + "because\n" * 8, timeout=60)
        finally:
            client.kill()
            client.communicate()
        return client.returncode, shown, arm.verdict()


def main(forceshade, kind, library):
    checks = Checks()
    arms.Dhd.library = library
    sources = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))

    def expect_good(what, run):
        checks.expect(run.returncode == 0, f"{what}: exit code {run.returncode}: {run.stdout}{run.stderr}")
        return run.stdout

    with tempfile.TemporaryDirectory() as folder:
        code, shown, faults = tried(forceshade, kind, folder)
        checks.expect(code == 0 and shown.count(PROMPT) == 2, f"device try: exit code {code}: {shown}")
        felt = [line for line in shown.splitlines() if line.startswith("felt ")]
        checks.expect(felt and " in 0 of" not in felt[0], f"device try felt nothing: {shown}")
        checks.expect(not faults, f"device try: the stand-in found {faults}")
        print(felt[0] if felt else shown)
        print(expect_good("recording verify", ran(forceshade, "recording", "verify", "try.fsr", folder=folder)), end="")

        with open(folder + "/protocol.toml", "w") as file:
            file.write(PROTOCOL.format(sources=sources))
        code, shown, faults = session(forceshade, kind, folder, "S")
        checks.expect(code == 0 and not faults, f"experiment: exit code {code}, the stand-in found {faults}: {shown}")
        print(expect_good("recording verify", ran(forceshade, "recording", "verify", "S", folder=folder)), end="")
        said = expect_good("recording recompute", ran(forceshade, "recording", "recompute", "S", folder=folder))
        checks.expect(" 0 in contact" not in said, f"recording recompute: {said}")
        print(said, end="")
    return checks.exit_code(8)


sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2], os.path.abspath(sys.argv[3])))
