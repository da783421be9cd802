#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::CycleValue;

/// FU is a feed a turn of the spindle, FZ a tooth.
NcResult<double> number_value(Channel& channel, const klartext::CycleParameter& written) {
  switch (written.kind) {
    case CycleValue::Max: return std::numeric_limits<double>::infinity();
    case CycleValue::Auto: return channel.contour.tool_feed;
    default: break;
  }
  const auto value = number(channel, written.value);
  if (!value || written.kind == CycleValue::Expression) return value;
  double feed = *value * channel.length_unit() * channel.state().modes.spindle_rpm;
  if (written.kind == CycleValue::Fz) {
    const Tool* tool = channel.state().active_tool();
    feed *= tool == nullptr ? 0 : tool->teeth;
  }
  return feed;
}

/// The value of a cycle parameter in mm, mm/min and degrees; MAX is infinity, AUTO the feed of TOOL
/// CALL, a text if the parameter accepts one. @errors decision 3.
NcResult<ArgumentValue> cycle_argument(Channel& channel, const klartext::CycleParameter& written,
                                       const CycleParameter& parameter) {
  if (written.kind == CycleValue::Predef) {
    const int number = written.parameter.number;
    const auto found = channel.predefined.find(number);
    if (found != channel.predefined.end()) return ArgumentValue(found->second);
    // Not null: the linker has refused parameters that no GLOBAL DEF has.
    const CycleDescriptor& definition = *global_definition_of(number);
    return nc_error(1017, "Q{} is PREDEF, but GLOBAL DEF {} {} is missing before it", number,
                    definition.number, definition.name);
  }
  if (auto value = literal(channel.program(), written, parameter)) return *std::move(value);
  if (written.kind == CycleValue::Expression && is_text(written.value)) {
    auto value = TRY(text(channel, written.value));
    return ArgumentValue(std::move(value));
  }
  const auto value = TRY(number_value(channel, written));
  const bool is_converted = written.kind != CycleValue::Expression;
  const double scale = is_converted ? 1 : scale_of(parameter.unit, channel.linked().is_inch());
  return ArgumentValue(value * scale);
}

/// A word of an old cycle in the current cycle. `scale`: 2 makes a diameter of a radius.
struct OldWord {
  int cycle;
  int part;
  Letter letter;
  int parameter;
  double scale = 1;
};

constexpr OldWord kOldWords[] = {
    {1, 1, Letter::Value, 200},  {1, 2, Letter::Value, 201},    {1, 3, Letter::Value, 202},
    {1, 4, Letter::Value, 211},  {1, 5, Letter::F, 206},        {2, 1, Letter::Value, 200},
    {2, 2, Letter::Value, 201},  {2, 3, Letter::Value, 211},    {2, 4, Letter::F, 206},
    {3, 1, Letter::Value, 200},  {3, 2, Letter::Value, 201},    {3, 3, Letter::Value, 202},
    {3, 3, Letter::F, 206},      {3, 4, Letter::X, 218},        {3, 4, Letter::Y, 218},
    {3, 5, Letter::X, 219},      {3, 5, Letter::Y, 219},        {3, 6, Letter::F, 207},
    {4, 1, Letter::Value, 200},  {4, 2, Letter::Value, 201},    {4, 3, Letter::Value, 202},
    {4, 3, Letter::F, 206},      {4, 4, Letter::X, 218},        {4, 4, Letter::Y, 219},
    {4, 5, Letter::X, 218},      {4, 5, Letter::Y, 219},        {4, 6, Letter::F, 207},
    {4, 6, Letter::Value, 220},  {4, 6, Letter::Dr, 351},       {5, 5, Letter::Dr, 351},
    {5, 1, Letter::Value, 200},  {5, 2, Letter::Value, 201},    {5, 3, Letter::Value, 202},
    {5, 3, Letter::F, 206},      {5, 4, Letter::Value, 223, 2}, {5, 5, Letter::F, 207},
    {17, 1, Letter::Value, 200}, {17, 2, Letter::Value, 201},   {17, 3, Letter::Value, 239},
    {18, 1, Letter::Value, 201}, {18, 2, Letter::Value, 239},
};

const OldWord* find_old(int cycle, int part, Letter letter) {
  for (const OldWord& row : kOldWords) {
    if (row.cycle == cycle && row.part == part && row.letter == letter) return &row;
  }
  return nullptr;
}

/// Feeds of an INCH program count tenths of an inch a minute.
double unit_of(const Channel& channel, int parameter) {
  if (parameter == 211 || !channel.linked().is_inch()) return 1;
  const bool is_feed = parameter == 206 || parameter == 207;
  return is_feed ? kMillimetresPerInch / 10 : kMillimetresPerInch;
}

}  // namespace

std::vector<PartWord> words_of_parts(const Channel& channel, std::uint32_t first,
                                     std::uint32_t last) {
  std::vector<PartWord> all;
  const auto blocks = channel.program().blocks();
  for (std::uint32_t i = first; i <= last; ++i) {
    const auto* part = blocks[i].as<klartext::CyclePart>();
    if (part == nullptr) continue;
    for (const Word& word : channel.program().view(part->words)) all.push_back({part->part, word});
  }
  return all;
}

NcResult<Arguments> cycle_arguments(Channel& channel, const klartext::Cycle& cycle,
                                    const BoundCycle& bound) {
  Arguments arguments(*bound.descriptor());
  const auto parameters = channel.program().view(cycle.parameters);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    auto value = TRY(cycle_argument(channel, parameters[i], *bound.parameters[i]));
    arguments.set(bound.parameters[i]->id, std::move(value));
  }
  return arguments;
}

