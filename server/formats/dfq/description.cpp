#include "formats/dfq/reader.hpp"

namespace fitgauge::aqdef {
namespace {

Error wrong(std::string what) { return {kMalformed, std::move(what)}; }

std::string_view tolerance_name(int number) { return field_info(number)->name; }

/// Reads the lengths of one characteristic.
class ToleranceReader {
 public:
  ToleranceReader(const Description& description, const Characteristic& characteristic)
      : description_(description), characteristic_(characteristic) {}

  Result<Toleranced> read(std::optional<sheet::LengthUnit> fallback,
                          const sheet::LimitsOfClass& limits_of) {
    const Described* const unit = find(k::kUnit);
    const auto known = unit == nullptr ? fallback : sheet::length_unit(unit->text);
    if (!known) {
      return unit == nullptr
                 ? wrong(nullptr,
                         fmt::format("describes characteristic {}, which has no unit: write "
                                     "K2142, or set length_unit",
                                     characteristic_.index))
                 : wrong(unit,
                         fmt::format(
                             "has the unit '{}', which must be one of: mm, \xC2\xB5m, cm, m, inch",
                             first_characters(unit->text, 40)));
    }
    read_.unit = *known;
    const auto nominal = TRY(length(k::kNominal));
    if (!nominal) {
      return wrong(nullptr, fmt::format("describes characteristic {}, which has no nominal value: "
                                        "write K2101",
                                        characteristic_.index));
    }
    read_.nominal = *nominal;
    const auto lower = TRY(limit(k::kLowerLimit, k::kLowerAllowance, k::kLowerLimitType));
    const auto upper = TRY(limit(k::kUpperLimit, k::kUpperAllowance, k::kUpperLimitType));
    read_.limits = {.upper = upper, .lower = lower};
    if (lower && upper && *upper < *lower)
      return wrong(find(k::kUpperLimit), "has an upper limit that is below the lower one");
    const Described* const letter = find(k::kToleranceClass);
    const Described* const grade = find(k::kToleranceGrade);
    if ((letter == nullptr) != (grade == nullptr)) {
      return wrong(letter == nullptr ? grade : letter,
                   "has only one of K2103 and K2104: write both, such as H and 7");
    }
    read_.class_name = letter == nullptr
                           ? std::string(user_text(description_, characteristic_, "class"))
                           : letter->text + grade->text;
    if (read_.class_name.empty()) return read_;
    TRY(check_class(limits_of));
    return read_;
  }

 private:
  Error wrong(const Described* field, std::string_view what) const {
    return at_line(field == nullptr ? characteristic_.line : field->line, what);
  }
  const Described* find(int number) const { return description_.find(characteristic_, number); }

  Result<std::optional<Length>> length(int number) const {
    const Described* const field = find(number);
    if (field == nullptr) return std::optional<Length>();
    const auto value = sheet::parse_length(field->text, read_.unit);
    if (!value) {
      return wrong(field,
                   fmt::format("has '{}' in K{:04}, the {}, which must be a number",
                               first_characters(field->text, 40), number, tolerance_name(number)));
    }
    return std::optional(*value);
  }

  /// Returns the upper or lower deviation, from its limit or its allowance.
  Result<std::optional<Length>> limit(int limit_number, int allowance_number,
                                      int type_number) const {
    const Described* const type = find(type_number);
    if (type != nullptr && type->text != "0" && type->text != "1" && type->text != "2") {
      return wrong(
          type,
          fmt::format(
              "has '{}' in K{:04}, which must be 0 (no limit), 1 (limit) or 2 (natural limit)",
              first_characters(type->text, 40), type_number));
    }
    auto limit = length(limit_number);
    if (!limit) return limit;
    const auto allowance = TRY(length(allowance_number));
    if (type != nullptr && type->text != "1") return std::optional<Length>();
    if (!allowance) return limit;
    const Length by_allowance = read_.nominal + *allowance;
    if (*limit && **limit != by_allowance) {
      return wrong(
          find(limit_number),
          fmt::format("has {} mm in K{:04}, but K{:04} gives {} mm: correct one of them",
                      format_mm(**limit), limit_number, allowance_number, format_mm(by_allowance)));
    }
    return std::optional(by_allowance);
  }

  Result<void> check_class(const sheet::LimitsOfClass& limits_of) const {
    if (!limits_of) return {};
    const auto limits = limits_of(read_.nominal, read_.class_name);
    if (!limits) {
      return wrong(find(k::kToleranceClass), fmt::format("has {} in K2103 and K2104: {}",
                                                         read_.class_name, limits.error().message));
    }
    const auto agree = [&](const std::optional<Length>& said, const std::optional<Length>& by_class,
                           int number) -> Result<void> {
      const auto differs = sheet::difference(fmt::format("K{:04}", number), said, by_class,
                                             read_.nominal, read_.class_name);
      if (!differs) return {};
      const Described* const field = find(number);
      return wrong(field != nullptr ? field : find(k::kToleranceClass),
                   *differs + ": correct one of them, or remove K2103 and K2104");
    };
    TRY(agree(read_.limits.lower, limits->lower, k::kLowerLimit));
    return agree(read_.limits.upper, limits->upper, k::kUpperLimit);
  }

