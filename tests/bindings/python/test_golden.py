# SPDX-License-Identifier: BSD-3-Clause
"""Every bit of every force that the independent programs of tests/golden/ have."""

import collections
from fractions import Fraction

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


def test_exact_forces_of_laws_have_every_digit():
    rows = [row for row in rows_of("bump_forces.csv") if row["status"] == "contact"][::97]
    fractions = 0
    for row in rows:
        shape = {} if row["law"] == "wall" else {"radius": binary32(row["R_mm"]), "width": binary32(row["w_mm"])}
        law = forceshade.Law(row["law"], stiffness=binary32(row["K_N_per_mm"]), **shape)
        exact = law.reference(*(binary32(row[axis]) for axis in ("x_mm", "y_mm", "z_mm")), digits=40)
        for component, golden in ((exact.x, row["fx_N"]), (exact.z, row["fz_N"])):
            if isinstance(component, Fraction):
                fractions += 1
                assert abs(component - Fraction(golden)) <= abs(component) * Fraction(1, 10**39)
            else:
                assert number(component) == number(golden)
        assert exact.y == 0
    assert len(rows) > 20 and 0 < fractions < 2 * len(rows)


def test_the_geometry_has_every_digit():
    for row in rows_of("bump_geometry.csv"):
        its = forceshade.geometry(radius=binary32(row["R_mm"]), width=binary32(row["w_mm"]), digits=50)
        for key, value in zip(("d_mm", "h_mm", "w_prime_mm", "h_prime_mm", "theta_rad"), its):
            assert number(value) == number(row[key]), (row, key)


def grids():
    """The maps of the golden file that are one grid."""
    maps = collections.defaultdict(list)
    for row in rows_of("height_maps.csv"):
        maps[row["map"]].append(row)
    for name, parts in maps.items():
        if len(parts) == 1 and parts[0]["negated"] == "0" and "bilinear" in parts[0]["shape"]:
            yield name, parts[0]["shape"], parts[0]["numbers"].split()


def test_bilinear_height_maps_give_every_bit_digit_and_status():
    forces = collections.defaultdict(list)
    for row in rows_of("height_forces.csv"):
        forces[row["map"], row["rendering"], row["K_N_per_mm"]].append(row)
    count = 0
    for name, shape, numbers in grids():
        columns, rows, pitch = int(binary32(numbers[0])), int(binary32(numbers[1])), binary32(numbers[2])
        heights = np.array([binary32(text) for text in numbers[3:]], np.float32).reshape(rows, columns)
        edge = "tile" if "tile" in shape else "clamp"
        for (of, rendering, stiffness), its in forces.items():
            if of != name:
                continue
            subject = forceshade.HeightMap(
                heights, pitch=pitch, interpolant="bilinear", edge=edge, render=rendering, stiffness=binary32(stiffness)
            )
            at = np.array([[binary32(row[axis]) for axis in ("x_mm", "y_mm", "z_mm")] for row in its], np.float32)
            golden = [[binary32(row[axis]) for axis in ("fx_binary32", "fy_binary32", "fz_binary32")] for row in its]
            for answers in (subject.answers(at), subject.reference_forces(at)):
                assert same_bits(answers["force"], golden), (name, rendering)
                assert list(answers["status"]) == [STATUSES[row["status"]] for row in its]
            for row, position in list(zip(its, at))[::5]:
                exact = subject.reference(*position, digits=40)
                for component, text in zip(exact[:3], (row["fx_N"], row["fy_N"], row["fz_N"])):
                    if isinstance(component, Fraction):
                        assert abs(component - Fraction(text)) <= abs(component) * Fraction(1, 10**39)
                    else:
                        assert number(component) == number(text)
            count += len(its)
    assert count > 50


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
