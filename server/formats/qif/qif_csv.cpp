#include "formats/qif/qif.hpp"

namespace fitgauge::qif {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kUncertainty = aqdef::place_of("uncertainty_um");
constexpr std::size_t kSizeOperator = aqdef::place_of("size_operator");
constexpr std::size_t kEnvelope = aqdef::place_of("envelope");
constexpr std::string_view kEnding = "CharacteristicMeasurement";
/// Quantities between two points of a surface, as a gauge for sizes measures them.
constexpr std::array kSizes = {
    "Diameter"sv, "SphericalDiameter"sv, "Width"sv,  "Thickness"sv,       "Length"sv, "Height"sv,
    "Depth"sv,    "DistanceBetween"sv,   "Radius"sv, "LinearCoordinate"sv};

/// Returns the quantity of a kind; the document gives its feature separately. A length that is
/// neither hole nor shaft is a distance.
std::string_view quantity_of(std::string_view kind, bool has_feature) {
  if (kind == "Radius") return "radius";
  if (kind == "LinearCoordinate") return "position";
  if (kind.ends_with("Diameter")) return "diameter";
  return has_feature ? "width" : "distance";
}

constexpr std::size_t kMostDefinitions = 100'000;          ///< of all kinds
constexpr std::size_t kMostBytes = std::size_t{16} << 20;  ///< of their texts
constexpr std::string_view kNamespace = "http://qifstandards.org/xsd/qif3";

/// Lists whose elements are read whole.
constexpr std::array<std::string_view, 10> kLists = {
    "CharacteristicDefinitions", "CharacteristicNominals", "CharacteristicItems",
    "FeatureDefinitions",        "FeatureNominals",        "FeatureItems",
    "ActualComponentSet",        "MeasurementDevices",     "PrimaryUnits",
    "InspectionTraceability"};

std::optional<sheet::LengthUnit> unit_of_factor(std::string_view factor) {
  using sheet::LengthUnit;
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

Result<Length> QifRows::length(std::string_view what, const std::string& text,
                               std::uint32_t line) const {
  if (!definitions_.unit()) {
    return aqdef::at_line(line,
                          "has lengths without a known unit in FileUnits ('{}'): set length_unit",
                          first_characters(definitions_.unit_name(), 40));
  }
  const auto read = sheet::parse_length(text, *definitions_.unit());
  if (read) return *read;
  return aqdef::at_line(line, "has the {} '{}', which is not a length", what,
                        first_characters(text, 40));
}

Result<void> QifRows::read_tolerance(const Definitions::Item& item, std::uint32_t line) {
  const auto* const nominal = definitions_.nominal(item.nominal);
  const auto* const definition = definitions_.definition(nominal->definition);
  fill(aqdef::kName, item.name);
  fill(aqdef::kName, nominal->name);
  fill(aqdef::kName, definition->name);
  const auto target = TRY(length("TargetValue", nominal->target, line));
  fields_[aqdef::kNominal] = format_mm(target);
  fill(aqdef::kQuantity, definition->quantity);
  const Length from = definition->is_limit ? Length() : target;
  const auto upper = TRY(limit(definition->upper, from, "MaxValue", line));
  const auto lower = TRY(limit(definition->lower, from, "MinValue", line));
  if (!definition->class_name.empty()) {
    fields_[aqdef::kClass] = definition->class_name;
    if (!options_.limits_of) return {};
    const auto limits = options_.limits_of(target, definition->class_name);
    if (!limits) return aqdef::at_line(line, "has a tolerance class: " + limits.error().message);
    for (const auto& [said, of_class, what] : {std::tuple(upper, limits->upper, "MaxValue"),
                                               std::tuple(lower, limits->lower, "MinValue")}) {
      const auto differs = sheet::difference(what, said, of_class, target, definition->class_name);
      if (differs) return aqdef::at_line(line, *differs + ": correct one of them");
    }
    return {};
  }
  if (upper) fields_[aqdef::kUpper] = format_um(*upper - target);
  if (lower) fields_[aqdef::kLower] = format_um(*lower - target);
  fill(aqdef::kFeature, definition->feature);
  fill(aqdef::kFeature, definitions_.feature(item, *nominal));
  return {};
}

Result<void> QifRows::read_value(const Element& element, std::uint32_t line) {
  const auto values = element.find("Value");
  const std::string unit = values.front().attribute("linearUnit");
  if (!unit.empty() && unit != definitions_.unit_name()) {
    return aqdef::at_line(line, "has a value in '{}', but the unit of the document is '{}'",
                          first_characters(unit, 40), definitions_.unit_name());
  }
  const auto measured = TRY(length("value", values.front().own_text(), line));
  fill(aqdef::kMeasured, format_mm(measured));
  if (const std::string said = values.front().attribute("combinedUncertainty"); !said.empty()) {
    const auto uncertainty = TRY(length("combinedUncertainty", said, line));
    fill(kUncertainty, format_um(uncertainty));
  }
  return {};
}

Result<void> QifRows::read_time(const Element& element, std::uint32_t line) {
  auto instant = sheet::instant_text(element.text("TimeStamp"), options_.zone);
  if (!instant) return aqdef::at_line(line, instant.error().message);
  fields_[aqdef::kMeasuredAt] = *std::move(instant);
  return {};
}

std::string QifRows::reason_against(const Element& element, const Definitions::Item& item) const {
  std::string kind = element.name();
  if (kind.ends_with(kEnding)) kind.resize(kind.size() - kEnding.size());
  if (std::ranges::find(kSizes, kind) == kSizes.end()) {
    return fmt::format("has a {}, which is not a measurement",
                       first_characters(element.name(), 60));
  }
  if (!element.has("Value")) return fmt::format("has a {} without a Value", kind);
  const auto* const nominal = definitions_.nominal(item.nominal);
  const auto* const definition =
      nominal == nullptr ? nullptr : definitions_.definition(nominal->definition);
  if (definition == nullptr) return "measures a characteristic without a nominal or a definition";
  if (nominal->target.empty()) return "measures a characteristic whose nominal has no TargetValue";
  const bool is_toleranced =
      !definition->upper.empty() || !definition->lower.empty() || !definition->class_name.empty();
  return is_toleranced ? "" : "measures a characteristic without a tolerance";
}

Result<bool> QifRows::read_row(const Element& element, std::uint32_t line) {
  const auto* const item = definitions_.item(element.text("CharacteristicItemId"));
  if (item == nullptr)
    return aqdef::at_line(line, "measures a characteristic without an item in the document");
  if (const std::string reason = reason_against(element, *item); !reason.empty()) {
    if (options_.leaves_out_others) return false;
    return aqdef::at_line(line, reason + ": leave_out stores the other measurements");
  }
  fields_ = {};
  for (const auto& [name, text] : item->attributes) set_field(fields_, name, text);
  for (const auto& [name, text] : element.named_attributes()) set_field(fields_, name, text);
  TRY(read_tolerance(*item, line));
  std::string_view kind = element.name();
  kind.remove_suffix(kEnding.size());
  const bool has_side = !fields_[aqdef::kClass].empty() || !fields_[aqdef::kFeature].empty();
  fill(aqdef::kQuantity, std::string(quantity_of(kind, has_side)));
  const auto quantity = gauging::quantity_from_word(fields_[aqdef::kQuantity]);
  if (!quantity || gauging::has_feature(*quantity)) {  // otherwise the modifiers mean nothing
    const auto* const nominal = definitions_.nominal(item->nominal);
    const auto* const definition = definitions_.definition(nominal->definition);
    fill(kSizeOperator, definition->size_operator);
    fill(kEnvelope, definition->envelope);
  }
  TRY(read_value(element, line));
  TRY(read_time(element, line));
  fill(aqdef::kPartId, definitions_.part(element.text("ActualComponentId")));
  fill(aqdef::kComment, element.text("Description"));
  fill(aqdef::kOrder, definitions_.order());
  fill(aqdef::kOperator, definitions_.inspector());
  const std::string device = element.text("MeasurementDeviceIds/Id");
  fill(aqdef::kGauge, definitions_.device(device.empty() ? item->device : device));
  for (const auto& [name, text] : options_.constants) {
    const std::size_t place = aqdef::place_of(name);
    if (place < fields_.size()) fill(place, text);
  }
  return true;
}

Result<bool> QifRows::append(std::string& out, std::vector<std::uint32_t>& lines) {
  for (;;) {
    const auto more = TRY(reader_.next());
    if (!more) return false;
    if (reader_.parent() != "CharacteristicMeasurements") continue;
    const std::uint32_t line = reader_.line();
    const auto element = TRY(reader_.take());
    const auto read = TRY(read_row(element, line));
    if (!read) continue;
    if (++rows_ > options_.most_rows) {
      return aqdef::at_line(line, "comes after {} measured values: split the document",
                            options_.most_rows);
    }
    const auto before = static_cast<std::ptrdiff_t>(out.size());
    sheet::append_row(out, fields_);
    // A text may have line ends.
    const auto ends = std::count(out.begin() + before, out.end(), '\n');
    lines.insert(lines.end(), static_cast<std::size_t>(ends), line);
    return true;
  }
}

std::string QifRows::header() const {
  return fmt::format("{}\n", fmt::join(sheet::kMeasurementFields, ";"));
}

bool is_qif(std::string_view file_name) { return ascii_lower(file_name).ends_with(".qif"); }

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
    for (const auto& fits : element.find("LimitsAndFitsSpecification"))
      definition.class_name = fits.text("FormVariance") + fits.text("Grade");
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
    unit_ = factor.empty() ? sheet::length_unit(unit_name_) : unit_of_factor(factor);
  } else if (list == "InspectionTraceability") {
    if (element.name() == "OrderNumber") order_ = element.own_text();
    if (element.name() == "InspectionOperator") inspector_ = element.text("Name");
  }
}

