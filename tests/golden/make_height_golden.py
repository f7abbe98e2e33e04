#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes height_maps.csv and height_forces.csv: height maps of every kind by docs/height-maps.md, on inputs chosen to hurt.

Usage: make_height_golden.py [directory]      (the default is the directory of this file; the output is always the same)

As in make_golden.py, whose exact numbers and rounding are used, no floating-point number takes part in a result. Planes,
polygons, cones, caps and grids are elements of its tower of fields: contact, ties and digits are decided by algebra. A number
that a Gaussian or a grating takes part in is an expression that is enclosed by integers in as many bits as a decision needs.
Such a number is never tested where it could be exactly a tie: at a Gaussian's centre and at an angle of 0 it is rational.
"""

import math
import sys
from collections import Counter
from fractions import Fraction
from functools import lru_cache
from pathlib import Path

import make_golden as exact
from make_golden import Algebraic, Draw, QUANTUM, binary32, decimal, enclose, hexfloat, read, sign, single, step, write

MOST_BITS = 1 << 17
field_sqrt = lru_cache(None)(exact.sqrt)  # equal radicands give the same root, so that what cancels does


# ---------------------------------------------------------------- enclosed real numbers

class Expression:
    """Stands where make_golden.py has a root: a number that is known by enclosures alone."""

    rank = math.inf

    def __init__(self, isolate):
        self.isolate, self.known = isolate, {}

    def enclose(self, bits):
        if bits not in self.known:
            self.known[bits] = self.isolate(bits)
        return self.known[bits]

    def sign(self, _):
        bits = exact.BITS
        while bits < MOST_BITS:
            bits *= 2
            low, high = self.enclose(bits)
            if low > 0 or high < 0:
                return 1 if low > 0 else -1
        raise ArithmeticError('a number that could be zero')


def times(a, b, bits):
    products = [x * y for x in a for y in b]
    return min(products) >> bits, -(-max(products) >> bits)


class Enclosed(Algebraic):
    """Operations give expressions; `enclose` and `sign` of make_golden.py work on them as they stand."""

    def __init__(self, isolate):
        super().__init__(Expression(isolate), (0, 1))

    def __add__(self, other):
        return Enclosed(lambda bits: tuple(map(sum, zip(enclose(self, bits), enclose(other, bits)))))

    def __mul__(self, other):
        return Enclosed(lambda bits: times(enclose(self, bits), enclose(other, bits), bits)) if other else Fraction(0)

    def __neg__(self):
        return Enclosed(lambda bits: tuple(-end for end in reversed(enclose(self, bits))))

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return -self + other

    def over_at_least_1(self, divisor):
        """self/divisor."""
        def isolate(bits):
            low, high = enclose(divisor, bits)
            assert low > 0
            return times(enclose(self, bits), ((1 << 2 * bits) // high, -(-(1 << 2 * bits) // low)), bits)
        return Enclosed(isolate)

    __radd__, __rmul__ = __add__, __mul__


ONE = Enclosed(lambda bits: (1 << bits, 1 << bits))


def sqrt(x):
    if not isinstance(x, Enclosed):
        return exact.sqrt(x) if isinstance(x, Algebraic) else field_sqrt(Fraction(x))

    def isolate(bits):
        low, high = enclose(x, bits)
        return math.isqrt(max(low, 0) << bits), math.isqrt(high << bits) + 1
    return Enclosed(isolate)


def series(r, bits, is_alternating, start):
    """e^r; or, alternating, cos r (start 0) or sin r (start 1): enclosed, for 0 ≤ r ≤ 2⁻⁸."""
    stride = 2 if is_alternating else 1
    low = high = 0
    term_low = term_high = 1 << bits
    r_low, r_high = (r.numerator << bits) // r.denominator, -(-(r.numerator << bits) // r.denominator)
    n = 0
    while True:
        if n >= start and (n - start) % stride == 0:
            if is_alternating and (n - start) % 4 == 2:
                low, high = low - term_high, high - term_low
            else:
                low, high = low + term_low, high + term_high
            if term_high <= 1:
                return low - 2, high + 2  # what follows is less than the last term, twice
        n += 1
        term_low, term_high = term_low * r_low // (n << bits), -(-term_high * r_high // (n << bits))


def halvings(x):
    return max(0, math.ceil(x).bit_length() + 8)


def decay(q):
    """e^(-q) for a rational q > 0."""
    assert 0 < q < 30000

    def isolate(bits):
        k = halvings(q)
        inner = bits + 2 * k + 64
        low, high = series(q / 2**k, inner, False, 0)
        for _ in range(k):
            low, high = low * low >> inner, -(-high * high >> inner)
        one = 1 << (inner + bits)
        return one // high, -(-one // low)
    return Enclosed(isolate)


def cosine_and_sine(a):
    """For a rational a that is not 0."""
    def both(bits):
        k = halvings(abs(a))
        inner = bits + 4 * k + 64
        c, s = series(abs(a) / 2**k, inner, True, 0), series(abs(a) / 2**k, inner, True, 1)
        for _ in range(k):
            square, product = times(c, c, inner), times(c, s, inner)
            c = 2 * square[0] - (1 << inner), 2 * square[1] - (1 << inner)
            s = 2 * product[0], 2 * product[1]
        cut = inner - bits
        return [(low >> cut, -(-high >> cut)) for low, high in (c, s)]
    both = lru_cache(None)(both)
    sine = Enclosed(lambda bits: both(bits)[1])
    return Enclosed(lambda bits: both(bits)[0]), sine if a > 0 else -sine


# ---------------------------------------------------------------- the maps: (U, U_x, U_y) at exact rationals x, y

def plane(x, y, slope_x, slope_y, height):
    return height + slope_x * x + slope_y * y, slope_x, slope_y


FLAT = Fraction(0), Fraction(0), Fraction(0)


def is_inside(X, rho_squared, radius):
    """The side with larger x has the rim: it is inside where X < 0."""
    return rho_squared < radius**2 or rho_squared == radius**2 and X < 0


def cone(x, y, x0, y0, height, radius):
    X, Y = x - read(x0), y - read(y0)
    rho_squared = X * X + Y * Y
    if rho_squared == 0:
        return height, -height / radius, Fraction(0)
    if not is_inside(X, rho_squared, radius):
        return FLAT
    rho = sqrt(rho_squared)
    slope = -height / radius * (rho * (1 / rho_squared))
    return height - height / radius * rho, slope * X, slope * Y


def cap(X, Y, R, w):
    rho_squared = X * X + Y * Y
    if not is_inside(X, rho_squared, w / 2):
        return FLAT
    above = sqrt(R * R - rho_squared)
    per_above = above * (1 / (R * R - rho_squared))
    return above - sqrt(R * R - w * w / 4), -X * per_above, -Y * per_above


def cylinder_cap(x, y, x0, R, w):
    return cap(x - read(x0), Fraction(0), R, w)


def sphere_cap(x, y, x0, y0, R, w):
    return cap(x - read(x0), y - read(y0), R, w)


def gaussian(x, y, x0, y0, height, sigma):
    X, Y = x - read(x0), y - read(y0)
    q = (X * X + Y * Y) / (2 * sigma * sigma)
    U = height * decay(q) if q else height
    return U, -X / sigma**2 * U, -Y / sigma**2 * U


def grating(x, y, height, wave_x, wave_y, phase):
    angle = wave_x * x + wave_y * y + phase
    if angle == 0:
        return height, Fraction(0), Fraction(0)
    cosine, sine = cosine_and_sine(angle)
    return height * cosine, -height * wave_x * sine, -height * wave_y * sine


def polygons(x, y, *numbers):
    knots = [(read(numbers[i]), numbers[i + 1]) for i in range(0, len(numbers), 2)]
    if x < knots[0][0]:
        return knots[0][1], Fraction(0), Fraction(0)
    for (x0, z0), (x1, z1) in zip(knots, knots[1:]):
        if x0 <= x < x1:
            slope = (z1 - z0) / (x1 - x0)
            return z0 + slope * (x - x0), slope, Fraction(0)
    return knots[-1][1], Fraction(0), Fraction(0)


def bilinear_weights(t):
    return {0: (1 - t, -1), 1: (t, 1)}  # value and derivative


def spline_weights(t):
    return {-1: ((1 - t)**3 / 6, -(1 - t)**2 / 2), 0: ((3 * t**3 - 6 * t**2 + 4) / 6, (9 * t**2 - 12 * t) / 6),
            1: ((-3 * t**3 + 3 * t**2 + 3 * t + 1) / 6, (-9 * t**2 + 6 * t + 3) / 6), 2: (t**3 / 6, t**2 / 2)}


def grid(weights, is_tiled):
    def at(x, y, columns, rows, pitch, *values):
        columns, rows = int(columns), int(rows)

        def cell(coordinate, count):
            place = coordinate / pitch + Fraction(count - 1, 2)
            index = place.numerator // place.denominator
            return index, weights(place - index)

        def kept(index, count):
            return index % count if is_tiled else min(max(index, 0), count - 1)
        (i, along), (j, across) = cell(x, columns), cell(y, rows)
        U = Ux = Uy = Fraction(0)
        for k, (a, da) in along.items():
            for l, (b, db) in across.items():
                c = values[kept(j + l, rows) * columns + kept(i + k, columns)]
                U, Ux, Uy = U + a * b * c, Ux + da * b * c / pitch, Uy + a * db * c / pitch
        return U, Ux, Uy
    return at


SHAPES = {
    'plane': plane, 'cone': cone, 'cylinder-cap': cylinder_cap, 'sphere-cap': sphere_cap, 'gaussian': gaussian,
    'grating': grating, 'polygons': polygons,
    'bilinear-clamp': grid(bilinear_weights, False), 'bilinear-tile': grid(bilinear_weights, True),
    'cubic-spline-clamp': grid(spline_weights, False), 'cubic-spline-tile': grid(spline_weights, True),
}


class Map:
    """parts, surface: lists of (negated, shape, numbers); edges: coordinates at which something changes, mm; points: places
    that the kink rule or a special case decides."""

    def __init__(self, name, parts, edges, reach, surface=(), points=()):
        self.name, self.parts, self.surface, self.edges, self.reach, self.points = name, parts, surface, edges, reach, points

    def jet(self, parts, x, y):
        total = FLAT
        for negated, shape, numbers in parts:
            one = SHAPES[shape](x, y, *map(Fraction, numbers))
            total = tuple(t + (-o if negated else o) for t, o in zip(total, one))
        return total


TAIL = 'tail-beside-a-tie'
RENDERINGS = 'height-map', 'height-map-shaded', 'height-map-conservative'


def local(a_map, rendering, x, y):
    """The height that depth is measured from, and the slopes."""
    U, Ux, Uy = a_map.jet(a_map.parts, x, y)
    return (a_map.jet(a_map.surface, x, y)[0] if rendering == 'height-map-shaded' else U), Ux, Uy


def evaluate(a_map, rendering, K, position):
    """The exact force and the status."""
    if not all(abs(c) <= 1e4 for c in position):  # false for NaN too
        return (0, 0, 0), 'invalid'
    x, y, z = map(read, position)
    height, Ux, Uy = local(a_map, rendering, x, y)
    gap = height - z
    if sign(gap) <= 0:
        return (0, 0, 0), 'free'
    push = Fraction(K) * gap
    if rendering != 'height-map-conservative':
        square = Ux * Ux + Uy * Uy + 1
        n = sqrt(square)
        if isinstance(n, Enclosed) or isinstance(push, Enclosed):
            push = (ONE * push).over_at_least_1(n)
        else:
            push = push * n / square
    return (-(push * Ux), -(push * Uy), push), 'contact'


# ---------------------------------------------------------------- the inputs

def f32(*numbers):
    return tuple(map(single, numbers))


def values(name, count, low, high):
    draw = Draw(f'forceshade {name}')
    return tuple(draw.between(low, high) for _ in range(count))


def coarse(name, count):
    draw = Draw(f'forceshade {name}')
    return tuple(int(64 * draw.random()) / 32 for _ in range(count))


def maps():
    def one(name, shape, numbers, edges, reach, negated=0, points=()):
        return Map(name, [(negated, shape, f32(*numbers))], f32(*edges), reach, (), [f32(*point) for point in points])
    circle = (0, 0), (5, 0), (-5, 0), (0, 5), (0, -5), (3, 4), (-3, 4), (3, -4), (-3, -4)
    yield one('plane', 'plane', (0.3, -0.7, 1.25), (0, 1), 8)
    yield one('plane-3-4-5', 'plane', (0.75, 0, 2), (0, 1), 8)
    yield one('level', 'plane', (0, 0, 0.5), (0,), 4)
    yield one('cone', 'cone', (0.3, -0.2, 2.7, 3.9), (0.3, -0.2, 4.2, -3.6, 3.7), 6)
    yield one('cone-3-4-5', 'cone', (0, 0, 3.75, 5), (0, 3, 4, 5, -3, -4, -5), 7, 0, circle)
    yield one('dent', 'cone', (1, 2, 1.5, 2), (1, 2, 3, -1, 0, 2.2, 2.6, 3.6), 4, 1, ((1, 2), (3, 2), (-1, 2), (1, 4), (1, 0)))
    yield one('cylinder-cap', 'cylinder-cap', (0, 15.24, 25.4), (0, 12.7, -12.7), 16)
    yield one('cylinder-cap-3-4-5', 'cylinder-cap', (1, 5, 8), (1, 4, -2, 5, -3), 7, 0,
              ((1, 0), (5, 2), (-3, 2)))
    yield one('sphere-cap', 'sphere-cap', (0.7, 0.1, 4.4, 6.2), (0.7, 0.1, 3.8, -2.4), 5)
    yield one('bowl-3-4-5', 'sphere-cap', (0, 0, 5, 8), (0, 2.4, 3.2, 4, -4, -2.4, -3.2), 6, 1,
              ((0, 0), (4, 0), (-4, 0), (0, 4), (0, -4)))
    yield one('gaussian', 'gaussian', (0.5, -1, 3, 1.7), (0.5, -1, 9, -12), 6, 0, ((0.5, -1),))
    yield one('gaussian-hole', 'gaussian', (0, 0, -1, 0.25), (0, 0.25, 2, 15), 2)
    yield one('grating', 'grating', (0.45, 2.3, -1.1, 0.6), (0, 1, -2), 10)
    yield one('grating-from-0', 'grating', (0.5, 3, -4, 0), (0, 4, 3, 100), 8, 0, ((0, 0), (4, 3)))
    yield one('polygons', 'polygons', (-3, 0.5, -1, 2.5, 0.5, 2.5, 2, -0.25, 6, 1), (-3, -1, 0.5, 2, 6), 7)
    yield one('polygons-3-4-5', 'polygons', (-4, 0, 0, 3, 4, 0), (-4, 0, 4), 5)
    for interpolant in 'bilinear', 'cubic-spline':
        for edge in 'clamp', 'tile':
            kind = f'{interpolant}-{edge}'
            yield one(f'{kind}-rough', kind, (6, 5, 0.35, *values(kind, 30, -0.6, 0.8)),
                      (0, 0.175, -0.175, 0.35, 0.875, -0.875, 0.7), 1.8)
            yield one(f'{kind}-coarse', kind, (5, 4, 0.5, *coarse(kind, 20)), (0, 0.5, -0.5, 0.25, 0.75, -0.75, 1), 2)
    one_cone, slope = ('cone', (0.0, 0.0, 2.0, 4.0)), ('plane', (0.75, 0.0, 1.0))
    yield Map('cancelling-cones', [(0, *one_cone), (1, *one_cone), (0, *slope)], (0.0, 4.0, -4.0), 5)
    yield Map(TAIL, [(0, *slope), (0, 'gaussian', (0.0, 0.0, 1.0, 0.5))],
              (0.0, 16.0, -24.0, 40.0), 32)
    yield Map('wave-on-a-plane', [(0, 'plane', f32(-0.4, 0.2, 1)), (1, 'grating', f32(0.1, 5, 1, 0.3))], (0.0, 1.0), 6)
    yield Map('cap-in-a-cone', [(0, 'cone', f32(0, 0, 2, 6)), (1, 'sphere-cap', f32(1, 0, 5, 6))], (0.0, 6.0, 4.0, -2.0), 7)
    # Depth from one surface, direction from another.
    yield Map('spline-on-two-polygons', [(0, 'cubic-spline-tile', (4.0, 3.0, 0.5, *coarse('shaded', 12)))],
              (0.0, 3.0, -3.0, 0.25), 4, [(0, 'polygons', (-3.0, 0.0, 0.0, 1.5, 3.0, 0.0))])
    yield Map('cone-on-a-cap', [(0, 'cone', f32(0.2, 0, 2.4, 5))], f32(0, 0.2, 4, 5.2), 6,
              [(0, 'sphere-cap', f32(0, 0, 9, 8))])


def bounded(f):
    return min(max(single(f), -1e4), 1e4)


def heights(draw, a_map, rendering, x, y, count):
    """z on the surface or next to it, and below it."""
    U = local(a_map, rendering, read(x), read(y))[0]
    near = binary32(U)[0]
    for _ in range(count):
        choice = int(8 * draw.random())
        if choice < 3:
            yield bounded(step(near, choice - 1))
        elif choice == 3:
            yield bounded(near - math.ldexp(1 + draw.random(), -int(24 * draw.random())))
        elif choice == 4:
            yield draw.pick((0.0, -0.0, QUANTUM, step(QUANTUM, -1), -QUANTUM))
        elif choice == 5:
            yield bounded(math.floor(16 * near) / 16 - int(32 * draw.random()) / 16)
        else:
            yield bounded(near - 2 * draw.random())


def coordinate(draw, a_map):
    choice = int(6 * draw.random())
    edge = draw.pick(a_map.edges)
    if choice == 0:
        return edge
    if choice == 1:
        return step(edge, draw.pick((-2, -1, 1, 2)))
    if choice == 2:
        return int((2 * draw.random() - 1) * a_map.reach * 16) / 16
    return draw.between(-a_map.reach, a_map.reach)


def positions(draw, a_map, rendering, count):
    for x, y in a_map.points:
        yield x, y, -0.625
        for z in heights(draw, a_map, rendering, x, y, 2):
            yield x, y, z
    for _ in range(count):
        x, y = coordinate(draw, a_map), coordinate(draw, a_map)
        for z in heights(draw, a_map, rendering, x, y, 2):
            yield x, y, z


def ties(draw, a_map, rendering, wanted, tries):
    """Inputs for which a component of the force lies exactly half way between two binary32 numbers: where the normal's length
    is rational, the gap is taken as a multiple of it."""
    found = 0
    for _ in range(tries):
        x, y = (draw.pick(a_map.edges) if draw.random() < 0.5 else int((2 * draw.random() - 1) * a_map.reach * 4) / 4
                for _ in 'xy')
        height, Ux, Uy = local(a_map, rendering, read(x), read(y))
        length = sqrt(Ux * Ux + Uy * Uy + 1)
        if any(isinstance(n, Algebraic) for n in (height, Ux, Uy)):
            continue
        n = Fraction(1) if rendering == 'height-map-conservative' or isinstance(length, Algebraic) else length
        K = draw.pick((1, 3, 5, 7, 9, 15, 25)) / draw.pick((2, 4, 16))
        z = height - n * Fraction(int(draw.random() * 2**22) | 1, 2**draw.pick((20, 21, 22)))
        if Fraction(single(float(z))) != z:
            continue
        force, _ = evaluate(a_map, rendering, K, (x, y, float(z)))
        if any(binary32(f)[1] for f in force):
            yield K, (x, y, float(z))
            found += 1
            if found == wanted:
                return


INVALID = [(0.0, 0.0, step(-1e4, -1)), (step(1e4, 1), 0.0, -1.0), (0.0, math.nan, -1.0), (0.0, 0.0, math.inf)]


def inputs(a_map, rendering):
    draw = Draw(f'forceshade {a_map.name} {rendering}')
    for position in positions(draw, a_map, rendering, 11):
        yield draw.pick((0.5, 1.0, single(0.3), single(draw.between(0.01, 2)))), position
    yield from ties(draw, a_map, rendering, 3, 60)
    if a_map.name == TAIL:  # ties of the plane alone, beside which the tail decides
        yield from ties(draw, Map(TAIL, a_map.parts[:1], a_map.edges[1:], a_map.reach), rendering, 12, 400)
    yield 1.0, draw.pick(INVALID)


# ---------------------------------------------------------------- the files

def main(directory):
    described, rows, reached = [], {}, Counter()
    for a_map in maps():
        for use, parts in ('map', a_map.parts), ('surface', a_map.surface):
            for negated, shape, numbers in parts:
                described.append((a_map.name, use, negated, shape, ' '.join(map(hexfloat, map(float, numbers)))))
        for rendering in RENDERINGS if not a_map.surface else RENDERINGS[1:2]:
            for K, position in inputs(a_map, rendering):
                assert all(repr(single(c)) == repr(c) for c in (K, *position))
                key = a_map.name, rendering, *map(hexfloat, (K, *position))
                if key in rows:
                    continue
                force, status = evaluate(a_map, rendering, K, position)
                rounded = [binary32(f) for f in force]
                rows[key] = *key, *(decimal(f, 40) for f in force), *(hexfloat(f) for f, _ in rounded), status
                reached.update({(rendering, 'rows'): 1, (rendering, status): 1,
                                (rendering, 'ties'): sum(tie for _, tie in rounded)})
    write(directory / 'height_maps.csv', 'map,use,negated,shape,numbers', described)
    write(directory / 'height_forces.csv',
          'map,rendering,K_N_per_mm,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,fx_binary32,fy_binary32,fz_binary32,status', rows.values())
    for rendering in RENDERINGS:
        kinds = 'rows', 'contact', 'free', 'invalid', 'ties'
        print(f'{rendering:24}', *(f'{kind} {reached[rendering, kind]:4}' for kind in kinds))
        assert all(reached[rendering, kind] for kind in kinds)


if __name__ == '__main__':
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
