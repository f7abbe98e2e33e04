# SPDX-License-Identifier: BSD-3-Clause
"""The compiled module with arrays that are not NumPy's. It needs neither NumPy nor pytest, so that every CPython runs it:
buffers.py FOLDER, which has the package forceshade.
"""

import array
import ctypes
import importlib
import sys
import types

# The package without its Python files, which import NumPy.
package = types.ModuleType("forceshade")
package.__path__ = [f"{sys.argv[1]}/forceshade"]
sys.modules["forceshade"] = package
core = importlib.import_module("forceshade._forceshade")

AT = [3, 0, -0.5, 0, 0, 5, -6, 2, -1, 20000, 0, 0]
bump = core.Subject(core.law_of("bump-2p", 15.24, 25.4, 0.5))
EXPECTED = [component for i in range(0, len(AT), 3) for component in bump.force(*AT[i : i + 3])]
assert EXPECTED[:3] == [1.3490643501281738, 0.0, 2.5137453079223633], EXPECTED


def floats(numbers):
    return array.array("f", numbers)


def rows(numbers):
    """As a memoryview of two axes (n, 3)."""
    return memoryview(numbers).cast("B").cast("f", (len(numbers) // 3, 3))


class State(ctypes.Structure):
    _fields_ = [("place", ctypes.c_uint8 * 4), ("position", ctypes.c_float * 3), ("index", ctypes.c_uint32 * 8)]


class Exporter:
    """An object of Python with a buffer; from CPython 3.12 on."""

    def __init__(self, its):
        self.its = its

    def __buffer__(self, flags):
        return memoryview(self.its)


def refused(kind, words, call, *arguments):
    try:
        call(*arguments)
    except kind as error:
        assert words in str(error), f"expected {words!r}, got {str(error)!r}"
        return
    raise AssertionError(f"expected {kind.__name__}: {words}")


def test_arrays_of_every_kind_are_read_and_written_where_they_lie():
    at, out, status = floats(AT), floats([7] * 12), array.array("B", [9] * 4)
    assert bump._forces(rows(at), rows(out), status) == 1
    assert out.tolist() == EXPECTED and status.tolist() == [1, 1, 1, 2]
    many = floats([float("inf")] * 3 + [1] * (3 << 18))  # in more than one part
    assert bump._forces(rows(many), rows(floats(many))) == 1
    of_ctypes = (ctypes.c_float * 3 * 4)()
    bump._forces(rows(at), of_ctypes)
    assert [component for row in of_ctypes for component in row] == EXPECTED
    read_only = memoryview(at.tobytes()).cast("f", (4, 3))
    assert read_only.readonly
    out = floats([7] * 12)
    core.Session(bump)._steps(read_only, rows(out))
    assert out.tolist() == EXPECTED
    if sys.version_info >= (3, 12):
        out = floats([7] * 12)
        bump._forces(Exporter(read_only), Exporter(rows(out)))
        assert out.tolist() == EXPECTED
    at.append(0)  # nobody holds it any more


def test_one_position_may_lie_apart_or_backwards():
    apart, out = floats([3, 7, 0, 7, -0.5, 7]), floats([7] * 6)
    bump._forces(memoryview(apart)[::2], memoryview(out)[::-2])
    assert out.tolist() == [7, EXPECTED[2], 7, EXPECTED[1], 7, EXPECTED[0]]


def test_many_axes_are_taken():
    out = floats([7] * 12)
    bump._forces(memoryview(floats(AT)).cast("B").cast("f", (2, 2, 3)), memoryview(out).cast("B").cast("f", (2, 2, 3)))
    assert out.tolist() == EXPECTED


def test_other_numbers_and_shapes_are_refused():
    at, out = rows(floats(AT)), rows(floats([7] * 12))
    for wrong in (array.array("d", AT[:3]), array.array("i", [1, 2, 3]), (ctypes.c_float.__ctype_be__ * 3)(), bytes(12)):
        refused(ValueError, "expected numbers of the format f, got", bump._forces, wrong, out)
        refused((ValueError, BufferError), "", bump._forces, at, wrong)
    refused(ValueError, "got >f", bump._forces, (ctypes.c_float.__ctype_be__ * 3)(), out)
    refused(ValueError, "expected positions (..., 3)", bump._forces, ctypes.c_float(1), out)
    refused(ValueError, "expected positions (..., 3)", bump._forces, floats([1, 2]), out)
    refused(ValueError, "expected forces of the shape of the positions", bump._forces, at, floats([0] * 12))
    refused(ValueError, "expected numbers of the format B, got f", bump._forces, at, out, floats([0] * 4))
    refused(ValueError, "expected statuses of the shape", bump._forces, at, out, array.array("B", [0] * 3))
    refused(BufferError, "", bump._forces, at, memoryview(bytes(48)).cast("f", (4, 3)))
    refused(ValueError, "multiples of 4 bytes", bump._forces, memoryview(bytearray(13))[1:].cast("f"), floats([0] * 3))
    refused(TypeError, "", bump._forces, AT, out)


def test_states_are_advanced_where_they_lie():
    corners, faces = floats([-9, -9, 0, 9, -9, 0, 9, 9, 0]), array.array("I", [0, 1, 2])
    mesh = core.Subject(
        core.mesh_of_arrays(rows(corners), memoryview(faces).cast("B").cast("I", (1, 3)), None, None, None, 180, 0.5, [], [])
    )
    states, out = (State * 2)(), floats([7] * 6)
    assert ctypes.sizeof(State) == 48
    for z in (1, -2):
        mesh._advance(states, rows(floats([3, 0, z, 4, 1, 2])), rows(out))
    assert out.tolist() == [0, 0, 1, 0, 0, 0] and [state.place[0] for state in states] == [4, 1]
    refused(ValueError, "states: expected one for each position", mesh._advance, (State * 3)(), rows(floats(AT[:6])), rows(out))
    refused(ValueError, "states: expected one for each position", mesh._advance, bytearray(64), rows(floats(AT[:6])), rows(out))
    # The rows that it gives lie where the mesh has it, and lives as long as it is used.
    vertices, triangles = mesh._vertices, mesh._faces
    del mesh
    assert vertices.readonly and vertices.shape == (3, 3) and vertices.tolist()[1] == [9, -9, 0]
    assert triangles.readonly and triangles.format == "I" and triangles.tolist() == [[0, 1, 2]]


def test_exact_forces_are_written():
    out, status = floats([7] * 12), array.array("B", [9] * 4)
    core.Reference(bump).rounded(rows(floats(AT)), rows(out), status)
    assert out.tolist() == EXPECTED and status.tolist() == [1, 1, 1, 2]


tests = [test for name, test in sorted(globals().items()) if name.startswith("test_")]
for test in tests:
    test()
assert "numpy" not in sys.modules
print(f"{len(tests)} tests of buffers passed in CPython {sys.version.split()[0]}, without NumPy")