  const Description& description_;
  const Characteristic& characteristic_;
  Toleranced read_{};
};

}  // namespace

const Described* FieldList::find(int number) const {
  const auto found = std::ranges::find_if(fields_, [number](const Described& field) {
    return field.number == number && !field.text.empty();
  });
  return found == fields_.end() ? nullptr : &*found;
}

Result<void> FieldList::add(const FieldLine& field, std::uint32_t line, std::string text) {
  const Described* const there = find(field.number);
  if (there == nullptr) {
    fields_.push_back({.number = field.number, .line = line, .text = std::move(text)});
  } else if (there->text != text) {
    return wrong(fmt::format("has '{}', but line {} has '{}': remove one K{:04}",
                             first_characters(text, 40), there->line,
                             first_characters(there->text, 40), field.number));
  }
  return {};
}

Result<std::string> Description::decoded(std::string_view bytes) const {
  auto text = sheet::to_utf8(bytes, encoding_);
  if (!text) return wrong("is not UTF-8: set encoding to windows-1252");
  return text;
}

Result<void> Description::add(const FieldLine& field, std::uint32_t line) {
  bytes_ += field.text.size() + sizeof(Described);
  if (bytes_ > kMostBytes) {
    return wrong(
        fmt::format("comes after {} MiB of description: split the file", kMostBytes >> 20));
  }
  if (field.number == k::kCount) {
    const std::uint32_t count = read_number<std::uint32_t>(field.text).value_or(0);
    if (count == 0 || count > kMostCharacteristics) {
      return wrong(fmt::format("must have the number of characteristics in K0100, 1 to {}",
                               kMostCharacteristics));
    }
    if (stated_count_ && *stated_count_ != count) {
      return wrong(
          fmt::format("has {} in K0100, but an earlier line has {}", count, *stated_count_));
    }
    stated_count_ = count;
    characteristics_.resize(count);
    return {};
  }
  if (!stated_count_)
    return wrong("comes before K0100, the number of characteristics, which begins a DFQ");
  auto text = TRY(decoded(field.text));
  switch (level_of(field.number)) {
    case Level::Part: {
      if (field.index == 0) return all_parts_.add(field, line, std::move(text));
      part_ = field.index;
      return parts_[field.index].add(field, line, std::move(text));
    }
    case Level::Characteristic: return add_to_characteristics(field, line, std::move(text));
    case Level::Catalogue: catalogues_[{field.number, field.index}] = std::move(text); return {};
    default: return {};
  }
}

Result<void> Description::add_to_characteristics(const FieldLine& field, std::uint32_t line,
                                                 std::string text) {
  if (field.index == 0) return all_characteristics_.add(field, line, std::move(text));
  if (field.index > *stated_count_) {
    return wrong(fmt::format("is for characteristic {}, but K0100 gives {} characteristics",
                             field.index, *stated_count_));
  }
  Characteristic& characteristic = characteristics_[field.index - 1];
  if (characteristic.index == 0) {
    ++count_;
    characteristic.index = field.index;
    characteristic.part = part_;
    characteristic.line = line;
  }
  if (characteristic.has_values) {
    return wrong(fmt::format(
        "describes characteristic {} after its values: write K2xxx before them", field.index));
  }
  return characteristic.fields.add(field, line, std::move(text));
}

Result<void> Description::check() const {
  if (!stated_count_) return wrong("The file has no K0100, which begins a DFQ");
  if (count_ != *stated_count_) {
    return wrong(
        fmt::format("K0100 gives {} characteristics, but the file describes {}: send the whole "
                    "file, or correct K0100",
                    *stated_count_, count_));
  }
  return {};
}

Characteristic* Description::characteristic(std::uint32_t index) {
  if (index == 0 || index > characteristics_.size()) return nullptr;
  Characteristic& found = characteristics_[index - 1];
  return found.index == 0 ? nullptr : &found;
}

const Characteristic* Description::characteristic(std::uint32_t index) const {
  return const_cast<Description*>(this)->characteristic(index);
}

std::string_view Description::part_text(const Characteristic& characteristic, int number) const {
  const auto part = parts_.find(characteristic.part);
  const std::string_view own =
      part == parts_.end() ? std::string_view() : part->second.text(number);
  return own.empty() ? all_parts_.text(number) : own;
}

std::string_view user_text(const Description& description, const Characteristic& characteristic,
                           std::string_view name) {
  if (description.text(characteristic, k::kUserName) != "fitgauge") return {};
  std::string_view rest = description.text(characteristic, k::kUserText);
  while (!rest.empty()) {
    const std::string_view one = take_field(rest, ';');
    if (one.size() > name.size() && one.starts_with(name) && one[name.size()] == '=')
      return one.substr(name.size() + 1);
  }
  return {};
}

Result<Toleranced> read_tolerance(const Description& description,
                                  const Characteristic& characteristic,
                                  std::optional<sheet::LengthUnit> fallback,
                                  const sheet::LimitsOfClass& limits_of) {
  return ToleranceReader(description, characteristic).read(fallback, limits_of);
}

}  // namespace fitgauge::aqdef
