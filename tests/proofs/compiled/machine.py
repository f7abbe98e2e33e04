# SPDX-License-Identifier: BSD-3-Clause
"""An object file for x86-64: its sections, symbols, relocations and instructions; and the state of a processor that runs it on terms."""
import re
import struct
import subprocess

import terms as t


class Unknown(Exception):
    """Something that cannot be followed."""


class Instruction:
    __slots__ = ('section', 'address', 'length', 'name', 'operands', 'text', 'counts')  # counts: on a way that is not settled


VECTOR = re.compile(r'([xyz])mm(\d+)((?:\{k[1-7]\})?)((?:\{z\})?)$')
MEMORY = re.compile(r'(?:(BYTE|WORD|DWORD|QWORD|XMMWORD|YMMWORD|ZMMWORD) (PTR|BCST) )?\[([^\]]*)\](?:\{1to\d+\})?((?:\{k[1-7]\})?)$')
SIZES = {'BYTE': 1, 'WORD': 2, 'DWORD': 4, 'QWORD': 8, 'XMMWORD': 16, 'YMMWORD': 32, 'ZMMWORD': 64, None: 0}
REGISTERS = {}  # a name: the register and its size in bytes
for old in ('ax', 'bx', 'cx', 'dx', 'si', 'di', 'bp', 'sp'):
    REGISTERS.update({'r' + old: (old, 8), 'e' + old: (old, 4), old: (old, 2), (old[0] if old[1] == 'x' else old) + 'l': (old, 1)})
for new in range(8, 16):
    REGISTERS.update({f'r{new}': (f'r{new}', 8), f'r{new}d': (f'r{new}', 4), f'r{new}w': (f'r{new}', 2), f'r{new}b': (f'r{new}', 1)})


def parsed(text):
    """An operand: ('g', register, size), ('v', index, words, mask, zeroes), ('k', index), ('i', value) or
    ('m', size, broadcasts, registers with factors, displacement, is of rip, mask)."""
    if text in REGISTERS:
        return ('g', *REGISTERS[text])
    if match := VECTOR.match(text):
        return ('v', int(match[2]), {'x': 4, 'y': 8, 'z': 16}[match[1]], int(match[3][2]) if match[3] else 0, bool(match[4]))
    if match := re.match(r'k([0-7])((?:\{k[1-7]\})?)$', text):
        return ('k', int(match[1]), int(match[2][2]) if match[2] else 0)
    if re.match(r'-?0x[0-9a-f]+$|\d+$', text):
        return ('i', int(text, 0))
    if match := MEMORY.match(text):
        registers, displacement, is_rip = [], 0, False
        for sign, part in re.findall(r'([+-]?)([^+-]+)', match[3]):
            name, _, factor = part.partition('*')
            if name == 'rip':
                is_rip = True
            elif name in REGISTERS and REGISTERS[name][1] == 8:
                registers.append((REGISTERS[name][0], int(factor or 1)))
            elif re.match(r'0x[0-9a-f]+$', part):
                displacement += int(part, 0) * (-1 if sign == '-' else 1)
            else:
                raise Unknown(f'operand {text}')
        return ('m', SIZES[match[1]], match[2] == 'BCST', registers, displacement, is_rip, int(match[4][2]) if match[4] else 0)
    raise Unknown(f'operand {text}')


