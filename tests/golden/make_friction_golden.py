#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes friction/: paths on the meshes of god_object/ with materials, and what the god-object does on them by the contact rule
friction of docs/friction.md.

Usage: make_friction_golden.py [directory]           (the default is friction/ beside this file; the output is always the same)
       make_friction_golden.py --check directory [mesh ...]
           computes every path in the directory again and compares every column; meshes, sides and corner normals are those of
           the directory god_object/ beside it

The tick is that of make_god_object_golden.py.
"""

import csv
import math
import sys
from fractions import Fraction
from pathlib import Path

from make_god_object_golden import (COLUMNS, Mesh, Paths, compare, dot, follow, from_text, listed, minus, places_of, plus, positions_of,
                                    read_path, scenes, shortest, times, write)
from make_golden import single

ROUGH_COLUMNS = COLUMNS.replace('side,', 'side,slipping,')


# ---------------------------------------------------------------- checking other paths

def read_coefficient(text):
    return math.inf if text == 'inf' else Fraction(from_text(text))


def read_materials(path):
    with open(path, newline='') as file:
        return [tuple(map(read_coefficient, row[1:])) for row in list(csv.reader(file))[1:]]


def read_rough_path(directory, name, sides):
    """The mesh with corner normals and materials, and the rows of the path."""
    source = directory.parent / 'god_object'
    smooth, _, _ = read_path(source, name, sides)
    mesh = Mesh(smooth.vertices, smooth.triangles, sides, smooth.corner_normals,
                read_materials(directory / f'{name}.materials.csv'))
    with open(directory / f'{name}.csv', newline='') as file:
        header, *rows = csv.reader(file)
    assert ','.join(header) == ROUGH_COLUMNS
    return mesh, rows


def check(directory, only):
    different = 0
    for name, (sides, _) in listed(directory.parent / 'god_object').items():
        if (directory / f'{name}.csv').exists() and (not only or name in only):
            mesh, rows = read_rough_path(directory, name, sides)
            different += compare(name, rows, follow(mesh, positions_of(rows)))
    print(dict(Mesh.reached))
    return different


# ---------------------------------------------------------------- the paths

LEAST = 2.0**-10
NONE, ALWAYS = (0.0, 0.0), (math.inf, math.inf)
# The materials of a mesh: the one of all faces, or those of which each face has one. Then the first position, if it is special.
PLANS = {
    'tetrahedron': ([(0.4, 0.3)], None),
    'cube': ([NONE, (0.3, 0.2), (1.5, 0.125), (0.7, 0.7)], (4, 1.3, -0.7)),
    'l_prism': ([(math.inf, 0.5), (0.6, 0.6), (LEAST, LEAST), (0.25, 0.1)], (-1, -1, 0.3)),
    'folded_sheet': ([(0.5, 0.25)], None),
    'hairpin': ([(1024, 1024), (1024, LEAST), (0.7, 0.1), ALWAYS], None),
    'saddle_8': ([NONE, (0.25, 0.25), (0.9, 0.4)], (0, 0, 0)),
    'fan_40': ([(0.2, 0.1), (0.05, 0.05), (0.1, 0)], None),
    'slivers': ([(0.3, 0.15)], None),
    'near_parts': ([(0.8, 0.4), (0.2, 0.2)], None),
    'torus': ([NONE, (0.3, 0.2), (0.6, 0)], None),
    'stairs': ([NONE, (LEAST, 0), (0.75, 0.5), (2, 0.25)], (-3, 0.6, -4)),
    'scaled_down': ([(0.35, 0.35)], None),
    'far': ([(math.inf, LEAST)], None),
    'ribbon': ([(LEAST, 0)], None),
}
KINDS = ['starts on a rough place', 'lands', 'flies along', 'ends at p on a rough place', 'sticks', 'sticks while slipping',
         'slides', 'slides less than to a border', 'refused slide', 'refused flight', 'slides to a smooth rest', 'flies to a smooth rest',
         'the bit set by a tick', 'the bit kept by a tick', 'the bit cleared at a rest', 'the bit cleared by a flight',
         'slips over an edge', 'shaded with a drag', 'v front', 'v back', 'e front', 'e back', 't front', 't back', 'free',
         'unfinished', 'invalid', 'shaded on a crease']


class RoughPaths(Paths):
    """Pieces of paths over one mesh with materials."""

    tries = 40

    def __init__(self, scene, mesh, seed='forceshade friction'):
        super().__init__(scene, mesh)
        self.draw = type(self.draw)(f'{seed} {scene.name}')
        self.first = PLANS[scene.name][1]

    def pressed(self):
        """(a point on the surface, the unit normal out of it on the pressed side, a tangent, a depth)."""
        point, n = self.on_surface()
        n = times(self.facing(), n)
        other = tuple(self.number(1) for _ in range(3))
        tangent = minus(other, times(dot(other, n), n))
        size = math.sqrt(dot(tangent, tangent)) or 1
        return point, n, times(1 / size, tangent), self.scene.size * self.draw.pick((0.001, 0.03, 0.1, 0.3, 1.0))

    def back_and_forth(self):
        """Pressed in, dragged along in steps below and above the cone, back, held, and lifted."""
        point, n, tangent, depth = self.pressed()
        yield plus(point, times(self.scene.size, n))
        way = 0.0
        stride = depth * self.draw.pick((0.05, 0.2, 0.6))
        for i in range(14):
            yield plus(point, plus(times(way, tangent), times(-depth, n)))
            way += stride * (1 if i < 8 else -1)
            if self.draw.random() < 0.15:
                depth *= self.draw.pick((0.5, 2.0))
        if self.draw.random() < 0.5:
            yield plus(point, plus(times(way, tangent), times(self.scene.size, n)))

    def at_the_cone(self):
        """A pull as near to a coefficient times the pressure as binary32 comes, and half of it."""
        point, n, tangent, depth = self.pressed()
        coefficient = self.draw.pick([float(c) for pair in self.mesh.materials for c in pair if 0 < c < 8] or [1.0])
        yield plus(point, times(self.scene.size, n))
        yield plus(point, times(-depth, n))
        for part in (1.0, 1 + 2.0**-20, 0.5, 1.5, 1 - 2.0**-20, 1.0):
            yield plus(point, plus(times(part * coefficient * depth, tangent), times(-depth, n)))

    def pieces(self):
        often = [*[self.back_and_forth] * 5, *[self.at_the_cone] * 3, *[self.stroke] * 3, *[self.walk] * 2, self.along_axis,
                 self.jumps, self.on_it, *[self.next_door] * 2]
        return often + ([*[self.hot] * 2, *[self.refusal] * 3] if self.scene.hot else [])

    def pieces_in_turn(self, pieces, start):
        yield from super().pieces_in_turn(pieces, self.first or start)


def with_materials(scene, draw):
    """[(static, dynamic)] of the faces, as binary32."""
    kinds = [tuple(map(single, pair)) for pair in PLANS[scene.name][0]]
    return [draw.pick(kinds) for _ in scene.triangles]


def rough_mesh(scene, materials, corner_normals=None):
    exact = [tuple(c if c == math.inf else Fraction(c) for c in pair) for pair in materials]
    return Mesh(scene.vertices, scene.triangles, scene.sides, corner_normals, exact)


def main(directory):
    directory.mkdir(exist_ok=True)
    table = []
    for scene in scenes():
        smooth, _, _ = read_path(Path(__file__).parent / 'god_object', scene.name, scene.sides)
        scene = scene._replace(ticks=60 if scene.name == 'ribbon' else 400)
        paths = RoughPaths(scene, None)
        materials = with_materials(scene, paths.draw)
        mesh = paths.mesh = rough_mesh(scene, materials, smooth.corner_normals)
        rows = list(follow(mesh, paths.positions()))
        write(directory / f'{scene.name}.materials.csv',
              [['triangle', 'static', 'dynamic'], *([i, *map(shortest, pair)] for i, pair in enumerate(materials))])
        write(directory / f'{scene.name}.csv', [ROUGH_COLUMNS.split(','), *rows])
        seen = places_of(rows)
        Mesh.reached.update(seen)
        slipping = sum(row[6] == '1' for row in rows)
        table.append([scene.name, len(set(materials)), len(rows), seen['touching'], slipping])
        print(f'{scene.name:13}', len(rows), 'ticks, touching', seen['touching'], 'slipping', slipping, flush=True)
    write(directory / 'paths.csv', [['name', 'materials', 'ticks', 'touching', 'slipping'], *table])
    print(*(f'{kind}: {Mesh.reached[kind]}' for kind in KINDS), sep='\n')
    assert all(Mesh.reached[kind] for kind in KINDS)


if __name__ == '__main__':
    if sys.argv[1:2] == ['--check']:
        sys.exit(1 if check(Path(sys.argv[2]), sys.argv[3:]) else 0)
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / 'friction')
