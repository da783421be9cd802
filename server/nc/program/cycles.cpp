#include "nc/program/cycles.hpp"

#include "nc/probing/cycles.hpp"
#include "nc/probing/parameters.hpp"

namespace fitgauge::interpreter {
namespace {

constexpr CycleDescriptor setting(std::uint16_t number, std::string_view name,
                                  std::string_view meaning) {
  return {.family = probing::CycleFamily::CyclDef,
          .number = number,
          .name = name,
          .dotted = true,
          .simulated = meaning};
}

constexpr CycleDescriptor kSettings[] = {
    setting(7, "DATUM SHIFT", "moves the datum along the axes, or by row # of the datum table"),
    setting(8, "MIRROR IMAGE", "mirrors the axes that it names; without an axis it ends"),
    setting(9, "DWELL TIME", "waits for the seconds"),
    setting(10, "ROTATION", "turns the coordinates to ROT; IROT adds to it"),
    setting(11, "SCALING", "multiplies lengths by SCL"),
    setting(12, "PGM CALL", "makes the program a cycle for CYCL CALL, M99 and M89"),
    setting(13, "ORIENTATION", "turns the spindle to ANGLE with M19"),
    setting(19, "WORKING PLANE", "tilts the working plane to A, B and C"),
    setting(26, "AXIS-SPEC. SCALING", "multiplies lengths by a factor for each axis"),
    setting(32, "TOLERANCE", "allows the path to deviate by T")};

namespace usual = probing::parameter;
using probing::Unit;
using probing::ValueKind;

constexpr std::array kGeneral{
    usual::length(200, "Set-up clearance"), usual::length(204, "2nd set-up clearance"),
    usual::feed(253, "Feed for pre-positioning"), usual::feed(208, "Feed for retraction")};
constexpr std::array kDrilling{usual::length(256, "Retraction for chip breaking"),
                               usual::plain(210, "Dwell time at the top", 0, 3600),
                               usual::plain(211, "Dwell time at the depth", 0, 3600)};
constexpr std::array kPocketMilling{usual::plain(370, "Path overlap factor", 0, 1.999),
                                    usual::choice(351, "Climb 1 or up-cut -1", -1, 1),
                                    usual::choice(366, "Type of plunging", 0, 2)};
constexpr std::array kContourMilling{
    usual::plain(2, "Path overlap factor", 0.0001, 1.9999), usual::length(6, "Set-up clearance"),
    usual::coordinate(7, "Clearance height"), usual::choice(9, "Direction of rotation", -1, 1)};
constexpr std::array kProbing{usual::length(320, "Set-up clearance"),
                              usual::coordinate(260, "Clearance height"),
                              usual::choice(301, "Move to clearance height: 0 no, 1 yes", 0, 1)};
constexpr std::array kPositioning{usual::choice(345, "Positioning height: 0 last, 1 Q204", 0, 1)};

constexpr std::array<CycleDescriptor, 6> kDefinitions{
    {{.number = 100, .name = "GENERAL", .parameters = kGeneral},
     {.number = 105, .name = "DRILLING", .parameters = kDrilling},
     {.number = 110, .name = "POCKET MILLING", .parameters = kPocketMilling},
     {.number = 111, .name = "CONTOUR MILLING", .parameters = kContourMilling},
     {.number = 120, .name = "PROBING", .parameters = kProbing},
     {.number = 125, .name = "POSITIONING", .parameters = kPositioning}}};

}  // namespace

BoundCycle bind_cycle(const Program& program, const klartext::Cycle& cycle) {
  BoundCycle bound;
  if (cycle.family == klartext::CycleFamily::GlobalDef) {
    bound.global = global_definition(cycle.number);
  } else if (const auto* probing = find_cycle(cycle.family, cycle.number);
             probing != nullptr && !probing->descriptor.dotted) {
    bound.probing = probing;
  } else if (cycle.family == klartext::CycleFamily::CyclDef) {
    const auto* machining = machining_cycle(cycle.number);
    if (machining != nullptr && !machining->descriptor.dotted) bound.machining = machining;
  }
  const CycleDescriptor* descriptor = bound.descriptor();
  if (descriptor == nullptr) return bound;
  for (const klartext::CycleParameter& written : program.view(cycle.parameters))
    bound.parameters.push_back(find_parameter(*descriptor, written.parameter));
  return bound;
}

double scale_of(probing::Unit unit, bool is_inch) {
  if (!is_inch) return 1;
  switch (unit) {
    case probing::Unit::Length: return kMillimetresPerInch;
    case probing::Unit::Feed: return kMillimetresPerInch / 10;
    default: return 1;
  }
}

std::optional<ArgumentValue> literal(const Program& program,
                                     const klartext::CycleParameter& written,
                                     const CycleParameter& parameter) {
  switch (written.kind) {
    case klartext::CycleValue::Expression: break;
    case klartext::CycleValue::Max: return std::numeric_limits<double>::infinity();
    default: return std::nullopt;
  }
  if (const auto* number = std::get_if<double>(&written.value)) {
    const bool is_inch = program.unit() == klartext::Unit::Inch;
    return *number * scale_of(parameter.unit, is_inch);
  }
  if (const auto* text = std::get_if<Text>(&written.value)) return std::string(program.text(*text));
  return std::nullopt;
}

const CycleParameter* find_parameter(const CycleDescriptor& descriptor, QRef written) {
  if (written.space != QSpace::Q && written.space != QSpace::Qs) return nullptr;
  const auto* parameter = descriptor.find(probing::q(written.number));
  if (parameter == nullptr || !written.is_string()) return parameter;
  return parameter->takes_text() ? parameter : nullptr;
}

const CycleDescriptor* other_cycle(const CycleDescriptor& cycle, std::string_view name) {
  // `TAPPING` is short for `RIGID TAPPING`.
  const bool is_short =
      cycle.dotted && ascii_upper(cycle.name).find(ascii_upper(name)) != std::string::npos;
  if (is_short || ascii_iequals(cycle.name, name)) return nullptr;
  const auto is_meant = [&](const CycleDescriptor& other) {
    return other.family == cycle.family && ascii_iequals(other.name, name);
  };
  const CycleDescriptor* found = nullptr;
  const auto consider = [&](const CycleDescriptor& other) {
    const bool is_nearer = found == nullptr || found->dotted != cycle.dotted;
    if (is_nearer && is_meant(other)) found = &other;
  };
  for (const TouchProbeCycle* other : probing::cycles()) consider(other->descriptor);
  if (!cycle.dotted)
    for (const MachiningCycle& other : machining_cycles()) consider(other.descriptor);
  for (const CycleDescriptor& other : kSettings) consider(other);
  return found;
}

const CycleDescriptor* cycle_of(klartext::CycleFamily family, int number) {
  if (const auto* cycle = find_cycle(family, number)) return &cycle->descriptor;
  if (family == klartext::CycleFamily::TchProbe) return nullptr;
  if (const auto* cycle = machining_cycle(number)) return &cycle->descriptor;
  return dotted_setting(number);
}

const CycleDescriptor* dotted_setting(int number) {
  const auto* found = std::ranges::find(kSettings, number, &CycleDescriptor::number);
  return found == std::end(kSettings) ? nullptr : found;
}

bool is_available(klartext::CycleFamily family, int number, bool dotted) {
  const CycleDescriptor* cycle = cycle_of(family, number);
  return cycle != nullptr && cycle->dotted == dotted;
}

const CycleDescriptor* global_definition(int number) {
  const auto found = std::ranges::find(kDefinitions, number, &CycleDescriptor::number);
  return found == kDefinitions.end() ? nullptr : &*found;
}

const CycleDescriptor* global_definition_of(int parameter) {
  const auto has = [&](const CycleDescriptor& definition) {
    return definition.find(probing::q(parameter)) != nullptr;
  };
  const auto found = std::ranges::find_if(kDefinitions, has);
  return found == kDefinitions.end() ? nullptr : &*found;
}

}  // namespace fitgauge::interpreter