class ObjectFile:
    """A relocatable file for x86-64."""

    def __init__(self, path):
        with open(path, 'rb') as file:
            self.bytes = data = file.read()
        if data[:6] != b'\x7fELF\x02\x01' or struct.unpack_from('<HH', data, 16) != (1, 62):
            raise Unknown(f'{path} is no object file for x86-64')
        table, = struct.unpack_from('<Q', data, 40)
        size, count, name_table = struct.unpack_from('<HHH', data, 58)
        heads = [struct.unpack_from('<IIQQQQIIQQ', data, table + i * size) for i in range(count)]

        def text_at(section, offset):
            start = heads[section][4] + offset
            return data[start:data.index(b'\0', start)].decode()
        self.names = [text_at(name_table, head[0]) for head in heads]
        self.heads = heads
        self.symbols, self.functions, self.relocations = [], {}, {}
        for head in heads:
            if head[1] == 2:  # symbols
                for at in range(head[4], head[4] + head[5], 24):
                    name, info, _, section, value, length = struct.unpack_from('<IBBHQQ', data, at)
                    self.symbols.append((text_at(head[6], name), section, value))
                    if info & 15 == 2 and section:
                        self.functions[self.symbols[-1][0]] = (section, value, length)
        for head in heads:
            if head[1] == 4:  # relocations with addends
                for at in range(head[4], head[4] + head[5], 24):
                    offset, info, addend = struct.unpack_from('<QQq', data, at)
                    self.relocations[(head[7], offset)] = (info & ONES, *self.symbols[info >> 32], addend)
        comment = [head for head, name in zip(heads, self.names) if name == '.comment']
        self.compiler = data[comment[0][4]:comment[0][4] + comment[0][5]].strip(b'\0').split(b'\0')[0].decode() if comment else 'nothing'
        self.instructions = {}
        self.disassemble(path)

    def disassemble(self, path):
        """Has objdump name the instructions; sections that share a name follow each other in the file's order."""
        output = subprocess.run(['objdump', '-d', '-w', '-z', '-M', 'intel', '--no-show-raw-insn', path], check=True, text=True,
                                stdout=subprocess.PIPE).stdout
        code = [i for i, head in enumerate(self.heads) if head[1] == 1 and head[2] & 4 and head[5]]
        section, last = None, None
        for line in output.splitlines():
            if line.startswith('Disassembly of section '):
                section, last = code.pop(0), None
                if self.names[section] != line[23:-1]:
                    raise Unknown(f'the order of sections: {line}')
            address, tab, text = line.partition(':\t')
            if not tab:
                continue
            one = Instruction()
            one.section, one.address, one.text = section, int(address, 16), text.partition('#')[0].rstrip()
            one.length = self.heads[section][5] - one.address
            if last:
                last.length = one.address - last.address
            self.instructions[(section, one.address)] = last = one
            one.name, one.operands, one.counts = None, None, False  # read when it is run

    def read(self, one):
        name, _, rest = re.sub(r'^(?:(?:data16|cs|ds|notrack|bnd|rex\S*) )+', '', one.text).partition(' ')
        if name[0] == 'j' or name == 'call':
            target = re.match(r'\s*([0-9a-f]+) <', rest)
            one.operands = [('i', int(target[1], 16))] if target else [('t',)]
        else:
            parts = re.split(r',(?![^\[]*\])', rest.strip()) if rest.strip() else []
            one.operands = [] if name.startswith(('nop', 'prefetch')) else [parsed(part.strip()) for part in parts]
        one.name = name

    def referred(self, one, displacement):
        """Returns where an operand or a jump of this instruction goes by its relocation: the symbol, the section and the offset."""
        for at in range(one.address, one.address + one.length):
            found = self.relocations.get((one.section, at))
            if found:
                kind, name, section, value, addend = found
                if kind not in (2, 4):  # relative to the instruction, or by way of a table of procedures
                    raise Unknown(f'relocation {kind}')
                return name, section, value + addend + (one.address + one.length - at) + displacement
        return None

    def word(self, section, offset):
        head = self.heads[section]
        if head[1] != 1 or head[2] & 5 or not 0 <= offset <= head[5] - 4:  # neither written nor run
            raise Unknown(f'a constant in section {self.names[section]}')
        if any((section, offset - i) in self.relocations for i in range(8)):
            raise Unknown('a constant that is an address')
        return struct.unpack_from('<I', self.bytes, head[4] + offset)[0]


ONES = 0xffffffff


def pointer(region, offset):
    return t.term('ptr8', ((region, 1),), offset)


def added(a, b, factor=1):
    """a + factor·b of registers: integers, and addresses as sums of where the arrays begin."""
    kinds = [t.terms[a], t.terms[b]]
    for this, kind in enumerate(kinds):
        if kind[0] == 'if8':
            parts = [added(part, b, factor) if this == 0 else added(a, part, factor) for part in kind[2:]]
            return t.chosen(kind[1], *parts, '8')
    sums, offset = {}, 0
    for kind, times in zip(kinds, (1, factor)):
        if kind[0] == 'c8':
            offset += times * kind[1]
        elif kind[0] == 'ptr8':
            offset += times * kind[2]
            for region, count in kind[1]:
                sums[region] = sums.get(region, 0) + times * count
        elif factor == 1 and 'c8' in (kinds[0][0], kinds[1][0]):
            a, b = (a, b) if kinds[1][0] == 'c8' else (b, a)
            return t.term('iadd8', a, b) if b != t.ZERO8 else a
        else:
            raise Unknown('a sum of registers')
    left = tuple(sorted(((region, count) for region, count in sums.items() if count), key=str))
    if not left:
        return t.c8(offset)
    return t.term('ptr8', left, (offset + 2**63) % 2**64 - 2**63)


