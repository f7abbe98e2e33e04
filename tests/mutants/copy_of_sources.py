"""A copy of the sources in which lines may be changed, with a build of its own."""
import functools
import hashlib
import os
import pathlib
import signal
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CORES = os.cpu_count() or 1
TIME_LIMIT = 60  # s of processor time; the slowest of the tests takes a sixth of it where nothing is changed


def digest(*texts):
    return hashlib.sha256("\0".join(texts).encode()).hexdigest()[:16]


@functools.cache
def sources_of_tests():
    """By name: the test programs, and the scripts that test the command and are given no more than it."""
    def is_run(path):
        head = path.read_text().split("\n", 2)[1]
        return path.suffix == ".cpp" or head.startswith(f"# {path.name} FORCESHADE:")

    return {path.stem: path for path in (ROOT / "tests").glob("**/*_test.*") if path.suffix in (".cpp", ".sh") and is_run(path)}


def names_of_tests():
    return sorted(sources_of_tests().keys() - {"mutants_test"})


def source_of(test):
    return sources_of_tests()[test]


def is_script(test):
    return source_of(test).suffix == ".sh"


def sources():
    listing = subprocess.run(["git", "ls-files", "-coz", "--exclude-standard"], cwd=ROOT, check=True, capture_output=True)
    return [path for path in listing.stdout.decode().split("\0") if path and (ROOT / path).is_file()]


def write_source(root, path, content):
    """Writes a file of the sources below root, unless it has this content there."""
    target = root / path
    if target.exists() and target.read_bytes() == content:
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(content)
    target.chmod((ROOT / path).stat().st_mode)


class Copy:
    def __init__(self, root, flags="-O1"):
        self.root, self.build, self.flags = root, root / "build", flags
        for path in sources():
            self.write(path, (ROOT / path).read_bytes())
        self.configure(with_mutants="OFF")

    def configure(self, with_mutants):
        """With mutants_test every change of a header would configure anew."""
        self.run(["cmake", "-G", "Ninja", "-S", self.root, "-B", self.build, "-DCMAKE_BUILD_TYPE=Release",
                  f"-DCMAKE_CXX_FLAGS_RELEASE={self.flags}", "-DCMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE=PRE_TEST",
                  "-DFORCESHADE_UNITE=OFF", f"-DFORCESHADE_MUTANTS={with_mutants}"], check=True)

    def write(self, path, content):
        write_source(self.root, path, content)

    def run(self, command, **options):
        return subprocess.run([str(word) for word in command], cwd=self.root, text=True, errors="replace",
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)

    def make(self, test, jobs=1):
        return self.run(["ninja", "-C", self.build, f"-j{jobs}", self.target(test)])

    def target(self, test):
        return "forceshade" if is_script(test) else test

    def binary(self, test):
        return self.build / ("apps/forceshade" if is_script(test) else f"tests/{test}")

    def run_test(self, test, limit=TIME_LIMIT):
        source = self.root / source_of(test).relative_to(ROOT)
        command = [source, self.binary(test)] if is_script(test) else [self.binary(test), "--gtest_fail_fast", "--gtest_brief=1"]
        if source.parent.name == "window":
            command = [source.parent / "under_xvfb.sh", *command]
        return self.run(["prlimit", f"--cpu={limit}", *command])

    def fails(self, test):
        """The reason why the test does not pass, or nothing."""
        made = self.make(test)
        if made.returncode != 0:
            print(next((line for line in made.stdout.splitlines() if "error" in line.lower()), "no error is printed"))
            return "killed: does not compile, seen"
        ran = self.run_test(test)
        if ran.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return "killed: hangs, seen"
        return "killed" if ran.returncode != 0 else None
