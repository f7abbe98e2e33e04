#!/usr/bin/env python3
"""weakened_test.py SOURCE [FOLDER]: makes weaker statements of the theorems of proofs/Main.v on calls and on batches, of what is
shown of batches in proofs/code/Walk.v, and of the specification in proofs/spec/Laws.v. proofs/digests.py must refuse each of them, and
pass over comments and line breaks. With FOLDER, in which scripts/proofs left what Coq read, Coq must refuse to take a weaker theorem of
Main.v for the one that this program writes, and with a weaker Laws.v to read restated.v. Exits 77 where FOLDER is given and Coq is not
there."""

import concurrent.futures
import contextlib
import importlib
import io
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

source = pathlib.Path(sys.argv[1])
folder = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
LAWS = (source / "proofs/spec/Laws.v").read_text()
MAIN = (source / "proofs/Main.v").read_text()
NAMES = ["wall", "cylinder", "bump_cylinder", "bump_1p", "bump_2p", "bump_3p", "bump_1p_shaded", "bump_2p_shaded", "bump_3p_shaded"]
PLANES = ("wall", "bump_1p")  # these have no third stage


def parts(law):
    """Quantifiers, hypothesis, answer and exact force of a law's theorem."""
    needed = "stiffness K" if law in PLANES else "parameters R w K"
    machine, arithmetic = ("", "") if law in PLANES else ("(outside : Z -> Z) ", "(of_limbs outside) ")
    numbers = "(value32 K)" if law == "wall" else "(value32 R) (value32 w) (value32 K)"
    return (f"forall {machine}(is_fused : bool) (R w K x y z : binary32), ", needed,
            f"answer (code_of_{law} {arithmetic}is_fused R w K) x y z", f"exact_{law} {numbers}")


def whole(law):
    numbers, needed, answer, exact = parts(law)
    return f"{numbers}{needed} -> right_answer ({answer}) ({exact}) x y z"


def weaker(law, number):
    """Weaker statements of a law's theorem, by what they lack."""
    numbers, needed, answer, exact = parts(law)
    right = f"right_answer ({answer}) ({exact}) x y z"
    lacking = ["value32 x <> 0", "value32 z < -1", "is_finite 24 128 y = true", "in_range y", "value32 K = 1", "is_fused = true", "x = z",
               "value32 R = value32 w", "Rabs (value32 x) <= value32 w"]
    more, other = lacking[number], lacking[(number + 4) % len(lacking)]
    return {
        "a hypothesis more": f"{numbers}{needed} -> {more} -> {right}",
        "a hypothesis in the place of another": f"{numbers}{needed} /\\ {other} -> {right}",
        "one way to multiply and add": f"{numbers}{needed} -> " + right.replace("is_fused", "false"),
        "only in contact": f"{numbers}{needed} -> fst ({answer}) = contact -> {right}",
        "some answer is right": f"{numbers}{needed} -> exists some, right_answer some ({exact}) x y z",
        "or something else": f"{numbers}{needed} -> {right} \\/ fst ({answer}) = invalid",
        "an implication of itself": f"{numbers}{needed} -> {right} -> {right}",
        **({} if law in PLANES else {"exponents of any size": f"{numbers}(forall t, outside t = t) -> {needed} -> {right}"}),
    }


def whole_of_batches(law):
    numbers, needed, answer, _ = parts(law)
    return (f"{numbers.replace(' x y z', '')}{needed} -> batches_agree (form_of_{law} R w K) "
            f"({answer.replace(' x y z', '')})")


def weaker_of_batches(law, number):
    """Weaker statements of the theorem on a law's batches, by what they lack."""
    numbers, agree = whole_of_batches(law).split(" -> batches_agree ")
    agree = "batches_agree " + agree
    more = ["value32 K = 1", "is_fused = true", "value32 R = value32 w", "R = K"][number % 4]
    return {
        "a hypothesis more": f"{numbers} -> {more} -> {agree}",
        "a hypothesis in the place of another": f"{numbers} /\\ {more} -> {agree}",
        "one way to multiply and add": f"{numbers} -> " + agree.replace("is_fused", "false"),
        "some form agrees": f"{numbers} -> exists some, " + agree.replace(f"(form_of_{law} R w K)", "some"),
        "or something else": f"{numbers} -> {agree} \\/ value32 R = value32 w",
        "an implication of itself": f"{numbers} -> {agree} -> {agree}",
    }


# By law: the theorem's name, what it states, weaker statements, and the names that these are about.
def statements(number, law):
    machine = "" if law in PLANES else "outside "
    yield f"{law}_is_correctly_rounded", whole(law), weaker(law, number), f"{machine}is_fused R w K x y z"
    if f"Theorem {law}_batches_agree" in MAIN:
        yield f"{law}_batches_agree", whole_of_batches(law), weaker_of_batches(law, number), f"{machine}is_fused R w K"


