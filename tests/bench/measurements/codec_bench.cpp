// 10,000 measurements from the bytes of a request to the bytes of its answer without storing them:
// parsed, judged, serialised. Against nlohmann's DOM both ways with the same limits and verdicts,
// interleaved in one run, both by the processor time of the thread, so that other load falls out.
// Quote the ratio; the times depend on the machine.

#include <benchmark/benchmark.h>
#include <time.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "api/measurements/measurements.hpp"
#include "http/request.hpp"
#include "record/measurement_batch.hpp"
#include "record/record.hpp"
#include "tables/iso286/tolerance_class.hpp"

using namespace fitgauge;
using nlohmann::json;

namespace {

constexpr std::size_t kRows = 10'000;
constexpr Timestamp kReceived{1'795'000'000'000'000'000};

const iso286::ToleranceTables& tables() {
  static const auto kTables =
      iso286::ToleranceTables::make(iso286::compiled_in_tables(), {}).value();
  return kTables;
}

/// Rows as a gauge at a machine sends them, with the padding a request's body has.
const std::string& request_body() {
  static const std::string kBody = [] {
    std::string body = "[";
    for (std::size_t i = 0; i < kRows; ++i) {
      body += fmt::format(
          R"({}{{"nominal_mm":25,"tolerance_class":"H7","measured_mm":25.{:06},"part_id":"SN-{:07}",)"
          R"("characteristic":"bore-A","order":"WO-17","operation":"OP20","machine":"M3",)"
          R"("operator":"42","gauge":"G-07","measured_at":"2026-11-20T08:00:00+01:00"}})",
          i == 0 ? "" : ",", i % 30'000, i);
    }
    body += ']';
    body.reserve(body.size() + http::Request::kBodyPadding);
    return body;
  }();
  return kBody;
}

std::string ours() {
  api::MeasurementBatch batch;
  const auto decoded = api::decode_measurements(
      request_body(), "application/json", {.tables = tables(), .received_at = kReceived}, batch);
  decoded.value();
  api::MeasurementAnswer answer(api::Preference::Representation);
  answer.expect(request_body().size());
  std::string records;
  app::RecordWriter writer(records);
  for (const app::Measurement& m : batch.rows) {
    if (!records.empty()) records += ',';
    writer.append(m);
  }
  answer.add(batch.rows, records);
  return answer.finish().body;
}

/// One record by the DOM: every field looked up by name, every field written by name.
json record(const json& row) {
  app::Measurement m;
  const auto size =
      iso286::NominalSize::make(Length::nearest_mm(row.at("nominal_mm").get<double>()).value())
          .value();
  const auto& name = row.at("tolerance_class").get_ref<const std::string&>();
  app::apply_limits(m, tables().limits_of_size(size, name).value(), tables());
  m.measured = Length::nearest_mm(row.at("measured_mm").get<double>()).value();
  app::judge(m);
  json out = {
      {"id", app::measurement_id_text(0, "5f0c9a3e77d21b40")},
      {"source", "gauge"},
      {"measured_at",
       format_rfc3339(parse_rfc3339(row.at("measured_at").get_ref<const std::string&>()).value())},
      {"received_at", format_rfc3339(kReceived)},
      {"designation", format_mm(m.nominal_size) + " " + std::string(*m.class_name)},
      {"nominal_mm", m.nominal_size.to_mm()},
      {"tolerance_class", *m.class_name},
      {"feature", word(m.feature)},
      {"upper_deviation_um", m.deviations.upper.to_mm() * 1000},
      {"lower_deviation_um", m.deviations.lower.to_mm() * 1000},
      {"upper_limit_mm", m.upper_limit().to_mm()},
      {"lower_limit_mm", m.lower_limit().to_mm()},
      {"tolerance_um", (m.deviations.upper - m.deviations.lower).to_mm() * 1000},
      {"size_range_mm",
       {{"over", m.size_range->over.to_mm()}, {"up_to", m.size_range->up_to.to_mm()}}},
      {"basis", word(m.basis)},
      {"table_revision", m.table_revision},
      {"measured_mm", m.measured.to_mm()},
      {"deviation_um", (m.measured - m.nominal_size).to_mm() * 1000},
      {"verdict", word(m.result.verdict)},
      {"excess_um", m.result.excess.to_mm() * 1000}};
  for (const app::MeasurementField& field : app::kLabels) {
    const auto given = row.find(field.name);
    if (given != row.end()) out[std::string(field.name)] = *given;
  }
  return out;
}

std::string by_dom() {
  const json rows = json::parse(request_body());
  json records = json::array();
  for (const json& row : rows) records.push_back(record(row));
  return json{{"measurements", std::move(records)}}.dump();
}

/// Seconds of the processor that this thread has used.
double thread_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// Both ways take turns, so that both see the same machine.
void codec(benchmark::State& state) {
  double our_time = 0;
  double dom_time = 0;
  for ([[maybe_unused]] auto _ : state) {
    const double start = thread_time();
    benchmark::DoNotOptimize(ours());
    const double middle = thread_time();
    benchmark::DoNotOptimize(by_dom());
    our_time += middle - start;
    dom_time += thread_time() - middle;
  }
  const double rows = static_cast<double>(state.iterations()) * static_cast<double>(kRows);
  state.counters["ns_per_row"] = our_time / rows * 1e9;
  state.counters["dom_ns_per_row"] = dom_time / rows * 1e9;
  state.counters["times_as_fast_as_dom"] = dom_time / our_time;
}
BENCHMARK(codec)->Unit(benchmark::kMillisecond);

/// The peers agree before they are compared.
void check_agreement() {
  const json ours_read = json::parse(ours());
  const json dom_read = json::parse(by_dom());
  for (std::size_t i = 0; i < kRows; ++i) {
    for (const char* field : {"verdict", "upper_limit_mm", "part_id", "designation"}) {
      if (ours_read["measurements"][i][field] == dom_read["measurements"][i][field]) continue;
      std::fprintf(stderr, "row %zu differs in %s\n", i, field);
      std::exit(1);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  check_agreement();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
