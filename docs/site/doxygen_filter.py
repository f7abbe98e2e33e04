#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""doxygen_filter.py HEADER: the header with its comments as Doxygen reads them. The first comment is of the file, with its example
as code; every other one is of what follows it, or of what stands before it on its line."""
import re
import sys


def of_file(lines):
    """The lines of the first comment, without their marks; those of an example are indented by two spaces more than text."""
    in_code = False
    for line in lines:
        is_code = line.startswith("  ") or (in_code and not line.strip())
        if is_code != in_code:
            yield "@code" if is_code else "@endcode"
        in_code = is_code
        yield line
    if in_code:
        yield "@endcode"


def filtered(text):
    text = re.sub(r"^(//|/\*) SPDX.*\n", "", text)
    first = re.search(r"^(?:/\*(?:.|\n)*?\*/\n|(?://.*\n)+)", text, re.MULTILINE)
    words = [re.sub(r"^(//|/\*| \*(?!/)) ?| *\*/$", "", line) for line in first[0].splitlines()]
    block = "".join(f"/// {line}\n" for line in ["@file", *of_file(words)])
    # The end of a namespace, and the file of what is only declared, describe nothing.
    rest = re.sub(r" +// (namespace .*|[a-z0-9_/]+\.(h|cpp))$", "", text[first.end():], flags=re.MULTILINE)
    rest = re.sub(r"^( *)// ?", r"\1/// ", rest, flags=re.MULTILINE)
    rest = re.sub(r"^( *)/\* (?!-)", r"\1/** ", rest, flags=re.MULTILINE)  # not the headings of sections
    rest = re.sub(r"^( *[^ /*\n][^\n]*?) +// (.*)$", r"\1  ///< \2", rest, flags=re.MULTILINE)
    rest = re.sub(r"^( *[^ /*\n][^\n]*?) +/\* (.*\*/)", r"\1  /**< \2", rest, flags=re.MULTILINE)
    return text[:first.start()] + block + rest


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as header:
        sys.stdout.write(filtered(header.read()))
