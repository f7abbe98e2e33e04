#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The house's own rules: one law, one basename; two sides that never meet; nothing copyleft near the real-time path; each module stands
on those before it; and each row of the lists of mutants tries something."""

import collections
import re

from tree import CPP, ROOT, device_kinds, expect, files_of, laws, lines_of, modules, name_of, run, text_of, top_folders


def includes_of(text):
    """The text between the <> or "" of every #include, with the < or "."""
    return re.findall(r'^#include *([<"][^>"]*)', text, re.MULTILINE)


def expect_no_include(folders, forbidden, allowed="nothing"):
    for folder in folders:
        found = [include[1:] for path in files_of(folder, kinds=CPP) for include in includes_of(text_of(path))]
        assert found, folder
        for include in found:
            expect(not re.match(forbidden, include) or re.match(allowed, include), f"{folder} includes {include}")


def test_every_law_has_its_file_in_every_folder():
    for _, file in laws():
        for path in ("reference/laws/%.h", "fast/laws/%.h", "fast/laws/%.g", "tests/laws/%_test.cpp", "tests/laws/%.cases"):
            expect((ROOT / path.replace("%", file)).exists(), f"{path} of {file}")


def test_each_source_file_includes_the_header_of_its_name_first():
    """A build with the preset dev thus compiles the header by itself; the others are for tests/headers_test.sh."""
    found = 0
    for folder in ("fast", "files", "rendering", "subjects", "system", "device", "run", "report", "window", "reference", "properties",
                   "certificate", "apps", "clients"):
        for path in files_of(folder, kinds={".cpp"}):
            header = path.with_suffix(".h")
            if header.exists():
                found += 1
                root = ROOT / folder if folder == "clients" else ROOT
                expect(includes_of(text_of(path))[:1] == ['"' + header.relative_to(root).as_posix()], name_of(path))
    assert found > 60


def test_every_kind_of_device_has_a_row_in_the_table_of_what_works_with_it():
    table = re.search(r"^## What works with which device\n.*?(?=^## |\Z)", text_of("docs/device.md"), re.MULTILINE | re.DOTALL)[0]
    for kind in device_kinds():
        expect(f"\n| `{kind}` |" in table, kind)


def test_every_folder_with_a_library_is_a_module():
    """The compiler holds the table of modules; that it holds it everywhere takes a library of each, which is in the table."""
    found = 0
    for top in ROOT.iterdir():
        if top.is_dir() and not top.name.startswith((".", "build", "tests")):
            for path in top.rglob("CMakeLists.txt"):
                folder, libraries = name_of(path.parent), re.findall(r"^forceshade_library\(", text_of(path), re.MULTILINE)
                found += len(libraries)
                expect(not libraries or folder in modules(), f"{folder} is not in cmake/modules.txt")
    assert found > 10


def test_every_command_of_cmake_is_quoted_for_the_shell():
    """A build in a folder with brackets in its name would fail otherwise."""
    commands = [(path, command) for path in ROOT.glob("[a-z]*/**/CMakeLists.txt") if "build" not in name_of(path)
                for command in re.findall(r"^ *add_custom_(?:command|target)\(([^()]* COMMAND [^()]*)\)", text_of(path), re.MULTILINE)]
    assert len(commands) >= 5
    for path, command in commands:
        expect("VERBATIM" in command, f"{name_of(path)}: {command}")


def test_every_module_is_in_the_picture_that_scripts_modules_draws():
    picture = text_of("docs/modules.svg")
    for module in modules():
        if module != "apps" and not module.startswith("tests"):  # they may include everything
            expect(f"<title>{module}</title>" in picture, f"{module}: run scripts/modules")


def public_headers():
    """The lines of cmake/public_headers.txt: header and module."""
    found = dict(line.split(": ") for line in lines_of("cmake/public_headers.txt") if ": " in line and not line.startswith("#"))
    assert len(found) >= 12
    return found


