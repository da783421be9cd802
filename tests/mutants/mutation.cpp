#include "mutation.hpp"

#include <cctype>
#include <regex>

#include "nc/probing/cycles.hpp"
#include "nc/program/cycles.hpp"

namespace fitgauge::mutants {
namespace {

using probing::CycleDescriptor;
using probing::CycleFamily;

/// Physical lines that belong together: all but the last end with `~`.
struct Text {
  std::size_t at = 0;
  std::string text{};  ///< comments are blanks
  std::uint32_t first_line = 0;
  std::uint32_t last_line = 0;
  std::size_t length = 0;
};

std::vector<Text> blocks_of(std::string_view program) {
  std::vector<Text> blocks;
  bool goes_on = false;
  std::uint32_t number = 0;
  for (std::size_t at = 0; at < program.size();) {
    const std::size_t end = std::min(program.find('\n', at), program.size() - 1) + 1;
    std::string line(program.substr(at, end - at));
    ++number;
    const std::size_t last = line.find_last_not_of(" \r\n");
    const bool continues = last != line.npos && line[last] == '~';
    if (const std::size_t comment = line.find(';'); comment != line.npos)
      std::fill(line.begin() + static_cast<std::ptrdiff_t>(comment), line.end() - 1, ' ');
    if (!goes_on) blocks.push_back({at, "", number, number, 0});
    blocks.back().text += line;
    blocks.back().last_line = number;
    blocks.back().length = end - blocks.back().at;
    goes_on = continues;
    at = end;
  }
  return blocks;
}

/// A number that stands in a program.
struct Value {
  Edit place{};
  double value = 0;
  int parameter = 0;  ///< of the cycle that reads it
  const CycleDescriptor* cycle = nullptr;
  const probing::CycleParameter* meaning = nullptr;
};

std::string written(double value) { return fmt::format("{:+.10g}", value); }

const CycleDescriptor* descriptor(CycleFamily family, int number) {
  if (const auto* cycle = probing::find_cycle(family, number)) return &cycle->descriptor;
  const auto* cycle = interpreter::machining_cycle(number);
  return family == CycleFamily::CyclDef && cycle != nullptr ? &cycle->descriptor : nullptr;
}

/// The number of the cycle that a block defines.
struct Header {
  Edit number{};
  CycleFamily family{};
  int cycle = 0;
};

std::optional<Header> header(const Text& block) {
  static const std::regex kKlartext(R"((TCH PROBE|CYCL DEF) (\d+)(?![\d.]))");
  static const std::regex kIso(R"(\bG(2\d\d|4\d\d)\b)");
  std::smatch found;
  if (std::regex_search(block.text, found, kKlartext)) {
    const auto family = found[1] == "TCH PROBE" ? CycleFamily::TchProbe : CycleFamily::CyclDef;
    return Header{{block.at + static_cast<std::size_t>(found.position(2)),
                   static_cast<std::size_t>(found.length(2))},
                  family,
                  std::stoi(found[2])};
  }
  if (block.text.find("Q") != block.text.npos && std::regex_search(block.text, found, kIso)) {
    const int number = std::stoi(found[1]);
    const auto family = probing::find_cycle(CycleFamily::TchProbe, number) != nullptr
                            ? CycleFamily::TchProbe
                            : CycleFamily::CyclDef;
    return Header{{block.at + static_cast<std::size_t>(found.position(1)),
                   static_cast<std::size_t>(found.length(1))},
                  family,
                  number};
  }
  return std::nullopt;
}

void each_match(const std::string& text, const std::regex& pattern, const auto& use) {
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) use(*at);
}
Edit place(const Text& block, const std::smatch& found, std::size_t group) {
  return {block.at + static_cast<std::size_t>(found.position(group)),
          static_cast<std::size_t>(found.length(group))};
}

/// Inside and outside of the same shape.
constexpr std::array<std::array<int, 2>, 6> kTwins{
    {{408, 409}, {410, 411}, {412, 413}, {421, 422}, {423, 424}, {425, 426}}};

bool has(std::string_view text, std::string_view word) {
  return ascii_lower(text).find(word) != std::string::npos;
}

class Finder {
 public:
  Finder(std::string_view program, std::string_view reader) : blocks_(blocks_of(program)) {
    for (const Text& block : blocks_of(reader)) feed(block);
  }

  std::vector<Site> find() {
    for (const Text& block : blocks_) feed(block);
    for (const Text& block : blocks_) {
      block_ = &block;
      if (const auto cycle = header(block)) {
        look_at(*cycle);
      } else {
        look_at_other();
      }
    }
    add_unit();
    return std::move(sites_);
  }

 private:
  Site& add(Kind kind, std::function<std::vector<Edit>(Random&)> draw) {
    sites_.push_back({kind, block_->first_line, block_->last_line, std::move(draw)});
    return sites_.back();
  }
  Site& replace(Kind kind, Edit place, std::string by) {
    place.by = std::move(by);
    return add(kind, [place](Random&) { return std::vector{place}; });
  }

