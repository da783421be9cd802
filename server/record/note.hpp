#pragma once

#include <concepts>

#include "base/json/body_forms.hpp"
#include "record/measurement.hpp"

// A note in responses, in events and on its way to the centre.

namespace fitgauge::api {

/// The form of a text that is not blank.
struct NoteText {
  std::size_t longest = 200;  ///< bytes of a cause, a measure, a name

  std::string schema(Side) const { return schema::text(longest); }
  /// @param what the text, as the error names it
  void check(FieldErrors& errors, const std::string& at, std::string_view what,
             std::string_view text) const {
    const auto refuse = [&](ErrorCode code, std::string_view condition) {
      errors.add(code, at, fmt::format("{} must {}", what, condition));
    };
    if (text.size() > longest) {
      refuse(ErrorCode::FieldTooLong, fmt::format("have at most {} bytes", longest));
    } else if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
      refuse(ErrorCode::FieldInvalid, "not be blank");
    } else if (text.find('\0') != std::string_view::npos) {
      refuse(ErrorCode::FieldInvalid, "not contain a NUL character");
    }
  }
  bool read(FieldReader& fields, std::string_view name, std::string& to) const {
    auto given = fields.text(name);
    if (!given) return false;
    check(fields.errors(), fields.at(name), name, *given);
    to = *std::move(given);
    return true;
  }
  void write(JsonWriter& json, std::string_view from) const { json.value(from); }
};

/// The texts of a note from the caller.
void given_members(auto& v, auto& note) {
  v.optional("cause", note.cause, NoteText{}, "Cause of the value");
  v.optional("measure", note.measure, NoteText{}, "Action after the value");
  v.optional("text", note.text, NoteText{2000}, "Free text; one of the three is required");
  v.optional("operator", note.operator_id, NoteText{}, "Author of the note");
}

template <class N>
requires std::same_as<std::remove_const_t<N>, app::Note>
void members(auto& v, N& note) {
  v.member("id", note.id, "Opaque id, without an order");
  v.member("measurement_id", note.measurement, "The record of the note");
  given_members(v, note);
  v.optional("caller", note.caller, "Name of the key that stored the note");
  v.member("received_at", note.received_at, Time{}, "Time in UTC");
}

}  // namespace fitgauge::api
