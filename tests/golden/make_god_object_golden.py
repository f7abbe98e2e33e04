#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes god_object/: small meshes, paths on them, and what the god-object of docs/god-object.md does on these paths, by the
contact rule direct.

Usage: make_god_object_golden.py [directory]       (the default is god_object/ beside this file; the output is always the same)
       make_god_object_golden.py --sub-goal [directory]
           the same by the contact rule sub-goal on some of the meshes; the default is sub_goal_god_object/
       make_god_object_golden.py --check directory [mesh ...]
           computes every path in the directory again and compares every column
Paths by the contact rule friction are made by make_friction_golden.py. The tick here is that of friction; a mesh without materials
has coefficients of 0, where friction is the direct rule.

All decisions are signs of integers or of rationals; there is no tree, no tolerance and no floating-point number in a decision.
The methods are chosen to differ from the formulas of docs/god-object.md:
  - on which side of the surface a direction points: a segment runs from the direction to a point inside a triangle at the same
    point of the surface, and its crossings of the other triangles there are counted;
  - where a flight meets the surface: all vertices are projected along the flight onto a plane, and the signed areas there give
    the place of the crossing;
  - directions and sub-goals: projections onto triangles by 2 x 2 normal equations;
  - grid points: all neighbours of the point are tried;
  - friction: pull and pressure are both computed as squares of vectors, not by u² = t² + z²; a share is the floor of an integer's
    root;
  - forces: a component a + √b is rounded by comparing exact numbers;
  - sub-goals: the position, moved by what lies between the feet in the triangle of itself and of its foot on the shading plane.
Angles and unit normals, which the corner normals are made of, are decimals of 110 digits; a corner normal that these leave in
doubt would stop the program. Everything else is exact. The unit of length of the integers is 2^-77 mm: vertices and positions
are multiples of 2^-53 mm, and the grid of the states divides these by 2^24.
"""

import csv
import math
import re
import sys
from collections import Counter, namedtuple
from decimal import Decimal, localcontext
from fractions import Fraction
from pathlib import Path

from make_golden import Draw, single, step

GRID = 1 << 24
UNIT = 1 << 77
QUANTUM = Fraction(1, 1 << 30)
K = Fraction(single(0.3))  # N/mm


# ---------------------------------------------------------------- binary32

def nearest_integer_to_root(square):
    """The integer nearest to the square root of a rational, ties to even."""
    n = math.isqrt(square.numerator // square.denominator)
    excess = square - Fraction(2 * n + 1, 2)**2
    return n + (excess > 0 or excess == 0 and n & 1)


def rounded_root(square, is_negative=False):
    """The binary32 nearest to ±√square, ties to even; zero is +0."""
    square = Fraction(square)
    if square == 0:
        return 0.0
    exponent = (square.numerator.bit_length() - square.denominator.bit_length()) // 2 + 2
    while square < Fraction(4)**exponent:
        exponent -= 1
    unit = max(exponent, -126) - 23
    n = nearest_integer_to_root(square / Fraction(4)**unit)
    if n * Fraction(2)**unit >= 1 << 128:
        return -math.inf if is_negative else math.inf
    return math.ldexp(-n if is_negative else n, unit) if n else 0.0


def rounded(x):
    return rounded_root(Fraction(x)**2, x < 0)


def from_text(text):
    """The binary32 nearest to a decimal, without a binary64 between the two."""
    value = float(text)
    return rounded(Fraction(text)) if math.isfinite(value) else value


def shortest(f):
    """The shortest decimal that is read back as f; of these the nearest to f, then the even one. Laid out like Python's repr."""
    if not math.isfinite(f):
        return repr(f)
    if f == 0:
        return '0'
    size = abs(Fraction(f))
    power = math.floor(math.log10(size))
    power += (size >= Fraction(10)**(power + 1)) - (size < Fraction(10)**power)
    for digits in range(1, 10):
        place = Fraction(10)**(power + 1 - digits)
        below = size // place
        fits = [n for n in (below, below + 1) if n and rounded(n * place) == size]
        if fits:
            break
    n = min(fits, key=lambda n: (abs(n * place - size), n % 2))
    text = str(n)
    power += len(text) - digits  # 9.99… may have become 10.0…
    text = text.rstrip('0')
    if power < -4 or power >= 16:
        shown = text[0] + ('.' + text[1:] if text[1:] else '') + f'e{power:+03d}'
    elif power < 0:
        shown = '0.' + '0' * (-power - 1) + text
    else:
        text = text.ljust(power + 1, '0')
        shown = text[:power + 1] + ('.' + text[power + 1:] if text[power + 1:] else '')
    return '-' + shown if f < 0 else shown


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


# ---------------------------------------------------------------- vectors

def plus(a, b):
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def times(s, a):
    return s * a[0], s * a[1], s * a[2]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def in_basis(x, y, u):
    """Integers (s, t, d), d > 0: (s·x + t·y)/d is the point of the plane of x and y that is nearest to u."""
    xx, xy, yy, ux, uy = dot(x, x), dot(x, y), dot(y, y), dot(u, x), dot(u, y)
    return ux * yy - uy * xy, uy * xx - ux * xy, xx * yy - xy * xy


# ---------------------------------------------------------------- meshes

def read_coordinate(c):
    return Fraction(c) if abs(c) >= QUANTUM else Fraction(0)


def in_units(position):
    scaled = [read_coordinate(c) * UNIT for c in position]
    assert all(c.denominator == 1 for c in scaled)
    return tuple(c.numerator for c in scaled)


# Places: ('v', vertex), ('e', a, b, t) with a < b, ('t', triangle, beta, gamma). In a state the numbers are integers in
# 0 … 2^24; a place that is not a state holds them as Fractions in 0 … 1.
Sector = namedtuple('Sector', 'triangle x y is_x_line is_y_line')  # s·x + t·y; s ≥ 0 unless x is a line, t likewise


State = namedtuple('State', 'place side g slipping')
NOWHERE = State(None, 'front', None, False)
Way = namedtuple('Way', 'reach kind which end')  # what Mesh.steepest() gives: an edge is of kind 0, a triangle of kind 1


