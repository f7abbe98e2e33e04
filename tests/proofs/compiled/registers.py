# SPDX-License-Identifier: BSD-3-Clause
"""Instructions of integers: what they do to the state, and the conditions of jumps."""
import terms as t
from machine import Unknown, added, pointer


def joined_or_zero(words):
    return t.joined(words[0], words[1] if len(words) > 1 else t.ZERO4)


def equal_words(a, b):
    """a == b; of a least one and the least of fewer, that the more are not less, and so of a largest."""
    for operation in ('umin4', 'umax4'):
        parts_a, parts_b = ({part} if t.terms[part][0] != operation else t.terms[part][1] for part in (a, b))
        for more, fewer, extreme in ((parts_a, parts_b, b), (parts_b, parts_a, a)):
            if fewer <= more:
                c = t.T
                for part in more - fewer:
                    c = t.both(c, t.unsigned_at_most(*((extreme, part) if operation == 'umin4' else (part, extreme))))
                return c
    if t.terms[a][0] == 'c4' and t.terms[b][0] == 'c4':
        return t.F
    return t.term('same4', *sorted((a, b)))


def general(state, one, operand):
    if operand[0] == 'i':
        return t.c8(operand[1])
    if operand[0] == 'm':
        address = state.address(one, operand)
        if operand[1] < 4:
            word = state.load(address)
            return t.joined(t.word_of_bytes([t.byte_of(word, i) for i in range(operand[1])] + [t.ZERO4] * (4 - operand[1])), t.ZERO4)
        return joined_or_zero([state.load(address, 4 * i) for i in range(operand[1] // 4)])
    whole = state.general[operand[1]]
    if operand[2] == 8:
        return whole
    low = t.half(whole, False)
    if operand[2] == 1:
        return t.joined(t.byte_of(low, 0), t.ZERO4)
    if operand[2] == 2 and t.terms[low][0] not in ('bits', 'c4'):
        raise Unknown('two bytes of a register')
    return t.joined(low if t.terms[low][0] != 'c4' or operand[2] == 4 else t.c4(t.terms[low][1] & 0xffff), t.ZERO4)


def put_general(state, one, operand, value):
    if operand[0] == 'm':
        address = state.address(one, operand)
        for i in range(max(operand[1] // 4, 1)):
            state.store(address, 4 * i, t.half(value, bool(i)), min(operand[1], 4))
        return
    name, size = operand[1:]
    if size == 8:
        state.general[name] = value
    elif size == 4:
        state.general[name] = t.joined(t.half(value, False), t.ZERO4)
    elif size == 1:
        low, high = (t.half(state.general[name], upper) for upper in (False, True))
        state.general[name] = t.joined(t.word_of_bytes([t.half(value, False)] + [t.byte_of(low, i) for i in (1, 2, 3)]), high)
    else:
        low = t.terms[t.half(state.general[name], False)]
        if low[0] != 'bits' and (low[0] != 'c4' or low[1] > 0xffff):
            raise Unknown('a write of two bytes')
        state.general[name] = t.joined(t.half(value, False), t.ZERO4)


def integer(state, one, name):
    """add, sub, and, or, xor, shl, shr, sar, imul, neg, not, inc, dec, of constants, addresses and bits."""
    operands = one.operands
    destination, size = operands[0], operands[0][2] if operands[0][0] == 'g' else operands[0][1]
    if name == 'imul' and len(operands) == 3:
        a, b = (general(state, one, operand) for operand in operands[1:])
    else:
        a = general(state, one, destination)
        b = general(state, one, operands[1]) if len(operands) > 1 else t.c8(1)
    if name == 'xor' and operands[0] == operands[1]:
        result = t.ZERO8
    elif t.terms[a][0] == 'c8' and t.terms[b][0] == 'c8':
        x, y, bits = t.terms[a][1], t.terms[b][1], 8 * size
        x, signed = x & (1 << bits) - 1, (x & (1 << bits) - 1) - (x >> bits - 1 & 1) * (1 << bits)
        y &= (1 << bits) - 1
        result = {'add': x + y, 'sub': x - y, 'and': x & y, 'or': x | y, 'xor': x ^ y, 'shl': x << (y & 63), 'shr': x >> (y & 63),
                  'sar': signed >> (y & 63), 'imul': x * y, 'neg': -x, 'not': ~x, 'inc': x + 1, 'dec': x - 1}[name]
        result = t.c8(result & (1 << bits) - 1)
    elif size == 8 and name in ('add', 'sub', 'inc', 'dec'):
        result = added(a, b, -1 if name in ('sub', 'dec') else 1) if name != 'dec' else added(a, t.c8(-1))
        if name == 'sub' and t.terms[result][0] == 'iadd8':
            raise Unknown('a difference of registers')
    elif size == 8 and name == 'and' and t.terms[a][0] == 'ptr8' and t.terms[a][1] == (('stack', 1),) and t.terms[b][0] == 'c8' \
            and t.terms[b][1] >> 63:
        result = pointer('stack', t.terms[a][2] & t.terms[b][1] - 2**64)
    elif size == 8 and name == 'or' and t.terms[a][0] == 'ptr8' and t.terms[a][1] == (('stack', 1),) and t.terms[b][0] == 'c8' \
            and not t.terms[a][2] & t.terms[b][1]:
        result = added(a, b)
    elif size == 8 and name == 'shr' and b == t.c8(32):
        result = t.joined(t.half(a, True), t.ZERO4)
    elif name in ('and', 'or', 'xor', 'add', 'sub') and size != 8 and (size != 1 or name in ('and', 'or', 'xor')):
        result = t.joined(t.word(name + '4', t.half(a, False), t.half(b, False)), t.ZERO4)
    else:
        raise Unknown(f'{name} of registers')
    put_general(state, one, destination, result)
    if name != 'not':
        state.flags = {'sub': ('compare', a, b, size), 'imul': None}.get(name, ('result', result, size))


def condition(state, code):
    """The condition of a jump, by the flags."""
    if state.flags is None:
        raise Unknown('flags')
    is_not = code[0] == 'n' and code not in ('np', 'ns') and code[1:] in ('e', 'z', 'a', 'ae', 'b', 'be', 'l', 'le', 'g', 'ge', 'c')
    if is_not:
        return t.negation(condition(state, code[1:]))
    code = {'z': 'e', 'c': 'b'}.get(code, code)
    kind = state.flags[0]
    if kind == 'numbers':
        _, a, b, size = state.flags
        unordered = t.compared('un' + size, a, b)
        found = {'a': lambda: t.compared('lt' + size, b, a), 'ae': lambda: t.compared('le' + size, b, a),
                 'b': lambda: t.negation(t.compared('le' + size, b, a)), 'be': lambda: t.negation(t.compared('lt' + size, b, a)),
                 'e': lambda: t.either(t.compared('eq' + size, a, b), unordered), 'p': lambda: unordered,
                 'np': lambda: t.negation(unordered)}
    elif kind == 'zero':
        found = {'e': lambda: state.flags[1]}
    elif kind == 'result':
        low, size = t.half(state.flags[1], False), state.flags[2]
        zero = t.is_zero(low) if size < 8 else t.both(t.is_zero(low), t.is_zero(t.half(state.flags[1], True)))
        zero = t.F if t.terms[state.flags[1]][0] == 'ptr8' else zero  # no array begins at 0
        found = {'e': lambda: zero, 's': lambda: t.top_bit(t.half(state.flags[1], True) if size == 8 else low)}
    else:
        return compared_registers(code, *state.flags[1:])
    if code not in found:
        raise Unknown(f'the condition {code}')
    return found[code]()


def compared_registers(code, a, b, size):
    """Constants, addresses in one array, words."""
    kind_a, kind_b = t.terms[a], t.terms[b]
    if kind_a[0] == kind_b[0] == 'ptr8' and kind_a[1] == kind_b[1]:
        x, y = signed_x, signed_y = kind_a[2], kind_b[2]
    elif kind_a[0] == kind_b[0] == 'c8':
        bits = 8 * size
        x, y = (kind[1] & (1 << bits) - 1 for kind in (kind_a, kind_b))
        signed_x, signed_y = (value - (value >> bits - 1 << bits) for value in (x, y))
    else:
        low_a, low_b = t.half(a, False), t.half(b, False)
        if size == 8 and not t.half(a, True) == t.half(b, True) == t.ZERO4 or size < 4 and kind_b[0] != 'c8':
            raise Unknown('a comparison of registers')
        found = {'a': lambda: t.unsigned_less(low_b, low_a), 'ae': lambda: t.unsigned_at_most(low_b, low_a),
                 'b': lambda: t.unsigned_less(low_a, low_b), 'be': lambda: t.unsigned_at_most(low_a, low_b),
                 'e': lambda: equal_words(low_a, low_b)}
        if code not in found:
            raise Unknown(f'the condition {code}')
        return found[code]()
    found = {'a': x > y, 'ae': x >= y, 'b': x < y, 'be': x <= y, 'e': x == y, 'l': signed_x < signed_y, 'le': signed_x <= signed_y,
             'g': signed_x > signed_y, 'ge': signed_x >= signed_y, 's': signed_x - signed_y < 0}
    return t.T if found[code] else t.F
