from os import PathLike
from typing import Any, Union

from numpy.typing import NDArray

class Recording:
    path: str
    run: dict[str, Any]
    def __init__(self, path: Union[str, PathLike[str]]) -> None: ...
    @property
    def frames(self) -> dict[str, NDArray[Any]]: ...
    @property
    def track(self) -> dict[str, NDArray[Any]]: ...
    @property
    def counters(self) -> dict[str, NDArray[Any]]: ...