# Texts of Walk.v, each with one that says less or something else.
SHOWN = [
    ("forall (set : option instruction_set) (count : nat),", "forall (set : option instruction_set) (count : nat), count < 16 ->"),
    ("forall (set : option instruction_set) (count : nat),", "forall (count : nat), let set := None in"),
    ("(arrays : nat -> nat -> binary32), fx <> fz ->", "(arrays : nat -> nat -> binary32), fx <> fz -> fx <> x ->"),
    ("(forall i, i < count -> exists y, snd (answer i) =", "(forall i, i < count -> fst (answer i) = free -> exists y, snd (answer i) ="),
    ("= (memory after fx i, y, memory after fz i)) /\\", "= (memory after fx i, y, y)) /\\"),
    ("    (forall a i, count <= i \\/ a <> fx /\\ a <> fz -> memory after a i = arrays a i) /\\\n", ""),
    ("    (forall a i, count <= i \\/ a <> forces -> memory after a i = arrays a i) /\\\n", ""),
    ("    (forall i, i < count -> memory after forces i = snd (answer i)) /\\\n", ""),
    ("let answer i := let '(x, y, z) := arrays positions i in one x y z in",
     "let answer i := let '(x, y, z) := arrays positions i in one x x z in"),
    ("done + 16) in", "done + 1) in"),
    ("if is_in_place && negb answered then s", "if negb answered then s"),
]

# Texts of Laws.v, each with one that says less or something else.
SPECIFICATION = [
    ("/ 1000 <= value32 K <= 1000.\nDefinition parameters", "/ 1000 <= value32 K <= 100.\nDefinition parameters"),
    ("Definition stiffness (K : binary32) : Prop := is", "Definition stiffness (K : binary32) : Prop := value32 K <> 1 /\\ is"),
    ("/ 10 <= value32 R <= 10000 /\\", "1 <= value32 R <= 10000 /\\"),
    ("/ 10 <= value32 R <= 10000 /\\", "/ 10 <= value32 R < 10000 /\\"),
    ("/ 1000 <= value32 w <= 2 * value32 R /\\", "/ 1000 <= value32 w < 2 * value32 R /\\"),
    ("/ 1000 <= value32 w <= 2 * value32 R /\\", "/ 1000 < value32 w <= 2 * value32 R /\\"),
    ("/\\ / 1000 <= value32 K <= 1000.\n\n", "/\\ / 100 <= value32 K <= 1000.\n\n"),
    ("/\\ / 1000 <= value32 K <= 1000.\n\n", "/\\ / 1000 <= value32 K <= 1000 /\\ K <> R.\n\n"),
    ("Rabs (value32 x) <= 10000.", "Rabs (value32 x) <= 1000."),
    ("Rabs (value32 x) <= 10000.", "Rabs (value32 x) < 10000."),
    ("Rabs (value32 x) <= 10000.", "Rabs (value32 x) <= 20000."),
    ("is_finite 24 128 x = true /\\ Rabs (value32 x)", "Rabs (value32 x)"),
    ("bpow radix2 (-30)", "bpow radix2 (-20)"),
    ("if Rle_bool (bpow radix2 (-30)) (Rabs x) then x else 0", "x"),
    ("(round radix2 fexp32 ZnearestE)", "(round radix2 fexp32 Zfloor)"),
    ("(round radix2 fexp32 ZnearestE)", "(round radix2 fexp32 ZnearestA)"),
    ("(FLT_exp (-149) 24)", "(FLT_exp (-149) 23)"),
    ("(FLT_exp (-149) 24)", "(FLT_exp (-126) 24)"),
    ("(FLT_exp (-149) 24)", "(FLX_exp 24)"),
    ("value32 answer = nearest32 exact /\\", "Rabs (value32 answer - exact) <= ulp radix2 fexp32 exact /\\"),
    ("value32 answer = nearest32 exact /\\ ", ""),
    ("is_finite 24 128 answer = true /\\ (nearest32", "(nearest32"),
    (" /\\ (nearest32 exact = 0 -> answer = zero32)", ""),
    (" /\\ is_nearest32 fx Fx /\\", " /\\"),
    (" /\\ is_nearest32 fz Fz", ""),
    ("exists fx fz, answer = (contact, (fx, zero32, fz))", "exists fx fy fz, answer = (contact, (fx, fy, fz))"),
    ("exists fx fz, answer = (contact, (fx, zero32, fz))", "exists status fx fz, answer = (status, (fx, zero32, fz))"),
    ("~ touches /\\ answer = no_force free \\/", "answer = no_force free \\/"),
    ("  touches /\\ exists", "  exists"),
    ("~ touches /\\ answer = no_force free \\/", "~ touches \\/"),
    (" /\\\n  (~ (in_range x /\\ in_range y /\\ in_range z) -> answer = no_force invalid)", ""),
    ("-> answer = no_force invalid)", "-> fst answer = invalid)"),
    ("(in_range x /\\ in_range y /\\ in_range z -> is_answer", "(in_range x /\\ in_range y /\\ in_range z /\\ x <> z -> is_answer"),
    ("let exact := law (read (value32 x)) (read (value32 z)) in", "let exact := law (value32 x) (value32 z) in"),
    ("Notation zero32 := (B754_zero 24 128 false)", "Notation zero32 := (B754_zero 24 128 true)"),
    ("Rsqr Rad - Rsqr (w / 2)", "Rsqr Rad - Rsqr w"),
    ("2 / 3 * asin", "1 / 3 * asin"),
    ("if Rle_bool (Rabs X) (top_width Rad w / 2) then 0", "if Rlt_bool (Rabs X) (top_width Rad w / 2) then 0"),
    ("(if Rlt_bool X 0 then - sine_of", "(if Rle_bool X 0 then - sine_of"),
    ("exact_x := Fx; exact_z := Fz", "exact_x := 0; exact_z := Fz"),
    ("exact_wall (K X Z : R) := force (Z < 0)", "exact_wall (K X Z : R) := force (Z <= 0)"),
    ("force (distance_from_axis Rad w X Z < Rad) (", "force (0 < distance_from_axis Rad w X Z < Rad) ("),
    ("Rad w X Z < Rad \\/ Z < 0)", "Rad w X Z < Rad)"),
    ("+ Rmax (- K * Z) 0)", "+ - K * Z)"),
    ("exact_bump_1p (Rad w K X Z : R) := force (Z < 0) 0", "exact_bump_1p (Rad w K X Z : R) := force False 0"),
    ("let M := penetration_2p Rad w X Z in\n", "let M := - Z in\n"),
    ("let M := penetration_3p Rad w X Z in force (0 < M) (shaded_x", "let M := penetration_3p Rad w X Z in force (0 < M) (side_x"),
    ("exact_bump_1p_shaded (Rad w K X Z : R) := force (Z < 0)", "exact_bump_1p_shaded (Rad w K X Z : R) := force (X < 0)"),
]



