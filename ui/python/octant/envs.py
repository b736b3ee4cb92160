"""Environments to learn in, with the interface of Gymnasium; the package gymnasium is not needed.

>>> import octant
>>> env = octant.envs.FollowPath(path="turn", aircraft="500md", camera=octant.Camera(32, 24), terrain="none")
>>> observation, info = env.reset(seed=1)
>>> observation.shape, observation.dtype
((24, 32, 3), dtype('uint8'))
>>> observation, reward, terminated, truncated, info = env.step([0.0, 0.0, 0.0, 0.0])
>>> 0 <= reward <= 1, terminated, truncated
(True, False, False)
"""

from __future__ import annotations

import math
import numbers
import threading
import weakref
from collections.abc import Callable, Sequence
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

import octant

__all__ = ["Batch", "FollowPath", "Space", "batch"]

_bounds = {
    "rgb": (0, 255),
    "depth_m": (0, np.inf),
    "class_id": (0, len(octant.classes) - 1),
    "object_id": (0, 2**32 - 1),
    "normal": (-1, 1),
    "flow_px": (-np.inf, np.inf),
    "coverage": (0, 1),
}


class Space:
    """Arrays of a shape and dtype with values from low to high, as gymnasium.spaces.Box.

    >>> import octant
    >>> space = octant.envs.Space((4,), "float32", -1, 1)
    >>> space.sample(seed=3).shape, space.contains([0, 0, 0, 2])
    ((4,), False)
    """

    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    low: NDArray[Any]
    high: NDArray[Any]

    def __init__(self, shape: Sequence[int], dtype: Any, low: float, high: float) -> None:
        self.shape = tuple(shape)
        self.dtype = np.dtype(dtype)
        self.low = np.full(self.shape, low, self.dtype)
        self.high = np.full(self.shape, high, self.dtype)
        self._random = np.random.default_rng()

    def seed(self, seed: int) -> None:
        """Begins the samples anew; the same seed gives the same samples."""
        self._random = np.random.default_rng(seed)

    def sample(self, seed: Optional[int] = None) -> NDArray[Any]:
        """An array, evenly distributed; bounds that are infinite count as -1e3 and 1e3. With a seed always the same."""
        if seed is not None:
            self.seed(seed)
        low, high = np.clip(self.low.astype(np.float64), -1e3, None), np.clip(self.high.astype(np.float64), None, 2.0**32)
        high = np.where(np.isinf(self.high.astype(np.float64)), 1e3, high)
        if self.dtype.kind in "iu":
            return self._random.integers(low.astype(np.int64), high.astype(np.int64), endpoint=True).astype(self.dtype)
        return self._random.uniform(low, high).astype(self.dtype)

    def contains(self, value: ArrayLike) -> bool:
        """Whether an array is one of these."""
        value = np.asarray(value)
        return value.shape == self.shape and bool((value >= self.low).all() and (value <= self.high).all())

    def __contains__(self, value: ArrayLike) -> bool:
        return self.contains(value)

    def __eq__(self, other):
        return (
            isinstance(other, Space)
            and (self.shape, self.dtype) == (other.shape, other.dtype)
            and np.array_equal(self.low, other.low)
            and np.array_equal(self.high, other.high)
        )

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self):
        low, high = (self.low.min(), self.high.max()) if self.low.size else ("", "")
        return f"Space({self.shape}, {self.dtype}, {low}, {high})"


_Observation = Union[NDArray[Any], dict[str, NDArray[Any]]]
_Info = dict[str, Any]
_Space = Union[Space, dict[str, Space]]


def _observation_space(camera, outputs, count=None):
    spaces = {}
    empty = octant.Frames.empty(camera, 1, outputs).arrays
    for name in outputs:
        low, high = _bounds[name]
        array = empty[name]
        if array.dtype == np.uint16:
            high = 65535
        spaces[name] = Space(array.shape[1:] if count is None else (count,) + array.shape[1:], array.dtype, low, high)
    return spaces[outputs[0]] if len(outputs) == 1 else spaces


