#!/usr/bin/env python3
"""stages_test.py SOURCE COMPILER EIGEN: recorded_stages, compiled with a header that has one fault, does not compile, or prints something
else than proofs/recorded/RecordedStages.v. So the comparison in every run of the tests refuses each of these faults."""

import pathlib
import subprocess
import sys
import tempfile

source, compiler, eigen = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
STORED = (source / "proofs/recorded/RecordedStages.v").read_text()
FAULTS = """
type      | laws/cylinder.h | double anchored, rest; => double anchored; float rest;
type      | laws/shading.h | double K_over_R; => float K_over_R;
type      | laws/bump_geometry.h | const double rest = (R - half) / R; => const float rest = static_cast<float>((R - half) / R);
type      | numbers/double_double.h | const double size = std::fabs(b.hi) => const float size = static_cast<float>(std::fabs(b.hi))
order     | numbers/ball.h | candidate = above; => candidate = below;
order     | evaluate.h | round_to_binary32(outcome.x) => round_to_binary32(outcome.z)
order     | laws/bump_2p.h | x < 0 ? -face.sine : face.sine => x < 0 ? face.sine : -face.sine
order     | laws/top_edge.h | -2 * scaled.lo, -scaled.lo => -scaled.lo, -2 * scaled.lo
insertion | numbers/double_double.h | const TwoTerms q = => if (a.error < 1e-20) return {a.hi / b.hi, 0, 0}; const TwoTerms q =
insertion | numbers/ball.h | const float above = => if (step == 1) continue; const float above =
insertion | laws/bump_cylinder.h | const Outcome<N> wall = => if (x == 0) return cylinder; const Outcome<N> wall =
insertion | domain.h | return __builtin_fabsf(coordinate) >= => if (coordinate == 1) return 1; return __builtin_fabsf(coordinate) >=
comment   | numbers/ball.h | step < 3 => /* step < 3 */ step < 1
dropped   | numbers/double_double.h | + a.error * b.error => + 0
dropped   | numbers/double_double.h | kSlack * (propagated + kRelativeError * std::fabs(value.hi)) => kSlack * propagated
dropped   | laws/bump_geometry.h | derivative(widened(x, -40)) => derivative(x)
dropped   | evaluate.h | if (outcome.contact == Sign::unknown) return std::nullopt; =>
dropped   | evaluate.h | quantised(position.x()) => position.x()
constant  | numbers/double_double.h | kNewtonSteps = 1; => kNewtonSteps = 2;
constant  | numbers/double_double.h | kRelativeError = 0x1p-101 => kRelativeError = 0x1p-102
constant  | numbers/first_stage.h | kDroppedMask - 2 * kWindow => kDroppedMask - kWindow
constant  | laws/bump_3p.h | kWideLimbs = 64 => kWideLimbs = 32
constant  | laws/outcome.h | N::exactly(0), N::exactly(1) => N::exactly(1), N::exactly(0)
constant  | laws/polygon_gap.h | N::exactly(0.5 * static_cast<double>(width)) - => N::exactly(static_cast<double>(width)) -
condition | laws/bump_3p_shaded.h | ax <= half_top => ax < half_top
condition | laws/bump_2p_shaded.h | if (2 * ax > p.width) => if (2 * ax >= p.width)
condition | laws/cylinder.h | x != 0 ? Sign::positive => z != 0 ? Sign::positive
"""


def said(folder, first):
    """What the program prints, where it compiles, with the headers of `first` before those of the source."""
    program = folder / "recorded_stages"
    includes = [f"-I{first}", f"-I{source}", f"-I{source}/include", "-isystem", eigen]
    done = subprocess.run([compiler, "-std=c++20", "-O0", "-ffp-contract=off", "-w", *includes, source / "tests/proofs/recorded_stages.cpp",
                           "-o", program], capture_output=True, text=True)
    if done.returncode != 0:
        return "does not compile"
    done = subprocess.run([program], capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else "does not end well"


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    assert said(folder, folder / "none") == STORED, "the headers without a fault"
    kinds, compiled = {}, 0
    for line in FAULTS.strip().splitlines():
        kind, file, change = (part.strip() for part in line.split(" | "))
        old, new = (part.strip() for part in (change + " ").split(" => "))
        text = (source / "fast" / file).read_text()
        assert text.count(old) >= 1, f"{file} has no {old}"
        planted = folder / "planted"
        (planted / "fast" / file).parent.mkdir(parents=True, exist_ok=True)
        (planted / "fast" / file).write_text(text.replace(old, new, 1))
        printed = said(folder, planted)
        assert printed != STORED, f"not refused: {line}"
        print(f"refused: {line}", flush=True)
        compiled += printed.startswith("(*")
        kinds[kind] = kinds.get(kind, 0) + 1
        (planted / "fast" / file).unlink()
print(f"refused: {sum(kinds.values())} faults ({', '.join(f'{count} {kind}' for kind, count in kinds.items())}), {compiled} by other terms")
