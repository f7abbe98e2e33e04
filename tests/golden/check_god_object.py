#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks paths of a god-object against what docs/god-object.md promises, tick by tick, without computing a path.

Usage: check_god_object.py [--single-moves] [directory] [mesh ...]
       (the default is god_object/ beside this file; --single-moves: a tick has at most one move; exits with 1 if a tick is wrong)

It shares no code with make_god_object_golden.py. It reads the rows alone, and so cannot see the moves inside of a tick; for this
the other program writes the same paths as ticks of one move. Per tick:
  - the state is well formed: indices, parameters in range, front at a rim, unchanged where the position is invalid;
  - a tick of one move that begins or ends free is one straight segment: it crosses no triangle from a side that is blocked;
    where it lands, it was stopped, and is on the side that it came from; a tick of one move along the surface is the steepest
    slide and ends where this meets the border, or inside; a tick without a move changes nothing;
  - on a closed mesh also after several moves: the god-object is not behind the surface when it was in front (and with `both` not
    in front when it was behind);
  - the force is the binary32 nearest to K (r - p), where r is the nearest point to p on the plane or line of the state's triangle
    or edge, if this rounds to the state, and else the state's own point;
  - at r no direction along the surface leads nearer to p, and p is on the blocked side; or the move was refused: then the way to
    the next border, times the gain per length, is at most h^2/3;
  - from surface point to surface point the distance to p does not grow;
  - the same position again gives the same state and forces;
  - the shaded force has the size of the unshaded one and does not point away from it.
