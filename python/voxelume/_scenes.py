# SPDX-License-Identifier: Apache-2.0
"""Scenes from dicts, files and arrays."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._colors import voxel_bytes
from ._errors import Error
from ._native import Scene

#: What a scene may be given as: a Scene, a dict as a scene file has it, or the path of a scene or
#: of a model file.
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
    raise Error(f"a scene can't hold a {type(value).__name__}: {value!r}", kind="scene")


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
        texts = {path: json.dumps(value, default=_plain)
                 for path, value in (changes or {}).items()}
        folders = [os.fspath(folder) for folder in assets]
        if isinstance(source, Mapping):
            arrays: Arrays = {}
            text = json.dumps(_without_arrays(source, arrays), default=_plain)
            made = _native.parse_scene(text, "scene", False, folders, texts, arrays)
        else:
            made = _native.load_scene(os.fspath(source), folders, texts)
    if size is not None:
        made = made.with_size(size)
    if samples is not None:
        made = made.with_samples(samples)
    return made if light is None else made.with_light(light)


def parse_scene(text: str, name: str = "scene", *,
                assets: Sequence[str | os.PathLike[str]] = ()) -> Scene:
    """Makes a scene of the text of a scene file; `name` names it in messages."""
    return _native.parse_scene(text, name, True, [os.fspath(folder) for folder in assets], {}, {})
