#include "formats/qif/qif.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::qif {
namespace {

using Texts = std::vector<std::pair<std::string_view, std::string>>;

/// `<Attributes>` of texts by their names; empty without texts.
std::string attributes(const Texts& texts) {
  if (texts.empty()) return {};
  std::string out = fmt::format("<Attributes n=\"{}\">", texts.size());
  for (const auto& [name, text] : texts)
    out += fmt::format("<AttributeStr name=\"{}\" value=\"{}\"/>", name, xml_text(text));
  return out += "</Attributes>";
}

/// A verdict in the words of QIF.
struct Status {
  gauging::Verdict verdict;
  std::string_view word;        ///< of CharacteristicStatusEnum
  std::string_view inspection;  ///< of a part, or of all results: none for an open verdict
};
constexpr Status kStatuses[] = {{gauging::Verdict::Good, "PASS", "PASS"},
                                {gauging::Verdict::Unjudged, "UNDEFINED", "UNKNOWN"},
                                {gauging::Verdict::Rework, "REWORK", "REWORK"},
                                {gauging::Verdict::Indeterminate, "INDETERMINATE", "UNKNOWN"},
                                {gauging::Verdict::Reject, "FAIL", "FAIL"}};

std::string tolerance(const app::Measurement& m) {
  const bool upper = m.has_upper_limit();
  const bool lower = m.has_lower_limit();
  if (!upper && !lower) return "<NonTolerance>MEASURED</NonTolerance>";
  std::string out = "<Tolerance>";
  if (upper) out += fmt::format("<MaxValue>{}</MaxValue>", format_mm(m.upper_limit()));
  if (lower) out += fmt::format("<MinValue>{}</MinValue>", format_mm(m.lower_limit()));
  return out += "<DefinedAsLimit>true</DefinedAsLimit></Tolerance>";
}

/// The QIF name of a characteristic of that quantity: of a chamfer its length, of a deviation a
/// coordinate along the surface's normal. ThreadCharacteristic has no value of the pitch diameter.
std::string_view characteristic_of(gauging::Quantity quantity) {
  switch (quantity) {
    case gauging::Quantity::Width: return "Width";
    case gauging::Quantity::Radius: return "Radius";
    case gauging::Quantity::Position:
    case gauging::Quantity::Deviation: return "LinearCoordinate";
    case gauging::Quantity::Distance:
    case gauging::Quantity::Chamfer: return "Length";
    case gauging::Quantity::Diameter:
    case gauging::Quantity::PitchDiameter: break;
  }
  return "Diameter";
}

/// DimensionDeterminationEnumType: the operators of ISO 14405-1 that QIF knows.
constexpr std::string_view kDeterminations[] = {"LP", "LS", "GG", "GX", "GN",
                                                "GC", "CC", "CA", "CV"};

Result<void> check(std::string_view name, std::string_view text) {
  if (is_xml_text(text)) return {};
  return Error{ErrorCode::FieldInvalid,
               fmt::format("{} has a control character, which XML cannot hold", name)};
}

/// Fields of a record without a place in QIF.
Texts other_fields(const app::Measurement& m) {
  Texts fields;
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

gauging::Quantity quantity_of(const app::Measurement& m) {
  return m.quantity.value_or(gauging::Quantity::Diameter);
}

}  // namespace

std::uint32_t QifWriter::item_of(const app::Measurement& m) {
  const gauging::Quantity quantity = quantity_of(m);
  const std::string_view size_operator = m.size_operator.value_or("");
  Texts of_definition;
  if (m.has_feature()) of_definition.emplace_back("feature", word(m.feature));
  if (quantity != gauging::Quantity::Diameter)
    of_definition.emplace_back("quantity", word(quantity));
  if (!m.table_class().empty()) of_definition.emplace_back("tolerance_class", m.table_class());
  std::string modifiers = m.envelope ? "<EnvelopeRequirement>true</EnvelopeRequirement>" : "";
  if (std::ranges::find(kDeterminations, size_operator) != std::end(kDeterminations)) {
    modifiers += fmt::format(
        "<DimensionModifiers><DeterminationModifier>{}</DeterminationModifier></"
        "DimensionModifiers>",
        size_operator);
  } else if (!size_operator.empty()) {
    of_definition.emplace_back("size_operator", size_operator);
  }
  const std::string definition = attributes(of_definition) + modifiers + tolerance(m);
  const std::string_view kind = characteristic_of(quantity);
  const std::string nominal =
      m.has_nominal() ? fmt::format("<TargetValue>{}</TargetValue>", format_mm(m.nominal_size)) : "";
  const std::string name(m.characteristic.value_or(""));
  const auto [known, is_new] =
      items_.try_emplace(fmt::format("{}\n{}\n{}\n{}", kind, definition, nominal, name), 0);
  if (!is_new) return known->second;
  const std::uint32_t first = last_id_ + 1;
  last_id_ += 3;
  known->second = last_id_;
  definitions_ +=
      fmt::format("<{0}CharacteristicDefinition id=\"{1}\">{2}</{0}CharacteristicDefinition>\n",
                  kind, first, definition);
  nominals_ += fmt::format(
      "<{0}CharacteristicNominal id=\"{1}\"><CharacteristicDefinitionId>{2}"
      "</CharacteristicDefinitionId>{3}</{0}CharacteristicNominal>\n",
      kind, first + 1, first, nominal);
  const std::string plain = sheet::squeezed(name);
  Texts of_item;
  if (plain != name) of_item.emplace_back("characteristic", name);
  item_texts_ += fmt::format(
      "<{0}CharacteristicItem id=\"{1}\">{2}{3}<CharacteristicNominalId>{4}"
      "</CharacteristicNominalId></{0}CharacteristicItem>\n",
      kind, last_id_, attributes(of_item),
      plain.empty() ? "" : fmt::format("<Name>{}</Name>", xml_text(plain)), first + 1);
  return last_id_;
}

Result<void> QifWriter::add(const app::Measurement& m) {
  if (m.source != app::Source::Gauge)
    return Error{ErrorCode::FieldInvalid, "it is simulated, not the result of an inspection"};
  Texts fields = other_fields(m);
  fields.emplace(fields.begin(), "id", fmt::format("m{}-{}", m.id, m.origin));
  for (const auto& [name, text] : fields) TRY(check(name, text));
  for (const auto& [name, text] : {std::pair("part_id", m.part_id.value_or("")),
                                   std::pair("characteristic", m.characteristic.value_or("")),
                                   std::pair("tolerance_class", m.table_class()),
                                   std::pair("size_operator", m.size_operator.value_or(""))}) {
    TRY(check(name, text));
  }
  if (is_empty()) qpid_ = aqdef::guid_of(m.origin, m.id);
  const auto status = static_cast<std::size_t>(
      std::ranges::find(kStatuses, m.result.verdict, &Status::verdict) - kStatuses);
  const std::uint32_t item = item_of(m);
  std::string part;
  if (m.part_id) {
    auto& known = parts_[std::string(*m.part_id)];
    if (known.id == 0) known.id = ++last_id_;
    known.worst = std::max(known.worst, status);
    part = fmt::format("<ActualComponentId>{}</ActualComponentId>", known.id);
  }
  const std::string uncertainty =
      m.standard_uncertainty
          ? fmt::format(" combinedUncertainty=\"{}\"", format_mm(api::known_uncertainty(m).u))
          : std::string();
  measurement_texts_ += fmt::format(
      "<{0}CharacteristicMeasurement id=\"{1}\">{2}<Status><CharacteristicStatusEnum>{3}"
      "</CharacteristicStatusEnum></Status><CharacteristicItemId>{4}</CharacteristicItemId>"
      "<TimeStamp>{5}</TimeStamp>{6}<Value{7}>{8}</Value></{0}CharacteristicMeasurement>\n",
      characteristic_of(quantity_of(m)), ++last_id_, attributes(fields), kStatuses[status].word,
      item, format_rfc3339(m.measured_at), part, uncertainty, format_mm(m.decisive()));
  worst_ = std::max(worst_, status);
  is_iso286_ = is_iso286_ && m.basis == app::LimitsBasis::Iso286;
  ++measurements_;
  return {};
}

std::string QifWriter::element() const {
  std::string out;  // nearly all of its size at once: growth would hold it twice
  out.reserve(definitions_.size() + nominals_.size() + item_texts_.size() +
              measurement_texts_.size() + (parts_.size() + 16) * 256);
  out += fmt::format(
      "<QIFDocument xmlns=\"http://qifstandards.org/xsd/qif3\" versionQIF=\"3.0.0\" idMax=\"{}\">\n"
      "<QPId>{}</QPId>\n",
      last_id_ + 1, qpid_);
  // ISO 8015 holds for every specification of ISO.
  out += fmt::format(
      "<StandardsDefinitions n=\"1\"><Standard "
      "id=\"1\"><Organization><StandardsOrganizationEnum>ISO"
      "</StandardsOrganizationEnum></Organization><Designator>{}</Designator></Standard>"
      "</StandardsDefinitions>\n",
      is_iso286_ ? "286-1" : "8015");
  out +=
      "<FileUnits><PrimaryUnits><LinearUnit><SIUnitName>meter</SIUnitName><UnitName>mm</UnitName>"
      "<UnitConversion><Factor>0.001</Factor></UnitConversion></LinearUnit></PrimaryUnits>"
      "</FileUnits>\n<Characteristics><FormalStandardId>1</FormalStandardId>\n";
  const auto list = [&out](std::string_view name, std::size_t count, std::string_view texts) {
    fmt::format_to(std::back_inserter(out), "<{} n=\"{}\">\n", name, count);
    out.append(texts);
    fmt::format_to(std::back_inserter(out), "</{}>\n", name);
  };
  list("CharacteristicDefinitions", items_.size(), definitions_);
  list("CharacteristicNominals", items_.size(), nominals_);
  list("CharacteristicItems", items_.size(), item_texts_);
  out += fmt::format(
      "</Characteristics>\n<Results><MeasurementResultsSet n=\"1\"><MeasurementResults id=\"{}\">"
      "<MeasuredCharacteristics>\n",
      last_id_ + 1);
  list("CharacteristicMeasurements", measurements_, measurement_texts_);
  out += fmt::format(
      "</MeasuredCharacteristics><InspectionStatus><InspectionStatusEnum>{}</InspectionStatusEnum>"
      "</InspectionStatus></MeasurementResults></MeasurementResultsSet>\n",
      kStatuses[worst_].inspection);
  if (!parts_.empty()) {
    std::string components;
    for (const auto& [serial, part] : parts_) {
      components += fmt::format(
          "<ActualComponent "
          "id=\"{}\"><SerialNumber>{}</SerialNumber><Status><InspectionStatusEnum>{}"
          "</InspectionStatusEnum></Status></ActualComponent>\n",
          part.id, xml_text(serial), kStatuses[part.worst].inspection);
    }
    out += "<ActualComponentSets n=\"1\">\n";
    list("ActualComponentSet", parts_.size(), components);
    out += "</ActualComponentSets>\n";
  }
  out += "</Results>\n</QIFDocument>\n";
  return out;
}

}  // namespace fitgauge::qif
