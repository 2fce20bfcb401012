"""The form of a model, from ``[model]`` of model.toml: its order, and whose rotation its accelerometers sense."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal

from ragg_runtime.base.errors import UserError, at, check_choice, check_keys, check_table


@dataclass(frozen=True)
class Form:
    """The table ``[model]``; what it leaves out is the paper's.

    ``kinematics``: ``platform`` (Eq. 9) or ``full`` (of the disc, which turns). ``mounting``: power to which rotations
    are kept, or ``exact``. ``misalignment``: 1 (C of Eq. 2) or ``exact``. ``second_order_angles``: whether second-order
    terms see the force along the axes as they are.
    """

    kinematics: Literal["platform", "full"] = "platform"
    mounting: int | str = 1
    misalignment: int | str = 1
    second_order_angles: bool = False

    @property
    def preset(self) -> str | None:
        """``paper`` or ``exact``, if the order is one of these."""
        return next((name for name, order in PRESETS.items() if order == self.order), None)

    @property
    def order(self) -> Mapping[str, int | str | bool]:
        return {k: v for k, v in asdict(self).items() if k != "kinematics"}

    def words(self) -> str:
        """In half a sentence."""
        order = self.preset or ", ".join(
            f'{k} = "{v}"' if isinstance(v, str) else f"{k} = {str(v).lower()}" for k, v in self.order.items()
        )
        return f"kinematics {self.kinematics}, order {order}"


PAPER = Form()

PRESETS: Mapping[str, Mapping[str, int | str | bool]] = {
    "paper": PAPER.order,
    "exact": Form(mounting="exact", misalignment="exact", second_order_angles=True).order,
}

_CHOICES: Mapping[str, tuple[int | str | bool, ...]] = {
    "mounting": (1, 2, "exact"),
    "misalignment": (1, "exact"),
    "second_order_angles": (True, False),
}


def read_form(table: object, path: Path | None = None) -> tuple[Form, str | None]:
    """``[model]`` of a parsed model.toml, and its ``angle_origin``; ``None``: it is not there, which means the paper's."""
    where = at(path, "[model]")
    table = check_table({} if table is None else table, "model", path, "[model]")
    check_keys(table, ("kinematics", "order", "angle_origin"), where)
    kinematics = check_choice(
        table.get("kinematics", PAPER.kinematics), ("platform", "full"), f"{where} kinematics"
    )
    if "angle_origin" in table:
        check_choice(table["angle_origin"], ("zero", "first-sample"), f"{where} angle_origin")
    order = _read_order(table.get("order", {}), f"{where} order")
    return Form(kinematics=kinematics, **order), table.get("angle_origin")


def _read_order(order: object, where: str) -> dict[str, Any]:
    if isinstance(order, str):
        return dict(PRESETS[check_choice(order, tuple(PRESETS), where)])
    if not isinstance(order, dict):
        expected = '"paper", "exact" or { mounting = 1, misalignment = 1, second_order_angles = false }'
        raise UserError("the order is invalid", where=where, found=repr(order), expected=expected)
    check_keys(order, _CHOICES, where)
    return {k: check_choice(v, _CHOICES[k], f"{where}: {k}") for k, v in order.items()}
