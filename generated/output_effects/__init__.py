"""Effects of the recorder, by their ids: whether a series shows them; do not edit, see derive/effects/."""

from . import imu_saturation, quantisation, saturation

RECOGNISERS = {
    "imu-saturation": imu_saturation,
    "quantisation": quantisation,
    "saturation": saturation,
}
