#include "nc/klartext/diagnostic.hpp"

#include <doctest/doctest.h>

namespace fitgauge::klartext {
namespace {

Diagnostic at(std::uint32_t column, std::uint32_t end_column, std::string source) {
  return {.severity = Severity::Error,
          .code = DiagnosticCode::LabelUnknown,
          .message = "label 5 is not defined",
          .program = "8255.h",
          .range = {{14, column}, {14, end_column}},
          .block = 13,
          .source = std::move(source)};
}

TEST_CASE("A rendered diagnostic has its place, its code, the line and carets below the place") {
  CHECK(render(at(13, 18, "13 CALL LBL 5 ;x")) ==
        "8255.h:14:13: error: label 5 is not defined [label.unknown]\n"
        "13 CALL LBL 5 ;x\n"
        "            ^^^^^");
}

TEST_CASE("A caret counts characters, keeps tabs, and may stand right behind the line") {
  CHECK(render(at(4, 4, "\tÄÖ X")).ends_with("\n\t  ^"));
  CHECK(render(at(2, 2, "L")).ends_with("L\n ^"));
}

TEST_CASE("There is no caret beyond a line that was cut") {
  CHECK(render(at(4, 5, "L")).ends_with("\nL"));
}

TEST_CASE("Codes of diagnostics are distinct") {
  std::set<std::string_view> ids;
  const auto last = static_cast<int>(DiagnosticCode::MaskValueType);
  for (int i = 0; i <= last; ++i) ids.insert(id(static_cast<DiagnosticCode>(i)));
  CHECK(ids.size() == static_cast<std::size_t>(last) + 1);
  CHECK(id(DiagnosticCode::MaskValueType) == "mask.value_type");
}

}  // namespace
}  // namespace fitgauge::klartext
