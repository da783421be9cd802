"""Who may do what: keys, roles, the modes of --auth, proxies, foreign pages."""

import contextlib
import datetime
import http.client
import itertools
import os
import socket
import time

from support.clock import ClockTest
from support.daemon import SANITIZED, Daemon, DaemonTest, command
from support.waiting import PATIENCE, wait_for

PART = {"designation": "25 H7", "measured_mm": 25.013}
CONTROL = {"kind": "lsv2", "address": "127.0.0.1:1", "paths": ["TNC:\\logs\\*.TXT"]}
COLUMN = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": -3}]}
OPEN_READS = ("/v1/limits/25H7", "/v1/fits/25H7/g6", "/v1/tables",
              "/v1/verdicts/25H7?measured_mm=25", "/openapi.json", "/")
HEALTH = ("/livez", "/readyz")


class Callers(DaemonTest):
    def make_key(self, name, role):
        made = self.daemon.command("key", "create", "--name", name, "--role", role)
        self.assertEqual(made.returncode, 0, made.stderr)
        return made.stdout.strip()

    def assert_needs_a_key(self, answer):
        self.assert_problem(answer, 401, "auth.required")
        self.assertTrue(answer.headers["www-authenticate"].startswith("Bearer"))


class Open(Callers):
    """The default on loopback."""

    def test_nobody_here_needs_a_key(self):
        self.assertEqual(self.daemon.measure(PART).status, 201)

    def test_through_a_proxy_everybody_is_remote(self):
        for field in ("Forwarded", "X-Forwarded-For", "X-Forwarded-Proto", "X-Forwarded-Host", "Via", "X-Real-IP",
                      "x-real-ip", "True-Client-IP", "CF-Connecting-IP"):
            with self.subTest(field):
                self.assert_needs_a_key(self.daemon.measure(PART, {field: "for=10.0.0.9"}))
                self.assertEqual(
                    self.daemon.request("GET", "/v1/limits/25H7", headers={field: "x"}).status, 200)

    def test_a_proxy_that_says_nothing_is_told_of_once(self):
        def ask(field):
            with socket.create_connection(("127.0.0.1", self.daemon.port), timeout=PATIENCE) as client:
                client.sendall(b"GET /v1/limits/25H7 HTTP/1.0\r\nHost: h\r\n" + field + b"\r\n")
                while client.recv(4096):
                    pass

        warned = lambda: self.daemon.log.count("proxy_suspected")
        ask(b"")
        self.assertEqual(warned(), 0, "HTTP/1.0 alone is an old client")
        for _ in range(3):
            ask(b"Connection: close\r\n")
        wait_for(lambda: warned() == 1)

    def test_foreign_credentials_count_as_none_where_none_are_needed(self):
        for value in ("Basic dXNlcjpwYXNz", "Bearer of-another-service", "Negotiate x", ""):
            self.assertEqual(self.daemon.measure(PART, {"Authorization": value}).status, 201, value)
        answer = self.daemon.measure(PART, {"Authorization": "Bearer fg_" + "0" * 40})
        self.assert_problem(answer, 401, "auth.invalid")

    def test_a_page_of_another_site_cannot_write(self):
        before = len(self.daemon.stored())
        for origin in ("http://evil.example", "null", "http://localhost:1",
                       f"https://127.0.0.1:{self.daemon.port}"):
            with self.subTest(origin):
                self.assert_problem(self.daemon.measure(PART, {"Origin": origin}), 403,
                                    "origin.refused")
        self.assertEqual(len(self.daemon.stored()), before)
        own = f"http://127.0.0.1:{self.daemon.port}"
        self.assertEqual(self.daemon.measure(PART, {"Origin": own}).status, 201)
        self.assertEqual(self.daemon.request("GET", "/v1/limits/25H7",
                                             headers={"Origin": "http://evil.example"}).status, 200)

    def test_a_page_behind_a_proxy_that_ends_tls_may_write(self):
        proxied = {"X-Forwarded-Proto": "https", "X-Forwarded-For": "10.0.0.9", "Host": "gauge.example"}
        key = self.make_key("page", "operator")
        headers = {**proxied, "Origin": "https://gauge.example", "Authorization": f"Bearer {key}"}
        wait_for(lambda: self.daemon.measure(PART, headers).status != 401)
        self.assertEqual(self.daemon.measure(PART, headers).status, 201)
        for origin in ("https://evil.example", "http://gauge.example"):
            self.assert_problem(self.daemon.measure(PART, {**headers, "Origin": origin}), 403, "origin.refused")

    def test_a_name_that_was_made_to_resolve_here_is_remote(self):
        for host in ("rebound.example", "rebound.example:8286", "rebound.example.", "rebound.example..",
                     "127.0.0.1.rebound.example"):
            self.assert_needs_a_key(self.daemon.get("/v1/measurements", Host=host))
            self.assert_needs_a_key(self.daemon.measure(PART, {"Host": host, "Origin": f"http://{host}"}))
            self.assertEqual(self.daemon.measure(PART, {"Host": host}).status, 201, "no page writes so")
        for host in ("localhost", "LOCALHOST:8286", "127.0.0.1", "0.0.0.0:8286", "[::1]:8286", "gauge-3"):
            self.assertEqual(self.daemon.get("/v1/measurements", Host=host).status, 200, host)
            origin = f"http://{host.lower()}"
            self.assertEqual(self.daemon.measure(PART, {"Host": host, "Origin": origin}).status, 201, host)



