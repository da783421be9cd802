"""/openapi.json is the contract: every operation is described, and what it answers is what it says."""

import re
import unittest

from support.contract_test import SETUP, ContractTest
from support.control import FOREVER
from support.daemon import ROOT

PLAN = {"part": "4711-A", "name": "Housing", "characteristics": [
    {"name": "bore-A", "designation": "25 H7", "gauge": "G-07"},
    {"name": "slot", "nominal_mm": 8, "feature": "hole", "upper_um": 36, "lower_um": 0, "reaction": "Stop"}]}


class Answers(ContractTest):
    def test_every_operation_answers_as_its_schema_says(self):
        self.succeeded = set()
        self.expect("getLimits", 200, designation="25H7")
        self.expect("findLimits", 200, nominal_mm=25, tolerance_class="g6")
        self.expect("getFit", 200, hole="25H7", shaft="g6")
        self.expect("getFitAsOne", 200, fit="25H7/g6")
        self.expect("getVerdict", 200, designation="25H7", measured_mm=25.02, rule="guard_band", uncertainty_um=1,
                    degrees_of_freedom=9)
        self.expect("getVerdict", 200, designation="25H7(E)", measured_mm=25.02, temperature_c=30)
        self.expect("getVerdict", 200, designation="25H7", measured_mm=25.02, rule="conformance", uncertainty_um=1,
                    temperature_c=23, part_material="steel", temperature_uncertainty_c=0.1)
        self.expect("getVerdict", 422, designation="25H7", measured_mm=25.02, rule="conformance", uncertainty_um=9)
        self.expect("listTables", 200)
        housing = (ROOT / "tests/fuzz/corpus/step/housing.stp").read_bytes()
        self.expect("readDrawing", 200, housing, {"Content-Type": "model/step"})
        self.expect("putPlan", 201, housing, {"Content-Type": "model/step"}, part="drawn")
        self.expect("getPlan", 200, part="drawn")
        column = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": "-3"}]}
        for table, name in (("Hole", "SHOP"), ("Shaft", "shop")):
            self.expect(f"put{table}TableColumn", 201, column, name=name)
            self.expect(f"put{table}TableColumn", 200, column, name=name)
            self.expect(f"get{table}Table", 200, classes=name)
            self.expect(f"get{table}Table", 200, format="csv")
            self.expect(f"get{table}TableTab", 200)
            self.expect(f"delete{table}TableColumn", 204, name=name)
        self.measurements()
        self.fits()
        self.statistics()
        self.runs()
        self.expect("listCycles", 200)
        self.expect("getCycle", 200, number=421)
        self.shared()
        for name in ("live", "ready", "getMetrics", "getOpenapi", "getPage"):
            self.expect(name, 200)
        self.expect("getPageFile", 200, path="app.js")
        self.assert_seen("Limits", "Fit", "Verdict", "Measurement", "MeasurementList", "SummaryGroup", "Accepted",
                         "RunOrder", "Diagnostic", "Cycle", "Trace",
                         without={"RunOrder": {"block_skip", "language"}, "Measurement": {"caller", "conflict"}})
        # Events end when the service does; what a station forwards is checked where there is one.
        operations = {operation["operationId"] for _, _, operation in self.contract.operations()}
        self.assertEqual(operations - self.succeeded, {"followEvents", "putLogBatch"})

    def measurements(self):
        full = {"designation": "25 H7", "measured_mm": 25.013, "uncertainty_um": 0.8, "coverage_factor": 2,
                "temperature_c": 20.4, "measured_at": "2026-11-20T08:00:00+01:00"}
        texts = [name for name, member in self.contract.document["components"]["schemas"]["NewMeasurement"][
            "properties"].items() if member.get("maxLength", 0) >= 200]
        full |= {name: name for name in texts}
        first = self.expect("postMeasurements", 201, full).json["id"]
        drawn = {"nominal_mm": 8, "feature": "shaft", "upper_um": 0, "lower_um": -9, "measured_mm": "7.9955"}
        self.expect("postMeasurements", 201, [full, drawn])
        self.expect("postMeasurements", 201, [full, drawn], {"Prefer": "return=representation"})
        self.expect("postMeasurements", 201, full, {"Prefer": "return=minimal"})
        decided = {"designation": "25 H7", "measured_mm": 25.013, "rule": "conformance", "uncertainty_um": 1,
                   "probability": 0.9, "temperature_c": 21, "scale_temperature_c": 19}
        decided |= {"temperature_uncertainty_c": 0.1, "scale_temperature_uncertainty_c": 0.1,
                    "part_expansion_uncertainty_um_per_m_k": 1, "scale_expansion_uncertainty_um_per_m_k": 1}
        self.expect("postMeasurements", 201, {**decided, "part_expansion_um_per_m_k": 11.5, "scale_material": "steel"})
        self.expect("postMeasurements", 201, {**decided, "part_material": "steel", "scale_expansion_um_per_m_k": 8,
                                             "offset_um": -2, "tool": "T30", "confirmed": True})
        self.expect("postMeasurements", 201, {"nominal_mm": 8, "feature": "shaft", "upper_um": 0, "measured_mm": 8})
        self.expect("putUncertainty", 201, {"contributions": [{"name": "a", "standard_uncertainty": 1}]}, name="ring")
        self.expect("putGaugeInUse", 201, {"uncertainty": "ring", "calibration_due": "2020-03-31"}, name="late")
        late = {"designation": "25 H7", "measured_mm": 25.01, "rule": "guard_band", "gauge": "late", "order": "order"}
        self.expect("postMeasurements", 201, {**late, "measured_at": "2026-01-01T00:00:00Z"})
        self.expect("recordCalibration", 201, {"from": "2026-03-31", "due": "2099-03-31", "certificate": "K-1", "laboratory": "x"},
                    name="late")
        self.expect("postMeasurements", 201, late)
        self.expect("recordCalibration", 201, {"from": "2026-06-01", "status": "blocked"}, name="late")
        self.expect("postMeasurements", 201, late)
        self.expect("postMeasurements", 201, {"designation": "R5 ISO 2768-m", "measured_mm": 5, "inside_corner": True})
        enveloped = {"designation": "25 H7(E)", "measured_mm": 25.01, "go_gauge": "passes", "gauge": "another",
                     "rule": "guard_band", "uncertainty_um": 1, "degrees_of_freedom": 9}
        self.expect("postMeasurements", 201, enveloped)
        self.expect("postMeasurements", 201, [enveloped, {"measured_mm": -1, "quantity": "position"}])
        self.expect("getCertificate", 200, headers={"Accept": "application/json"}, order="order")
        self.expect("correctMeasurement", 201, {"measured_mm": 25.012, "reason": "misread"}, id=first)
        self.expect("correctMeasurement", 409, {"measured_mm": 25.012, "reason": "misread"}, id=first)
        self.expect("getMeasurement", 200, id=first)
        self.expect("getProof", 200, id=first)
        self.expect("getCheckpoint", 200)
        self.expect("getChangesCheckpoint", 200)
        self.expect("getChangesKeys", 200)
        self.expect("getChangesTile", 200, path="entries/000.p/1")
        self.expect("getChangesTile", 404, path="entries/999")
        self.expect("getLogKeys", 200)
        self.expect("getTile", 200, path="entries/000.p/1")
        self.expect("listMeasurements", 200, history="all", limit=2)
        self.expect("listMeasurements", 200, headers={"Accept": "text/csv"})
        parameters = self.contract.operation("summariseMeasurements")[2]["parameters"]
        for field in next(p for p in parameters if p["name"] == "group_by")["schema"]["enum"]:
            self.expect("summariseMeasurements", 200, group_by=field)

    def shared(self):
        """What a centre hands on, and what else a shop shares: catalogues, notes, standards."""
        for status in (201, 200):
            self.expect("putCatalogue", status, {"causes": ["Insert worn"], "measures": ["Insert changed"]}, name="lathe")
        self.expect("listCatalogues", 200)
        self.expect("getCatalogue", 200, name="lathe")
        self.expect("putHoleTableColumn", 201, {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": -3}]}, name="OWN")
        self.expect("getRevisions", 200, station="0123456789abcdef")
        self.expect("deleteHoleTableColumn", 204, name="OWN")
        self.expect("deleteCatalogue", 204, name="lathe")
        record = self.expect("postMeasurements", 201, {"designation": "25 H7", "measured_mm": 25.1}).json["id"]
        self.expect("addNote", 201, {"cause": "Insert worn", "measure": "Insert changed", "text": "x", "operator": "Kim"}, id=record)
        self.expect("listNotes", 200, id=record)
        self.expect("addNote", 201, {"cause": "Chip at the gauge", "measure": "set aside"}, id=record)
        self.expect("listMeasurements", 200, notes="shown")
        for standard in self.expect("listStandards", 200).json["standards"]:
            for table in standard["tables"]:
                self.expect("getStandard", 200, name=standard["name"], table=table)
        self.expect("getStandard", 422, name="din6885-1", size_mm="25.0000001")
        for name in ("listMtconnectAsset", "listMtconnectAssets"):
            self.expect(name, 200)
        asset = re.search(r'QIFDocumentWrapper assetId="([^"]+)"', self.daemon.get("/mtconnect/assets").text).group(1)
        self.expect("getMtconnectAsset", 200, id=asset)

    def fits(self):
        self.expect("findFits", 200, nominal_mm=25, min_clearance_um=5, max_clearance_um=45, limit=3)
        self.expect("getLimitGauge", 200, designation="25H7")
        material = {"youngs_modulus_mpa": 70000, "poisson_ratio": 0.33, "rz_um": 4}
        self.expect("computePressFit", 200, {
            "joint_diameter_mm": 50, "length_mm": 40, "friction": 0.1, "min_interference_um": 20,
            "max_interference_um": 40, "hub": {"outer_diameter_mm": 100, **material},
            "shaft": {"inner_diameter_mm": 10, **material}})
        self.assert_seen("FoundFits", "LimitGauge", "PressFit", without={})

    def statistics(self):
        lot = [25 + (i * 7919 % 1000) / 1e6 for i in range(750)]
        groups = [lot[i:i + 5] for i in range(0, 50, 5)]
        self.expect("computeSummary", 200, {"values": ["1.5", 2, 4]})
        self.expect("analyseVariance", 200, {"groups": [[1, 2], [2, 4, 5]]})
        self.expect("assessCapability", 200, {"values": lot, "lower": 24.9, "upper": "25.1", "target": 25, "confidence": 0.9})
        self.expect("assessCapability", 200, {"values": [1, 2, 3], "upper": 5})
        for kind in ("i_mr", "xbar_r", "xbar_s", "ewma", "cusum"):
            data = {"values": lot[:30]} if kind == "i_mr" else {"subgroups": groups}
            self.expect("makeControlChart", 200, {"kind": kind, **data, "rules": [1, 2, 3, 4] if kind[0] in "ix" else [1],
                                                  "phase1": {"from": 0, "to": 5}})
        master = {"values": [9.9, 10.1, 10.1, 9.9], "reference": 10, "tolerance": 6,
                  "measuring_system": {"resolution": 0.1, "u_cal": 0.01}}
        self.expect("studyGaugeOnMaster", 200, master)
        rows = [{"part": part, "operator": who, "trial": trial, "value": value}
                for who, trials in enumerate([[[0, 2], [4, 6]], [[2, 4], [2, 4]]])
                for part, values in enumerate(trials) for trial, value in enumerate(values)]
        for method in ("anova", "average_range", "type3", "nested"):
            self.expect("studyGauge", 200, {"method": method, "model": "auto", "tolerance": 60, "measurements": rows})
        self.expect("studyGauge", 200, {"measurements": rows, "measuring_process": {
            "resolution": 0.1, "u_cal": 0.01, "u_bi": 0.01, "u_evr": 0.1}})
        self.expect("studyGauge", 200, {"method": "linearity", "measurements": [
            {"reference": x, "value": y} for x, y in ((1, 1.1), (1, 1.2), (2, 2.1), (3, 3.3))]})
        self.expect("studyGauge", 200, {"method": "stability", "measurements": [
            {"at": day, "value": value} for day in range(5) for value in (1, 2)]})
        self.expect("studyGauge", 200, {"method": "attribute", "good": 1, "measurements": [
            {**row, "value": row["part"], "reference": row["part"]} for row in rows]})
        self.expect("pairParts", 200, {"holes": [25.01], "shafts": ["24.99", 25.001], "target_clearance_um": 8})
        self.expect("combineUncertainties", 200, {"contributions": [
            {"name": "a", "standard_uncertainty": 2, "degrees_of_freedom": 9, "sensitivity": 1},
            {"name": "b", "half_width": 3, "distribution": "triangular"}], "probability": 0.99,
            "correlations": [], "monte_carlo": {"trials": 1000, "seed": 3}})
        self.expect("combineUncertainties", 200, {"model": "a^2", "contributions": [
            {"name": "a", "value": 1, "half_width": 0.1, "limits_half_width": 0.01}], "monte_carlo": {"digits": 1}})
        row = {"designation": "25H7", "characteristic": "figures"}
        for i, values in enumerate([*groups, [25.1] * 5]):
            self.expect("postMeasurements", 201, [{**row, "measured_mm": value, "subgroup": str(i)} for value in values])
        for subgroups in ("use", "ignore"):
            self.expect("assessStoredCapability", 200, characteristic="figures", subgroups=subgroups)
            self.expect("makeStoredControlChart", 200, characteristic="figures", subgroups=subgroups, rules="1,2,3,4")
        self.expect("assessStoredCapability", 422, characteristic="none")
        self.expect("proposeOffset", 200, characteristic="figures")
        budget = {"contributions": [{"name": "a", "standard_uncertainty": 2}]}
        for status in (201, 200):
            self.expect("putUncertainty", status, budget, name="plug")
            self.expect("putGaugeInUse", status, {"uncertainty": "plug", "calibration_due": "2027-03-31", "comment": "x"},
                        name="G-07")
            calibration = {"from": "2026-03-31", "due": "2027-03-31", "certificate": "K-1", "laboratory": "x", "status": "in_use",
                           "uncertainty": "plug", "as_found_um": 1, "as_left_um": 0.5, "comment": "x"}
            self.expect("recordCalibration", status, calibration, name="G-07")
        self.expect("listCalibrations", 200, name="G-07")
        self.expect("listCalibrations", 404, name="none")
        self.expect("recordCalibration", 404, calibration, name="none")
        for status, study in ((201, {"kind": "type1", "input": master}), (200, {"kind": "grr", "input": {"measurements": rows}})):
            self.expect("putStudy", status, {"gauge": "G-07", "at": "2026-03-31", "comment": "x", **study}, name="type 1")
        self.expect("listStudies", 200)
        self.expect("getStudy", 200, name="type 1")
        self.expect("deleteGaugeInUse", 409, name="G-07")
        self.expect("deleteStudy", 204, name="type 1")
        self.expect("deleteStudy", 404, name="type 1")
        self.expect("deleteUncertainty", 409, name="plug")
        self.expect("listChanges", 200, kind="gauge", limit=1)
        for kind, plural in (("GaugeInUse", "GaugesInUse"), ("Uncertainty", "Uncertainties")):
            self.expect(f"list{plural}", 200)
            name = "plug" if kind == "Uncertainty" else "G-07"
            self.expect(f"get{kind}", 200, name=name)
            self.expect(f"delete{kind}", 204, name=name)
            self.expect(f"delete{kind}", 404, name=name)
        self.assert_seen("ValueSummary", "Anova", "Capability", "CapabilityIndex", "ControlChart", "Type1Study", "VariationStudy",
                         "LinearityStudy", "StabilityStudy", "AttributeStudy", "Pairing", "Uncertainty", without={})

    def runs(self):
        bad = b"BEGIN PGM BAD MM\nLBL 5\nLBL 5\nCALL LBL 6\nEND PGM BAD MM\n"
        self.expect("putFile", 201, bad, path="nc_prog/bad.h")
        self.expect("putFile", 200, bad, path="nc_prog/bad.h")
        self.expect("checkFile", 200, path="nc_prog/bad.h", action="check")
        self.expect("checkFile", 200, path="nc_prog/hole.h", action="format")
        self.expect("checkFile", 422, path="nc_prog/m.a", action="format")
        self.expect("listFiles", 200, prefix="nc_prog/")
        self.expect("getFile", 200, path="nc_prog/hole.h")
        self.expect("putSetup", 200, SETUP, name="m3")
        self.expect("putSetup", 201, SETUP, name="m4")
        self.expect("getSetup", 200, name="m4")
        self.expect("listSetups", 200)
        self.expect("deleteSetup", 204, name="m4")
        self.expect("putPlan", 201, PLAN, part="4711-A")
        self.expect("putPlan", 200, PLAN, part="4711-A")
        self.expect("getPlan", 200, part="4711-A")
        self.expect("listPlans", 200)
        self.expect("postMeasurements", 201, {"part_id": "SN-P", "characteristic": "slot", "nominal_mm": 8, "feature": "hole",
                                              "upper_um": 36, "lower_um": 0, "measured_mm": 8.05})
        self.expect("getPart", 200, part="SN-P", plan="4711-A")
        self.expect("getPart", 404, part="SN-none")
        self.expect("deletePlan", 204, part="4711-A")
        self.connections()
        order = {"program": "TNC:\\nc_prog\\hole.h", "setup": SETUP, "parameters": {"Q1": 25, "QS1": "H7"},
                 "limits": {"blocks": 1000, "seconds": 60}, "on_stop": "end", "unreadable": "refuse",
                 "start_block": 0, "watch": ["Q1"],
                 "part_id": "SN-17", "order": "WO-9"}
        run = self.expect("postRun", 201, order).json
        self.assertEqual(run["status"], "completed", run)
        self.expect("postRun", 202, order, {"Prefer": "respond-async"})
        self.expect("postRun", 422, {"program": "TNC:\\nc_prog\\bad.h"})
        replay = self.expect("postRun", 201, {**order, "contacts_mm": [[50, 50, -5], None]}).json
        self.expect("getRunRequest", 200, id=replay["id"])
        self.expect("getRun", 200, id=run["id"])
        self.expect("getRunParameters", 200, id=run["id"])
        self.expect("getRunRequest", 200, id=run["id"])
        self.expect("getRunTrace", 200, id=run["id"])
        self.expect("getRunTrace", 200, id=run["id"], headers={"Accept": "text/csv"})
        self.expect("getRunFile", 200, id=run["id"], name="TCHPR421.TXT")
        self.expect("followRun", 200, id=run["id"])
        self.expect("cancelRun", 409, id=run["id"])
        lines = ("BEGIN PGM L MM", *FOREVER, "END PGM L MM\n")
        self.expect("putFile", 201, "\n".join(lines).encode(), path="endless.h")
        endless = {"program": "endless.h", "limits": {"blocks": 100_000_000, "seconds": 60}}
        self.expect("cancelRun", 204, id=self.expect("postRun", 202, endless, {"Prefer": "respond-async"}).json["id"])
        self.expect("listRuns", 200)
        self.expect("listMeasurements", 200, source="simulation")
        self.expect("deleteFile", 204, path="nc_prog/bad.h")

    def connections(self):
        control = {"kind": "lsv2", "address": "127.0.0.1:1", "machine": "M3", "paths": ["TNC:\\logs\\*.TXT"],
                   "interval_s": 3600, "patterns": [{"file": "bore", "text": "nominal_mm = 25\n---\n{measured_mm} MM\n"}]}
        self.expect("putConnection", 201, control, name="mill")
        self.expect("putConnection", 200, control, name="mill")
        self.expect("putConnection", 422, {"kind": "mqtt"}, name="mill")
        self.expect("putConnection", 422, {**control, "paths": ["PLC:\\x"]}, name="mill")
        self.expect("putConnection", 400, control, name="a b")
        self.expect("listConnections", 200)
        self.expect("getConnection", 200, name="mill")
        self.expect("testConnection", 200, name="mill")
        self.expect("testConnection", 404, name="none")
        self.expect("replayConnection", 422, {"from": "2026-11-20T08:00:00Z"}, name="mill")
        webhook = {"kind": "webhook", "url": "http://127.0.0.1:1/", "secrets": ["whsec_" + "A" * 32],
                   "headers": {"X-Plant": "press-3"}, "body": {"text": "{{id}}"}}
        self.expect("putConnection", 201, webhook, name="mes")
        self.expect("replayConnection", 200, {"from": "2026-11-20T08:00:00Z"}, name="mes")
        self.expect("replayConnection", 422, {"from": "yesterday"}, name="mes")
        self.expect("replayConnection", 404, {"from": "yesterday"}, name="none")
        self.expect("deleteConnection", 204, name="mes")
        for name in ("probeMtconnect", "currentMtconnect", "sampleMtconnect"):
            self.expect(name, 200)
        self.expect("sampleMtconnect", 404, **{"from": 10**9})
        self.expect("deleteConnection", 204, name="mill")
        self.expect("deleteConnection", 404, name="mill")
        self.expect("getConnection", 404, name="mill")

    def assert_seen(self, *names, without):
        """Every member that a schema names came in some answer: none is described that is not there."""
        for name in names:
            with self.subTest(name):
                properties = self.contract.document["components"]["schemas"][name]["properties"]
                self.assertEqual(set(properties) - self.contract.seen[name], without.get(name, set()))


if __name__ == "__main__":
    unittest.main()
