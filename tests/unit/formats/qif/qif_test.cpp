#include <doctest/doctest.h>

#include "formats/qif/qif.hpp"
#include "support/qif_text.hpp"

namespace fitgauge::qif {
namespace {

using namespace std::string_literals;

using app::Measurement;

Measurement value(std::int64_t number, std::int64_t nanometres) {
  Measurement value;
  value.origin = "5f0c9a3e77d21b40";
  value.id = number;
  value.measured = Length::nanometres(nanometres);
  value.nominal_size = Length::millimetres(25);
  value.deviations = {.upper = Length::nanometres(21'000), .lower = {}};
  value.class_name = "H7";
  return value;
}

/// A document of `count` values.
std::string written(std::size_t count) {
  QifWriter writer;
  for (std::size_t i = 0; i < count; ++i) {
    const auto added =
        writer.add(value(static_cast<std::int64_t>(i), 25'000'000 + static_cast<std::int64_t>(i)));
    REQUIRE(added.has_value());
  }
  return writer.text();
}

std::string error_of(const std::string& text, const QifOptions& options = {}) {
  const auto read = read_qif(text, options);
  return read ? "" : read.error().message;
}

TEST_CASE("what is written is read with the same values") {
  QifWriter writer;
  Measurement first = value(1, 25'013'100);
  first.part_id = "P<1>&\"";
  first.characteristic = " a  b\n";
  first.standard_uncertainty = Length::nanometres(750);
  first.machine = "M3";
  first.comment = "a;\n\t\"b\"";
  REQUIRE(writer.add(first).has_value());
  Measurement second = value(2, 24'991'000);
  second.class_name.reset();
  second.basis = app::LimitsBasis::Explicit;
  second.feature = iso286::Feature::Shaft;
  second.deviations.lower = -app::kNoLimit;
  REQUIRE(writer.add(second).has_value());
  const auto read = read_qif(writer.text(), {}).value();
  CHECK(read.csv.find("25.0131") != std::string::npos);
  CHECK(read.csv.find("24.991") != std::string::npos);
  CHECK(read.csv.find("H7") != std::string::npos);
  CHECK(read.csv.find("\"P<1>&\"\"\"") != std::string::npos);
  CHECK(read.csv.find("M3") != std::string::npos);
  CHECK(read.csv.find("shaft") != std::string::npos);
  // The second comes behind a row of three lines, each of which has the line of the document.
  CHECK(read.lines.size() >= 2);
  CHECK(read.lines.front() < read.lines.back());
}

TEST_CASE("the operator of a size and the envelope are elements of the definition") {
  QifWriter writer;
  for (const char* const name : {"GG", "SD"}) {
    Measurement sized = value(1, 25'010'000);
    sized.size_operator = name;
    if (name == std::string("GG")) sized.envelope = app::kEnvelopeRequired;
    REQUIRE(writer.add(sized).has_value());
  }
  const std::string text = writer.text();
  CAPTURE(text);
  // In the order of the schema: attributes, envelope, modifiers, tolerance.
  CHECK(text.find("</Attributes><EnvelopeRequirement>true</EnvelopeRequirement><DimensionModifiers>"
                  "<DeterminationModifier>GG</DeterminationModifier></DimensionModifiers>"
                  "<Tolerance>") != std::string::npos);
  CHECK(text.find(R"(<AttributeStr name="size_operator" value="SD"/>)") != std::string::npos);
  const auto read = read_qif(text, {}).value();
  CHECK(read.csv.find(";GG;required;") != std::string::npos);
  CHECK(read.csv.find(";SD;;") != std::string::npos);
  // Of a distance, of which nothing says that it is a size, they are passed over.
  std::string distance = text;
  for (const auto& [from, to] : {std::pair("Diameter"s, "Length"s),
                                 std::pair("name=\"tolerance_class\""s, "name=\"other\""s),
                                 std::pair("name=\"feature\""s, "name=\"other\""s)}) {
    for (std::size_t at = 0; (at = distance.find(from, at)) != std::string::npos;) {
      distance.replace(at, from.size(), to);
    }
  }
  const auto other = read_qif(distance, {}).value();
  CHECK(other.csv.find("distance") != std::string::npos);
  CHECK(other.csv.find(";GG;") == std::string::npos);
}

TEST_CASE("the same values are the same bytes, and a text that XML cannot hold is refused") {
  CHECK(written(20) == written(20));
  QifWriter writer;
  Measurement bad = value(1, 25'000'000);
  bad.part_id = "a\x01";
  CHECK_FALSE(writer.add(bad).has_value());
  Measurement simulated = value(1, 25'000'000);
  simulated.source = app::Source::Simulation;
  CHECK_FALSE(writer.add(simulated).has_value());
  CHECK(writer.is_empty());
}

TEST_CASE("a document that is cut anywhere is an error") {
  const std::string text = written(3);
  REQUIRE(error_of(text).empty());
  // Behind the last tag stands a line end alone.
  for (std::size_t size = 0; size + 2 < text.size(); ++size) {
    CAPTURE(size);
    REQUIRE_FALSE(error_of(text.substr(0, size)).empty());
  }
}

TEST_CASE("a document type is refused where it stands") {
  std::string text = written(1);
  text.insert(text.find("?>\n") + 3, "<!DOCTYPE QIFDocument>\n");
  const std::string error = error_of(text);
  CAPTURE(error);
  CHECK(error.starts_with("line 2 "));
  CHECK(error.find("DOCTYPE") != std::string::npos);
}

TEST_CASE("a document is read in the encoding that it names, or refused") {
  const auto read_in = [](std::string_view encoding, std::string_view name) {
    QifWriter writer;
    Measurement named = value(1, 25'000'000);
    named.part_id = "NAME";
    REQUIRE(writer.add(named).has_value());
    std::string text = writer.text();
    text.replace(text.find("UTF-8"), 5, encoding);
    text.replace(text.find("NAME"), 4, name);
    const auto read = read_qif(text, {});
    return read ? read->csv : read.error().message;
  };
  for (const auto& [encoding, name] :
       {std::pair("UTF-8", "B\xC3\xBChrle"), std::pair("ISO-8859-1", "B\xFChrle"),
        std::pair("windows-1252", "B\xFChrle"), std::pair("IBM850", "B\x81hrle")}) {
    CAPTURE(encoding);
    CHECK(read_in(encoding, name).find("B\xC3\xBChrle") != std::string::npos);
  }
  CHECK(read_in("UTF-8", "B\xFChrle").find("is not well-formed XML") != std::string::npos);
  for (const char* const unknown : {"Shift_JIS", "no-encoding"}) {
    CAPTURE(unknown);
    CHECK(read_in(unknown, "a") == "line 1 is not well-formed XML: unknown encoding");
  }
  std::string wide = "\xFE\xFF";
  for (const char c : written(2)) wide += {'\0', c};
  wide.replace(wide.find("U\0T\0F\0-\0008"s), 9, "U\0T\0F\0-\0001\0006"s);
  CHECK(error_of(wide).empty());
}

TEST_CASE("an input that fails is told with its words") {
  const std::string text = written(200);
  std::size_t left = text.size() / 2;
  auto failing = read_text(text);
  const Read read = [&](std::span<char> into) -> Result<std::size_t> {
    if (left < into.size()) return Error{ErrorCode::Internal, "the disk is gone"};
    left -= into.size();
    return failing(into);
  };
  CHECK(QifRows::open(read, read_text(text), {}).error().message.find("the disk is gone") !=
        std::string::npos);
}

TEST_CASE("rows, definitions and elements are bounded") {
  const std::string text = written(30);
  CHECK(error_of(text, {{}, 30}).empty());
  CHECK(error_of(text, {{}, 29}).find("comes after 29 measured values") != std::string::npos);
  // One element of more than it may have, given piece by piece: nothing of it is kept for long.
  const std::string begin =
      R"(<QIFDocument xmlns="http://qifstandards.org/xsd/qif3"><CharacteristicItems><I id="1">)";
  const std::string piece = "<Name>" + std::string(100, 'x') + "</Name>";
  std::string large = begin;
  while (large.size() < XmlReader::kLargestElement + begin.size() + 10'000) large += piece;
  CHECK(error_of(large).find("has an element of more than 4 MiB") != std::string::npos);
  const std::string root = R"(<QIFDocument xmlns="http://qifstandards.org/xsd/qif3">)";
  for (const std::string& tag :
       {"<a b='" + std::string(90'000, 'x') + "'/>", "<!--" + std::string(90'000, 'x') + "-->"}) {
    CHECK(error_of(root + tag).find("has a tag or a comment of more than 64 KiB") !=
          std::string::npos);
  }
  std::string attributes;
  for (int i = 0; i < 257; ++i) attributes += fmt::format(" a{}=''", i);
  CHECK(error_of(root + "<a" + attributes + "/>").find("has more than 256 attributes") !=
        std::string::npos);
  CHECK(error_of("<a" + attributes + "/>").find("has more than 256 attributes") !=
        std::string::npos);
  std::string deep = root;
  for (int i = 0; i < 256; ++i) deep += "<a>";
  CHECK(error_of(deep).find("has more than 256 elements inside each other") != std::string::npos);
  std::string many =
      R"(<QIFDocument xmlns="http://qifstandards.org/xsd/qif3"><CharacteristicItems>)";
  for (int i = 0; i <= 100'000; ++i) many += "<I/>";
  CHECK(error_of(many).find("comes after 100000 definitions") != std::string::npos);
}

}  // namespace
}  // namespace fitgauge::qif
