"""Does a record look as it should? Likely mistakes by their physics, spikes, and what was done about them."""

from ragg_runtime.model.evaluate import check_settings
from ragg_runtime.screening.examine import examined
from ragg_runtime.screening.identify import LikelyMistake, likely_mistake
from ragg_runtime.screening.spikes import spikes

__all__ = ["LikelyMistake", "check_settings", "examined", "likely_mistake", "spikes"]
