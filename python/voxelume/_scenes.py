# SPDX-License-Identifier: Apache-2.0
"""Scenes from dicts, files and arrays."""
from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._arguments import choice, path, paths, shown, whole
from ._arguments import size as checked_size
from ._arguments import text as _text
from ._colors import voxel_bytes
from ._errors import Error
from ._native import Scene

#: The forms of a scene: a Scene, a dict like a scene file, or the path of a scene or a model file.
SceneLike = Union[Scene, Mapping[str, Any], str, "os.PathLike[str]"]

Arrays = dict[str, npt.NDArray[np.uint8]]


def _plain(value: Any) -> Any:
    """Values of numpy as those that JSON has."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError


def _fault(value: Any, key: str, depth: int = 0) -> Error | None:
    """What of a value JSON can't have, by its key."""
    where = f"{key}: " if key else ""
    if isinstance(value, float) and not math.isfinite(value):
        return Error(f"scene: {where}must be a finite number, not {value}", "scene", key=key)
    if depth > 100:
        return Error(f"scene: {where}is too deep, or holds itself", "scene", key=key)
    if isinstance(value, dict):
        for name, inner in value.items():
            if not isinstance(name, str):
                return Error(f"scene: {where}a key is a text, not {shown(name)}", "scene", key=key)
            if fault := _fault(inner, f"{key}.{name}" if key else name, depth + 1):
                return fault
    elif isinstance(value, (list, tuple)):
        for i, inner in enumerate(value):
            if fault := _fault(inner, f"{key}[{i}]", depth + 1):
                return fault
    elif value is not None and not isinstance(value, (str, int, float)):
        try:
            return _fault(_plain(value), key, depth + 1)
        except TypeError:
            return Error(f"scene: {where}can't be a {type(value).__name__}: {shown(value)}",
                         "scene", key=key)
    return None


def _json(value: Any, key: str = "") -> str:
    """The value as JSON; Error names the key of what JSON can't have."""
    try:
        return json.dumps(value, default=_plain, allow_nan=False)
    except (TypeError, ValueError, RecursionError) as error:
        raise _fault(value, key) or Error(f"scene: {error}", "scene", key=key) from None


def _without_arrays(scene: Mapping[str, Any], arrays: Arrays) -> dict[str, Any]:
    """The scene with names in place of arrays of voxels, which go to `arrays`."""
    result = dict(scene)
    models = result.get("models")
    if not isinstance(models, Mapping):
        return result
    result["models"] = dict(models)
    for name, model in models.items():
        if not isinstance(model, Mapping) or not isinstance(model.get("voxels"), np.ndarray):
            continue
        array_name = f"array of {name}"
        arrays[array_name] = voxel_bytes(model["voxels"])
        result["models"][name] = {**model, "voxels": array_name}
    return result


def _texts(changes: Any) -> dict[str, str]:
    """Changes of a scene's values, as JSON."""
    if changes is None:
        return {}
    if not isinstance(changes, Mapping):
        raise Error(f"changes are a dict of paths and values, not {shown(changes)}")
    return {_text("a path of changes", name): _json(value, name) for name, value in changes.items()}


def scene(source: SceneLike, *, assets: Sequence[str | os.PathLike[str]] = (),
          changes: Mapping[str, Any] | None = None, size: tuple[int, int] | None = None,
          samples: int | None = None, light: str | None = None) -> Scene:
    """Makes a scene of a dict, or of a scene's or model's file, and checks it.

    A dict is what the JSON of a scene file is; scenes/README.md describes it. Numbers and lists may
    be numpy's. The "voxels" of a model may be an array, as `voxels` takes one; its axes are those
    of the model, Y up, and a voxel is 1 m long unless "fit" or "unit" says otherwise.

    `assets` are folders in which files are looked for; those that a dict names are looked for in
    the working folder first. `changes` replaces values: {"objects.ball.position": [0, 1, 0]}.
    `size`, `samples` and `light` replace those of "render".

    Raises Error of the kind "scene" with the key, and for files with line and column.
    """
    if isinstance(source, Scene):
        if changes:
            raise Error("a finished scene can't be changed: give its file or dict instead")
        made = source
    else:
        texts = _texts(changes)
        folders = paths("assets", assets)
        if isinstance(source, Mapping):
            arrays: Arrays = {}
            scene_text = _json(_without_arrays(source, arrays))
            made = _native.parse_scene(scene_text, "scene", False, folders, texts, arrays)
        elif isinstance(source, (str, bytes, os.PathLike)):
            made = _native.load_scene(path("scene", source), folders, texts)
        else:
            raise Error("a scene is a Scene, a dict, or the path of a file, not "
                        f"{shown(source)}; `voxels` draws arrays")
    if size is not None:
        made = made.with_size(checked_size("size", size))
    if samples is not None:
        made = made.with_samples(whole("samples", samples, 1, 4096))
    return made if light is None else made.with_light(choice("light", light, ("local", "global")))


def parse_scene(text: str, name: str = "scene", *,
                assets: Sequence[str | os.PathLike[str]] = ()) -> Scene:
    """Makes a scene of the text of a scene file; `name` names it in messages."""
    return _native.parse_scene(_text("text", text), _text("name", name), True,
                               paths("assets", assets), {}, {})
