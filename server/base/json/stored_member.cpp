#include "base/json/stored_member.hpp"

#include <fmt/format.h>
#include <simdjson.h>

namespace fitgauge::api {
namespace {

namespace ondemand = simdjson::ondemand;

simdjson::error_code find(ondemand::document& document, std::string_view name,
                          std::string_view& text) {
  ondemand::value value;
  if (const auto failure = document.find_field(name).get(value)) return failure;
  ondemand::array list;
  if (value.get_array().get(list) == simdjson::SUCCESS) return list.raw_json().get(text);
  ondemand::object members;
  if (const auto failure = value.get_object().get(members)) return failure;
  return members.raw_json().get(text);
}

}  // namespace

Result<std::string> stored_member(std::string_view object, std::string_view name,
                                  std::string_view what) {
  ondemand::parser parser;
  const simdjson::padded_string padded(object);
  ondemand::document document;
  std::string_view found;
  auto failure = parser.iterate(padded).get(document);
  if (failure == simdjson::SUCCESS) failure = find(document, name, found);
  if (failure == simdjson::NO_SUCH_FIELD) return std::string();
  if (failure == simdjson::SUCCESS) return std::string(found);
  return Error{ErrorCode::StorageCorrupt,
               fmt::format("the stored {} cannot be read ({}); restore a backup or delete it", what,
                           simdjson::error_message(failure))};
}

}  // namespace fitgauge::api