def test_the_public_headers_are_the_files_of_their_folder():
    files = {path.relative_to(ROOT / "include").as_posix() for path in files_of("include")}
    c_interfaces = {"forceshade.h", "forceshade_reference.h"}
    expect(files == {"forceshade/" + header for header in public_headers()} | c_interfaces, f"the headers are {files}")
    for header, module in public_headers().items():
        expect(module in modules(), f"{header}: {module}")


def test_public_headers_include_only_one_another_eigen_and_the_standard_library():
    """An installed program thus needs no other header, and no library but Eigen to compile."""
    known = {'"forceshade/' + header for header in public_headers()} | {"<Eigen/Core"}
    for header in public_headers():
        for include in includes_of(text_of("include/forceshade/" + header)):
            expect(include in known or re.fullmatch("<[a-z_]+", include), f"{header} includes {include}")


def test_each_public_header_begins_with_an_example_and_says_what_is_not_promised():
    for header in public_headers():
        begin = text_of("include/forceshade/" + header).split("\n\n")[0]
        expect("\n//\n//   " in begin and "\n// Not promised: " in begin, header)


def test_the_page_of_the_public_headers_says_what_each_includes_and_needs():
    # The component of the package that each library comes with; a library that none names is always there.
    components = {}
    for component, libraries in re.findall(r"set\(libraries_of_(\w+) ([^)]+)\)", text_of("cmake/install.cmake")):
        components |= dict.fromkeys(libraries.split(), f"`{component}`")
    assert len(components) > 8
    page = text_of("docs/public-headers.md")
    for header, module in public_headers().items():
        includes = includes_of(text_of("include/forceshade/" + header))
        words = [f"`{include[12:]}`" for include in includes if include[0] == '"'] + ["Eigen"] * ("<Eigen/Core" in includes)
        line = re.search(rf"^\| `{re.escape(header)}` \| .*", page, re.MULTILINE)[0]
        expect(f" | {', '.join(words) or '—'} | " in line, f"{line}\nexpected {words}")
        library = re.search(r" \| `forceshade::(\w+)`", line)
        if library:
            expect(line.endswith(f" | {components.get(library[1], 'always there')} |"), line)
            expect("forceshade_" + library[1] in text_of(f"{module}/CMakeLists.txt"), line)
        else:
            expect(module in ("text", "rendering") and line.endswith(" | none | always there |"), line)


NAMES_OF_NO_FILE = {
    "mutant.cpp": "each mutant is generated under this name",
    "mutated.py": "tests of the command write it",
    "stdio.h": "of the standard",
    "math.h": "of the standard",
    "ball.py": "a page has its reader write it",
    "mine.py": "a page has its reader write it",
    "test_mine.py": "a page has its reader write it",
    "_avx2.cpp": "the end of a pattern",
    "_avx512.cpp": "the end of a pattern",
    "_test.cpp": "the end of a pattern",
}


def test_every_file_that_a_comment_or_page_names_exists():
    """A comment that names a file which was moved sends its reader to nothing."""
    word = re.compile(r"[A-Za-z0-9_./-]+\.(?:h|cpp|inl|inc|g|md|sh|py|cases)\b", re.ASCII)
    files = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")]
    files += files_of("cmake", "docs", "scripts", *top_folders())
    names = {path.name for path in files} | {"CHANGELOG.md"}  # it tells of files that are no more, and is not read itself
    found = 0
    for path in files:
        if path.suffix in CPP | {".inc", ".sh", ".py", ".cmake", ".g", ".md"} or path.name == "CMakeLists.txt":
            mark = "" if path.suffix == ".md" else "//" if path.suffix in CPP | {".inc"} else "# "
            for line in lines_of(path):
                for name in word.findall(line.partition(mark)[2] if mark else line):
                    if name not in NAMES_OF_NO_FILE:
                        found += 1
                        places = [ROOT, ROOT / "fast", ROOT / "include", ROOT / "clients", path.parent]
                        there = any((place / name).exists() for place in places) if "/" in name else name in names
                        expect(there, f"{name_of(path)} names {name}")
    assert found > 500


