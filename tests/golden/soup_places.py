# SPDX-License-Identifier: BSD-3-Clause
"""The god-object on any set of triangles, as docs/soups.md defines it: the set and its places. A point is (x, y, z, w), the integers
x, y, z divided by w > 0; their unit of length is 2^-53 mm, so a vertex has w = 1. Every triangle is tried everywhere."""

from collections import Counter
from fractions import Fraction
from math import gcd, lcm

from make_god_object_golden import cross, dot, minus, times
from soup_cells import Near, primitive, sign

UNIT = 1 << 53


def point(coordinates):
    """From rationals."""
    w = lcm(*(c.denominator for c in coordinates))
    return (*(c.numerator * (w // c.denominator) for c in coordinates), w)


def reduced(x):
    size = gcd(*x)
    return tuple(c // size for c in x)


def way(a, b):
    """b − a, times a positive integer."""
    return tuple(b[k] * a[3] - a[k] * b[3] for k in range(3))


def apart(a, b):
    """The square of the distance."""
    d = way(a, b)
    return Fraction(dot(d, d), (a[3] * b[3])**2)


def along(a, b, t):
    """a + t (b − a)"""
    s, t, one = (t.denominator - t.numerator) * b[3], t.numerator * a[3], t.denominator * a[3] * b[3]
    return reduced((*(s * a[k] + t * b[k] for k in range(3)), one))


def in_units(position):
    return tuple(int(Fraction(c) * UNIT) if abs(c) >= 2**-30 else 0 for c in position)


MOST_LOOKS = 1 << 14


class TooManyLooks(Exception):
    pass


class Places:
    reached = Counter()
    looks = points = 0  # of a tick; at the points of a move or a rest

    def __init__(self, vertices, triangles, sides, corner_normals=None):
        """sides: front or back for all, or a list with one for each triangle."""
        vertices = [in_units(v) for v in vertices]
        lowest = {}
        for v in sorted(v for t in triangles for v in t):
            lowest.setdefault(vertices[v], v)
        self.vertices = vertices
        self.triangles = [tuple(lowest[vertices[v]] for v in t) for t in triangles]
        self.is_both = [s == 'both' for s in ([sides] * len(triangles) if isinstance(sides, str) else sides)]
        self.corner_normals = corner_normals
        self.normals, self.planes, self.along, self.inward, self.edges, self.levels = ([] for _ in range(6))
        for t in self.triangles:
            corners = [vertices[v] for v in t]
            sides_of = [minus(corners[k - 2], corners[k]) for k in range(3)]
            n = cross(sides_of[0], sides_of[1])
            inward = [cross(n, e) for e in sides_of]
            self.normals.append(n)
            self.planes.append(max(primitive(n), times(-1, primitive(n))) if any(n) else None)
            self.along.append(sides_of)
            self.inward.append(inward)
            self.edges.append([tuple(sorted((t[k], t[k - 2]))) for k in range(3)])
            self.levels.append((dot(n, corners[0]), *(dot(inward[k], corners[k]) for k in range(3))))
        self.used = [i for i, n in enumerate(self.normals) if any(n)]
        self.nears = {}

    # ------------------------------------------------------------ where points are

    def height(self, i, x):
        """n·(x − a), times x's denominator."""
        return dot(self.normals[i], x[:3]) - self.levels[i][0] * x[3]

    def insides(self, i, x):
        """For each border of the triangle, how far x is on its inner side; times x's denominator."""
        return [dot(self.inward[i][k], x[:3]) - self.levels[i][k + 1] * x[3] for k in range(3)]

    def holders(self, x):
        """{triangle that holds x: its borders on whose lines x lies}"""
        found = {}
        for i in self.used:
            if self.height(i, x) == 0:
                inside = self.insides(i, x)
                if min(inside) >= 0:
                    found[i] = [k for k in range(3) if inside[k] == 0]
        return found

    def near(self, x):
        """The surface near x; None off the surface."""
        if x not in self.nears:
            if len(self.nears) > 2000:
                self.nears.clear()
            found = self.holders(x)
            self.nears[x] = Near(self, found) if found else None
        return self.nears[x]

    def looked_at(self, x):
        """The surface near a point of a move or of a rest: there are not too many triangles in pieces at all of them."""
        near = self.near(x)
        count = sum(len(piece.triangles) for piece in near.pieces)
        self.looks += count
        self.points += count
        if self.points > MOST_LOOKS:
            raise TooManyLooks
        return near

    def look_along(self, a, b):
        """At the triangles whose boxes, along the axes, the straight way from a to b meets."""
        d = way(a, b)
        for i in self.used:
            corners = [self.vertices[v] for v in self.triangles[i]]
            box = [(min(c[k] for c in corners), max(c[k] for c in corners)) for k in range(3)]
            is_beyond = any(max(a[k] * b[3], b[k] * a[3]) < low * a[3] * b[3] or min(a[k] * b[3], b[k] * a[3]) > high * a[3] * b[3]
                            for k, (low, high) in enumerate(box))
            sides = [{sign(d[j] * (at_k * a[3] - a[k]) - d[k] * (at_j * a[3] - a[j])) for at_j in box[j] for at_k in box[k]}
                     for j, k in ((0, 1), (1, 2), (2, 0))]
            self.looks += not is_beyond and {1} not in sides and {-1} not in sides

    def stretch(self, i, a, b):
        """The part of the segment from a to b that is in triangle i, as a pair of rationals in 0 … 1; None if there is none."""
        above, below = self.height(i, a), self.height(i, b)
        if above > 0 < below or above < 0 > below:
            return None
        if above or below:
            t = Fraction(above * b[3], above * b[3] - below * a[3])
            low = high = t
        else:
            low, high = Fraction(0), Fraction(1)
        for s, e in zip(self.insides(i, a), self.insides(i, b)):
            s, e = s * b[3], e * a[3]  # at t it is s + t (e − s), which has to be ≥ 0
            if low == high:
                if s * low.denominator + low.numerator * (e - s) < 0:
                    return None
            elif s < 0 and e < 0:
                return None
            elif s < 0:
                low = max(low, Fraction(s, s - e))
            elif e < 0:
                high = min(high, Fraction(s, s - e))
            if low > high:
                return None
        return low, high

    def meetings(self, a, b):
        """Where triangles begin or end strictly between a and b, in order."""
        found = set()
        for i in self.used:
            part = self.stretch(i, a, b)
            if part:
                found.update(t for t in part if 0 < t < 1)
        return sorted(found)

    def obstacle(self, a, b, w):
        """The first point strictly between a and b where the way from a to b, moved towards w, may not go on; else None."""
        e = way(a, b)
        for t in self.meetings(a, b):
            y = along(a, b, t)
            near = self.looked_at(y)
            ahead = near.cell_beside(e, w)
            if ahead is None or ahead not in near.reached(near.cell_beside(times(-1, e), w)):
                return y
        return None

    def foot(self, i, p):
        """p's nearest point on the plane of the triangle."""
        n = self.normals[i]
        square, h = dot(n, n), self.height(i, p)
        return reduced((*(p[k] * square - n[k] * h for k in range(3)), p[3] * square))

    def foot_on_line(self, a, d, p):
        """p's nearest point on the line through a along d."""
        t = Fraction(dot(d, way(a, p)), dot(d, d) * a[3] * p[3])
        return point([Fraction(a[k], a[3]) + t * d[k] for k in range(3)])

    # ------------------------------------------------------------ places

    def weights(self, i, x):
        """The weights of the corners a, b, c at a point of the triangle's plane."""
        square = dot(self.normals[i], self.normals[i]) * x[3]
        inside = self.insides(i, x)
        return [Fraction(inside[(k + 1) % 3], square) for k in range(3)]

    def mixed(self, i, beta, gamma):
        a, b, c = (self.vertices[v] for v in self.triangles[i])
        return point([Fraction(a[k]) + beta * (b[k] - a[k]) + gamma * (c[k] - a[k]) for k in range(3)])

    def line_at(self, x, near):
        """The grid on the line of a point of kind 1: (the beginning of the place's name, parameter at x, its change along d, d)."""
        d = max(near.rays)
        pairs = set.union(*near.rays.values())
        if pairs:
            i, j = min(pairs)
            a, b = self.vertices[i], self.vertices[j]
            e = minus(b, a)
            square = dot(e, e)
            return ('e', i, j), Fraction(dot(e, way((*a, 1), x)), square * x[3]), Fraction(dot(e, d), square), d
        f = min(near.cones)
        h = min(i for i in near.cones if self.planes[i] != self.planes[f])
        square = dot(self.normals[f], self.normals[f])
        change = [Fraction(dot(self.inward[f][(k + 1) % 3], d), square) for k in range(3)]
        i = max(range(3), key=lambda k: (abs(change[k]), -k))
        return ('c', f, h, i), self.weights(f, x)[i], change[i], d

    def point_on_line(self, x, line, parameter):
        _, here, change, d = line
        t = (parameter - here) / change
        return point([Fraction(x[k], x[3]) + t * d[k] for k in range(3)])

    def name_of_point(self, x, near):
        """A corner is named by what meets there."""
        vertices = [v for i in near.cones for v in self.triangles[i] if len(near.cones[i]) == 2 and (*self.vertices[v], 1) == x]
        if vertices:
            return 'v', min(vertices)
        edges = {self.edges[i][k]: self.along[i][k] for i, borders in near.cones.items() for k in borders}
        pairs = sorted(edges)
        first = pairs[0] if pairs else None
        crossing = [other for other in pairs if any(cross(edges[other], edges[first]))]
        if crossing:
            return ('ee', *first, *crossing[0])
        own = sorted(near.cones)
        if first:
            return ('ef', *first, min(i for i in own if dot(self.normals[i], edges[first])))
        f = own[0]
        h = next(i for i in own if self.planes[i] != self.planes[f])
        line = cross(self.normals[f], self.normals[h])
        return 'fff', f, h, next(i for i in own if dot(self.normals[i], line))
