"""Programs that try to take more than a run may: name -> (blocks, setup, files beside the program).

Families, each with the forms it can take: what never ends, what lasts inside of one block, what
grows, what leaves the finite numbers, what leaves the disk, and what is merely very large.
"""

import os

# A file holds up to 8 MiB; the short form takes less, since sanitizers parse slowly.
SCALE = 8 if os.environ.get("TESTS_DEEP") else 1
ENDLESS = "FN 9: IF +0 EQU +0 GOTO LBL 1"
MEGABYTE = 1 << 20
SPACE = 1_000_000
PLANE = {"type": "plane"}
BLOCK = {"type": "block", "min_mm": [0, 0, -40], "max_mm": [100, 80, 0]}
BORE = {"type": "bore", "center_mm": [50, 40], "depth_mm": 30, "diameter_mm": 25.013}
LOBES = {"type": "bore", "center_mm": [0, 0], "depth_mm": 50, "diameter_mm": 20, "lobes": 1000,
         "lobe_amplitude_um": 100}
HOLE = ["TCH PROBE 421 MEASURE HOLE ~", *(f" {word} ~" for word in (
    "Q273=+50 Q274=+40 Q262=+25 Q325=+0 Q247=+90 Q261=-10 Q320=+0 Q260=+40 Q301=+0 Q275=+25.021 "
    "Q276=+25 Q279=+0 Q280=+0 Q281=+1 Q309=+0").split()), " Q330=+0"]


def part(*features, **axes):
    """A machine with a million millimetres of travel and these features."""
    wide = {"min_mm": -SPACE, "max_mm": SPACE}
    return {"machine": {"axes": {"X": wide, "Y": wide, "Z": wide, **axes}, "start_mm": {"Z": 500}},
            "workpiece": {"features": list(features)}}


def loop(*blocks, before=()):
    return [*before, "LBL 1", *blocks, ENDLESS]


def endless():
    """What never ends by itself."""
    yield "jump", loop()
    yield "count", loop("Q1 = Q1 + 1", before=["Q1 = 0"])
    yield "formula", loop("Q1 = SIN( Q2 ) * COS( Q2 ) + SQRT( 2 )", before=["Q2 = 33"])
    yield "text", loop('QS1 = "abc" || "def"')
    yield "comparison", ['QS1 = "a"', "LBL 1", "FN 9: IF QS1 EQU QS1 GOTO LBL 1"]
    yield "label", ["LBL 1", "CALL LBL 1 REP 65534"]
    yield "nested_labels", ["LBL 1", "LBL 2", "LBL 3", "CALL LBL 3 REP 65534",
                            "CALL LBL 2 REP 65534", "CALL LBL 1 REP 65534"]
    yield "subprogram", [*loop("CALL LBL 9"), "LBL 9", "Q1 = 1", "LBL 0"]
    yield "stop", loop("STOP")
    yield "dwell", loop("CYCL DEF 9.0 DWELL TIME", "CYCL DEF 9.1 DWELL 0.1")
    yield "tool_call", loop("TOOL CALL 30 Z S100")
    yield "move", loop("L X+1 FMAX", "L X-1 FMAX")
    yield "arc", loop("CC X+0 Y+0", "C X+10 Y+0 DR+ F500", before=["TOOL CALL 30 Z", "L X+10 Y+0 FMAX"])
    yield "shift", loop("CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 IX+0.001")
    yield "rotation", loop("CYCL DEF 10.0 ROTATION", "CYCL DEF 10.1 IROT+1")
    yield "spindle", loop("M3", "M5")
    yield "system_data", loop("FN 18: SYSREAD Q1 = ID270 NR1 IDX1")
    yield "date", loop("QS1 = SYSSTR( ID10321 NR0 )")
    yield "undefine", loop("Q1 = 1", "FN 9: IF Q1 IS DEFINED GOTO LBL 1")
    yield "recursion", ["LBL 1", "CALL LBL 1", "LBL 0", "CALL LBL 1"]
    yield "own_program", ["CALL PGM own_program.h"]
    yield "cycle_12", ["CYCL DEF 12.0 PGM CALL", "CYCL DEF 12.1 PGM cycle_12.h", "L X+1 FMAX M99"]
    yield "indirect", loop("Q0 = Q0 + 1", before=["Q0 = 0"])
    yield "substring", loop("QS2 = SUBSTR( SRC_QS1 BEG0 LEN3 )", before=['QS1 = "abcdef"'])
    yield "search", loop("Q1 = INSTR( SRC_QS1 SEA_QS2 BEG0 )",
                         before=['QS1 = "' + "a" * 200 + '"', 'QS2 = "aaaaaaab"'])


