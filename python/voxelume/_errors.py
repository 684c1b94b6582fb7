# SPDX-License-Identifier: Apache-2.0
"""The one exception of the package."""


class Error(Exception):
    """A call that failed. `str(error)` is a finished sentence: where, what, and what to do.

    The parts of the place that it is about are data, too; those that don't apply are empty or 0.
    """

    #: "render", "usage", "scene", "input", "output", "device", "build", "limit" or "cancelled".
    kind: str
    #: The file of the scene, mesh, image or volume.
    file: str
    #: The line of the file, from 1 on.
    line: int
    #: The column of the line, from 1 on.
    column: int
    #: The path of a value in a scene: "objects[0].material".
    key: str

    def __init__(self, sentence: str, kind: str = "usage", file: str = "", line: int = 0,
                 column: int = 0, key: str = "") -> None:
        super().__init__(sentence, kind, file, line, column, key)
        self.kind = kind
        self.file = file
        self.line = line
        self.column = column
        self.key = key

    def __str__(self) -> str:
        return str(self.args[0])