def changed(text, old, new):
    assert text.count(old) == 1, f"expected once in a file of statements, got {text.count(old)} times: {old}"
    return text.replace(old, new)


def without_coq(root):
    """The digests refuse every weaker text, and no other comment and line break."""
    listed = [line.split() for line in (source / "proofs/code.txt").read_text().splitlines() if line.startswith("proofs/")]
    for name in ["proofs/digests.py"] + [line[0] for line in listed]:
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source / name, root / name)
    (root / "proofs/code.txt").write_text("".join(" ".join(line) + "\n" for line in listed))
    sys.path.insert(0, str(root / "proofs"))
    digests = importlib.import_module("digests")
    sys.argv[1:] = []

    def refused(file, text):
        kept = (root / file).read_text()
        assert text != kept, file
        (root / file).write_text(text)
        found = digests.changed([" ".join(line) for line in listed if line[0] == file])
        (root / file).write_text(kept)
        return bool(found)

    def says():
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            code = digests.main()
        return code, printed.getvalue()

    assert says() == (0, "")
    (root / "proofs/spec/Laws.v").write_text(changed(LAWS, *SPECIFICATION[0]))
    assert says() == (1, "proofs/spec/Laws.v does not state what a person has read: does it say less? Then\n"
                         "  proofs/digests.py --renew proofs/spec/Laws.v\n")
    (root / "proofs/spec/Laws.v").write_text(LAWS)

    for file in (source / "proofs/spec").iterdir():  # a specification is made of nothing that is proved here
        text = file.read_text()
        imported = re.findall(r"^(?:From (\w+) )?Require.*$|^From (\w+)", text, re.MULTILINE)
        assert {first or second for first, second in imported} == {"Coq", "Flocq"} and "Proof" not in text, (file, imported)
    tried = 0
    for number, law in enumerate(NAMES):
        for name, text, weak_ones, _ in statements(number, law):
            statement = re.search(rf"Theorem {name} : (.*?)\.\nProof", MAIN, re.DOTALL)
            assert " ".join(statement[1].split()) == text, f"expected of proofs/Main.v: {text}"
            assert re.match(r"\.\s+exact \([^.]*\)\.\s+Qed\.\n", MAIN[statement.end():]), name
            for what, weak in weak_ones.items():
                assert refused("proofs/Main.v", MAIN.replace(statement[1], weak)), (name, what)
                tried += 1
    walk = (source / "proofs/code/Walk.v").read_text()
    for old, new in SHOWN:
        assert refused("proofs/code/Walk.v", changed(walk, old, new)), new
        tried += 1
    for old, new in SPECIFICATION:
        assert refused("proofs/spec/Laws.v", changed(LAWS, old, new)), new
        tried += 1
    assert refused("proofs/Main.v", changed(MAIN, "\n\nTheorem wall_is", "\n\nNotation parameters R w K := (K = R).\n\nTheorem wall_is"))
    assert refused("proofs/code/Code.v", (source / "proofs/code/Code.v").read_text().replace("curved (members_of", "plane (members_of", 1))
    assert refused("proofs/Main.v", MAIN.replace("(of_limbs outside)", "of_integers"))
    limbs = 0
    for file, *names, _ in listed:  # the definitions of limbs, and recorded laws
        text = (root / file).read_text()
        for name in names if names != ["*"] else []:
            defined = re.search(rf"((Definition|Fixpoint) {name} .*?:=|Theorem {name} :) ?", text, re.DOTALL).end()
            assert refused(file, text[:defined] + " id " + text[defined:]), name
            assert not refused(file, text + "Lemma another : True. Proof. exact I. Qed.\n"), file
            limbs += 1
    for file, text in (("proofs/spec/Laws.v", LAWS), ("proofs/Main.v", MAIN)):
        assert not refused(file, text.replace("\n\n", "\n\n(* A (* nested *) remark. *)\n").replace(" ->", "\n  ->")), file
    return tried + 3 + limbs


