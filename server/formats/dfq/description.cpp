#include "formats/dfq/description.hpp"

#include "base/number.hpp"
#include "base/text.hpp"

namespace fitgauge::aqdef {
namespace {

Error wrong(std::string what) { return {kMalformed, std::move(what)}; }

}  // namespace

const Described* FieldList::find(int number) const {
  const auto found = std::find_if(fields_.begin(), fields_.end(), [number](const Described& field) {
    return field.number == number && !field.text.empty();
  });
  return found == fields_.end() ? nullptr : &*found;
}

std::string_view FieldList::text(int number) const {
  const Described* const field = find(number);
  return field == nullptr ? std::string_view() : std::string_view(field->text);
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
  if (!stated_count_) {
    return wrong("comes before K0100, the number of characteristics, which begins a DFQ");
  }
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

const Described* Description::find(const Characteristic& characteristic, int number) const {
  const Described* const own = characteristic.fields.find(number);
  return own == nullptr ? all_characteristics_.find(number) : own;
}

std::string_view Description::text(const Characteristic& characteristic, int number) const {
  const Described* const field = find(characteristic, number);
  return field == nullptr ? std::string_view() : std::string_view(field->text);
}

std::string_view Description::part_text(const Characteristic& characteristic, int number) const {
  const auto part = parts_.find(characteristic.part);
  const std::string_view own =
      part == parts_.end() ? std::string_view() : part->second.text(number);
  return own.empty() ? all_parts_.text(number) : own;
}

std::string_view Description::catalogue_text(int number, std::uint32_t entry) const {
  const auto found = catalogues_.find({number, entry});
  return found == catalogues_.end() ? std::string_view() : std::string_view(found->second);
}

}  // namespace fitgauge::aqdef
