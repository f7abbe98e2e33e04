#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""terms_test.py COUNT: no rule of the terms changes a bit. Random expressions of random numbers are made as terms and computed beside
that; each term must have the value, and have it still where conditions that hold are assumed."""
import math
import random
import struct
import sys
from fractions import Fraction

import cases
import registers
import terms as t

SPECIAL = [0.0, -0.0, 1.0, -1.0, 2.0, 0.5, 1e-30, 2.0**-126, 3.0e38, 1e4, 2.0**-30, math.inf, -math.inf]


def bits(value, size):
    if size == '8':
        return struct.unpack('<Q', struct.pack('<d', value))[0]
    try:
        return struct.unpack('<I', struct.pack('<f', value))[0]
    except OverflowError:
        return 0x7f800000 | (0x80000000 if value < 0 else 0)


def real(word, size):
    return struct.unpack('<d', struct.pack('<Q', word))[0] if size == '8' else struct.unpack('<f', struct.pack('<I', word))[0]


def rounded(name, values):
    """An operation of numbers in Python's binary64; NaN where there is no number."""
    if any(map(math.isnan, values)):
        return math.nan
    x, y, z = (values + [0, 0])[:3]
    if name == 'root':
        return math.sqrt(x) if x >= 0 else math.nan
    if name == 'over':
        sign = math.copysign(1, x) * math.copysign(1, y)
        return x / y if y else math.nan if x == 0 else sign * math.inf
    if name in ('plus', 'minus'):
        return x + y if name == 'plus' else x - y
    if name == 'times' or any(map(math.isinf, values)) or x * y == 0:
        return x * y if name == 'times' else x * y + z
    total = Fraction(x) * Fraction(y) + Fraction(z)
    try:
        return float(total) if total else 0.0
    except OverflowError:
        return math.inf if total > 0 else -math.inf


def operation(name, size, words):
    value = rounded(name, [real(word, size) for word in words])
    return bits(value, size)


COMPARE = {'lt': lambda x, y: x < y, 'le': lambda x, y: x <= y, 'eq': lambda x, y: x == y, 'un': lambda x, y: x != x or y != y}


def value_of(a, leaves, memo):
    """The value of a term: bits of a word or a number, or True or False."""
    if a not in memo:
        name, *parts = t.terms[a]
        size = name[-1]

        def of(i):
            return value_of(parts[i], leaves, memo)
        if name in ('T', 'F'):
            result = name == 'T'
        elif name in ('c4', 'c8'):
            result = parts[0]
        elif name in ('in4', 'in8'):
            result = leaves[a]
        elif name == 'or':
            result = any(value_of(part, leaves, memo) for part in parts[0])
        elif name in ('umax4', 'umin4'):
            result = (max if name == 'umax4' else min)(value_of(part, leaves, memo) for part in parts[0])
        elif name in ('if4', 'if8'):
            result = of(1) if of(0) else of(2)
        elif name[:2] in COMPARE and len(name) == 3:
            result = COMPARE[name[:2]](real(of(0), size), real(of(1), size))
        elif name in t.BITWISE:
            result = t.BITWISE[name](of(0), of(1)) & t.ONES
        elif name == 'unfused' + size:
            result = operation('fused', size, [of(0) ^ (1 << (63 if size == '8' else 31)), of(1), of(2)])
        elif name[:-1] in ('plus', 'minus', 'times', 'over', 'root', 'fused'):
            result = operation(name[:-1], size, [of(i) for i in range(len(parts))])
        elif name == 'byte4':
            result = of(0) >> 8 * parts[1] & 255
        else:
            result = {'not': lambda: not of(0), 'ule4': lambda: of(0) <= of(1), 'zero4': lambda: of(0) == 0, 'top4': lambda: of(0) >= t.TOP,
                      'same4': lambda: of(0) == of(1), 'lo4': lambda: of(0) & t.ONES, 'hi4': lambda: of(0) >> 32,
                      'join8': lambda: of(0) | of(1) << 32, 'neg4': lambda: of(0) ^ t.TOP, 'abs4': lambda: of(0) & t.SIZE,
                      'neg8': lambda: of(0) ^ 1 << 63, 'abs8': lambda: of(0) & (1 << 63) - 1, 'wide': lambda: bits(real(of(0), '4'), '8'),
                      'narrow': lambda: bits(real(of(0), '8'), '4'),
                      'bytes4': lambda: sum(of(i) << 8 * i for i in range(4))}[name]()
        memo[a] = result
    return memo[a]


