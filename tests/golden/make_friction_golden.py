#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes friction/: paths on the meshes of god_object/ with materials, and what the god-object does on them by the contact rule
friction of docs/friction.md.

Usage: make_friction_golden.py [directory]           (the default is friction/ beside this file; the output is always the same)
       make_friction_golden.py --check directory [mesh ...]
           computes every path in the directory again and compares every column; meshes, sides and corner normals are those of
           the directory god_object/ beside it
       make_friction_golden.py --smooth directory [mesh ...]
           computes every path of such a god_object/ with all coefficients 0, compares every column, and expects that only
           unfinished ticks leave the bit set

Directions, sides, flights, grids and shading directions are those of make_god_object_golden.py; the friction is computed here,
from rationals alone. Pull and pressure are both computed as squares of vectors, not by u² = t² + z². A share is the floor of an
integer's root, and a component of a force is rounded by comparing exact numbers a + √b.
"""

import csv
import math
import sys
from collections import Counter, namedtuple
from fractions import Fraction
from pathlib import Path

from make_god_object_golden import (COLUMNS, GRID, K, UNIT, Mesh, Paths, as_fractions, bounded, cross, dot, from_text,
                                    in_units, kept_on_grid, listed, minus, places_of, plus, read_off, read_path, rounded,
                                    scenes, shortest, times, write)
from make_golden import single

State = namedtuple('State', 'place side g slipping')
NOWHERE = State(None, 'front', None, False)


# ---------------------------------------------------------------- a + √b

def sign_of_sum(a, root):
    """The sign of a + σ√b, root = (σ, b)."""
    signs = (a > 0) - (a < 0), root[0] if root[1] else 0
    if signs[0] * signs[1] >= 0:
        return signs[0] or signs[1]
    return signs[0] * ((a * a > root[1]) - (a * a < root[1]))


def rounded_sum(a, root):
    """The binary32 nearest to a + σ√b, ties to even; zero is +0."""
    sign = sign_of_sum(a, root)
    if sign == 0:
        return 0.0
    a, root = sign * Fraction(a), (sign * root[0], Fraction(root[1]))

    def reaches(c):
        return sign_of_sum(a - c, root) >= 0
    exponent = 129
    while exponent > -126 and not reaches(Fraction(2)**exponent):
        exponent -= 1
    unit = Fraction(2)**(exponent - 23)
    low, high = 0, 1 << 24  # low · unit ≤ a + σ√b < high · unit
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if reaches(middle * unit) else (low, middle)
    above = sign_of_sum(a - (low + Fraction(1, 2)) * unit, root)
    n = low + (above > 0 or above == 0 and low & 1)
    assert n * unit < 1 << 128
    return sign * math.ldexp(n, exponent - 23) if n else 0.0


# ---------------------------------------------------------------- one tick

Way = namedtuple('Way', 'reach kind which end')  # what Mesh.steepest() gives: an edge is of kind 0, a triangle of kind 1


def holds(pull, coefficient, pressure):
    """t² ≤ μ²z² of t² and z², with ∞·0 = 0."""
    if coefficient == math.inf:
        return pressure > 0 or pull == 0
    return pull <= coefficient * coefficient * pressure


class RoughMesh(Mesh):
    def __init__(self, vertices, triangles, sides, corner_normals=None, materials=None):
        super().__init__(vertices, triangles, sides, corner_normals)
        self.materials = materials or [(Fraction(0), Fraction(0))] * len(triangles)  # (static, dynamic): Fraction or inf
        assert len(self.materials) == len(triangles) and all(s >= d for s, d in self.materials)
        self.most_moves = Mesh.most_moves
        self.steps = []  # of the last tick

    def triangles_at(self, place):
        return self.fans[place[1]] if place[0] == 'v' else self.edges[place[1:3]] if place[0] == 'e' else [place[1]]

    def is_rough(self, place):
        return any(self.materials[i][0] > 0 for i in self.triangles_at(place))

    def coefficients(self, way):
        """(μs, μd) of the way's edge or triangle."""
        own = self.edges[way.which] if way.kind == 0 else [way.which]
        return tuple(max(self.materials[i][k] for i in own) for k in (0, 1))

    def to_foot(self, u, way):
        """q − g."""
        if way.kind == 0:
            a, b = way.which
            along = minus(self.w[b], self.w[a])
            return times(Fraction(dot(u, along), dot(along, along)), along)
        n = self.normals[way.which]
        return minus(u, times(Fraction(dot(u, n), dot(n, n)), n))

    def pull_and_pressure(self, u, way):
        """(t², z²)."""
        tangential = self.to_foot(u, way)
        normal = minus(u, tangential)
        return dot(tangential, tangential), dot(normal, normal)

    def goes_on_slipping(self, place, g, p):
        """True if a rest at g keeps the bit, if it was set."""
        u = minus(p, g)
        if not any(u):
            return False
        way = Way(*self.steepest(place, u))
        static, dynamic = self.coefficients(way)
        pull, pressure = self.pull_and_pressure(u, way)
        return way.reach > 0 and static > 0 and not holds(4 * pull, dynamic, pressure)

    def share(self, u, way):
        """λ of rule 2b."""
        pull, pressure = self.pull_and_pressure(u, way)
        dynamic = self.coefficients(way)[1]
        if dynamic == math.inf or pressure == 0:
            assert pressure == 0
            return Fraction(1)
        left = math.isqrt(math.floor(GRID**2 * dynamic**2 * pressure / pull))
        assert left < GRID
        return 1 - Fraction(left, GRID)

    def slide_by(self, place, p, way, share):
        """The end in Fractions of a slide by a share of the way to the foot, which ends earlier at a border."""
        g = self.grid_point(place)
        change = times(share, self.to_foot(minus(p, g), way))
        if way.kind == 0:
            a, b = way.which
            along = minus(self.w[b], self.w[a])
            t = dot(plus(minus(g, self.w[a]), change), along) / Fraction(dot(along, along))
            return ('e', a, b, t) if 0 < t < 1 else ('v', way.end)
        # The weight of a corner is an area over the whole, as seen along the normal.
        corners = self.triangles[way.which]
        n = self.normals[way.which]
        inward = [cross(n, minus(self.w[corners[k - 1]], self.w[corners[k - 2]])) for k in range(3)]
        whole = dot(n, n)
        start = [Fraction(dot(inward[k], minus(g, self.w[corners[k - 2]])), whole) for k in range(3)]
        growth = [dot(inward[k], change) / Fraction(whole) for k in range(3)]
        part = min([Fraction(1)] + [w / -dw for w, dw in zip(start, growth) if dw < 0])
        weights = [w + part * dw for w, dw in zip(start, growth)]
        assert min(weights) >= 0
        return self.reduced(('t', way.which, *weights[1:]), 1)

    def tick(self, state, p):
        """Returns (state, status, moves, the resting place in Fractions). `steps` is what happened: (kind, place, side, g,
        slipping, way or None, λ or None, end or None, rounded end or None)."""
        place, side, g, slipping = state
        moves, self.steps = 0, []

        def note(kind, way=None, share=None, end=None, landed=None):
            self.steps.append((kind, place, side, g, slipping, way, share, end, landed))
            self.reached[kind] += 1

        def at_rest(kept, rest, is_slipping):
            own_side = 'front' if self.is_at_rim(kept) else side
            return State(kept, own_side, self.grid_point(kept), is_slipping), 'touching', moves, rest

        def stays():
            return at_rest(place, as_fractions(place), slipping and self.goes_on_slipping(place, g, p))

        if g is None:
            u = (1, 1, 1)
            on_p = [x for h, x in self.crossings(minus(p, u), u) if h == 1]
            if not on_p:
                return State(None, 'front', p, False), 'free', 0, None
            side = 'front'
            if not self.is_rough(on_p[0]):
                return at_rest(kept_on_grid(on_p[0]), on_p[0], False)
            place = self.on_grid(on_p[0], p)
            note('starts on a rough place', end=on_p[0], landed=place)
            g = self.grid_point(place)
        while True:
            u = minus(p, g)
            was_free = place is None
            if not any(u):
                return (State(None, 'front', g, False), 'free', moves, None) if was_free else stays()
            flies = was_free
            if not was_free:
                way = Way(*self.steepest(place, u))
                flies = self.whereabouts(place, u) in ('open', side)
                if not flies:
                    if way.reach <= 0:
                        return stays()
                    pull, pressure = self.pull_and_pressure(u, way)
                    if holds(pull, self.coefficients(way)[1 if slipping else 0], pressure):
                        note('sticks while slipping' if slipping else 'sticks', way)
                        return stays()
            if moves == self.most_moves:
                return State(place, side, g, slipping), 'unfinished', moves, as_fractions(place)
            share = None
            if flies:
                x, new_side, is_end = self.flight(g, u)
                if x is None:
                    return State(None, 'front', p, False), 'free', moves + 1, None
            else:
                share, new_side = self.share(u, way), side
                x = self.slide_by(place, p, way, share)
                is_inside = x[0] == 'et'[way.kind]
                is_end = is_inside and share == 1 or self.point(x) == p
            own_way = None if flies else way
            if is_end and not self.is_rough(x):
                note('flies to a smooth rest' if flies else 'slides to a smooth rest', own_way, share, x)
                moves, side = moves + 1, new_side
                return at_rest(kept_on_grid(x), x, False)
            landed = self.on_grid(x, p)
            there = self.grid_point(landed)
            left = minus(p, there)
            if not was_free and dot(left, left) >= dot(u, u):
                note('refused flight' if flies else 'refused slide', own_way, share, x, landed)
                return stays()
            note(('lands' if was_free else 'flies along') if flies else 'slides', own_way, share, x, landed)
            self.reached['ends at p on a rough place'] += flies and is_end
            self.reached['slides less than to a border'] += not flies and share < 1 and is_inside
            self.reached['slips over an edge'] += slipping and not flies and place[0] == 'e' and way.kind == 1
            place, g = landed, there
            side = 'front' if self.is_at_rim(place) else new_side
            slipping = slipping or not flies
            moves += 1

    # ------------------------------------------------------------ force

    def drag(self, rest, p):
        """D_t."""
        r = self.point(rest)
        u = minus(p, r)
        if not self.is_rough(rest) or not any(u):
            return 0, 0, 0
        way = Way(*self.steepest(rest, u))
        if way.reach <= 0 or self.coefficients(way)[0] == 0:
            return 0, 0, 0
        return times(-1, self.to_foot(u, way))

    def forces(self, rest, side, p):
        if rest is None:
            return [0.0] * 6
        D = minus(self.point(rest), p)
        tangential = self.drag(rest, p)
        normal = minus(D, tangential)
        N = self.shading_direction(rest, side, normal) if any(normal) else None
        force = [rounded(K * c / UNIT) for c in D]
        if N is None:
            return 2 * force
        self.reached['shaded with a drag'] += any(tangential)
        scale = K * K * dot(normal, normal) / UNIT**2 / Fraction(dot(N, N))
        return force + [rounded_sum(K * t / UNIT, ((c > 0) - (c < 0), scale * c * c)) for t, c in zip(tangential, N)]


