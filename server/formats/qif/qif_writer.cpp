#include "formats/qif/qif.hpp"

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

/// Returns the word for a part or for all results: QIF has no word for an open verdict.
std::string_view inspection_word(Status status) {
  const bool is_open = status == Status::Indeterminate || status == Status::Undefined;
  return is_open ? "UNKNOWN" : word(status);
}

std::string tolerance(const OutgoingValue& value) {
  if (!value.upper && !value.lower) return "<NonTolerance>MEASURED</NonTolerance>";
  std::string out = "<Tolerance>";
  if (value.upper) out += fmt::format("<MaxValue>{}</MaxValue>", format_mm(*value.upper));
  if (value.lower) out += fmt::format("<MinValue>{}</MinValue>", format_mm(*value.lower));
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

}  // namespace

std::string_view word(Status status) {
  return word_of(status, {"PASS", "UNDEFINED", "REWORK", "INDETERMINATE", "FAIL"});
}

std::uint32_t QifWriter::item_of(const OutgoingValue& value) {
  Texts of_definition;
  if (!value.feature.empty()) of_definition.emplace_back("feature", value.feature);
  if (value.quantity != gauging::Quantity::Diameter)
    of_definition.emplace_back("quantity", word(value.quantity));
  if (!value.class_name.empty())
    of_definition.emplace_back("tolerance_class", std::string(value.class_name));
  std::string modifiers =
      value.has_envelope ? "<EnvelopeRequirement>true</EnvelopeRequirement>" : "";
  if (std::ranges::find(kDeterminations, value.size_operator) != std::end(kDeterminations)) {
    modifiers += fmt::format(
        "<DimensionModifiers><DeterminationModifier>{}</DeterminationModifier></"
        "DimensionModifiers>",
        value.size_operator);
  } else if (!value.size_operator.empty()) {
    of_definition.emplace_back("size_operator", value.size_operator);
  }
  const std::string definition = attributes(of_definition) + modifiers + tolerance(value);
  const std::string_view kind = characteristic_of(value.quantity);
  const std::string nominal =
      value.nominal ? fmt::format("<TargetValue>{}</TargetValue>", format_mm(*value.nominal)) : "";
  const std::string name(value.characteristic.value_or(""));
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

Result<void> QifWriter::add(const OutgoingValue& value) {
  Texts fields = {{"id", fmt::format("m{}-{}", value.number, value.origin)}};
  for (const auto& field : value.fields) fields.push_back(field);
  for (const auto& [name, text] : fields) TRY(check(name, text));
  for (const auto& [name, text] : {std::pair("part_id", value.part_id.value_or("")),
                                   std::pair("characteristic", value.characteristic.value_or("")),
                                   std::pair("tolerance_class", value.class_name),
                                   std::pair("size_operator", value.size_operator)}) {
    TRY(check(name, text));
  }
  if (is_empty()) qpid_ = aqdef::guid_of(value.origin, value.number);
  const std::uint32_t item = item_of(value);
  std::string part;
  if (value.part_id) {
    auto& known = parts_[std::string(*value.part_id)];
    if (known.id == 0) known.id = ++last_id_;
    known.worst = std::max(known.worst, value.status);
    part = fmt::format("<ActualComponentId>{}</ActualComponentId>", known.id);
  }
  const std::string uncertainty =
      value.uncertainty ? fmt::format(" combinedUncertainty=\"{}\"", format_mm(*value.uncertainty))
                        : std::string();
  measurement_texts_ += fmt::format(
      "<{0}CharacteristicMeasurement id=\"{1}\">{2}<Status><CharacteristicStatusEnum>{3}"
      "</CharacteristicStatusEnum></Status><CharacteristicItemId>{4}</CharacteristicItemId>"
      "<TimeStamp>{5}</TimeStamp>{6}<Value{7}>{8}</Value></{0}CharacteristicMeasurement>\n",
      characteristic_of(value.quantity), ++last_id_, attributes(fields), word(value.status), item,
      format_rfc3339(value.measured_at), part, uncertainty, format_mm(value.measured));
  worst_ = std::max(worst_, value.status);
  is_iso286_ = is_iso286_ && value.is_iso286;
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
      inspection_word(worst_));
  if (!parts_.empty()) {
    std::string components;
    for (const auto& [serial, part] : parts_) {
      components += fmt::format(
          "<ActualComponent "
          "id=\"{}\"><SerialNumber>{}</SerialNumber><Status><InspectionStatusEnum>{}"
          "</InspectionStatusEnum></Status></ActualComponent>\n",
          part.id, xml_text(serial), inspection_word(part.worst));
    }
    out += "<ActualComponentSets n=\"1\">\n";
    list("ActualComponentSet", parts_.size(), components);
    out += "</ActualComponentSets>\n";
  }
  out += "</Results>\n</QIFDocument>\n";
  return out;
}

}  // namespace fitgauge::qif
