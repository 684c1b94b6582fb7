# SPDX-License-Identifier: Apache-2.0
"""Arguments of calls, checked: what is wrong is said in a sentence that names the argument."""
from __future__ import annotations

import math
import operator
import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeVar

import numpy as np

from ._errors import Error

_Function = TypeVar("_Function", bound=Callable[..., object])

#: The maximum number that the library accepts as a frame, a size or a count.
MAX_WHOLE = 2**31 - 1


def shown(value: Any) -> str:
    """The value for a message: short, whatever it is."""
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def number(name: str, value: Any, maximum: float = math.inf) -> float:
    """A finite number of Python or numpy, from -maximum to maximum."""
    if not isinstance(value, (bool, np.bool_, str, bytes)):
        try:
            result = float(value)
        except (TypeError, ValueError, OverflowError):
            result = math.nan
        if math.isfinite(result) and abs(result) <= maximum:
            return result
    kind = ("a finite number" if math.isinf(maximum)
            else f"a number from {-maximum:g} to {maximum:g}")
    raise Error(f"{name} is {kind}, not {shown(value)}")


def whole(name: str, value: Any, minimum: int = -MAX_WHOLE, maximum: int = MAX_WHOLE) -> int:
    """A whole number within bounds."""
    if not isinstance(value, (bool, np.bool_)):
        try:
            result = operator.index(value)
        except TypeError:
            pass
        else:
            if minimum <= result <= maximum:
                return result
    raise Error(f"{name} is a whole number from {minimum} to {maximum}, not {shown(value)}")


def items(name: str, value: Any, what: str, count: int | None = None) -> list[Any]:
    """The items of a list, a tuple or an array, and not of a text."""
    if isinstance(value, Iterable) and not isinstance(value, (str, bytes, dict)):
        try:
            result = list(value)
        except TypeError:  # an array without axes
            result = None
        if result is not None and (count is None or len(result) == count):
            return result
    raise Error(f"{name} is {what}, not {shown(value)}")


def size(name: str, value: Any) -> tuple[int, int]:
    """(width, height) in pixels."""
    width, height = items(name, value, "(width, height) in pixels", 2)
    return whole(f"{name}[0]", width, 1), whole(f"{name}[1]", height, 1)


def flag(name: str, value: Any) -> bool:
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise Error(f"{name} is True or False, not {shown(value)}")


def choice(name: str, value: Any, known: Sequence[str]) -> str:
    if isinstance(value, str) and value in known:
        return value
    listed = " or ".join([", ".join(f'"{word}"' for word in known[:-1]), f'"{known[-1]}"'])
    raise Error(f"{name} is {listed}, not {shown(value)}")


def text(name: str, value: Any) -> str:
    if isinstance(value, str) and not any("\ud800" <= letter <= "\udfff" for letter in value):
        return value
    raise Error(f"{name} is a text, not {shown(value)}")


def path(name: str, value: Any) -> str:
    """The path of a file."""
    if isinstance(value, (str, bytes, os.PathLike)):
        result = os.fsdecode(value)
        if result and "\0" not in result:
            return result
    raise Error(f"{name} is the path of a file, not {shown(value)}")


def paths(name: str, value: Any) -> list[str]:
    """One path, or several."""
    if isinstance(value, (str, bytes, os.PathLike)):
        return [path(name, value)]
    each = items(name, value, "a path, or several")
    return [path(f"{name}[{i}]", item) for i, item in enumerate(each)]


def function(name: str, value: _Function | None) -> _Function | None:
    if value is None or callable(value):
        return value
    raise Error(f"{name} is a function or None, not {shown(value)}")


def instance(name: str, value: Any, kind: type) -> None:
    if not isinstance(value, kind):
        raise Error(f"{name} is a voxelume.{kind.__name__}, not {shown(value)}")
