#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks what docs/friction.md promises of each tick, on random paths over the meshes of god_object/ with random materials.

Usage: check_friction.py [ticks] [seed] [mesh ...]    (the default is 4000 ticks in all; exits with 1 if a tick is wrong)
       check_friction.py --scaled directory [mesh ...]
           computes the paths of a directory like friction/ with all lengths times 1/8 and expects the same states
       check_friction.py --strokes
           strokes a ridge, a valley and spheres of a radius of 50 mm, 1.5 mm deep, with μs = μd = 0.3 and without friction, and
           prints the largest change of the force in a tick, as a part of the force

The ticks and their moves are those of make_friction_golden.py; what is checked is computed from the points of these moves. All
comparisons are exact. Per tick:
  - each move ends nearer to the position; a slide has (r - g)·(q - g) > |r - g|²/2, a share below 1 only on a rough face, and with
    an infinite dynamic coefficient it has no pressure;
  - the cone: at a rest that is no refusal, t <= μd z if the tick made a slide or began slipping, else t <= μs z;
  - a refused slide that ends inside its feature has t (t - μd z) <= λt² <= h²/3, h the longest side of the grid cell;
  - the rest of a rough place is the point of the state; the bit is clear when free and at the rest of a smooth place, and is set
    only by a slide;
  - the same position again: no move, the same state, force and bit; so after an unfinished tick, once it is finished;
  - the same tick by one move at a time ends in the same state;
  - side: over a closed mesh with one side, what was in front of it is not free behind it;
  - energy: F·Δp <= (F² - F'²)/2K + K Δp²/2 from a rough rest, with K h²/6 more from free, and with the terms of docs/energy.md
    from a smooth rest, where the number of ticks that break the first form is printed.
"""

import math
import sys
from collections import Counter
from fractions import Fraction
from pathlib import Path

from make_friction_golden import (GRID, LEAST, NOWHERE, UNIT, Mesh, RoughMesh, RoughPaths, Way, bounded, cross, dot, follow,
                                  from_text, holds, in_units, listed, minus, plus, read_path, read_rough_path, rough_mesh,
                                  scenes, times)
from check_god_object import Surface
from make_golden import Draw, single

MATERIALS = [(0.0, 0.0), (math.inf, math.inf), (math.inf, 1.0), (1024.0, LEAST), (1024.0, 1024.0), (LEAST, 0.0), (LEAST, LEAST),
             (0.75, 0.0), (0.3, 0.2), (0.5, 0.25), (0.7, 0.7), (2.0, 0.5), (1.0, 1.0), (0.1, 0.05)]


def squared(v):
    return dot(v, v)


def longest_step_squared(mesh, place):
    """h² of the grid of a place."""
    if place[0] == 'v':
        return 0
    corners = place[1:3] if place[0] == 'e' else mesh.triangles[place[1]]
    return Fraction(max(squared(minus(mesh.w[a], mesh.w[b])) for a in corners for b in corners), GRID**2)


class Checker:
    def __init__(self, mesh):
        self.mesh, self.counts, self.wrong, self.largest = mesh, Counter(), [], Counter()

    def expect(self, what, is_so):
        self.counts[what] += 1
        if not is_so:
            self.wrong.append(what)

    def check_moves(self, steps, p):
        slid = False
        for kind, place, side, g, slipping, way, share, end, landed in steps:
            slid |= kind in ('slides', 'slides to a smooth rest')
            if kind not in ('slides', 'slides to a smooth rest', 'flies along', 'refused slide'):
                continue
            u = minus(p, g)
            reached = self.mesh.point(end) if landed is None else self.mesh.grid_point(landed)
            moved = minus(reached, g)
            if kind == 'refused slide':
                self.check_refusal(place, u, way, share, end)
                continue
            self.expect('a move ends nearer', squared(minus(p, reached)) < squared(u))
            if way:
                foot = self.mesh.to_foot(u, way)
                self.expect('never against the slip', 2 * dot(moved, foot) > squared(moved))
                static, dynamic = self.mesh.coefficients(way)
                pull, pressure = self.mesh.pull_and_pressure(u, way)
                self.expect('slides outside of the cone', not holds(pull, dynamic if slipping else static, pressure))
                if dynamic == math.inf:
                    self.expect('no slide under pressure where μd is infinite', pressure == 0)
        return slid

    def check_refusal(self, place, u, way, share, end):
        pull, pressure = self.mesh.pull_and_pressure(u, way)
        dynamic = self.mesh.coefficients(way)[1]
        is_inside = end[0] == 'et'[way.kind]
        step = longest_step_squared(self.mesh, end)
        excess = float(pull) - (0 if pressure == 0 else float(dynamic) * math.sqrt(pressure) * math.sqrt(pull))
        name = 'inside' if is_inside else 'at a border'
        self.counts[f'refusals {name}'] += 1
        self.largest[f'(t - μd z) t of a refusal {name}, mm²'] = max(
            self.largest[f'(t - μd z) t of a refusal {name}, mm²'], excess / UNIT**2)
        self.largest[f't - μd z of a refusal {name}, mm'] = max(
            self.largest[f't - μd z of a refusal {name}, mm'], excess / math.sqrt(pull) / UNIT)
        if step:
            self.largest[f'(t - μd z) t of a refusal {name}, over h²/3'] = max(
                self.largest[f'(t - μd z) t of a refusal {name}, over h²/3'], 3 * excess / float(step))
        if is_inside:
            self.expect('a refusal inside is below h²/3', 3 * share * pull <= step)
            self.expect('a share brings inside the cone', holds((1 - share)**2 * pull, dynamic, pressure))
        else:
            moved = minus(self.mesh.point(end), self.mesh.grid_point(place))
            self.expect('a refusal at a border has d t below h²/3', 9 * squared(moved) * pull <= step * step)

    def check_rest(self, before, state, p, rest, slid, is_refused):
        mesh = self.mesh
        if not mesh.is_rough(rest):
            self.expect('the bit is clear at a smooth rest', not state.slipping)
            return
        self.expect('a rough rest is the point of the state', mesh.point(rest) == state.g)
        u = minus(p, state.g)
        if is_refused or not any(u):
            return
        way = Way(*mesh.steepest(rest, u))
        if way.reach > 0:
            pull, pressure = mesh.pull_and_pressure(u, way)
            static, dynamic = mesh.coefficients(way)
            self.expect('the cone after a slide' if slid else 'the cone of a slipping state' if before.slipping else
                        'the cone of a sticking state',
                        holds(pull, dynamic if slid or before.slipping else static, pressure))

    def check_energy(self, before, drawn, state, rest, p, steps):
        """drawn: (the position and D of the tick before, whether its rest is the state's point)."""
        last, D, is_exact = drawn
        moved = minus(p, last)
        now = (0, 0, 0) if rest is None else minus(self.mesh.point(rest), p)
        excess = 2 * dot(D, moved) - squared(D) + squared(now) - squared(moved)
        if before.place is None:
            landing = [step for step in steps if step[0] == 'lands']
            more = longest_step_squared(self.mesh, landing[0][7]) / 3 if landing else 0
            self.expect('energy from free', excess <= more)
        elif is_exact:
            self.expect('energy from a rough rest', excess <= 0)
        else:
            off = minus(before.g, plus(last, D))
            self.expect('energy from a smooth rest', excess <= 2 * dot(off, minus(D, moved)) + squared(off))
            self.counts['  of them beyond the form without ρ'] += excess > 0
            self.largest['beyond it, mm²'] = max(self.largest['beyond it, mm²'], float(excess) / UNIT**2)

    def check_again(self, state, status, p, rest):
        mesh = self.mesh
        if status == 'unfinished':
            return
        again = mesh.tick(state, p)
        self.expect('the same position again', again[:2] == (state, status) and again[3] == rest
                    and (rest is None or not mesh.is_rough(rest) or again[2] == 0))
        if state.place:
            self.expect('the same force again', mesh.forces(again[3], state.side, p) == mesh.forces(rest, state.side, p))

    def check_single_moves(self, before, state, p, moves):
        if before.g is None:
            return
        mesh, at, status, count = self.mesh, before, 'unfinished', 0
        mesh.most_moves = 1
        while status == 'unfinished' and count <= 2 * moves + 2:
            at, status, done, _ = mesh.tick(at, p)
            count += done
        mesh.most_moves = 256
        self.expect('the same by single moves', at == state and count == moves)

    def check_path(self, positions):
        mesh, state, drawn, was_in_front = self.mesh, NOWHERE, None, False
        surface = Surface(mesh.w, mesh.triangles, mesh.sides)
        for position in positions:
            if not all(abs(c) <= 1e4 for c in position):
                continue
            p, before = in_units(position), state
            state, status, moves, rest = mesh.tick(before, p)
            steps = mesh.steps
            known = len(self.wrong)
            self.counts[f'ticks that end {status}'] += 1
            slid = self.check_moves(steps, p)
            is_refused = bool(steps) and steps[-1][0].startswith('refused')
            if status == 'touching':
                self.check_rest(before, state, p, rest, slid, is_refused)
            elif status == 'free':
                self.expect('the bit is clear when free', not state.slipping)
            if not mesh.rim and mesh.sides == 'front':
                is_behind = status == 'free' and surface.is_behind(p)
                if was_in_front:
                    self.expect('not free behind the surface', not is_behind)
                was_in_front = not is_behind
            if state.slipping:
                self.expect('the bit is set by a slide', before.slipping or slid)
            if drawn:
                self.check_energy(before, drawn, state, rest, p, steps)
            self.check_again(state, status, p, rest)
            if moves > 1 and status != 'unfinished':
                self.check_single_moves(before, state, p, moves)
            D = (0, 0, 0) if rest is None else minus(mesh.point(rest), p)
            drawn = p, D, rest is None or mesh.point(rest) == state.g
            if len(self.wrong) > known:
                print('WRONG', self.wrong[known:], position, before, state, *steps, rest, flush=True, sep='\n    ')


def check(ticks, seed, only):
    counts, largest, wrong = Counter(), Counter(), 0
    chosen = [scene for scene in scenes() if not only or scene.name in only]
    for number, scene in enumerate(chosen):
        smooth, _, _ = read_path(Path(__file__).parent / 'god_object', scene.name, scene.sides)
        share = ticks * (number + 1) // len(chosen) - ticks * number // len(chosen)
        for part in range(4):  # four sets of materials
            draw = Draw(f'{seed} {scene.name} {part}')
            kinds = [draw.pick(MATERIALS) for _ in range((1, 2, 3, 8)[part])]
            mesh = rough_mesh(scene, [draw.pick(kinds) for _ in scene.triangles], smooth.corner_normals)
            paths = RoughPaths(scene._replace(ticks=share // 4), mesh, f'{seed} {part}')
            checker = Checker(mesh)
            checker.check_path(paths.positions())
            counts.update(checker.counts)
            wrong += len(checker.wrong)
            for name, value in checker.largest.items():
                largest[name] = max(largest[name], value)
        print(f'{scene.name}: {share} ticks, {wrong} wrong so far', flush=True)
    print(*(f'{what}: {count}' for what, count in sorted(counts.items())), sep='\n')
    print(*(f'largest {what}: {value:.3g}' for what, value in sorted(largest.items())), sep='\n')
    print(f'moves and rests: {dict(Mesh.reached)}')
    print(f'{wrong} wrong')
    return wrong


def check_scaled(directory, only):
    different = 0
    for name, (sides, _) in listed(directory.parent / 'god_object').items():
        if not (directory / f'{name}.csv').exists() or only and name not in only:
            continue
        mesh, rows = read_rough_path(directory, name, sides)
        small = type(mesh)([times(0.125, v) for v in mesh.vertices], mesh.triangles, sides, mesh.corner_normals, mesh.materials)
        positions = [times(1.0 if row[3] == 'invalid' else 0.125, tuple(map(from_text, row[:3]))) for row in rows]
        own = list(follow(small, positions))
        wrong = [(row, one) for row, one in zip(rows, own) if row[3:8] != one[3:8]]
        print(f'{name}: {len(rows)} ticks, {len(wrong)} other states', flush=True)
        different += len(wrong)
    return different


# ---------------------------------------------------------------- a sphere

def sphere(times_divided, radius):
    """An icosphere; the corner normals are the directions of its vertices."""
    golden = (1 + math.sqrt(5)) / 2
    corners = [(s, t * golden, 0) for s in (-1, 1) for t in (-1, 1)]
    points = [tuple(c[k - i] for k in range(3)) for i in range(3) for c in corners]
    near = [[b for b in range(12) if b != a and squared(minus(points[a], points[b])) < 5] for a in range(12)]
    triangles = [(a, b, c) for a in range(12) for b in near[a] for c in near[a] if a < b < c and c in near[b]]
    triangles = [t if dot(points[t[0]], cross(points[t[1]], points[t[2]])) > 0 else (t[0], t[2], t[1]) for t in triangles]
    for _ in range(times_divided):
        middles = {}

        def middle(a, b):
            if (key := (min(a, b), max(a, b))) not in middles:
                middles[key] = len(points)
                points.append(times(0.5, plus(points[a], points[b])))
            return middles[key]
        triangles = [small for a, b, c in triangles for ab, bc, ca in [(middle(a, b), middle(b, c), middle(c, a))]
                     for small in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))]
        points = [times(1 / math.sqrt(squared(point)), point) for point in points]
    normals = [tuple(Fraction(single(c)) for c in point) for point in points]
    vertices = [tuple(single(radius * c) for c in point) for point in points]
    return vertices, triangles, [[normals[v] for v in t] for t in triangles]


def roof(turn):
    """Two planes that meet at x = 0: a ridge that turns by the angle, or a valley where it is negative. Normals turn steadily."""
    vertices = [(x, y, -max(x, 0) * math.tan(turn)) for y in (-40, 40) for x in (-40, 0, 40)]
    directions = [(math.sin(part * turn), 0, math.cos(part * turn)) for part in (0, 0.5, 1)] * 2
    triangles = [(0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4)]
    normals = [tuple(Fraction(single(c)) for c in direction) for direction in directions]
    return [tuple(map(single, map(float, v))) for v in vertices], triangles, [[normals[v] for v in t] for t in triangles]


def changes(mesh, hand):
    """The largest change of the force from tick to tick, as a part of the force: unshaded, shaded."""
    rows = list(follow(mesh, hand))[1 + len(hand) // 5:]
    forces = [[tuple(map(float, row[first:first + 3])) for row in rows] for first in (8, 11)]
    return [max(math.sqrt(squared(minus(a, b)) / squared(a)) for a, b in zip(one, one[1:])) for one in forces]


def stroked(surface, sides, material, hand):
    vertices, triangles, normals = surface
    exact = tuple(map(Fraction, map(single, material)))
    mesh = RoughMesh(vertices, triangles, sides, normals, [exact] * len(triangles))
    return mesh, changes(mesh, list(map(bounded, hand)))


def largest_turn(mesh):
    """The largest angle between the normals of two neighbours."""
    units = [times(1 / math.sqrt(float(squared(n))), tuple(map(float, n))) for n in mesh.normals]
    pairs = [own for own in mesh.edges.values() if len(own) == 2]
    return max(2 * math.asin(math.sqrt(squared(minus(units[i], units[j]))) / 2) for i, j in pairs)


def stroke():
    around = []
    for step in range(240):
        a = step * 0.05 / 48.5
        position = 48.5 * math.sin(a) + 3, 48.5 * math.cos(a) * 0.8, 48.5 * math.cos(a) * 0.6
        around.append(times(48.5 / math.sqrt(squared(position)), position))
    across = [(-1 + i * 0.025, 0.3, -1.5) for i in range(100)]
    for name, surface, sides, hand in [
            ('a ridge', roof(0.1), 'both', [(-1, 0.3, 1), *across]), ('a valley', roof(-0.1), 'both', [(-1, 0.3, 1), *across]),
            ('320 triangles', sphere(2, 50), 'front', [times(1.1, around[0]), *around[::4]]),
            ('320 triangles', sphere(2, 50), 'front', [times(1.1, around[0]), *around]),
            ('1280 triangles', sphere(3, 50), 'front', [times(1.1, around[0]), *around[::4]]),
            ('1280 triangles', sphere(3, 50), 'front', [times(1.1, around[0]), *around])]:
        for material in ((0.0, 0.0), (0.3, 0.3)):
            mesh, (plain, shaded) = stroked(surface, sides, material, hand)
            print(f'{name}, turn {largest_turn(mesh):.3f}, {math.dist(hand[2], hand[3]):.3f} mm a tick, μ {material[0]}: '
                  f'{plain:.4f} unshaded, {shaded:.4f} shaded', flush=True)


if __name__ == '__main__':
    if sys.argv[1:2] == ['--scaled']:
        sys.exit(1 if check_scaled(Path(sys.argv[2]), sys.argv[3:]) else 0)
    if sys.argv[1:2] == ['--strokes']:
        sys.exit(stroke())
    sys.exit(1 if check(int(sys.argv[1]) if len(sys.argv) > 1 else 4000, sys.argv[2] if len(sys.argv) > 2 else 'friction',
                        sys.argv[3:]) else 0)
