"""Octant: pictures of flight over terrain with their ground truth, drawn by the processor.

Lengths are in metres, times in seconds, angles in degrees where a name ends in ``_deg``. World axes: x east, y north,
z up, the local tangent plane at the centre of the map. Body axes: x forward, y right, z down. An attitude is a unit
quaternion w, x, y, z that turns body axes into world axes; a camera looks along body x with body z downwards. The same
arguments give the same bytes for any number of threads and any split into calls.

Wrong arguments raise ValueError; files and settings that cannot be used raise octant.Error, which is a ValueError and
an OSError, with one line of text: ``file:line: expected ..., got ...``. Notes about what was guessed or mended while
loading are warnings (UserWarning).

>>> import octant
>>> world = octant.World(terrain="hills", triangles=1000)
>>> frames = world.render(octant.Camera(64, 48), eye=[0, 0, 900], look=octant.attitudes(pitch_deg=-20))
>>> frames.rgb.shape, frames.rgb.dtype
((1, 48, 64, 3), dtype('uint8'))
"""

from __future__ import annotations

import importlib
import operator
import os
import re
import struct
import warnings
import zlib
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _octant
from ._octant import Box, Camera, Error, Object, classes
from ._octant import version as __version__

if TYPE_CHECKING:
    from . import envs as envs
    from ._recording import Recording as Recording

_Path = Union[str, "os.PathLike[str]"]
_Floats = NDArray[np.float64]

__all__ = [
    "Box", "Camera", "Error", "Flight", "Frame", "Frames", "Ground", "Object", "Picture", "PilotedAircraft",
    "Recording", "States", "World", "attitudes", "classes", "envs", "fly", "from_opencv", "from_opengl", "look_at",
    "output_names", "recording", "report", "setting_names", "states", "to_opencv", "to_opengl",
]  # fmt: skip

output_names = ("rgb", "depth_m", "class_id", "object_id", "normal", "flow_px", "coverage")
"""The arrays that a picture can have."""

_formats = {
    "rgb": (np.uint8, (3,)),
    "depth_m": (np.float32, ()),
    "class_id": (np.uint8, ()),
    "object_id": (np.uint32, ()),
    "normal": (np.float32, (3,)),
    "flow_px": (np.float32, (2,)),
    "coverage": (np.float32, ()),
}


def __getattr__(name):
    # Loaded when they are first used.
    if name == "envs":
        return importlib.import_module("octant.envs")
    if name == "Recording":
        return importlib.import_module("octant._recording").Recording
    raise AttributeError(f"module 'octant' has no attribute '{name}'")


# Settings by keyword.

_setting_forms = None


def _forms():
    global _setting_forms
    if _setting_forms is None:
        _setting_forms = {name: form for name, form, _ in _octant.known_settings()}
    return _setting_forms


def setting_names() -> dict[str, str]:
    """The settings that World() and fly() take as keywords, with their meanings: a dictionary.

    A keyword may end in the unit of its value: ``visibility`` and ``visibility_m`` are the same.

    >>> import octant
    >>> octant.setting_names()["sun_elevation"]
    'height of the sun above the horizon'
    """
    return {name.replace("-", "_"): meaning for name, _, meaning in _octant.known_settings()}


def _setting_name(keyword):
    name = keyword.replace("_", "-")
    if name in _forms():
        return name
    for unit in ("-deg", "-m", "-s", "-px"):
        if name.endswith(unit) and name[: -len(unit)] in _forms():
            return name[: -len(unit)]
    return name  # refused by the library, with the name that is meant


def _words(keyword, value, form):
    """A value as the words of an option."""
    if isinstance(value, (bool, np.bool_)):
        return ["true" if value else "false"]
    if isinstance(value, str):
        return [value]
    if isinstance(value, os.PathLike):
        return [os.fspath(value)]
    if isinstance(value, (int, np.integer)):
        return [str(int(value))]
    if isinstance(value, (float, np.floating)):
        return [repr(float(value))]
    if isinstance(value, (list, tuple, np.ndarray)):
        words = [_words(keyword, each, "")[0] for each in value]
        if form.startswith("WIDTHx"):
            return ["x".join(words)]
        if keyword != "aircraft":
            return [",".join(words)]
        if words:
            return words
    raise ValueError(f"{keyword}: expected a text, a number, True, False or several of them, got {value!r}")


def _setting_words(settings):
    """Keywords as pairs of a setting's name and a word; what is None is left at its default."""
    pairs = []
    for keyword, value in settings.items():
        if value is not None:
            name = _setting_name(keyword)
            if any(name == known for known, _ in pairs):
                raise ValueError(f"{keyword}: expected each setting once, got {name} twice")
            pairs += [(name, word) for word in _words(keyword, value, _forms().get(name, ""))]
    return pairs


