# SPDX-License-Identifier: BSD-3-Clause
"""Instructions of vectors and masks: what they do to the state, as processors' manuals have it."""
import terms as t
from machine import Unknown
from registers import equal_words, joined_or_zero, put_general

COMPARISONS = {'eq': ('eq', 0, 0), 'lt': ('lt', 0, 0), 'le': ('le', 0, 0), 'unord': ('un', 0, 0), 'neq': ('eq', 0, 1), 'nlt': ('lt', 0, 1),
               'nle': ('le', 0, 1), 'ord': ('un', 0, 1), 'nge': ('le', 1, 1), 'ngt': ('lt', 1, 1), 'ge': ('le', 1, 0), 'gt': ('lt', 1, 0)}
DEFAULTS = {'eq_oq', 'lt_os', 'le_os', 'unord_q', 'neq_uq', 'nlt_us', 'nle_us', 'ord_q', 'nge_us', 'ngt_us', 'ge_os', 'gt_os',
            'eq_os', 'lt_oq', 'le_oq', 'nlt_uq', 'nle_uq', 'neq_us', 'nge_uq', 'ngt_uq', 'ge_oq', 'gt_oq'}


def require_alignment(state, one, operand, address):
    """Memory of 16 bytes and more: of an aligned move, or of any other instruction without VEX."""
    if operand[1] < 16 or operand[2] or 'movu' in one.name or 'movdqu' in one.name:
        return
    if one.name[0] != 'v' or 'mova' in one.name or 'movdqa' in one.name:
        region, offset = state.place(address, 0)
        if region not in ('stack',) and not isinstance(region, int) or offset % operand[1]:
            raise Unknown('memory that need not be aligned')


