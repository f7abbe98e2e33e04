# SPDX-License-Identifier: BSD-3-Clause
# The C interface from Python alone, by ctypes: python3 force.py. (The package `forceshade` needs no such lines: docs/python.md.)
from ctypes import CDLL, POINTER, Structure, byref, c_char_p, c_float, c_int32, c_size_t, c_uint8, c_uint64


class Law(Structure):
    _fields_ = [("size", c_size_t), ("radius", c_float), ("width", c_float), ("stiffness", c_float)]


class Subject(Structure):
    _fields_ = [("handle", c_uint64)]


library = CDLL("libforceshade.so.0")
library.forceshade_message.restype = c_char_p
library.forceshade_law_new.argtypes = [c_char_p, POINTER(Law), POINTER(Subject)]
library.forceshade_law_new.restype = c_int32
library.forceshade_force.argtypes = [Subject, POINTER(c_float), POINTER(c_float), POINTER(c_uint8)]
library.forceshade_force.restype = c_int32


def checked(result):
    if result != 0:
        raise RuntimeError(library.forceshade_message().decode())


law, bump = Law(radius=15.24, width=25.4, stiffness=0.5), Subject()
law.size = 24  # sizeof(forceshade_law)
checked(library.forceshade_law_new(b"bump-2p", byref(law), byref(bump)))
position, force = (c_float * 3)(3, 0, -0.5), (c_float * 3)()  # mm, N
checked(library.forceshade_force(bump, position, force, None))
print(f"{force[2]:.6g} N")