_worlds: weakref.WeakValueDictionary[str, octant.World] = weakref.WeakValueDictionary()
_worlds_lock = threading.Lock()


def _shared_world(terrain, aircraft, settings):
    """One world for all environments of the same settings in this process; each gets a copy with states of its own."""
    key = repr((terrain, aircraft, sorted(settings.items())))
    with _worlds_lock:
        world = _worlds.get(key)
        if world is None:
            world = octant.World(terrain=terrain, aircraft=[aircraft], **settings)
            _worlds[key] = world
    return world


class FollowPath:
    """Flies an aircraft by hand along a path and sees what its camera sees.

    path, aircraft, terrain, settings: as of octant.World; the path lies over the ground as ``octant fly`` lays it.
    The aircraft is a built-in one and flies as in ``octant view``.
    camera: octant.Camera. view: "nose", the forward camera in front of the aircraft, or "chase", behind it.
    outputs: names of render(); observations are the array of one, or a dictionary of several.
    step_s: simulated time of a step, in whole 1/120 s. start_error_m: standard deviation of the start's distance from
    the path's start, each way.

    An action is roll, pitch, collective or throttle, yaw, each -1 to 1 (throttle: -1 = idle, 1 = full).
    The path's point is the one nearest to the aircraft, between 1 s before and 5 s after that of the step before. The
    reward of a step is 1 / (1 + (distance / 25 m) ** 2) * (1 + cos(heading error)) / 2, from 0 to 1; distance is that
    to the path's point, the heading error is that of the velocity from the path's there. `terminated`: the aircraft
    touches the ground or leaves the map; the reward is 0 then. `truncated`: the path's end is reached, or half as much
    time again as it takes has gone by. The same seed and actions give the same results.

    info: time_s; position_m, velocity_mps (3,); attitude (4,); distance_m; heading_error_deg (positive: the aircraft
    flies to the right of the path); above_ground_m; progress, 0 to 1; ahead_m (3,), where the path will be in 2 s from
    its point, body axes forward, right, down; path_speed_mps; trim_throttle, as an action.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"]}
    render_mode = "rgb_array"
    spec = None
    camera: octant.Camera
    outputs: tuple[str, ...]
    world: octant.World
    step_s: float
    observation_space: _Space
    action_space: Space

    def __init__(
        self,
        path: str = "turn",
        aircraft: str = "500md",
        camera: Optional[octant.Camera] = None,
        terrain: str = "hills",
        *,
        view: str = "nose",
        outputs: Union[str, Sequence[str]] = ("rgb",),
        step_s: float = 0.1,
        start_error_m: float = 5.0,
        threads: int = 0,
        **settings: Any,
    ) -> None:
        if view not in ("nose", "chase"):
            raise ValueError(f"view: expected nose or chase, got {view!r}")
        if not isinstance(step_s, numbers.Real) or not 0.5 < step_s * octant._octant.steps_per_second <= 1e8:
            raise ValueError(f"step_s: expected 1/120 s or more, at most 800,000 s, got {step_s!r}")
        self._steps = round(step_s * octant._octant.steps_per_second)
        if not isinstance(start_error_m, numbers.Real) or not 0 <= start_error_m < np.inf:
            raise ValueError(f"start_error_m: expected a number not below 0, got {start_error_m!r}")
        self.camera = octant.Camera(84, 84, fov_deg=80) if camera is None else camera
        self.outputs = octant._checked_outputs(outputs)
        self._shared = _shared_world(terrain, aircraft, {"path": path, **settings})
        self.world = self._shared.copy()
        self.observation_space = _observation_space(self.camera, self.outputs)
        self.action_space = Space((4,), np.float32, -1, 1)
        self.step_s = self._steps / octant._octant.steps_per_second
        self._aircraft_name = aircraft
        self._view = view
        self._start_error_m = start_error_m
        self._threads = threads
        self._random = np.random.default_rng()
        self._path_rate_hz = 20.0
        self._path = self.world.path_states(self._path_rate_hz)
        itself = self.world.objects[0]
        self._below_m = float(itself.box_centre_m[2] + itself.size_m[2] / 2)
        self._nose_m = float(itself.box_centre_m[0] + itself.size_m[0] / 2)
        self._length_m = float(itself.size_m[0])
        self._aircraft = None

    # Motion, apart from pictures: a batch moves all before it draws them in one call.

    def _begin(self, seed):
        if seed is not None:
            self._random = np.random.default_rng(octant._whole("seed", seed))
        offset = self._random.normal(0.0, 1.0, 3) * self._start_error_m
        first = self._path[0]
        place = first.position_m + offset
        ground_m = self.world.ground.height_m(place[0], place[1])
        if np.isfinite(ground_m):
            place[2] = max(place[2], ground_m + self._below_m + 5.0)
        start = octant.states(
            place[None], first.attitude[None], velocity_mps=first.velocity_mps[None], load_factor=first.load_factor
        )
        self._aircraft = octant.PilotedAircraft(self._aircraft_name, start)
        self._trim = 2.0 * self._aircraft.trim_throttle - 1.0
        self._count = 0
        self._point = 0
        self._is_over = False
        self._follow()
        return self._info()

    def _move(self, action):
        """Flies one step. Returns reward, terminated, truncated, info."""
        if self._aircraft is None:
            raise ValueError("step: expected reset() before the first step, got none")
        if self._is_over:
            raise ValueError("step: expected reset() after the last step of an episode, got none")
        action = np.clip(self._checked_action(action), -1.0, 1.0)
        roll, pitch, throttle, yaw = (float(each) for each in action)
        self._aircraft.advance(roll, pitch, (throttle + 1.0) / 2.0, yaw, self._steps)
        self._count += 1
        self._follow()
        terminated = not self._above_ground_m > 0.0
        is_late = self._count * self.step_s > 1.5 * (len(self._path) - 1) / self._path_rate_hz
        truncated = not terminated and (self._point >= len(self._path) - 2 or is_late)
        self._is_over = terminated or truncated
        nearness = 1.0 / (1.0 + (self._distance_m / 25.0) ** 2)
        along = (1.0 + math.cos(math.radians(self._heading_error_deg))) / 2.0
        return (0.0 if terminated else nearness * along), terminated, truncated, self._info()

    @staticmethod
    def _checked_action(action):
        action = octant._numbers("action", action)
        if action.shape != (4,) or not np.isfinite(action).all():
            raise ValueError(f"action: expected four finite numbers, got {action.tolist()}")
        return action

    def _follow(self):
        """Finds the path's point, and where the aircraft is from it."""
        self._state = state = self._aircraft.state
        position = state.position_m
        first = max(0, self._point - int(self._path_rate_hz))
        last = min(len(self._path), self._point + 5 * int(self._path_rate_hz) + 1)
        points = self._path.position_m[first:last]
        self._point = first + int(np.argmin(((points - position) ** 2).sum(axis=1)))
        self._distance_m = self._distance_to_path(position)
        flown, wanted = state.velocity_mps, self._path.velocity_mps[self._point]
        turn = math.degrees(math.atan2(flown[0], flown[1]) - math.atan2(wanted[0], wanted[1]))
        self._heading_error_deg = (turn + 180.0) % 360.0 - 180.0
        ground_m = float(self.world.ground.height_m(position[0], position[1]))
        self._above_ground_m = float(position[2]) - self._below_m - ground_m

    def _distance_to_path(self, position):
        """To the segments before and after the path's point."""
        nearest = math.inf
        for begin in (self._point - 1, self._point):
            if 0 <= begin < len(self._path) - 1:
                a, b = self._path.position_m[begin], self._path.position_m[begin + 1]
                along = b - a
                share = np.clip(np.dot(position - a, along) / max(np.dot(along, along), 1e-12), 0.0, 1.0)
                nearest = min(nearest, float(np.linalg.norm(position - a - share * along)))
        return nearest

    def _info(self):
        state = self._state
        ahead = min(len(self._path) - 1, self._point + 2 * int(self._path_rate_hz))
        return {
            "time_s": self._count * self.step_s,
            "position_m": state.position_m.copy(),
            "velocity_mps": state.velocity_mps.copy(),
            "attitude": state.attitude.copy(),
            "distance_m": self._distance_m,
            "heading_error_deg": self._heading_error_deg,
            "above_ground_m": self._above_ground_m,
            "progress": self._point / (len(self._path) - 1),
            "ahead_m": _to_body(state.attitude, self._path.position_m[ahead] - state.position_m),
            "path_speed_mps": float(np.linalg.norm(self._path.velocity_mps[self._point])),
            "trim_throttle": self._trim,
        }

    def _pose(self):
        """Eye and look of its camera."""
        state = self._state
        if self._view == "nose":
            offset = np.array([self._nose_m + 0.5, 0.0, 0.0])
        else:
            offset = np.array([-2.0 * self._length_m, 0.0, -0.4 * self._length_m])
        return state.position_m + _to_world(state.attitude, offset), state.attitude

    def _observation(self, frames, place):
        arrays = {name: frames.arrays[name][place].copy() for name in self.outputs}
        return arrays[self.outputs[0]] if len(self.outputs) == 1 else arrays

    def _draw(self):
        self.world.set_states(_row_of_states([self]))
        eye, look = self._pose()
        frames = self.world.render(self.camera, eye, look, outputs=self.outputs, threads=self._threads)
        return self._observation(frames, 0)

    # The interface of Gymnasium.

    def reset(self, *, seed: Optional[int] = None, options: Any = None) -> tuple[_Observation, _Info]:
        """Begins an episode at the path's start. Returns the observation and info. options are not used."""
        info = self._begin(seed)
        return self._draw(), info

    def step(self, action: ArrayLike) -> tuple[_Observation, float, bool, bool, _Info]:
        """Flies one step. Returns observation, reward, terminated, truncated, info. Raises ValueError."""
        reward, terminated, truncated, info = self._move(action)
        return self._draw(), reward, terminated, truncated, info

    def render(self) -> NDArray[Any]:
        """The picture that the camera sees, (height, width, 3)."""
        eye, look = self._pose()
        return self.world.render(self.camera, eye, look, threads=self._threads).rgb[0]

    def close(self) -> None:
        """Gives up its world; others that share it go on."""
        self.world.close()

    @property
    def unwrapped(self) -> FollowPath:
        """Itself."""
        return self

    def __enter__(self) -> FollowPath:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _to_world(attitude, vector):
    """Turns a vector from body axes into world axes."""
    w, axis = attitude[0], attitude[1:]
    twice = 2.0 * np.cross(axis, vector)
    return vector + w * twice + np.cross(axis, twice)


