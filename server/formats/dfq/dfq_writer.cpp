#include "formats/dfq/dfq_writer.hpp"

namespace fitgauge::aqdef {
namespace {

constexpr std::string_view kLineEnd = "\r\n";
constexpr std::string_view kNoValue =
    "\x14"
    "256";  ///< of a characteristic that was not measured

std::size_t characters_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// The first characters, whole.
std::string_view cut(std::string_view text, std::size_t characters) {
  std::size_t at = 0;
  for (; at < text.size(); ++at) {
    const bool begins = (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80;
    if (begins && characters-- == 0) break;
  }
  return trim(text.substr(0, at));
}

int decimals_of(std::string_view number) {
  const std::size_t point = number.find('.');
  return point == std::string_view::npos ? 0 : static_cast<int>(number.size() - point - 1);
}

/// `H` and `7`; none for a class that the two fields cannot express.
std::optional<std::pair<std::string, std::string>> letters_and_grade(std::string_view name) {
  constexpr std::size_t kMost = 2;
  std::size_t letters = 0;
  while (letters < name.size() && is_ascii_letter(name[letters])) ++letters;
  const std::string_view grade = name.substr(letters);
  const bool is_grade = !grade.empty() && grade.size() <= kMost && grade[0] != '0' &&
                        std::ranges::all_of(grade, [](char c) { return c >= '0' && c <= '9'; });
  if (letters == 0 || letters > kMost || !is_grade) return std::nullopt;
  return std::pair(std::string(name.substr(0, letters)), std::string(grade));
}

std::string_view carried(const Comment& comment, int number) {
  for (const CarriedField& field : comment.fields) {
    if (field.number == number) return field.text;
  }
  return {};
}

/// Whether a text of a file in Windows-1252 would be read as UTF-8.
bool is_ambiguous(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::string_view text = bytes.substr(0, bytes.find_first_of("\r\n\x14\x0F"));
    bytes.remove_prefix(std::min(bytes.size(), text.size() + 1));
    const bool is_ascii =
        std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    if (!is_ascii && is_utf8(text)) return true;
  }
  return false;
}

/// If it has no other characters.
std::optional<std::string> as_windows1252(std::string_view text) {
  static const auto upper = [] {
    std::map<std::string, char, std::less<>> map;
    for (int byte = 0x80; byte < 0x100; ++byte) {
      const char c = static_cast<char>(byte);
      map.emplace(utf8_from_windows1252({&c, 1}), c);
    }
    return map;
  }();
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    if (static_cast<unsigned char>(text[at]) < 0x80) {
      out += text[at++];
      continue;
    }
    std::size_t end = at + 1;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) ++end;
    const auto found = upper.find(text.substr(at, end - at));
    if (found == upper.end()) return std::nullopt;
    out += found->second;
    at = end;
  }
  if (is_ambiguous(out)) return std::nullopt;
  return out;
}

}  // namespace

