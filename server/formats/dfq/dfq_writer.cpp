#include "formats/dfq/dfq_writer.hpp"

#include "record/verdict_codec.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::aqdef {
namespace {

constexpr std::string_view kLineEnd = "\r\n";
constexpr std::string_view kNoValue =
    "\x14"
    "256";  ///< of a characteristic that was not measured

/// The first characters, whole.
std::string_view cut(std::string_view text, std::size_t characters) {
  return trim(text.substr(0, tabfile::skip_characters(text, 0, characters)));
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

void add_text(auto& fields, int number, std::optional<std::string_view> text) {
  if (text && !text->empty()) fields.emplace_back(number, *text);
}

/// Gives `say` the decision rule of a record and its modifiers: nothing if it uses only the limits.
void say_rule(const app::Measurement& m, const auto& say) {
  if (m.rule.kind() != gauging::DecisionRule::Kind::Simple) say("rule", word(m.rule.kind()));
  // u and ν belong to the size at 20 degrees, which is written.
  const gauging::KnownUncertainty known = api::known_uncertainty(m);
  if (m.standard_uncertainty) say("uncertainty_um", format_um(known.u));
  if (m.coverage_factor) say("coverage_factor", format(*m.coverage_factor));
  if (m.degrees_of_freedom) {
    constexpr double kMost = 1e6;  // of the field
    say("degrees_of_freedom",
        format_decimal(std::llround(std::min(known.degrees_of_freedom, kMost) * 1e6), 6));
  }
  if (m.size_operator && m.size_operator != app::kTwoPoint) say("size_operator", *m.size_operator);
  if (m.envelope) say("envelope", *m.envelope);
  if (m.go_gauge) say("go_gauge", *m.go_gauge);
  if (m.inside_corner) say("inside_corner", "true");
  if (m.conformance) say("probability", format(m.rule.probability()));
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
    const std::size_t end = tabfile::skip_characters(text, at, 1);
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
  const std::size_t count = tabfile::count_characters(text);
  if (count <= static_cast<std::size_t>(info->longest)) return {};
  return Error{ErrorCode::FieldTooLong,
               fmt::format("{} must have at most {} characters; '{}' has {}", name, info->longest,
                           first_characters(text, 60), count)};
}

DfqWriter::Fields DfqWriter::part_fields(const app::Measurement& m, const Comment& comment) const {
  const std::string_view number = carried(comment, k::kPartNumber);
  const std::string_view description = carried(comment, k::kPartDescription);
  Fields fields = {{k::kPartNumber, number.empty() ? options_.part_number : std::string(number)},
                   {k::kPartDescription,
                    description.empty() ? options_.part_description : std::string(description)}};
  add_text(fields, k::kOperation, m.operation);
  add_text(fields, k::kPlant, m.unit);
  return fields;
}

DfqWriter::Fields DfqWriter::characteristic_fields(const app::Measurement& m) {
  const std::string nominal = m.has_nominal() ? format_mm(m.nominal_size) : std::string();
  const std::string_view class_name = m.table_class();
  const bool has_quantity =
      m.quantity && (m.quantity != gauging::Quantity::Diameter || !m.is_judged());
  const std::string_view quantity = has_quantity ? word(*m.quantity) : "";
  const auto split = letters_and_grade(class_name);
  std::string name(m.characteristic.value_or(""));
  if (name.empty())
    name = fmt::format("{} {}", nominal, class_name.empty() ? quantity : class_name);
  name = trim(name);
  Fields fields = {
      {k::kNumber, std::string(cut(name, 20))}, {k::kDescription, name}, {k::kType, "0"}};
  if (m.has_nominal()) fields.emplace_back(k::kNominal, nominal);
  if (split) {
    fields.emplace_back(k::kToleranceClass, split->first);
    fields.emplace_back(k::kToleranceGrade, split->second);
  }
  const bool lower = m.has_lower_limit();
  const bool upper = m.has_upper_limit();
  if (lower) fields.emplace_back(k::kLowerLimit, format_mm(m.lower_limit()));
  if (upper) fields.emplace_back(k::kUpperLimit, format_mm(m.upper_limit()));
  if (lower) fields.emplace_back(k::kLowerAllowance, format_mm(m.deviations.lower));
  if (upper) fields.emplace_back(k::kUpperAllowance, format_mm(m.deviations.upper));
  fields.emplace_back(k::kLowerLimitType, lower ? "1" : "0");
  fields.emplace_back(k::kUpperLimitType, upper ? "1" : "0");
  fields.emplace_back(k::kUnit, "mm");
  std::string user;
  const auto say = [&user](std::string_view field, std::string_view text) {
    user += fmt::format("{}{}={}", user.empty() ? "" : ";", field, text);
  };
  if (class_name.empty() && m.has_feature()) say("feature", word(m.feature));
  if (has_quantity) say("quantity", quantity);
  if (!class_name.empty() && !split) say("class", class_name);
  say_rule(m, say);
  if (user.empty()) return fields;
  fields.emplace_back(k::kUserName, "fitgauge");
  fields.emplace_back(k::kUserType, "A");
  fields.emplace_back(k::kUserText, user);
  return fields;
}

DfqWriter::Fields DfqWriter::value_fields(const app::Measurement& m, const Comment& comment) {
  Fields fields;
  add_text(fields, k::kText, comment.text);
  add_text(fields, k::kPartIdent, m.part_id);
  add_text(fields, k::kOrder, m.order);
  const std::string guid = ascii_upper(guid_of(m.origin, m.id));
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

Result<void> DfqWriter::add(const app::Measurement& m) {
  if (m.source != app::Source::Gauge)
    return Error{ErrorCode::FieldInvalid, "it is simulated, which a DFQ cannot express"};
  const Comment comment = parse_comment(m.comment.value_or(""));
  const Fields part = part_fields(m, comment);
  const Fields characteristic = characteristic_fields(m);
  Written written{.characteristic = 0,
                  .part_id = std::string(m.part_id.value_or("")),
                  .cells = {},
                  .fields = value_fields(m, comment)};
  const std::string_view machine = m.machine.value_or("");
  const std::string_view worker = m.operator_id.value_or("");
  const std::string_view gauge = m.gauge.value_or("");
  const std::string_view subgroup = m.subgroup.value_or("");
  const Fields entries = {{k::kMachineNumber, std::string(machine)},
                          {k::kOperatorName, std::string(worker)},
                          {k::kGaugeNumber, std::string(gauge)},
                          {k::kBatch, std::string(subgroup)}};
  for (const Fields* fields :
       std::array<const Fields*, 4>{&part, &characteristic, &written.fields, &entries}) {
    for (const auto& [number, text] : *fields) TRY(check_text(number, text));
  }
  const std::string_view cavity = carried(comment, k::kCavity);
  written.cells = {format_mm(m.decisive()),
                   "0",
                   time_text(m.measured_at),
                   std::string(carried(comment, k::kEvents)),
                   subgroup.empty() ? std::string() : fmt::format("#{}", subgroup),
                   cavity.empty() ? std::string("0") : std::string(cavity),
                   entry(operators_, worker),
                   entry(machines_, machine),
                   std::string(carried(comment, k::kProcess)),
                   entry(gauges_, gauge)};
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
