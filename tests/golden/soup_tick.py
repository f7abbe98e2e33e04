# SPDX-License-Identifier: BSD-3-Clause
"""A tick of the god-object on any set of triangles, as docs/soups.md defines it."""

from fractions import Fraction
from math import floor

from make_god_object_golden import GRID, times
from soup_places import MOST_LOOKS, Places, TooManyLooks, along, apart, way

MOST_MOVES = 256


class Soup(Places):
    """A set of triangles with the ticks on it. A state is None, (point, None, None) when free, or (point, place, name of the cell)."""

    # ------------------------------------------------------------ the cell after a flight; ends

    def blocker(self, near, cell):
        """The lowest triangle that blocks from the cell's side, and the direction to that side; at a point of kind 2."""
        side = near.cells[cell][0]
        return min(near.blocking(side)), times(1 - 2 * (side % 2), near.pieces[0].normal)

    @staticmethod
    def cell_after_flight(near, u, is_at_position):
        """The cell of −u. But at the position, if that has no wall beside it, or where u is on the surface, the cell of a wall that can
        be reached."""
        cell = near.cell(times(-1, u))
        walls = near.walls(cell)
        if not is_at_position and near.cell(u) is not None:
            return cell
        at_u = [] if is_at_position else [side for side in walls if side in near.sides_at(u)]
        if at_u:
            Soup.reached['flights that end along the surface'] += 1
            return near.cell_of_side(min(at_u, key=lambda side: (near.cell_of_side(side) != cell, near.name_of_side(side))))
        if any(near.cell_of_side(side) == cell for side in walls):
            return cell
        Soup.reached['flights from behind'] += 1
        return near.cell_of_side(min(walls, key=near.name_of_side))

    def across_line(self, near, cell):
        """At a point of kind 1: the direction across the cell's wedge."""
        return near.across(max(near.rays), near.cells[cell][0])

    def cell_back(self, x, y, w):
        """At y, which a way from x beside w ends at: the cell from which it comes."""
        return self.near(y).cell_beside(way(y, x), w)

    def beside_on_line(self, x, line, parameter):
        """From x along its line to the parameter, or the next point of kind 0 where that comes first: (point, parameter)."""
        y = self.point_on_line(x, line, parameter)
        meetings = self.meetings(x, y)
        if meetings:
            self.reached['roundings on a line stopped'] += 1
            return along(x, y, meetings[0]), line[1] + meetings[0] * (parameter - line[1])
        return y, parameter

    def rounded(self, x, cell, p):
        """Rule 3: (point, cell, place; None if it is not strictly inside a triangle whose grid gave it)."""
        near = self.near(x)
        if near.kind == 0:
            return x, cell, None
        if near.kind == 1:
            line = self.line_at(x, near)
            scaled = line[1] * GRID
            if scaled.denominator == 1:
                return x, cell, None
            ends = [self.beside_on_line(x, line, Fraction(floor(scaled) + k, GRID)) for k in (0, 1)]
            y = min(ends, key=lambda end: (apart(end[0], p), end[1]))[0]
            self.looked_at(y)
            return y, self.cell_back(x, y, self.across_line(near, cell)), None
        f, w = self.blocker(near, cell)
        c, place = self.corner(f, x, p)
        if c == x:
            return x, cell, place
        y = self.obstacle(x, c, w)
        if y is None:
            self.looked_at(c)
            return c, self.cell_back(x, c, w), place
        self.reached['roundings in a triangle stopped'] += 1
        return self.rounded(y, self.cell_back(x, y, w), p)

    def corner(self, f, x, p):
        """The corner of x's cell in triangle f's grid that is nearest to p, and its place."""
        _, beta, gamma = (weight * GRID for weight in self.weights(f, x))
        k, l = floor(beta), floor(gamma)
        corners = [(k, l), (k + 1, l), (k, l + 1)]
        if beta.denominator == 1 or gamma.denominator == 1 or (beta + gamma).denominator == 1:
            if beta.denominator == gamma.denominator == 1:
                corners = [(k, l)]
            elif beta.denominator == 1:
                corners = [(k, l), (k, l + 1)]
            elif gamma.denominator == 1:
                corners = [(k, l), (k + 1, l)]
            else:
                corners = [(k, l + 1), (k + 1, l)]
        elif beta + gamma > k + l + 1:
            corners = [(k + 1, l + 1), (k + 1, l), (k, l + 1)]
        found = [(self.mixed(f, Fraction(k, GRID), Fraction(l, GRID)), k, l) for k, l in corners]
        c, k, l = min(found, key=lambda one: (apart(one[0], p), *one[1:]))
        return c, ('t', f, k, l) if k > 0 and l > 0 and k + l < GRID else None

    def place_of(self, x):
        """The name of a grid point on a border of a triangle, or of a point of kind 0."""
        near = self.near(x)
        if near.kind == 0:
            return self.name_of_point(x, near)
        line = self.line_at(x, near)
        return (*line[0], int(line[1] * GRID))

    def at_rest(self, r, cell):
        """Rule 4 for r ≠ g: (point, cell, place) that the state keeps."""
        near = self.near(r)
        self.points = 0
        if near.kind == 0:
            return r, cell, self.name_of_point(r, near)
        if near.kind == 1:
            line = self.line_at(r, near)
            m = round(line[1] * GRID)
            if line[0][0] == 'e':
                m = min(max(m, 1), GRID - 1)
            y = self.point_on_line(r, line, Fraction(m, GRID))
            if y == r:
                return r, cell, (*line[0], m)
            if self.meetings(r, y) or self.near(y).kind == 0:
                self.reached['feet on a line'] += 1
                return r, cell, ('q', *line[0])
            return y, self.cell_back(r, y, self.across_line(near, cell)), (*line[0], m)
        f, w = self.blocker(near, cell)
        k, l = self.kept_inside(*(round(weight * GRID) for weight in self.weights(f, r)[1:]))
        c = self.mixed(f, Fraction(k, GRID), Fraction(l, GRID))
        if c == r:
            return r, cell, ('t', f, k, l)
        try:
            is_stopped = self.obstacle(r, c, w) or self.looked_at(c) and self.obstacle(c, r, w)
        except TooManyLooks:
            is_stopped = True
        if is_stopped:
            self.reached['feet in a triangle'] += 1
            return r, cell, ('q', 't', f)
        return c, self.cell_back(r, c, w), ('t', f, k, l)

    @staticmethod
    def kept_inside(k, l):
        k, l = max(k, 1), max(l, 1)
        excess = k + l - (GRID - 1)
        if excess > 0:
            k, l = (k - excess, l) if k >= l else (k, l - excess)
        return k, l

    # ------------------------------------------------------------ the ways

    def flight(self, g, p):
        """(end, cell, whether it rests there); the cell is None where p is off the surface."""
        u = way(g, p)
        self.look_along(g, p)
        for t in self.meetings(g, p):
            x = along(g, p, t)
            near = self.looked_at(x)
            if near.cell(u) not in near.reached(near.cell(times(-1, u))):
                return x, self.cell_after_flight(near, u, False), False
        near = self.near(p) and self.looked_at(p)
        return p, near and self.cell_after_flight(near, u, True), True

    def steepest(self, near, cell, u):
        """(direction, wall, whether the direction is in the wall's piece); None if there is no direction with u·v > 0."""
        best, closest = None, None
        for side in near.walls(cell):
            piece = near.pieces[side // 2]
            last = near.cell_of_side(side) != cell, near.name_of_side(side)
            ways = [(ray, (0, self.order_of_ray(near, ray), *last), False) for ray in {piece.start, piece.end} if ray]
            foot = near.projection(piece, u)
            ways += [(foot, (1, min(near.blocking(side)), *last), True)] if foot else []
            for v, order, is_in_piece in ways:
                s, t = near.closeness(u, v)
                news = s * closest[1] - closest[0] * t if closest else 1
                self.reached['ties of directions'] += news == 0 and not is_in_piece and v != best[1]
                if news > 0 or news == 0 and order < best[0]:
                    best, closest = (order, v, side, is_in_piece), (s, t)
        return best[1:] if best and closest[0] > 0 else None

    def order_of_ray(self, near, ray):
        if near.rays[ray]:
            return 0, *min(near.rays[ray])
        own = [i for i in sorted(near.cones) if near.holds(i, ray)]
        return 1, own[0], next(i for i in own if self.planes[i] != self.planes[own[0]])

    def slide(self, g, near, steepest, p):
        """(end, cell, whether it rests there)"""
        v, side, is_in_piece = steepest
        if is_in_piece:
            f = min(near.blocking(side))
            q = self.foot(f, p)
            self.look_along(g, q)
            w = times(1 - 2 * (side % 2), near.pieces[side // 2].normal)
            rests = min(self.insides(f, q)) > 0
            x = q if rests else along(g, q, self.stretch(f, g, q)[1])
            y = self.obstacle(g, x, w)
            if y:
                self.reached['slides stopped'] += 1
                x, rests = y, False
            else:
                self.looked_at(x)
        else:
            q, w = self.foot_on_line(g, v, p), near.across(v, side)
            self.look_along(g, q)
            meetings = self.meetings(g, q)
            x = along(g, q, meetings[0]) if meetings else q
            self.looked_at(x)
            rests = not meetings and self.near(q).kind == 1
            self.reached['lines that end at the foot'] += not meetings and not rests
        return x, self.cell_back(g, x, w), rests or x == p

    def tick(self, state, p):
        """(state, status, moves, (r, cell) or None)"""
        self.looks = self.points = 0
        if state is None:
            near = self.near(p)
            if near is None:
                return (p, None, None), 'free', 0, None
            try:
                self.looked_at(p)
            except TooManyLooks:
                return None, 'unfinished', 0, None
            return self.resting(p, min(near.cells, key=near.name), 0)
        g, place, name = state
        cell = place and self.near(g).cell_named(name)
        moves = 0
        while True:
            u, near = way(g, p), place and self.near(g)
            if not any(u):
                return self.staying(g, place, cell, 'touching', moves) if place else (state, 'free', moves, None)
            flies = place is None or near.cell(u) in near.reached(cell)
            steepest = None if flies else self.steepest(near, cell, u)
            if not flies and steepest is None:
                return self.staying(g, place, cell, 'touching', moves)
            if moves == MOST_MOVES or self.looks >= MOST_LOOKS:
                return self.staying(g, place, cell, 'unfinished', moves)
            self.points = 0
            try:
                x, cell_there, rests = self.flight(g, p) if flies else self.slide(g, near, steepest, p)
                if cell_there is None:
                    return (p, None, None), 'free', moves + 1, None
                if rests:
                    return self.resting(x, cell_there, moves + 1)
                x, cell_there, place_there = self.rounded(x, cell_there, p)
            except TooManyLooks:
                self.reached['moves with too many looks'] += 1
                return self.staying(g, place, cell, 'unfinished', moves) if place else (state, 'unfinished', moves, None)
            if place and apart(x, p) >= apart(g, p):
                self.reached['refused'] += 1
                return self.staying(g, place, cell, 'touching', moves)
            g, cell, place, moves = x, cell_there, place_there or self.place_of(x), moves + 1

    def staying(self, g, place, cell, status, moves):
        return (g, place, self.near(g).name(cell)), status, moves, (g, cell)

    def resting(self, r, cell, moves):
        x, kept, place = self.at_rest(r, cell)
        return (x, place, self.near(x).name(kept)), 'touching', moves, (r, cell)
