#include "cli/answers.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;
using namespace fitgauge::cli;

namespace {

constexpr Terminal kPlainTerminal{};
constexpr Terminal kUnicode{.unicode = true};

ToleranceZone zone(const char* name, std::int64_t lower_nm, std::int64_t upper_nm) {
  const bool hole = std::string_view(name) == "hole";
  return {.heading = name,
          .upper_name = hole ? "ES" : "es",
          .lower_name = hole ? "EI" : "ei",
          .upper = Length::nanometres(upper_nm),
          .lower = Length::nanometres(lower_nm)};
}

std::string draw(const ToleranceZone& hole, const ToleranceZone& shaft, const Terminal& terminal,
                 std::size_t rows = 8) {
  return draw_zones(std::array{hole, shaft}, "25 mm", terminal, rows);
}

}  // namespace

TEST_CASE("a clearance fit stands on both sides of the zero line") {
  CHECK(draw(zone("hole", 0, 20'000), zone("shaft", -20'000, -10'000), kPlainTerminal) ==
        "  hole                            shaft\n"
        "  ######## ES +20 um\n"
        "  ########\n"
        "  ########\n"
        "  ########\n"
        "---------- EI 0 um ----------------------------------------------- 25 mm\n"
        "\n"
        "\n"
        "                                  ######## es -10 um\n"
        "                                  ######## ei -20 um\n");
}

TEST_CASE("block characters show half lines") {
  const std::string drawing =
      draw(zone("hole", 0, 17'500), zone("shaft", -20'000, -12'500), kUnicode);
  CHECK(drawing.find("  ▄▄▄▄▄▄▄▄ ES +17.5 µm\n") != std::string::npos);
  CHECK(drawing.find(" ▄▄▄▄▄▄▄▄ es -12.5 µm\n") != std::string::npos);
  CHECK(drawing.find("──────────") != std::string::npos);
}

TEST_CASE("a zone about the zero line interrupts it") {
  const std::string drawing =
      draw(zone("hole", -10'000, 10'000), zone("shaft", -20'000, 0), kPlainTerminal);
  CHECK(drawing.find("\n--########------------------------") != std::string::npos);
  CHECK(drawing.find("--- es 0 um ") != std::string::npos);
}

TEST_CASE("a thin zone shows, with both of its deviations") {
  const std::string drawing =
      draw(zone("hole", 0, 100'000), zone("shaft", -50'001, -50'000), kPlainTerminal);
  CHECK(drawing.find("######## es -50, ei -50.001 um\n") != std::string::npos);
}

TEST_CASE("colour is a matter of the terminal") {
  ToleranceZone hole = zone("hole", 0, 20'000);
  hole.colour = Colour::Yellow;
  const ToleranceZone shaft = zone("shaft", -20'000, -10'000);
  CHECK(draw(hole, shaft, kPlainTerminal).find('\x1b') == std::string::npos);
  CHECK(draw(hole, shaft, {.colour = true}).find("\x1b[33m########\x1b[0m ES +20") !=
        std::string::npos);
}

TEST_CASE("both deviations of every zone are named once, whatever the sizes are") {
  const auto count = [](const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      ++found;
    }
    return found;
  };
  for (std::int64_t lower = -90'000; lower <= 90'000; lower += 7'500) {
    for (const std::int64_t tolerance : {500, 6'000, 60'000}) {
      for (const std::size_t rows : {1U, 5U, 14U}) {
        CAPTURE(lower);
        CAPTURE(tolerance);
        CAPTURE(rows);
        const std::string drawing = draw(zone("hole", lower, lower + tolerance),
                                         zone("shaft", -20'000, -7'000), kPlainTerminal, rows);
        for (const char* name : {"ES ", "EI ", "es ", "ei "}) CHECK(count(drawing, name) == 1);
        CHECK(static_cast<std::size_t>(std::count(drawing.begin(), drawing.end(), '\n')) <=
              rows + 4);
      }
    }
  }
}
