# SPDX-License-Identifier: BSD-3-Clause
"""Subjects to render: laws, height maps and meshes."""

from __future__ import annotations

import copy
import os
import warnings
from typing import Any, Literal, SupportsFloat

import numpy as np
import numpy.typing as npt

from . import _arrays, _exact, _forceshade
from ._arrays import Rounding
from ._materials import Friction, Materials, materials_of, words_of_friction
from ._subject import File, Quantity, Subject, length_of, path_of, remade, stiffness_of, text_of, word_of

LawName = Literal[
    "wall", "cylinder", "bump-cylinder", "bump-1p", "bump-2p", "bump-3p", "bump-1p-shaded", "bump-2p-shaded", "bump-3p-shaded"
]
Interpolant = Literal["cubic-spline", "bilinear"]
Edge = Literal["clamp", "tile"]
Render = Literal["height-map", "height-map-shaded", "height-map-conservative"]
Unit = Literal["mm", "cm", "m", "in"]
Sides = Literal["front", "both"]
Contact = Literal["direct", "sub-goal", "friction"]


_TEXTURE = "texture:"  # before the name of its file


def _short(number: float) -> str:
    return str(np.float32(number))


class Law(Subject):
    """One of the nine force laws of docs/laws.md: forceshade.laws() has their names.

    radius: R, mm, in [0.1, 10 000]. width: w, mm, the chord of the bump on the plane, in [0.001, 2 R]. stiffness: K, N/mm, in
    [0.001, 1000]. The defaults are the command's: 15.24 mm, 25.4 mm and 0.5 N/mm.

    The wall takes the stiffness alone. A number stands for the nearest binary32 number, as on the command line, and a text may
    have a unit: "600mil", "500N/m".

    Raises ValueError for an unknown law, a wrong unit, and a number outside its range.

    >>> Law("bump-1p", radius="600mil", width="1in", stiffness="500N/m")
    Law('bump-1p', radius=15.24, width=25.4, stiffness=0.5)
    """

    def __init__(
        self,
        name: LawName,
        *,
        radius: Quantity | None = None,
        width: Quantity | None = None,
        stiffness: Quantity = _forceshade.usual_stiffness,
    ) -> None:
        self._made_by = Law, (name,), {"radius": radius, "width": width, "stiffness": stiffness}
        for value, key in ((radius, "radius"), (width, "width")):
            if name == "wall" and value is not None:
                raise TypeError(f"the wall has no {key}; expected its stiffness alone")
        super().__init__(
            _forceshade.law_of(
                word_of(name, "law"),
                length_of(_forceshade.usual_radius if radius is None else radius, "radius"),
                length_of(_forceshade.usual_width if width is None else width, "width"),
                stiffness_of(stiffness),
            )
        )

    @property
    def name(self) -> str:
        """ "bump-2p" and the like."""
        return self._name

    @property
    def radius(self) -> float | None:
        """R, mm; None for the wall."""
        value = self._parameters.get("radius_mm")
        return None if value is None else float(value)

    @property
    def width(self) -> float | None:
        """w, mm; None for the wall."""
        value = self._parameters.get("width_mm")
        return None if value is None else float(value)

    def geometry(self, *, digits: int = 50) -> _exact.Geometry:
        """d, h, w', h' and theta of the bump, as forceshade.geometry() gives them."""
        if self.radius is None or self.width is None:
            raise _forceshade.Error("the wall has no geometry; expected a law with a bump")
        return _exact.geometry(radius=self.radius, width=self.width, digits=digits)

    def __repr__(self) -> str:
        numbers_of = {"radius": self.radius, "width": self.width, "stiffness": self.stiffness}
        words = (f"{key}={_short(value)}" for key, value in numbers_of.items() if value is not None)
        return f"Law({self.name!r}, {', '.join(words)})"


