#include "service_fixture.hpp"

namespace fitgauge::app {
namespace {

interpreter::ControlPath path(std::string_view text) {
  return interpreter::ControlPath::parse(text).value();
}

TEST_CASE("a file is written, replaced, read and removed, whatever the case of its name") {
  Service service;
  FileService& files = service->files();
  const auto write = [&](std::string_view name, std::string_view bytes) {
    return wait_for<bool>(
               [&](auto done) { files.write(path(name), bytes, {}, {}, std::move(done)); })
        .value();
  };
  const auto read = [&](std::string_view name) {
    return wait_for<store::FileContent>(
        [&](auto done) { files.read(path(name), std::move(done)); });
  };
  const auto first = write("TNC:\\Dir\\File.H", "one");
  const auto second = write("TNC:\\dir\\file.h", std::string_view("\0\xFF", 2));
  CHECK(first);
  CHECK_FALSE(second);
  CHECK(read("TNC:\\DIR\\FILE.H")->content == std::string("\0\xFF", 2));

  write("TNC:\\other\\file.h", "");
  const auto listed = wait_for<std::vector<store::FileEntry>>(
      [&](auto done) { files.list("TNC:\\dir\\", std::move(done)); });
  REQUIRE(listed->size() == 1);
  CHECK((*listed)[0].size == 2);

  const auto remove = [&] {
    return wait_for<bool>(
        [&](auto done) { files.remove(path("TNC:\\dir\\FILE.h"), {}, {}, {}, std::move(done)); });
  };
  CHECK(remove().has_value());
  CHECK(remove().error().code == ErrorCode::FileUnknown);
  CHECK(read("TNC:\\dir\\file.h").error().code == ErrorCode::FileUnknown);
}

TEST_CASE("a precondition is asked with the state that a change would replace") {
  Service service;
  FileService& files = service->files();
  const auto write = [&](const FileService::Precondition& allowed, std::string_view bytes) {
    return wait_for<bool>(
        [&](auto done) { files.write(path("TNC:\\a.h"), bytes, {}, allowed, std::move(done)); });
  };
  const auto is_new = [](std::optional<std::string_view> stored) { return !stored; };
  REQUIRE(write(is_new, "x").has_value());
  CHECK(write(is_new, "y").error().code == ErrorCode::PreconditionFailed);
  const auto is_first = [](std::optional<std::string_view> stored) { return stored == "x"; };
  CHECK(write(is_first, "y").has_value());
  CHECK(write(is_first, "z").error().code == ErrorCode::PreconditionFailed);
  const auto remove = [&](const FileService::Precondition& allowed) {
    return wait_for<bool>(
        [&](auto done) { files.remove(path("TNC:\\a.h"), {}, allowed, {}, std::move(done)); });
  };
  CHECK(remove(is_first).error().code == ErrorCode::PreconditionFailed);
  CHECK(remove({}).has_value());
  CHECK(remove(is_first).error().code == ErrorCode::FileUnknown);
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
    const auto found = findings(name);
    REQUIRE(found.has_value());
    REQUIRE_FALSE(found->empty());
    CHECK(found->front().severity == klartext::Severity::Error);
    CHECK(found->front().program == name);
    CHECK(found->front().range.begin.line == expected.second);
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

TEST_CASE("a named setup is kept as it was written") {
  Service service;
  DocumentService& documents = service->documents();
  constexpr auto kSetup = DocumentKind::Setup;
  const auto write = [&](std::string text) {
    return wait_for<bool>([&](auto done) {
      documents.write({.kind = kSetup, .name = "mill", .text = std::move(text)}, std::move(done));
    });
  };
  CHECK(write("{}").value());
  CHECK_FALSE(write("{\"seed\": 7}").value());
  CHECK(documents.wait_for(kSetup, "mill")->text == "{\"seed\": 7}");
  const auto listed = wait_for<std::vector<NamedDocument>>(
      [&](auto done) { documents.list(kSetup, std::move(done)); });
  REQUIRE(listed->size() == 1);
  CHECK((*listed)[0].name == "mill");
  CHECK(wait_for<bool>([&](auto done) {
          documents.remove(kSetup, "mill", {}, {}, {}, std::move(done));
        }).has_value());
  CHECK(documents.wait_for(kSetup, "mill").error().code == ErrorCode::SetupUnknown);
}

TEST_CASE("a path is given with or without its drive, and with either separator") {
  for (const char* text :
       {"TNC:\\b\\out.txt", "TNC:/b/out.txt", "tnc:\\b/out.txt", "b/out.txt", "/b/out.txt"}) {
    CAPTURE(text);
    const auto parsed = parse_file_path(text);
    REQUIRE(parsed.has_value());
    CHECK(parsed->text() == "TNC:\\b\\out.txt");
  }
  CHECK(parse_file_path("PLC:/b/out.txt").has_error());
}

}  // namespace
}  // namespace fitgauge::app