# Operands.
def cells(state, one, operand, count):
    """The words of an operand of vectors."""
    if operand[0] == 'v':
        return state.vectors[operand[1]][:count]
    if operand[0] == 'g':
        low, high = (t.half(state.general[operand[1]], upper) for upper in (False, True))
        return ([low, high] if operand[2] == 8 else [low]) + [t.ZERO4] * (count - operand[2] // 4)
    if operand[0] != 'm':
        raise Unknown('an operand of vectors')
    address = state.address(one, operand)
    require_alignment(state, one, operand, address)
    size = min(operand[1], 4 * count)
    words = [state.load(address, 4 * i) for i in range(size // 4)]
    return words * (count * 4 // operand[1]) if operand[2] else words + [t.ZERO4] * (count - len(words))


def put(state, one, operand, words, element=1, scalar=False):
    """Writes a vector; element: words of one element, for masks. scalar: the rest of the register stays."""
    if operand[0] == 'm':
        if operand[6]:
            raise Unknown('a store under a mask')
        address = state.address(one, operand)
        require_alignment(state, one, operand, address)
        for i, word in enumerate(words[:operand[1] // 4]):
            state.store(address, 4 * i, word)
        return
    _, index, _, masked, zeroes = operand
    old = state.vectors[index]
    if masked:
        conditions = state.masks[masked]
        words = [t.chosen(conditions[i // element], word, t.ZERO4 if zeroes else old[i], '4') for i, word in enumerate(words)]
    is_vex = one.name[0] == 'v'
    rest = [t.ZERO4] * (16 - len(words)) if is_vex and not scalar else old[len(words):]
    state.vectors[index] = list(words) + rest


def numbers(words, size):
    return list(words) if size == '4' else [t.joined(words[i], words[i + 1]) for i in range(0, len(words), 2)]


def words_of(values, size):
    return list(values) if size == '4' else [t.half(value, upper) for value in values for upper in (False, True)]


def width(operands):
    """Words of the widest register of vectors."""
    return max([operand[2] for operand in operands if operand[0] == 'v'], default=4)


def sources(state, one, count):
    """The words of the two operands, of three with VEX, the first of which is the destination without."""
    return [cells(state, one, operand, count) for operand in (one.operands[1:3] if one.name[0] == 'v' else one.operands[:2])]


# Numbers.
def chosen_larger(operation, a, b, size):
    """The second, where they are equal or not ordered."""
    first, second = (b, a) if operation == 'max' else (a, b)
    return t.chosen(t.compared('lt' + size, first, second), a, b, size)


def arithmetic(state, one, operation, form):
    size = '8' if form[1] == 'd' else '4'
    count = width(one.operands) if form[0] == 'p' else int(size) // 4
    if operation == 'sqrt':
        a = b = cells(state, one, one.operands[-1], count)
    else:
        a, b = sources(state, one, count)
    values = []
    for x, y in zip(numbers(a, size), numbers(b, size)):
        if operation in ('max', 'min'):
            values.append(chosen_larger(operation, x, y, size))
        elif operation == 'sqrt':
            values.append(t.real('root' + size, x))
        else:
            values.append(t.real({'add': 'plus', 'sub': 'minus', 'mul': 'times', 'div': 'over'}[operation] + size, x, y))
    if form[0] == 's':
        put_scalar(state, one, words_of(values, size), int(size) // 4)
    else:
        put(state, one, one.operands[0], words_of(values, size), int(size) // 4)


def put_scalar(state, one, words, element):
    """The result of a scalar operation, under the first operand's upper words with VEX, the destination's without."""
    if one.name[0] == 'v':
        words = words + state.vectors[one.operands[1][1]][len(words):4]
    put(state, one, one.operands[0], words, element)


def fused(state, one, minus, is_less, order, form):
    size = '8' if form[1] == 'd' else '4'
    count = width(one.operands) if form[0] == 'p' else int(size) // 4
    by_place = [numbers(cells(state, one, operand, count), size) for operand in one.operands[:3]]
    a, b, c = (by_place[int(place) - 1] for place in order)
    values = [t.real('fused' + size, t.negative(x, size) if minus else x, y, t.negative(z, size) if is_less else z)
              for x, y, z in zip(a, b, c)]
    words = words_of(values, size)
    if form[0] == 's':
        words += state.vectors[one.operands[0][1]][len(words):4]
    put(state, one, one.operands[0], words, int(size) // 4)


def compare_numbers(state, one, predicate, form):
    if predicate not in COMPARISONS and predicate not in DEFAULTS:
        raise Unknown(f'the comparison {predicate}')
    operation, is_swapped, is_negated = COMPARISONS[predicate.partition('_')[0]]
    size = '8' if form[1] == 'd' else '4'
    count = width(one.operands) if form[0] == 'p' else int(size) // 4
    a, b = (numbers(words, size) for words in sources(state, one, count))
    if is_swapped:
        a, b = b, a
    found = [t.compared(operation + size, x, y) for x, y in zip(a, b)]
    put_conditions(state, one, [t.negation(c) if is_negated else c for c in found], int(size) // 4, form[0] == 's')


def put_conditions(state, one, conditions, element, scalar=False):
    destination = one.operands[0]
    if destination[0] == 'k':
        if destination[2]:
            conditions = [t.both(c, given) for c, given in zip(conditions, state.masks[destination[2]])]
        state.masks[destination[1]] = conditions + [t.F] * (16 - len(conditions))
        return
    words = [t.mask(c) for c in conditions for _ in range(element)]
    if scalar:
        put_scalar(state, one, words, element)
    else:
        put(state, one, destination, words, element)


def convert(state, one, source, target, form):
    destination, operand = one.operands[0], one.operands[-1]
    element = 2 if target == 'd' else 1
    if form == 's':
        value = numbers(cells(state, one, operand, 2 if source == 'd' else 1), '8' if source == 'd' else '4')[0]
        put_scalar(state, one, words_of([t.wide(value) if target == 'd' else t.narrow(value)], '8' if target == 'd' else '4'), element)
        return
    count = destination[2] // 2 if target == 'd' else (operand[2] if operand[0] == 'v' else operand[1] // 4)
    values = numbers(cells(state, one, operand, count), '8' if source == 'd' else '4')
    words = words_of([t.wide(value) if target == 'd' else t.narrow(value) for value in values], '8' if target == 'd' else '4')
    put(state, one, destination, words + [t.ZERO4] * (4 - len(words)), element)


# Words.
def bitwise(state, one, operation, element):
    count = width(one.operands)
    a, b = sources(state, one, count)
    if operation == 'andn':
        a, operation = list(map(t.inverted, a)), 'and'
    put(state, one, one.operands[0], [t.word(operation + '4', x, y) for x, y in zip(a, b)], element)


THREE = {0xff: lambda x, y, z: t.ONES4, 0x78: lambda x, y, z: t.word('xor4', x, t.word('and4', y, z)),
         0x6a: lambda x, y, z: t.word('xor4', z, t.word('and4', x, y)), 0x6c: lambda x, y, z: t.word('xor4', y, t.word('and4', x, z)),
         0xf8: lambda x, y, z: t.word('or4', x, t.word('and4', y, z)), 0xfe: lambda x, y, z: t.word('or4', x, t.word('or4', y, z))}


def ternary(state, one, element):
    count, truth = width(one.operands), one.operands[3][1]
    if truth not in THREE:
        raise Unknown(f'vpternlog with {truth:#x}')
    put(state, one, one.operands[0], list(map(THREE[truth], *(cells(state, one, operand, count) for operand in one.operands[:3]))), element)


def integers(state, one, operation):
    a, b = sources(state, one, width(one.operands))
    if operation in ('cmpeqd', 'cmpgtd'):
        for x, y in zip(a, b):
            if operation == 'cmpgtd' and not (t.has_no_top_bit(x) and t.has_no_top_bit(y)):
                raise Unknown('a comparison of integers that may be negative')
        found = [equal_words(x, y) if operation == 'cmpeqd' else t.unsigned_less(y, x) for x, y in zip(a, b)]
        return put_conditions(state, one, found, 1)
    if operation == 'maxsd' and not all(map(t.has_no_top_bit, a + b)):
        raise Unknown('the larger of integers that may be negative')
    function = {'addd': lambda x, y: t.word('add4', x, y), 'subd': lambda x, y: t.word('sub4', x, y),
                'maxsd': lambda x, y: t.extreme('umax4', x, y),
                'maxud': lambda x, y: t.extreme('umax4', x, y), 'minud': lambda x, y: t.extreme('umin4', x, y)}[operation]
    put(state, one, one.operands[0], list(map(function, a, b)), 1)


def signs(state, one):
    """vpcmpgtq of 0 and a vector: the upper words' signs."""
    zeros, values = sources(state, one, width(one.operands))
    if set(zeros) != {t.ZERO4}:
        raise Unknown('a comparison of integers of 64 bits')
    put_conditions(state, one, [t.top_bit(word) for word in values[1::2]], 2)


def compare_unsigned(state, one, predicate):
    a, b = sources(state, one, width(one.operands))
    found = {'lt': t.unsigned_less, 'le': t.unsigned_at_most, 'nle': lambda x, y: t.negation(t.unsigned_at_most(x, y)),
             'nlt': lambda x, y: t.negation(t.unsigned_less(x, y))}[predicate]
    put_conditions(state, one, list(map(found, a, b)), 1)


# Moves.
def move(state, one, element):
    operands = one.operands
    if len(operands) == 3:  # movss and movsd of registers
        if one.name[-2:] not in ('ss', 'sd'):
            raise Unknown('a move of three')
        return put_scalar(state, one, cells(state, one, operands[2], element), element)
    destination, source = operands
    name = one.name.lstrip('v')
    if destination[0] == 'g':
        return put_general(state, one, destination, joined_or_zero(cells(state, one, source, destination[2] // 4)))
    if name in ('movss', 'movsd', 'movd', 'movq'):
        words = cells(state, one, source, element)
        if destination[0] == 'v':
            if name in ('movss', 'movsd') and source[0] == 'v':
                return put(state, one, destination, words, element, scalar=True)
            words += [t.ZERO4] * (4 - len(words))
        return put(state, one, destination, words, element)
    count = width(operands)
    put(state, one, destination, cells(state, one, source, count), element)


def broadcast(state, one, element):
    destination, source = one.operands
    words = cells(state, one, source, element)
    put(state, one, destination, words * (destination[2] // element), 2 if element == 2 else 1)


def part(state, one, size):
    destination, source, which = one.operands
    words = cells(state, one, source, 16)
    begin = size * (which[1] % (source[2] // size))
    put(state, one, destination, words[begin:begin + size], 1)


def insert(state, one, size):
    destination, into, source, which = one.operands
    words = cells(state, one, into, destination[2])
    begin = size * (which[1] % (destination[2] // size))
    words[begin:begin + size] = cells(state, one, source, size)
    put(state, one, destination, words, 1)


def shuffle(state, one, name):
    """Shuffles within 128 bits."""
    operands, choice = one.operands, one.operands[-1][1] if one.operands[-1][0] == 'i' else None
    count, result = width(operands), []
    has_two = name in ('shufps', 'shufpd') or name.startswith(('unpck', 'movhlps', 'movlhps', 'punpck'))
    sources_of = operands[1:3] if one.name[0] == 'v' else operands[:2]
    a, b = [cells(state, one, operand, count) for operand in sources_of] if has_two else [cells(state, one, operands[1], count)] * 2
    for begin in range(0, count, 4):
        x, y = a[begin:begin + 4], b[begin:begin + 4]
        if name in ('shufps', 'permilps', 'pshufd'):
            result += [(x, x, y, y)[i][choice >> 2 * i & 3] for i in range(4)]
        elif name in ('shufpd', 'permilpd'):
            low, high = choice >> begin // 2 & 1, choice >> begin // 2 + 1 & 1
            result += x[2 * low:2 * low + 2] + y[2 * high:2 * high + 2]
        else:
            result += {'unpcklps': [x[0], y[0], x[1], y[1]], 'punpckldq': [x[0], y[0], x[1], y[1]],
                       'unpcklpd': [x[0], x[1], y[0], y[1]], 'punpcklqdq': [x[0], x[1], y[0], y[1]], 'movlhps': [x[0], x[1], y[0], y[1]],
                       'unpckhpd': [x[2], x[3], y[2], y[3]], 'unpckhps': [x[2], y[2], x[3], y[3]],
                       'movhlps': [y[2], y[3], x[2], x[3]], 'movddup': [x[0], x[1]] * 2,
                       'movshdup': [x[1], x[1], x[3], x[3]], 'movsldup': [x[0], x[0], x[2], x[2]]}[name]
    put(state, one, operands[0], result, 2 if name.endswith(('pd', 'qdq', 'ddup')) else 1)


def permute(state, one, has_two):
    """vpermps and vpermd by constant places; vpermt2ps takes them from two vectors, of which the first is the destination."""
    destination, places, source = one.operands
    count = destination[2]
    words = (cells(state, one, destination, count) if has_two else []) + cells(state, one, source, count)
    chosen = [t.terms[word] for word in cells(state, one, places, count)]
    if any(kind[0] != 'c4' for kind in chosen):
        raise Unknown('places that are no constants')
    put(state, one, destination, [words[kind[1] % len(words)] for kind in chosen])


def signs_of(state, one, of_each):
    """vmovmskps, and vpmovmskb of masks: bits in a register."""
    words = cells(state, one, one.operands[1], one.operands[1][2])
    conditions = [t.top_bit(word) for word in words]
    if of_each > 1 and list(map(t.mask, conditions)) != words:
        raise Unknown('bytes that are no mask')
    put_general(state, one, one.operands[0], t.joined(t.term('bits', *(c for c in conditions for _ in range(of_each))), t.ZERO4))


def insertps(state, one):
    destination, into, source, choice = (one.operands if one.name[0] == 'v' else [one.operands[0], *one.operands])
    words, value = cells(state, one, into, 4), choice[1]
    words[value >> 4 & 3] = cells(state, one, source, 4)[value >> 6 if source[0] == 'v' else 0]
    put(state, one, destination, [t.ZERO4 if value >> i & 1 else word for i, word in enumerate(words)], 1)


def extract_word(state, one, count):
    destination, source, which = one.operands
    words = cells(state, one, source, 4)[count * which[1]:count * which[1] + count]
    if destination[0] == 'm':
        return put(state, one, destination, words, 1)
    put_general(state, one, destination, joined_or_zero(words))


def blend(state, one, form):
    element = 2 if form == 'pd' else 1
    destination, no, yes, choice = one.operands if one.name[0] == 'v' else (one.operands[0], *one.operands[:2], ('v', 0, 4, 0, False))
    count = width(one.operands)
    first, second = cells(state, one, no, count), cells(state, one, yes, count)
    if choice[0] == 'i':
        return put(state, one, destination, [(b if choice[1] >> i // element & 1 else a) for i, (a, b) in enumerate(zip(first, second))])
    signs = [t.top_bit(word) for word in cells(state, one, choice, count)]
    conditions = [signs[i - i % element + element - 1] for i in range(count)]
    put(state, one, destination, [t.chosen(c, b, a, '4') for c, a, b in zip(conditions, first, second)])


def blend_by_mask(state, one, form):
    element = 2 if form[-1] in 'dq' and form != 'd' else 1
    destination = one.operands[0]
    first, second = (cells(state, one, operand, destination[2]) for operand in one.operands[1:3])
    conditions = [state.masks[destination[3]][i // element] for i in range(destination[2])]
    zero = [t.ZERO4] * destination[2] if destination[4] else first
    put(state, one, ('v', destination[1], destination[2], 0, False), [t.chosen(c, b, a, '4') for c, a, b in zip(conditions, zero, second)])


def move_half(state, one, upper):
    """movlps, movhps, movlpd, movhpd: half of a vector, and memory."""
    destination, source = one.operands[0], one.operands[-1]
    begin = 2 * upper
    if destination[0] == 'm':
        return put(state, one, destination, cells(state, one, source, 4)[begin:begin + 2])
    words = cells(state, one, one.operands[-2], 4)
    words[begin:begin + 2] = cells(state, one, source, 2)
    put(state, one, destination, words)


# Masks.
def masks(state, one, operands):
    """The conditions that an instruction takes of masks: eight with a name that ends in b, else sixteen, which are all that are set."""
    count = 8 if one.name[-1] == 'b' else 16
    return [state.masks[operand[1]][:count] + [t.F] * (16 - count) for operand in operands]


def mask_move(state, one):
    destination, source = one.operands
    if destination[0] == 'k':
        raise Unknown('a mask from elsewhere')
    put_general(state, one, destination, t.joined(t.term('bits', *masks(state, one, [source])[0]), t.ZERO4))


def mask_words(state, one):
    """vpmovm2d."""
    destination, source = one.operands
    put(state, one, destination, list(map(t.mask, state.masks[source[1]][:destination[2]])))


def mask_operation(state, one, operation):
    a, b = masks(state, one, one.operands[1:3])
    function = {'or': t.either, 'and': t.both, 'xor': lambda x, y: t.chosen_condition(x, t.negation(y), y)}[operation]
    state.masks[one.operands[0][1]] = list(map(function, a, b))


def mask_test(state, one):
    a, b = masks(state, one, one.operands)
    state.flags = ('zero', t.negation(t.either(*a, *b)))
