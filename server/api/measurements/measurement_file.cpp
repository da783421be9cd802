#include "api/measurements/measurement_file.hpp"

#include "formats/xlsx/workbook.hpp"
#include "record/record_members.hpp"

namespace fitgauge::api {
namespace {

/// Results that another writer makes a text of.
template <class Writer>
class WrittenFile final : public MeasurementFile {
 public:
  using Add = Result<void> (*)(Writer&, const app::Measurement&);
  WrittenFile(std::string_view name, Writer writer, Add add_one)
      : name_(name), writer_(std::move(writer)), add_one_(add_one) {}

  Result<void> add(const app::Measurement& measurement) override {
    const auto added = add_one_(writer_, measurement);
    if (added) return {};
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("a {} cannot contain {}: {}; exclude it by a filter, or use csv",
                             name_, app::measurement_id_text(measurement.id, measurement.origin),
                             added.error().message),
                 "format"};
  }

  Result<std::string> finish() override {
    if (!writer_.is_empty()) return writer_.text();
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("no measurement matches: a {} needs one or more", name_), "format"};
  }

 private:
  const std::string_view name_;
  Writer writer_;
  const Add add_one_;
};

/// Cells of one row of a sheet.
class SheetRow {
 public:
  SheetRow(workbook::Workbook& book, const std::optional<sheet::TimeZone>& zone)
      : book_(book), zone_(zone) {}

  void begin_cell() {
    if (is_empty_) book_.blank();
    is_empty_ = true;
  }

  void word(std::string_view text) { cell().text(text); }
  void name(std::string_view text) { cell().text(text); }
  void text(std::string_view text) { cell().text(text); }
  void time(Timestamp time) { cell().time(zone_ ? zone_->shown(time) : time); }
  void mm(Length length) { cell().mm(length); }
  void um(Length length) { cell().um(length); }
  void decimal(std::int64_t value, int scale) { cell().decimal(value, scale); }
  void billionths(std::int64_t value) { cell().decimal(value, 9); }
  void truth() { cell().text("true"); }
  void null() {}

 private:
  workbook::Workbook& cell() {
    is_empty_ = false;
    return book_;
  }

  workbook::Workbook& book_;
  bool is_empty_ = false;  ///< the cell that was begun
  const std::optional<sheet::TimeZone>& zone_;
};

class XlsxFile final : public MeasurementFile {
 public:
  XlsxFile(workbook::Workbook book, std::optional<sheet::TimeZone> zone)
      : book_(std::move(book)), zone_(std::move(zone)) {}

  Result<void> add(const app::Measurement& measurement) override {
    SheetRow row(book_, zone_);
    app::for_each_column([&](const auto& column, std::size_t /*index*/) {
      row.begin_cell();
      column.write(measurement, app::MemberValue{row});
    });
    book_.end_row();
    return {};
  }

  Result<std::string> finish() override { return book_.finish(); }

 private:
  workbook::Workbook book_;
  const std::optional<sheet::TimeZone> zone_;
};

/// Returns the decision rule of a record; empty if it uses only the limits.
std::string rule_of(const app::Measurement& m) {
  std::string rule;
  const auto say = [&rule](std::string_view name, std::string_view text) {
    if (!rule.empty()) rule += ';';
    rule += fmt::format("{}={}", name, text);
  };
  if (m.rule.kind() != gauging::DecisionRule::Kind::Simple) say("rule", word(m.rule.kind()));
  // u and ν belong to the size at 20 degrees, which is written.
  const gauging::KnownUncertainty known = known_uncertainty(m);
  if (m.standard_uncertainty) say("uncertainty_um", format_um(known.u));
  if (m.coverage_factor) say("coverage_factor", format(*m.coverage_factor));
  if (m.degrees_of_freedom) {
    constexpr double kMost = 1e6;  // of the field
    say("degrees_of_freedom",
        format_decimal(std::llround(std::min(known.degrees_of_freedom, kMost) * 1e6), 6));
  }
  if (m.size_operator && m.size_operator != "LP") say("size_operator", *m.size_operator);
  if (m.envelope) say("envelope", *m.envelope);
  if (m.go_gauge) say("go_gauge", *m.go_gauge);
  if (m.inside_corner) say("inside_corner", "true");
  if (m.conformance) say("probability", format(m.rule.probability()));
  return rule;
}

qif::Status status_of(gauging::Verdict verdict) {
  switch (verdict) {
    case gauging::Verdict::Good: return qif::Status::Pass;
    case gauging::Verdict::Rework: return qif::Status::Rework;
    case gauging::Verdict::Reject: return qif::Status::Fail;
    case gauging::Verdict::Unjudged: return qif::Status::Undefined;
    case gauging::Verdict::Indeterminate: break;
  }
  return qif::Status::Indeterminate;
}