def _in_keywords(text, settings):
    """What the library says, with keywords in place of the names of settings: those that were given, else x_y of x-y."""
    given = {_setting_name(keyword): keyword for keyword in settings}
    begin = re.match(r"[a-z0-9-]+(?=:)", text)
    if begin and begin[0] in given:
        text = given[begin[0]] + text[begin.end() :]
    keywords = {name: name.replace("-", "_") for name in _forms() if "-" in name}
    keywords.update((name, keyword) for name, keyword in given.items() if "-" in name)
    names = "|".join(re.escape(name) for name in sorted(keywords, key=len, reverse=True))
    return re.sub(rf"(?<![\w/.-])({names})(?![\w/.-])", lambda found: keywords[found[0]], text)


def _load(function, settings, *arguments, stacklevel=3):
    """What a function of the library loads by settings. Its notes become warnings, at 3 of the caller's caller."""
    try:
        loaded, notes = function(*arguments)
    except Error as fault:
        raise Error(_in_keywords(str(fault), settings)) from None
    for note in notes:
        warnings.warn(_in_keywords(note, settings), UserWarning, stacklevel=stacklevel)
    return loaded


# Attitudes and arrays.


def _array(name, value):
    try:
        return np.asarray(value)
    except ValueError as fault:
        raise ValueError(f"{name}: expected an array, got lists of different lengths") from fault


def _path(name, value):
    """A path as text."""
    try:
        return os.fsdecode(value)
    except TypeError:
        raise ValueError(f"{name}: expected a text or a path, got {value!r}") from None


def _several(name, value, what, kinds=str):
    """One or several of `what`, as a tuple."""
    if isinstance(value, kinds):
        return (value,)
    try:
        return tuple(value)
    except TypeError:
        raise ValueError(f"{name}: expected {what} or several, got {value!r}") from None


def _numbers(name, value):
    array = _array(name, value)
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name}: expected an array of numbers, got values of type {array.dtype}")
    return array.astype(np.float64)


def _whole(name, value, least=0, most=2**63 - 1):
    try:
        number = operator.index(value)
    except TypeError:
        raise ValueError(f"{name}: expected a whole number, got {value!r}") from None
    if not least <= number <= most:
        raise ValueError(f"{name}: expected a whole number from {least} to {most}, got {number}")
    return number


def _broadcast(names, values):
    return _together(names, [_numbers(name, value) for name, value in zip(names, values)])


def _together(names, arrays):
    try:
        return np.broadcast_arrays(*arrays)
    except ValueError as fault:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in zip(names, arrays))
        raise ValueError(f"expected arrays of shapes that go together, got {shapes}") from fault


def _rows(name, value, width):
    """As an array of shape (..., width)."""
    array = _numbers(name, value)
    if array.ndim < 1 or array.shape[-1] != width:
        raise ValueError(f"{name}: expected an array of shape (..., {width}), got {array.shape}")
    return array


def _row_count(name, value):
    array = _numbers(name, value)
    return array.shape[0] if array.ndim > 1 else 1


def _by_row(function, name, value, width, result_width):
    rows = _rows(name, value, width)
    return function(rows.reshape(-1, width)).reshape(rows.shape[:-1] + (result_width,))


def attitudes(heading_deg: ArrayLike = 0.0, pitch_deg: ArrayLike = 0.0, bank_deg: ArrayLike = 0.0) -> _Floats:
    """Attitudes of headings (clockwise from north), pitch (nose up) and bank (to the right), in degrees.

    The arrays are broadcast against each other: shape (...) gives (..., 4) float64, w, x, y, z.

    >>> import octant
    >>> octant.attitudes(heading_deg=[0, 90], pitch_deg=-10).shape
    (2, 4)
    """
    angles = _broadcast(("heading_deg", "pitch_deg", "bank_deg"), (heading_deg, pitch_deg, bank_deg))
    flat = np.stack(angles, axis=-1)
    return _octant.attitudes(flat.reshape(-1, 3)).reshape(flat.shape[:-1] + (4,))


def look_at(eye: ArrayLike, target: ArrayLike) -> _Floats:
    """Attitudes of cameras at `eye` that look at `target`, the horizon level; north is up in vertical looks.

    eye, target: (..., 3), metres, broadcast against each other. Returns (..., 4) float64.

    >>> import octant
    >>> bool(abs(octant.look_at([0, 0, 0], [0, 5, 0]) - octant.attitudes(heading_deg=0)).max() < 1e-12)
    True
    """
    eyes, targets = _together(("eye", "target"), [_rows("eye", eye, 3), _rows("target", target, 3)])
    return _octant.look_at(eyes.reshape(-1, 3), targets.reshape(-1, 3)).reshape(eyes.shape[:-1] + (4,))


