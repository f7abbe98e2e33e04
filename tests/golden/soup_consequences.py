#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: soup_consequences.py [sets]

Judges by other means what docs/soups.md says follows, on sets of tetrahedra between the points of a lattice, which cross, touch, stand on
each other and coincide (60 of them unless another number is named):
  - nothing passes a wall: how often the surface winds around the god-object never rises with `front` and never changes with `both`;
  - a rest is idempotent, and one that is no refusal a local minimum: of random directions that lead nearer to the position, none is in a
    cell that can be reached.
"""

import sys
from fractions import Fraction

from make_god_object_golden import cross, dot, minus
from make_golden import Draw
from soup_places import UNIT, in_units, way
from soup_scenes import Lattice
from soup_tick import Soup


class Solids(Lattice):
    def __init__(self, name):
        self.draw, self.ticks = Draw(f'forceshade solids {name}'), 24
        draw = self.draw
        self.step, self.span = draw.pick((4.0, 3.0, 1.0)), draw.pick((1, 1, 2))
        self.vertices, self.triangles, self.sides = [], [], draw.pick(('front', 'both'))
        for _ in range(draw.pick((1, 2, 2, 3, 4))):
            corners, volume = [], 0
            while volume == 0:
                corners = [self.node(self.span) for _ in range(4)]
                x, y, z = (minus(corner, corners[0]) for corner in corners[1:])
                volume = dot(x, cross(y, z))
            if volume < 0:
                corners[0], corners[1] = corners[1], corners[0]
            first = len(self.vertices)
            self.vertices += corners
            self.triangles += [tuple(first + k for k in t) for t in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))]
        self.triangles.sort(key=lambda t: draw.random())


def winding(soup, x, draw):
    """How often the surface winds around a point off it, given in rationals: its crossings of a ray that meets no edge."""
    while True:
        d = tuple(int(2**20 * draw.random()) - 2**19 for _ in range(3))
        total = 0
        for i in soup.used:
            a, b, c = (minus(soup.vertices[v], x) for v in soup.triangles[i])
            height, rise = dot(soup.normals[i], a), dot(soup.normals[i], d)
            if height == 0:
                continue  # the ray begins in the plane, outside the triangle
            turns = [dot(d, cross(a, b)), dot(d, cross(b, c)), dot(d, cross(c, a))]
            if 0 in turns or rise == 0:
                break
            if (turns[0] > 0) == (turns[1] > 0) == (turns[2] > 0) and (height > 0) == (rise > 0):
                total += 1 if rise > 0 else -1
        else:
            return total


def beside(soup, state):
    """A point near the state's, in its cell."""
    g, place, name = state
    base = tuple(Fraction(c, g[3]) for c in g[:3])
    if place is None:
        return base
    near = soup.near(g)
    side = near.cells[near.cell_named(name)][0]
    along, up = near.pieces[side // 2].middle, near.pieces[side // 2].normal
    sizes = max(map(abs, along)), max(map(abs, up)) * (-1 if side % 2 else 1) * 2**12
    return tuple(base[k] + (Fraction(along[k], sizes[0]) * (near.kind != 2) + Fraction(up[k], sizes[1])) * UNIT / 2**90 for k in range(3))


def directions_nearer(u, draw):
    for _ in range(12):
        share = draw.pick((0, 60, 600))
        d = tuple(int(101 * draw.random()) - 50 + share * c // max(map(abs, u)) for c in u)
        if dot(d, u) > 0:
            yield d


def judge(name):
    """(ticks, rests, directions) without a fault."""
    scene = Solids(name)
    soup = Soup(scene.vertices, scene.triangles, scene.sides)
    state, before, ticks, rests, tried = None, None, 0, 0, 0
    for position in scene.positions():
        p = (*in_units(position), 1)
        Soup.reached.clear()
        state, _, _, rest = soup.tick(state, p)
        is_refused = Soup.reached['refused']
        turns = winding(soup, beside(soup, state), scene.draw)
        assert before is None or turns == before or turns < before and scene.sides == 'front', (name, position, before, turns)
        before = turns
        ticks += 1
        if rest:
            rests += 1
            assert soup.tick(state, p)[0] == state, (name, position)
            u = way(rest[0], p)
            if any(u) and not is_refused:
                near = soup.near(rest[0])
                for d in directions_nearer(u, scene.draw):
                    tried += 1
                    assert near.cell(d) not in near.reached(rest[1]), (name, position, d)
    return ticks, rests, tried


if __name__ == '__main__':
    found = [judge(number) for number in range(int(sys.argv[1]) if len(sys.argv) > 1 else 60)]
    ticks, rests, tried = map(sum, zip(*found))
    print(f'{ticks} ticks, {rests} rests, {tried} directions')
    assert rests and tried
