#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""faults_test.py [every_law] RECORDED_FORMS RECORDED_V OBJECT...: check.py must refuse the objects with one instruction changed.

Each fault is written over an instruction that check.py has run, or over a constant that one reads. every_law: in every law that has
such an instruction, else in one."""
import os
import re
import subprocess
import sys
import tempfile

import check
from machine import ObjectFile, Unknown

# A name, the objects by their sets, the instruction with its operands, and what is put there, at most as long.
V = r'[xyz]mm\d+'
FAULTS = [
    ('an addition that is a subtraction', 'law', rf'addsd ({V}),({V})', r'subsd \1,\2'),
    ('an addition that is a subtraction', 'avx2 avx512', rf'vaddpd ({V}),({V}),({V})', r'vsubpd \1,\2,\3'),
    ('a subtraction the other way round', 'law', rf'subsd ({V}),({V})', r'vsubsd \1,\2,\1'),
    ('a subtraction the other way round', 'avx2 avx512', rf'vsubpd ({V}),({V}),({V})', r'vsubpd \1,\3,\2'),
    ('a quotient the other way round', 'law', rf'divsd ({V}),({V})', r'vdivsd \1,\2,\1'),
    ('a quotient the other way round', 'avx2 avx512', rf'vdivps ({V}),({V}),({V})', r'vdivps \1,\3,\2'),
    ('a product in binary32', 'law', rf'mulsd ({V}),({V})', r'mulss \1,\2'),
    ('a product in binary32', 'avx2', rf'vmulpd ({V}),({V}),({V})', r'vmulps \1,\2,\3'),
    ('a difference that is one with a product, rounded once', 'law', rf'subsd (xmm\d+),(xmm(?:8|9|1\d))', r'vfnmadd231sd \1,\2,\2'),
    ('a sum that is one with a product, rounded once', 'avx2', rf'vmulpd ({V}),({V}),(ymm(?:8|9|1\d))', r'vfmadd231pd \1,\2,\3'),
    ('a fused product that is added and not subtracted', 'avx2 avx512', rf'vfmsub(\d+)pd ({V}),({V}),({V})', r'vfmadd\1pd \2,\3,\4'),
    ('a fused product of other operands', 'avx2 avx512', rf'vfmadd132pd ({V}),({V}),(?!\2$)({V})', r'vfmadd213pd \1,\2,\3'),
    ('a fused product of the other sign', 'avx2 avx512', rf'vfnmadd(\d+)pd ({V}),({V}),({V})', r'vfmadd\1pd \2,\3,\4'),
    ('rounding to zero', 'avx512', r'vcvtpd2ps (ymm\d+),(zmm\d+)', r'vcvtpd2ps \1,\2,{rz-sae}'),
    ('rounding upwards', 'avx512', r'vmulpd (zmm\d+),(zmm\d+),(zmm\d+)', r'vmulpd \1,\2,\3,{ru-sae}'),
    ('a root of binary32', 'law', rf'sqrtsd ({V}),({V})', r'sqrtss \1,\2'),
    ('a choice that is dropped', 'avx2', rf'vblendvp[sd] ({V}),({V}),({V}),{V}', r'vmovaps \1,\3'),
    ('a choice the other way round', 'avx2', rf'vblendvp([sd]) ({V}),({V}),({V}),({V})', r'vblendvp\1 \2,\4,\3,\5'),
    ('a mask that is dropped', 'avx512', rf'vmovaps ({V})\{{k\d\}}\{{z\}},({V})', r'vmovaps \1,\2'),
    ('a choice that is dropped', 'avx512', rf'vblendmp([sd]) ({V})\{{(k\d)\}},({V}),({V})', r'vmovaps \2,\5'),
    ('a choice that is dropped', 'law', rf'andnpd ({V}),({V})', r'movapd \1,\2'),
    ('a wrong lane', 'avx2 avx512', rf'vshufps ({V}),({V}),({V}),0x(88|dd)', r'vshufps \1,\2,\3,0x8d'),
    ('a wrong lane', 'avx2', rf'vinsertf128 ({V}),({V}),({V}),0x1', r'vinsertf128 \1,\2,\3,0x0'),
    ('a wrong lane', 'avx2', rf'vextractf128 ({V}),({V}),0x1', r'vextractf128 \1,\2,0x0'),
    ('a wrong lane', 'avx512', rf'vinsertf(32x8|64x4) ({V}),({V}),({V}),0x1', r'vinsertf\1 \2,\3,\4,0x0'),
    ('a wrong lane', 'avx2 avx512', rf'vblendps ({V}),({V}),({V}),0x92', r'vblendps \1,\2,\3,0x93'),
    ('less for at most', 'avx2', rf'vcmple_oqp([sd]) ({V}),({V}),({V})', r'vcmplt_oqp\1 \2,\3,\4'),
    ('less for at most', 'avx512', rf'vcmple_oqp([sd]) (k\d),({V}),({V})', r'vcmplt_oqp\1 \2,\3,\4'),
    ('less for at most', 'law', rf'cmpnle([sd])([sd]) ({V}),({V})', r'cmpnlt\1\2 \3,\4'),
    ('at most for less', 'avx2', rf'vcmplt_oqp([sd]) ({V}),({V}),({V})', r'vcmple_oqp\1 \2,\3,\4'),
    ('the larger, and its operands the other way round', 'avx2 avx512', rf'vmaxpd ({V}),({V}),({V})', r'vmaxpd \1,\3,\2'),
    ('the smaller', 'avx2 avx512', rf'vmaxps ({V}),({V}),({V})', r'vminps \1,\2,\3'),
    ('a watch that keeps the smaller', 'avx2 avx512', rf'vpmaxud ({V}),({V}),({V})', r'vpminud \1,\2,\3'),
    ('a watch that compares the other way round', 'avx2', rf'vpcmpgtd ({V}),({V}),({V})', r'vpcmpgtd \1,\3,\2'),
    ('a hazard that is dropped', 'avx2', rf'vpcmpgtd ({V}),({V}),({V})', r'vpxor \1,\1,\1'),
    ('a watch that compares the other way round', 'avx512', rf'vpcmpnleud (k\d),({V}),({V})', r'vpcmpnleud \1,\3,\2'),
    ('a sum with zero that is dropped', 'law', rf'addss ({V}),({V})', r'nop'),
    ('a jump where two are equal', 'law', r'(setae) (\w+)', r'seta \2'),
    ('a jump that is taken where two are equal', 'law', r'(seta) (\w+)', r'setae \2'),
    ('a window that is larger', 'law', r'cmp (r\w+),(0x1fff\w+)', r'cmp \1,0x1ffffff0'),
    ('a doubt that is dropped', 'law', r'test al,al', r'cmp al,al'),
    ('hazards of eight lanes that are dropped', 'avx512', r'kmovw (\w+),(k\d)', r'kmovb \1,\2'),
    ('another result', 'avx2 avx512', r'sete (\w+)', r'setne \1'),
    ('a sign that is dropped', 'avx2', rf'vxorp([sd]) ({V}),({V}),(?!\3$)({V})', r'vmovap\1 \2,\3'),
    ('a stack that is not put back', 'law', r'add rsp,0x\w+', r'add rsp,8'),
]
CONSTANT = ('a constant with its lowest bit changed', 'law avx2 avx512', rf'v?(?:mulsd|movsd|comiss|broadcastss|movss) {V},.*\[rip', None)


def assembled(text, folder):
    """The bytes of an instruction; none if there is no such one."""
    source, target, flat = (os.path.join(folder, name) for name in ('one.s', 'one.o', 'one.bin'))
    with open(source, 'w') as file:
        file.write('.intel_syntax noprefix\n' + text + '\n')
    if subprocess.run(['as', '-o', target, source], stderr=subprocess.DEVNULL).returncode:
        return None
    subprocess.run(['objcopy', '-O', 'binary', '-j', '.text', target, flat], check=True)
    with open(flat, 'rb') as file:
        return file.read()


def patched(code, one, replacement, folder):
    """The object's bytes with an instruction, or the constant that it reads, changed; none if there is no room."""
    changed = bytearray(code.bytes)
    at = code.heads[one.section][4] + one.address
    if replacement is None:
        _, section, offset = code.referred(one, 0)
        changed[code.heads[section][4] + offset] ^= 1
        return changed
    new = assembled(replacement, folder)
    if new is None or len(new) > one.length or any((one.section, one.address + i) in code.relocations for i in range(one.length)):
        return None
    changed[at:at + one.length] = new + b'\x90' * (one.length - len(new))
    return None if changed == code.bytes else changed