Result<void> check_text(int number, std::string_view text) {
  const FieldInfo* const info = field_info(number);
  const std::string name = info == nullptr ? fmt::format("K{:04}", number)
                                           : fmt::format("K{:04}, the {},", number, info->name);
  const bool is_plain = std::ranges::none_of(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7F'; });
  if (!is_plain) {
    return Error{ErrorCode::FieldInvalid,
                 fmt::format("{} cannot hold a line end or another control character", name)};
  }
  if (info == nullptr || info->longest == 0) return {};
  const std::size_t count = characters_of(text);
  if (count <= static_cast<std::size_t>(info->longest)) return {};
  return Error{ErrorCode::FieldTooLong,
               fmt::format("{} must have at most {} characters; '{}' has {}", name, info->longest,
                           first_characters(text, 60), count)};
}

DfqWriter::Fields DfqWriter::part_fields(const OutgoingValue& value, const Comment& comment) const {
  const std::string_view number = carried(comment, k::kPartNumber);
  const std::string_view description = carried(comment, k::kPartDescription);
  Fields fields = {{k::kPartNumber, number.empty() ? options_.part_number : std::string(number)},
                   {k::kPartDescription,
                    description.empty() ? options_.part_description : std::string(description)}};
  if (!value.operation.empty()) fields.emplace_back(k::kOperation, value.operation);
  if (!value.unit.empty()) fields.emplace_back(k::kPlant, value.unit);
  return fields;
}

DfqWriter::Fields DfqWriter::characteristic_fields(const OutgoingValue& value) {
  const std::string nominal = value.nominal ? format_mm(*value.nominal) : std::string();
  const auto split = letters_and_grade(value.class_name);
  std::string name(value.characteristic);
  if (name.empty()) {
    name =
        fmt::format("{} {}", nominal, value.class_name.empty() ? value.quantity : value.class_name);
  }
  name = trim(name);
  Fields fields = {
      {k::kNumber, std::string(cut(name, 20))}, {k::kDescription, name}, {k::kType, "0"}};
  if (value.nominal) fields.emplace_back(k::kNominal, nominal);
  if (split) {
    fields.emplace_back(k::kToleranceClass, split->first);
    fields.emplace_back(k::kToleranceGrade, split->second);
  }
  const auto& [upper, lower] = value.limits;
  if (lower) fields.emplace_back(k::kLowerLimit, format_mm(*lower));
  if (upper) fields.emplace_back(k::kUpperLimit, format_mm(*upper));
  if (lower) fields.emplace_back(k::kLowerAllowance, format_mm(*lower - *value.nominal));
  if (upper) fields.emplace_back(k::kUpperAllowance, format_mm(*upper - *value.nominal));
  fields.emplace_back(k::kLowerLimitType, lower ? "1" : "0");
  fields.emplace_back(k::kUpperLimitType, upper ? "1" : "0");
  fields.emplace_back(k::kUnit, "mm");
  std::string user;
  const auto say = [&user](const std::string& what) {
    if (!user.empty()) user += ';';
    user += what;
  };
  if (value.class_name.empty() && !value.feature.empty())
    say(fmt::format("feature={}", value.feature));
  if (!value.quantity.empty()) say(fmt::format("quantity={}", value.quantity));
  if (!value.class_name.empty() && !split) say(fmt::format("class={}", value.class_name));
  if (!value.rule.empty()) say(std::string(value.rule));
  if (user.empty()) return fields;
  fields.emplace_back(k::kUserName, "fitgauge");
  fields.emplace_back(k::kUserType, "A");
  fields.emplace_back(k::kUserText, user);
  return fields;
}

DfqWriter::Fields DfqWriter::value_fields(const OutgoingValue& value, const Comment& comment) {
  Fields fields;
  if (!comment.text.empty()) fields.emplace_back(k::kText, comment.text);
  if (!value.part_id.empty()) fields.emplace_back(k::kPartIdent, value.part_id);
  if (!value.order.empty()) fields.emplace_back(k::kOrder, value.order);
  const std::string guid = ascii_upper(guid_of(value.origin, value.number));
  if (carried(comment, k::kGuid).empty()) fields.emplace_back(k::kGuid, "{" + guid + "}");
  for (const CarriedField& field : comment.fields) {
    const bool is_cell = std::ranges::find(kCells, field.number) != kCells.end();
    const bool is_there =
        std::ranges::any_of(fields, [&](const auto& other) { return other.first == field.number; });
    if (level_of(field.number) != Level::Value || is_cell || is_there) continue;
    fields.emplace_back(field.number, field.text);
  }
  std::ranges::sort(fields);
  return fields;
}

std::string DfqWriter::time_text(Timestamp time) const {
  if (options_.zone) time = options_.zone->shown(time);
  const CivilTime civil = civil_time(time);
  return fmt::format("{:02}.{:02}.{:04}/{:02}:{:02}:{:02}", civil.day, civil.month, civil.year,
                     civil.hour, civil.minute, civil.second);
}

std::string DfqWriter::entry(Catalogue& catalogue, std::string_view text) {
  if (text.empty()) return "0";  // as others write it, whose readers want a number
  const auto found = std::ranges::find(catalogue.entries, text);
  const auto place = found - catalogue.entries.begin();
  if (found == catalogue.entries.end()) catalogue.entries.emplace_back(text);
  return std::to_string(place + 1);
}

std::size_t DfqWriter::place_of_characteristic(std::size_t part, const Fields& fields) {
  const auto [known, is_new] =
      known_characteristics_.try_emplace({part, fields}, characteristics_.size());
  if (is_new) {
    Described described{.part = part, .fields = fields};
    for (const auto& [number, text] : fields) {
      if (field_info(number)->type == FieldType::Number)
        described.decimals = std::max(described.decimals, decimals_of(text));
    }
    characteristics_.push_back(std::move(described));
  }
  return known->second;
}

Result<void> DfqWriter::add(const OutgoingValue& value) {
  const Comment comment = parse_comment(value.comment);
  const Fields part = part_fields(value, comment);
  const Fields characteristic = characteristic_fields(value);
  Written written{.characteristic = 0,
                  .part_id = std::string(value.part_id),
                  .cells = {},
                  .fields = value_fields(value, comment)};
  const Fields entries = {{k::kMachineNumber, std::string(value.machine)},
                          {k::kOperatorName, std::string(value.operator_name)},
                          {k::kGaugeNumber, std::string(value.gauge)},
                          {k::kBatch, std::string(value.subgroup)}};
  for (const Fields* fields :
       std::array<const Fields*, 4>{&part, &characteristic, &written.fields, &entries}) {
    for (const auto& [number, text] : *fields) TRY(check_text(number, text));
  }
  const std::string_view cavity = carried(comment, k::kCavity);
  written.cells = {format_mm(value.measured),
                   "0",
                   time_text(value.measured_at),
                   std::string(carried(comment, k::kEvents)),
                   value.subgroup.empty() ? std::string() : fmt::format("#{}", value.subgroup),
                   cavity.empty() ? std::string("0") : std::string(cavity),
                   entry(operators_, value.operator_name),
                   entry(machines_, value.machine),
                   std::string(carried(comment, k::kProcess)),
                   entry(gauges_, value.gauge)};
  written.characteristic = place_of_characteristic(place_of_part(part), characteristic);
  int& decimals = characteristics_[written.characteristic].decimals;
  decimals = std::max(decimals, decimals_of(written.cells[0]));
  values_.push_back(std::move(written));
  return {};
}

std::vector<std::size_t> DfqWriter::indices() const {
  std::vector<std::size_t> indices(characteristics_.size());
  std::size_t next = 1;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    for (std::size_t i = 0; i < characteristics_.size(); ++i) {
      if (characteristics_[i].part == part) indices[i] = next++;
    }
  }
  return indices;
}

