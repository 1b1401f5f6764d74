"""What can go wrong: each exception has the command's message, the place, the key and a hint."""

from __future__ import annotations

__all__ = [
    "AleGearError",
    "ArgumentError",
    "InexactError",
    "InputError",
    "InternalError",
    "NoResultError",
    "SceneError",
]


class AleGearError(Exception):
    """Base of all."""

    message: str
    """One line: what, where, what was expected; as the command says it."""
    file: str | None
    """The file that is meant."""
    line: int | None
    """Its line, from 1."""
    key: str | None
    """The key of the scene, or the argument."""
    hint: str | None
    """What to do next."""
    excerpt: str | None
    """The line with a mark below what is meant."""
    result: object
    """The result that failed a check, where there is one."""

    def __init__(
        self,
        message: str,
        *,
        file: str | None = None,
        line: int | None = None,
        key: str | None = None,
        hint: str | None = None,
        excerpt: str | None = None,
    ) -> None:
        super().__init__(message)
        self.message = message
        self.file = file
        self.line = line
        self.key = key
        self.hint = hint
        self.excerpt = excerpt
        self.result = None

    def __str__(self) -> str:
        parts = [self.message, self.excerpt, f"hint: {self.hint}" if self.hint else None]
        return "\n".join(part for part in parts if part)


class SceneError(AleGearError, ValueError):
    """A scene, a plan or an optimisation says what cannot be."""


class InputError(AleGearError, ValueError):
    """Any other input is wrong: a mesh, a folder, a file."""


class ArgumentError(AleGearError, TypeError, ValueError):
    """An argument of a function is of no use to it."""


class NoResultError(AleGearError, RuntimeError):
    """The input is fine, but there is no result, or the result failed a check (then `result` has it)."""


class InexactError(NoResultError):
    """The result is there (`result`), less exact than was asked."""


class InternalError(AleGearError, RuntimeError):
    """A fault of this program."""
