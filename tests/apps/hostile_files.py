"""Files that are not what they are given for: forces beside positions, and recordings of other systems."""

import os
import random
import struct
import sys

from hostile_programs import Case, add

COMPARE = ["conform", "judge", "--law", "wall", "--stiffness", "1.5"]
RECORDING = ["conform", "recording", "--law", "wall", "--stiffness", "1.5"]
GIGABYTE = 10**9


def file_case(kind, name, words, file, made, arguments, code=2, slow=False):
    """made: its bytes, or what makes it at a path."""

    def run(mark, folder):
        if callable(made):
            made(os.path.join(folder, file))
        else:
            with open(os.path.join(folder, file), "wb") as out:
                out.write(made)
        return arguments + [file]

    add(f"{kind} {name}", Case(words, run, code=code, slow=slow))


def sparse(path):
    with open(path, "wb") as out:
        out.truncate(GIGABYTE)


def long_line(path):
    with open(path, "wb") as out:
        for _ in range(GIGABYTE // 10**7):
            out.write(b"x" * 10**7)


NO_FILES = {  # words of the verdicts on CSV
    "an empty file": (b"", "header row"),
    "spaces": (b"  \n\n", "expected"),
    "a folder": (os.mkdir, "directory"),
    "a name that leads nowhere": (lambda path: os.symlink("nowhere", path), "No such file"),
    "a name that leads to itself": (lambda path: os.symlink(os.path.basename(path), path), "symbolic links"),
    "no end of zeros": (lambda path: os.symlink("/dev/zero", path), "got"),
    "nothing at all": (lambda path: os.symlink("/dev/null", path), "header row"),
    "a GB of zeros": (sparse, "got"),
    "memory of the process": (lambda path: os.symlink("/proc/self/mem", path), "expected|cannot|error"),
    "a pipe to which nobody writes": (os.mkfifo, "it is a named pipe"),
    "random bytes": (random.Random(1).randbytes(5000), "expected"),
    "a program": (lambda path: os.symlink(os.path.realpath(sys.executable), path), "expected"),
    "a picture": (b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 4, "expected"),
    "compressed": (b"\x1f\x8b\x08\0" + random.Random(2).randbytes(500), "gzip|expected"),
    "UTF-16": ("t_s,x_mm\n{}".encode("utf-16"), "UTF-16|expected"),
    "HTML": (b"<!doctype html>\n<html></html>\n", "expected"),
    "a million quotes": (b'"' * 1_000_000, "expected"),
    "a million brackets": (b"[" * 1_000_000, "expected"),
}  # fmt: skip
NAMED = ("directory", "No such file", "symbolic links", "it is a named pipe")  # what is said of them whatever they hold
for name, (made, csv) in NO_FILES.items():
    file_case("forces", name, csv, "given.csv", made, COMPARE)
    is_read = csv not in NAMED  # by what reads forces, too
    file_case("recording", name, csv, "given.csv", made, RECORDING, slow=is_read)
    file_case("forces", f"{name}, of NumPy", csv if csv in NAMED else "NPY header", "given.npy", made, COMPARE, slow=is_read)
for kind, arguments in (("forces", COMPARE), ("recording", RECORDING)):
    file_case(kind, "a line of 1 GB", "bytes in a row", "given.csv", long_line, arguments, slow=True)

# CSV. Rows that are right: the wall's stiffness is 1.5 N/mm.
HEADS = {"forces": b"x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,reset,aim", "recording": b"t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N"}
ROWS = {"forces": [b"1,2,-2,0,0,3,1,volume", b"1,2,-1,0,0,1.5,0,volume"], "recording": [b"0,1,2,-2,0,0,3", b"0.001,1,2,-1,0,0,1.5"]}


def csv_case(kind, name, words, code=2, head=None, rows=None, end=b"\n", before=b""):
    lines = [HEADS[kind] if head is None else head] + (ROWS[kind] if rows is None else rows)
    file_case(kind, name, words, "given.csv", before + end.join(lines) + end, COMPARE if kind == "forces" else RECORDING, code)


for kind, first in (("forces", 0), ("recording", 1)):
    head, rows = HEADS[kind], ROWS[kind]

    def cell(column, value, kind=kind, rows=rows):
        cells = rows[1].split(b",")
        cells[column] = value
        return [rows[0], b",".join(cells)]

    csv_case(kind, "right", "held", code=0)
    csv_case(kind, "right, with CRLF", "held", code=0, end=b"\r\n")
    csv_case(kind, "right, with a BOM", "held", code=0, before=b"\xef\xbb\xbf")
    csv_case(kind, "right, with columns in another order", "held", code=0, head=b",".join(head.split(b",")[::-1]), rows=[b",".join(row.split(b",")[::-1]) for row in rows])
    csv_case(kind, "right, but for one force", "FAILED: 1 of 2", code=1, rows=cell(first + 5, b"1.6"))
    csv_case(kind, "half of a row", "given.csv:3", rows=[rows[0], rows[1][:7]])
    csv_case(kind, "no rows", "got none|at least", rows=[])
    csv_case(kind, "no header", "header row|columns", head=rows[0])
    csv_case(kind, "a column twice", "are both called", head=head.replace(b"y_mm", b"x_mm"))
    csv_case(kind, "a column twice at the end", "are both called", head=head + b",z_mm", rows=[row + b",7" for row in rows])
    csv_case(kind, "a column less", "fz_N", head=head.replace(b"fz_N", b"fz"))
    csv_case(kind, "a cell more", "given.csv:3", rows=[rows[0], rows[1] + b",7"])
    csv_case(kind, "semicolons", "header row|columns", head=head.replace(b",", b";"))
    csv_case(kind, "a decimal comma", "given.csv:3", rows=cell(first + 2, b"-1,0"))
    csv_case(kind, "a NUL in a cell", "given.csv:3", rows=cell(first + 2, b"-1\0"))
    csv_case(kind, "a quote without its end", "given.csv", rows=cell(first + 2, b'"-1'))
    csv_case(kind, "a text that is not UTF-8", "given.csv:3", rows=cell(first + 2, b"-1\xff"))
    csv_case(kind, "a million columns", "bytes in a row", head=head + b",a" * 1_000_000)
    for value in (b"", b"deep", b"1.5 N", b"1e", b"0x", b"--1", b"1_000", b"\xc2\xb2", b"1" * 100_000 + b"x"):
        csv_case(kind, f"a number {value[:20]!r}", "expected a number|expected a finite number|given.csv:3", rows=cell(first + 2, value))
    csv_case(kind, "a number of 100 000 digits", "FAILED: 1 of 2", code=1, rows=cell(first + 5, b"1" * 100_000))
    for value in (b"nan", b"inf", b"1e999", b"-1e39", b"3e38"):
        csv_case(kind, f"a force {value.decode()}", "FAILED: 1 of 2", code=1, rows=cell(first + 5, value))
csv_case("forces", "a reset of 2", 'expected 0 or 1, got "2"', rows=[b"1,2,-2,0,0,3,2,volume"])
csv_case("forces", "a position that is no number, with a force", "FAILED: 1 of 2", code=1, rows=[b"nan,2,-2,0,0,3,1,volume", b"1,2,-1,0,0,1.5,0,volume"])
csv_case("recording", "a position that is no number", "expected a finite number", rows=[b"0,nan,2,-2,0,0,3", b"0.001,1,2,-1,0,0,1.5"])
csv_case("recording", "a time that is no number", "expected a finite number", rows=[b"nan,1,2,-2,0,0,3", b"0.001,1,2,-1,0,0,1.5"])
csv_case("recording", "times of 1e308", "FAILED|expected", code=1, rows=[b"-1e308,1,2,-2,0,0,3", b"1e308,1,2,-1,0,0,1.5"])
csv_case("recording", "times that go backwards", "FAILED: time increases", code=1, rows=ROWS["recording"][::-1])

# NumPy.
NUMBERS = [1, 2, -2, 0, 0, 3]


def npy(header, data, version=(1, 0)):
    text = header.encode() + b" " * (-(len(header) + 11) % 64) + b"\n"
    return b"\x93NUMPY" + bytes(version) + struct.pack("<H" if version[0] == 1 else "<I", len(text)) + text + data


def npy_case(name, words, header=None, data=None, code=2, whole=None, **options):
    if header is None:
        header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 6), }"
    data = struct.pack("<12f", *NUMBERS, *NUMBERS) if data is None else data
    file_case("forces", name + ", of NumPy", words, "given.npy", npy(header, data, **options) if whole is None else whole, COMPARE, code)


