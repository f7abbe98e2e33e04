# SPDX-License-Identifier: BSD-3-Clause
"""The cost of a loop's vector instructions on the processor that runs this, in cycles: alone, and beside instructions that fill the
pipes which multiply, those which add, or all of them. A cycle is a third of an imul that waits for the one before.

Each instruction is run many times with independent results: its form, without its memory operand, which is a load of its own. What it
adds to a stream of others is the time that it takes from their pipes; so instructions that share pipes show it, whatever the vendor's
names of the pipes are. Needs g++ and an x86-64 processor with the instructions."""
import itertools
import pathlib
import re
import subprocess
import tempfile

TURNS, REPEATS = 300, 6
PROBES = {"multiply": ("vmulps %zmm30, %zmm31, %zmm{}", 0.5), "add": ("vaddps %zmm30, %zmm31, %zmm{}", 0.5),
          "any": ("vpaddd %zmm30, %zmm31, %zmm{}", 0.25)}
RUNNER = """
#include <algorithm>
#include <chrono>
#include <cstdio>
extern "C" void (*const functions[])(double*);
extern "C" const unsigned count, turns;
int main() {
  alignas(64) static double ones[64];
  std::fill(ones, ones + 64, 1.0);
  const auto seconds = [&](unsigned i) {
    const auto start = std::chrono::steady_clock::now();
    functions[i](ones);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  for (unsigned i = 0; i < count; ++i) {
    double best = 1e9, chain = 1e9;
    for (int repetition = 0; repetition < 60; ++repetition) {
      chain = std::min(chain, seconds(0));
      best = std::min(best, seconds(i));
    }
    std::printf("%.17g\\n", i > 0 ? 3 * 96 * best / chain : 1e9 * chain / (3 * 96 * turns));
  }
}
"""


def form(instruction):
    """The instruction with registers that no other waits for ("{}" is its result's number), or None where it is no vector operation;
    whether it loads, and whether it stores."""
    text = instruction.split("#")[0].strip().replace("\t", " ")
    memory = re.search(r"[-\w.]*\([^)]*\)", text)
    is_store = memory is not None and text.rstrip().endswith(memory[0])
    if not text.startswith(("v", "k")) or re.match(r"vmov\w+ %zmm\d+, %zmm\d+$", text):  # the last take no pipe
        return None, memory is not None and not is_store, is_store
    if is_store or (memory and re.match(r"vmov\w+ ", text)):
        return None, not is_store, is_store
    if memory:
        text = text.replace(memory[0], "%ymm31" if text.startswith("vcvtps2pd") else "%zmm31")
    head, kind, masks = re.match(r"(.*[ ,])%([a-z]+)\w*((?:\{[^}]*\})*)$", text).groups()
    sources = itertools.cycle((31, 30))  # two, since what is made of a register and itself may be known to be 0
    head = re.sub(r"%(zmm|ymm|xmm)\d+", lambda match: f"%{match[1]}{next(sources)}", head)
    head = re.sub(r"%k\d", "%k1", head)
    result = f"%{kind}{{}}" if kind in ("zmm", "ymm", "xmm", "k") else "%eax"
    return head + result + re.sub(r"%k\d", "%k1", masks), memory is not None, False


def stream(texts):
    """The texts, each with a register of its own as its result."""
    return [text.replace("{}", str(2 + i % 6 if "%k{}" in text else i % 29)) for i, text in enumerate(texts)]


def cycles_of(streams):
    """The cycles that each list of instructions takes, once; and how many ns a cycle takes."""
    bodies = [["imul %rax, %rax"] * 96] + [stream(texts) for texts in streams]
    with tempfile.TemporaryDirectory() as folder:
        assembly = [".text"]
        for i, body in enumerate(bodies):
            assembly += [f"f{i}:", "vmovupd (%rdi), %zmm31", "vmovupd (%rdi), %zmm30", "kxnorw %k1, %k1, %k1", f"mov ${TURNS}, %ecx",
                         ".p2align 6", "1:", *body, "dec %ecx", "jnz 1b", "vzeroupper", "ret"]
        assembly += [".section .data.rel.ro", ".globl functions, count, turns", "functions:", *(f".quad f{i}" for i in range(len(bodies))),
                     f"count: .long {len(bodies)}", f"turns: .long {TURNS}", '.section .note.GNU-stack,"",@progbits', ""]
        pathlib.Path(folder, "streams.s").write_text("\n".join(assembly))
        pathlib.Path(folder, "run.cpp").write_text(RUNNER)
        subprocess.run(["g++", "-O1", "-no-pie", "-o", "run", "run.cpp", "streams.s"], cwd=folder, check=True)
        printed = subprocess.run([f"{folder}/run"], check=True, capture_output=True, text=True).stdout
    cycle, *cycles = [float(line) for line in printed.split()]
    return cycles, cycle


def costs(forms):
    """For each form the cycles it takes alone, and what it takes from the pipes of each probe."""
    forms = sorted(forms)
    alone = [cycles / 24 for cycles in cycles_of([[text] * 24 for text in forms])[0]]
    streams = []
    for text, cycles in zip(forms, alone):
        for probe, probe_cycles in PROBES.values():
            probes = [probe] * round((2 * cycles + 2) / probe_cycles)
            streams += [([text] + probes) * REPEATS, probes * REPEATS]
    cycles, _ = cycles_of(streams)
    taken = [max(0.0, both - probes) / REPEATS for both, probes in zip(cycles[::2], cycles[1::2])]
    return {text: {"alone": alone[i], **dict(zip(PROBES, taken[3 * i:3 * i + 3]))} for i, text in enumerate(forms)}