class ReadOpen(Callers):
    flags = ("--auth", "read-open")

    def test_tables_are_open_and_measurements_are_not(self):
        for path in OPEN_READS + HEALTH:
            self.assertEqual(self.daemon.get(path).status, 200, path)
        self.assert_needs_a_key(self.daemon.get("/v1/measurements"))
        self.assert_needs_a_key(self.daemon.measure(PART))
        self.assert_needs_a_key(self.daemon.get("/v1/events"))
        revision = self.daemon.get("/v1/tables").json["revision"]
        for path in ("/v1/limits/25H7", "/v1/fits/25H7/g6", "/v1/fits/25H7%2Fg6"):
            self.assertEqual(self.daemon.get(f"{path}?revision={revision}").status, 200, path)
        both = f"?revision={revision}&hole_characteristic=a&shaft_characteristic=b"
        self.assert_needs_a_key(self.daemon.get("/v1/fits/25H7/g6" + both))
        # A fit is of the tables, what measured parts do is not.
        stored = "?hole_characteristic=a&shaft_characteristic=b"
        for path in ("/v1/fits/25H7/g6", "/v1/fits/25H7%2Fg6"):
            self.assertEqual(self.daemon.get(path).status, 200)
            self.assert_needs_a_key(self.daemon.get(path + stored))
            key = f"Bearer {self.make_key('viewer' + str(len(path)), 'viewer')}"
            wait_for(lambda: self.daemon.get(path + stored, Authorization=key).status != 401)
            self.assert_problem(self.daemon.get(path + stored, Authorization=key), 422, "statistics.too_few")

    def test_the_first_start_writes_the_administrators_key_for_its_owner(self):
        file = self.daemon.data / "admin.key"
        self.assertEqual(file.stat().st_mode & 0o777, 0o600)
        token = file.read_text().strip()
        self.daemon.wait_for_log(str(file))
        self.assertNotIn(token, self.daemon.log + self.daemon.output)
        self.assertEqual(self.daemon.get("/v1/measurements",
                                         Authorization=f"Bearer {token}").status, 200)
        self.assertEqual(self.daemon.stop(), 0)
        file.unlink()
        self.daemon.start()
        self.assertFalse(file.exists(), "made once")
        self.assertEqual(self.daemon.log.count("admin_key_written"), 1)
        self.assertNotIn(token.encode(), self.daemon.database.read_bytes(), "only a hash is stored")

    def test_it_is_the_default_of_an_address_that_is_not_loopback(self):
        daemon = Daemon(listen="0.0.0.0:0")
        self.addCleanup(daemon.cleanup)
        daemon.start()
        self.assert_needs_a_key(daemon.measure(PART))
        self.assertEqual(daemon.get("/v1/limits/25H7").status, 200)
        self.assertEqual(daemon.stop(), 0)