ROUGH_COLUMNS = COLUMNS.replace('side,', 'side,slipping,')


def follow(mesh, positions):
    """The rows of a path."""
    state = NOWHERE
    for position in positions:
        moves, forces = 0, [0.0] * 6
        if all(abs(c) <= 1e4 for c in position):  # false for NaN too
            p = in_units(position)
            before = state.slipping
            state, status, moves, rest = mesh.tick(state, p)
            mesh.reached['the bit ' + {(0, 1): 'set by a tick', (1, 1): 'kept by a tick', (0, 0): 'left clear',
                                       (1, 0): 'cleared ' + ('at a rest' if state.place else 'by a flight')}
                         [before, state.slipping]] += 1
            forces = mesh.forces(rest, state.side, p)
        else:
            status = 'invalid'
        where = ('-', '-') if state.place is None else (' '.join(map(str, state.place)), state.side)
        yield [*map(shortest, position), status, *where, str(int(state.slipping)), str(moves), *map(shortest, forces)]


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
    mesh = RoughMesh(smooth.vertices, smooth.triangles, sides, smooth.corner_normals,
                     read_materials(directory / f'{name}.materials.csv'))
    with open(directory / f'{name}.csv', newline='') as file:
        header, *rows = csv.reader(file)
    assert ','.join(header) == ROUGH_COLUMNS
    return mesh, rows


