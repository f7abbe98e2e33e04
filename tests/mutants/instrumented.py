"""A copy of the sources in which all mutants are compiled in at once; an environment variable chooses (chosen.h)."""
import collections
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

from copy_of_sources import CORES, ROOT, sources, write_source
from sites import Site, sites_of

FLAGS = "-O1 -DNDEBUG -w -Wno-narrowing"


@dataclasses.dataclass
class Mutant:
    number: int
    site: Site
    changed: str

    def __str__(self):
        site = self.site
        changed = re.sub(r" ?(\.|->|::|\(|\[) ?", r"\1", re.sub(r" ([,;)\]])", r"\1", self.changed)) or "nothing"
        return f"{site.file}:{site.line}: {site.kind}: {site.original} => {changed}"


def overlap(a, b):
    return a.site.file == b.site.file and a.site.begin < b.site.end and b.site.begin < a.site.end


class Tree:
    def __init__(self, root):
        self.root, self.sources, self.build = root, root / "tree", root / "build"

    def configure(self, source, build, *options):
        made = subprocess.run(["cmake", "-G", "Ninja", "-S", source, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
                               f"-DCMAKE_CXX_FLAGS_RELEASE={FLAGS}", "-DFORCESHADE_MUTANTS=OFF", *options], capture_output=True, text=True)
        if made.returncode != 0:
            sys.exit(made.stdout + made.stderr)

    def find(self, wanted):
        """The sites of the wanted files, each from a compilation that reads it."""
        self.configure(ROOT, self.root / "one_by_one", "-DFORCESHADE_UNITE=OFF")
        commands = {}
        for entry in json.loads((self.root / "one_by_one" / "compile_commands.json").read_text()):
            path = pathlib.Path(entry["file"])
            if path.is_relative_to(ROOT) and not path.is_relative_to(self.root):
                commands.setdefault(str(path.relative_to(ROOT)), entry["command"])
        left, found = set(wanted), {}
        while left:
            read_by = {}  # the compilation that each file is looked for in
            for name in sorted(left):
                compilation = name if name in commands else next(
                    (other for other in sorted(commands, key=lambda other: pathlib.Path(other).parts[0] != pathlib.Path(name).parts[0])
                     if f'#include "{name}"' in (ROOT / other).read_text()), None)
                if compilation is not None:
                    read_by.setdefault(compilation, set()).add(name)
            if not read_by:
                break
            with concurrent.futures.ProcessPoolExecutor(CORES) as pool:
                work = {pool.submit(sites_of, arguments_of(commands[compilation]) + [str(ROOT / compilation)], ROOT, left): names
                        for compilation, names in read_by.items()}
                for done in concurrent.futures.as_completed(work):
                    for name, sites in done.result()[0].items():
                        found.setdefault(name, sites)
                    left -= work[done]
            left -= found.keys()
        return found

    def write_mutants(self, found, refused, keeps):
        """Numbers the mutants of the sites (those that `keeps` picks, and no refused one), and writes the sources with them."""
        mutants, number = [], 0
        for path in sources():
            if path not in found:
                write_source(self.sources, path, (ROOT / path).read_bytes())
        for name in sorted(found):
            by_site = collections.defaultdict(list)
            for index, site in enumerate(found[name]):
                for changed in site.changed:
                    number += 1
                    mutant = Mutant(len(mutants), site, changed)
                    if (name, site.begin, site.end, changed) not in refused and keeps(number, site):
                        mutants.append(mutant)
                        by_site[index].append(mutant)
            text = (ROOT / name).read_bytes()
            body = rendered(text, [(found[name][index], by_site[index]) for index in by_site], 0, len(text))
            first, newline, rest = body.partition(b"\n")
            if not first.startswith(b"//"):
                sys.exit(f"{name}:1: expected a comment, in whose place a line can be written")
            write_source(self.sources, name, f'#include "{self.sources}/tests/mutants/chosen.h"'.encode() + newline + rest)
        return mutants

    def compile(self, targets):
        """Builds the targets; returns the lines that the compiler refuses."""
        made = subprocess.run(["ninja", "-C", self.build, "-k", "0", f"-j{CORES}", *targets], text=True, errors="replace",
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        (self.root / "build.log").write_text(made.stdout)
        if made.returncode == 0:
            return set()
        lines = set()
        # A template that is refused inside of a library is named by the line that required it.
        for path, line in re.findall(r"^(\S+?):(\d+):\d+: +(?:(?:fatal )?error:|required from here)", made.stdout, re.M):
            path = pathlib.Path(os.path.join(self.build, path)).resolve()
            if path.is_relative_to(self.sources):
                lines.add((str(path.relative_to(self.sources)), int(line)))
        if not lines:
            sys.exit(f"the build failed: {self.root / 'build.log'}")
        return lines


def arguments_of(command):
    words = shlex.split(command)
    found = []
    for word, following in zip(words, words[1:] + [""]):
        if word.startswith(("-I", "-D", "-std", "-m")):
            found.append(word)
        elif word == "-isystem":
            found += [word, following]
    return found


def rendered(text, sites, begin, end):
    """The text from begin to end with the mutants of the sites inside of it, which come with the outer one first."""
    parts, at, position = [], begin, 0
    while position < len(sites):
        site, mutants = sites[position]
        after = next((i for i in range(position + 1, len(sites)) if sites[i][0].begin >= site.end), len(sites))
        inside = [inner for inner in sites[position + 1:after] if inner[0].end <= site.end]
        parts += [text[at:site.begin], wrapped(site, mutants, rendered(text, inside, site.begin, site.end))]
        at, position = site.end, after
    return b"".join(parts) + text[at:end]


def wrapped(site, mutants, inner):
    if not mutants:
        return inner
    chosen = [f"::forceshade_mutants::chosen({mutant.number})" for mutant in mutants]
    if site.is_statement:
        parts = [f"if ({one}) {{ {mutant.changed}; }} else " for one, mutant in zip(chosen, mutants)]
        return "".join(parts).encode() + b"{ " + inner + b"; }"
    cast = "static_cast<bool>" if site.is_condition else ""  # both sides: a bool would become an optional that has a value
    parts = [f"{one} ? {cast}({mutant.changed}) : " for one, mutant in zip(chosen, mutants)]
    return f"({''.join(parts)}{cast}(".encode() + inner + b"))"
