#pragma once

#include "base/json/body_forms.hpp"
#include "nc/run/interpreter.hpp"
#include "service/runs/control_files.hpp"

namespace fitgauge::api {

// Forms of a setup's members: lengths are exact decimals in mm or µm, and doubles in the machine.

using Mm = Millimetres;
using Um = Micrometres;

/// Reads an array of as many numbers as there is room for.
bool read_numbers(const JsonValue& array, const std::string& pointer, std::span<double> to,
                  bool are_lengths, FieldErrors& errors);

/// Numbers in an array of their size; of a point or a vector three.
template <std::size_t size, bool are_lengths>
struct NumbersForm {
  std::string schema(Side) const {
    return schema::array(are_lengths ? schema::exact() : schema::number(), size, size);
  }
  bool read(FieldReader& fields, std::string_view name, std::array<double, size>& to) const {
    const JsonValue* array = fields.array(name);
    return array != nullptr &&
           read_numbers(*array, fields.at(name), to, are_lengths, fields.errors());
  }
  bool read(FieldReader& fields, std::string_view name, machine::Vec3& to) const {
    std::array<double, 3> values{to.x, to.y, to.z};
    const bool is_read = read(fields, name, values);
    to = {values[0], values[1], values[2]};
    return is_read;
  }
  template <class Values>
  void write(JsonWriter& json, const Values& from) const {
    json.begin_array();
    for (std::size_t i = 0; i < size; ++i) json.value(from[i]);
    json.end_array();
  }
};
using Mm2 = NumbersForm<2, true>;
using Mm3 = NumbersForm<3, true>;
using Numbers2 = NumbersForm<2, false>;
using Numbers3 = NumbersForm<3, false>;

/// Points in mm.
struct PointList {
  std::string schema(Side side) const { return schema::array(Mm3{}.schema(side)); }
  bool read(FieldReader& fields, std::string_view name, std::vector<machine::Vec3>& to) const;
};

/// A file of the control's disk, in either form; read as TNC:\...
struct DiskFile {
  std::string schema(Side) const { return schema::text(); }
  bool read(FieldReader& fields, std::string_view name, std::string& to) const;
};

/// List of words; the variables show for each word if the list has it.
template <std::size_t size>
struct SomeOf : std::array<std::string_view, size> {
  std::string schema(Side) const {
    return schema::array(schema::words({this->begin(), this->end()}));
  }
  bool read(FieldReader& fields, std::string_view name, std::array<bool, size>& to) const {
    const JsonValue* list = fields.array(name);
    if (list == nullptr) return false;
    to.fill(false);
    for (const JsonValue& item : list->items) {
      const auto found = item.is(JsonValue::Kind::String)
                             ? std::find(this->begin(), this->end(), item.text)
                             : this->end();
      if (found == this->end()) {
        fields.report(ErrorCode::FieldInvalid, name, "{} must be a list of \"{}\"", name,
                      fmt::join(this->begin(), this->end(), "\", \""));
        return false;
      }
      to[static_cast<std::size_t>(found - this->begin())] = true;
    }
    return true;
  }
};

/// A member that is read elsewhere.
struct Elsewhere {
  std::string json;

  std::string schema(Side) const { return json; }
  bool read(FieldReader& fields, std::string_view name, const auto&) const {
    return fields.optional(name) != nullptr;
  }
};

/// Schemas of the members that decode_builder reads.
std::string builder_actions_schema();
std::string decimal_separator_schema();

/// Names `m_functions` and `cycles`, which decode_builder reads.
void builder_members(auto& v) {
  std::nullptr_t elsewhere{};
  const Elsewhere actions{builder_actions_schema()};
  v.optional("m_functions", elsewhere, actions,
             "M functions of the machine's builder, by number: `ignore`, or an object "
             "whose `call` is the program that replaces the function");
  v.optional("cycles", elsewhere, actions,
             "Cycles of the machine's builder, by number: `ignore`, or an object with `call`");
}

/// Names `decimal_separator` and the two paths, which decode_builder reads.
void printing_members(auto& v) {
  std::nullptr_t elsewhere{};
  v.optional("decimal_separator", elsewhere, Elsewhere{decimal_separator_schema()},
             "Decimal separator of FN 15 (default: comma)");
  v.optional("fn16_default_path", elsewhere, Elsewhere{schema::text()},
             "fn16DefaultPath: the folder, such as `TNC:\\logs`, of logs and of files that FN 16 "
             "names without a folder (default: the folder of the program)");
  v.optional(
      "active_datum_table", elsewhere, Elsewhere{schema::text()},
      "The datum table that is active at the start, such as `TNC:\\table\\zero.d` (default: none)");
}

/// The part of a setup that belongs to the run and not to the machine: `m_functions` and `cycles`
/// of the machine builder, the `decimal_separator` of FN 15, the `fn16_default_path` and the
/// `active_datum_table`. The tables are in the setup, or in its `machine`. Errors go to `errors`.
void decode_builder(const JsonValue& setup, const std::string& pointer,
                    interpreter::RunOptions& options, FieldErrors& errors);

/// Reads a machine setup and adds the rows of the control's tables; missing members have the
/// default of the contract. Errors go to `errors` with their JSON pointer below `pointer`; the
/// setup is then unusable.
machine::Setup decode_setup(const JsonValue& body, const std::string& pointer,
                            const app::ControlTables& tables, FieldErrors& errors);

}  // namespace fitgauge::api