NcResult<MachiningDefinition> machining_arguments(Channel& channel, const klartext::Cycle& cycle,
                                                  const BoundCycle& bound) {
  auto arguments = TRY(cycle_arguments(channel, cycle, bound));
  TRY(arguments.complete());
  MachiningDefinition definition{.cycle = bound.machining};
  for (const CycleParameter* parameter : bound.parameters)
    definition.given.insert(static_cast<int>(parameter->id));
  for (const CycleParameter& parameter : bound.machining->descriptor.parameters) {
    if (arguments.has_number(parameter.id)) {
      definition.values[static_cast<int>(parameter.id)] = arguments.number(parameter.id);
    } else if (const std::string* written = arguments.text(parameter.id)) {
      definition.text = *written;
    }
  }
  return definition;
}

NcResult<MachiningDefinition> machining_arguments(Channel& channel, const MachiningCycle& cycle,
                                                  std::uint32_t first, std::uint32_t last) {
  MachiningDefinition definition{.cycle = &cycle};
  for (const auto& [part, word] : words_of_parts(channel, first, last)) {
    const OldWord* row = find_old(cycle.descriptor.number, part, word.letter);
    if (row == nullptr || is_absent(word.value)) continue;
    const auto value = TRY(number(channel, word.value));
    double result = value * row->scale * unit_of(channel, row->parameter);
    // Depth, pitch and rotation have a direction, the others are sizes.
    const bool has_direction =
        row->parameter == 201 || row->parameter == 239 || row->parameter == 351;
    if (row->parameter == 218) {  // the slot runs along that axis, in that direction
      definition.values[374] = (word.letter == Letter::Y ? 90 : 0) + (result < 0 ? 180 : 0);
    }
    if (!has_direction) result = std::abs(result);
    definition.values[row->parameter] = result;
    definition.given.insert(row->parameter);
  }
  return definition;
}

NcResult<Arguments> dotted_arguments(Channel& channel, const TouchProbeCycle& cycle,
                                     std::uint32_t first, std::uint32_t last) {
  // Numbers after dialog text: the values of a sub-line have this order.
  constexpr std::array kOrder{
      ParameterId::WordAngle,     ParameterId::WordDistance, ParameterId::WordReferenceSystem,
      ParameterId::WordErrorMode, ParameterId::WordCheck,    ParameterId::WordHeight,
      ParameterId::WordTeeth};
  Arguments arguments(cycle.descriptor);
  int last_part = -1;
  auto next = kOrder.begin();  // of the sub-line
  for (const auto& [part, word] : words_of_parts(channel, first, last)) {
    if (std::exchange(last_part, part) != part) next = kOrder.begin();
    const auto has = [&, sub_line = part](ParameterId id) {
      const auto* parameter = cycle.descriptor.find(id);
      return parameter != nullptr && parameter->part == sub_line;
    };
    ParameterId id{};
    double added = 0;
    if (word.letter == Letter::Result) {
      const auto* parameter = std::get_if<QRef>(&word.value);
      if (parameter == nullptr || parameter->space != QSpace::Q)
        return nc_error("the result of a touch-probe cycle must be a Q parameter");
      if (has(ParameterId::WordResult))
        arguments.set(ParameterId::WordResult, static_cast<double>(parameter->number));
      continue;
    }
    if (is_axis(word.letter)) {  // the name of the probing axis (`X-`, `X ANGLE`), or a coordinate
      if (word.letter > Letter::Z)
        return nc_error("a touch-probe cycle accepts only the axes X, Y and Z");
      const auto axis = static_cast<int>(word.letter);
      id = static_cast<ParameterId>(static_cast<int>(ParameterId::WordX) + axis);
      if (has(ParameterId::WordAxis)) {
        arguments.set(ParameterId::WordAxis, static_cast<double>(axis));
        id = ParameterId::WordDirection;
      } else if (word.incremental && cycle.descriptor.number != 4) {
        // IX of cycle 4 is a component of the probing direction, elsewhere a distance from here.
        added = channel.machine().position().linear[static_cast<std::size_t>(axis)];
      }
    } else if (word.letter == Letter::Value) {
      next = std::find_if(next, kOrder.end(), has);
      if (next == kOrder.end())
        return nc_error("sub-line {} of the cycle has a number too many", part);
      id = *next++;
    } else if (word.letter == Letter::F || word.letter == Letter::Mb) {
      id = word.letter == Letter::F ? ParameterId::WordFeed : ParameterId::WordRetract;
    }
    if (!has(id)) continue;
    const auto value = TRY(number(channel, word.value));
    const double scale = scale_of(cycle.descriptor.find(id)->unit, channel.linked().is_inch());
    arguments.set(id, value * scale + added);
  }
  return arguments;
}

NcResult<std::vector<std::uint32_t>> contour_labels(Channel& channel, std::uint32_t first,
                                                    std::uint32_t last) {
  std::vector<std::uint32_t> labels;
  for (const auto& [part, word] : words_of_parts(channel, first, last)) {
    if (part == 0 || word.letter != Letter::Value) continue;
    const auto label = TRY(whole(channel, word.value));
    labels.push_back(static_cast<std::uint32_t>(std::max(0, label)));
  }
  if (labels.empty()) return nc_error(1017, "CYCL DEF 14 names no label");
  return labels;
}

}  // namespace fitgauge::interpreter
