#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "plant/folder/folder_in.hpp"
#include "plant/folder/folder_path.hpp"
#include "record/measurement_row_fields.hpp"

namespace fitgauge::connections {
namespace {

using api::FieldErrors;
using api::FieldReader;

constexpr std::size_t kMostNames = 20;
constexpr std::size_t kMostWords = 200;
constexpr std::size_t kLongestGlob = 100;

bool is_field(std::string_view name) {
  return std::any_of(api::kRowFields.begin(), api::kRowFields.end(),
                     [&](const api::RowField& field) { return field.name == name; });
}

void read_files(FieldReader& fields, FieldErrors& errors, FolderInOptions& options) {
  if (!fields.has("names")) return;
  const JsonValue* const list = fields.array("names");
  if (list == nullptr) return;
  options.names.clear();
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const JsonValue& item = list->items[i];
    const bool is_glob = item.is(JsonValue::Kind::String) && !item.text.empty() &&
                         item.text.size() <= kLongestGlob &&
                         item.text.find('/') == std::string::npos;
    if (is_glob) {
      options.names.push_back(item.text);
    } else {
      errors.add(ErrorCode::FieldInvalid, pointer_to(fields.at("names"), i),
                 "a name of files without a folder, which may have * and ?: *.csv");
    }
  }
  if (list->items.empty() || list->items.size() > kMostNames) {
    fields.report(ErrorCode::FieldInvalid, "names", fmt::format("1 to {} names", kMostNames));
  }
}

/// An object of texts.
sheet::Words read_words(std::string_view name, FieldReader& fields, FieldErrors& errors) {
  sheet::Words words;
  if (!fields.has(name)) return words;
  const JsonValue* const object = fields.object(name);
  if (object == nullptr) return words;
  if (object->members.size() > kMostWords) {
    fields.report(ErrorCode::FieldInvalid, name, fmt::format("at most {} of them", kMostWords));
    return words;
  }
  for (const auto& [key, value] : object->members) {
    if (value.is(JsonValue::Kind::String) || value.is(JsonValue::Kind::Number)) {
      words.emplace_back(key, value.text);
    } else {
      errors.add(ErrorCode::FieldType, pointer_to(fields.at(name), key), "a text is wanted");
    }
  }
  return words;
}

void check_columns(const sheet::Words& columns, FieldReader& fields, FieldErrors& errors) {
  for (const auto& [from, to] : columns) {
    if (to.empty() || to == "date" || to == "time" || is_field(to)) continue;
    errors.add(ErrorCode::FieldInvalid, pointer_to(fields.at("map"), from),
               fmt::format("there is no field {}; an empty text leaves the column out",
                           first_characters(to, 100)));
  }
}

void check_constants(const sheet::Words& constants, FieldReader& fields, FieldErrors& errors) {
  for (const auto& [field, value] : constants) {
    if (is_field(field) && field != "measured_mm") continue;
    errors.add(
        ErrorCode::FieldInvalid, pointer_to(fields.at("set"), field),
        fmt::format("{} is no field that all rows can have alike", first_characters(field, 100)));
  }
}

void read_zone(FieldReader& fields, FolderInOptions& options) {
  const auto name = fields.optional_text("time_zone");
  if (!name) return;
  auto zone = sheet::TimeZone::load(*name);
  if (zone) {
    options.csv.zone = *std::move(zone);
  } else {
    fields.report(ErrorCode::FieldInvalid, "time_zone", zone.error().message);
  }
}

}  // namespace

FolderInOptions read_folder_in(std::string_view name, const FolderPermissions& allowed,
                               FieldReader& fields, FieldErrors& errors) {
  FolderInOptions options;
  options.name = name;
  options.folder = read_path("folder", allowed, fields);
  read_files(fields, errors, options);
  options.csv.columns = read_words("map", fields, errors);
  check_columns(options.csv.columns, fields, errors);
  options.csv.constants = read_words("set", fields, errors);
  check_constants(options.csv.constants, fields, errors);
  read_zone(fields, options);
  if (const auto word = fields.optional_text("encoding")) {
    const auto encoding = sheet::encoding_from_word(*word);
    options.csv.encoding = encoding.value_or(options.csv.encoding);
    if (!encoding) {
      fields.report(ErrorCode::FieldInvalid, "encoding",
                    "encoding is auto, utf-8, utf-16 or windows-1252");
    }
  }
  if (const auto unit = fields.optional_text("length_unit")) {
    options.length_unit = aqdef::length_unit(*unit);
    if (!options.length_unit) {
      fields.report(ErrorCode::FieldInvalid, "length_unit",
                    "length_unit is mm, \xC2\xB5m, cm, m or inch");
    }
  }
  const auto others = fields.optional_text("other_columns");
  options.csv.leaves_out_others = others == "leave_out";
  if (others && *others != "leave_out" && *others != "refuse") {
    fields.report(ErrorCode::FieldInvalid, "other_columns", "other_columns is refuse or leave_out");
  }
  options.interval =
      std::chrono::seconds(fields.integer_or("interval_s", options.interval.count(), 1, 3600));
  options.rest = std::chrono::seconds(fields.integer_or("rest_s", options.rest.count(), 1, 3600));
  return options;
}

}  // namespace fitgauge::connections
