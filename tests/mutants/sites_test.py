# SPDX-License-Identifier: BSD-3-Clause
"""sites_test.py: the faults that scripts/generated_mutants makes of a few lines, and that their text with all mutants compiles and
runs with one chosen. Exit code 77 where Python's module of clang is not there."""
import pathlib
import subprocess
import sys
import tempfile

try:
    import clang.cindex  # noqa: F401
except ImportError:
    print("skipped: python3-clang-14 is not installed")
    sys.exit(77)
from instrumented import Mutant, rendered
from listed import listed_sites
from sites import sites_of

TEXT = """// A comment, in whose place the switch is included.
#include <algorithm>
#include <cstdio>
enum class Place { before, behind };
constexpr int kRoom = 3;
static_assert(kRoom < 4);
template <int N> int twice(int a) { return N * a; }
int count = 0;
int room(int used, bool is_open) {
  if (!is_open || used >= kRoom) return std::max(used - kRoom, 0);
  count += twice<2>(used);
  for (int i = 0; i < 2; ++i) {
    if (i == 1) continue;
    ++count;
  }
  return is_open ? kRoom - used : -used;
}
Place place(int a) { return a < 0 ? Place::before : Place::behind; }
#include <optional>
struct Row { int number; bool operator==(const Row&) const = default; };
void sit(std::optional<int> seat) { if (!seat || *seat > 1) count += 1; }
bool is_elsewhere(Row a, Row b) { return a != b; }
int main() {
  sit(1);
  int first = room(1, true), second = room(5, true), third = static_cast<int>(place(2));
  std::printf("%d %d %d %d\\n", first, second, count, third);
}
"""
EXPECTED = {  # line: what may stand there
    10: {"false", "true", "( ! is_open ) && ( used >= kRoom )", "! is_open", "used >= kRoom", "is_open", "( used ) > ( kRoom )",
         "( used ) < ( kRoom )", "kRoom + 1", "std :: min ( used - kRoom , 0 )", "( used ) + ( kRoom )", "used", "1"},
    11: {"", "count -= twice < 2 > ( used )"},
    12: {"1", "( i ) <= ( 2 )", "( i ) > ( 2 )", "3"},
    13: {"false", "true", "( i ) != ( 1 )", "2"},
    14: {""},
    16: {"false", "true", "( kRoom ) + ( used )", "kRoom", "kRoom + 1", "used"},
    18: {"false", "true", "( a ) <= ( 0 )", "( a ) > ( 0 )", "1", "Place :: behind", "Place :: before"},
    21: {"false", "true", "( ! seat ) && ( * seat > 1 )", "! seat", "* seat > 1", "seat", "( * seat ) >= ( 1 )", "( * seat ) < ( 1 )", "2"},
    22: {"( a ) == ( b )"},
}

LISTED = """# file | original => changed
room.cpp | ++count; =>
room.cpp | a < 0 => a <= 0
room.cpp | if («i == 1») continue => i == 0
"""

with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name).resolve()
    (folder / "room.cpp").write_text(TEXT)
    found, errors = sites_of(["-std=c++20", str(folder / "room.cpp")], folder, ["room.cpp"])
    assert not errors, errors
    by_line = {}
    for site in found["room.cpp"]:
        by_line.setdefault(site.line, set()).update(site.changed)
    for line, expected in EXPECTED.items():
        assert by_line.get(line) == expected, f"line {line}: expected {expected}, got {by_line.get(line)}"
    assert not by_line.keys() & {4, 5, 6}, "what the compiler computes is no site"

    mutants, sites = [], []
    for site in found["room.cpp"]:
        own = [Mutant(len(mutants) + i, site, changed) for i, changed in enumerate(site.changed)]
        mutants += own
        sites.append((site, own))
    body = rendered(TEXT.encode(), sites, 0, len(TEXT)).split(b"\n", 1)[1]
    switch = pathlib.Path(__file__).parent / "chosen.h"
    (folder / "all.cpp").write_bytes(f'#include "{switch}"\n'.encode() + body)
    subprocess.run([sys.argv[1], "-std=c++20", "-w", folder / "all.cpp", "-o", folder / "all"], check=True)

    def printed(**chosen):
        active = bytearray(len(mutants))
        for mutant in chosen.get("active", ()):
            active[mutant.number] = 1
        (folder / "active").write_bytes(active)
        (folder / "reached").write_bytes(bytes(len(mutants)))
        ran = subprocess.run([folder / "all"], check=True, capture_output=True, text=True,
                             env={"FORCESHADE_MUTANTS": str(folder / "active"), "FORCESHADE_REACHED": str(folder / "reached")})
        return ran.stdout, (folder / "reached").read_bytes()

    usual, reached = printed()
    assert usual == "2 2 3 1\n", usual
    one = {(mutant.site.line, mutant.changed): mutant for mutant in mutants}
    assert printed(active=[one[11, ""]])[0] == "2 2 1 1\n"
    assert printed(active=[one[21, "seat"]])[0] == "2 2 4 1\n"
    assert printed(active=[one[10, "std :: min ( used - kRoom , 0 )"]])[0] == "2 0 3 1\n"
    assert printed(active=[one[18, "( a ) > ( 0 )"], one[14, ""]])[0] == "2 2 2 0\n"
    assert reached[one[11, ""].number] == 1 and reached[one[16, "used"].number] == 0

    listed = listed_sites(LISTED, folder)["room.cpp"]
    of_list = [(site, [Mutant(number, site, site.changed[0])]) for number, site in enumerate(listed)]
    assert [(site.line, site.original, site.is_statement) for site in listed] == [(13, "i == 1", False), (14, "++count", True),
                                                                                  (18, "a < 0", False)], listed
    text = rendered(TEXT.encode(), of_list, 0, len(TEXT)).decode()
    chosen = "::forceshade_mutants::chosen"
    for changed in (f"({chosen}(0) ? (i == 0) : (i == 1))", f"if ({chosen}(1)) {{ ; }} else {{ ++count; }};",
                    f"({chosen}(2) ? (a <= 0) : (a < 0))"):
        assert changed in text, text
    for wrong in ("room.cpp | used => 1", "room.cpp | unused => 1"):
        try:
            listed_sites(wrong, folder)
        except ValueError as error:
            assert "exactly one place" in str(error), error
        else:
            raise AssertionError(f"{wrong}: expected to be refused")
