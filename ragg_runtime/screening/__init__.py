"""Does a record look as it should? What is no measurement is left out, what is odd is flagged, likely mistakes are named."""

from ragg_runtime.screening.screen import screen

__all__ = ["screen"]
