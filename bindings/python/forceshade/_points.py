# SPDX-License-Identifier: BSD-3-Clause
"""The point of a god-object, exactly, from the names of a state (docs/god-object.md, docs/soups.md)."""

from __future__ import annotations

from fractions import Fraction

from ._subjects import Mesh

Vector = list[Fraction]


def _plus(a: Vector, t: Fraction, b: Vector) -> Vector:
    return [x + t * y for x, y in zip(a, b)]


def _minus(a: Vector, b: Vector) -> Vector:
    return _plus(a, Fraction(-1), b)


def _dot(a: Vector, b: Vector) -> Fraction:
    return sum((x * y for x, y in zip(a, b)), Fraction(0))


def _cross(a: Vector, b: Vector) -> Vector:
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


class _Mesh:
    """Vertices, and the planes of triangles as a normal and a point."""

    def __init__(self, mesh: Mesh) -> None:
        self._vertices, self._faces = mesh.vertices, mesh.faces

    def vertex(self, v: int) -> Vector:
        return [Fraction(float(x)) for x in self._vertices[v]]

    def corners(self, f: int) -> list[Vector]:
        return [self.vertex(int(v)) for v in self._faces[f]]

    def plane(self, f: int) -> tuple[Vector, Vector]:
        a, b, c = self.corners(f)
        return _cross(_minus(b, a), _minus(c, a)), a


def _cut(a: Vector, along: Vector, plane: tuple[Vector, Vector]) -> Vector:
    normal, at = plane
    return _plus(a, _dot(normal, _minus(at, a)) / _dot(normal, along), along)


def _meeting(*planes: tuple[Vector, Vector]) -> Vector:
    (n, a), (m, b), (k, c) = planes
    point = [Fraction(0)] * 3
    for normal, at, across in ((n, a, _cross(m, k)), (m, b, _cross(k, n)), (k, c, _cross(n, m))):
        point = _plus(point, _dot(normal, at) / _dot(n, _cross(m, k)), across)
    return point


def point_on(
    mesh: Mesh, meeting: int, index: tuple[int, int], parameter: tuple[int, int], further: tuple[int, int], position: Vector, size: int
) -> Vector:
    """The point of a touching state. size: of the feature that `index` names: 1 for a vertex, 2 for an edge, 3 for a triangle."""
    its = _Mesh(mesh)
    i, j = index
    share = [Fraction(number, 2**24) for number in parameter]
    if meeting == 0:
        a, *others = its.corners(i) if size == 3 else [its.vertex(v) for v in index[:size]]
        point = a
        for other, part in zip(others, share):
            point = _plus(point, part, _minus(other, a))
        return point
    if size == 2:
        a = its.vertex(i)
        along = _minus(its.vertex(j), a)
        if meeting == 2:
            c = its.vertex(further[0])
            other = _minus(its.vertex(further[1]), c)
            return _cut(a, along, (_cross(other, _cross(along, other)), c))
        return _cut(a, along, (along, position) if meeting == 6 else its.plane(further[0]))
    f = its.plane(i)
    if meeting == 5:
        return _cut(position, f[0], f)
    h = its.plane(j)
    if meeting == 4:
        return _meeting(f, h, its.plane(further[0]))
    if meeting == 7:
        return _meeting(f, h, (_cross(f[0], h[0]), position))
    corners = its.corners(i)
    of, b, c = (corners[(further[0] + k) % 3] for k in range(3))
    return _meeting(f, h, (_cross(f[0], _minus(c, b)), _plus(b, share[0], _minus(of, b))))
