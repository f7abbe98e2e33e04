#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes soups/: sets of triangles of any kind, paths on them, and what the god-object of docs/soups.md does on these paths.

Usage: make_soup_golden.py                       writes the soups that this program makes
       make_soup_golden.py --check [ticks [name ...]]
           computes the stored paths again, of each the first ticks, and compares every column
       make_soup_golden.py --compare directory [name ...]
           the same for a folder in the form of god_object/ (NAME.off, NAME.normals.csv, NAME.csv, and a table in meshes.csv or README.md)
       make_soup_golden.py --take directory ticks
           the same, and stores the first ticks of each path

Decisions are signs of integers and of rationals in soup_cells.py, soup_places.py and soup_tick.py, which share no decision with the
programs of meshes; soup_force.py has the forces. A stored path is one text: `sides` and a letter for each triangle, f (front) or b
(both); vertices (v) and triangles (t, with the normals of the three corners, or one for all); then a line for each tick: x, y, z, the
moves, with u after them if the tick is unfinished, or i for an invalid position; the place and the cell; the force, and the shaded
force where it is another. What is left out at the end of a line is free, 0 or the same.
"""

import csv
import re
import sys
from fractions import Fraction
from pathlib import Path

from make_god_object_golden import COLUMNS, Mesh, corner_normals, from_text, listed, read_off, shortest
from soup_force import forces
from soup_places import in_units
from soup_scenes import scenes
from soup_tick import Soup

FOLDER = Path(__file__).parent / 'soups'


# ---------------------------------------------------------------- rows

def name_of_cell(soup, state):
    x, _, (i, back, number) = state
    words = ['back' if back else 'front']
    if number or i != min(soup.near(x).cones):
        words += [str(i)] + ([str(number)] if number else [])
    return ' '.join(words)


def follow(soup, positions):
    """The rows of a path, in the columns of god_object/."""
    state = None
    for position in positions:
        moves, values = 0, [0.0] * 6
        if all(abs(c) <= 1e4 for c in position):  # false for NaN too
            p = (*in_units(position), 1)
            state, status, moves, rest = soup.tick(state, p)
            values = forces(soup, rest, p)
        else:
            status = 'invalid'
        is_off = state is None or state[1] is None
        where = ('-', '-') if is_off else (' '.join(map(str, state[1])), name_of_cell(soup, state))
        yield [*map(shortest, position), status, *where, str(moves), *map(shortest, values)]


def compact(row):
    x, y, z, status, feature, side, moves, *values = row
    if status == 'invalid':
        return f'{x} {y} {z},i'
    text = f'{x} {y} {z},{moves}' + ('u' if status == 'unfinished' else '')
    if status == 'free':
        return text
    text += f',{feature},{side.replace("front", "f").replace("back", "b")}'
    f, s = values[:3], values[3:]
    if any(c != '0' for c in values):
        text += ',' + ' '.join(f) + ('' if f == s else ',' + ' '.join(s))
    return text


def positions_of(rows):
    return [tuple(map(from_text, row[:3])) for row in rows]


# ---------------------------------------------------------------- files

def stored(soup_text, rows):
    return '\n'.join([*soup_text, *map(compact, rows)]) + '\n'


def text_of(vertices, triangles, sides, normals):
    lines = ['sides ' + ''.join(s[0] for s in sides)]
    lines += ['v ' + ' '.join(map(shortest, v)) for v in vertices]
    for t, corners in zip(triangles, normals):
        kept = [] if corners[0] is None else corners[:1] if len(set(corners)) == 1 else corners
        lines.append(' '.join(['t', *map(str, t), *(shortest(c) for n in kept for c in n)]))
    return lines


def read_stored(path):
    """(soup, its lines, the lines of the ticks)"""
    lines = path.read_text().splitlines()
    vertices, triangles, normals = [], [], []
    for count, line in enumerate(lines[1:], 1):
        kind, *words = line.split()
        if kind == 'v':
            vertices.append(tuple(map(from_text, words)))
        elif kind == 't':
            triangles.append(tuple(map(int, words[:3])))
            numbers = [Fraction(from_text(c)) for c in words[3:]]
            corners = [tuple(numbers[k:k + 3]) for k in range(0, len(numbers), 3)] or [None]
            normals.append(corners if len(corners) == 3 else corners * 3)
        else:
            break
    sides = [{'f': 'front', 'b': 'both'}[c] for c in lines[0].split()[1]]
    return Soup(vertices, triangles, sides, normals), lines[:count], lines[count:]


def read_csv(directory, name):
    with open(directory / name, newline='') as file:
        return list(csv.reader(file))


def read_path(directory, name, sides):
    """(vertices, triangles, sides, normals, rows)"""
    vertices, triangles = read_off(directory / f'{name}.off')
    own = {tuple(map(int, row[:2])): tuple(map(from_text, row[2:])) for row in read_csv(directory, f'{name}.normals.csv')[1:]}
    normals = [[own.get((i, k)) for k in range(3)] for i in range(len(triangles))]
    header, *rows = read_csv(directory, f'{name}.csv')
    assert ','.join(header) == COLUMNS
    return vertices, triangles, [sides] * len(triangles), normals, rows


def soup_of(vertices, triangles, sides, normals):
    return Soup(vertices, triangles, sides, [[n and tuple(map(Fraction, n)) for n in corners] for corners in normals])


def smooth_normals(vertices, triangles):
    """The corner normals with no crease but edges that are not regular; 0 for triangles without area."""
    soup = Soup(vertices, triangles, 'both')
    own = [soup.triangles[i] for i in soup.used]
    mesh = Mesh(vertices, own, 'both')
    for (a, b), at in mesh.edges.items():
        runs = {(own[i][k], own[i][k - 2]) for i in at for k in range(3)} & {(a, b), (b, a)}
        if len(at) != 2 or len(runs) != 2:
            mesh.edges[a, b] = at[:1]  # as at a rim
    found = dict(zip(soup.used, corner_normals(mesh, 180)))
    return [found.get(i, [(0.0,) * 3] * 3) for i in range(len(triangles))]


# ---------------------------------------------------------------- checks

# Rules that few paths reach.
MUST_OCCUR = ['slides stopped', 'roundings in a triangle stopped', 'roundings on a line stopped', 'feet in a triangle', 'feet on a line',
              'lines that end at the foot', 'walls with two wedges', 'ties of directions', 'flights from behind',
              'flights that end along the surface', 'moves with too many looks']


def report(name, given, computed):
    """The number of differences; the first are printed."""
    wrong = [(number, a, b) for number, (a, b) in enumerate(zip(given, computed), 1) if a != b]
    print(f'{name}: {len(given)} ticks, {len(wrong)} differences', flush=True)
    for number, a, b in wrong[:3]:
        print(f'    tick {number}: {a}\n    computed: {b}')
    return len(wrong)


def check(ticks, only):
    different = 0
    for path in sorted(FOLDER.glob('*.txt')):
        if not only or path.stem in only:
            soup, _, given = read_stored(path)
            given = given[:ticks]
            positions = [tuple(map(from_text, line.split(',')[0].split())) for line in given]
            different += report(path.stem, given, list(map(compact, follow(soup, positions))))
    if ticks is None and not only:
        print(*(f'{kind}: {Soup.reached[kind]}' for kind in MUST_OCCUR), sep='\n')
        different += sum(Soup.reached[kind] == 0 for kind in MUST_OCCUR)
    return different


def sides_in(directory):
    if (directory / 'meshes.csv').exists():
        return {name: sides for name, (sides, _) in listed(directory).items()}
    return dict(re.findall(r'^\| `(\w+)` \| \d+ \| (front|both) \|', (directory / 'README.md').read_text(), re.M))


def compare(directory, only, ticks=None):
    different = 0
    for name, sides in sides_in(directory).items():
        if only and name not in only:
            continue
        *parts, given = read_path(directory, name, sides)
        computed = list(follow(soup_of(*parts), positions_of(given)))
        wrong = report(name, given, computed)
        different += wrong
        if ticks and not wrong:
            (FOLDER / f'{name}.txt').write_text(stored(text_of(*parts), computed[:ticks]))
    return different


# ---------------------------------------------------------------- the soups

def make():
    for name, scene in scenes():
        normals = smooth_normals(scene.vertices, scene.triangles)
        parts = scene.vertices, scene.triangles, scene.sides, normals
        rows = list(follow(soup_of(*parts), scene.positions()))
        (FOLDER / f'{name}.txt').write_text(stored(text_of(*parts), rows))


if __name__ == '__main__':
    if sys.argv[1:2] == ['--check']:
        sys.exit(1 if check(int(sys.argv[2]) if len(sys.argv) > 2 else None, sys.argv[3:]) else 0)
    if sys.argv[1:2] == ['--compare']:
        sys.exit(1 if compare(Path(sys.argv[2]), sys.argv[3:]) else 0)
    if sys.argv[1:2] == ['--take']:
        sys.exit(1 if compare(Path(sys.argv[2]), [], int(sys.argv[3])) else 0)
    FOLDER.mkdir(exist_ok=True)
    make()
