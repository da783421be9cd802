// Program 82551 of the examples for each class it is made for, at each size range to 400 mm: the
// limits it reads are those of the tolerance tables, and the status is right for a part in the
// middle, on both limits, and 0.1 um outside of each.

#include <doctest/doctest.h>

#include <fstream>

#include "service/runs/active_run.hpp"
#include "service/runs/control_files.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::app {
namespace {

using gauging::Verdict;

constexpr std::array kClasses = {
    "D10",  "E9",   "F7",  "F8", "G7", "G9", "H6", "H7", "H8", "H9",  "H11", "H12",
    "H13",  "JS7",  "JS9", "K6", "K7", "M6", "M7", "N7", "N9", "P7",  "P9",  "R7",
    "d9",   "e8",   "f7",  "g6", "h5", "h6", "h7", "h8", "h9", "h11", "js5", "js6",
    "js13", "js14", "k5",  "k6", "m5", "m6", "n6", "p6", "r6", "s6",  "s7"};
static_assert(kClasses.size() == 47);
constexpr std::size_t kRangesTo400 = 23;
constexpr Length kStep = Length::nanometres(100);

const iso286::ToleranceTables& tables() {
  static const auto kTables =
      iso286::ToleranceTables::make(iso286::compiled_in_tables(), {"iso"}).value();
  return kTables;
}

/// The example programs on a disk in memory, with the live tables beside them.
class Examples {
 public:
  Examples() {
    for (const char* name : {"82551.h", "82552.a"}) {
      std::ifstream file(std::string(FITGAUGE_SOURCE_DIR "/clients/nc/8255/") + name,
                         std::ios::binary);
      disk_.write(std::string("TNC:\\nc_prog\\8255\\") + name,
                  {std::istreambuf_iterator<char>(file), {}});
    }
  }

  /// Gauges a bore or stud of that diameter.
  interpreter::RunResult gauge(const iso286::LimitsOfSize& limits, Length diameter) {
    const bool is_hole = limits.feature == iso286::Feature::Hole;
    RunOrder order{
        .program = interpreter::ControlPath::parse("TNC:\\nc_prog\\8255\\82551.h").value(),
        .setup = {},
        .options = {},
        .request = {}};
    // A ball that enters the smallest bore.
    order.setup.machine.tools[0].row.r = 0.4;
    order.setup.features = {machine::Block{{-300, -300, -60}, {300, 300, 0}}};
    if (is_hole) {
      order.setup.features.emplace_back(machine::Bore{{}, 0, 40, diameter.to_mm()});
    } else {
      order.setup.features.emplace_back(machine::Boss{{}, 30, 30, diameter.to_mm()});
    }
    const auto set = [&order](std::string_view name, auto value) {
      auto& parameter = order.options.parameters.emplace_back();
      parameter.parameter = interpreter::parse_parameter_name(name).value();
      parameter.value = std::move(value);
    };
    set("Q1", limits.nominal_size.length().to_mm());
    set("QS1", std::string(tables().class_name(limits.class_id)));
    set("Q31", is_hole ? -10.0 : 15.0);
    for (const char* zero : {"Q11", "Q21", "Q41", "Q51"}) set(zero, 0.0);
    ActiveRun run(1, "5f0c9a3e77d21b40", std::make_shared<const RunOrder>(std::move(order)), {});
    return execute({projected_, programs_, clock_, trace_}, run).result;
  }

 private:
  interpreter::MemoryDisk disk_;
  interpreter::ProjectingDisk projected_{disk_, project(tables())};
  interpreter::ProgramCache programs_;
  SystemClock clock_;
  const TraceFormat trace_{
      .move = [](std::string&, const machine::TracedMove&, const TracePlace&,
                 std::span<const machine::Axis>) {},
      .block = {},
      .tail = [](std::size_t, const std::optional<WatchedBlocks>&) { return std::string(); }};
};

std::optional<Length> length_of(const interpreter::RunResult& result, std::string_view name) {
  const klartext::QRef sought = interpreter::parse_parameter_name(name).value();
  for (const auto& [parameter, value] : result.parameters) {
    if (parameter == sought) return Length::nearest_mm(std::get<double>(value)).value();
  }
  return std::nullopt;
}

struct Part {
  Length diameter;
  Verdict verdict;
};

/// The five parts of the check, in the order middle, limits, outside.
std::array<Part, 5> parts_of(const iso286::LimitsOfSize& limits) {
  const bool is_hole = limits.feature == iso286::Feature::Hole;
  const Length upper = limits.upper_limit();
  const Length lower = limits.lower_limit();
  return {{{Length::nanometres((upper.count() + lower.count()) / 2), Verdict::Good},
           {upper, Verdict::Good},
           {lower, Verdict::Good},
           {upper + kStep, is_hole ? Verdict::Reject : Verdict::Rework},
           {lower - kStep, is_hole ? Verdict::Rework : Verdict::Reject}}};
}

TEST_CASE("limits and status of the 47 classes of 8255 at each size range to 400 mm") {
  // Each part of each size range; under the sanitizers one of the five, in turn.
  const bool is_full = std::getenv("FITGAUGE_ALL_PARTS") != nullptr;
  Examples examples;
  std::size_t turn = 0;
  std::size_t gauged = 0;
  for (const char* name : kClasses) {
    for (const iso286::NominalSizeRange& range : tables().ranges().first(kRangesTo400)) {
      const auto size = iso286::NominalSize::make(range.up_to).value();
      const auto limits = tables().limits_of_size(size, name);
      REQUIRE(limits.has_value());
      const auto parts = parts_of(*limits);
      ++turn;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!is_full && turn % parts.size() != i) continue;
        const auto result = examples.gauge(*limits, parts[i].diameter);
        ++gauged;
        CAPTURE(name);
        CAPTURE(format_mm(range.up_to));
        CAPTURE(i);
        REQUIRE(result.status == interpreter::RunStatus::Completed);
        CHECK(length_of(result, "Q23") == limits->upper_limit());
        CHECK(length_of(result, "Q33") == limits->lower_limit());
        CHECK(length_of(result, "Q153") == parts[i].diameter);
        CHECK(result.verdict == parts[i].verdict);
      }
    }
  }
  CHECK(gauged == kClasses.size() * kRangesTo400 * std::size_t{is_full ? 5U : 1U});
}

}  // namespace
}  // namespace fitgauge::app
