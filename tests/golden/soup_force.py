# SPDX-License-Identifier: BSD-3-Clause
"""The force at a rest of the god-object on any set of triangles, without shading and with the vertex scheme, as docs/soups.md
defines it."""

from fractions import Fraction

from make_god_object_golden import K, cross, dot, plus, rounded, rounded_root, times
from soup_places import UNIT


def mixed(weights, vectors):
    return tuple(sum(w * v[k] for w, v in zip(weights, vectors)) for k in range(3))


def normal_in(soup, i, r):
    """Interpolated at a point of triangle i."""
    return mixed(soup.weights(i, r), soup.corner_normals[i])


def towards(near, side):
    """(triangle, 1 or -1): the lowest triangle that blocks from this side, and whether this is its front."""
    i = min(near.blocking(side))
    return i, 1 if near.is_front(i, side) else -1


def along_crease(soup, r, walls, D):
    (f, s), (h, t) = walls
    n, m = times(s, soup.normals[f]), times(t, soup.normals[h])
    axis = cross(n, m)
    if not any(axis) or dot(axis, D):
        return None
    square = dot(axis, axis)
    alpha, beta = Fraction(dot(axis, cross(D, m)), square), Fraction(dot(axis, cross(n, D)), square)
    if alpha < 0 or beta < 0:
        return None
    q, c = (Fraction(rounded_root(Fraction(dot(v, v), UNIT**4))) for v in (n, m))
    return plus(times(alpha * q * s, normal_in(soup, f, r)), times(beta * c * t, normal_in(soup, h, r)))


def on_line(soup, near, r, cell, D):
    ray = max(near.rays)
    sides = near.cells[cell]
    edges = near.rays[ray]
    own = sorted(near.cones)
    if len(edges) == 1 and len(own) <= 2 and all(near.cones.values()):
        edge = min(edges)
        runs = [[t for t in (soup.triangles[i],) for k in range(3) if (t[k], t[k - 2]) == edge] for i in own]
        if len(own) == 1 or bool(runs[0]) != bool(runs[1]):
            ends = [[soup.corner_normals[i][soup.triangles[i].index(v)] for v in edge] for i in own]
            if ends[0] == ends[-1]:
                t = soup.line_at(r, near)[1]
                is_behind = len(own) == 2 and not near.is_front(near.pieces[sides[0] // 2].triangles[0], sides[0])
                return times(-1 if is_behind else 1, mixed((1 - t, t), ends[0]))
    bounds = near.bounds(ray, sides[0])
    if not all(near.blocking(side) for side in bounds):
        return None
    return along_crease(soup, r, [towards(near, side) for side in bounds], D)


def direction(soup, r, cell, D):
    near = soup.near(r)
    if near.kind == 2:
        f, s = towards(near, near.cells[cell][0])
        return times(s, normal_in(soup, f, r))
    if near.kind == 1:
        return on_line(soup, near, r, cell, D)
    at = [soup.corner_normals[i][k] for i in near.cones for k in range(3) if (*soup.vertices[soup.triangles[i][k]], 1) == r]
    if len(at) == len(near.cones) and len(set(at)) == 1 and len(near.parts) == 1:
        return times(-1 if near.name(cell)[1] else 1, at[0])
    return None


def forces(soup, rest, p):
    """The six components of both forces, rounded to binary32."""
    if rest is None:
        return [0.0] * 6
    r, cell = rest
    D = tuple((Fraction(r[k], r[3]) - p[k]) / UNIT for k in range(3))
    result = [rounded(K * c) for c in D]
    N = direction(soup, r, cell, D) if any(D) else None
    if N is None or dot(N, D) <= 0:
        return result + result
    return result + [rounded_root(K * K * dot(D, D) * c * c / dot(N, N), c < 0) for c in N]
