#include <doctest/doctest.h>

#include "nc/klartext/mask_file.hpp"

namespace fitgauge::klartext {
namespace {

ParsedMask parsed(std::string text) { return parse_mask(std::move(text), "m.a"); }

/// The pieces of a mask of one line.
std::vector<MaskPiece> pieces(std::string line) {
  const ParsedMask mask = parsed(std::move(line));
  for (const Diagnostic& diagnostic : mask.diagnostics) MESSAGE(render(diagnostic));
  REQUIRE(mask.diagnostics.empty());
  REQUIRE(mask.mask.lines.size() == 1);
  return std::get<MaskFormat>(mask.mask.lines[0].content).pieces;
}

MaskPlaceholder placeholder(const std::string& format, const std::string& value) {
  const auto found = pieces("\"" + format + "\", " + value + ";");
  REQUIRE(found.size() == 1);
  return std::get<MaskPlaceholder>(found[0]);
}

std::string first_finding(std::string text) {
  const ParsedMask mask = parsed(std::move(text));
  if (mask.diagnostics.empty()) return {};
  const Diagnostic& first = mask.diagnostics[0];
  return std::to_string(first.range.begin.line) + ":" + std::to_string(first.range.begin.column) +
         " " + std::string(id(first.code));
}

TEST_CASE("A line of a mask is text and placeholders with their values") {
  const auto found = pieces("\"MEASURED DIAMETER: %9.4LF mm %S\", Q153, QS1;  comment");
  REQUIRE(found.size() == 4);
  CHECK(std::get<std::string>(found[0]) == "MEASURED DIAMETER: ");
  const MaskPlaceholder diameter{.width = 9, .decimals = 4, .value = QRef{QSpace::Q, 153}};
  CHECK(std::get<MaskPlaceholder>(found[1]) == diameter);
  CHECK(std::get<std::string>(found[2]) == " mm ");
  const MaskPlaceholder name{.conversion = MaskConversion::String, .value = QRef{QSpace::Qs, 1}};
  CHECK(std::get<MaskPlaceholder>(found[3]) == name);
}

TEST_CASE("Placeholders in all their forms") {
  const QRef q5{QSpace::Q, 5};
  const QRef qs5{QSpace::Qs, 5};
  CHECK(placeholder("%F", "Q5") == MaskPlaceholder{.value = q5});
  CHECK(placeholder("%+7.3F", "q5") ==
        MaskPlaceholder{.plus = true, .width = 7, .decimals = 3, .value = q5});
  CHECK(placeholder("%-7.3f", "Q5") ==
        MaskPlaceholder{.left = true, .width = 7, .decimals = 3, .value = q5});
  CHECK(placeholder("%02.2d", "DAY") == MaskPlaceholder{.conversion = MaskConversion::Integer,
                                                        .zero = true,
                                                        .width = 2,
                                                        .decimals = 2,
                                                        .value = MaskKeyword::Day});
  CHECK(placeholder("%4d", "YEAR4") == MaskPlaceholder{.conversion = MaskConversion::Integer,
                                                       .width = 4,
                                                       .value = MaskKeyword::Year4});
  CHECK(placeholder("%LD", "QL5").conversion == MaskConversion::Integer);
  CHECK(placeholder("%I", "QR5").conversion == MaskConversion::Integer);
  CHECK(placeholder("%C", "Q5").conversion == MaskConversion::Character);
  CHECK(placeholder("%s", "QS5") ==
        MaskPlaceholder{.conversion = MaskConversion::String, .value = qs5});
  CHECK(placeholder("%RS", "CALL_PATH") ==
        MaskPlaceholder{.conversion = MaskConversion::RawString, .value = MaskKeyword::CallPath});
  CHECK(placeholder("%S", "STR_MONTH").value == MaskValue(MaskKeyword::MonthName));
}

TEST_CASE("Escapes") {
  const auto text = [](std::string line) {
    return std::get<std::string>(pieces(std::move(line)).at(0));
  };
  CHECK(text(R"("100%% \"ok\" \\ C:\test\n")") == "100% \"ok\" \\ C:\\test\n");
  CHECK(text("\"; no comment, Q1\"") == "; no comment, Q1");
  CHECK(pieces("\"\";").empty());
}

TEST_CASE("The semicolon at the end may be missing, a comma may stand there") {
  CHECK(pieces("\"a\"").size() == 1);
  CHECK(pieces("  \"a %F\",Q1").size() == 2);
  CHECK(pieces("\"a %F\", Q1,").size() == 2);
}

TEST_CASE("Every keyword line") {
  const ParsedMask mask = parsed(
      "* comment\n; comment\n\nM_CLOSE;\nM_APPEND\nm_append_max20;\nM_TRUNCATE\nM_EMPTY_HIDE\n"
      "M_EMPTY_SHOW\n");
  REQUIRE(mask.diagnostics.empty());
  std::vector<MaskControlKind> kinds;
  for (const MaskLine& line : mask.mask.lines) {
    kinds.push_back(std::get<MaskControl>(line.content).kind);
  }
  CHECK(kinds == std::vector{MaskControlKind::Close, MaskControlKind::Append,
                             MaskControlKind::AppendMax, MaskControlKind::Truncate,
                             MaskControlKind::EmptyHide, MaskControlKind::EmptyShow});
  CHECK(std::get<MaskControl>(mask.mask.lines[2].content).kilobytes == 20);
  CHECK(mask.mask.lines[0].line == 4);
}

TEST_CASE("Every language line") {
  struct Row {
    const char* line;
    MaskLanguage language;
  };
  for (const Row& row : std::initializer_list<Row>{
           {"L_ENGLISH", MaskLanguage::English}, {"L_GERMAN", MaskLanguage::German},
           {"L_CZECH", MaskLanguage::Other},     {"L_FRENCH", MaskLanguage::Other},
           {"L_ITALIAN", MaskLanguage::Italian}, {"L_SPANISH", MaskLanguage::Other},
           {"L_PORTUGUE", MaskLanguage::Other},  {"L_SWEDISH", MaskLanguage::Other},
           {"L_DANISH", MaskLanguage::Other},    {"L_FINNISH", MaskLanguage::Other},
           {"L_DUTCH", MaskLanguage::Dutch},     {"L_POLISH", MaskLanguage::Polish},
           {"L_HUNGARIA", MaskLanguage::Other},  {"L_RUSSIAN", MaskLanguage::Other},
           {"L_CHINESE", MaskLanguage::Other},   {"L_CHINESE_TRAD", MaskLanguage::Other},
           {"L_SLOVENIAN", MaskLanguage::Other}, {"L_KOREAN", MaskLanguage::Other},
           {"L_NORWEGIAN", MaskLanguage::Other}, {"L_ROMANIAN", MaskLanguage::Other},
           {"L_SLOVAK", MaskLanguage::Other},    {"L_TURKISH", MaskLanguage::Other},
           {"L_ALL", MaskLanguage::All}}) {
    CAPTURE(row.line);
    const ParsedMask mask = parsed(row.line);
    REQUIRE(mask.mask.lines.size() == 1);
    CHECK(std::get<MaskLanguage>(mask.mask.lines[0].content) == row.language);
  }
}

TEST_CASE("Mistakes in a mask are named with their place") {
  CHECK(first_finding("\"a\";\n\"%F %F\", Q1;") == "2:12 mask.value_missing");
  CHECK(first_finding("\"%F\", QS1;") == "1:7 mask.value_type");
  CHECK(first_finding("\"%S\", Q1;") == "1:7 mask.value_type");
  CHECK(first_finding("\"%S\", HOUR;") == "1:7 mask.value_type");
  CHECK(first_finding("\"%9.4X\", Q1;") == "1:2 mask.placeholder_malformed");
  CHECK(first_finding("\"100%\";") == "1:5 mask.placeholder_malformed");
  CHECK(first_finding("\"%999F\", Q1;") == "1:2 mask.placeholder_malformed");
  CHECK(first_finding("\"open") == "1:1 string.unterminated");
  CHECK(first_finding("L_LATIN") == "1:1 mask.keyword_unknown");
  CHECK(first_finding("\"%F\", Q2000") == "1:7 parameter.out_of_range");
  CHECK(first_finding("\"%F\", X") == "1:7 syntax.error");
  CHECK(first_finding("\"a\" Q1") == "1:5 syntax.error");
}

TEST_CASE("A value without a placeholder is a warning, and the line stays") {
  const ParsedMask mask = parsed("\"a\", Q1;");
  REQUIRE(mask.diagnostics.size() == 1);
  CHECK(mask.diagnostics[0].code == DiagnosticCode::MaskValueUnused);
  CHECK_FALSE(has_errors(mask.diagnostics));
  CHECK(mask.mask.lines.size() == 1);
}

TEST_CASE("A mask beyond the limit is refused") {
  std::string text;
  while (text.size() <= kLargestMask) text += "\"\";\n";
  const ParsedMask refused = parse_mask(text, "m.a");
  REQUIRE(refused.diagnostics.size() == 1);
  CHECK(refused.diagnostics[0].code == DiagnosticCode::ProgramTooLarge);
  CHECK_FALSE(
      has_errors(parse_mask(text.substr(0, kLargestMask - kLargestMask % 4), "m.a").diagnostics));
}

TEST_CASE("Masks come in UTF-8 with a byte order mark and in Windows-1252") {
  CHECK(std::get<std::string>(pieces("\xEF\xBB\xBF\"\xC3\x84\"\r\n").at(0)) == "\xC3\x84");
  CHECK(std::get<std::string>(pieces("\"\xC4 \x80\"\r").at(0)) == "\xC3\x84 \xE2\x82\xAC");
}

}  // namespace
}  // namespace fitgauge::klartext