def _to_body(attitude, vector):
    return _to_world(attitude * np.array([1.0, -1.0, -1.0, -1.0]), vector)


def _row_of_states(environments):
    """The aircraft of each environment as a picture's states: shape (1,) for one, (n, 1) for several."""
    every = [each._state for each in environments]
    arrays = {name: np.stack([np.asarray(getattr(state, name)) for state in every]) for name in octant.States._widths}
    if len(every) > 1:
        arrays = {name: array[:, None] for name, array in arrays.items()}
    return octant.States(arrays)


class Batch:
    """Several environments that step and are drawn together, as gymnasium.vector.VectorEnv. See batch().

    Observations, rewards, terminated and truncated are arrays with the environment first; info is a dictionary of
    arrays. An environment whose episode ended begins a new one with its next step (that step's action is not used, its
    reward is 0).
    """

    envs: list[FollowPath]
    num_envs: int
    single_observation_space: _Space
    single_action_space: Space
    observation_space: _Space
    action_space: Space

    def __init__(self, make: Callable[[], FollowPath], count: int) -> None:
        count = octant._whole("count", count, least=1)
        self.envs = [make() for _ in range(count)]
        self.num_envs = count
        first = self.envs[0]
        for each in self.envs:
            if each.camera != first.camera or each.outputs != first.outputs:
                raise ValueError("make: expected environments with the same camera and outputs, got different ones")
        self.single_observation_space = first.observation_space
        self.single_action_space = first.action_space
        self.observation_space = _observation_space(first.camera, first.outputs, count)
        self.action_space = Space((count, 4), np.float32, -1, 1)
        self._ended = np.zeros(count, bool)
        # One call of render() for each world; environments of the same settings share one.
        self._groups: dict[int, list[int]] = {}
        for place, each in enumerate(self.envs):
            self._groups.setdefault(id(each._shared), []).append(place)

    def _draw(self):
        first = self.envs[0]
        frames = octant.Frames.empty(first.camera, self.num_envs, first.outputs)
        for places in self._groups.values():
            group = [self.envs[place] for place in places]
            eyes, looks = (np.stack(rows) for rows in zip(*(each._pose() for each in group)))
            drawn = group[0].world.render(
                first.camera,
                eyes,
                looks,
                outputs=first.outputs,
                out=frames if len(self._groups) == 1 else None,
                threads=first._threads,
                states=_row_of_states(group),
            )
            if drawn is not frames:
                for name in first.outputs:
                    frames.arrays[name][places] = drawn.arrays[name]
        arrays = frames.arrays
        return arrays[first.outputs[0]] if len(first.outputs) == 1 else arrays

    @staticmethod
    def _stacked(infos):
        return {name: np.stack([np.asarray(info[name]) for info in infos]) for name in infos[0]}

    def reset(
        self, *, seed: Union[int, Sequence[int], None] = None, options: Any = None
    ) -> tuple[_Observation, _Info]:
        """Begins all episodes, those of environment i with seed + i (or with seed[i]). Returns observations, info."""
        seeds: list[Optional[int]] = [None] * self.num_envs
        if isinstance(seed, (int, np.integer)):
            seeds = [seed + i for i in range(self.num_envs)]
        elif seed is not None:
            seeds = list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"seed: expected {self.num_envs} seeds, got {len(seeds)}")
        infos = [each._begin(one) for each, one in zip(self.envs, seeds)]
        self._ended[:] = False
        return self._draw(), self._stacked(infos)

    def step(
        self, actions: ArrayLike
    ) -> tuple[_Observation, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], _Info]:
        """Flies one step of all; actions: (count, 4). Returns observations, rewards, terminated, truncated, info."""
        rows = octant._numbers("actions", actions)
        if rows.shape != (self.num_envs, 4):
            raise ValueError(f"actions: expected an array of shape ({self.num_envs}, 4), got {rows.shape}")
        if not np.isfinite(rows).all():
            raise ValueError(f"actions: expected finite numbers, got {rows[~np.isfinite(rows)][0]}")
        results = []
        for each, action, has_ended in zip(self.envs, rows, self._ended):
            results.append((0.0, False, False, each._begin(None)) if has_ended else each._move(action))
        rewards, terminated, truncated, infos = zip(*results)
        terminated, truncated = np.array(terminated), np.array(truncated)
        self._ended = terminated | truncated
        return self._draw(), np.array(rewards), terminated, truncated, self._stacked(infos)

    def close(self) -> None:
        """Closes all."""
        for each in self.envs:
            each.close()

    def __enter__(self) -> Batch:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def batch(make: Callable[[], FollowPath], count: int) -> Batch:
    """`count` environments, made by calls of make(), that step and are drawn in one call: octant.envs.Batch.

    >>> import octant
    >>> camera = octant.Camera(16, 16)
    >>> many = octant.envs.batch(lambda: octant.envs.FollowPath(camera=camera, terrain="none"), count=3)
    >>> observations, info = many.reset(seed=1)
    >>> observations.shape, info["distance_m"].shape
    ((3, 16, 16, 3), (3,))
    """
    return Batch(make, count)
