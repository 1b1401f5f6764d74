"""Progress of a run: to a function of the caller, or as a bar of tqdm where that is installed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .errors import ArgumentError


class _Bar:
    """One bar a phase."""

    def __init__(self, tqdm: Any) -> None:
        self._tqdm = tqdm
        self._bar: Any = None
        self._phase: str | None = None

    def __call__(self, phase: str, done: int, total: int | None, message: str) -> None:
        if phase != self._phase:
            self.close()
            self._phase = phase
            self._bar = self._tqdm(total=total, desc=phase, leave=False)
        self._bar.update(done - self._bar.n)
        if message:
            self._bar.set_postfix_str(message, refresh=False)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None


def callback(progress: Any) -> Callable[[str, int, int | None, str], object] | None:
    """What is called with phase, steps done, all steps (None: not known) and a message; None: nothing."""
    if progress is None or progress is False:
        return None
    if progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            return None
        return _Bar(tqdm)
    if callable(progress):
        told: Callable[[str, int, int | None, str], object] = progress
        return told
    raise ArgumentError(
        f"`progress` is {type(progress).__name__}, wanted is a function or True",
        key="progress",
        hint="a function of phase, done, total and message; True for a bar of tqdm",
    )


def finish(progress: object) -> None:
    """The work is done."""
    if isinstance(progress, _Bar):
        progress.close()