class Keys(Callers):
    flags = ("--auth", "keys")

    def test_everything_but_health_needs_a_key(self):
        for path in HEALTH:
            self.assertEqual(self.daemon.get(path).status, 200, path)
            self.assertEqual(self.daemon.get(path, Authorization="Basic dXNlcjpwYXNz").status, 200, path)
            self.assertEqual(self.daemon.get(path, Authorization="Bearer fg_" + "0" * 40).status, 200, path)
        for path in OPEN_READS[:-1]:
            self.assert_needs_a_key(self.daemon.get(path))

    def test_roles(self):
        tokens = {role: self.make_key(f"{role}-1", role) for role in ("viewer", "operator", "admin")}
        calls = [("viewer", "GET", "/v1/measurements", None), ("operator", "POST", "/v1/measurements", PART),
                 ("admin", "PUT", "/v1/tables/hole/classes/Shop1", COLUMN),
                 ("admin", "PUT", "/v1/setups/mill-1", {}), ("admin", "DELETE", "/v1/setups/mill-1", None),
                 ("admin", "PUT", "/v1/connections/mill-1", CONTROL), ("viewer", "GET", "/v1/connections/mill-1", None),
                 ("admin", "POST", "/v1/connections/mill-1/test", None), ("admin", "DELETE", "/v1/connections/mill-1", None),
                 ("admin", "PUT", "/v1/files/p.h", "0 BEGIN PGM p MM\n1 END PGM p MM\n"),
                 ("operator", "POST", "/v1/runs", {"program": "TNC:\\p.h"}),
                 ("viewer", "POST", "/v1/files/p.h?action=check", None), ("admin", "DELETE", "/v1/files/p.h", None)]
        order = ["viewer", "operator", "admin"]
        wait_for(lambda: self.daemon.get(
            "/v1/measurements", Authorization=f"Bearer {tokens['admin']}").status == 200)
        for needed, method, path, body in calls:
            for role in order:
                answer = self.daemon.request(method, path, body, {"Authorization": f"Bearer {tokens[role]}"})
                with self.subTest(role=role, method=method, path=path):
                    if order.index(role) < order.index(needed):
                        self.assert_problem(answer, 403, "auth.forbidden")
                        self.assertEqual(answer.json["detail"], f"the key {role}-1 has the role {role}; this needs the role {needed}")
                    elif role == needed:
                        self.assertIn(answer.status, (200, 201, 204), answer)
                    else:
                        self.assertNotEqual(answer.status, 403, answer)
        for of_another in ({}, {"Authorization": "Basic dXNlcjpwYXNz"}, {"Authorization": "Bearer of-another-service"}):
            answer = self.daemon.measure(PART, {"X-API-Key": tokens["operator"], **of_another})
            with self.subTest(of_another):
                self.assertEqual((answer.status, answer.json.get("caller")), (201, "operator-1"), answer)

    def test_keys_that_are_none(self):
        for value in ("Bearer nonsense", "Bearer ", "Basic dXNlcjpwYXNz", "Bearer fg_" + "0" * 40):
            with self.subTest(value):
                answer = self.daemon.get("/v1/limits/25H7", Authorization=value)
                self.assertEqual(answer.status, 401)
                self.assertIn("www-authenticate", answer.headers)

    def test_a_key_is_listed_and_revoked(self):
        token = self.make_key("press-3", "operator")
        use = lambda: self.daemon.measure(PART, {"Authorization": f"Bearer {token}"}).status
        wait_for(lambda: use() == 201)
        listed = self.daemon.command("key", "list").stdout
        self.assertIn("press-3\toperator", listed)
        self.assertNotIn(token, listed)
        self.assertEqual(self.daemon.command("key", "create", "--name", "press-3", "--role",
                                             "viewer").returncode, 1)
        self.assertEqual(self.daemon.command("key", "revoke", "--name", "press-3").returncode, 0)
        wait_for(lambda: use() == 401)
        self.assertIn("revoked", self.daemon.command("key", "list").stdout)
        self.assertEqual(self.daemon.command("key", "revoke", "--name", "press-3").returncode, 1)

    def test_a_name_that_no_record_can_have(self):
        for name in ("", "x" * 201, os.fsdecode(b"M\xfcller"), "a\nb", "a\tb"):
            made = self.daemon.command("key", "create", "--name", name, "--role", "viewer")
            self.assertEqual(made.returncode, 1, name)
            self.assertIn("name of the key must have 1 to 200 bytes of UTF-8 without control characters", made.stderr)

    def test_a_role_that_is_none(self):
        made = self.daemon.command("key", "create", "--name", "x", "--role", "king")
        self.assertEqual(made.returncode, 2)
        self.assertIn("viewer, operator, admin, station", made.stderr)


