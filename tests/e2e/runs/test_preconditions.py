"""Files and setups with If-Match and If-None-Match (RFC 9110 section 13), and the forms of a path."""

import shutil

from support.daemon import Daemon, DaemonTest

PROGRAM = "0 BEGIN PGM p MM\n1 L X+%d FMAX\n2 END PGM p MM\n"


class Preconditions(DaemonTest):
    def check_resource(self, path, texts):
        """`texts` gives ever new contents."""
        def call(method, body=None, **fields):
            headers = {name.replace("_", "-"): value for name, value in fields.items()}
            if body is not None:
                headers["Content-Type"] = "application/json"
            return self.daemon.request(method, path, body, headers)

        def refused(answer, why=""):
            self.assertIn(why, self.assert_problem(answer, 412, "precondition.failed")["detail"])

        self.assertEqual(call("GET", If_Match="*").status, 404)
        self.assertEqual(call("DELETE", If_Match='"none"').status, 404)
        refused(call("PUT", next(texts), If_Match="*"), "does not exist")
        self.assertEqual(call("GET").status, 404, "a refused PUT stores nothing")

        made = call("PUT", next(texts), If_None_Match="*")
        self.assertEqual(made.status, 201, made)
        first = made.headers["etag"]
        self.assertRegex(first, '^"[^"]+"$', "strong")
        self.assertEqual(call("GET").headers["etag"], first)
        refused(call("PUT", next(texts), If_None_Match="*"), "exists")
        refused(call("PUT", next(texts), If_Match='"99"'))
        refused(call("PUT", next(texts), If_Match="W/" + first))
        refused(call("PUT", next(texts), If_None_Match='"99", W/' + first))
        self.assertEqual(call("GET").headers["etag"], first, "refused changes change nothing")

        second = call("PUT", next(texts), If_Match='"99", ' + first)
        self.assertEqual(second.status, 200, second)
        self.assertNotEqual(second.headers["etag"], first)
        refused(call("PUT", next(texts), If_Match=first))
        refused(call("DELETE", If_Match=first))
        current = second.headers["etag"]
        refused(call("GET", If_Match=first))
        self.assertEqual(call("HEAD", If_Match=first).status, 412)
        self.assertEqual(call("GET", If_Match=current).status, 200)
        self.assertEqual(call("GET", If_None_Match=first).status, 200)
        for tags in (current, "W/" + current, '"0", ' + current, "*"):
            self.assertEqual(call("GET", If_None_Match=tags).status, 304, tags)
        self.assertEqual(call("DELETE", If_Match=current).status, 204)
        self.assertEqual(call("GET").status, 404)

    def test_files(self):
        self.check_resource("/v1/files/nc_prog/e.h", (PROGRAM % n for n in range(100)))

    def test_plans(self):
        plan = ('{"characteristics":[{"name":"a","designation":"%d H7"}]}' % n for n in range(1, 100))
        self.check_resource("/v1/plans/4711", plan)

    def test_setups(self):
        self.check_resource("/v1/setups/mill", (f'{{"seed":{n}}}' for n in range(1, 100)))

    def test_of_two_programmers_one_keeps_his_work(self):
        path = "/v1/files/both.h"
        tag = self.daemon.request("PUT", path, PROGRAM % 0).headers["etag"]
        answers = [self.daemon.request("PUT", path, PROGRAM % n, {"If-Match": tag}).status for n in (1, 2)]
        self.assertEqual(answers, [200, 412])
        self.assertIn("X+1", self.daemon.get(path).text)


    def test_after_a_backup_is_put_back_a_tag_still_names_one_content(self):
        copy = self.daemon.folder / "copy.db"
        self.assertEqual(self.daemon.command("backup", copy).returncode, 0)
        branch = Daemon()
        self.addCleanup(branch.cleanup)
        branch.data.mkdir()
        shutil.copy(copy, branch.database)
        branch.start()
        path = "/v1/files/branched.h"
        tag = self.daemon.request("PUT", path, PROGRAM % 1).headers["etag"]
        other = branch.request("PUT", path, PROGRAM % 2).headers["etag"]
        self.assertEqual(branch.get(path, If_None_Match=tag).status, 200)
        self.assertEqual(branch.request("PUT", path, PROGRAM % 3, {"If-Match": tag}).status, 412)
        self.assertEqual(branch.request("DELETE", path, headers={"If-Match": tag}).status, 412)
        packed = other[:-1] + '-gzip"'
        self.assertEqual([branch.get(path, If_None_Match=each).status for each in (other, packed)], [304, 304])
        self.assertEqual(branch.request("PUT", path, PROGRAM % 1, {"If-Match": packed}).headers["etag"], tag)