def described(descr, shape="(2, 6)", order="False"):
    return f"{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}, }}"


npy_case("right", "held: 2 of 2", code=0)
npy_case("right, version 2", "held: 2 of 2", code=0, version=(2, 0))
npy_case("not a number", "FAILED: 1 of 2", data=struct.pack("<12f", *NUMBERS, 1, 2, -2, 0, 0, float("nan")), code=1)
npy_case("the other byte order", "expected", described("'>f4'"), struct.pack(">12f", *NUMBERS, *NUMBERS))
npy_case("float64", "expected", described("'<f8'"), struct.pack("<12d", *NUMBERS, *NUMBERS))
npy_case("integers", "expected", described("'<i4'"), struct.pack("<12i", *NUMBERS, *NUMBERS))
npy_case("objects", "expected", described("'|O'"), b"\x80\x04K\x01.")
npy_case("by column", "row by row", described("'<f4'", order="True"))
for shape in ("(12,)", "()", "(6, 2)", "(2, 6, 1)", "(1, 2, 6)", "(2, 3)", "(-2, 6)", "(2.0, 6)", "2, 6", "(2 6)"):
    npy_case("shape " + shape, "expected|shape", described("'<f4'", shape))
for rows in ("3", "1000000000000000000", "18446744073709551615", "99999999999999999999", "768614336404564651"):
    npy_case(f"{rows} rows", "truncated|expected|shape", described("'<f4'", f"({rows}, 6)"))
