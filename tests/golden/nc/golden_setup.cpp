#include "golden_setup.hpp"

#include <sstream>

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

/// The real tool, with the number of its row: `actual 30 120.1 1.98`.
void add_actual(std::istringstream& in, machine::MachineSetup& machine) {
  const Numbers n(in);
  for (machine::ToolSetup& tool : machine.tools) {
    if (tool.row.number != static_cast<int>(n[0])) continue;
    tool.actual_length = n[1];
    (tool.row.lathe ? tool.actual_xl : tool.actual_radius) = n[2];
  }
}

/// A lathe tool: `lathe number ZL XL RS TO ORI`.
machine::ToolSetup lathe_tool(std::istringstream& in) {
  const Numbers n(in);
  machine::ToolSetup tool;
  tool.row.number = static_cast<int>(n[0]);
  tool.row.lathe = machine::LatheTool{
      .zl = n[1], .xl = n[2], .rs = n[3], .orientation = static_cast<int>(n[4]), .ori = n[5]};
  return tool;
}

/// LTOL RTOL LBREAK RBREAK CUT of the last tool.
void add_limits(std::istringstream& in, machine::Tool& row) {
  const Numbers n(in);
  row.l_tolerance = n[0];
  row.r_tolerance = n[1];
  row.l_breakage = n[2];
  row.r_breakage = n[3];
  row.teeth = static_cast<int>(n[4]);
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
    if (n.size() > 5) {
      bore.lobes = static_cast<int>(n[5]);
      bore.lobe_amplitude_um = n[6];
    }
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

/// What the probe and the tools are calibrated against, and how they really are.
bool read_standard(const std::string& word, std::istringstream& in,
                   machine::MachineSetup& machine) {
  if (word == "actual") {
    add_actual(in, machine);
  } else if (word == "limits") {
    add_limits(in, machine.tools.back().row);
  } else if (word == "offset") {
    const Numbers n(in);
    machine.probes.at(0).centre_offset = {n[0], n[1]};
  } else if (word == "ring") {
    const Numbers n(in);
    machine.calibration_ring = machine::CalibrationRing{{n[0], n[1]}, n[2], n[3], n[4], {}};
  } else if (word == "stud") {
    const Numbers n(in);
    machine.calibration_stud = machine::Boss{{n[0], n[1]}, n[2], n[3], n[4]};
  } else if (word == "sphere") {
    const Numbers n(in);
    machine.calibration_sphere = machine::CalibrationSphere{n.vector(0), n[3]};
  } else if (word == "cuboid") {
    machine.tt.known.shape = machine::ContactPlate::Cube;
  } else if (word == "disc") {
    machine.tt.known.shape = machine::ContactPlate::Disc;
  } else if (word == "tt") {
    const Numbers n(in);
    machine.tt.actual_centre = n.vector(0);
    machine.tt.actual_radius = n[3];
  } else {
    return false;
  }
  return true;
}

machine::AxisSetup& rotary_axis(std::istringstream& in, machine::MachineSetup& machine) {
  std::string name;
  in >> name;
  return machine.axes.at(3 + static_cast<std::size_t>(name.at(0) - 'A')).value();
}

/// How the rotary axes really are, and where the sphere is expected.
bool read_kinematics(const std::string& word, std::istringstream& in,
                     machine::MachineSetup& machine) {
  if (word == "error") {
    machine::AxisSetup& axis = rotary_axis(in, machine);
    const Numbers n(in);
    axis.centre_error = n.vector(0);
    axis.tilt_error_deg = n.vector(3);
  } else if (word == "hirth") {
    in >> rotary_axis(in, machine).hirth_grid_deg;
  } else if (word == "strobe") {
    std::string name;
    in >> name;
    machine.kinematics_options.strobed.at(static_cast<std::size_t>(name.at(0) - 'A')) = true;
  } else if (word == "noise") {  // repeatability of the probe in um
    in >> machine.probes.front().repeatability_um;
  } else if (word == "preset") {
    const Numbers n(in);
    machine.presets.front().frame.origin = n.vector(0);
  } else {
    return false;
  }
  return true;
}

bool read_machine(const std::string& word, std::istringstream& in, machine::MachineSetup& machine) {
  if (word == "tool" || word == "lathe") {
    const machine::ToolSetup added = word == "tool" ? tool(in) : lathe_tool(in);
    std::erase_if(machine.tools,
                  [&](const auto& known) { return known.row.number == added.row.number; });
    machine.tools.push_back(added);
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

/// What is missing or in the way.
bool read_obstacle(const std::string& word, std::istringstream& in, machine::Setup& setup) {
  machine::MachineSetup& machine = setup.machine;
  if (word == "nothing") {
    setup.features.clear();
    machine.calibration_ring.reset();
    machine.calibration_stud.reset();
    machine.calibration_sphere.reset();
  } else if (word == "rigid") {
    for (const machine::Axis axis : {machine::Axis::A, machine::Axis::B, machine::Axis::C}) {
      machine.axes[machine::index(axis)].reset();
    }
  } else if (word == "head") {
    rotary_axis(in, machine).mount = machine::AxisMount::Head;
  } else if (word == "locked") {
    const int number = static_cast<int>(Numbers(in)[0]);
    std::erase_if(machine.presets, [&](const auto& row) { return row.number == number; });
    machine::Preset row = machine::MachineSetup::default_preset();
    row.number = number;
    row.locked = true;
    machine.presets.insert(machine.presets.begin(), row);
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
        !read_machine(word, words, setup.machine.machine) &&
        !read_standard(word, words, setup.machine.machine) &&
        !read_kinematics(word, words, setup.machine.machine) &&
        !read_obstacle(word, words, setup.machine) && !read_option(word, words, setup)) {
      throw std::runtime_error("setup.txt: cannot read '" + line + "'");
    }
  }
  if (const auto valid = machine::validate(setup.machine); valid.has_error()) {
    throw std::runtime_error("setup.txt: " + valid.error().message);
  }
  return setup;
}

}  // namespace fitgauge::interpreter::golden
