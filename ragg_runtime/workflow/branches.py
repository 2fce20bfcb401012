"""The history of a model as branches: where undo and redo lead."""

from __future__ import annotations

from collections.abc import Sequence

from ragg_runtime.base.errors import UserError
from ragg_runtime.model_dir.history import Step


def text_of(history: Sequence[Step], step: int) -> str:
    """model.toml as it was after a step; UserError if that was not kept."""
    if not history[step].text:
        raise UserError(
            "that state was not kept: an older version made the step",
            found=f"step {step + 1}",
            remedy="remove effects one by one instead",
        )
    return history[step].text


def branches(history: Sequence[Step]) -> tuple[list[int], list[int]]:
    """Steps on the present branch, and those that undo has left and redo would come back to (nearest last).

    Undo and redo are steps themselves: nothing is ever taken out of a history.
    """
    past: list[int] = []
    future: list[int] = []
    for n, s in enumerate(history):
        if s.action == "calibrate":
            continue  # the model stays as it is
        if s.action == "undo" and len(past) > 1:
            future.append(past.pop())
        elif s.action == "redo" and future:
            past.append(future.pop())
        else:
            past.append(n)
            future.clear()
    return past, future


NO_STATES = ("undo", "redo", "calibrate")
"""Steps after which the model is one that it was before."""


def tree(history: Sequence[Step]) -> dict[int, tuple[int | None, int]]:
    """Of every step that made a state: that from which it was made, and the lane in which it is drawn.

    The first step from a state goes on in its lane, each further one begins a lane of its own.
    """
    found: dict[int, tuple[int | None, int]] = {}
    lanes = 0
    for n, s in enumerate(history):
        if s.action in NO_STATES:
            continue
        past, _ = branches(history[:n])
        origin: int | None = past[-1] if past else None
        if s.action == "restore" and s.effect.isdigit() and int(s.effect) in found:
            origin = int(s.effect)
        taken = any(parent == origin for parent, _ in found.values())
        lane = lanes if origin is None or taken else found[origin][1]
        lanes = max(lanes, lane + 1)
        found[n] = (origin, lane)
    return found
