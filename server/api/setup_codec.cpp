#include "api/setup_codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace fitgauge::api {
namespace {

using machine::Axis;
using machine::Vec3;
using Kind = JsonValue::Kind;

constexpr int kHighestNumber = 65535;

/// Reads optional members of an object into variables that hold their defaults.
class SetupReader {
 public:
  SetupReader(const JsonValue& object, std::string pointer, FieldErrors& errors)
      : fields_(object, pointer, errors), pointer_(std::move(pointer)), errors_(errors) {}
  SetupReader(const SetupReader&) = delete;
  SetupReader& operator=(const SetupReader&) = delete;
  ~SetupReader() { fields_.refuse_unknown(); }

  FieldReader& fields() { return fields_; }
  FieldErrors& errors() { return errors_; }
  std::string at(std::string_view name) const { return pointer_to(pointer_, name); }

  void mm(std::string_view name, double& value) {
    if (fields_.has(name)) required_mm(name, value);
  }
  void required_mm(std::string_view name, double& value) {
    if (const auto length = fields_.mm(name)) value = length->to_mm();
  }
  void mm(std::string_view name, std::optional<double>& value) {
    if (!fields_.has(name)) return;
    if (const auto length = fields_.mm(name)) value = length->to_mm();
  }
  void um(std::string_view name, double& value) {
    if (!fields_.has(name)) return;
    constexpr double kMicrometres = 1000;
    if (const auto length = fields_.um(name)) {
      value = static_cast<double>(length->count()) / kMicrometres;
    }
  }
  void number(std::string_view name, double& value) { value = fields_.number_or(name, value); }
  void integer(std::string_view name, int& value, int least, int most) {
    value = static_cast<int>(fields_.integer_or(name, value, least, most));
  }
  void boolean(std::string_view name, bool& value) { value = fields_.boolean_or(name, value); }
  void text(std::string_view name, std::string& value) {
    if (auto given = fields_.optional_text(name)) value = *std::move(given);
  }

  /// Lengths or plain numbers in an array of as many elements as `values` has.
  template <std::size_t N>
  void mm(std::string_view name, std::array<double, N>& values) {
    elements(name, values, [](FieldReader& element, std::string_view index) {
      const auto length = element.mm(index);
      return length ? std::optional(length->to_mm()) : std::nullopt;
    });
  }
  template <std::size_t N>
  void numbers(std::string_view name, std::array<double, N>& values) {
    elements(name, values,
             [](FieldReader& element, std::string_view index) { return element.number(index); });
  }
  void mm(std::string_view name, Vec3& point) {
    std::array<double, 3> values{point.x, point.y, point.z};
    mm(name, values);
    point = {values[0], values[1], values[2]};
  }
  void numbers(std::string_view name, Vec3& vector) {
    std::array<double, 3> values{vector.x, vector.y, vector.z};
    numbers(name, values);
    vector = {values[0], values[1], values[2]};
  }
  void required_mm(std::string_view name, Vec3& point) {
    if (!fields_.has(name)) fields_.array(name);  // reports that it is missing
    mm(name, point);
  }
  template <std::size_t N>
  void required_mm(std::string_view name, std::array<double, N>& values) {
    if (!fields_.has(name)) fields_.array(name);
    mm(name, values);
  }

  /// Calls `read(object reader)` for a member that is there.
  template <class Read>
  void object(std::string_view name, const Read& read) {
    if (!fields_.has(name)) return;
    const JsonValue* value = fields_.object(name);
    if (value == nullptr) return;
    SetupReader reader(*value, at(name), errors_);
    read(reader);
  }

  /// Replaces `rows` by what `read(object reader)` gives for each element of an array.
  template <class Row, class Read>
  void array(std::string_view name, std::vector<Row>& rows, const Read& read) {
    if (!fields_.has(name)) return;
    const JsonValue* value = fields_.array(name);
    if (value == nullptr) return;
    rows.clear();
    for (std::size_t i = 0; i < value->items.size(); ++i) {
      SetupReader reader(value->items[i], pointer_to(at(name), i), errors_);
      rows.push_back(read(reader));
    }
  }

 private:
  template <std::size_t N, class Read>
  void elements(std::string_view name, std::array<double, N>& values, const Read& read) {
    if (!fields_.has(name)) return;
    const JsonValue* array = fields_.array(name);
    if (array != nullptr) read_elements(*array, at(name), values, read, errors_);
  }