/// Records that QIF cannot express.
std::vector<std::pair<std::string_view, std::string>> other_fields(const app::Measurement& m) {
  std::vector<std::pair<std::string_view, std::string>> fields;
  const auto add = [&](const app::MeasurementField& field) {
    if (field.text != nullptr) {
      if (m.*field.text) fields.emplace_back(field.name, *(m.*field.text));
    } else if (m.*field.number) {
      fields.emplace_back(field.name, app::number_text(field, *(m.*field.number)));
    }
  };
  for (const app::MeasurementField& field : app::kLabels) {
    if (field.name != "part_id" && field.name != "characteristic") add(field);
  }
  if (m.corrected) {  // the value and its uncertainty are those of the size at 20 degrees
    fields.emplace_back("measured_mm", format_mm(m.measured));
    if (m.standard_uncertainty)
      fields.emplace_back("uncertainty_um", format_um(*m.standard_uncertainty));
  }
  if (m.rule.kind() != gauging::DecisionRule::Kind::Simple)
    fields.emplace_back("rule", word(m.rule.kind()));
  if (m.coverage_factor) fields.emplace_back("coverage_factor", format(*m.coverage_factor));
  if (m.conformance) fields.emplace_back("probability", format(m.rule.probability()));
  for (const bool is_text : {false, true}) {
    for (const app::MeasurementField& field : app::kGivenFields.subspan(app::kLabels.size())) {
      const bool has_place = field.name == "size_operator" || field.name == "envelope";
      if ((field.text != nullptr) == is_text && !has_place) add(field);
    }
  }
  return fields;
}

/// Other standards have no classes of a table: their limits and quantity are in the file.
std::string_view table_class_of(const app::Measurement& m) {
  return m.basis == app::LimitsBasis::Standard ? "" : m.class_name.value_or("");
}

}  // namespace

std::unique_ptr<MeasurementFile> make_dfq_file(aqdef::DfqOptions options) {
  return std::make_unique<WrittenFile<aqdef::DfqWriter>>(
      "DFQ", aqdef::DfqWriter(std::move(options)), add_to_dfq);
}

std::unique_ptr<MeasurementFile> make_qif_file() {
  return std::make_unique<WrittenFile<qif::QifWriter>>("QIF", qif::QifWriter(), add_to_qif);
}

Result<std::unique_ptr<MeasurementFile>> make_xlsx_file(std::optional<sheet::TimeZone> zone) {
  std::vector<std::string> columns;
  app::for_each_column(
      [&](const auto& column, std::size_t /*index*/) { columns.emplace_back(column.name); });
  auto book = TRY(workbook::Workbook::make("measurements", columns));
  return std::unique_ptr<MeasurementFile>(
      std::make_unique<XlsxFile>(std::move(book), std::move(zone)));
}

Result<void> add_to_dfq(aqdef::DfqWriter& writer, const app::Measurement& m) {
  if (m.source != app::Source::Gauge)
    return Error{ErrorCode::FieldInvalid, "it is simulated, which a DFQ cannot express"};
  const std::string rule = rule_of(m);
  aqdef::OutgoingValue value{.origin = m.origin, .number = m.id, .measured_at = m.measured_at};
  value.measured = m.decisive();
  if (m.has_nominal) value.nominal = m.nominal_size;
  if (m.has_upper_limit()) value.limits.upper = m.upper_limit();
  if (m.has_lower_limit()) value.limits.lower = m.lower_limit();
  value.class_name = table_class_of(m);
  if (m.has_feature()) value.feature = word(m.feature);
  if (m.quantity && (m.quantity != gauging::Quantity::Diameter || !m.is_judged()))
    value.quantity = word(*m.quantity);
  value.rule = rule;
  value.part_id = m.part_id.value_or("");
  value.characteristic = m.characteristic.value_or("");
  value.order = m.order.value_or("");
  value.operation = m.operation.value_or("");
  value.machine = m.machine.value_or("");
  value.operator_name = m.operator_id.value_or("");
  value.gauge = m.gauge.value_or("");
  value.unit = m.unit.value_or("");
  value.comment = m.comment.value_or("");
  value.subgroup = m.subgroup.value_or("");
  return writer.add(value);
}

Result<void> add_to_qif(qif::QifWriter& writer, const app::Measurement& m) {
  if (m.source != app::Source::Gauge)
    return Error{ErrorCode::FieldInvalid, "it is simulated, not the result of an inspection"};
  qif::OutgoingValue value{.origin = m.origin, .number = m.id, .measured_at = m.measured_at};
  value.measured = m.decisive();
  if (m.has_nominal) value.nominal = m.nominal_size;
  if (m.has_upper_limit()) value.upper = m.upper_limit();
  if (m.has_lower_limit()) value.lower = m.lower_limit();
  value.class_name = table_class_of(m);
  value.is_iso286 = m.basis == app::LimitsBasis::Iso286;
  value.quantity = m.quantity.value_or(gauging::Quantity::Diameter);
  if (m.has_feature()) value.feature = word(m.feature);
  value.size_operator = m.size_operator.value_or("");
  value.has_envelope = m.envelope.has_value();
  value.status = status_of(m.result.verdict);
  if (m.standard_uncertainty) value.uncertainty = known_uncertainty(m).u;
  value.part_id = m.part_id;
  value.characteristic = m.characteristic;
  value.fields = other_fields(m);
  return writer.add(value);
}

}  // namespace fitgauge::api