npy_case("no rows", "got none", described("'<f4'", "(0, 6)"), b"")
npy_case("one row too few", "goes on after its last row", described("'<f4'", "(1, 6)"))
npy_case("cut in a row", "truncated", data=struct.pack("<11f", *range(11)))
npy_case("no header", "expected|header", whole=b"\x93NUMPY\x01\x00")
npy_case("a header that is cut", "truncated", whole=npy(described("'<f4'"), b"")[:40])
npy_case("a header of 4 GB", "expected|header", whole=b"\x93NUMPY\x02\x00\xff\xff\xff\xff{'descr'")
npy_case("version 9", "version", version=(9, 0))
for header in ("", "{}", "{'descr': '<f4'}", "[]", "import os", described("'<f4'")[:-2], described("'<f4'") * 2, "{" * 30000, described("'" + "<f4" * 1000 + "'")):
    npy_case(f"a header {header[:40]!r} of {len(header)} characters", "expected|header", header)
FIELDS = [(name.decode(), "<f4") for name in HEADS["forces"].split(b",")[:6]]
for name, fields, words in (
    ("no field fz_N", FIELDS[:5], "has no field fz_N"), ("fz_N of float64", FIELDS[:5] + [("fz_N", "<f8")], "expected <f4"), ("fz_N twice", FIELDS + [("fz_N", "<f4")], "expected"),
    ("a field of two numbers", FIELDS[:1] + [("more", "<f4", (2,))] + FIELDS[1:], "goes on after its last row|expected"), ("fields within one", [("all", FIELDS)], "expected|has no field"),
    ("reset of float", FIELDS + [("reset", "<f4")], "expected |u1"), ("a huge field", FIELDS + [("aim", "|S999999999")], "expected"),
):  # fmt: skip
    npy_case(name, words, described(fields, "(1,)"), struct.pack("<8f", *NUMBERS, 0, 0))
