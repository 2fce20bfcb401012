"""Flights: records of motion and output, read from the field's files or from memory, and written.

The way of all of them: a reader makes tables of a file, a recording is what is meant of a table, a flight is a recording
in SI on a uniform grid.
"""

from ragg_runtime.io.files import read_flight, read_flights, write_flight
from ragg_runtime.io.record import Flight

__all__ = ["Flight", "read_flight", "read_flights", "write_flight"]