  /// Which parameters of cycles read a variable: `Q275=+QL2`.
  void feed(const Text& block) {
    static const std::regex kFed(R"(\bQ(\d+)\s*=\s*[+]?(Q[LR]?\d+)\b)");
    const auto cycle = header(block);
    const auto* known = cycle ? descriptor(cycle->family, cycle->cycle) : nullptr;
    if (known == nullptr) return;
    each_match(block.text, kFed, [&](const std::smatch& found) {
      fed_.try_emplace(found[2], std::pair(known, std::stoi(found[1])));
    });
  }

  void look_at(const Header& cycle) {
    static const std::regex kNumber(R"(\bQ(\d+)\s*=\s*([+-]?\d+(?:\.\d+)?)(?![\d.]))");
    const CycleDescriptor* known = descriptor(cycle.family, cycle.cycle);
    if (known == nullptr) return;
    std::vector<int> others;
    for (const auto* other : probing::cycles())
      if (other->descriptor.family == cycle.family && !other->descriptor.dotted)
        others.push_back(other->descriptor.number);
    if (cycle.family == CycleFamily::CyclDef)
      for (const auto& other : interpreter::machining_cycles())
        others.push_back(other.descriptor.number);
    std::erase(others, cycle.cycle);
    add(Kind::Cycle, [place = cycle.number, others](Random& random) mutable {
      place.by = std::to_string(others[random() % others.size()]);
      return std::vector{place};
    });
    for (const auto& twins : kTwins) {
      const auto* here = std::ranges::find(twins, cycle.cycle);
      if (cycle.family != CycleFamily::TchProbe || here == twins.end()) continue;
      exchange_side(cycle, here == twins.begin() ? twins[1] : twins[0]);
    }
    std::vector<Value> values;
    each_match(block_->text, kNumber, [&](const std::smatch& found) {
      const int number = std::stoi(found[1]);
      values.push_back({place(*block_, found, 2), std::stod(found[2]), number, known,
                        known->find(probing::q(number))});
    });
    for (std::size_t i = 0; i < values.size(); ++i) {
      look_at(values[i]);
      if (i > 0 && values[i].value != values[i - 1].value) swap(values[i - 1], values[i]);
    }
  }

  /// The block as it would be written for the other side, its dialog text and limits too.
  void exchange_side(const Header& cycle, int twin) {
    replace(Kind::BossForBore, cycle.number, std::to_string(twin));
    const CycleDescriptor* from = descriptor(cycle.family, cycle.cycle);
    const CycleDescriptor* to = descriptor(cycle.family, twin);
    std::vector<Edit> edits{{cycle.number.at, cycle.number.length, std::to_string(twin)}};
    static const std::regex kDialog(R"((?:PROBE|G)\s*\d+ ([A-Z][^~;\n]*[A-Z.]))");
    static const std::regex kName(R"(\bQ(\d+)\s*=)");
    std::smatch dialog;
    if (std::regex_search(block_->text, dialog, kDialog)) {
      edits.push_back(place(*block_, dialog, 1));
      edits.back().by = to->name;
    }
    each_match(block_->text, kName, [&](const std::smatch& found) {
      const auto is_it = [&](const auto& each) {
        return each.id == probing::q(std::stoi(found[1]));
      };
      const auto at = std::ranges::find_if(from->parameters, is_it) - from->parameters.begin();
      const auto index = static_cast<std::size_t>(at);
      if (index >= to->parameters.size() || index >= from->parameters.size()) return;
      edits.push_back(place(*block_, found, 1));
      edits.back().by = std::to_string(static_cast<int>(to->parameters[index].id));
    });
    add(Kind::BossForBore, [edits](Random&) { return edits; });
  }

  void look_at(const Value& value) {
    if (value.meaning == nullptr) return;
    const std::string_view meaning = value.meaning->meaning;
    const auto& range = value.meaning->range;
    const bool is_length = value.meaning->unit == probing::Unit::Length;
    const bool is_limit = is_length && (has(meaning, "maxim") || has(meaning, "minim") ||
                                        has(meaning, "toleran") || has(meaning, "limit"));
    if (value.value != 0) replace(Kind::Sign, value.place, written(-value.value));
    if (is_length && range.min < 0 && (has(meaning, "centre") || has(meaning, "point"))) {
      add(Kind::Centre, [value = value](Random& random) mutable {
        const double off = 0.2 + static_cast<double>(random() % 2981) * 0.01;
        value.place.by = written(value.value + (random() % 2 == 0 ? off : -off));
        return std::vector{value.place};
      });
    }
    if (is_limit && value.value != 0) {
      add(Kind::Limits, [value = value](Random& random) mutable {
        constexpr std::array kFactors{0.01, 0.1, 0.5, 2.0, 10.0, 100.0, 1000.0};
        value.place.by = written(value.value * kFactors[random() % kFactors.size()]);
        return std::vector{value.place};
      });
    }
    if (value.parameter == 272) {
      for (int axis = 1; axis <= 3; ++axis)
        if (axis != static_cast<int>(value.value)) replace(Kind::Axis, value.place, written(axis));
    }
    if (value.parameter == 260 || value.parameter == 204) {
      add(Kind::Retraction, [value = value](Random& random) mutable {
        value.place.by = written(-static_cast<double>(random() % 40));
        return std::vector{value.place};
      });
    }
  }

