#include "golden_setup.hpp"

#include <sstream>
#include <stdexcept>
#include <vector>

#include "base/text.hpp"

namespace fitgauge::interpreter::golden {
namespace {

using machine::Vec3;

klartext::MaskLanguage language(const std::string& name) {
  using klartext::MaskLanguage;
  if (name == "English") return MaskLanguage::English;
  if (name == "German") return MaskLanguage::German;
  if (name == "Dutch") return MaskLanguage::Dutch;
  if (name == "Italian") return MaskLanguage::Italian;
  throw std::runtime_error("unknown language " + name);
}

/// `Q1 = 25` or `QS1 = "H7"`.
ParameterValue parameter(const std::string& line) {
  const std::size_t equals = line.find('=');
  const auto name = parse_parameter_name(trim(std::string_view(line).substr(0, equals))).value();
  const std::string_view value = trim(std::string_view(line).substr(equals + 1));
  if (name.is_string()) return {name, std::string(value.substr(1, value.size() - 2))};
  return {name, std::stod(std::string(value))};
}

/// The words of one line after the first.
class Numbers {
 public:
  explicit Numbers(std::istringstream& in) {
    double value = 0;
    while (in >> value) values_.push_back(value);
  }
  double operator[](std::size_t i) const { return values_.at(i); }
  Vec3 vector(std::size_t i) const { return {values_.at(i), values_.at(i + 1), values_.at(i + 2)}; }
  std::size_t size() const { return values_.size(); }

 private:
  std::vector<double> values_;
};

machine::ToolSetup tool(std::istringstream& in) {
  machine::ToolSetup tool;
  in >> tool.row.number >> tool.row.l >> tool.row.r >> tool.row.name;
  return tool;
}

void add_rotary(std::istringstream& in, machine::MachineSetup& machine) {
  std::string name;
  in >> name;
  const auto axis = static_cast<machine::Axis>(name.at(0) - 'A' + 3);
  machine::AxisSetup setup = machine::AxisSetup::of(axis);
  in >> setup.min >> setup.max;
  machine.axes[machine::index(axis)] = setup;
}

bool read_feature(const std::string& word, std::istringstream& in, machine::Setup& setup) {
  if (word == "block") {
    const Numbers n(in);
    setup.features.emplace_back(machine::Block{n.vector(0), n.vector(3)});
  } else if (word == "bore") {
    const Numbers n(in);
    machine::Bore bore;
    bore.centre = {n[0], n[1]};
    bore.top = n[2];
    bore.depth = n[3];
    bore.diameter = n[4];
    setup.features.emplace_back(bore);
  } else if (word == "boss") {
    const Numbers n(in);
    setup.features.emplace_back(machine::Boss{{n[0], n[1]}, n[2], n[3], n[4]});
  } else if (word == "surface") {
    const Numbers n(in);
    machine::Surface surface;
    for (std::size_t i = 0; i + 2 < n.size(); i += 3) surface.points.push_back(n.vector(i));
    setup.features.emplace_back(surface);
  } else {
    return false;
  }
  return true;
}

bool read_machine(const std::string& word, std::istringstream& in, machine::MachineSetup& machine) {
  if (word == "tool") {
    machine.tools.push_back(tool(in));
  } else if (word == "rotary") {
    add_rotary(in, machine);
  } else if (word == "start") {
    const Numbers n(in);
    machine.start = machine::AxisWords::linear(n.vector(0));
  } else {
    return false;
  }
  return true;
}

bool read_option(const std::string& word, std::istringstream& in, CaseSetup& setup) {
  if (word == "live") {
    setup.live_tables = true;
  } else if (word == "trace") {
    setup.trace = true;
  } else if (word == "stop_ends") {
    setup.options.on_stop = OnStop::End;
  } else if (word == "block_skip") {
    setup.options.block_skip = true;
  } else if (word == "blocks") {
    in >> setup.options.limits.blocks;
  } else if (word == "language") {
    std::string name;
    in >> name;
    setup.options.language = language(name);
  } else {
    return false;
  }
  return true;
}

}  // namespace

CaseSetup read_setup(const std::string& text) {
  CaseSetup setup;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (line.front() == 'Q') {
      setup.options.parameters.push_back(parameter(line));
      continue;
    }
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (!read_feature(word, words, setup.machine) &&
        !read_machine(word, words, setup.machine.machine) && !read_option(word, words, setup)) {
      throw std::runtime_error("setup.txt: cannot read '" + line + "'");
    }
  }
  if (const auto valid = machine::validate(setup.machine); valid.has_error()) {
    throw std::runtime_error("setup.txt: " + valid.error().message);
  }
  return setup;
}

}  // namespace fitgauge::interpreter::golden