def test_no_file_of_code_has_more_than_400_lines():
    """But for tables and the programs that compute the golden files by themselves. A program in C includes one header, which grows by
    each function of the library."""
    found = 0
    for path in files_of(*top_folders(), kinds=CPP | {".inc", ".sh", ".py", ".cmake"}):
        found += 1
        if name_of(path) != "include/forceshade.h" and not name_of(path).startswith("tests/golden/"):
            expect(text_of(path).count("\n") <= 400, name_of(path))
    assert found > 700


def test_a_comment_begins_with_a_noun_or_a_verb():
    """"Of a face that climbs." and "What is left." send their reader to the code to find the noun."""
    for path in files_of(*top_folders()):
        is_script = path.suffix in {".py", ".sh", ".cmake", ".g"} or path.name == "CMakeLists.txt"
        if is_script or path.suffix in CPP:
            mark = "#" if is_script else "//"
            wrong = rf"^(?! *{mark}).*\n *({mark} (?:What|Where|Whether|How|Who|Which|When|Why|Of) .*)"  # after a line without a comment
            for line in re.findall(wrong, "\n" + text_of(path), re.MULTILINE):
                expect(False, f"{name_of(path)}: {line}")


def test_each_row_of_the_planted_defects_has_a_test_of_its_number():
    """number_7_ is part of the name of the test of row 7, or of a comment above its line of a shell test."""
    tests = "".join(text_of("tests/" + file) for file in ("conformance/planted_defects_test.cpp", "apps/conform_command_test.sh",
                                                          "conformance/planted_simulator_defects_test.cpp"))
    rows = re.findall(r"^\| (\d+) \|", text_of("tests/conformance/planted_defects.md"), re.MULTILINE)
    assert len(rows) == 30
    for row in rows:
        expect(f"number_{row}_" in tests, f"row {row}")


def test_each_test_that_finds_mutants_has_a_name_of_its_own():
    """Test programs, and scripts that are given the command alone."""
    paths = [path for path in files_of("tests", kinds={".cpp", ".sh"}) if path.suffix == ".cpp" or ".sh FORCESHADE:" in text_of(path)]
    for name, count in collections.Counter(path.stem for path in paths if path.stem.endswith("_test")).items():
        expect(count == 1, name)


def test_the_real_time_side_uses_no_library_of_the_exact_one():
    expect_no_include(["fast", "device", "rendering/heights"], "CGAL|mpfr|gmp")
    expect_no_include(["fast", "rendering/heights"], "boost")


def test_devices_take_only_the_sockets_of_boost():
    expect_no_include(["device"], "boost", "boost/asio/|boost/beast/")


def test_the_recorder_takes_only_the_ring_of_boost():
    expect_no_include(["run/recorder"], "CGAL|boost", "boost/lockfree/spsc_queue.hpp$")


def test_no_gpl_part_of_cgal_is_used():
    expect_no_include(["reference", "rendering", "subjects", "report", "run", "properties", "certificate", "window", "apps", "clients",
                       "tests"], "CGAL/(AABB|Polygon_mesh_processing|Surface_mesh|box_intersection_d)")


def test_each_folder_and_module_is_built_before_those_that_use_it():
    """The folders at the top are layers: the table has the modules of each together, and a module includes only its own folder and those
    before it."""
    page, manifest = text_of("CONTRIBUTING.md"), text_of("MANIFEST.in")
    before, folders = set(), []
    for module, used in modules().items():
        folder = module.split("/")[0]
        if folders[-1:] != [folder]:
            expect(folder not in folders, f"{folder} is in two places of the table")
            expect(f"\n| `{folder}/` | " in page, f"CONTRIBUTING.md has no row of {folder}")
            expect(f"\ngraft {folder}\n" in manifest, f"MANIFEST.in lacks {folder}")
            folders.append(folder)
        expect(set(used.split()) <= before | {"*"}, f"{module} includes {set(used.split()) - before}")
        before.add(module)
    assert len(folders) > 12