  void swap(const Value& a, const Value& b) {
    Site& site = add(Kind::Swap, [a, b](Random&) {
      return std::vector{Edit{a.place.at, a.place.length, written(b.value)},
                         Edit{b.place.at, b.place.length, written(a.value)}};
    });
    const bool is_limits = a.meaning != nullptr && b.meaning != nullptr &&
                           has(a.meaning->meaning, "maxim") && has(b.meaning->meaning, "minim");
    if (is_limits) {
      Site copy = site;
      copy.kind = Kind::Limits;
      sites_.push_back(std::move(copy));
    }
  }

  void look_at_other() {
    const std::string& text = block_->text;
    static const std::regex kTool(R"((?:TOOL CALL |^(?:N\d+ )?T)(\d+)\b)");
    static const std::regex kSet(
        R"(^\s*(?:N?\d+ )?(Q[LR]?\d+)\s*=\s*([+-]?\d+(?:\.\d+)?)\s*\*?\s*$)");
    static const std::regex kMotion(
        R"(^\s*(?:N?\d+ )?(?:L |TCH PROBE \d\.\d|G0[01] |CYCL DEF \d+\.\d |[XYZ][+-]))");
    static const std::regex kWord(R"(\bI?([XYZ])([+-]\d+(?:\.\d+)?)\b)");
    static const std::regex kBack(R"(^\s*(?:N?\d+ )?(?:L (?:R0 )?Z\+\S+ .*FMAX|G00 .*Z\+|.*M140))");
    std::smatch found;
    if (std::regex_search(text, found, kTool)) {
      const Edit tool = place(*block_, found, 1);
      for (const char* other : {"5", "77", "0", "31"})
        if (found[1] != other) replace(Kind::Tool, tool, other);
      replace(Kind::Tool, {block_->at, block_->length}, "");
      return;
    }
    if (std::regex_search(text, found, kSet)) {
      const auto fed = fed_.find(found[1]);
      if (fed == fed_.end()) return;
      const auto [cycle, number] = fed->second;
      const std::size_t first = sites_.size();
      look_at(Value{place(*block_, found, 2), std::stod(found[2]), number, cycle,
                    cycle->find(probing::q(number))});
      for (std::size_t i = first; i < sites_.size(); ++i) {
        sites_[i].target = found[1];
      }
      return;
    }
    if (!std::regex_search(text, found, kMotion)) return;
    if (std::regex_search(text, kBack)) replace(Kind::Retraction, {block_->at, block_->length}, "");
    each_match(text, kWord, [&](const std::smatch& each) {
      const double value = std::stod(each[2]);
      const Edit number = place(*block_, each, 2);
      if (value != 0) replace(Kind::Sign, number, written(-value));
      for (const char* axis : {"X", "Y", "Z"}) {
        if (text.find(std::string(axis) + "+") == text.npos &&
            text.find(std::string(axis) + "-") == text.npos)
          replace(Kind::Axis, place(*block_, each, 1), axis);
      }
    });
  }

  void add_unit() {
    static const std::regex kUnit(
        R"((?:(?:BEGIN|END) PGM \S+ |^(?:N\d+ )?%\S+ )(MM|INCH|G71|G70)\b)");
    const std::map<std::string, std::string> kOther{
        {"MM", "INCH"}, {"INCH", "MM"}, {"G71", "G70"}, {"G70", "G71"}};
    std::vector<Edit> edits;
    for (const Text& block : blocks_) {
      std::smatch found;
      if (!std::regex_search(block.text, found, kUnit)) continue;
      edits.push_back(place(block, found, 1));
      edits.back().by = kOther.at(found[1]);
      if (edits.size() == 1) block_ = &block;
    }
    if (edits.size() == 2) add(Kind::Unit, [edits](Random&) { return edits; });
  }

  std::vector<Text> blocks_;
  const Text* block_ = nullptr;
  std::map<std::string, std::pair<const CycleDescriptor*, int>> fed_;
  std::vector<Site> sites_;
};

}  // namespace

std::string_view word(Kind kind) {
  constexpr std::array<std::string_view, kKinds> kWords{
      "cycle",  "boss for bore", "sign",       "axis", "centre",
      "limits", "tool",          "retraction", "swap", "unit"};
  return kWords[static_cast<std::size_t>(kind)];
}

std::vector<Site> sites_of(std::string_view program, std::string_view reader) {
  return Finder(program, reader).find();
}

std::string edited(std::string_view program, std::vector<Edit> edits) {
  std::ranges::sort(edits, std::greater(), &Edit::at);
  std::string text(program);
  for (const Edit& edit : edits) text.replace(edit.at, edit.length, edit.by);
  return text;
}

}  // namespace fitgauge::mutants
