# SPDX-License-Identifier: MIT
from array import array
from mmap import mmap
from typing import Any, Callable, List, Literal, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

_Numbers = npt.ArrayLike
_Integers = npt.ArrayLike
_Bits = Optional[_Integers]
_Filter = Union[_Bits, Tuple[_Bits, _Bits]]
_Ids = npt.NDArray[np.uint64]
_Pairs = npt.NDArray[Any]
_Offsets = npt.NDArray[np.int64]
_Indices = npt.DTypeLike
_Invalid = Literal["warn", "skip", "raise"]
_Method = Literal["planned", "hybrid"]
_Callback = Callable[[_Pairs], object]
_Lengths = Optional[_Numbers]
_Saved = Union[bytes, bytearray, memoryview, mmap, array[Any], npt.NDArray[Any]]

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

class InvalidBoxesWarning(UserWarning): ...

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
        boxes: _Numbers,
        other: Optional[_Numbers] = None,
        groups: _Filter = None,
        masks: _Filter = None,
        *,
        ids: _Bits = None,
        ids_a: _Bits = None,
        ids_b: _Bits = None,
        closed: bool = True,
        tolerance: float = 0.0,
        dimensions: Literal[1, 2, 3] = 3,
        dtype: _Indices = "int64",
        max_pairs: Optional[int] = None,
        copy: Optional[bool] = None,
        invalid: _Invalid = "warn",
    ) -> _Pairs: ...
    def find_neighbours(
        self,
        boxes: _Numbers,
        other: Optional[_Numbers] = None,
        groups: _Filter = None,
        masks: _Filter = None,
        *,
        both: bool = True,
        ids: _Bits = None,
        ids_a: _Bits = None,
        ids_b: _Bits = None,
        closed: bool = True,
        tolerance: float = 0.0,
        dimensions: Literal[1, 2, 3] = 3,
        dtype: _Indices = "int64",
        copy: Optional[bool] = None,
        invalid: _Invalid = "warn",
    ) -> Tuple[_Offsets, npt.NDArray[Any]]: ...
    def find_pairs_in_sets(
        self,
        boxes: _Numbers,
        offsets: _Integers,
        other: Optional[_Numbers] = None,
        other_offsets: Optional[_Integers] = None,
        groups: _Filter = None,
        masks: _Filter = None,
        *,
        ids: _Bits = None,
        ids_a: _Bits = None,
        ids_b: _Bits = None,
        closed: bool = True,
        tolerance: float = 0.0,
        dimensions: Literal[1, 2, 3] = 3,
        dtype: _Indices = "int64",
        copy: Optional[bool] = None,
        invalid: _Invalid = "warn",
    ) -> Tuple[_Pairs, _Offsets]: ...
    def stream_pairs(
        self,
        boxes: _Numbers,
        callback: _Callback,
        other: Optional[_Numbers] = None,
        groups: _Filter = None,
        masks: _Filter = None,
        *,
        block: int = 65536,
        ids: _Bits = None,
        ids_a: _Bits = None,
        ids_b: _Bits = None,
        closed: bool = True,
        tolerance: float = 0.0,
        dimensions: Literal[1, 2, 3] = 3,
        dtype: _Indices = "int64",
        copy: Optional[bool] = None,
        invalid: _Invalid = "warn",
    ) -> int: ...
    def find_near_pairs(
        self,
        points: _Numbers,
        distance: float,
        *,
        radii: Optional[_Numbers] = None,
        dimensions: Literal[1, 2, 3] = 3,
        dtype: _Indices = "int64",
        max_pairs: Optional[int] = None,
        invalid: _Invalid = "warn",
    ) -> _Pairs: ...
    def stream_near_pairs(
        self,
        points: _Numbers,
        distance: float,
        callback: _Callback,
        *,
        block: int = 65536,
        radii: Optional[_Numbers] = None,
        dimensions: Literal[1, 2, 3] = 3,
        dtype: _Indices = "int64",
        invalid: _Invalid = "warn",
    ) -> int: ...
    @property
    def stats(self) -> Stats: ...
    @property
    def scratch_bytes(self) -> int: ...
    def shrink_to_fit(self) -> None: ...

