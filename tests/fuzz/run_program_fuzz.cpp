// Any first line as a setup (JSON), the rest as a program that is run on it with tight limits: the
// run ends, and all that it answers is JSON.

#include <cstdio>

#include "api/runs/run_codec.hpp"
#include "api/runs/setup_codec.hpp"
#include "base/json/field_reader.hpp"
#include "base/json/json_value.hpp"
#include "service/runs/active_run.hpp"
#include "service/runs/stored_run.hpp"
#include "target.hpp"

using namespace fitgauge;

namespace {

constexpr std::chrono::milliseconds kTime{200};
constexpr std::size_t kMemory = std::size_t{16} << 20;

machine::Setup setup_of(std::string_view json) {
  const auto body = parse_json(json);
  if (!body) return {};
  api::FieldErrors errors;
  machine::Setup setup = api::decode_setup(*body, "", {}, errors);
  return errors.take() ? machine::Setup{} : setup;
}

void expect(bool holds, const char* what, const std::string& text) {
  if (holds) return;
  std::fprintf(stderr, "%s: %.2000s\n", what, text.c_str());
  std::abort();
}

}  // namespace

void take(std::string_view bytes) {
  std::string text(bytes);
  const std::size_t line = std::min(text.find('\n'), text.size());
  const machine::Setup setup = setup_of(std::string_view(text).substr(0, line));
  text.erase(0, line + 1);

  const auto path = interpreter::ControlPath::parse("TNC:\\fuzz.h").value();
  interpreter::MemoryDisk disk;
  disk.write(path, text);
  disk.write("TNC:\\mask.a", "\"%F\", Q1;\n\"%S\", QS1;\n\"\";\nL_ENGLISH;\n\"%d %c\", Q2, Q3;\n");
  disk.write("TNC:\\empty.a", "\"\";\nM_CLOSE;\n");
  disk.write("TNC:\\points.tab",
             "BEGIN points .TAB MM\nNR   X      Y      Z\n0    1      2\n[END]\n");
  disk.write("TNC:\\sub.h", "BEGIN PGM SUB MM\nQ2 = Q1 + 1\nEND PGM SUB MM\n");
  interpreter::ProgramCache programs;
  const SystemClock clock;

  app::RunOrder order{.program = path, .setup = setup, .options = {}, .request = {}};
  order.options.limits.blocks = 20'000;
  order.options.limits.time = kTime;
  order.options.limits.memory_bytes = kMemory;
  order.options.limits.output_bytes = std::size_t{1} << 20;
  app::ActiveRun active(1, "0123456789abcdef",
                        std::make_shared<const app::RunOrder>(std::move(order)), clock.now());
  const app::RunFormat format = api::run_format();
  const auto begun = std::chrono::steady_clock::now();
  app::ExecutedRun executed = app::execute({disk, programs, clock, format.trace}, active);
  // Sanitizers make everything some twenty times as slow; an unbounded loop takes longer still.
  expect(std::chrono::steady_clock::now() - begun < std::chrono::seconds(20), "took too long",
         text);

  app::TraceReader packed(std::move(executed.trace));
  std::string trace;
  for (std::string piece; !(piece = packed.next().value()).empty();) trace += piece;
  expect(parse_json(trace).has_value(), "the trace is no JSON", trace);
  expect(api::TraceCsv().rows(trace).has_value(), "the trace gives no CSV", trace);
  const app::RunReport report{
      .id = 1, .program = path.text(), .result = std::move(executed.result), .seed = 1};
  const std::string answer = format.report(report);
  expect(parse_json(answer).has_value(), "the report is no JSON", answer);
  expect(parse_json(format.event(report)).has_value(), "the event is no JSON", answer);
}
