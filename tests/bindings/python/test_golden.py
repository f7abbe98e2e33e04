# SPDX-License-Identifier: BSD-3-Clause
"""Every bit of every force that the independent programs of tests/golden/ have."""

import collections

import numpy as np
import pytest
from conftest import GOLDEN, binary32, number, positions, rows_of, same_bits

import forceshade

STATUSES = {"free": forceshade.Status.FREE, "contact": forceshade.Status.CONTACT, "invalid": forceshade.Status.INVALID}


def test_laws_give_every_bit_and_status():
    laws = collections.defaultdict(list)
    for row in rows_of("bump_forces.csv"):
        laws[row["law"], row["R_mm"], row["w_mm"], row["K_N_per_mm"]].append(row)
    met = collections.Counter()
    for (name, radius, width, stiffness), rows in laws.items():
        shape = {} if name == "wall" else {"radius": binary32(radius), "width": binary32(width)}
        law = forceshade.Law(name, stiffness=binary32(stiffness), **shape)
        at = np.array([[binary32(row[axis]) for axis in ("x_mm", "y_mm", "z_mm")] for row in rows], np.float32)
        golden = np.array([[binary32(row["fx_binary32"]), 0, binary32(row["fz_binary32"])] for row in rows], np.float32)
        answers = law.answers(at)
        assert same_bits(answers["force"], golden), law
        assert list(answers["status"]) == [STATUSES[row["status"]] for row in rows], law
        assert same_bits([law.force(*position) for position in at], golden), law
        met[name] += len(rows)
    assert set(met) == set(forceshade.laws())


def test_the_geometry_has_every_digit():
    for row in rows_of("bump_geometry.csv"):
        its = forceshade.geometry(radius=binary32(row["R_mm"]), width=binary32(row["w_mm"]), digits=50)
        for key, value in zip(("d_mm", "h_mm", "w_prime_mm", "h_prime_mm", "theta_rad"), its):
            assert number(value) == number(row[key]), (row, key)


@pytest.mark.parametrize("name", ["tetrahedron", "cube", "hairpin"])
def test_god_objects_give_every_bit_of_their_paths(name):
    rows, of = rows_of(f"god_object/{name}.csv"), {row["name"]: row for row in rows_of("god_object/meshes.csv")}[name]
    at = np.array([[np.float32(row[axis]) for axis in ("x_mm", "y_mm", "z_mm")] for row in rows], np.float32)
    words = {"free": 0, "touching": 1, "invalid": 2, "unfinished": 3}
    for shading, prefix in (("none", "f"), ("vertex", "s")):
        mesh = forceshade.Mesh(
            GOLDEN / "god_object" / f"{name}.off",
            unit="mm",
            sides=of["sides"],
            shading=shading,
            crease=None if shading == "none" else of["crease_degrees"],
            stiffness="0.3",
        )
        golden = [[np.float32(row[prefix + axis + "_N"]) for axis in "xyz"] for row in rows]
        session = forceshade.Session(mesh)
        answers = session.answers(at)
        assert same_bits(answers["force"], golden)
        assert list(answers["status"]) == [words[row["status"]] for row in rows]
        assert same_bits(mesh.reference_forces(at)["force"], golden)


def test_the_real_time_side_and_the_exact_side_give_the_same_bits(bump):
    at = positions(2000)
    assert np.array_equal(bump.answers(at), bump.reference_forces(at))
