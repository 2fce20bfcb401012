"""model.toml of the array: what a data sheet and a ruler say, and how sure they are."""

from __future__ import annotations

from collections.abc import Sequence

PLACES = (("A1", 45, 1), ("A2", 225, 1), ("A3", 135, -1), ("A4", 315, -1))


def sheet(
    height: str | Sequence[str] = "2 mm",
    radius: str = "13.364 mm",
    lift: str = "5",
    arm: str = "0.5",
) -> str:
    """The sheet; ``lift`` deg and ``arm`` mm say how sure it is of beta_x and dR; a ``height`` for each or all."""
    heights = (height,) * len(PLACES) if isinstance(height, str) else height
    text = [
        "# Four of eight MEMS accelerometers on a board, along the tangents of the circle through them: a gradiometer",
        "# that stands still. The measurement frame's origin is amidst the four on the back, 2 mm below.",
        "effects = []",
        'g0 = "9.81 m/s^2"',
        "",
        "[model]",
        'kinematics = "full"',
        "",
        "[[disc]]",
        'name = "A"',
        f'radius = "{radius}"',
        'spin_frequency = "0 Hz"',
    ]
    for (name, angle, sign), above in zip(PLACES, heights, strict=True):
        text += [
            "[[disc.accelerometer]]",
            f'name = "{name}"',
            f'angle = "{angle} deg"',
            f'height = "{above}"',
        ]
        text += [f"sign = {sign}", 'output = "G_out"']
    text += [
        "",
        "[accelerometers]",
        f'dR = {{ value = 0, sigma = {arm}, unit = "mm" }}',
        f'beta_x = {{ value = 0, sigma = {lift}, unit = "deg" }}',
        *(
            f'{n} = {{ value = 0, sigma = 3, unit = "deg" }}'
            for n in ("beta_z", "vartheta_x", "vartheta_y", "vartheta_z")
        ),
        'K0 = { value = 0, sigma = 60, unit = "mg" }',
        'K1 = { value = 1, sigma = 0.03, unit = "A/g" }',
        *(f'K{n} = {{ value = 0, sigma = 2, unit = "mg/g^2" }}' for n in (2, 4, 5, 6, 7, 8)),
        'k_VI = { value = 1, unit = "ohm" }',
    ]
    return "\n".join(text) + "\n"
