#pragma once

#include "base/result.hpp"
#include "formats/dfq/description.hpp"
#include "formats/dfq/lines.hpp"
#include "formats/sheet/record_reader.hpp"

namespace fitgauge::qif {

class Element;

/// The texts of a measurement by the places of sheet::kMeasurementFields.
using Fields = std::array<std::string, sheet::kMeasurementFields.size()>;

/// Sets the field of that name; other names are ignored.
void set_field(Fields& fields, std::string_view name, std::string_view text);

/// The characteristics, parts and devices of a document. Bounded in memory.
class Definitions {
 public:
  /// A characteristic that was measured.
  struct Item {
    std::string name{};
    std::string nominal{};                                          ///< id
    std::string device{};                                           ///< id
    std::string part_feature{};                                     ///< id of a feature item
    std::vector<std::pair<std::string, std::string>> attributes{};  ///< by names of fields
  };
  struct Nominal {
    std::string definition{};  ///< id
    std::string target{};
    std::string name{};
    std::string feature{};  ///< id of a feature's nominal
  };
  struct Definition {
    std::string upper{};
    std::string lower{};
    bool is_limit = false;  ///< else they are deviations
    std::string class_name{};
    std::string feature{};
    std::string quantity{};
    std::string size_operator{};
    std::string envelope{};
    std::string name{};
  };

  /// Reads all but the measurements. @errors CsvMalformed with the line
  static Result<Definitions> read(Read document, std::optional<aqdef::LengthUnit> fallback);

  /// Returns null if there is no such id.
  const Item* item(const std::string& id) const { return find(items_, id); }
  const Nominal* nominal(const std::string& id) const { return find(nominals_, id); }
  const Definition* definition(const std::string& id) const { return find(definitions_, id); }
  std::string_view part(const std::string& id) const { return text(parts_, id); }
  std::string_view device(const std::string& id) const { return text(devices_, id); }
  /// Returns `hole`, `shaft` or nothing, for the feature of a characteristic.
  std::string_view feature(const Item& item, const Nominal& nominal) const {
    std::string of_nominal = nominal.feature;
    if (of_nominal.empty()) of_nominal = text(feature_items_, item.part_feature);
    return text(features_, std::string(text(feature_nominals_, of_nominal)));
  }
  /// Returns the unit of the document or of the caller; none if neither has one.
  std::optional<aqdef::LengthUnit> unit() const { return unit_; }
  const std::string& unit_name() const { return unit_name_; }
  const std::string& order() const { return order_; }
  const std::string& inspector() const { return inspector_; }

 private:
  template <class Value>
  using ById = std::map<std::string, Value, std::less<>>;
  template <class Value>
  static const Value* find(const ById<Value>& by_id, const std::string& id) {
    const auto found = by_id.find(id);
    return found == by_id.end() ? nullptr : &found->second;
  }
  static std::string_view text(const ById<std::string>& by_id, const std::string& id) {
    const auto* const found = find(by_id, id);
    return found == nullptr ? std::string_view() : std::string_view(*found);
  }
  /// Reads an element of one of the lists. Stores only the used parts.
  void take(std::string_view list, const Element& element);

  ById<Item> items_{};
  ById<Nominal> nominals_{};
  ById<Definition> definitions_{};
  ById<std::string> parts_{};
  ById<std::string> devices_{};
  ById<std::string> features_{};          ///< hole or shaft
  ById<std::string> feature_nominals_{};  ///< id of the feature's definition
  ById<std::string> feature_items_{};     ///< id of the feature's nominal
  std::optional<aqdef::LengthUnit> unit_{};
  std::string unit_name_{};
  std::string order_{};
  std::string inspector_{};
};

}  // namespace fitgauge::qif