def path_of(mesh, rows):
    return follow(mesh, [tuple(map(from_text, row[:3])) for row in rows])


def compare(name, rows, path):
    wrong = [f'line {number}: {",".join(row)}\n    computed {",".join(own)}'
             for number, (row, own) in enumerate(zip(rows, path), 2) if row != own]
    print(f'{name}: {len(rows)} ticks, {len(wrong)} differences', flush=True)
    for text in wrong[:3]:
        print('   ', text)
    return len(wrong)


def check(directory, only):
    different = 0
    for name, (sides, _) in listed(directory.parent / 'god_object').items():
        if (directory / f'{name}.csv').exists() and (not only or name in only):
            mesh, rows = read_rough_path(directory, name, sides)
            different += compare(name, rows, path_of(mesh, rows))
    print(dict(Mesh.reached))
    return different


def without_bit(path):
    for row in path:
        assert row[6] == '0' or row[3] in ('unfinished', 'invalid')
        yield row[:6] + row[7:]


def check_smooth(directory, only):
    different = 0
    for name, (sides, _) in listed(directory).items():
        if not only or name in only:
            smooth, _, rows = read_path(directory, name, sides)
            mesh = RoughMesh(smooth.vertices, smooth.triangles, sides, smooth.corner_normals)
            different += compare(name, rows, without_bit(path_of(mesh, rows)))
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

    def __init__(self, scene, mesh, seed='forceshade friction'):
        super().__init__(scene, mesh)
        self.draw = type(self.draw)(f'{seed} {scene.name}')
        self.first = PLANS[scene.name][1]

    def refused_after(self, start, offsets, entry=()):
        """True if a path from no state has a refused move."""
        state, before = NOWHERE, Counter(self.mesh.reached)
        for position in (*entry, *(plus(start, offset) for offset in offsets)):
            state = self.mesh.tick(state, in_units(bounded(position)))[0]
        news = self.mesh.reached - before
        self.mesh.reached.clear()
        self.mesh.reached.update(before)
        return news['refused slide'] + news['refused flight'] > 0

    def refusal(self):
        point, reach, *entry = self.draw.pick(self.scene.hot)
        for _ in range(40):
            offsets = [(0.0, 0.0, 0.0)] + [tuple(self.number(reach) for _ in range(3)) for _ in range(2)]
            if self.refused_after(point, offsets, entry):
                yield from (*entry, *(plus(point, offset) for offset in offsets))
                return

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
    return RoughMesh(scene.vertices, scene.triangles, scene.sides, corner_normals, exact)


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
    if sys.argv[1:2] == ['--smooth']:
        sys.exit(1 if check_smooth(Path(sys.argv[2]), sys.argv[3:]) else 0)
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / 'friction')