def lasting():
    """What lasts inside of one block."""
    for gap in ("0.001", "0.00001", "0.00000001"):
        yield f"beside_a_plane_{gap[2:]}", ["TOOL CALL 30 Z", f"L Z+{gap} FMAX", "L X+999000 FMAX"], part(PLANE)
    turns = ["TOOL CALL 30 Z", "CC X+0 Y+0", "L X+4 FMAX", "L Z-1 FMAX"]
    yield "helix_in_lobes", [*turns, "CP IPA+999999 IZ-5 DR+ FMAX"], part(PLANE, LOBES)
    yield "circles_in_lobes", [*turns, *loop("C X+4 Y+0 DR+ F500")], part(PLANE, LOBES)
    yield "helix_beside_a_plane", [*turns[:3], "L Z+0.00001 FMAX", "CP IPA+999999 IZ+0 DR+ FMAX"], part(PLANE)
    yield "touch_lobes", ["TOOL CALL 30 Z", "L X+0 Y+0 Z-10 FMAX", *loop(
        "TCH PROBE 3.0 MEASURING", "TCH PROBE 3.1 Q1", "TCH PROBE 3.2 X ANGLE: +33",
        "TCH PROBE 3.3 ABST+30 F100 MB1 SYSTEM OF REFERENCE:0", "TCH PROBE 3.4 ERRORMODE1")], part(PLANE, LOBES)
    bores = [{**BORE, "center_mm": [x * 12, y * 12], "diameter_mm": 10}
             for x in range(60) for y in range(60)]
    yield "many_bores", ["TOOL CALL 30 Z", "L Z+3 FMAX", *loop("L X+700 Y+700 FMAX", "L X+0 Y+0 FMAX")], \
        part({**BLOCK, "max_mm": [720, 720, 0]}, *bores)
    spheres = [{"type": "sphere", "center_mm": [x * 7, y * 7, -10], "diameter_mm": 6}
               for x in range(60) for y in range(60)]
    yield "many_spheres", ["TOOL CALL 30 Z", "L Z+3 FMAX", *loop("L X+400 Y+400 FMAX", "L X+0 Y+0 FMAX")], \
        part(*spheres)
    points = [[x * 5, y * 5, (x * 7 + y * 13) % 5 / 10] for x in range(80) for y in range(80)]
    yield "rough_surface", ["TOOL CALL 30 Z", "L Z+2.5 FMAX", *loop("L X+390 Y+390 FMAX", "L X+1 Y+1 FMAX")], \
        part({"type": "surface", "points_mm": points})
    table = {"A": {"on": "table"}, "C": {"on": "table", "min_deg": -36000, "max_deg": 36000}}
    yield "tcpm_turns", ["TOOL CALL 30 Z", "L X+50 Z+10 FMAX", "M128", *loop("L C+36000 F100", "L C-36000 F100")], \
        part(PLANE, **table)
    yield "hole_for_ever", ["TOOL CALL 30 Z", "L Z+50 FMAX", *loop(*HOLE)], part(BLOCK, BORE)
    yield "plane_spatial", ["TOOL CALL 30 Z", *loop("PLANE SPATIAL SPA+10 SPB+0 SPC+30 STAY",
                                                    "PLANE RESET STAY")], part(PLANE, **table)


