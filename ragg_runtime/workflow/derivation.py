"""What ``ragg derive`` does, without all that flights need: that would take as long to load as a tenth of the derivation."""

from ragg_runtime.model_dir.publish import HOME as HOME
from ragg_runtime.model_dir.publish import checked as checked
from ragg_runtime.model_dir.publish import rederived as rederived
