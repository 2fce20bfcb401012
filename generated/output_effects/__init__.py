"""Effects of the recorder: whether an output (N,), V, shows them; do not edit, see derive/effects/."""

from . import imu_saturation, quantisation, saturation

RECOGNISERS = {
    "imu-saturation": imu_saturation.present,
    "quantisation": quantisation.present,
    "saturation": saturation.present,
}
