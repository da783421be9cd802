#pragma once

// Logs typed by hand: the first with the wording and numbers of the example in HEIDENHAIN's manuals
// (fundamentals of touch-probe cycles 420 to 431), the German one after the German edition.

inline constexpr std::string_view kHole =
    "Measuring log for touch probe cycle 421 Hole measuring\r\n"
    "Date: 30-06-2005\r\n"
    "Time: 6:55:04\r\n"
    "Measuring program: TNC:\\GEH35712\\CHECK1.H\r\n"
    "Type of dimension (0 = MM / 1 = INCH): 0\r\n"
    "\r\n"
    "Nominal values:\r\n"
    "Center in reference axis: 50.0000\r\n"
    "Center in minor axis: 65.0000\r\n"
    "Diameter: 12.0000\r\n"
    "\r\n"
    "Given limit values:\r\n"
    "Maximum limit for center in reference axis: 50.1000\r\n"
    "Minimum limit for center in reference axis: 49.9000\r\n"
    "Maximum limit for center in minor axis: 65.1000\r\n"
    "Minimum limit for center in minor axis: 64.9000\r\n"
    "Maximum dimension for hole: 12.0450\r\n"
    "Minimum dimension for hole: 12.0000\r\n"
    "\r\n"
    "Actual values:\r\n"
    "Center in reference axis: 50.0810\r\n"
    "Center in minor axis: 64.9530\r\n"
    "Diameter: 12.0259\r\n"
    "\r\n"
    "Deviations:\r\n"
    "Center in reference axis: 0.0810\r\n"
    "Center in minor axis: -0.0470\r\n"
    "Diameter: 0.0259\r\n"
    "\r\n"
    "Further measuring results: Measuring height: -5.0000\r\n"
    "Measuring log end\r\n";

// In Windows-1252, as an older control writes it.
inline constexpr std::string_view kStudInGerman =
    "Messprotokoll Antastzyklus 422 Kreis aussen messen\n"
    "Datum: 01.12.2019\n"
    "Uhrzeit: 23:00:59\n"
    "Messprogramm: TNC:\\teil.h\n"
    "Ma\xDF"
    "art (0=MM / 1=INCH): 1\n"
    "-----------------\n"
    "Sollwerte:\n"
    "Mitte Hauptachse: 1.000000\n"
    "Mitte Nebenachse: 0.500000\n"
    "Durchmesser: 0.984252\n"
    "-----------------\n"
    "Vorgegebene Grenzwerte:\n"
    "Gr\xF6\xDFtma\xDF Zapfen: 0.985000\n"
    "Kleinstma\xDF Zapfen: 0.984000\n"
    "-----------------\n"
    "Istwerte:\n"
    "Mitte Hauptachse: 1.000039\n"
    "Mitte Nebenachse: 0.500000\n"
    "Durchmesser: 0.984500\n"
    "Abweichungen:\n"
    "Durchmesser: 0.000248\n"
    "Weitere Messergebnisse: Messh\xF6he: -0.2\n"
    "Messprotokoll-Ende\n";

inline constexpr std::string_view kAngle =
    "****** Measuring log of touch-probe cycle 420 MEASURE ANGLE ******\n"
    "Date: 20-11-2026\nTime: 8:05:09\nMeasuring program: TNC:\\a.h\nUnit (0=MM / 1=INCH): 0\n"
    "------\nActual values:\nMeasured angle:     1.1458\n------\n"
    "****** End of measuring log ******\n\n";

inline constexpr std::string_view kPoint =
    "<!DOCTYPE html>\n<html><head><title>x</title><style>p { color: red }</style></head><body>\n"
    "<header><h1>Measuring log of touch-probe cycle 444 PROBING IN 3-D</h1>\n"
    "<p>Measuring program: TNC:\\a&amp;b.h</p>\n<p>Lengths in mm.</p></header>\n"
    "<section><h2>Point touched on 20-11-2026 at 6:05:04</h2>\n"
    "<table><tr><th>Value</th><th>X</th><th>Along the normal</th></tr>\n"
    "<tr><th>Nominal</th><td>10.0000</td><td>0.0000</td></tr>\n"
    "<tr><th>Upper limit</th><td>10.0500</td><td>0.0500</td></tr>\n"
    "<tr><th>Lower limit</th><td>9.9800</td><td>-0.0200</td></tr>\n"
    "<tr><th>Actual</th><td>10.0123</td><td class=\"judged good\">0.0123</td></tr>\n"
    "</table></section>\n";
