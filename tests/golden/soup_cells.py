# SPDX-License-Identifier: BSD-3-Clause
"""The surface of any set of triangles in all directions from one of its points, as docs/soups.md defines it: rays, pieces, cells,
walls. All numbers are integers; a direction is a vector of any length."""

from collections import namedtuple
from functools import cmp_to_key
from math import gcd

from make_god_object_golden import cross, dot, times

Piece = namedtuple('Piece', 'normal start end middle triangles')  # from start to end counter-clockwise around normal


def primitive(d):
    size = gcd(*d)
    return d[0] // size, d[1] // size, d[2] // size


def sign(x):
    return (x > 0) - (x < 0)


def around(axis, first):
    """The order of directions by the angle from first, counter-clockwise around the axis; their parts along it do not count."""
    across, square, part = cross(axis, first), dot(axis, axis), dot(axis, first)

    def is_far(d):  # by half a turn or more
        s = dot(across, d)
        return s < 0 or s == 0 and dot(first, d) * square < part * dot(axis, d)

    def compare(a, b):
        return is_far(a) - is_far(b) or -sign(dot(axis, cross(a, b)))
    return compare


def between(axis, a, b):
    """A direction strictly between a and b, at right angles to the axis as they are, counter-clockwise from a; a = b: a whole turn."""
    turn = dot(axis, cross(a, b))
    if turn:
        return times(sign(turn), (a[0] + b[0], a[1] + b[1], a[2] + b[2]))
    return times(-1, a) if dot(a, b) > 0 else cross(axis, a)


class Joined:
    """Disjoint sets of the numbers below n."""

    def __init__(self, n):
        self.up = list(range(n))

    def find(self, i):
        while self.up[i] != i:
            i = self.up[i]
        return i

    def join(self, i, j):
        i, j = self.find(i), self.find(j)
        self.up[max(i, j)] = min(i, j)


