#include "formats/step/values.hpp"

#include "base/text.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::step {
namespace {

/// Millimetres of a metre with a prefix of SI_UNIT.
constexpr std::array<std::pair<std::string_view, double>, 7> kMetres = {{
    {"", 1e3},
    {".MILLI.", 1},
    {".CENTI.", 10},
    {".DECI.", 100},
    {".MICRO.", 1e-3},
    {".NANO.", 1e-6},
    {".KILO.", 1e6},
}};

}  // namespace

std::vector<Parameter> record_of(const Part21& file, std::uint32_t id, std::string_view name,
                                 std::uint32_t from) {
  if (id == 0) return {};
  for (const Record& each : file.records(id, from != 0 ? from : id)) {
    if (each.name == name) return file.parameters(each.list);
  }
  return {};
}

std::string text_in(const Part21& file, std::uint32_t id, std::string_view name, std::size_t at,
                    std::uint32_t from) {
  const auto all = record_of(file, id, name, from);
  // Many entries may share one long text.
  constexpr std::size_t kLongestText = 1000;
  std::string text = at < all.size() ? std::string(trim(text_of(all[at]))) : std::string();
  text.resize(first_characters(text, kLongestText).size());
  return text;
}

std::vector<std::uint32_t> references_in(const Part21& file, const Parameter& in) {
  if (in.is(Kind::Reference)) return {in.id};
  std::vector<std::uint32_t> found;
  if (!in.is(Kind::List) && !in.is(Kind::Typed)) return found;
  for (const Parameter& item : file.parameters(in.text)) {
    const auto more = references_in(file, item);
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

double Values::millimetres(std::uint32_t id, std::uint32_t from, int deep) {
  if (const auto known = units_.find(id); known != units_.end()) return known->second;
  double factor = 0;
  for (const Record& each : file_.records(id, from)) {
    const auto all = file_.parameters(each.list);
    if (each.name == "SI_UNIT" && all.size() >= 2 && all.back().text == ".METRE.") {
      const Parameter& prefix = all[all.size() - 2];
      const auto found = std::find_if(kMetres.begin(), kMetres.end(), [&](const auto& p) {
        return p.first == (prefix.is(Kind::Word) ? prefix.text : std::string_view());
      });
      if (found != kMetres.end()) factor = found->second;
    } else if (each.name == "CONVERSION_BASED_UNIT" && !all.empty() &&
               all.back().is(Kind::Reference) && deep > 0) {
      const Value found = read(all.back().id, id, deep - 1);
      factor = found.number * found.unit;
    }
  }
  if (!(factor > 0) || !std::isfinite(factor)) {
    file_.fail(from, fmt::format("#{} has the unit #{}, which is not a length: export the file "
                                 "with lengths in mm or inch",
                                 from, id));
  }
  units_[id] = factor;
  return factor;
}

Value Values::read(std::uint32_t id, std::uint32_t from, int deep) {
  Value found;
  for (const Record& each : file_.records(id, from)) {
    const auto all = file_.parameters(each.list);
    if (each.name.ends_with("REPRESENTATION_ITEM") && !all.empty() && all[0].is(Kind::Text))
      found.name = trim(text_of(all[0]));
    if (each.name == "QUALIFIED_REPRESENTATION_ITEM" && !all.empty()) {
      for (const std::uint32_t qualifier : references_in(file_, all[0]))
        qualify(qualifier, id, found);
    }
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      if (all[i].is(Kind::Typed) && all[i + 1].is(Kind::Reference))
        measure(all[i], all[i + 1].id, id, deep, found);
    }
  }
  if (found.unit == 0) return found;
  const auto length = [&](double number) -> std::optional<Length> {
    const auto read = Length::nearest_mm(number * found.unit);
    if (read && *read <= api::kLargestMeasured && *read >= -api::kLargestMeasured) return *read;
    file_.fail(id, fmt::format("#{} is a length beyond 100 km: export the file again", id));
    return std::nullopt;
  };
  found.exact = found.length = length(found.number);
  if (found.decimals) {
    // A half rounds to the even digit in inches (ASME Y14.5), up in millimetres.
    constexpr double kNoise = 1e6;
    const double tens = std::pow(10, *found.decimals);
    const double scaled = std::round(found.number * tens * kNoise) / kNoise;
    found.length = length((found.unit == 1 ? std::round(scaled) : std::nearbyint(scaled)) / tens);
  }
  return found;
}

/// `maximum`, or a format: `NR2 1.3` has three decimals.
void Values::qualify(std::uint32_t id, std::uint32_t from, Value& to) {
  constexpr int kMostDecimals = 6;
  if (auto word = text_in(file_, id, "TYPE_QUALIFIER", 0, from); !word.empty())
    to.qualifier = std::move(word);
  const std::string format = text_in(file_, id, "VALUE_FORMAT_TYPE_QUALIFIER", 0, from);
  int decimals = -1;
  if (const auto point = format.rfind('.');
      format.starts_with("NR2 ") && point != std::string::npos)
    std::from_chars(format.data() + point + 1, format.data() + format.size(), decimals);
  if (decimals >= 0 && decimals <= kMostDecimals) to.decimals = decimals;
}

void Values::measure(const Parameter& typed, std::uint32_t unit, std::uint32_t id, int deep,
                     Value& to) {
  const std::string_view type = typed.text.substr(0, typed.text.find_first_of("( "));
  const auto number = file_.parameters(typed.text);
  if (!type.ends_with("LENGTH_MEASURE") || number.size() != 1) return;
  to.number = number_of(number[0]);
  to.unit = millimetres(unit, id, deep);
}

}  // namespace fitgauge::step