def to_opencv(attitude: ArrayLike) -> _Floats:
    """The same orientations for cameras with OpenCV's axes (x right, y down, z forward): camera to world.

    attitude: (..., 4). Returns (..., 4) float64.

    >>> import octant
    >>> q = octant.attitudes(heading_deg=[10, 20])
    >>> bool(abs(octant.from_opencv(octant.to_opencv(q)) - q).max() < 1e-12)
    True
    """
    return _by_row(_octant.to_opencv, "attitude", attitude, 4, 4)


def to_opengl(attitude: ArrayLike) -> _Floats:
    """The same orientations for cameras with OpenGL's axes (x right, y up, z backward): camera to world.

    attitude: (..., 4). Returns (..., 4) float64.
    """
    return _by_row(_octant.to_opengl, "attitude", attitude, 4, 4)


def from_opencv(camera_to_world: ArrayLike) -> _Floats:
    """Attitudes of cameras whose axes are OpenCV's. camera_to_world: (..., 4). Returns (..., 4) float64."""
    return _by_row(_octant.from_opencv, "camera_to_world", camera_to_world, 4, 4)


def from_opengl(camera_to_world: ArrayLike) -> _Floats:
    """Attitudes of cameras whose axes are OpenGL's. camera_to_world: (..., 4). Returns (..., 4) float64."""
    return _by_row(_octant.from_opengl, "camera_to_world", camera_to_world, 4, 4)


# States of aircraft.


class States:
    """Where aircraft are: arrays of one shape (...), as made by octant.states().

    position_m, velocity_mps: (..., 3). attitude: (..., 4). time_s, load_factor, is_present: (...). kind: a tuple with
    the kinds along the last axis, or None. Indexing gives the states of a part: ``states[0].position_m``.
    """

    __slots__ = ("position_m", "attitude", "velocity_mps", "time_s", "load_factor", "is_present", "kind")

    position_m: _Floats
    attitude: _Floats
    velocity_mps: _Floats
    time_s: _Floats
    load_factor: _Floats
    is_present: NDArray[np.bool_]
    kind: Optional[tuple[str, ...]]

    _widths = {"position_m": 3, "attitude": 4, "velocity_mps": 3, "time_s": 1, "load_factor": 1, "is_present": 1}

    def __init__(self, arrays: dict[str, NDArray[Any]], kind: Optional[tuple[str, ...]] = None) -> None:
        for name in self._widths:
            setattr(self, name, arrays[name])
        self.kind = kind

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the arrays, without the axis of a vector's parts."""
        return self.position_m.shape[:-1]

    def __len__(self) -> int:
        if not self.shape:
            raise TypeError("a single state has no len()")
        return self.shape[0]

    def __getitem__(self, index: Any) -> States:
        if not self.shape:
            raise IndexError("a single state has no parts")
        kind = self.kind[index] if self.kind is not None and len(self.shape) == 1 else None
        kind = (kind,) if isinstance(kind, str) else kind
        return States({name: getattr(self, name)[index] for name in self._widths}, kind)

    def __iter__(self) -> Iterator[States]:
        return (self[i] for i in range(len(self)))

    def __repr__(self):
        return f"<octant.States of shape {self.shape}>"

    def _flat(self, name):
        return np.asarray(getattr(self, name)).astype(np.float64).reshape(-1, self._widths[name])