  template <std::size_t N, class Read>
  static void read_elements(const JsonValue& array, const std::string& pointer,
                            std::array<double, N>& values, const Read& read, FieldErrors& errors) {
    if (array.items.size() != N) {
      return errors.add(ErrorCode::FieldInvalid, pointer,
                        fmt::format("{} numbers are wanted, not {}", N, array.items.size()));
    }
    // The elements as members of an object, whose names are then the tokens of their pointers.
    JsonValue object{.kind = Kind::Object};
    for (std::size_t i = 0; i < N; ++i) {
      object.members.emplace_back(std::to_string(i), array.items[i]);
    }
    FieldReader element(object, pointer, errors);
    for (std::size_t i = 0; i < N; ++i) {
      if (const auto value = read(element, object.members[i].first)) values[i] = *value;
    }
  }

  friend void read_points(SetupReader& reader, std::vector<Vec3>& points);

  FieldReader fields_;
  const std::string pointer_;
  FieldErrors& errors_;
};

void read_points(SetupReader& reader, std::vector<Vec3>& points) {
  const JsonValue* array = reader.fields().array("points_mm");
  if (array == nullptr) return;
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    const std::string pointer = pointer_to(reader.at("points_mm"), i);
    const JsonValue& item = array->items[i];
    if (!item.is(Kind::Array)) {
      reader.errors().add(ErrorCode::FieldType, pointer,
                          fmt::format("an array is wanted, not {}", name_of(item.kind)));
      continue;
    }
    std::array<double, 3> point{};
    SetupReader::read_elements(
        item, pointer, point,
        [](FieldReader& element, std::string_view index) {
          const auto length = element.mm(index);
          return length ? std::optional(length->to_mm()) : std::nullopt;
        },
        reader.errors());
    points.push_back({point[0], point[1], point[2]});
  }
}

machine::AxisSetup read_axis(SetupReader& reader, Axis axis) {
  machine::AxisSetup setup = machine::AxisSetup::of(axis);
  if (!is_rotary(axis)) {
    reader.mm("min_mm", setup.min);
    reader.mm("max_mm", setup.max);
    return setup;
  }
  reader.number("min_deg", setup.min);
  reader.number("max_deg", setup.max);
  reader.number("hirth_grid_deg", setup.hirth_grid_deg);
  if (const auto mount = reader.fields().optional_text("on")) {
    if (*mount != "table" && *mount != "head") {
      reader.fields().report(ErrorCode::FieldInvalid, "on", "on takes \"table\" or \"head\"");
    }
    setup.mount = *mount == "head" ? machine::AxisMount::Head : machine::AxisMount::Table;
  }
  reader.mm("center_mm", setup.centre);
  reader.numbers("direction", setup.direction);
  reader.mm("center_error_mm", setup.centre_error);
  reader.numbers("tilt_error_deg", setup.tilt_error_deg);
  reader.number("backlash_deg", setup.backlash_deg);
  reader.um("scatter_um", setup.scatter_um);
  return setup;
}

machine::ToolSetup read_tool(SetupReader& reader) {
  machine::ToolSetup tool;
  machine::Tool& row = tool.row;
  if (!reader.fields().has("number")) reader.fields().number("number");  // reports it as missing
  reader.integer("number", row.number, 0, kHighestNumber);
  reader.text("name", row.name);
  reader.mm("length_mm", row.l);
  reader.mm("radius_mm", row.r);
  reader.mm("corner_radius_mm", row.r2);
  std::array<double, 3> delta{};
  reader.mm("delta_mm", delta);
  std::tie(row.dl, row.dr, row.dr2) = std::tie(delta[0], delta[1], delta[2]);
  reader.mm("actual_length_mm", tool.actual_length);
  reader.mm("actual_radius_mm", tool.actual_radius);
  reader.mm("length_tolerance_mm", row.l_tolerance);
  reader.mm("radius_tolerance_mm", row.r_tolerance);
  reader.mm("length_breakage_mm", row.l_breakage);
  reader.mm("radius_breakage_mm", row.r_breakage);
  reader.mm("length_offset_mm", row.l_offset);
  reader.mm("radius_offset_mm", row.r_offset);
  reader.integer("teeth", row.teeth, 0, 1000);
  reader.boolean("locked", row.locked);
  reader.integer("probe", row.probe, 0, kHighestNumber);
  return tool;
}

