"""The log of changes: what was changed of all that decides, by whom, with before and after, and what is in use."""

import base64
import hashlib
import json
import shutil
import sqlite3
import sys
import tempfile
import unittest

from support.daemon import ROOT, Daemon, DaemonTest
from support.seals import alter, sealed_anew

sys.path.insert(0, str(ROOT / "clients" / "python"))

import check_proof  # noqa: E402 - what an auditor runs

BUDGET = {"contributions": [{"name": "all", "standard_uncertainty": 0.8}]}
PLAN = {"characteristics": [{"name": "bore", "designation": "25 H7", "gauge": "G-1", "catalogue": "causes"}]}
SETUP = {"machine": {"tools": [{"number": 5, "radius_mm": 2}], "presets": [{"number": 1}], "active_preset": 1}}
COLUMN = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": -3}]}
FOLDERS = tempfile.mkdtemp(prefix="fitgauge-changes-")


def tearDownModule():
    shutil.rmtree(FOLDERS, ignore_errors=True)


def tree(leaves):
    """The root of RFC 6962."""
    if len(leaves) == 1:
        return leaves[0]
    split = 1 << (len(leaves) - 1).bit_length() - 1
    return hashlib.sha256(b"\1" + tree(leaves[:split]) + tree(leaves[split:])).digest()


