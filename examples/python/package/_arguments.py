# SPDX-License-Identifier: MIT
"""Checks of arguments. A message has one line: "function: argument = value must ..."."""
from __future__ import annotations

import operator
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ids = NDArray[np.int64]


def short(value: Any) -> str:
    """A value on one line, of at most 60 characters."""
    if isinstance(value, np.ndarray) and value.size > 6:
        return f"(array of the shape {value.shape})"
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def refuse(function: str, argument: str, value: Any, expectation: str) -> NoReturn:
    raise ValueError(f"{function}: {argument} = {short(value)} {expectation}") from None


def number(function: str, argument: str, value: Any) -> float:
    """A number; strings and arrays are refused."""
    if isinstance(value, (str, bytes, bool)):
        refuse(function, argument, value, "must be a number")
    try:
        return float(value)
    except (TypeError, ValueError):
        refuse(function, argument, value, "must be a number")


def positive(function: str, argument: str, value: Any) -> float:
    x = number(function, argument, value)
    if not (np.isfinite(x) and x > 0):
        refuse(function, argument, value, "must be finite and > 0")
    return x


def integer(function: str, argument: str, value: Any, least: int = 0) -> int:
    if isinstance(value, bool):
        refuse(function, argument, value, f"must be an integer >= {least}")
    try:
        k = operator.index(value)
    except TypeError:
        refuse(function, argument, value, f"must be an integer >= {least}")
    if k < least or k >= 2**63:
        refuse(function, argument, value, f"must be an integer >= {least}")
    return k


def body(function: str, argument: str, value: Any) -> int:
    if isinstance(value, bool):
        refuse(function, argument, value, "must be the id of a body")
    try:
        k = operator.index(value)
    except TypeError:
        refuse(function, argument, value, "must be the id of a body")
    if k < 0 or k >= 2**63:
        refuse(function, argument, value, "must be the id of a body")
    return k


def flag(function: str, argument: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        refuse(function, argument, value, "must be True or False")
    return bool(value)


def choice(function: str, argument: str, value: Any, names: tuple[str, ...]) -> str:
    if value not in names or not isinstance(value, str):
        refuse(function, argument, value, f"must be one of {', '.join(map(repr, names))}")
    return value


def path(function: str, argument: str, value: Any) -> str:
    import os
    try:
        return os.fsdecode(os.fspath(value))
    except TypeError:
        refuse(function, argument, value, "must be a path")


def numbers(function: str, argument: str, value: Any, what: str) -> Floats:
    """An array of floats of any shape."""
    try:
        array = np.asarray(value)
    except ValueError:  # ragged
        refuse(function, argument, value, f"must be {what}")
    if array.dtype.kind not in "fiu":
        refuse(function, argument, value, f"must be {what}")
    return np.asarray(array, dtype=np.float64, order="C")  # a number stays an array without axes


def vector(function: str, argument: str, value: Any, size: int) -> Floats:
    """A vector of this many numbers; of one, a number will do."""
    what = "a number" if size == 1 else f"{size} numbers"
    array = numbers(function, argument, value, what)
    if size == 1 and array.ndim == 0:
        array = array.reshape(1)
    if array.shape != (size,):
        refuse(function, argument, value, f"must be {what}")
    return array


def rows(function: str, argument: str, value: Any, columns: int, count: int | None = None) -> Floats:
    """An array of the shape (n, columns); one row stands for itself."""
    n = "n" if count is None else str(count)
    what = f"an array of the shape ({n}, {columns})"
    array = numbers(function, argument, value, what)
    if array.ndim == 1 and array.shape == (columns,) and count in (None, 1):
        array = array.reshape(1, columns)
    if array.ndim != 2 or array.shape[1] != columns or (count is not None and array.shape[0] != count):
        refuse(function, argument, value, f"must be {what}")
    return array


def each(function: str, argument: str, value: Any, count: int) -> Floats:
    """One number for all, or one for each of `count`."""
    what = f"a number or an array of the shape ({count},)"
    array = numbers(function, argument, value, what)
    if array.ndim == 0:
        return np.full(count, float(array))
    if array.shape != (count,):
        refuse(function, argument, value, f"must be {what}")
    return array


def each_integer(function: str, argument: str, value: Any, count: int) -> Ids:
    """One integer for all, or one for each of `count`."""
    what = f"an integer or {count} integers"
    try:
        array = np.asarray(value)
    except ValueError:
        refuse(function, argument, value, f"must be {what}")
    if array.size == 0 and count == 0:
        return np.zeros(0, dtype=np.int64)
    if array.dtype.kind not in "iu":
        refuse(function, argument, value, f"must be {what}")
    array = array.astype(np.int64)
    if array.ndim == 0:
        return np.full(count, int(array), dtype=np.int64)
    if array.shape != (count,):
        refuse(function, argument, value, f"must be {what}")
    return np.ascontiguousarray(array)


def ids(function: str, argument: str, value: Any) -> Ids:
    """The ids of bodies, or one id."""
    try:
        array = np.atleast_1d(np.asarray(value))
    except ValueError:
        refuse(function, argument, value, "must be ids of bodies")
    if array.size == 0:
        return np.zeros(0, dtype=np.int64)
    if array.dtype.kind not in "iu" or array.ndim != 1:
        refuse(function, argument, value, "must be ids of bodies")
    return np.ascontiguousarray(array, dtype=np.int64)
