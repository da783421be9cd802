#include "record/record.hpp"

#include "base/length.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::api {
namespace {

using app::Measurement;

constexpr int kMmDecimals = 6;
constexpr int kUmDecimals = 3;
constexpr int kBillionths = 9;

/// The members of a record, by name; keeps the first error.
class Record {
 public:
  Record(const JsonValue& json, TextArena& texts) : json_(json), texts_(texts) {}

  std::optional<std::string_view> text(std::string_view name) {
    const JsonValue* value = json_.find(name);
    if (value == nullptr) return std::nullopt;
    return texts_.keep(value->text);
  }

  std::optional<std::int64_t> decimal(std::string_view name, int scale) {
    const JsonValue* value = json_.find(name);
    if (value == nullptr || value->is(JsonValue::Kind::Null)) return std::nullopt;
    return taken(name, parse_decimal(value->text, {.scale = scale, .exponent = true}));
  }

  /// 1 if it exists.
  std::optional<std::int64_t> truth(std::string_view name) {
    const JsonValue* value = json_.find(name);
    if (value == nullptr) return std::nullopt;
    if (!value->is(JsonValue::Kind::Boolean) || !value->boolean) wrong(name);
    return 1;
  }

  std::optional<Length> length(std::string_view name, int scale) {
    // So near that no sum of such lengths overflows.
    constexpr std::int64_t kFarthest = 1'000'000'000'000'000'000;
    const auto nanometres = decimal(name, scale);
    if (!nanometres) return std::nullopt;
    if (*nanometres < -kFarthest || *nanometres > kFarthest) wrong(name);
    return Length::nanometres(std::clamp(*nanometres, -kFarthest, kFarthest));
  }
  std::optional<Length> mm(std::string_view name) { return length(name, kMmDecimals); }
  std::optional<Length> um(std::string_view name) { return length(name, kUmDecimals); }

  template <class T>
  T required(std::string_view name, const std::optional<T>& value) {
    if (!value) wrong(name);
    return value.value_or(T());
  }

  template <class T>
  std::optional<T> taken(std::string_view name, const Result<T>& value) {
    if (value) return *value;
    wrong(name);
    return std::nullopt;
  }

