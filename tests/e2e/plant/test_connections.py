"""Connections as data: made, changed and deleted over HTTP, and those of the configuration file beside them."""

import json
import pathlib
import socket
import tempfile
import threading
import unittest

from support.daemon import Daemon, DaemonTest, command
from support.waiting import wait_for

CONTROL = {"kind": "lsv2", "address": "127.0.0.1:1", "paths": ["TNC:\\logs\\*.TXT"], "interval_s": 3600}


class Stored(DaemonTest):
    def put(self, name, body, status):
        answer = self.daemon.request("PUT", f"/v1/connections/{name}", body, {"Content-Type": "application/json"})
        self.assertEqual(answer.status, status, answer)
        return answer.json

    def test_it_is_kept_and_changed_and_deleted(self):
        made = self.put("mill-1", {**CONTROL, "machine": "M1"}, 201)
        self.assertEqual((made["name"], made["kind"], made["direction"], made["machine"], made["read_only"]),
                         ("mill-1", "lsv2", "in", "M1", False))
        self.daemon.kill()
        self.daemon.start()
        found = self.daemon.get("/v1/connections").json["connections"]
        self.assertEqual([(each["name"], each["machine"]) for each in found], [("mill-1", "M1")])
        self.assertEqual(self.put("mill-1", {**CONTROL, "machine": "M2"}, 200)["machine"], "M2")
        self.assertEqual(self.daemon.get("/v1/connections/mill-1").json["machine"], "M2")
        self.assertEqual(self.put("MILL-1", CONTROL, 400)["code"], "path.malformed")
        self.assertEqual(self.daemon.request("DELETE", "/v1/connections/mill-1").status, 204)
        for method in ("GET", "DELETE"):
            self.assert_problem(self.daemon.request(method, "/v1/connections/mill-1"), 404, "connection.unknown")
        self.daemon.kill()
        self.daemon.start()
        self.assertEqual(self.daemon.get("/v1/connections").json["connections"], [])

    def test_a_kind_that_is_not_there_is_refused(self):
        problem = self.put("x", {"kind": "opcua", "url": "opc.tcp://127.0.0.1"}, 422)
        kinds = next(e["detail"] for e in problem["errors"] if (e["pointer"], e["code"]) == ("/kind", "field.invalid"))
        for kind in ("lsv2", "webhook", "folder_in", "folder_out", "mqtt", "sparkplug"):
            self.assertIn(kind, kinds)
        self.assertEqual(self.daemon.get("/v1/connections").json["connections"], [])

    def test_every_bad_field_is_named(self):
        problem = self.put("x", {"kind": "lsv2", "address": "a:b:c", "paths": ["PLC:\\x", 1], "interval_s": 0, "colour": 1}, 422)
        self.assertEqual(sorted((e["pointer"], e["code"]) for e in problem["errors"]), [
            ("/address", "field.invalid"), ("/colour", "field.unknown"), ("/interval_s", "field.invalid"),
            ("/paths/0", "field.invalid"), ("/paths/1", "field.type")])
        self.assertEqual(self.put("x", [], 422)["errors"][0]["code"], "field.type")
        self.assertEqual(self.put("x", "{", 400)["code"], "json.malformed")

    def test_a_test_says_what_is_wrong(self):
        self.put("away", CONTROL, 201)
        answer = self.daemon.post("/v1/connections/away/test", None).json
        self.assertFalse(answer["ok"])
        self.assertIn("127.0.0.1:1 cannot be reached", answer["detail"])
        self.daemon.request("DELETE", "/v1/connections/away")


