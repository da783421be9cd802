#include "api/measurements/measurement_listing.hpp"

#include "api/wire/formulas.hpp"
#include "base/csv.hpp"
#include "record/record_members.hpp"

namespace fitgauge::api {
namespace {

/// Cells of one line of CSV.
class CsvLine {
 public:
  explicit CsvLine(std::string& out) : out_(out) {}

  void begin_cell() {
    if (!std::exchange(is_first_, false)) out_ += ',';
  }

  void word(std::string_view text) { sheet::append_csv_cell(out_, text); }
  void name(std::string_view text) { sheet::append_csv_cell(out_, text); }
  void text(std::string_view text) { sheet::append_csv_text(out_, text); }
  void time(Timestamp time) { out_ += format_rfc3339(time); }
  void mm(Length length) { append_mm(out_, length); }
  void um(Length length) { append_um(out_, length); }
  void decimal(std::int64_t value, int scale) { append_decimal(out_, value, scale); }
  void billionths(std::int64_t value) { append_decimal(out_, value, 9); }
  void truth() { out_ += "true"; }
  void null() {}

 private:
  std::string& out_;
  bool is_first_ = true;
};

}  // namespace

std::string measurement_csv_header() {
  std::string out;
  app::for_each_column([&out](const auto& column, std::size_t /*index*/) {
    if (!out.empty()) out += ',';
    out += column.name;
  });
  return out += "\r\n";
}

void append_measurement_csv(std::string& out, const app::Measurement& measurement) {
  CsvLine line(out);
  app::for_each_column([&](const auto& column, std::size_t /*index*/) {
    line.begin_cell();
    column.write(measurement, app::MemberValue{line});
  });
  out += "\r\n";
}

void write_verdict_counts(JsonWriter& json, const app::VerdictTally& verdicts) {
  json.key("verdicts").begin_object();
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const auto verdict = static_cast<gauging::Verdict>(i);
    if (verdict == gauging::Verdict::Unjudged && verdicts[i] == 0) continue;
    json.member(word(verdict), verdicts[i]);
  }
  json.end_object();
}

std::string summary_json(std::string_view group_by, std::span<const app::MeasurementGroup> groups) {
  return json_object([&](JsonWriter& json) {
    write_formula(json, "stored_summary");
    json.list("groups", groups, [&](const app::MeasurementGroup& group) {
      json.begin_object().member(group_by, group.value).member("count", group.count);
      write_verdict_counts(json, group.verdicts);
      json.key("mean_mm").raw(group.mean_mm);
      json.key("standard_deviation_mm").raw(group.standard_deviation_mm.value_or("null"));
      json.member_mm("min_mm", Length::nanometres(group.min_nm));
      json.member_mm("max_mm", Length::nanometres(group.max_nm)).end_object();
    });
  });
}

}  // namespace fitgauge::api
