# SPDX-License-Identifier: BSD-3-Clause
"""Runs a function of an object file on terms, every way through it. An instruction that is not here is Unknown."""
import re

import registers as r
import terms as t
import vectors as v
from cases import assume, under
from machine import Unknown, added, pointer

# A mnemonic, the words in it, and what is done. The first that fits is taken.
TABLE = [(re.compile(pattern + '$'), function) for pattern, function in (
    (r'v?(add|sub|mul|div|max|min|sqrt)([ps][sd])', v.arithmetic),
    (r'vf(n?)m(?:add|(sub))(132|213|231)([ps][sd])', v.fused),
    (r'v?cmp([a-z]+(?:_[a-z]+)?)([ps][sd])', v.compare_numbers),
    (r'v?cvts([sd])2s([sd])()', lambda state, one, a, b, _: v.convert(state, one, a, b, 's')),
    (r'v?cvtp([sd])2p([sd])', lambda state, one, a, b: v.convert(state, one, a, b, 'p')),
    (r'v?(and|andn|or|xor)p([sd])', lambda state, one, name, form: v.bitwise(state, one, name, 2 if form == 'd' else 1)),
    (r'v?p(and|andn|or|xor)([dq]?)', lambda state, one, name, form: v.bitwise(state, one, name, 2 if form == 'q' else 1)),
    (r'vpternlog([dq])', lambda state, one, form: v.ternary(state, one, 2 if form == 'q' else 1)),
    (r'vp(addd|subd|maxud|maxsd|minud|cmpeqd|cmpgtd)', v.integers),
    (r'vpcmpgtq', v.signs),
    (r'vpcmp(n?l[te])ud', v.compare_unsigned),
    (r'v?mov(?:[au]p|s)d', lambda state, one: v.move(state, one, 2)),
    (r'v?mov(?:[au]p|s)s|v?mov(?:dq[au](?:32)?|d)', lambda state, one: v.move(state, one, 1)),
    (r'v?mov(?:q|dq[au]64)', lambda state, one: v.move(state, one, 2)),
    (r'vp?broadcast(?:s|d|ss)', lambda state, one: v.broadcast(state, one, 1)),
    (r'vp?broadcast(?:q|sd)', lambda state, one: v.broadcast(state, one, 2)),
    (r'vbroadcast[fi](?:128|32x4|64x2)', lambda state, one: v.broadcast(state, one, 4)),
    (r'vextract[fi](?:128|32x4|64x2)', lambda state, one: v.part(state, one, 4)),
    (r'vextract[fi](?:32x8|64x4)', lambda state, one: v.part(state, one, 8)),
    (r'vinsert[fi](?:128|32x4|64x2)', lambda state, one: v.insert(state, one, 4)),
    (r'vinsert[fi](?:32x8|64x4)', lambda state, one: v.insert(state, one, 8)),
    (r'v?(shufp[sd]|permilp[sd]|pshufd|unpck[lh]p[sd]|punpckldq|punpcklqdq|mov(?:lhps|hlps|ddup|shdup|sldup))', v.shuffle),
    (r'v?mov([lh])p[sd]', lambda state, one, which: v.move_half(state, one, which == 'h')),
    (r'vperm(t2)?(?:ps|d)', v.permute),
    (r'vmovmskps', lambda state, one: v.signs_of(state, one, 1)),
    (r'vpmovmskb', lambda state, one: v.signs_of(state, one, 4)),
    (r'vpmovm2d', v.mask_words),
    (r'v?insertps', v.insertps),
    (r'v?pextr([dq])', lambda state, one, form: v.extract_word(state, one, 2 if form == 'q' else 1)),
    (r'v?p?blendv?(p[sd]|d)', v.blend),
    (r'v(?:p?blendm)(p[sd]|d|q)', v.blend_by_mask),
    (r'kmov[bwdq]', v.mask_move),
    (r'k(or|and|xor)[bw]', v.mask_operation),
    (r'kortest[bw]', v.mask_test))]


def vector_test(state, one):
    """Sets the flags by the common bits of two vectors."""
    a, b = (v.cells(state, one, operand, v.width(one.operands)) for operand in one.operands)
    state.flags = ('zero', t.negation(t.either(*(t.negation(t.is_zero(t.word('and4', x, y))) for x, y in zip(a, b)))))


