#include "api/runs/setup_codec.hpp"

#include "nc/program/cycles.hpp"
#include "nc/program/diagnose.hpp"
#include "service/files/file_service.hpp"

namespace fitgauge::api {
namespace {

using interpreter::BuilderAction;
using Kind = JsonValue::Kind;

constexpr int kLargestNumber = 9999;
constexpr std::size_t kMostActions = 1000;

std::optional<int> number_of(std::string_view name) {
  const auto number = read_number<int>(name);
  return number && *number >= 0 && *number <= kLargestNumber ? number : std::nullopt;
}

/// `"ignore"` or `{"call":"TNC:\\oem\\m25.h"}`.
std::optional<BuilderAction> read_action(const JsonValue& value, const std::string& pointer,
                                         FieldErrors& errors) {
  if (value.is(Kind::String) && value.text == "ignore") return BuilderAction{};
  const JsonValue* call = value.is(Kind::Object) ? value.find("call") : nullptr;
  if (call == nullptr || !call->is(Kind::String) || value.members.size() != 1) {
    errors.add(ErrorCode::FieldInvalid, pointer,
               R"(takes "ignore" or {"call":"TNC:\\oem\\name.h"}, the program that stands for it)");
    return std::nullopt;
  }
  auto path = interpreter::ControlPath::parse(call->text);
  if (!path) {
    errors.add(path.error().code, pointer_to(pointer, "call"), path.error().message);
    return std::nullopt;
  }
  return BuilderAction{*std::move(path)};
}

/// @param is_known which numbers are the control's own, and stay so.
template <class IsKnown>
void read_actions(const JsonValue& parent, const std::string& parent_pointer,
                  std::string_view member, const IsKnown& is_known,
                  std::map<int, BuilderAction>& actions, FieldErrors& errors) {
  const JsonValue* object = parent.find(member);
  if (object == nullptr) return;
  const std::string pointer = pointer_to(parent_pointer, member);
  if (!object->is(Kind::Object) || object->members.size() > kMostActions) {
    errors.add(ErrorCode::FieldType, pointer,
               fmt::format("must be an object of at most {} numbers", kMostActions));
    return;
  }
  for (const auto& [name, value] : object->members) {
    const std::string where = pointer_to(pointer, name);
    const auto number = number_of(name);
    if (!number) {
      errors.add(ErrorCode::FieldInvalid, where,
                 fmt::format("must have a number from 0 to {}", kLargestNumber));
    } else if (is_known(*number)) {
      errors.add(ErrorCode::FieldInvalid, where,
                 fmt::format("{} is the control's own and cannot be replaced", *number));
    } else if (auto action = read_action(value, where, errors)) {
      actions.insert_or_assign(*number, *std::move(action));
    }
  }
}

bool is_known_cycle(int number) {
  for (const auto family : {klartext::CycleFamily::CyclDef, klartext::CycleFamily::TchProbe}) {
    for (const bool dotted : {false, true}) {
      if (interpreter::is_available(family, number, dotted)) return true;
    }
  }
  return false;
}

void read_separator(const JsonValue& setup, const std::string& pointer,
                    interpreter::RunOptions& options, FieldErrors& errors) {
  const JsonValue* separator = setup.find("decimal_separator");
  if (separator == nullptr) return;
  if (separator->is(Kind::String) && (separator->text == "comma" || separator->text == "point")) {
    options.decimal_comma = separator->text == "comma";
  } else {
    errors.add(ErrorCode::FieldInvalid, pointer_to(pointer, "decimal_separator"),
               "must be \"comma\" or \"point\"");
  }
}

/// A path of the control followed by `added`.
void read_path(const JsonValue& setup, const std::string& pointer, std::string_view member,
               std::string_view added, std::optional<interpreter::ControlPath>& to,
               FieldErrors& errors) {
  const JsonValue* written = setup.find(member);
  if (written == nullptr) return;
  const std::string where = pointer_to(pointer, member);
  if (!written->is(Kind::String)) {
    errors.add(ErrorCode::FieldType, where, "must be a text such as TNC:\\logs");
    return;
  }
  auto path = interpreter::ControlPath::parse(written->text + std::string(added));
  if (path) {
    to = *std::move(path);
  } else {
    errors.add(path.error().code, where, path.error().message);
  }
}

}  // namespace

bool read_numbers(const JsonValue& array, const std::string& pointer, std::span<double> to,
                  bool are_lengths, FieldErrors& errors) {
  if (array.items.size() != to.size()) {
    errors.add(ErrorCode::FieldInvalid, pointer,
               fmt::format("must be {} numbers; got {}", to.size(), array.items.size()));
    return false;
  }
  // The elements as members of an object, whose names are then the tokens of their pointers.
  JsonValue object{.kind = JsonValue::Kind::Object};
  for (std::size_t i = 0; i < to.size(); ++i)
    object.members.emplace_back(std::to_string(i), array.items[i]);
  FieldReader element(object, pointer, errors);
  for (std::size_t i = 0; i < to.size(); ++i) {
    const std::string& index = object.members[i].first;
    are_lengths ? Mm{}.read(element, index, to[i]) : Number{}.read(element, index, to[i]);
  }
  return true;
}

bool PointList::read(FieldReader& fields, std::string_view name,
                     std::vector<machine::Vec3>& to) const {
  const JsonValue* const array = fields.array(name);
  if (array == nullptr) return false;
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    const std::string pointer = pointer_to(fields.at(name), i);
    const JsonValue& item = array->items[i];
    std::array<double, 3> point{};
    if (!item.is(JsonValue::Kind::Array)) {
      fields.errors().add(ErrorCode::FieldType, pointer,
                          fmt::format("must be an array; got {}", name_of(item.kind)));
    } else if (read_numbers(item, pointer, point, true, fields.errors())) {
      to.push_back({point[0], point[1], point[2]});
    }
  }
  return true;
}

bool DiskFile::read(FieldReader& fields, std::string_view name, std::string& to) const {
  const auto given = fields.text(name);
  if (!given) return false;
  const auto parsed = app::parse_file_path(*given);
  if (parsed) {
    to = parsed->text();
  } else {
    fields.report(parsed.error().code, name, parsed.error().message);
  }
  return parsed.has_value();
}

std::string builder_actions_schema() {
  const std::string call = schema::object(
      {{"call", schema::text(), "The program that replaces it"}}, schema::Others::Refused);
  return schema::map(schema::one_of({schema::words({"ignore"}), call}));
}

std::string decimal_separator_schema() { return schema::words({"comma", "point"}); }

void decode_builder(const JsonValue& setup, const std::string& pointer,
                    interpreter::RunOptions& options, FieldErrors& errors) {
  if (!setup.is(Kind::Object)) return;
  const auto read = [&](const JsonValue& parent, const std::string& where) {
    read_actions(parent, where, "m_functions", interpreter::is_m_function,
                 options.builder.m_functions, errors);
    read_actions(parent, where, "cycles", is_known_cycle, options.builder.cycles, errors);
  };
  if (const JsonValue* machine = setup.find("machine"); machine != nullptr) {
    if (machine->is(Kind::Object)) read(*machine, pointer_to(pointer, "machine"));
  }
  read(setup, pointer);
  read_separator(setup, pointer, options, errors);
  read_path(setup, pointer, "fn16_default_path", "\\log", options.print_folder, errors);
  read_path(setup, pointer, "active_datum_table", "", options.datum_table, errors);
}

}  // namespace fitgauge::api