def coqc(where, file, text, *paths):
    (where / file).write_text(text)
    return subprocess.run(["coqc", *paths, file], cwd=where, capture_output=True, text=True)


def with_coq(root):
    """Coq refuses every weaker statement in the place of the whole one."""
    text = re.search(r"^From Flocq.*?\n\n", MAIN, re.DOTALL | re.MULTILINE)[0]
    text += "From Coq Require Import ZArith Reals.\nFrom Forceshade Require Import ThirdStages Batch Walk Main.\nOpen Scope R_scope.\n"
    for number, law in enumerate(NAMES):
        for name, stated, _, _ in statements(number, law):
            text += f"Check ({name} : {stated}).\n"
    # From here on the code is any code, so that Coq need not look into it.
    text += "Section AnyCode.\n"
    for law in NAMES:
        arithmetic = "" if law in PLANES else "forall {number : Type}, (nat -> arithmetic number) -> "
        text += f"Variable code_of_{law} : {arithmetic}bool -> binary32 -> binary32 -> binary32 -> code.\n"
        text += f"Variable form_of_{law} : binary32 -> binary32 -> binary32 -> form.\n"
    tried = 0
    for number, law in enumerate(NAMES):
        for _, stated, weak_ones, names in statements(number, law):
            for weak in weak_ones.values():
                # It follows from the whole statement, which does not follow from it.
                text += (f"Goal ({stated}) -> ({weak}).\nProof.\n  intros whole {names}; intros.\n"
                         f"  first [now apply whole | left; now apply whole | eexists; now apply (whole {names})\n"
                         f"    | apply whole; tauto].\nQed.\nFail Definition taken (weak : {weak}) : {stated} := weak.\n")
                tried += 1
    text += "End AnyCode.\n"
    done = coqc(root, "Weakened.v", text, "-R", folder.resolve(), "Forceshade")
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr

    restated = (source / "tests/proofs/restated.v").read_text()

    def takes(laws):
        with tempfile.TemporaryDirectory(dir=root) as own:
            read = coqc(pathlib.Path(own), "Laws.v", laws, "-R", ".", "Forceshade")
            assert read.returncode == 0, read.stderr
            return coqc(pathlib.Path(own), "Restated.v", restated, "-R", ".", "Forceshade").returncode == 0

    assert takes(LAWS)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for (_, new), taken in zip(SPECIFICATION, pool.map(lambda each: takes(changed(LAWS, *each)), SPECIFICATION)):
            assert not taken, new
    return tried + len(SPECIFICATION)


def main():
    if folder and not shutil.which("coqc"):
        print("skipped: coqc is not installed (Debian packages coq and libcoq-flocq)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as made:
        print(f"refused: {with_coq(pathlib.Path(made)) if folder else without_coq(pathlib.Path(made))} weaker statements")


main()
