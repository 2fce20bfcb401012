"""Who a scheduler may be: its answers are unpickled here, so whoever answers can run code in this process.

Over ``tls://`` only a scheduler answers whose certificate the given authority has signed (Dask does not compare
names: the authority should be the cluster's own). Over ``tcp://`` anybody may who can take its place on the
network; on this machine itself that is little to fear, elsewhere it is said.
"""

from __future__ import annotations

import ipaddress
import ssl
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from ragg_runtime.base.errors import UserError, printable


@dataclass(frozen=True)
class Tls:
    """Certificates (PEM files) for a ``tls://`` scheduler.

    Attributes
    ----------
    ca
        Of the authority that signed the scheduler's certificate.
    cert, key
        Our own, which the scheduler asks for, and its key.
    """

    ca: Path
    cert: Path
    key: Path


def tls_of(ca: Path | None, cert: Path | None, key: Path | None) -> Tls | None:
    """The certificates that the options name; UserError if they are incomplete."""
    if ca is None and cert is None and key is None:
        return None
    if ca is None or cert is None or key is None:
        raise UserError(
            "the certificates for the scheduler are incomplete",
            where="--tls-ca, --tls-cert, --tls-key",
            expected="all three",
        )
    return Tls(ca=ca, cert=cert, key=key)


def security(address: str, tls: Tls | None) -> Any:
    """Dask's ``Security`` for this address: with these certificates, else with those of Dask's own configuration."""
    from distributed.security import Security

    encrypted = address.startswith("tls://")
    if not encrypted:
        if tls is not None:
            raise UserError(
                "certificates serve a scheduler over TLS",
                where="--scheduler",
                found=address,
                expected="tls://host:port",
            )
        return Security()
    given: dict[str, object] = {"require_encryption": True}
    if tls is not None:
        given |= {
            "tls_ca_file": str(tls.ca),
            "tls_client_cert": str(tls.cert),
            "tls_client_key": str(tls.key),
        }
    made = Security(**given)
    try:
        context = made.get_connection_args("client").get("ssl_context")
    except (OSError, ssl.SSLError) as error:
        raise UserError(
            "the certificates for the scheduler cannot be read",
            where="--tls-ca, --tls-cert, --tls-key",
            found=str(error),
            expected="PEM files: of the authority, of this user, and its key",
        ) from None
    if context is None:
        raise UserError(
            "a scheduler over TLS needs certificates",
            where=address,
            remedy="give --tls-ca, --tls-cert and --tls-key, or distributed.comm.tls in Dask's configuration",
        )
    return made


def say_unproven(address: str | None) -> None:
    """On stderr what to know of the address of a scheduler, if there is one."""
    warning = None if address is None else unproven(address)
    if warning is not None:
        click.echo(printable(f"note: {warning}"), err=True)


def unproven(address: str) -> str | None:
    """What to know of an address before it is spoken to, in a sentence; ``None`` over TLS and on this machine."""
    scheme, _, rest = address.partition("://")
    host = rest.rpartition(":")[0].strip("[]")
    if scheme == "tls" or host == "localhost":
        return None
    try:
        if ipaddress.ip_address(host).is_loopback:
            return None
    except ValueError:
        pass
    return (
        f"{address} is neither encrypted nor proven: what answers there can run code in this process; "
        "use it behind a wall alone, or tls:// with --tls-ca, --tls-cert, --tls-key"
    )
