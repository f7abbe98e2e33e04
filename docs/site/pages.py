#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""pages.py FOLDER PAGE...: copies these pages of the sources, the pages that their links lead to, and every other file that a page
names, into FOLDER, each with its path; a browser keeps each option in a table on one line. It stops at a link to a folder, which a page of
the site cannot show."""
import os
import pathlib
import re
import shutil
import sys

SOURCES = pathlib.Path(__file__).resolve().parents[2]
OPTION = re.compile(r"(`--[^`|]{1,24}`)(?=.*\|$)", re.M)
LINK = re.compile(r"\]\(([^)\s#]+)[^)]*\)|src=\"([^\"#]+)\"")


def links_of(page):
    for found in LINK.finditer((SOURCES / page).read_text(encoding="utf-8")):
        target = found[1] or found[2]
        if ":" not in target:
            yield os.path.normpath(page.parent / target)


def main(folder, pages):
    waiting, seen = [pathlib.Path(page) for page in pages], set()
    while waiting:
        path = waiting.pop()
        if path in seen or not (SOURCES / path).exists():  # MkDocs says which link leads nowhere
            continue
        seen.add(path)
        if (SOURCES / path).is_dir():
            sys.exit(f"{path} is a folder; expected the pages to name files")
        to = folder / path
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(SOURCES / path, to)
        if path.suffix == ".md":
            to.write_text(OPTION.sub(r"\1{.option}", to.read_text(encoding="utf-8")), encoding="utf-8")
            waiting += [pathlib.Path(link) for link in links_of(path)]


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), sys.argv[2:])
