#include "base/json/body_forms.hpp"

namespace fitgauge::api {

bool Text::read(FieldReader& fields, std::string_view name, std::string& to) const {
  auto given = fields.text(name);
  if (!given) return false;
  const bool fits = longest == 0 || given->size() <= longest;
  if (fits) {
    to = *std::move(given);
  } else {
    fields.report(ErrorCode::FieldTooLong, name, "{} must have at most {} bytes", name, longest);
  }
  return fits;
}

bool Time::read(FieldReader& fields, std::string_view name, Timestamp& to) const {
  const auto given = fields.text(name);
  if (!given) return false;
  const auto time = parse_rfc3339(*given);
  if (time) to = *time;
  if (!time) fields.report(time.error().code, name, time.error().message);
  return time.has_value();
}

bool Word::read(FieldReader& fields, std::string_view name, std::string& to) const {
  auto given = fields.text(name);
  if (!given) return false;
  if (*given != word) fields.report(ErrorCode::FieldInvalid, name, "{} must be {}", name, word);
  to = *std::move(given);
  return to == word;
}

std::string Integer::schema(Side) const {
  const bool is_count = least == 0 && most == std::numeric_limits<std::int64_t>::max();
  return is_count ? schema::count() : schema::integer(least, most);
}

std::string Number::schema(Side) const {
  std::string json = schema::number();
  if (std::isfinite(least))
    json = schema::bounded(json, ends == Ends::Closed ? "minimum" : "exclusiveMinimum", least);
  if (std::isfinite(most))
    json = schema::bounded(json, ends == Ends::Open ? "exclusiveMaximum" : "maximum", most);
  return json;
}

bool Number::read(FieldReader& fields, std::string_view name, double& to) const {
  const auto given = fields.number(name);
  if (!given) return false;
  const bool fits = (ends == Ends::Closed ? *given >= least : *given > least) &&
                    (ends == Ends::Open ? *given < most : *given <= most);
  if (fits) {
    to = *given;
  } else {
    const std::string_view between =
        ends == Ends::Closed ? "must be from {} to {}" : "must be between {} and {}";
    const std::string wanted =
        must.empty() ? fmt::format(fmt::runtime(between), least, most) : std::string(must);
    fields.report(ErrorCode::FieldInvalid, name, "{} {}", name, wanted);
  }
  return fits;
}

std::optional<std::size_t> find_word(FieldReader& fields, std::string_view name,
                                     std::span<const std::string_view> words, bool is_listed) {
  const auto given = fields.text(name);
  if (!given) return std::nullopt;
  const auto found = std::ranges::find(words, *given);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  fields.report(ErrorCode::FieldInvalid, name,
                is_listed ? fmt::format("{} must be one of: {}", name, fmt::join(words, ", "))
                          : fmt::format("{} must be \"{}\"", name, fmt::join(words, "\" or \"")));
  return std::nullopt;
}

}  // namespace fitgauge::api
