"""A scheduler proves who it is, or nothing that it answers is taken in."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import main
from ragg_runtime.flight import write_flight
from ragg_runtime.survey.tls import Tls, unproven
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated

pytest.importorskip("distributed", reason="Dask is an optional extra: pip install 'ragg[cluster]'")
from test_survey_cluster import Cluster

pytestmark = pytest.mark.skipif(shutil.which("openssl") is None, reason="certificates are made with openssl")


def openssl(*words: str | Path) -> None:
    subprocess.run(["openssl", *map(str, words)], check=True, capture_output=True, timeout=60)


def authority(folder: Path, name: str) -> Tls:
    """An authority, and a certificate that it signed."""
    ca, key, cert = (folder / f"{name}-{part}.pem" for part in ("ca", "key", "cert"))
    ec = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes")
    openssl(
        "req",
        "-x509",
        *ec,
        "-keyout",
        folder / f"{name}-ca.key",
        "-out",
        ca,
        "-days",
        "2",
        "-subj",
        f"/CN={name}",
    )
    openssl("req", *ec, "-keyout", key, "-out", folder / "request", "-subj", "/CN=member")
    openssl(
        *("x509", "-req", "-in", folder / "request", "-CA", ca, "-CAkey", folder / f"{name}-ca.key"),
        *("-CAcreateserial", "-days", "2", "-out", cert),
    )
    return Tls(ca=ca, cert=cert, key=key)


@pytest.fixture(scope="module")
def certificates(tmp_path_factory: pytest.TempPathFactory) -> tuple[Tls, Tls]:
    folder = tmp_path_factory.mktemp("certificates")
    return authority(folder, "ours"), authority(folder, "theirs")


def options(tls: Tls) -> tuple[object, ...]:
    return ("--protocol", "tls", "--tls-ca-file", tls.ca, "--tls-cert", tls.cert, "--tls-key", tls.key)


@pytest.fixture(scope="module")
def cluster(certificates: tuple[Tls, Tls], tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    """A scheduler over TLS with one worker."""
    c = Cluster(tmp_path_factory.mktemp("cluster"), *options(certificates[0]))
    try:
        c.worker()
        yield c
    finally:
        c.end()


def test_a_survey_over_tls(
    cluster: Cluster, certificates: tuple[Tls, Tls], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cluster.address.startswith("tls://")
    m = loop.new(tmp_path / "model")
    write_flight(simulated(m.instrument, [], seed=1, duration=90.0, rate=16.0), tmp_path / "f.parquet")
    ours, theirs = certificates
    words = ["survey", str(tmp_path / "model"), str(tmp_path / "f.parquet"), "--scheduler", cluster.address]
    for attempt in range(20):  # until the worker is there
        try:
            main([*words, "--tls-ca", str(ours.ca), "--tls-cert", str(ours.cert), "--tls-key", str(ours.key)])
            break
        except SystemExit:
            said = capsys.readouterr().err
            assert "has no workers" in said, said
            assert attempt < 19
    said = capsys.readouterr().out
    assert said.startswith("1 flight: 1 ") and "in error" not in said, said

    def refused(*more: str | Path) -> str:
        with pytest.raises(SystemExit) as end:
            main([*words, *map(str, more)])
        assert end.value.code == 2
        return capsys.readouterr().err

    # A scheduler that our authority has not signed is a stranger, and so are we without a certificate.
    assert "cannot be reached" in refused(
        "--tls-ca", theirs.ca, "--tls-cert", theirs.cert, "--tls-key", theirs.key
    )
    assert "cannot be reached" in refused(
        "--tls-ca", theirs.ca, "--tls-cert", ours.cert, "--tls-key", ours.key
    )
    said = refused("--tls-ca", ours.ca, "--tls-cert", theirs.cert, "--tls-key", theirs.key)
    assert "cannot be reached" in said
    assert "incomplete" in refused("--tls-ca", ours.ca)
    assert "needs certificates" in refused()


def test_what_the_options_must_be(tmp_path: Path, certificates: tuple[Tls, Tls]) -> None:
    m = loop.new(tmp_path / "model")
    ours = certificates[0]

    def survey(address: str, tls: Tls | None) -> None:
        loop.survey(m, [tmp_path / "f.parquet"], scheduler=address, tls=tls)

    with pytest.raises(UserError, match=r"expected: tls://"):
        survey("tcp://127.0.0.1:1", ours)
    with pytest.raises(UserError, match="cannot be read"):
        survey("tls://127.0.0.1:1", replace(ours, ca=tmp_path / "none.pem"))
    (tmp_path / "bad.pem").write_text("no certificate")
    with pytest.raises(UserError, match="cannot be read"):
        survey("tls://127.0.0.1:1", replace(ours, ca=tmp_path / "bad.pem"))
    with pytest.raises(SystemExit):
        main(["survey", str(tmp_path / "model"), "f.parquet", "--tls-cert", "x"])


@pytest.mark.parametrize(
    ("address", "proven"),
    [
        ("tls://far.example:8786", True),
        ("tcp://127.0.0.1:8786", True),
        ("tcp://[::1]:8786", True),
        ("tcp://localhost:8786", True),
        ("tcp://10.0.0.5:8786", False),
        ("tcp://far.example:8786", False),
        ("ws://far.example:8786", False),
    ],
)
def test_an_address_that_proves_nothing_is_remarked(address: str, proven: bool) -> None:
    assert (unproven(address) is None) == proven
