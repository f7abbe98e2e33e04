#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes bump_geometry.csv and bump_forces.csv: the nine force laws on inputs chosen to hurt, from integers alone.

Usage: make_golden.py [directory]      (the default is the directory of this file; the output is always the same)

No floating-point number takes part in a result. A force is an element of a tower of real fields Q ⊂ Q(g₁) ⊂ Q(g₁, g₂)…,
where a generator g is a square root or the root t of 4t³ − 3t + s, and every decision (contact, facet, digit, rounding,
tie) is the sign of such an element:
  1. an enclosure in 512-bit fixed point decides, unless it contains zero;
  2. else exact algebra does: sign(a + b√q) follows from the signs of a, b and a² − b²q, all one storey below; over Q(t)
     a polynomial of degree < 3 vanishes only if all its coefficients do, because third() hands out a cubic t only when
     the cubic is irreducible over Q.
So a tie is proved by algebra, not by a separation bound, and the files do not depend on BITS.
"""

import csv
import math
import random
import struct
import sys
from collections import Counter
from fractions import Fraction
from functools import lru_cache
from pathlib import Path

BITS = 512
HALF = Fraction(1, 2)


# ---------------------------------------------------------------- exact real numbers

def last(holds, low, high):
    """The largest integer n in [low, high) where `holds`, which is true at low and, once false, stays false."""
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low


class Root:
    """A real number g > 0 over the numbers made before it: gⁿ = Σ power[i]·gⁱ with n = len(power)."""

    made = 0

    def __init__(self, power):
        Root.made += 1
        self.rank, self.power, self.known = Root.made, power, {}

    def enclose(self, bits):
        if bits not in self.known:
            self.known[bits] = self.isolate(bits)
        return self.known[bits]


class SquareRoot(Root):
    def __init__(self, square):
        super().__init__((square, Fraction(0)))

    def isolate(self, bits):
        low, high = enclose(self.power[0], bits)
        return math.isqrt(max(low, 0) << bits), math.isqrt(high << bits) + 1

    def sign(self, coefficient):
        a, b = coefficient
        sign_a, sign_b = sign(a), sign(b)
        return sign_a * sign(a * a - b * b * self.power[0]) if sign_a * sign_b < 0 else sign_a or sign_b


class ThirdOfAngle(Root):
    """The root t of 4t³ − 3t + s in (0, ½), where the cubic falls; 0 < s < 1, the cubic irreducible."""

    def __init__(self, s):
        super().__init__((-s / 4, Fraction(3, 4), Fraction(0)))
        self.s = s

    def isolate(self, bits):
        one, p, q = 1 << bits, self.s.numerator, self.s.denominator
        n = last(lambda n: q * n * (4 * n * n - 3 * one * one) + p * one**3 >= 0, 0, one // 2)
        return n, n + 1

    def sign(self, coefficient):
        number, bits = Algebraic(self, coefficient), BITS
        while True:  # ends: the number is not zero
            bits *= 2
            low, high = enclose(number, bits)
            if low > 0 or high < 0:
                return 1 if low > 0 else -1


class Algebraic:
    """Σ coefficient[i]·gⁱ, the coefficients rational or made of roots of lower rank."""

    def __init__(self, root, coefficient):
        self.root, self.coefficient = root, coefficient

    def map(self, f):
        return make(self.root, [f(c) for c in self.coefficient])

    def __add__(self, other):
        if not isinstance(other, Algebraic) or other.root.rank < self.root.rank:
            return Algebraic(self.root, (self.coefficient[0] + other, *self.coefficient[1:]))
        if other.root is not self.root:
            return other + self
        return make(self.root, [a + b for a, b in zip(self.coefficient, other.coefficient)])

    def __mul__(self, other):
        if not isinstance(other, Algebraic) or other.root.rank < self.root.rank:
            return self.map(lambda c: c * other)
        if other.root is not self.root:
            return other * self
        n = len(self.coefficient)
        product = [Fraction(0)] * (2 * n - 1)
        for i, a in enumerate(self.coefficient):
            for j, b in enumerate(other.coefficient):
                product[i + j] += a * b
        while len(product) > n:
            top = product.pop()
            for i, p in enumerate(self.root.power):
                product[len(product) - n + i] += top * p
        return make(self.root, product)

    def __truediv__(self, other):
        return self * reciprocal(other)

    def __rtruediv__(self, other):
        return other * reciprocal(self)

    def __neg__(self):
        return self.map(lambda c: -c)

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return -self + other

    __radd__, __rmul__ = __add__, __mul__


def make(root, coefficient):
    return Algebraic(root, tuple(coefficient)) if any(coefficient[1:]) else coefficient[0]


def reciprocal(x):
    """Rationals, and a + b√q with √q irrational: the only divisors that the laws need."""
    if not isinstance(x, Algebraic):
        return 1 / Fraction(x)
    a, b = x.coefficient
    conjugate = Algebraic(x.root, (a, -b))
    return conjugate * reciprocal(x * conjugate)


def enclose(x, bits):
    """Integers low, high with low ≤ x·2^bits ≤ high."""
    if not isinstance(x, Algebraic):
        scaled = x.numerator << bits
        return scaled // x.denominator, -(-scaled // x.denominator)
    g_low, g_high = x.root.enclose(bits)
    low = high = 0
    for c in reversed(x.coefficient):
        c_low, c_high = enclose(c, bits)
        low = (low * (g_low if low >= 0 else g_high) >> bits) + c_low
        high = -(-high * (g_high if high >= 0 else g_low) >> bits) + c_high
    return low, high


def sign(x):
    if not isinstance(x, Algebraic):
        return (x > 0) - (x < 0)
    low, high = enclose(x, BITS)
    return 1 if low > 0 else -1 if high < 0 else x.root.sign(x.coefficient)


def sqrt(x):
    """√x for x ≥ 0, rational where x is the square of a rational."""
    if not isinstance(x, Algebraic):
        p, q = math.isqrt(x.numerator), math.isqrt(x.denominator)
        if p * p == x.numerator and q * q == x.denominator:
            return Fraction(p, q)
    return Algebraic(SquareRoot(x), (Fraction(0), Fraction(1))) if sign(x) else Fraction(0)


def third(s):
    """t = sin(arcsin(s)/3), the root of 4t³ − 3t + s in (0, ½], in the smallest field that holds it.

    A rational root is a/2b with a³ − 3ab² + p = 0, where 2s = p/b³ in lowest terms: the denominator has to be a cube.
    The three roots are sought between the turning points ∓b.
    """
    p, q = (2 * s).numerator, (2 * s).denominator
    b = last(lambda n: n**3 <= q, 0, q + 1)
    if b**3 == q:
        f = lambda a: a**3 - 3 * a * b * b + p
        a = last(lambda a: f(a) >= 0, 0, b + 1)
        if f(a) == 0:
            return Fraction(a, 2 * b)
        for low, side in (-2 * b, -1), (b, 1):
            a = last(lambda a: f(a) <= 0, low, low + b + 1)
            if f(a) == 0:  # another root r is rational: t is a root of 4t² + 4rt + 4r² − 3
                r = Fraction(a, 2 * b)
                return (-r + side * sqrt(3 - 3 * r * r)) / 2
    return Algebraic(ThirdOfAngle(s), (Fraction(0), Fraction(1), Fraction(0)))


# ---------------------------------------------------------------- rounding

def floor(x):
    if not isinstance(x, Algebraic):
        return x.numerator // x.denominator
    bits = BITS
    while (high := enclose(x, bits)[1]) - enclose(x, bits)[0] >= 1 << bits:
        bits *= 2
    n = high >> bits
    return n if sign(x - n) >= 0 else n - 1


def nearest(x):
    """The integer nearest to x, ties to even, and whether there was a tie."""
    n = floor(x + HALF)
    tie = sign(x + HALF - n) == 0
    return (n - (n & 1) if tie else n), tie


def exponent(x, base):
    """The largest e with base^e ≤ x, for x > 0: a guess, then corrected by exact comparisons."""
    bits = BITS
    while enclose(x, bits)[0] <= 0:
        bits *= 2
    e = math.floor((math.log2(enclose(x, bits)[0]) - bits) / math.log2(base))
    while sign(x - Fraction(base)**e) < 0:
        e -= 1
    while sign(x - Fraction(base)**(e + 1)) >= 0:
        e += 1
    return e


def decimal(x, digits):
    """x correctly rounded to so many significant decimal digits, scientific, trailing zeros dropped."""
    side = sign(x)
    if side == 0:
        return '0'
    e = exponent(side * x, 10)
    text = str(nearest(side * x * Fraction(10)**(digits - 1 - e))[0])
    e += len(text) - digits  # 9.99… may have become 10.0…
    fraction = text[1:].rstrip('0')
    return f"{'-' if side < 0 else ''}{text[0]}{'.' if fraction else ''}{fraction}e{e:+d}"


def binary32(x):
    """x rounded to binary32, nearest, ties to even; zero is +0; and whether there was a tie."""
    side = sign(x)
    if side == 0:
        return 0.0, False
    unit = max(exponent(side * x, 2), -126) - 23
    n, tie = nearest(side * x * Fraction(2)**-unit)
    return math.ldexp(side * n, unit) if n else 0.0, tie  # exact; no force in the domain comes near 2¹²⁸


def hexfloat(f):
    mantissa, p, e = f.hex().partition('p')
    return (mantissa.rstrip('0').rstrip('.') if p else mantissa) + p + e


# ---------------------------------------------------------------- the laws

class Bump:
    def __init__(self, R, w):
        self.R, self.w = R, w = Fraction(R), Fraction(w)
        assert Fraction(1, 10) <= R <= 10**4 and Fraction(1, 1000) <= w <= 2 * R
        s = w / (2 * R)
        self.d = d = sqrt(R * R - w * w / 4)
        self.h = h = R - d
        self.slope_2p = 2 * h / w
        self.cos_2p = 1 / sqrt(1 + self.slope_2p * self.slope_2p)

        self.t = t = third(s)
        cos_third = sqrt(1 - t * t)
        self.sin_3p = sin = 2 * t * cos_third  # of θ = 2 arcsin t
        self.cos_3p = cos = 1 - 2 * t * t
        self.tan_3p = sin * (4 * cos * cos - 3) / (1 - 2 * s * s)  # 4cos³θ − 3cos θ = cos 3θ = cos 2α ≠ 0
        self.w_flat = 2 * R * t
        self.h_flat = self.w_flat * sin
        # The definitions, as identities between algebraic numbers (not to so many digits).
        assert sign(w * cos - 2 * d * sin - self.w_flat) == 0
        assert sign(w / 2 * sin + d * cos - d - self.h_flat) == 0
        assert sign(self.tan_3p * (w - self.w_flat) - 2 * self.h_flat) == 0

    def theta(self):
        """θ = 2 arcsin t to 50 digits, from both ends of an enclosure of t. θ is transcendental: no tie is possible.

        In units of 2^−664: each of the N terms is cut by less than 3, and what follows the last is less than 2.
        """
        texts = set()
        for end, t in enumerate(enclose(self.t, 600)):
            power, total, n = t << 64, 0, 0  # power = t^(2n+1)·(2n)!/(4ⁿ n!²), which falls faster than ¼ⁿ
            while power:
                total += power // (2 * n + 1)
                n += 1
                power = (power * t * t * (2 * n - 1) >> 1200) // (2 * n)
            texts.add(decimal(Fraction(2 * (total + end * (3 * n + 2)), 1 << 664), 50))
        theta, = texts
        return theta


def flat(b, x):
    return 0


def roof(b, x):
    return b.h * (1 - 2 * abs(x) / b.w) if 2 * abs(x) <= b.w else 0


def trapezium(b, x):
    if sign(b.w_flat - 2 * abs(x)) >= 0:
        return b.h_flat
    return b.tan_3p * (b.w / 2 - abs(x)) if 2 * abs(x) <= b.w else 0


UP = 0, 1


def flat_normal(b, x):
    return UP


def roof_normal(b, x):
    if 2 * abs(x) > b.w:
        return UP
    return (b.slope_2p if x >= 0 else -b.slope_2p) * b.cos_2p, b.cos_2p


def trapezium_normal(b, x):
    if sign(b.w_flat - 2 * abs(x)) >= 0 or 2 * abs(x) > b.w:
        return UP
    return (b.sin_3p if x > 0 else -b.sin_3p), b.cos_3p


def circle_normal(b, x):
    return (x / b.R, sqrt(b.R * b.R - x * x) / b.R) if 2 * abs(x) <= b.w else UP


def height_map(height, normal):
    def force(b, K, x, z):
        depth = height(b, x) - z
        return tuple(K * depth * n for n in normal(b, x)) if sign(depth) > 0 else None
    return force


def cylinder(b, K, x, z):
    zeta = z + b.d
    square = x * x + zeta * zeta
    if sign(square) == 0:
        return 0, K * b.R
    if sign(b.R * b.R - square) <= 0:
        return None
    pull = K * (b.R * sqrt(square) / square - 1)  # K(R − ρ)/ρ, with 1/ρ = ρ/ρ²
    return pull * x, pull * zeta


wall = height_map(flat, flat_normal)


def bump_cylinder(b, K, x, z):
    parts = [f for f in (cylinder(b, K, x, z), wall(b, K, x, z)) if f]
    return tuple(map(sum, zip(*parts))) or None


LAWS = {
    'wall': wall,
    'cylinder': cylinder,
    'bump-cylinder': bump_cylinder,
    'bump-1p': height_map(flat, flat_normal),
    'bump-2p': height_map(roof, roof_normal),
    'bump-3p': height_map(trapezium, trapezium_normal),
    'bump-1p-shaded': height_map(flat, circle_normal),
    'bump-2p-shaded': height_map(roof, circle_normal),
    'bump-3p-shaded': height_map(trapezium, circle_normal),
}

QUANTUM = 2.0**-30


def read(coordinate):
    return Fraction(coordinate) if abs(coordinate) >= QUANTUM else Fraction(0)


def evaluate(law, b, K, position):
    """The exact force (fx, fz) and the status."""
    assert 1e-3 <= K <= 1e3
    if not all(abs(c) <= 1e4 for c in position):  # false for NaN too
        return (0, 0), 'invalid'
    x, _, z = map(read, position)
    force = LAWS[law](b, Fraction(K), x, z)
    return (force, 'contact') if force else ((0, 0), 'free')


# ---------------------------------------------------------------- the inputs

def single(x):
    return struct.unpack('<f', struct.pack('<f', x))[0]


def ordinal(f):
    """binary32 numbers counted in order; both zeros are 0."""
    n = struct.unpack('<i', struct.pack('<f', f))[0]
    return n if n >= 0 else -(n & 0x7fffffff)


def at(n):
    return math.copysign(struct.unpack('<f', struct.pack('<i', abs(n)))[0], n)


def step(f, n):
    return at(ordinal(f) + n)


def straddle(holds, low, high):
    """The last binary32 in [low, high) where `holds`, and the neighbour on either side of it."""
    n = last(lambda n: holds(at(n)), ordinal(low), ordinal(high))
    return [at(n - 1), at(n), at(n + 1)]


bump = lru_cache(None)(Bump)
PARAMETERS = [(single(R), single(w), single(K)) for R, w, K in (
    (15.24, 25.4, 0.5), (20.32, 25.4, 0.5), (25.4, 25.4, 0.5), (30.48, 25.4, 0.5), (35.56, 25.4, 0.5),  # the thesis
    (1.25, 1.5, 0.5), (2.5, 3, 1.5), (3.125, 6, 2.5),      # d rational
    (1, 1.375, 0.75), (2197 / 1024, 2035 / 512, 1.0),      # t = ¼; t = 5/13, and d and h′ rational too
    (1, 1.125, 3.0),                                       # the cubic has the root ¾, t is (√21 − 3)/8
    (12.7, 25.4, 0.5), (step(12.7, 1), 25.4, 0.5),         # w = 2R, and one unit in the last place short of it
    (0.1, 1e-3, 1e-3), (0.1, 0.2, 1e3), (1e4, 1e-3, 1e3), (1e4, 2e4, 1e-3), (1e4, step(2e4, -1), 1e3))]
TIE_BUMPS = (1.25, 1.5), (2.5, 3.0), (3.125, 6.0), (2197 / 1024, 2035 / 512), (1e4, 1.2e4), (8788.0, 16280.0)
TRIPLES = (3, 4, 5), (4, 3, 5), (7, 24, 25), (24, 7, 25), (5, 12, 13), (12, 5, 13)
INVALID = [(0.0, 0.0, step(-1e4, -1)), (step(1e4, 1), 0.0, -1.0), (0.0, step(1e4, 1), -1.0),
           (single(-3e38), 0.0, -1.0), (math.nan, 0.0, -1.0), (0.0, math.nan, -1.0), (0.0, 0.0, math.nan),
           (math.inf, 0.0, -1.0), (0.0, -math.inf, -1.0), (0.0, 0.0, -math.inf)]
ENDS = [(1e4, 0.0, -1e4), (-1e4, 1e4, -1e4), (0.0, -1e4, step(-1e4, 1)), (1.0, 0.0, 1e4), (-0.0, -0.0, -0.0)]


class Draw(random.Random):
    """Uses random() alone, the one method promised to be the same in every Python."""

    def pick(self, items):
        return items[int(self.random() * len(items))]

    def between(self, low, high):
        return single(low + (high - low) * self.random())

    def log(self, low, high):
        low, high = ordinal(low), ordinal(high)  # binary32 numbers in order are nearly a logarithm, and need no libm
        return at(low + int((high - low) * self.random()))

    def binade(self, low, high):
        return single(math.ldexp(self.pick((-1, 1)) * (1 + self.random()), low + int(self.random() * (high - low))))


def lines(b):
    """Both sides of every line where a law may change: x = 0 and the quantum, |x| = w′/2, |x| = w/2, |x| = R."""
    edges = [0.0, at(1), step(QUANTUM, -1), QUANTUM, step(QUANTUM, 1)]
    for edge in (b.w_flat / 2, b.w / 2, b.R):
        edges += straddle(lambda x: sign(edge - Fraction(x)) >= 0, 0.0, 2e4)
    return [side * x for x in edges for side in (1.0, -1.0) if x <= 1e4]


def around(draw, law, b, K, x):
    """The binary32 numbers next to a surface at x, found by bisection on the law itself; where the cylinder has none,
    next to the height of its axis."""
    touches = lambda z: evaluate(law, b, K, (x, 0.0, z))[1] == 'contact'
    if law != 'cylinder':
        return straddle(touches, -1e4, 1e4)
    axis = beside_axis(b)
    if not touches(axis[1]):
        return axis
    if touches(-1e4) or draw.random() < 0.5:
        return straddle(touches, axis[1], 1e4)
    return straddle(lambda z: not touches(z), -1e4, axis[1])


def beside_axis(b):
    return straddle(lambda z: sign(Fraction(z) + b.d) <= 0, -1e4, 1.0)


def positions(draw, law, b, K):
    R, w, depth = float(b.R), float(b.w), max(float(b.w) / 4, 1e-3)
    edges = lines(b)
    for x in draw.pick(edges), draw.between(-w / 2, w / 2):           # at the surface
        for z in around(draw, law, b, K, x):
            yield x, 0.0, z
    for _ in range(4):                                                # under the lines
        yield draw.pick(edges), draw.binade(-20, 12), -draw.log(1e-6 * depth, depth)
    for _ in range(2):                                                # under the bump, or a little above
        yield draw.between(-w / 2, w / 2), 0.0, draw.between(-depth, depth / 2)
    for _ in range(2):                                                # anywhere
        yield draw.binade(-40, 14), draw.binade(-149, 14), draw.binade(-40, 14)
    yield draw.binade(-149, -20), 0.0, draw.binade(-149, 10)          # around the quantum, and subnormal
    if 'cylinder' in law:
        axis = beside_axis(b)
        yield draw.pick((0.0, -0.0, QUANTUM, -1.5 * QUANTUM)), 0.0, draw.pick(axis)
        x = draw.pick((0.0, draw.between(0, R / 4)))                  # where the wall and the cylinder cancel
        lifts = lambda z: sign(evaluate('bump-cylinder', b, K, (x, 0.0, z))[0][1]) > 0
        for z in straddle(lifts, -R, axis[0]):
            yield x, 0.0, z


def ties(draw, law, wanted):
    """Inputs for which a component of the force lies exactly half way between two binary32 numbers."""
    found = 0
    while found < wanted:
        R, w = draw.pick(TIE_BUMPS)
        b, (p, q, r) = bump(R, w), draw.pick(TRIPLES)
        K = draw.pick((1, 3, 5, 7, 9, 11, 13)) * draw.pick((1, 5, 25, 13, 169)) / draw.pick((8, 16, 64))
        n = int(draw.random() * 2**24) | 1
        z = -n / 2**draw.pick((10, 12, 22, 23, 24, 25))
        x = draw.pick((0.0, R * p / r, w / 2, R * (2035 - 119 * int(10 * draw.random())) / 2197))
        if 'cylinder' in law and draw.random() < 0.5:
            m = (n >> 4) / 2**22 * draw.pick((1, 2**10))
            x, z = m * p, m * q * draw.pick((1, -1)) - float(b.d)
        x *= draw.pick((1, -1))
        if single(x) != x or single(z) != z:
            continue
        force, status = evaluate(law, b, K, (x, 0.0, z))
        if any(binary32(f)[1] for f in force):
            found += 1
            for nudge in (0.0, step(QUANTUM, -1), QUANTUM) if x == 0 else (0.0,):  # a tie, read as one, just missed
                yield b, K, (x + nudge, 0.0, z)


def inputs(law):
    draw = Draw(f'forceshade {law}')
    for R, w, K in PARAMETERS:
        for position in positions(draw, law, bump(R, w), K):
            yield bump(R, w), K, position
    for _ in range(6):
        R = draw.log(0.11, 9e3)
        b, K = bump(R, draw.log(1e-3, 2 * R)), draw.log(1e-3, 1e3)
        for position in positions(draw, law, b, K):
            yield b, K, position
    b, K = bump(*PARAMETERS[0][:2]), 0.5
    for position in INVALID + ENDS:
        yield b, K, position
    yield from ties(draw, law, 16)


# ---------------------------------------------------------------- the files

def geometry_row(b):
    return [hexfloat(float(b.R)), hexfloat(float(b.w)),
            *(decimal(length, 50) for length in (b.d, b.h, b.w_flat, b.h_flat)), b.theta()]


def write(path, header, rows):
    with open(path, 'w', newline='', encoding='ascii') as file:
        csv.writer(file, lineterminator='\n').writerows([header.split(','), *rows])


def main(directory):
    rows, bumps, reached = {}, {}, Counter()
    for law in LAWS:
        for b, K, position in inputs(law):
            assert all(repr(single(c)) == repr(c) for c in (K, *position))
            key = law, *map(hexfloat, (float(b.R), float(b.w), K, *position))
            if key in rows:
                continue
            force, status = evaluate(law, b, K, position)
            rounded = [binary32(f) for f in force]
            rows[key] = *key, *(decimal(f, 40) for f in force), *(hexfloat(f) for f, _ in rounded), status
            bumps[b] = None
            reached.update({(law, 'rows'): 1, (law, status): 1, (law, 'ties'): sum(tie for _, tie in rounded)})
    write(directory / 'bump_geometry.csv', 'R_mm,w_mm,d_mm,h_mm,w_prime_mm,h_prime_mm,theta_rad',
          map(geometry_row, bumps))
    write(directory / 'bump_forces.csv',
          'law,R_mm,w_mm,K_N_per_mm,x_mm,y_mm,z_mm,fx_N,fz_N,fx_binary32,fz_binary32,status', rows.values())
    for law in LAWS:
        kinds = 'rows', 'contact', 'free', 'invalid', 'ties'
        print(f'{law:15}', *(f'{kind} {reached[law, kind]:4}' for kind in kinds))
        assert all(reached[law, kind] for kind in kinds)


if __name__ == '__main__':
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
