#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""check.py RECORDED_FORMS RECORDED_V COUNTS OBJECT...: requires that objects of fast/ do what is recorded of the nine laws.

RECORDED_FORMS prints places and forms (recorded_forms.cpp); RECORDED_V is proofs/recorded/Recorded.v. Of the objects, law.cpp.o holds the
single calls, batch_avx2.cpp.o and batch_avx512.cpp.o the blocks. COUNTS: the sizes of blocks, as in 16,32; all: every size that a batch
has."""
import subprocess
import sys
import types

import cases
import follow
import recorded
import terms as t
from machine import ObjectFile, State, Unknown, pointer

sys.setrecursionlimit(20000)
LARGEST, QUANTUM = t.real4(1e4), t.real4(2.0**-30)
DROPPED = (1 << 29) - 1
STATUS = {'free': 0, 'contact': 1, 'invalid': 2}


class Law:
    """A law as recorded_forms prints it: where it holds each of its numbers, and its form in a batch."""

    def __init__(self, text):
        places, form = text.strip().split('form ')
        self.window, self.form = form.split('\n', 1)
        head, *lines = places.strip().splitlines()
        self.positions = []
        self.name, self.offset = head.split()[0], int(head.split()[1])
        self.names, self.words = {}, {}
        for line in lines:
            fields = line.split()
            if fields[0] == 'place':
                name, size, at = fields[1], int(fields[2]), int(fields[3])
                leaf = t.term('in4' if size == 4 else 'in8', name)
                self.names[name] = t.wide(leaf) if size == 4 else leaf
                for i in range(size // 4):
                    self.words[at + 4 * i] = leaf if size == 4 else t.half(leaf, bool(i))
        if 'anchor' in self.names:  # 8R², exact: R is a binary32; so the code's least v is the recorded one
            R, anchor = self.names['R'], self.names['anchor']
            t.facts[t.real('times8', t.real('times8', t.real8(2.0**-47), R), R)] = t.real('times8', t.real8(2.0**-50), anchor)
        self.symbol = ''.join(part.capitalize() for part in self.name.split('_'))


def laws_of(program):
    output = subprocess.run([program], check=True, text=True, stdout=subprocess.PIPE).stdout
    number, *laws = output.split('law ')
    laws = [Law(text) for text in laws]
    for index, law in enumerate(laws):
        law.number = (int(number.split()[1]), index)
    return laws


def is_tie(value, window):
    """The dropped bits are within the window of one half."""
    if window == 0:
        return t.F
    moved = t.word('and4', t.word('add4', t.half(value, False), t.c4(DROPPED // 2 - window)), t.c4(DROPPED))
    return t.unsigned_at_most(t.c4(DROPPED - 2 * window), moved)


def require_equal(pairs, given):
    different = cases.differ(pairs, given)
    if different is not None:
        raise Unknown(f'is {cases.shown(different[0])}\n  and not {cases.shown(different[1])}')


def single_call(law, code, window, stage):
    """Requires that evaluate of a law is what fast/evaluate.h says of the recorded first stage, up to where a later stage begins."""
    function = function_of(code, f'6Inside8evaluateINS0_5BuiltINS0_{len(law.symbol)}{law.symbol}EEEEE')
    position = [t.term('in4', axis) for axis in 'xyz']
    is_invalid = t.negation(t.T)
    for coordinate in position:
        is_invalid = t.either(is_invalid, t.negation(t.compared('le4', t.absolute4(coordinate), LARGEST)))
    x, z = (t.chosen(t.compared('le4', QUANTUM, t.absolute4(a)), a, t.ZERO4, '4') for a in (position[0], position[2]))
    first = stage({**law.names, 'x': t.wide(x), 'z': t.wide(z)})
    is_later = t.both(t.negation(is_invalid), t.either(first['doubt'], t.both(
        first['contact'], t.either(is_tie(first['x'], window), is_tie(first['z'], window)))))
    is_contact = t.both(t.negation(is_invalid), first['contact'])
    later = t.term('in4', 'a later stage')

    def answer(where_contact, else_):
        return t.chosen(is_later, later, t.chosen(is_contact, where_contact, else_, '4'), '4')
    force = [t.real('plus4', t.narrow(first[axis]), t.ZERO4) for axis in 'xz']
    status = t.chosen(is_invalid, t.c4(STATUS['invalid']), t.c4(STATUS['free']), '4')
    expected = {0: answer(force[0], t.ZERO4), 4: answer(t.ZERO4, t.ZERO4), 8: answer(force[1], t.ZERO4),
                12: answer(t.c4(STATUS['contact']), status), 16: answer(t.ZERO4, t.ZERO4)}

    def inputs(region, offset):
        if region == 'position' and offset in (0, 4, 8):
            return position[offset // 4]
        if region == 'law' and offset - law.offset in law.words:
            return law.words[offset - law.offset]
        if (region, offset) == ('law', law.number[0]):
            return t.term('bytes4', t.c4(law.number[1]), *(t.term('byte4', t.term('left4', region, offset), i) for i in (1, 2, 3)))
        return t.term('left4', region, offset)
    state = started(code, inputs, ('out',), di='out', si='law', dx='position')
    paths = 0
    for end in follow.run(state, function, lambda given: cases.differ([(is_later, t.T)], given) is None):
        paths += 1
        pairs = []
        if end.beyond is not None and end.memory.get(('out', 16)) in (t.c4(1), t.c4(2)):
            continue  # a later stage answered
        for offset, wanted in expected.items():
            found = end.memory.get(('out', offset), t.term('left4', 'out', offset))
            found = t.byte_of(found, 0) if offset == 12 else found  # the status is a byte
            pairs.append((found, wanted))
        require_equal(pairs + [(end.general['ax'], pointer('out', 0))], end.given)
    return paths


def at_position(law, i):
    """The form's fields at a position of a batch; kept."""
    while len(law.positions) <= i:
        names = {axis: t.term('in4', f'{axis}[{len(law.positions)}]') for axis in 'xz'}
        law.positions.append(recorded.form_at(law.form, {**law.names, **names}))
    return law.positions[i]