def states(
    position_m: ArrayLike,
    attitude: ArrayLike = (1.0, 0.0, 0.0, 0.0),
    kind: Union[str, Sequence[str], None] = None,
    *,
    velocity_mps: ArrayLike = 0.0,
    time_s: ArrayLike = 0.0,
    load_factor: ArrayLike = 1.0,
    is_present: ArrayLike = True,
) -> States:
    """States of aircraft, for World.set_states() and render(states=).

    position_m: (a, 3) for a aircraft, (n, a, 3) for n pictures of them, metres. attitude: (..., 4). velocity_mps:
    (..., 3) (bends what follows the motion), time_s (turns rotors), load_factor, is_present (False: not drawn): (...);
    all are broadcast to the shape of position_m. kind: the kind of each aircraft, as "f15"; without it, states are
    those of the world's aircraft in their order. Raises ValueError.

    >>> import octant
    >>> octant.states(position_m=[[0, 0, 500], [50, 0, 500]], kind=["f15", "f15"])
    <octant.States of shape (2,)>
    """
    positions = _rows("position_m", position_m, 3)
    shape = positions.shape[:-1]

    def spread(name, value, width):
        array = _array(name, value) if name == "is_present" else _numbers(name, value)
        if array.dtype.kind not in "bfiu":
            raise ValueError(f"{name}: expected True or False, got values of type {array.dtype}")
        to = shape + ((width,) if width > 1 else ())
        try:
            return np.array(np.broadcast_to(array, to), dtype=bool if name == "is_present" else np.float64)
        except ValueError as fault:
            raise ValueError(f"{name}: expected an array of shape {to}, got {array.shape}") from fault

    arrays = {
        "position_m": positions,
        "attitude": spread("attitude", attitude, 4),
        "velocity_mps": spread("velocity_mps", velocity_mps, 3),
        "time_s": spread("time_s", time_s, 1),
        "load_factor": spread("load_factor", load_factor, 1),
        "is_present": spread("is_present", is_present, 1),
    }
    for name in ("position_m", "attitude", "velocity_mps", "time_s", "load_factor"):
        wrong = arrays[name][~np.isfinite(arrays[name])]
        if wrong.size:
            raise ValueError(f"{name}: expected finite numbers, got {wrong[0]}")
    if kind is not None:
        count = shape[-1] if shape else 1
        kind = (kind,) * count if isinstance(kind, str) else _several("kind", kind, "a kind")
        if len(kind) != count:
            raise ValueError(f"kind: expected {count} kinds, got {len(kind)}")
    return States(arrays, kind)


# Pictures.


class Frames:
    """The arrays of a batch of n pictures, first index = picture, rows from the top, C-contiguous.

    rgb: (n, height, width, 3) uint8, or uint16 with Camera(bits=16). depth_m: (n, height, width) float32, along the
    optical axis; inf where the sky is. class_id: uint8, a place in octant.classes. object_id: uint32, 0 = none,
    i = World.objects[i - 1]. normal: (n, height, width, 3) float32, world axes, towards the eye; 0, 0, 0 for the sky.
    flow_px: (n, height, width, 2) float32, how far the point moved since the previous picture, right and down; NaN
    unknown. coverage: float32, the share of the pixel that the object fills. Arrays that were not asked for raise
    AttributeError.
    """

    rgb: NDArray[Any]
    depth_m: NDArray[np.float32]
    class_id: NDArray[np.uint8]
    object_id: NDArray[np.uint32]
    normal: NDArray[np.float32]
    flow_px: NDArray[np.float32]
    coverage: NDArray[np.float32]

    def __init__(self, arrays: dict[str, NDArray[Any]]) -> None:
        self._arrays = dict(arrays)

    @classmethod
    def empty(cls, camera: Camera, count: int, outputs: Union[str, Sequence[str]] = ("rgb",)) -> Frames:
        """Arrays for `count` pictures of a camera, for render(out=)."""
        arrays = {}
        count = _whole("count", count)
        for name in _checked_outputs(outputs):
            dtype, values = _formats[name]
            if name == "rgb" and camera.bits == 16:
                dtype = np.uint16
            arrays[name] = np.empty((count, camera.height, camera.width) + values, dtype)
        return cls(arrays)

    @property
    def outputs(self) -> tuple[str, ...]:
        """The names of its arrays."""
        return tuple(self._arrays)

    @property
    def arrays(self) -> dict[str, NDArray[Any]]:
        """Its arrays by name: a dictionary."""
        return dict(self._arrays)

    def __len__(self) -> int:
        return len(next(iter(self._arrays.values())))

    def __getattr__(self, name):
        if name in output_names:
            arrays = self.__dict__.get("_arrays", {})
            if name in arrays:
                return arrays[name]
            raise AttributeError(f"{name}: not among the outputs of these frames, {', '.join(arrays)}")
        raise AttributeError(f"'Frames' object has no attribute '{name}'")

    def __repr__(self):
        return f"<octant.Frames: {len(self)} pictures, {', '.join(self.outputs)}>"


def _checked_outputs(outputs):
    outputs = _several("outputs", outputs, "a name")
    if not outputs:
        raise ValueError(f"outputs: expected some of {', '.join(output_names)}, got none")
    for name in outputs:
        if name not in output_names:
            raise ValueError(f"outputs: expected some of {', '.join(output_names)}, got {name!r}")
    return tuple(dict.fromkeys(outputs))


