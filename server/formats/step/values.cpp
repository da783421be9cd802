#include "formats/step/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"

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
  for (const Record& each : file.records(id, from != 0 ? from : id)) {
    if (each.name == name) return file.parameters(each.list);
  }
  return {};
}

std::string text_in(const Part21& file, std::uint32_t id, std::string_view name, std::size_t at,
                    std::uint32_t from) {
  const auto all = record_of(file, id, name, from);
  return at < all.size() ? std::string(trim(text_of(all[at]))) : std::string();
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
      factor = read(all.back().id, id, deep - 1).number;
    }
  }
  if (!(factor > 0) || !std::isfinite(factor)) {
    file_.fail(from, fmt::format("#{} has the unit #{}, which is no length: export the file with "
                                 "lengths in mm or inch",
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
      for (const std::uint32_t qualifier : references_in(file_, all[0])) {
        if (auto word = text_in(file_, qualifier, "TYPE_QUALIFIER", 0, id); !word.empty())
          found.qualifier = std::move(word);
      }
    }
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      if (all[i].is(Kind::Typed) && all[i + 1].is(Kind::Reference))
        measure(all[i], all[i + 1].id, id, deep, found);
    }
  }
  return found;
}

void Values::measure(const Parameter& typed, std::uint32_t unit, std::uint32_t id, int deep,
                     Value& to) {
  const std::string_view type = typed.text.substr(0, typed.text.find_first_of("( "));
  const auto number = file_.parameters(typed.text);
  if (!type.ends_with("LENGTH_MEASURE") || number.size() != 1) return;
  to.number = number_of(number[0]) * millimetres(unit, id, deep);
  const auto length = Length::nearest_mm(to.number);
  if (!length || *length > kLongest || *length < -kLongest) {
    return file_.fail(id, fmt::format("#{} is a length beyond 1000 km: export the file again", id));
  }
  to.length = *length;
}

}  // namespace fitgauge::step
