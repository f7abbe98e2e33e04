# SPDX-License-Identifier: BSD-3-Clause
"""Terms where conditions hold, and whether two are equal in every case."""
import registers
import terms as t

SIMPLE = {'not': lambda _, a: t.negation(a), 'or': lambda _, parts: t.either(*parts), 'ule4': lambda _, a, b: t.unsigned_at_most(a, b),
          'zero4': lambda _, a: t.is_zero(a), 'top4': lambda _, a: t.top_bit(a), 'same4': lambda _, a, b: registers.equal_words(a, b),
          'lo4': lambda _, a: t.half(a, False), 'hi4': lambda _, a: t.half(a, True), 'join8': lambda _, a, b: t.joined(a, b),
          'wide': lambda _, a: t.wide(a), 'narrow': lambda _, a: t.narrow(a),
          'unfused8': lambda _, a, b, c: t.real('fused8', t.negative(a, '8'), b, c),
          'unfused4': lambda _, a, b, c: t.real('fused4', t.negative(a, '4'), b, c)}
for name in ('if4', 'if8'):
    SIMPLE[name] = lambda operation, c, a, b: t.chosen(c, a, b, operation[-1])
for name in ('lt4', 'lt8', 'le4', 'le8', 'eq4', 'eq8', 'un4', 'un8'):
    SIMPLE[name] = t.compared
for name in t.BITWISE:
    SIMPLE[name] = t.word
for name in ('plus', 'minus', 'times', 'over', 'root', 'fused', 'neg', 'abs'):
    SIMPLE[name + '4'] = SIMPLE[name + '8'] = t.real


def under(given, a, memo):
    """The term where these conditions hold or do not."""
    if a in given:
        return given[a]
    if a in memo:
        return memo[a]
    key = t.terms[a]
    function = SIMPLE.get(key[0])
    if function is None:
        if key[0] in ('umax4', 'umin4', 'bits', 'iadd8', 'bytes4', 'byte4'):
            if key[0] == 'byte4':
                result = t.byte_of(under(given, key[1], memo), key[2])
            elif key[0] in ('iadd8', 'bits', 'bytes4'):
                result = t.term(key[0], *(under(given, part, memo) for part in key[1:]))
            else:
                parts = [under(given, part, memo) for part in key[1]]
                result = parts[0]
                for part in parts[1:]:
                    result = t.extreme(key[0], result, part)
        else:
            result = a
    elif key[0] == 'or':
        result = function('or', [under(given, part, memo) for part in key[1]])
    else:
        result = function(key[0], *(under(given, part, memo) for part in key[1:]))
    memo[a] = given.get(result, result)
    return memo[a]


IMPLIED = {('lt', True): (('un', 0, False), ('eq', 0, False), ('lt', 1, False), ('le', 0, True), ('le', 1, False)),
           ('le', True): (('un', 0, False), ('lt', 1, False)),
           ('eq', True): (('un', 0, False), ('lt', 0, False), ('lt', 1, False), ('le', 0, True), ('le', 1, True)),
           ('un', True): (('eq', 0, False), ('lt', 0, False), ('lt', 1, False), ('le', 0, False), ('le', 1, False)),
           ('le', False): (('lt', 0, False), ('eq', 0, False))}


def implied(kind, holds):
    """Yields what follows from a comparison for others of the same numbers."""
    name, size = kind[0][:2], kind[0][2:]
    for other, is_swapped, value in IMPLIED.get((name, holds), ()) if size in ('4', '8') else ():
        a, b = kind[2:0:-1] if is_swapped else kind[1:]
        if other in ('eq', 'un'):
            a, b = sorted((a, b))
        known = t.known.get((other + size, a, b))
        if known is not None:
            yield known, value


def assume(given, c, holds):
    """The conditions, with one more and what follows for the others; None if they cannot all be."""
    given = dict(given)
    waiting = [(c, holds)]
    while waiting:
        while waiting:
            c, holds = waiting.pop()
            kind = t.terms[c]
            if kind[0] == 'not':
                waiting.append((kind[1], not holds))
            elif c in (t.T, t.F):
                if (c == t.T) != holds:
                    return None
            elif c not in given:
                given[c] = t.T if holds else t.F
                waiting += [(part, False) for part in kind[1]] if kind[0] == 'or' and not holds else implied(kind, holds)
            elif (given[c] == t.T) != holds:
                return None
        for c, value in list(given.items()):
            others = dict(given)
            del others[c]
            simpler, holds = under(others, c, {}), value == t.T
            if t.terms[simpler][0] == 'not':
                simpler, holds = t.terms[simpler][1], not holds
            if simpler in (t.T, t.F) and (simpler == t.T) != holds:
                return None
            if simpler not in (t.T, t.F) and simpler not in given:
                waiting.append((simpler, holds))
    return given


def undecided(a, seen):
    """A condition of a choice in the term, the innermost first; None if there is none."""
    if a in seen:
        return None
    seen.add(a)
    key = t.terms[a]
    parts = list(key[1]) if key[0] in ('or', 'umax4', 'umin4') else [part for part in key[1:] if isinstance(part, int)] \
        if key[0] in SIMPLE or key[0] in ('bits', 'bytes4') else [key[1]] if key[0] == 'byte4' else []
    for part in parts:
        found = undecided(part, seen)
        if found is not None:
            return found
    if key[0] in ('if4', 'if8'):
        return key[1]
    return a if key[0][:-1] in ('lt', 'le', 'eq', 'un', 'ule', 'same', 'zero', 'top') else None


def differ(pairs, given, depth=0):
    """None if all pairs are equal in every case, else the first that is not, as it is in such a case."""
    for a, b in pairs:
        if a == b:
            continue
        memo = {}
        a, b = under(given, a, memo), under(given, b, memo)
        if a == b:
            continue
        seen = set()
        c = undecided(a, seen)
        c = undecided(b, seen) if c is None else c
        if c is None or depth > 20:
            return a, b
        for holds in (True, False):
            case = assume(given, c, holds)
            different = differ([(a, b)], case, depth + 1) if case is not None else None
            if different is not None:
                return different
    return None


def shown(a, depth=9):
    """A term as text."""
    key = t.terms[a]
    if key[0] in ('c4', 'c8'):
        value = t.number(a)
        return f'{key[1]:#x}' if value is None or value and not 1e-30 < abs(value) < 1e30 else repr(value)
    if key[0] in ('in4', 'in8'):
        return str(key[1])
    if depth == 0:
        return '…'
    parts = sorted(key[1]) if key[0] in ('or', 'umax4', 'umin4') else key[1:]
    texts = [shown(part, depth - 1) if type(part) is int and key[0] in SIMPLE else str(part) for part in parts[:6]]
    return f"{key[0]}({', '.join(texts + ['…'] * (len(parts) > 6))})"
