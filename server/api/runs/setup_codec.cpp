#include "api/runs/setup_codec.hpp"

#include "api/runs/setup_machine.hpp"
#include "api/service/document_routes.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::api {
namespace {

Result<CheckedDocument> check_setup(const Services& services, const std::string&,
                                    std::string_view text) {
  const auto body = TRY(parse_json(text));
  const auto tables = TRY(services.runs.control_tables());
  FieldErrors errors;
  machine::Setup setup = decode_setup(body, "", *tables, errors);
  interpreter::RunOptions options;
  decode_builder(body, "", options, errors);
  if (auto error = errors.take()) return *std::move(error);
  TRY(services.runs.load_meshes(setup, "", app::MissingFiles::Allowed));
  return CheckedDocument{.text = std::string(text)};
}

constexpr KindOfDocument kSetups{.kind = app::DocumentKind::Setup,
                                 .path = "/v1/setups",
                                 .one = "a setup",
                                 .contents = "a machine, its tools and the workpiece on its table",
                                 .many = "named setups",
                                 .member = "setups",
                                 .operation = "Setup",
                                 .operations = "Setups",
                                 .longest_name = 100,
                                 .names_with_slashes = false,
                                 .check = check_setup};

/// Reports contradictions between fields, unless a refused field is the reason.
void check(const machine::Setup& setup, const std::string& pointer, FieldErrors& errors) {
  const auto valid = machine::validate(setup);
  if (valid) return;
  for (const Error& finding : valid.error().details) {
    std::string where = pointer + finding.where;
    if (!errors.has(where)) errors.add(finding.code, std::move(where), finding.message);
  }
}

}  // namespace

// The members of a setup's workpiece.

void members(auto& v, machine::Block& block) {
  v.member("min_mm", block.min, Mm3{}, "The corner with the smallest coordinates");
  v.member("max_mm", block.max, Mm3{}, "The corner with the largest coordinates");
}

void members(auto& v, machine::Bore& bore) {
  v.member("center_mm", bore.centre, Mm2{}, "X and Y of the opening's centre");
  v.optional("top_mm", bore.top, Mm{}, "Z of the opening");
  v.optional("depth_mm", bore.depth, Mm{}, "Depth from the opening to the flat bottom");
  v.member("diameter_mm", bore.diameter, Mm{}, "Diameter at the opening");
  v.optional("lobes", bore.lobes, Integer{0, 1000},
             "Number n of lobes, r = R + a cos(n (angle - phase)); 0: round");
  v.optional("lobe_amplitude_um", bore.lobe_amplitude_um, Um{}, "Amplitude a of the lobes");
  v.optional("lobe_phase_deg", bore.lobe_phase_deg, Number{}, "Angle of the first lobe's top");
  v.optional("taper_um_per_mm", bore.taper_um_per_mm, Number{},
             "Change of the diameter for each millimetre of depth");
  v.optional("tilt_deg", bore.tilt_deg, Numbers2{},
             "Tilt of the bore's axis around X, then around Y, at the opening");
}

void members(auto& v, machine::Plane& plane) {
  v.optional("point_mm", plane.point, Mm3{}, "A point of the plane");
  v.optional("normal", plane.normal, Numbers3{}, "Away from the material, any length");
}

void members(auto& v, machine::Sphere& sphere) {
  v.member("center_mm", sphere.centre, Mm3{}, "Centre of the sphere");
  v.member("diameter_mm", sphere.diameter, Mm{}, "Diameter");
}

void members(auto& v, machine::Surface& surface) {
  v.member("points_mm", surface.points, PointList{},
           "X, Y and Z of measured points; material below, piecewise "
           "linear between them, nothing outside their hull");
}

void members(auto& v, machine::Mesh& mesh) {
  v.member("file", mesh.file, DiskFile{},
           "STL of the control's disk, text or binary: `parts/flange.stl`");
  constexpr double kInch = 25.4;
  bool is_inch = false;
  v.optional("unit", is_inch, OneOf<2>{"mm", "inch"}, "Unit of the figures in the file");
  mesh.unit = is_inch ? kInch : 1;
  v.optional("origin_mm", mesh.origin, Mm3{}, "Position of the file's zero");
  v.optional("spatial_angles_deg", mesh.spatial_angles_deg, Numbers3{},
             "Spatial angles of the file's axes around its zero, as in PLANE SPATIAL");
}

/// A kind of feature: the word for it, its component and its meaning.
struct FeatureKind {
  std::string_view word;
  std::string_view component;
  std::string_view meaning;

  std::string schema(Side) const {
    return fmt::format(R"({{"type":"string","const":"{}"}})", word);
  }
};

