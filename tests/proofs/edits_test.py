#!/usr/bin/env python3
"""edits_test.py SOURCE COMPILER EIGEN: edits of one line each, which change what the code does or a theorem says. Each is refused by the
test that its row names, all of which run in every run of the tests: terms and stages (proofs.recorded_terms_are_those_stored,
proofs.recorded_stages_are_those_stored), digest (proofs.code_is_that_of_the_definitions, proofs.weaker_statements_are_refused) and rows
(proofs.code_answers_as_the_model_did)."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

source, compiler, eigen = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
# From an audit of an earlier state of the proofs, which accepted all but one of them. The eleventh is mutants.txt's kLargestRadius = 2e4F.
AUDIT = r"""
rows   | type      | laws/cylinder.h | double anchored, rest; => double anchored; float rest;
stages | unlisted  | evaluate.h | quantised(position.x()) => position.x()
stages | order     | numbers/ball.h | candidate = above; => candidate = below;
digest | insertion | numbers/big_float_ball.h | BigFloatBall result = large; => BigFloatBall result = large; small.error_ = kExact;
stages | insertion | numbers/double_double.h | return rounded(q, => if (a.error < 1e-20) return {q.hi, q.lo, 0}; return rounded(q,
stages | comment   | numbers/ball.h | step < 3 => /* step < 3 */ step < 1
stages | type      | laws/shading.h | double K_over_R; => float K_over_R;
terms  | type      | laws/bump_2p.h | double K, K_sine, K_cosine; => double K; float K_sine, K_cosine;
stages | unlisted  | numbers/double_double.h | return {hi, lo}; => return {hi, lo * 0.5};
digest | statement | Main.v | -> right_answer (answer (code_of_bump_2p => -> 0 < value32 x -> w = K -> right_answer (answer (code_of_bump_2p
"""
FURTHER = r"""
stages | type      | laws/bump_geometry.h | const double rest = (R - half) / R; => const float rest = static_cast<float>((R - half) / R);
stages | type      | numbers/double_double.h | const double size = std::fabs(b.hi) => const float size = static_cast<float>(std::fabs(b.hi))
digest | type      | numbers/big_float_ball.h | const Product t = Product{limbs_[i]} + => const std::uint64_t t = limbs_[i] +
terms  | order     | laws/polygon_gap.h | (surface - z) + (error + => ((surface - z) + error) + (
stages | order     | evaluate.h | round_to_binary32(outcome.x) => round_to_binary32(outcome.z)
stages | order     | laws/bump_2p.h | x < 0 ? -face.sine : face.sine => x < 0 ? face.sine : -face.sine
stages | order     | laws/top_edge.h | -2 * scaled.lo, -scaled.lo => -scaled.lo, -2 * scaled.lo
digest | order     | law.cpp | if (done < whole && together(done, kStep)) done = step; => done = step;
stages | insertion | numbers/double_double.h | const TwoTerms root => if (a.error < 1e-20) return {1, 0, 0}; const TwoTerms root
stages | insertion | numbers/ball.h | const float above = => if (step == 1) continue; const float above =
stages | insertion | laws/bump_cylinder.h | const Outcome<N> wall = => if (x == 0) return cylinder; const Outcome<N> wall =
stages | insertion | domain.h | return __builtin_fabsf(coordinate) >= => return coordinate == 0x1p-40F || __builtin_fabsf(coordinate) >=
digest | insertion | numbers/big_float_ball.h | BigFloatBall root = => if (a.exponent_ == 3) return exactly(2); BigFloatBall root =
digest | comment   | numbers/big_float_ball.h | if (carry == 0) return; => // if (carry == 0) return;
stages | comment   | laws/bump_3p_shaded.h | if (2 * ax > p.width) => if (false)  // 2 * ax > p.width
stages | dropped   | numbers/double_double.h | + a.error * b.error => + 0
stages | dropped   | numbers/double_double.h | kSlack * (propagated + kRelativeError * std::fabs(value.hi)) => kSlack * propagated
stages | dropped   | laws/bump_geometry.h | derivative(widened(x, -40)) => derivative(x)
stages | dropped   | evaluate.h | if (outcome.contact == Sign::unknown) return std::nullopt; =>
digest | dropped   | meshes/rounding_bound.h | 0x1p-53 => 0x1p-54
stages | constant  | numbers/double_double.h | kNewtonSteps = 1; => kNewtonSteps = 2;
stages | constant  | numbers/double_double.h | kRelativeError = 0x1p-101 => kRelativeError = 0x1p-102
stages | constant  | numbers/first_stage.h | kDroppedMask - 2 * kWindow => kDroppedMask - kWindow
stages | constant  | laws/bump_3p.h | kWideLimbs = 64 => kWideLimbs = 32
stages | constant  | laws/outcome.h | N::exactly(0), N::exactly(1) => N::exactly(1), N::exactly(0)
stages | constant  | laws/polygon_gap.h | N::exactly(0.5 * static_cast<double>(width)) - => N::exactly(static_cast<double>(width)) -
rows   | constant  | numbers/big_float_ball.h | larger(remainder, propagated) + 1 => larger(remainder, propagated) + 700
stages | condition | laws/bump_3p_shaded.h | ax <= half_top => ax < half_top
stages | condition | laws/bump_2p_shaded.h | if (2 * ax > p.width) => if (2 * ax >= p.width)
stages | condition | laws/cylinder.h | x != 0 ? Sign::positive => z != 0 ? Sign::positive
"""


def compiled(folder, name):
    """The program of tests/proofs, where it compiles, with the headers of `folder` before those of the source."""
    program = folder / "program"
    includes = [f"-I{folder}", f"-I{source}", f"-I{source}/include", "-isystem", eigen]
    done = subprocess.run([compiler, "-std=c++20", "-O0", "-ffp-contract=off", "-w", *includes, source / "tests/proofs" / name,
                           "-o", program], capture_output=True, text=True)
    return program if done.returncode == 0 else None


def refusal_by_program(folder, name, stored, given=""):
    program = compiled(folder, name)
    if program is None:
        return "not compiled"
    done = subprocess.run([program], input=given, capture_output=True, text=True)
    return "" if done.returncode == 0 and done.stdout == stored else "other output"


def refusal_by_digests(folder):
    return "" if subprocess.run([folder / "proofs/digests.py"], capture_output=True).returncode == 0 else "other digest"


def lines_of(file):
    return [line for line in (source / file).read_text().splitlines() if not line.startswith("#")]


TERMS, STAGES = ((source / "proofs/recorded" / file).read_text() for file in ("Recorded.v", "RecordedStages.v"))
ROWS = "\n".join(lines_of("tests/golden/model_rows.txt")) + "\n"
REFUSAL = {
    "terms": lambda folder: refusal_by_program(folder, "recorded_terms.cpp", TERMS),
    "stages": lambda folder: refusal_by_program(folder, "recorded_stages.cpp", STAGES),
    "rows": lambda folder: refusal_by_program(folder, "model/code_rows.cpp", ROWS, ROWS),
    "digest": refusal_by_digests,
}

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "proofs").mkdir()
    for file in ["proofs/digests.py", "proofs/code.txt"] + [line.split()[0] for line in lines_of("proofs/code.txt")]:
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source / file, folder / file)
    for test, refusal in REFUSAL.items():
        assert refusal(folder) == "", f"{test} refuses the sources without an edit"
    kinds, reasons = {}, {}
    for line in (AUDIT.strip() + FURTHER.rstrip()).splitlines():
        test, kind, file, change = (part.strip() for part in line.split(" | "))
        file = f"proofs/{file}" if file.endswith(".v") else f"fast/{file}"
        old, new = (part.strip() for part in (change + " ").split(" => "))
        text = " ".join((source / file).read_text().split()) if file.endswith(".v") else (source / file).read_text()
        assert text.count(old) >= 1, f"{file} has no {old}"
        planted = folder / file
        was_there = planted.exists()
        planted.parent.mkdir(parents=True, exist_ok=True)
        planted.write_text(text.replace(old, new + "\n" if "//" in new else new, 1))
        reason = REFUSAL[test](folder)
        assert reason != "", f"not refused: {line}"
        print(f"{reason}: {line}", flush=True)
        kinds[kind] = kinds.get(kind, 0) + 1
        reasons[reason] = reasons.get(reason, 0) + 1
        if was_there:
            shutil.copy(source / file, planted)
        else:
            planted.unlink()
for counts in (kinds, reasons):
    print(f"{sum(counts.values())} edits: {', '.join(f'{count} {name}' for name, count in counts.items())}")