def growing():
    """What grows without an end."""
    number = ("Q1 = Q1 + 1",)
    yield "presets", loop(*number, "FN 17: SYSWRITE ID503 NRQ1 IDX1 = Q1", before=["Q1 = 0"])
    yield "presets_of_axes", loop(*number, "FN 17: SYSWRITE ID503 NRQ1 IDX6 = 1", before=["Q1 = 0"])
    name = 'QS1 = "f" || TOCHAR( DAT+Q1 )'
    for mask, text in (("empty", ""), ("blank", '"";\n'), ("one", '"x";\n'), ("close", '"x";\nM_CLOSE;\n')):
        yield f"files_{mask}", loop(*number, name, "FN 16: F-PRINT m.a / :'QS1'", before=["Q1 = 0"]), \
            {}, {"m.a": text}
    yield "one_file", loop("FN 16: F-PRINT m.a / TNC:\\out.txt"), {}, {"m.a": '"' + "x" * 200 + '";\n'}
    yield "screen", loop("FN 16: F-PRINT m.a / SCREEN:"), {}, {"m.a": '"' + "x" * 200 + '";\n'}
    yield "blank_screen", loop("FN 16: F-PRINT m.a / SCREEN:"), {}, {"m.a": '"";\n' * 1000}
    yield "markup", loop("FN 16: F-PRINT m.a / SCREEN:"), {}, {"m.a": '"<script>\\"&";\n'}
    yield "fn15", loop("FN 15: PRINT 1/2/3")
    yield "append", loop("FN 16: F-PRINT m.a / TNC:\\out.txt"), {}, {"m.a": '"x";\nM_APPEND;\nM_CLOSE;\n'}
    yield "wide_format", loop("FN 16: F-PRINT m.a / SCREEN:", before=["Q1 = 1"]), {}, {"m.a": '"%9999F", Q1;\n'}
    yield "messages", loop(*number, "M0", before=["Q1 = 0"])
    yield "text_doubles", loop("QS1 = QS1 || QS1", before=['QS1 = "ab"'])
    yield "records", ["TOOL CALL 30 Z", "L Z+50 FMAX", *loop(*HOLE)], part(BLOCK, BORE)
    yield "table_rows", loop(*number, 'FN 27: TABWRITE Q1/"X" = 5', before=["Q1 = 0", "FN 26: TABOPEN t.tab"]), \
        {}, {"t.tab": "BEGIN t .TAB MM\nNR   X\n0    1\n[END]\n"}
    yield "table_reopened", loop('FN 27: TABWRITE 0/"X" = Q5', "FN 26: TABOPEN t.tab",
                                 before=["Q5 = 3", "FN 26: TABOPEN t.tab"]), {}, {"t.tab": rows(20_000)}
    yield "trace", loop("L X+1 FMAX", "L Y+1 FMAX", "L X+0 FMAX", "L Y+0 FMAX")
    yield "datum_table", loop("CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 #1", before=['SEL TABLE "d.d"']), \
        {}, {"d.d": rows(20_000)}


def rows(count):
    return "BEGIN t .TAB MM\nNR      X\n" + "".join(f"{n:<8}1\n" for n in range(count)) + "[END]\n"


