# SPDX-License-Identifier: BSD-3-Clause
"""Haptic force laws, height maps and triangle meshes: each force is the binary32 number nearest to the exact one.

>>> import forceshade
>>> bump = forceshade.Law("bump-2p", radius=15.24, width=25.4, stiffness=0.5)    # mm, mm, N/mm
>>> bump.force(3, 0, -0.5)                                                       # N, at x, y, z in mm
(1.3490643501281738, 0.0, 2.5137453079223633)
>>> bump.forces([[3, 0, -0.5], [0, 0, 5]])
array([[1.3490644 , 0.        , 2.5137453 ],
       [0.42932048, 0.        , 0.7999636 ]], dtype=float32)

Frame and units: x points right, y into the page, z up. Lengths are in mm, forces in N, stiffnesses in N/mm. A coordinate below
2^-30 mm in size is read as 0; one beyond 10 000 mm, or NaN, makes its position invalid, which gives no force.

Numbers: forces are those of binary32 numbers (numpy.float32). Others are taken, too, as numpy.linspace() and Python have them: one
that binary32 does not hold is rounded to the nearest that it holds, with a RoundingWarning, which Python shows once for each line of
a program. rounding="nearest" says that this is meant, and warnings.simplefilter("error", forceshade.RoundingWarning) refuses it.

Threads: subjects do not change and may be shared. A session is for one thread at a time. Arrays are worked on without the GIL,
and by several threads where forces() or advance() is given threads=.

Errors: ValueError, TypeError, OSError, or forceshade.Error; each says what was expected and what was got.

Source: Morgenbesser and Srinivasan, "Force Shading for Shape Perception in Haptic Virtual Environments", RLE Technical Report 606,
MIT, December 1996. No force is computed in this package: it calls the same libraries as the command forceshade.
"""

from ._checks import Certificate, PlanState, PropertyResult, certify, make_plan, merged_plan, plan_state, properties, work_on_plan
from ._conform import Conformance, OpenedDampedRenderer, OpenedRenderer, RendererOfScenes, conform
from ._damping import DAMPING_STATE, Damping, DampingState
from ._exact import ExactForce, Geometry, geometry
from ._forceshade import Error, RoundingWarning, library_digest
from ._forceshade import version as _version
from ._recordings import Recording, read_recording
from ._scenes import Pose, Scene
from ._sessions import Meeting, Place, Session, State
from ._subject import ANSWER, STATE, Identity, Status, Subject
from ._subjects import HeightMap, Law, Mesh, laws, read_subject

__version__: str = _version
"""The version of the package, which is that of the libraries."""

__all__ = [
    "ANSWER",
    "DAMPING_STATE",
    "STATE",
    "Certificate",
    "Error",
    "Conformance",
    "Damping",
    "DampingState",
    "ExactForce",
    "Geometry",
    "HeightMap",
    "Identity",
    "Law",
    "Meeting",
    "Mesh",
    "OpenedDampedRenderer",
    "OpenedRenderer",
    "Place",
    "PlanState",
    "Pose",
    "PropertyResult",
    "Recording",
    "RendererOfScenes",
    "RoundingWarning",
    "Scene",
    "Session",
    "State",
    "Status",
    "Subject",
    "__version__",
    "certify",
    "conform",
    "geometry",
    "laws",
    "library_digest",
    "make_plan",
    "merged_plan",
    "plan_state",
    "properties",
    "read_recording",
    "read_subject",
    "work_on_plan",
]
