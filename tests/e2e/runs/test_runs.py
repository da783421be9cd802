"""Files, setups and the life of a run: asynchronous, followed, cancelled, repeated, interrupted."""

import json
import unittest

from runs.test_mesh import binary, ring
from support.control import FOREVER, ControlTest
from support.daemon import Daemon

LONG = {"blocks": 100_000_000, "seconds": 60}


class Files(ControlTest):
    def test_bytes_come_back_as_they_went(self):
        content = bytes(range(256))
        first = self.daemon.request("PUT", "/v1/files/Some/Dir/File.H", content)
        self.assertEqual(first.status, 201)
        again = self.daemon.request("PUT", "/v1/files/some/dir/file.h", content)
        self.assertEqual(again.status, 200)
        read = self.daemon.get("/v1/files/SOME/dir/FILE.h")
        self.assertEqual((read.status, read.body), (200, content))
        head = self.daemon.request("HEAD", "/v1/files/some/dir/file.h")
        self.assertEqual((head.status, head.headers["content-length"]), (200, "256"))
        self.assertEqual(self.daemon.get("/v1/files/some/dir/file.h",
                                         If_None_Match=read.headers["etag"]).status, 304)
        listed = self.daemon.get("/v1/files?prefix=some/").json["files"]
        self.assertEqual([(f["path"], f["size"]) for f in listed], [("TNC:\\some\\dir\\file.h", 256)])
        self.assertEqual(self.daemon.request("DELETE", "/v1/files/some/dir/file.h").status, 204)
        self.assert_problem(self.daemon.get("/v1/files/some/dir/file.h"), 404, "file.unknown")

    def test_uploaded_table_goes_before_the_live_one(self):
        table = "BEGIN 82553_hole .TAB MM\nNR      BEREICH H7\n0       50      30\n1       50      5\n[END]\n"
        self.upload("own/82553_hole.tab", table)
        self.upload("own/p.h", "0 BEGIN PGM p MM\n1 FN 26: TABOPEN 82553_hole.tab\n"
                               "2 FN 28: TABREAD Q1 = 0/\"H7\"\n3 END PGM p MM\n")
        run = self.run_program("TNC:\\own\\p.h")
        self.assertEqual(run["parameters"]["Q1"], 30)
        self.assertEqual(run["tables"][0]["source"], "stored")


class Setups(ControlTest):
    def test_setup_is_kept_and_used_by_name(self):
        setup = {"machine": {"start_mm": {"Z": 300}}, "seed": 7}
        self.assertEqual(self.daemon.request("PUT", "/v1/setups/mill-1", setup).status, 201)
        self.assertEqual(self.daemon.get("/v1/setups/mill-1").json, setup)
        self.assertEqual([s["name"] for s in self.daemon.get("/v1/setups").json["setups"]], ["mill-1"])
        program = self.upload_program("nothing", "Q1 = 1")
        run = self.run_program(program, "mill-1")
        self.assertEqual(run["setup_seed"], 7)
        order = self.daemon.get(f"/v1/runs/{run['id']}/request").json
        self.assertEqual(order["setup"], setup)
        self.assertEqual(self.daemon.request("DELETE", "/v1/setups/mill-1").status, 204)
        self.assert_problem(self.daemon.get("/v1/setups/mill-1"), 404, "setup.unknown")
        problem = self.assert_problem(self.post_run(program, "mill-1"), 422, "request.invalid")
        self.assertEqual(problem["errors"][0]["code"], "setup.unknown")

    def test_every_error_has_its_pointer(self):
        setup = {"machine": {"axes": {"X": {"min_mm": 10, "max_mm": 5}, "U": {}},
                             "tools": [{"length_mm": "a"}], "rapid_mm_min": -1,
                             "calibration_sphere": {"radius_mm": 0, "diameter_mm": 25}},
                 "workpiece": {"features": [{"type": "bore", "center_mm": [1], "diameter_mm": 25.0000001},
                                            {"type": "cone"},
                                            {"type": "sphere", "center_mm": [0, 0, 0], "diameter_mm": 0}]},
                 "sead": 1}
        problem = self.assert_problem(self.daemon.request("PUT", "/v1/setups/bad", setup),
                                      422, "request.invalid")
        found = {entry["pointer"]: entry["code"] for entry in problem["errors"]}
        self.assertEqual(found, {"/machine/axes/X/max_mm": "field.conflict",
                                 "/machine/axes/U": "field.unknown",
                                 "/machine/tools/0/number": "field.missing",
                                 "/machine/tools/0/length_mm": "length.malformed",
                                 "/machine/rapid_mm_min": "field.invalid",
                                 "/machine/calibration_sphere/center_mm": "field.missing",
                                 "/machine/calibration_sphere/radius_mm": "field.invalid",
                                 "/machine/calibration_sphere/diameter_mm": "field.unknown",
                                 "/workpiece/features/0/center_mm": "field.invalid",
                                 "/workpiece/features/0/diameter_mm": "length.too_fine",
                                 "/workpiece/features/1/type": "field.invalid",
                                 "/workpiece/features/2/diameter_mm": "field.invalid",
                                 "/sead": "field.unknown"})


