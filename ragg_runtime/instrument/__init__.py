"""The instrument: nominal parameters, units and effects of one gradiometer, read from ``model.toml``."""