All numbers are integers: coordinates in units of 2^-77 mm, so that a state is a point with integer coordinates.
"""

import csv
import math
import re
import struct
import sys
from collections import Counter
from fractions import Fraction as Q
from itertools import pairwise
from pathlib import Path

STEPS = 2**24
SCALE = 2**77


# ---------------------------------------------------------------- numbers and vectors

def bits_to_float(bits):
    return struct.unpack('<f', struct.pack('<I', bits))[0]


def float_to_bits(f):
    return struct.unpack('<I', struct.pack('<f', f))[0]


def neighbours(f):
    """The binary32 numbers next to f, as rationals, and whether the last bit of f is 0."""
    bits = float_to_bits(abs(f))
    near = [bits_to_float(bits + 1), -bits_to_float(1) if bits == 0 else bits_to_float(bits - 1)]
    return [Q(n) if f >= 0 else -Q(n) for n in near], bits % 2 == 0


def is_nearest(f, exact):
    """True if the binary32 f is `exact` rounded to the nearest, ties to even."""
    others, is_even = neighbours(f)
    own = abs(Q(f) - exact)
    return all(own < abs(other - exact) or own == abs(other - exact) and is_even for other in others)


def number(text):
    """The binary32 nearest to a decimal: the guess from a binary64 is one of three."""
    guess = float(text)
    if not math.isfinite(guess) or abs(guess) > 3e38:
        return guess
    exact, bits = Q(text), float_to_bits(abs(guess))
    sign = -1.0 if guess < 0 else 1.0
    return next(sign * bits_to_float(b) for b in (bits, bits + 1, max(bits - 1, 0)) if is_nearest(sign * bits_to_float(b), exact))


def integer_point(position):
    return [0 if abs(c) < 2.0**-30 else int(Q(c) * SCALE) for c in position]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def det(a, b, c):
    return dot(a, cross(b, c))


# ---------------------------------------------------------------- surfaces

class Surface:
    def __init__(self, points, faces, sides):
        self.points, self.faces, self.both = points, faces, sides == 'both'
        self.edge_faces, self.vertex_faces = {}, {}
        for f, face in enumerate(faces):
            for k in range(3):
                self.edge_faces.setdefault(frozenset((face[k], face[k - 1])), []).append(f)
                self.vertex_faces.setdefault(face[k], []).append(f)
        self.rim = {e for e, own in self.edge_faces.items() if len(own) == 1}
        self.rim_vertices = {v for e in self.rim for v in e}
        self.normal = [cross(sub(points[b], points[a]), sub(points[c], points[a])) for a, b, c in faces]
        self.box = [[(min(points[v][k] for v in face), max(points[v][k] for v in face)) for k in range(3)] for face in faces]
        self.is_inside_out = sum(det(*(points[v] for v in face)) for face in faces) < 0
        self.longest_squared = max(dot(s, s) for s in (sub(points[a], points[b]) for a, b in map(tuple, self.edge_faces)))

    def is_rim(self, corners):
        return corners in self.rim if len(corners) == 2 else len(corners) == 1 and next(iter(corners)) in self.rim_vertices

    def faces_at(self, corners):
        return [f for f in self.vertex_faces[next(iter(corners))] if corners <= set(self.faces[f])]

    def side(self, corners, u):
        """front, back, on or open: where u points, from a point inside of the vertex, edge or triangle with these corners."""
        own = self.faces_at(corners)
        if len(corners) == 3:
            height = dot(self.normal[own[0]], u)
            return 'front' if height > 0 else 'back' if height < 0 else 'on'
        if len(corners) == 2:
            return self.side_of_edge(corners, own, u)
        return self.side_of_vertex(next(iter(corners)), own, u)

    def side_of_edge(self, corners, own, u):
        a, b = sorted(corners)
        along = sub(self.points[b], self.points[a])
        offs = []
        for f in own:
            c, = set(self.faces[f]) - corners
            off = sub(self.points[c], self.points[a])
            offs.append(off)
            # In the plane of the triangle, and not beyond the edge from it: u leaves the edge as its third corner does.
            if dot(self.normal[f], u) == 0 and dot(cross(along, u), cross(along, off)) >= 0:
                return 'on'
        if len(own) == 1:
            return 'open'
        above = [dot(self.normal[f], u) > 0 for f in own]
        is_narrow = dot(self.normal[own[0]], offs[1]) > 0
        return 'front' if (all(above) if is_narrow else any(above)) else 'back'

    def side_of_vertex(self, v, own, u):
        """By the nearest direction along the surface: the signed squared cosine, as a rational, of every candidate."""
        size, best = dot(u, u), None
        for f in own:
            n = self.normal[f]
            k = self.faces[f].index(v)
            x, y = (sub(self.points[self.faces[f][k - away]], self.points[v]) for away in (2, 1))  # counterclockwise
            for end, way in ((self.faces[f][k - 2], x), (self.faces[f][k - 1], y)):
                reach = dot(u, way)
                found = Q(reach * abs(reach), dot(way, way)), 1, frozenset((v, end))
                best = max(best, found, key=lambda one: one[:2]) if best else found
            height = dot(n, u)
            if det(n, x, u) > 0 and det(n, u, y) > 0:  # the projection is strictly between x and y
                found = size - Q(height * height, dot(n, n)), 0, f
                best = max(best, found, key=lambda one: one[:2]) if best else found
        if best[0] == size:
            return 'on'
        if v in self.rim_vertices:
            return 'open'
        if best[1] == 0:
            return 'front' if dot(self.normal[best[2]], u) > 0 else 'back'
        return self.side_of_edge(best[2], self.edge_faces[best[2]], u)

    def meets(self, start, end):
        """[(h, corners of what is met, or None where the segment runs in a triangle)] for 0 < h ≤ 1, in order."""
        u, found = sub(end, start), {}
        box = [(min(a, b), max(a, b)) for a, b in zip(start, end)]
        for f, face in enumerate(self.faces):
            if any(high < own_low or low > own_high for (low, high), (own_low, own_high) in zip(box, self.box[f])):
                continue
            corners = [self.points[v] for v in face]
            n = self.normal[f]
            first, last = dot(n, sub(start, corners[0])), dot(n, sub(end, corners[0]))
            inward = [cross(n, sub(corners[k - 2], corners[k])) for k in range(3)]  # of the edge from k to k + 1
            if first == 0 and last == 0:
                low, high = Q(0), Q(1)
                for way, corner in zip(inward, corners):
                    a, b = dot(way, sub(start, corner)), dot(way, sub(end, corner))
                    if a < 0 and b < 0 or a == b and a < 0:
                        low, high = Q(1), Q(0)
                    elif a < 0:
                        low = max(low, Q(a, a - b))
                    elif b < 0:
                        high = min(high, Q(a, a - b))
                if low < high:
                    found[low] = None
                    continue
                if low > high or low == 0:
                    continue
                h = low
            elif first == last or not 0 < (h := Q(first, first - last)) <= 1:
                continue
            place = [h.denominator * s + h.numerator * c for s, c in zip(start, u)]
            heights = [dot(way, sub(place, [h.denominator * c for c in corner])) for way, corner in zip(inward, corners)]
            if min(heights) < 0:
                continue
            # On the edge from k to k + 1 the third corner has no part.
            found.setdefault(h, frozenset(face[k] for k in range(3) if heights[k - 2] != 0))
        return sorted(found.items(), key=lambda one: one[0])

    def blocks(self, corners, u):
        """True if motion along u must stop there."""
        if corners is None:
            return True
        back = [-c for c in u]
        before, after = self.side(corners, back), self.side(corners, u)
        if after in ('open', before):
            return False
        return self.both or (before, after) != ('back', 'front')

    def is_behind(self, point):
        """For a closed surface and a point off it: the first crossing of a half-line decides, in a direction that meets no edge.
        Where there is none the point is outside, which is in front unless the surface is turned inside out."""
        far = 10**5 * SCALE
        for attempt in range(1, 100):
            end = [point[0] + far, point[1] + far // 97 * attempt, point[2] + far // 89 * (attempt * attempt % 31 - 15)]
            met = self.meets(point, end)
            if not met:
                return self.is_inside_out
            if all(corners and len(corners) == 3 for _, corners in met):
                return self.side(met[0][1], sub(end, point)) == 'front'
        raise ArithmeticError('every half-line meets an edge')


# ---------------------------------------------------------------- one tick

class State:
    def __init__(self, surface, feature, side, position):
        self.corners, self.side, self.text = None, side, (feature, side)
        if feature == '-':
            self.point = position
            return
        kind, *numbers = feature.split()
        numbers = list(map(int, numbers))
        points = surface.points
        if kind == 'v':
            v, = numbers
            order, self.parameters = [v], []
        elif kind == 'e':
            a, b, m = numbers
            assert a < b and 0 < m < STEPS, 'an edge out of range'
            order, self.parameters = [a, b], [m]
        else:
            f, k, l = numbers
            assert kind == 't' and k > 0 and l > 0 and k + l < STEPS, 'a triangle out of range'
            order, self.parameters = surface.faces[f], [k, l]
        self.order, self.corners = order, frozenset(order)
        assert len(order) == 3 or surface.faces_at(self.corners), 'no such edge or vertex'
        self.point = [sum([c * w for c, w in zip(column, [STEPS - sum(self.parameters), *self.parameters])]) for column in
                      zip(*(points[v] for v in order))]
        assert not any(c % STEPS for c in self.point)
        self.point = [c // STEPS for c in self.point]
        assert side in ('front', 'back') and (surface.both or side == 'front'), 'a side that does not exist'
        assert side == 'front' or not surface.is_rim(self.corners), 'the back of a rim'


def nearest_on_feature(surface, state, p):
    """The point of the state's line or plane nearest to p, if it is strictly inside and rounds to the state; scaled by the
    integer that is returned with it. From the normal, not from the sides: q = p - (n·(p - a)/n·n) n."""
    a = surface.points[state.order[0]]
    if len(state.order) == 2:
        along = sub(surface.points[state.order[1]], a)
        whole = dot(along, along)
        shares = [Q(dot(sub(p, a), along), whole)]
        q = [x * whole + c * dot(sub(p, a), along) for x, c in zip(a, along)]
    else:
        f, = surface.faces_at(state.corners)
        n = surface.normal[f]
        whole = dot(n, n)
        q = [c * whole - dot(n, sub(p, a)) * m for c, m in zip(p, n)]
        b, c = (surface.points[v] for v in state.order[1:])
        # Areas of the parts of the triangle, seen along n.
        shares = [Q(det(n, sub(p, a), sub(c, a)), whole), Q(det(n, sub(b, a), sub(p, a)), whole)]
    if min(shares) <= 0 or sum(shares) >= 1:
        return None
    kept = [max(1, int(s * STEPS + Q(1, 2)) - (s * STEPS % 1 == Q(1, 2) and int(s * STEPS) % 2 == 0)) for s in shares]
    excess = sum(kept) - (STEPS - 1)
    if excess > 0:
        kept[0 if len(kept) == 1 or kept[0] >= kept[1] else 1] -= excess
    return (q, whole) if kept == state.parameters else None


def is_minimum(surface, corners, u):
    """True if no direction along the surface leads towards u. A direction in a sector or half-plane is a sum of its sides, with
    parts that are not negative, so it suffices to try the sides."""
    for f in surface.faces_at(corners):
        face = [surface.points[v] for v in surface.faces[f]]
        inside = [v in corners for v in surface.faces[f]]
        if len(corners) == 3:
            return not any(cross(surface.normal[f], u))
        for k in range(3):
            if inside[k]:
                if any(dot(sub(face[m], face[k]), u) > 0 for m in range(3)):
                    return False
    return True


class Slide:
    """A way along the surface: the square of its gain u·v, the corners of its triangle or edge, where it meets their border, the
    square of its length up to there, and whether the point nearest to p lies strictly before."""

    def __init__(self, gain_squared, corners, border, length_squared, is_short):
        self.gain_squared, self.corners, self.border = gain_squared, corners, border
        self.length_squared, self.is_short = length_squared, is_short


def steepest_slides(surface, state, u):
    """The slides with the largest gain, of which there are several where two are equal; none where nothing leads towards u."""
    found = []
    for f in surface.faces_at(state.corners):
        face, n = surface.faces[f], surface.normal[f]
        nn = dot(n, n)
        projection = [c * nn - dot(n, u) * m for c, m in zip(u, n)]  # times n·n
        end = None
        for k in range(3):
            a, b = surface.points[face[k]], surface.points[face[k - 2]]
            inward = cross(n, sub(b, a))
            height, change = dot(inward, sub(state.point, a)), dot(inward, projection)
            if height == 0 and change <= 0:
                end = None
                break
            if change < 0:
                reached = Q(height, -change)
                end = reached if end is None else min(end, reached)
        if end is not None:
            size = dot(projection, projection)
            border = [a + end * c for a, c in zip(state.point, projection)]
            found.append(Slide(Q(size, nn * nn), frozenset(face), border, end * end * size, end * nn > 1))
    for v in {v for f in surface.faces_at(state.corners) for v in surface.faces[f]} if len(state.corners) < 3 else ():
        if (len(state.corners) == 1) == (v in state.corners):
            continue
        way = sub(surface.points[v], state.point)
        reach, size = dot(way, u), dot(way, way)
        if reach > 0:
            found.append(Slide(Q(reach**2, size), state.corners | {v}, surface.points[v], size, reach < size))
    most = max((slide.gain_squared for slide in found), default=None)
    return [slide for slide in found if slide.gain_squared == most]


class Checker:
    def __init__(self, surface, stiffness, most_moves):
        self.surface, self.stiffness, self.most_moves, self.count = surface, stiffness, most_moves, Counter()
        self.is_closed = not surface.rim
        self.was_behind = None

    def tick(self, before, row, p):
        """before: State or None at the start. Returns the state after."""
        surface, count = self.surface, self.count
        status, moves = row[3], int(row[6])
        force, shaded = ([number(text) for text in row[k:k + 3]] for k in (7, 10))
        assert '-0' not in row[7:], 'a zero with a sign'
        if p is None:
            assert status == 'invalid' and moves == 0 and not any(force + shaded), 'an invalid position'
            assert row[4:6] == list(before.text if before else ('-', '-')), 'an invalid position changes the state'
            count['invalid'] += 1
            return before
        after = State(surface, row[4], row[5], p)
        assert status == ('free' if after.corners is None else 'unfinished' if status == 'unfinished' else 'touching'), 'status'
        assert 0 <= moves <= self.most_moves and (status != 'unfinished' or moves == self.most_moves), 'moves'
        self.motion(before, after, p, moves)
        self.parity(after, p)
        if after.corners is None:
            assert not any(force + shaded), 'a force in free space'
            count['free'] += 1
            return after
        r, whole = self.rest(before, after, p, status, force)
        D = [c - whole * x for c, x in zip(r, p)]
        self.shading(D, whole, shaded)
        if before and before.corners is not None:
            old, new = sub(p, before.point), Q(dot(D, D), whole * whole)
            assert new <= dot(old, old), 'the distance to p grows'
            assert moves == 0 or new < dot(old, old), 'a move without gain'
            count['distances'] += 1
        return after

    def motion(self, before, after, p, moves):
        surface, count = self.surface, self.count
        if before is None:
            met = [corners for h, corners in surface.meets([2 * c - x for c, x in zip(p, self.beside(p))], p) if h == 1]
            assert moves == 0 and bool(met) == (after.corners is not None), 'the start'
            return
        if moves == 0:
            assert before.text == after.text or before.corners is None, 'no move, but another state'
            assert before.corners is not None or before.point == p, 'free, and no move'
            return
        if moves > 1:
            count['ticks of several moves'] += 1
            return
        u = sub(p, before.point)
        if before.corners is not None:
            where = surface.side(before.corners, u)
            if where not in ('open', before.side):
                self.slide(before, after, u)
                return
        met = surface.meets(before.point, p)
        blocking = [(h, corners) for h, corners in met if surface.blocks(corners, u)]
        if after.corners is None:
            assert not blocking, 'a segment crosses the surface from a blocked side'
            count['free segments'] += 1
            return
        # It ends at the first blocking place, rounded, or at p. A landing is rounded to a corner of its grid triangle; at p both
        # parameters are rounded, and may have to be kept inside.
        ends = blocking or [one for one in met if one[0] == 1]
        assert ends, 'it ends on the surface without being stopped'
        h, corners = ends[0]
        place = [a + h * c for a, c in zip(before.point, u)]
        apart = sub(place, after.point)
        assert dot(apart, apart) * STEPS**2 <= (4 if h == 1 else 1) * surface.longest_squared, 'it does not end where it lands'
        if corners is not None:
            assert after.corners <= corners, 'it ends on another feature'
            is_front = not surface.both or surface.is_rim(after.corners) or surface.is_rim(corners)
            assert after.side == ('front' if is_front else surface.side(corners, [-c for c in u])), 'the wrong side'
        count['landings'] += 1

    def slide(self, before, after, u):
        surface = self.surface
        assert after.corners is not None, 'it leaves the surface through it'
        assert after.side == ('front' if surface.is_rim(after.corners) else before.side), 'the side changes in a slide'

        def fits(way):
            if way.is_short:
                return after.corners == way.corners
            apart = sub(way.border, after.point)
            return after.corners <= way.corners and dot(apart, apart) * STEPS**2 <= surface.longest_squared
        ways = steepest_slides(surface, before, u)
        assert any(map(fits, ways)), 'not the steepest slide'
        self.count['slides'] += 1
        self.count['slides to a border'] += not any(way.is_short for way in ways)

    @staticmethod
    def beside(p):
        """A point near p, in a direction that is in no plane of the meshes."""
        return [c + SCALE // d for c, d in zip(p, (1009, 1013, 1019))]

    def parity(self, after, p):
        if not self.is_closed:
            return
        if after.corners is not None:
            is_behind = after.side == 'back'
        elif any(h == 1 for h, _ in self.surface.meets(self.beside(p), p)):
            raise AssertionError('free on the surface')
        else:
            is_behind = self.surface.is_behind(p)
        if self.was_behind is not None:
            assert not is_behind or self.was_behind, 'it got behind the surface'
            assert is_behind or not self.was_behind or not self.surface.both, 'it got to the front of the surface'
            self.count['in front or behind'] += 1
        self.was_behind = is_behind

    def rest(self, before, after, p, status, force):
        """r, as integers over a common denominator. The force must be the rounded one of one of the two places that r can be."""
        surface, count = self.surface, self.count

        def fits(r, whole):
            exact = (self.stiffness * Q(a - whole * b, whole * SCALE) for a, b in zip(r, p))
            return all(is_nearest(f, e) for f, e in zip(force, exact))
        inside = nearest_on_feature(surface, after, p) if len(after.corners) > 1 and status == 'touching' else None
        u = sub(p, after.point)
        if inside and fits(*inside):
            r, whole = inside
            left = [whole * c - x for c, x in zip(p, r)]
            if not any(left):
                count['at p'] += 1
            elif is_minimum(surface, after.corners, left):
                where = surface.side(after.corners, left)
                assert where not in ('open', 'on', after.side), f'it rests, but p is {where}'
                assert surface.both or where == 'back'
                count[f'at rest on {("an edge", "a triangle")[len(after.corners) - 2]}'] += 1
            else:
                inside = None
            if inside:
                return r, whole
        assert fits(after.point, 1), 'the force'
        if status == 'unfinished':
            count['unfinished'] += 1
        elif not any(u):
            count['at p'] += 1
        elif is_minimum(surface, after.corners, u) and surface.side(after.corners, u) not in ('open', after.side):
            count['at rest on a grid point'] += 1
        else:
            self.refusal(after, p, u)
        return after.point, 1

    def refusal(self, after, p, u):
        surface = self.surface
        limit = Q(surface.longest_squared**2, 9 * STEPS**4)
        if surface.side(after.corners, u) in ('open', after.side):
            hits = surface.meets(after.point, p)
            assert hits and hits[0][0]**2 * dot(u, u)**2 <= limit, 'it rests, but could fly'
            self.count['refused flights'] += 1
        else:
            ways = steepest_slides(surface, after, u)
            assert ways and all(not way.is_short and way.length_squared * way.gain_squared <= limit for way in ways), (
                'it rests, but could slide')
            self.count['refused slides'] += 1

    def shading(self, D, whole, shaded):
        size_squared = self.stiffness**2 * Q(dot(D, D), whole * whole * SCALE * SCALE)
        own = sum(Q(f)**2 for f in shaded)
        if size_squared > Q(1, 2**200):
            assert abs(own - size_squared) <= size_squared * Q(1, 2**22), 'the size of the shaded force'
            assert sum(Q(f) * c for f, c in zip(shaded, D)) >= 0, 'the shaded force pulls'
            self.count['shaded'] += 1


# ---------------------------------------------------------------- files

def read_surface(path, sides):
    lines = [line.split() for line in path.read_text().split('\n')]
    count, faces = int(lines[1][0]), int(lines[1][1])
    points = [integer_point(map(number, line)) for line in lines[2:2 + count]]
    return Surface(points, [list(map(int, line[1:4])) for line in lines[2 + count:2 + count + faces]], sides)


def sides_of(directory):
    if (directory / 'meshes.csv').exists():
        return [row[:2] for row in csv.reader(open(directory / 'meshes.csv'))][1:]
    return re.findall(r'^\| `(\w+)` \| \d+ \| (front|both) \|', (directory / 'README.md').read_text(), re.M)


def check_path(directory, name, sides, most_moves):
    """The number of wrong ticks, of which the first are printed."""
    checker = Checker(read_surface(directory / f'{name}.off', sides), Q(number('0.3')), most_moves)
    rows = list(csv.reader(open(directory / f'{name}.csv')))[1:]
    wrong, before = 0, None
    for line, (last, row) in enumerate(pairwise([None, *rows]), 2):
        position = [number(text) for text in row[:3]]
        p = integer_point(position) if all(abs(c) <= 10000 for c in position) else None
        try:
            if last and last[:3] == row[:3] and p and last[3] in ('free', 'touching'):
                assert last[3:6] + last[7:] == row[3:6] + row[7:], 'the same position again, but something else'
                checker.count['repeats'] += 1
            before = checker.tick(before, row, p)
        except AssertionError as error:
            wrong += 1
            if wrong <= 5:
                print(f'{name}.csv, line {line}: {error}: {",".join(row)}')
            before = State(checker.surface, row[4], row[5], p or before.point) if p or before else None
    seen = ', '.join(f'{kind} {n}' for kind, n in sorted(checker.count.items()))
    print(f'{name}: {len(rows)} ticks, {wrong} wrong;', seen, flush=True)
    return wrong, checker.count


def main(directory, names, most_moves):
    total, wrong = Counter(), 0
    for name, sides in sides_of(directory):
        if not names or name in names:
            bad, count = check_path(directory, name, sides, most_moves)
            wrong += bad
            total += count
    print(f'all: {wrong} wrong;', ', '.join(f'{kind} {n}' for kind, n in sorted(total.items())))
    return 1 if wrong else 0


if __name__ == '__main__':
    words = sys.argv[1:]
    single = '--single-moves' in words
    words = [word for word in words if word != '--single-moves']
    sys.exit(main(Path(words[0]) if words else Path(__file__).parent / 'god_object', words[1:], 1 if single else 256))
