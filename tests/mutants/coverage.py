"""Finds the test programs that run a line, measured with gcov."""
import json
import pathlib
import subprocess
import sys
import time

from copy_of_sources import CORES, ROOT, TIME_LIMIT, Copy, digest, is_script, names_of_tests, source_of


SKIPPED = 77  # the exit code of a script that lacks what it tests with


class Coverage:
    """Builds every test program for coverage and runs those that have changed since the last time."""

    def __init__(self, root):
        self.copy = Copy(root, flags="-O1 --coverage")
        self.record = root / "coverage.json"
        known = json.loads(self.record.read_text()) if self.record.exists() else {}
        names = names_of_tests()
        made = self.copy.run(["ninja", "-C", self.copy.build, f"-j{CORES}", *sorted({self.copy.target(name) for name in names})])
        if made.returncode != 0:
            sys.exit(made.stdout)
        self.tests = {}
        for name in names:
            state = digest(self.copy.binary(name).read_bytes().hex(), source_of(name).read_text() if is_script(name) else "")
            if known.get(name, {}).get("state") != state:
                known[name] = {"state": state, **self.measure(name)}
                self.record.write_text(json.dumps(known))
            self.tests[name] = known[name]

    def measure(self, name):
        """Seconds, and the lines of each of the sources that it runs."""
        for file in self.copy.build.glob("**/*.gcda"):
            file.unlink()
        begin = time.monotonic()
        ran = self.copy.run_test(name, limit=60 * TIME_LIMIT)
        if ran.returncode == SKIPPED:
            return {"seconds": 0, "lines": {}}
        if ran.returncode != 0:
            sys.exit(f"{name} fails where nothing is changed:\n{ran.stdout}")
        seconds, lines = time.monotonic() - begin, {}
        for file in self.copy.build.glob("**/*.gcda"):
            for source, ran_lines in self.lines_in(file):
                lines.setdefault(source, set()).update(ran_lines)
        print(f"coverage of {name}: {len(lines)} files, {seconds:.1f} s", flush=True)
        return {"seconds": seconds, "lines": {source: sorted(numbers) for source, numbers in lines.items()}}

    def lines_in(self, file):
        report = subprocess.run(["gcov", "--json-format", "--stdout", file], cwd=self.copy.build, check=True, capture_output=True)
        for text in report.stdout.decode().splitlines():
            for source in json.loads(text)["files"]:
                path = (self.copy.build / source["file"]).resolve()
                if path.is_relative_to(self.copy.root):
                    yield (str(path.relative_to(self.copy.root)),
                           [line["line_number"] for line in source["lines"] if line["count"] > 0])

    def tests_of(self, path, lines):
        """The tests that run one of these lines; where no test does, since a constant is no code, those that run any of the file;
        where these are none either, those that include it. Those of the module first, of these the quickest."""
        run_it = [name for name, test in self.tests.items() if not set(lines).isdisjoint(test["lines"].get(path, ()))]
        found = run_it or [name for name, test in self.tests.items() if path in test["lines"]] or self.including(path)
        module = pathlib.Path(path).parts[0]

        def cost(name):
            source = source_of(name).relative_to(ROOT / "tests")
            return source.parts[0] != module, self.tests[name]["seconds"]

        return sorted(found, key=cost)

    def including(self, path):
        """The tests of which an object file depends on this one, whichever library holds it."""
        objects, current = set(), None
        for line in self.copy.run(["ninja", "-C", self.copy.build, "-t", "deps"]).stdout.splitlines():
            if line and not line.startswith(" "):
                current = line.split(":")[0]
            elif line and (self.copy.build / line.strip()).resolve() == self.copy.root / path:
                objects.add(current)
        return [name for name in self.tests if self.is_made_of(name, objects)]

    def is_made_of(self, name, objects):
        inputs = self.copy.run(["ninja", "-C", self.copy.build, "-t", "inputs",
                                self.copy.binary(name).relative_to(self.copy.build)]).stdout.split()
        return not objects.isdisjoint(inputs)
