#include "base/json/body_forms.hpp"

namespace fitgauge::api {

bool Text::read(FieldReader& fields, std::string_view name, std::string& to) const {
  auto given = fields.text(name);
  if (!given) return false;
  const bool fits = longest == 0 || given->size() <= longest;
  if (fits) {
    to = *std::move(given);
  } else {
    fields.report(ErrorCode::FieldTooLong, name,
                  fmt::format("{} takes at most {} bytes", name, longest));
  }
  return fits;
}

std::string Integer::schema(Side) const {
  const bool is_count = least == 0 && most == std::numeric_limits<std::int64_t>::max();
  return is_count ? schema::count() : schema::integer(least, most);
}

std::string Number::schema(Side) const {
  return is_open ? schema::number_between(least, most) : schema::number(least, most);
}

bool Number::read(FieldReader& fields, std::string_view name, double& to) const {
  const auto given = fields.number(name);
  if (!given) return false;
  const bool fits = is_open ? *given > least && *given < most : *given >= least && *given <= most;
  if (fits) {
    to = *given;
  } else {
    fields.report(ErrorCode::FieldInvalid, name,
                  is_open ? fmt::format("{} lies between {} and {}", name, least, most)
                          : fmt::format("{} lies from {} to {}", name, least, most));
  }
  return fits;
}

}  // namespace fitgauge::api