def hazard(law, name, value, least, is_signed):
    """Returns the condition on which the watch of a batch (fast/simd/pack_*.h) stops at a number."""
    if name == 'domain':
        return t.unsigned_less(LARGEST, value)
    if name == 'tiny':  # the two sets compare in two ways
        less_one = t.word('add4', value, t.c4(-1))
        if is_signed:
            return t.unsigned_at_most(less_one, t.word('add4', least['least_coordinate'], t.c4(-2)))
        return t.unsigned_less(less_one, t.word('add4', least['least_coordinate'], t.c4(-1)))
    if name == 'rounding':
        return is_tie(value, int(law.window))
    if name == 'distance':
        return t.unsigned_at_most(t.absolute4(t.half(value, True)), t.half(least['least_distance'], True))
    return {'doubt': value}[name]


def block(law, code, count, is_signed):
    """Requires that a block's answer of so many positions is the recorded form's at each, and its result that of the watch."""
    function = function_of(code, f'12answer_blockINS0_{len(law.symbol)}{law.symbol}EEE')
    results, hazards = {}, []
    for i in range(count):
        fields = at_position(law, i)
        least = dict(fields[-2:])
        for name, value in fields[:-2]:
            if name.startswith('force_'):
                results[('f' + name[-1], 4 * i)] = value
            else:
                hazards.append(hazard(law, name, value, least, is_signed))

    def inputs(region, offset):
        if region in ('x', 'z'):
            if not 0 <= offset < 4 * count:
                raise Unknown(f'a load behind the end of {region}')
            return t.term('in4', f'{region}[{offset // 4}]')
        return law.words[offset] if region == 'law' and offset in law.words else t.term('left4', region, offset)
    state = started(code, inputs, ('fx', 'fz'), di='law', si=count, dx='x', cx='z', r8='fx', r9='fz')
    return require_results(state, function, results, t.negation(t.either(*hazards)))