class Ground:
    """The ground of a world: heights and places."""

    def __init__(self, world: World) -> None:
        self._of = world

    @property
    def half_extent_m(self) -> tuple[float, float]:
        """Half the extent of the map, east and north, metres."""
        return self._of._opened().half_extent_m()

    def height_m(self, x_m: ArrayLike, y_m: ArrayLike) -> _Floats:
        """Heights of the ground above datum, metres; NaN outside the map. The arrays are broadcast: (...) float64."""
        east, north = _broadcast(("x_m", "y_m"), (x_m, y_m))
        return self._of._opened().height_m(east.ravel(), north.ravel()).reshape(east.shape)

    def random_positions(
        self, count: int, above_ground_m: tuple[float, float] = (30.0, 300.0), seed: int = 0
    ) -> _Floats:
        """Positions above the inner 80 % of the map: (count, 3) float64, metres.

        above_ground_m: the least and greatest height above the ground. The same for the same seed, and the first of
        many as of few.
        """
        heights = _numbers("above_ground_m", above_ground_m)
        if heights.shape != (2,) or not np.isfinite(heights).all() or heights[0] > heights[1]:
            raise ValueError(f"above_ground_m: expected the least and the greatest height, got {heights.tolist()}")
        opened = self._of._opened()
        count, seed = _whole("count", count), _whole("seed", seed)
        return opened.random_positions(count, float(heights[0]), float(heights[1]), seed)