machine::ProbeSetup read_probe(SetupReader& reader) {
  machine::ProbeSetup probe;
  machine::ProbeRow& row = probe.row;
  reader.integer("number", row.number, 0, kHighestNumber);
  reader.mm("set_up_mm", row.set_up);
  reader.mm("dist_mm", row.distance);
  reader.number("feed_mm_min", row.feed);
  reader.number("fmax_mm_min", row.rapid);
  reader.mm("cal_of1_mm", row.cal_of1);
  reader.mm("cal_of2_mm", row.cal_of2);
  reader.um("repeatability_um", probe.repeatability_um);
  reader.um("pretravel_um", probe.pretravel_um);
  reader.mm("center_offset_mm", probe.centre_offset);
  return probe;
}

machine::Preset read_preset(SetupReader& reader) {
  machine::Preset preset;
  preset.number = 1;
  reader.integer("number", preset.number, 0, kHighestNumber);
  reader.text("comment", preset.comment);
  reader.mm("x_mm", preset.frame.origin.x);
  reader.mm("y_mm", preset.frame.origin.y);
  reader.mm("z_mm", preset.frame.origin.z);
  reader.numbers("rotation_deg", preset.frame.basic_rotation_deg);
  reader.numbers("offsets_deg", preset.frame.rotary_offsets_deg);
  reader.boolean("locked", preset.locked);
  return preset;
}

void read_start(SetupReader& reader, machine::AxisWords& start) {
  for (const Axis axis : machine::kAllAxes) {
    if (!reader.fields().has(name(axis))) continue;
    if (is_rotary(axis)) {
      start[axis] = reader.fields().number(name(axis));
    } else {
      reader.mm(name(axis), start[axis]);
    }
  }
}

void read_tool_touch_probe(SetupReader& reader, machine::ToolTouchProbeSetup& tt) {
  reader.mm("center_mm", tt.known.centre);
  reader.mm("radius_mm", tt.known.radius);
  if (const auto shape = reader.fields().optional_text("shape")) {
    if (*shape != "disc" && *shape != "cube") {
      reader.fields().report(ErrorCode::FieldInvalid, "shape", "shape takes \"disc\" or \"cube\"");
    }
    tt.shape = *shape == "cube" ? machine::ContactPlate::Cube : machine::ContactPlate::Disc;
  }
  if (reader.fields().has("actual_center_mm")) {
    reader.mm("actual_center_mm", tt.actual_centre.emplace(tt.known.centre));
  }
  reader.mm("actual_radius_mm", tt.actual_radius);
  reader.um("repeatability_um", tt.repeatability_um);
}

/// The members that a boss, a stud and a ring have in common.
template <class Cylinder>
void read_cylinder(SetupReader& reader, Cylinder& cylinder) {
  reader.required_mm("center_mm", cylinder.centre);
  reader.mm("top_mm", cylinder.top);
  reader.mm("height_mm", cylinder.height);
  reader.required_mm("diameter_mm", cylinder.diameter);
}

void read_calibration_ring(SetupReader& reader, machine::CalibrationRing& ring) {
  read_cylinder(reader, ring);
  reader.mm("outer_diameter_mm", ring.outer_diameter);
}

machine::MachineSetup read_machine(SetupReader& reader) {
  machine::MachineSetup machine;
  reader.object("axes", [&machine](SetupReader& axes) {
    for (const Axis axis : machine::kAllAxes) {
      axes.object(name(axis), [&](SetupReader& fields) {
        machine.axes[index(axis)] = read_axis(fields, axis);
      });
    }
  });
  reader.object("start_mm", [&machine](SetupReader& start) { read_start(start, machine.start); });
  reader.number("rapid_mm_min", machine.rapid_mm_min);
  reader.array("tools", machine.tools, read_tool);
  reader.array("probes", machine.probes, read_probe);
  reader.object("tt", [&machine](SetupReader& tt) { read_tool_touch_probe(tt, machine.tt); });
  reader.object("calibration_ring", [&machine](SetupReader& ring) {
    read_calibration_ring(ring, machine.calibration_ring.emplace());
  });
  reader.object("calibration_stud", [&machine](SetupReader& stud) {
    machine.calibration_stud = machine::Boss{.height = 20};
    read_cylinder(stud, *machine.calibration_stud);
  });
  reader.object("calibration_sphere", [&machine](SetupReader& fields) {
    machine::CalibrationSphere& sphere = machine.calibration_sphere.emplace();
    fields.required_mm("center_mm", sphere.centre);
    fields.mm("radius_mm", sphere.radius);
  });
  reader.array("presets", machine.presets, read_preset);
  reader.integer("active_preset", machine.active_preset, 0, kHighestNumber);
  return machine;
}

