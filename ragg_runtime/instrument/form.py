"""What a model keeps, from ``[model]`` of model.toml: at which order, and whose rotation its accelerometers feel."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ragg_runtime.base.errors import UserError, at, check_keys, did_you_mean

KINEMATICS = ("platform", "full")
MOUNTING: tuple[int | str, ...] = (1, 2, "exact")
MISALIGNMENT: tuple[int | str, ...] = (1, "exact")
ANGLE_ORIGINS = ("zero", "first-sample")


@dataclass(frozen=True)
class Form:
    """The table ``[model]``; what it leaves out is the paper's.

    ``kinematics``: ``platform`` (Eq. 9) or ``full`` (of the disc, which turns). ``mounting``: power to which rotations
    are kept, or ``exact``. ``misalignment``: 1 (C of Eq. 2) or ``exact``. ``second_order_angles``: whether second-order
    terms see the force along the axes as they are.
    """

    kinematics: str = "platform"
    mounting: int | str = 1
    misalignment: int | str = 1
    second_order_angles: bool = False

    @property
    def preset(self) -> str | None:
        """``paper`` or ``exact``, if the order is one of these."""
        return next((name for name, order in PRESETS.items() if order == self.order), None)

    @property
    def order(self) -> Mapping[str, int | str | bool]:
        return {
            "mounting": self.mounting,
            "misalignment": self.misalignment,
            "second_order_angles": self.second_order_angles,
        }

    def as_json(self) -> dict[str, object]:
        return {"kinematics": self.kinematics, "order": dict(self.order)}

    def in_short(self) -> str:
        """For a table: what is beyond the paper's order, if it has no name."""
        beyond = [(k, v) for k, v in self.order.items() if v != PAPER.order[k]]
        kept = (f"{k.replace('_', ' ')}{'' if v is True else f' {v}'}" for k, v in beyond)
        return f"{self.kinematics}, {self.preset or ', '.join(kept)}"

    def words(self) -> str:
        """In half a sentence."""
        order = self.preset or ", ".join(f"{k} = {_toml(v)}" for k, v in self.order.items())
        return f"kinematics {self.kinematics}, order {order}"


PAPER = Form()

PRESETS: Mapping[str, Mapping[str, int | str | bool]] = {
    "paper": PAPER.order,
    "exact": Form(mounting="exact", misalignment="exact", second_order_angles=True).order,
}


def read_form(table: object, path: Path | None = None) -> Form:
    """``[model]`` of a parsed model.toml; ``None``: it is not there, which means the paper's."""
    if table is None:
        return PAPER
    if not isinstance(table, dict):
        raise UserError("model must be a table", where=path, found=repr(table), expected="[model]")
    where = at(path, "[model]")
    check_keys(table, ("kinematics", "order", "angle_origin"), where)
    kinematics = _one_of(table.get("kinematics", PAPER.kinematics), KINEMATICS, f"{where} kinematics")
    order = table.get("order", "paper")
    where = f"{where} order"
    if isinstance(order, str):
        return Form(
            kinematics=str(kinematics), **dict[str, Any](PRESETS[str(_one_of(order, tuple(PRESETS), where))])
        )
    if not isinstance(order, dict):
        raise UserError("the order is not understood", where=where, found=repr(order), expected=_EXPECTED)
    check_keys(order, tuple(PAPER.order), where)
    known: dict[str, tuple[int | str | bool, ...]] = {
        "mounting": MOUNTING,
        "misalignment": MISALIGNMENT,
        "second_order_angles": (True, False),
    }
    chosen = {k: _one_of(v, known[k], f"{where}: {k}") for k, v in order.items()}
    return Form(kinematics=str(kinematics), **dict[str, Any]({**PAPER.order, **chosen}))


def read_angle_origin(table: object, path: Path | None = None) -> str | None:
    """``angle_origin`` of the table ``[model]`` that :func:`read_form` has read; ``None``: it is not there."""
    if not isinstance(table, dict) or "angle_origin" not in table:
        return None
    return str(_one_of(table["angle_origin"], ANGLE_ORIGINS, f"{at(path, '[model]')} angle_origin"))


_EXPECTED = '"paper", "exact" or { mounting = 1, misalignment = 1, second_order_angles = false }'


def _one_of(found: object, known: tuple[int | str | bool, ...], where: str) -> int | str | bool:
    for value in known:
        if type(found) is type(value) and found == value:  # true is no 1
            return value
    shown = " or ".join(_toml(v) for v in known)
    near = did_you_mean(found, [v for v in known if isinstance(v, str)]) if isinstance(found, str) else None
    raise UserError("no such choice", where=where, found=repr(found), expected=shown, remedy=near)


def _toml(value: object) -> str:
    return f'"{value}"' if isinstance(value, str) else str(value).lower()