# Files that ask the system itself, each with the reason.
ASKS_ITSELF = {
    "apps/certify.cpp": "the number of processors, for certification, which no clock judges",
    "apps/certify_plan.cpp": "the same",
    "apps/progress_line.h": "how long each part of a check takes",
    "apps/standard_input.cpp": "waits for a pipe",
    "apps/terminal_attendant.cpp": "waits for a key of the terminal",
    "device/haply/haply_socket.cpp": "waits for a network",
    "device/lasting_words.cpp": "a lock that is held for a moment, and across no step",
    "files/child_process.cpp": "the process of a third-party program",
    "files/keeper.cpp": "the process between this one and a third-party program",
    "files/keeper.h": "the same",
    "files/output_file.cpp": "waits for a pipe",
    "clients/study/command/experiment.cpp": "the number of processors",
    "clients/study/command/experiment_fronts.cpp": "waits for a key of the terminal",
    "clients/study/command/experiment_virtual.cpp": "virtual participants, on all processors",
    "window/glfw_canvas.cpp": "waits for the display",
}


def test_only_system_asks_for_time_waiting_threads_processes_and_luck():
    """What devices, recordings and sessions want of these they ask of system/ alone, so that a simulated world can stand in its place
    (tests/world)."""
    asks = re.compile(r"clock_gettime|_clock::now|(?<!\bsystem::)(?:sleep_for|sleep_until)|nanosleep|usleep|std::j?thread|std::mutex"
                      r"|condition_variable|std::async|\bpoll\(|\bfork\(|waitpid|random_device")
    files = [path for path in files_of("device", "files", "run", "window", "apps", "clients", kinds={".h", ".cpp"})
             if "/tests/" not in name_of(path)]
    asking = {name_of(path) for path in files if asks.search(text_of(path))}
    assert len(files) > 300
    expect(asking == set(ASKS_ITSELF), f"asking the operating system itself, and exceptions without need: {asking ^ set(ASKS_ITSELF)}")


def mutant_rows(name):
    """Lines "file | original => changed", and those that begin with a law, "law | file | original => changed"; \\n in an original is the
    end of a line."""
    for line in lines_of("tests/mutants/" + name):
        if line and line[0] not in "# ":
            row = re.match(r"(?:[^/|]* \| )?([^|]*?) \| (.*?) =>", line)
            expect(row, f"{name}: expected 'file | original => changed', got {line}")
            if row:
                yield line, row[1], row[2].replace("\\n", "\n")


def test_every_row_of_the_lists_of_mutants_matches_one_place():
    """The place is what a row is about: where the code has changed, the row tries nothing."""
    found = 0
    for name in ("mutants.txt", "equivalent.txt"):
        for line, file, original in mutant_rows(name):
            found += 1
            text = text_of(file)
            expect(text.find(original) == text.rfind(original) >= 0, f"{name}: none or several places in {file} read as in {line}")
    assert found > 1000


def test_every_file_of_fast_that_evaluates_height_maps_has_its_mutants():
    """A claim that no change of its code has ever broken is not known to be tested: rows of mutants.txt. Those of other folders than fast/
    and reference/laws/ are generated."""
    # By file without its extension: a header may have its code in a source file.
    mutants = collections.Counter(file.rsplit(".", 1)[0] for _, file, _ in mutant_rows("mutants.txt"))
    found = 0
    for path in files_of("fast", kinds={".h", ".cpp"}):
        is_of_height_maps = path.parent.name == "heights" or path.stem.startswith("height_") or path.stem in ("fraction", "root_field")
        # The others list kinds, or bound them for properties, and evaluate nothing.
        if is_of_height_maps and path.stem not in ("all", "shape", "outline"):
            found += 1
            expect(mutants[name_of(path.with_suffix(""))] >= 2, name_of(path))
    assert found > 15


if __name__ == "__main__":
    run(globals())
