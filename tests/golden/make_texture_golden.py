#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes textured_god_object/: paths of the god-object on meshes with a height map laid over them (docs/god-object.md, the
texture scheme; docs/meshes.md, texture coordinates).

Usage: make_texture_golden.py [directory]     (the default is textured_god_object/ beside this file; the output is always the same)

The path is that of make_god_object_golden.py. The slopes are those of make_height_golden.py: exact numbers, and with Gaussians
and gratings enclosures in as many bits as a rounding needs. Beyond these two programs:
  - a gradient is the solution of the 2 x 2 normal equations of a triangle, a rational vector. The mean of several is rational
    where all ratios of their areas are; otherwise it is a decimal of 110 digits, and one in doubt would stop the program;
  - points, slopes and the direction are rationals, rounded once where the page says so.
"""

import sys
from collections import Counter, namedtuple
from decimal import Decimal, localcontext
from fractions import Fraction
from math import isqrt
from pathlib import Path

import make_god_object_golden as god_object
from make_god_object_golden import (DIGITS, UNIT, Mesh, Paths, assert_is_mesh, corner_normals, creases, cross, dot,
                                    exact_decimal, follow_smooth, groups, minus, places_of, plus, rounded, rounded_root,
                                    rounded_surely, scenes, shortest, times, write, write_path)
from make_golden import binary32, hexfloat, read, single
from make_height_golden import Map, coarse, f32, values


# ---------------------------------------------------------------- corners

def corner_gradients(mesh, points, crease_degrees):
    """[triangle][corner] = (the gradient of x, that of y), as binary32 numbers. points: in mm."""
    def point(i, v):
        return points[i][mesh.triangles[i].index(v)]

    def is_turned_over(i):
        (x0, y0), (x1, y1), (x2, y2) = points[i]
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        assert area
        return area < 0
    separating = creases(mesh, crease_degrees)
    for edge, own in mesh.edges.items():
        if len({tuple(point(i, v) for v in edge) for i in own}) > 1 or len(set(map(is_turned_over, own))) > 1:
            separating.add(edge)

    def gradient(i, axis):
        a, b, c = (mesh.w[v] for v in mesh.triangles[i])
        x, y = (times(Fraction(1, UNIT), minus(end, a)) for end in (b, c))
        dx, dy = (points[i][k][axis] - points[i][0][axis] for k in (1, 2))
        xx, xy, yy = dot(x, x), dot(x, y), dot(y, y)
        s, t, d = dx * yy - dy * xy, dy * xx - dx * xy, xx * yy - xy * xy
        return plus(times(s / d, x), times(t / d, y))

    def mean(own, axis):
        gradients = [gradient(i, axis) for i in own]
        if len(set(gradients)) == 1:
            Mesh.reached['gradients that are no mean'] += 1
            return tuple(map(rounded, gradients[0]))
        squares = [Fraction(dot(mesh.normals[i], mesh.normals[i]), dot(mesh.normals[own[0]], mesh.normals[own[0]])) for i in own]
        roots = [Fraction(isqrt(c.numerator), isqrt(c.denominator)) for c in squares]
        if all(root * root == square for root, square in zip(roots, squares)):
            Mesh.reached['gradients that are rational means'] += 1
            total = (Fraction(0),) * 3
            for root, one in zip(roots, gradients):
                total = plus(total, times(root, one))
            return tuple(map(rounded, times(1 / sum(roots), total)))
        Mesh.reached['gradients that are other means'] += 1
        with localcontext() as context:
            context.prec = DIGITS + 20
            areas, total = [exact_decimal([square])[0].sqrt() for square in squares], (Decimal(0),) * 3
            for area, one in zip(areas, gradients):
                total = plus(total, times(area, exact_decimal(one)))
            return tuple(map(rounded_surely, times(1 / sum(areas), total)))
    result = [[None] * 3 for _ in mesh.triangles]
    for v, own in groups(mesh, separating):
        both = tuple(tuple(float(read(c)) for c in mean(own, axis)) for axis in (0, 1))
        assert all(abs(c) <= 1000 for one in both for c in one)
        for i in own:
            result[i][mesh.triangles[i].index(v)] = both
    return result


# ---------------------------------------------------------------- the scheme

class TexturedMesh(Mesh):
    """A corner is a normal, a point of the map and two gradients: eleven numbers."""

    a_map = None

    def direction_in(self, i, rest):
        parts = [[weight * c for c in self.corner(i, v)] for v, weight in self.weights(rest)]
        nx, ny, nz, x, y, *gradients = map(sum, zip(*parts))
        N = nx, ny, nz
        (x, is_tie_x), (y, is_tie_y) = binary32(x), binary32(y)
        self.reached['ties of a point'] += is_tie_x + is_tie_y
        at = read(x), read(y)
        self.reached['points where the map changes'] += any(Fraction(c) in at for c in self.a_map.edges)
        slopes = []
        for slope, without_tail in zip(self.a_map.jet(self.a_map.parts, *at)[1:], self.a_map.jet(self.a_map.parts[:2], *at)[1:]):
            near, is_tie = binary32(slope)
            self.reached['ties of a slope'] += is_tie
            self.reached['slopes that a tail separates from a tie'] += not is_tie and binary32(without_tail)[1]
            slopes.append(read(near))
        length = Fraction(rounded_root(dot(N, N)))
        tilt = plus(times(slopes[0], gradients[:3]), times(slopes[1], gradients[3:]))
        self.reached['tilted' if any(tilt) else 'level'] += 1
        return minus(N, times(length, tilt))


# ---------------------------------------------------------------- the scenes

# chart: the point of the map for a corner, from (triangle, vertex). shift: what a chart of a box adds to coordinates, else None.
Textured = namedtuple('Textured', 'name scene a_map chart scale shift ticks')


def normal_axis(scene, i):
    """The axis along which the normal of a triangle is longest."""
    a, b, c = (scene.vertices[v] for v in scene.triangles[i])
    n = cross(minus(b, a), minus(c, a))
    return max(range(3), key=lambda axis: abs(n[axis]))


def box(scene, shift):
    def point(i, v):
        axis = normal_axis(scene, i)
        return tuple(c + shift for k, c in enumerate(scene.vertices[v]) if k != axis)
    return point


def from_above(scene):
    return lambda i, v: scene.vertices[v][:2]


def halves(scene):
    """From above; beyond x = 0 the map goes by twice as fast, and the points differ at x = 0."""
    def point(i, v):
        x, y = scene.vertices[v][:2]
        return (2 * x + 1, y) if sum(scene.vertices[v][0] for v in scene.triangles[i]) > 0 else (x, y)
    return point


def around_torus(scene):
    """Around the ring of eight by six vertices, with a seam where the numbers begin again."""
    def point(i, v):
        column, row = divmod(i // 2, 6)
        return 0.7 * (v // 6 + 8 * (v // 6 < column)) - 2.8, 0.4 * (v % 6 + 6 * (v % 6 < row)) - 1.2
    return point


def textured_scenes():
    known = {scene.name: scene for scene in scenes()}

    def one(name, mesh, a_map, chart, scale=1.0, shift=None, ticks=70, **change):
        scene = known[mesh]._replace(name=name, ticks=ticks, **change)
        return Textured(name, scene, a_map, chart(scene) if shift is None else chart(scene, shift), scale, shift, ticks)
    yield one('cone_on_a_cube', 'cube', Map('', [(0, 'cone', f32(0, 0, 3.75, 5))], (0.0, 3.0, -3.0, 4.0, -4.0), 5), box, 1.0, 0.0)
    yield one('grid_on_a_cube', 'cube', Map('', [(0, 'bilinear-tile', (5.0, 4.0, 0.5, *coarse('texture', 20)))],
                                            (4.0, 4.25, 4.5, 5.0, 7.5), 5), box, 1.0, 4.0, 90)
    tail = 'gaussian', (0.0, 0.0, 1.0, 0.5)
    planes = [(0, 'plane', (1.0, 0.5, 0.0)), (0, 'plane', (2.0**-24, 3 * 2.0**-25, 0.0))]
    yield one('tail_on_stairs', 'stairs', Map('', [*planes, (0, *tail)], (0.0, 2.0, -4.0), 5), box, 1.0, 0.0)
    yield one('grating_on_a_fold', 'folded_sheet', Map('', [(0, 'grating', f32(0.45, 2.3, -1.1, 0.6))], (), 5), halves, 1.0, None, 80)
    yield one('spline_on_a_torus', 'torus', Map('', [(0, 'cubic-spline-tile', f32(6, 5, 0.35, *values('texture', 30, -0.3, 0.4)))],
                                                (), 5), around_torus, 2.5)
    yield one('caps_on_a_saddle', 'saddle_8', Map('', [(0, 'cone', f32(0, 0, 2, 6)), (1, 'sphere-cap', f32(1, 0, 5, 6))], (), 7),
              halves)
    yield one('steep_tetrahedron', 'tetrahedron', Map('', [(0, 'polygons', f32(-3, 0, -1, 19, 0.5, 9, 2, -34, 6, 1)),
                                                           (0, 'plane', f32(0, 12.5, 0))], (), 7), from_above)
    # From inside, where its corners are pits.
    yield one('gaussian_in_a_tetrahedron', 'tetrahedron', Map('', [(0, 'gaussian', f32(1, 0.5, 2, 3.5))], (), 7), box, 1.0, 0.0, 80,
              sides='both', hot=[((9.7, 4.1, 4.9), 0.25, (2.0, 0.25, -0.5)), ((1.5, -2.9, -3.0), 0.25, (2.0, 0.25, -0.5))])


class TexturedPaths(Paths):
    def __init__(self, textured, mesh):
        super().__init__(textured.scene, mesh)
        self.textured = textured

    def chosen(self):
        """Straight onto a triangle that lies across an axis, at a point of the map where it changes, or that is a tie."""
        i = int(self.draw.random() * len(self.scene.triangles))
        axis = normal_axis(self.scene, i)
        corners = [self.scene.vertices[v] for v in self.scene.triangles[i]]
        if len({corner[axis] for corner in corners}) > 1:
            return
        weights = [1 + self.draw.random() for _ in corners]
        at = [sum(w * corner[k] for w, corner in zip(weights, corners)) / sum(weights) for k in range(3)]
        for k in range(3):
            low, high = min(corner[k] for corner in corners), max(corner[k] for corner in corners)
            edges = [c - self.textured.shift for c in self.textured.a_map.edges if low < c - self.textured.shift < high]
            kind = int(3 * self.draw.random())
            if k != axis and kind == 0 and edges:
                at[k] = self.draw.pick(edges)
            elif k != axis and kind < 2:
                at[k] = (2 * int(at[k] * 2**21) + 1) / 2**22
        n = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))[axis]
        out = self.facing() * (1 if n > 0 else -1)
        for height in (0.5, -0.0625, -0.375):
            yield tuple(c + (out * height if k == axis else 0) for k, c in enumerate(at))

    def pieces(self):
        often = [self.stroke, self.stroke, self.stroke, self.walk, self.on_it, self.next_door]
        return often + [self.hot] * (4 if self.scene.hot else 0) + [self.chosen] * (0 if self.textured.shift is None else 9)

    def pieces_in_turn(self, pieces, start):
        entries = [entry for _, _, *entries in self.scene.hot for entry in entries]
        yield from super().pieces_in_turn(pieces, entries[0] if entries else start)


# ---------------------------------------------------------------- the files

MUST_OCCUR = ['free', 'touching', 'invalid', 'v front', 'e front', 'e back', 't front', 't back', 'shaded on a crease',
              'unshaded at a vertex', 'unshaded, N away from D', 'ties of a point', 'ties of a slope',
              'slopes that a tail separates from a tie', 'points where the map changes', 'tilted', 'level',
              'gradients that are no mean', 'gradients that are rational means', 'gradients that are other means']


def main(directory):
    directory.mkdir(exist_ok=True)
    table, described = [], []
    for textured in textured_scenes():
        scene = textured.scene
        mesh = TexturedMesh(scene.vertices, scene.triangles, scene.sides)
        assert_is_mesh(mesh)
        given = [[tuple(map(single, textured.chart(i, v))) for v in t] for i, t in enumerate(scene.triangles)]
        points = [[tuple(read(rounded(Fraction(c) * Fraction(textured.scale))) for c in point) for point in corners]
                  for corners in given]
        normals, gradients = corner_normals(mesh, scene.crease), corner_gradients(mesh, points, scene.crease)
        mesh.corner_normals = [[tuple(map(Fraction, (*normals[i][k], *points[i][k], *gradients[i][k][0], *gradients[i][k][1])))
                                for k in range(3)] for i in range(len(points))]
        mesh.a_map = textured.a_map
        before = Counter(Mesh.reached)
        rows = list(follow_smooth(mesh, TexturedPaths(textured, mesh).positions()))
        write_path(directory, scene, normals, rows)
        write(directory / f'{scene.name}.texture.csv',
              [['triangle', 'corner', 'u', 'v', 'x_mm', 'y_mm', 'xx', 'xy', 'xz', 'yx', 'yy', 'yz'],
               *([i, k, *map(shortest, (*given[i][k], *map(float, points[i][k]), *gradients[i][k][0], *gradients[i][k][1]))]
                 for i in range(len(points)) for k in range(3))])
        described += [[scene.name, 'map', negated, shape, ' '.join(map(hexfloat, map(float, numbers)))]
                      for negated, shape, numbers in textured.a_map.parts]
        table.append([scene.name, scene.sides, scene.crease, len(scene.triangles), len(rows), shortest(textured.scale)])
        Mesh.reached.update(places_of(rows))
        print(f'{scene.name:18}', *(f'{kind} {n}' for kind, n in (Mesh.reached - before).items()), sep='; ', flush=True)
    write(directory / 'meshes.csv', [[*god_object.TABLE, 'scale_mm'], *table])
    write(directory / 'maps.csv', [['map', 'use', 'negated', 'shape', 'numbers'], *described])
    print(*(f'{kind}: {Mesh.reached[kind]}' for kind in MUST_OCCUR), sep='\n')
    assert all(Mesh.reached[kind] for kind in MUST_OCCUR)


if __name__ == '__main__':
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / 'textured_god_object')
