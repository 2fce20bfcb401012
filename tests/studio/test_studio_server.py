"""The studio: what it asks of the fitting room; its server, who may ask it, what it touches, a directory that several change."""

from __future__ import annotations

import socket
import struct
import subprocess
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from types import SimpleNamespace

import httpx
import pyarrow.csv
import pytest
from serving import PATIENCE, Served, brief, compared, foreign, served, settled

from derive.effects import catalogue
from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.regressors import list_base_columns
from ragg_runtime.model.directory import HistoryStep, load_model_dir
from ragg_runtime.studio import mapping, views
from ragg_runtime.studio.session import list_present
from ragg_runtime.wording import numbers


def test_an_undo_takes_the_last_step_back() -> None:
    words = "new, add lag, add time-offset, undo 1, undo 0, edit, undo 0, calibrate"
    commands = [(*w.split(), "")[:2] for w in words.split(", ")]
    steps = [HistoryStep(action, "2026-01-01", effect, text="x") for action, effect in commands]
    paths = [list_present(steps[:n]) for n in (3, 4, 5, 6, 7, 8)]
    assert paths == [[0, 1, 2], [0, 1], [0], [0, 5], [0], [0]]


def test_a_mapping_is_asked_tried_and_kept_but_never_laid_over_another_unasked(tmp_path: Path) -> None:
    api.new(tmp_path / "model")
    m = api.load(tmp_path / "model")
    path = tmp_path / "flight.csv"
    foreign(path)
    draft = mapping.draft(m, path)
    assert [q.split(":")[0] for q in draft["questions"]] == [
        "[columns] a_x",
        "[columns] a_y",
        "[columns] a_z",
    ]
    assert "not answered" in mapping.try_mapping(m, path, draft["text"])["error"]["what"]
    text = draft["text"].replace('unit = "?"', 'unit = "m/s^2"')
    trial = mapping.try_mapping(m, path, text)
    assert trial["error"] is None
    raw = pyarrow.csv.read_csv(path)["ACC_Z"].to_numpy()
    assert "<td>a_z</td><td>m/s²</td>" in trial["preview"]
    mapping.keep(m, path, text, replace=False)
    m = api.load(tmp_path / "model")
    (flight,) = api.read_flights(m, [path])
    assert flight.channels["a_z"] == pytest.approx(raw)
    assert mapping.draft(m, path)["text"] == (tmp_path / "model" / "mapping.toml").read_text() == text
    other = text.replace('"ACC_X", unit', '"ACC_X", sign = -1, unit')
    with pytest.raises(UserError, match="mapping already"):
        mapping.keep(m, path, other, replace=False)
    mapping.keep(m, path, other, replace=True)
    for wrong in (
        "[time",
        text.replace("ACC_X", "nothing"),
        text.replace("a_x", "a_q"),
        text.replace("m/s^2", "]"),
    ):
        assert mapping.try_mapping(m, path, wrong)["error"]
    for wrong in ("[time", text.replace("ACC_X", "nothing"), text.replace("m/s^2", "]")):
        with pytest.raises(UserError):
            mapping.keep(m, path, wrong, replace=True)


def test_every_equation_of_the_catalogue_is_plain_text() -> None:
    for e in catalogue():
        assert not set("\\{}") & set(numbers.equation(e.equation)), e.id


def test_names_of_several_lines_stay_in_the_comments_of_a_shell(tmp_path: Path) -> None:
    """commands.sh is run by hand: names of strangers' files, lines and folders stand in its comments, too."""
    evil = "x\ntouch PWNED\n#"
    api.new(tmp_path / evil)
    m = api.load(tmp_path / evil)
    steps = (
        HistoryStep(action="add", time="", effect="lag", flights={evil: ""}),
        HistoryStep(action=evil, time=""),
    )
    shown = SimpleNamespace(
        loaded=m,
        model=SimpleNamespace(directory=SimpleNamespace(path=m.directory.path, history=(*m.directory.history, *steps))),
        paths=[tmp_path / evil / "flight.csv"],
        flights=[SimpleNamespace(name=evil)],
        cuts=[[(1.0, 2.0)]],
        diagnosed=None,
        kept=frozenset(),
    )  # fmt: skip
    script = "ragg() { :; }\n" + "\n".join(views.list_commands(shown))  # type: ignore[arg-type]
    assert script.count("# done: ") == 2
    subprocess.run(["sh", "-c", script], cwd=tmp_path, check=True)
    assert not (tmp_path / "PWNED").exists()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("open")


@pytest.fixture(scope="module")
def server(folder: Path) -> Iterator[Served]:
    model = folder / "model"
    api.new(model)
    flight = folder / "demo-flight.parquet"
    brief(flight)
    with served(model, flight) as s:
        yield s


