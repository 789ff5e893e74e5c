# SPDX-License-Identifier: MIT
from typing import Any, Callable, List, Literal, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

_Floats = Union[npt.NDArray[np.float32], npt.NDArray[np.float64]]
_Bits = Optional[npt.NDArray[np.uint32]]
_Filter = Union[_Bits, Tuple[_Bits, _Bits]]
_Ids = npt.NDArray[np.uint64]
_Pairs = npt.NDArray[np.uint32]
_Offsets = Union[npt.NDArray[np.int64], npt.NDArray[np.uint64]]
_Invalid = Literal["skip", "raise"]
_Method = Literal["planned", "hybrid"]
_Callback = Callable[[_Pairs], object]
_Lengths = Union[None, float, _Floats]

__version__: str

class Executor:
    def __init__(self, threads: Optional[int] = None) -> None: ...
    @property
    def threads(self) -> int: ...

class Stats:
    @property
    def boxes(self) -> int: ...
    @property
    def invalid(self) -> int: ...
    @property
    def pairs(self) -> int: ...
    @property
    def nodes(self) -> int: ...
    @property
    def cells(self) -> int: ...
    @property
    def records(self) -> int: ...
    @property
    def tests(self) -> int: ...
    @property
    def over_budget(self) -> int: ...

class WorldStats:
    @property
    def proxies(self) -> int: ...
    @property
    def invalid(self) -> int: ...
    @property
    def moved(self) -> int: ...
    @property
    def pairs(self) -> int: ...
    @property
    def begun(self) -> int: ...
    @property
    def ended(self) -> int: ...
    @property
    def search(self) -> Stats: ...

class Detector:
    def __init__(
        self, executor: Optional[Executor] = None, *, method: _Method = "planned", cutoff: int = 0
    ) -> None: ...
    def find_pairs(
        self,
        boxes: _Floats,
        other: Optional[_Floats] = None,
        groups: _Filter = None,
        masks: _Filter = None,
        *,
        invalid: _Invalid = "skip",
    ) -> _Pairs: ...
    def find_pairs_in_sets(
        self,
        boxes: _Floats,
        offsets: _Offsets,
        other: Optional[_Floats] = None,
        other_offsets: Optional[_Offsets] = None,
        groups: _Filter = None,
        masks: _Filter = None,
        *,
        invalid: _Invalid = "skip",
    ) -> Tuple[_Pairs, npt.NDArray[np.uint64]]: ...
    def stream_pairs(
        self,
        boxes: _Floats,
        callback: _Callback,
        other: Optional[_Floats] = None,
        groups: _Filter = None,
        masks: _Filter = None,
        *,
        block: int = 65536,
        invalid: _Invalid = "skip",
    ) -> int: ...
    def find_near_pairs(self, balls: _Floats, distance: float, *, invalid: _Invalid = "skip") -> _Pairs: ...
    def stream_near_pairs(
        self,
        balls: _Floats,
        distance: float,
        callback: _Callback,
        *,
        block: int = 65536,
        invalid: _Invalid = "skip",
    ) -> int: ...
    @property
    def stats(self) -> Stats: ...
    @property
    def scratch_bytes(self) -> int: ...

class World:
    def __init__(
        self,
        dtype: npt.DTypeLike = "float32",
        executor: Optional[Executor] = None,
        sticky_filters: bool = False,
        *,
        method: _Method = "planned",
        cutoff: int = 0,
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def dtype(self) -> np.dtype[Any]: ...
    def create(
        self,
        boxes: _Floats,
        groups: _Bits = None,
        masks: _Bits = None,
        users: Optional[npt.NDArray[np.uint64]] = None,
        *,
        invalid: _Invalid = "skip",
    ) -> _Ids: ...
    def move(self, ids: _Ids, boxes: _Floats, *, invalid: _Invalid = "skip") -> int: ...
    def destroy(self, ids: _Ids) -> int: ...
    def set_filters(self, ids: _Ids, groups: _Bits = None, masks: _Bits = None) -> int: ...
    def clear(self) -> None: ...
    def update(self) -> WorldStats: ...
    def contains(self, ids: _Ids) -> npt.NDArray[np.bool_]: ...
    def boxes(self, ids: _Ids) -> npt.NDArray[Any]: ...
    def users(self, ids: _Ids) -> npt.NDArray[np.uint64]: ...
    @property
    def bounds(self) -> npt.NDArray[Any]: ...
    @property
    def begun(self) -> _Ids: ...
    @property
    def ended(self) -> _Ids: ...
    @property
    def pairs(self) -> _Ids: ...
    def query_boxes(self, boxes: _Floats) -> Tuple[npt.NDArray[np.int64], _Ids]: ...
    def query_rays(
        self, origins: _Floats, directions: _Floats, lengths: _Lengths = None
    ) -> Tuple[npt.NDArray[np.int64], _Ids, npt.NDArray[Any]]: ...
    def cast_rays(
        self, origins: _Floats, directions: _Floats, lengths: _Lengths = None
    ) -> Tuple[_Ids, npt.NDArray[Any]]: ...
    def query_nearest(self, points: _Floats, count: int = 1) -> _Ids: ...

def find_pairs(
    boxes: _Floats,
    other: Optional[_Floats] = None,
    groups: _Filter = None,
    masks: _Filter = None,
    *,
    executor: Optional[Executor] = None,
    invalid: _Invalid = "skip",
) -> _Pairs: ...
def find_pairs_in_sets(
    boxes: _Floats,
    offsets: _Offsets,
    other: Optional[_Floats] = None,
    other_offsets: Optional[_Offsets] = None,
    groups: _Filter = None,
    masks: _Filter = None,
    *,
    executor: Optional[Executor] = None,
    invalid: _Invalid = "skip",
) -> Tuple[_Pairs, npt.NDArray[np.uint64]]: ...
def stream_pairs(
    boxes: _Floats,
    callback: _Callback,
    other: Optional[_Floats] = None,
    groups: _Filter = None,
    masks: _Filter = None,
    *,
    block: int = 65536,
    executor: Optional[Executor] = None,
    invalid: _Invalid = "skip",
) -> int: ...
def find_near_pairs(
    balls: _Floats, distance: float, *, executor: Optional[Executor] = None, invalid: _Invalid = "skip"
) -> _Pairs: ...
def stream_near_pairs(
    balls: _Floats,
    distance: float,
    callback: _Callback,
    *,
    block: int = 65536,
    executor: Optional[Executor] = None,
    invalid: _Invalid = "skip",
) -> int: ...
def simd_target() -> str: ...

class Simulated(NamedTuple):
    poses: npt.NDArray[np.float64]
    pairs: List[_Pairs]

def simulate(scene: str, steps: int = 100, *, broadphase: str = "boxstream") -> Simulated: ...
