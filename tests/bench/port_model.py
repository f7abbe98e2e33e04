#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""port_model.py BUILD_FOLDER [PROCESSOR]: what llvm-mca says of the loops of the AVX2 batch, each of which answers eight positions: their
instructions, the cycles that the execution ports need at least, and the cycles that the simulated processor (znver3) takes. Needs the
Debian package llvm."""
import pathlib
import re
import subprocess
import sys
import tempfile

OBJECT = "fast/CMakeFiles/forceshade_fast_objects.dir/simd/batch_avx2.cpp.o"
ITERATIONS = 200


def assembly(build, to):
    """The build's own command for the file, with -S in place of -c."""
    commands = subprocess.run(["ninja", "-C", build, "-t", "commands", OBJECT], check=True, capture_output=True, text=True).stdout
    command = re.sub(r" -o \S+| -M[DTF]+( \S+\.[od])?", "", commands.splitlines()[-1]).replace(" -c ", f" -S -o {to} ")
    subprocess.run(command, shell=True, check=True, cwd=build)
    return pathlib.Path(to).read_text().splitlines()


def loops(lines):
    """(function, instructions) of each loop that holds no other."""
    function, labels, last_loop = "", {}, 0
    for i, line in enumerate(lines):
        if match := re.match(r"(_Z\w+):", line):
            function, labels = match[1], {}
        elif match := re.match(r"(\.L\d+):", line):
            labels[match[1]] = i
        elif (match := re.match(r"\s+j\w+\s+(\.L\d+)", line)) and labels.get(match[1], -1) > last_loop and "\tjmp" not in line:
            last_loop = i
            body = [text for text in lines[labels[match[1]] + 1:i] if not text.strip().startswith(".") and not text.endswith(":")]
            yield function, body


def simulated(instructions, processor):
    report = subprocess.run(["llvm-mca", f"-mcpu={processor}", f"-iterations={ITERATIONS}"], input="\n".join(instructions) + "\n",
                            check=True, capture_output=True, text=True).stdout
    cycles = int(re.search(r"Total Cycles:\s+(\d+)", report)[1]) / ITERATIONS
    return cycles, float(re.search(r"Block RThroughput:\s+(\S+)", report)[1])


def main():
    build, processor = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "znver3"
    print(f"{'law':16} {'instructions':>12} {'ports':>6} {'simulated':>9}")
    with tempfile.TemporaryDirectory() as scratch:
        for function, body in loops(assembly(build, f"{scratch}/batch.s")):
            law = re.search(r"answer(?:_block)?INS0_\d+(\w+?)EEE?b", function)
            if law is None or any("\tj" in line for line in body):
                continue
            cycles, ports = simulated(body, processor)
            print(f"{law[1]:16} {len(body):12} {ports:6.1f} {cycles:9.1f}")


if __name__ == "__main__":
    main()
