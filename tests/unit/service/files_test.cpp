#include "service_fixture.hpp"

namespace fitgauge::app {
namespace {

interpreter::ControlPath path(std::string_view text) {
  return interpreter::ControlPath::parse(text).value();
}

TEST_CASE("a file is checked as what its extension says: program, mask or table") {
  Service service;
  service.upload("TNC:\\p.h", "BEGIN PGM p MM\nGARBAGE\nEND PGM p MM\n");
  service.upload("TNC:\\m.a", "\"%5.2XF\", Q1;\n");
  service.upload("TNC:\\t.tab", "BEGIN t .TAB MM\nNR      X\n0       1\n");
  const auto findings = [&](std::string_view name) {
    return service.prepared([&] { return service->runs().check(path(name)); });
  };
  for (const auto& expected :
       {std::pair{"TNC:\\p.h", 2U}, std::pair{"TNC:\\m.a", 1U}, std::pair{"TNC:\\t.tab", 3U}}) {
    const std::string_view name = expected.first;
    CAPTURE(name);
    const auto found = findings(name).value();
    REQUIRE_FALSE(found.empty());
    CHECK(found.front().severity == klartext::Severity::Error);
    CHECK(found.front().program == name);
    CHECK(found.front().range.begin.line == expected.second);
  }
  CHECK(findings("TNC:\\none.h").error().code == ErrorCode::ProgramUnknown);
}

TEST_CASE("a draft is checked in place of the stored file, which stays as it is") {
  Service service;
  service.upload("TNC:\\p.h", "BEGIN PGM p MM\nEND PGM p MM\n");
  service.upload("TNC:\\sub.h", "BEGIN PGM sub MM\nEND PGM sub MM\n");
  const auto findings = [&](std::string_view name, std::optional<std::string> draft) {
    return service.prepared([&] { return service->runs().check(path(name), draft); }).value();
  };
  // Twice with other texts: no cache keeps one draft for the next.
  const auto broken =
      findings("TNC:\\P.H", "BEGIN PGM p MM\nCALL PGM sub\nGARBAGE\nEND PGM p MM\n");
  REQUIRE(broken.size() == 1);
  CHECK(broken.front().range.begin.line == 3);
  CHECK(findings("TNC:\\p.h", "BEGIN PGM p MM\nCALL PGM sub\nEND PGM p MM\n").empty());
  CHECK(findings("TNC:\\p.h", std::nullopt).empty());
  // What was never stored can be checked too.
  CHECK(findings("TNC:\\new.h", "BEGIN PGM new MM\nCALL PGM none\nEND PGM new MM\n").size() == 1);
}

TEST_CASE("a path is given with or without its drive, and with either separator") {
  for (const char* text :
       {"TNC:\\b\\out.txt", "TNC:/b/out.txt", "tnc:\\b/out.txt", "b/out.txt", "/b/out.txt"}) {
    CAPTURE(text);
    const auto parsed = parse_file_path(text).value();
    CHECK(parsed.text() == "TNC:\\b\\out.txt");
  }
  CHECK(parse_file_path("PLC:/b/out.txt").has_error());
}

}  // namespace
}  // namespace fitgauge::app
