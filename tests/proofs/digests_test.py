#!/usr/bin/env python3
"""digests_test.py SOURCE: proofs/digests.py agrees with the sources as they are; in a copy it refuses a change of any token of the code
that code.txt names, passes over other text, and renews a digest."""

import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

source = pathlib.Path(sys.argv[1])
LINES = [line.split() for line in (source / "proofs/code.txt").read_text().splitlines() if not line.startswith("#")]
NAMED = [line for line in LINES if not line[0].endswith(".v")]  # weakened_test.py changes the statements


def run(root, *words):
    done = subprocess.run([root / "proofs/digests.py", *words], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


code, words = run(source)
assert code == 0, words

with tempfile.TemporaryDirectory() as folder:
    root = pathlib.Path(folder)
    (root / "proofs").mkdir()
    for name in ("digests.py", "code.txt"):
        shutil.copy(source / "proofs" / name, root / "proofs")
    for file, *_ in LINES:
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source / file, root / file)

    spec = importlib.util.spec_from_file_location("digests", root / "proofs/digests.py")
    digests = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(digests)

    def refused(file, text):
        """Asks the lines of this file alone, since no other line reads it."""
        kept = (root / file).read_text()
        (root / file).write_text(text)
        found = digests.changed([" ".join(line) for line in LINES if line[0] == file])
        (root / file).write_text(kept)
        return bool(found)

    planted = 0
    for file, *names, _ in NAMED:
        text = (root / file).read_text()
        assert not refused(file, text.replace(";\n", ";\n\n  // A { remark.\n")), file
        # A return of each named function, or of the file, gives something else.
        code_alone = re.sub(r"//.*", lambda remark: " " * len(remark[0]), text)
        for name in names:
            at = 0 if name == "*" else re.search(rf"\b{name}\([^;{{]*{{", code_alone).start()
            found = re.compile(r"\breturn |\bconst |\bif \(").search(code_alone, at)
            assert refused(file, text[:found.start()] + "[[unlikely]] " + text[found.start():]), (file, name)
            planted += 1
    # Faults of one token that a grep for lines let pass: a type, and a line that is inserted.
    file = "fast/numbers/big_float_ball.h"
    for old, new in (("std::uint64_t carry", "std::uint32_t carry"), ("return lost;", "return lost; return lost;")):
        text = (root / file).read_text()
        assert refused(file, text.replace(old, new, 1)), file
    # Code of the same file that no definition was written from.
    file = "fast/meshes/friction.h"
    assert not refused(file, (root / file).read_text() + "inline int other() { return 1; }\n")

    (root / "fast/meshes/rounded.h").write_text("int changed;\n")
    code, words = run(root)
    assert code == 1 and words.startswith("fast/meshes/rounded.h is not the code") and len(words.splitlines()) == 2, words
    assert run(root, "--renew", "fast/meshes/rounded.h") == (0, "")
    assert run(root)[0] == 0
    assert run(root, "--renew", "fast/none.h") == (1, "proofs/code.txt: expected a line of fast/none.h\n")
    assert run(root, "--wrong")[0] == 1
    (root / file).write_text("")
    assert "expected functions of fast/meshes/friction.h, got exact_order" in run(root)[1]
print(f"refused: {planted} changes of {len(NAMED)} files")
