# SPDX-License-Identifier: Apache-2.0
"""Runs the program, and says what is wrong with how it ended."""
import dataclasses
import os
import pathlib
import re
import resource
import signal
import subprocess
import tempfile
import time

CODES = range(9)  # what cli/MANUAL.md documents, but for those of signals
HANG_SECONDS = 300  # kernels may be compiled, on a machine that may be loaded


@dataclasses.dataclass
class Run:
    code: int  # negative: the signal that ended it
    err: str
    wall: float
    cpu: float  # seconds, of it and its helpers
    peak: int  # bytes of the largest of them
    hung: bool = False


def wait_for_group(group):
    """Waits until the linkers that a killed run has started are gone, too."""
    deadline = time.monotonic() + 1  # what nobody asks for its end stays as a number
    while time.monotonic() < deadline:
        try:
            os.killpg(group, 0)
        except (ProcessLookupError, PermissionError):
            return
        time.sleep(0.005)


def run(program, arguments, folder, kill_after=None, environment=None,
        hang_seconds=HANG_SECONDS):
    """Runs `program arguments` in `folder`; kills it after some seconds if those are given."""
    def leave_no_core():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    started = time.monotonic()
    with tempfile.TemporaryFile() as err:
        process = subprocess.Popen([str(program), *arguments], cwd=folder, start_new_session=True,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=err, preexec_fn=leave_no_core,
                                   env={**os.environ, **(environment or {})})
        hung = False
        deadline = kill_after if kill_after is not None else hang_seconds
        while True:
            ended, status, usage = os.wait4(process.pid, os.WNOHANG)
            if ended:
                break
            left = deadline - (time.monotonic() - started)
            if left <= 0:
                hung = kill_after is None
                os.killpg(process.pid, signal.SIGKILL)
                _, status, usage = os.wait4(process.pid, 0)
                wait_for_group(process.pid)
                break
            time.sleep(min(left, 0.002 if kill_after is not None else 0.005))
        process.returncode = os.waitstatus_to_exitcode(status)
        err.seek(0)
        text = err.read().decode("utf-8", "replace")
    return Run(process.returncode, text, time.monotonic() - started,
               usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024, hung)


def files_below(folder):
    """The bytes of each file below a folder, hidden ones included, by its relative path."""
    folder = pathlib.Path(folder)
    return {str(path.relative_to(folder)): path.read_bytes()
            for path in sorted(folder.rglob("*")) if path.is_file()}


def sentence_faults(result):
    """What is wrong with the message of a run that failed."""
    lines = [line for line in result.err.splitlines() if line.strip()]
    errors = [line for line in lines if not line.startswith(("voxelume: warning", "  "))]
    if not errors:
        return ["it says nothing"]
    if len(errors) > 2:
        return [f"it says {len(errors)} lines: {errors[:3]}"]
    if not re.match(r"voxelume: .{10,}", errors[-1]):
        return [f"its last line is no sentence of ours: {errors[-1]!r}"]
    return []


class Tally:
    """Counts runs, and tells each fault once it is found."""

    def __init__(self, name):
        self.name, self.runs, self.faults = name, 0, 0

    def add(self, what, faults):
        self.runs += 1
        for fault in faults:
            self.faults += 1
            print(f"FAULT {self.name}: {what}: {fault}", flush=True)

    def end(self, more=""):
        print(f"{self.name}: {self.runs} runs, {self.faults} faults{more}", flush=True)
        return self.faults