class Near:
    """The surface near a point. The two sides of piece i are 2i, to which its normal points, and 2i + 1. A cell is a tuple: for
    each part of the surface the set of sides among which a direction of the cell is."""

    def __init__(self, soup, cones):
        self.soup, self.cones = soup, cones  # {triangle: its borders, 0 to 2, on whose lines the point is}
        self.planes = {}
        for i in sorted(cones):
            self.planes.setdefault(soup.planes[i], []).append(i)
        self.find_rays()
        self.pieces = [piece for plane, own in self.planes.items() for piece in self.pieces_in(plane, own)]
        self.find_sets()
        self.cells = {}
        for side in range(2 * len(self.pieces)):
            self.cells.setdefault(self.cell_of_side(side), []).append(side)
        self.reach = {}

    @property
    def kind(self):
        if not self.rays:
            return 2
        return 1 if len(self.rays) == 2 and times(-1, min(self.rays)) == max(self.rays) else 0

    def holds(self, i, d):
        """The cone of triangle i, with its border."""
        inward = self.soup.inward[i]
        return dot(self.soup.normals[i], d) == 0 and all(dot(inward[k], d) >= 0 for k in self.cones[i])

    def find_rays(self):
        """{ray: the edges along it}"""
        self.rays = {}
        for i, borders in self.cones.items():
            for k in borders:
                for d in (self.soup.along[i][k], times(-1, self.soup.along[i][k])):
                    if self.holds(i, d):
                        self.rays.setdefault(primitive(d), set()).add(self.soup.edges[i][k])
        planes = list(self.planes.items())
        for number, (n, own) in enumerate(planes):
            for m, others in planes[:number]:
                line = primitive(cross(n, m))
                for d in (line, times(-1, line)):
                    if any(self.holds(i, d) for i in own) and any(self.holds(j, d) for j in others):
                        self.rays.setdefault(d, set())

    def pieces_in(self, plane, own):
        rays = [d for d in self.rays if dot(plane, d) == 0]
        if not rays:
            full = tuple(i for i in own if not self.cones[i])
            return [Piece(plane, None, None, self.soup.along[full[0]][0], full)] if full else []
        rays.sort(key=cmp_to_key(around(plane, rays[0])))
        result = []
        for start, end in zip(rays, rays[1:] + rays[:1]):
            middle = between(plane, times(max(map(abs, end)), start), times(max(map(abs, start)), end))
            triangles = tuple(i for i in own if self.holds(i, middle))
            if triangles:
                result.append(Piece(plane, start, end, middle, triangles))
        return result

    def find_sets(self):
        """The pieces around each ray, and which sides and which pieces hang together."""
        self.wheels = {d: [] for d in self.rays}  # [(direction into a piece, its side ahead, its side behind)]
        for number, piece in enumerate(self.pieces):
            if piece.start:
                self.wheels[piece.start].append((cross(piece.normal, piece.start), 2 * number, 2 * number + 1))
                self.wheels[piece.end].append((cross(piece.end, piece.normal), 2 * number + 1, 2 * number))
        sides, parts = Joined(2 * len(self.pieces)), Joined(len(self.pieces))
        for ray, wheel in self.wheels.items():
            order = around(ray, wheel[0][0])
            wheel.sort(key=cmp_to_key(lambda x, y: order(x[0], y[0])))
            for this, following in zip(wheel, wheel[1:] + wheel[:1]):
                sides.join(this[1], following[2])
                parts.join(this[1] // 2, following[1] // 2)
        self.set_of = [sides.find(side) for side in range(2 * len(self.pieces))]
        self.parts = {}
        for number in range(len(self.pieces)):
            self.parts.setdefault(parts.find(number), []).append(number)
        self.part_of = [parts.find(number) for number in range(len(self.pieces))]

    def is_inside(self, piece, d):
        """Strictly inside; d is in the plane of the piece."""
        if piece.start is None:
            return True
        order = around(piece.normal, piece.start)
        return order(piece.start, d) < 0 and (piece.start == piece.end or order(d, piece.end) < 0)

    def projection(self, piece, d):
        """d's projection onto the plane of the piece, times a positive number, or None if it is not strictly inside; its length
        is found by closeness()."""
        n = piece.normal
        square, height = dot(n, n), dot(n, d)
        foot = (d[0] * square - n[0] * height, d[1] * square - n[1] * height, d[2] * square - n[2] * height)
        return foot if any(foot) and self.is_inside(piece, foot) else None

    @staticmethod
    def closeness(d, v):
        """(s, t), t > 0, so that s/t rises with the cosine of the angle between d and v."""
        c = dot(d, v)
        return c * abs(c), dot(v, v)

    def whereabouts(self, part, d):
        """A side that d is beside, where the surface is this part alone; None if d is in it."""
        rays = {ray for number in part for ray in self.pieces[number][1:3] if ray}
        best, what = None, None
        for ray in rays:
            s, t = self.closeness(d, ray)
            if best is None or s * best[1] > best[0] * t:
                best, what = (s, t), ray
        for number in part:
            foot = self.projection(self.pieces[number], d)
            if foot:
                s, t = self.closeness(d, foot)
                if best is None or s * best[1] > best[0] * t:
                    best, what = (s, t), number
        if best is None:  # a whole plane, and d at right angles to it
            what = part[0]
        if isinstance(what, tuple):
            if best[0] == dot(d, d) * best[1]:
                return None
            return self.wedge(what, d)[0]
        height = dot(self.pieces[what].normal, d)
        return 2 * what + (height < 0) if height else None

    def wedge(self, ray, w):
        """(side, side) that bound the wedge at the ray which holds w, counter-clockwise; None if w is in a piece."""
        wheel = self.wheels[ray]
        order = around(ray, wheel[0][0])
        last = max(k for k in range(len(wheel)) if order(wheel[k][0], w) <= 0)
        if order(wheel[last][0], w) == 0:
            return None
        return wheel[last][1], wheel[(last + 1) % len(wheel)][2]

    def wedge_of(self, ray, side):
        """The two entries of the ray's wheel between which the wedge at the side is. A piece that begins and ends at the ray has
        two: the one counter-clockwise of it around the ray."""
        wheel = self.wheels[ray]
        pairs = list(zip(wheel, wheel[1:] + wheel[:1]))
        after, before = ([pair for pair in pairs if pair[0][1] == side], [pair for pair in pairs if pair[1][2] == side])
        self.soup.reached['walls with two wedges'] += bool(after and before and after != before)
        return (after + before)[0]

    def across(self, ray, side):
        """A direction across the wedge at the ray which the side bounds."""
        this, following = self.wedge_of(ray, side)
        return between(ray, this[0], following[0])

    def bounds(self, ray, side):
        """The two sides that bound this wedge."""
        this, following = self.wedge_of(ray, side)
        return this[1], following[2]

    def cell(self, d):
        """The cell of a direction; None on the surface."""
        sides = [self.whereabouts(part, d) for part in self.parts.values()]
        return None if None in sides else tuple(self.set_of[side] for side in sides)

    def cell_of_side(self, side):
        own, middle = self.part_of[side // 2], self.pieces[side // 2].middle
        return tuple(self.set_of[side if part == own else self.whereabouts(numbers, middle)]
                     for part, numbers in self.parts.items())

    def cell_beside(self, d, w):
        """The cell of d + εw; None on the surface."""
        ray = primitive(d)
        if ray in self.rays:
            wedge = self.wedge(ray, w)
            return self.cell_of_side(wedge[0]) if wedge else None
        for number, piece in enumerate(self.pieces):
            if dot(piece.normal, d) == 0 and self.is_inside(piece, d):
                height = dot(piece.normal, w)
                return self.cell_of_side(2 * number + (height < 0)) if height else None
        return self.cell(d)

    def sides_at(self, d):
        """The sides of the piece that holds d, or of the pieces at d where it is a ray."""
        ray = primitive(d)
        if ray in self.rays:
            return {side for _, *both in self.wheels[ray] for side in both}
        return {2 * number + s for number, piece in enumerate(self.pieces) for s in (0, 1)
                if dot(piece.normal, d) == 0 and self.is_inside(piece, d)}

    # ------------------------------------------------------------ walls and names

    def is_front(self, i, side):
        """The side is the front of triangle i, which has the piece."""
        return (dot(self.soup.normals[i], self.pieces[side // 2].normal) > 0) == (side % 2 == 0)

    def blocking(self, side):
        """The triangles of the side's piece that block from there."""
        return [i for i in self.pieces[side // 2].triangles if self.soup.is_both[i] or self.is_front(i, side)]

    def reached(self, cell):
        """R: the cells that can be reached from the cell."""
        if cell not in self.reach:
            found, new = {cell}, [cell]
            while new:
                for side in self.cells[new.pop()]:
                    other = self.cell_of_side(side ^ 1)
                    if other not in found and not self.blocking(side):
                        found.add(other)
                        new.append(other)
            self.reach[cell] = found
        return self.reach[cell]

    def walls(self, cell):
        """W: the walls beside cells of R."""
        return [side for beside in self.reached(cell) for side in self.cells[beside] if self.blocking(side)]

    def name_of_side(self, side):
        return min((i, 0 if self.is_front(i, side) else 1, self.number(i, side // 2)) for i in self.pieces[side // 2].triangles)

    def number(self, i, piece):
        """The number of a piece in triangle i: pieces are counted around its normal by their middles, from the direction of b − a."""
        own = [k for k, other in enumerate(self.pieces) if i in other.triangles]
        if len(own) == 1:
            return 0
        order = around(self.soup.normals[i], self.soup.along[i][0])
        own.sort(key=cmp_to_key(lambda k, m: order(self.pieces[k].middle, self.pieces[m].middle)))
        return own.index(piece)

    def name(self, cell):
        return min(map(self.name_of_side, self.cells[cell]))

    def cell_named(self, name):
        i, back, number = name
        for side in range(2 * len(self.pieces)):
            if i in self.pieces[side // 2].triangles and self.is_front(i, side) != back and self.number(i, side // 2) == number:
                return self.cell_of_side(side)
        raise AssertionError
