#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""port_model.py BUILD_FOLDER [PROCESSOR | measured]: what the loops of the batch need at least.

Of the AVX2 batch, a turn of which answers eight positions, llvm-mca (Debian package llvm) says how many cycles the execution ports need,
and how many the simulated processor (znver3) takes. With "measured", of the AVX-512 batch and sixteen positions, what instruction_costs.py
measures on this processor says how many cycles the pipes that multiply, those that add, all pipes, the divider, and the ports of loads
and of stores need; the largest bounds the loop from below. All other work should be stopped then. The wall's loop is unrolled
four times."""
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

import instruction_costs

OBJECT = "fast/CMakeFiles/forceshade_fast_objects.dir/simd/batch_{}.cpp.o"
ITERATIONS = 200


def assembly(build, instruction_set, to):
    """The build's own command for the file, with -S in place of -c."""
    commands = subprocess.run(["ninja", "-C", build, "-t", "commands", OBJECT.format(instruction_set)], check=True, capture_output=True,
                              text=True).stdout
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


def laws_loops(build, instruction_set):
    """(law, instructions) of each loop that answers positions."""
    with tempfile.TemporaryDirectory() as scratch:
        for function, body in loops(assembly(build, instruction_set, f"{scratch}/batch.s")):
            law = re.search(r"answer(?:_block)?INS0_\d+(\w+?)EEE?b", function)
            if law is not None and not any("\tj" in line for line in body):
                yield law[1], body


def print_simulated(build, processor):
    print(f"{'law':16} {'instructions':>12} {'ports':>6} {'simulated':>9}")
    for law, body in laws_loops(build, "avx2"):
        cycles, ports = simulated(body, processor)
        print(f"{law:16} {len(body):12} {ports:6.1f} {cycles:9.1f}")


def print_measured(build):
    all_loops = list(laws_loops(build, "avx512"))
    forms = [[instruction_costs.form(instruction) for instruction in body] for _, body in all_loops]
    costs = instruction_costs.costs({text for body in forms for text, _, _ in body if text})
    (load, store), cycle = instruction_costs.cycles_of([["vmovups 64(%rdi), %zmm{}"] * 24, ["vmovups %zmm31, 64(%rdi)"] * 24])
    pipes = [*instruction_costs.PROBES, "divider", "loads", "stores"]
    print(f"cycles of {cycle:.3f} ns")
    print(f"{'law':16} {'instructions':>12} " + " ".join(f"{pipe:>8}" for pipe in pipes))
    for (law, body), parts in zip(all_loops, forms):
        texts = [text for text, _, _ in parts if text]
        divisions = [text for text in texts if text.startswith(("vdiv", "vsqrt"))]
        needs = {pipe: sum(costs[text][pipe] for text in texts) for pipe in instruction_costs.PROBES}
        needs["divider"] = instruction_costs.cycles_of([divisions * 8])[0][0] / 8 if divisions else 0
        needs["loads"] = sum(loads for _, loads, _ in parts) * load / 24
        needs["stores"] = sum(stores for _, _, stores in parts) * store / 24
        print(f"{law:16} {len(body):12} " + " ".join(f"{needs[pipe]:8.1f}" for pipe in pipes))
    counts = collections.Counter(text for body in forms for text, _, _ in body if text)
    print(f"\n{'instruction':48} {'alone':>6} " + " ".join(f"{probe:>8}" for probe in instruction_costs.PROBES))
    for text, _ in counts.most_common():
        print(f"{text:48} {costs[text]['alone']:6.2f} " + " ".join(f"{costs[text][probe]:8.2f}" for probe in instruction_costs.PROBES))


def main():
    build, processor = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "znver3"
    if processor == "measured":
        print_measured(build)
    else:
        print_simulated(build, processor)


if __name__ == "__main__":
    main()
