# SPDX-License-Identifier: BSD-3-Clause
"""The places of the source files, and their contents; and what runs the rules of a script about them."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
CPP = {".h", ".cpp", ".inl"}
failures = []


def expect(holds, words):
    if not holds:
        failures.append(words)


def text_of(path):
    """Of a path below the root."""
    return (ROOT / path).read_text(encoding="utf-8", errors="surrogateescape")


def lines_of(path):
    return text_of(path).removesuffix("\n").split("\n")


def name_of(path):
    return path.relative_to(ROOT).as_posix()


def files_of(*folders, kinds=None):
    """All files below the folders whose extension is one of `kinds`, with links not followed."""
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*")):
            if (kinds is None or path.suffix in kinds) and path.is_file():
                yield path


def modules():
    """Of cmake/modules.txt, with what each may include."""
    found = dict(line.split(":", 1) for line in lines_of("cmake/modules.txt") if not line.startswith("#"))
    assert len(found) > 10
    return found


def top_folders():
    """The folders at the top in which modules, their public headers and clients lie."""
    return sorted({"include", "clients"} | {module.split("/")[0] for module in modules()})


def laws():
    """Names and files of the laws in include/forceshade/law.h."""
    text = text_of("include/forceshade/law.h")
    found = re.findall(r'\{LawId::\w+, "([\w-]+)", "(\w+)"\}', text)
    assert f"std::array<LawName, {len(found)}> kLaws" in text and len(found) > 8, found
    return found


def device_kinds():
    found = re.findall(r'^    Kind\{"(\w+)"', text_of("device/kinds.cpp"), re.MULTILINE)
    assert len(found) > 7 and len(found) == text_of("device/kinds.cpp").count(" Kind{"), found
    return found


def run(names):
    """Runs the rules that the command line names, or all: functions whose names begin with test_."""
    for rule in sys.argv[1:] or [name for name in names if name.startswith("test_")]:
        names[rule]()
    print(*failures, sep="\n")
    sys.exit(bool(failures))
