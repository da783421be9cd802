"""Parts from CAD: STL files of the control's disk as workpieces. The files and what they measure are made here."""

import math
import struct

from support.control import ControlTest, workpiece


def ring(inside, outside, height, corners):
    """A ring below Z 0 whose hole and outside are regular prisms, as triangles."""
    profile = [(inside, -height), (outside, -height), (outside, 0), (inside, 0)]

    def corner(i, j):
        angle, (radius, z) = 2 * math.pi * (i % corners) / corners, profile[j % 4]
        return radius * math.cos(angle), radius * math.sin(angle), z

    for i in range(corners):
        for j in range(4):
            a, b, c, d = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
            yield a, b, c
            yield a, c, d


def binary(triangles):
    records = [struct.pack("<12fH", 0, 0, 0, *(x for p in t for x in p), 0) for t in triangles]
    return b"ring".ljust(80) + struct.pack("<I", len(records)) + b"".join(records)


def text(triangles):
    lines = ["solid ring"]
    for t in triangles:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x!r} {y!r} {z!r}" for x, y, z in t), "endloop",
                  "endfacet"]
    return "\n".join(lines + ["endsolid ring"])


MEASURE = ("TOOL CALL 30 Z", "L Z+100 R0 FMAX",
           "TCH PROBE 421 MEASURE HOLE ~\n Q273=+50 ~\n Q274=+40 ~\n Q262=+25 ~\n Q325=+2.045455 ~\n Q247=+90 ~\n"
           " Q261=-10 ~\n Q320=+0 ~\n Q260=+40 ~\n Q301=+0 ~\n Q275=+25.021 ~\n Q276=+24.9 ~\n Q279=+0 ~\n"
           " Q280=+0 ~\n Q281=+0 ~\n Q309=+0 ~\n Q330=+0")


class Meshes(ControlTest):
    # 88 corners: at half a face and 90 degrees on, the ball meets faces squarely.
    RING = list(ring(12.5, 30, 30, 88))
    ACROSS = 25 * math.cos(math.pi / 88)

    def mesh(self, **members):
        return workpiece({"type": "mesh", "file": "parts/ring.stl", **members})

    def measured(self, setup):
        run = self.run_program(self.upload_program("p", *MEASURE), setup)
        self.assertEqual(run["status"], "completed", run["messages"])
        return run["parameters"]

    def assert_bore(self, parameters, across=ACROSS):
        for name, value in (("Q151", 50), ("Q152", 40), ("Q153", across)):
            # The corners of a binary file are floats of 24 bits.
            self.assertAlmostEqual(parameters[name], value, delta=4e-6, msg=name)

    def test_a_tessellated_bore_measures_its_faces(self):
        for name, content in (("binary", binary(self.RING)), ("text", text(self.RING))):
            with self.subTest(name):
                self.upload("parts/ring.stl", content)
                self.assert_bore(self.measured(self.mesh(origin_mm=[50, 40, 0])))

    def test_inches_and_angles(self):
        # Lying on its side along Y in inches, and stood up by the setup.
        lying = [[(x / 25.4, -z / 25.4, y / 25.4) for x, y, z in t] for t in self.RING]
        self.upload("parts/ring.stl", binary(lying))
        self.assert_bore(self.measured(self.mesh(unit="inch", origin_mm=[50, 40, 0], spatial_angles_deg=[-90, 0, 0])))
        # Beside its zero and above it, and turned about Z.
        aside = [[(x + 7, y, z + 25) for x, y, z in t] for t in self.RING]
        self.upload("parts/ring.stl", binary(aside))
        self.assert_bore(self.measured(self.mesh(origin_mm=[50, 33, -25], spatial_angles_deg=[0, 0, 90])))

    def test_a_bore_in_a_mesh_is_exact(self):
        self.upload("parts/ring.stl", binary(self.RING))
        setup = self.mesh(origin_mm=[50, 40, 0])
        setup["workpiece"]["features"].append({"type": "bore", "center_mm": [50, 40], "diameter_mm": 25.013})
        self.assert_bore(self.measured(setup), 25.013)

    def test_what_is_no_body_is_refused_with_its_place(self):
        program = self.upload_program("p", *MEASURE)
        bad = {"is open: the edge from": binary(self.RING[1:]),
               "is inverted: its volume is -": binary([(a, c, b) for a, b, c in self.RING]),
               "is degenerate: triangle 1 at": binary([(self.RING[0][0],) * 3, *self.RING]),
               "is not an STL file": b"BEGIN PGM"}
        for words, content in bad.items():
            with self.subTest(words):
                self.upload("parts/ring.stl", content)
                answer = self.post_run(program, self.mesh())
                self.assertEqual(answer.status, 422, answer)
                entry = answer.json["errors"][0]
                self.assertEqual(entry["pointer"], "/setup/workpiece/features/0/file")
                self.assertIn(words, entry["detail"])
                answer = self.daemon.request("PUT", "/v1/setups/m", self.mesh())
                self.assertEqual(answer.status, 422, answer)

    def test_a_setup_may_be_stored_before_its_parts(self):
        setup = workpiece({"type": "mesh", "file": "TNC:\\parts\\later.stl", "origin_mm": [50, 40, 0]})
        self.assertIn(self.daemon.request("PUT", "/v1/setups/later", setup).status, (200, 201))
        program = self.upload_program("p", *MEASURE)
        answer = self.post_run(program, "later")
        self.assertEqual(answer.status, 422, answer)
        self.assertEqual(answer.json["errors"][0]["code"], "file.unknown")
        self.assertIn("later.stl is not on the control's disk", answer.json["errors"][0]["detail"])
        self.upload("parts/later.stl", binary(self.RING))
        self.assert_bore(self.measured("later"))
