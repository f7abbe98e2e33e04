# SPDX-License-Identifier: BSD-3-Clause
"""Recorded definitions (proofs/recorded/Recorded.v, and what recorded_forms prints) as terms."""
import functools
import re

import terms as t

OPERATIONS = {
    'opp': lambda size, a: t.negative(a, size), 'absolute': lambda size, a: t.real('abs' + size, a),
    'square_root': lambda size, a: t.real('root' + size, a), 'fused': lambda size, a, b, c: t.real('fused' + size, a, b, c),
    'larger': lambda size, a, b: t.chosen(t.compared('lt' + size, b, a), a, b, size),
    'greatest': lambda size, a, b: t.chosen(t.compared('lt' + size, a, b), b, a, size),  # std::max
    'is_less': lambda size, a, b: t.compared('lt' + size, a, b), 'is_at_most': lambda size, a, b: t.compared('le' + size, a, b),
    'is_equal': lambda size, a, b: t.compared('eq' + size, a, b), 'andb': lambda _, a, b: t.both(a, b),
    'orb': lambda _, a, b: t.either(a, b), 'negb': lambda _, a: t.negation(a),
    'multiply_add': lambda _, a, b, c: t.real('plus8', t.real('times8', a, b), c),  # not fused
    'multiply_subtract': lambda _, a, b, c: t.real('minus8', c, t.real('times8', a, b)),
    'widened': lambda _, a: t.wide(a), 'rounded': lambda _, a: t.narrow(a), 'choice': lambda size, c, a, b: t.chosen(c, a, b, size),
    'where': lambda size, c, a: t.chosen(c, a, t.ZERO4, size), 'times_sign': lambda _, a, b: t.word('xor4', a, t.word('and4', b, t.TOP4))}


def operation(name, operands):
    """A term of an operation of Coq's language, or of one for binary32, which ends in 32."""
    size, name = ('4', name[:-2]) if name.endswith('32') else ('8', name)
    if name in ('plus', 'minus', 'times', 'over'):
        return t.real(name + size, *operands)
    return OPERATIONS[name](size, *operands)


@functools.cache
def parsed(text):
    """An expression as lists of words and lists."""
    result = [[]]
    for token in re.findall(r'[()]|[^\s()]+', text):
        if token == '(':
            result.append([])
        elif token == ')':
            result[-2].append(result.pop())
        elif token != 'is_fused':
            result[-1].append(token)
    return result[0]


def evaluated(expression, names):
    """The term of an expression."""
    if isinstance(expression, list):
        head, *rest = expression
        if not rest:
            return evaluated(head, names)
        if head == 'two_to':
            return t.real8(2.0**int(rest[0][0]))
        if head == 'if':  # of binary64
            head, rest = 'choice', rest[0::2]
        return operation(head, [evaluated(part, names) for part in rest])
    if expression in names:
        return names[expression]
    if expression.startswith('bits'):
        return (t.c4 if expression[4:6] == '32' else t.c8)(int(expression[7:], 16))
    return {'zero64': t.ZERO8, 'true': t.T, 'false': t.F}[expression]


def first_stages(text):
    """By law: its window, and its first stage as a function of the terms of its constants and x and z."""
    result = {}
    for name, arguments, body in re.findall(r'Definition (\w+) \(is_fused : bool\)\s+\(([\w ]+) : binary64\) : FirstStage :=\n(.*?)\|\}\.',
                                            text, re.S):
        window = int(re.search(rf'Definition {name}_window : Z := (\d+)', text)[1])

        def stage(names, body=body, arguments=arguments.split()):
            names = {argument: names[argument] for argument in arguments}
            for line in re.findall(r'let (\w+) := (.*) in\n', body):
                names[line[0]] = evaluated(parsed(line[1]), names)
            fields = re.search(r'\{\| (.*) ', body)[1]
            return {field: evaluated(parsed(value), names) for field, value in re.findall(r'first_(\w+) := (\w+)', fields)}
        result[name] = (window, stage)
    return result


def form_at(text, names):
    """A form of a batch at one position, and what it watches there: field names and terms."""
    names, fields = dict(names), []
    for line in text.strip().splitlines():
        if match := re.match(r'\s*let (\w+) := (.*) in$', line):
            names[match[1]] = evaluated(parsed(match[2]), names)
        else:
            field, value = line.split(' ', 1)
            fields.append((field, evaluated(parsed(value), names)))
    return fields
