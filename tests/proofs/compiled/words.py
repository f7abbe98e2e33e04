# SPDX-License-Identifier: BSD-3-Clause
"""Terms over bits: what a register or a word of memory holds, as an operation of the inputs. Here: conditions, and words of 32 bits.

A term is a number, the index of a tuple (operation, operands...), each made once and in one form. Names of operations end in 4 for
words of 32 bits and in 8 for 64. No rule changes a bit of a result, but for the payload and the sign of a NaN."""
import functools

terms, known = [], {}


def term(*key):
    """The term that is this operation as it stands."""
    number = known.get(key)
    if number is None:
        number = known[key] = len(terms)
        terms.append(key)
    return number


ONES, TOP, SIZE = 0xffffffff, 0x80000000, 0x7fffffff
T, F = term('T'), term('F')


def c4(value):
    return term('c4', value & ONES)


def c8(value):
    return term('c8', value & 0xffffffffffffffff)


ZERO4, ONES4, TOP4 = c4(0), c4(ONES), c4(TOP)
ZERO8 = c8(0)


# Conditions.
def negation(c):
    if c == T or c == F:
        return F if c == T else T
    return terms[c][1] if terms[c][0] == 'not' else term('not', c)


def either(*conditions):
    parts = set()
    for c in conditions:
        if terms[c][0] == 'or':
            parts |= terms[c][1]
        elif c != F:
            parts.add(c)
    if T in parts or any(terms[c][0] == 'not' and terms[c][1] in parts for c in parts):
        return T
    if not parts:
        return F
    return parts.pop() if len(parts) == 1 else term('or', frozenset(parts))


def both(a, b):
    return negation(either(negation(a), negation(b)))


@functools.cache
def unsigned_at_most(a, b):
    """a <= b of unsigned words; a largest or smallest of several says it of each."""
    kind_a, kind_b = terms[a], terms[b]
    if kind_a[0] == 'c4' and kind_b[0] == 'c4':
        return T if kind_a[1] <= kind_b[1] else F
    if kind_b == ('c4', ONES) or kind_a == ('c4', 0):
        return T
    if kind_a[0] == 'c4':
        return negation(unsigned_at_most(b, c4(kind_a[1] - 1)))  # one form
    if kind_a[0] == 'umin4':
        return either(*(unsigned_at_most(part, b) for part in kind_a[1]))
    if kind_a[0] == 'umax4':
        return negation(either(*(negation(unsigned_at_most(part, b)) for part in kind_a[1])))
    if kind_b[0] == 'umin4':
        return negation(either(*(negation(unsigned_at_most(a, part)) for part in kind_b[1])))
    if kind_b[0] == 'umax4':
        return either(*(unsigned_at_most(a, part) for part in kind_b[1]))
    return term('ule4', a, b)


def unsigned_less(a, b):
    if terms[b][0] == 'c4' and terms[a][0] != 'c4':  # one form for constants: at most
        return unsigned_at_most(a, c4(terms[b][1] - 1)) if terms[b][1] else F
    return negation(unsigned_at_most(b, a))


@functools.cache
def has_no_top_bit(a):
    kind = terms[a]
    if kind[0] == 'c4':
        return kind[1] < TOP
    if kind[0] == 'umax4':
        return all(map(has_no_top_bit, kind[1]))
    return kind[0] == 'abs4' or (kind[0] == 'and4' and any(has_no_top_bit(part) for part in kind[1:]))


@functools.cache
def is_zero(a):
    """All bits of a word are 0."""
    kind = terms[a]
    if kind[0] == 'c4':
        return T if kind[1] == 0 else F
    if kind[0] == 'if4':
        return chosen_condition(kind[1], is_zero(kind[2]), is_zero(kind[3]))
    if kind[0] == 'bits':
        return negation(either(*kind[1:]))
    if kind[0] == 'or4':
        return both(is_zero(kind[1]), is_zero(kind[2]))
    return term('zero4', a)


@functools.cache
def top_bit(a):
    kind = terms[a]
    if kind[0] == 'c4':
        return T if kind[1] & TOP else F
    if kind[0] == 'if4':
        return chosen_condition(kind[1], top_bit(kind[2]), top_bit(kind[3]))
    return F if has_no_top_bit(a) else term('top4', a)


def chosen_condition(c, yes, no):
    return either(both(c, yes), both(negation(c), no))


# Words.
def chosen(c, yes, no, size):
    """yes where c holds, else no."""
    if yes == no or c == T:
        return yes
    if c == F:
        return no
    if terms[c][0] == 'not':
        return chosen(terms[c][1], no, yes, size)
    operation = 'if' + size
    if terms[yes][0] == operation and terms[yes][3] == no:  # two conditions, one choice
        return chosen(both(c, terms[yes][1]), terms[yes][2], no, size)
    if terms[no][0] == operation and terms[no][2] == yes:
        return chosen(either(c, terms[no][1]), yes, terms[no][3], size)
    return term(operation, c, yes, no)


def mask(c):
    return chosen(c, ONES4, ZERO4, '4')


