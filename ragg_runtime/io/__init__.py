"""Flights: records of motion and output, read from and written to the field's files."""

from ragg_runtime.io.files import read_flight, read_flights, write_flight
from ragg_runtime.io.record import Flight

__all__ = ["Flight", "read_flight", "read_flights", "write_flight"]
