# SPDX-License-Identifier: BSD-3-Clause
"""Terms over bits (words.py), with numbers: binary32 in words, binary64 in pairs of them."""
import functools
import math
import struct

from words import *  # noqa: F403: terms are one thing in two files


@functools.cache
def number(a):
    """A constant binary32 or binary64 as Python's number, else None; not NaN."""
    kind = terms[a]
    if kind[0] == 'c8':
        value = struct.unpack('<d', struct.pack('<Q', kind[1]))[0]
    elif kind[0] == 'c4':
        value = struct.unpack('<f', struct.pack('<I', kind[1]))[0]
    else:
        return None
    return None if math.isnan(value) else value


@functools.cache
def constant8(value, sign):
    return c8(struct.unpack('<Q', struct.pack('<d', value))[0])


@functools.cache
def constant4(value, sign):
    return c4(struct.unpack('<I', struct.pack('<f', value))[0])


def real8(value):
    return constant8(value, math.copysign(1, value))


def real4(value):
    return constant4(value, math.copysign(1, value))


def compared(operation, a, b):
    """lt, le, eq or un (not ordered) of two numbers; of binary32 ones where both are such."""
    if operation[-1] == '8':
        narrow_a, narrow_b = as_binary32(a), as_binary32(b)
        if narrow_a is not None and narrow_b is not None:
            return compared(operation[:-1] + '4', narrow_a, narrow_b)
    size, zero = operation[-1], ZERO8 if operation[-1] == '8' else ZERO4
    a, b = (zero if number(part) == 0 else part for part in (a, b))
    x, y = number(a), number(b)
    if x is not None and y is not None:
        return T if {'lt': x < y, 'le': x <= y, 'eq': x == y, 'un': False}[operation[:2]] else F
    is_a, is_b = terms[a][0] == 'neg' + size, terms[b][0] == 'neg' + size
    if (is_a or x is not None) and (is_b or y is not None):  # both change their sign, and the order
        return compared(operation, negative(b, size), negative(a, size))
    if operation[:2] in ('eq', 'un'):
        a, b = sorted((a, b))
    return term(operation, a, b)


def as_binary32(a):
    kind = terms[a]
    if kind[0] == 'wide':
        return kind[1]
    if kind[0] == 'neg8':
        size = as_binary32(kind[1])
        return None if size is None else negative4(size)
    if kind[0] == 'if8':
        yes, no = map(as_binary32, kind[2:])
        return None if yes is None or no is None else chosen(kind[1], yes, no, '4')
    value = number(a)
    if value is None or (value != 0 and not math.isinf(value) and not 2.0**-126 <= abs(value) < 2.0**127):
        return None
    narrow = real4(value)
    return narrow if number(narrow) == value else None


# Two words as one of 64 bits, and back.
def half(a, upper):
    kind = terms[a]
    operation = kind[0]
    if operation == 'join8':
        return kind[2] if upper else kind[1]
    if operation == 'c8':
        return c4(kind[1] >> 32 if upper else kind[1])
    if operation == 'if8':
        return chosen(kind[1], half(kind[2], upper), half(kind[3], upper), '4')
    if operation in ('neg8', 'abs8'):
        part = half(kind[1], upper)
        return part if not upper else negative4(part) if operation == 'neg8' else absolute4(part)
    if operation == 'iadd8' and not upper:
        return word('add4', half(kind[1], False), half(kind[2], False))
    return term('hi4' if upper else 'lo4', a)


def joined(low, high):
    a, b = terms[low], terms[high]
    if a[0] == 'c4' and b[0] == 'c4':
        return c8(a[1] | b[1] << 32)
    if a[0] == 'lo4' and b == ('hi4', a[1]):
        return a[1]
    if b[0] in ('neg4', 'abs4'):
        whole = joined(low, b[1])
        if terms[whole][0] != 'join8':
            return real('neg8' if b[0] == 'neg4' else 'abs8', whole)
    if a[0] == 'if4' and b[0] == 'if4' and a[1] == b[1]:
        return chosen(a[1], joined(a[2], b[2]), joined(a[3], b[3]), '8')
    for this, is_low in ((a, True), (b, False)):  # one half is the same in both
        if this[0] == 'if4':
            yes, no = (joined(part, high) if is_low else joined(low, part) for part in this[2:])
            if terms[yes][0] != 'join8' and terms[no][0] != 'join8':
                return chosen(this[1], yes, no, '8')
    return term('join8', low, high)