class Ends(Callers):
    """Keys that are revoked or expire, and the streams that they opened."""
    flags = ("--auth", "keys")
    SOON = 4  # seconds: two as the guide says, and as much again

    def follow(self, token, path):
        connection = self.daemon.connect()
        self.addCleanup(connection.close)
        fields = {"Authorization": f"Bearer {token}"}
        wait_for(lambda: self.daemon.get("/v1/tables", **fields).status == 200)
        connection.request("GET", path, headers=fields)
        response = connection.getresponse()
        self.assertEqual(response.status, 200)
        return response

    def time_to_end(self, response):
        begun = time.monotonic()
        with contextlib.suppress(http.client.IncompleteRead):
            while response.read1():
                pass
        return time.monotonic() - begun

    def test_the_streams_of_a_revoked_key_end(self):
        other = self.make_key("stayer", "viewer")
        stays = self.follow(other, "/v1/events")
        stays.read1()
        leavers = (f"leaver-{number}" for number in itertools.count())

        def longest(leaver):
            token = self.make_key(leaver, "viewer")
            streams = [self.follow(token, path) for path in ("/v1/events", "/mtconnect/sample?interval=100")]
            self.assertEqual(self.daemon.command("key", "revoke", "--name", leaver).returncode, 0)
            return max([self.time_to_end(stream) for stream in streams])

        # A busy machine takes longer by chance, and not always.
        wait_for(lambda: longest(next(leavers)) < self.SOON or SANITIZED, "streams that end soon")
        self.daemon.wait_for_log('"key_revoked","detail":"leaver-0 (viewer)"')
        admin = (self.daemon.data / "admin.key").read_text().strip()
        self.assertEqual(self.daemon.measure(PART, {"Authorization": f"Bearer {admin}"}).status, 201)
        while b"measurement.recorded" not in (told := stays.read1()):  # a heartbeat may come before
            self.assertTrue(told)

    def test_an_expiry_that_is_none(self):
        for expires, code in (("tomorrow", 2), ("", 2), ("2020-01-01T00:00:00Z", 1)):
            made = self.daemon.command("key", "create", "--name", "x", "--role", "viewer", "--expires", expires)
            self.assertEqual(made.returncode, code)
            self.assertIn("expire", made.stderr)


class Expiry(ClockTest):
    flags = ("--auth", "keys")

    def test_a_key_expires_with_its_streams(self):
        self.daemon.start()
        end = datetime.datetime.now(datetime.timezone.utc) + datetime.timedelta(days=1)
        made = self.daemon.command("key", "create", "--name", "auditor", "--role", "viewer", "--expires",
                                   end.isoformat())
        self.assertEqual(made.returncode, 0, made.stderr)
        fields = {"Authorization": f"Bearer {made.stdout.strip()}"}
        admin = {"Authorization": "Bearer " + (self.daemon.data / "admin.key").read_text().strip()}
        self.daemon.wait_for_log('"key_created","detail":"auditor (viewer, expires ')
        connection = self.daemon.connect()
        self.addCleanup(connection.close)
        connection.request("GET", "/v1/events", headers=fields)
        stream = connection.getresponse()
        self.assertEqual(stream.status, 200)
        while b"measurement.recorded" not in stream.read1():  # what was sent before the first value
            self.assertEqual(self.daemon.measure(PART, admin).status, 201)
        self.set_clock("+2d")
        with contextlib.suppress(http.client.IncompleteRead):
            while stream.read1():
                pass
        answer = self.daemon.get("/v1/tables", **fields)
        self.assertEqual((answer.status, answer.json["code"]), (401, "auth.expired"))
        self.assertIn("www-authenticate", answer.headers)
        self.assertIn("auditor\tviewer\tcreated", self.daemon.command("key", "list").stdout)
        self.assertIn("\texpires ", self.daemon.command("key", "list").stdout)
        self.assertEqual(self.daemon.stop(), 0)


