"""Flights: records of motion and output, read from and written to CSV, Parquet and NetCDF."""

from ragg_runtime.flight.record import Flight

__all__ = ["Flight"]
