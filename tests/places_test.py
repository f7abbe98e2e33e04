#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the tables of CONTRIBUTING.md: where a law, a kind of height map, a shading scheme, a contact rule or a device is added, and
that nothing beside these places has to be extended; and that no line is wider than a page."""

import re

from tree import CPP, ROOT, device_kinds, expect, files_of, laws, lines_of, name_of, run, text_of, top_folders

CHOSEN = "it tests chosen laws and numbers, while loops over kLaws test every law"
FIGURES, STIMULI = "the thesis's own figures", "the stimuli of the thesis's two experiments"
IN_WORDS = "the C header names them for its readers; no code of the interface does"
IN_BROWSERS = "a client: a browser offers the laws that it names, and its tests hold that these are all"
MAPS = "it tests chosen maps, while height_kinds.h and any_height_map() bring every kind"
SOME = "it tests what the schemes that it names have; mesh_subject_test.cpp runs every scheme"
CHOSEN_RULES = "it tests chosen rules, while mesh_subject_test.cpp runs every rule"
# Files that name most of a sort, and why none has to be added there.
OF_LAWS = {
    "include/forceshade.h": IN_WORDS,
    "clients/study/analysis/thesis.cpp": STIMULI,
    "clients/web/interface.js": IN_BROWSERS,
    "clients/web/package/forceshade.d.ts": IN_BROWSERS,
    "clients/web/page/bump.js": IN_BROWSERS,
    "clients/study/tests/analysis/psychometric_test.cpp": STIMULI,
    "clients/study/tests/analysis/simulated.h": STIMULI,
    "clients/study/tests/analysis/thesis_numbers_test.cpp": STIMULI,
    "clients/study/tests/experiments/virtual_fit.cpp": STIMULI,
    "report/figures.cpp": FIGURES,
    "report/thesis_figures.cpp": FIGURES,
    "tests/certificate/refusal_test.cpp": CHOSEN,
    "tests/certificate/sweep_test.cpp": CHOSEN,
    "tests/fast/batch_doubt_test.cpp": "what each form leaves to later stages; a new form has a hazard of its own or none",
    "tests/fast/separation_test.cpp": "the separations of docs/proofs.md, law by law; it fails for a law without one",
    "tests/proofs/model/positions.py": "the laws that Coq has read",
    "tests/hard_cases/search.cpp": "extra places to aim at; it searches every law",
    "tests/properties/properties_test.cpp": CHOSEN,
    "tests/properties/witness_test.cpp": CHOSEN,
    "tests/properties/work_test.cpp": CHOSEN,
    "tests/reference/energy_test.cpp": "energies known in closed form",
    "tests/report/report_words_test.cpp": CHOSEN,
}
OF_KINDS = {
    "tests/bindings/python/test_objects.py": MAPS,
    "tests/certificate/height_certificate_test.cpp": MAPS,
    "tests/fast/height_bounds_test.cpp": "the kinds that reach farthest; a loop compares every kind with them",
    "tests/height_maps/height_exact_test.cpp": MAPS,
    "tests/height_maps/height_map_field_test.cpp": MAPS,
    "tests/height_maps/height_scenes.h": "sums of chosen kinds beside a scene of every kind",
    "tests/heights/height_spec_test.cpp": "texts of TOML files; every kind is read by the same lines",
    "tests/properties/height_properties_test.cpp": MAPS,
    "tests/reference/height_energy_test.cpp": MAPS,
    "tests/reference/height_reference_test.cpp": MAPS,
    "tests/report/side_view_test.cpp": MAPS,
}
OF_SCHEMES = {
    "include/forceshade.h": IN_WORDS,
    "tests/bench/mesh_bench.cpp": "the schemes that are timed",
    "bindings/python/forceshade/_subjects.py": "their words for readers; the type is any text, as texture:FILE needs",
    "clients/web/package/forceshade.d.ts": "a client: the schemes of JavaScript",
    "clients/web/page/page.js": "a client: the schemes of the page",
    "clients/web/tests/page_test.js": "a client: the schemes of the page",
    "properties/mesh_subject.cpp": "what only one scheme has: a turn that is bounded, a texture to draw",
    "tests/bindings/python/test_misuse.py": SOME,
    "tests/bindings/python/test_soups.py": SOME,
    "tests/fast/same_bits_meshes.h": "the schemes of the stored hashes",
    "tests/meshes/mesh_contract_test.cpp": SOME,
    "tests/meshes/random_paths.h": "the places of a state, two of which are called as schemes are",
    "tests/meshes/texture_scheme_test.cpp": SOME,
    "tests/subjects/scene_file_test.cpp": SOME,
}
OF_RULES = {
    "include/forceshade.h": IN_WORDS,
    "properties/mesh_properties.cpp": "what only one rule has: a goal beside the position, a drag beside the shading",
    "tests/bench/friction_bench.cpp": "the rules that are timed",
    "clients/web/package/forceshade.d.ts": "a client: the rules of JavaScript",
    "tests/bindings/c_materials_test.cpp": CHOSEN_RULES,
    "tests/bindings/python/test_package.py": CHOSEN_RULES,
    "tests/conformance/hello_test.cpp": CHOSEN_RULES,
    "tests/meshes/god_object_golden_test.cpp": "the rules of the stored paths",
    "tests/meshes/friction_test.cpp": CHOSEN_RULES,
    "tests/subjects/materials_test.cpp": CHOSEN_RULES,
    "tests/subjects/scene_file_test.cpp": CHOSEN_RULES,
}


class Sort:
    """A sort of thing that is added now and then, and the table of CONTRIBUTING.md that says where.

    pattern: of a file's name in the table. scope: before that name, in code. ending: of file and type beside the name: vertex_scheme of the
    name vertex."""

    def __init__(self, heading, pattern, scope, most_places, names, exceptions, ending=""):
        self.heading, self.pattern, self.most_places, self.exceptions = heading, pattern, most_places, exceptions
        self.names = names
        full = {name: name + ending for name in names}
        self.files = {name: full[name].replace("-", "_") for name in names}  # bump_2p of bump-2p
        types = {name: "".join(part[:1].upper() + part[1:] for part in full[name].split("-")) for name in names}  # Bump2p
        # bump-1p is no part of bump-1p-shaded.
        word = r"(?<![\w-])(?:{})(?![\w-])"
        self.in_text = {name: re.compile(word.format(f"{file}|{name}|{full[name].replace('-', ' ')}|{types[name]}"), re.ASCII)
                        for name, file in self.files.items()}
        code = word + r'|"{}"|/{}\.h"'
        self.in_code = {name: re.compile(code.format(f"{types[name]}|{scope}{file}", name, file), re.ASCII)
                        for name, file in self.files.items()}
        self.parts = {name: {types[name], scope + file, name, file + ".h"} for name, file in self.files.items()}

    def places(self):
        """The numbered places of the table."""
        below = text_of("CONTRIBUTING.md").split(f"\n{self.heading}\n")[1].split("\n## ")[0]
        rows = re.findall(r"^\| (\d+) \|(.*)", below, re.MULTILINE)
        found = [re.match(r" `([^`]*)` \|", rest) for _, rest in rows]
        assert [int(number) for number, _ in rows] == list(range(1, len(rows) + 1)) and all(found), f"one place in a row: {rows}"
        return [place[1] for place in found]

    def is_in(self, code, name):
        return any(part in code for part in self.parts[name]) and bool(self.in_code[name].search(code))  # most have no part of it

    def files_of(self, place):
        """The files that a place stands for: one, or one of each."""
        return [place.replace(self.pattern, file, 1) for file in self.files.values()] if self.pattern in place else [place]


def names_in(header, table):
    """The texts of a table in include/forceshade/."""
    return re.findall(r'"([\w-]+)"', re.search(table + r"\{([^}]*)\}", text_of("include/forceshade/" + header))[1])


def height_map_kinds():
    text = text_of("include/forceshade/height_map.h")
    kinds = re.findall(r'std::string_view kName = "([\w-]+)";', text)
    assert len(kinds) == text.count("kName") - 1, "one for each, and their list"
    return kinds


SORTS = [
    Sort("## Adding a law", "<law>", "LawId::", 15, [name for name, _ in laws()], OF_LAWS),
    Sort("## Adding a kind of height map", "<kind>", "LawId::", 8,
         height_map_kinds(), OF_KINDS),
    Sort("## Adding a shading scheme", "<scheme>", "Shading::", 10,
         [name for name in names_in("mesh.h", "kShadingNames") if name != "none"], OF_SCHEMES, "-scheme"),
    Sort("## Adding a contact rule", "<rule>", "Contact::", 11, names_in("mesh.h", "kContactNames"), OF_RULES),
    Sort("## Adding a device", "<kind>", "LawId::", 2, device_kinds(), {}),
]


def test_the_tables_of_contributing_name_as_few_places_as_they_may():
    for sort in SORTS:
        places = sort.places()
        expect(len(sort.names) > 2 and sort.most_places // 2 <= len(places) <= sort.most_places, f"{sort.heading}: {len(places)}")
        expect(len(set(places)) == len(places), sort.heading)


def test_everything_is_in_every_place_of_its_table():
    for sort in SORTS:
        for place in sort.places():
            for file in sort.files_of(place):
                expect((ROOT / file).is_file(), file)
            if sort.pattern not in place:
                for name in sort.names:
                    expect(sort.in_text[name].search(text_of(place)), f"{place} lacks {name}")


def test_no_file_beside_the_tables_has_to_be_extended():
    """A file that names more than half of a sort is a list, a switch or a set of overloads, which one more would have to be added to. By
    its type, its id, its name as a text or its header; comments left out."""
    files = files_of(*top_folders(), kinds=CPP | {".inc", ".py", ".pyi", ".js", ".mjs", ".ts"})
    codes = {name_of(path): re.sub("//.*", "", text_of(path)) for path in files}
    assert len(codes) > 400
    for sort in SORTS:
        places = {file for place in sort.places() for file in sort.files_of(place)}
        unused = dict(sort.exceptions)
        for file, code in codes.items():
            named, count = sum(sort.is_in(code, name) for name in sort.names), len(sort.names)
            # An exception stays one down to a third, so that it does not end with the next law.
            if 3 * named > count and file not in places and unused.pop(file, None) is None:
                expect(2 * named <= count, f"{file} names {named} of {count}, and is not in {sort.heading}")
        for file, reason in unused.items():
            expect(False, f"{file} is no exception any more: {reason}")


def test_no_line_of_code_has_more_than_140_columns():
    """But in the output of a program, and in tests of the command and of clients, where a line is one call with what is expected of it."""
    kinds = CPP | {".c", ".g", ".v", ".pml", ".py", ".pyi", ".sh", ".js", ".mjs"}
    files = [path for path in files_of("scripts", "proofs", *top_folders())
             if (path.suffix in kinds or path.parent == ROOT / "scripts" and not path.suffix)
             and not name_of(path).startswith(("proofs/recorded/Recorded.v", "clients/", "tests/apps/"))]
    assert len(files) > 1500
    for path in files:
        for number, line in enumerate(lines_of(path), 1):
            expect(len(line) <= 140, f"{name_of(path)}:{number}")


if __name__ == "__main__":
    run(globals())