class OtherOrigins(Callers):
    """Pages of an origin that --allow-origin names, in open mode."""
    MES = "https://mes.example"
    flags = ("--allow-origin", MES, "--allow-origin", "http://10.0.0.7:8080")

    def test_they_read_without_a_key_and_write_with_one(self):
        read = self.daemon.get("/v1/limits/25H7", Origin=self.MES)
        self.assertEqual((read.status, read.headers["access-control-allow-origin"]), (200, self.MES))
        self.assertEqual(read.headers["cross-origin-resource-policy"], "cross-origin")
        refused = self.daemon.measure(PART, {"Origin": self.MES})
        self.assert_needs_a_key(refused)
        self.assertEqual(refused.headers["access-control-allow-origin"], self.MES)
        figures = {"values": [1, 2, 3]}
        self.assert_needs_a_key(self.daemon.post("/v1/statistics/summary", figures, {"Origin": self.MES}))
        token = self.make_key("mes", "operator")
        fields = {"Origin": self.MES, "Authorization": f"Bearer {token}"}
        wait_for(lambda: self.daemon.measure(PART, fields).status == 201)
        self.assertEqual(self.daemon.post("/v1/statistics/summary", figures, fields).status, 200)
        self.assertEqual(self.daemon.measure(PART).status, 201, "no page: open as ever")

    def test_a_preflight_needs_no_key(self):
        answer = self.daemon.request("OPTIONS", "/v1/measurements", headers={
            "Origin": self.MES, "Access-Control-Request-Method": "POST"})
        self.assertEqual(answer.status, 204)
        self.assertEqual(answer.headers["access-control-allow-methods"], "GET, HEAD, POST, OPTIONS")
        allowed = set(answer.headers["access-control-allow-headers"].split(", "))
        described = self.daemon.get("/openapi.json").json
        parameters = [each for path in described["paths"].values() for operation in path.values()
                      for each in operation.get("parameters", []) if each["in"] == "header"]
        schemes = [each for each in described["components"]["securitySchemes"].values() if each.get("in") == "header"]
        self.assertEqual({each["name"] for each in (*parameters, *schemes)} - allowed, set())
        self.assertLessEqual({"Authorization", "Content-Type", "X-Request-Id"}, allowed)

    def test_others_stay_refused(self):
        for origin in ("https://mes.example.evil", "https://MES.example", "null"):
            answer = self.daemon.measure(PART, {"Origin": origin})
            self.assert_problem(answer, 403, "origin.refused")
            self.assertNotIn("access-control-allow-origin", answer.headers)
            self.assertEqual(answer.headers["vary"], "Origin")

    def test_an_origin_that_is_none(self):
        for origin in ("*", "null", "mes.example", "https://mes.example/", "https://MES.example", "https://"):
            refused = command("--check-config", "--allow-origin", origin)
            self.assertEqual(refused.returncode, 2, origin)
            self.assertIn("allow-origin must be an origin", refused.stderr)


class TheFirstKey(Callers):
    def test_its_file_may_be_elsewhere(self):
        daemon = Daemon("--auth", "keys")
        self.addCleanup(daemon.cleanup)
        file = daemon.folder / "first"
        file.write_text("an old one")
        file.chmod(0o644)
        daemon.flags += ["--admin-key-out", str(file)]
        daemon.start()
        token = file.read_text().strip()
        self.assertEqual(file.stat().st_mode & 0o777, 0o600)
        self.assertEqual(daemon.get("/v1/measurements", Authorization=f"Bearer {token}").status, 200)
        self.assertFalse((daemon.data / "admin.key").exists())
        self.assertEqual(daemon.stop(), 0)

    def test_a_start_that_cannot_write_it_says_so(self):
        refused = command("--auth", "keys", "--listen", "127.0.0.1:0", "--data", self.daemon.folder / "new",
                          "--admin-key-out", "/proc/none/key")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("admin-key-out: cannot write /proc/none/key", refused.stderr)

    def test_it_may_come_from_a_file(self):
        daemon = Daemon("--auth", "keys")
        self.addCleanup(daemon.cleanup)
        token = "fg_" + "7" * 40
        (daemon.folder / "key").write_text(token + "\n")
        daemon.environment["FITGAUGE_ADMIN_KEY_FILE"] = str(daemon.folder / "key")
        daemon.start()
        self.assertEqual(daemon.get("/v1/measurements", Authorization=f"Bearer {token}").status, 200)
        self.assertNotIn("admin_key_written", daemon.log)
        self.assertFalse((daemon.data / "admin.key").exists())
        self.assertEqual(daemon.stop(), 0)

    def test_others_may_be_made_before_the_first_start(self):
        daemon = Daemon("--auth", "keys")
        self.addCleanup(daemon.cleanup)
        made = daemon.command("key", "create", "--name", "press-3", "--role", "operator")
        self.assertEqual(made.returncode, 0, made.stderr)
        daemon.start()
        self.assertEqual(
            daemon.measure(PART, {"Authorization": f"Bearer {made.stdout.strip()}"}).json["caller"], "press-3")
        self.assertTrue((daemon.data / "admin.key").exists(), "somebody has to have the other rights")
        self.assertEqual(daemon.stop(), 0)
