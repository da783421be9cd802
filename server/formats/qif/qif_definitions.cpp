#include "formats/qif/qif_definitions.hpp"

#include "formats/qif/xml_reader.hpp"

namespace fitgauge::qif {
namespace {

constexpr std::size_t kMostDefinitions = 100'000;          ///< of all kinds
constexpr std::size_t kMostBytes = std::size_t{16} << 20;  ///< of their texts
constexpr std::string_view kNamespace = "http://qifstandards.org/xsd/qif3";

/// Lists whose elements are read whole.
constexpr std::array<std::string_view, 10> kLists = {
    "CharacteristicDefinitions", "CharacteristicNominals", "CharacteristicItems",
    "FeatureDefinitions",        "FeatureNominals",        "FeatureItems",
    "ActualComponentSet",        "MeasurementDevices",     "PrimaryUnits",
    "InspectionTraceability"};

std::optional<aqdef::LengthUnit> unit_of_factor(std::string_view factor) {
  using aqdef::LengthUnit;
  constexpr int kScale = 9;
  const auto billionths = parse_decimal(factor, {.scale = kScale, .exponent = true});
  if (!billionths) return std::nullopt;
  switch (*billionths) {
    case 1'000: return LengthUnit::Micrometre;
    case 1'000'000: return LengthUnit::Millimetre;
    case 10'000'000: return LengthUnit::Centimetre;
    case 25'400'000: return LengthUnit::Inch;
    case 1'000'000'000: return LengthUnit::Metre;
    default: return std::nullopt;
  }
}

}  // namespace

void set_field(Fields& fields, std::string_view name, std::string_view text) {
  const std::size_t place = aqdef::place_of(name);
  if (place < fields.size()) fields.at(place) = text;
}

void Definitions::take(std::string_view list, const Element& element) {
  const std::string id = element.attribute("id");
  if (list == "CharacteristicItems") {
    Item& item = items_[id];
    item.name = element.text("Name");
    if (item.name.empty()) item.name = element.text("CharacteristicDesignator/Designator");
    item.nominal = element.text("CharacteristicNominalId");
    item.device = element.text("MeasurementDeviceIds/Id");
    item.part_feature = element.text("FeatureItemIds/Id");
    for (auto& [name, text] : element.named_attributes()) {
      if (aqdef::place_of(name) < aqdef::kNames.size())
        item.attributes.emplace_back(std::move(name), std::move(text));
    }
  } else if (list == "CharacteristicNominals") {
    nominals_[id] = {.definition = element.text("CharacteristicDefinitionId"),
                     .target = element.text("TargetValue"),
                     .name = element.text("Name"),
                     .feature = element.text("FeatureNominalIds/Id")};
  } else if (list == "CharacteristicDefinitions") {
    Definition& definition = definitions_[id];
    definition = {.upper = element.text("Tolerance/MaxValue"),
                  .lower = element.text("Tolerance/MinValue"),
                  .size_operator = element.text("DimensionModifiers/DeterminationModifier"),
                  .name = element.text("Name")};
    const auto is_true = [&](std::string_view path) {
      const std::string text = element.text(path);
      return text == "true" || text == "1";
    };
    definition.is_limit = is_true("Tolerance/DefinedAsLimit");
    if (is_true("EnvelopeRequirement")) definition.envelope = "required";
    for (const auto& fits : element.find("LimitsAndFitsSpecification")) {
      definition.class_name = fits.text("FormVariance") + fits.text("Grade");
    }
    for (const auto& [name, text] : element.named_attributes()) {
      if (name == "tolerance_class") definition.class_name = text;
      if (name == "feature") definition.feature = text;
      if (name == "quantity") definition.quantity = text;
      if (name == "size_operator") definition.size_operator = text;
    }
  } else if (list == "FeatureDefinitions") {
    const std::string side = element.text("InternalExternal");
    if (side == "INTERNAL") features_[id] = "hole";
    if (side == "EXTERNAL") features_[id] = "shaft";
  } else if (list == "FeatureNominals") {
    feature_nominals_[id] = element.text("FeatureDefinitionId");
  } else if (list == "FeatureItems") {
    feature_items_[id] = element.text("FeatureNominalId");
  } else if (list == "ActualComponentSet") {
    parts_[id] = element.text("SerialNumber");
  } else if (list == "MeasurementDevices") {
    devices_[id] = element.text("Name");
  } else if (list == "PrimaryUnits" && element.name() == "LinearUnit") {
    unit_name_ = element.text("UnitName");
    const std::string factor = element.text("UnitConversion/Factor");
    unit_ = factor.empty() ? aqdef::length_unit(unit_name_) : unit_of_factor(factor);
  } else if (list == "InspectionTraceability") {
    if (element.name() == "OrderNumber") order_ = element.own_text();
    if (element.name() == "InspectionOperator") inspector_ = element.text("Name");
  }
}

Result<Definitions> Definitions::read(Read document, std::optional<aqdef::LengthUnit> fallback) {
  XmlReader reader(std::move(document));
  Definitions read;
  read.unit_ = fallback;
  std::size_t bytes = 0;
  for (std::size_t count = 0;;) {
    const auto more = TRY(reader.next());
    if (!more) return read;
    if (reader.depth() == 0 &&
        (reader.name() != "QIFDocument" || reader.name_space() != kNamespace)) {
      return aqdef::at_line(reader.line(),
                            fmt::format("begins {}, but must begin a QIFDocument of QIF 3 ({})",
                                        reader.name(), kNamespace));
    }
    const auto list = std::ranges::find(kLists, reader.parent());
    if (reader.parent() == "CharacteristicMeasurements") reader.pass_over();
    if (list == kLists.end()) continue;
    if (++count > kMostDefinitions) {
      return aqdef::at_line(
          reader.line(),
          fmt::format("comes after {} definitions: split the document", kMostDefinitions));
    }
    const auto element = TRY(reader.take());
    bytes += element.own_text().size();
    if (bytes > kMostBytes) {
      return aqdef::at_line(
          reader.line(),
          fmt::format("comes after {} MiB of definitions: split the document", kMostBytes >> 20));
    }
    read.take(*list, element);
  }
}

}  // namespace fitgauge::qif
