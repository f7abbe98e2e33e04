"""Finds the mutants that the tests catch: each alone in the quickest tests that reach it, then those that are left
together in the others."""
import concurrent.futures
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import time

from copy_of_sources import CORES
from instrumented import overlap

FIRST_SECONDS = 4  # of tests that a mutant is tried in alone


class Test:
    def __init__(self, entry):
        properties = {one["name"]: one["value"] for one in entry.get("properties", ())}
        self.name, self.command = entry["name"], entry.get("command", ())
        self.folder = properties.get("WORKING_DIRECTORY")
        self.environment = dict(one.split("=", 1) for one in properties.get("ENVIRONMENT", ()))
        self.skipped = properties.get("SKIP_RETURN_CODE")
        self.seconds, self.reached = 0.0, frozenset()

    def run(self, variables, limit):
        """Returns the exit code; None where it takes longer than the limit, s."""
        with subprocess.Popen(self.command, cwd=self.folder, env={**os.environ, **self.environment, **variables}, start_new_session=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            try:
                return process.wait(limit)
            except subprocess.TimeoutExpired:
                return None
            finally:
                try:
                    os.killpg(process.pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass


def tests_in(build, targets):
    """The tests of a build folder; where targets are named, only those that run one of them."""
    listing = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True, text=True)
    tests = [Test(entry) for entry in json.loads(listing.stdout)["tests"]]
    return [test for test in tests if test.command and os.access(test.command[0], os.X_OK)
            and (not targets or pathlib.Path(test.command[0]).name in targets)]


class Judge:
    def __init__(self, tests, mutants, folder):
        self.mutants, self.folder = mutants, folder
        self.lock = threading.Lock()
        self.killed_by = {}
        self.tests = tests

    def measure(self):
        """Runs each test with nothing chosen; drops those that fail so, or reach no mutant."""
        def one(test):
            with tempfile.NamedTemporaryFile(dir=self.folder) as file:
                file.write(bytes(len(self.mutants)))
                file.flush()
                begin = time.monotonic()
                code = test.run({"FORCESHADE_REACHED": file.name}, 1200)
                test.seconds = time.monotonic() - begin
                file.seek(0)
                test.reached = frozenset(i for i, byte in enumerate(file.read()) if byte)
            return code == 0

        with concurrent.futures.ThreadPoolExecutor(CORES) as pool:
            passed = list(pool.map(one, self.tests))
        left_out = [test.name for test, has_passed in zip(self.tests, passed) if not has_passed]
        print(f"{len(left_out)} of {len(self.tests)} tests are left out, because they fail with nothing changed: {' '.join(left_out)}",
              flush=True)
        self.tests = [test for test, has_passed in zip(self.tests, passed) if has_passed]
        self.tests = sorted((test for test in self.tests if test.reached), key=lambda test: test.seconds)

    def fails(self, test, numbers):
        """Returns true if the test notices that these mutants are active."""
        with tempfile.NamedTemporaryFile(dir=self.folder) as file:
            active = bytearray(len(self.mutants))
            for number in numbers:
                active[number] = 1
            file.write(active)
            file.flush()
            code = test.run({"FORCESHADE_MUTANTS": file.name}, 10 * test.seconds + 20)
            return code != 0

    def alone(self, mutant):
        """Tries the quickest tests that reach the mutant; keeps how many."""
        spent, tried = 0.0, set()
        for test in self.tests:
            if mutant.number not in test.reached:
                continue
            if tried and spent + test.seconds > FIRST_SECONDS:
                break
            spent += test.seconds
            tried.add(test.name)
            if self.fails(test, [mutant.number]):
                self.killed_by[mutant.number] = test.name
                break
        return mutant, tried

    def together(self, members, tried):
        """Runs the other tests with all members active that they reach, and parts them where a test fails."""
        def one(test):
            with self.lock:
                active = [m.number for m in members
                          if m.number in test.reached and m.number not in self.killed_by and test.name not in tried[m.number]]
            self.part(test, active)

        with concurrent.futures.ThreadPoolExecutor(CORES) as pool:
            list(pool.map(one, self.tests))

    def part(self, test, numbers):
        numbers = [number for number in numbers if number not in self.killed_by]
        if not numbers or not self.fails(test, numbers):
            return
        if len(numbers) == 1:
            self.killed_by[numbers[0]] = test.name
            return
        half = len(numbers) // 2
        self.part(test, numbers[:half])
        self.part(test, numbers[half:])

    def judge(self, say):
        reached = set().union(*(test.reached for test in self.tests))
        left, tried = [], {}
        with concurrent.futures.ThreadPoolExecutor(CORES) as pool:
            for mutant, names in pool.map(self.alone, [m for m in self.mutants if m.number in reached]):
                tried[mutant.number] = names
                if len(tried) % 100 == 0:
                    say(f"{len(tried)} of {len(reached)} are tried alone")
                if mutant.number not in self.killed_by:
                    left.append(mutant)
        say(f"{len(self.killed_by)} of {len(self.mutants)} are caught by quick tests, "
            f"{len(self.mutants) - len(reached)} are reached by none; {len(left)} go through all other tests together")
        groups = []
        for mutant in left:
            group = next((group for group in groups if not any(overlap(mutant, other) for other in group)), None)
            if group is None:
                groups.append(group := [])
            group.append(mutant)
        for group in groups:
            self.together(group, tried)
        return reached