class Runs(ControlTest):
    def start(self, program, setup=None, **order):
        answer = self.post_run(program, setup, headers={"Prefer": "respond-async"}, **order)
        self.assertEqual(answer.status, 202, answer)
        self.assertEqual(answer.json["status"], "queued", "as a repeat of the request answers")
        return answer.headers["location"]

    def test_run_is_followed_to_its_end(self):
        self.upload("say.a", '"STEP %2.0F", Q1;\n')
        program = self.upload_program("steps", "Q1 = 0", "LBL 1", "Q1 = Q1 + 1",
                                      "FN 16: F-PRINT say.a / SCREEN:", "CALL LBL 1 REP 2")
        with self.daemon.client() as client:
            name = client.start_run(program)["id"]
            live = list(client.run_events(name))
            self.assertEqual([event.data["line"] for event in live if event.type == "output"],
                             ["STEP  1", "STEP  2", "STEP  3"])
            run = client.run(name)
            self.assertEqual((live[-1].type, live[-1].data), ("end", run))
            self.assertEqual(run["status"], "completed")
            self.assertEqual(client.run_parameters(name), run["parameters"])
            later = list(client.run_events(name))
            self.assertEqual([event for event in live if event.type != "progress"], later)

    def test_run_is_cancelled(self):
        place = self.start(self.upload_program("endless", *FOREVER), limits=LONG)
        self.assertEqual(self.daemon.request("DELETE", place).status, 204)
        run = self.daemon.get(place).json
        self.assertEqual(run["status"], "cancelled")
        self.assertEqual(run["messages"][-1]["kind"], "cancelled")
        self.assert_problem(self.daemon.request("DELETE", place), 409, "run.finished")

    def test_queued_run_is_cancelled_before_its_first_block(self):
        endless = self.upload_program("endless2", *FOREVER)
        places = [self.start(endless, {"seed": seed, "machine": {"presets": [{"number": seed}], "active_preset": seed}},
                             limits=LONG) for seed in range(10, 14)]
        for seed, place in reversed(list(enumerate(places, start=10))):
            self.assertEqual(self.daemon.request("DELETE", place).status, 204)
            run = self.daemon.get(place).json
            self.assertEqual((run["status"], run["setup_seed"], run["active_preset"]), ("cancelled", seed, seed))

    def test_end_of_a_run_is_an_event(self):
        completed = self.run_program(self.upload_program("over", "Q1 = 1"))
        failed = self.run_program(self.upload_program("bad", "Q1 = 1 / 0"))
        ids = (completed["id"], failed["id"])
        with self.daemon.client() as client:
            events = client.events(last_event_id="m0.e0")
            finished = (event.data for event in events if event.type == "run.finished" and event.data["id"] in ids)
            for run in (completed, failed):
                fields = ("id", "status", "program", "finished_at", "verdict")
                self.assertEqual(next(finished), {field: run[field] for field in fields})
            events.close()

    def test_too_many_runs_are_refused_until_there_is_room(self):
        endless = self.upload_program("endless3", *FOREVER)
        self.daemon.request("PUT", "/v1/setups/queued", {})
        places = []
        while True:
            answer = self.post_run(endless, "queued", {"Prefer": "respond-async"}, limits=LONG)
            if answer.status != 202:
                break
            places.append(answer.headers["location"])
        self.assert_problem(answer, 503, "service.overloaded")
        for path in ("/v1/setups/queued", "/v1/files/endless3.h"):
            for condition in ({}, {"If-Match": '"none"'}):
                problem = self.assert_problem(self.daemon.request("DELETE", path, headers=condition), 409, "document.in_use")
                self.assertIn("queued run r", problem["detail"])
        self.assertIn("retry-after", answer.headers)
        for place in places:
            self.assertEqual(self.daemon.request("DELETE", place).status, 204)

    def test_the_meshes_of_a_queued_run_are_not_deleted(self):
        endless = self.upload_program("endless4", *FOREVER)
        meshes = [{"type": "mesh", "file": f"parts/{name}.stl"} for name in ("part", "clamp", "free")]
        for mesh in meshes:
            self.upload(mesh["file"], binary(ring(12.5, 30, 30, 8)))
        own = {"workpiece": {"features": meshes[:1], "fixtures": meshes[1:2]}}
        places = [self.start(endless, own, limits=LONG) for _ in range(3)]
        for mesh in meshes[:2]:
            problem = self.assert_problem(self.daemon.request("DELETE", "/v1/files/" + mesh["file"]), 409, "document.in_use")
            self.assertIn("queued run r", problem["detail"])
        self.assertEqual(self.daemon.request("DELETE", "/v1/files/parts/free.stl").status, 204)
        for place in reversed(places):
            self.assertEqual(self.daemon.request("DELETE", place).status, 204)
        for mesh in meshes[:2]:
            self.assertEqual(self.daemon.request("DELETE", "/v1/files/" + mesh["file"]).status, 204)

    def test_a_parameter_is_watched_once_and_set_once(self):
        program = self.upload_program("once1", "Q1 = 1")
        run = self.run_program(program, watch=["q1", "Q1", "Q01", "QS1"])
        trace = self.daemon.get(f"/v1/runs/{run['id']}/trace").text
        blocks = dict(json.loads(trace, object_pairs_hook=list))["blocks"]
        self.assertEqual([dict(block)["values"] for block in blocks][-1], [("Q1", 1)])
        problem = self.assert_problem(self.post_run(program, parameters={"q1": 1, "Q1": 2, "Q2": 3, "Q01": 1}),
                                      422, "request.invalid")
        self.assertEqual([(each["pointer"], each["code"]) for each in problem["errors"]],
                         [("/parameters/Q1", "field.conflict"), ("/parameters/Q01", "field.conflict")])

    def test_files_of_one_name_are_read_by_their_paths(self):
        self.upload("out.a", '"IN %s", QS1;\n')
        program = self.upload_program("twice", 'QS1 = "A"', "FN 16: F-PRINT out.a / a\\out.txt", 'QS1 = "B"',
                                      "FN 16: F-PRINT out.a / b\\out.txt")
        run = self.run_program(program)
        self.assertEqual([each["path"] for each in run["files"]], ["TNC:\\a\\out.txt", "TNC:\\b\\out.txt"])
        files = f"/v1/runs/{run['id']}/files/"
        for name, text in (("out.txt", "IN A"), ("a%2Fout.txt", "IN A"), ("b%2FOUT.TXT", "IN B"), ("b%5Cout.txt", "IN B"),
                           ("tnc%3A%5CB%5Cout.txt", "IN B")):
            self.assertEqual(self.daemon.get(files + name).text.strip(), text, name)
        for name in ("c%2Fout.txt", "b%2Fnone.txt", "D%3A%5Cout.txt"):
            self.assert_problem(self.daemon.get(files + name), 404, "file.unknown")
        with self.daemon.client() as client:
            self.assertEqual(client.run_file(run["id"], "TNC:\\b\\out.txt").strip(), b"IN B")

    def test_repeat_with_the_same_key_is_the_same_run(self):
        program = self.upload_program("once", "Q1 = 5")
        key = {"Idempotency-Key": '"run-1"'}
        first = self.post_run(program, headers=key)
        again = self.post_run(program, headers={"Idempotency-Key": "run-1"})
        self.assertEqual((first.status, first.body, first.headers["location"]),
                         (again.status, again.body, again.headers["location"]))
        other = self.post_run(program, headers=key, parameters={"Q2": 1})
        self.assert_problem(other, 422, "idempotency.key_reused")
        for number in range(20):
            at_once = {"Idempotency-Key": f"async-{number}", "Prefer": "respond-async"}
            first, again = (self.post_run(program, headers=at_once) for _ in range(2))
            self.assertEqual((first.status, first.body), (202, again.body))

    def test_runs_are_listed_the_newest_first(self):
        program = self.upload_program("listed", "Q1 = 1")
        ids = [self.run_program(program)["id"] for _ in range(3)]
        answer = self.daemon.get("/v1/runs?program=tnc:%5Clisted.h&limit=2")
        self.assertEqual([run["id"] for run in answer.json["runs"]], ids[:0:-1])
        following = f"/v1/runs?program=tnc:%5Clisted.h&limit=2&after={answer.json['next']}"
        self.assertEqual(answer.headers["link"], f'<{following}>; rel="next"')
        last = self.daemon.get(following)
        self.assertEqual(([run["id"] for run in last.json["runs"]], last.json["next"]), ([ids[0]], None))
        self.assertNotIn("link", last.headers)
        completed = self.daemon.get("/v1/runs?status=completed&limit=1000").json["runs"]
        self.assertTrue(set(ids) <= {run["id"] for run in completed})
        self.assertEqual(self.daemon.get("/v1/runs?program=tnc:%5Clisted.h&status=failed").json["runs"], [])
        self.assert_problem(self.daemon.get("/v1/runs?status=done"), 400, "query.invalid")

    def test_start_at_a_block_runs_nothing_before_it(self):
        program = self.upload_program("begun", "Q1 = 1", "Q2 = 2", "; from here", "Q3 = Q9", "STOP")
        order = {"program": program, "parameters": {"Q9": 7}, "on_stop": "end"}
        for number, expected in ((0, {"Q1": 1, "Q2": 2}), (2, {"Q2": 2}), (3, {}), (4, {})):
            run = self.daemon.post("/v1/runs", {**order, "start_block": number}).json
            self.assertEqual(run["parameters"], {**expected, "Q3": 7, "Q9": 7}, number)
            self.assertEqual((run["status"], run["messages"][0]["block"]), ("stopped", 5))
        refused = self.assert_problem(self.daemon.post("/v1/runs", {**order, "start_block": 99}), 422, "request.invalid")
        self.assertEqual(refused["errors"], [{"pointer": "/start_block", "code": "field.invalid",
                                              "detail": f"{program} has no block 99; its last block is 6"}])

    def test_watched_parameters_stand_in_the_trace_after_each_block(self):
        program = self.upload_program("watched", "Q1 = 1", "LBL 1", "Q1 = Q1 + 1", 'QS2 = "two"', "FN 12: IF +Q1 LT +3 GOTO LBL 1")
        order = {"program": program, "watch": ["Q1", "qs2", "QL7"]}
        trace = self.daemon.get(f"/v1/runs/{self.daemon.post('/v1/runs', order).json['id']}/trace").json
        self.assertEqual([(b["block"], b["line"], b["program"], b["values"]) for b in trace["blocks"]],
                         [(1, 2, program, {"Q1": 1}), (3, 4, program, {"Q1": 2}),
                          (4, 5, program, {"Q1": 2, "QS2": "two"}), (5, 6, program, {"Q1": 2, "QS2": "two"}),
                          (3, 4, program, {"Q1": 3, "QS2": "two"}), (4, 5, program, {"Q1": 3, "QS2": "two"}),
                          (5, 6, program, {"Q1": 3, "QS2": "two"}), (6, 7, program, {"Q1": 3, "QS2": "two"})])
        self.assertEqual([b["moves"] for b in trace["blocks"]], [0] * 8)
        self.assertEqual((trace["dropped"], trace["blocks_dropped"]), (0, 0))
        unwatched = self.daemon.post("/v1/runs", {"program": program}).json["id"]
        self.assertNotIn("blocks", self.daemon.get(f"/v1/runs/{unwatched}/trace").json)
        refused = self.assert_problem(self.daemon.post("/v1/runs", {**order, "watch": ["Q1", "X", 3]}), 422, "request.invalid")
        self.assertEqual([(e["pointer"], e["code"]) for e in refused["errors"]],
                         [("/watch/1", "field.invalid"), ("/watch/2", "field.type")])

    def test_a_block_of_the_trace_has_the_tool_in_the_spindle(self):
        self.upload("TOOLS.I", '%TOOLS G71 *\nN10 Q1 = 7 *\nN20 QS1 = "T8" *\nN30 T5 G17 S900 *\nN40 G62 T0.05 *\n'
                    'N50 G51 T8 *\nN60 TQ1 G17 *\nN70 T"D10" G17 *\nN99999999 %TOOLS G71 *\n')
        run = self.daemon.post("/v1/runs", {"program": "TNC:\\TOOLS.I", "watch": ["Q1"], "setup": {"machine": {"tools": [
            {"number": number, "name": f"D{number + 2}", "length_mm": 80, "radius_mm": 4} for number in (5, 7, 8)]}}}).json
        self.assertEqual(run["messages"], [])
        blocks = self.daemon.get(f"/v1/runs/{run['id']}/trace").json["blocks"]
        self.assertEqual([(each["block"], each["tool"]) for each in blocks],
                         [(10, 0), (20, 0), (30, 5), (40, 5), (50, 5), (60, 7), (70, 8), (99999999, 8)])

    def test_measured_and_read_values_name_the_blocks_they_come_from(self):
        hole = "TCH PROBE 421 MEASURE HOLE Q273=+50 Q274=+40 Q262=+Q5 Q247=+90 Q261=-5 Q260=+20"
        program = self.upload_program("origins", "TOOL CALL 30 Z", "Q5 = 25", "CALL LBL 1", "L X+20 FMAX",
                                      "FN 18: SYSREAD Q2 = ID270 NR1 IDX1", "M30", "LBL 1", hole, "LBL 0")
        bore = {"type": "bore", "center_mm": [50, 40], "top_mm": 0, "depth_mm": 30, "diameter_mm": 25.013}
        block = {"type": "block", "min_mm": [0, 0, -40], "max_mm": [100, 80, 0]}
        run = self.run_program(program, {"workpiece": {"features": [block, bore]}}, watch=["Q2"])
        self.assertEqual([[(each["line"], each["message"]) for each in one["origins"]] for one in run["measurements"]],
                         [[(3, "Q5 set here")]])
        trace = self.daemon.get(f"/v1/runs/{run['id']}/trace").json
        self.assertEqual([(b["line"], [(each["line"], each["program"], each["message"]) for each in b["origins"]])
                          for b in trace["blocks"] if "origins" in b],
                         [(9, [(3, program, "Q5 set here")]),
                          (6, [(2, program, "tool set here"), (5, program, "X set here"), (9, program, "Z, Y set here")])])

    def test_blocks_of_a_long_watch_are_counted_beyond_4_mib(self):
        program = self.upload_program("long", "Q1 = 0", "LBL 1", "Q1 = Q1 + 1", "FN 12: IF +Q1 LT +50000 GOTO LBL 1")
        run = self.daemon.post("/v1/runs", {"program": program, "watch": ["Q1"], "limits": LONG}).json
        self.assertEqual(run["status"], "completed", run)
        trace = self.daemon.get(f"/v1/runs/{run['id']}/trace").json
        self.assertGreater(trace["blocks_dropped"], 0)
        self.assertEqual(len(trace["blocks"]) + trace["blocks_dropped"], 100_002)

    def test_order_with_wrong_fields_lists_them_all(self):
        answer = self.daemon.post("/v1/runs", {"program": "C:\\x.h", "parameters": {"Q9999": 1, "QS1": 5},
                                               "limits": {"blocks": 0, "seconds": 61},
                                               "on_stop": "wait", "block_skip": "yes", "more": 1})
        found = {e["pointer"] for e in self.assert_problem(answer, 422, "request.invalid")["errors"]}
        self.assertEqual(found, {"/program", "/parameters/Q9999", "/parameters/QS1", "/limits/blocks",
                                 "/limits/seconds", "/on_stop", "/block_skip", "/more"})

    def test_unknown_run(self):
        for path in ("r0", "r999", "r999/trace", "r999/events", "r999/parameters", "r999/files/x", "nonsense"):
            self.assert_problem(self.daemon.get(f"/v1/runs/{path}"), 404, "run.unknown")

    def test_cycles_are_described(self):
        cycles = self.daemon.get("/v1/cycles").json["cycles"]
        self.assertTrue({247, 417, 421, 422, 427} <= {cycle["number"] for cycle in cycles})
        hole = self.daemon.get("/v1/cycles/421").json
        self.assertEqual(hole["name"], "MEASURE HOLE")
        diameter = next(p for p in hole["parameters"] if p["name"] == "Q262")
        self.assertEqual((diameter["unit"], diameter["range"]), ("mm", {"min": 0, "max": 99999.9999}))
        self.assertIn("Q153", [result["name"] for result in hole["results"]])
        self.assert_problem(self.daemon.get("/v1/cycles/999"), 404, "cycle.unknown")


class Interruptions(unittest.TestCase):
    def setUp(self):
        self.daemon = Daemon()
        self.addCleanup(self.daemon.cleanup)
        self.daemon.start()
        lines = ["BEGIN PGM loop MM", *FOREVER, "END PGM loop MM"]
        self.daemon.request("PUT", "/v1/files/loop.h",
                            "".join(f"{n} {text}\n" for n, text in enumerate(lines)))
        self.places = [
            self.daemon.post("/v1/runs", {"program": "TNC:\\loop.h", "limits": LONG,
                                          "setup": {"seed": seed}},
                             {"Prefer": "respond-async"}).headers["location"]
            for seed in range(4)]

    def test_killed_daemon_leaves_failed_runs(self):
        self.daemon.kill()
        self.daemon.start()
        for seed, place in enumerate(self.places):
            run = self.daemon.get(place).json
            self.assertEqual((run["status"], run["setup_seed"]), ("failed", seed))
            self.assertEqual(run["messages"][0]["program"], "TNC:\\loop.h")

    def test_shutdown_cancels_runs(self):
        self.assertEqual(self.daemon.stop(), 0)
        self.daemon.start()
        for place in self.places:
            self.assertEqual(self.daemon.get(place).json["status"], "cancelled")
