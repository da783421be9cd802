#include "nc/run/dotted_arguments.hpp"

#include "nc/program/cycles.hpp"
#include "nc/run/channel.hpp"
#include "nc/run/values.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Letter;
using klartext::Word;
using probing::ParameterId;

/// Reads one sub-line after the other into the arguments of the cycle.
class DottedReader {
 public:
  DottedReader(Channel& channel, const probing::CycleDescriptor& descriptor)
      : channel_(channel), descriptor_(descriptor), arguments_(descriptor) {}

  NcResult<void> read(const klartext::CyclePart& part) {
    values_ = 0;
    for (const Word& word : channel_.program().view(part.words)) TRY(read(word, part.part));
    return {};
  }

  probing::Arguments take() { return std::move(arguments_); }

 private:
  const probing::CycleParameter* find(ParameterId id, int part) const {
    const auto* parameter = descriptor_.find(id);
    return parameter != nullptr && parameter->part == part ? parameter : nullptr;
  }

  NcResult<void> set(const probing::CycleParameter& parameter, const Word& word, double added = 0) {
    const auto value = TRY(number(channel_, word.value));
    const double scale = scale_of(parameter.unit, channel_.linked().is_inch());
    arguments_.set(parameter.id, value * scale + added);
    return {};
  }

  NcResult<void> read(const Word& word, int part) {
    switch (word.letter) {
      case Letter::Result: return read_result(word, part);
      case Letter::F: return read_as(ParameterId::WordFeed, word, part);
      case Letter::Mb: return read_as(ParameterId::WordRetract, word, part);
      case Letter::Value: return read_value(word, part);
      default: return is_axis(word.letter) ? read_axis(word, part) : NcResult<void>();
    }
  }

  NcResult<void> read_as(ParameterId id, const Word& word, int part) {
    const auto* parameter = find(id, part);
    return parameter != nullptr ? set(*parameter, word) : NcResult<void>();
  }

  NcResult<void> read_result(const Word& word, int part) {
    const auto* parameter = std::get_if<klartext::QRef>(&word.value);
    if (parameter == nullptr || parameter->space != klartext::QSpace::Q) {
      return nc_error("the result of a touch-probe cycle must be a Q parameter");
    }
    if (find(ParameterId::WordResult, part) != nullptr) {
      arguments_.set(ParameterId::WordResult, static_cast<double>(parameter->number));
    }
    return {};
  }

  /// The name of the probing axis (`X-`, `X ANGLE`), or a coordinate.
  NcResult<void> read_axis(const Word& word, int part) {
    if (word.letter > Letter::Z) {
      return nc_error("a touch-probe cycle accepts only the axes X, Y and Z");
    }
    const auto axis = static_cast<int>(word.letter);
    if (find(ParameterId::WordAxis, part) != nullptr) {
      arguments_.set(ParameterId::WordAxis, static_cast<double>(axis));
      const auto* direction = find(ParameterId::WordDirection, part);
      return direction != nullptr ? set(*direction, word) : NcResult<void>();
    }
    const auto id = static_cast<ParameterId>(static_cast<int>(ParameterId::WordX) + axis);
    const auto* parameter = find(id, part);
    if (parameter == nullptr) return {};
    // IX of cycle 4 is a component of the probing direction, elsewhere a distance from here.
    const bool is_direction = descriptor_.number == 4;
    const double here = channel_.machine().position().linear[static_cast<std::size_t>(axis)];
    return set(*parameter, word, word.incremental && !is_direction ? here : 0);
  }

  /// A number after dialog text: the values of a sub-line have this order.
  NcResult<void> read_value(const Word& word, int part) {
    constexpr std::array kOrder{
        ParameterId::WordAngle,     ParameterId::WordDistance, ParameterId::WordReferenceSystem,
        ParameterId::WordErrorMode, ParameterId::WordCheck,    ParameterId::WordHeight,
        ParameterId::WordTeeth};
    while (values_ < kOrder.size()) {
      const auto* parameter = find(kOrder[values_++], part);
      if (parameter != nullptr) return set(*parameter, word);
    }
    return nc_error(fmt::format("sub-line {} of the cycle has a number too many", part));
  }

  Channel& channel_;
  const probing::CycleDescriptor& descriptor_;
  probing::Arguments arguments_;
  std::size_t values_ = 0;
};

}  // namespace

NcResult<probing::Arguments> dotted_arguments(Channel& channel,
                                              const probing::TouchProbeCycle& cycle,
                                              std::uint32_t first, std::uint32_t last) {
  DottedReader reader(channel, cycle.descriptor);
  for (std::uint32_t i = first; i <= last; ++i) {
    const auto* part = std::get_if<klartext::CyclePart>(&channel.program().blocks()[i].statement);
    if (part == nullptr) continue;
    TRY(reader.read(*part));
  }
  return reader.take();
}

}  // namespace fitgauge::interpreter