void DfqWriter::append_description(std::string& out,
                                   const std::vector<std::size_t>& indices) const {
  const auto append = [&out](int number, std::size_t index, std::string_view text) {
    out += fmt::format("K{:04}/{} {}{}", number, index, text, kLineEnd);
  };
  out += fmt::format("K0100 {}{}", characteristics_.size(), kLineEnd);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    for (const auto& [number, text] : parts_[part]) append(number, part + 1, text);
    for (std::size_t i = 0; i < characteristics_.size(); ++i) {
      const Described& described = characteristics_[i];
      if (described.part != part) continue;
      for (const auto& [number, text] : described.fields) {
        append(number, indices[i], text);
        if (number == k::kType)
          append(k::kDecimals, indices[i], std::to_string(described.decimals));
      }
    }
  }
  for (const Catalogue* catalogue : {&machines_, &gauges_, &operators_}) {
    for (std::size_t i = 0; i < catalogue->entries.size(); ++i)
      append(catalogue->field, i + 1, catalogue->entries[i]);
  }
}

void DfqWriter::append_values(std::string& out, const std::vector<std::size_t>& indices) const {
  for (std::size_t first = 0; first < values_.size();) {
    // Values of one part in the order of its characteristics are on one line.
    std::size_t end = first + 1;
    while (end < values_.size() && !values_[first].part_id.empty() &&
           values_[end].part_id == values_[first].part_id &&
           indices[values_[end].characteristic] > indices[values_[end - 1].characteristic]) {
      ++end;
    }
    std::size_t next = first;
    for (std::size_t index = 1; index <= characteristics_.size(); ++index) {
      if (index > 1) out += kValueSeparator;
      if (next == end || indices[values_[next].characteristic] != index) {
        out += kNoValue;
        continue;
      }
      const auto& cells = values_[next++].cells;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i > 0) out += kFieldSeparator;
        out += cells.at(i);
      }
    }
    out += kLineEnd;
    for (; first != end; ++first) {
      const std::size_t index = indices[values_[first].characteristic];
      for (const auto& [number, text] : values_[first].fields)
        out += fmt::format("K{:04}/{} {}{}", number, index, text, kLineEnd);
    }
  }
}

std::string DfqWriter::text() const {
  const std::vector<std::size_t> places = indices();
  std::string out;
  append_description(out, places);
  append_values(out, places);
  if (auto encoded = as_windows1252(out)) return *std::move(encoded);
  return "\xEF\xBB\xBF" + out;
}

}  // namespace fitgauge::aqdef
