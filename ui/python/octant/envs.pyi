from collections.abc import Callable, Sequence
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import Camera, World

_Observation = Union[NDArray[Any], dict[str, NDArray[Any]]]
_Info = dict[str, Any]

class Space:
    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    low: NDArray[Any]
    high: NDArray[Any]
    def __init__(self, shape: Sequence[int], dtype: Any, low: float, high: float) -> None: ...
    def seed(self, seed: int) -> None: ...
    def sample(self, seed: Optional[int] = None) -> NDArray[Any]: ...
    def contains(self, value: ArrayLike) -> bool: ...
    def __contains__(self, value: ArrayLike) -> bool: ...

_Space = Union[Space, dict[str, Space]]

class FollowPath:
    metadata: dict[str, Any]
    render_mode: str
    spec: None
    camera: Camera
    outputs: tuple[str, ...]
    world: World
    step_s: float
    observation_space: _Space
    action_space: Space
    def __init__(
        self,
        path: str = "turn",
        aircraft: str = "500md",
        camera: Optional[Camera] = None,
        terrain: str = "hills",
        *,
        view: str = "nose",
        outputs: Union[str, Sequence[str]] = ("rgb",),
        step_s: float = 0.1,
        start_error_m: float = 5.0,
        threads: int = 0,
        **settings: Any,
    ) -> None: ...
    def reset(self, *, seed: Optional[int] = None, options: Any = None) -> tuple[_Observation, _Info]: ...
    def step(self, action: ArrayLike) -> tuple[_Observation, float, bool, bool, _Info]: ...
    def render(self) -> NDArray[Any]: ...
    def close(self) -> None: ...
    @property
    def unwrapped(self) -> FollowPath: ...
    def __enter__(self) -> FollowPath: ...
    def __exit__(self, *_: object) -> None: ...

class Batch:
    envs: list[FollowPath]
    num_envs: int
    single_observation_space: _Space
    single_action_space: Space
    observation_space: _Space
    action_space: Space
    def __init__(self, make: Callable[[], FollowPath], count: int) -> None: ...
    def reset(
        self, *, seed: Union[int, Sequence[int], None] = None, options: Any = None
    ) -> tuple[_Observation, _Info]: ...
    def step(
        self, actions: ArrayLike
    ) -> tuple[_Observation, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], _Info]: ...
    def close(self) -> None: ...
    def __enter__(self) -> Batch: ...
    def __exit__(self, *_: object) -> None: ...

def batch(make: Callable[[], FollowPath], count: int) -> Batch: ...