class World:
    """Terrain, things on it, aircraft and light, loaded.

    terrain: hills, canyon, background60, none, or a map file. aircraft: names or files, one for each aircraft.
    triangles: of the ground in each picture. settings: all others of ``octant fly`` by keyword, as
    ``near_detail=False, visibility_m=8000`` (setting_names()). May be used by several threads at once; ends by close()
    or with a ``with`` statement, after which its use is a ValueError. Raises octant.Error.

    >>> import octant
    >>> with octant.World(terrain="hills", aircraft=["f15"], scenery=False) as world:
    ...     [object.kind for object in world.objects]
    ['f15']
    """

    def __init__(
        self,
        terrain: _Path = "hills",
        aircraft: Union[_Path, Sequence[_Path]] = (),
        *,
        sun_elevation_deg: Optional[float] = None,
        triangles: Optional[int] = None,
        **settings: Any,
    ) -> None:
        aircraft = _several("aircraft", aircraft, "a name", (str, os.PathLike))
        named = {"sun_elevation_deg": sun_elevation_deg, "triangles": triangles}
        words = [_path("aircraft", each) for each in aircraft]
        self._made_of = (_path("terrain", terrain), words, {**named, **settings})
        self._begin(None)

    def _begin(self, shared: Any) -> None:
        terrain, aircraft, settings = self._made_of
        self._world = _load(_octant.load, settings, terrain, aircraft, _setting_words(settings), shared, stacklevel=4)
        self._objects: Optional[list[Object]] = None

    def _opened(self):
        if self._world.is_closed:
            raise ValueError("world: expected an open world, got a closed one")
        return self._world

    def close(self) -> None:
        """Gives the world up. Calls that run in other threads end in order; later ones are ValueErrors."""
        self._world.close()

    def __enter__(self) -> World:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def copy(self) -> World:
        """A world that shares everything with this one but the states of aircraft."""
        copy = World.__new__(World)
        copy._world = self._opened().copy()
        copy._objects = self._objects
        copy._made_of = self._made_of
        return copy

    __copy__ = copy

    def with_settings(self, **changes: Any) -> World:
        """A world of the same terrain and aircraft under settings of which some are others, with the states that it
        begins with. Takes what World() takes by keyword. What both have in common is shared and not loaded again: under
        another sun heights, roads and aircraft, which leaves some hundredths of a second and 5 MB.

        >>> import octant
        >>> with octant.World(terrain="hills", scenery=False, sun_elevation_deg=50) as noon:
        ...     evening = noon.with_settings(sun_elevation_deg=6)
        """
        terrain, aircraft, settings = self._made_of
        other = World.__new__(World)
        other._made_of = (terrain, aircraft, {**settings, **changes})
        other._begin(self._opened())
        return other

    @property
    def ground(self) -> Ground:
        """Heights and places: octant.Ground."""
        self._opened()
        return Ground(self)

    @property
    def objects(self) -> list[Object]:
        """The things that object ids name: a list of octant.Object; id i is objects[i - 1]."""
        opened = self._opened()
        if self._objects is None:
            self._objects = opened.objects()
        return list(self._objects)

    @property
    def states(self) -> States:
        """Where the aircraft are: octant.States of shape (aircraft,)."""
        return States(self._opened().states(), tuple(each.kind for each in self.objects))

    def set_states(self, states: States) -> None:
        """Moves the aircraft. Those before are where they were in the previous picture (flow_px).

        states: octant.states(...) of shape (a,). With kinds, each state is that of the next aircraft of its kind;
        aircraft without a state are absent. Raises ValueError for more states than aircraft.
        """
        if not isinstance(states, States) or len(states.shape) > 1:
            raise ValueError(f"states: expected octant.states() of shape (aircraft,), got {states!r}")
        self._opened().set_states(self._ordered("states", states))

    def _ordered(self, name, given):
        """States in the order of the world's aircraft, all of them, from those of some kinds."""
        if given is None:
            return None
        if not isinstance(given, States):
            raise ValueError(f"{name}: expected octant.states(), got {type(given).__name__}")
        count = given.shape[-1] if given.shape else 1
        kinds = [each.kind for each in self.objects]
        if count > len(kinds):
            raise ValueError(f"{name}: expected at most {len(kinds)} aircraft, got {count}")
        places = list(range(count))
        if given.kind is not None:
            free = list(range(len(kinds)))
            for number, kind in enumerate(given.kind):
                place = next((place for place in free if kinds[place] == kind), None)
                if place is None:
                    raise ValueError(f"{name}: expected kinds of the world's aircraft {kinds}, got {list(given.kind)}")
                free.remove(place)
                places[number] = place
        if places == list(range(len(kinds))):
            return given
        before = given.shape[:-1]
        arrays = {}
        for member, width in States._widths.items():
            tail = (width,) if width > 1 else ()
            whole = np.zeros(before + (len(kinds),) + tail, bool if member == "is_present" else np.float64)
            if member == "attitude":
                whole[..., 0] = 1.0
            part = np.asarray(getattr(given, member)).reshape(before + (count,) + tail)
            if tail:
                whole[..., places, :] = part
            else:
                whole[..., places] = part
            arrays[member] = whole
        return States(arrays, tuple(kinds))

    def render(
        self,
        camera: Camera,
        eye: ArrayLike,
        look: ArrayLike,
        *,
        previous_eye: Optional[ArrayLike] = None,
        previous_look: Optional[ArrayLike] = None,
        velocity_mps: Optional[ArrayLike] = None,
        turn_rate_degps: Optional[ArrayLike] = None,
        outputs: Union[str, Sequence[str], None] = None,
        out: Optional[Frames] = None,
        threads: int = 0,
        states: Optional[States] = None,
        previous_states: Optional[States] = None,
        seed: int = 0,
        first_index: int = 0,
    ) -> Frames:
        """Draws n pictures and returns octant.Frames. Lets go of Python's lock; Ctrl-C ends it between pictures.

        camera: octant.Camera. eye: (n, 3) or (3,), metres. look: (n, 4) or (4,), attitudes. previous_eye,
        previous_look: where each camera was before, for flow_px. velocity_mps, turn_rate_degps (body axes): (n, 3) or
        (3,), move the camera while its shutter is open. outputs: names, ["rgb"] unless out has others. out: Frames to
        write into. threads: 0 = one for each processor. states, previous_states: octant.states(...) of shape (a,) for
        all pictures or (n, a); those of set_states() otherwise. seed, first_index: of the camera's noise; the noise of
        a picture is that of the seed and first_index + its number.

        Raises ValueError for arrays of wrong shape, type or size and for numbers that are not finite.
        """
        opened = self._opened()
        if not isinstance(camera, Camera):
            raise ValueError(f"camera: expected an octant.Camera, got {type(camera).__name__}")
        if out is None:
            count = max(_row_count("eye", eye), _row_count("look", look))
            out = Frames.empty(camera, count, ("rgb",) if outputs is None else outputs)
        elif not isinstance(out, Frames):
            raise ValueError(f"out: expected octant.Frames, got {type(out).__name__}")
        arrays = out.arrays
        if outputs is not None:
            wanted = _checked_outputs(outputs)
            missing = [name for name in wanted if name not in arrays]
            if missing:
                raise ValueError(f"out: expected arrays for {', '.join(wanted)}, got none for {', '.join(missing)}")
            arrays = {name: arrays[name] for name in wanted}
        opened.render(
            camera,
            eye,
            look,
            arrays,
            previous_eye=previous_eye,
            previous_look=previous_look,
            velocity_mps=velocity_mps,
            turn_rate_degps=turn_rate_degps,
            threads=_whole("threads", threads, most=1024),
            states=self._ordered("states", states),
            previous_states=self._ordered("previous_states", previous_states),
            seed=_whole("seed", seed),
            first_index=_whole("first_index", first_index),
        )
        return out

    def boxes(
        self,
        camera: Camera,
        eye: ArrayLike,
        look: ArrayLike,
        *,
        velocity_mps: Optional[ArrayLike] = None,
        turn_rate_degps: Optional[ArrayLike] = None,
        threads: int = 0,
        states: Optional[States] = None,
    ) -> list[list[Box]]:
        """Boxes of the objects in each of n pictures: a list of lists of octant.Box. Arguments as of render().

        What is visible is what render() shows as object_id, through a distorted lens and a rolling shutter, too; the
        whole box, its corners and its distance are those of eye and look.
        """
        if not isinstance(camera, Camera):
            raise ValueError(f"camera: expected an octant.Camera, got {type(camera).__name__}")
        opened = self._opened()
        threads = _whole("threads", threads, most=1024)
        return opened.boxes(
            camera,
            eye,
            look,
            velocity_mps=velocity_mps,
            turn_rate_degps=turn_rate_degps,
            threads=threads,
            states=self._ordered("states", states),
        )

    def local(self, latitude_deg: ArrayLike, longitude_deg: ArrayLike, height_m: ArrayLike = 0.0) -> _Floats:
        """Positions in the world of places on the earth: (..., 3) float64, metres. The arrays are broadcast.

        height_m: above datum. Raises octant.Error for a world that lies nowhere.
        """
        names = ("latitude_deg", "longitude_deg", "height_m")
        place = np.stack(_broadcast(names, (latitude_deg, longitude_deg, height_m)), axis=-1)
        return self._opened().local(place.reshape(-1, 3)).reshape(place.shape)

    def geodetic(self, position_m: ArrayLike) -> _Floats:
        """Latitude and longitude in degrees and height above datum of positions: (..., 3) float64.

        position_m: (..., 3). Raises octant.Error for a world that lies nowhere.
        """
        return _by_row(self._opened().geodetic, "position_m", position_m, 3, 3)

    def path_states(self, rate_hz: float = 20.0) -> States:
        """The path of the settings (path=, place=, heading_deg=) over the ground: octant.States of shape (n,).

        One each 1 / rate_hz seconds from its start, and the one at its end.
        """
        rate = _numbers("rate_hz", rate_hz)
        if rate.ndim != 0:
            raise ValueError(f"rate_hz: expected a number, got an array of shape {rate.shape}")
        return States(self._opened().path_states(float(rate)))

    def export(
        self,
        path: _Path,
        camera: Optional[Camera] = None,
        eye: Optional[ArrayLike] = None,
        look: Optional[ArrayLike] = None,
    ) -> None:
        """Writes the triangles that a picture shows as OBJ: a group for each class and object.

        The ground is refined for the picture. Without camera, eye and look: all of the map, from above its centre.
        """
        opened = self._opened()
        east_m, north_m = opened.half_extent_m()
        if eye is None:
            eye = (0.0, 0.0, np.nan_to_num(opened.height_m([0.0], [0.0])[0]) + max(east_m, north_m))
        look = attitudes(pitch_deg=-90.0) if look is None else look
        camera = Camera(512, 512, fov_deg=90.0) if camera is None else camera
        opened.export_scene(_path("path", path), camera, eye, look)