@pytest.fixture(scope="module")
def client(server: Served) -> Iterator[httpx.Client]:
    with server.client() as c:
        yield c


def ask(server: Served, client: httpx.Client, what: str, *headers: str, host: str | None = None) -> str:
    """The status of an answer to what no well-behaved client would send."""
    host = f"127.0.0.1:{server.port}" if host is None else host
    cookie = "; ".join(f"{k}={v}" for k, v in client.cookies.items())
    lines = [f"{what} HTTP/1.1", f"Host: {host}", f"Cookie: {cookie}", *headers, "Connection: close", "", "x"]
    with socket.create_connection(("127.0.0.1", server.port), timeout=30) as s:
        s.sendall("\r\n".join(lines).encode("latin-1"))
        answer = b""
        while part := s.recv(65536):
            answer += part
    return answer.decode("latin-1").split()[1]


def test_the_token_serves_once_and_the_cookie_keeps_to_its_site(server: Served, client: httpx.Client) -> None:
    first = server.exchanged
    assert first is not None
    assert first.headers["location"] == "/"
    cookie = first.headers["set-cookie"]
    assert "HttpOnly" in cookie and "SameSite=strict" in cookie
    page = client.get("/")
    assert page.status_code == 200 and "token" not in page.text
    with httpx.Client(base_url=server.origin) as other:
        for token in (server.address.removeprefix(server.origin), "/?token=" + "x" * 43):
            assert other.get(token).status_code == 403
        assert other.get("/api/state").status_code == 403


def test_it_listens_to_this_machine_alone(server: Served) -> None:
    ports = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    listening = [row[1] for row in ports if row[3] == "0A" and int(row[1].split(":")[1], 16) == server.port]
    assert [struct.pack("<I", int(x.split(":")[0], 16)) for x in listening] == [b"\x7f\x00\x00\x01"]


def test_a_name_that_is_made_to_point_here_is_refused(server, client) -> None:
    evil = (f"evil.example:{server.port}", f"127.0.0.1.evil:{server.port}")
    for host in ("evil.example", *evil, "127.0.0.1", "127.0.0.1:1", ""):
        assert ask(server, client, "GET /api/state", host=host) in ("400", "421"), host


def test_a_post_from_another_site_changes_nothing(client, folder) -> None:
    before = load_model_dir(folder / "model").digest
    origins = [{"origin": x} for x in ("http://evil.example", "null", "", "http://127.0.0.1:1")]
    for headers in origins:
        answer = client.post("/api/do/remove", json={"effect": "lag"}, headers=headers)
        assert answer.status_code == 403, headers
    assert load_model_dir(folder / "model").digest == before


def test_a_post_without_origin_or_as_a_form_is_refused(server: Served, client: httpx.Client) -> None:
    with httpx.Client(base_url=server.origin, cookies=client.cookies) as c:
        assert c.post("/api/do/undo", json={}).status_code == 403
    assert client.post("/api/do/undo", data={"a": "b"}).status_code == 400
    text = {"content-type": "text/plain"}
    assert client.post("/api/do/undo", content="{}", headers=text).status_code == 400
    assert client.get("/api/do/undo").status_code == 405


def test_no_answer_may_be_framed_sniffed_or_run_code_from_elsewhere(client: httpx.Client) -> None:
    for path in ("/", "/static/js/app.js", "/api/state", "/nothing"):
        headers = client.get(path).headers
        policy = headers["content-security-policy"]
        parts = ("default-src 'none'", "script-src 'self'", "frame-ancestors 'none'")
        assert all(p in policy for p in parts) and "unsafe" not in policy
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"
        assert "access-control-allow-origin" not in headers


def test_no_folder_beside_those_named_is_shown(client: httpx.Client, folder: Path) -> None:
    (folder / "link").symlink_to("/etc")
    inside = [f"{folder}/{x}" for x in ("..", "model/../../..", "link")]
    for place in ("/etc", "/", "..", *inside, "\0", "~", "/proc/self/root"):
        answer = client.get("/api/folder", params={"place": place})
        assert answer.status_code == 400, place
        assert "may not use this folder" in answer.json()["error"]["what"]


def test_nothing_is_opened_made_or_served_from_elsewhere(client, folder, server) -> None:
    for body in ({"model": "/etc"}, {"flights": ["/etc/passwd"]}, {"flights": [f"{folder}/link/passwd"]}):
        assert client.post("/api/do/open", json=body).status_code == 400
    assert client.post("/api/do/new", json={"model": f"{folder}/../stolen"}).status_code == 400
    assert not (folder.parent / "stolen").exists()
    for path in ("../serve.py", "%2e%2e/serve.py", "..%2fserve.py", "/etc/passwd"):
        assert ask(server, client, f"GET /static/{path}") in ("403", "404")