def infinite():
    """What leaves the finite numbers, or those that a whole number holds."""
    yield "slow_feed", ["Q1 = 999999999 ^ -34", "TOOL CALL 30 Z", "L X+100 FQ1"]
    yield "slow_arc", ["Q1 = 999999999 ^ -34", "TOOL CALL 30 Z", "L X+10 FMAX", "CC X+0 Y+0", "C X-10 DR+ FQ1"]
    yield "slow_many", ["Q1 = 1 / 999999999", "TOOL CALL 30 Z", *loop("L X+100 FQ1", "L X-100 FQ1")]
    yield "long_dwells", ["LBL 1", "CYCL DEF 9.0 DWELL TIME", "CYCL DEF 9.1 DWELL 999999999", "CALL LBL 1 REP 300"]
    yield "power", ["Q1 = 999999999", "LBL 1", "Q1 = Q1 * Q1", ENDLESS]
    yield "root", ["Q1 = SQRT( -1 )"]
    yield "divide", ["Q1 = 1 / 0"]
    yield "logarithm", ["Q1 = LN( 0 )"]
    yield "exponent", ["Q1 = EXP( 99999 )"]
    yield "tangent", ["Q1 = TAN( 90 )", "L X+Q1 FMAX"]
    big = ["Q5 = 4294967", "Q5 = Q5 * 1000 + 296"]
    yield "preset_beyond", [*big, "FN 17: SYSWRITE ID503 NRQ5 IDX1 = 5"]
    yield "tool_beyond", [*big, "FN 18: SYSREAD Q1 = ID50 NR1 IDXQ5"]
    yield "error_beyond", [*big, "FN 14: ERROR = Q5"]
    yield "label_beyond", [*big, "CALL LBL Q5"]
    yield "tool_call_beyond", [*big, "TOOL CALL Q5 Z"]
    yield "far_move", ["L X+999999999 FMAX"]
    yield "far_arc", ["TOOL CALL 30 Z", "CC X+999999999 Y+0", "C X+0 DR+ F500"]
    yield "scale_0", ["CYCL DEF 11.0 SCALING", "CYCL DEF 11.1 SCL 0"]
    yield "angle", ["CYCL DEF 10.0 ROTATION", "CYCL DEF 10.1 ROT+999999999"]


def outside():
    """What tries to leave the control's disk."""
    for number, path in enumerate(("..\\..\\etc\\passwd", "/etc/passwd", "C:\\x", "\\\\host\\x", "PLC:\\x",
                                   ".", "..", "sub\\..", "sub\\.")):
        yield f"print_{number}", [f"FN 16: F-PRINT m.a / {path}"], {}, {"m.a": '"x";\n'}
    yield "open_outside", ["FN 26: TABOPEN ..\\..\\..\\etc\\passwd"]
    yield "call_outside", ["CALL PGM ..\\..\\x.h"]
    yield "exists_again", loop("FN 18: SYSREAD Q1 = ID10 NR110 IDX1", before=['QS1 = "big.bin"']), \
        {}, {"big.bin": "x" * (SCALE * MEGABYTE - 1)}


