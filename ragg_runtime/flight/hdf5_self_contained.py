"""Does an HDF5 file hold its numbers itself?

External storage, virtual datasets and external links let a file name other files, whose bytes would be read as
channels: somebody else's, or a pipe that never ends. Such a file is no record: its digest says nothing about
what is read. Everything is looked up by low-level calls that follow no link and read no data.
"""

from __future__ import annotations

from pathlib import Path

import h5py

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.hdf5_trial import refuse_endless
from ragg_runtime.flight.source import MOST_COLUMNS, too_many_columns

MOST = 200_000
"""Objects of a file up to which it is looked through: a survey of 2,000 lines has some 30 columns in each."""


def refuse_elsewhere(path: Path) -> None:
    """UserError if anything in the file stands in another one, or if it leads in circles; OSError etc. if it is damaged."""
    refuse_endless(path, leads_elsewhere)
    found = leads_elsewhere(path)
    if found is not None:
        raise UserError(
            "the file does not hold its numbers itself",
            where=path,
            found=found,
            expected="a file whose numbers all stand in it",
            remedy="copy the data into one file, with nccopy or h5repack for example",
        )


def leads_elsewhere(path: Path) -> str | None:
    """What in the file stands in another one, in words; ``None`` if nothing does. OSError etc. if it is damaged."""
    with h5py.File(path, "r") as file:
        waiting = [(file.id, "")]
        seen: set[int] = set()
        while waiting:
            group, place = waiting.pop()
            columns = 0
            for name in group:
                here = f"{place}/{name.decode('utf-8', 'replace')}"
                kind = group.links.get_info(name).type
                if kind == h5py.h5l.TYPE_SOFT:  # to a place in this file: what stands there is met by itself
                    continue
                if kind != h5py.h5l.TYPE_HARD:
                    return f"{here} is a link to another file"
                thing = h5py.h5o.open(group, name)
                address = h5py.h5o.get_info(thing).addr
                if address in seen:
                    continue
                seen.add(address)
                if len(seen) > MOST:
                    return f"more than {MOST} objects, which no flight has"
                if isinstance(thing, h5py.h5g.GroupID):
                    waiting.append((thing, here))
                elif isinstance(thing, h5py.h5d.DatasetID):
                    columns += 1
                    if columns > MOST_COLUMNS:
                        raise too_many_columns(path)
                    found = _stored_elsewhere(thing)
                    if found is not None:
                        return f"{here} {found}"
    return None


def _stored_elsewhere(dataset: h5py.h5d.DatasetID) -> str | None:
    made = dataset.get_create_plist()
    if made.get_layout() == h5py.h5d.VIRTUAL:
        return "is a virtual dataset: its numbers stand in other datasets"
    if made.get_layout() == h5py.h5d.CONTIGUOUS and made.get_external_count():
        return f"has its numbers in another file, {made.get_external(0)[0].decode(errors='replace')}"
    return None