def runs_of(paths, laws, stages):
    """The objects and laws, with the instructions that each law runs."""
    for path in paths:
        code, file = ObjectFile(path), path.split('/')[-1]
        if not code.compiler.startswith(check.KNOWN[0]):
            print(f'skipped: the faults are written for g++ 12, not for {code.compiler}')
            sys.exit(77)
        for law in laws + [check.ROWS] * (file != check.FILES[0]):
            for one in code.instructions.values():
                one.counts = False
            check.ways_of(law, code, file, stages, [32])
            yield file, law, code, [one for one in code.instructions.values() if one.counts]


def planted(run, pattern, replacement, folder):
    """The first place where a fault fits into a law, as text, and the object with it."""
    _, _, code, instructions = run
    for one in instructions:
        match = (re.fullmatch if replacement else re.match)(pattern, re.sub(' +', ' ', one.text))
        text = match.expand(replacement) if match and replacement else replacement
        changed = patched(code, one, text, folder) if match else None
        if changed is not None:
            return f'{one.address:#x}: {one.text} -> {text}', changed
    return None, None


def main():
    every_law = sys.argv[1] == 'every_law'
    program, definitions, *paths = sys.argv[1 + every_law:]
    laws, stages = check.recorded_in(program, definitions)
    runs = list(runs_of([path for path in paths if path.split('/')[-1] in check.FILES], laws, stages))
    refused, wrong = 0, []
    with tempfile.TemporaryDirectory() as folder:
        for name, which, pattern, replacement in ((fault[0], one, *fault[2:]) for fault in FAULTS + [CONSTANT] for one in fault[1].split()):
            found = 0
            for run in (run for run in runs if which in run[0]):
                place, changed = planted(run, pattern, replacement, folder) if every_law or not found else (None, None)
                if place is None:
                    continue
                found += 1
                target = os.path.join(folder, run[0])
                with open(target, 'wb') as output:
                    output.write(changed)
                try:
                    check.ways_of(run[1], ObjectFile(target), run[0], stages, [32])
                    wrong.append(f'ACCEPTED: {name}: {run[0]}, {run[1].name}, {place}')
                except Unknown as unknown:
                    refused += 1
                    print(f'{run[0]}, {run[1].name}: {name} is refused: {str(unknown).splitlines()[0][:90]}')
            wrong += [] if found else [f'NO PLACE: {name} in {which}']
    print(f'{refused} faults are refused', *wrong, sep='\n')
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
