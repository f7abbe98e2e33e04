"""Faults that a list names, for scripts/generated_mutants --listed.

A line is `file | original => changed`, as in mutants.txt. The original stands in the file exactly once, and is a whole expression, or a
statement where it ends in a semicolon, which changes to nothing where it is left out. In a longer text « and » mark it, where it
stands there more than once.
"""
from sites import Site

MARKS = "«", "»"


def site_of(name, text, original, changed):
    """The place of one change; throws ValueError where there is no such place, or more than one."""
    before, old, _ = original.replace(MARKS[1], MARKS[0]).split(MARKS[0]) if MARKS[0] in original else ("", original, "")
    whole = original.replace(MARKS[0], "").replace(MARKS[1], "").encode()
    if text.count(whole) != 1:
        raise ValueError(f"{name}: expected exactly one place that reads: {original}")
    begin = text.index(whole) + len(before.encode())
    is_statement = old.endswith(";")
    end = begin + len(old.encode()) - is_statement
    line = text.count(b"\n", 0, begin) + 1
    shown = " ".join(old.removesuffix(";").split())
    return Site(name, line, line + old.count("\n"), begin, end, is_statement, shown, [changed.removesuffix(";")], "listed")


def listed_sites(list_of_faults, root):
    """The sites of the faults of a text, by file, as Tree.write_mutants() takes them."""
    found = {}
    for line in list_of_faults.splitlines():
        if not line or line.startswith("#"):
            continue
        name, _, change = line.partition(" | ")
        original, _, changed = (part.replace("\\n", "\n") for part in change.partition(" =>"))
        site = site_of(name, (root / name).read_bytes(), original, changed.removeprefix(" "))
        sites = found.setdefault(name, [])
        same = next((other for other in sites if (other.begin, other.end) == (site.begin, site.end)), None)
        if same:
            same.changed += site.changed
        else:
            sites.append(site)
    return {name: sorted(sites, key=lambda site: (site.begin, -site.end)) for name, sites in found.items()}
