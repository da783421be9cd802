#pragma once

#include <string>

#include "api/runs/setup_forms.hpp"
#include "base/json/field_reader.hpp"
#include "nc/run/interpreter.hpp"

namespace fitgauge::api {

/// The schemas of what decode_builder reads.
std::string builder_actions_schema();
std::string decimal_separator_schema();

/// Names `m_functions` and `cycles`, which decode_builder reads.
void builder_members(auto& v) {
  std::nullptr_t elsewhere{};
  const Elsewhere actions{builder_actions_schema()};
  v.optional("m_functions", elsewhere, actions,
             "Of the machine's builder, by number: `ignore`, or an object "
             "whose `call` is the program that stands for it");
  v.optional("cycles", elsewhere, actions, "Of the machine's builder, likewise");
}

/// Names `decimal_separator`, `fn16_default_path` and `active_datum_table`, which decode_builder
/// reads.
void printing_members(auto& v) {
  std::nullptr_t elsewhere{};
  v.optional("decimal_separator", elsewhere, Elsewhere{decimal_separator_schema()},
             "Of FN 15; comma when absent");
  v.optional("fn16_default_path", elsewhere, Elsewhere{schema::text()},
             "fn16DefaultPath: the folder, such as `TNC:\\logs`, of logs and of files that "
             "FN 16 names without a folder; that of the program when absent");
  v.optional("active_datum_table", elsewhere, Elsewhere{schema::text()},
             "The datum table that is active at the start, such as `TNC:\\table\\zero.d`; none "
             "when absent");
}

/// What of a setup belongs to the run and not to the machine: `m_functions` and `cycles` of the
/// machine builder, the `decimal_separator` of FN 15, the `fn16_default_path` and the
/// `active_datum_table`. The tables stand in the setup, or below its `machine`. What cannot be
/// accepted goes to `errors`.
void decode_builder(const JsonValue& setup, const std::string& pointer,
                    interpreter::RunOptions& options, FieldErrors& errors);

}  // namespace fitgauge::api
