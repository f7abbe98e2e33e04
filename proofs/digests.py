#!/usr/bin/env python3
"""proofs/digests.py [--renew FILE...]: compares the code that definitions of these proofs were written from by hand, and the statements
of the theorems, with the digests of proofs/code.txt, and exits with 1 where one differs. Each line of code.txt names a file, functions of
it (or * for the whole file), or definitions of a file of Coq, and the digest of their text without comments and line breaks. Whoever
changes such code looks at the definitions in proofs/*.v again, whoever changes a statement asks whether it says less, and then renews
the digest of the file."""

import hashlib
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = ROOT / "proofs/code.txt"


def without_comments(text):
    text = re.sub(r'("(?:\\.|[^"\\\n])*")|//[^\n]*|/\*.*?\*/', lambda found: found[1] or " ", text, flags=re.DOTALL)
    text = re.sub(r"^\s*#.*$", lambda line: line[0] + ";", text, flags=re.MULTILINE)  # a directive ends at its line
    return re.sub(r"\s*([(){}\[\],;])\s*", r"\1", " ".join(text.split()))


def without_coq_comments(text):
    depth, kept = 0, []
    for part in re.split(r"(\(\*|\*\))", text):
        depth += {"(*": 1, "*)": -1}.get(part, 0)
        kept.append(part if depth == 0 and part != "*)" else " ")
    return " ".join("".join(kept).split())


def body_end(text, begin):
    """The place behind the bracket that closes the one at `begin`."""
    depth = 0
    for at in range(begin, len(text)):
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return at + 1
    raise SystemExit("a bracket is not closed")


def functions(text, name):
    """Every definition of the function, from its head to the closing bracket."""
    for found in re.finditer(rf"(?<![\w.>]){name}\(", text):
        head = re.compile(r"[^;{}]*").match(text, found.end()).end()
        begin = max(text.rfind(each, 0, found.start()) for each in ";{}") + 1
        if head < len(text) and text[head] == "{" and not re.search(r"\b(return|if|while)\b|[=,]$", text[begin:found.start()]):
            yield text[begin:body_end(text, head)]


def definitions(text, name):
    """The definition in Coq, or the statement of the theorem, to the full stop that ends it."""
    return re.findall(rf"\b(?:Definition|Fixpoint|Theorem) {name} .*?\.(?= |$)", text)


def digest_of(file, names):
    text = (without_coq_comments if file.endswith(".v") else without_comments)((ROOT / file).read_text())
    parts = [text]
    if names != ["*"]:
        parts = []
        for name in names:
            found = list((definitions if file.endswith(".v") else functions)(text, re.escape(name)))
            if not found:
                raise SystemExit(f"proofs/code.txt: expected functions of {file}, got {name}")
            parts += found
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]


def changed(lines):
    """The files of these lines of code.txt that differ from their digests."""
    split = [line.split() for line in lines if not line.startswith("#")]
    return [file for file, *names, digest in split if digest_of(file, names) != digest]


def main():
    renewed = sys.argv[2:] if sys.argv[1:2] == ["--renew"] else []
    if len(sys.argv) > 1 and not renewed:
        raise SystemExit(__doc__)
    lines = LIST.read_text().splitlines()
    for file in renewed:
        places = [place for place, line in enumerate(lines) if line.split()[0] == file]
        if not places:
            raise SystemExit(f"proofs/code.txt: expected a line of {file}")
        for place in places:
            _, *names, _ = lines[place].split()
            lines[place] = " ".join([file, *names, digest_of(file, names)])
    if renewed:
        LIST.write_text("\n".join(lines) + "\n")
    differing = changed(lines)
    for file in differing:
        what = ("does not state what a person has read: does it say less?" if file.endswith(".v") else
                "is not the code that definitions of proofs/ were written from: look at them again,")
        print(f"{file} {what} Then\n  proofs/digests.py --renew {file}")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
