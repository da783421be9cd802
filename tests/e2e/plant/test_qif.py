"""QIF 3.0 in watched folders, in lists and in `fitgauge import`: read by the XML parser of Python, held against the
schemas where QIF_SCHEMAS names their folder, and the same records when what was written comes in again."""

import decimal
import os
import pathlib
import subprocess
import unittest
import xml.etree.ElementTree as tree

from support.cli import FITGAUGE
from support.folders import Folders

SCHEMAS = os.environ.get("QIF_SCHEMAS")
SAMPLES = os.environ.get("QIF_SAMPLES")  # a folder of documents by others
T = "{http://qifstandards.org/xsd/qif3}"
WORDS = {"good": "PASS", "rework": "REWORK", "reject": "FAIL", "indeterminate": "INDETERMINATE"}
HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<QIFDocument xmlns="http://qifstandards.org/xsd/qif3" versionQIF="3.0.0" idMax="99">
<QPId>fd43400a-29bf-4ec6-b96c-e2f846eb6ff6</QPId>
<FileUnits><PrimaryUnits><LinearUnit><SIUnitName>meter</SIUnitName><UnitName>UNIT</UnitName>
<UnitConversion><Factor>FACTOR</Factor></UnitConversion></LinearUnit></PrimaryUnits></FileUnits>
<MeasurementResources><MeasurementDevices n="1"><Micrometer id="30"><Name>Plug 25</Name></Micrometer></MeasurementDevices></MeasurementResources>
<Features><FeatureDefinitions n="1"><CylinderFeatureDefinition id="10"><InternalExternal>EXTERNAL</InternalExternal></CylinderFeatureDefinition>
</FeatureDefinitions><FeatureNominals n="1"><CylinderFeatureNominal id="11"><FeatureDefinitionId>10</FeatureDefinitionId></CylinderFeatureNominal>
</FeatureNominals></Features>
"""
BODY = """<Characteristics><FormalStandardId>1</FormalStandardId><CharacteristicDefinitions n="2">
<DiameterCharacteristicDefinition id="1"><LimitsAndFitsSpecification zoneVariance="HOLE"><FormVariance>H</FormVariance><Grade>7</Grade>
</LimitsAndFitsSpecification></DiameterCharacteristicDefinition>
<WidthCharacteristicDefinition id="2"><Tolerance><MaxValue>0</MaxValue><MinValue>-0.009</MinValue><DefinedAsLimit>false</DefinedAsLimit>
</Tolerance></WidthCharacteristicDefinition></CharacteristicDefinitions>
<CharacteristicNominals n="2"><DiameterCharacteristicNominal id="3"><CharacteristicDefinitionId>1</CharacteristicDefinitionId>
<TargetValue>25</TargetValue></DiameterCharacteristicNominal><WidthCharacteristicNominal id="4"><CharacteristicDefinitionId>2</CharacteristicDefinitionId>
<FeatureNominalIds n="1"><Id>11</Id></FeatureNominalIds><TargetValue>8.000</TargetValue></WidthCharacteristicNominal></CharacteristicNominals>
<CharacteristicItems n="2"><DiameterCharacteristicItem id="5"><Name>Bore &amp; seat</Name><MeasurementDeviceIds n="1"><Id>30</Id></MeasurementDeviceIds>
<CharacteristicNominalId>3</CharacteristicNominalId></DiameterCharacteristicItem>
<WidthCharacteristicItem id="6"><CharacteristicDesignator><Designator>12.1</Designator></CharacteristicDesignator>
<CharacteristicNominalId>4</CharacteristicNominalId></WidthCharacteristicItem></CharacteristicItems></Characteristics>
<Results><MeasurementResultsSet n="1"><MeasurementResults id="7"><InspectionTraceability><OrderNumber>WO-9</OrderNumber>
<InspectionOperator><Name>Mustermann</Name></InspectionOperator></InspectionTraceability>
<MeasuredCharacteristics><CharacteristicMeasurements n="2">
<DiameterCharacteristicMeasurement id="20"><Status><CharacteristicStatusEnum>FAIL</CharacteristicStatusEnum></Status>
<CharacteristicItemId>5</CharacteristicItemId><TimeStamp>2026-11-20T08:00:00</TimeStamp><ActualComponentId>40</ActualComponentId>
<Value combinedUncertainty="0.0008">25.0131</Value></DiameterCharacteristicMeasurement>
<WidthCharacteristicMeasurement id="21"><Status><CharacteristicStatusEnum>PASS</CharacteristicStatusEnum></Status>
<CharacteristicItemId>6</CharacteristicItemId><TimeStamp>2026-11-20T08:00:05+01:00</TimeStamp><Value>7.9955</Value></WidthCharacteristicMeasurement>
</CharacteristicMeasurements></MeasuredCharacteristics><InspectionStatus><InspectionStatusEnum>PASS</InspectionStatusEnum></InspectionStatus>
</MeasurementResults></MeasurementResultsSet><ActualComponentSets n="1"><ActualComponentSet n="1"><ActualComponent id="40">
<SerialNumber>SN-1</SerialNumber><Status><InspectionStatusEnum>PASS</InspectionStatusEnum></Status></ActualComponent></ActualComponentSet>
</ActualComponentSets></Results></QIFDocument>
"""
DOCUMENT = HEAD.replace("UNIT", "mm").replace("FACTOR", "0.001") + BODY


SIZES = {"Diameter", "SphericalDiameter", "Width", "Thickness", "Length", "Height", "Depth", "DistanceBetween"}


def sizes_of(path):
    """What a document has measured, in order, as (millimetres, nominal, upper, lower limit), counted here with ElementTree."""
    root = tree.parse(path).getroot()
    if not root.tag.startswith(T):
        return None
    by_id = {each.get("id"): each for each in root.iter() if each.get("id")}
    text = lambda element, path: element.findtext("/".join(T + name for name in path.split("/"))) if element is not None else None
    linear = next(root.iter(T + "LinearUnit"), None)
    factor = decimal.Decimal(text(linear, "UnitConversion/Factor") or {"m": "1", "meter": "1", "mm": "0.001", "inch": "0.0254", None: "0.001"}[text(linear, "UnitName")]) * 1000
    found = []
    for parent in root.iter(T + "CharacteristicMeasurements"):
        for each in parent:
            item = by_id.get(text(each, "CharacteristicItemId"))
            if item is None or not item.tag.endswith("CharacteristicItem"):  # it stands in another document
                return "measures a characteristic without an item in the document"
            if each.tag.removeprefix(T).removesuffix("CharacteristicMeasurement") not in SIZES or text(each, "Value") is None:
                continue
            nominal = by_id.get(text(item, "CharacteristicNominalId"))
            definition = by_id.get(text(nominal, "CharacteristicDefinitionId"))
            target, upper, lower = text(nominal, "TargetValue"), text(definition, "Tolerance/MaxValue"), text(definition, "Tolerance/MinValue")
            if target is None or not (upper or lower or text(definition, "LimitsAndFitsSpecification/Grade")):
                continue
            begin = 0 if text(definition, "Tolerance/DefinedAsLimit") in ("true", "1") else decimal.Decimal(target)
            limit = lambda value: None if value is None else float(round((begin + decimal.Decimal(value)) * factor, 6))
            found.append((float(round(decimal.Decimal(text(each, "Value")) * factor, 6)), float(round(decimal.Decimal(target) * factor, 6)), limit(upper), limit(lower)))
    return found


class Qif(Folders):
    @unittest.skipUnless(SAMPLES, "QIF_SAMPLES names no folder")
    def test_documents_of_others_have_as_many_sizes_as_an_independent_count(self):
        counted, daemon = 0, self.daemon().start()
        for number, path in enumerate(sorted(pathlib.Path(SAMPLES).iterdir())):
            wanted = sizes_of(path)
            if not wanted:
                continue
            copy = self.root / f"{number}.qif"
            copy.write_bytes(path.read_bytes())
            with self.subTest(path.name):
                done = self.measure(daemon, copy, "--state", self.root / f"{number}.state", "--time-zone", "UTC", "--length-unit", "mm", "--set", "feature=hole",
                                    "--leave-out-others")
                if isinstance(wanted, str):
                    self.assertIn(wanted, done.stderr)
                    continue
                self.assertEqual(done.returncode & ~3, 0, done.stdout + done.stderr)
                read = [(row["measured_mm"], row["nominal_mm"], row.get("upper_limit_mm"), row.get("lower_limit_mm")) for row in daemon.stored()[counted:]]
                counted += len(read)
                self.assertEqual(read, wanted)
        self.assertGreater(counted, 0)

    def connected(self, **more):
        daemon = self.daemon().start()
        self.connect(daemon, **{"time_zone": "Europe/Berlin", **more})
        return daemon

    def taken(self, name, content):
        self.drop(name, content)
        self.wait(lambda: name in self.files("done") + self.files("failed"))
        return name in self.files("done")

    def told(self, name):
        return (self.folder / "failed" / (name + ".error.txt")).read_text()

    def plain(self, daemon):
        return [{name: value for name, value in row.items() if name not in ("id", "received_at", "caller")} for row in daemon.stored()]

    def measure(self, daemon, path, *more):
        return subprocess.run([FITGAUGE, "measure", path, "--server", f"http://127.0.0.1:{daemon.port}",
                               *(() if "--state" in more else ("--state", self.root / "state")), *more],
                              capture_output=True, text=True, check=False)

    def test_what_goes_out_is_qif_and_comes_in_again_as_the_same_records(self):
        first, second, third = self.daemon().start(), self.connected(), self.daemon().start()
        for row in ({"designation": "25 H7", "measured_mm": "25.0131", "part_id": "P<1>&\"", "characteristic": " a  b\n", "order": "WO",
                     "operation": "OP", "machine": "M3", "operator": "Müller", "gauge": "G1", "unit": "L1", "comment": "a;\n\t\"b\"", "subgroup": "S",
                     "measured_at": "2026-11-20T08:00:00.123456+01:00", "uncertainty_um": "0.75"},
                    {"nominal_mm": 8, "feature": "shaft", "upper_um": 0, "lower_um": "-9", "measured_mm": "7.9911", "part_id": "P2"},
                    {"nominal_mm": 8, "feature": "hole", "upper_um": 5, "measured_mm": "8.0001", "part_id": "P2"},
                    {"nominal_mm": 8, "feature": "hole", "lower_um": 5, "measured_mm": "8.0001"},
                    {"designation": "25 g6", "measured_mm": "24.99", "rule": "guard_band", "uncertainty_um": "0.8", "coverage_factor": "1.5"},
                    {"designation": "25 H7(E)", "measured_mm": "25.01", "size_operator": "GG", "go_gauge": "fails"},
                    {"nominal_mm": 8, "feature": "hole", "upper_um": 5, "lower_um": 0, "measured_mm": "8.001", "size_operator": "SD"},
                    {"designation": "8 P9", "quantity": "width", "measured_mm": "7.96"},
                    {"designation": "25 H7", "measured_mm": "25.03", "characteristic": "Bore"}, {"designation": "25 H7", "measured_mm": "24.99"},
                    {"designation": "25 H7", "measured_mm": "25.01", "rule": "conformance", "uncertainty_um": 1, "probability": "0.9",
                     "temperature_c": 23, "part_material": "steel", "temperature_uncertainty_c": 2, "scale_temperature_c": "21.5", "scale_expansion_um_per_m_k": 8}):
            self.assertEqual(first.measure(row).status, 201, row)
        answer = first.get("/v1/measurements?format=qif")
        self.assertEqual((answer.status, answer.headers["content-type"]), (200, "application/xml"))
        if SCHEMAS:
            done = subprocess.run(["xmllint", "--noout", "--nonet", "--schema", pathlib.Path(SCHEMAS) / "QIFDocument.xsd", "-"],
                                  input=answer.body, capture_output=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr.decode())
        root = tree.fromstring(answer.body)
        stored = first.stored()
        self.assertEqual((root.tag, root.get("versionQIF")), (T + "QIFDocument", "3.0.0"))
        ids = [each.get("id") for each in root.iter() if each.get("id")]
        self.assertEqual((len(ids), max(map(int, ids))), (len(set(ids)), int(root.get("idMax"))))
        for each in root.iter():
            if each.get("n"):
                self.assertEqual(int(each.get("n")), len(each), each.tag)
        measured = [each for each in root.iter() if each.tag.endswith("CharacteristicMeasurement")]
        by_id = {each.get("id"): each for each in root.iter() if each.get("id")}
        self.assertEqual(len(measured), len(stored))
        for each, record in zip(measured, stored):
            item = by_id[each.find(T + "CharacteristicItemId").text]
            nominal = by_id[item.find(T + "CharacteristicNominalId").text]
            definition = by_id[nominal.find(T + "CharacteristicDefinitionId").text]
            # A reader without fitgauge sees the size that was judged, with its u: of the last row √(1² + 0.575² + 0.043²) µm.
            value = each.find(T + "Value")
            self.assertEqual(float(value.text), record.get("corrected_mm", record["measured_mm"]))
            u = record.get("uncertainty_um") if "corrected_mm" not in record else 1.155
            self.assertEqual(value.get("combinedUncertainty"), u and f"{u / 1000:g}")
            self.assertEqual(each.find(f"{T}Status/{T}CharacteristicStatusEnum").text, WORDS[record["verdict"]])
            self.assertEqual(float(nominal.find(T + "TargetValue").text), record["nominal_mm"])
            for name, member in (("MaxValue", "upper_limit_mm"), ("MinValue", "lower_limit_mm")):
                limit = definition.find(f"{T}Tolerance/{T}{name}")
                self.assertEqual(limit if limit is None else float(limit.text), record.get(member))
            part = each.find(T + "ActualComponentId")
            self.assertEqual(part if part is None else by_id[part.text].find(T + "SerialNumber").text, record.get("part_id"))
        self.assertEqual(root.find(f".//{T}MeasurementResults/{T}InspectionStatus/{T}InspectionStatusEnum").text, "FAIL")
        self.assertTrue(self.taken("out.qif", answer.body), self.files("failed") and self.told("out.qif"))
        self.assertEqual(self.plain(second), self.plain(first))
        path = self.root / "all.QIF"
        path.write_bytes(answer.body)
        done = self.measure(third, path)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.plain(third), self.plain(first))

    def test_a_document_of_others(self):
        daemon = self.connected()
        self.assertTrue(self.taken("a.qif", DOCUMENT), self.files("failed") and self.told("a.qif"))
        said = [{name: row.get(name) for name in ("measured_mm", "tolerance_class", "feature", "upper_limit_mm", "lower_limit_mm", "verdict", "part_id",
                 "characteristic", "order", "operator", "gauge", "uncertainty_um", "measured_at")} for row in daemon.stored()]
        self.assertEqual(said, [
            {"measured_mm": 25.0131, "tolerance_class": "H7", "feature": "hole", "upper_limit_mm": 25.021, "lower_limit_mm": 25, "verdict": "good",
             "part_id": "SN-1", "characteristic": "Bore & seat", "order": "WO-9", "operator": "Mustermann", "gauge": "Plug 25", "uncertainty_um": 0.8,
             "measured_at": "2026-11-20T07:00:00Z"},
            {"measured_mm": 7.9955, "tolerance_class": None, "feature": "shaft", "upper_limit_mm": 8, "lower_limit_mm": 7.991, "verdict": "good",
             "part_id": None, "characteristic": "12.1", "order": "WO-9", "operator": "Mustermann", "gauge": None, "uncertainty_um": None,
             "measured_at": "2026-11-20T07:00:05Z"}])
        # In inches: 1 inch H7 is 25.4 mm H7.
        inch = DOCUMENT.replace(">mm<", ">inch<").replace("0.001<", "0.0254<").replace(">25<", ">1<").replace("25.0131", "1.0002")
        self.assertTrue(self.taken("inch.qif", inch), self.files("failed") and self.told("inch.qif"))
        self.assertEqual((daemon.stored()[2]["nominal_mm"], daemon.stored()[2]["measured_mm"]), (25.4, 25.40508))

    def test_a_bad_document_stores_nothing_and_is_told_with_its_line(self):
        daemon = self.connected()
        bomb = '<!DOCTYPE QIFDocument [<!ENTITY a "aaaaaaaaaa">' + "".join(
            f'<!ENTITY {chr(98 + i)} "{("&" + chr(97 + i) + ";") * 10}">' for i in range(9)) + "]>"
        declared = DOCUMENT.replace("?>\n", "?>\n" + bomb + "\n", 1).replace("SN-1", "&j;")
        outside = DOCUMENT.replace("?>\n", '?>\n<!DOCTYPE QIFDocument [<!ENTITY x SYSTEM "file:///etc/passwd">]>\n', 1).replace("SN-1", "&x;")
        class_with = lambda limits: DOCUMENT.replace('<LimitsAndFitsSpecification zoneVariance="HOLE"><FormVariance>H</FormVariance><Grade>7</Grade>\n'
                                                     "</LimitsAndFitsSpecification>", '<Attributes n="1"><AttributeStr name="tolerance_class" value="H7"/></Attributes>'
                                                     f"<Tolerance>{limits}<DefinedAsLimit>true</DefinedAsLimit></Tolerance>")
        bad = {
            "bomb": (declared, "DOCTYPE"), "outside": (outside, "DOCTYPE"),
            "cut": (DOCUMENT[:len(DOCUMENT) // 2], "is not well-formed XML"), "cut-late": (DOCUMENT[:-20], "is not well-formed XML"),
            "nul": (DOCUMENT.replace("SN-1", "SN\0"), "is not well-formed XML"), "empty": ("", ""), "text": ("Bore 25.01", "is not well-formed XML"),
            "other": ("<html/>", "but must begin a QIFDocument of QIF 3"), "qif2": (DOCUMENT.replace("xsd/qif3", "xsd/qif2"), "but must begin a QIFDocument of QIF 3"),
            "deep": ("<a>" * 100_000, ""), "no-value": (DOCUMENT.replace("<Value>7.9955</Value>", ""), "without a Value"),
            "angle": (DOCUMENT.replace("WidthCharacteristicMeasurement", "AngleCharacteristicMeasurement"), "which is not a measurement"),
            "number": (DOCUMENT.replace("7.9955", "7.99.55"), "line 28 has the value '7.99.55', which is not a length"),
            "item": (DOCUMENT.replace("<CharacteristicItemId>6<", "<CharacteristicItemId>66<"), "without an item in the document"),
            "class": (class_with("<MaxValue>25.03</MaxValue>"), "has 25.03 mm in MaxValue, but H7 of 25 mm gives 25.021 mm"),
            "unit": (DOCUMENT.replace("<Value>7", '<Value linearUnit="inch">7'), "has a value in 'inch'"),
            "units": (DOCUMENT.replace("0.001<", "0.3048<"), "without a known unit"),
            "time": (DOCUMENT.replace("2026-11-20T08:00:00<", "2026-03-29T02:30:00<"), "2026-03-29T02:30:00"),
            "none": (DOCUMENT.replace("<DiameterCharacteristicMeasurement", "<x>").split("<x>")[0] + "</CharacteristicMeasurements></MeasuredCharacteristics>"
                     "</MeasurementResults></MeasurementResultsSet></Results></QIFDocument>", "no measured size"),
            "long": ("<QIFDocument xmlns='http://qifstandards.org/xsd/qif3'>" + "x" * 20_000_000, ""),
        }
        for name, (content, words) in bad.items():
            self.assertFalse(self.taken(name + ".qif", content), name)
            self.assertIn(words, self.told(name + ".qif"), name)
            self.assertNotIn("root:", self.told(name + ".qif"))
        self.assertTrue(self.taken("good.qif", class_with("<MaxValue>25.021</MaxValue><MinValue>25.000</MinValue>")))
        self.assertEqual(len(daemon.stored()), 2)

    def test_what_is_no_size_is_passed_over_where_it_is_asked_for(self):
        daemon = self.connected(other_columns="leave_out")
        self.assertTrue(self.taken("a.qif", DOCUMENT.replace("WidthCharacteristicMeasurement", "AngleCharacteristicMeasurement")))
        self.assertEqual(self.parts(daemon), ["SN-1"])

    def test_the_command_line_names_the_line_of_the_document(self):
        daemon = self.daemon().start()
        path = self.root / "a.qif"
        path.write_text(DOCUMENT)
        self.assertIn("name the time zone", self.measure(daemon, path).stderr)
        path.write_text(DOCUMENT.replace("SN-1", "S" * 201))
        done = self.measure(daemon, path, "--time-zone", "Europe/Berlin")
        self.assertIn("a.qif:25: part_id", done.stderr + done.stdout)
        self.assertEqual(daemon.stored(), [])

    def test_a_folder_out(self):
        daemon, out = self.daemon().start(), self.root / "out"
        out.mkdir()
        answer = daemon.request("PUT", "/v1/connections/customer", {"kind": "folder_out", "folder": str(out), "format": "qif", "every_s": 1})
        self.assertEqual(answer.status, 201, answer)
        daemon.measure([{"designation": "25 H7", "measured_mm": 25.01, "part_id": "SN-1"}, {"designation": "25 H7", "measured_mm": 25.01, "comment": "\x01"}])
        self.wait(lambda: list(out.glob("*.qif")))
        root = tree.parse(next(out.glob("*.qif")))
        self.assertEqual([each.text for each in root.iter(T + "SerialNumber")], ["SN-1"])
        self.wait(lambda: daemon.get("/v1/connections/customer").json["dead_letters"])
        self.assertIn("control character", daemon.get("/v1/connections/customer").json["dead_letters"][0]["reason"])


if __name__ == "__main__":
    unittest.main()
