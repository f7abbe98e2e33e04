# SPDX-License-Identifier: BSD-3-Clause
"""The exact side where a library that is loaded into Python has set the x87 to 53 bits, as WSL 1 sets it for every process."""

import ctypes
import platform

import numpy as np
import pytest

import forceshade

LIBM = ctypes.CDLL("libm.so.6")
X87_OF_53_BITS = 0x27F

pytestmark = pytest.mark.skipif(platform.machine() != "x86_64", reason="this processor has no x87")


@pytest.fixture
def x87_of_53_bits():
    before, other = (ctypes.create_string_buffer(64) for _ in range(2))  # a fenv_t, which begins with the control word
    assert LIBM.fegetenv(before) == 0 and LIBM.fegetenv(other) == 0
    other[0:2] = X87_OF_53_BITS.to_bytes(2, "little")
    assert LIBM.fesetenv(other) == 0
    yield
    assert LIBM.fegetenv(other) == 0
    assert int.from_bytes(other[0:2], "little") == X87_OF_53_BITS, "it is the caller's own"
    assert LIBM.fesetenv(before) == 0


LAW = forceshade.Law("bump-cylinder", radius=15.24, width=25.4, stiffness=0.5)


def test_exact_forces_and_their_digits_are_exact(x87_of_53_bits):
    positions = np.random.default_rng(3).uniform((-14, 0, -2), (14, 0.01, 9), (20000, 3)).astype(np.float32)
    assert np.array_equal(LAW.reference_forces(positions)["force"], LAW.forces(positions))
    exact = forceshade.Law("bump-2p", radius=15.24, width=25.4, stiffness=0.5).reference(3, 0, -0.5, digits=20)
    assert (exact.x, exact.z) == ("1.3490643153346555443", "2.5137452088061372488")


def test_certificates_properties_and_renderers_hold(x87_of_53_bits):
    assert forceshade.certify(LAW, points=20000, cases=100).held
    assert all(result.held for result in forceshade.properties(LAW, cases=200))
    declares = {"memory": "none", "answers": "force", "claims": "definition", "length_unit": "mm", "force_unit": "N",
                "frame": ["x", "y", "z"], "domain_mm": 10000, "rate_Hz": None, "loop_energy_mJ": 0}
    assert forceshade.conform(LAW.forces, LAW, declares=declares, points=5000)
