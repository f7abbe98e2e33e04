# SPDX-License-Identifier: BSD-3-Clause
"""inline.py MODULE.js MODULE.wasm ARGUMENTS.js INTERFACE.js OUT.js: makes one classic script of emscripten's code, the module, which it
packs with gzip and writes as base64, and the interface. The same inputs give the same bytes."""

import base64
import gzip
import sys


def main(module, binary, arguments, interface, out):
    with open(module) as file:
        code = file.read()
    with open(binary, "rb") as file:
        packed = base64.b64encode(gzip.compress(file.read(), 9, mtime=0)).decode()
    with open(arguments) as file, open(interface) as its:
        interface = file.read() + its.read()
    with open(out, "w") as file:
        file.write(f'{code}\nconst forceshadePacked = "{packed}";\n{interface}')


main(*sys.argv[1:])