Result<Definitions> Definitions::read(Read document, std::optional<sheet::LengthUnit> fallback) {
  XmlReader reader(std::move(document));
  Definitions read;
  read.unit_ = fallback;
  std::size_t bytes = 0;
  for (std::size_t count = 0;;) {
    const auto more = TRY(reader.next());
    if (!more) return read;
    if (reader.depth() == 0 &&
        (reader.name() != "QIFDocument" || reader.name_space() != kNamespace)) {
      return aqdef::at_line(reader.line(), "begins {}, but must begin a QIFDocument of QIF 3 ({})",
                            reader.name(), kNamespace);
    }
    const auto list = std::ranges::find(kLists, reader.parent());
    if (reader.parent() == "CharacteristicMeasurements") reader.pass_over();
    if (list == kLists.end()) continue;
    if (++count > kMostDefinitions) {
      return aqdef::at_line(reader.line(), "comes after {} definitions: split the document",
                            kMostDefinitions);
    }
    const auto element = TRY(reader.take());
    bytes += element.own_text().size();
    if (bytes > kMostBytes) {
      return aqdef::at_line(reader.line(), "comes after {} MiB of definitions: split the document",
                            kMostBytes >> 20);
    }
    read.take(*list, element);
  }
}

}  // namespace fitgauge::qif
