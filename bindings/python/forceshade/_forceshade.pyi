# The compiled module: in types what users see of it, and what the package returns as it is. The package has read the arguments of
# all else, which has no types here.
from typing import Any, Optional, SupportsFloat

version: str
rounded: str

class Error(Exception): ...
class RoundingWarning(UserWarning): ...

class Description:
    kind: str

class Subject:
    _kind: str
    _name: str
    _digest: str
    _words: str
    _parameters: dict[str, float | str]
    _is_regular: bool
    _is_damped: bool
    _vertices: memoryview
    _faces: memoryview
    _damping_at: Any
    _heights_of: Any
    _forces: Any
    _advance: Any
    def __init__(self, description: Description) -> None: ...
    def force(
        self, x: SupportsFloat, y: SupportsFloat, z: SupportsFloat, *, rounding: Optional[str] = None
    ) -> tuple[float, float, float]: ...

class Session:
    _status: int
    _steps: Any
    _state: Any
    _resume: Any
    _damping_state: Any
    _resume_damping: Any
    def __init__(self, subject: Subject, damping: Any = None, /) -> None: ...
    def step(
        self, x: SupportsFloat, y: SupportsFloat, z: SupportsFloat, *, rounding: Optional[str] = None
    ) -> tuple[float, float, float]: ...

class Scene:
    _status: int
    _step: Any
    _forces: Any
    _damping_state: Any
    _resume_damping: Any
    def __init__(self, objects: Any, damping: Any = None, /) -> None: ...

class Reference:
    decimals: Any
    compare: Any
    rounded: Any
    def __init__(self, subject: Subject) -> None: ...

def library_digest() -> str: ...
def laws() -> list[str]: ...
def nearest(number: object, /) -> float: ...
def length(name: str, text: str, /) -> float: ...
def stiffness(name: str, text: str, /) -> float: ...
def height_at(subject: Subject, x: float, y: float, /) -> float: ...
def __getattr__(name: str) -> Any: ...