def holds(pull, coefficient, pressure):
    """t² ≤ μ²z² of t² and z², with ∞·0 = 0."""
    if coefficient == math.inf:
        return pressure > 0 or pull == 0
    return pull <= coefficient * coefficient * pressure


class Mesh:
    def __init__(self, vertices, triangles, sides, corner_normals=None, materials=None):
        self.vertices, self.triangles, self.sides = vertices, triangles, sides
        self.materials = materials or [(Fraction(0), Fraction(0))] * len(triangles)  # (static, dynamic): Fraction or inf
        assert len(self.materials) == len(triangles) and all(s >= d for s, d in self.materials)
        self.w = [in_units(v) for v in vertices]
        self.corner_normals = corner_normals
        self.edges, self.fans = {}, {}
        for i, triangle in enumerate(triangles):
            for corner in range(3):
                a, b = triangle[corner], triangle[corner - 2]
                self.edges.setdefault((min(a, b), max(a, b)), []).append(i)
                self.fans.setdefault(a, []).append(i)
        self.spokes = {v: [] for v in self.fans}
        for edge in sorted(self.edges):
            for v in edge:
                self.spokes[v].append(edge)
        self.rim = {edge for edge, own in self.edges.items() if len(own) == 1}
        self.rim |= {v for edge in self.rim for v in edge}
        self.normals = [cross(minus(self.w[b], self.w[a]), minus(self.w[c], self.w[a])) for a, b, c in triangles]

    def is_at_rim(self, place):
        return place[0] == 'v' and place[1] in self.rim or place[0] == 'e' and place[1:3] in self.rim

    def corner(self, i, v):
        return self.corner_normals[i][self.triangles[i].index(v)]

    def weights(self, place):
        """[(vertex, weight)] of a place given in Fractions."""
        if place[0] == 'v':
            return [(place[1], Fraction(1))]
        if place[0] == 'e':
            return [(place[1], 1 - place[3]), (place[2], place[3])]
        a, b, c = self.triangles[place[1]]
        return [(a, 1 - place[2] - place[3]), (b, place[2]), (c, place[3])]

    def point(self, place):
        """The point of a place given in Fractions, in units; for a place on the grid the coordinates are integers."""
        parts = [times(weight, self.w[v]) for v, weight in self.weights(place)]
        return tuple(sum(column) for column in zip(*parts))

    def grid_point(self, place):
        if place[0] == 'v':
            return self.w[place[1]]
        if place[0] == 'e':
            a, b = self.w[place[1]], self.w[place[2]]
            return plus(a, tuple(place[3] * c // GRID for c in minus(b, a)))
        a, b, c = (self.w[v] for v in self.triangles[place[1]])
        return plus(a, tuple((place[2] * x + place[3] * y) // GRID for x, y in zip(minus(b, a), minus(c, a))))

    def reduced(self, place, one):
        """The same place on the edge or vertex that it lies on; `one` is the parameters' unit."""
        if place[0] == 't':
            i, beta, gamma = place[1:]
            held = [(v, w) for v, w in zip(self.triangles[i], (one - beta - gamma, beta, gamma)) if w]
        elif place[0] == 'e':
            held = [(v, w) for v, w in zip(place[1:3], (one - place[3], place[3])) if w]
        else:
            return place
        if len(held) == 3:
            return place
        held.sort()
        return ('v', held[0][0]) if len(held) == 1 else ('e', held[0][0], held[1][0], held[1][1])

    def sectors(self, place):
        """The surface near a place: sectors, half-planes or one plane, from the place as origin."""
        if place[0] == 't':
            a, b, c = (self.w[v] for v in self.triangles[place[1]])
            return [Sector(place[1], minus(b, a), minus(c, a), True, True)]
        if place[0] == 'e':
            a, b = place[1:3]
            off = ((i, next(v for v in self.triangles[i] if v != a and v != b)) for i in self.edges[a, b])
            return [Sector(i, minus(self.w[b], self.w[a]), minus(self.w[c], self.w[a]), True, False) for i, c in off]
        v = place[1]
        ends = ((i, [self.w[c] for c in self.triangles[i] if c != v]) for i in self.fans[v])
        return [Sector(i, minus(x, self.w[v]), minus(y, self.w[v]), False, False) for i, (x, y) in ends]

    def rays(self, place):
        """[(edge, direction away from the place, the vertex at its end)]."""
        if place[0] == 't':
            return []
        if place[0] == 'e':
            a, b = place[1:3]
            along = minus(self.w[b], self.w[a])
            return [((a, b), along, b), ((a, b), times(-1, along), a)]
        v = place[1]
        other = ((edge, edge[0] + edge[1] - v) for edge in self.spokes[v])
        return [(edge, minus(self.w[end], self.w[v]), end) for edge, end in other]

    # ------------------------------------------------------------ directions

    def steepest(self, place, u):
        """(the square of u·v with the sign of u·v, 0 for an edge or 1 for a triangle, which, the end of the edge)."""
        found = []
        for edge, along, end in self.rays(place):
            reach = dot(u, along)
            found.append((-Fraction(reach * abs(reach), dot(along, along)), 0, edge, end))
        for sector in self.sectors(place):
            s, t, d = in_basis(sector.x, sector.y, u)
            inside = (sector.is_x_line or s > 0) and (sector.is_y_line or t > 0)
            if inside and (s or t or place[0] == 't'):
                found.append((-Fraction(s * dot(u, sector.x) + t * dot(u, sector.y), d), 1, sector.triangle, None))
        negated, *way = min(found, key=lambda one: one[:3])
        return (-negated, *way)

    def count_side(self, place, u):
        """front or back, for u off the surface at a place that is not on the rim: crossings of a segment from u to a point of
        the surface are counted. A target for which a crossing is not clear is left for another."""
        sectors = self.sectors(place)
        for attempt in range(1, 1000):
            for target in sectors:
                height = dot(self.normals[target.triangle], u)
                aim = plus(times(attempt, target.x), times(1 + attempt * attempt % 7, target.y))
                if height == 0:
                    continue
                flips = 0
                for other in sectors:
                    if other is target:
                        continue
                    from_u, from_aim = (dot(self.normals[other.triangle], w) for w in (u, aim))
                    if from_u == 0 and from_aim == 0:
                        break
                    if (from_u > 0) - (from_u < 0) != (from_aim < 0) - (from_aim > 0):
                        continue
                    s, t, _ = in_basis(other.x, other.y, plus(times(abs(from_aim), u), times(abs(from_u), aim)))
                    signs = ([] if other.is_x_line else [s]) + ([] if other.is_y_line else [t])
                    if any(c == 0 for c in signs) and all(c >= 0 for c in signs):
                        break
                    flips += all(c > 0 for c in signs)
                else:
                    return 'front' if (height > 0) == (flips % 2 == 0) else 'back'
        raise ArithmeticError('no clear crossing')

    def whereabouts(self, place, u):
        """on, open, front or back."""
        if self.steepest(place, u)[0] == dot(u, u):
            return 'on'
        return 'open' if self.is_at_rim(place) else self.count_side(place, u)

    # ------------------------------------------------------------ one tick

    def crossings(self, g, u):
        """Every point of the surface at g + h·u, 0 < h ≤ 1, as (h, place in Fractions), in order."""
        axis = min(range(3), key=lambda k: abs(u[k]))
        one = cross(u, tuple(int(k == axis) for k in range(3)))
        two = cross(u, one)
        seen = {}
        for v in self.fans:
            from_g = minus(self.w[v], g)
            seen[v] = dot(from_g, one), dot(from_g, two), dot(from_g, u)
        found = [(Fraction(seen[v][2]), ('v', v)) for v in self.fans if seen[v][:2] == (0, 0)]
        area = {}
        for a, b in self.edges:
            (ax, ay, ah), (bx, by, bh) = seen[a], seen[b]
            area[a, b] = ax * by - ay * bx
            area[b, a] = -area[a, b]
            if area[a, b] == 0 and ax * bx + ay * by < 0:
                t = Fraction(ax, ax - bx) if ax != bx else Fraction(ay, ay - by)
                found.append((ah + t * (bh - ah), ('e', a, b, t)))
        for i, (a, b, c) in enumerate(self.triangles):
            parts = area[b, c], area[c, a], area[a, b]
            if min(parts) > 0 or max(parts) < 0:
                _, beta, gamma = (Fraction(part, sum(parts)) for part in parts)
                height = (1 - beta - gamma) * seen[a][2] + beta * seen[b][2] + gamma * seen[c][2]
                found.append((height, ('t', i, beta, gamma)))
        full = dot(u, u)
        return sorted((height / full, place) for height, place in found if 0 < height <= full)

    def flight(self, g, u):
        """(place in Fractions or None, side, whether it is at p)."""
        for h, place in self.crossings(g, u):
            before, after = self.whereabouts(place, times(-1, u)), self.whereabouts(place, u)
            assert before != 'on'
            side = 'front' if self.sides == 'front' or self.is_at_rim(place) else before
            if h == 1:
                return place, side, True
            passes = after == 'open' or after == before or self.sides == 'front' and (before, after) == ('back', 'front')
            if not passes:
                return place, side, False
        return None, 'front', True

    def on_grid(self, place, p):
        """Rule 3: of the grid points around a place, the one nearest to p."""
        if place[0] == 'v':
            return place
        if place[0] == 'e':
            t = place[3] * GRID
            near = [('e', *place[1:3], m) for m in range(math.floor(t) - 1, math.floor(t) + 3) if abs(m - t) < 1]
        else:
            k0, l0 = place[2] * GRID, place[3] * GRID
            near = [('t', place[1], k, l) for k in range(math.floor(k0) - 1, math.floor(k0) + 3)
                    for l in range(math.floor(l0) - 1, math.floor(l0) + 3)
                    if max(abs(k - k0), abs(l - l0), abs(k + l - k0 - l0)) < 1]

        def distance(candidate):
            apart = minus(self.grid_point(candidate), p)
            return dot(apart, apart), candidate
        best, others = min(map(distance, near)), Counter(distance(candidate)[0] for candidate in near)
        self.reached['ties of grid points'] += others[best[0]] > 1
        self.reached['grid points kept'] += len(near) == 1
        return self.reduced(best[1], GRID)

    reached = Counter()
    most_moves = 256  # a tick

    # ------------------------------------------------------------ friction

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
        """Returns (state, status, moves, the resting place in Fractions)."""
        place, side, g, slipping = state
        moves = 0

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
            self.reached['starts on a rough place'] += 1
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
                        self.reached['sticks while slipping' if slipping else 'sticks'] += 1
                        return stays()
            if moves == self.most_moves:
                return State(place, side, g, slipping), 'unfinished', moves, as_fractions(place)
            if flies:
                x, new_side, is_end = self.flight(g, u)
                if x is None:
                    return State(None, 'front', p, False), 'free', moves + 1, None
            else:
                share, new_side = self.share(u, way), side
                x = self.slide_by(place, p, way, share)
                is_inside = x[0] == 'et'[way.kind]
                is_end = is_inside and share == 1 or self.point(x) == p
            if is_end and not self.is_rough(x):
                self.reached['flies to a smooth rest' if flies else 'slides to a smooth rest'] += 1
                moves, side = moves + 1, new_side
                return at_rest(kept_on_grid(x), x, False)
            landed = self.on_grid(x, p)
            there = self.grid_point(landed)
            left = minus(p, there)
            if not was_free and dot(left, left) >= dot(u, u):
                self.reached['refused flight' if flies else 'refused slide'] += 1
                return stays()
            self.reached[('lands' if was_free else 'flies along') if flies else 'slides'] += 1
            self.reached['ends at p on a rough place'] += flies and is_end
            self.reached['slides less than to a border'] += not flies and share < 1 and is_inside
            self.reached['slips over an edge'] += slipping and not flies and place[0] == 'e' and way.kind == 1
            place, g = landed, there
            side = 'front' if self.is_at_rim(place) else new_side
            slipping = slipping or not flies
            moves += 1

    # ------------------------------------------------------------ contact rules

    def foot_in(self, i, point):
        """The point of a triangle's plane that is nearest to a point."""
        a, b, c = (self.w[v] for v in self.triangles[i])
        x, y = minus(b, a), minus(c, a)
        s, t, d = in_basis(x, y, minus(point, a))
        return plus(a, plus(times(Fraction(s) / d, x), times(Fraction(t) / d, y)))

    def sub_goal(self, state, p):
        """In units; p itself where there is none."""
        place, side, g, _ = state
        if place is None or place[0] != 't':
            return p
        facing = 1 if side == 'front' else -1
        n, N = (times(facing, v) for v in (self.normals[place[1]], self.direction_in(place[1], as_fractions(place))))
        from_g = minus(p, g)
        if dot(from_g, n) >= 0 or dot(from_g, N) >= 0:
            return p
        on_plane = minus(p, times(Fraction(dot(from_g, N)) / dot(N, N), N))
        goal = plus(p, minus(self.foot_in(place[1], on_plane), self.foot_in(place[1], p)))
        self.reached['sub-goals'] += 1
        return in_units(bounded(rounded(Fraction(c) / UNIT) for c in goal))

    def tick_by_sub_goal(self, state, p):
        goal = self.sub_goal(state, p)
        result = self.tick(state, goal)
        if result[1] == 'free' and goal != p:
            self.reached['sub-goals off the surface'] += 1
            return self.tick(state, p)
        return result

    # ------------------------------------------------------------ force

    def direction_in(self, i, rest):
        """N at the resting place, by the corners of triangle i alone."""
        return tuple(map(sum, zip(*(times(w, self.corner(i, v)) for v, w in self.weights(rest)))))

    def shading_direction(self, rest, side, D):
        """N at the resting place, or None for unshaded; D = r − p."""
        own = self.fans[rest[1]] if rest[0] == 'v' else self.edges[rest[1:3]] if rest[0] == 'e' else [rest[1]]
        corners = {tuple(self.corner(i, v) for v, _ in self.weights(rest)) for i in own}
        facing = 1 if side == 'front' else -1
        if len(corners) == 1:
            N = times(facing, self.direction_in(own[0], rest))
        elif rest[0] == 'v':
            self.reached['unshaded at a vertex'] += 1
            return None
        else:
            n1, n2 = (times(facing, self.normals[i]) for i in own)
            if not any(cross(n1, n2)):
                return None
            s, t, d = in_basis(n1, n2, D)
            if s < 0 or t < 0 or plus(times(s, n1), times(t, n2)) != times(d, D):
                self.reached['unshaded on a crease'] += 1
                return None
            self.reached['shaded on a crease'] += 1
            q1, q2 = (Fraction(rounded_root(Fraction(dot(n, n), UNIT**4))) for n in (n1, n2))
            N1, N2 = (self.direction_in(i, rest) for i in own)
            N = times(facing, plus(times(s * q1, N1), times(t * q2, N2)))
        if dot(N, D) <= 0:
            self.reached['unshaded, N away from D'] += 1
            return None
        return N

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


def as_fractions(place):
    return place if place[0] == 'v' else (*place[:-1], Fraction(place[3], GRID)) if place[0] == 'e' else (
        *place[:2], Fraction(place[2], GRID), Fraction(place[3], GRID))


def kept_on_grid(place):
    """Rule 4: the parameters rounded to even and kept inside."""
    if place[0] == 'v':
        return place
    if place[0] == 'e':
        return (*place[:3], min(max(round(place[3] * GRID), 1), GRID - 1))
    k, l = (max(round(parameter * GRID), 1) for parameter in place[2:])
    excess = max(k + l - (GRID - 1), 0)
    return (*place[:2], k - excess, l) if k >= l else (*place[:2], k, l - excess)


TABLE = ['name', 'sides', 'crease_degrees', 'triangles', 'ticks']
COLUMNS = 'x_mm,y_mm,z_mm,status,feature,side,moves,fx_N,fy_N,fz_N,sx_N,sy_N,sz_N'


def follow(mesh, positions, tick=Mesh.tick):
    """The rows of a path, with the bit of slipping."""
    state = NOWHERE
    for position in positions:
        moves, forces = 0, [0.0] * 6
        if all(abs(c) <= 1e4 for c in position):  # false for NaN too
            p = in_units(position)
            before = state.slipping
            state, status, moves, rest = tick(mesh, state, p)
            mesh.reached['the bit ' + {(0, 1): 'set by a tick', (1, 1): 'kept by a tick', (0, 0): 'left clear',
                                       (1, 0): 'cleared ' + ('at a rest' if state.place else 'by a flight')}
                         [before, state.slipping]] += 1
            forces = mesh.forces(rest, state.side, p)
        else:
            status = 'invalid'
        where = ('-', '-') if state.place is None else (' '.join(map(str, state.place)), state.side)
        yield [*map(shortest, position), status, *where, str(int(state.slipping)), str(moves), *map(shortest, forces)]


def follow_smooth(*arguments):
    """The same without the bit, which only an unfinished tick sets where nothing is rough."""
    for row in follow(*arguments):
        assert row[6] == '0' or row[3] in ('unfinished', 'invalid')
        yield row[:6] + row[7:]


# ---------------------------------------------------------------- corner normals

DIGITS = 90
DOUBT = Fraction(1, 10**70)


def arc_tangent(t):
    """For t ≥ 0, to nearly all digits of the context: the angle is halved eight times, then the series."""
    for _ in range(8):
        t = t / (1 + (1 + t * t).sqrt())
    total, power, n = Decimal(0), t, 0
    while abs(power) > Decimal(10)**-(DIGITS + 10):
        total += power / (2 * n + 1) * (-1)**n
        power *= t * t
        n += 1
    return 256 * total


def cosine(degrees):
    x = Decimal(degrees) * 4 * arc_tangent(Decimal(1)) / 180
    total, term, n = Decimal(0), Decimal(1), 0
    while abs(term) > Decimal(10)**-(DIGITS + 10):
        total += term
        n += 2
        term *= -x * x / (n * (n - 1))
    return total


def exact_decimal(vector):
    return tuple(Decimal(c.numerator) / Decimal(c.denominator) for c in map(Fraction, vector))


def unit_normals(mesh):
    """In the precision of the context."""
    unit = []
    for n in mesh.normals:
        n = exact_decimal(Fraction(c, UNIT**2) for c in n)
        unit.append(times(1 / dot(n, n).sqrt(), n))
    return unit


def creases(mesh, crease_degrees):
    """The edges whose two triangles turn by more."""
    if crease_degrees == 180:
        return set()
    with localcontext() as context:
        context.prec = DIGITS + 20
        unit, least = unit_normals(mesh), cosine(crease_degrees)
        excess = {edge: dot(unit[own[0]], unit[own[1]]) - least for edge, own in mesh.edges.items() if len(own) == 2}
        assert all(abs(c) > Decimal(10)**-60 for c in excess.values())
        return {edge for edge, c in excess.items() if c < 0}


def groups(mesh, separating):
    """(vertex, triangles) for those around a vertex that are joined over edges there which do not separate."""
    for v, fan in mesh.fans.items():
        group = {i: i for i in fan}

        def first(i):
            return i if group[i] == i else first(group[i])
        for edge in mesh.spokes[v]:
            if len(mesh.edges[edge]) == 2 and edge not in separating:
                i, j = map(first, mesh.edges[edge])
                group[max(i, j)] = min(i, j)
        for leader in sorted(set(map(first, fan))):
            yield v, [i for i in fan if first(i) == leader]


def rounded_surely(c):
    """The binary32 nearest to a decimal with an error below DOUBT."""
    low, high = rounded(Fraction(c) - DOUBT), rounded(Fraction(c) + DOUBT)
    assert low == high or abs(c) < DOUBT
    return low if low == high else 0.0


def corner_normals(mesh, crease_degrees):
    """The unit angle-weighted means, as binary32; no component is near enough to a tie to be in doubt."""
    separating = creases(mesh, crease_degrees)
    with localcontext() as context:
        context.prec = DIGITS + 20
        unit = unit_normals(mesh)

        def angle(i, v):
            k = mesh.triangles[i].index(v)
            x, y = (exact_decimal(Fraction(c, UNIT) for c in minus(mesh.w[mesh.triangles[i][k - away]], mesh.w[v]))
                    for away in (1, 2))
            area, along = cross(x, y), dot(x, y)
            size = (dot(x, x) * dot(y, y)).sqrt()
            return 2 * arc_tangent(dot(area, area).sqrt() / (size + along))
        result = [[None] * 3 for _ in mesh.triangles]
        for v, own in groups(mesh, separating):
            total = (Decimal(0),) * 3
            for i in own:
                total = plus(total, times(angle(i, v), unit[i]))
            size = dot(total, total).sqrt()
            normal = tuple(map(rounded_surely, times(1 / size, total))) if size > Decimal(10)**-60 else (0.0,) * 3
            for i in own:
                result[i][mesh.triangles[i].index(v)] = normal
    return result


# ---------------------------------------------------------------- checking other paths

def read_off(path):
    words = [line.split() for line in path.read_text().splitlines() if line.strip()]
    vertices, triangles = int(words[1][0]), int(words[1][1])
    body = words[2:]
    return ([tuple(map(from_text, line)) for line in body[:vertices]],
            [tuple(map(int, line[1:])) for line in body[vertices:vertices + triangles]])


def listed(directory):
    """{name: (sides, crease in degrees)} of meshes.csv, or of the table in README.md where there is no such file."""
    table = directory / 'meshes.csv'
    if table.exists():
        with open(table, newline='') as file:
            return {row['name']: (row['sides'], int(row['crease_degrees'])) for row in csv.DictReader(file)}
    rows = re.findall(r'^\| `(\w+)` \| \d+ \| (front|both) \| (none|\d+)', (directory / 'README.md').read_text(), re.M)
    return {name: (sides, 180 if crease == 'none' else int(crease)) for name, sides, crease in rows}


def read_path(directory, name, sides):
    """The mesh with the file's own corner normals, and the rows of the path."""
    vertices, triangles = read_off(directory / f'{name}.off')
    mesh = Mesh(vertices, triangles, sides)
    with open(directory / f'{name}.normals.csv', newline='') as file:
        normals = list(csv.reader(file))[1:]
    mesh.corner_normals = [[tuple(Fraction(from_text(c)) for c in row[2:]) for row in normals[3 * i:3 * i + 3]]
                           for i in range(len(triangles))]
    with open(directory / f'{name}.csv', newline='') as file:
        header, *rows = csv.reader(file)
    assert ','.join(header) == COLUMNS
    return mesh, normals, rows


def compare(name, rows, path):
    """The number of rows that differ from the path that is computed; the first are printed."""
    wrong = [f'line {number}: {",".join(row)}\n    computed {",".join(own)}'
             for number, (row, own) in enumerate(zip(rows, path), 2) if row != own]
    print(f'{name}: {len(rows)} rows, {len(wrong)} differences', *wrong[:3], sep='\n    ', flush=True)
    return len(wrong)


def positions_of(rows):
    return [tuple(map(from_text, row[:3])) for row in rows]


def check(directory, only):
    """The number of differences."""
    different = 0
    for name, (sides, crease) in listed(directory).items():
        if only and name not in only:
            continue
        mesh, given, rows = read_path(directory, name, sides)
        normals = [[*row[:2], *map(shortest, c)] for row, c in zip(given, sum(corner_normals(mesh, crease), []), strict=True)]
        different += compare(f'{name}, corner normals', given, normals)
        different += compare(name, rows, follow_smooth(mesh, positions_of(rows)))
    print(dict(Mesh.reached))
    return different


def write(path, rows):
    with open(path, 'w', newline='') as file:
        csv.writer(file, lineterminator='\n').writerows(rows)


# ---------------------------------------------------------------- the meshes

# size: of a typical stroke, mm. hot: narrow places, as (point, how far around it in mm, the point from where it is entered).
Scene = namedtuple('Scene', 'name vertices triangles sides crease size hot ticks')


def dyadic(x, bits=10):
    return math.floor(x * 2**bits + 0.5) / 2**bits


def turned(i, n, shift=0.0):
    """A point of the unit circle, near to 2 pi (i + shift)/n: snapped, so that it does not depend on the library's cosine."""
    angle = 2 * math.pi * (i + shift) / n
    return dyadic(math.cos(angle)), dyadic(math.sin(angle))


def sheet(columns, rows, place):
    """A grid of columns x rows quadrilaterals, every second diagonal turned; place(i, j) is a vertex."""
    vertices = [place(i, j) for j in range(rows + 1) for i in range(columns + 1)]
    triangles = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c, d = a + 1, a + columns + 1, a + columns + 2
            triangles += [(a, b, d), (a, d, c)] if (i + j) % 2 else [(a, b, c), (d, c, b)]
    return vertices, triangles


def prism(outline, cap, low, high):
    """Over an outline that runs counterclockwise; cap: its triangles."""
    n = len(outline)
    vertices = [(x, y, z) for z in (low, high) for x, y in outline]
    triangles = [(a, c, b) for a, b, c in cap] + [(a + n, b + n, c + n) for a, b, c in cap]
    for i in range(n):
        j = (i + 1) % n
        triangles += [(i, j, n + j), (i, n + j, n + i)]
    return vertices, triangles


TETRAHEDRON = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def scenes():
    def one(name, mesh, sides, crease, size, hot=(), ticks=300):
        vertices, triangles = mesh
        return Scene(name, [tuple(map(single, map(float, v))) for v in vertices], triangles, sides, crease, size, hot, ticks)
    yield one('tetrahedron', ([(-3.1, -2.7, -1.9), (1.3, -2.2, -2.6), (0.7, 2.1, -2.3), (9.4, 3.9, 4.7)], TETRAHEDRON),
              'front', 180, 2)
    yield one('cube', prism([(-4, -4), (4, -4), (4, 4), (-4, 4)], [(0, 1, 2), (0, 2, 3)], -4, 4), 'front', 40, 4)
    yield one('l_prism', prism([(-5, -5), (4, -5), (4, -1), (-1, -1), (-1, 6), (-5, 6)],
                               [(0, 1, 3), (1, 2, 3), (0, 3, 5), (3, 4, 5)], -2, 3), 'front', 60, 3, [((-1, -1, 0), 2**-12)])
    yield one('folded_sheet', sheet(6, 3, lambda i, j: (2 * i - 6, 2.5 * j - 4 + 0.25 * (i % 2), 1.5 * abs(i - 3) + 0.125 * j)),
              'both', 180, 3, [((0, 1, 0.25), 2**-10)])
    yield one('hairpin', sheet(4, 4, lambda i, j: (3 * abs(i - 2) - 4 + 0.5 * (j % 2), 2 * j - 4, (i > 2) * 2.0**-8)),
              'both', 60, 2, [((0, 0, 2.0**-9), 2**-6, (20, 0, 2.0**-9)), ((-4, 1, 0), 2**-7),
                              ((-3.5, 0, 2.0**-10), 2**-8, (20, 0, 2.0**-9))])
    ring = [(6 * x, 6 * y, 2.5 * (-1)**i) for i, (x, y) in enumerate(turned(i, 8) for i in range(8))]
    outer = [(10 * x, 10 * y, 4.5 * (-1)**i) for i, (x, y) in enumerate(turned(i, 8) for i in range(8))]
    triangles = [(0, 1 + i, 1 + (i + 1) % 8) for i in range(8)]
    for i in range(8):
        a, b = 1 + i, 1 + (i + 1) % 8
        triangles += [(a, a + 8, b + 8), (a, b + 8, b)]
    yield one('saddle_8', ([(0, 0, 0), *ring, *outer], triangles), 'both', 180, 4, [((0, 0, 0), 2**-3), ((0, 0, 0), 2**-22)])
    crown = [(x * (7 + 2 * (i % 2)), y * (7 + 2 * (i % 2)), 1.5 * (i % 2)) for i, (x, y) in
             enumerate(turned(i, 40, 0.25) for i in range(40))]
    yield one('fan_40', ([(0, 0, 5), *crown, (0, 0, -3)], [t for i in range(40) for t in
                          ((0, 1 + i, 1 + (i + 1) % 40), (41, 1 + (i + 1) % 40, 1 + i))]),
              'front', 180, 3, [((0, 0, 5), 2**-4), ((0, 0, 4), 2)])
    # The rows are shifted against each other, so that the grid points of neighbouring rows of a triangle's grid are not opposite.
    yield one('slivers', sheet(2, 12, lambda i, j: (700 * (i - 1) + 310 * (j % 2), (j - 6) / 64 + (i == 2) / 256,
                                                    (j * j % 5) / 256)),
              'both', 40, 0.25, [((0, 0, 1 / 256), 2**-6), ((175 / 256, 2.0**-18, 1 / 256), 2**-16),
                                 ((175 / 256, 2.0**-18, 1 / 256), 2**-19), ((-175 / 512, 0, 1 / 256), 2**-17)], 420)
    gap = 2.0**-24
    yield one('near_parts', ([(0, -8, -8), (0, 8, -8), (0, 0, 9), (-9, 0, 0),
                              (gap, 7, -6), (gap, -6.5, -7), (2 * gap, 0.5, 8), (9, 0, 0)],
                             [(0, 1, 2), (1, 0, 3), (2, 1, 3), (0, 2, 3), (4, 5, 6), (5, 4, 7), (6, 5, 7), (4, 6, 7)]),
              'front', 60, 3, [((gap / 2, 0.25, 0.125), 2**-22, (gap / 2, 20, 0.125)),
                               ((gap / 2, 0.25, -6.5), 2**-22, (gap / 2, 0.25, -20)), ((0, 0, 0), 2**-4)], 420)
    circle = [turned(j, 6, 0.5) for j in range(6)]
    torus = [(x * (6 + 2.5 * c), y * (6 + 2.5 * c), 2.5 * s) for x, y in (turned(i, 8) for i in range(8)) for c, s in circle]
    triangles = []
    for i in range(8):
        for j in range(6):
            a, b, c, d = (6 * (k % 8) + l % 6 for k, l in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
            triangles += [(a, b, c), (a, c, d)]
    yield one('torus', (torus, triangles), 'front', 50, 3, [((0, 0, 0), 4)])
    yield one('stairs', sheet(8, 3, lambda i, j: (2 * ((i + 1) // 2) - 4, 3 * j - 4, 2 * (i // 2) - 4)), 'both', 30, 3,
              [((0, -1, 0), 2**-1), ((0, -1, -2), 2**-1), ((-2, 0, -2), 2**-9)])
    tiny = 2.0**-20
    yield one('scaled_down', ([tuple(tiny * c for c in v) for v in
                               ((5, 0.25, 0), (-4, 0, 0.5), (0, 4.5, 0), (0.25, -5, 0), (0, 0, 6), (0.5, 0, -3))],
                              [(4, 0, 2), (4, 2, 1), (4, 1, 3), (4, 3, 0), (5, 2, 0), (5, 1, 2), (5, 3, 1), (5, 0, 3)]),
              'front', 180, 3 * tiny, [((0, 0, 0), 4 * tiny)])
    yield one('far', sheet(4, 4, lambda i, j: (9984 + 4 * i, -10000 + 4 * j, 9990 + (i * 7 + j * 5) % 6)), 'both', 75, 3,
              [((9992, -9992, 9992), 2**-6)])
    yield one('ribbon', sheet(140, 1, lambda i, j: ((i - 70) / 2, 2 * j - 1 + (i % 2) / 8, -(i - 70)**2 / 128)), 'both', 1,
              1, (), 60)


def assert_is_mesh(mesh):
    """Edges have one or two triangles, in opposite directions; no edge and no vertex meets the surface where it should not."""
    directed = Counter((t[k - 1], t[k]) for t in mesh.triangles for k in range(3))
    assert max(directed.values()) == 1
    volume = sum(dot(mesh.w[a], cross(mesh.w[b], mesh.w[c])) for a, b, c in mesh.triangles)
    assert mesh.rim or volume > 0
    for a, b in mesh.edges:
        assert mesh.crossings(mesh.w[a], minus(mesh.w[b], mesh.w[a])) == [(1, ('v', b))]
    u = UNIT // 7, UNIT // 11, UNIT // 13
    for v in mesh.fans:
        assert [place for h, place in mesh.crossings(minus(mesh.w[v], u), u) if h == 1] == [('v', v)]


# ---------------------------------------------------------------- the paths

INVALID = [(math.nan, 0.0, 0.0), (0.0, math.inf, 0.0), (0.0, 1.0, -math.inf), (0.0, 0.0, step(1e4, 1)),
           (step(-1e4, -1), 0.0, 0.0), (0.0, single(1e26), 0.0)]


def bounded(position):
    return tuple(min(max(single(c), -1e4), 1e4) + 0.0 for c in position)


class Paths:
    """Pieces of paths over one mesh. Only sums, products, quotients and square roots, so the same on every machine."""

    tries = 150  # of a refusal

    def __init__(self, scene, mesh):
        self.mesh, self.scene, self.draw = mesh, scene, Draw(f'forceshade god-object {scene.name}')
        self.last = (0.0, 0.0, 0.0)

    def number(self, most):
        return most * (2 * self.draw.random() - 1)

    def on_surface(self):
        """A point of a triangle, often of its border, and the unit normal there."""
        t = self.draw.pick(self.scene.triangles)
        a, b, c = (self.scene.vertices[v] for v in t)
        r, s = self.draw.random(), self.draw.random()
        kind = int(8 * self.draw.random())
        if kind == 0:
            r, s = 0, 0
        elif kind == 1:
            r, s = 0.5, 0.5
        elif kind == 2:
            r, s = 0.25, 0.5
        elif r + s > 1:
            r, s = 1 - r, 1 - s
        n = cross(minus(b, a), minus(c, a))
        return plus(a, plus(times(r, minus(b, a)), times(s, minus(c, a)))), times(1 / math.sqrt(dot(n, n)), n)

    def above(self, height):
        point, n = self.on_surface()
        return plus(point, times(height, n))

    def facing(self):
        return self.draw.pick((1, -1)) if self.scene.sides == 'both' else 1

    def stroke(self):
        """Pressed in at one place, dragged to another, lifted."""
        facing, size = self.facing(), self.scene.size
        depth = size * self.draw.pick((0.01, 0.1, 0.3, 1.0, 2.0))
        (start, m), (end, n) = self.on_surface(), self.on_surface()
        yield plus(start, times(facing * size, m))
        count = 4 + int(8 * self.draw.random())
        for i in range(count + 1):
            middle = plus(times(1 - i / count, minus(start, times(facing * depth, m))),
                          times(i / count, minus(end, times(facing * depth, n))))
            yield middle
        if self.draw.random() < 0.7:
            yield plus(end, times(facing * size, n))

    def walk(self):
        """Steps of 1e-9 to 1e3 mm; back to the surface when it is lost."""
        position = self.above(self.facing() * self.scene.size / 8)
        center, reach = position, 12 * self.scene.size
        yield position
        for _ in range(16):
            length = math.ldexp(1 + self.draw.random(), -30 + int(40 * self.draw.random()))
            position = plus(position, tuple(self.number(length) for _ in range(3)))
            yield position
            if max(map(abs, minus(position, center))) > reach:
                position = self.above(-self.facing() * self.scene.size / 8)

    def along_axis(self):
        """Exactly through a vertex, the middle of an edge or a point of a triangle."""
        t = self.draw.pick(self.scene.triangles)
        a, b = (self.scene.vertices[t[k]] for k in (0, 1))
        through = self.draw.pick((a, times(0.5, plus(a, b)), self.on_surface()[0]))
        axis, stride = int(3 * self.draw.random()), self.facing() * self.scene.size / 4
        backwards = self.draw.pick((1, -1))
        for i in range(4, -5, -1):
            offset = [0.0] * 3
            offset[axis] = i * stride * backwards
            yield plus(through, offset)

    def jumps(self):
        lows, highs = ([f(v[k] for v in self.scene.vertices) for k in range(3)] for f in (min, max))
        for _ in range(5):
            yield tuple(low + (high - low) * (1.5 * self.draw.random() - 0.25) + self.number(self.scene.size)
                        for low, high in zip(lows, highs))

    def on_it(self):
        """Exactly on the surface, or as near as binary32 comes."""
        for _ in range(4):
            yield self.on_surface()[0]
        yield self.draw.pick(self.scene.vertices)

    def next_door(self):
        """One unit in the last place from where the last piece ended."""
        position = bounded(self.last)
        for _ in range(5):
            axis = int(3 * self.draw.random())
            position = tuple(step(c, self.draw.pick((-1, 1))) if k == axis else c for k, c in enumerate(position))
            yield position

    def hot(self):
        """Close to a place where something is narrow, which may have to be entered from the right side."""
        point, reach, *entry = self.draw.pick(self.scene.hot)
        if entry and self.draw.random() < 0.6:
            yield from (*entry, point)
        if self.draw.random() < 0.7:  # creep around a place beside it
            point = plus(point, tuple(self.number(reach) for _ in range(3)))
            reach *= self.draw.pick((0.5, 0.125, 0.03, 0.03))
        for _ in range(15):
            kept = int(4 * self.draw.random())
            yield tuple(c if k == kept else c + self.number(reach) for k, c in enumerate(point))

    def refusal(self):
        """Tries until a move near a narrow place is refused because of the grid; gives up where that is rare."""
        point, reach, *entry = self.draw.pick(self.scene.hot)
        for _ in range(self.tries):
            found = [*entry, point]
            found += [tuple(c + self.number(reach) for c in point) for _ in range(2)]
            state, before = NOWHERE, Counter(self.mesh.reached)
            for position in found:
                state = self.mesh.tick(state, in_units(bounded(position)))[0]
            news = self.mesh.reached - before
            self.mesh.reached.clear()
            self.mesh.reached.update(before)
            if news['refused flight'] + news['refused slide']:
                yield from found
                return

    def pieces(self):
        often = [*[self.stroke] * 3, *[self.walk] * 2, *[self.along_axis] * 2, self.jumps, self.on_it, self.next_door]
        return often + ([*[self.hot] * 4, *[self.refusal] * 4] if self.scene.hot else [])

    def positions(self):
        pieces = self.pieces()
        start = self.above(self.scene.size)
        count = 0
        for piece in self.pieces_in_turn(pieces, start):
            for position in piece:
                self.last = bounded(position)
                again = self.draw.random()
                for result in [self.last] * (1 + (again < 0.06) + (again < 0.02)):
                    if self.draw.random() < 0.012:
                        yield self.draw.pick(INVALID)
                        count += 1
                    yield result
                    count += 1
                    if count >= self.scene.ticks:
                        return

    def pieces_in_turn(self, pieces, start):
        if self.scene.name == 'ribbon':  # so far along it that the moves of one tick do not suffice
            yield [(-34.25, 0.25, -33.0), (-34.25, 0.25, -37.5), *[(34.25, 0.25, -37.0)] * 3]
        yield [start]
        while True:
            yield self.draw.pick(pieces)()


# ---------------------------------------------------------------- the files

MUST_OCCUR = ['free', 'touching', 'unfinished', 'invalid', 'v front', 'v back', 'e front', 'e back', 't front', 't back',
              'flies to a smooth rest', 'slides to a smooth rest', 'refused flight', 'refused slide', 'lands', 'flies along', 'slides',
              'ties of grid points', 'grid points kept', 'shaded on a crease', 'unshaded on a crease', 'unshaded at a vertex',
              'unshaded, N away from D']


def write_path(directory, scene, normals, rows):
    lines = ['OFF', f'{len(scene.vertices)} {len(scene.triangles)} 0']
    lines += [' '.join(map(shortest, v)) for v in scene.vertices]
    lines += [' '.join(map(str, (3, *t))) for t in scene.triangles]
    (directory / f'{scene.name}.off').write_text('\n'.join(lines) + '\n')
    write(directory / f'{scene.name}.normals.csv',
          [['triangle', 'corner', 'nx', 'ny', 'nz'],
           *([i, k, *map(shortest, n)] for i, corners in enumerate(normals) for k, n in enumerate(corners))])
    write(directory / f'{scene.name}.csv', [COLUMNS.split(','), *rows])


def places_of(rows):
    seen = Counter(row[3] for row in rows)
    seen.update(f'{row[4][0]} {row[5]}' for row in rows if row[3] == 'touching')
    return seen


# Some of the meshes, with smooth normals, and a part of their paths.
BY_SUB_GOAL = {'tetrahedron', 'l_prism', 'folded_sheet', 'saddle_8', 'torus', 'stairs', 'far'}
MUST_OCCUR_BY_SUB_GOAL = ['free', 'touching', 'invalid', 'v front', 'v back', 'e front', 'e back', 't front', 't back',
                          'sub-goals', 'sub-goals off the surface']


def main(directory, chosen, tick, must_occur):
    directory.mkdir(exist_ok=True)
    table = []
    for scene in chosen:
        mesh = Mesh(scene.vertices, scene.triangles, scene.sides)
        assert_is_mesh(mesh)
        normals = corner_normals(mesh, scene.crease)
        mesh.corner_normals = [[tuple(map(Fraction, n)) for n in corners] for corners in normals]
        rows = list(follow_smooth(mesh, Paths(scene, mesh).positions(), tick))
        write_path(directory, scene, normals, rows)
        table.append([scene.name, scene.sides, scene.crease, len(scene.triangles), len(rows)])
        seen = places_of(rows)
        Mesh.reached.update(seen)
        print(f'{scene.name:13}', *(f'{kind} {seen[kind]:3}' for kind in must_occur[:10]), flush=True)
    write(directory / 'meshes.csv', [TABLE, *table])
    print(*(f'{kind}: {Mesh.reached[kind]}' for kind in must_occur), sep='\n')
    assert all(Mesh.reached[kind] for kind in must_occur)


if __name__ == '__main__':
    if sys.argv[1:2] == ['--check']:
        sys.exit(1 if check(Path(sys.argv[2]), sys.argv[3:]) else 0)
    here = Path(__file__).parent
    if sys.argv[1:2] == ['--sub-goal']:
        some = (scene._replace(crease=180, ticks=120) for scene in scenes() if scene.name in BY_SUB_GOAL)
        sys.exit(main(Path(sys.argv[2]) if len(sys.argv) > 2 else here / 'sub_goal_god_object', some, Mesh.tick_by_sub_goal,
                      MUST_OCCUR_BY_SUB_GOAL))
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else here / 'god_object', scenes(), Mesh.tick, MUST_OCCUR)