class Configured(unittest.TestCase):
    def test_a_test_waits_for_no_other(self):
        daemon = Daemon("--allow-private-addresses").start()
        self.addCleanup(daemon.cleanup)
        with socket.create_server(("127.0.0.1", 0)) as silent:
            hook = {"kind": "webhook", "url": f"http://127.0.0.1:{silent.getsockname()[1]}/", "timeout_s": 30,
                    "secrets": ["whsec_" + "A" * 32]}
            for name, body in (("silent", hook), ("away", CONTROL)):
                self.assertEqual(daemon.request("PUT", f"/v1/connections/{name}", body).status, 201)
            answered = []

            def test(name):
                daemon.post(f"/v1/connections/{name}/test", None)
                answered.append(name)

            waiting = threading.Thread(target=test, args=("silent",))
            waiting.start()
            taken, _ = silent.accept()
            test("away")
            taken.close()
        waiting.join()
        self.assertEqual(answered, ["away", "silent"])

    def test_those_of_the_file_are_read_only(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / "connections.toml"
        path.write_text('[[connection]]\nname = "mill"\nkind = "lsv2"\naddress = "127.0.0.1:1"\n'
                        'paths = [\'TNC:\\logs\\*.TXT\']\n')
        daemon = Daemon("--connections", path)
        self.addCleanup(daemon.cleanup)
        daemon.start()
        self.assertTrue(daemon.get("/v1/connections/mill").json["read_only"])
        for method in ("PUT", "DELETE"):
            answer = daemon.request(method, "/v1/connections/mill", CONTROL if method == "PUT" else None)
            self.assertEqual((answer.status, answer.json["code"]), (409, "connection.read_only"), answer)
        self.assertEqual(daemon.request("PUT", "/v1/connections/other", CONTROL).status, 201)
        # The file goes before what is stored under the same name.
        path.write_text(path.read_text().replace('"mill"', '"other"'))
        daemon.kill()
        daemon.start()
        found = daemon.get("/v1/connections").json["connections"]
        self.assertEqual([(each["name"], each["read_only"]) for each in found], [("other", True)])
        self.assertEqual(daemon.stop(), 0)  # its log is written
        self.assertIn("connection_not_started", daemon.log)

    def test_the_file_must_not_store_again_what_it_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "connections.toml"
            path.write_text("".join(f'[[connection]]\nname = "{name}"\nkind = "{kind}"\nfolder = "{folder}"\n'
                                    for name, kind in (("cmm", "folder_in"), ("caq", "folder_out"))))
            checked = command("--connections", path, "--data", folder, "--check-config")
        self.assertEqual(checked.returncode, 2)
        self.assertIn("connections.toml:5: 'cmm' would store again what 'caq' writes", checked.stderr)

    def test_one_that_was_not_started_keeps_its_position(self):
        root = tempfile.TemporaryDirectory()
        self.addCleanup(root.cleanup)
        old, new = (pathlib.Path(root.name) / name for name in ("old", "new"))
        daemon = Daemon("--connection-folders", old)
        self.addCleanup(daemon.cleanup)
        daemon.start()

        def put(name, folder):
            folder.mkdir(exist_ok=True)
            return daemon.request("PUT", f"/v1/connections/{name}", {
                "kind": "folder_out", "folder": str(folder), "every_s": 1, "format": "ndjson"})

        def store(name):
            self.assertEqual(daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "part_id": name}).status, 201)

        def written(folder):
            return [json.loads(line)["part_id"] for file in sorted(folder.glob("*.ndjson"))
                    for line in file.read_text().splitlines()]

        self.assertEqual(put("caq", old).status, 201)
        store("before")
        wait_for(lambda: written(old) == ["before"], lambda: daemon.log)
        self.assertEqual(daemon.stop(), 0)
        daemon.flags = ["--connection-folders", str(new)]
        daemon.start()
        daemon.wait_for_log('"event":"connection_not_started"')
        shown, = daemon.get("/v1/connections").json["connections"]
        self.assertEqual((shown["name"], shown["kind"], shown["direction"], shown["state"], shown["folder"], shown["lag_s"]),
                         ("caq", "folder_out", "out", "failing", str(old), None))
        self.assertIn("connection_folders", shown["last_error"])
        tested = daemon.post("/v1/connections/caq/test", None).json
        self.assertEqual((tested["ok"], tested["detail"]), (False, shown["last_error"]))
        self.assertEqual(daemon.post("/v1/connections/caq/replay", {"from": "2026-11-20T00:00:00Z"}).status, 422)
        self.assertIn('fitgauge_connection_up{connection="caq"} 0', daemon.get("/metrics").text)
        store("between")
        self.assertEqual(put("CAQ", new).json["code"], "path.malformed")
        self.assertEqual(put("caq", new).status, 200)
        store("after")
        wait_for(lambda: written(new) == ["between", "after"], lambda: written(new))


if __name__ == "__main__":
    unittest.main()