ENTRY = 2**20 + 8  # of the stack where a function begins: 8 bytes off a multiple of 16, and no more than that
KEPT = ('bx', 'bp', 'r12', 'r13', 'r14', 'r15')


class State:
    """Registers and memory. A register of vectors is sixteen words, a register of masks sixteen conditions."""

    def __init__(self, code, inputs, written):
        self.code, self.inputs, self.written = code, inputs, written
        self.general = {name: t.term('left8', name) for name, _ in REGISTERS.values()}
        self.general['sp'] = pointer('stack', ENTRY)
        self.vectors = [[t.term('left4', i, j) for j in range(16)] for i in range(32)]
        self.masks = [[t.term('left1', i, j) for j in range(16)] for i in range(8)]
        self.flags, self.memory, self.given = None, {}, {}
        self.at, self.calls = None, []
        self.beyond = None  # the number of instructions since the way was settled, as run() has it

    def require_return(self, one):
        """The stack and the registers that a caller keeps there are as they were."""
        if one.operands:
            raise Unknown('a return that moves the stack')
        kept = all(self.general[name] == t.term('left8', name) for name in KEPT)
        if not kept or self.general['sp'] != pointer('stack', ENTRY) or ('stack', ENTRY) in self.memory:
            raise Unknown('a register of the caller is lost')

    def copy(self):
        other = State.__new__(State)
        other.code, other.inputs, other.written, other.flags, other.at = self.code, self.inputs, self.written, self.flags, self.at
        other.general, other.memory, other.given = dict(self.general), dict(self.memory), dict(self.given)
        other.vectors, other.masks = [list(one) for one in self.vectors], [list(one) for one in self.masks]
        other.calls, other.beyond = list(self.calls), self.beyond
        return other

    def address(self, one, operand):
        """The address that a memory operand names."""
        _, _, _, registers, displacement, is_rip, _ = operand
        if is_rip:
            found = self.code.referred(one, displacement)
            if found is None or not found[1]:
                raise Unknown(f'memory of another file: {found and found[0]}')
            return pointer(*found[1:])
        total = t.c8(displacement)
        for name, factor in registers:
            total = added(total, self.general[name], factor)
        return total

    def place(self, address, offset):
        kind = t.terms[address]
        if kind[0] != 'ptr8' or len(kind[1]) != 1 or kind[1][0][1] != 1:
            raise Unknown('an address in no array')
        return kind[1][0][0], kind[2] + offset

    def load(self, address, offset=0):
        """A word of memory, by an address that may depend on a condition."""
        kind = t.terms[address]
        if kind[0] == 'if8':
            return t.chosen(kind[1], self.load(kind[2], offset), self.load(kind[3], offset), '4')
        region, offset = self.place(address, offset)
        shift = offset % 4
        if isinstance(region, int):
            return t.c4(self.code.word(region, offset))
        if shift:
            first, second = self.word(region, offset - shift), self.word(region, offset - shift + 4)
            parts = [t.byte_of(first, i) for i in range(4)] + [t.byte_of(second, i) for i in range(4)]
            return t.word_of_bytes(parts[shift:shift + 4])
        return self.word(region, offset)

    def word(self, region, offset):
        found = self.memory.get((region, offset))
        return self.inputs(region, offset) if found is None else found

    def store(self, address, offset, value, size=4):
        """Writes a word or its lowest bytes."""
        region, offset = self.place(address, offset)
        if region != 'stack' and region not in self.written:
            raise Unknown(f'a store to {region}')
        if size == 4 and offset % 4 == 0:
            self.memory[(region, offset)] = value
            return
        for i in range(size):
            at, byte = (offset + i) // 4 * 4, (offset + i) % 4
            parts = [t.byte_of(self.word(region, at), j) for j in range(4)]
            parts[byte] = t.byte_of(value, i)
            self.memory[(region, at)] = t.word_of_bytes(parts)