  void wrong(std::string_view name) {
    if (!error_) {
      error_ = Error{ErrorCode::LogRecordInvalid,
                     fmt::format("a record of the batch cannot be read: its {}", name)};
    }
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  const JsonValue& json_;
  TextArena& texts_;
  std::optional<Error> error_;
};

/// `m17-5f0c9a3e77d21b40`: the letter, the number and the digits.
struct IdParts {
  std::int64_t number = 0;
  std::string_view digits{};
};

std::optional<IdParts> parts_of(char letter, std::string_view id) {
  const std::size_t dash = id.find('-', 2);
  if (id.size() < 2 || id.front() != letter || dash == id.npos) return std::nullopt;
  IdParts parts{.digits = id.substr(dash + 1)};
  const char* const end = id.data() + dash;
  const auto read = std::from_chars(id.data() + 1, end, parts.number);
  if (read.ptr != end || read.ec != std::errc() || parts.number < 1) return std::nullopt;
  return parts;
}

Timestamp time_of(Record& record, std::string_view name) {
  const auto text = record.required(name, record.text(name));
  return record.required(name, record.taken(name, parse_rfc3339(text)));
}

void read_ids(Record& record, Measurement& m) {
  const auto part = [&record](std::string_view name, char letter) -> std::optional<IdParts> {
    const auto text = record.text(name);
    if (!text) return std::nullopt;
    const auto parts = parts_of(letter, *text);
    if (!parts) record.wrong(name);
    return parts;
  };
  const IdParts id = record.required("id", part("id", 'm'));
  m.id = id.number;
  m.origin = id.digits;
  if (const auto run = part("run_id", 'r')) m.run_id = run->number;
  if (const auto corrected = part("correction_of", 'm')) {
    m.correction_of = corrected->number;
    m.corrected_elsewhere = app::Elsewhere{.digits = corrected->digits};
  }
}

void read_limits(Record& record, const JsonValue& json, Measurement& m) {
  if (const auto said = record.text("quantity")) {
    m.quantity = record.required("quantity", gauging::quantity_from_word(*said));
  }
  const std::string_view basis = record.text("basis").value_or("");
  if (basis == word(app::LimitsBasis::None)) {
    app::apply_no_limits(m, record.mm("nominal_mm"));
    m.feature = iso286::feature_from_word(record.text("feature").value_or("")).value_or(m.feature);
    return;
  }
  m.nominal_size = record.required("nominal_mm", record.mm("nominal_mm"));
  m.class_name = record.text("tolerance_class");
  const auto feature = iso286::feature_from_word(record.text("feature").value_or(""));
  if (m.has_feature()) m.feature = record.required("feature", feature);
  m.deviations = {.upper = record.um("upper_deviation_um").value_or(app::kNoLimit),
                  .lower = record.um("lower_deviation_um").value_or(-app::kNoLimit)};
  m.basis = record.required("basis", enum_of<app::LimitsBasis>(basis, app::kBasisWords));
  m.table_revision = record.text("table_revision").value_or("");
  if (const JsonValue* range = json.find("size_range_mm")) {
    TextArena unused;
    Record inner(*range, unused);
    m.size_range = iso286::NominalSizeRange{.over = inner.required("over", inner.mm("over")),
                                            .up_to = inner.required("up_to", inner.mm("up_to"))};
    if (inner.error()) record.wrong("size_range_mm");
  }
}

void read_rule(Record& record, Measurement& m) {
  m.standard_uncertainty = record.um("uncertainty_um");
  if (const auto k = record.decimal("coverage_factor", 6)) {
    m.coverage_factor =
        record.taken("coverage_factor", gauging::CoverageFactor::from_millionths(*k));
  }
  const auto kind = gauging::rule_from_word(record.text("rule").value_or(""));
  if (!m.is_judged()) return;
  const auto rule = make_rule(
      {.kind = record.required("rule", kind),
       .standard_uncertainty = m.standard_uncertainty,
       .coverage_millionths =
           m.coverage_factor ? std::optional(m.coverage_factor->millionths()) : std::nullopt,
       .probability_millionths = record.decimal("probability", 6),
       .degrees_of_freedom = m.degrees_of_freedom,
       .added_uncertainty = m.added_uncertainty});
  m.rule = record.required("rule", record.taken("rule", rule));
  if (m.rule.kind() == gauging::DecisionRule::Kind::Conformance) {
    m.conformance = gauging::ConformanceFigures{
        .probability = record.required("conformance_probability",
                                       record.decimal("conformance_probability", kBillionths)),
        .guard_band =
            record.required("guard_band_um", record.decimal("guard_band_um", kBillionths))};
  }
}

void read_plain(Record& record, Measurement& m) {
  for (const app::MeasurementField& field : app::kMeasurementFields) {
    if (field.text != nullptr) {
      m.*field.text = record.text(field.name);
    } else if (field.accepted.is_truth) {
      m.*field.number = record.truth(field.name);
    } else {
      m.*field.number = record.decimal(field.name, field.scale);
    }
  }
  m.form = record.decimal("form_um", kUmDecimals);
}

}  // namespace

Result<Measurement> read_record(const JsonValue& json, TextArena& texts) {
  Record record(json, texts);
  Measurement m;
  read_plain(record, m);
  read_ids(record, m);
  const auto source = app::source_from_word(record.text("source").value_or(""));
  m.source = record.required("source", source);
  m.measured_at = time_of(record, "measured_at");
  m.received_at = time_of(record, "received_at");
  read_limits(record, json, m);
  m.measured = record.required("measured_mm", record.mm("measured_mm"));
  m.corrected = record.mm("corrected_mm");
  read_rule(record, m);
  const auto verdict = gauging::verdict_from_word(record.text("verdict").value_or(""));
  if (m.is_judged() != verdict.has_value()) record.wrong("verdict");
  if (record.error()) return *record.error();
  m.result = gauging::gauge(m.feature, m.upper_limit(), m.lower_limit(), m.decisive());
  m.result.verdict = verdict.value_or(gauging::Verdict::Unjudged);
  return m;
}

}  // namespace fitgauge::api