class Paths(DaemonTest):
    def test_an_encoded_slash_is_a_slash(self):
        put = self.daemon.request("PUT", "/v1/files/nc_prog%2Fgen%2Fa.h", PROGRAM % 1)
        self.assertEqual(put.status, 201, put)
        self.assertEqual(put.headers["location"], "/v1/files/nc_prog/gen/a.h")
        self.assertEqual(self.daemon.get("/v1/files/nc_prog/gen/a.h").text, PROGRAM % 1)

    def test_a_run_takes_the_path_as_files_have_it(self):
        self.daemon.request("PUT", "/v1/files/nc_prog/forms.h", PROGRAM % 1)
        for form in ("TNC:\\nc_prog\\forms.h", "nc_prog/forms.h", "/v1/files/nc_prog/forms.h"):
            run = self.daemon.post("/v1/runs", {"program": form})
            self.assertEqual(run.status, 201, run)
            self.assertEqual(run.json["program"], "TNC:\\nc_prog\\forms.h")
        listed = self.daemon.get("/v1/runs?program=nc_prog/forms.h").json["runs"]
        self.assertEqual(len(listed), 3)


class Events(DaemonTest):
    def test_a_reader_that_comes_back_gets_what_follows_and_204_after_the_end(self):
        self.daemon.request("PUT", "/v1/files/m.a", '"LINE %2.0F", Q1;\n')
        self.daemon.request("PUT", "/v1/files/print.h",
                            "BEGIN PGM print MM\nQ1 = 1\nFN 16: F-PRINT m.a / SCREEN:\nQ1 = 2\n"
                            "FN 16: F-PRINT m.a / SCREEN:\nEND PGM print MM\n")
        run = self.daemon.post("/v1/runs", {"program": "print.h"}).json
        path = f"/v1/runs/{run['id']}/events"
        everything = self.daemon.get(path)
        self.assertEqual(everything.headers["x-accel-buffering"], "no")
        ids = [line[4:] for line in everything.text.splitlines() if line.startswith("id: ")]
        self.assertEqual(ids, [str(n + 1) for n in range(len(run["screen"]))] + ["end"])
        rest = self.daemon.get(path, **{"Last-Event-ID": "1"}).text
        self.assertTrue(everything.text.endswith(rest))
        self.assertEqual(rest.count("event: output"), len(run["screen"]) - 1)
        self.assertEqual(self.daemon.get(path + "?last_event_id=end").status, 204)
        self.assertEqual(self.daemon.get(path, **{"Last-Event-ID": "end"}).status, 204)


class OddNumbers(DaemonTest):
    def test_no_feed_makes_a_time_that_is_no_number(self):
        for machine in ({"rapid_mm_min": 1e-320}, {"rapid_mm_min": 2e-308},
                        {"probes": [{"number": 1, "feed_mm_min": 1e-320}]},
                        {"probes": [{"number": 1, "fmax_mm_min": 1e-320}]}):
            answer = self.daemon.post("/v1/runs", {"program": "p.h", "setup": {"machine": machine}})
            self.assert_problem(answer, 422, "request.invalid")
        self.daemon.request("PUT", "/v1/files/slow.h", "BEGIN PGM slow MM\nTOOL CALL 30 Z\nL X+10 F Q1\n"
                                                       "END PGM slow MM\n")
        run = self.daemon.post("/v1/runs", {"program": "slow.h", "parameters": {"Q1": 1e-320},
                                            "setup": {"machine": {"tools": [{"number": 30}]}}})
        self.assertIn(run.status, (201, 422), run)
        if run.status == 201:
            for what in ("", "/parameters", "/events", "/trace", "/trace?"):
                answer = self.daemon.get(f"/v1/runs/{run.json['id']}{what}")
                self.assertEqual(answer.status, 200, what)
            csv = self.daemon.get(f"/v1/runs/{run.json['id']}/trace", Accept="text/csv")
            self.assertEqual(csv.status, 200)
            self.assertNotIn("inf", csv.text)
        self.assertEqual(self.daemon.get("/livez").status, 200)