class HeightMap(Subject):
    """A height map U(x, y).

    heights: an array (rows, columns) of heights in mm, within ±10 000 mm, and 0 below 2^-30 mm in size: float32, 2 to 32 768
    rows and columns, and 2^26 samples at most. Rows run along y from the smallest, columns along x, `pitch` mm apart, and the
    middle is the origin. (A picture has the largest y in its first row: heights[::-1].)
    Or a file: a TOML file (docs/height-maps.md), which says all but the stiffness; or a greyscale PNG, TIFF or PFM picture or
    an NPY array, whose first row has the largest y, with its pitch and its `scale`: the height of white, or of 1, in mm.
    stiffness: K, N/mm, in [0.001, 1000]; default: 0.5.
    interpolant: "cubic-spline", which goes through the heights, or "bilinear". edge: beyond the samples, "clamp" or "tile".
    render: "height-map" (at the surface's own depth), "height-map-shaded" (at the plane's), or "height-map-conservative".
    rounding: "nearest" says that heights of other types than float32 may be rounded; else a RoundingWarning does.

    Raises ValueError for what is outside its range, TypeError for a wrong type, OSError and Error for an unreadable file.

    >>> import numpy
    >>> x = numpy.linspace(-1, 1, 65)
    >>> waves = HeightMap(numpy.cos(6 * x) + 0 * x[:, None], pitch=0.5, stiffness=0.3, rounding="nearest")
    >>> waves.force(0, 0, 0.25)[2] > 0
    True
    """

    _read_heights: npt.NDArray[np.float32] | None = None

    def __init__(
        self,
        heights: npt.ArrayLike | File,
        *,
        stiffness: Quantity = _forceshade.usual_stiffness,
        pitch: Quantity | None = None,
        scale: Quantity | None = None,
        interpolant: Interpolant | None = None,
        edge: Edge | None = None,
        render: Render | None = None,
        rounding: Rounding = None,
    ) -> None:
        given = {"pitch": pitch, "scale": scale, "interpolant": interpolant, "edge": edge, "render": render}
        through, beyond, as_what = (
            usual if given[key] is None else word_of(given[key], key)
            for key, usual in (("interpolant", "cubic-spline"), ("edge", "clamp"), ("render", "height-map"))
        )
        source: Any = heights
        if isinstance(heights, (str, os.PathLike)):
            path = path_of(heights)
            source = os.path.abspath(path)
            if pitch is None and scale is None:
                for key, value in given.items():
                    if value is not None:
                        raise TypeError(f"{path} says {key} itself; expected the stiffness alone, or pitch and scale too")
                text = text_of(stiffness, "stiffness", '"500N/m"')
                description = _forceshade.of_options([("height-map", os.fsencode(path)), ("stiffness", text)])
            elif pitch is None or scale is None:
                raise TypeError("a picture needs pitch and scale, both in mm")
            else:
                mm = length_of(pitch, "pitch"), length_of(scale, "scale")
                description = _forceshade.map_of_picture(
                    os.fsencode(path), *mm, through, beyond, as_what, stiffness_of(stiffness)
                )
        else:
            if pitch is None:
                raise TypeError("heights need their pitch, mm between samples")
            if scale is not None:
                raise TypeError("scale is that of a picture; heights are in mm")
            given_heights = _arrays.as_floats(heights, "heights", rounding)
            if given_heights.ndim != 2:
                raise ValueError(f"heights have the shape {given_heights.shape}; expected (rows, columns)")
            # In the memory of bytes, which nobody can make writable.
            samples = source = np.frombuffer(given_heights.tobytes(), np.float32).reshape(given_heights.shape)
            description = _forceshade.map_of_samples(
                samples, length_of(pitch, "pitch"), through, beyond, as_what, stiffness_of(stiffness)
            )
        self._made_by = HeightMap, (source,), {"stiffness": stiffness, **given}
        super().__init__(description)

    @property
    def heights(self) -> npt.NDArray[np.float32] | None:
        """The heights (mm) that it was made of, (rows, columns), read-only: rows from the smallest y, as in the constructor.

        Those of a file are in mm, too, and band-limited where it says so. They lie where the map has them if it is bilinear; of a
        spline, the file is read again, and refused with Error where it has changed. None where the map is not samples alone.
        """
        source = self._made_by[1][0]
        if isinstance(source, np.ndarray):
            return source
        if self._read_heights is None:
            pitch, scale = (self._made_by[2][key] for key in ("pitch", "scale"))
            mm = (None, None) if pitch is None else (length_of(pitch, "pitch"), length_of(scale, "scale"))
            lying = self._heights_of(os.fsencode(source), *mm)
            self._read_heights = None if lying is None else np.asarray(lying)
        return self._read_heights

    def height(self, x: SupportsFloat, y: SupportsFloat, *, rounding: Rounding = None) -> float:
        """The height (mm) of the surface at a place of the plane (mm): the exact one, rounded once to binary32.

        x, y: within ±10 000 mm; rounded to binary32, with a RoundingWarning unless rounding="nearest". It is U(x, y) of
        docs/height-maps.md, on which the force begins; a shaded map with a [[surface]] measures its depth from that one.

        Raises ValueError for a place outside.

        >>> HeightMap([[0, 0, 0], [0, 3, 0], [0, 0, 0]], pitch=2, interpolant="bilinear").height(1, 0)
        1.5
        """
        place = _arrays.as_floats([x, y], "place", rounding)
        if place.shape != (2,):
            raise TypeError("expected two numbers x, y in mm")
        at = float(place[0]), float(place[1])
        if not all(abs(coordinate) <= 10_000 for coordinate in at):
            raise ValueError(f"place is {at}; expected x and y within ±10 000 mm")
        return _forceshade.height_at(self, *at)

    def __repr__(self) -> str:
        return f"<HeightMap {self._name}: {self._words}>"