def made(pools):
    """A new term of those that there are, and its value: the kind of it, the term, the value."""
    def some(kind):
        return random.choice(pools[kind])
    kind = random.choice(['4', '4', '8', '8', 'c', 'c'])
    (w, a), (v, b), (d, x), (e, y), (g, z), (c, holds), (k, also) = map(some, ('4', '4', '8', '8', '8', 'c', 'c'))
    size = random.choice('48')
    (m, p), (n, q) = map(some, size * 2)
    number = random.choice(['plus', 'minus', 'times', 'over'])
    if kind == '4':
        name = random.choice(list(t.BITWISE))
        i = random.randrange(4)
        return kind, *random.choice([
            lambda: (t.word(name, w, v), t.BITWISE[name](a, b) & t.ONES), lambda: (t.absolute4(w), a & t.SIZE),
            lambda: (t.negative4(w), a ^ t.TOP), lambda: (t.extreme('umax4', w, v), max(a, b)), lambda: (t.inverted(w), a ^ t.ONES),
            lambda: (t.extreme('umin4', w, v), min(a, b)), lambda: (t.chosen(c, w, v, '4'), a if holds else b),
            lambda: (t.mask(c), t.ONES if holds else 0), lambda: (t.half(d, True), x >> 32), lambda: (t.half(d, False), x & t.ONES),
            lambda: (t.narrow(d), bits(real(x, '8'), '4')), lambda: (t.byte_of(w, i), a >> 8 * i & 255),
            lambda: (t.word_of_bytes([t.byte_of(w, 0), t.byte_of(v, 1), t.byte_of(w, 2), t.byte_of(v, 3)]), a & 0xff00ff | b & 0xff00ff00),
            lambda: (t.real(number + '4', w, v), operation(number, '4', [a, b]))])()
    if kind == '8':
        return kind, *random.choice([
            lambda: (t.joined(w, v), a | b << 32), lambda: (t.joined(t.half(d, False), t.negative4(t.half(d, True))), x ^ 1 << 63),
            lambda: (t.real('neg8', d), x ^ 1 << 63), lambda: (t.real('abs8', d), x & (1 << 63) - 1),
            lambda: (t.wide(w), bits(real(a, '4'), '8')), lambda: (t.chosen(c, d, e, '8'), x if holds else y),
            lambda: (t.joined(*(t.chosen(c, t.half(d, upper), t.half(e, upper), '4') for upper in (False, True))), x if holds else y),
            lambda: (t.real('root8', d), operation('root', '8', [x])),
            lambda: (t.real('fused8', d, e, g), operation('fused', '8', [x, y, z])),
            lambda: (t.real(number + '8', d, e), operation(number, '8', [x, y]))])()
    name = random.choice(list(COMPARE))
    return kind, *random.choice([
        lambda: (t.compared(name + size, m, n), COMPARE[name](real(p, size), real(q, size))), lambda: (t.negation(c), not holds),
        lambda: (t.either(c, k), holds or also), lambda: (t.both(c, k), holds and also), lambda: (t.unsigned_at_most(w, v), a <= b),
        lambda: (t.unsigned_less(w, v), a < b), lambda: (t.is_zero(w), a == 0), lambda: (t.top_bit(w), a >= t.TOP),
        lambda: (registers.equal_words(t.extreme('umin4', w, v), w), min(a, b) == a), lambda: (registers.equal_words(w, v), a == b)])()


def round_of(number):
    """Makes some terms of new leaves, and compares. Returns how many."""
    pools, leaves = {'4': [], '8': [], 'c': [(t.T, True), (t.F, False)]}, {}
    for size in '48':
        for i in range(6):
            value = bits(random.choice(SPECIAL + [random.uniform(-2, 2), random.uniform(-1e4, 1e4)]), size)
            leaf = t.term('in' + size, f'{number}.{i}') if i % 3 else (t.c4 if size == '4' else t.c8)(value)
            leaves[leaf] = value
            pools[size].append((leaf, value))
    for _ in range(60):
        kind, a, value = made(pools)
        if kind != 'c' and math.isnan(real(value, kind)):
            continue
        if value_of(a, leaves, {}) != value:
            raise AssertionError(f'{cases.shown(a, 6)} is {value_of(a, leaves, {})}, not {value}')
        pools[kind].append((a, value))
    for size in '48':  # conditions that imply each other
        pair = random.sample(pools[size], 2)
        for name in COMPARE:
            for (m, p), (n, q) in (pair, pair[::-1]):
                pools['c'].append((t.compared(name + size, m, n), COMPARE[name](real(p, size), real(q, size))))
    given = {}
    for c, holds in random.sample(pools['c'], 6):
        given = cases.assume(given, c, holds)
        assert given is not None, f'conditions that hold cannot be: {cases.shown(c, 6)}'
    for kind in '48c':
        for a, value in pools[kind]:
            b = cases.under(given, a, {})
            assert value_of(b, leaves, {}) == value, f'{cases.shown(a, 6)} became {cases.shown(b, 6)}'
    return sum(map(len, pools.values()))


def main():
    random.seed(1)
    sys.setrecursionlimit(20000)
    print(sum(round_of(number) for number in range(int(sys.argv[1]))), 'terms have their values')


if __name__ == '__main__':
    main()
