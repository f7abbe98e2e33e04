# SPDX-License-Identifier: BSD-3-Clause
"""Small sets of triangles between the points of a lattice, and paths from one of its points to another, so that nearly all is a tie:
triangles lie in each other, cross in vertices and edges, stand on each other and coincide. Everything is drawn from a name."""

from make_golden import Draw, single


class Lattice:
    def __init__(self, name, ticks):
        self.draw, self.ticks = Draw(f'forceshade soup {name}'), ticks
        draw = self.draw
        self.step, self.span = draw.pick((4.0, 3.0, 1.0, 2.0**-22)), draw.pick((1, 1, 2))
        self.vertices = [self.node(self.span) for _ in range(draw.pick((6, 9, 14)))]
        if draw.random() < 0.3:  # most of it in one plane
            self.vertices = [v if draw.random() < 0.3 else (v[0], v[1], 0.0) for v in self.vertices]
        self.triangles = [self.three_of(len(self.vertices)) for _ in range(draw.pick((3, 4, 6, 9, 14)))]
        kind = draw.pick(('front', 'both', None))
        self.sides = [kind or draw.pick(('front', 'both')) for _ in self.triangles]

    def node(self, most):
        return tuple(self.step * (int((2 * most + 1) * self.draw.random()) - most) for _ in range(3))

    def three_of(self, count):
        left = list(range(count))
        return tuple(left.pop(int(len(left) * self.draw.random())) for _ in range(3))

    def position(self, last):
        draw, kind = self.draw, self.draw.random()
        if kind < 0.4:
            return self.node(2 * self.span)
        if kind < 0.6:
            return tuple(c / 2 for c in self.node(4 * self.span))
        if kind < 0.75:
            return tuple((a + b) / 2 for a, b in zip(draw.pick(self.vertices), draw.pick(self.vertices)))
        if kind < 0.9:
            return tuple(c + self.step * (0.6 * draw.random() - 0.3) for c in last)
        return tuple(self.step * self.span * (3 * draw.random() - 1.5) for _ in range(3))

    def positions(self):
        last = (0.0, 0.0, 0.0)
        for _ in range(self.ticks):
            if self.draw.random() > 0.06:
                last = tuple(single(c) + 0.0 for c in self.position(last))
            yield last


class Creep(Lattice):
    """Steps of about the grid of the states, beside points of triangles."""

    def positions(self):
        draw = self.draw
        for number in range(self.ticks):
            if number % 12 == 0:
                corners = [self.vertices[v] for v in draw.pick(self.triangles)]
                weights = draw.pick(((0.5, 0.5, 0), (0.25, 0.25, 0.5), (0.5, 0.25, 0.25), (0.125, 0.5, 0.375)))
                base = tuple(sum(w * corner[k] for w, corner in zip(weights, corners)) for k in range(3))
            reach = self.step * (2**-22 if number % 12 else 0.25)
            yield tuple(single(c + reach * draw.pick((0, 1, 1, 4)) * (2 * draw.random() - 1)) + 0.0 for c in base)


class Fin:
    """A plate, and a fin through it whose free edge begins over the plate's inside: the ray there has a wedge on each side."""
    vertices = [(-8.0, -8.0, 0.0), (8.0, -8.0, 0.0), (0.0, 8.0, 0.0), (-2.0, 0.0, 3.0), (-2.0, 0.0, -3.0), (4.0, 0.0, 0.0)]
    triangles = [(0, 1, 2), (3, 4, 5)]
    sides = ['both'] * 2

    @staticmethod
    def positions():
        for s in (1.0, -1.0):
            for y in (1.0, -1.0):
                yield from ((-3.0, 0.0, s), (-2.0, 0.0, -s), (1.0, 0.0, -s), (1.0, 0.0, -s))
                yield from ((1.0, -2.0 * y, 0.5 * s), (1.0, 2.0 * y, 0.5 * s), (-6.0, 0.0, 2.0 * s))
        yield from ((-3.0, 0.0, 1.0), (-2.0, 0.0, 0.0), (4.0, 0.0, 0.0), (4.0, 0.5, -0.5), (-3.0, 0.0, -0.25), (-3.0, 0.0, 0.25))


class Sheets:
    """A plate that is there 200 times, with ribs below it: at each of the points where a way along the plate meets a rib, it looks
    at all plates twice, so a long one is not made."""
    plates, ribs = 200, 45
    vertices = [(-1.0, -40.0, 0.0), (80.0, 0.0, 0.0), (-1.0, 40.0, 0.0)]
    triangles = [(0, 1, 2)] * plates
    for rib in range(ribs):
        x, first = 1.0 + 0.5 * rib, len(vertices)
        vertices = vertices + [(x, -1.0, 0.0), (x, 1.0, 0.0), (x, 0.0, -1.0)]
        triangles = triangles + [(first, first + 1, first + 2)]
    sides = ['both'] * len(triangles)

    @staticmethod
    def positions():
        yield from ((0.25, 0.0, 1.0), (0.25, 0.0, -0.5), (40.0, 0.125, -0.25), (40.0, 0.125, -0.25), (9.25, 0.125, -0.25))
        yield from ((40.0, 0.125, -0.25), (40.0, 0.125, 0.5))


def scenes():
    """(name, scene); the numbers are those of lattices in which rules matter that few paths reach."""
    yield 'fin', Fin()
    yield 'sheets', Sheets()
    for number in (40, 50, 60, 62, 63, 65, 81, 101, 115, 118, 122, 123):
        yield f'lattice_{number}', Lattice(str(number), 90)
    for number in (4, 5, 27, 30):
        yield f'creep_{number}', Creep(f'creep {number}', 90)
