#include "plant/mtconnect/mtconnect_document.hpp"

namespace fitgauge::mtconnect {
namespace {

/// An attribute and its text.
using Condition = std::pair<std::string_view, std::string_view>;

struct Step {
  bool is_anywhere = false;  ///< after `//`
  std::string_view name;
  /// Alternatives; each is a list of conditions that must all hold. Empty: no condition.
  std::vector<std::vector<Condition>> any{};
};

/// An element as a step sees it.
struct Place {
  std::string_view name;
  std::vector<Condition> attributes{};
};

class PathReader {
 public:
  explicit PathReader(std::string_view text) : rest_(text) {}

  /// Reads the steps; none if the text is not a path.
  std::optional<std::vector<Step>> read() {
    std::vector<Step> steps;
    while (!rest_.empty()) {
      Step step;
      if (!take("/")) return std::nullopt;
      step.is_anywhere = take("/");
      step.name = take("*") ? "*" : name();
      if (step.name.empty()) return std::nullopt;
      while (take("[")) {
        if (!conditions(step)) return std::nullopt;
      }
      steps.push_back(std::move(step));
    }
    return steps.empty() ? std::nullopt : std::optional(std::move(steps));
  }

 private:
  bool take(std::string_view text) {
    if (!rest_.starts_with(text)) return false;
    rest_.remove_prefix(text.size());
    return true;
  }
  void blanks() {
    while (take(" ")) {
    }
  }
  /// Reads a name without its prefix: `DataItem` of `m:DataItem`.
  std::string_view name() {
    const auto word = [this] {
      const auto end = std::ranges::find_if_not(
          rest_, [](char c) { return is_ascii_alphanumeric(c) || c == '_'; });
      const std::string_view found = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
      rest_.remove_prefix(found.size());
      return found;
    };
    const std::string_view first = word();
    return take(":") ? word() : first;
  }
  std::optional<Condition> condition() {
    blanks();
    if (!take("@")) return std::nullopt;
    Condition read(name(), "");
    blanks();
    if (!take("=")) return std::nullopt;
    blanks();
    const char quote = rest_.empty() ? '\0' : rest_.front();
    const std::size_t end = quote == '"' || quote == '\'' ? rest_.find(quote, 1) : rest_.npos;
    if (end == rest_.npos) return std::nullopt;
    read.second = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    blanks();
    return read;
  }
  bool conditions(Step& step) {
    if (!step.any.empty()) return false;  // one pair of brackets a step
    step.any.emplace_back();
    for (;;) {
      auto read = condition();
      if (!read) return false;
      step.any.back().push_back(*read);
      if (take("]")) return true;
      if (take("or ")) {
        step.any.emplace_back();
      } else if (!take("and ")) {
        return false;
      }
    }
  }

  std::string_view rest_;
};

bool is_met(const Step& step, const Place& place) {
  if (step.name != "*" && step.name != place.name) return false;
  const auto is_there = [&place](const Condition& condition) {
    return std::ranges::find(place.attributes, condition) != place.attributes.end();
  };
  return step.any.empty() || std::ranges::any_of(step.any, [&](const auto& all) {
           return std::ranges::all_of(all, is_there);
         });
}

/// Whether the steps from `step` on lead from below `at` to the item, or to a parent of it.
bool leads(const std::vector<Step>& steps, std::size_t step, const std::array<Place, 5>& places,
           std::size_t at) {
  if (step == steps.size()) return true;
  const std::size_t last =
      steps[step].is_anywhere ? places.size() : std::min(at + 1, places.size());
  for (std::size_t place = at; place < last; ++place) {
    if (is_met(steps[step], places[place]) && leads(steps, step + 1, places, place + 1))
      return true;
  }
  return false;
}

}  // namespace

Result<Selection> select(std::string_view path) {
  Selection selection;
  for (std::string_view rest = path;;) {
    const std::size_t bar = std::min(rest.find('|'), rest.size());
    const auto steps = PathReader(trim(rest.substr(0, bar))).read();
    if (!steps) {
      return Error{ErrorCode::QueryInvalid,
                   fmt::format("path must be XPath such as //DataItem[@type=\"PART_ID\"]; got '{}'",
                               first_characters(path, 100)),
                   "path"};
    }
    for (std::size_t i = 0; i < kDataItems.size(); ++i) {
      const DataItem& item = kDataItems.at(i);
      std::array<Place, 5> places = {
          {{"MTConnectDevices"},
           {"Devices"},
           {"Device", {{"name", "Gauge"}, {"id", "gauge"}}},
           {"DataItems"},
           {"DataItem", {{"id", item.id}, {"type", item.type}, {"category", "EVENT"}}}}};
      if (!item.sub_type.empty()) places[4].attributes.emplace_back("subType", item.sub_type);
      if (leads(*steps, 0, places, 0)) selection.set(i);
    }
    if (bar == rest.size()) break;
    rest.remove_prefix(bar + 1);
  }
  if (selection.any()) return selection;
  return Error{ErrorCode::QueryInvalid,
               fmt::format("path '{}' names nothing of the device Gauge: see /mtconnect/probe",
                           first_characters(path, 100)),
               "path"};
}

}  // namespace fitgauge::mtconnect
