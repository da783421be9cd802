#include "golden_case.hpp"

#include "nc/machine/simulated_machine.hpp"
#include "nc/program/program_cache.hpp"
#include "tables/tabfile/iso286_projection.hpp"
#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::interpreter::golden {

namespace fs = std::filesystem;

namespace {

class GoldenClock final : public Clock {
 public:
  Timestamp now() const override { return parse_rfc3339("2026-11-20T08:05:09Z").value(); }
};

std::string number_text(double value) {
  // Rounded to a nanometre: what differs beyond is rounding of the arithmetic.
  std::string text = fmt::format("{:.6f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string describe(const std::optional<probing::Form>& form) {
  if (!form) return {};
  std::string out = form->assessable ? "form assessable" : "form not assessable";
  if (form->residual_mm) out += fmt::format(", residual {}", number_text(*form->residual_mm));
  return fmt::format("{}: {}\n", out, form->reason);
}

std::string describe(const Ran& ran, bool trace) {
  const RunResult& result = ran.result;
  std::string out = fmt::format("status {}\n", word(result.status));
  for (const RunMessage& message : result.messages) {
    out += fmt::format("message {} {} line {}: {}\n", word(message.kind), message.number,
                       message.line, message.text);
  }
  for (const std::string& line : result.screen) out += fmt::format("screen {}\n", line);
  for (const auto& [parameter, value] : result.parameters) {
    const auto* number = std::get_if<double>(&value);
    out += fmt::format("{} = {}\n", name(parameter),
                       number != nullptr ? number_text(*number) : std::get<std::string>(value));
  }
  for (const Measurement& measurement : result.measurements) {
    out += fmt::format("measured cycle {} line {}\n", measurement.record.cycle, measurement.line);
    out += describe(measurement.record.form);
  }
  if (result.verdict) out += fmt::format("verdict {}\n", gauging::word(*result.verdict));
  for (const WrittenFile& file : result.files) {
    out += fmt::format("file {}\n{}", file.path.text(), file.bytes);
  }
  if (trace) {
    for (const std::string& line : ran.commands) out += fmt::format("trace {}\n", line);
  }
  return out;
}

ProjectingDisk::Projection projection(const iso286::ToleranceTables& tables,
                                      iso286::Feature feature, std::string name) {
  const auto table = std::make_shared<const tabfile::TabTable>(tabfile::project(tables, feature));
  return {std::move(name), std::make_shared<const std::string>(tabfile::write_tab(*table)), "iso",
          table};
}

}  // namespace

Case::Case(const fs::path& folder)
    : Case(folder, fs::exists(folder / "setup.txt") ? content_of(folder / "setup.txt") : "") {}

Case::Case(const fs::path& folder, const std::string& setup) : setup_(read_setup(setup)) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name != "setup.txt" && name != "expected.txt")
      add(name, content_of(entry.path()));
  }
}

ProjectingDisk Case::disk() const {
  std::vector<ProjectingDisk::Projection> projections;
  if (setup_.live_tables) {
    static const auto kTables =
        iso286::ToleranceTables::make(iso286::compiled_in_tables(), {}).value();
    projections.push_back(projection(kTables, iso286::Feature::Hole, "82553_hole.tab"));
    projections.push_back(projection(kTables, iso286::Feature::Shaft, "82553_shaft.tab"));
  }
  return ProjectingDisk(disk_, std::move(projections));
}

std::vector<klartext::Diagnostic> Case::diagnostics(const std::string& name) {
  Allowance unlimited;
  return check(path(name), disk(), programs_, unlimited).value();
}

std::optional<Ran> Case::execute(const std::string& name, RunObserver& observer) {
  const ProjectingDisk disk = this->disk();
  const auto file = programs_.get(*disk.find(path(name)));
  if (file->program == nullptr) return std::nullopt;
  std::vector<machine::Vec3> touched;
  const auto keep = [&](const machine::TracedMove& move) {
    if (move.contact) touched.push_back(move.contact->machine_surface);
  };
  machine::TracingMachine tracing(setup_.machine, {.keep = keep, .longest = 10'000, .lines = true});
  tracing_ = &tracing;
  const GoldenClock clock;
  RunResult result =
      interpreter::run(file->program, {tracing, disk, programs_, clock, observer}, setup_.options);
  tracing_ = nullptr;
  const RunMessage last = result.messages.empty() ? RunMessage{} : result.messages.back();
  outcome_ = fmt::format("{} line {}: {}", word(result.status), last.line, last.text);
  return Ran{std::move(result), tracing.lines(), std::move(touched)};
}

std::string Case::run(const std::string& name) {
  RunObserver observer;
  const auto ran = execute(name, observer);
  if (ran) return describe(*ran, setup_.trace);
  return "refused: " +
         klartext::render(programs_.get(*disk_.find(path(name)))->diagnostics.front());
}

}  // namespace fitgauge::interpreter::golden