# Flights.


class Timing:
    """What the stages of a frame took: frame_ms, sim_ms, plan_ms, draw_ms, read_ms, milliseconds of wall time."""

    __slots__ = ("frame_ms", "sim_ms", "plan_ms", "draw_ms", "read_ms")

    frame_ms: float
    sim_ms: float
    plan_ms: float
    draw_ms: float
    read_ms: float

    def __init__(self, values: dict[str, float]) -> None:
        for name in self.__slots__:
            setattr(self, name, values[name])

    def __repr__(self):
        return f"<octant.Timing: frame {self.frame_ms:.2f} ms>"


class Frame:
    """A frame of a flight: number, time_s, rgb ((height, width, 3) uint8), states (octant.States), timing."""

    __slots__ = ("number", "time_s", "rgb", "states", "timing")

    number: int
    time_s: float
    rgb: NDArray[np.uint8]
    states: States
    timing: Timing

    def __init__(self, flight: Any) -> None:
        self.number = flight.frame
        self.time_s = flight.time_s
        self.rgb = flight.rgb()
        self.states = States(flight.states())
        self.timing = Timing(flight.timing())

    def __repr__(self):
        return f"<octant.Frame {self.number} at {self.time_s:.3f} s>"


class Flight:
    """The frames of octant.fly(), one for each step of a loop. close() ends it before its last frame.

    len() is the number of frames of the whole flight.
    """

    def __init__(self, path: _Path, record: Optional[_Path], settings: dict[str, Any]) -> None:
        settings = {"path": path, **settings}
        folder = "" if record is None else _path("record", record)
        self._flight = _load(_octant.load_flight, settings, _setting_words(settings), folder)

    def __len__(self) -> int:
        return self._flight.frame_count if self._flight is not None else 0

    def __iter__(self) -> Iterator[Frame]:
        return self

    def __next__(self) -> Frame:
        if self._flight is None:
            raise StopIteration
        if not self._flight.next():
            self.close()
            raise StopIteration
        return Frame(self._flight)

    def close(self) -> None:
        """Ends the flight; a recording then gets its report."""
        if self._flight is not None:
            flight, self._flight = self._flight, None
            flight.finish()

    def __enter__(self) -> Flight:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def fly(path: _Path = "straight", *, record: Optional[_Path] = None, **settings: Any) -> Flight:
    """Flies a path and gives its frames one after the other: octant.Flight, for a loop.

    path: straight, jinking, pop-up, turn, a path file or a recorded track. record: the folder of a recording, which
    must not be there. settings: those of ``octant fly`` by keyword, as ``aircraft="f15", terrain="canyon",
    view="chase", size=(640, 360)``. The frames are those of ``octant fly`` with the same settings. Raises octant.Error.

    >>> import octant
    >>> for frame in octant.fly("turn", terrain="none", size=(64, 48), frames=2):
    ...     print(frame.number, frame.rgb.shape)
    0 (48, 64, 3)
    1 (48, 64, 3)
    """
    return Flight(path, record, settings)