class BoxIndex:
    def __init__(
        self,
        boxes: _Numbers,
        *,
        dimensions: int = 3,
        copy: Optional[bool] = None,
        invalid: _Invalid = "warn",
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def dtype(self) -> np.dtype[Any]: ...
    @property
    def dimensions(self) -> int: ...
    @property
    def bounds(self) -> npt.NDArray[Any]: ...
    def query_boxes(self, boxes: _Numbers, *, dtype: _Indices = "int64") -> _Pairs: ...
    def query_rays(
        self, origins: _Numbers, directions: _Numbers, lengths: _Lengths = None
    ) -> Tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[Any]]: ...
    def cast_rays(
        self, origins: _Numbers, directions: _Numbers, lengths: _Lengths = None
    ) -> Tuple[npt.NDArray[np.int64], npt.NDArray[Any]]: ...
    def query_nearest(self, points: _Numbers, count: int = 1) -> npt.NDArray[np.int64]: ...
    def save(self) -> bytes: ...
    @staticmethod
    def load(saved: _Saved, *, dimensions: int = 3) -> BoxIndex: ...

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
    def save(self) -> bytes: ...
    @staticmethod
    def load(saved: _Saved, executor: Optional[Executor] = None) -> World: ...
    def create(
        self,
        boxes: _Numbers,
        groups: _Bits = None,
        masks: _Bits = None,
        users: Optional[_Integers] = None,
        *,
        invalid: _Invalid = "warn",
    ) -> _Ids: ...
    def move(self, ids: _Integers, boxes: _Numbers, *, invalid: _Invalid = "skip") -> int: ...
    def destroy(self, ids: _Integers) -> int: ...
    def set_filters(self, ids: _Integers, groups: _Bits = None, masks: _Bits = None) -> int: ...
    def clear(self) -> None: ...
    def shrink_to_fit(self) -> None: ...
    def update(self) -> WorldStats: ...
    def contains(self, ids: _Integers) -> npt.NDArray[np.bool_]: ...
    def boxes(self, ids: _Integers) -> npt.NDArray[Any]: ...
    def users(self, ids: _Integers) -> npt.NDArray[np.int64]: ...
    @property
    def bounds(self) -> npt.NDArray[Any]: ...
    @property
    def begun(self) -> _Ids: ...
    @property
    def ended(self) -> _Ids: ...
    @property
    def pairs(self) -> _Ids: ...
    def query_boxes(self, boxes: _Numbers) -> Tuple[npt.NDArray[np.int64], _Ids]: ...
    def query_rays(
        self, origins: _Numbers, directions: _Numbers, lengths: _Lengths = None
    ) -> Tuple[npt.NDArray[np.int64], _Ids, npt.NDArray[Any]]: ...
    def cast_rays(
        self, origins: _Numbers, directions: _Numbers, lengths: _Lengths = None
    ) -> Tuple[_Ids, npt.NDArray[Any]]: ...
    def query_nearest(self, points: _Numbers, count: int = 1) -> _Ids: ...

def find_pairs(
    boxes: _Numbers,
    other: Optional[_Numbers] = None,
    groups: _Filter = None,
    masks: _Filter = None,
    *,
    ids: _Bits = None,
    ids_a: _Bits = None,
    ids_b: _Bits = None,
    closed: bool = True,
    tolerance: float = 0.0,
    dimensions: Literal[1, 2, 3] = 3,
    dtype: _Indices = "int64",
    max_pairs: Optional[int] = None,
    copy: Optional[bool] = None,
    invalid: _Invalid = "warn",
    executor: Optional[Executor] = None,
) -> _Pairs: ...
def find_neighbours(
    boxes: _Numbers,
    other: Optional[_Numbers] = None,
    groups: _Filter = None,
    masks: _Filter = None,
    *,
    both: bool = True,
    ids: _Bits = None,
    ids_a: _Bits = None,
    ids_b: _Bits = None,
    closed: bool = True,
    tolerance: float = 0.0,
    dimensions: Literal[1, 2, 3] = 3,
    dtype: _Indices = "int64",
    copy: Optional[bool] = None,
    invalid: _Invalid = "warn",
    executor: Optional[Executor] = None,
) -> Tuple[_Offsets, npt.NDArray[Any]]: ...
def find_pairs_in_sets(
    boxes: _Numbers,
    offsets: _Integers,
    other: Optional[_Numbers] = None,
    other_offsets: Optional[_Integers] = None,
    groups: _Filter = None,
    masks: _Filter = None,
    *,
    ids: _Bits = None,
    ids_a: _Bits = None,
    ids_b: _Bits = None,
    closed: bool = True,
    tolerance: float = 0.0,
    dimensions: Literal[1, 2, 3] = 3,
    dtype: _Indices = "int64",
    copy: Optional[bool] = None,
    invalid: _Invalid = "warn",
    executor: Optional[Executor] = None,
) -> Tuple[_Pairs, _Offsets]: ...
def stream_pairs(
    boxes: _Numbers,
    callback: _Callback,
    other: Optional[_Numbers] = None,
    groups: _Filter = None,
    masks: _Filter = None,
    *,
    block: int = 65536,
    ids: _Bits = None,
    ids_a: _Bits = None,
    ids_b: _Bits = None,
    closed: bool = True,
    tolerance: float = 0.0,
    dimensions: Literal[1, 2, 3] = 3,
    dtype: _Indices = "int64",
    copy: Optional[bool] = None,
    invalid: _Invalid = "warn",
    executor: Optional[Executor] = None,
) -> int: ...
def find_near_pairs(
    points: _Numbers,
    distance: float,
    *,
    radii: Optional[_Numbers] = None,
    dimensions: Literal[1, 2, 3] = 3,
    dtype: _Indices = "int64",
    max_pairs: Optional[int] = None,
    invalid: _Invalid = "warn",
    executor: Optional[Executor] = None,
) -> _Pairs: ...
def stream_near_pairs(
    points: _Numbers,
    distance: float,
    callback: _Callback,
    *,
    block: int = 65536,
    radii: Optional[_Numbers] = None,
    dimensions: Literal[1, 2, 3] = 3,
    dtype: _Indices = "int64",
    invalid: _Invalid = "warn",
    executor: Optional[Executor] = None,
) -> int: ...
def simd_target() -> str: ...

class Simulated(NamedTuple):
    poses: npt.NDArray[np.float64]
    pairs: List[_Pairs]

def simulate(scene: str, steps: int = 100, *, broadphase: str = "boxstream") -> Simulated: ...