def test_uploads_keep_to_their_folder_and_their_kinds(client, folder) -> None:
    for name in ("x.exe", "", ".csv", "model.toml", "..", "x.csv/.."):
        assert client.post("/api/upload", params={"name": name}, content=b"x").status_code == 400, name
    assert client.post("/api/upload", params={"name": "empty.csv"}, content=b"").status_code == 400
    names = ("../../evil.csv", "..\\evil.csv")

    def send(name: str) -> str:  # all at once: none takes the place of another
        answer = client.post("/api/upload", params={"name": name}, content=b"time [s],x [V]\n0,1\n1,2\n2,3\n")
        return str(answer.json()["path"])

    with ThreadPoolExecutor(2) as pool:
        answers = list(pool.map(send, names))
    inside = folder / "model" / "flights"
    kept = ["evil-2.csv", "evil.csv"]
    assert sorted(answers) == [str(inside / n) for n in kept]
    damaged = client.post("/api/upload", params={"name": "damaged.parquet"}, content=b"PAR1 no more")
    assert damaged.status_code == 400
    assert "cannot be read" in damaged.json()["error"]["what"]
    assert sorted(p.name for p in inside.iterdir()) == kept


def test_a_request_that_does_not_arrive_is_closed(client: httpx.Client, server: Served, folder: Path) -> None:
    settled(client)
    cookie = "; ".join(f"{k}={v}" for k, v in client.cookies.items())
    head = f"Host: 127.0.0.1:{server.port}\r\nOrigin: {server.origin}\r\nCookie: {cookie}\r\nContent-Length: 99\r\n\r\n"
    begun = (
        "",
        "GET / HTTP",
        f"POST /api/upload?name=slow.csv HTTP/1.1\r\n{head}time",
        f"POST /api/do/look HTTP/1.1\r\nContent-Type: application/json\r\n{head}",
    )
    with ExitStack() as stack:
        sockets = [stack.enter_context(socket.create_connection(("127.0.0.1", server.port))) for _ in begun]
        for s, text in zip(sockets, begun, strict=True):
            s.sendall(text.encode())
            s.settimeout(PATIENCE)
        for s in sockets:
            assert s.recv(99) == b""
    arrived, end = folder / "model" / "flights" / "slow.csv", time.monotonic() + PATIENCE
    while arrived.exists() and time.monotonic() < end:  # it is removed once the server has noticed
        time.sleep(0.05)
    assert not arrived.exists()


def test_a_long_or_broken_body_is_refused(client: httpx.Client) -> None:
    head = {"content-type": "application/json"}
    assert client.post("/api/do/edit", content=b"[" * 2_000_000, headers=head).status_code == 413
    for text in (b"[", b"[" * 50_000, b"3", b'{"effects": 3}', b"\xff"):
        assert client.post("/api/do/add", content=text, headers=head).status_code == 400
    for body in ({}, {"flight": "/etc/passwd", "mapping": {}}, {"flight": 3}, []):
        assert client.post("/api/mapping", json=body).status_code == 400
    assert client.get("/api/mapping", params={"flight": "/etc/passwd"}).status_code == 400
    for wrong in (10**400, "twelve", None):  # no float holds the first
        assert client.post("/api/do/edit", json={"text": wrong}).status_code == 400
        assert client.post("/api/do/leave", json={"flight": 0, "from": wrong, "to": 1}).status_code == 400
    assert client.post("/api/do/unheard-of", json={}).status_code == 400


def test_what_is_drawn_is_what_the_commands_compute(client: httpx.Client) -> None:
    state = settled(client)
    assert state["verdict"] == "missing-effect"
    best = state["effects"][0]["id"]
    assert best in state["result"][0]
    rms = state["error"]["calibrated"]["rms_Eo"]
    assert f'<td>current model</td><td class="n">{numbers.number(rms)}</td>' in state["result"][0]
    ask = {"from": 20.0, "to": 60.0, "fan": 1}
    for what in (
        "time",
        "spectrum",
        "channels",
        "columns",
        "correlations",
        "whiteness",
        "against:temperature",
    ):
        picture = client.get("/api/panel", params={"what": what, **ask})
        assert picture.headers["content-type"] == "image/svg+xml", what
        assert picture.text.startswith("<svg ")
        assert "var(--" not in picture.text
    assert "models within" in client.get("/api/panel", params={"what": "time", **ask}).text
    for wrong in (
        {"what": "against:nothing"},
        {"what": "nothing"},
        {"from": "x"},
        {"flight": 9},
        {"to": 0.5},
    ):
        assert client.get("/api/panel", params=wrong).status_code == 400, wrong
    report = client.get("/api/take/diagnosis.html")
    assert report.headers["content-disposition"].startswith("attachment")
    assert best in report.text


