#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bundle.py FORCESHADE.js OUT.html: writes the page as one file, which loads no other. FORCESHADE.js is the library, a classic script
with the compiled module inside."""

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
SCRIPTS = ["numbers.js", "naive.js", "bump.js", "surfaces.js", "drawing.js", "controls.js", "page.js"]  # each uses those before it
MOST = 1_000_000  # bytes


def script(text):
    """A script element. What would end it, or begin a comment of HTML, occurs in strings of JavaScript alone, and is escaped there."""
    text = re.sub(r"<(?=/script|!--)", r"\\x3c", text, flags=re.IGNORECASE)
    return f"<script>\n{text}</script>\n"


def bundled(library):
    """The page, with the text of the library's script inside."""
    scripts = "".join(script(text) for text in [library, *((HERE / name).read_text("utf-8") for name in SCRIPTS)])
    page = (HERE / "index.html").read_text("utf-8")
    style = (HERE / "page.css").read_text("utf-8")
    return page.replace("@page.css@\n", style).replace("@scripts@\n", scripts)


def main(words):
    if len(words) != 2:
        sys.exit(f"bundle.py: {len(words)} arguments; expected FORCESHADE.js OUT.html")
    library, out = map(pathlib.Path, words)
    page = bundled(library.read_text("utf-8"))
    size = len(page.encode("utf-8"))
    if size > MOST:
        sys.exit(f"bundle.py: {out} would have {size} bytes; expected at most {MOST}")
    out.write_text(page, "utf-8")
    print(f"{out}: {size} bytes")


if __name__ == "__main__":
    main(sys.argv[1:])