def large():
    """What is merely very large."""
    most = SCALE * MEGABYTE - 200
    blocks = most if SCALE > 1 else most // 8  # each is read twice and written once more, as DIN/ISO
    yield "formulas", ["Q1=1"] * (blocks // 9)
    yield "short_blocks", ["M5"] * (blocks // 11)
    yield "labels", [f"LBL {n}" for n in range(1, 8_000 * SCALE)]
    yield "labels_again", [f"LBL {n}" for n in range(1, 8_000 * SCALE)] + ["CALL PGM labels_again.h"]
    yield "one_comment", ["; " + "x" * (most - 100)]
    yield "one_formula", ["Q1 = " + "1 + " * 100_000 + "1"]
    yield "deep", ["Q1 = " + "( " * 10_000 + "1" + " )" * 10_000]
    yield "faults", ["GARBAGE"] * (12_500 * SCALE)
    yield "line_ends", ["\n" * (most - 100)]
    yield "mask_lines", ["FN 16: F-PRINT m.a / SCREEN:"], {}, {"m.a": "L_ALL\n" * (most // 6)}
    yield "mask_texts", ["FN 16: F-PRINT m.a / SCREEN:"], {}, {"m.a": '"";\n' * (most // 4)}
    columns = "BEGIN t .TAB MM\n#STRUCTBEGIN\n#STRUCTEND\nNR " + " ".join(f"C{n}" for n in range(100_000))
    yield "table_columns", ["FN 26: TABOPEN t.tab"], {}, {"t.tab": columns + "\n[END]\n"}
    described = "".join(f" NAME = C{n}\n TYPE = N\n" for n in range(100_000))
    yield "table_description", ["FN 26: TABOPEN t.tab"], {}, \
        {"t.tab": f"BEGIN t .TAB MM\n#STRUCTBEGIN\n{described}#STRUCTEND\nNR X\n0  1\n[END]\n"}
    yield "table_lines", ["FN 26: TABOPEN t.tab"], {}, {"t.tab": "BEGIN t\nNR X\n" + "\n" * (most - 100) + "[END]\n"}
    yield "table_cells", ["FN 26: TABOPEN t.tab"], {}, {"t.tab": rows(100_000 * SCALE)[:most]}
    called = "BEGIN PGM S MM\n" + "Q1 = Q1 + 1\n" * (18_000 * SCALE) + "END PGM S MM\n"
    yield "many_programs", [f"CALL PGM s{n}.h" for n in range(12)], {}, {f"s{n}.h": called for n in range(12)}


def iso_texts():
    """What only a reader of DIN/ISO meets: (name, blocks as they are written)."""
    most = SCALE * MEGABYTE - 200
    many = 12_500 * SCALE
    yield "endless", ["N10 G98 L1 *", "N20 D09 P01 +0 P02 +0 P03 1 *"]
    yield "calls_itself", ["N10 %iso_calls_itself *"]
    yield "calls_nested", ["N10 G98 L1 *", "N20 G98 L2 *", "N30 L2,65534 *", "N40 L1,65534 *"]
    yield "moves", ["N10 T30 G17 *", "N20 G98 L1 *", "N30 G01 G91 X+1 F500 *", "N40 X-1 *", "N50 D09 P01 +0 P02 +0 P03 1 *"]
    yield "arcs", ["N10 T30 G17 *", "N20 I+0 J+0 *", "N30 G00 G90 X+10 *", "N40 G98 L1 *", "N50 G02 X+10 Y+0 F500 *",
                   "N60 D09 P01 +0 P02 +0 P03 1 *"]
    yield "block_without_end", ["N10 G421 MEASURE HOLE", *["Q273=+1 ~"] * (most // 10)]
    yield "lines_without_end", ["N10 G01 X+1"] * (most // 12)
    yield "wraps", ["~"] * (most // 2)
    yield "stars", ["*" * most]
    yield "blocks_in_a_line", ["N10 G01 X+1 * " * (most // 14)]
    yield "codes_in_a_block", ["N10 " + "G01 " * (most // 4) + "*"]
    yield "words_in_a_block", ["N10 G01 " + "X+1 " * (most // 4) + "*"]
    yield "parameters_in_a_block", ["N10 G421 " + "Q273=+1 " * (most // 8) + "*"]
    yield "lines_of_a_block", ["N10 G421 ~", *["Q273=+1 ~"] * (most // 10), "Q274=+1 *"]
    yield "unknown_codes", ["N10 G998 X+1 *"] * many
    yield "unknown_letters", ["N10 W?!$ *"] * many
    yield "assumed_modes", ["N10 X+1 Y+1 *"] * (most // 14)
    yield "rows_of_frames", ["%A G71 *", "N99999999 %A G71 *"] * (most // 28)
    yield "numbers_beyond", [f"N{'9' * 400} G{'9' * 400} X+{'9' * 400} L{'9' * 400} T{'9' * 400} D{'9' * 400} *"] * 1_000
    yield "open_quotes", ['N10 QS1 = "' + "x" * most]
    yield "comment_stars", ["N10 M5 ;" + "*~" * (most // 2)]
    yield "deep", ["N10 Q1 = " + "( " * 10_000 + "1" + " )" * 10_000 + " *"]
    yield "texts_of_functions", ["N10 D18: " + "SYSREAD " * (most // 8) + "*"]
    yield "points_of_a_function", ["N10 D09 " + "P01 +0 " * (most // 7) + "*"]


def programs():
    for family in (endless, lasting, growing, infinite, outside, large):
        for entry in family():
            name, blocks, *rest = entry
            machine, files = (*rest, {}, {})[:2]
            yield f"{family.__name__}_{name}".lower(), blocks, machine, files