def step(state, one):
    """Runs an instruction that is no jump."""
    name, operands = one.name, one.operands
    if name.startswith(('nop', 'prefetch', 'endbr')) or (name == 'xchg' and operands[0] == operands[1]):
        return
    if name in ('mov', 'movabs'):
        value = r.general(state, one, operands[1])
        return r.put_general(state, one, operands[0], value)
    if name == 'movzx':
        return r.put_general(state, one, operands[0], r.general(state, one, operands[1]))
    if name == 'lea':
        return r.put_general(state, one, operands[0], lea(state, one, operands[1]))
    if name in ('add', 'sub', 'and', 'or', 'xor', 'shl', 'shr', 'sar', 'imul', 'neg', 'not', 'inc', 'dec'):
        return r.integer(state, one, name)
    if name in ('cmp', 'test'):
        a, b = (r.general(state, one, operand) for operand in operands)
        size = max(operand[2 if operand[0] == 'g' else 1] for operand in operands if operand[0] != 'i')
        if name == 'cmp':
            state.flags = ('compare', a, b, size)
        elif a == b and t.terms[a][0] == 'ptr8':
            state.flags = ('zero', t.F)  # no array begins at 0
        elif size < 8 or a == b:
            low = t.word('and4', t.half(a, False), t.half(b, False))
            state.flags = ('result', t.joined(low, t.half(a, True)), size)
        else:
            raise Unknown('a test of two registers')
        return
    if match := re.match(r'v?u?comis([sd])$', name):
        size = '8' if match[1] == 'd' else '4'
        a, b = (v.numbers(v.cells(state, one, operand, int(size) // 4), size)[0] for operand in operands)
        state.flags = ('numbers', a, b, size)
        return
    if name in ('vptest', 'ptest'):
        return vector_test(state, one)
    if name == 'vzeroupper':
        state.vectors = [words[:4] + [t.ZERO4] * 12 for words in state.vectors]
        return
    if match := re.match(r'set(\w+)$', name):
        return r.put_general(state, one, operands[0], t.joined(t.chosen(r.condition(state, match[1]), t.c4(1), t.ZERO4, '4'), t.ZERO4))
    if match := re.match(r'cmov(\w+)$', name):
        values = (r.general(state, one, operand) for operand in reversed(operands))
        return r.put_general(state, one, operands[0], t.chosen(r.condition(state, match[1]), *values, '8'))
    if name in ('push', 'pop'):
        move = t.c8(-8 if name == 'push' else 8)
        value = r.general(state, one, operands[0]) if name == 'push' else None
        if name == 'push':
            state.general['sp'] = added(state.general['sp'], move)
        if name == 'push':
            for upper in (False, True):
                state.store(state.general['sp'], 4 * upper, t.half(value, upper))
            return
        r.put_general(state, one, operands[0], t.joined(*(state.load(state.general['sp'], 4 * upper) for upper in (False, True))))
        state.general['sp'] = added(state.general['sp'], move)
        return
    if name == 'leave':
        state.general['sp'] = state.general['bp']
        one_pop = type(one)()
        one_pop.name, one_pop.operands = 'pop', [('g', 'bp', 8)]
        return step(state, one_pop)
    for pattern, function in TABLE:
        if match := pattern.match(name):
            return function(state, one, *match.groups())
    raise Unknown(f'the instruction {name}')


def lea(state, one, operand):
    return state.address(one, operand)


BEYOND = 300  # instructions that are followed where a way is settled


def run(state, function, is_settled):
    """Runs a function from its beginning: yields the state at the end of every way. Where it is settled that the way leads to code that is
    none of the caller's matter, it is followed to the first call, or to what cannot be followed, or for some instructions."""
    code = state.code
    state.at = code.functions[function][:2]
    waiting, steps = [state], 0
    while waiting:
        state = waiting.pop()
        while state is not None:
            steps += 1
            one = code.instructions.get(state.at)
            if one is None or steps > 400000:
                raise Unknown('a way that leaves the code' if one is None else 'too many steps')
            if state.beyond is None:
                one.counts = True
            else:
                state.beyond += 1
            try:
                if one.name is None:
                    code.read(one)
                if state.beyond is not None and (state.beyond > BEYOND or one.name == 'call'):
                    break
                if one.name == 'ret' and not state.calls:
                    state.require_return(one)
                    yield state
                    break
                following = advance(state, one, is_settled)
            except (Unknown, KeyError, IndexError) as unknown:  # the latter where a table above has no such entry
                if state.beyond is not None and not one.name == 'ret':
                    break
                raise Unknown(f'{unknown}, at {one.address:#x}: {one.text}') from None
            state = following.pop() if following else None
            waiting += following


def advance(state, one, is_settled):
    """The states after an instruction: one, or two where its condition is open, less those that cannot be."""
    next_at = (one.section, one.address + one.length)
    if one.name == 'ret':
        if one.operands:
            raise Unknown('a return that moves the stack')
        state.at = state.calls.pop()
        state.general['sp'] = added(state.general['sp'], t.c8(8))
    elif one.name in ('jmp', 'call'):
        state.at = jump_target(state.code, one)
        if one.name == 'call':
            state.calls.append(next_at)
            state.general['sp'] = added(state.general['sp'], t.c8(-8))
    elif one.name[0] == 'j':
        target, c = jump_target(state.code, one), under(state.given, r.condition(state, one.name[1:]), {})
        if c not in (t.T, t.F):
            result = []
            for holds in (False, True):
                other = state.copy()
                other.given, other.at = assume(state.given, c, holds), target if holds else next_at
                if other.given is not None:
                    other.beyond = 0 if other.beyond is None and is_settled(other.given) else other.beyond
                    result.append(other)
            return result
        state.at = target if c == t.T else next_at
    else:
        step(state, one)
        state.at = next_at
    return [state]


def jump_target(code, one):
    found = code.referred(one, 0)
    if found:
        name, section, offset = found
        if not section:
            raise Unknown(f'a call of {name}')
        return section, offset
    if one.operands[0][0] != 'i':
        raise Unknown('a jump by a register')
    return one.section, one.operands[0][1]