def rows(code, count):
    """Requires that rows (x, y, z) are taken apart, with a look at y, and put together as such."""
    def inputs(region, offset):
        if not 0 <= offset < (12 if region == 'rows' else 4) * count:
            raise Unknown(f'a load behind the end of {region}')
        return t.term('in4', f'{region}[{offset // 4}]')
    apart, together, hazards = {}, {}, []
    for i in range(count):
        for column, region in ((0, 'x'), (2, 'z')):
            apart[(region, 4 * i)] = t.term('in4', f'rows[{3 * i + column}]')
            together[('rows', 12 * i + 4 * column)] = t.term('in4', f'f{region}[{i}]')
        together[('rows', 12 * i + 4)] = t.ZERO4
        hazards.append(t.unsigned_less(LARGEST, t.absolute4(t.term('in4', f'rows[{3 * i + 1}]'))))
    state = started(code, inputs, ('x', 'z'), di='rows', si=count, dx='x', cx='z')
    ways = require_results(state, function_of(code, '15take_rows_apartE'), apart, t.negation(t.either(*hazards)))
    state = started(code, inputs, ('rows',), di='fx', si='fz', dx=count, cx='rows')
    return ways + require_results(state, function_of(code, '17put_rows_togetherE'), together, None)


def started(code, inputs, written, **registers):
    """The state where a function begins: its arguments are integers, or where arrays begin."""
    state = State(code, inputs, written)
    for register, value in registers.items():
        state.general[register] = t.c8(value) if isinstance(value, int) else pointer(value, 0)
    return state


def require_results(state, function, results, wanted):
    """Requires of each way that these words are written, no others, and that the result is the condition."""
    paths = 0
    for end in follow.run(state, function, lambda given: False):
        paths += 1
        if any(place[0] in state.written and place not in results for place in end.memory):
            raise Unknown('a store behind the end')
        pairs = [(end.word(*place), value) for place, value in results.items()]
        if wanted is not None:
            pairs.append((t.byte_of(t.half(end.general['ax'], False), 0), t.chosen(wanted, t.c4(1), t.ZERO4, '4')))
        require_equal(pairs, end.given)
    return paths


def function_of(code, part):
    found = [name for name in code.functions if part in name]
    if len(found) != 1:
        raise Unknown(f'{len(found)} functions {part}')
    return found[0]


KNOWN = ('GCC: (Debian 12.', 'Debian clang version 14.')
FILES = ('law.cpp.o', 'batch_avx2.cpp.o', 'batch_avx512.cpp.o')
ROWS = types.SimpleNamespace(name='the order of rows')  # beside the laws in the list of what is followed


def ways_of(law, code, file, stages, counts):
    """The numbers of ways through a law's function, which all do what is recorded."""
    if law is ROWS:
        return [rows(code, count) for count in counts]
    if file == 'law.cpp.o':
        return [single_call(law, code, *stages[law.name])]
    return [block(law, code, count, file == 'batch_avx2.cpp.o') for count in counts]


def recorded_in(program, definitions):
    with open(definitions) as file:
        return laws_of(program), recorded.first_stages(file.read())


def main():
    program, definitions, counts, *paths = sys.argv[1:]
    counts = range(16, 513, 16) if counts == 'all' else [int(count) for count in counts.split(',')]
    paths = [path for path in paths if path.split('/')[-1] in FILES]
    laws, stages = recorded_in(program, definitions)
    refused = 0
    for path in paths:
        code, file = ObjectFile(path), path.split('/')[-1]
        if not code.compiler.startswith(KNOWN):
            print(f'skipped: it is not known what code {code.compiler} makes; known are {", ".join(KNOWN)}')
            return 77
        for law in laws + [ROWS] * (file != FILES[0]):
            try:
                ways = ways_of(law, code, file, stages, counts)
                print(f'{file}, {code.compiler}: {law.name} does what is recorded, {sum(ways)} ways')
            except Unknown as unknown:
                refused += 1
                print(f'{file}, {code.compiler}: {law.name} is refused: {unknown}')
    return 1 if refused or {path.split('/')[-1] for path in paths} != set(FILES) else 0


if __name__ == '__main__':
    sys.exit(main())