BITWISE = {'and4': lambda x, y: x & y, 'or4': lambda x, y: x | y, 'xor4': lambda x, y: x ^ y,
           'add4': lambda x, y: x + y, 'sub4': lambda x, y: x - y}


def word(operation, a, b):
    """and4, or4, xor4, add4 or sub4, of integers."""
    kind_a, kind_b = terms[a], terms[b]
    if kind_a[0] == 'c4' and kind_b[0] == 'c4':
        return c4(BITWISE[operation](kind_a[1], kind_b[1]))
    if operation == 'sub4' and kind_b[0] == 'c4':
        return word('add4', a, c4(-kind_b[1]))
    if operation != 'sub4' and (kind_a[0] == 'c4' or (kind_b[0] != 'c4' and b < a)):
        a, b, kind_a, kind_b = b, a, kind_b, kind_a  # a constant stands last
    if kind_b[0] == 'c4':
        value = kind_b[1]
        if value == 0:
            return ZERO4 if operation == 'and4' else a
        if operation == 'and4' and value == ONES:
            return a
        if operation == 'and4' and value == SIZE:
            return absolute4(a)
        if operation == 'xor4' and value == TOP:
            return negative4(a)
        if operation == 'and4' and kind_a[0] == 'add4' and terms[kind_a[2]][0] == 'c4' and value & (value + 1) == 0:
            a = word('add4', kind_a[1], c4(terms[kind_a[2]][1] & value))  # of a sum's lower bits
    if a == b and operation in ('xor4', 'sub4'):
        return ZERO4
    if a == b and operation in ('and4', 'or4'):
        return a
    if kind_a[0] == 'if4' and kind_b[0] == 'if4' and kind_a[1] == kind_b[1]:
        return chosen(kind_a[1], word(operation, kind_a[2], kind_b[2]), word(operation, kind_a[3], kind_b[3]), '4')
    for this, other, left in ((kind_a, b, True), (kind_b, a, False)):
        if this[0] == 'if4' and terms[this[2]][0] == 'c4' and terms[this[3]][0] == 'c4':
            branch = [word(operation, *((part, other) if left else (other, part))) for part in this[2:]]
            return chosen(this[1], *branch, '4')
    if operation in ('and4', 'or4', 'xor4') and kind_a[0] == 'bits' and kind_b[0] == 'bits' and len(kind_a) == len(kind_b):
        combine = {'and4': both, 'or4': either, 'xor4': lambda p, q: chosen_condition(p, negation(q), q)}[operation]
        return term('bits', *map(combine, kind_a[1:], kind_b[1:]))
    return term(operation, a, b)


def inverted(a):
    return word('xor4', a, ONES4)


def absolute4(a):
    kind = terms[a]
    if kind[0] == 'c4':
        return c4(kind[1] & SIZE)
    if kind[0] == 'neg4':
        return absolute4(kind[1])
    if kind[0] == 'if4':
        return chosen(kind[1], absolute4(kind[2]), absolute4(kind[3]), '4')
    return a if kind[0] == 'abs4' else term('abs4', a)


def negative4(a):
    kind = terms[a]
    if kind[0] == 'c4':
        return c4(kind[1] ^ TOP)
    if kind[0] == 'if4':
        return chosen(kind[1], negative4(kind[2]), negative4(kind[3]), '4')
    return kind[1] if kind[0] == 'neg4' else term('neg4', a)


def extreme(operation, a, b):
    """umax4 or umin4, of unsigned words: a set."""
    parts = set()
    for part in (a, b):
        parts |= terms[part][1] if terms[part][0] == operation else {part}
    parts.discard(ZERO4 if operation == 'umax4' else ONES4)
    constants = [part for part in parts if terms[part][0] == 'c4']
    if len(constants) > 1:
        best = (max if operation == 'umax4' else min)(constants, key=lambda part: terms[part][1])
        parts = parts - set(constants) | {best}
    if not parts:
        return ZERO4 if operation == 'umax4' else ONES4
    return parts.pop() if len(parts) == 1 else term(operation, frozenset(parts))


def byte_of(a, i):
    """A byte of a word, the lowest first, as a word."""
    kind = terms[a]
    if kind[0] == 'c4':
        return c4(kind[1] >> 8 * i & 255)
    if kind[0] == 'bytes4':
        return kind[1 + i]
    if kind[0] == 'if4':
        return chosen(kind[1], byte_of(kind[2], i), byte_of(kind[3], i), '4')
    if kind[0] in ('and4', 'or4', 'xor4'):
        return word(kind[0], byte_of(kind[1], i), byte_of(kind[2], i))
    if kind[0] == 'bits' and all(c == F for c in kind[9:]):
        return ZERO4 if i else a
    return term('byte4', a, i)


def word_of_bytes(parts):
    kinds = [terms[part] for part in parts]
    if all(kind[0] == 'c4' for kind in kinds):
        return c4(sum(kind[1] << 8 * i for i, kind in enumerate(kinds)))
    if all(kind == ('byte4', kinds[0][1], i) for i, kind in enumerate(kinds)):
        return kinds[0][1]
    if parts[1:] == [ZERO4] * 3:
        return parts[0]
    return term('bytes4', *parts)