machine::Feature read_block(SetupReader& reader) {
  machine::Block block;
  reader.required_mm("min_mm", block.min);
  reader.required_mm("max_mm", block.max);
  return block;
}

machine::Feature read_bore(SetupReader& reader) {
  machine::Bore bore;
  bore.depth = 30;
  reader.required_mm("center_mm", bore.centre);
  reader.mm("top_mm", bore.top);
  reader.mm("depth_mm", bore.depth);
  reader.required_mm("diameter_mm", bore.diameter);
  reader.integer("lobes", bore.lobes, 0, 1000);
  reader.um("lobe_amplitude_um", bore.lobe_amplitude_um);
  reader.number("lobe_phase_deg", bore.lobe_phase_deg);
  reader.number("taper_um_per_mm", bore.taper_um_per_mm);
  reader.numbers("tilt_deg", bore.tilt_deg);
  return bore;
}

machine::Feature read_boss(SetupReader& reader) {
  machine::Boss boss;
  boss.top = 10;
  boss.height = 10;
  read_cylinder(reader, boss);
  return boss;
}

machine::Feature read_plane(SetupReader& reader) {
  machine::Plane plane;
  reader.mm("point_mm", plane.point);
  reader.numbers("normal", plane.normal);
  return plane;
}

machine::Feature read_sphere(SetupReader& reader) {
  machine::Sphere sphere;
  reader.required_mm("center_mm", sphere.centre);
  reader.required_mm("diameter_mm", sphere.diameter);
  return sphere;
}

machine::Feature read_surface(SetupReader& reader) {
  machine::Surface surface;
  read_points(reader, surface.points);
  return surface;
}

struct FeatureKind {
  std::string_view type;
  machine::Feature (*read)(SetupReader&);
};
constexpr std::array<FeatureKind, 6> kFeatures{{{"block", read_block},
                                                {"bore", read_bore},
                                                {"boss", read_boss},
                                                {"plane", read_plane},
                                                {"sphere", read_sphere},
                                                {"surface", read_surface}}};

machine::Feature read_feature(SetupReader& reader) {
  const auto type = reader.fields().text("type");
  const auto kind = std::find_if(kFeatures.begin(), kFeatures.end(),
                                 [&type](const FeatureKind& k) { return type && k.type == *type; });
  if (kind != kFeatures.end()) return kind->read(reader);
  if (type) {
    reader.fields().report(ErrorCode::FieldInvalid, "type",
                           "type takes block, bore, boss, plane, sphere or surface");
  }
  reader.fields().accept_all();  // what else it may have depends on its type
  return machine::Plane{};
}

/// What does not make sense together, unless a field that was refused already is why.
void check(const machine::Setup& setup, const std::string& pointer, FieldErrors& errors) {
  const auto valid = machine::validate(setup);
  if (valid) return;
  for (const Error& finding : valid.error().details) {
    std::string where = pointer + finding.where;
    if (!errors.has(where)) errors.add(finding.code, std::move(where), finding.message);
  }
}

}  // namespace

machine::Setup decode_setup(const JsonValue& body, const std::string& pointer,
                            const app::ControlTables& tables, FieldErrors& errors) {
  machine::Setup setup;
  app::GivenTables given;
  {
    SetupReader reader(body, pointer, errors);
    reader.object("machine", [&](SetupReader& machine) {
      const FieldReader& fields = machine.fields();
      given = {fields.has("tools"), fields.has("probes"), fields.has("presets")};
      setup.machine = read_machine(machine);
    });
    reader.object("workpiece", [&setup](SetupReader& workpiece) {
      workpiece.array("features", setup.features, read_feature);
    });
    setup.seed = static_cast<std::uint64_t>(
        reader.fields().integer_or("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  }
  app::add_rows(tables, given, setup.machine);
  check(setup, pointer, errors);
  return setup;
}

}  // namespace fitgauge::api
