"""Flights: records of motion and output, read from and written to the field's files."""

from ragg_runtime.flight.files import read_flight, read_flights, write_flight
from ragg_runtime.flight.record import Flight

__all__ = ["Flight", "read_flight", "read_flights", "write_flight"]
