"""Effects of the recorder: whether an output (N,), V, shows them; do not edit, see derive/effects/."""

from . import quantisation, saturation

RECOGNISERS = {
    "quantisation": quantisation.present,
    "saturation": saturation.present,
}
