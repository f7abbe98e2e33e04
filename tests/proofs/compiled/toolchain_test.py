#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""toolchain_test.py COMPILER BUILD COUNTS RECORDED_FORMS RECORDED_V: compiles the objects that check.py looks at with this compiler and the
flags of the build, and requires that they do what is recorded, in blocks of these sizes; and that check.py refuses them where products
and sums were contracted. Exits 77 where there is no such compiler."""
import json
import os
import shlex
import shutil
import subprocess
import sys
import tempfile

CHECK = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'check.py')
FOR_GCC_ALONE = ('-fpch-preprocess', '--param=', '-Wno-maybe-uninitialized')


def compiled(compiler, build, folder, *flags):
    """The objects, with some flags more."""
    with open(os.path.join(build, 'compile_commands.json')) as file:
        entries = json.load(file)
    objects = []
    for name in ('law.cpp', 'batch_avx2.cpp', 'batch_avx512.cpp'):
        entry, = (one for one in entries if one['file'].endswith(('/fast/' + name, '/fast/simd/' + name)))
        words = shlex.split(entry['command'])
        words = words[[word.endswith(('++', 'cc', 'clang')) for word in words].index(True) + 1:]
        words[words.index('-o') + 1] = target = os.path.join(folder, name + '.o')
        if 'clang' in compiler:
            words = [word for word in words if not word.startswith(FOR_GCC_ALONE)]
        subprocess.run([compiler, *words, *flags], cwd=entry['directory'], check=True)
        objects.append(target)
    return objects


def main():
    compiler, build, counts, *recorded = sys.argv[1:]
    if not shutil.which(compiler):
        print(f'skipped: {compiler} is not installed')
        return 77
    with tempfile.TemporaryDirectory() as folder:
        result = subprocess.run(['/usr/bin/python3', CHECK, *recorded, counts, *compiled(compiler, build, folder)]).returncode
        if result:
            return result
        for path in compiled(compiler, build, folder, '-mfma', '-ffp-contract=fast'):
            output = subprocess.run(['/usr/bin/python3', CHECK, *recorded, '16', path], text=True, stdout=subprocess.PIPE).stdout
            refused = [line for line in output.splitlines() if ': cylinder is refused' in line]
            print(f'contracted: {refused[0][:120] if refused else output}')
            if not refused:
                return 1
    return 0


if __name__ == '__main__':
    sys.exit(main())