def report(recordings: Union[_Path, Sequence[_Path]], out: _Path) -> None:
    """Writes one page of one recording or several, as ``octant report`` does. Raises octant.Error.

    recordings: folders, packed recordings or captured frame times. out: the HTML file.
    """
    recordings = _several("recordings", recordings, "a recording", (str, os.PathLike))
    _octant.write_report([_path("recordings", each) for each in recordings], _path("out", out))


def recording(path: _Path) -> Recording:
    """A recording of ``octant fly --record`` or fly(record=): octant.Recording. path: its folder or packed file.

    Raises octant.Error where there is none, with the file and line of what is wrong.
    """
    from ._recording import Recording

    return Recording(path)


class PilotedAircraft:
    """A built-in aircraft flown by hand, in steps of 1/120 s, from a state on.

    aircraft: as "f15". start: octant.states() of one aircraft, with its velocity. Raises octant.Error for an aircraft
    that has no flight model.
    """

    def __init__(self, aircraft: str, start: States) -> None:
        if not isinstance(aircraft, str):
            raise ValueError(f"aircraft: expected a name, got {aircraft!r}")
        if not isinstance(start, States):
            raise ValueError(f"start: expected octant.states() of one aircraft, got {type(start).__name__}")
        self._aircraft = _octant.PilotedAircraft(aircraft, start)

    def advance(self, roll: float, pitch: float, throttle: float, yaw: float, steps: int = 1) -> None:
        """Flies on for some steps of 1/120 s. roll, pitch, yaw: -1 to 1; throttle (or collective): 0 to 1."""
        self._aircraft.advance((roll, pitch, throttle, yaw), _whole("steps", steps, most=2**31 - 1))

    @property
    def state(self) -> States:
        """Where it is: octant.States of a single state."""
        return States(self._aircraft.state())[0]

    @property
    def trim_throttle(self) -> float:
        """The throttle that holds speed and height from the start on with centred controls."""
        return self._aircraft.trim_throttle

    @property
    def is_stalled(self) -> bool:
        """Whether more lift is asked for than the wing has."""
        return self._aircraft.is_stalled

    @property
    def is_at_limit(self) -> bool:
        """Whether load factor, roll rate, bank, speed or climb is held at its limit."""
        return self._aircraft.is_at_limit


class Picture:
    """An (height, width, 3) or (height, width) uint8 array as a picture that notebooks show. save() writes a PNG file.

    >>> import numpy, octant
    >>> octant.Picture(numpy.zeros((2, 3, 3), numpy.uint8)).png()[:4]
    b'\\x89PNG'
    """

    array: NDArray[np.uint8]

    def __init__(self, array: ArrayLike) -> None:
        self.array = np.ascontiguousarray(_array("array", array))
        is_picture = self.array.ndim == 2 or self.array.ndim == 3 and self.array.shape[2] == 3
        if self.array.dtype != np.uint8 or not is_picture or self.array.size == 0:
            raise ValueError(
                f"array: expected (height, width, 3) or (height, width) of uint8, "
                f"got {self.array.shape} of {self.array.dtype}"
            )

    def png(self) -> bytes:
        """The bytes of a PNG file."""
        height, width = self.array.shape[:2]
        colour_type = 2 if self.array.ndim == 3 else 0
        rows = self.array.reshape(height, -1)
        unfiltered = np.concatenate([np.zeros((height, 1), np.uint8), rows], axis=1).tobytes()

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        header = struct.pack(">IIBBBBB", width, height, 8, colour_type, 0, 0, 0)
        return (
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(unfiltered)) + chunk(b"IEND", b"")
        )

    def save(self, path: _Path) -> None:
        """Writes a PNG file."""
        with open(path, "wb") as file:
            file.write(self.png())

    _repr_png_ = png