def test_a_stretch_is_left_out_and_taken_back(client: httpx.Client) -> None:
    before = settled(client)["error"]["calibrated"]["rms_Eo"]
    for k, first, last in ((7, 1, 2), (0, 2, 1), (0, -1, 1e9)):
        body = {"flight": k, "from": first, "to": last}
        assert client.post("/api/do/leave", json=body).status_code == 400
    assert client.post("/api/do/leave", json={"flight": 0, "from": 0.0, "to": 30.0}).status_code == 202
    state = compared(client)
    assert state["flights"][0]["valid"] == 960 - 241
    assert state["error"]["calibrated"]["rms_Eo"] != before
    assert any("left out by hand" in line for line in state["commands"])
    assert client.post("/api/do/leave", json={"flight": 0}).status_code == 202
    assert compared(client)["error"]["calibrated"]["rms_Eo"] == before


def test_a_flight_kept_for_validation_and_a_fixed_parameter_are_not_fitted(client, folder) -> None:
    demo, second = folder / "demo-flight.parquet", folder / "b.parquet"
    brief(second, 4000)
    assert client.post("/api/do/open", json={"flights": [str(demo), str(second)]}).status_code == 202
    both = compared(client)
    assert client.post("/api/do/validate", json={"flight": 0}).status_code == 202
    state = compared(client)
    assert [(f["name"], f["kept"]) for f in state["flights"]] == [("demo-flight", True), ("b", False)]
    assert state["error"] != both["error"]
    assert any(line.endswith("demo-flight.parquet --frozen") for line in state["commands"])
    assert client.post("/api/do/validate", json={"flight": 1}).status_code == 400  # one is to be fitted
    text = state["sheet"].replace('unit = "mA/g" }', 'unit = "mA/g", fixed = true }')
    assert client.post("/api/do/edit", json={"text": text}).status_code == 202
    state = compared(client, "validation")
    assert "The calibration on b " in state["validation"]
    kept = client.get("/api/panel", params={"what": "time", "flight": 0, "fan": 1})
    assert "residual" in kept.text and "models within" not in kept.text
    instrument = load_model_dir(folder / "model").instrument
    assert instrument.fixed == {"K1"}
    m = api.load(folder / "model")
    assert "K1" not in {q.name for q, _ in list_base_columns(m.model, m.instrument)}
    assert client.post("/api/do/open", json={"flights": [str(demo)]}).status_code == 202
    compared(client)


def test_a_directory_that_several_change_loses_nothing(server, client, folder) -> None:
    """Work that is cancelled, a shell beside two tabs, and in the end a server that is killed at work."""
    model = folder / "model"

    def effects() -> list[str]:
        return [e.id for e in load_model_dir(model).instrument.effects]

    one = client
    with httpx.Client(base_url=server.origin, cookies=one.cookies, headers=one.headers, timeout=60) as two:
        one.post("/api/do/add", json={"effects": ["lag"]})
        one.post("/api/do/cancel", json={})
        state = settled(one)
        if effects() == []:
            assert "cancelled" in state["status"]["error"]["what"]
        # a shell adds an effect while the page shows the old state: the page's change is refused, not laid over it
        api.add(api.load(model), "bias-drift")
        present = effects()
        change = {"text": one.get("/api/state").json()["sheet"] + "\n# a remark\n"}
        refused = two.post("/api/do/edit", json=change)
        if refused.status_code != 202:
            assert "meantime" in refused.json()["error"]["what"] or refused.status_code == 409
        assert effects() == present
        with one.stream("GET", "/api/events") as events:  # whoever listens makes the server look
            for _ in events.iter_lines():
                if [e["id"] for e in one.get("/api/state").json()["model"]["effects"]] == present:
                    break
        compared(one)
        answers = [c.post("/api/do/edit", json=change) for c in (one, two)]
        assert {a.status_code for a in answers} <= {202, 409}
        compared(two)
        assert one.post("/api/do/undo", json={}).status_code == 202
        compared(one)
        steps = len(load_model_dir(model).history)
        assert load_model_dir(model).history[-1].action == "undo"
        assert one.post("/api/do/add", json={"effects": ["thermal-scale"]}).status_code == 202
        assert two.post("/api/do/add", json={"effects": ["lag"]}).status_code == 409
        with one.stream("GET", "/api/events") as events:
            for line in events.iter_lines():
                if "deriving" in line:
                    break
        server.process.kill()
        server.process.wait(10)
    added = effects() != present
    assert effects() == ([*present, "thermal-scale"] if added else present)
    assert len(load_model_dir(model).history) == steps + added
    assert [p.name for p in folder.iterdir() if p.name.startswith(".")] == []