# Numbers. Operations of binary64 end in 8, of binary32 in 4.
def negative(a, size):
    return real('neg8', a) if size == '8' else negative4(a)


def without_sign(a, size):
    """a without its outermost minus, and whether it had one."""
    kind, value = terms[a], number(a)
    if kind[0] == 'neg' + size:
        return kind[1], True
    return (negative(a, size), True) if value is not None and math.copysign(1, value) < 0 else (a, False)


def exact(operation, values, size):
    """The rounded result of an operation of constants, where Python has it: binary64 by itself, binary32 by way of it."""
    x, y = (values + [None])[:2]
    if any(math.isinf(value) for value in values):
        return None
    if operation == 'root':
        result = math.sqrt(x) if x >= 0 and not (x == 0 and math.copysign(1, x) < 0) else None
    elif operation == 'over':
        result = x / y if y else None
    else:
        result = {'plus': x + y, 'minus': x - y, 'times': x * y}[operation]
    if result is None or abs(result) >= (2.0**127 if size == '4' else math.inf) or size == '4' and 0 < abs(result) < 2.0**-126:
        return None
    return real8(result) if size == '8' else real4(result)  # twice rounded is once rounded: 53 >= 2·24 + 2


facts = {}  # a term that another one is known to be equal to


def real(name, *operands):
    """plus, minus, times, over, root, fused, neg, abs of numbers, as one term."""
    result = number_term(name, *operands)
    return facts.get(result, result)


def number_term(name, *operands):
    operation, size = name[:-1], name[-1]
    kinds = [terms[a] for a in operands]
    if operation in ('neg', 'abs'):
        (a,), (kind,) = operands, kinds
        if size == '4':
            return negative4(a) if operation == 'neg' else absolute4(a)
        if kind[0] == 'c8':
            return c8(kind[1] ^ 1 << 63) if operation == 'neg' else c8(kind[1] & ~(1 << 63))
        if kind[0] == 'wide' and operation == 'abs':
            return term('wide', absolute4(kind[1]))
        if kind[0] == 'if8':
            return chosen(kind[1], real(name, kind[2]), real(name, kind[3]), '8')
        if kind[0] == 'neg8':
            return kind[1] if operation == 'neg' else real(name, kind[1])
        return a if kind[0] == name else term(name, a)
    values = [number(a) for a in operands]
    if operation != 'fused' and all(value is not None for value in values):
        folded = exact(operation, values, size)
        if folded is not None:
            return folded
    if operation == 'root':
        return term(name, *operands)
    if operation == 'fused':
        (a, is_a), (b, is_b) = without_sign(operands[0], size), without_sign(operands[1], size)
        a, b = sorted((a, b))
        return term(('unfused' if is_a != is_b else 'fused') + size, a, b, operands[2])  # minus the product, or plus
    a, b = operands
    zero, one, two = ((real8, real4)[size == '4'](value) for value in (0.0, 1.0, 2.0))
    if operation in ('times', 'over'):
        (a, is_a), (b, is_b) = without_sign(a, size), without_sign(b, size)
        if operation == 'times' and b < a:
            a, b = b, a
        if b == one or (operation == 'times' and a == one):
            result = a if b == one else b
        elif operation == 'times' and two in (a, b):
            other = b if a == two else a
            result = term('plus' + size, other, other)
        else:
            result = term(name, a, b)
        return negative(result, size) if is_a != is_b else result
    if operation == 'minus':
        if b == zero:
            return a
        b, is_negative = without_sign(b, size)
        return real('plus' + size, a, b) if is_negative else term(name, a, b)
    (plain_a, is_a), (plain_b, is_b) = without_sign(a, size), without_sign(b, size)
    if is_b:
        return real('minus' + size, a, plain_b)
    if is_a:
        return real('minus' + size, b, plain_a)
    return term(name, *sorted((a, b)))


def wide(a):
    kind = terms[a]
    if kind[0] == 'c4' and number(a) is not None:
        return real8(number(a))
    if kind[0] == 'if4':
        return chosen(kind[1], wide(kind[2]), wide(kind[3]), '8')
    return real('neg8', wide(kind[1])) if kind[0] == 'neg4' else term('wide', a)


def narrow(a):
    kind = terms[a]
    if kind[0] == 'wide':
        return kind[1]
    if kind[0] == 'neg8':
        return negative4(narrow(kind[1]))
    value = number(a)
    if value is not None and abs(value) < 2.0**127:
        return real4(value)
    return term('narrow', a)