/// Calls `use(kind, feature)` for each kind, with a feature that has the defaults of the contract.
void each_kind_of_feature(const auto& use) {
  use(FeatureKind{"block", "Block", "Material between two corners"}, machine::Block{});
  use(FeatureKind{"bore", "Bore", "Removes material: a hole that is open upwards"},
      machine::Bore{.depth = 30});
  use(FeatureKind{"boss", "Boss", "Material: an upright cylinder"},
      machine::Boss{.top = 10, .height = 10});
  use(FeatureKind{"plane", "Plane", "Material everywhere behind a plane"}, machine::Plane{});
  use(FeatureKind{"sphere", "Sphere", "Material: a ball"}, machine::Sphere{});
  use(FeatureKind{"surface", "Surface", "Material below a measured surface"}, machine::Surface{});
  use(FeatureKind{"mesh", "Mesh", "Material inside a closed mesh of triangles"}, machine::Mesh{});
}

/// The form of a feature, whose other members depend on the word `type`.
struct FeatureForm {
  std::string schema(Side) const { return schema::ref("Feature"); }
  void read_item(const JsonValue& item, const std::string& pointer, FieldErrors& errors,
                 machine::Feature& to) const {
    BodyReader v(item, pointer, errors);
    std::string word;
    to = machine::Plane{};
    if (item.is(JsonValue::Kind::Object)) v.member("type", word);
    std::string words;
    bool is_known = false;
    each_kind_of_feature([&](const FeatureKind& kind, auto feature) {
      words.append(words.empty() ? "" : ", ").append(kind.word);
      if (kind.word != word) return;
      is_known = true;
      members(v, feature);
      v.end();
      to = feature;
    });
    if (is_known || errors.has(pointer) || errors.has(pointer_to(pointer, "type"))) return;
    errors.add(ErrorCode::FieldInvalid, pointer_to(pointer, "type"),
               fmt::format("type must be one of: {}", words));
  }
};

inline constexpr Nested kWorkpieceForm{
    "Workpiece", [](auto& v, auto& setup) {
      const List<machine::Feature, FeatureForm> list;
      v.optional("features", setup.features, list, "Joined in this order");
      v.optional("fixtures", setup.fixtures, list,
                 "Clamps and vices, joined likewise: no value is taken from them, and a tool that "
                 "touches one ends the run as failed");
    }};

void members(auto& v, machine::Setup& setup) {
  v.optional("machine", setup.machine, Object<machine::MachineSetup>{"Machine"},
             "Axes, tools, touch probes and presets");
  v.optional("workpiece", setup, kWorkpieceForm, "Workpiece on the table (default: none)");
  builder_members(v);
  printing_members(v);
  v.optional("seed", setup.seed, Integer{},
             "Seed of the scatter of contacts; the same seed gives the same run");
}

void add_setup_schemas(Schemas& schemas) {
  const auto add = [&schemas](std::string_view name, const auto& describe) {
    BodySchema v(Side::Order);
    describe(v);
    schemas.push_back({std::string(name), v.json()});
  };
  const auto add_nested = [&add]<class T>(const auto& form, T variable) {
    add(form.component, [&](BodySchema& v) { form.describe(v, variable); });
  };
  add_nested(axis_form(machine::Axis::X), machine::AxisSetup{});
  add_nested(axis_form(machine::Axis::A), machine::AxisSetup{});
  add_nested(kAxesForm, machine::MachineSetup{}.axes);
  schemas.push_back(order_schema<machine::AxisWords>("StartPosition"));
  schemas.push_back(order_schema<machine::LatheTool>("LatheTool"));
  schemas.push_back(order_schema<machine::ToolSetup>("Tool"));
  schemas.push_back(order_schema<machine::ProbeSetup>("Probe"));
  schemas.push_back(order_schema<machine::ToolTouchProbeSetup>("ToolTouchProbe"));
  schemas.push_back(order_schema<machine::CalibrationRing>("CalibrationRing"));
  add_nested(kStudForm, machine::Boss{});
  schemas.push_back(order_schema<machine::CalibrationSphere>("CalibrationSphere"));
  add_nested(kPresetForm, machine::Preset{});
  schemas.push_back(order_schema<machine::MachineSetup>("Machine"));
  std::vector<std::pair<std::string_view, std::string>> features;
  each_kind_of_feature([&](const FeatureKind& kind, auto feature) {
    features.emplace_back(kind.word, kind.component);
    add(kind.component, [&](BodySchema& v) {
      v.member("type", kind.word, kind, kind.meaning);
      members(v, feature);
    });
  });
  schemas.push_back({"Feature", schema::one_of("type", features)});
  add_nested(kWorkpieceForm, machine::Setup{});
  schemas.push_back(order_schema<machine::Setup>("Setup"));
  schemas.push_back(names_schema("Setups", "setups"));
}

machine::Setup decode_setup(const JsonValue& body, const std::string& pointer,
                            const app::ControlTables& tables, FieldErrors& errors) {
  machine::Setup setup;
  read_body(body, pointer, errors, setup);
  const JsonValue* const machine = body.find("machine");
  const auto has = [machine](std::string_view name) {
    return machine != nullptr && machine->find(name) != nullptr;
  };
  app::add_rows(tables, {has("tools"), has("probes"), has("presets")}, setup.machine);
  check(setup, pointer, errors);
  return setup;
}

void add_setups_routes(Routes& add) { add_document_routes(add, kSetups); }

}  // namespace fitgauge::api