class Changes(DaemonTest):
    flags = ("--connection-folders", FOLDERS)

    def put(self, path, body, status=201):
        answer = self.daemon.request("PUT", path, body)
        self.assertEqual(answer.status, status, answer)

    def delete(self, path):
        self.assertEqual(self.daemon.request("DELETE", path).status, 204)

    def changes(self, query=""):
        answer = self.daemon.get(f"/v1/changes?{query}")
        self.assertEqual(answer.status, 200, answer)
        return answer.json["changes"]

    def test_each_kind_is_logged_with_before_and_after(self):
        other = {"contributions": [{"name": "all", "standard_uncertainty": 0.1}]}
        self.put("/v1/uncertainties/bore", BUDGET)
        self.put("/v1/uncertainties/bore", BUDGET, 200)  # which changes nothing
        self.put("/v1/uncertainties/bore", other, 200)
        self.delete("/v1/uncertainties/bore")
        logged = self.changes("kind=budget&name=bore")
        self.assertEqual([(each["action"], each["before"], each["after"]) for each in logged],
                         [("created", None, BUDGET), ("replaced", BUDGET, other), ("deleted", other, None)])
        self.put("/v1/gauges-in-use/G-9", {"calibration_due": "2027-03-31"})
        calibration = self.daemon.post("/v1/gauges-in-use/G-9/calibrations", {"from": "2026-07-01", "due": "2027-07-01"}).json
        self.assertEqual([each["after"] for each in self.changes("kind=calibration&name=G-9")], [calibration])
        study = {"gauge": "G-9", "at": "2026-07-01", "kind": "type1", "input": {"values": [1, 2, 4], "reference": 2, "tolerance": 1}}
        self.put("/v1/studies/July", study)
        self.put("/v1/studies/July", study, 200)  # which changes nothing
        logged = self.changes("kind=study&name=July")
        self.assertEqual([each["after"] for each in logged], [self.daemon.get("/v1/studies/July").json])
        self.put("/v1/catalogues/c", {"causes": ["a"], "measures": ["b"]})
        self.put("/v1/plans/P-9", {"characteristics": [{"name": "bore", "designation": "25 H7"}]})
        self.put("/v1/setups/mill", SETUP)
        self.put("/v1/tables/hole/classes/SHOP", COLUMN)
        self.assertEqual(self.daemon.command("key", "create", "--role", "viewer", "--name", "panel").returncode, 0)
        self.assertEqual(self.daemon.command("key", "revoke", "--name", "panel").returncode, 0)
        self.put("/v1/connections/hook", {"kind": "mqtt", "broker": "mqtt://127.0.0.1:1", "user": "u", "password": "hidden",
                                          "topic": "a"})
        last = {each["kind"]: each for each in self.changes()}
        self.assertEqual(set(last), {"budget", "gauge", "calibration", "study", "catalogue", "plan", "setup", "tables", "key", "connection"})
        self.assertEqual((last["tables"]["name"], last["tables"]["after"]), ("hole/SHOP", COLUMN))
        self.assertEqual((last["key"]["action"], last["key"]["before"], last["key"]["after"]), ("revoked", {"role": "viewer"}, None))
        self.assertTrue(last["connection"]["after"]["password_set"])
        self.assertNotIn("hidden", self.daemon.get("/v1/changes").text)
        digits = self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01}).json["id"].split("-")[1]
        self.assertEqual([each["id"] for each in self.changes()],
                         [f"c{number}-{digits}" for number in range(1, len(self.changes()) + 1)])

    def test_a_list_is_read_in_pages_and_by_time(self):
        for number in range(5):
            self.put(f"/v1/uncertainties/page-{number}", BUDGET)
        all_of_them = self.changes()
        ids, path = [], "/v1/changes?limit=2"
        while path:
            answer = self.daemon.get(path)
            ids += [each["id"] for each in answer.json["changes"]]
            after = answer.json["next"]
            path = after and f"/v1/changes?limit=2&after={after}"
            self.assertEqual(answer.headers.get("link"), path and f'<{path}>; rel="next"')
        self.assertEqual(ids, [each["id"] for each in all_of_them])
        at = all_of_them[-2]["at"]
        self.assertEqual(self.changes(f"to={at}") + self.changes(f"from={at}"), all_of_them)
        self.assertEqual(self.changes("name=none"), [])
        newest = all_of_them[-1]["id"]
        self.assertEqual(self.changes(f"after={newest}"), [])
        number, digits = newest[1:].split("-")
        self.assert_problem(self.daemon.get(f"/v1/changes?after=c{int(number) + 1}-{digits}"), 400, "cursor.invalid")
        self.assert_problem(self.daemon.get("/v1/changes?kind=verdict"), 400, "query.invalid")

    def test_what_others_name_is_not_deleted(self):
        self.put("/v1/uncertainties/used", BUDGET)
        self.put("/v1/uncertainties/calibrated", BUDGET)
        self.put("/v1/gauges-in-use/G-1", {"uncertainty": "used", "calibration_due": "2027-03-31"})
        self.daemon.post("/v1/gauges-in-use/G-1/calibrations",
                         {"from": "2026-07-01", "due": "2027-07-01", "uncertainty": "calibrated"})
        self.put("/v1/catalogues/causes", {"causes": ["a"], "measures": ["b"]})
        self.put("/v1/plans/P-1", PLAN)
        self.put("/v1/studies/S-1", {"gauge": "G-1", "at": "2026-07-01", "kind": "type1",
                                     "input": {"values": [1, 2, 4], "reference": 2, "tolerance": 1}})
        paths = ("/v1/uncertainties/used", "/v1/uncertainties/calibrated", "/v1/gauges-in-use/G-1", "/v1/catalogues/causes")
        for path, by in zip(paths, ("gauge in use 'G-1'", "calibration 'G-1'", "plan 'P-1', study 'S-1'", "plan 'P-1'")):
            problem = self.assert_problem(self.daemon.request("DELETE", path), 409, "document.in_use")
            self.assertIn(by, problem["detail"])
        for path in ("/v1/plans/P-1", "/v1/studies/S-1", *reversed(paths)):
            self.delete(path)

    def test_what_a_watched_folder_sets_is_not_deleted(self):
        self.put("/v1/gauges-in-use/G-5", {"calibration_due": "2027-03-31"})
        self.put("/v1/tables/hole/classes/Own5", COLUMN)
        for names in ({"gauge": "G-5", "designation": "25 Own5"}, {"gauge": "G-5", "tolerance_class": "Own5"}):
            self.daemon.request("PUT", "/v1/connections/cmm", {"kind": "folder_in", "folder": FOLDERS, "set": names})
            for path in ("/v1/gauges-in-use/G-5", "/v1/tables/hole/classes/Own5"):
                problem = self.assert_problem(self.daemon.request("DELETE", path), 409, "document.in_use")
                self.assertIn("in use by connection 'cmm'", problem["detail"])
        self.delete("/v1/connections/cmm")
        for path in ("/v1/gauges-in-use/G-5", "/v1/tables/hole/classes/Own5"):
            self.delete(path)

    def test_the_picture_of_a_plan_is_not_deleted(self):
        forms = ("pic.png", "/v1/files/Shop/pic.png", "TNC:\\shop\\PIC.png")
        for part, form in enumerate(forms):
            self.put(f"/v1/plans/P-{part}", {"characteristics": [{"name": "a", "designation": "25 H7", "picture": form}]})
        for path, plans in (("/v1/files/pic.png", (0,)), ("/v1/files/shop/pic.png", (1, 2))):
            self.daemon.request("PUT", path, b"png")
            problem = self.assert_problem(self.daemon.request("DELETE", path), 409, "document.in_use")
            self.assertIn("by " + ", ".join(f"plan 'P-{part}'" for part in plans), problem["detail"])
            for part in plans:
                self.delete(f"/v1/plans/P-{part}")
            self.delete(path)

    def test_what_is_in_use_is_told_before_its_tag(self):
        """RFC 9110, 13.2.1: a precondition counts where the answer would be a success without it."""
        self.put("/v1/uncertainties/used-too", BUDGET)
        self.put("/v1/gauges-in-use/G-2", {"uncertainty": "used-too", "calibration_due": "2027-03-31"})
        self.daemon.request("PUT", "/v1/files/shop.png", b"png")
        self.put("/v1/plans/P-3", {"characteristics": [{"name": "a", "designation": "25 H7", "picture": "shop.png"}]})
        self.put("/v1/tables/hole/classes/Own3", COLUMN)
        self.put("/v1/plans/P-4", {"characteristics": [{"name": "a", "designation": "25 Own3"}]})
        of_others = {"If-Match": '"none"'}
        for path in ("/v1/uncertainties/used-too", "/v1/files/shop.png", "/v1/tables/hole/classes/Own3"):
            self.assert_problem(self.daemon.request("DELETE", path, headers=of_others), 409, "document.in_use")
        for path in ("/v1/gauges-in-use/G-2", "/v1/plans/P-3", "/v1/plans/P-4"):
            self.delete(path)
        for path in ("/v1/uncertainties/used-too", "/v1/files/shop.png", "/v1/tables/hole/classes/Own3"):
            self.assert_problem(self.daemon.request("DELETE", path, headers=of_others), 412, "precondition.failed")
            self.delete(path)
            self.assertEqual(self.daemon.request("DELETE", path, headers=of_others).status, 404)

    def test_a_class_of_a_plan_and_a_mesh_of_a_setup_are_not_deleted(self):
        for name in ("Own2", "Own1", "H7"):
            self.put(f"/v1/tables/hole/classes/{name}", COLUMN)
        self.put("/v1/plans/P-2", {"characteristics": [
            {"name": "a", "designation": "25 Own2"}, {"name": "b", "nominal_mm": 25, "tolerance_class": "Own1"},
            {"name": "c", "designation": "25 H7"}]})
        triangles = [((0, 0, 0), (0, 1, 0), (1, 0, 0)), ((0, 0, 0), (1, 0, 0), (0, 0, 1)),
                     ((0, 0, 0), (0, 0, 1), (0, 1, 0)), ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
        stl = "solid a\n" + "".join("facet normal 0 0 0\nouter loop\n" + "".join(
            f"vertex {x} {y} {z}\n" for x, y, z in each) + "endloop\nendfacet\n" for each in triangles) + "endsolid a\n"
        self.daemon.request("PUT", "/v1/files/parts/a.stl", stl, {"Content-Type": "model/stl"})
        self.put("/v1/setups/meshed", {"workpiece": {"features": [{"type": "mesh", "file": "parts/a.stl"}]}})
        self.delete("/v1/tables/hole/classes/H7")  # ISO 286 has it
        for path, by in (("/v1/tables/hole/classes/Own2", "plan 'P-2'"), ("/v1/tables/hole/classes/Own1", "plan 'P-2'"),
                         ("/v1/files/parts/a.stl", "setup 'meshed'")):
            problem = self.assert_problem(self.daemon.request("DELETE", path), 409, "document.in_use")
            self.assertIn(by, problem["detail"])
        for path in ("/v1/plans/P-2", "/v1/setups/meshed", "/v1/tables/hole/classes/Own2", "/v1/tables/hole/classes/Own1",
                     "/v1/files/parts/a.stl"):
            self.delete(path)

    def test_the_changes_are_a_tree_that_others_verify(self):
        large = {"features": [{"type": "bore", "center_mm": [0, 0], "diameter_mm": 10}] * 1200}
        self.put("/v1/setups/large", {**SETUP, "workpiece": large})
        for number in range(260):
            self.put(f"/v1/uncertainties/tree-{number}", BUDGET)
        note = self.daemon.get("/v1/log/changes/checkpoint").text
        name, size, root = note.split("\n")[:3]
        size = int(size)
        self.assertEqual(name, self.daemon.get("/v1/log/checkpoint").text.split("\n")[0] + "/changes")
        self.assertTrue(check_proof.is_signed(note, self.daemon.get("/v1/log/changes/key").text.split()))
        self.assertFalse(check_proof.is_signed(note, self.daemon.get("/v1/log/key").text.split()))
        entries, hashes = [], b""
        for first in range(0, size, 256):
            width = min(256, size - first)
            path = f"{first // 256:03d}" + (f".p/{width}" if width < 256 else "")
            bundle = self.daemon.get(f"/v1/log/changes/tile/entries/{path}").body
            hashes += self.daemon.get(f"/v1/log/changes/tile/0/{path}").body
            while bundle:
                length = int.from_bytes(bundle[:2], "big")
                entries.append(bundle[2:2 + length])
                bundle = bundle[2 + length:]
        leaves = [hashlib.sha256(b"\0" + entry).digest() for entry in entries]
        self.assertEqual((b"".join(leaves), len(leaves)), (hashes, size))
        self.assertEqual(base64.b64encode(tree(leaves)).decode(), root)
        self.assertEqual(self.daemon.get("/v1/log/changes/tile/1/000.p/1").body, tree(leaves[:256]))
        listed = self.changes("limit=1000")
        for entry, change in zip(map(json.loads, entries), listed, strict=True):
            # An entry has the number alone: its tree is the history.
            change["id"] = int(change["id"][1:].split("-")[0])
            if "after_sha256" in entry:
                self.assertEqual((change["name"], entry["before"]), ("large", None))
                text = self.daemon.get("/v1/setups/large").body
                self.assertEqual(entry["after_sha256"], hashlib.sha256(text).hexdigest())
            else:
                self.assertEqual(entry, change)
        self.assertEqual(sum(b"after_sha256" in entry for entry in entries), 1)
        self.assert_problem(self.daemon.get(f"/v1/log/changes/tile/0/001.p/{size % 256 + 1}"), 404, "resource.not_found")
        # One more leaf is another root; the same ones are the same note after a restart.
        self.assertEqual(self.daemon.get("/v1/log/changes/checkpoint").text, note)
        self.daemon.stop()
        self.daemon.start()
        self.assertEqual(self.daemon.get("/v1/log/changes/checkpoint").text, note)
        self.put("/v1/uncertainties/one-more", BUDGET)
        self.assertNotEqual(self.daemon.get("/v1/log/changes/checkpoint").text.split("\n")[2], root)

    def test_a_change_is_altered_by_nobody(self):
        self.put("/v1/uncertainties/kept", BUDGET)
        self.daemon.stop()
        with sqlite3.connect(self.daemon.database) as database:
            for statement in ("UPDATE changes SET name = 'x'", "DELETE FROM changes"):
                with self.assertRaisesRegex(sqlite3.IntegrityError, "a change is never"):
                    database.execute(statement)
        database.close()
        self.daemon.start()
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def assert_verified(self, daemon, line, *flags, status=1):
        verified = daemon.command("verify", *flags)
        self.assertEqual(verified.returncode, status, verified.stdout)
        self.assertIn(line, verified.stdout)

    def test_a_kept_head_of_changes_is_verified(self):
        daemon, other = Daemon(), Daemon()
        heads = []
        for each, count in ((daemon, 260), (other, 10)):
            self.addCleanup(each.cleanup)
            each.start()
            for number in range(count):
                self.assertEqual(each.request("PUT", f"/v1/uncertainties/b-{number}", BUDGET).status, 201)
                if number in (9, 259):
                    heads.append(each.folder / f"head-{number}")
                    heads[-1].write_text(each.get("/v1/log/changes/checkpoint").text)
            self.assertEqual(each.stop(), 0)
        for head in heads[:2]:
            self.assert_verified(daemon, "/changes: 260 changes, root ", "--checkpoint", head, status=0)
        self.assert_verified(daemon, "is not a checkpoint of this log", "--checkpoint", heads[2])
        alter(daemon.database, "DROP TRIGGER changes_are_not_updated", "UPDATE changes SET caller = 'nobody' WHERE id = 7",
              sealed_anew("changes"))
        self.assert_verified(daemon, "change 7 was altered")
        for head in heads[:2]:
            self.assert_verified(daemon, f"differ from the ones that {head} has signed", "--checkpoint", head)
        alter(daemon.database, "DROP TRIGGER changes_are_not_deleted", "DELETE FROM changes WHERE id = 100")
        self.assert_verified(daemon, "changes after 0 are missing")


if __name__ == "__main__":
    unittest.main()