def _indices(triangles: npt.ArrayLike, count: int) -> npt.NDArray[np.uint32]:
    array = _arrays.array_of(triangles, "triangles")
    if array.dtype.kind not in "iu":
        raise TypeError(f"triangles are of type {array.dtype}; expected integers, the numbers of vertices from 0")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"triangles have the shape {array.shape}; expected (m, 3)")
    is_none = (array < 0) | (array >= count)
    if is_none.any():
        row, column = (int(i) for i in np.argwhere(is_none)[0])
        which = f"triangles[{row}, {column}]"
        raise ValueError(f"{which} is {array[row, column]}; expected the number of a vertex, 0 to {count - 1}")
    return array.astype(np.uint32)


class Mesh(Subject):
    """A triangle mesh, felt through a god-object. Its force depends on the path: a Session follows one.

    vertices: float32 (n, 3), mm. triangles: integers (m, 3), numbers of vertices from 0; (b - a) x (c - a) points to the front.
    Or a file instead of both, OFF, OBJ, PLY or STL, with its `unit`: "mm", "cm", "m" or "in"; its shading may be "texture:FILE.toml",
    with the length `texture_scale` of one unit of its coordinates.
    stiffness: K, N/mm, in [0.001, 1000]; default: 0.5. sides: which block, "front" or "both"; default: "front" for a closed mesh, else
    "both". shading: "vertex" (usual), "edge" or "none" (usual with sub-goal). contact: "direct", "sub-goal" or
    "friction", which is usual where a coefficient of friction is above 0.
    friction: a coefficient of friction, or a pair (static, dynamic), for the whole mesh: 0, inf, or 2**-10 to 1024.
    materials: instead, of a mesh file, a TOML file; of arrays a pair (list, numbers): a list of dictionaries with "friction",
    "stiffness", "damping", "drag" or none of these, and for each triangle the number of its material (docs/meshes.md,
    "Materials and friction").
    crease: degrees, 0 to 180 (no creases), for the normals.
    self_intersecting: deprecated and without effect, since every set of triangles is taken.

    Triangles may cross, touch, coincide and share edges as they like (docs/soups.md); `is_regular` says whether they do none of it,
    which shading "edge" and "texture" and contact "sub-goal" need. This is found exactly, in a second for some hundred thousand
    triangles. Raises ValueError with the numbers of faces and vertices for what cannot be rendered, OSError and Error for a file.

    >>> corners, faces = [[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    >>> session = Session(Mesh(corners, faces, stiffness=0.5, shading="none"))
    >>> session.step(2, 2, -1), session.step(2, 2, 1)
    ((0.0, 0.0, 0.0), (0.0, 0.0, -0.5))
    """

    def __init__(
        self,
        vertices: npt.ArrayLike | File,
        triangles: npt.ArrayLike | None = None,
        *,
        stiffness: Quantity = _forceshade.usual_stiffness,
        unit: Unit | None = None,
        sides: Sides | None = None,
        shading: str | None = None,
        contact: Contact | None = None,
        crease: Quantity | None = None,
        texture_scale: Quantity | None = None,
        self_intersecting: bool = False,
        friction: Friction | None = None,
        materials: File | Materials | None = None,
        rounding: Rounding = None,
    ) -> None:
        if friction is not None and materials is not None:
            raise TypeError("friction is that of the whole mesh; expected friction or materials, got both")
        if self_intersecting:
            warnings.warn("self_intersecting is not needed: every set of triangles is taken", DeprecationWarning, stacklevel=2)
        made_by = {
            "stiffness": stiffness,
            "unit": unit,
            "sides": sides,
            "shading": shading,
            "contact": contact,
            "crease": crease,
            "texture_scale": texture_scale,
            "friction": friction,
            "materials": copy.deepcopy(materials),
        }
        source: tuple[str, ...] = ()
        is_file = isinstance(vertices, (str, os.PathLike))
        options: dict[str, Any] = {"sides": sides, "shading": shading, "contact": contact}
        for key, value in options.items():
            is_texture = is_file and key == "shading" and isinstance(value, str) and value.startswith(_TEXTURE)
            if value is not None and not is_texture:  # whose file's name need be no UTF-8
                word_of(value, key)
        if is_file:
            if triangles is not None:
                raise TypeError("a file has its own triangles; expected Mesh(file, ...)")
            if unit is None:
                raise TypeError('a mesh file does not say its unit; expected unit="mm", "cm", "m" or "in"')
            source = (os.path.abspath(path_of(vertices)),)
            options = {"mesh": path_of(vertices), "unit": word_of(unit, "unit"), **options}
            options["stiffness"] = text_of(stiffness, "stiffness", '"500N/m"')
            if crease is not None:
                options["crease"] = text_of(crease, "crease", '"30deg"')
            if texture_scale is not None:
                options["texture-scale"] = text_of(texture_scale, "texture_scale", '"10mm"')
            if friction is not None:
                options["friction"] = words_of_friction(friction)
            if materials is not None:
                if not isinstance(materials, (str, os.PathLike)):
                    raise TypeError("the materials of a mesh file are a TOML file; expected its path")
                options["materials"] = path_of(materials)
                made_by["materials"] = os.path.abspath(path_of(materials))  # it is made again in another folder, too
            if shading is not None and shading.startswith(_TEXTURE):
                made_by["shading"] = _TEXTURE + os.path.abspath(shading[len(_TEXTURE) :])
            description = _forceshade.of_options([(key, os.fsencode(value)) for key, value in options.items() if value is not None])
        else:
            if triangles is None:
                raise TypeError("vertices need their triangles; expected Mesh(vertices, triangles, ...) or Mesh(file, ...)")
            if unit is not None or texture_scale is not None:
                raise TypeError("unit and texture_scale are those of a file; vertices are in mm")
            points = _arrays.as_floats(vertices, "vertices", rounding)
            if points.ndim != 2 or points.shape[1] != 3:
                raise ValueError(f"vertices have the shape {points.shape}; expected (n, 3): x, y, z in mm")
            angle = 180.0 if crease is None else _forceshade.angle("crease", text_of(crease, "crease", '"30deg"'))
            description = _forceshade.mesh_of_arrays(
                points,
                _indices(triangles, len(points)),
                sides,
                shading,
                contact,
                angle,
                stiffness_of(stiffness),
                *materials_of(friction, materials),
            )
        self._made_by = Mesh, source, made_by
        super().__init__(description)

    def __reduce__(self) -> tuple[Any, ...]:
        make, source, options = self._made_by
        return remade, (self.digest, make, source or (self.vertices, self.faces), options)

    @property
    def vertices(self) -> npt.NDArray[np.float32]:
        """(n, 3), mm; read-only. A coordinate below 2^-30 mm in size is 0."""
        return np.asarray(self._vertices)

    @property
    def is_regular(self) -> bool:
        """True for a mesh as docs/meshes.md has it; any other set of triangles is rendered as docs/soups.md defines it."""
        return self._is_regular

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """The triangles, (m, 3): the numbers of their vertices, from 0; read-only."""
        return np.asarray(self._faces)

    def __repr__(self) -> str:
        return f"<Mesh {self._name}: {self._words}>"


def read_subject(file: File) -> Law | HeightMap | Mesh:
    """The law, height map or mesh of a subject file (docs/subjects.md). Files that it names lie beside it.

    Raises OSError where it cannot be opened, and Error with file and line where it is refused.
    """
    description = _forceshade.of_file(os.fsencode(path_of(file)))
    made: Law | HeightMap | Mesh
    if description.kind == "law":
        made = Law.__new__(Law)
    elif description.kind == "mesh":
        made = Mesh.__new__(Mesh)
    else:
        made = HeightMap.__new__(HeightMap)
    _forceshade.Subject.__init__(made, description)
    made._made_by = read_subject, (os.path.abspath(path_of(file)),), {}
    return made


def laws() -> list[str]:
    """The names of the laws.

    >>> laws()[:2]
    ['wall', 'cylinder']
    """
    return _forceshade.laws()
