#include "formats/sheet/record_reader.hpp"

#include <doctest/doctest.h>

namespace fitgauge::sheet {
namespace {

std::string read_all(std::string_view text, std::size_t most) {
  const Read pieces = [read = read_text(text), most](std::span<char> into) {
    return read(into.first(std::min(most, into.size())));
  };
  auto rows = NdjsonRows::open({}, pieces, Encoding::Utf8, {});
  std::string out;
  for (;;) {
    const auto more = rows->append(out);
    if (!more) return "error: " + more.error().message;
    if (!*more) return out;
  }
}

TEST_CASE("records come as they are given, whatever the pieces") {
  const std::string given = "{\"measured_mm\":25}\n\n{\"comment\":\"\xC3\x98\"}";
  const std::string exported =
      "\n{\"id\":\"m1\",\"source\":\"gauge\",\"basis\":\"iso286\",\"received_at\":\"2026-11-20T07:"
      "00:00Z\","
      "\"measured_mm\":25}\n";
  const std::string simulated =
      "{}\n{\"id\":\"m1\",\"source\":\"simulation\",\"basis\":\"iso286\",\"received_at\":\"\"}\n";
  for (const std::size_t most : {1U, 2U, 7U, 1000U}) {
    CHECK(read_all(given, most) == given);
    CHECK(read_all(exported, most) == "\n{\"measured_mm\":25}\n");
    CHECK(read_all(simulated, most).starts_with("error: line 2 is simulated"));
    CHECK(read_all("{}\n\xFF{}\n", most).starts_with("error: byte 3 is not UTF-8"));
  }
  CHECK(read_all("", 1).empty());
}

TEST_CASE("a line that does not end is refused") {
  CHECK(read_all("{}\n" + std::string(3 << 20, ' '), 1 << 16) ==
        "error: line 2 has more than 1024 KiB: is it NDJSON?");
}

}  // namespace
}  // namespace fitgauge::sheet
